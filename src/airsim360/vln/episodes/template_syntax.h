// Instructions before they are bound to a world: the words, what they ask for, where one stands and what counts as done.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/vln/predicates/query.h"

namespace airsim360 {

/// From where an instruction is given.
enum class StartFrame {
  kAround,    ///< anywhere in the open around the thing
  kRoad,      ///< above a road, looking along it
  kTurn,      ///< on a road that leads to a junction at which the instruction turns
  kCrossing,  ///< before one end of the thing's long side, looking along it
  kFacing,    ///< before the middle of its long side, looking across it
  kBeside,    ///< left of it, looking along it
};
inline constexpr const char* kStartFrameNames[] = {"around", "road", "turn", "crossing", "facing", "beside"};

/// Where one has arrived.
enum class GoalKind {
  kNear,          ///< beside the thing, in sight of it
  kRoof,          ///< above its top
  kLand,          ///< close above its surface
  kBelow,         ///< on the ground at its foot
  kShore,         ///< before the edge that faces the start
  kStreetBeyond,  ///< above a road on its far side
  kPathBeyond,    ///< above a path on its far side
  kFarEnd,        ///< beyond its far end, on the line ahead
  kOtherSide,     ///< on the other side of its long axis, as far from it as the start
  kOver,          ///< above its middle
};
inline constexpr const char* kGoalKindNames[] = {"near",          "roof",        "land",    "below",      "shore",
                                                 "street_beyond", "path_beyond", "far_end", "other_side", "over"};

/// What an instruction goes on with, seen from where the part before it ended and in the direction of that flight.
struct NextPart {
  Query query;
  GoalKind goal = GoalKind::kNear;
  double distance = 4;  ///< metres that the goal keeps from the thing
};

struct InstructionTemplate {
  std::string id;    ///< "paper37/01"
  std::string text;  ///< the instruction
  Query query;
  StartFrame frame = StartFrame::kAround;
  std::string heading = "any";          ///< around: the sector that the thing is to be in, or any
  double nearest = 24, farthest = 150;  ///< metres between start and thing, seen from above
  double lowest = 2, highest = 8;       ///< metres of the start above what is below it
  GoalKind goal = GoalKind::kNear;
  double distance = 4;  ///< metres that the goal keeps from the thing
  /// Pixels of SeenAtStart that starts have to show, for its words take for granted that one sees it: "the lake in front of you".
  /// An instruction that turns is seen from there. 0: it may be hidden.
  int64_t in_sight = 0;
  double room = 0;                  ///< metres free around the start; 0: as places have it
  double radius = 0;                ///< metres around the goal that count as there; 0: 20, in rooms 1
  std::vector<NextPart> then = {};  ///< in order; at most kMostParts
};
inline constexpr size_t kMostParts = 8;

/// The 37 instructions of the appendix of the AirSim360 paper ("List of Prompts", Table of prompts), word for word, bound to
/// what New York City and Downtown West hold.
const std::vector<InstructionTemplate>& PaperTemplates();
/// JSON as in docs/guide/vln.md: a list of templates. InputError naming `name` and the field.
std::vector<InstructionTemplate> ParseTemplates(const std::string& text, const std::string& name);
/// "paper37", "any", or a file. `rooms`: distances of "any" fit rooms. InputError naming --templates.
std::vector<InstructionTemplate> FindTemplates(const std::string& name, const Scene& scene, bool rooms);

/// The same as JSON.
std::string_view PaperTemplatesText();
}  // namespace airsim360
