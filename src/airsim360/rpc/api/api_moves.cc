// takeoff … moveByMotorPWMs: each starts a task and answers when it ends.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/wire/limits.h"

namespace airsim360 {
namespace {

using airsim::DrivetrainType;
using airsim::Seconds;
using airsim::YawMode;
using Text = const std::string&;

// AirSim's: how high a take-off goes and how fast, what counts as standing.
constexpr double kTakeoffHeight = 2, kTakeoffSpeed = 0.5, kHomeSpeed = 0.5, kHoverSpeed = 0.5;
constexpr double kForever = 3e38;

void CheckDrivetrain(DrivetrainType drivetrain) {
  if (drivetrain == DrivetrainType::kMaxDegreeOfFreedom || drivetrain == DrivetrainType::kForwardOnly) return;
  throw std::invalid_argument("drivetrain: " + std::to_string(static_cast<int>(drivetrain)) +
                              " is neither 0 (MaxDegreeOfFreedom) nor 1 (ForwardOnly)");
}

PathOptions Options(const Session& s, double velocity, DrivetrainType drivetrain, const YawMode& yaw, double lookahead,
                    double adaptive_lookahead) {
  CheckDrivetrain(drivetrain);
  return {velocity, drivetrain, yaw, lookahead, adaptive_lookahead, s.settings().slow_down};
}

// Starts what `make` builds of the drone as it is now.
template <class Make>
void Begin(Session& s, const Reply& reply, Text name, const Make& make) {
  VehicleControl& control = s.drone(name);
  const FlightView view = control.ViewOf(s.vehicle(control), s.state().t_ns);
  control.Start(make(view), s.state().t_ns, reply);
}

void Takeoff(Session& s, const Reply& reply, Seconds timeout_sec, Text vehicle) {
  Begin(s, reply, vehicle, [&](const FlightView& view) {
    const double speed = Norm(view.v_N);
    if (speed > kStillSpeed) {
      throw std::runtime_error("Cannot perform takeoff because vehicle is already moving with velocity " + std::to_string(speed) + " m/s");
    }
    const Vec3d above = view.p_N - Vec3d{0, 0, kTakeoffHeight};
    return MakePathTask(view, {above}, timeout_sec, Options(s, kTakeoffSpeed, DrivetrainType::kMaxDegreeOfFreedom, {true, 0}, -1, 1));
  });
}

// Says in the log that a drone is sent where it cannot come to: out of a room, below the ground, off the edge of the world.
void NoticeFarGoal(Session& s, const std::vector<Vec3d>& path_N, Text name) {
  const Box3f& bounds = s.objects().scene().bounds;
  const bool closed = s.objects().scene().sky_entity == kNoEntity;
  const VehicleStatus& status = s.drone(name).status();
  const Vec3d low = VecCast<double>(bounds.min) - status.origin_W, high = VecCast<double>(bounds.max) - status.origin_W;
  const auto is_out = [&](Vec3d p_N) {
    const Vec3d p = NedFromWorld(p_N);
    return p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || p.z < low.z || (closed && p.z > high.z);
  };
  if (bounds.empty() || std::ranges::none_of(path_N, is_out)) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "a goal of vehicle '%.80s' lies outside the world, which in its frame reaches from (%.1f, %.1f, %.1f) to "
                "(%.1f, %.1f, %.1f): it may never come there",
                status.name.c_str(), low.y, low.x, -low.z, high.y, high.x, -high.z);
  NoticeOnce(text);
}

void MoveTo(Session& s, const Reply& reply, const std::vector<Vec3d>& path, double timeout, const PathOptions& options, Text vehicle) {
  NoticeFarGoal(s, path, vehicle);
  Begin(s, reply, vehicle, [&](const FlightView& view) { return MakePathTask(view, path, timeout, options); });
}

void AddPathCalls(Api& api) {
  api.Start("moveOnPath", [](Session& s, const Reply& reply, const std::vector<airsim::Vector3r>& path, float velocity, Seconds timeout_sec,
                             DrivetrainType drivetrain, const YawMode& yaw, float lookahead, float adaptive_lookahead, Text vehicle) {
    std::vector<Vec3d> points;
    for (const airsim::Vector3r& point : path) points.push_back(airsim::FromVector(point));
    MoveTo(s, reply, points, timeout_sec, Options(s, velocity, drivetrain, yaw, lookahead, adaptive_lookahead), vehicle);
  });
  api.Start("moveToPosition", [](Session& s, const Reply& reply, float x, float y, float z, float velocity, Seconds timeout_sec,
                                 DrivetrainType drivetrain, const YawMode& yaw, float lookahead, float adaptive_lookahead, Text vehicle) {
    MoveTo(s, reply, {{x, y, z}}, timeout_sec, Options(s, velocity, drivetrain, yaw, lookahead, adaptive_lookahead), vehicle);
  });
  api.Start("moveToGPS",
            [](Session& s, const Reply& reply, double latitude, double longitude, float altitude, float velocity, Seconds timeout_sec,
               DrivetrainType drivetrain, const YawMode& yaw, float lookahead, float adaptive_lookahead, Text vehicle) {
              CheckPlaceOnEarth(latitude, longitude);
              const Vec3d p_W = s.earth().ToWorld({latitude, longitude, altitude});
              const Vec3d p_N = NedFromWorld(p_W - s.drone(vehicle).status().origin_W);
              MoveTo(s, reply, {p_N}, timeout_sec, Options(s, velocity, drivetrain, yaw, lookahead, adaptive_lookahead), vehicle);
            });
  api.Start("moveToZ", [](Session& s, const Reply& reply, float z, float velocity, Seconds timeout_sec, const YawMode& yaw, float lookahead,
                          float adaptive_lookahead, Text vehicle) {
    const VehicleControl& control = s.drone(vehicle);
    Vec3d p_N = control.ViewOf(s.vehicle(control), s.state().t_ns).p_N;
    p_N.z = z;
    MoveTo(s, reply, {p_N}, timeout_sec, Options(s, velocity, DrivetrainType::kMaxDegreeOfFreedom, yaw, lookahead, adaptive_lookahead),
           vehicle);
  });
}

void AddWholeCalls(Api& api) {
  api.Start("takeoff", [](Session& s, const Reply& reply, Seconds timeout_sec, Text vehicle) { Takeoff(s, reply, timeout_sec, vehicle); });
  api.Start("land", [](Session& s, const Reply& reply, Seconds timeout_sec, Text vehicle) {
    Begin(s, reply, vehicle, [&](const FlightView&) { return MakeLandTask(timeout_sec); });
  });
  api.Start("goHome", [](Session& s, const Reply& reply, Seconds timeout_sec, Text vehicle) {
    MoveTo(s, reply, {Vec3d{}}, timeout_sec, Options(s, kHomeSpeed, DrivetrainType::kMaxDegreeOfFreedom, {true, 0}, -1, 1), vehicle);
  });
  api.Start("hover", [](Session& s, const Reply& reply, Text vehicle) {
    const VehicleControl& control = s.drone(vehicle);
    const Vec3d p_N = control.ViewOf(s.vehicle(control), s.state().t_ns).p_N;
    MoveTo(s, reply, {p_N}, kForever, Options(s, kHoverSpeed, DrivetrainType::kMaxDegreeOfFreedom, {true, 0}, 1, 0), vehicle);
  });
  api.Start("rotateToYaw", [](Session& s, const Reply& reply, float yaw, Seconds timeout_sec, float margin, Text vehicle) {
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      TaskPointer task = MakeRotateTask(view, yaw, margin, timeout_sec, s.settings().wrap_yaw);
      task->result_at_timeout = timeout_sec <= 0;
      return task;
    });
  });
  api.Start("rotateByYawRate", [](Session& s, const Reply& reply, float yaw_rate, Seconds duration, Text vehicle) {
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      return MakeTimedTask(NedPosition(view.p_N, {true, yaw_rate}, view.origin_W), duration);
    });
  });
  api.Start("moveByManual", [](Session& s, const Reply& reply, float vx_max, float vy_max, float z_min, Seconds duration,
                               DrivetrainType drivetrain, const YawMode& yaw, Text vehicle) {
    CheckDrivetrain(drivetrain);
    Begin(s, reply, vehicle,
          [&](const FlightView& view) { return MakeManualTask(view, vx_max, vy_max, z_min, duration, drivetrain, yaw); });
  });
}

// A velocity in the frame of the heading that the drone has now.
Vec3d FromHeading(const FlightView& view, double vx, double vy) {
  const double yaw = view.yaw_deg * 3.14159265358979323846 / 180, c = std::cos(yaw), sn = std::sin(yaw);
  return {vx * c - vy * sn, vx * sn + vy * c, 0};
}

void AddVelocityCalls(Api& api) {
  api.Start("moveByVelocity", [](Session& s, const Reply& reply, float vx, float vy, float vz, Seconds duration, DrivetrainType drivetrain,
                                 const YawMode& yaw, Text vehicle) {
    CheckDrivetrain(drivetrain);
    Begin(s, reply, vehicle, [&](const FlightView&) {
      return MakeTimedTask(NedVelocity({vx, vy, vz}, AdjustYaw({vx, vy, 0}, drivetrain, yaw)), duration);
    });
  });
  api.Start("moveByVelocityZ", [](Session& s, const Reply& reply, float vx, float vy, float z, Seconds duration, DrivetrainType drivetrain,
                                  const YawMode& yaw, Text vehicle) {
    CheckDrivetrain(drivetrain);
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      TaskPointer task = MakeTimedTask(NedVelocityZ(vx, vy, z, AdjustYaw({vx, vy, 0}, drivetrain, yaw), view.origin_W), duration);
      // The one move whose answer to no time at all is False.
      if (duration <= 0) task->result_at_timeout = false;
      return task;
    });
  });
  api.Start("moveByVelocityBodyFrame", [](Session& s, const Reply& reply, float vx, float vy, float vz, Seconds duration,
                                          DrivetrainType drivetrain, const YawMode& yaw, Text vehicle) {
    CheckDrivetrain(drivetrain);
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      const Vec3d v_N = FromHeading(view, vx, vy);
      return MakeTimedTask(NedVelocity({v_N.x, v_N.y, vz}, AdjustYaw(v_N, drivetrain, yaw)), duration);
    });
  });
  api.Start("moveByVelocityZBodyFrame", [](Session& s, const Reply& reply, float vx, float vy, float z, Seconds duration,
                                           DrivetrainType drivetrain, const YawMode& yaw, Text vehicle) {
    CheckDrivetrain(drivetrain);
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      const Vec3d v_N = FromHeading(view, vx, vy);
      return MakeTimedTask(NedVelocityZ(v_N.x, v_N.y, z, AdjustYaw(v_N, drivetrain, yaw), view.origin_W), duration);
    });
  });
}

// roll, pitch, yaw or its rate, then a throttle or z: one function for the four of them.
void AddAttitudeCall(Api& api, const char* name, bool yaw_is_rate, bool is_throttle) {
  api.Start(name, [=](Session& s, const Reply& reply, float roll, float pitch, float yaw, float vertical, Seconds duration, Text vehicle) {
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      const double value = is_throttle ? std::clamp(vertical, 0.0f, 1.0f) : vertical;
      return MakeTimedTask(FrdAttitude(roll, pitch, yaw, yaw_is_rate, {is_throttle, value}, view.origin_W), duration);
    });
  });
}

void AddRateCall(Api& api, const char* name, bool is_throttle) {
  api.Start(name, [=](Session& s, const Reply& reply, float roll_rate, float pitch_rate, float yaw_rate, float vertical, Seconds duration,
                      Text vehicle) {
    Begin(s, reply, vehicle, [&](const FlightView& view) {
      const double value = is_throttle ? std::clamp(vertical, 0.0f, 1.0f) : vertical;
      return MakeTimedTask(FrdRates({roll_rate, pitch_rate, yaw_rate}, {is_throttle, value}, view.origin_W), duration);
    });
  });
}

}  // namespace

void AddMoveCalls(Api& api) {
  AddWholeCalls(api);
  AddPathCalls(api);
  AddVelocityCalls(api);
  AddAttitudeCall(api, "moveByRollPitchYawZ", false, false);
  AddAttitudeCall(api, "moveByRollPitchYawThrottle", false, true);
  AddAttitudeCall(api, "moveByRollPitchYawrateThrottle", true, true);
  AddAttitudeCall(api, "moveByRollPitchYawrateZ", true, false);
  AddRateCall(api, "moveByAngleRatesZ", false);
  AddRateCall(api, "moveByAngleRatesThrottle", true);
  api.Start("moveByMotorPWMs", [](Session& s, const Reply& reply, float front_right, float rear_left, float front_left, float rear_right,
                                  Seconds duration, Text vehicle) {
    const auto signal = [](float pwm) { return static_cast<double>(std::clamp(pwm, 0.0f, 1.0f)); };
    Begin(s, reply, vehicle, [&](const FlightView&) {
      return MakeTimedTask(MotorSignals({signal(front_right), signal(rear_left), signal(front_left), signal(rear_right)}), duration);
    });
  });
}

}  // namespace airsim360
