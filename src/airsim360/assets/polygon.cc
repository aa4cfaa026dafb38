#include "airsim360/assets/polygon.h"

#include <cmath>
#include <cstdint>
#include <numeric>

namespace airsim360::internal {
namespace {

// The corners in a plane, seen from the side their normal points to.
std::vector<Vec2d> Flatten(std::span<const Vec3f> corners) {
  // Newell's normal is twice the vector area; drop its largest axis.
  const Vec3d origin = VecCast<double>(corners[0]);
  Vec3d n{};
  for (size_t i = 0; i < corners.size(); ++i) {
    n += Cross(VecCast<double>(corners[i]) - origin, VecCast<double>(corners[(i + 1) % corners.size()]) - origin);
  }
  const int axis = std::abs(n.x) > std::abs(n.y) ? (std::abs(n.x) > std::abs(n.z) ? 0 : 2) : (std::abs(n.y) > std::abs(n.z) ? 1 : 2);
  const double flip = n[axis] < 0 ? -1 : 1;
  std::vector<Vec2d> flat;
  for (Vec3f corner : corners) {
    const Vec3d p = VecCast<double>(corner) - origin;
    flat.push_back({flip * p[(axis + 1) % 3], p[(axis + 2) % 3]});
  }
  return flat;
}

double Turn(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool IsEar(const std::vector<Vec2d>& flat, const std::vector<uint32_t>& rest, size_t i) {
  const size_t n = rest.size();
  const uint32_t ia = rest[(i + n - 1) % n];
  const uint32_t ib = rest[i];
  const uint32_t ic = rest[(i + 1) % n];
  if (Turn(flat[ia], flat[ib], flat[ic]) <= 0) return false;
  for (uint32_t other : rest) {
    if (other == ia || other == ib || other == ic) continue;
    const Vec2d p = flat[other];
    if (p == flat[ia] || p == flat[ib] || p == flat[ic]) continue;
    if (Turn(flat[ia], flat[ib], p) >= 0 && Turn(flat[ib], flat[ic], p) >= 0 && Turn(flat[ic], flat[ia], p) >= 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Vec3u> TriangulateFace(std::span<const Vec3f> corners) {
  constexpr size_t kMostForEars = 512;
  std::vector<Vec3u> triangles;
  if (corners.size() < 3) return triangles;
  triangles.reserve(corners.size() - 2);
  std::vector<uint32_t> rest(corners.size());
  std::iota(rest.begin(), rest.end(), 0u);

  // Cut ears while there are any, starting after the last cut so that strips alternate.
  if (corners.size() > 3 && corners.size() <= kMostForEars) {
    const std::vector<Vec2d> flat = Flatten(corners);
    size_t i = 1;
    for (size_t tried = 0; rest.size() > 3 && tried < rest.size();) {
      const size_t n = rest.size();
      i %= n;
      if (IsEar(flat, rest, i)) {
        triangles.push_back({rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        tried = 0;
      } else {
        ++i;
        ++tried;
      }
    }
  }

  // What is left is a triangle, or a polygon without ears: a fan.
  for (size_t i = 1; i + 1 < rest.size(); ++i) triangles.push_back({rest[0], rest[i], rest[i + 1]});
  return triangles;
}

}  // namespace airsim360::internal
