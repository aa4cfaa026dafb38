// Behind the houses of a map, by rule: gardens and courts, as much of them as there is room for between the walls.
#include <array>
#include <cmath>
#include <span>

#include "airsim360/worlds/osm/osm_dresser.h"

namespace airsim360::internal {
namespace {

constexpr double kCell = 4.4, kReach = 260;  // metres: of the grid, from the focus

struct YardThing {
  const char* kind;
  double chance, room;  // of a cell; metres from walls
  float scale;
};
constexpr std::array<YardThing, 6> kGarden{{{"tree_narrowleaf", 0.10, 3.0, 0.6f},
                                            {"tree_generic", 0.07, 3.0, 0.5f},
                                            {"shrub", 0.22, 1.2, 0.9f},
                                            {"green_pot", 0.10, 1.0, 1},
                                            {"bench_wood", 0.03, 1.4, 1},
                                            {"plant", 0.12, 1.0, 1}}};
constexpr std::array<YardThing, 4> kCourtyard{
    {{"car", 0.10, 2.6, 1}, {"trash_can", 0.06, 1.0, 1}, {"green_pot", 0.05, 1.0, 1}, {"tree_narrowleaf", 0.02, 3.0, 0.6f}}};
constexpr std::array<YardThing, 4> kMeadow{
    {{"tree_generic", 0.012, 3.5, 0.7f}, {"tree_narrowleaf", 0.008, 3.5, 0.8f}, {"shrub", 0.04, 1.2, 1}, {"plant", 0.03, 1.0, 1}}};

// What `pick` of [0, 1) draws.
const YardThing* Draw(std::span<const YardThing> things, double pick) {
  for (const YardThing& thing : things) {
    if (pick < thing.chance) return &thing;
    pick -= thing.chance;
  }
  return nullptr;
}

std::span<const YardThing> ThingsOf(Neighbours::Yard::Kind kind) {
  using Kind = Neighbours::Yard::Kind;
  if (kind == Kind::kCourt) return kCourtyard;
  return kind == Kind::kGarden ? std::span<const YardThing>(kGarden) : kMeadow;
}

}  // namespace

void Dresser::Yards() {
  for (const Neighbours::Yard& yard : near_.yards) {
    RngStream rng(scene_.options.seed, yard.name);
    int number = 0;
    for (const Patch& patch : yard.patches) {
      const Bounds2d box = BoundsOf(patch.outer);
      const Vec2d low{std::max(box.min.x, scene_.focus.x - kReach), std::max(box.min.y, scene_.focus.y - kReach)},
          high{std::min(box.max.x, scene_.focus.x + kReach), std::min(box.max.y, scene_.focus.y + kReach)};
      for (double y = low.y; y < high.y; y += kCell)
        for (double x = low.x; x < high.x; x += kCell) {
          const Vec2d p{x + kCell * rng.Uniform(0.1, 0.9), y + kCell * rng.Uniform(0.1, 0.9)};
          const double pick = rng.Uniform(), yaw = 2 * M_PI * rng.Uniform();
          const uint32_t variant = rng.Index(36);
          const YardThing* thing = Draw(ThingsOf(yard.kind), pick);
          if (!thing || !Here(p) || OnRoad(p, 3) || !Inside(patch, p) || InBuilding(p, thing->room) ||
              paths_.Find(p, 2.2).owner != UINT32_MAX)
            continue;
          const bool tree = std::string_view(thing->kind).starts_with("tree");
          if (tree && planted_ >= kMostPlanted) continue;
          if (scene_.dress && ((tree && !scene_.dress->yard_trees) || (std::string_view(thing->kind) == "car" && !scene_.dress->yard_cars)))
            continue;
          // Where few trees stand along streets, few stand in yards.
          constexpr double kFew = 0.5, kVariants = 36;
          const double trees = scene_.dress ? scene_.dress->trees : 1;
          if (tree && trees > 0 && trees < kFew && variant >= kVariants * trees) continue;
          // Cars stand square to each other; everything else as it likes.
          const double turn = std::string_view(thing->kind) == "car" ? std::round(yaw) * (M_PI / 2) : yaw;
          const Footprint place = FootprintOf(thing->kind, ToFloat(p), static_cast<float>(turn), thing->scale);
          if (!scene_.occupancy.IsFree(place)) continue;
          scene_.occupancy.Add(place);
          planted_ += tree;
          scene_.Put(yard.name + "/" + thing->kind + " " + std::to_string(++number), thing->kind, scene_.On(p, tree ? -0.03 : 0), turn,
                     thing->scale, variant);
        }
    }
  }
}

}  // namespace airsim360::internal
