#include "airsim360/rpc/session/airsim_drone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

constexpr double kAirSimPointsPerSecond = 100000;

double Given(double value, double otherwise) { return std::isnan(value) ? otherwise : value; }

// The sensors of a type that the settings name, or one with AirSim's default name.
template <class Visit>
void ForSensors(const AirSimSettings& settings, const VehicleSettings& vehicle, SensorType type, const char* default_name,
                const Visit& visit) {
  const auto& own = vehicle.sensors.empty() ? settings.default_sensors : vehicle.sensors;
  bool found = false;
  for (const auto& [name, sensor] : own) {
    if (sensor.type != type) continue;
    found = true;
    if (sensor.enabled) visit(name, sensor);
  }
  // Naming other sensors does not take the default ones away.
  if (!found && default_name != nullptr) visit(default_name, SensorSettings{.type = type, .pose = {}});
}

Mount AsMount(const RigidTransform& X_BS) {
  const GimbalAngles angles = AnglesOf(X_BS.R);
  return {X_BS.p, angles.yaw * kRadian, angles.pitch * kRadian, angles.roll * kRadian};
}

LidarSpec AsLidar(const SensorSettings& sensor, bool cosys) {
  LidarSpec spec;
  spec.mount = AsMount(MountOf(sensor.pose, {0, 0, 0, 0, 0, 0}));  // AirSim puts those of cars alone a metre higher
  spec.rate_hz = sensor.rotations_per_second;
  spec.channels = static_cast<uint64_t>(sensor.channels);
  constexpr int kCosysMeasurements = 512;
  const double points = Given(sensor.points_per_second, kAirSimPointsPerSecond);
  double shots = points / sensor.rotations_per_second / sensor.channels;
  if (cosys && std::isnan(sensor.points_per_second)) shots = kCosysMeasurements;
  if (sensor.measurements_per_cycle > 0) shots = sensor.measurements_per_cycle;
  spec.columns = static_cast<uint64_t>(std::clamp(std::round(shots), 1.0, 36000.0));
  spec.low_deg = std::min(sensor.vertical_fov_lower, sensor.vertical_fov_upper);
  spec.high_deg = std::max(sensor.vertical_fov_lower, sensor.vertical_fov_upper);
  // AirSim's azimuths go clockwise seen from above, ours to the left.
  spec.start_deg = -sensor.horizontal_fov_start;
  double sweep = sensor.horizontal_fov_end - sensor.horizontal_fov_start;
  if (sweep <= 0) sweep += 360;
  spec.sweep_deg = std::clamp(sweep >= 359 ? 360 : sweep, 0.1, 360.0);
  spec.min_range = 0.01;
  spec.max_range = sensor.range;
  spec.sigma = 0;
  return spec;
}

}  // namespace

DroneModel AirSimQuad() {
  constexpr double kArm = 0.2275, kRotorHeight = 0.025, kTopSpeed = 669.86, kThrust = 4.179446, kTorque = 0.055562;
  const double d = kArm * std::numbers::sqrt2 / 2;
  DroneModel model;
  model.name = "airsim_quad";
  model.mass = 1;
  model.inertia_B.m = {{{0.006721, 0, 0}, {0, 0.008041, 0}, {0, 0, 0.014279}}};
  // FR and RL turn counter-clockwise seen from above, their reaction is clockwise.
  const struct { double x, y, direction; } kPlaces[] = {{d, -d, -1}, {-d, d, -1}, {d, d, 1}, {-d, -d, 1}};
  for (const auto& place : kPlaces) {
    RotorModel rotor;
    rotor.p_B = {place.x, place.y, kRotorHeight};
    rotor.direction = place.direction;
    rotor.diameter = 0.2286;
    rotor.thrust_factor = kThrust / (kTopSpeed * kTopSpeed);
    rotor.torque_ratio = kTorque / kThrust;
    rotor.tau_up = rotor.tau_down = 0.005;
    rotor.max_speed = kTopSpeed;
    model.rotors.push_back(rotor);
  }
  // Drag of six faces, N/(m/s)^2: AirSim's factors times the density of air.
  model.quadratic_drag_B = Vec3d{0.005383, 0.005838, 0.10993} * kSeaLevelAirDensity;
  model.half_size_B = {0.09, 0.055, 0.02};
  return model;
}

RigidTransform MountOf(const SettingsPose& pose, const SettingsPose& otherwise) {
  const Vec3d p_F{Given(pose.x, Given(otherwise.x, 0)), Given(pose.y, Given(otherwise.y, 0)), Given(pose.z, Given(otherwise.z, 0))};
  // Yaw turns to the right, pitch and roll are as ours.
  return BodyPose(FrdFromBody(p_F), -Given(pose.yaw, Given(otherwise.yaw, 0)) * kDegree,
                  Given(pose.pitch, Given(otherwise.pitch, 0)) * kDegree, Given(pose.roll, Given(otherwise.roll, 0)) * kDegree);
}

RaySensors MakeRaySensors(const AirSimSettings& settings, const VehicleSettings& vehicle) {
  RaySensors sensors;
  for (const SensorType type : {SensorType::kLidar, SensorType::kGpuLidar}) {
    ForSensors(settings, vehicle, type, nullptr, [&](const std::string& name, const SensorSettings& s) {
      sensors.lidars.push_back({name, AsLidar(s, settings.cosys), s.sensor_local_frame, type == SensorType::kGpuLidar, s.noise_sigma,
                                s.noise_sigma * s.noise_scale});
    });
  }
  ForSensors(settings, vehicle, SensorType::kDistance, nullptr, [&](const std::string& name, const SensorSettings& s) {
    RangeFinderSpec spec;
    spec.mount = AsMount(MountOf(s.pose, {0, 0, 0, 0, 0, 0}));
    spec.beam_deg = 0;
    spec.min_range = s.min_distance;
    spec.max_range = s.max_distance;
    spec.sigma = spec.sigma_per_metre = 0;
    sensors.distances.push_back({name, spec});
  });
  return sensors;
}

DroneSetup MakeDroneSetup(const std::string& name, const AirSimSettings& settings, const VehicleSettings& vehicle,
                          const SimpleFlightGains& gains, const RigidTransform& X_WB) {
  DroneSetup setup;
  setup.name = name;
  setup.model = AirSimQuad();
  setup.autopilot.controller = ControllerKind::kSimpleFlight;
  setup.autopilot.control_dt = static_cast<double>(kControlStepNs) * 1e-9;
  setup.autopilot.simple_flight = gains;
  setup.contact = {.restitution = 0.55, .friction = 0.5};
  setup.crash_disarms = false;
  setup.X_WB = X_WB;
  SensorSet& set = setup.sensors;
  set = {};
  ForSensors(settings, vehicle, SensorType::kImu, "imu", [&](const std::string& sensor, const SensorSettings&) {
    set.imus.push_back({sensor, ImuSpec{.rate_hz = 333}});
  });
  ForSensors(settings, vehicle, SensorType::kGps, "gps", [&](const std::string& sensor, const SensorSettings&) {
    // AirSim's receiver knows its place exactly, 0.2 s late; eph and epv are what it reports.
    set.gnss.push_back({sensor, GnssSpec{.rate_hz = 50,
                                         .horizontal_sigma = 0,
                                         .vertical_sigma = 0,
                                         .velocity_sigma = 0,
                                         .correlation_time = 0,
                                         .latency = 0.2,
                                         .start_up = 1}});
  });
  ForSensors(settings, vehicle, SensorType::kBarometer, "barometer", [&](const std::string& sensor, const SensorSettings&) {
    set.barometers.push_back({sensor, {}});
  });
  ForSensors(settings, vehicle, SensorType::kMagnetometer, "magnetometer", [&](const std::string& sensor, const SensorSettings&) {
    set.magnetometers.push_back({sensor, {}});
  });
  return setup;
}

}  // namespace airsim360
