#include "airsim360/app/plan/plan_output.h"

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/planning/export/export_crazyflie.h"
#include "airsim360/planning/export/npz.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr double kSetpointInterval = 0.02;  // seconds: PX4 wants more than 2 Hz, and 50 is usual
constexpr double kMissionSpacing = 5;       // metres between waypoints of a mission

struct Format {
  const char* name;
  const char* extension;  // of its file beside others
};
constexpr Format kFormats[] = {{"csv", ".csv"},
                               {"json", ".json"},
                               {"npz", ".npz"},
                               {"yaml", ".yaml"},
                               {"crazyflie", ".poly4d.csv"},
                               {"crazyflie-compressed", ".poly4d.bin"},
                               {"qgc", ".plan"},
                               {"mavlink", ".setpoints.csv"},
                               {"svg", ".svg"}};

std::string Npz(const PlanRecord& plan, double interval) {
  const PolynomialTrajectory& path = plan.trajectory;
  std::vector<double> times, samples;
  for (const double t : SampleTimes(path.duration(), interval)) {
    const TrajectoryPoint point = path.At(t);
    times.push_back(plan.start_time + t);
    for (const Vec3d v : {point.p, point.v, point.a}) samples.insert(samples.end(), {v.x, v.y, v.z});
  }
  const double peaks[] = {plan.peaks.speed.value, plan.peaks.acceleration.value};
  NpzWriter npz;
  npz.Add("durations", path.durations(), {path.segments()});
  npz.Add("coefficients", path.coefficients(), {path.segments(), 3, static_cast<size_t>(path.degree()) + 1});
  npz.Add("t", times, {times.size()});
  npz.Add("samples", samples, {times.size(), 3, 3});
  npz.Add("max_speed_acceleration", peaks, {2});
  return npz.Finish();
}

std::string Encode(const std::string& format, const PlanRecord& plan, const PlanOutput& output) {
  if (format == "csv") return TrajectorySamplesCsv(plan, output.interval);
  if (format == "json") return TrajectoryJson(plan);
  if (format == "npz") return Npz(plan, output.interval);
  if (format == "yaml") return PolynomialTrajectoryYaml(plan);
  if (format == "mavlink") return MavlinkSetpointsCsv(plan, kSetpointInterval);
  if (format == "svg") return PlotFlight(plan.trajectory, output.plot);
  if (format == "qgc")
    return QgcPlan(plan.trajectory, {.origin = output.origin,
                                     .spacing = kMissionSpacing,
                                     .speed = plan.peaks.speed.value,
                                     .yaw = output.has_yaw ? std::optional(plan.yaw) : std::nullopt});
  if (format == "crazyflie") {
    const Poly4dRows rows = ToPoly4d(plan.trajectory, plan.yaw);
    if (rows.worst_error > 1e-3) {
      LogWarning("crazyflie: in single precision the flight is off by up to " + std::to_string(rows.worst_error) + " m");
    }
    if (rows.worst_yaw_error > 0.02) {
      LogWarning("crazyflie: where the heading turns suddenly the polynomials are off by up to " + std::to_string(rows.worst_yaw_error) +
                 " rad");
    }
    return Poly4dCsv(rows.rows);
  }
  const auto bytes = CompressTrajectory(plan.trajectory, plan.yaw, plan.trajectory.At(0).p);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

const std::vector<std::string>& PlanFormats() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Format& format : kFormats) list.push_back(format.name);
    return list;
  }();
  return names;
}

std::vector<std::string> FormatsToWrite(const PlanOutput& output) {
  if (!output.formats.empty()) return output.formats;
  const std::string name = output.out.filename();
  const Format* best = nullptr;  // the longest extension that fits: .poly4d.csv before .csv
  for (const Format& format : kFormats) {
    const std::string extension = format.extension;
    if (name.ends_with(extension) && (best == nullptr || extension.size() > std::string(best->extension).size())) best = &format;
  }
  if (best == nullptr) throw InputError("--out: the extension of '" + output.out.string() + "' names no format; give --format");
  return {best->name};
}

std::vector<fs::path> WritePlan(const PlanRecord& plan, const PlanOutput& output) {
  const std::vector<std::string> formats = FormatsToWrite(output);
  // All are encoded before the first is written: nothing is left behind if one fails.
  std::vector<std::pair<fs::path, std::string>> files;
  for (const std::string& format : formats) {
    fs::path file = output.out;
    if (formats.size() > 1) {
      const auto found = std::find_if(std::begin(kFormats), std::end(kFormats), [&](const Format& f) { return f.name == format; });
      file.replace_extension();
      file += found->extension;
    }
    files.emplace_back(file, Encode(format, plan, output));
  }
  std::vector<fs::path> names;
  for (const auto& [file, bytes] : files) {
    if (file.has_parent_path()) CreateWritableFolder(file.parent_path());
    WriteFileAtomically(file, bytes);
    names.push_back(file);
  }
  return names;
}

}  // namespace airsim360
