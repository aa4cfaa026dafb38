#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/vln/flights/run_episodes.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::Rounded;
using internal::VlnFields;
using internal::VlnJson;

constexpr size_t kMostSteps = 1'000'000;

VlnJson PointsJson(const std::vector<Vec3d>& points) {
  VlnJson list = VlnJson::array();
  for (const Vec3d& p : points) list.push_back(internal::ToJson(p));
  return list;
}

VlnJson LogJson(const std::vector<VlnStep>& log) {
  VlnJson list = VlnJson::array();
  for (const VlnStep& step : log) {
    VlnJson& said = list.emplace_back(
        VlnJson{{"t", Rounded(step.t)}, {"p", internal::ToJson(step.p)}, {"yaw_deg", Rounded(step.yaw_deg)}, {"said", step.said}});
    if (!step.told.empty()) said["told"] = step.told;
  }
  return list;
}

std::vector<VlnStep> ReadLog(const VlnJson& list, const std::string& where) {
  if (!list.is_array() || list.size() > kMostSteps) throw InputError(where + ": is no list of decisions");
  std::vector<VlnStep> log;
  for (const VlnJson& entry : list) {
    VlnFields fields(entry, where + "[" + std::to_string(log.size()) + "]");
    VlnStep step;
    step.t = fields.Number("t", 0, 0, 1e9);
    step.p = fields.Point("p");
    step.yaw_deg = fields.Number("yaw_deg", 0, -360, 360);
    step.said = fields.Text("said", "");
    step.told = fields.Text("told", "");
    fields.Finish();
    log.push_back(std::move(step));
  }
  return log;
}

std::vector<double> ReadHeadings(const VlnJson& list, size_t count, const std::string& where) {
  std::vector<double> headings;
  if (list.is_array())
    for (const VlnJson& value : list)
      headings.push_back(value.is_number() && std::abs(value.get<double>()) <= 360 ? value.get<double>() : 1e9);
  if (headings.size() != count || std::ranges::count(headings, 1e9) > 0)
    throw InputError(where + ": is no list of an angle in degrees for each place of 'pred'");
  return headings;
}

}  // namespace

std::string ResultLine(const VlnResult& r) {
  VlnJson json = {{"id", r.id},
                  {"template", r.template_id},
                  {"world", r.world},
                  {"difficulty", r.difficulty},
                  {"agent", r.agent},
                  {"view", r.view},
                  {"decisions_by", r.decisions_by},
                  {"protocol", r.protocol},
                  {"radius", r.radius},
                  {"end", r.end},
                  {"explanation", r.explanation},
                  {"success", r.success},
                  {"oracle_success", r.oracle_success},
                  {"collided", r.collided},
                  {"stopped", r.stopped},
                  {"distance", Rounded(r.distance)},
                  {"path_length", Rounded(r.path_length)},
                  {"geodesic_length", Rounded(r.geodesic_length)},
                  {"straight_length", Rounded(r.straight_length)},
                  {"decisions", r.decisions},
                  {"moves", r.moves},
                  {"faults", r.faults},
                  {"yaw_turned_deg", Rounded(r.yaw_turned_deg)},
                  {"seconds", Rounded(r.seconds)},
                  {"parts", PointsJson(r.parts)},
                  {"ref", PointsJson(r.ref)},
                  {"pred", PointsJson(r.pred)}};
  if (r.goal) json["goal"] = internal::ToJson(*r.goal);
  if (!r.places.empty()) json["places"] = PointsJson(r.places);
  if (!r.heading_deg.empty()) json["heading_deg"] = r.heading_deg;
  if (!r.log.empty()) json["log"] = LogJson(r.log);
  return json.dump(-1, ' ', false, VlnJson::error_handler_t::replace);
}

VlnResult ParseResultLine(const std::string& line, const std::string& where) {
  const VlnJson json = internal::ParseVlnJson(line, where);
  VlnFields fields(json, where);
  VlnResult r;
  r.id = fields.Text("id", "");
  if (r.id.empty()) throw InputError(where + ".id: is missing");
  r.template_id = fields.Text("template", "");
  r.world = fields.Text("world", "");
  r.difficulty = fields.Text("difficulty", "");
  r.agent = fields.Text("agent", "");
  r.view = fields.Text("view", "");
  r.decisions_by = fields.Text("decisions_by", "");
  r.protocol = fields.Text("protocol", "");
  r.radius = fields.Number("radius", 0, 0, 1000);
  r.end = fields.Text("end", "");
  r.explanation = fields.Text("explanation", "");
  r.success = fields.Flag("success", false);
  r.oracle_success = fields.Flag("oracle_success", false);
  r.collided = fields.Flag("collided", false);
  r.stopped = fields.Flag("stopped", true);
  r.distance = fields.Number("distance", 0, 0, 1e7);
  r.path_length = fields.Number("path_length", 0, 0, 1e7);
  r.geodesic_length = fields.Number("geodesic_length", 0, 0, 1e7);
  r.straight_length = fields.Number("straight_length", 0, 0, 1e7);
  r.decisions = static_cast<int64_t>(fields.Number("decisions", 0, 0, 1e9));
  r.moves = static_cast<int64_t>(fields.Number("moves", 0, 0, 1e9));
  r.faults = static_cast<int64_t>(fields.Number("faults", 0, 0, 1e9));
  r.yaw_turned_deg = fields.Number("yaw_turned_deg", 0, 0, 1e9);
  r.seconds = fields.Number("seconds", 0, 0, 1e9);
  if (const VlnJson* parts = fields.Find("parts"); parts != nullptr) r.parts = fields.Points("parts", kMostParts);
  if (fields.Find("goal") != nullptr) r.goal = fields.Point("goal");
  // The goal and its at most 4096 other places.
  if (fields.Find("places") != nullptr) r.places = fields.Points("places", 4097);
  r.ref = fields.Points("ref", 100'000);
  r.pred = fields.Points("pred", 1'000'000);
  if (const VlnJson* headings = fields.Find("heading_deg"); headings != nullptr)
    r.heading_deg = ReadHeadings(*headings, r.pred.size(), where + ".heading_deg");
  if (const VlnJson* log = fields.Find("log"); log != nullptr) r.log = ReadLog(*log, where + ".log");
  fields.Finish();
  if (r.ref.empty() || r.pred.empty()) throw InputError(where + ": 'ref' and 'pred' need a point each");
  return r;
}

std::vector<VlnResult> ReadResults(const std::filesystem::path& file) {
  std::istringstream lines(ReadTextFile(file, uint64_t{8} << 30));
  std::vector<VlnResult> results;
  std::set<std::string> ids;
  std::string line;
  for (size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = file.string() + ":" + std::to_string(number);
    results.push_back(ParseResultLine(line, where));
    if (!ids.insert(results.back().id).second) throw InputError(where + ".id: '" + results.back().id + "' is there twice");
  }
  if (results.empty()) throw InputError(file.string() + ": holds no result");
  return results;
}

}  // namespace airsim360
