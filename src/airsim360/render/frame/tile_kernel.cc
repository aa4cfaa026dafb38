#include "airsim360/render/frame/tile_kernel.h"

#include <cmath>
#include <cstring>

#include "airsim360/render/frame/tile_rows.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

typedef uint16_t Shorts16 __attribute__((vector_size(32)));

// 4x4 or 16x1 directions, column by column in the inner loop.
template <int kColumns>
AIRSIM360_INLINE void FillSeparable(const RayField& f, int column, int row, RayHit16& rays) {
  for (int r = 0; r < 16 / kColumns; ++r) {
    const double s = f.row_scale[row + r], x = f.row_x[row + r], y = f.row_y[row + r], z = f.row_z[row + r];
    for (int c = 0; c < kColumns; ++c) {
      rays.direction_x[r * kColumns + c] = static_cast<float>(s * f.column_x[column + c] + x);
    }
    for (int c = 0; c < kColumns; ++c) {
      rays.direction_y[r * kColumns + c] = static_cast<float>(s * f.column_y[column + c] + y);
    }
    for (int c = 0; c < kColumns; ++c) {
      rays.direction_z[r * kColumns + c] = static_cast<float>(s * f.column_z[column + c] + z);
    }
  }
}

template <int kColumns>
AIRSIM360_INLINE void FillFromTable(const RayField& f, int column, int row, RayHit16& rays, int* valid) {
  for (int r = 0; r < 16 / kColumns; ++r) {
    const int64_t first = static_cast<int64_t>(row + r) * f.stride + column;
    for (int c = 0; c < kColumns; ++c) {
      const double x = f.ray_x[first + c], y = f.ray_y[first + c], z = f.ray_z[first + c];
      rays.direction_x[r * kColumns + c] = static_cast<float>(f.R[0] * x + f.R[1] * y + f.R[2] * z);
      rays.direction_y[r * kColumns + c] = static_cast<float>(f.R[3] * x + f.R[4] * y + f.R[5] * z);
      rays.direction_z[r * kColumns + c] = static_cast<float>(f.R[6] * x + f.R[7] * y + f.R[8] * z);
      valid[r * kColumns + c] &= f.has_ray[first + c];
    }
  }
}

AIRSIM360_INLINE void Corner(int p, PacketShape shape, int& column, int& row) {
  column += shape == PacketShape::kRow ? 0 : (p & 3) * 4;
  row += shape == PacketShape::kRow ? p : (p >> 2) * 4;
}

// The slots of a packet's hits. Camera rays mostly meet one slot, which keeps look-ups out of the vector
// loops.
struct PacketSlots {
  alignas(64) int hit[16];  // -1 or 0
  bool any_hit, uniform;
  uint32_t first;                 // slot of the first hit; of all if uniform
  alignas(64) uint32_t slot[16];  // set if not uniform
};

AIRSIM360_INLINE void FindSlots(const LabelView& view, const RayHit16& rays, const int* valid, PacketSlots& out) {
  uint32_t any = 0;
  for (int i = 0; i < 16; ++i) {
    out.hit[i] = rays.geometry[i] != kMiss ? valid[i] : 0;
    any |= static_cast<uint32_t>(out.hit[i]);
  }
  out.any_hit = any != 0;
  out.uniform = true;
  out.first = 0;
  if (!out.any_hit) return;
  int lane = 0;
  while (out.hit[lane] == 0) ++lane;
  const uint32_t geometry = rays.geometry[lane], instance = rays.instance[lane];
  Words16 geometries, instances, hits;
  std::memcpy(&geometries, rays.geometry, sizeof geometries);
  std::memcpy(&instances, rays.instance, sizeof instances);
  std::memcpy(&hits, out.hit, sizeof hits);
  const Words16 other = ((geometries ^ geometry) | (instances ^ instance)) & hits;
  uint32_t differs = 0;
  for (int i = 0; i < 16; ++i) differs |= other[i];
  out.first = instance == kMiss ? view.first_slot[geometry] : view.first_slot[instance] + geometry;
  if (differs == 0) return;
  out.uniform = false;
  for (int i = 0; i < 16; ++i) {
    if (out.hit[i] == 0)
      out.slot[i] = out.first;
    else if (rays.instance[i] == kMiss)
      out.slot[i] = view.first_slot[rays.geometry[i]];
    else
      out.slot[i] = view.first_slot[rays.instance[i]] + rays.geometry[i];
  }
}

AIRSIM360_INLINE void ResolveEntities(const LabelView& view, const RayHit16& rays, const int* valid, const PacketSlots& slots,
                                      uint32_t* entity) {
  if (!slots.any_hit) {
    for (int i = 0; i < 16; ++i) entity[i] = valid[i] != 0 ? view.sky_entity : 0;
  } else if (slots.uniform) {
    const SlotLabels& labels = view.slots[slots.first];
    const uint32_t* own = view.entities + labels.entity_base;
    const uint32_t mask = labels.entity_mask, shared = labels.entity, sky = view.sky_entity;
    alignas(64) uint32_t id[16], primitive[16];
    for (int i = 0; i < 16; ++i) primitive[i] = rays.primitive[i] & mask & static_cast<uint32_t>(slots.hit[i]);
    if (mask == 0) {
      for (int i = 0; i < 16; ++i) id[i] = own[0];
    } else {
      for (int i = 0; i < 16; ++i) id[i] = own[primitive[i]];
    }
    for (int i = 0; i < 16; ++i) {
      const uint32_t mine = id[i] != 0 ? id[i] : shared, none = valid[i] != 0 ? sky : 0;
      entity[i] = slots.hit[i] != 0 ? mine : none;
    }
  } else {
    for (int i = 0; i < 16; ++i) {
      const SlotLabels& labels = view.slots[slots.slot[i]];
      const uint32_t primitive = rays.primitive[i] & labels.entity_mask & static_cast<uint32_t>(slots.hit[i]);
      const uint32_t own = view.entities[labels.entity_base + primitive];
      entity[i] = slots.hit[i] != 0 ? (own != 0 ? own : labels.entity) : valid[i] != 0 ? view.sky_entity : 0;
    }
  }
}

// Unit normals in W towards the camera.
AIRSIM360_INLINE void ResolveNormals(const LabelView& view, const RayHit16& rays, const PacketSlots& slots, float* out_x, float* out_y,
                                     float* out_z) {
  alignas(64) float nx[16], ny[16], nz[16];
  if (slots.uniform) {
    const float* m = view.slots[slots.first].normal_matrix;
    const float m0 = m[0], m1 = m[1], m2 = m[2], m3 = m[3], m4 = m[4], m5 = m[5], m6 = m[6], m7 = m[7], m8 = m[8];
    for (int i = 0; i < 16; ++i) {
      const float x = rays.normal_x[i], y = rays.normal_y[i], z = rays.normal_z[i];
      nx[i] = m0 * x + m1 * y + m2 * z;
      ny[i] = m3 * x + m4 * y + m5 * z;
      nz[i] = m6 * x + m7 * y + m8 * z;
    }
  } else {
    for (int i = 0; i < 16; ++i) {
      const float* m = view.slots[slots.slot[i]].normal_matrix;
      const float x = rays.normal_x[i], y = rays.normal_y[i], z = rays.normal_z[i];
      nx[i] = m[0] * x + m[1] * y + m[2] * z;
      ny[i] = m[3] * x + m[4] * y + m[5] * z;
      nz[i] = m[6] * x + m[7] * y + m[8] * z;
    }
  }
  for (int i = 0; i < 16; ++i) {
    const float length2 = nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i];
    const float towards = nx[i] * rays.direction_x[i] + ny[i] * rays.direction_y[i] + nz[i] * rays.direction_z[i];
    const float length = __builtin_sqrtf(length2);
    const float scale = (towards > 0 ? -1.0f : 1.0f) / (length > 0 ? length : 1.0f);
    out_x[i] = slots.hit[i] != 0 ? nx[i] * scale : 0.0f;
    out_y[i] = slots.hit[i] != 0 ? ny[i] * scale : 0.0f;
    out_z[i] = slots.hit[i] != 0 ? nz[i] * scale : 0.0f;
  }
}

}  // namespace

void InitPacket(float x, float y, float z, RayHit16& rays) {
  for (int i = 0; i < 16; ++i) {
    rays.origin_x[i] = x;
    rays.origin_y[i] = y;
    rays.origin_z[i] = z;
    rays.t_near[i] = 0;
    rays.time[i] = 0;
    rays.mask[i] = ~0u;
    rays.id[i] = 0;
    rays.flags[i] = 0;
    rays.primitive[i] = 0;
    rays.geometry[i] = kMiss;
    rays.instance[i] = kMiss;
  }
}

void FillPacket(const RayField& field, int column, int row, int p, PacketShape shape, RayHit16& rays, int* valid) {
  Corner(p, shape, column, row);
  const int columns = shape == PacketShape::kRow ? 16 : 4;
  const int shift = shape == PacketShape::kRow ? 4 : 2;
  const bool inside = column + columns <= field.width && row + 16 / columns <= field.height;
  for (int i = 0; i < 16; ++i) {
    rays.t_far[i] = __builtin_inff();
    valid[i] = inside || ((column + (i & (columns - 1)) < field.width) & (row + (i >> shift) < field.height)) ? -1 : 0;
  }
  if (field.separable) {
    if (shape == PacketShape::kRow)
      FillSeparable<16>(field, column, row, rays);
    else
      FillSeparable<4>(field, column, row, rays);
  } else {
    if (shape == PacketShape::kRow)
      FillFromTable<16>(field, column, row, rays, valid);
    else
      FillFromTable<4>(field, column, row, rays, valid);
  }
}

void ResolvePacket(const LabelView& view, const RayHit16& rays, const int* valid, int p, bool normals, LabelTile& tile) {
  PacketSlots slots;
  FindSlots(view, rays, valid, slots);
  float* range = tile.range + 16 * p;
  uint32_t* entity = tile.entity + 16 * p;
  uint32_t* category = tile.category + 16 * p;
  for (int i = 0; i < 16; ++i) range[i] = slots.hit[i] != 0 ? rays.t_far[i] : 0.0f;
  ResolveEntities(view, rays, valid, slots, entity);
  uint32_t differs = 0;
  for (int i = 1; i < 16; ++i) differs |= entity[i] ^ entity[0];
  if (differs == 0) {
    const uint32_t shared = view.category_of_entity[entity[0]];
    for (int i = 0; i < 16; ++i) category[i] = shared;
  } else {
    for (int i = 0; i < 16; ++i) category[i] = view.category_of_entity[entity[i]];
  }
  if (!normals) return;
  if (slots.any_hit) {
    ResolveNormals(view, rays, slots, tile.normal_x + 16 * p, tile.normal_y + 16 * p, tile.normal_z + 16 * p);
  } else {
    for (float* normal : {tile.normal_x, tile.normal_y, tile.normal_z}) {
      for (int i = 0; i < 16; ++i) normal[16 * p + i] = 0;
    }
  }
}

void AppendHits(const LabelView& view, const RayHit16& rays, const int* valid, int p, HitBatch& batch) {
  const int first = 16 * p;
  std::memcpy(batch.direction_x + first, rays.direction_x, 64);
  std::memcpy(batch.direction_y + first, rays.direction_y, 64);
  std::memcpy(batch.direction_z + first, rays.direction_z, 64);
  std::memcpy(batch.distance + first, rays.t_far, 64);
  std::memcpy(batch.u + first, rays.u, 64);
  std::memcpy(batch.v + first, rays.v, 64);
  PacketSlots slots;
  FindSlots(view, rays, valid, slots);
  if (slots.uniform && view.slots[slots.first].triangle_base == kMiss) {
    const uint32_t instance = view.slots[slots.first].instance;
    for (int i = 0; i < 16; ++i) {
      batch.instance[first + i] = slots.hit[i] != 0 ? instance : kMiss;
      batch.triangle[first + i] = rays.primitive[i] & static_cast<uint32_t>(slots.hit[i]);
    }
    return;
  }
  for (int i = 0; i < 16; ++i) {
    const bool hit = slots.hit[i] != 0;
    const SlotLabels& labels = view.slots[slots.uniform ? slots.first : slots.slot[i]];
    const uint32_t primitive = hit ? rays.primitive[i] : 0;
    batch.instance[first + i] = hit ? labels.instance : kMiss;
    batch.triangle[first + i] = labels.triangle_base == kMiss ? primitive : view.triangles[labels.triangle_base + primitive];
  }
}

// Lines of the images are on their way while the tile is traced.
void PrefetchTile(const TileTarget& t) {
  for (int r = 0; r < Rows(t); ++r) {
    const int64_t first = RowRuns(t, r).first;
    if (t.range != nullptr) __builtin_prefetch(t.range + first, 1), __builtin_prefetch(t.range + first + 15, 1);
    if (t.entity != nullptr) __builtin_prefetch(t.entity + first, 1), __builtin_prefetch(t.entity + first + 15, 1);
    if (t.category != nullptr) __builtin_prefetch(t.category + first, 1);
    if (t.normal != nullptr) {
      for (int i = 0; i < 16; i += 5) __builtin_prefetch(t.normal + first + i, 1);
    }
  }
}

void StoreLabels(const LabelTile& tile, const TileTarget& t) {
  for (int r = 0; r < Rows(t); ++r) {
    const Runs runs = RowRuns(t, r);
    if (t.range != nullptr) {
      Floats16 values;
      GatherRow(tile.range, t.shape, r, values);
      StoreRow(values, runs, t.range);
    }
    Words16 ids;
    if (t.entity != nullptr) {
      GatherRow(tile.entity, t.shape, r, ids);
      StoreRow(ids, runs, t.entity);
    }
    if (t.category != nullptr) {
      GatherRow(tile.category, t.shape, r, ids);
      const Shorts16 narrow = __builtin_convertvector(ids, Shorts16);
      StoreRow(narrow, runs, t.category);
    }
    if (t.normal != nullptr) StorePoints(tile.normal_x, tile.normal_y, tile.normal_z, t.shape, r, runs, t.normal);
  }
}

void StoreColors(const Rgb8* colors, const TileTarget& t, Rgb8* image, uint8_t* luma) {
  const auto* from = reinterpret_cast<const uint8_t*>(colors);
  auto* to = reinterpret_cast<uint8_t*>(image);
  for (int r = 0; r < Rows(t); ++r) {
    const Runs runs = RowRuns(t, r);
    const bool whole = runs.count == kTileSize;
    alignas(64) uint8_t gray[16];
    // Four pixels lie side by side in either shape of packet.
    for (int b = 0; b < 4; ++b) {
      const uint8_t* four = from + 3 * PacketIndex(t.shape, 4 * b, r);
      if (whole) std::memcpy(to + 3 * (runs.first + 4 * b), four, 12);
      for (int i = 0; i < 4; ++i) {
        const int x = 4 * b + i;
        const uint8_t* c = four + 3 * i;
        if (!whole && x < runs.count + runs.rest)
          std::memcpy(to + 3 * (x < runs.count ? runs.first + x : runs.second + x - runs.count), c, 3);
        if (luma != nullptr) gray[x] = Luma(c[0], c[1], c[2]);
      }
    }
    if (luma != nullptr) StoreRow(gray, runs, luma);
  }
}

void MarkEdges(const uint32_t* const* entity_rows, const uint8_t* const* luma_rows, int width, bool wraps, int contrast, uint8_t* out) {
  const uint32_t *above = entity_rows[0], *here = entity_rows[1], *below = entity_rows[2];
  const uint8_t *luma_above = luma_rows[0], *luma = luma_rows[1], *luma_below = luma_rows[2];
  const auto differs = [&](int i, int j) __attribute__((always_inline)) {
    const int d = luma[i] - luma[j];
    return (here[i] != here[j]) * kSilhouette | ((d > contrast) | (-d > contrast)) * kContrastEdge;
  };
  for (int i = 0; i < width; ++i) {
    const int up = luma[i] - luma_above[i], down = luma[i] - luma_below[i];
    const int silhouette = (here[i] != above[i]) | (here[i] != below[i]);
    const int step = (up > contrast) | (-up > contrast) | (down > contrast) | (-down > contrast);
    out[i] = static_cast<uint8_t>(silhouette * kSilhouette | step * kContrastEdge);
  }
  for (int i = 1; i < width - 1; ++i) out[i] |= differs(i, i - 1) | differs(i, i + 1);
  if (width > 1) {
    const int seam = wraps ? kSilhouette | kContrastEdge : 0;
    out[0] |= differs(0, 1) | (seam & differs(0, width - 1));
    out[width - 1] |= differs(width - 1, width - 2) | (seam & differs(width - 1, 0));
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
