#include "airsim360/planning/export_text.h"

#include <cmath>
#include <numbers>

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

}  // namespace

std::string TrajectorySamplesCsv(const PlanRecord& plan, double interval) {
  std::string out = "t_s,px,py,pz,vx,vy,vz,ax,ay,az\n";
  for (const double t : SampleTimes(plan.trajectory.duration(), interval)) {
    const TrajectoryPoint point = plan.trajectory.At(t);
    AppendNumber(out, plan.start_time + t);
    for (const Vec3d v : {point.p, point.v, point.a}) {
      out += ',';
      AppendVector(out, v, ",");
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
  for (size_t i = 0; i < path.segments(); ++i)
    times.push_back(plan.start_time + path.start(i) + path.durations()[i]);
  out += "  \"times\": ";
  AppendList(out, times);
  out += ",\n  \"durations\": ";
  AppendList(out, path.durations());
  out += ",\n  \"waypoints\": [";
  for (size_t i = 0; i <= path.segments(); ++i) {
    out += i > 0 ? ", [" : "[";
    AppendVector(out, path.At(i < path.segments() ? path.start(i) : path.duration()).p, ", ");
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
  AppendField(out, "yaw", plan.yaw);
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
  for (size_t i = 0; i < path.segments(); ++i) {
    out += "- num_coeffs: " + std::to_string(path.degree() + 1) + "\n  segment_time: ";
    AppendNumber(out, path.durations()[i]);
    for (int axis = 0; axis < 3; ++axis) {
      out += std::string("\n  ") + names[axis] + ": ";
      AppendList(out, path.coefficients(i, axis));
    }
    std::vector<double> yaw(static_cast<size_t>(path.degree() + 1), 0.0);
    yaw[0] = plan.yaw;
    out += "\n  yaw: ";
    AppendList(out, yaw);
    out += '\n';
  }
  return out;
}

std::string MavlinkSetpointsCsv(const PlanRecord& plan, double interval) {
  std::string out = "time_boot_ms,coordinate_frame,type_mask,x,y,z,vx,vy,vz,afx,afy,afz,yaw,yaw_rate\n";
  const double yaw = std::remainder(std::numbers::pi / 2 - plan.yaw, 2 * std::numbers::pi);
  for (const double t : SampleTimes(plan.trajectory.duration(), interval)) {
    const TrajectoryPoint point = plan.trajectory.At(t);
    out += std::to_string(std::llround(t * 1000)) + ",1,0";
    for (const Vec3d v : {point.p, point.v, point.a}) {
      out += ',';
      AppendVector(out, {v.y, v.x, -v.z}, ",");
    }
    out += ',';
    AppendNumber(out, yaw);
    out += ",0\n";
  }
  return out;
}

}  // namespace airsim360
