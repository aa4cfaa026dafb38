// Furniture of the pavements and traffic, by quarter.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/sf_city/city.h"
#include "airsim360/worlds/town/pavement_side.h"

namespace airsim360::internal {
namespace {

constexpr CafeRow kCafe{.tables = 3, .pitch = 2.6f, .from_wall = 1.0f, .umbrella = 0.85f, .to_chair = 0.85f};

// What stands along every side: kind, spacing, depth from the kerb, whether it looks at the street, how many stand together.
struct Rule {
  const char* kind;
  float spacing, depth;
  bool to_street;
  int group;
};
constexpr Rule kTowerRules[] = {
    {"fire_hydrant", 46, 0.55f, true, 1},      {"trash_can", 26, 0.8f, false, 1},   {"newspaper_box", 44, 0.75f, false, 3},
    {"mailbox", 80, 0.8f, false, 1},           {"traffic_sign", 28, 0.5f, true, 1}, {"bench_wood", 42, 1.0f, false, 1},
    {"electric_box", 52, 0.85f, false, 1},     {"bicycle", 48, 1.1f, true, 3},      {"poster_stand", 85, 0.95f, false, 1},
    {"parking_meter", 12.4f, 0.45f, false, 1}, {"recycle_bin", 60, 0.8f, false, 1}};
constexpr Rule kShopRules[] = {
    {"fire_hydrant", 46, 0.55f, true, 1},     {"trash_can", 24, 0.8f, false, 1},   {"newspaper_box", 36, 0.75f, false, 3},
    {"mailbox", 75, 0.8f, false, 1},          {"traffic_sign", 24, 0.5f, true, 1}, {"bench_wood", 30, 1.0f, false, 1},
    {"electric_box", 56, 0.85f, false, 1},    {"bicycle", 30, 1.1f, true, 3},      {"poster_stand", 40, 2.6f, false, 1},
    {"parking_meter", 6.2f, 0.45f, false, 1}, {"wheelie_bin", 33, 1.0f, true, 2},  {"green_pot", 18, 3.4f, true, 1}};
constexpr Rule kHouseRules[] = {{"fire_hydrant", 55, 0.55f, true, 1},  {"traffic_sign", 38, 0.5f, true, 1},
                                {"electric_box", 70, 0.85f, false, 1}, {"wheelie_bin", 30, 0.6f, true, 2},
                                {"mailbox", 140, 0.8f, false, 1},      {"trash_can", 95, 0.8f, false, 1},
                                {"bicycle", 80, 1.1f, true, 1}};

void PlaceByRule(District& d, const PavementSide& side, std::span<const Rule> rules, RngStream& rng) {
  for (const Rule& rule : rules) {
    for (float s = side.s0 + static_cast<float>(rng.Uniform(0.05, 0.9)) * rule.spacing; s < side.s1;
         s += rule.spacing * static_cast<float>(rng.Uniform(0.85, 1.15)))
      for (int i = 0; i < rule.group; ++i)
        d.placer.Try(rule.kind, side.At(s + 0.68f * static_cast<float>(i), rule.depth),
                     FacingYaw(rule.to_street ? side.street() : side.line.inward));
  }
}

void PlantTrees(District& d, const PavementSide& side, float pitch, double chance, float size, RngStream& rng) {
  struct Tree {
    const char* kind;
    uint32_t variant;
    float scale;
  };
  static constexpr Tree kTrees[] = {{"tree_generic", 3, 0.66f}, {"tree_generic", 2, 0.72f},   {"tree_generic", 5, 0.8f},
                                    {"tree_generic", 0, 0.68f}, {"tree_narrowleaf", 0, 0.8f}, {"tree_narrowleaf", 2, 0.85f}};
  const uint32_t kin = rng.Index(6);
  const EntityId litter = d.builder.AddEntity("fallen leaves", d.builder.tree().At("vegetation/plant"));
  for (float s = side.s0 + 3.5f; s < side.s1 - 2; s += pitch) {
    if (!rng.Chance(chance)) continue;
    const Tree& tree = kTrees[rng.Chance(0.7) ? kin : rng.Index(6)];
    const Vec3f p = side.At(s + static_cast<float>(rng.Uniform(-0.4, 0.4)), 1.1f);
    if (d.placer.Try(tree.kind, p, static_cast<float>(rng.Uniform(0, kTauF)),
                     size * tree.scale * static_cast<float>(rng.Uniform(0.85, 1.1)), {1, 1, 1}, tree.variant)) {
      LayTreePit(d.ground, {p.x, p.y});
      DropLeaves(d, litter, {p.x, p.y}, 1.0f, 9, 0.012f);
    }
  }
}

// Queues before doors: ropes along the wall; barriers where a crowd was expected.
void PlaceQueues(District& d, const PavementSide& side, RngStream& rng) {
  const auto s = static_cast<float>(rng.Uniform(side.s0 + 4, side.s1 - 18));
  if (rng.Chance(0.45)) {
    const Vec3f a = side.At(s, side.depth - 1.2f), b = side.At(s + 6, side.depth - 1.2f);
    if (d.placer.Try("rope_bollard", side.At(s + 7.1f, side.depth - 1.2f), FacingYaw(side.street())))
      PlaceRun(d, "rope_bollard", {a.x, a.y}, {b.x, b.y}, 0);
  }
  if (rng.Chance(0.4))
    for (int i = 0; i < 5; ++i)
      d.placer.Try("metal_barricade", side.At(s + 8 + 2.05f * static_cast<float>(i), 0.45f), FacingYaw(side.street()));
}

void FurnishSide(District& d, const Block& block, int k, const PavementSide& side, RngStream& rng) {
  const Quarter quarter = QuarterOf(block);
  const std::vector<float> lamps = LampsAlong(d.plan, block, k, side.s0, side.s1, rng);
  const bool boulevard =
      (k == 1 && block.column == 3) || (k == 3 && block.column == 4) || (k == 2 && block.row == 3) || (k == 0 && block.row == 4);
  for (float s : lamps) {
    const char* kind = boulevard                                                      ? "boulevard_lamp"
                       : quarter == Quarter::kHouses || quarter == Quarter::kHillPark ? "hill_lamp"
                       : quarter == Quarter::kShops                                   ? "boulevard_lamp"
                                                                                      : "street_light";
    d.placer.Try(kind, side.At(s, 0.6f), FacingYaw(kind == std::string_view("boulevard_lamp") ? side.line.along : side.street()));
  }
  // Tall lights of the boulevard stand between its globes.
  if (boulevard)
    for (float s = side.s0 + 14; s < side.s1 - 8; s += 33) d.placer.Try("street_light", side.At(s, 0.62f), FacingYaw(side.street()));
  if (quarter == Quarter::kTowers || quarter == Quarter::kShops) {
    if (k == static_cast<int>((block.column + block.row) % 4) || boulevard)
      d.placer.Try("bus_stop", side.At((side.s0 + side.s1) / 2 + 3, 1.3f), FacingYaw(side.street()));
    PlantTrees(d, side, boulevard ? 8.6f : 10.4f, boulevard ? 0.97 : 0.8, boulevard ? 0.9f : 1.0f, rng);
    if (quarter == Quarter::kShops && rng.Chance(0.75))
      PlaceCafeRow(d, side, static_cast<float>(rng.Uniform(side.s0 + 4, side.s1 - 10)), kCafe, rng);
    if (quarter == Quarter::kTowers) PlaceQueues(d, side, rng);
    PlaceByRule(d, side, quarter == Quarter::kTowers ? std::span<const Rule>(kTowerRules) : std::span<const Rule>(kShopRules), rng);
    for (float s = side.s0 + 2; s < side.s1 - 2; s += static_cast<float>(rng.Uniform(7, 13)))
      if (rng.Chance(0.25)) d.placer.Try("planter", side.At(s, side.depth - 0.5f), FacingYaw(side.street()));
    return;
  }
  PlantTrees(d, side, 9.6f, quarter == Quarter::kHouses ? 0.62 : 0.9, 0.95f, rng);
  if (quarter == Quarter::kLake || quarter == Quarter::kHillPark) {
    PlaceByRule(d, side, kShopRules, rng);
    if (k == 1) PlaceQueues(d, side, rng);
  } else {
    if (k == static_cast<int>((block.column + 2 * block.row) % 4) && rng.Chance(0.4))
      d.placer.Try("bus_stop", side.At((side.s0 + side.s1) / 2, 1.3f), FacingYaw(side.street()));
    PlaceByRule(d, side, kHouseRules, rng);
  }
}

// Road works in a lane: tubes along it, cones where it begins, barriers around the open road.
void PlaceRoadWorks(District& d, const StreetStretch& street, float s0, float s1, float lane, RngStream& rng) {
  const float inner = lane - std::copysign(1.75f, lane), outer = lane + std::copysign(1.75f, lane);
  const auto at = [&](float s, float across) { return street.At(s, across, 0.0f); };
  const Vec2f along = street.along_x ? Vec2f{1, 0} : Vec2f{0, 1};
  d.ground.Begin("open road", "ground/dirt", Surface::kDirt);
  StreetStretch hole = street;
  for (float s = s0 + 9; s < s1 - 8; s += 1)
    d.ground.Quad(hole.At(s, lane - 0.8f, 0.011f), hole.At(s + 1, lane - 0.8f, 0.011f), hole.At(s + 1, lane + 0.8f, 0.011f),
                  hole.At(s, lane + 0.8f, 0.011f));
  for (float s = s0; s < s1; s += 2.4f) d.placer.Try("traffic_tube", at(s, inner), 0, 1, {1, 1, 1});
  for (int i = 0; i < 6; ++i) {
    const float t = static_cast<float>(i) / 5;
    d.placer.Try("traffic_cone", at(s0 - 1.5f - 1.2f * static_cast<float>(i), inner + (outer - inner) * t),
                 static_cast<float>(rng.Uniform(0, kTauF)));
    d.placer.Try("traffic_cone", at(s1 + 1.5f + 0.8f * static_cast<float>(i), inner + (outer - inner) * t),
                 static_cast<float>(rng.Uniform(0, kTauF)));
  }
  for (float s : {s0 + 4, s1 - 4}) {
    d.placer.Try("water_barrier", at(s, lane - 0.9f), FacingYaw(along));
    d.placer.Try("water_barrier", at(s, lane + 0.9f), FacingYaw(along));
  }
  for (float s = s0 + 8; s < s1 - 7; s += 2.2f) d.placer.Try("water_barrier", at(s, outer), FacingYaw(along) + kTauF / 4);
}

}  // namespace

void FurnishSfPavements(District& d, const Hills&, const SfPlan& city) {
  const GroundRect reach = d.plan.reach();
  // Stoops that reach over the setback keep their place.
  for (const RowHouse& house : city.houses) {
    const float s = BayHouseStoop(house.shape);
    d.placer.Reserve({house.At(s, -kSetback), {0.9f, 0.5f}, 0});
  }
  for (size_t i = 0; i < d.plan.blocks.size(); ++i) {
    const Block& block = d.plan.blocks[i];
    for (int k = 0; k < 4; ++k) {
      if (!FacesCoreStreet(d.plan, block, k)) continue;
      RngStream rng(d.seed, "sf pavement", i * 4 + static_cast<size_t>(k));
      const PavementSide side = SideBetweenRamps(block, k);
      if (reach.Contains(side.line.At(side.line.length - 1, 3))) {
        if (QuarterOf(block) == Quarter::kHouses) {
          const Vec2f p = side.line.At(side.line.length - 1.6f, 1.6f);
          d.placer.Try("traffic_sign", {p.x, p.y, 0}, FacingYaw(side.street()));
        } else {
          FurnishCorner(d, block, side.line, "road_column");
        }
      }
      FurnishSide(d, block, k, side, rng);
    }
  }
}

void FurnishSfStreets(District& d, const Hills&, const std::vector<StreetStretch>& streets) {
  LayCrossingCovers(d);
  for (size_t i = 0; i < streets.size(); ++i) {
    const StreetStretch& street = streets[i];
    RngStream rng(d.seed, "sf traffic", i);
    const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
    const float hw = street.line.half_width, s0 = street.s0 + 7.6f, s1 = street.s1 - 7.6f, middle = (s0 + s1) / 2;
    const bool avenue = street.line.kind == StreetKind::kAvenue, cable = !street.along_x && std::abs(street.line.center + 244) < 1;
    const Vec2f forward = street.along_x ? Vec2f{1, 0} : Vec2f{0, 1};
    if (avenue && !street.along_x && middle < 0 && middle > -120) PlaceRoadWorks(d, street, middle - 15, middle + 12, -5.45f, rng);
    if (avenue && street.along_x && middle > 150 && middle < 230) PlaceRoadWorks(d, street, middle - 15, middle + 15, 8.8f, rng);
    for (float side : {-1.0f, 1.0f}) {
      const Vec2f heading = forward * -side;
      // A bus at each stop of the avenue; parked cars else.
      if (avenue && rng.Chance(0.75))
        d.placer.Drive("bus", street.At(middle + uniform(-6, 6), side * (hw - 1.7f), -0.004f), FacingYaw(heading));
      for (float s = s0 + 3.1f; s + 3.1f < s1 + 0.1f; s += 6.2f) {
        if (!rng.Chance(0.78)) continue;
        d.placer.Try(rng.Chance(0.86) ? "car" : "van", street.At(s + uniform(-0.25, 0.25), side * (hw - 1.22f), -0.004f),
                     FacingYaw(heading) + uniform(-0.015, 0.015));
      }
      std::vector<float> lanes{side * (hw - 2.35f) * 0.5f};
      if (avenue) lanes = {side * 2.0f, side * 5.45f};
      for (float lane : lanes) {
        if (cable) continue;
        for (float s = s0 + uniform(2, 30); s < s1 - 2.5f; s += uniform(avenue ? 16 : 26, avenue ? 60 : 90)) {
          const double pick = rng.Uniform();
          const char* kind = pick < 0.76 ? "car" : pick < 0.88 ? "van" : pick < 0.95 ? "taxi" : "bus";
          d.placer.Drive(avenue || kind[0] != 'b' ? kind : "car", street.At(s, lane + uniform(-0.2, 0.2), -0.004f),
                         FacingYaw(heading) + uniform(-0.02, 0.02));
        }
      }
    }
    for (int k = 0; k < (avenue ? 5 : 4); ++k) {
      const float at = uniform(0.9, hw - 3.2) * (rng.Chance(0.5) ? 1.0f : -1.0f);
      d.placer.shelf().Place("manhole", street.At(uniform(s0, s1), at, 0.001f), uniform(0, kTauF), rng.Index(2));
    }
  }
}

}  // namespace airsim360::internal
