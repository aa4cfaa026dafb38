// Whether two boxes meet.
#pragma once

namespace airsim360 {

/// True if two closed boxes (Box3f, Box3d) have a point in common; false if one is empty.
template <class Box>
bool Overlap(const Box& a, const Box& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z && b.min.z <= a.max.z;
}

}  // namespace airsim360
