#include "airsim360/app/plan_file.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMaxFileSize = uint64_t{64} << 20;

PlannedPath FromJson(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::json::parse(text);
    std::vector<double> coefficients;
    for (const auto& segment : json.at("coefficients")) {
      if (segment.size() != 3) throw InputError(name + ": coefficients: a segment has three axes");
      for (const auto& axis : segment) {
        for (const auto& c : axis) coefficients.push_back(c.get<double>());
      }
    }
    std::optional<double> yaw;
    if (json.contains("yaw")) yaw = json["yaw"].get<double>();
    return {PolynomialTrajectory(json.at("order").get<int>(), json.at("durations").get<std::vector<double>>(), std::move(coefficients)),
            yaw};
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name + ": " + error.what());
  }
}

double Number(const std::string& text, const std::string& where) {
  double value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw InputError(where + ": '" + text.substr(0, 64) + "' is not a number");
  return value;
}

struct PlanSegment {
  uint64_t num_coeffs = 0;
  double segment_time = 0;
  std::vector<std::string> x, y, z, yaw;
};

PlannedPath FromYaml(const std::string& text, const std::string& name) {
  std::vector<PlanSegment> segments;
  uint64_t seq = 0, secs = 0, nsecs = 0;
  std::string frame;
  ReadYaml(text, name, [&](ConfigVisitor& v) {
    v.Group("header", "of the message", [&](ConfigVisitor& h) {
      h.Field("seq", "number of the message", seq);
      h.Field("frame_id", "frame", frame);
      h.Group("stamp", "time", [&](ConfigVisitor& s) {
        s.Field("secs", "seconds", secs);
        s.Field("nsecs", "nanoseconds", nsecs);
      });
    });
    v.List("segments", "pieces of the path", segments, [](ConfigVisitor& e, PlanSegment& s) {
      e.Field("num_coeffs", "powers", s.num_coeffs);
      e.Field("segment_time", "seconds", s.segment_time, 1e-9, 1e9);
      e.Field("x", "increasing powers", s.x);
      e.Field("y", "increasing powers", s.y);
      e.Field("z", "increasing powers", s.z);
      e.Field("yaw", "increasing powers", s.yaw);
    });
  });
  if (segments.empty()) throw InputError(name + ": no segments");
  std::vector<double> durations, coefficients;
  for (size_t i = 0; i < segments.size(); ++i) {
    const PlanSegment& s = segments[i];
    const std::string where = name + ": segment " + std::to_string(i + 1);
    durations.push_back(s.segment_time);
    for (const auto* axis : {&s.x, &s.y, &s.z}) {
      if (axis->size() != segments[0].x.size() || axis->size() != s.num_coeffs)
        throw InputError(where + ": x, y and z need num_coeffs numbers each, as many as other segments");
      for (const std::string& c : *axis) coefficients.push_back(Number(c, where));
    }
  }
  const int degree = static_cast<int>(segments[0].x.size()) - 1;
  std::optional<double> yaw;
  if (!segments[0].yaw.empty()) yaw = Number(segments[0].yaw[0], name + ": segment 1: yaw");
  return {PolynomialTrajectory(degree, std::move(durations), std::move(coefficients)), yaw};
}

}  // namespace

PlannedPath ReadPlanFile(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path, kMaxFileSize), name = path.string();
  try {
    if (path.extension() == ".json") return FromJson(text, name);
    if (path.extension() == ".yaml" || path.extension() == ".yml") return FromYaml(text, name);
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.starts_with(name) ? what : name + ": " + what);
  }
  throw InputError(name + ": a plan is a .json or .yaml file of `airsim360 plan`");
}

}  // namespace airsim360
