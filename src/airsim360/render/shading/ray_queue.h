// Collecting single rays into packets.
#pragma once

#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

inline float RayOffset(Vec3f p, float distance) { return scalar::ray_offset(p, distance); }

/// Sixteen rays collected one by one, with the place where each answer goes.
struct RayQueue {
  RayHit16 rays{};
  alignas(64) int valid[16] = {};
  int lane[16] = {};
  int count = 0;
  uint32_t mask;

  explicit RayQueue(uint32_t meets = kMaskAll) : mask(meets) {}
  void Add(Vec3f p, Vec3f d, int index, float reach = INFINITY) {
    const int i = count++;
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = 0, rays.t_far[i] = reach, rays.mask[i] = mask;
    lane[i] = index;
  }
  /// As sixteen times Add for places from `index` on, of rays whose origins and directions are set already.
  void Fill(int index, float reach = INFINITY) {
    for (int i = 0; i < 16; ++i) {
      rays.t_near[i] = 0, rays.t_far[i] = reach, rays.mask[i] = mask;
      lane[i] = index + i;
    }
    count = 16;
  }
  /// Marks the lanes in use; the others repeat the last ray.
  void Close() {
    if (count == 16) {
      for (int& lane_valid : valid) lane_valid = -1;
      return;
    }
    for (int i = 0; i < 16; ++i) {
      valid[i] = i < count ? -1 : 0;
      if (i < count) continue;
      rays.origin_x[i] = rays.origin_x[0], rays.origin_y[i] = rays.origin_y[0], rays.origin_z[i] = rays.origin_z[0];
      rays.direction_x[i] = rays.direction_x[0], rays.direction_y[i] = rays.direction_y[0], rays.direction_z[i] = rays.direction_z[0];
      rays.t_near[i] = 0, rays.t_far[i] = INFINITY, rays.mask[i] = mask;
    }
  }
};

}  // namespace airsim360::internal
