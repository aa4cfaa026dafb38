// Rows of a tile put together from packets and written into images (only for *_kernel.cc files).
#pragma once

#include <cstring>

#include "airsim360/render/frame/tile_kernel.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define AIRSIM360_INLINE static inline __attribute__((always_inline, unused))

typedef uint32_t Words4 __attribute__((vector_size(16)));
typedef uint32_t Words16 __attribute__((vector_size(64)));
typedef float Floats16 __attribute__((vector_size(64)));

// Four times four numbers in one row.
template <class Quad, class Sixteen>
AIRSIM360_INLINE void Join(const Quad (&part)[4], Sixteen& row) {
  const auto low = __builtin_shufflevector(part[0], part[1], 0, 1, 2, 3, 4, 5, 6, 7);
  const auto high = __builtin_shufflevector(part[2], part[3], 0, 1, 2, 3, 4, 5, 6, 7);
  const auto all = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::memcpy(&row, &all, sizeof row);
}

// The 16 numbers of tile row r, first tile column to last. They are put together in registers: a load right
// behind smaller stores to the same place would wait for these.
template <class Number, class Sixteen>
AIRSIM360_INLINE void GatherRow(const Number* tile, PacketShape shape, int r, Sixteen& row) {
  if (shape == PacketShape::kRow) {
    std::memcpy(&row, tile + r * 16, sizeof row);
    return;
  }
  Words4 part[4];
  for (int b = 0; b < 4; ++b) std::memcpy(&part[b], tile + ((r >> 2) * 4 + b) * 16 + (r & 3) * 4, sizeof part[b]);
  Join(part, row);
}

// Four points of three coordinates each, side by side at `out`.
AIRSIM360_INLINE void Interleave(const float* x, const float* y, const float* z, float* out) {
  typedef float Quad __attribute__((vector_size(16), may_alias));
  const Quad X = *reinterpret_cast<const Quad*>(x), Y = *reinterpret_cast<const Quad*>(y), Z = *reinterpret_cast<const Quad*>(z);
  const Quad first = __builtin_shufflevector(__builtin_shufflevector(X, Y, 0, 4, 1, 1), Z, 0, 1, 4, 2);
  const Quad second = __builtin_shufflevector(__builtin_shufflevector(Y, Z, 1, 5, 2, 2), X, 0, 1, 6, 2);
  const Quad third = __builtin_shufflevector(__builtin_shufflevector(Z, X, 2, 7, 3, 3), Y, 0, 1, 7, 2);
  std::memcpy(out, &first, sizeof first);
  std::memcpy(out + 4, &second, sizeof second);
  std::memcpy(out + 8, &third, sizeof third);
}

AIRSIM360_INLINE int Rows(const TileTarget& t) { return t.height - t.row < kTileSize ? t.height - t.row : kTileSize; }
AIRSIM360_INLINE int Columns(const TileTarget& t) { return t.width - t.column < kTileSize ? t.width - t.column : kTileSize; }

// Image pixels of a tile row: one run, or two where it crosses the seam.
struct Runs {
  int64_t first;   // index of the image pixel of tile column 0
  int count;       // pixels before the seam
  int64_t second;  // index of the first pixel after it
  int rest;
};

AIRSIM360_INLINE Runs RowRuns(const TileTarget& t, int r) {
  const int columns = Columns(t);
  int x = t.column - t.column_shift;
  if (x < 0) x += t.width;
  const int64_t row = static_cast<int64_t>(t.row + r) * t.width;
  const int before = t.width - x < columns ? t.width - x : columns;
  return {row + x, before, row, columns - before};
}

// `pixels`: an array or vector of 16.
template <class Row, class Pixel>
AIRSIM360_INLINE void StoreRow(const Row& pixels, const Runs& runs, Pixel* image) {
  static_assert(sizeof pixels == kTileSize * sizeof(Pixel));
  if (runs.count == kTileSize) {
    std::memcpy(image + runs.first, &pixels, sizeof pixels);
    return;
  }
  for (int i = 0; i < runs.count; ++i) image[runs.first + i] = pixels[i];
  for (int i = 0; i < runs.rest; ++i) image[runs.second + i] = pixels[runs.count + i];
}

// Three numbers side by side, whatever type of pixel they are.
struct Packed {
  float v[3];
};

// Tile row r of three planes as pixels of three numbers.
template <class Pixel>
AIRSIM360_INLINE void StorePoints(const float* x, const float* y, const float* z, PacketShape shape, int r, const Runs& runs,
                                  Pixel* image) {
  static_assert(sizeof(Pixel) == sizeof(Packed));
  auto* to = reinterpret_cast<Packed*>(image);
  alignas(64) Packed points[kTileSize];
  // Whole rows go straight to the image: wide loads right behind narrow stores would wait for these.
  const bool whole = runs.count == kTileSize;
  Packed* row = whole ? to + runs.first : points;
  for (int b = 0; b < 4; ++b) {
    const int first = shape == PacketShape::kRow ? r * 16 + b * 4 : ((r >> 2) * 4 + b) * 16 + (r & 3) * 4;
    Interleave(x + first, y + first, z + first, row[4 * b].v);
  }
  if (!whole) StoreRow(points, runs, to);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
