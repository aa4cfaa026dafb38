#include "airsim360/render/reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/reference/path_batch.h"

namespace airsim360::internal {
namespace {

Rgb32f ToRgb(Vec3d c) { return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)}; }

// Sums of a pixel's samples and of their squares.
struct Sums {
  Vec3d light, squares;
  int count = 0;

  void Add(Vec3f c) {
    const Vec3d d = VecCast<double>(c);
    light += d;
    squares += d * d;
    ++count;
  }
  Vec3d mean() const { return light * (1.0 / std::max(count, 1)); }
  Vec3d variance_of_mean() const {
    const Vec3d m = mean();
    const double n = count;
    return count < 2 ? Vec3d{} : Max(squares * (1 / n) - m * m, Vec3d{}) * (1 / (n - 1));
  }
};

class ImageTracer {
 public:
  ImageTracer(const PathScene& scene, const CameraRays& rays, Vec3f origin, const PathTracerOptions& options)
      : scene_(scene), rays_(rays), origin_(origin), options_(options) {}

  void RunTile(int column, int row, Image<Rgb32f>& radiance, Image<Rgb32f>* variance) const;

 private:
  bool Start(int column, int row, uint32_t sample, Path& path) const;

  const PathScene& scene_;
  const CameraRays& rays_;
  const Vec3f origin_;
  const PathTracerOptions& options_;
};

// The camera ray of a sample; canonical pixels choose its numbers, so that turning the camera by whole
// columns rolls the image.
bool ImageTracer::Start(int column, int row, uint32_t sample, Path& path) const {
  path.sampler = PathSampler(options_.seed, static_cast<uint64_t>(row) * rays_.field().width + column);
  path.sample = sample;
  const Vec2f at = path.sampler.Pair(sample, 0);
  Vec3d direction;
  if (!rays_.Direction(column, row, rays_.MakeOffset(at.x - 0.5, at.y - 0.5), direction)) return false;
  path.origin = origin_;
  path.direction = VecCast<float>(direction);
  path.spread = static_cast<float>(rays_.cone_angle()) * kPathFootprint;
  return true;
}

void ImageTracer::RunTile(int column, int row, Image<Rgb32f>& radiance, Image<Rgb32f>* variance) const {
  const RayField& field = rays_.field();
  const int width = std::min(kTileSize, field.width - column), height = std::min(kTileSize, field.height - row);
  PathBatch batch(scene_, options_.max_bounces, options_.next_event, static_cast<float>(rays_.cone_angle()));
  Sums sums[kTileSize * kTileSize];
  int pixel_of[kTileSize * kTileSize];
  for (int sample = 0; sample < options_.samples; ++sample) {
    batch.Clear();
    for (int k = 0; k < width * height; ++k) {
      Path path;
      if (!Start(column + k % width, row + k / width, static_cast<uint32_t>(sample), path)) continue;
      pixel_of[batch.size()] = k;
      batch.Add(path);
    }
    batch.Run();
    for (int i = 0; i < batch.size(); ++i) sums[pixel_of[i]].Add(batch.path(i).radiance);
  }
  for (int k = 0; k < width * height; ++k) {
    const int x = ((column + k % width - rays_.column_shift()) % field.width + field.width) % field.width;
    radiance(x, row + k / width) = ToRgb(sums[k].mean());
    if (variance != nullptr) (*variance)(x, row + k / width) = ToRgb(sums[k].variance_of_mean());
  }
}

}  // namespace

void TracePaths(const RayTracer& tracer, const Shader& shader, const CameraRays& rays, Vec3f origin, const PathTracerOptions& options,
                Image<Rgb32f>& radiance, Image<Rgb32f>* variance) {
  const RayField& field = rays.field();
  for (Image<Rgb32f>* image : {&radiance, variance}) {
    if (image != nullptr && (image->width() != field.width || image->height() != field.height))
      *image = Image<Rgb32f>(field.width, field.height);
  }
  const PathScene scene(tracer, shader);
  const ImageTracer image(scene, rays, origin, options);
  const int across = (field.width + kTileSize - 1) / kTileSize, down = (field.height + kTileSize - 1) / kTileSize;
  std::atomic<int> done = 0;
  ParallelFor(int64_t{across} * down, [&](int64_t tile) {
    const FlushDenormals flush_denormals;
    image.RunTile(static_cast<int>(tile % across) * kTileSize, static_cast<int>(tile / across) * kTileSize, radiance, variance);
    const int count = ++done;
    if (options.progress) options.progress(static_cast<double>(count) / (across * down));
  });
}

}  // namespace airsim360::internal
