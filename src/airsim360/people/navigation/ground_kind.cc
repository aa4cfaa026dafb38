#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360 {
namespace {

constexpr const char* kNames[] = {"none", "pavement", "path", "floor", "stairs", "crossing", "grass", "parking", "road"};
static_assert(std::size(kNames) == static_cast<size_t>(GroundKind::kCount));

// Longest prefix wins, so the order does not matter.
constexpr std::pair<std::string_view, GroundKind> kPrefixes[] = {
    {"ground", GroundKind::kPavement},
    {"ground/bike_lane", GroundKind::kRoad},
    {"ground/crosswalk", GroundKind::kCrossing},
    {"ground/dirt", GroundKind::kGrass},
    {"ground/floor", GroundKind::kFloor},
    {"ground/grass", GroundKind::kGrass},
    {"ground/gravel", GroundKind::kGrass},
    {"ground/lane_marking", GroundKind::kRoad},
    {"ground/parking", GroundKind::kParking},
    {"ground/path", GroundKind::kPath},
    {"ground/road", GroundKind::kRoad},
    {"ground/sand", GroundKind::kGrass},
    {"ground/terrain", GroundKind::kGrass},
    {"construction/bridge", GroundKind::kPavement},
    {"construction/stairs", GroundKind::kStairs},
    {"furniture/rug", GroundKind::kFloor},
    {"nature/hill", GroundKind::kGrass},
    {"nature/terrain", GroundKind::kGrass},
};

}  // namespace

const char* GroundKindName(GroundKind kind) { return kNames[static_cast<size_t>(kind)]; }

double GroundCost(GroundKind kind) {
  constexpr double kCosts[] = {100, 1, 1, 1, 1.3, 1.2, 2.5, 4, 12};
  return kCosts[static_cast<size_t>(kind)];
}

GroundKind GroundKindOf(const SemanticTree& tree, CategoryId category) {
  const std::string_view path = tree[category].path;
  GroundKind kind = GroundKind::kNone;
  size_t longest = 0;
  for (const auto& [prefix, of_prefix] : kPrefixes) {
    const bool under = path.starts_with(prefix) && (path.size() == prefix.size() || path[prefix.size()] == '/');
    if (under && prefix.size() > longest) {
      longest = prefix.size();
      kind = of_prefix;
    }
  }
  return kind;
}

}  // namespace airsim360
