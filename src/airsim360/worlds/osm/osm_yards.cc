// Behind the houses of a map, by rule: gardens and courts, as much of them as there is room for between the walls.
#include <array>
#include <cmath>

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
constexpr std::array<YardThing, 4> kCourtyard{{{"car", 0.10, 2.6, 1}, {"trash_can", 0.06, 1.0, 1}, {"green_pot", 0.05, 1.0, 1}, {"tree_narrowleaf", 0.02, 3.0, 0.6f}}};

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
          const double pick = rng.Uniform(), yaw = kCell * rng.Uniform();
          const uint32_t variant = rng.Index(36);
          double sum = 0;
          const YardThing* thing = nullptr;
          const auto choose = [&](const auto& things) {
            for (const YardThing& one : things)
              if (!thing && pick < (sum += one.chance)) thing = &one;
          };
          yard.paved ? choose(kCourtyard) : choose(kGarden);
          if (!thing || !Here(p) || OnRoad(p, 3) || !Inside(patch, p) || InBuilding(p, thing->room) || paths_.Find(p, 2.2).owner != UINT32_MAX) continue;
          const bool tree = std::string_view(thing->kind).starts_with("tree");
          if (tree && planted_ >= kMostPlanted) continue;
          // Cars stand in rows; everything else as it likes.
          const double turn = std::string_view(thing->kind) == "car" ? std::round(yaw) * (M_PI / 2) : yaw;
          const Footprint place = FootprintOf(thing->kind, ToFloat(p), static_cast<float>(turn), thing->scale);
          if (!scene_.occupancy.IsFree(place)) continue;
          scene_.occupancy.Add(place);
          planted_ += tree;
          scene_.Put(yard.name + "/" + thing->kind + " " + std::to_string(++number), thing->kind, scene_.On(p, tree ? -0.03 : 0), turn, thing->scale, variant);
        }
    }
  }
}

}  // namespace airsim360::internal
