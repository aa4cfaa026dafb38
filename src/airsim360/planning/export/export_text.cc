#include "airsim360/planning/export/export_text.h"

#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/planning/number_text.h"

namespace airsim360 {
namespace {

void AppendVector(std::string& out, Vec3d v, const char* separator) {
  const double values[] = {v.x, v.y, v.z};
  AppendNumbers(out, values, separator);
}

// "name": value, on a line of its own.
void AppendField(std::string& out, const char* name, double value) {
  out += std::string("  \"") + name + "\": ";
  AppendNumber(out, value);
  out += ",\n";
}

void AppendList(std::string& out, std::span<const double> values) {
  out += '[';
  AppendNumbers(out, values, ", ");
  out += ']';
}

/// Powers of the heading in every segment; neighbours meet without a jump of a turn.
std::vector<std::array<double, 8>> YawSegments(const PolynomialTrajectory& path, const YawProfile& yaw) {
  std::vector<std::array<double, 8>> segments;
  double at_end = yaw.At(0);
  for (size_t i = 0; i < path.segments(); ++i) {
    const double duration = path.durations()[i];
    segments.push_back(yaw.Powers(path.start(i), duration, at_end));
    at_end = 0;
    for (size_t k = 8; k-- > 0;) at_end = at_end * duration + segments.back()[k];
  }
  return segments;
}

// A sum of short decimals is one.
double TimeOf(const PlanRecord& plan, double t) {
  constexpr double kGrid = 1e12;  // of a second
  const double sum = plan.start_time + t;
  return plan.start_time == 0 || std::fabs(sum) > 1e3 ? sum : std::round(sum * kGrid) / kGrid;
}

}  // namespace

std::string TrajectorySamplesCsv(const PlanRecord& plan, double interval) {
  const YawProfile yaw(plan.trajectory, plan.yaw);
  std::string out = "t_s,px,py,pz,vx,vy,vz,ax,ay,az";
  out += yaw.is_constant() ? "\n" : ",yaw\n";
  for (const double t : SampleTimes(plan.trajectory.duration(), interval)) {
    const TrajectoryPoint point = plan.trajectory.At(t);
    AppendNumber(out, TimeOf(plan, t));
    for (const Vec3d v : {point.p, point.v, point.a}) {
      out += ',';
      AppendVector(out, v, ",");
    }
    if (!yaw.is_constant()) {
      out += ',';
      AppendNumber(out, yaw.At(t));
    }
    out += '\n';
  }
  return out;
}

std::string TrajectoryJson(const PlanRecord& plan) {
  const PolynomialTrajectory& path = plan.trajectory;
  std::string out = "{\n";
  AppendField(out, "order", path.degree());
  AppendField(out, "duration", path.duration());
  std::vector<double> times = {plan.start_time};
  for (size_t i = 0; i < path.segments(); ++i) times.push_back(plan.start_time + path.start(i) + path.durations()[i]);
  out += "  \"times\": ";
  AppendList(out, times);
  out += ",\n  \"durations\": ";
  AppendList(out, path.durations());
  out += ",\n  \"waypoints\": [";
  std::vector<Vec3d> waypoints = plan.waypoints;
  for (size_t i = 0; plan.waypoints.empty() && i <= path.segments(); ++i)
    waypoints.push_back(path.At(i < path.segments() ? path.start(i) : path.duration()).p);
  for (size_t i = 0; i < waypoints.size(); ++i) {
    out += i > 0 ? ", [" : "[";
    AppendVector(out, waypoints[i], ", ");
    out += ']';
  }
  out += "],\n  \"coefficients\": [\n";
  for (size_t i = 0; i < path.segments(); ++i) {
    out += "    [";
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) out += ",\n     ";
      AppendList(out, path.coefficients(i, axis));
    }
    out += i + 1 < path.segments() ? "],\n" : "]\n";
  }
  out += "  ],\n";
  AppendField(out, "cost_snap", plan.cost_snap);
  AppendField(out, "max_speed", plan.peaks.speed.value);
  AppendField(out, "max_speed_time", plan.start_time + plan.peaks.speed.time);
  AppendField(out, "max_acceleration", plan.peaks.acceleration.value);
  AppendField(out, "max_acceleration_time", plan.start_time + plan.peaks.acceleration.time);
  if (plan.lower_bound > 0) AppendField(out, "time_lower_bound", plan.lower_bound);
  const YawProfile yaw(path, plan.yaw);
  if (yaw.is_constant()) {
    AppendField(out, "yaw", yaw.At(0));
  } else {
    out += "  \"yaw_coefficients\": [";
    for (const auto& powers : YawSegments(path, yaw)) {
      out += out.back() == '[' ? "\n    " : ",\n    ";
      AppendList(out, powers);
    }
    out += "],\n";
  }
  if (plan.certificate) {
    AppendField(out, "radius", plan.radius);
    out += std::string("  \"collision_free\": ") + (plan.certificate->certified ? "true" : "false") + ",\n";
    if (plan.certificate->certified) {
      AppendField(out, "least_clearance_bound", plan.certificate->least_clearance);
    } else {
      AppendField(out, "violation_time", plan.start_time + plan.certificate->violation_time);
    }
  }
  out += "  \"frame\": \"W: x east, y north, z up; metres, seconds\"\n}\n";
  return out;
}

std::string PolynomialTrajectoryYaml(const PlanRecord& plan) {
  const PolynomialTrajectory& path = plan.trajectory;
  std::string out =
      "# mav_planning_msgs/PolynomialTrajectory\nheader: {seq: 0, stamp: {secs: 0, nsecs: 0}, frame_id: "
      "world}\nsegments:\n";
  const char* names[] = {"x", "y", "z"};
  const YawProfile profile(path, plan.yaw);
  const auto yaws = YawSegments(path, profile);
  const size_t powers = profile.is_constant() ? static_cast<size_t>(path.degree()) + 1 : 8;
  for (size_t i = 0; i < path.segments(); ++i) {
    out += "- num_coeffs: " + std::to_string(powers) + "\n  segment_time: ";
    AppendNumber(out, path.durations()[i]);
    for (int axis = 0; axis < 3; ++axis) {
      out += std::string("\n  ") + names[axis] + ": ";
      const auto c = path.coefficients(i, axis);
      std::vector<double> padded(c.begin(), c.end());
      padded.resize(powers);
      AppendList(out, padded);
    }
    out += "\n  yaw: ";
    AppendList(out, std::span(yaws[i]).first(powers));
    out += '\n';
  }
  return out;
}

std::string MavlinkSetpointsCsv(const PlanRecord& plan, double interval) {
  std::string out = "time_boot_ms,coordinate_frame,type_mask,x,y,z,vx,vy,vz,afx,afy,afz,yaw,yaw_rate\n";
  constexpr double kStep = 1e-3;  // s, of the rate's difference
  const YawProfile yaw(plan.trajectory, plan.yaw);
  for (const double t : SampleTimes(plan.trajectory.duration(), interval)) {
    const TrajectoryPoint point = plan.trajectory.At(t);
    out += std::to_string(std::llround(t * 1000)) + ",1,0";
    for (const Vec3d v : {point.p, point.v, point.a}) {
      out += ',';
      AppendVector(out, {v.y, v.x, -v.z}, ",");
    }
    out += ',';
    AppendNumber(out, std::remainder(std::numbers::pi / 2 - yaw.At(t), kTau));
    out += ',';
    // Anticlockwise seen from above is negative in NED; 0.0 instead of -0.
    AppendNumber(out, 0.0 - std::remainder(yaw.At(t + kStep) - yaw.At(t - kStep), kTau) / (2 * kStep));
    out += '\n';
  }
  return out;
}

}  // namespace airsim360
