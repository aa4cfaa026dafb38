#include "airsim360/sim/world_contacts.h"

#include <algorithm>
#include <cmath>

#include "airsim360/sensors/surface_label.h"

namespace airsim360 {

DroneBoxes::DroneBoxes(std::vector<DroneBox> boxes) : boxes_(std::move(boxes)) {
  std::ranges::stable_sort(boxes_, {}, [](const DroneBox& box) { return box.X_WB.p.x; });
  for (const DroneBox& box : boxes_) largest_ = std::max(largest_, box.radius);
}

size_t DroneBoxes::FirstFrom(double x) const {
  const auto first = std::ranges::lower_bound(boxes_, x, {}, [](const DroneBox& box) { return box.X_WB.p.x; });
  return static_cast<size_t>(first - boxes_.begin());
}

std::optional<SurfacePoint> HitBox(const DroneBox& box, Vec3d from_W, Vec3d to_W) {
  // Slabs in the frame of the box.
  const Mat3d R_BW = box.X_WB.R.transpose();
  const Vec3d from = R_BW * (from_W - box.X_WB.p), d = R_BW * (to_W - from_W);
  double enter = -1, leave = 1;
  Vec3d normal_B;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) {
      if (std::abs(from[i]) > box.half_size_B[i]) return std::nullopt;
      continue;
    }
    const double sign = d[i] > 0 ? 1 : -1;
    const double in = (-sign * box.half_size_B[i] - from[i]) / d[i];
    leave = std::min(leave, (sign * box.half_size_B[i] - from[i]) / d[i]);
    if (in <= enter) continue;
    enter = in;
    normal_B = {};
    normal_B[i] = -sign;
  }
  if (enter < 0 || enter > leave) return std::nullopt;  // also where the segment begins inside
  return SurfacePoint{from_W + (to_W - from_W) * enter, box.X_WB.R * normal_B, box.entity};
}

SurfacePoint NearestOnBox(const DroneBox& box, Vec3d p_W) {
  const Vec3d p = box.X_WB.R.transpose() * (p_W - box.X_WB.p), half = box.half_size_B;
  Vec3d q = Max(Min(p, half), -half), normal_B;
  if (q == p) {
    // Inside: out through the nearest face.
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (half[i] - std::abs(p[i]) < half[axis] - std::abs(p[axis])) axis = i;
    }
    normal_B[axis] = p[axis] < 0 ? -1 : 1;
    q[axis] = normal_B[axis] * half[axis];
  } else {
    normal_B = Normalized(p - q);
  }
  return {box.X_WB * q, box.X_WB.R * normal_B, box.entity};
}

std::optional<SurfacePoint> WorldContacts::FirstHit(Vec3d from_W, Vec3d to_W) const {
  const Vec3d way = to_W - from_W;
  const double length = Norm(way);
  if (!(length > 0)) return std::nullopt;
  std::optional<SurfacePoint> first;
  double nearest = length;
  if (const auto hit = tracer_.Intersect(VecCast<float>(from_W), VecCast<float>(way / length), static_cast<float>(length))) {
    nearest = hit->distance;
    first = SurfacePoint{from_W + way * (nearest / length), VecCast<double>(hit->normal), LabelOf(tracer_, hit->surface).entity};
  }
  drones_.Near((from_W + to_W) * 0.5, length / 2, self_, [&](const DroneBox& box) {
    const auto hit = HitBox(box, from_W, to_W);
    if (!hit || !(Norm(hit->p_W - from_W) < nearest)) return;
    nearest = Norm(hit->p_W - from_W);
    first = hit;
  });
  return first;
}

std::optional<SurfacePoint> WorldContacts::Nearest(Vec3d p_W, double range) const {
  std::optional<SurfacePoint> nearest;
  if (const auto found = tracer_.Nearest(VecCast<float>(p_W), static_cast<float>(range))) {
    range = found->distance;
    nearest = SurfacePoint{p_W + VecCast<double>(found->offset), VecCast<double>(-Normalized(found->offset)),
                           LabelOf(tracer_, found->surface).entity};
  }
  drones_.Near(p_W, range, self_, [&](const DroneBox& box) {
    const SurfacePoint point = NearestOnBox(box, p_W);
    if (!(Norm(point.p_W - p_W) < range)) return;
    range = Norm(point.p_W - p_W);
    nearest = point;
  });
  return nearest;
}

}  // namespace airsim360
