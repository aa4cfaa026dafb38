#include "airsim360/people/body/seat_sockets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/people/body/anatomy.h"

namespace airsim360 {
namespace {

constexpr double kStep = 0.0015;  // metres between the places that are tried

// The point of a limb that its sockets give way to: deep inside whatever the level.
Vec3d CoreOf(const Socket& socket, const std::array<Vec3d, kJointCount>& q, std::span<const Socket> sockets) {
  using internal::At;
  if (socket.joint == Joint::kHead) {
    for (const Socket& s : sockets) {
      if (s.name == "head_center") return q[At(Joint::kHead)] + s.p_J;
    }
  }
  if (socket.name.ends_with("heel")) return q[At(socket.joint)];
  const Joint parent = ParentOf(socket.joint);
  const Vec3d own = q[At(socket.joint)];
  // Tips of hands and feet: back along the bone.
  if (Norm(socket.p_J) > 0.01) return own;
  return (own + q[At(parent)]) * 0.5;
}

// Whether a point and its six neighbours at `margin` are inside.
bool SeatedIn(const BodyLevel& level, Vec3d p, double margin) {
  if (level.mesh.triangles.empty()) return true;
  if (!IsInside(level, p)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d d;
    d[axis] = margin;
    if (!IsInside(level, p + d) || !IsInside(level, p - d)) return false;
  }
  return true;
}

}  // namespace

double WindingNumber(const BodyLevel& level, Vec3d p_P) {
  double sum = 0;
  for (const MeshPart& part : level.mesh.parts) {
    if (part.entity != 0) continue;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u& t = level.mesh.triangles[k];
      const Vec3d a = VecCast<double>(level.mesh.positions[t.x]) - p_P, b = VecCast<double>(level.mesh.positions[t.y]) - p_P,
                  c = VecCast<double>(level.mesh.positions[t.z]) - p_P;
      const double la = Norm(a), lb = Norm(b), lc = Norm(c);
      sum += std::atan2(Dot(a, Cross(b, c)), la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
    }
  }
  return sum / (2 * std::numbers::pi);
}

void SeatSockets(std::span<const BodyLevel> levels, const std::array<Vec3d, kJointCount>& p_PJ, double margin, double farthest,
                 std::vector<Socket>& sockets) {
  const std::vector<Socket> given = sockets;
  ParallelFor(static_cast<int64_t>(sockets.size()), [&](int64_t i) {
    Socket& socket = sockets[static_cast<size_t>(i)];
    const Vec3d joint = p_PJ[internal::At(socket.joint)], start = joint + socket.p_J;
    const Vec3d way = CoreOf(socket, p_PJ, given) - start;
    const double length = Norm(way);
    const int steps = static_cast<int>(std::min(length, farthest) / kStep);
    // The first place that most levels agree on, finer ones first: level 0 counts more than all coarser.
    Vec3d best = start;
    int best_score = -1;
    const int full = (1 << levels.size()) - 1;
    for (int k = 0; k <= steps && best_score < full; ++k) {
      const Vec3d p = start + way * (k * kStep / std::max(length, 1e-9));
      int score = 0;
      for (const BodyLevel& level : levels) score = score * 2 + (SeatedIn(level, p, margin) ? 1 : 0);
      if (score <= best_score) continue;
      best_score = score;
      best = p;
    }
    socket.p_J = best - joint;
  });
}

}  // namespace airsim360
