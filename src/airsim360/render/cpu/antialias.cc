#include "airsim360/render/cpu/antialias.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"

namespace airsim360::internal {
namespace {

constexpr int kContrast = 15;  // of 255: about what the eye sees as a step
constexpr int kSymmetries = 8;
constexpr int kRowsPerTask = 16;
constexpr int kTableSize = 8192;

// 8-bit sRGB of linear light in [0, 1], to within one code.
uint8_t EncodeSrgb(float linear) {
  static const std::array<uint8_t, kTableSize> table = [] {
    std::array<uint8_t, kTableSize> t{};
    for (int i = 0; i < kTableSize; ++i) t[i] = LinearToSrgb8((static_cast<float>(i)) / (kTableSize - 1));
    return t;
  }();
  return table[static_cast<int>(linear * (kTableSize - 1) + 0.5f)];
}

// The rays of one tile's edge pixels on their way through tracing and shading.
struct EdgeBatch {
  int pixel_count = 0;
  uint8_t x[kTilePixels], y[kTilePixels];  // tile pixels
  float r[kTilePixels] = {}, g[kTilePixels] = {}, b[kTilePixels] = {};
  int weight[kTilePixels] = {};

  HitBatch hits;
  int owner[kTilePixels];  // index of the pixel of each ray

  void Add(int pixel, Rgb8 color) {
    r[pixel] += SrgbToLinear(color.r);
    g[pixel] += SrgbToLinear(color.g);
    b[pixel] += SrgbToLinear(color.b);
    ++weight[pixel];
  }
};

}  // namespace

int64_t Antialiaser::FindEdges(const Image<EntityId>& entity, const Image<uint8_t>& luma, bool wraps,
                               Image<uint8_t>& edges) const {
  const int width = entity.width(), height = entity.height();
  std::atomic<int64_t> total = 0;
  ParallelFor((height + kRowsPerTask - 1) / kRowsPerTask, [&](int64_t task) {
    int64_t count = 0;
    for (int y = static_cast<int>(task) * kRowsPerTask;
         y < std::min(height, static_cast<int>(task + 1) * kRowsPerTask); ++y) {
      const int up = std::max(y - 1, 0), down = std::min(y + 1, height - 1);
      const uint32_t* entity_rows[3] = {entity.row(up).data(), entity.row(y).data(), entity.row(down).data()};
      const uint8_t* luma_rows[3] = {luma.row(up).data(), luma.row(y).data(), luma.row(down).data()};
      uint8_t* out = edges.row(y).data();
      kernels_.mark_edges(entity_rows, luma_rows, width, wraps, kContrast, out);
      for (int x = 0; x < width; ++x) count += out[x];
    }
    total += count;
  });
  return total;
}

void Antialiaser::MakeOffsets(const CameraRays& rays, int samples) {
  // R2 low-discrepancy sequence (Roberts 2018) shifted so that sample 0 is the centre; its eight mirror
  // images and rotations keep the centre and break up patterns between pixels.
  constexpr double kPlastic = 1.32471795724474602596;
  offsets_.clear();
  for (int symmetry = 0; symmetry < kSymmetries; ++symmetry) {
    for (int s = 1; s < samples; ++s) {
      double dx = 0.5 + s / kPlastic, dy = 0.5 + s / (kPlastic * kPlastic);
      dx -= std::floor(dx) + 0.5;
      dy -= std::floor(dy) + 0.5;
      if (symmetry & 1) dx = -dx;
      if (symmetry & 2) dy = -dy;
      if (symmetry & 4) std::swap(dx, dy);
      offsets_.push_back(rays.MakeOffset(dx, dy));
    }
  }
}

void Antialiaser::Run(const AntialiasTask& task) {
  MakeOffsets(*task.rays, task.samples);
  const RayField& field = task.rays->field();
  const int across = (field.width + kTileSize - 1) / kTileSize,
            down = (field.height + kTileSize - 1) / kTileSize;
  ParallelFor(int64_t{across} * down, [&](int64_t tile) {
    RunTile(task, static_cast<int>(tile % across) * kTileSize, static_cast<int>(tile / across) * kTileSize);
  });
}

void Antialiaser::RunTile(const AntialiasTask& task, int column, int row) const {
  const RayField& field = task.rays->field();
  const auto image_column = [&](int x) {
    const int c = column + x - task.rays->column_shift();
    return c < 0 ? c + field.width : c;
  };

  // Edge pixels, block by block so that neighbours stay together.
  EdgeBatch batch;
  for (int i = 0; i < kTilePixels; ++i) {
    const int x = ((i >> 4) & 3) * 4 + (i & 3), y = (i >> 6) * 4 + ((i >> 2) & 3);
    if (column + x >= field.width || row + y >= field.height || !(*task.edges)(image_column(x), row + y))
      continue;
    batch.x[batch.pixel_count] = static_cast<uint8_t>(x);
    batch.y[batch.pixel_count] = static_cast<uint8_t>(y);
    batch.Add(batch.pixel_count++, (*task.colors)(image_column(x), row + y));
  }
  if (batch.pixel_count == 0) return;

  const FlushDenormals flush_denormals;
  RayHit16 packet;
  alignas(64) int valid[16];
  int lanes = 0;
  HitBatch& hits = batch.hits;
  hits.origin = task.origin;
  hits.cone_angle = static_cast<float>(task.rays->cone_angle() / std::sqrt(task.samples));
  kernels_.init(task.origin.x, task.origin.y, task.origin.z, packet);

  const auto shade = [&] {
    RadianceBatch radiance;
    Rgb8 colors[kTilePixels];
    task.shader->Shade(hits, radiance);
    task.shader->ToneMap(radiance.r, radiance.g, radiance.b, hits.count, task.exposure_ev, colors);
    for (int i = 0; i < hits.count; ++i) batch.Add(batch.owner[i], colors[i]);
    hits.count = 0;
  };
  const auto trace = [&] {
    for (int i = 0; i < 16; ++i) {
      valid[i] = i < lanes ? -1 : 0;
      packet.t_far[i] = std::numeric_limits<float>::infinity();
      if (i < lanes) continue;
      packet.direction_x[i] = packet.direction_x[0];
      packet.direction_y[i] = packet.direction_y[0];
      packet.direction_z[i] = packet.direction_z[0];
    }
    TracePacket(*task.tracer, task.labels.sky_entity != kNoEntity, valid, packet);
    kernels_.append_hits(task.labels, packet, valid, hits.count / 16, hits);
    hits.count += lanes;
    lanes = 0;
    if (hits.count > HitBatch::kCapacity - 16) shade();
  };

  // Sixteen rays at a time, sixteen packets at a time.
  for (int i = 0; i < batch.pixel_count; ++i) {
    const int x = column + batch.x[i], y = row + batch.y[i];
    const uint64_t key =
        MixBits(static_cast<uint64_t>(y) * static_cast<uint64_t>(field.width) + static_cast<uint64_t>(x));
    const PixelOffset* offsets = &offsets_[(key & (kSymmetries - 1)) * static_cast<size_t>(task.samples - 1)];
    for (int s = 1; s < task.samples; ++s) {
      Vec3d direction;
      if (!task.rays->Direction(x, y, offsets[s - 1], direction)) continue;
      packet.direction_x[lanes] = static_cast<float>(direction.x);
      packet.direction_y[lanes] = static_cast<float>(direction.y);
      packet.direction_z[lanes] = static_cast<float>(direction.z);
      hits.sample_key[hits.count + lanes] =
          static_cast<uint32_t>(MixBits(key + static_cast<uint64_t>(s))) | 1u;
      batch.owner[hits.count + lanes] = i;
      if (++lanes == 16) trace();
    }
  }
  if (lanes > 0) trace();
  if (hits.count > 0) shade();

  for (int i = 0; i < batch.pixel_count; ++i) {
    const float scale = 1.0f / static_cast<float>(batch.weight[i]);
    (*task.colors)(image_column(batch.x[i]), row + batch.y[i]) = {
        EncodeSrgb(batch.r[i] * scale), EncodeSrgb(batch.g[i] * scale), EncodeSrgb(batch.b[i] * scale)};
  }
}

}  // namespace airsim360::internal
