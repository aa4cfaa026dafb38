// Furniture of the pavements, traffic, and the landmarks among them.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/new_york_city/city.h"
#include "airsim360/worlds/town/pavement_side.h"

namespace airsim360::internal {
namespace {

constexpr PavementRule kRules[] = {
    {"fire_hydrant", 42, 0.55f, true, 1},  {"trash_can", 24, 0.8f, false, 1},     {"newspaper_box", 38, 0.75f, false, 4},
    {"mailbox", 70, 0.8f, false, 1},       {"traffic_sign", 22, 0.5f, true, 1},   {"bench_wood", 40, 1.1f, false, 1},
    {"electric_box", 75, 0.85f, false, 1}, {"bicycle", 45, 1.1f, true, 3},        {"poster_stand", 80, 0.95f, false, 1},
    {"concrete_block", 90, 0.9f, true, 2}, {"parking_meter", 14, 0.5f, false, 1}, {"trash_bags", 17, 1.0f, true, 1},
};

void ApplyRule(District& d, const PavementSide& side, const PavementRule& rule, double density, RngStream& rng) {
  const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
  const float spacing = rule.spacing / static_cast<float>(density);
  for (float s = side.s0 + uniform(0.05, 0.9) * spacing; s < side.s1; s += spacing * uniform(0.8, 1.2)) {
    const float step = rule.kind == std::string_view("concrete_block") ? 2.6f : 0.62f;
    for (int i = 0; i < rule.group; ++i)
      d.placer.Try(rule.kind, side.At(s + step * static_cast<float>(i), rule.depth),
                   FacingYaw(rule.to_street ? side.street() : side.line.inward));
  }
}

void FurnishSide(District& d, const PavementSide& side, bool avenue, const Period& period, const Density& density,
                 const std::vector<float>& lamps, RngStream& rng) {
  const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
  for (float s : lamps) d.placer.Try("street_light", side.At(s, 0.6f), FacingYaw(side.street()));
  // Trees in pits; few on narrow streets of towers.
  const double planted = density.trees * (avenue ? 0.98 : 0.85);
  const float pitch = rng.Chance(0.5) ? 8.4f : 9.7f;
  for (float s = side.s0 + 4.6f; s < side.s1 - 3; s += pitch) {
    if (!rng.Chance(planted)) continue;
    struct Tree {
      const char* kind;
      uint32_t variant;
      float scale;
    };
    static constexpr Tree kTrees[] = {{"tree_generic", 3, 0.72f},
                                      {"tree_generic", 2, 0.8f},
                                      {"tree_narrowleaf", 0, 0.9f},
                                      {"tree_narrowleaf", 1, 0.85f},
                                      {"tree_narrowleaf", 2, 0.95f}};
    const Tree& tree = kTrees[rng.Index(5)];
    const Vec3f p = side.At(s + uniform(-0.3, 0.3), 1.15f);
    if (d.placer.Try(tree.kind, p, uniform(0, kTauF), tree.scale * uniform(0.85, 1.0), {1, 1, 1}, tree.variant))
      LayTreePit(d.ground, {p.x, p.y});
  }
  for (const auto rules : {period.pavement, std::span<const PavementRule>(kRules)})
    for (const PavementRule& rule : rules)
      if (density.furniture >= 0.05) ApplyRule(d, side, rule, density.furniture, rng);
  // Carts at the kerb of the avenues; plants and steel bollards by the doors; cones where somebody digs.
  if (avenue && rng.Chance(0.6)) d.placer.Try("hotdog_cart", side.At(uniform(side.s0 + 4, side.s1 - 4), 1.5f), FacingYaw(side.line.inward));
  for (float s = side.s0 + 2; s < side.s1 - 2; s += uniform(6, 11)) {
    const double pick = rng.Uniform();
    if (pick < 0.3) {
      d.placer.Try("green_pot", side.At(s, side.depth - 0.65f), FacingYaw(side.street()));
    } else if (pick < 0.42) {
      for (int i = 0; i < 4; ++i) d.placer.Try("road_column", side.At(s + 1.1f * static_cast<float>(i), 0.45f), 0, 1, {1, 1, 1}, 0u);
    } else if (pick < 0.5) {
      for (int i = 0; i < 4; ++i) d.placer.Try("traffic_cone", side.At(s + uniform(0, 2.5), uniform(0.6, 1.8)), uniform(0, 6));
    } else if (pick < 0.55) {
      d.placer.Try("plant", side.At(s, side.depth - 0.5f), uniform(0, 6));
    }
  }
}

// A sidewalk shed of `bays` sections against the wall.
void PlaceShed(District& d, const PavementSide& side, float s, int bays) {
  for (int i = 0; i < bays; ++i) {
    const Vec3f p = side.At(s + 2.4f * static_cast<float>(i), side.depth - 1.65f);
    d.placer.Try("scaffold", p, FacingYaw(side.street()), 1, {1, 1, 1}, 0u);
  }
}

bool OnAvenue(int side) { return side % 2 == 1; }

// A free place on a side for a landmark: tries along s from `from`.
EntityId PutLandmark(District& d, const PavementSide& side, std::string name, std::string_view kind, float from, float depth,
                     bool to_street) {
  const float yaw = FacingYaw(to_street ? side.street() : side.line.inward);
  const Vec3f p = side.At(from, depth);
  d.placer.Reserve(FootprintOf(kind, {p.x, p.y}, yaw));
  return PlaceNamed(d, std::move(name), kind, p, yaw);
}

}  // namespace

void PlaceLandmarks(District& d, const Manhattan& city) {
  const auto block = [&](int column, int row) -> const Block& { return d.plan.blocks[static_cast<size_t>(row * 5 + column)]; };
  // Sides: 0 south, 1 east, 2 north, 3 west of a block.
  const PavementSide ne_west = SideBetweenRamps(block(2, 2), 3), ne_south = SideBetweenRamps(block(2, 2), 0),
                     se_west = SideBetweenRamps(block(2, 1), 3), sw_east = SideBetweenRamps(block(1, 1), 1),
                     nw_east = SideBetweenRamps(block(1, 2), 1), se_north = SideBetweenRamps(block(2, 1), 2);
  PutLandmark(d, ne_south, "red telephone booth", "phone_booth", ne_south.s0 + 3, 1.0f, false);
  PutLandmark(d, nw_east, "orange mailbox", "orange_mailbox", nw_east.s0 + 6.5f, 0.8f, false);
  PutLandmark(d, sw_east, "blue mailbox", "mailbox", sw_east.s1 - 6.5f, 0.8f, false);
  PutLandmark(d, se_north, "blue barrier", "blue_barrier", se_north.s1 - 9, 0.9f, true);
  // Parked in the bus lane's quiet end: the truck's window looks at the pavement on its right.
  const StreetStretch street{d.plan.east_west[2], true, 19, 113};
  const Vec3f truck = street.At(36, -(d.plan.east_west[2].half_width - 1.25f), -0.004f);
  d.placer.Reserve({{truck.x, truck.y}, {3.3f, 1.25f}, 0});
  PlaceNamed(d, "food truck", "food_truck", truck, FacingYaw({1, 0}));
  // A tree with red leaves among the green ones of the boulevard.
  const Vec3f tree = ne_west.At(ne_west.s1 - 12, 1.2f);
  d.placer.Reserve({{tree.x, tree.y}, {0.9f, 0.9f}, 0});
  LayTreePit(d.ground, {tree.x, tree.y});
  PlaceNamed(d, "tree with red leaves", "red_tree", tree, 0.7f);
  // The flag on a mast in front of the bank, its columns and its sign.
  const Lot& bank = LotOf(city, "bank");
  const GroundRect& r = bank.rect;
  for (float x = r.x0 + 2.2f; x < r.x1 - 1; x += 3.6f) d.placer.Put("pillar", {x, r.y0 - 0.62f, 0}, 0, 0.92f, {1, 1, 1}, 0u);
  PlaceNamed(d, "bank with the purple sign", "bank_sign", {r.center().x, r.y0 - 0.35f, 5.3f}, FacingYaw({0, -1}), 0, 1.3f);
  d.placer.Reserve({{r.center().x, r.y0 - 0.62f}, {r.width() / 2, 0.5f}, 0});
  const Vec3f mast = se_west.At(se_west.s0 + 4, 1.6f);
  d.placer.Reserve({{mast.x, mast.y}, {0.4f, 0.4f}, 0});
  PlaceNamed(d, "american flag on a mast", "us_flag", mast, 0.4f);
  // Three hot dog carts by the crossing, three flags on the bank.
  for (float s : {10.0f, 14.5f, 19.0f}) {
    const Vec3f cart = se_west.At(se_west.s0 + s, 1.7f);
    const float yaw = FacingYaw(se_west.line.inward);
    d.placer.Reserve(FootprintOf("hotdog_cart", {cart.x, cart.y}, yaw));
    PlaceNamed(d, "hot dog cart", "hotdog_cart", cart, yaw, s > 12);
  }
  for (float s : {0.15f, 0.5f, 0.85f})
    PlaceNamed(d, "american flag", "us_flag", {r.x0 + r.width() * s, r.y0 - 0.3f, 9.4f}, FacingYaw({0, -1}), 1, 1.3f);
  const Lot& bottle = LotOf(city, "bottle roof");
  const Vec2f top = bottle.rect.center();
  PlaceNamed(d, "giant cola bottle", "giant_bottle", {top.x, bottle.rect.y0 + 3.4f, bottle.podium}, kTauF / 8);
}

void RaiseAerials(District& d, const Manhattan& city) {
  for (const BuildingPlan& plan : city.buildings) {
    const bool low = plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kBrownstone;
    if (!low || plan.base > 0 || !plan.upper.empty()) continue;
    RngStream rng(plan.seed, "aerials");
    const GroundRect roof = plan.bounds().Inset(0.75f);
    const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
    for (int n = 1 + static_cast<int>(rng.Index(3)); n > 0; --n)
      d.placer.shelf().Place("antenna", {uniform(roof.x0, roof.x1), rng.Chance(0.5) ? roof.y0 : roof.y1, plan.height()}, uniform(-0.4, 0.4),
                             rng.Index(3));
  }
}

void PlaceSubwayStairs(District& d) {
  const auto put = [&](int column, int row, int side_of_block, float share) {
    const PavementSide side = SideBetweenRamps(d.plan.blocks[static_cast<size_t>(row * 5 + column)], side_of_block);
    const Vec2f along = side.line.along;
    // Beside the kerb; the head of the flight looks to the nearer corner.
    const float s = side.s0 + (side.s1 - side.s0) * share, turn = share < 0.5f ? 0 : kTauF / 2;
    d.placer.Try("subway_stairs", side.At(s, 1.35f), std::atan2(along.y, along.x) + turn, 1, {1, 1, 1}, column % 2 == 0 ? 0u : 1u);
  };
  // Sides: 0 south, 1 east, 2 north, 3 west of a block.
  put(2, 2, 3, 0.25f);
  put(1, 1, 1, 0.62f);
  put(1, 2, 1, 0.45f);
  put(2, 1, 3, 0.75f);
  put(2, 2, 1, 0.2f);
  put(3, 1, 3, 0.8f);
}

void FurnishNewYorkPavements(District& d, const Manhattan& city, const Period& period, const Density& density) {
  const GroundRect reach = d.plan.reach();
  // Stoops keep their place.
  for (const BuildingPlan& plan : city.buildings) {
    if (plan.style != FacadeStyle::kBrownstone) continue;
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      if (plan.edges[e] != EdgeKind::kStreet) continue;
      const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
      const float l = std::hypot(v.x, v.y);
      const Vec2f u = v * (1 / l), out{u.y, -u.x}, p = a + u * StoopMiddle(l) + out * 0.95f;
      d.placer.Reserve({p, {1.1f, 1.0f}, 0});
    }
  }
  for (size_t i = 0; i < d.plan.blocks.size(); ++i) {
    const Block& block = d.plan.blocks[i];
    for (int k = 0; k < 4; ++k) {
      if (!FacesCoreStreet(d.plan, block, k)) continue;
      RngStream rng(d.seed, "new york pavement", i * 4 + static_cast<size_t>(k));
      const PavementSide side = SideBetweenRamps(block, k);
      if (reach.Contains(side.line.At(side.line.length - 1, 3))) FurnishCorner(d, block, side.line, "road_column");
      if (block.kind == BlockKind::kBuilt && OnAvenue(k) && rng.Chance(0.6))
        PlaceCafeRow(d, side, static_cast<float>(rng.Uniform(side.s0 + 4, side.s1 - 12)), {}, rng);
      if (block.kind == BlockKind::kBuilt && k == static_cast<int>(i % 4)) {
        const Vec3f p = side.At((side.s0 + side.s1) / 2 + 3, 1.35f);
        d.placer.Try("bus_stop", p, FacingYaw(side.street()));
      }
      FurnishSide(d, side, OnAvenue(k), period, density, LampsAlong(d.plan, block, k, side.s0, side.s1, rng), rng);
    }
  }
  // Sheds stand in front of the lots whose shops have no awnings.
  for (const Lot& lot : city.lots) {
    const auto plan = std::find_if(city.buildings.begin(), city.buildings.end(), [&](const BuildingPlan& b) {
      return b.block == lot.block && b.base == 0 && !b.awnings && lot.rect.Contains(b.bounds().center());
    });
    if (plan == city.buildings.end() || !reach.Contains(lot.rect.center())) continue;
    const PavementSide side = SideBetweenRamps(d.plan.blocks[lot.block], lot.row == 0 ? 0 : 2);
    const float x = lot.row == 0 ? lot.rect.x0 - side.line.origin.x : side.line.origin.x - lot.rect.x1;
    PlaceShed(d, side, x + 1.6f, std::max(2, static_cast<int>((lot.rect.width() - 1) / 2.4f)));
  }
}

void FurnishNewYorkStreets(District& d, const std::vector<StreetStretch>& streets, const Density& density) {
  LayCrossingCovers(d);
  DriveAcross(d, "taxi", density.traffic);
  for (size_t i = 0; i < streets.size(); ++i) {
    const StreetStretch& street = streets[i];
    RngStream rng(d.seed, "new york traffic", i);
    const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
    const float hw = street.line.half_width, s0 = street.s0 + 7.6f, s1 = street.s1 - 7.6f;
    const bool boulevard = street.line.kind == StreetKind::kBoulevard, avenue = street.line.kind != StreetKind::kTwoWay;
    const Vec2f forward = street.along_x ? Vec2f{1, 0} : Vec2f{0, 1};
    for (float side : {-1.0f, 1.0f}) {
      const Vec2f heading = forward * -side;
      for (float s = s0 + 3.1f; (!boulevard || side < 0) && s + 3.1f < s1 + 0.1f; s += 6.2f) {
        if (!rng.Chance(0.8 * density.traffic)) continue;
        const double pick = rng.Uniform();
        d.placer.Try(pick < 0.78  ? "car"
                     : pick < 0.9 ? "van"
                                  : "taxi",
                     street.At(s + uniform(-0.25, 0.25), side * (hw - 1.22f), -0.004f), FacingYaw(heading) + uniform(-0.015, 0.015));
      }
      std::vector<float> lanes{side * (hw - 2.35f) * 0.5f};
      if (avenue) lanes = {side * 2.0f, side * 5.45f, side * 8.8f};
      if (boulevard) lanes = side < 0 ? std::vector<float>{-3.9f, -7.1f} : std::vector<float>{4.1f, 7.6f};
      for (float lane : lanes) {
        if (avenue && !boulevard && std::abs(lane) > 8) continue;
        // Queues at the line, then gaps.
        const float stop = side < 0 ? s1 - 3 : s0 + 3, back = side < 0 ? -1.0f : 1.0f;
        if (density.traffic < 0.05) continue;
        const auto gaps = static_cast<float>(1 / density.traffic);
        float s = rng.Chance(0.55) ? stop : stop + back * uniform(8, 25);
        while (s > s0 + 2.5f && s < s1 - 2.5f) {
          const double pick = rng.Uniform();
          const char* kind = pick < 0.40 ? "taxi" : pick < 0.88 ? "car" : pick < 0.97 ? "van" : "bus";
          d.placer.Drive(kind, street.At(s, lane + uniform(-0.2, 0.2), -0.004f), FacingYaw(heading) + uniform(-0.02, 0.02));
          s += back * (kind[0] == 'b' ? 15.0f : rng.Chance(0.5) ? uniform(6.5, 9) : gaps * uniform(14, 38));
        }
      }
      if (boulevard && side > 0 && rng.Chance(0.7)) d.placer.Drive("bus", street.At((s0 + s1) / 2 + 6, 11.1f, -0.004f), FacingYaw(heading));
    }
    for (int k = 0; k < (avenue ? 5 : 3); ++k) {
      const float at = uniform(avenue ? 2.6 : 0.9, hw - 3.2) * (rng.Chance(0.5) ? 1.0f : -1.0f);
      d.placer.shelf().Place("manhole", street.At(uniform(s0, s1), at, 0.012f), uniform(0, kTauF), rng.Index(2));
    }
  }
}

}  // namespace airsim360::internal
