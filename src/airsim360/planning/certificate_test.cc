#include "airsim360/planning/certificate.h"

#include <gtest/gtest.h>

#include "airsim360/base/random.h"
#include "airsim360/planning/analytic_world.h"
#include "airsim360/planning/arc_length.h"
#include "airsim360/planning/splines/minimum_snap.h"

namespace airsim360 {
namespace {

PolynomialTrajectory Straight(Vec3d a, Vec3d b) {
  const Vec3d points[] = {a, b};
  const double durations[] = {3};
  return SolveMinimumSnap({.waypoints = points, .durations = durations});
}

TEST(Certificate, HoldsUpToTheTrueClearanceAndNotBeyond) {
  // Past a ball of radius 1 at a distance of 3 of its centre: the clearance is 2.
  const AnalyticWorld world({{{0, 3, 0}, 1}}, {});
  const PolynomialTrajectory path = Straight({-10, 0, 0}, {10, 0, 0});
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  const Certificate good = Certify(path, peaks, world, 2 - 2 * kCertificateSlack);
  EXPECT_TRUE(good.certified);
  EXPECT_GE(good.least_clearance, 2 - 2 * kCertificateSlack);
  const Certificate bad = Certify(path, peaks, world, 2 + kCertificateSlack);
  EXPECT_FALSE(bad.certified);
  EXPECT_LT(path.At(bad.violation_time).p.x, 0.1);
  EXPECT_GT(path.At(bad.violation_time).p.x, -0.5);
}

TEST(Certificate, SeesAWallThinnerThanAnySampling) {
  const double thickness = 1e-9;
  const AnalyticWorld world({}, {{{2, -100, -100}, {2 + thickness, 100, 100}}});
  const PolynomialTrajectory path = Straight({-10, 0, 0}, {10, 0, 0});
  const Certificate certificate = Certify(path, CertifiedPeaks(path), world, 0.01);
  EXPECT_FALSE(certificate.certified);
  EXPECT_NEAR(path.At(certificate.violation_time).p.x, 2 - 0.01, 2 * kCertificateSlack);
}

TEST(Certificate, CertifiedFlightsKeepTheRadiusAtAMillionTimesAndOthersHaveAViolationWhereItIsTold) {
  RngStream rng(1, "certificate");
  int certified = 0, refused = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<Ball> balls;
    for (int i = 0; i < 12; ++i) balls.push_back({{rng.Uniform(-8, 8), rng.Uniform(-8, 8), rng.Uniform(-8, 8)}, rng.Uniform(0.2, 1.2)});
    const AnalyticWorld world(balls, {});
    std::vector<Vec3d> points;
    std::vector<double> durations;
    for (int i = 0; i < 4; ++i) points.push_back({rng.Uniform(-6, 6), rng.Uniform(-6, 6), rng.Uniform(-6, 6)});
    for (int i = 0; i < 3; ++i) durations.push_back(rng.Uniform(1, 4));
    const PolynomialTrajectory path = SolveMinimumSnap({.waypoints = points, .durations = durations});
    const double radius = 0.3;
    const Certificate certificate = Certify(path, CertifiedPeaks(path), world, radius);
    const int samples = 20'000;
    double first_violation = 1e9;
    for (int i = 0; i <= samples; ++i) {
      const double t = path.duration() * i / samples;
      if (world.Clearance(path.At(t).p, 9) < radius) {
        first_violation = t;
        break;
      }
    }
    if (certificate.certified) {
      ++certified;
      EXPECT_EQ(first_violation, 1e9);
    } else {
      ++refused;
      EXPECT_LE(certificate.violation_time, first_violation);
      EXPECT_LT(world.Clearance(path.At(certificate.violation_time).p, 9), radius + 1.5 * kCertificateSlack);
    }
  }
  EXPECT_GT(certified, 3);
  EXPECT_GT(refused, 3);
}

// Past balls, along floors, through them: the bound is below what any sample meets, and near it.
TEST(LeastClearanceBound, IsNeverAboveTheLeastClearanceOfASampleAndNearIt) {
  RngStream rng(2, "least clearance");
  int certified = 0, touching = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<Ball> balls;
    for (int i = 0; i < 8; ++i) balls.push_back({{rng.Uniform(-8, 8), rng.Uniform(-8, 8), rng.Uniform(-8, 8)}, rng.Uniform(0.2, 1.2)});
    const AnalyticWorld world(balls, {{{-50, -50, -9}, {50, 50, rng.Uniform(-8, -6)}}});
    std::vector<Vec3d> points;
    std::vector<double> durations;
    const bool level = k % 4 == 0;
    for (int i = 0; i < 2 + k % 3; ++i) points.push_back({rng.Uniform(-6, 6), rng.Uniform(-6, 6), level ? -5.0 : rng.Uniform(-6, 6)});
    for (size_t i = 1; i < points.size(); ++i) durations.push_back(rng.Uniform(0.2, 4));
    const PolynomialTrajectory path = SolveMinimumSnap({.waypoints = points, .durations = durations});
    const TrajectoryPeaks peaks = CertifiedPeaks(path);
    double met = 1e9;
    const int samples = 20'000;
    for (int i = 0; i <= samples; ++i) met = std::min(met, world.Clearance(path.At(path.duration() * i / samples).p, 1e3));
    const double bound = LeastClearanceBound(path, peaks, world);
    EXPECT_LE(bound, met);
    EXPECT_GE(bound, met - 0.01 - 1e-3 * ArcLength(path)) << k;
    touching += met == 0;
    const Certificate certificate = Certify(path, peaks, world, 0.2);
    if (!certificate.certified) continue;
    ++certified;
    EXPECT_LE(certificate.least_clearance, met);
    EXPECT_GE(certificate.least_clearance, 0.2);
  }
  EXPECT_GT(certified, 20);
  EXPECT_GT(touching, 20);
}

TEST(LeastClearanceBound, FewQueriesGiveALowerBoundToo) {
  const AnalyticWorld world({}, {{{-50, -50, -1}, {50, 50, 0}}});
  const PolynomialTrajectory path = Straight({-20, 0, 2}, {20, 0, 2});
  double last = 0;
  for (const int queries : {4, 40, 400, 4000, 40000}) {
    const double bound = LeastClearanceBound(path, CertifiedPeaks(path), world, queries);
    EXPECT_LE(bound, 2);
    EXPECT_GE(bound, last);
    last = bound;
  }
  EXPECT_NEAR(last, 2, 2e-3);
}

TEST(Certificate, OfAPartLooksAtThatPartOnly) {
  const AnalyticWorld world({{{5, 0, 0}, 1}}, {});
  const PolynomialTrajectory path = Straight({-10, 0, 0}, {10, 0, 0});
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  EXPECT_TRUE(Certify(path, peaks, world, 0.5, {0, 1.5}).certified);
  EXPECT_FALSE(Certify(path, peaks, world, 0.5, {1.5, 3}).certified);
}

TEST(SegmentIsClear, ExactlyWhereTheClosestPointOfTheSegmentIsFarEnough) {
  const AnalyticWorld world({{{0, 2, 0}, 1}}, {});
  EXPECT_TRUE(SegmentIsClear({-5, 0, 0}, {5, 0, 0}, world, 0.99));
  EXPECT_FALSE(SegmentIsClear({-5, 0, 0}, {5, 0, 0}, world, 1.01));
  EXPECT_TRUE(SegmentIsClear({3, 0, 0}, {3, 0, 0}, world, 1));
  EXPECT_FALSE(SegmentIsClear({0, 2, 0}, {0, 2, 0}, world, 0.1));
}

TEST(BoundedClearance, CountsTheSidesOfTheBox) {
  const AnalyticWorld empty({}, {});
  const BoundedClearance world(empty, {{-1, -2, -3}, {1, 2, 3}});
  EXPECT_EQ(world.Clearance({0, 0, 0}, 9), 1);
  EXPECT_EQ(world.Clearance({0, 1.75, 0}, 9), 0.25);
  EXPECT_EQ(world.Clearance({0, 2.5, 0}, 9), 0);
  EXPECT_EQ(world.LowerBound({0, 0, 0}, 9, 0.5), 0.5);
}

}  // namespace
}  // namespace airsim360
