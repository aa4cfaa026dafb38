// Reads the records under one vector of rays into lanes (only for *_kernel.cc files).
#pragma once

#include <cstddef>

#include "airsim360/render/shared/lane_gather.h"
#include "airsim360/render/shared/shading_texture.h"

namespace airsim360::internal::AIRSIM360_ISA {

using BitLanes = uint32_t[kLanes];

/// Records of the triangles under one vector of rays, turned into lanes. The first rows are the words of
/// TriangleRecord, InstanceRecord and MaterialRecord in their order.
struct alignas(64) Fetched {
  int32_t normal[3][kLanes], geometric[kLanes], tangent[kLanes];
  Lanes uv[6], texels_log2;  ///< the last with the instance's scale
  BitLanes material, pane_bits;
  Lanes area;
  BitLanes window;

  Lanes matrix[9], tint[3], scale_log2;
  BitLanes first_triangle, instance_hash, first_color;

  Lanes base[3], metallic, roughness, emission[3], transmission, macro, normal_scale, kind;
  int32_t base_id[kLanes], roughness_id[kLanes], normal_id[kLanes], emission_id[kLanes];
  Lanes clear_coat, clear_coat_roughness, mean[3], tile, blend, columns, rows, ground;
  Lanes room_material, beam;

  Lanes mirrored, pane, color[3];
  Lanes facet[3];  ///< the triangle's own normal in W
  /// Set only where any_window.
  Lanes corner_a[3], corner_b[3], half_a, half_b, u_per_a, v_per_b, room, interior;
  int32_t right[kLanes], up[kLanes];
  /// Set only where any_colored: the words of TriangleColors.
  int32_t corner_words[8][kLanes];
  bool any_smooth;  ///< some corner's normal is not the triangle's own
  bool any_normal, any_roughness, any_emission, any_macro, any_glass, any_water, any_base, any_blend, any_unit, any_ground, any_window,
      any_leaf, any_colored, any_beam;
  bool any_picture;  ///< something that needs texture coordinates
  /// All lanes lie on one triangle, this one.
  bool one = false;
  uint32_t one_instance, one_triangle;
  /// What all lanes share of the rows above; nullptr: they differ.
  const InstanceRecord* instance = nullptr;
  const MaterialRecord* of_material = nullptr;
};
constexpr size_t kWord = sizeof(float), kRow = kWord * kLanes;
static_assert(sizeof(TriangleRecord) == 16 * kWord && offsetof(TriangleRecord, window) == 15 * kWord &&
              offsetof(Fetched, window) == 15 * kRow && offsetof(Fetched, texels_log2) == 11 * kRow &&
              offsetof(TriangleRecord, texels_log2) == 11 * kWord);
static_assert(offsetof(InstanceRecord, first_color) == 15 * kWord && sizeof(TriangleColors) == 8 * kWord &&
              offsetof(Fetched, matrix) == 16 * kRow && offsetof(Fetched, first_color) == 31 * kRow &&
              offsetof(Fetched, base) == 32 * kRow);
static_assert(offsetof(MaterialRecord, interior) == 26 * kWord && offsetof(Fetched, room_material) == (32 + 26) * kRow &&
              offsetof(MaterialRecord, base_texture) == 12 * kWord && offsetof(Fetched, base_id) == (32 + 12) * kRow &&
              offsetof(MaterialRecord, beam) == 27 * kWord && offsetof(Fetched, beam) == (32 + 27) * kRow &&
              offsetof(MaterialRecord, tile) == 21 * kWord && offsetof(Fetched, tile) == (32 + 21) * kRow);

/// Brings the records of the next vector into the cache while this one is worked on.
KERNEL void Prefetch(const ShadeView& view, const RaySet& rays, int begin) {
  if (begin >= rays.count) return;
  for (int i = 0; i < kLanes; ++i) {
    __builtin_prefetch(&view.triangles[view.instances[rays.instance[begin + i]].first_triangle + rays.triangle[begin + i]]);
  }
}

KERNEL float HashLane(uint32_t bits) { return static_cast<float>((bits * 0x9e3779b1u) >> 8) * 0x1p-24f; }

/// The panes in front of rooms, where there are some.
static __attribute__((noinline)) void FetchPanes(const ShadeView& view, Fetched& f) {
  static constexpr PaneRecord kNone{{0, 0, 0}, {0, 0, 0}, 1, 1, 0, 0, 0, 0, 0};
  for (int i = 0; i < kLanes; ++i) {
    const uint32_t window = f.window[i];
    const PaneRecord& pane = window != 0 ? view.panes[window - 1] : kNone;
    for (int k = 0; k < 3; ++k) f.corner_a[k][i] = pane.a[k], f.corner_b[k][i] = pane.b[k];
    f.half_a[i] = pane.half_a;
    f.half_b[i] = pane.half_b;
    f.u_per_a[i] = pane.u_per_a;
    f.v_per_b[i] = pane.v_per_b;
    f.right[i] = static_cast<int32_t>(pane.right);
    f.up[i] = static_cast<int32_t>(pane.up);
    f.room[i] = HashLane((pane.hash ^ f.instance_hash[i]) * 0x85ebca6bu + 77u);
    f.interior[i] = window != 0 ? 1.0f : 0.0f;
  }
}

/// The record that all lanes have, or nullptr.
template <class Record>
KERNEL const Record* Shared(const Record* const* records) {
  uintptr_t differs = 0;
  for (int i = 1; i < kLanes; ++i) differs |= reinterpret_cast<uintptr_t>(records[i]) ^ reinterpret_cast<uintptr_t>(records[0]);
  return differs == 0 ? records[0] : nullptr;
}

KERNEL real3 UnpackDirection(const int32_t* packed) {
  const ireal p(packed, stdx::vector_aligned);
  return octahedral_decode(to_real(p & 0xffff) * kDirectionStep - 1.0f, to_real((p >> 16) & 0xffff) * kDirectionStep - 1.0f);
}

KERNEL real3 ToWorld(const Fetched& f, real3 a) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return load(f.matrix[k]) * a.x + load(f.matrix[k + 1]) * a.y + load(f.matrix[k + 2]) * a.z;
  };
  return normalize3(make3(row(0), row(3), row(6)));
}

/// Whether the normals of the corners are others than the facet's. Flat triangles have the facet's normal to the bit,
/// whatever lies in the lanes beside them.
KERNEL mask_t IsSmooth(const Fetched& f) {
  const auto differs = [&](int corner) __attribute__((always_inline)) {
    return ireal(f.normal[corner], stdx::vector_aligned) != ireal(f.geometric, stdx::vector_aligned);
  };
  return stdx::__proposed::static_simd_cast<mask_t>(differs(0) || differs(1) || differs(2));
}
KERNEL bool AnyBit(const int32_t* lanes) { return stdx::any_of(ireal(lanes, stdx::vector_aligned) != 0); }
KERNEL bool AnyIs(const float* lanes, float value) { return stdx::any_of(load(lanes) == value); }

/// Four rows of lanes for every sixteen bytes of the records. One record under all lanes (`shared`), as on
/// walls and grounds, is spread instead of turned round.
template <class Record>
KERNEL void TakeRecords(const Record* const* records, const Record* shared, int quads, void* rows) {
  auto* to = static_cast<char*>(rows);
  if (shared != nullptr) {
    const auto* first = reinterpret_cast<const float*>(shared);
    for (int k = 0; k < 4 * quads; ++k) SpreadWord(first + k, to + static_cast<size_t>(k) * kRow);
    return;
  }
  for (int q = 0; q < quads; ++q) {
    GatherRows(
        [&](int i) __attribute__((always_inline)) { return reinterpret_cast<const float*>(records[i]) + 4 * q; },
        to + 4 * static_cast<size_t>(q) * kRow);
  }
}

/// Vertex colours of vectors some lane of which lies in a mesh that has them.
static __attribute__((noinline)) void FetchColors(const ShadeView& view, const RaySet& rays, int begin, Fetched& f) {
  const TriangleColors* colors[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const uint32_t first = f.first_color[i];
    colors[i] = &view.colors[first == 0 ? 0 : first + rays.triangle[begin + i]];
  }
  TakeRecords(colors, f.one ? colors[0] : nullptr, 2, f.corner_words);
}

KERNEL real3 CornerColor(const Fetched& f, int corner) {
  const ireal rg(f.corner_words[2 * corner], stdx::vector_aligned), ba(f.corner_words[2 * corner + 1], stdx::vector_aligned);
  return make3(to_real(rg & 0xffff), to_real((rg >> 16) & 0xffff), to_real(ba & 0xffff)) * real(kColorStep);
}

/// What vertex colours do to the base colour at barycentrics (u, v).
static __attribute__((noinline)) real3 VertexColors(const Fetched& f, real u, real v) {
  return corner_color(CornerColor(f, 0), CornerColor(f, 1), CornerColor(f, 2), u, v);
}

/// The rows of a material and what follows from them alone.
KERNEL void TakeMaterials(const MaterialRecord* const* material, const MaterialRecord* shared, Fetched& f) {
  TakeRecords(material, shared, 7, f.base);
  f.any_base = AnyBit(f.base_id);
  f.any_normal = AnyBit(f.normal_id);
  f.any_roughness = AnyBit(f.roughness_id);
  f.any_emission = AnyBit(f.emission_id);
  f.any_macro = stdx::any_of(load(f.macro) != 0.0f);
  f.any_glass = AnyIs(f.kind, kGlass);
  f.any_water = AnyIs(f.kind, kWater);
  f.any_leaf = AnyIs(f.kind, kFoliage);
  f.any_blend = stdx::any_of(load(f.blend) != 0.0f);
  f.any_unit = stdx::any_of(load(f.columns) != 0.0f);
  f.any_ground = stdx::any_of((load(f.ground) != 0.0f) && (load(f.kind) != kFoliage));  // blades wear nothing
  f.any_beam = stdx::any_of(load(f.beam) != 0.0f);
  f.any_picture = f.any_base || f.any_normal || f.any_roughness || f.any_emission || f.any_blend || f.any_unit;
}

/// `f` is that of the vector before, or new.
KERNEL void Fetch(const ShadeView& view, const RaySet& rays, int begin, Fetched& f) {
  const uint32_t one_instance = rays.instance[begin], one_triangle = rays.triangle[begin];
  const bool one = stdx::all_of(Bits(rays.instance + begin) == one_instance && Bits(rays.triangle + begin) == one_triangle);
  if (one && f.one && f.one_instance == one_instance && f.one_triangle == one_triangle) return;
  f.one = one, f.one_instance = one_instance, f.one_triangle = one_triangle;

  const TriangleRecord* triangle[kLanes];
  const InstanceRecord* instance[kLanes];
  const MaterialRecord* material[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    instance[i] = &view.instances[rays.instance[begin + i]];
    triangle[i] = &view.triangles[instance[i]->first_triangle + rays.triangle[begin + i]];
    material[i] = &view.materials[triangle[i]->material & ~kMirroredUv];
  }
  TakeRecords(triangle, one ? triangle[0] : nullptr, 4, f.normal);
  // Instance and material are mostly those of the vector before.
  const InstanceRecord* same_instance = Shared(instance);
  if (same_instance == nullptr || same_instance != f.instance) {
    TakeRecords(instance, same_instance, 4, f.matrix);
    f.any_colored = stdx::any_of(Bits(f.first_color) != 0u);
  }
  f.instance = same_instance;
  const MaterialRecord* same_material = Shared(material);
  if (same_material == nullptr || same_material != f.of_material) TakeMaterials(material, same_material, f);
  f.of_material = same_material;

  store(f.texels_log2, load(f.texels_log2) + load(f.scale_log2));
  const ureal flags = Bits(f.material);
  const mask_t mirrored = stdx::__proposed::static_simd_cast<mask_t>((flags & kMirroredUv) != 0u);
  store(f.mirrored, sel(mirrored, real(-1.0f), real(1.0f)));
  store(f.pane, HashLanes(Bits(f.pane_bits) ^ Bits(f.instance_hash)));
  for (int k = 0; k < 3; ++k) store(f.color[k], load(f.base[k]) * load(f.tint[k]));
  store3(f.facet[0], f.facet[1], f.facet[2], ToWorld(f, UnpackDirection(f.geometric)));

  f.any_smooth = stdx::any_of(IsSmooth(f));
  f.any_window = stdx::any_of(Bits(f.window) != 0u);
  if (f.any_window) FetchPanes(view, f);
  if (f.any_colored) FetchColors(view, rays, begin, f);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
