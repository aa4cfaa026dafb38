// Tile-local wavefront on Embree: generate, trace and label 256 rays, shade them, then antialias the edges.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/cpu/antialias.h"
#include "airsim360/render/cpu/camera_rays.h"
#include "airsim360/render/cpu/coverage.h"
#include "airsim360/render/cpu/high_frame.h"
#include "airsim360/render/cpu/label_tables.h"
#include "airsim360/render/cpu/packet_tracer.h"
#include "airsim360/render/cpu/surface_products.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr int kTilesPerTask = 4;

template <class Pixel>
void Resize(Image<Pixel>& image, int width, int height, bool wanted) {
  if (!wanted) {
    image = {};
  } else if (image.width() != width || image.height() != height) {
    image = Image<Pixel>(width, height);
  }
}

template <class Pixel>
Pixel* DataOrNull(Image<Pixel>& image) {
  return image.empty() ? nullptr : image.pixels().data();
}

bool IsFinite(const RigidTransform& X) {
  double sum = X.p.x + X.p.y + X.p.z;
  for (int i = 0; i < 9; ++i) sum += X.R.m[i / 3][i % 3];
  return std::isfinite(sum);
}

class CpuRenderer : public Renderer {
 public:
  CpuRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options)
      : tracer_(std::move(tracer)),
        dynamic_(tracer_),
        applied_(tracer_),
        environment_(options.environment.value_or(tracer_->scene().environment)),
        tables_(*tracer_),
        labels_(tables_.view()),
        products_(SceneOf(tracer_)) {
    if (options.tier != Tier::kLabels) shader_ = std::make_unique<Shader>(tracer_, environment_);
  }

  RenderStats Render(const RenderRequest& request, Frame& frame) override;

 private:
  // The scene lives as long as its tracer.
  static std::shared_ptr<const Scene> SceneOf(const std::shared_ptr<const RayTracer>& tracer) {
    return {tracer, &tracer->scene()};
  }
  void SetState(const std::shared_ptr<const SceneState>& state);
  void ResizeFrame(const RenderRequest& request, bool color, bool edges, Frame& frame);
  uint64_t RenderTiles(const RenderRequest& request, bool color, Frame& frame);
  void RenderTile(const RenderRequest& request, bool color, int tile, Frame& frame);
  void Display(const RenderRequest& request, Frame& frame) const;
  void ShadeTile(const RenderRequest& request, HitBatch& hits, const TileTarget& target, Frame& frame);
  // Near the poles a 4x4 block is a sliver; a row is about as wide as it is long.
  PacketShape Shape(int row) const {
    const RayField& field = rays_.field();
    const double latitude = 0.5 - (row + 0.5 * kTileSize) / field.height;
    return field.separable && std::abs(latitude) > 1.0 / 3 ? PacketShape::kRow : PacketShape::kBlock;
  }

  std::shared_ptr<const RayTracer> tracer_;  // of the scene as built
  DynamicTracer dynamic_;
  std::shared_ptr<const RayTracer> applied_;  // of the instant that all tables show
  Environment environment_;
  LabelTables tables_;
  LabelView labels_;
  TileKernels kernels_;
  CameraRays rays_;
  std::unique_ptr<Shader> shader_;  // made when first needed
  Antialiaser antialiaser_;
  CoveragePass coverage_;
  SurfaceProducts products_;
  HighFrame high_;
  Image<Rgb32f> radiance_;  // of tier high
  Image<EntityId> entity_;  // where the frame does not want it but edges need it
  Image<uint8_t> luma_, edges_;
};

void CpuRenderer::ResizeFrame(const RenderRequest& request, bool color, bool edges, Frame& frame) {
  const int width = rays_.field().width, height = rays_.field().height;
  const Products& products = request.products;
  Resize(frame.rgb, width, height, color);
  Resize(frame.range, width, height, products.range);
  Resize(frame.semantic, width, height, products.semantic);
  Resize(frame.entity, width, height, products.entity);
  Resize(frame.normal, width, height, products.normal);
  Resize(frame.position, width, height, products.position);
  Resize(frame.albedo, width, height, products.albedo);
  Resize(frame.material, width, height, products.material);
  Resize(frame.flow, width, height, products.flow);
  Resize(frame.coverage, width, height, products.coverage);
  Resize(entity_, width, height, (edges || products.coverage) && !products.entity);
  Resize(luma_, width, height, color);
  Resize(edges_, width, height, edges);
}

void CpuRenderer::SetState(const std::shared_ptr<const SceneState>& state) {
  std::shared_ptr<const RayTracer> tracer = dynamic_.At(state);
  if (tracer == applied_) return;
  tables_.Apply(*tracer);
  if (shader_ != nullptr) shader_->Apply(tracer);
  applied_ = std::move(tracer);
}

RenderStats CpuRenderer::Render(const RenderRequest& request, Frame& frame) {
  if (request.tier == Tier::kReference) {
    throw InputError(std::string("tier '") + kTierNames[static_cast<int>(request.tier)] +
                     "' is not in the CPU renderer (choices: labels, fast, high)");
  }
  if (!IsFinite(request.X_WC)) throw InputError("camera pose is not finite");
  const bool color = request.products.rgb && request.tier != Tier::kLabels;
  if (color && shader_ == nullptr) {
    shader_ = std::make_unique<Shader>(tracer_, environment_);
    shader_->Apply(applied_);
  }
  SetState(request.state);
  const auto start = std::chrono::steady_clock::now();
  rays_.Update(request.camera, request.X_WC.R);
  if (SurfaceProducts::Wanted(request.products)) {
    const bool moves_on = request.products.flow && request.next_state != nullptr;
    products_.Update(request, rays_, shader_.get(), applied_,
                     moves_on ? dynamic_.At(request.next_state) : applied_);
  }
  const int samples = std::clamp(request.aa_samples, 1, kMaxSamples);
  const bool high = color && request.tier == Tier::kHigh;
  ResizeFrame(request, color, color && samples > 1 && !high, frame);
  RenderStats stats;
  if (high) {
    stats.rays += high_.Render(*applied_, *shader_, rays_, labels_, request, radiance_, frame);
    Display(request, frame);
    if (request.products.radiance) frame.radiance = radiance_;
  }
  // Tier high fills the labels alone: what else comes from the centre rays is traced as in tier labels.
  const bool more = SurfaceProducts::Wanted(request.products) || request.products.coverage;
  if (!high || more) stats.rays += RenderTiles(request, color && !high, frame);
  if (request.products.coverage) {
    const Image<EntityId>& entity = request.products.entity ? frame.entity : entity_;
    stats.rays += static_cast<uint64_t>(coverage_.Run(
        {applied_.get(), &rays_, labels_, VecCast<float>(request.X_WC.p), samples, &entity}, frame.coverage));
  }

  // More colour samples on edges.
  if (color && !high && samples > 1) {
    const Image<EntityId>& entity = request.products.entity ? frame.entity : entity_;
    antialiaser_.FindEdges(entity, luma_, rays_.field().separable, edges_);
    const int64_t rays =
        antialiaser_.Run({applied_.get(), shader_.get(), &rays_, labels_, VecCast<float>(request.X_WC.p),
                          request.exposure_ev, samples, &edges_, &frame.rgb});
    stats.rays += static_cast<uint64_t>(rays);
  }
  stats.render_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

// Centre rays: labels and, with `color`, colours of every pixel. Returns their number.
uint64_t CpuRenderer::RenderTiles(const RenderRequest& request, bool color, Frame& frame) {
  const RayField& field = rays_.field();
  const int across = (field.width + kTileSize - 1) / kTileSize,
            down = (field.height + kTileSize - 1) / kTileSize;
  const int tiles = across * down;
  ParallelFor((tiles + kTilesPerTask - 1) / kTilesPerTask, [&](int64_t task) {
    const FlushDenormals flush_denormals;
    const int first = static_cast<int>(task) * kTilesPerTask;
    for (int tile = first; tile < std::min(first + kTilesPerTask, tiles); ++tile)
      RenderTile(request, color, tile, frame);
  });
  return static_cast<uint64_t>(field.width) * static_cast<uint64_t>(field.height);
}

void CpuRenderer::RenderTile(const RenderRequest& request, bool color, int tile, Frame& frame) {
  const RayField& field = rays_.field();
  const int across = (field.width + kTileSize - 1) / kTileSize;
  const int column = tile % across * kTileSize, row = tile / across * kTileSize;
  const PacketShape shape = Shape(row);
  const Vec3f origin = VecCast<float>(request.X_WC.p);
  const bool normals = request.products.normal, products = SurfaceProducts::Wanted(request.products);

  const TileTarget target{column,
                          row,
                          rays_.column_shift(),
                          field.width,
                          field.height,
                          shape,
                          DataOrNull(frame.range),
                          DataOrNull(frame.semantic),
                          DataOrNull(entity_.empty() ? frame.entity : entity_),
                          DataOrNull(frame.normal)};
  kernels_.prefetch(target);

  // Generate, trace and label packet by packet, while each is in the first-level cache.
  LabelTile labels;
  HitBatch hits;
  RayHit16 packet;
  alignas(64) int valid[16];
  kernels_.init(origin.x, origin.y, origin.z, packet);
  for (int p = 0; p < kPackets; ++p) {
    kernels_.fill(field, column, row, p, shape, packet, valid);
    TracePacket(*applied_, labels_.sky_entity != kNoEntity, valid, packet);
    kernels_.resolve(labels_, packet, valid, p, normals, labels);
    if (color || products) kernels_.append_hits(labels_, packet, valid, p, hits);
  }

  kernels_.store_labels(labels, target);
  hits.count = kTilePixels;
  hits.origin = origin;
  hits.cone_angle = static_cast<float>(rays_.cone_angle());
  if (products) products_.Fill(hits, labels, target, frame);
  if (color) ShadeTile(request, hits, target, frame);
}

void CpuRenderer::ShadeTile(const RenderRequest& request, HitBatch& hits, const TileTarget& target,
                            Frame& frame) {
  RadianceBatch radiance;
  Rgb8 colors[kTilePixels];
  std::fill(std::begin(hits.sample_key), std::end(hits.sample_key), 0u);
  shader_->Shade(hits, radiance);
  shader_->ToneMap(radiance.r, radiance.g, radiance.b, kTilePixels, request.exposure_ev, colors);
  if (!rays_.field().separable) {
    // Pixels without a ray are black.
    const RayField& field = rays_.field();
    for (int y = 0; y < kTileSize; ++y) {
      for (int x = 0; x < kTileSize; ++x) {
        if (field.has_ray[static_cast<int64_t>(target.row + y) * field.stride + target.column + x] == 0) {
          colors[PacketIndex(target.shape, x, y)] = {};
        }
      }
    }
  }
  kernels_.store_colors(colors, target, frame.rgb.pixels().data(), luma_.pixels().data());
}

// From linear radiance to what a screen shows.
void CpuRenderer::Display(const RenderRequest& request, Frame& frame) const {
  ParallelFor(radiance_.height(), [&](int64_t y) {
    alignas(64) float channels[3][kTilePixels];
    const auto row = radiance_.row(static_cast<int>(y));
    const auto out = frame.rgb.row(static_cast<int>(y));
    for (size_t first = 0; first < row.size(); first += kTilePixels) {
      const size_t count = std::min<size_t>(kTilePixels, row.size() - first);
      for (size_t i = 0; i < count; ++i) {
        const Rgb32f c = row[first + i];
        channels[0][i] = c.r, channels[1][i] = c.g, channels[2][i] = c.b;
      }
      shader_->ToneMap(channels[0], channels[1], channels[2], static_cast<int>(count), request.exposure_ev,
                       &out[first]);
    }
  });
}

}  // namespace

std::unique_ptr<Renderer> MakeCpuRenderer(std::shared_ptr<const RayTracer> tracer,
                                          const RendererOptions& options) {
  return std::make_unique<CpuRenderer>(std::move(tracer), options);
}

}  // namespace airsim360
