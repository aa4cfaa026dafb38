#include "airsim360/mission/mission_nodes.h"

#include <cmath>
#include <cstdio>

namespace airsim360 {

using enum behaviour::NodeClass;

// Longer than a screen because it is a table: a row for each node.
const behaviour::Palette& MissionPalette() {
  constexpr auto Of = [](MissionNode node) { return static_cast<behaviour::Node>(node); };
  static const behaviour::Palette palette({
      {Of(MissionNode::kTakeoff),
       "Takeoff",
       kAction,
       {{"height", 'm', "2", false, "metres"}, {"speed", 'v', "1", false, "m/s"}},
       "arms and climbs above where it stands"},
      {Of(MissionNode::kLand), "Land", kAction, {{"speed", 'v', "0.7", false, "m/s"}}, "sinks until the ground stops it, then disarms"},
      {Of(MissionNode::kReturn), "Return", kAction, {{"height", 'm', "5", false, "metres above home, at least"}}, "flies home and lands"},
      {Of(MissionNode::kGoto),
       "Goto",
       kAction,
       {{"to", 'w', nullptr, false, "x;y;z, 60.17N;24.94E;z, or the name of a thing, person or vehicle"},
        {"distance", 'm', "3", false, "metres to keep from a thing"},
        {"height", 'h', "0", false, "metres above the middle of a thing"},
        {"speed", 'v', "4", false, "m/s at most"},
        {"acceleration", 'v', "4", false, "m/s^2 at most"},
        {"clearance", 'm', "0.5", false, "metres to keep from every surface"}},
       "flies there on a way that is proved free"},
      {Of(MissionNode::kOrbit),
       "Orbit",
       kAction,
       {{"around", 'w', nullptr, false, "as Goto"},
        {"radius", 'm', "10", false, "metres"},
        {"height", 'h', "2", false, "metres above the middle of a thing; above a point"},
        {"turns", 'r', "1", false, "positive: counter-clockwise from above"},
        {"speed", 'v', "3", false, "m/s at most"},
        {"clearance", 'm', "0.5", false, "metres to keep from every surface"}},
       "flies on a circle and looks at its middle"},
      {Of(MissionNode::kFollow),
       "Follow",
       kAction,
       {{"who", 'w', nullptr, false, "a person or a vehicle"},
        {"distance", 'm', "6", false, "metres over the ground"},
        {"height", 'h', "3", false, "metres above the middle"},
        {"seconds", 's', "0", false, "0: until it is broken off"},
        {"speed", 'v', "8", false, "m/s at most"},
        {"clearance", 'm', "0.5", false, "metres to keep from every surface"}},
       "stays near and looks at them"},
      {Of(MissionNode::kLook),
       "Look",
       kAction,
       {{"at", 'w', nullptr, false, "as Goto"}},
       "turns the drone, and its first gimbal, towards it"},
      {Of(MissionNode::kGimbal),
       "Gimbal",
       kAction,
       {{"pitch_deg", 'g', "0", false, "positive: up"},
        {"yaw_deg", 'g', "0"},
        {"roll_deg", 'g', "0"},
        {"gimbal", 'i', "0", false, "which one, from 0"}},
       "turns a gimbal of the drone"},
      {Of(MissionNode::kCapture),
       "Capture",
       kAction,
       {{"to", 'f', "captures", false, "name of the dataset"},
        {"count", 'c', "1", false, "frames"},
        {"every_s", 's', "1", false, "seconds between them"},
        {"products", 'x', "", false, "further products, with commas"}},
       "takes frames of a dataset"},
      {Of(MissionNode::kWait), "Wait", kAction, {{"seconds", 's', nullptr}}, "time passes"},
      {Of(MissionNode::kNear),
       "Near",
       kCondition,
       {{"what", 'w', nullptr, false, "as Goto"}, {"distance", 'm', nullptr, false, "metres"}},
       "whether it is so near"},
      {Of(MissionNode::kBatteryAbove),
       "BatteryAbove",
       kCondition,
       {{"share", 'q', nullptr, false, "0 to 1"}},
       "whether more charge is left"},
      {Of(MissionNode::kSees),
       "Sees",
       kCondition,
       {{"what", 't', nullptr, false, "name of a thing, person or vehicle, or part of a category path"},
        {"distance", 'm', "50", false, "metres"},
        {"thing", 'o', "", true, "the nearest one that is seen"}},
       "whether one is in sight, whichever way the drone looks"},
      {Of(MissionNode::kTimeAfter),
       "TimeAfter",
       kCondition,
       {{"seconds", 's', nullptr, false, "since the mission began"}},
       "whether so much time has passed"},
  });
  return palette;
}

std::optional<NumberRange> RangeOf(char kind) {
  switch (kind) {
    case 'm':
    case 's':
      return NumberRange{0, 1e5, false};
    case 'v':
      return NumberRange{0.05, 50, false};
    case 'c':
      return NumberRange{1, 100000, true};
    case 'h':
      return NumberRange{-1e4, 1e4, false};
    case 'q':
      return NumberRange{0, 1, false};
    case 'r':
      return NumberRange{-100, 100, false};
    case 'g':
      return NumberRange{-360, 360, false};
    case 'i':
      return NumberRange{0, 1000, true};
    default:
      return std::nullopt;
  }
}

std::string NumberProblem(char kind, double value) {
  const auto range = RangeOf(kind);
  if (!range) return {};
  char text[96];
  if (!(value >= range->low && value <= range->high)) {
    std::snprintf(text, sizeof text, "%g is not in %g … %g", value, range->low, range->high);
    return text;
  }
  if (!range->whole || value == std::floor(value)) return {};
  std::snprintf(text, sizeof text, "%g is not a whole number", value);
  return text;
}

}  // namespace airsim360
