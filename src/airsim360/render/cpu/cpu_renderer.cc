// Tile-local wavefront on Embree: generate, trace and label 256 rays, shade them, then antialias the edges.
#include "airsim360/render/cpu/cpu_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/cpu/coverage.h"
#include "airsim360/render/cpu/surface_products.h"
#include "airsim360/render/filter/exposure.h"
#include "airsim360/render/filter/tone_map.h"
#include "airsim360/render/frame/antialias.h"
#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/daylight.h"
#include "airsim360/render/frame/interruption.h"
#include "airsim360/render/frame/label_tables.h"
#include "airsim360/render/frame/packet_tracer.h"
#include "airsim360/render/frame/tile_pixels.h"
#include "airsim360/render/high/high_frame.h"
#include "airsim360/render/reference/path_tracer.h"
#include "airsim360/render/relightable.h"
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

bool IsLit(Tier tier) { return tier == Tier::kFast || tier == Tier::kHigh; }
// Whether the shaded centre rays are the picture.
bool IsDirect(Tier tier) { return tier != Tier::kHigh && tier != Tier::kReference; }

class CpuRenderer : public Renderer, public Relightable {
 public:
  CpuRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options, bool rooms)
      : rooms_(rooms),
        tracer_(std::move(tracer)),
        dynamic_(tracer_),
        applied_(tracer_),
        environment_(options.environment.value_or(tracer_->scene().environment)),
        tables_(*tracer_),
        labels_(tables_.view()),
        products_(SceneOf(tracer_)) {
    if (options.tier != Tier::kLabels) shader_ = std::make_unique<Shader>(tracer_, environment_);
    if (rooms_ && IsLit(options.tier)) shader_->PrepareIndoors();
    if (options.tier == Tier::kHigh) high_->Prepare(*tracer_, *shader_);
  }

  RenderStats Render(const RenderRequest& request, Frame& frame) override;
  bool SetEnvironment(const Environment& environment) override;

 private:
  // The scene lives as long as its tracer.
  static std::shared_ptr<const Scene> SceneOf(const std::shared_ptr<const RayTracer>& tracer) { return {tracer, &tracer->scene()}; }
  void SetState(const std::shared_ptr<const SceneState>& state);
  void ResizeFrame(const RenderRequest& request, bool color, bool edges, Frame& frame);
  void PrepareLight(RenderRequest& request);
  uint64_t RenderProducts(const RenderRequest& request, bool color, Frame& frame);
  void FinishColor(RenderRequest& request, Frame& frame);
  uint64_t Antialias(const RenderRequest& request, Frame& frame);
  uint64_t RenderTiles(const RenderRequest& request, bool color, Frame& frame);
  void RenderTile(const RenderRequest& request, bool color, int tile, Frame& frame);
  uint64_t RenderPaths(const RenderRequest& request, Image<Rgb32f>& radiance);
  void ShadeTile(const RenderRequest& request, HitBatch& hits, const TileTarget& target, Frame& frame);
  void KeepRadiance(const RadianceBatch& radiance, const TileTarget& target, Image<Rgb32f>& image) const;
  void Develop(ToneCurve tone, const Image<Rgb32f>& radiance, Frame& frame);
  float ExposureOf(const RenderRequest& request) const { return shader_->Exposure() * static_cast<float>(std::exp2(request.exposure_ev)); }
  Image<Rgb32f>& RadianceOf(Frame& frame) {
    return !frame.radiance.empty() ? frame.radiance : !frame.light.empty() ? frame.light : radiance_;
  }
  const Image<EntityId>& EntityOf(const RenderRequest& request, const Frame& frame) const {
    return request.products.entity ? frame.entity : entity_;
  }
  // Near the poles a 4x4 block is a sliver; a row is about as wide as it is long.
  PacketShape Shape(int row) const {
    const RayField& field = rays_.field();
    const double latitude = 0.5 - (row + 0.5 * kTileSize) / field.height;
    return field.separable && std::abs(latitude) > 1.0 / 3 ? PacketShape::kRow : PacketShape::kBlock;
  }

  const bool rooms_;                         // whether they have their own light
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
  std::optional<HighFrame> high_{std::in_place};
  Image<EntityId> entity_;  // where the frame does not want it but edges need it
  Image<uint8_t> luma_, edges_;
  Image<SunPixel> sun_;     // where edges need it
  Image<Rgb32f> radiance_;  // where the frame does not want it but tier or exposure need it
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
  Resize(luma_, width, height, edges);
  Resize(edges_, width, height, edges);
  Resize(sun_, width, height, edges);
  Resize(frame.radiance, width, height, color && products.radiance);
  Resize(frame.light, width, height, color && request.light);
  const bool linear = request.auto_exposure || request.tier == Tier::kHigh || request.tier == Tier::kReference;
  Resize(radiance_, width, height, color && linear && !products.radiance && !request.light);
}

void CpuRenderer::SetState(const std::shared_ptr<const SceneState>& state) {
  std::shared_ptr<const RayTracer> tracer = dynamic_.At(state);
  if (tracer == applied_) return;
  tables_.Apply(*tracer);
  if (shader_ != nullptr) shader_->Apply(tracer);
  applied_ = std::move(tracer);
}

bool CpuRenderer::SetEnvironment(const Environment& environment) {
  const bool same_lamps = environment.lamps_on() == environment_.lamps_on();
  environment_ = environment;
  if (shader_ == nullptr) return true;
  if (same_lamps) {
    // Light is baked in the scene as built.
    shader_->Apply(tracer_);
    shader_->SetEnvironment(environment_);
  } else {
    shader_ = std::make_unique<Shader>(tracer_, environment_);
  }
  shader_->Apply(applied_);
  high_.emplace();
  return true;
}

// The shader that the picture needs, and how its exposure is chosen.
void CpuRenderer::PrepareLight(RenderRequest& request) {
  if (shader_ == nullptr) {
    shader_ = std::make_unique<Shader>(tracer_, environment_);
    shader_->Apply(applied_);
  }
  if (!rooms_) return;
  if (IsLit(request.tier)) shader_->PrepareIndoors();
  // Rooms are so much darker than the day that its exposure shows nothing of them.
  if (!request.light && request.exposure_ev == 0 && !std::holds_alternative<CubeFace>(request.camera) &&
      shader_->IsIndoors(VecCast<float>(request.X_WC.p)))
    request.auto_exposure = true;
}

// Every product but the colours of edges. Returns the number of rays.
uint64_t CpuRenderer::RenderProducts(const RenderRequest& request, bool color, Frame& frame) {
  const bool paths = color && request.tier == Tier::kReference, high = color && request.tier == Tier::kHigh;
  const bool surface = SurfaceProducts::Wanted(request.products);
  if (surface) {
    const bool moves_on = request.products.flow && request.next_state != nullptr;
    products_.Update(request, rays_, shader_.get(), applied_, moves_on ? dynamic_.At(request.next_state) : applied_);
  }
  // Tier high fills the labels alone: what else comes from the centre rays is traced as in tier labels.
  uint64_t rays = 0;
  if (high) rays += high_->Render(*applied_, *shader_, rays_, labels_, request, RadianceOf(frame), frame);
  if (!high || surface || request.products.coverage) rays += RenderTiles(request, color && !paths && !high, frame);
  if (paths) rays += RenderPaths(request, RadianceOf(frame));
  if (request.products.coverage) {
    rays += static_cast<uint64_t>(
        coverage_.Run({applied_.get(), &rays_, labels_, VecCast<float>(request.X_WC.p), EdgeSamples(request), &EntityOf(request, frame)},
                      frame.coverage));
  }
  return rays;
}

// Linear light to display colours, at the picture's own exposure if asked.
void CpuRenderer::FinishColor(RenderRequest& request, Frame& frame) {
  const Image<Rgb32f>& radiance = RadianceOf(frame);
  if (request.auto_exposure) {
    request.exposure_ev += AutoExposureEv(radiance, request.camera, shader_->Exposure(), shader_->MostExposure());
    frame.exposure = ExposureOf(request);
  }
  if (!IsDirect(request.tier) || request.auto_exposure) Develop(request.tone, radiance, frame);
  if (request.light) {
    if (request.products.radiance) frame.light = frame.radiance;
    frame.daylight = DaylightAt(*applied_, *shader_, labels_, VecCast<float>(request.X_WC.p));
  }
}

// More colour samples on edges; returns the number of rays.
uint64_t CpuRenderer::Antialias(const RenderRequest& request, Frame& frame) {
  antialiaser_.FindEdges(EntityOf(request, frame), luma_, rays_.field().separable, edges_);
  return static_cast<uint64_t>(
      antialiaser_.Run({applied_.get(), shader_.get(), &rays_, labels_, VecCast<float>(request.X_WC.p), request.exposure_ev,
                        EdgeSamples(request), &edges_, &frame.rgb, &sun_, request.tone, request.light ? &frame.light : nullptr}));
}

RenderStats CpuRenderer::Render(const RenderRequest& asked, Frame& frame) {
  RenderRequest request = asked;
  if (!IsFinite(request.X_WC)) throw InputError("camera pose is not finite");
  const Products& products = request.products;
  const bool color = (products.rgb || products.radiance || request.light) && request.tier != Tier::kLabels;
  if (color) PrepareLight(request);
  SetState(request.state);
  const auto start = std::chrono::steady_clock::now();
  rays_.Update(request.camera, request.X_WC.R);
  const bool antialias = color && (products.rgb || request.light) && IsDirect(request.tier) && EdgeSamples(request) > 1;
  ResizeFrame(request, color, antialias, frame);
  frame.exposure = color ? ExposureOf(request) : 1;

  RenderStats stats;
  stats.rays += RenderProducts(request, color, frame);
  if (color) FinishColor(request, frame);
  if (antialias) stats.rays += Antialias(request, frame);
  if (!request.products.rgb) frame.rgb = {};
  stats.render_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

// Centre rays: labels and, with `color`, colours of every pixel. Returns their number.
uint64_t CpuRenderer::RenderTiles(const RenderRequest& request, bool color, Frame& frame) {
  const RayField& field = rays_.field();
  const int across = (field.width + kTileSize - 1) / kTileSize, down = (field.height + kTileSize - 1) / kTileSize;
  const int tiles = across * down;
  const Interruption interruption;
  ParallelFor((tiles + kTilesPerTask - 1) / kTilesPerTask, [&](int64_t task) {
    const FlushDenormals flush_denormals;
    const int first = static_cast<int>(task) * kTilesPerTask;
    for (int tile = first; tile < std::min(first + kTilesPerTask, tiles) && !interruption.came(); ++tile)
      RenderTile(request, color, tile, frame);
  });
  interruption.Check();
  return static_cast<uint64_t>(field.width) * static_cast<uint64_t>(field.height);
}

// Light of tier `reference`; returns the number of paths.
uint64_t CpuRenderer::RenderPaths(const RenderRequest& request, Image<Rgb32f>& radiance) {
  const int samples = request.samples > 0 ? request.samples : PathTracerOptions::kDefaultSamples;
  PathTracerOptions options{.samples = samples, .seed = request.seed};
  constexpr int kBouncesInRooms = 32;
  if (rooms_ && shader_->HasRooms()) options.max_bounces = kBouncesInRooms;
  TracePaths(*applied_, *shader_, rays_, VecCast<float>(request.X_WC.p), options, radiance);
  const RayField& field = rays_.field();
  for (int y = 0; y < field.height && !field.separable; ++y)
    for (int x = 0; x < field.width; ++x)
      if (field.has_ray[static_cast<int64_t>(y) * field.stride + x] == 0) radiance(x, y) = {};
  return static_cast<uint64_t>(field.width) * static_cast<uint64_t>(field.height) * static_cast<uint64_t>(samples);
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

void CpuRenderer::ShadeTile(const RenderRequest& request, HitBatch& hits, const TileTarget& target, Frame& frame) {
  RadianceBatch radiance;
  Rgb8 colors[kTilePixels];
  std::fill(std::begin(hits.sample_key), std::end(hits.sample_key), 0u);
  SunPixel sun[kTilePixels];
  if (!sun_.empty()) std::fill(std::begin(sun), std::end(sun), SunPixel{});
  shader_->Shade(hits, radiance, nullptr, sun_.empty() ? nullptr : sun);
  if (!sun_.empty()) {
    // Runs of four pixels, which lie side by side except at a border or the seam.
    for (int i = 0; i < kTilePixels; i += 4) {
      const TilePixel first = PixelOfPacketIndex(target.shape, i);
      const int64_t index = ImageIndex(target, first);
      if (index >= 0 && ImageIndex(target, {first.x + 3, first.y}) == index + 3) {
        std::copy_n(sun + i, 4, sun_.pixels().data() + index);
        continue;
      }
      for (int k = 0; k < 4; ++k) {
        const int64_t pixel = ImageIndex(target, {first.x + k, first.y});
        if (pixel >= 0) sun_.pixels()[static_cast<size_t>(pixel)] = sun[i + k];
      }
    }
  }
  shader_->ToneMap(radiance.r, radiance.g, radiance.b, kTilePixels, request.exposure_ev, colors, request.tone);
  if (Image<Rgb32f>& kept = RadianceOf(frame); !kept.empty()) KeepRadiance(radiance, target, kept);
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
  kernels_.store_colors(colors, target, frame.rgb.pixels().data(), DataOrNull(luma_));
}

void CpuRenderer::KeepRadiance(const RadianceBatch& radiance, const TileTarget& target, Image<Rgb32f>& image) const {
  const RayField& field = rays_.field();
  for (int y = 0; y < std::min(kTileSize, field.height - target.row); ++y) {
    for (int x = 0; x < std::min(kTileSize, field.width - target.column); ++x) {
      const int c = target.column + x, row = target.row + y;
      const bool seen = field.separable || field.has_ray[static_cast<int64_t>(row) * field.stride + c] != 0;
      const int i = PacketIndex(target.shape, x, y);
      image((c - target.column_shift + field.width) % field.width, row) =
          seen ? Rgb32f{radiance.r[i], radiance.g[i], radiance.b[i]} : Rgb32f{};
    }
  }
}

// Display colours of all pixels from their radiance.
void CpuRenderer::Develop(ToneCurve tone, const Image<Rgb32f>& radiance, Frame& frame) {
  ToneMapImage(radiance, frame.exposure, tone, frame.rgb);
  if (luma_.empty()) return;
  std::transform(frame.rgb.pixels().begin(), frame.rgb.pixels().end(), luma_.pixels().begin(), [](Rgb8 c) { return Luma(c.r, c.g, c.b); });
}

}  // namespace

std::unique_ptr<Renderer> MakeCpuRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options) {
  return std::make_unique<CpuRenderer>(std::move(tracer), options, true);
}

std::unique_ptr<Renderer> MakeCpuRendererWithoutRooms(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options) {
  return std::make_unique<CpuRenderer>(std::move(tracer), options, false);
}

}  // namespace airsim360
