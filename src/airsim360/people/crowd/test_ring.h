// A ring 4 m wide, for speeds over densities: nobody ever arrives.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "airsim360/people/crowd/steering.h"
#include "airsim360/people/navigation/test_ground.h"

namespace airsim360::internal {

inline constexpr double kRingInner = 6, kRingOuter = 10, kRingPi = 3.14159265358979;

inline std::shared_ptr<const NavMesh> BuildRing() {
  TestGround ground;
  constexpr int kSides = 64;
  for (int i = 0; i < kSides; ++i) {
    const auto at = [](double r, int k) {
      const double a = 2 * kRingPi * k / kSides;
      return Vec3f{static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), 0};
    };
    ground.Sheet("ground/floor", at(kRingInner, i), at(kRingOuter, i), at(kRingOuter, i + 1), at(kRingInner, i + 1));
  }
  return NavMesh::Build(*ground.Build());
}

/// Circles of people with about the same distance to all sides.
inline std::vector<Walker> FillRing(const NavMesh& mesh, double density) {
  const double area = kRingPi * (kRingOuter * kRingOuter - kRingInner * kRingInner);
  const auto wanted = static_cast<size_t>(density * area + 0.5);
  const double inner = kRingInner + 0.3, outer = kRingOuter - 0.3;
  for (double spacing = 3; spacing > 0.3; spacing *= 0.99) {
    std::vector<Walker> walkers;
    const int circles = 1 + static_cast<int>((outer - inner) / (spacing * 0.87));
    for (int c = 0; c < circles; ++c) {
      const double r = circles > 1 ? inner + (outer - inner) * c / (circles - 1) : (inner + outer) / 2;
      const int n = static_cast<int>(2 * kRingPi * r / spacing);
      for (int k = 0; k < n; ++k) {
        const double a = 2 * kRingPi * (k + 0.5 * (c % 2)) / n;
        Walker walker;
        walker.at = mesh.Nearest({r * std::cos(a), r * std::sin(a), 0}, 0.5);
        walkers.push_back(walker);
      }
    }
    if (walkers.size() < wanted) continue;
    // Too many by a few: leave some out evenly.
    std::vector<Walker> kept;
    for (size_t i = 0; i < wanted; ++i) kept.push_back(walkers[i * walkers.size() / wanted]);
    return kept;
  }
  return {};
}

/// Mean speed around the ring over the last half of `seconds`.
inline double RingSpeed(const NavMesh& mesh, double density, double seconds) {
  std::vector<Walker> walkers = FillRing(mesh, density);
  Steering steering;
  double sum = 0;
  int64_t count = 0;
  const int steps = static_cast<int>(seconds * 20);
  for (int i = 0; i < steps; ++i) {
    for (Walker& w : walkers) {
      const double r = std::hypot(w.at.p_W.x, w.at.p_W.y);
      w.wanted = Vec2d{-w.at.p_W.y, w.at.p_W.x} * (w.free_speed / r);
    }
    steering.Sort(walkers);
    steering.Step(mesh, walkers, {}, 0.05);
    if (i < steps / 2) continue;
    for (const Walker& w : walkers) {
      const double r = std::hypot(w.at.p_W.x, w.at.p_W.y);
      sum += (w.v.y * w.at.p_W.x - w.v.x * w.at.p_W.y) / r;
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

}  // namespace airsim360::internal
