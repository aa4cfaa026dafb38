// Axis-aligned boxes.
#pragma once

#include <limits>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Closed axis-aligned box; starts empty (min > max).
struct Box3f {
  Vec3f min{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
  Vec3f max{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

  bool empty() const { return min.x > max.x; }
  Vec3f center() const { return (min + max) * 0.5f; }
  Vec3f size() const { return max - min; }
  void Add(Vec3f p) {
    min = Min(min, p);
    max = Max(max, p);
  }
  void Add(const Box3f& b) {
    if (b.empty()) return;
    Add(b.min);
    Add(b.max);
  }
  bool Contains(Vec3f p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z; }
};

}  // namespace airsim360
