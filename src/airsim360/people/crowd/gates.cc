#include "airsim360/people/crowd/gates.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/mind.h"

namespace airsim360::internal {
namespace {

constexpr double kWidest = 1.4;   // metres of a gate: farther out the way would grow long
constexpr double kAtGate = 0.02;  // metres to a gate that is as good as passed
constexpr double kBeside = 0.25;  // and beside it, beyond its line

Vec2d Unit(Vec2d a) {
  const double n = std::sqrt(Dot(a, a));
  return n > 1e-9 ? a * (1 / n) : Vec2d{};
}

/// The room beside a corner: straight away from it, up to a wall or to ground that ways avoid.
Vec2d RoomBeside(const NavMesh& mesh, Vec3d corner, Vec2d outward) {
  const Vec2d p = Flat(corner);
  const NavPoint start = mesh.Nearest({p.x + 0.03 * outward.x, p.y + 0.03 * outward.y, corner.z}, 0.1);
  if (!start.valid()) return {};
  const Vec3d end = mesh.Along(start, p + outward * kWidest).p_W;
  double room = std::max(0.0, Dot(Flat(end) - p, outward));
  const double here = GroundCost(mesh.Kind(start));
  for (double s = 0.35; s < room; s += 0.35)
    if (GroundCost(mesh.Kind(mesh.Along(start, p + outward * s))) > 2 * here) room = s - 0.35;
  return outward * room;
}

}  // namespace

std::vector<Gate> GatesOf(const NavMesh& mesh, const NavPath& path) {
  std::vector<Gate> gates;
  const std::vector<Vec3d>& corners = path.corners;
  for (size_t k = 1; k < corners.size(); ++k) {
    const Vec2d in = Unit(Flat(corners[k]) - Flat(corners[k - 1]));
    Gate gate{corners[k], {}, in, 0};
    if (k + 1 < corners.size()) {
      const Vec2d out = Unit(Flat(corners[k + 1]) - Flat(corners[k]));
      const double turn = Cross(in, out);
      gate.ahead = Unit(in + out);
      const Vec2d left{-gate.ahead.y, gate.ahead.x};
      if (std::abs(turn) > 1e-3) gate.side = RoomBeside(mesh, corners[k], left * (turn > 0 ? -1 : 1));
    }
    gates.push_back(gate);
  }
  if (gates.empty() && !corners.empty()) gates.push_back({corners.back(), {}, {}, 0});
  for (size_t k = gates.size(); k-- > 1;) gates[k - 1].onward = gates[k].onward + Norm(gates[k].p - gates[k - 1].p);
  return gates;
}

Vec2d NearestInGate(const Gate& gate, Vec2d p) {
  const double n2 = Dot(gate.side, gate.side);
  const double t = n2 > 1e-9 ? std::clamp(Dot(p - Flat(gate.p), gate.side) / n2, 0.0, 1.0) : 0;
  return Flat(gate.p) + gate.side * t;
}

bool HasPassed(const Gate& gate, Vec2d p) {
  const Vec2d off = p - NearestInGate(gate, p);
  const double beyond = Dot(off, gate.ahead), beside = std::abs(Cross(off, gate.ahead));
  return Dot(off, off) < kAtGate * kAtGate || (beyond > 0 && beyond < 1.5 && beside < kBeside);
}

}  // namespace airsim360::internal
