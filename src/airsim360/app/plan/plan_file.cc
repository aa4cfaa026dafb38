#include "airsim360/app/plan/plan_file.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMaxFileSize = uint64_t{64} << 20;

// Where segments do not join the vehicle would jump: rounding of files is far below this.
constexpr double kMostGap = 1e-3, kMostStep = 1e-2;  // metres, m/s

void CheckJoints(const PolynomialTrajectory& path) {
  const auto at = [&](size_t segment, double t, int derivative) {
    Vec3d sum;
    for (int axis = 0; axis < 3; ++axis) {
      const auto c = path.coefficients(segment, axis);
      for (size_t k = c.size(); k-- > static_cast<size_t>(derivative);)
        sum[axis] = sum[axis] * t + c[k] * (derivative ? static_cast<double>(k) : 1.0);
    }
    return sum;
  };
  for (size_t i = 0; i + 1 < path.segments(); ++i) {
    for (const int derivative : {0, 1}) {
      const double gap = Norm(at(i + 1, 0, derivative) - at(i, path.durations()[i], derivative));
      if (gap <= (derivative ? kMostStep : kMostGap)) continue;
      char text[128];
      std::snprintf(text, sizeof(text), "segment %zu begins %.4g %s from where segment %zu ends", i + 2, gap, derivative ? "m/s" : "m",
                    i + 1);
      throw InputError(text);
    }
  }
}

// A heading that never changes is a constant one.
YawRule RuleOf(std::vector<std::vector<double>> segments) {
  bool constant = true;
  for (const auto& powers : segments) {
    constant &= powers[0] == segments[0][0];
    for (size_t k = 1; k < powers.size(); ++k) constant &= powers[k] == 0;
  }
  if (constant) return ConstantYaw{segments[0][0]};
  return YawPowers{std::move(segments)};
}

std::optional<YawRule> YawOf(const nlohmann::json& json, const std::string& name) {
  if (json.contains("yaw")) return ConstantYaw{json["yaw"].get<double>()};
  if (!json.contains("yaw_coefficients")) return {};
  auto segments = json["yaw_coefficients"].get<std::vector<std::vector<double>>>();
  const auto is_empty = [](const std::vector<double>& powers) { return powers.empty(); };
  if (segments.empty() || std::any_of(segments.begin(), segments.end(), is_empty))
    throw InputError(name + ": yaw_coefficients: a segment needs one number or more");
  return RuleOf(std::move(segments));
}

PlannedPath FromJson(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::json::parse(text);
    for (const char* key : {"order", "durations", "coefficients"}) {
      if (!json.contains(key)) throw InputError(name + ": '" + key + "' is missing; `airsim360 plan --format json` writes it");
    }
    std::vector<double> coefficients;
    for (const auto& segment : json.at("coefficients")) {
      if (segment.size() != 3) throw InputError(name + ": coefficients: a segment has three axes");
      for (const auto& axis : segment) {
        for (const auto& c : axis) coefficients.push_back(c.get<double>());
      }
    }
    return {PolynomialTrajectory(json.at("order").get<int>(), json.at("durations").get<std::vector<double>>(), std::move(coefficients)),
            YawOf(json, name)};
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(name + ": not JSON, or cut off, at byte " + std::to_string(error.byte));
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
  std::vector<std::vector<double>> yaws;
  for (size_t i = 0; i < segments.size(); ++i) {
    const std::string where = name + ": segment " + std::to_string(i + 1) + ": yaw";
    if (segments[i].yaw.empty() != segments[0].yaw.empty()) throw InputError(where + ": some segments have one and others do not");
    std::vector<double> powers;
    for (const std::string& c : segments[i].yaw) powers.push_back(Number(c, where));
    if (!powers.empty()) yaws.push_back(std::move(powers));
  }
  std::optional<YawRule> yaw;
  if (!yaws.empty()) yaw = RuleOf(std::move(yaws));
  return {PolynomialTrajectory(degree, std::move(durations), std::move(coefficients)), yaw};
}

}  // namespace

PlannedPath ReadPlanFile(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path, kMaxFileSize), name = path.string();
  try {
    std::optional<PlannedPath> plan;
    if (path.extension() == ".json") plan = FromJson(text, name);
    if (path.extension() == ".yaml" || path.extension() == ".yml") plan = FromYaml(text, name);
    if (plan) {
      CheckJoints(plan->trajectory);
      if (plan->yaw) YawProfile(plan->trajectory, *plan->yaw);
      return *plan;
    }
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.starts_with(name) ? what : name + ": " + what);
  }
  throw InputError(name + ": a plan is a .json or .yaml file of `airsim360 plan`");
}

}  // namespace airsim360
