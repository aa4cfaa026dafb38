// IMU, GNSS, barometer, magnetometer and gimbal against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/sensors/sensor_set.h"

namespace airsim360 {
namespace {

void ExpectNear(Vec3d a, Vec3d b, double tolerance = 1e-12) { EXPECT_LT(Norm(a - b), tolerance); }

TEST(IdealImu, ReadsGravityUpwardsOnATiltedTableAndNothingInFreeFall) {
  BodyMotion motion;
  motion.body.X_WB = BodyPose({}, 0.3, 0.2, -0.4);
  const Vec3d f = IdealImu({}, motion, 0).specific_force;
  ExpectNear(motion.body.X_WB.R * f, {0, 0, kGravity});
  motion.a_WB = {0, 0, -kGravity};
  ExpectNear(IdealImu({}, motion, 0).specific_force, {});
}

TEST(IdealImu, OffTheCentreOfMassFeelsCentripetalAndTangentialAcceleration) {
  BodyMotion motion;
  motion.a_WB = {0, 0, -kGravity};
  motion.body.w_WB_B = {0, 0, 5};
  motion.alpha_WB_B = {0, 0, 3};
  const RigidTransform X_BS{{}, {0.2, 0, 0}};
  ExpectNear(IdealImu(X_BS, motion, 0).specific_force, {-0.2 * 25, 0.2 * 3, 0});
}

TEST(IdealImu, AgreesWithTheSecondDifferenceOfItsOwnPath) {
  // A body that turns at a constant rate about a skew axis while it accelerates.
  const Vec3d w{0.4, -1.1, 2.0}, a{0.5, 0.3, -0.2}, r{0.3, -0.1, 0.05};
  const Kinematics start{BodyPose({1, 2, 3}, 0.2, 0.1, 0.3), {}, w};
  const auto sensor_place = [&](double t) { return Extrapolate(start, t) * r + a * (t * t / 2); };
  const double h = 1e-3;
  const Vec3d a_WS = (sensor_place(h) - sensor_place(0) * 2.0 + sensor_place(-h)) / (h * h);
  const BodyMotion motion{start, a, {}};
  const Vec3d f = IdealImu({{}, r}, motion, 0).specific_force;
  ExpectNear(start.X_WB.R * f - Vec3d{0, 0, kGravity}, a_WS, 1e-5);
}

TEST(SampleImu, ReadingsAreLimitedToTheirRange) {
  ImuSpec spec;
  BodyMotion motion;
  motion.body.w_WB_B = {100, -100, 0};
  motion.a_WB = {5000, 0, 0};
  ImuState state = StartImu(spec, {});
  SampleImu(spec, {}, motion, 5'000'000, state);
  EXPECT_EQ(state.last.angular_velocity.x, spec.gyro_range);
  EXPECT_EQ(state.last.angular_velocity.y, -spec.gyro_range);
  EXPECT_EQ(state.last.specific_force.x, spec.accel_range);
}

TEST(SampleGnss, ReadingsAreLateByTheLatencyAndBelongToTheirMeasurement) {
  GnssSpec spec{.rate_hz = 10, .horizontal_sigma = 0, .vertical_sigma = 0, .velocity_sigma = 0};
  const GeoFrame frame({50, 10, 100});
  GnssState state = StartGnss(spec, {});
  for (int i = 1; i <= 20; ++i) {
    BodyMotion motion;
    const int64_t t_ns = i * 100'000'000;
    motion.body.X_WB.p = {static_cast<double>(i), 0, 0};  // 10 m/s east
    motion.body.v_WB = {10, 0, 0};
    SampleGnss(spec, {}, frame, motion, t_ns, state);
    EXPECT_EQ(state.last.has_fix, i > 2);
    if (i <= 2) continue;
    EXPECT_EQ(state.last.t_ns, t_ns);
    EXPECT_EQ(state.last.measured_ns, t_ns - 200'000'000);
    ExpectNear(state.last.p_WS, {static_cast<double>(i - 2), 0, 0});
    ExpectNear(frame.ToWorld(state.last.place), state.last.p_WS, 1e-7);
    ExpectNear(state.last.v_WS, {10, 0, 0});
  }
}

TEST(SampleGnss, ErrorHasTheSetSigmasAndCorrelation) {
  const GnssSpec spec{.rate_hz = 1, .horizontal_sigma = 1.5, .vertical_sigma = 3, .correlation_time = 10};
  const GeoFrame frame({0, 0, 0});
  GnssState state = StartGnss(spec, {});
  double east = 0, up = 0, lag = 0, last = 0;
  constexpr int kCount = 100'000;
  for (int i = 1; i <= kCount; ++i) {
    SampleGnss(spec, {}, frame, {}, i * int64_t{1'000'000'000}, state);
    east += state.error.x * state.error.x;
    up += state.error.z * state.error.z;
    lag += state.error.x * last;
    last = state.error.x;
  }
  // About kCount / (2 * 10) independent values: a few percent.
  EXPECT_NEAR(std::sqrt(east / kCount), 1.5, 0.06);
  EXPECT_NEAR(std::sqrt(up / kCount), 3, 0.12);
  EXPECT_NEAR(lag / east, std::exp(-0.1), 0.01);
}

TEST(SampleBarometer, WithoutNoiseShowsTheHeightOverSeaLevelInTheStandardAtmosphere) {
  BarometerSpec spec;
  spec.pressure = {};
  spec.mount.p_BS = {0, 0, 0.1};
  BarometerState state = StartBarometer(spec, {});
  SampleBarometer(spec, {}, {}, 250, kSeaLevelPressure, 20'000'000, state);
  EXPECT_NEAR(state.last.altitude, 250.1, 1e-9);
  EXPECT_NEAR(state.last.pressure, StandardAir(250.1).pressure, 1e-9);
  // A low of 10 hPa reads as about 84 m more with the standard QNH.
  SampleBarometer(spec, {}, {}, 250, kSeaLevelPressure - 1000, 40'000'000, state);
  EXPECT_NEAR(state.last.altitude - 250.1, 1000 / (1.2 * kGravity), 2);
}

TEST(SampleMagnetometer, TurnsWithTheBodyAndKeepsItsStrength) {
  MagnetometerSpec spec;
  spec.field = {};
  const MagneticField field{.strength = 50e-6, .declination_deg = 0, .inclination_deg = 60};
  ExpectNear(field.InWorld(), {0, 25e-6, -50e-6 * std::sqrt(3) / 2}, 1e-18);
  BodyMotion motion;
  motion.body.X_WB = BodyPose({}, kPi / 2, 0, 0);  // facing north
  MagnetometerState state = StartMagnetometer(spec, {});
  SampleMagnetometer(spec, {}, field.InWorld(), motion, 20'000'000, state);
  ExpectNear(state.last.field, {25e-6, 0, -50e-6 * std::sqrt(3) / 2}, 1e-18);
}

TEST(Gimbal, SteadyAxesHoldTheHorizonWhileTheBodyPitchesAndRolls) {
  const GimbalSpec spec;
  for (const double pitch : {-0.5, 0.0, 0.4}) {
    const RigidTransform X_WB = BodyPose({1, 2, 3}, 0.7, pitch, -0.3);
    const GimbalState state = StartGimbal(spec, {0.1, -0.6, 0}, X_WB.R);
    const Mat3d R_WG = X_WB.R * GimbalPose(spec, state).R;
    const Mat3d expected = BodyPose({}, 0.8, -0.6, 0).R;
    for (int j = 0; j < 3; ++j) ExpectNear(R_WG.column(j), expected.column(j));
  }
}

TEST(Gimbal, JointsTurnNoFasterThanTheirLimitAndArrive) {
  const GimbalSpec spec{.max_rate_deg = 90};
  GimbalState state = StartGimbal(spec, {}, Mat3d());
  state.command.pitch = -kPi / 2 + 0.01;
  for (int i = 0; i < 500; ++i) {
    const double before = state.joints.pitch;
    StepGimbal(spec, Mat3d(), 0.001, state);
    ASSERT_LE(std::abs(state.joints.pitch - before), kPi / 2 * 0.001 + 1e-15);
  }
  EXPECT_NEAR(state.joints.pitch, -kPi / 4, 1e-9);
  for (int i = 0; i < 600; ++i) StepGimbal(spec, Mat3d(), 0.001, state);
  EXPECT_NEAR(state.joints.pitch, state.command.pitch, 1e-12);
}

TEST(Gimbal, JointsStayWithinTheirLimits) {
  const GimbalSpec spec{.pitch_low_deg = -30, .pitch_high_deg = 10, .roll_limit_deg = 5};
  const GimbalState state = StartGimbal(spec, {0, 1.0, 0}, BodyPose({}, 0, 0, 0.5).R);
  EXPECT_LE(state.joints.pitch, 10 * kPi / 180 + 1e-12);
  EXPECT_GE(state.joints.roll, -5 * kPi / 180 - 1e-12);
}

TEST(AnglesOf, IsTheInverseOfBodyPose) {
  for (const GimbalAngles& a : {GimbalAngles{0.3, -0.7, 1.2}, GimbalAngles{-3, 1.4, -3}}) {
    const GimbalAngles b = AnglesOf(BodyPose({}, a.yaw, a.pitch, a.roll).R);
    EXPECT_NEAR(b.yaw, a.yaw, 1e-12);
    EXPECT_NEAR(b.pitch, a.pitch, 1e-12);
    EXPECT_NEAR(b.roll, a.roll, 1e-12);
  }
  const GimbalAngles up = AnglesOf(BodyPose({}, 0.5, kPi / 2, 0).R);
  EXPECT_NEAR(up.yaw, 0.5, 1e-9);
}

}  // namespace
}  // namespace airsim360
