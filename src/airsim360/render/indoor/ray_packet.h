// Sixteen rays of light from anywhere, all lanes finite.
#pragma once

#include "airsim360/math/vector.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

struct RayPacket {
  RayHit16 rays;
  alignas(64) int valid[16];

  explicit RayPacket(uint32_t mask = kMaskSolid) : rays{}, valid{} {
    for (int i = 0; i < 16; ++i) rays.direction_z[i] = 1, rays.mask[i] = mask;
  }
  void Set(int i, Vec3f p, Vec3f d, float t_far) {
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = 0, rays.t_far[i] = t_far, rays.geometry[i] = rays.instance[i] = kMiss;
    valid[i] = -1;
  }
  void Clear() {
    for (int& lane : valid) lane = 0;
  }
  bool Hit(int i) const { return valid[i] != 0 && rays.geometry[i] != kMiss; }
  Vec3f Direction(int i) const { return {rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]}; }
  Vec3f Origin(int i) const { return {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]}; }
};

}  // namespace airsim360::internal
