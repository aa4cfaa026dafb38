#include "airsim360/vln/agents/answer.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::VlnFields;
using internal::VlnJson;

// A required number that is one: JSON has no NaN, but 1e999 and strings have to be refused too.
double NumberAt(VlnFields& fields, const char* name, double low, double high) {
  fields.At(name);
  return fields.Number(name, 0, low, high);
}

Answer YomoAnswer(VlnFields& fields) {
  Answer answer;
  if (fields.Flag("stop", false)) {
    answer.stop = true;
    return answer;
  }
  RelativeGoalAction move;
  move.azimuth = NumberAt(fields, "azimuth_deg", -360, 360) * kDegree;
  move.elevation = fields.Number("elevation_deg", 0, -90, 90) * kDegree;
  move.distance = NumberAt(fields, "distance_m", 0, kFarthestMove);
  answer.stop = move.distance > 0;
  answer.action = move;
  return answer;
}

Answer DiscreteAnswer(VlnFields& fields) {
  const VlnJson& action = fields.At("action");
  const std::string name = fields.Text("action", "");
  const std::vector<std::string> names(std::begin(kPresetNames), std::end(kPresetNames));
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError("answer.action: " +
                     UnknownChoiceMessage("action", action.dump(-1, ' ', true, VlnJson::error_handler_t::replace).substr(0, 40), names));
  const auto preset = static_cast<Preset>(found - names.begin());
  if (preset == Preset::kStop) return {.stop = true};
  return {.action = PresetAction{preset}};
}

Answer WaypointsAnswer(VlnFields& fields) {
  Answer answer;
  answer.stop = fields.Flag("stop", false);
  const double turn = fields.Number("turn_deg", 0, -360, 360) * kDegree;
  if (fields.Find("waypoints") == nullptr) {
    if (turn != 0) answer.action = RelativeGoalAction{.azimuth = turn};
    if (turn == 0 && !answer.stop) throw InputError("answer: has neither 'waypoints', 'turn_deg' nor 'stop'");
    return answer;
  }
  WaypointsAction way{.points = fields.Points("waypoints", kMostWaypoints), .body_frame = true};
  for (const Vec3d& p : way.points)
    if (Norm(p) > kFarthestMove) throw InputError("answer.waypoints: a point is farther than 500 m away");
  if (!way.points.empty()) answer.action = way;
  return answer;
}

}  // namespace

Answer ParseAnswer(std::string_view text, Decisions decisions) {
  if (text.size() > kLongestAnswer) throw InputError("answer: is longer than 65536 bytes");
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) throw InputError("answer: is empty");
  if (text[first] != '{') throw InputError("answer: does not begin with '{': give one JSON object and nothing around it");
  const VlnJson json = internal::ParseVlnJson(std::string(text), "answer");
  VlnFields fields(json, "answer");
  Answer answer = decisions == Decisions::kYomo       ? YomoAnswer(fields)
                  : decisions == Decisions::kDiscrete ? DiscreteAnswer(fields)
                                                      : WaypointsAnswer(fields);
  fields.Text("reason", "");
  fields.Finish();
  return answer;
}

std::string AnswerText(const Answer& answer) {
  VlnJson said = VlnJson::object();
  const auto degrees = [](double radians) { return internal::Rounded(radians / kDegree); };
  if (answer.action) {
    const AgentAction& action = *answer.action;
    if (const auto* preset = std::get_if<PresetAction>(&action)) {
      said["action"] = kPresetNames[static_cast<int>(preset->preset)];
    } else if (const auto* goal = std::get_if<RelativeGoalAction>(&action)) {
      said = {{"azimuth_deg", degrees(goal->azimuth)},
              {"elevation_deg", degrees(goal->elevation)},
              {"distance_m", internal::Rounded(goal->distance)}};
    } else if (const auto* way = std::get_if<WaypointsAction>(&action)) {
      VlnJson points = VlnJson::array();
      for (const Vec3d& p : way->points) points.push_back(internal::ToJson(p));
      said[way->body_frame ? "waypoints" : "waypoints_world"] = std::move(points);
    } else {
      said["action"] = kActionNames[action.index()];
    }
  }
  if (answer.stop) said["stop"] = true;
  return said.dump();
}

std::string AnswerGrammar(Decisions decisions) {
  switch (decisions) {
    case Decisions::kYomo:
      return "{\"azimuth_deg\": A, \"elevation_deg\": E, \"distance_m\": D} flies D metres straight towards azimuth A (degrees, 0 is ahead, "
             "positive to the right, -90 is left, 180 behind) and elevation E (positive up), and the flight ends there. With D = 0 the drone only "
             "turns towards A and is asked again. {\"stop\": true} ends the flight here.";
    case Decisions::kDiscrete:
      return "{\"action\": NAME} with NAME one of stop, hover, forward, backward, left, right, up, down, turn_left, turn_right. stop ends the flight.";
    case Decisions::kWaypoints:
      return "{\"waypoints\": [[F, L, U], ...], \"stop\": B} flies along points given in metres forward, left and up of where the drone is and "
             "looks now; with B = true the flight ends at the last. {\"turn_deg\": T} turns T degrees to the right. {\"stop\": true} ends the flight here.";
  }
  return "";
}

}  // namespace airsim360
