// Range finder and lidar in the analytic room: x = +-5, y = +-5, z = 0 … 6, a cube of 1 m at (3, 0, 0.5).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/sensors/lidar.h"
#include "airsim360/sensors/range_finder.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

const RayTracer& Room() {
  static const RayTracer tracer(BuildWorld("box_room", {}));
  return tracer;
}

// Where a ray enters (from outside) or leaves (from inside) a box; infinite if it misses.
double BoxRange(Vec3d p, Vec3d d, Vec3d low, Vec3d high) {
  double in = -1e300, out = 1e300;
  for (int i = 0; i < 3; ++i) {
    const double a = (low[i] - p[i]) / d[i], b = (high[i] - p[i]) / d[i];
    if (d[i] == 0) continue;
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  if (in > out || out < 0) return std::numeric_limits<double>::infinity();
  return in > 0 ? in : out;
}

double RoomRange(Vec3d p, Vec3d d) {
  return std::min(BoxRange(p, d, {-5, -5, 0}, {5, 5, 6}), BoxRange(p, d, {2.5, -0.5, 0}, {3.5, 0.5, 1}));
}

const std::string& EntityName(EntityId id) { return Room().scene().entity(id).name; }

TEST(MeasureRange, OfASingleRayIsTheClosedFormAndNamesTheSurface) {
  const RangeFinderSpec spec{.beam_deg = 0, .sigma = 0, .sigma_per_metre = 0};
  const RigidTransform X_WB = BodyPose({1, -2, 3}, 0, 0, 0);
  const RangeReading down = MeasureRange(spec, {}, Room(), X_WB * spec.mount.pose(), 0);
  EXPECT_TRUE(down.valid);
  EXPECT_NEAR(down.range, 3, 1e-6);
  EXPECT_EQ(EntityName(down.entity), "floor");
  const RangeReading ahead = MeasureRange(spec, {}, Room(), X_WB, 0);
  EXPECT_NEAR(ahead.range, 4, 1e-6);
  EXPECT_EQ(EntityName(ahead.entity), "wall east");
}

TEST(MeasureRange, OfABeamIsTheNearestInTheConeAndLimitedToItsReach) {
  // Beside the cube the axis meets the floor at 2 m; a wide beam finds the cube's edge.
  RangeFinderSpec spec{.beam_deg = 60, .sigma = 0, .sigma_per_metre = 0};
  const RigidTransform X_WS = BodyPose({2.2, 0, 2}, 0, 0, 0) * spec.mount.pose();
  const RangeReading wide = MeasureRange(spec, {}, Room(), X_WS, 0);
  EXPECT_LT(wide.range, 1.3);
  EXPECT_GE(wide.range, std::hypot(0.3, 1.0) - 1e-6);
  EXPECT_EQ(EntityName(wide.entity), "box");
  spec.max_range = 0.9;
  const RangeReading none = MeasureRange(spec, {}, Room(), X_WS, 0);
  EXPECT_FALSE(none.valid);
  EXPECT_EQ(none.range, 0.9);
}

TEST(MeasureRange, NoiseHasTheSetSigma) {
  const RangeFinderSpec spec{.beam_deg = 0, .sigma = 0.03, .sigma_per_metre = 0.01};
  double sum = 0, squares = 0;
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    const double error = MeasureRange(spec, {}, Room(), BodyPose({1, 0.7, 3}, 0, 0, 0), i * int64_t{1000}).range - 4;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kCount, 0, 4 * 0.05 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.05, 0.002);
}

TEST(ScanLidar, RangesAreTheClosedFormOfTheRoom) {
  LidarSpec spec{.channels = 32, .columns = 360, .low_deg = -80, .high_deg = 80, .min_range = 0, .sigma = 0};
  const Kinematics body{BodyPose({0.3, -0.4, 2.1}, 0.5, 0.1, -0.2), {}, {}};
  LidarScan scan;
  ScanLidar(spec, {}, Room(), body, {{}, {0, 0, 0.1}}, 100'000'000, scan);
  ASSERT_EQ(scan.points.size(), spec.shots());  // a closed room: every shot meets something
  const std::vector<Vec3f> directions = LidarDirections(spec, 1);
  for (const LidarPoint& point : scan.points) {
    const Vec3d d = scan.X_WS.R * VecCast<double>(directions[point.shot]);
    ASSERT_NEAR(point.range, RoomRange(scan.X_WS.p, d), 2e-5) << point.shot;
    const Vec3d hit = scan.X_WS * VecCast<double>(point.p_S);
    // The category and entity are those of the face where the point lies.
    const bool on_cube = std::abs(hit.x - 3) < 0.501 && std::abs(hit.y) < 0.501 && hit.z > 1e-4 && hit.z < 1.001;
    ASSERT_EQ(EntityName(point.entity) == "box", on_cube) << point.shot;
    ASSERT_EQ(point.category, Room().scene().entity(point.entity).category);
  }
}

TEST(ScanLidar, IntensityIsReflectanceTimesTheCosineOfIncidence) {
  LidarSpec spec{.channels = 1, .columns = 90, .low_deg = 0, .high_deg = 0, .start_deg = 40, .sweep_deg = 80, .min_range = 0, .sigma = 0};
  const Kinematics body{BodyPose({0, 0, 3}, 0, 0, 0), {}, {}};
  LidarScan scan;
  ScanLidar(spec, {}, Room(), body, {}, 0, scan);
  const float paint = (0.25f + 0.55f + 0.32f) / 3;  // of the east wall
  ASSERT_EQ(scan.points.size(), 90u);
  for (const LidarPoint& point : scan.points) {
    ASSERT_EQ(EntityName(point.entity), "wall east");
    ASSERT_NEAR(point.intensity, paint * 5 / point.range, 1e-5);
  }
}

TEST(ScanLidar, IsTheSameForAnyNumberOfThreads) {
  const LidarSpec spec{.channels = 64, .columns = 500, .low_deg = -40, .high_deg = 40, .dropout = 0.1};
  const Kinematics body{BodyPose({0, 1, 2}, 0.2, 0, 0), {1, 2, 0}, {0, 0, 1}};
  LidarScan a, b;
  ScanLidar(spec, {}, Room(), body, {}, 300'000'000, a);
  const ThreadLimit one(1);
  ScanLidar(spec, {}, Room(), body, {}, 300'000'000, b);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_EQ(a.points[i].p_S, b.points[i].p_S);
    ASSERT_EQ(a.points[i].shot, b.points[i].shot);
  }
  // A tenth is lost, within four standard errors.
  const double kept = static_cast<double>(a.points.size()) / 32000;
  EXPECT_NEAR(kept, 0.9, 4 * std::sqrt(0.09 / 32000) + 1e-3);
}

TEST(ScanLidar, MotionDistortionPutsEachShotWhereTheSensorWasAtItsTime) {
  LidarSpec spec{.channels = 4, .columns = 100, .low_deg = -20, .high_deg = 20, .min_range = 0, .sigma = 0};
  spec.motion_distortion = true;
  const Kinematics body{BodyPose({0, 0, 3}, 0, 0, 0), {8, 0, 0}, {0, 0, 2}};
  const RigidTransform X_BS{{}, {0.1, 0, 0}};
  LidarScan scan;
  ScanLidar(spec, {}, Room(), body, X_BS, 0, scan);
  const std::vector<Vec3f> directions = LidarDirections(spec, 0);
  ASSERT_EQ(scan.points.size(), 400u);
  EXPECT_EQ(scan.points.back().time, 0);
  EXPECT_NEAR(scan.points.front().time, -0.1 * 99 / 100, 1e-7);
  for (const LidarPoint& point : scan.points) {
    const RigidTransform X_WS = Extrapolate(body, point.time) * X_BS;
    const Vec3d d = X_WS.R * VecCast<double>(directions[point.shot]);
    ASSERT_NEAR(point.range, RoomRange(X_WS.p, d), 5e-5) << point.shot;
  }
}

TEST(LidarDirections, RosetteStaysInItsConeAndLaterScansFillOtherPlaces) {
  const LidarSpec spec{.pattern = "rosette", .channels = 1, .columns = 2000, .field_deg = 38.4};
  const std::vector<Vec3f> a = LidarDirections(spec, 0), b = LidarDirections(spec, 1);
  const float edge = static_cast<float>(std::cos(19.2 * std::numbers::pi / 180));
  float nearest = 1;
  for (const Vec3f& d : a) {
    ASSERT_GE(d.x, edge - 1e-6f);
    ASSERT_NEAR(Norm(d), 1, 1e-6);
    nearest = std::min(nearest, Norm(d - b[1000]));
  }
  EXPECT_GT(nearest, 0);
}

TEST(LidarSpec, NonsenseIsRefused) {
  EXPECT_THROW((LidarSpec{.pattern = "spining"}.Check()), InputError);
  EXPECT_THROW((LidarSpec{.channels = 0}.Check()), InputError);
  EXPECT_THROW((LidarSpec{.channels = uint64_t{1} << 40, .columns = uint64_t{1} << 40}.Check()), InputError);
}

}  // namespace
}  // namespace airsim360
