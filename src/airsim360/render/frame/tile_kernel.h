// Loops over the 16 rays of a packet and the 256 of a tile, compiled per instruction set.
#pragma once

#include <cstdint>

#include "airsim360/base/kernel_isa.h"
#include "airsim360/image/image.h"
#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/label_tables.h"
#include "airsim360/render/frame/tile_size.h"
#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal {

inline constexpr int kTilePixels = kTileSize * kTileSize;
inline constexpr int kPackets = kTilePixels / 16;

/// Where the 16 rays of each packet of a tile lie: 4x4 blocks, or one row each.
enum class PacketShape { kBlock, kRow };

/// Labels of a tile in packet order: element 16 p + i is ray i of packet p.
struct alignas(64) LabelTile {
  float range[kTilePixels];
  uint32_t entity[kTilePixels];
  uint32_t category[kTilePixels];
  float normal_x[kTilePixels], normal_y[kTilePixels], normal_z[kTilePixels];
};

/// Lightness by which edges are judged, of 255: (2 R + 5 G + B) / 8.
inline __attribute__((always_inline)) uint8_t Luma(uint8_t r, uint8_t g, uint8_t b) {
  return static_cast<uint8_t>((2 * r + 5 * g + b) >> 3);
}

/// Kinds of edges, bits of the edge image.
inline constexpr int kContrastEdge = 1, kSilhouette = 2;

/// One tile of the image and where its pixels go; null = not wanted.
struct TileTarget {
  int column, row;    ///< canonical pixel of its corner
  int column_shift;   ///< canonical column c is image column (c - column_shift) mod width
  int width, height;  ///< of the image
  PacketShape shape;
  float* range;
  uint16_t* category;
  uint32_t* entity;
  Vec3f* normal;
};

/// Index in packet order of the pixel in column x, row y of a tile.
inline constexpr int PacketIndex(PacketShape shape, int x, int y) {
  return shape == PacketShape::kRow ? y * 16 + x : ((y >> 2) * 4 + (x >> 2)) * 16 + (y & 3) * 4 + (x & 3);
}

}  // namespace airsim360::internal

/// Sets origin and the constants of a packet and marks its lanes as missed.
AIRSIM360_DECLARE_KERNEL(void InitPacket(float x, float y, float z, RayHit16& rays))
/// Sets directions and t_far of packet `p` of the tile whose corner is (column, row), and which lanes are
/// pixels with a ray.
AIRSIM360_DECLARE_KERNEL(void FillPacket(const RayField& field, int column, int row, int p, PacketShape shape, RayHit16& rays, int* valid))
/// Labels of packet `p` from its hits. Lanes that are not valid get range 0, entity 0, category void.
AIRSIM360_DECLARE_KERNEL(void ResolvePacket(const LabelView& view, const RayHit16& rays, const int* valid, int p, bool normals,
                                            LabelTile& tile))
/// Appends the hits of packet `p` as elements 16 p … 16 p + 15 of a batch for the shader; lanes not valid
/// become sky.
AIRSIM360_DECLARE_KERNEL(void AppendHits(const LabelView& view, const RayHit16& rays, const int* valid, int p, HitBatch& batch))
/// Starts to load the image lines that a tile will be written to.
AIRSIM360_DECLARE_KERNEL(void PrefetchTile(const TileTarget& target))
/// Writes a tile into the images.
AIRSIM360_DECLARE_KERNEL(void StoreLabels(const LabelTile& tile, const TileTarget& target))
/// … and its colours; `luma` gets their Luma if it is not null.
AIRSIM360_DECLARE_KERNEL(void StoreColors(const Rgb8* colors, const TileTarget& target, Rgb8* image, uint8_t* luma))
/// Marks pixels of one row that differ from the one above, below, left or right: kSilhouette in entity, plus
/// kContrastEdge by more than `contrast` in luma, else 0. Rows are those of the image; a missing neighbour
/// row is the row itself. Columns wrap if `wraps`.
AIRSIM360_DECLARE_KERNEL(void MarkEdges(const uint32_t* const* entity_rows, const uint8_t* const* luma_rows, int width, bool wraps,
                                        int contrast, uint8_t* out))
