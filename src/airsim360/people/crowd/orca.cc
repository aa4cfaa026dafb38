#include "airsim360/people/crowd/orca.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/math/plane.h"

namespace airsim360::internal {
namespace {

Vec2d Along(Vec2d normal) { return {normal.y, -normal.x}; }

constexpr double kTiny = 1e-9;

/// Best point of the border of planes[i] within the disc and planes[0, i): nearest to `wanted`, or farthest
/// along it if `is_direction`. False if there is none.
bool BestOnBorder(std::span<const HalfPlane> planes, size_t i, Vec2d wanted, bool is_direction, double radius, Vec2d& best) {
  // The border is point + t d; the disc leaves an interval of t.
  const Vec2d o = planes[i].point, d = Along(planes[i].normal);
  const double middle = -Dot(o, d), reach2 = middle * middle + radius * radius - Dot(o, o);
  if (reach2 < 0) return false;
  double low = middle - std::sqrt(reach2), high = middle + std::sqrt(reach2);

  // Every earlier half-plane cuts it from one side.
  for (size_t k = 0; k < i; ++k) {
    const double slope = Dot(d, planes[k].normal), gap = Dot(planes[k].point - o, planes[k].normal);
    if (std::abs(slope) < kTiny) {
      if (gap > 0) return false;
      continue;
    }
    const double t = gap / slope;
    if (slope > 0) {
      low = std::max(low, t);
    } else {
      high = std::min(high, t);
    }
    if (low > high) return false;
  }
  const double t = is_direction ? (Dot(wanted, d) > 0 ? high : low) : std::clamp(Dot(wanted - o, d), low, high);
  best = o + d * t;
  return true;
}

/// Adds the half-planes one by one; the best point changes only where it violates the new one, and then lies on
/// its border. Returns the number of half-planes that hold.
size_t BestInPlanes(std::span<const HalfPlane> planes, Vec2d wanted, bool is_direction, double radius, Vec2d& best) {
  const double n2 = Dot(wanted, wanted);
  if (is_direction) {
    best = wanted * radius;
  } else {
    best = n2 > radius * radius ? wanted * (radius / std::sqrt(n2)) : wanted;
  }
  for (size_t i = 0; i < planes.size(); ++i) {
    if (Dot(best - planes[i].point, planes[i].normal) >= 0) continue;
    const Vec2d before = best;
    if (!BestOnBorder(planes, i, wanted, is_direction, radius, best)) {
      best = before;
      return i;
    }
  }
  return planes.size();
}

/// From half-plane `from` on, where not all can hold: the point whose largest violation of the soft ones is
/// least (the third dimension of the paper's program is that violation).
void LeastViolation(std::span<const HalfPlane> planes, size_t hard, size_t from, double radius, Vec2d& best) {
  double violation = 0;
  std::array<HalfPlane, 64> borders;
  for (size_t i = from; i < planes.size(); ++i) {
    if (Dot(planes[i].point - best, planes[i].normal) <= violation) continue;
    // Where plane i is violated as much as each earlier one; the hard ones stay as they are.
    size_t count = 0;
    for (size_t k = 0; k < std::min(hard, i); ++k) borders[count++] = planes[k];
    for (size_t k = hard; k < i && count < borders.size(); ++k) {
      const Vec2d difference = planes[k].normal - planes[i].normal;
      const double n = std::sqrt(Dot(difference, difference));
      if (n < 1e-6) continue;  // the same direction: one holds where the other does
      const double sine = Cross(planes[i].normal, planes[k].normal);
      Vec2d on = (planes[i].point + planes[k].point) * 0.5;
      if (std::abs(sine) > 1e-6) {
        const Vec2d d = Along(planes[i].normal);
        on = planes[i].point + d * (Dot(planes[k].point - planes[i].point, planes[k].normal) / Dot(d, planes[k].normal));
      }
      borders[count++] = {on, difference * (1 / n)};
    }
    const Vec2d before = best;
    if (BestInPlanes({borders.data(), count}, planes[i].normal, true, radius, best) < count) best = before;
    violation = Dot(planes[i].point - best, planes[i].normal);
  }
}

}  // namespace

HalfPlane AvoidDisc(Vec2d p_AB, Vec2d v_A, Vec2d v_B, double radii, double horizon, double dt, double share) {
  // Relative velocities that lead to touching within the horizon: a cone cut off by a disc of radii / horizon
  // around p_AB / horizon. u leads from the relative velocity to the nearest point of its border.
  const Vec2d v = v_A - v_B;
  const double distance2 = Dot(p_AB, p_AB);
  Vec2d u, normal;
  const auto off_disc = [&](double time) {
    const Vec2d w = v - p_AB * (1 / time);
    const double n = std::sqrt(Dot(w, w));
    normal = n > kTiny ? w * (1 / n) : distance2 > 0 ? p_AB * (-1 / std::sqrt(distance2)) : Vec2d{1, 0};
    u = normal * (radii / time - n);
  };
  if (distance2 <= radii * radii) {
    off_disc(dt);  // touching already: apart within the step
  } else {
    const Vec2d w = v - p_AB * (1 / horizon);
    const double back = Dot(w, p_AB);
    if (back < 0 && back * back > radii * radii * Dot(w, w)) {
      off_disc(horizon);
    } else {
      // A leg of the cone: p_AB turned by the angle whose sine is radii / distance, to the nearer side.
      const double leg = std::sqrt(distance2 - radii * radii), side = Cross(p_AB, w) > 0 ? 1 : -1;
      const Vec2d d = Vec2d{p_AB.x * leg - side * p_AB.y * radii, side * p_AB.x * radii + p_AB.y * leg} * (1 / distance2);
      u = d * Dot(v, d) - v;
      normal = Vec2d{-d.y, d.x} * side;
    }
  }
  return {v_A + u * share, normal};
}

Vec2d SolveVelocity(std::span<const HalfPlane> planes, size_t hard, Vec2d wanted, double max_speed) {
  Vec2d best;
  const size_t holds = BestInPlanes(planes, wanted, false, max_speed, best);
  if (holds < planes.size()) LeastViolation(planes, hard, holds, max_speed, best);
  return best;
}

}  // namespace airsim360::internal
