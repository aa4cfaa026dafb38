#include "airsim360/render/frame/antialias.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/render/frame/edge_rays.h"
#include "airsim360/render/frame/interruption.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr int kContrast = 15;  // of 255: about what the eye sees as a step
constexpr int kSymmetries = 8;
constexpr int kRowsPerTask = 16;
constexpr int kTableSize = 8192;
constexpr int kRunTiles = 4;  // side by side, so that batches fill
constexpr int kRunWidth = kRunTiles * kTileSize, kRunPixels = kRunTiles * kTilePixels;

// 8-bit sRGB of linear light in [0, 1], to within one code.
uint8_t EncodeSrgb(float linear) {
  static const std::array<uint8_t, kTableSize> table = [] {
    std::array<uint8_t, kTableSize> t{};
    for (int i = 0; i < kTableSize; ++i) t[i] = LinearToSrgb8((static_cast<float>(i)) / (kTableSize - 1));
    return t;
  }();
  return table[static_cast<int>(linear * (kTableSize - 1) + 0.5f)];
}

// The edge pixels of a run of tiles.
class EdgeRun : public EdgeRays {
 public:
  EdgeRun(const AntialiasTask& task, const TileKernels& kernels) : EdgeRays(task, kernels), task_(task) {}

  // Adds a pixel of the run with its place in the image, where the colour of its centre ray is, and its kind of
  // edge.
  void AddPixel(int x, int y, int image_x, int image_y, uint8_t edge) {
    image_x_[pixel_count_] = image_x, image_y_[pixel_count_] = image_y;
    x_[pixel_count_] = static_cast<uint8_t>(x);
    y_[pixel_count_] = static_cast<uint8_t>(y);
    edge_[pixel_count_] = edge;
    low_[pixel_count_] = 255;
    if (task_.light != nullptr) AddLight(pixel_count_, (*task_.light)(image_x, image_y));
    AddColor(pixel_count_++, (*task_.colors)(image_x, image_y));
  }
  int x(int pixel) const { return x_[pixel]; }
  int y(int pixel) const { return y_[pixel]; }
  // Another entity that looks different: surely an edge that shows.
  bool on_visible_silhouette(int pixel) const { return edge_[pixel] == (kSilhouette | kContrastEdge); }
  // Darkest to lightest of the pixel's samples so far, of 255.
  int contrast(int pixel) const { return high_[pixel] - low_[pixel]; }

  Rgb8 Mean(int pixel) const {
    const float scale = 1.0f / static_cast<float>(weight_[pixel]);
    return {EncodeSrgb(r_[pixel] * scale), EncodeSrgb(g_[pixel] * scale), EncodeSrgb(b_[pixel] * scale)};
  }

  Rgb32f MeanLight(int pixel) const {
    const float scale = 1 / light_weight_[pixel];
    return {light_r_[pixel] * scale, light_g_[pixel] * scale, light_b_[pixel] * scale};
  }

 private:
  // Weighted against what is far above the display's white.
  void AddLight(int pixel, Rgb32f c) {
    const float exposure = task_.shader->Exposure();
    const float weight = 1 / (1 + exposure * (kEdgeRed * c.r + kEdgeGreen * c.g + kEdgeBlue * c.b));
    light_r_[pixel] += weight * c.r;
    light_g_[pixel] += weight * c.g;
    light_b_[pixel] += weight * c.b;
    light_weight_[pixel] += weight;
  }

  void AddColor(int pixel, Rgb8 color) {
    r_[pixel] += SrgbToLinear(color.r);
    g_[pixel] += SrgbToLinear(color.g);
    b_[pixel] += SrgbToLinear(color.b);
    ++weight_[pixel];
    const uint8_t luma = Luma(color.r, color.g, color.b);
    low_[pixel] = std::min(low_[pixel], luma);
    high_[pixel] = std::max(high_[pixel], luma);
  }

  void Shade() override {
    RadianceBatch radiance;
    Rgb8 colors[HitBatch::kCapacity];
    int x[HitBatch::kCapacity], y[HitBatch::kCapacity];
    for (int i = 0; i < hits_.count; ++i) x[i] = image_x_[owner_[i]], y[i] = image_y_[owner_[i]];
    const Image<SunPixel>& sun = *task_.sun;
    const SunNeighbours around{sun.pixels().data(), sun.width(), sun.height(), task_.rays->field().separable, x, y};
    task_.shader->Shade(hits_, radiance, &around);
    task_.shader->ToneMap(radiance.r, radiance.g, radiance.b, hits_.count, task_.exposure_ev, colors, task_.tone);
    for (int i = 0; i < hits_.count; ++i) AddColor(owner_[i], colors[i]);
    for (int i = 0; i < hits_.count && task_.light != nullptr; ++i) AddLight(owner_[i], {radiance.r[i], radiance.g[i], radiance.b[i]});
  }

  const AntialiasTask& task_;
  uint8_t x_[kRunPixels], y_[kRunPixels];  // of the pixels in the run
  int image_x_[kRunPixels], image_y_[kRunPixels];
  uint8_t edge_[kRunPixels], low_[kRunPixels], high_[kRunPixels] = {};
  float r_[kRunPixels] = {}, g_[kRunPixels] = {}, b_[kRunPixels] = {};
  int weight_[kRunPixels] = {};
  float light_r_[kRunPixels] = {}, light_g_[kRunPixels] = {}, light_b_[kRunPixels] = {}, light_weight_[kRunPixels] = {};
};

}  // namespace

void Antialiaser::FindEdges(const Image<EntityId>& entity, const Image<uint8_t>& luma, bool wraps, Image<uint8_t>& edges) const {
  const int width = entity.width(), height = entity.height();
  ParallelFor((height + kRowsPerTask - 1) / kRowsPerTask, [&](int64_t task) {
    for (int y = static_cast<int>(task) * kRowsPerTask; y < std::min(height, static_cast<int>(task + 1) * kRowsPerTask); ++y) {
      const int up = std::max(y - 1, 0), down = std::min(y + 1, height - 1);
      const uint32_t* entity_rows[3] = {entity.row(up).data(), entity.row(y).data(), entity.row(down).data()};
      const uint8_t* luma_rows[3] = {luma.row(up).data(), luma.row(y).data(), luma.row(down).data()};
      kernels_.mark_edges(entity_rows, luma_rows, width, wraps, kContrast, edges.row(y).data());
    }
  });
}

const PixelOffset* SampleOffsets(const std::vector<PixelOffset>& offsets, uint64_t pixel_key, int samples) {
  return &offsets[(pixel_key & (kSymmetries - 1)) * static_cast<size_t>(samples - 1)];
}

void MakeSampleOffsets(const CameraRays& rays, int samples, std::vector<PixelOffset>& out) {
  // R2 low-discrepancy sequence (Roberts 2018) shifted so that sample 0 is the centre; its eight mirror
  // images and rotations keep the centre and break up patterns between pixels.
  constexpr double kPlastic = 1.32471795724474602596;
  out.clear();
  for (int symmetry = 0; symmetry < kSymmetries; ++symmetry) {
    for (int s = 1; s < samples; ++s) {
      double dx = 0.5 + s / kPlastic, dy = 0.5 + s / (kPlastic * kPlastic);
      dx -= std::floor(dx) + 0.5;
      dy -= std::floor(dy) + 0.5;
      if (symmetry & 1) dx = -dx;
      if (symmetry & 2) dy = -dy;
      if (symmetry & 4) std::swap(dx, dy);
      out.push_back(rays.MakeOffset(dx, dy));
    }
  }
}

int64_t Antialiaser::Run(const AntialiasTask& task) {
  MakeSampleOffsets(*task.rays, task.samples, offsets_);
  const RayField& field = task.rays->field();
  const int across = (field.width + kRunWidth - 1) / kRunWidth, down = (field.height + kTileSize - 1) / kTileSize;
  std::atomic<int64_t> ray_count = 0;
  const Interruption interruption;
  ParallelFor(int64_t{across} * down, [&](int64_t run) {
    if (interruption.came()) return;
    ray_count += RunTiles(task, static_cast<int>(run % across) * kRunWidth, static_cast<int>(run / across) * kTileSize);
  });
  interruption.Check();
  return ray_count;
}

int Antialiaser::RunTiles(const AntialiasTask& task, int column, int row) const {
  const RayField& field = task.rays->field();
  const auto image_column = [&](int x) {
    const int c = column + x - task.rays->column_shift();
    return c < 0 ? c + field.width : c;
  };

  // Edge pixels, block by block so that neighbours stay together.
  EdgeRun run(task, kernels_);
  for (int i = 0; i < kRunPixels; ++i) {
    const int x = (i >> 8) * kTileSize + ((i >> 4) & 3) * 4 + (i & 3), y = ((i >> 6) & 3) * 4 + ((i >> 2) & 3);
    if (column + x >= field.width || row + y >= field.height) continue;
    const uint8_t edge = (*task.edges)(image_column(x), row + y);
    if (edge == 0) continue;
    const int image_x = image_column(x);
    run.AddPixel(x, y, image_x, row + y, edge);
  }
  if (run.pixel_count() == 0) return 0;

  // Rays first … last - 1 of a pixel; everything random depends on the canonical pixel alone.
  const FlushDenormals flush_denormals;
  const auto add_rays = [&](int i, int first, int last) {
    const int x = column + run.x(i), y = row + run.y(i);
    const uint64_t key = PixelKey(x, y, field.width);
    const PixelOffset* offsets = SampleOffsets(offsets_, key, task.samples);
    for (int s = first; s < last; ++s) {
      Vec3d direction;
      if (!task.rays->Direction(x, y, offsets[s - 1], direction)) continue;
      run.AddRay(i, direction, static_cast<uint32_t>(MixBits(key + static_cast<uint64_t>(s))) | 1u);
    }
  };

  // Silhouettes that show get all their rays at once; others the rest when the first differs from the centre.
  for (int i = 0; i < run.pixel_count(); ++i) add_rays(i, 1, run.on_visible_silhouette(i) ? task.samples : 2);
  run.Finish();
  for (int i = 0; i < run.pixel_count(); ++i) {
    if (!run.on_visible_silhouette(i) && run.contrast(i) > kContrast / 2) add_rays(i, 2, task.samples);
  }
  run.Finish();
  for (int i = 0; i < run.pixel_count(); ++i) {
    const int x = image_column(run.x(i)), y = row + run.y(i);
    (*task.colors)(x, y) = run.Mean(i);
    if (task.light != nullptr) (*task.light)(x, y) = run.MeanLight(i);
  }
  return run.ray_count();
}

}  // namespace airsim360::internal
