#include <algorithm>
#include <utility>

#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {

EntityId InteriorPen::Start(std::string name, const char* category) {
  const EntityId entity = builder_.AddEntity(std::move(name), builder_.tree().At(category));
  mesh_.SetEntity(entity);
  return entity;
}

void InteriorPen::Level(const PlanRect& r, float z, bool up) {
  const Vec3f a{r.x0, r.y0, z}, b{r.x1, r.y0, z}, c{r.x1, r.y1, z}, d{r.x0, r.y1, z};
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
  if (up)
    mesh_.QuadUv(a, b, c, d, uv(a), uv(b), uv(c), uv(d));
  else
    mesh_.QuadUv(a, d, c, b, uv(a), uv(d), uv(c), uv(b));
}

void InteriorPen::Upright(bool along_x, float at, float from, float to, float z0, float z1, bool high) {
  if (to <= from || z1 <= z0) return;
  // Counter-clockwise seen from where it faces: +y and -x see `from` on their right.
  const bool swap = along_x == high;
  const float left = swap ? to : from, right = swap ? from : to;
  const auto p = [&](float s, float z) { return along_x ? Vec3f{s, at, z} : Vec3f{at, s, z}; };
  const auto uv = [&](float s, float z) { return Vec2f{swap ? -s : s, -z}; };
  mesh_.QuadUv(p(left, z0), p(right, z0), p(right, z1), p(left, z1), uv(left, z0), uv(right, z0), uv(right, z1), uv(left, z1));
}

void InteriorPen::Box(Vec3f low, Vec3f high, unsigned sides) {
  using M = MeshBuilder;
  if (sides & M::kFront) Upright(true, low.y, low.x, high.x, low.z, high.z, false);
  if (sides & M::kBack) Upright(true, high.y, low.x, high.x, low.z, high.z, true);
  if (sides & M::kLeft) Upright(false, low.x, low.y, high.y, low.z, high.z, false);
  if (sides & M::kRight) Upright(false, high.x, low.y, high.y, low.z, high.z, true);
  if (sides & M::kTop) Level({low.x, low.y, high.x, high.y}, high.z, true);
  if (sides & M::kBottom) Level({low.x, low.y, high.x, high.y}, low.z, false);
}

void InteriorPen::WallBox(bool along_x, float from, float to, float near, float far, float z0, float z1) {
  const float lo = std::min(near, far), hi = std::max(near, far);
  if (along_x)
    Box({from, lo, z0}, {to, hi, z1});
  else
    Box({lo, from, z0}, {hi, to, z1});
}

void InteriorPen::Done(const char* name) {
  if (!mesh_.empty()) builder_.AddInstance({builder_.AddMesh(mesh_.Finish(name)), {}, kNoEntity});
}

}  // namespace airsim360::internal
