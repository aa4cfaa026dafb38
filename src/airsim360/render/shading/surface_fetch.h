// Reads the records under one vector of rays into lanes (only for *_kernel.cc files).
#pragma once

#include "airsim360/render/shading/shading_texture.h"

namespace airsim360::internal::AIRSIM360_ISA {

constexpr float kFoliage = 1, kGlass = 2, kWater = 3;  // SurfaceKind

/// Records of the triangles under one vector of rays, turned into lanes.
struct alignas(64) Fetched {
  alignas(64) int32_t normal[3][kLanes], geometric[kLanes], tangent[kLanes];
  alignas(64) int32_t base_id[kLanes], roughness_id[kLanes], normal_id[kLanes],
      emission_id[kLanes], macro_id[kLanes];
  alignas(64) Lanes uv[6], texels_log2, mirrored, pane, area;
  alignas(64) Lanes matrix[9], color[3], emission[3];
  alignas(64) Lanes metallic, roughness, transmission, macro, normal_scale, kind;
  alignas(64) Lanes clear_coat, clear_coat_roughness, mean[3], tile, blend, columns, rows, ground, interior;
  alignas(64) Lanes corner_a[3], corner_b[3], half_a, half_b, u_per_a, v_per_b, room;
  alignas(64) int32_t right[kLanes], up[kLanes];
  bool any_normal, any_roughness, any_emission, any_macro, any_glass, any_water, any_base, any_blend,
      any_unit, any_ground, any_window, any_leaf;
};

/// Brings the records of the next vector into the cache while this one is worked on.
KERNEL void Prefetch(const ShadeView& view, const RaySet& rays, int begin) {
  if (begin >= rays.count) return;
  for (int i = 0; i < kLanes; ++i) {
    __builtin_prefetch(
        &view.triangles[view.instances[rays.instance[begin + i]].first_triangle + rays.triangle[begin + i]]);
  }
}

KERNEL float HashLane(uint32_t bits) { return static_cast<float>((bits * 0x9e3779b1u) >> 8) * 0x1p-24f; }

/// The pane in front of a room under lane i, if any.
KERNEL void FetchPane(const ShadeView& view, const TriangleRecord& triangle, const InstanceRecord& instance,
                      int i, Fetched& f) {
  static constexpr PaneRecord kNone{{0, 0, 0}, {0, 0, 0}, 1, 1, 0, 0, 0, 0, 0};
  const PaneRecord& pane = triangle.window != 0 ? view.panes[triangle.window - 1] : kNone;
  for (int k = 0; k < 3; ++k) f.corner_a[k][i] = pane.a[k], f.corner_b[k][i] = pane.b[k];
  f.half_a[i] = pane.half_a;
  f.half_b[i] = pane.half_b;
  f.u_per_a[i] = pane.u_per_a;
  f.v_per_b[i] = pane.v_per_b;
  f.right[i] = static_cast<int32_t>(pane.right);
  f.up[i] = static_cast<int32_t>(pane.up);
  f.room[i] = HashLane((pane.hash ^ instance.hash) * 0x85ebca6bu + 77u);
  f.interior[i] = triangle.window != 0 ? 1.0f : 0.0f;
  f.any_window |= triangle.window != 0;
}

KERNEL void Fetch(const ShadeView& view, const RaySet& rays, int begin, Fetched& f) {
  f.any_normal = f.any_roughness = f.any_emission = f.any_macro = f.any_glass = f.any_water = f.any_base =
      f.any_blend = f.any_unit = f.any_ground = f.any_window = f.any_leaf = false;
  for (int i = 0; i < kLanes; ++i) {
    const InstanceRecord& instance = view.instances[rays.instance[begin + i]];
    const TriangleRecord& triangle = view.triangles[instance.first_triangle + rays.triangle[begin + i]];
    const MaterialRecord& material = view.materials[triangle.material & ~kMirroredUv];
    for (int k = 0; k < 3; ++k) f.normal[k][i] = static_cast<int32_t>(triangle.normals[k]);
    f.geometric[i] = static_cast<int32_t>(triangle.geometric_normal);
    f.tangent[i] = static_cast<int32_t>(triangle.tangent);
    for (int k = 0; k < 6; ++k) f.uv[k][i] = triangle.uv[k];
    f.texels_log2[i] = triangle.texels_log2 + instance.texels_log2;
    f.mirrored[i] = (triangle.material & kMirroredUv) != 0 ? -1.0f : 1.0f;
    f.pane[i] = HashLane(triangle.pane ^ instance.hash);
    f.area[i] = triangle.area;
    for (int k = 0; k < 9; ++k) f.matrix[k][i] = instance.normal_matrix[k];
    for (int k = 0; k < 3; ++k) f.color[k][i] = material.base[k] * instance.tint[k];
    for (int k = 0; k < 3; ++k) f.emission[k][i] = material.emission[k];
    f.metallic[i] = material.metallic;
    f.roughness[i] = material.roughness;
    f.transmission[i] = material.transmission;
    f.macro[i] = material.macro_variation;
    f.normal_scale[i] = material.normal_scale;
    f.kind[i] = material.kind;
    f.base_id[i] = material.base_texture;
    f.roughness_id[i] = material.roughness_texture;
    f.normal_id[i] = material.normal_texture;
    f.emission_id[i] = material.emission_texture;
    f.macro_id[i] = view.macro_texture;
    f.any_base |= material.base_texture != 0;
    f.any_normal |= material.normal_texture != 0;
    f.any_roughness |= material.roughness_texture != 0;
    f.any_emission |= material.emission_texture != 0;
    f.any_macro |= material.macro_variation != 0;
    f.any_glass |= material.kind == kGlass;
    f.any_water |= material.kind == kWater;
    f.clear_coat[i] = material.clear_coat;
    f.clear_coat_roughness[i] = material.clear_coat_roughness;
    for (int k = 0; k < 3; ++k) f.mean[k][i] = material.mean[k];
    f.tile[i] = material.tile;
    f.blend[i] = material.blend;
    f.columns[i] = material.unit_columns;
    f.rows[i] = material.unit_rows;
    f.ground[i] = material.ground;
    f.any_blend |= material.blend != 0;
    f.any_unit |= material.unit_columns != 0;
    f.any_ground |= material.ground != 0;
    f.any_leaf |= material.kind == kFoliage;
    FetchPane(view, triangle, instance, i, f);
  }
}

KERNEL real3 UnpackDirection(const int32_t* packed) {
  const ireal p(packed, stdx::vector_aligned);
  constexpr float scale = 2.0f / 65534.0f;
  return octahedral_decode(to_real(p & 0xffff) * scale - 1.0f, to_real((p >> 16) & 0xffff) * scale - 1.0f);
}

KERNEL real3 ToWorld(const Fetched& f, real3 a) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return load(f.matrix[k]) * a.x + load(f.matrix[k + 1]) * a.y + load(f.matrix[k + 2]) * a.z;
  };
  return normalize3(make3(row(0), row(3), row(6)));
}

}  // namespace airsim360::internal::AIRSIM360_ISA
