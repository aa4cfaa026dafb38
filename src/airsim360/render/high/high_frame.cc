#include "airsim360/render/high/high_frame.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <optional>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/filter/denoiser.h"
#include "airsim360/render/filter/exposure.h"
#include "airsim360/render/frame/antialias.h"
#include "airsim360/render/frame/packet_tracer.h"
#include "airsim360/render/high/high_buffers.h"
#include "airsim360/render/high/high_edges.h"
#include "airsim360/render/high/high_kernel.h"
#include "airsim360/render/high/smooth_sun_kernel.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/shading/sun_map.h"

namespace airsim360::internal {
namespace {

constexpr int kTilesPerTask = 4;
constexpr int kDefaultRays = 4, kMaxRays = 256;  // ambient rays of a pixel

template <class Pixel>
Pixel* DataOrNull(Image<Pixel>& image) {
  return image.empty() ? nullptr : image.pixels().data();
}

// Number 0 … 15 of the place (x, y) in its 4 x 4 block: any aligned 2 x 2 are four in a row.
uint32_t Morton(int x, int y) { return static_cast<uint32_t>((x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2); }

// Pixels of a tile by phase (see TileLayout) for either shape of packets.
TileLayout MakeLayout(PacketShape shape) {
  TileLayout layout{};
  for (int y = 0; y < kTileSize; ++y) {
    for (int x = 0; x < kTileSize; ++x) {
      const int slot = PacketIndex(shape, x, y);
      // Any 4 x 4 pixels whose rows start at a multiple of 4 have all sixteen; and so that filters that skip
      // pixels do not meet the same phase again and again, four rows further it is another.
      const int phase = (x + 4 * y + (y >> 2)) & 15;
      layout.slot_of[y * kTileSize + x] = static_cast<uint8_t>(slot);
      layout.pixel_of[slot] = static_cast<uint8_t>(y * kTileSize + x);
      layout.phase[slot] = static_cast<uint8_t>(phase);
      layout.members[phase][y] = static_cast<uint8_t>(slot);
    }
  }
  return layout;
}

}  // namespace

struct HighFrame::Impl {
  const RayTracer* tracer;
  const Shader* shader;
  const CameraRays* rays;
  LabelView labels;
  const RenderRequest* request;
  Frame* frame;
  Vec3f origin;
  float exposure;

  TileKernels kernels;
  decltype(&isa_sse42::StoreHigh) store = AIRSIM360_SELECT_KERNEL(StoreHigh);
  decltype(&isa_sse42::SmoothSunTile) smooth_sun = AIRSIM360_SELECT_KERNEL(SmoothSunTile);
  decltype(&isa_sse42::CombineTile) combine = AIRSIM360_SELECT_KERNEL(CombineTile);
  TileLayout layouts[2] = {MakeLayout(PacketShape::kBlock), MakeLayout(PacketShape::kRow)};
  HighBuffers buffers;
  Denoiser denoiser;
  std::optional<SunMap> sun_map;
  const Shader* sun_map_of = nullptr;
  uint64_t frames = 0;  // for the random choices of frames that are added up
  uint64_t tile_order = 0;

  SunMapView SunView() const { return sun_map ? sun_map->view() : SunMapView{}; }
  // Near the poles a 4x4 block is a sliver; a row is about as wide as it is long.
  PacketShape Shape(int row) const {
    const RayField& field = rays->field();
    const double latitude = 0.5 - (row + 0.5 * kTileSize) / field.height;
    return field.separable && std::abs(latitude) > 1.0 / 3 ? PacketShape::kRow : PacketShape::kBlock;
  }
  void TraceTiles();
  void TraceTile(int tile);
  HighPlanes Planes();
  void Denoise();
  void MixGloss();
  const TileLayout& LayoutAt(int row) const { return layouts[Shape(row) == PacketShape::kRow]; }
  // Whether some light has noise: in rooms alone there may be none.
  bool Noisy() const {
    return !shader->impl().indoor || std::ranges::any_of(buffers.light_samples.pixels(), [](uint8_t n) { return n != 0 && n != kCertain; });
  }
  void Combine(CombinedPlanes planes);
  void CombineTile(int tile, CombinedPlanes planes);
};

HighFrame::HighFrame() : impl_(std::make_unique<Impl>()) {}
HighFrame::~HighFrame() = default;
void HighFrame::ShuffleTiles(uint64_t order) { impl_->tile_order = order; }

uint64_t HighFrame::Render(const RayTracer& tracer, const Shader& shader, const CameraRays& rays, const LabelView& labels,
                           const RenderRequest& request, Image<Rgb32f>& radiance, Frame& frame) {
  Impl& impl = *impl_;
  const RayField& field = rays.field();
  impl.tracer = &tracer, impl.shader = &shader, impl.rays = &rays, impl.labels = labels;
  impl.request = &request, impl.frame = &frame;
  impl.origin = VecCast<float>(request.X_WC.p);
  impl.exposure = shader.Exposure() * static_cast<float>(std::exp2(request.exposure_ev));
  impl.buffers.Resize(field.width, field.height);
  if (shader.impl().indoor) impl.buffers.gloss.Resize(field.width, field.height);
  Prepare(tracer, shader);
  impl.frames = request.temporal ? impl.frames + 1 : 0;

  impl.TraceTiles();
  if (request.denoise && impl.Noisy()) impl.Denoise();
  if (shader.impl().indoor) impl.MixGloss();
  HighBuffers& buffers = impl.buffers;
  if (radiance.width() != field.width || radiance.height() != field.height) radiance = Image<Rgb32f>(field.width, field.height);
  const int samples = EdgeSamples(request);
  impl.Combine({buffers.light.pixels().data(), buffers.sun_seen.pixels().data(), impl.exposure, radiance.pixels().data(),
                samples > 1 ? buffers.luma.pixels().data() : nullptr});

  uint64_t count = static_cast<uint64_t>(field.width) * static_cast<uint64_t>(field.height);
  if (samples > 1) {
    // Where edges are white depends on the exposure that the picture will have: rooms by night are far brighter than the night.
    if (shader.impl().indoor && request.auto_exposure) {
      impl.exposure *= static_cast<float>(std::exp2(AutoExposureEv(radiance, request.camera, shader.Exposure(), shader.MostExposure())));
      impl.Combine({buffers.light.pixels().data(), buffers.sun_seen.pixels().data(), impl.exposure, radiance.pixels().data(),
                    buffers.luma.pixels().data()});
    }
    Antialiaser().FindEdges(buffers.entity, buffers.luma, field.separable, buffers.edges);
    const HighEdgeTask task{&tracer,
                            &shader,
                            &rays,
                            labels,
                            impl.SunView(),
                            impl.origin,
                            impl.exposure,
                            samples,
                            request.seed,
                            &radiance,
                            shader.impl().indoor != nullptr};
    std::vector<PixelOffset> offsets;
    MakeSampleOffsets(rays, samples, offsets);
    count += static_cast<uint64_t>(RefineEdges(task, offsets, buffers));
  }
  return count;
}

void HighFrame::Prepare(const RayTracer& tracer, const Shader& shader) {
  if (impl_->sun_map_of == &shader) return;
  impl_->sun_map_of = &shader;
  impl_->sun_map.reset();
  const auto& sky = shader.impl().sky;
  if (sky && sky->to_sun().z > 0 && !tracer.scene().instances.empty()) impl_->sun_map.emplace(tracer, sky->to_sun());
}

float AmbientRays(const RenderRequest& request, const RayField& field, int row) {
  const int wanted = std::clamp(request.samples > 0 ? request.samples : kDefaultRays, 1, kMaxRays);
  if (!request.latitude_sampling || !field.separable) return static_cast<float>(wanted);
  const double middle = std::min(row + 0.5 * kTileSize, field.height - 0.5);
  return static_cast<float>(std::max(1.0, wanted * std::sin(std::numbers::pi * middle / field.height)));
}

void HighFrame::Impl::TraceTiles() {
  const int tiles = buffers.across() * buffers.down(), tasks = (tiles + kTilesPerTask - 1) / kTilesPerTask;
  ParallelFor(tasks, [&](int64_t task) {
    const FlushDenormals flush;
    // Any order will do: tests choose one.
    if (tile_order != 0) task = static_cast<int64_t>((static_cast<uint64_t>(task) + tile_order) % tasks);
    const int first = static_cast<int>(task) * kTilesPerTask;
    for (int tile = first; tile < std::min(first + kTilesPerTask, tiles); ++tile) TraceTile(tile);
  });
}

void HighFrame::Impl::TraceTile(int tile) {
  const RayField& field = rays->field();
  const int column = tile % buffers.across() * kTileSize, row = tile / buffers.across() * kTileSize;
  const PacketShape shape = Shape(row);
  const TileTarget target{column,
                          row,
                          rays->column_shift(),
                          field.width,
                          field.height,
                          shape,
                          DataOrNull(frame->range),
                          DataOrNull(frame->semantic),
                          DataOrNull(frame->entity),
                          DataOrNull(frame->normal)};

  LabelTile tile_labels;
  HitBatch hits;
  RayHit16 packet;
  alignas(64) int valid[16];
  kernels.init(origin.x, origin.y, origin.z, packet);
  for (int p = 0; p < kPackets; ++p) {
    kernels.fill(field, column, row, p, shape, packet, valid);
    TracePacket(*tracer, labels.sky_entity != kNoEntity, valid, packet);
    kernels.resolve(labels, packet, valid, p, request->products.normal, tile_labels);
    kernels.append_hits(labels, packet, valid, p, hits);
  }
  kernels.store_labels(tile_labels, target);

  hits.count = kTilePixels;
  hits.origin = origin;
  hits.cone_angle = static_cast<float>(rays->cone_angle());
  std::fill(std::begin(hits.sample_key), std::end(hits.sample_key), 0u);
  const int across = column / kTileSize, down = row / kTileSize;
  const uint64_t key =
      MixBits(MixBits(request->seed + frames * 0x9e3779b97f4a7c15ull) + static_cast<uint64_t>(down / 4 * buffers.across() + across / 4));
  const TileSampling sampling{&layouts[shape == PacketShape::kRow],
                              static_cast<uint32_t>(key),
                              Morton(across, down),
                              AmbientRays(*request, field, row),
                              hits.cone_angle,
                              field.separable,
                              {static_cast<float>(field.R[1]), static_cast<float>(field.R[4]), static_cast<float>(field.R[7])}};
  HighTile shaded;
  std::optional<GlossPixels> gloss;
  if (shader->impl().indoor) gloss.emplace();
  ShadeHigh(*shader, SunView(), hits, &sampling, nullptr, buffers.terms[static_cast<size_t>(tile)], shaded, gloss ? &*gloss : nullptr);
  if (gloss) buffers.gloss.Put(*gloss, *sampling.layout, column, row);
  buffers.smooth[static_cast<size_t>(tile)] = store(tile_labels, shaded, target, Planes());
}

HighPlanes HighFrame::Impl::Planes() {
  return {buffers.range.pixels().data(),   buffers.entity.pixels().data(),        buffers.normal.pixels().data(),
          buffers.light.pixels().data(),   buffers.light_samples.pixels().data(), buffers.sun_seen.pixels().data(),
          buffers.penumbra.pixels().data()};
}

void HighFrame::Impl::Denoise() {
  // The camera of canonical columns.
  RigidTransform X_WC;
  for (int i = 0; i < 9; ++i) X_WC.R.m[i / 3][i % 3] = rays->field().R[i];
  X_WC.p = request->X_WC.p;
  const FilterGuides guides{&request->camera, X_WC, &buffers.range, &buffers.entity, &buffers.normal};
  denoiser.Run(guides, {&buffers.light, &buffers.light_samples}, request->temporal);
}

// The part of the picture that is mirrored, as wide as its lobes are.
void HighFrame::Impl::MixGloss() {
  if (request->denoise) FilterGloss(buffers.range, buffers.entity, buffers.normal, rays->field().separable, buffers.gloss);
  ParallelFor(int64_t{buffers.across()} * buffers.down(), [&](int64_t tile) {
    const int column = static_cast<int>(tile) % buffers.across() * kTileSize, row = static_cast<int>(tile) / buffers.across() * kTileSize;
    buffers.gloss.AddTo(buffers.terms[static_cast<size_t>(tile)], LayoutAt(row), column, row);
  });
}

void HighFrame::Impl::Combine(CombinedPlanes planes) {
  const int tiles = buffers.across() * buffers.down();
  ParallelFor((tiles + kTilesPerTask - 1) / kTilesPerTask, [&](int64_t task) {
    const int first = static_cast<int>(task) * kTilesPerTask;
    for (int tile = first; tile < std::min(first + kTilesPerTask, tiles); ++tile) CombineTile(tile, planes);
  });
}

void HighFrame::Impl::CombineTile(int tile, CombinedPlanes planes) {
  const RayField& field = rays->field();
  const int column = tile % buffers.across() * kTileSize, row = tile / buffers.across() * kTileSize;
  if (buffers.smooth[static_cast<size_t>(tile)] != 0) {
    float* smooth = buffers.sun_smooth.pixels().data();
    smooth_sun({buffers.range.pixels().data(), buffers.entity.pixels().data(), buffers.normal.pixels().data(),
                buffers.sun_seen.pixels().data(), buffers.penumbra.pixels().data(), smooth},
               field, static_cast<float>(rays->cone_angle()), column, row);
    planes.sun = smooth;
  }
  const TileTarget target{column, row, rays->column_shift(), field.width, field.height, Shape(row), nullptr, nullptr, nullptr, nullptr};
  combine(buffers.terms[static_cast<size_t>(tile)], target, planes);
  if (field.separable) return;
  // Pixels without a ray are black; such pictures have the columns of the image.
  for (int y = row; y < std::min(row + kTileSize, field.height); ++y) {
    for (int x = column; x < std::min(column + kTileSize, field.width); ++x) {
      if (field.has_ray[static_cast<int64_t>(y) * field.stride + x] != 0) continue;
      planes.radiance[static_cast<int64_t>(y) * field.width + x] = {};
      if (planes.luma != nullptr) buffers.luma(x, y) = 0;
    }
  }
}

}  // namespace airsim360::internal
