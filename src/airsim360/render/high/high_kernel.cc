// Kernel: tiles of tier `high` into the images that other pixels read, and together again.
#include "airsim360/render/high/high_kernel.h"

#include <cstring>

#include "airsim360/render/frame/tile_rows.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

typedef uint8_t Bytes16 __attribute__((vector_size(16)));

AIRSIM360_INLINE Bytes16 GatherBytes(const uint8_t* tile, PacketShape shape, int r) {
  Bytes16 row;
  if (shape == PacketShape::kRow) {
    std::memcpy(&row, tile + r * 16, sizeof row);
    return row;
  }
  uint32_t part[4];
  for (int b = 0; b < 4; ++b) std::memcpy(&part[b], tile + ((r >> 2) * 4 + b) * 16 + (r & 3) * 4, sizeof part[b]);
  const Words4 all = {part[0], part[1], part[2], part[3]};
  std::memcpy(&row, &all, sizeof row);
  return row;
}

// Sixteen pixels of three numbers as three rows.
AIRSIM360_INLINE void Deinterleave(const float* from, float (*to)[16]) {
  typedef float Quad __attribute__((vector_size(16)));
  Quad x[4], y[4], z[4];
  for (int b = 0; b < 4; ++b) {
    Quad A, B, C;
    std::memcpy(&A, from + 12 * b, sizeof A);
    std::memcpy(&B, from + 12 * b + 4, sizeof B);
    std::memcpy(&C, from + 12 * b + 8, sizeof C);
    x[b] = __builtin_shufflevector(__builtin_shufflevector(A, B, 0, 3, 6, 6), C, 0, 1, 2, 5);
    y[b] = __builtin_shufflevector(__builtin_shufflevector(A, B, 1, 4, 7, 7), C, 0, 1, 2, 6);
    z[b] = __builtin_shufflevector(__builtin_shufflevector(A, B, 2, 5, 5, 5), C, 0, 1, 4, 7);
  }
  Join(x, to[0]), Join(y, to[1]), Join(z, to[2]);
}

AIRSIM360_INLINE int64_t FirstPixel(const TileTarget& t, int r) { return static_cast<int64_t>(t.row + r) * t.width + t.column; }

}  // namespace

uint8_t StoreHigh(const LabelTile& labels, const HighTile& shaded, const TileTarget& t, const HighPlanes& planes) {
  for (int r = 0; r < Rows(t); ++r) {
    const Runs runs{FirstPixel(t, r), Columns(t), 0, 0};
    Floats16 numbers;
    GatherRow(labels.range, t.shape, r, numbers);
    StoreRow(numbers, runs, planes.range);
    GatherRow(shaded.sun_seen, t.shape, r, numbers);
    StoreRow(numbers, runs, planes.sun_seen);
    Words16 ids;
    GatherRow(labels.entity, t.shape, r, ids);
    StoreRow(ids, runs, planes.entity);
    StoreRow(GatherBytes(shaded.light_samples, t.shape, r), runs, planes.light_samples);
    StoreRow(GatherBytes(shaded.penumbra, t.shape, r), runs, planes.penumbra);
    StorePoints(shaded.normal_x, shaded.normal_y, shaded.normal_z, t.shape, r, runs, planes.normal);
    StorePoints(shaded.light_r, shaded.light_g, shaded.light_b, t.shape, r, runs, planes.light);
  }
  uint8_t any = 0;
  for (const uint8_t code : shaded.penumbra) any |= code;
  return any;
}

void CombineTile(const LightTerms& terms, const TileTarget& t, const CombinedPlanes& planes) {
  const int columns = Columns(t);
  for (int r = 0; r < Rows(t); ++r) {
    const int64_t first = FirstPixel(t, r);
    alignas(64) float light[3][16], sun[16], rgb[3][16];
    if (columns == kTileSize) {
      Deinterleave(&planes.light[first].r, light);
      std::memcpy(sun, planes.sun + first, sizeof sun);
    } else {
      for (int i = 0; i < 16; ++i) {
        const int64_t at = first + (i < columns ? i : 0);
        light[0][i] = planes.light[at].r, light[1][i] = planes.light[at].g, light[2][i] = planes.light[at].b;
        sun[i] = planes.sun[at];
      }
    }
    const float* planes_of[9] = {terms.ambient_r, terms.sun_r,     terms.rest_r, terms.ambient_g, terms.sun_g,
                                 terms.rest_g,    terms.ambient_b, terms.sun_b,  terms.rest_b};
    for (int c = 0; c < 3; ++c) {
      alignas(64) Floats16 k[3];
      for (int j = 0; j < 3; ++j) GatherRow(planes_of[3 * c + j], t.shape, r, k[j]);
      for (int i = 0; i < 16; ++i) rgb[c][i] = k[0][i] * light[c][i] + k[1][i] * sun[i] + k[2][i];
    }
    // The row as it is, not as packets have it.
    StorePoints(rgb[0], rgb[1], rgb[2], PacketShape::kRow, 0, RowRuns(t, r), planes.radiance);
    if (planes.luma == nullptr) continue;
    alignas(64) uint8_t luma[16];
    for (int i = 0; i < 16; ++i) {
      const float exposed = planes.exposure * (0.2126f * rgb[0][i] + 0.7152f * rgb[1][i] + 0.0722f * rgb[2][i]);
      luma[i] = static_cast<uint8_t>(255 * __builtin_sqrtf(exposed / (1 + exposed)));
    }
    StoreRow(luma, {first, columns, 0, 0}, planes.luma);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
