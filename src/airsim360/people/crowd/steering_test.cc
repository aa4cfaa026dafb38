#include "airsim360/people/crowd/steering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/base/state_hash.h"
#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/orca.h"
#include "airsim360/people/crowd/test_ring.h"

namespace airsim360::internal {
namespace {

TEST(Orca, TheSolvedVelocityIsTheNearestOfAFineRasterOfAllAllowedOnes) {
  RngStream rng(5, "orca");
  int feasible = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<HalfPlane> planes;
    const int n = 1 + static_cast<int>(rng.Index(6));
    for (int i = 0; i < n; ++i) {
      const double a = rng.Uniform(0, 6.28318);
      planes.push_back({{rng.Uniform(-0.6, 0.6), rng.Uniform(-0.6, 0.6)}, {std::cos(a), std::sin(a)}});
    }
    const Vec2d wanted{rng.Uniform(-1.2, 1.2), rng.Uniform(-1.2, 1.2)};
    const Vec2d v = SolveVelocity(planes, 0, wanted, 1.4);
    ASSERT_LE(Dot(v, v), 1.4 * 1.4 + 1e-9);
    double best = 1e9, least = 1e9;
    for (double x = -1.4; x <= 1.4; x += 0.02)
      for (double y = -1.4; y <= 1.4; y += 0.02) {
        if (x * x + y * y > 1.4 * 1.4) continue;
        double violation = 0;
        for (const HalfPlane& plane : planes) violation = std::max(violation, -Dot(Vec2d{x, y} - plane.point, plane.normal));
        least = std::min(least, violation);
        if (violation <= 0) best = std::min(best, Dot(Vec2d{x, y} - wanted, Vec2d{x, y} - wanted));
      }
    double violation = 0;
    for (const HalfPlane& plane : planes) violation = std::max(violation, -Dot(v - plane.point, plane.normal));
    if (best < 1e9) {
      ++feasible;
      EXPECT_LT(violation, 1e-6);
      EXPECT_LE(std::sqrt(Dot(v - wanted, v - wanted)), std::sqrt(best) + 1e-6);
    } else {
      EXPECT_LE(violation, least + 0.03);  // nothing is allowed: the least bad
    }
  }
  EXPECT_GT(feasible, 50);
}

TEST(Orca, TwoWhoFollowTheirHalfPlanesNeverTouch) {
  RngStream rng(9, "pairs");
  for (int trial = 0; trial < 200; ++trial) {
    Vec2d p[2] = {{0, 0}, {rng.Uniform(2, 6), rng.Uniform(-1, 1)}}, v[2] = {}, goal[2] = {p[1], p[0]};
    goal[0].y += rng.Uniform(-0.5, 0.5);
    for (int step = 0; step < 200; ++step) {
      Vec2d next[2];
      for (int i = 0; i < 2; ++i) {
        const HalfPlane plane = AvoidDisc(p[1 - i] - p[i], v[i], v[1 - i], 0.5, 2, 0.05, 0.5);
        const Vec2d to = goal[i] - p[i];
        const double n = std::sqrt(Dot(to, to));
        next[i] = SolveVelocity({&plane, 1}, 0, n > 0.1 ? to * (1.3 / n) : Vec2d{}, 1.5);
      }
      for (int i = 0; i < 2; ++i) {
        v[i] = next[i];
        p[i] = p[i] + v[i] * 0.05;
      }
      ASSERT_GT(std::sqrt(Dot(p[0] - p[1], p[0] - p[1])), 0.5 - 1e-3) << trial << " " << step;
    }
  }
}

TEST(Steering, SpeedOverDensityIsWithin15PercentOfWeidmann) {
  const auto mesh = BuildRing();
  for (const double density : {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
    const double speed = RingSpeed(*mesh, density, 20), weidmann = WeidmannSpeed(density);
    std::printf("density %.2f: %.3f m/s, Weidmann %.3f (%+.1f %%)\n", density, speed, weidmann, 100 * (speed / weidmann - 1));
    EXPECT_NEAR(speed / weidmann, 1, 0.15) << density;
  }
}

TEST(Steering, NobodyOverlapsAndThreadsDoNotMatter) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 30, 30);
  ground.Box("furniture/box", {12, 12, 0}, {18, 13, 1});
  const auto mesh = NavMesh::Build(*ground.Build());
  const auto run = [&](double* closest) {
    std::vector<Walker> walkers;
    for (int i = 0; i < 300; ++i) {
      Walker w;
      w.at = mesh->Nearest({1 + 0.9 * (i % 30), 1 + 0.9 * static_cast<int>(i / 30) + (i >= 150 ? 19 : 0), 0}, 1);
      walkers.push_back(w);
    }
    Steering steering;
    for (int step = 0; step < 500; ++step) {
      for (size_t i = 0; i < walkers.size(); ++i) {
        const Vec2d goal{29.0 - 0.9 * static_cast<double>(i % 30), i < 150 ? 28.0 : 2.0};
        const Vec2d to = goal - Vec2d{walkers[i].at.p_W.x, walkers[i].at.p_W.y};
        const double n = std::sqrt(Dot(to, to));
        walkers[i].wanted = n > 0.3 ? to * (1.34 / n) : Vec2d{};
      }
      steering.Sort(walkers);
      steering.Step(*mesh, walkers, {}, 0.05);
      if (!closest) continue;
      for (size_t i = 0; i < walkers.size(); ++i)
        for (size_t k = 0; k < i; ++k) *closest = std::min(*closest, Norm(walkers[i].at.p_W - walkers[k].at.p_W));
    }
    StateHasher hasher;
    for (const Walker& w : walkers) hasher.Add(w.at.p_W);
    return hasher.hash();
  };
  double closest = 1e9;
  const uint64_t many = run(&closest);
  EXPECT_GE(closest, 2 * kBodyRadius - 1e-6);
  const ThreadLimit one(1);
  EXPECT_EQ(run(nullptr), many);
}

}  // namespace
}  // namespace airsim360::internal
