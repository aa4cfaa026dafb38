// Every format is read back by a decoder of its own and evaluated against the trajectory.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/planning/export/export_crazyflie.h"
#include "airsim360/planning/export/export_qgc.h"
#include "airsim360/planning/export/export_text.h"
#include "airsim360/planning/export/npz.h"
#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/time_allocation.h"

namespace airsim360 {
namespace {

// A flight of about `length` metres within the paper's limits.
PolynomialTrajectory Flight(uint64_t seed, double length, SplineKind kind = SplineKind::kMinimumSnap) {
  RngStream rng(seed, "flight");
  std::vector<Vec3d> points = {{0, 0, 5}};
  for (int i = 0; i < 5; ++i) {
    const double yaw = rng.Uniform(0, 1.5), step = length / 5;
    points.push_back(points.back() + Vec3d{step * std::cos(yaw), step * std::sin(yaw), rng.Uniform(-2, 3)});
  }
  return AllocateTimes(points, {.speed = 16, .acceleration = 3}, {.kind = kind}).trajectory;
}

PlanRecord RecordOf(const PolynomialTrajectory& path) { return {.trajectory = path, .peaks = CertifiedPeaks(path)}; }

std::vector<std::vector<double>> ParseNumbers(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  for (size_t at = csv.find('\n') + 1; at < csv.size();) {
    const size_t end = csv.find('\n', at);
    rows.emplace_back();
    for (const char* p = csv.c_str() + at; p < csv.c_str() + end; ++p) {
      char* stop;
      rows.back().push_back(std::strtod(p, &stop));
      p = stop;
    }
    at = end + 1;
  }
  return rows;
}

TEST(Poly4d, ReadsBackExactlyAndFliesWithinAMillimetre) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const PolynomialTrajectory path =
        Flight(seed, 50 + 10 * static_cast<double>(seed), seed % 2 ? SplineKind::kPaperQuintic : SplineKind::kMinimumSnap);
    const Poly4dRows rows = ToPoly4d(path, ConstantYaw{0.3});
    const std::vector<Poly4d> back = ParsePoly4dCsv(Poly4dCsv(rows.rows), "test.csv");
    ASSERT_EQ(back.size(), rows.rows.size());
    for (size_t i = 0; i < back.size(); ++i) {
      EXPECT_EQ(back[i].duration, rows.rows[i].duration);
      for (int axis = 0; axis < 4; ++axis) {
        for (int k = 0; k < 8; ++k) EXPECT_EQ(back[i].p[axis][k], rows.rows[i].p[axis][k]);
      }
    }
    double worst = 0;
    for (int k = 0; k <= 10'000; ++k) {
      const double t = path.duration() * k / 10'000;
      worst = std::max(worst, Norm(EvaluatePoly4d(back, t) - path.At(t).p));
    }
    EXPECT_LT(worst, 1e-3) << seed;
  }
}

TEST(Poly4d, LongPiecesAreHalvedUntilSinglePrecisionIsEnough) {
  const Vec3d points[] = {{0, 0, 5}, {3000, 100, 50}};
  const double durations[] = {400};
  const PolynomialTrajectory path = SolveMinimumSnap({.waypoints = points, .durations = durations});
  const Poly4dRows coarse = ToPoly4d(path, ConstantYaw{}, 0.1), fine = ToPoly4d(path, ConstantYaw{}, 2e-3);
  EXPECT_LE(coarse.worst_error, 0.05);
  EXPECT_GE(fine.rows.size(), coarse.rows.size());
}

TEST(Poly4d, ErrorsNameThePlace) {
  const auto message = [](std::string_view text) -> std::string {
    try {
      ParsePoly4dCsv(text, "f.csv");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("h\n1,2\n").find("f.csv:2:"), std::string::npos);
  EXPECT_NE(message("h\nx\n").find("f.csv:2:1: not a finite"), std::string::npos);
  std::string row = "0";
  for (int i = 0; i < 32; ++i) row += ",0";
  EXPECT_NE(message("h\n" + row + "\n").find("positive"), std::string::npos);
}

TEST(Compressed, FliesWithinTwoMillimetresAtEveryTime) {
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const PolynomialTrajectory path = Flight(seed, 28, seed % 2 ? SplineKind::kPaperQuintic : SplineKind::kMinimumSnap);
    const Vec3d origin = path.At(0).p;
    const std::vector<uint8_t> bytes = CompressTrajectory(path, ConstantYaw{-1.2}, origin);
    const CompressedTrajectory back(bytes);
    EXPECT_NEAR(back.duration(), path.duration(), 5.1e-4);
    double worst = 0;
    for (int k = 0; k <= 10'000; ++k) {
      const double t = path.duration() * k / 10'000;
      const CompressedPoint point = back.At(t);
      worst = std::max(worst, Norm(point.p + origin - path.At(t).p));
      EXPECT_NEAR(point.yaw, -1.2, std::numbers::pi / 3600 + 1e-12);
    }
    EXPECT_LT(worst, 2e-3) << seed;
  }
}

TEST(Compressed, RefusesWhatItCannotHold) {
  EXPECT_THROW(CompressTrajectory(Flight(1, 150), ConstantYaw{}, {}), InputError);
  std::vector<uint8_t> bytes = CompressTrajectory(Flight(1, 20), ConstantYaw{}, {});
  bytes.pop_back();
  EXPECT_THROW(CompressedTrajectory{bytes}, InputError);
  EXPECT_THROW(CompressedTrajectory{std::vector<uint8_t>{}}, InputError);
}

// A level circle of four corners flown twice round: the heading turns through more than two whole turns.
PolynomialTrajectory Rounds() {
  std::vector<Vec3d> points;
  for (int i = 0; i <= 8; ++i) points.push_back({9 * std::cos(i * std::numbers::pi / 2), 9 * std::sin(i * std::numbers::pi / 2), 5});
  return AllocateTimes(points, {.speed = 6, .acceleration = 3}).trajectory;
}

double YawGap(double a, double b) { return std::fabs(std::remainder(a - b, 2 * std::numbers::pi)); }

TEST(Heading, AlongTheVelocityInEveryFormat) {
  const PolynomialTrajectory path = Rounds();
  const YawProfile yaw(path, YawAlongVelocity{});
  PlanRecord record = RecordOf(path);
  record.yaw = YawAlongVelocity{};

  // Crazyflie rows and their compressed form, half a degree; without a jump of a turn between pieces.
  const std::vector<Poly4d> rows = ToPoly4d(path, YawAlongVelocity{}).rows;
  const CompressedTrajectory compressed(CompressTrajectory(path, YawAlongVelocity{}, path.At(0).p));
  double from = 0, last = rows[0].p[3][0];
  for (const Poly4d& row : rows) {
    EXPECT_NEAR(row.p[3][0], last, 1e-3);
    for (int k = 0; k <= 20; ++k) {
      const double t = static_cast<double>(row.duration) * k / 20;
      double value = 0;
      for (int i = 8; i-- > 0;) value = value * t + static_cast<double>(row.p[3][i]);
      EXPECT_LT(YawGap(value, yaw.At(from + t)), 0.01);
      EXPECT_LT(YawGap(compressed.At(from + t).yaw, yaw.At(from + t)), 0.05);
      last = value;
    }
    from += static_cast<double>(row.duration);
  }
  EXPECT_GT(std::fabs(last - static_cast<double>(rows[0].p[3][0])), 3.5 * std::numbers::pi);

  // Samples: radians from east; MAVLink: from north, clockwise, with its rate.
  for (const auto& row : ParseNumbers(TrajectorySamplesCsv(record, 0.25))) {
    ASSERT_EQ(row.size(), 11u);
    EXPECT_LT(YawGap(row[10], yaw.At(row[0])), 1e-12);
  }
  const auto setpoints = ParseNumbers(MavlinkSetpointsCsv(record, 0.02));
  for (size_t i = 1; i + 1 < setpoints.size(); ++i) {
    EXPECT_LT(YawGap(setpoints[i][12], std::atan2(setpoints[i][7], setpoints[i][6])), 0.02);
    const double difference = std::remainder(setpoints[i + 1][12] - setpoints[i - 1][12], 2 * std::numbers::pi);
    if (i > 25 && i + 27 < setpoints.size()) {
      EXPECT_NEAR(setpoints[i][13], difference / 0.04, 0.1);
    }
  }
}

TEST(Heading, MissionsLookAtAPointIfAsked) {
  const PolynomialTrajectory path = Flight(5, 80);
  const std::string plan = QgcPlan(path, {.origin = {47.4, 8.5, 488}, .yaw = ConstantYaw{0}});
  EXPECT_NE(plan.find("\"params\": [0, 0, 0, 90, "), std::string::npos);  // east
  EXPECT_EQ(plan.find("null, 47"), std::string::npos);
}

TEST(Csv, SamplesAreTheTrajectoryToTheLastDigit) {
  const PolynomialTrajectory path = Flight(3, 60);
  const auto rows = ParseNumbers(TrajectorySamplesCsv(RecordOf(path), 0.5));
  ASSERT_GE(rows.size(), static_cast<size_t>(path.duration() / 0.5));
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 10u);
    const TrajectoryPoint point = path.At(row[0]);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(row[1 + axis], point.p[axis]);
      EXPECT_EQ(row[4 + axis], point.v[axis]);
      EXPECT_EQ(row[7 + axis], point.a[axis]);
    }
  }
  EXPECT_EQ(rows.back()[0], path.duration());
}

TEST(Mavlink, SetpointsAreNorthEastDownWithYawClockwiseFromNorth) {
  const PolynomialTrajectory path = Flight(4, 60);
  PlanRecord record = RecordOf(path);
  record.yaw = ConstantYaw{std::numbers::pi / 2};  // north
  const auto rows = ParseNumbers(MavlinkSetpointsCsv(record, 0.02));
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 14u);
    EXPECT_EQ(row[1], 1);  // MAV_FRAME_LOCAL_NED
    EXPECT_EQ(row[2], 0);
    const TrajectoryPoint point = path.At(row[0] / 1000);
    EXPECT_LT(Norm(Vec3d{row[4], row[3], -row[5]} - point.p), 16 * 5e-4 + 1e-9);
    EXPECT_LT(Norm(Vec3d{row[7], row[6], -row[8]} - point.v), 3 * 5e-4 + 1e-9);
    EXPECT_NEAR(row[12], 0, 1e-12);
  }
}

TEST(Qgc, WaypointsLieOnTheFlightAtMostTheirSpacingApart) {
  const PolynomialTrajectory path = Flight(5, 80);
  const QgcOptions options{.origin = {47.4, 8.5, 488}, .spacing = 4, .speed = 6};
  const std::string plan = QgcPlan(path, options);
  for (const char* key : {"\"fileType\": \"Plan\"", "\"plannedHomePosition\": [47.4, 8.5, 488]", "\"vehicleType\": 2",
                          "\"firmwareType\": 12", "\"command\": 22", "\"command\": 178", "\"command\": 21"})
    EXPECT_NE(plan.find(key), std::string::npos) << key;
  std::vector<Vec3d> places;
  for (size_t at = 0; (at = plan.find("\"params\": [0, 0, 0, null, ", at)) != std::string::npos; ++at) {
    double lat, lon, alt;
    ASSERT_EQ(std::sscanf(plan.c_str() + at, "\"params\": [0, 0, 0, null, %lf, %lf, %lf", &lat, &lon, &alt), 3);
    places.push_back(GeoFrame(options.origin).ToWorld({lat, lon, alt + 488}));
  }
  ASSERT_GT(places.size(), 20u);
  EXPECT_LT(Norm(places.front() - path.At(0).p), 1e-6);
  EXPECT_LT(Norm(places.back() - path.At(path.duration()).p), 1e-6);
  for (size_t i = 0; i + 1 < places.size(); ++i) EXPECT_LT(Norm(places[i + 1] - places[i]), 4.01);
}

TEST(Npz, ReadsBackExactlyAndRefusesDamage) {
  NpzWriter writer;
  const double values[] = {1.5, -2e300, 0.1, 4, 5, 6};
  const int64_t offsets[] = {0, 3, int64_t{1} << 40};
  writer.Add("values", values, {2, 3});
  writer.Add("offsets", offsets, {3});
  EXPECT_THROW(writer.Add("bad", values, {4}), InputError);
  std::string bytes = writer.Finish();
  const auto arrays = ReadNpz(bytes, "f.npz");
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].name, "values");
  EXPECT_EQ(arrays[0].shape, (std::vector<size_t>{2, 3}));
  EXPECT_TRUE(std::equal(values, values + 6, arrays[0].values.begin()));
  EXPECT_EQ(arrays[1].values[2], 0x1p40);
  bytes[140] = static_cast<char>(bytes[140] ^ 1);
  EXPECT_THROW(ReadNpz(bytes, "f.npz"), InputError);
  EXPECT_THROW(ReadNpz("PK", "f.npz"), InputError);
}

}  // namespace
}  // namespace airsim360
