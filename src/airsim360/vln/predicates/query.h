// What an instruction asks for: a noun and the predicates that leave one thing of it. Eleven predicates cover the 37
// instructions of the AirSim360 paper.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/vln/predicates/scene_graph.h"

namespace airsim360 {

enum class PredicateKind {
  kNearest,         ///< no other is as near, seen from above
  kOrdinal,         ///< the k-th on the way ahead
  kBearing,         ///< in a sector seen from the viewpoint: kSectors
  kHeightQuantile,  ///< among the tallest of what the noun names (sector "width": the widest): above a share of them
  kOppositeSide,    ///< the viewpoint is beside it, so that there is another side
  kSideOf,          ///< left or right of the line ahead; with `side_of_axis`, the viewpoint is on that side of its long axis
  kAcross,          ///< the line ahead enters it and leaves it again
  kAlong,           ///< in a corridor around the line ahead
  kOnTopOf,         ///< stands on the roof of another thing
  kStorey,          ///< within one storey of a building
  kSurroundedBy,    ///< things of another noun are around it, in a share of all directions
};
inline constexpr const char* kPredicateNames[] = {"nearest", "ordinal", "bearing",   "height_quantile", "opposite_side", "side_of",
                                                  "across",  "along",   "on_top_of", "storey",          "surrounded_by"};

/// Directions from the heading, degrees, positive to the right; `above` and `below` are elevations, `on_floor` is a range of heights.
struct Sector {
  const char* name;
  double azimuth, half_width;
};
inline constexpr Sector kSectors[] = {{"ahead", 0, 45},          {"right", 90, 45},       {"behind", 180, 45},     {"left", -90, 45},
                                      {"ahead_left", -45, 40},   {"ahead_right", 45, 40}, {"rear_right", 135, 40}, {"rear_left", -135, 40},
                                      {"straight_ahead", 0, 15}, {"right_hand", 90, 60}};
inline constexpr size_t kPlainSectors = 8;    ///< the first of them divide the circle twice; those after overlap them
inline constexpr double kAboveElevation = 8;  ///< degrees: higher is "above", lower than its negative "below"

/// Metres by which a thing from `low` to `high` is on the floor over which somebody's eyes are one to two metres high; negative: it
/// is not. Its foot is there, or it passes by on its way through several storeys. Storeys are 2.9 m high at least.
constexpr double OnFloorBy(double eye, double low, double high) {
  constexpr double kFoot[2] = {-2.4, 0.6}, kBody[2] = {-0.9, 0.3};  // metres from the eyes, between knees and head
  const double stands = std::min(low - eye - kFoot[0], eye + kFoot[1] - low),
               passes = std::min(high - eye - kBody[0], eye + kBody[1] - low);
  return std::max(stands, passes);
}

struct Predicate {
  PredicateKind kind = PredicateKind::kNearest;
  std::string sector =
      {};                ///< bearing: of kSectors, or "above", "below", "on_floor"; side_of: "left", "right"; height_quantile: "", "width"
  int k = 1;             ///< ordinal
  double share = 0.5;    ///< height_quantile, surrounded_by
  double width = 12;     ///< along, ordinal: metres of the corridor to either side
  double clear = 0;      ///< along: what is farther aside than `width` and nearer than this may or may not count; 0: as `width`
  double within = 40;    ///< surrounded_by: metres from the thing
  bool at_turn = false;  ///< seen from where the instruction turns, not from the start
  bool side_of_axis = false;  ///< side_of
  Noun of = {};               ///< on_top_of, storey, surrounded_by
};

/// Metres by which the second must be farther than the nearest, which is `distance` metres away: less than half a metre or a tenth
/// people do not tell (docs/internals/benchmarks/vln.md). Of both methods.
constexpr double NearestMargin(double distance) { return distance > 5 ? 0.1 * distance : 0.5; }

struct Query {
  Noun noun;
  std::vector<Predicate> predicates = {};  ///< nearest and ordinal last
  /// What people may call the same: the answer has to be the same with these things among those that the noun names. None: nothing.
  Noun rivals = {};
};

/// Whether a noun names anything at all.
inline bool Names(const Noun& noun) { return !noun.categories.empty() || !noun.names.empty(); }

/// Where an instruction is read, and where it turns.
struct Viewpoint {
  Vec3d p_W;
  double yaw = 0;  ///< rad
};
struct Standpoint {
  Viewpoint start;
  std::optional<Viewpoint> turn = {};
};

/// A thing that also competes for being meant.
struct Competitor {
  EntityId entity = kNoEntity;
  std::string name;
  double value = 0;  ///< of the predicate, in its unit
};

/// How one predicate decided. A filter holds for values above 0, and is decided where they are `needed` or more away from
/// it; nearest and ordinal compare values.
struct ProofStep {
  std::string predicate, unit;
  int before = 0, after = 0;                 ///< candidates
  double value = 0;                          ///< of the answer
  double margin = 0;                         ///< by which the closest call was decided
  double needed = 0;                         ///< less than this is no proof
  std::vector<Competitor> competitors = {};  ///< the closest calls, at most 4
};

struct Verdict {
  std::vector<Thing> answers;  ///< exactly one if the query is decided
  std::vector<ProofStep> steps;
  bool decided = false;
  std::string why;  ///< of what is not decided: absent, or which things compete and how close they are
};

/// Decides a query from boxes alone. O(things * predicates).
Verdict Decide(SceneGraph& graph, const Query& query, const Standpoint& standpoint);

/// Degrees from the heading to a point, positive to the right, in (-180, 180].
double AzimuthOf(const Viewpoint& view, Vec3d p_W);
/// Metres along the heading and to its left.
Vec2d InHeading(const Viewpoint& view, Vec3d p_W);

}  // namespace airsim360
