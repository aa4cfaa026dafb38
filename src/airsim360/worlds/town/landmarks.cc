// What flight instructions name, in downtown_west: each exactly once.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {

void Stand(District& d, std::string name, std::string_view kind, Vec2f at, float yaw, float z = 0) {
  d.placer.Reserve(FootprintOf(kind, at, yaw));
  PlaceNamed(d, std::move(name), kind, {at.x, at.y, z}, yaw);
}

bool AtCorner(const BuildingPlan& b) { return std::count(b.edges.begin(), b.edges.end(), EdgeKind::kStreet) > 1; }

// The first of three neighbours in one row, nearest to c, that can be made alike; buildings.size(): none.
size_t FindNeighbours(const std::vector<BuildingPlan>& buildings, Vec2f c, const GroundRect& reach) {
  size_t first = buildings.size();
  float least = 1e9f;
  for (size_t i = 0; i + 2 < buildings.size(); ++i) {
    const Vec2f v = buildings[i].bounds().center() - c;
    bool fits = std::hypot(v.x, v.y) < least && reach.Contains(buildings[i].bounds().center());
    for (size_t k = i; k < i + 3; ++k) {
      const BuildingPlan &b = buildings[k], &before = buildings[i];
      const Vec2f u = b.outline[1] - b.outline[0], w = before.outline[1] - before.outline[0];
      fits = fits && b.block == before.block && !AtCorner(b) && b.curtain_floor < 0 && b.kept_free.area() == 0 &&
             std::abs(u.x * w.y - u.y * w.x) < 0.1f;
    }
    if (!fits) continue;
    first = i;
    least = std::hypot(v.x, v.y);
  }
  return first;
}

void MakeAlike(std::vector<BuildingPlan>& buildings, size_t first) {
  for (size_t k = first; k < std::min(first + 3, buildings.size()); ++k) {
    BuildingPlan& b = buildings[k];
    b.name = "similar building ";
    b.name += std::to_string(k - first + 1);
    b.style = FacadeStyle::kClassicStone;
    b.floors = 5;
    b.palette = 1;
    b.roof = RoofKind::kHipSlate;  // one each: under flat ones their fronts join to one
  }
}

}  // namespace

void MarkDowntownLandmarks(const StreetPlan& plan, std::vector<BuildingPlan>& buildings) {
  const GroundRect reach = plan.reach();
  const auto plaza = std::find_if(plan.blocks.begin(), plan.blocks.end(), [](const Block& b) { return b.kind == BlockKind::kPlaza; });
  const Vec2f c = plaza->inner().center();
  // The building next to the plaza that meets a condition.
  const auto nearest = [&](const auto& fits) {
    BuildingPlan* best = nullptr;
    float least = 1e9f;
    for (BuildingPlan& building : buildings) {
      const Vec2f v = building.bounds().center() - c;
      const float distance = std::hypot(v.x, v.y);
      if (distance >= least || !reach.Contains(building.bounds().center()) || !fits(building)) continue;
      best = &building;
      least = distance;
    }
    return best;
  };
  const auto plain = [](FacadeStyle style) {
    return style == FacadeStyle::kBrickWalkUp || style == FacadeStyle::kClassicStone || style == FacadeStyle::kBrickLoft;
  };
  if (BuildingPlan* curtains = nearest([&](const BuildingPlan& b) { return plain(b.style) && AtCorner(b) && b.floors >= 4; }))
    curtains->curtain_floor = 3;
  BuildingPlan* bottle = nearest([&](const BuildingPlan& b) {
    const bool flat = b.roof == RoofKind::kFlatGravel || b.roof == RoofKind::kFlatBitumen;
    const bool wide = std::min(b.bounds().width(), b.bounds().depth()) > 7;
    return flat && wide && b.curtain_floor < 0 && b.outline.size() == 4 && b.height() > 12 && b.height() < 24;
  });
  if (bottle) {
    const Vec2f m = bottle->bounds().center(), a = (bottle->outline[0] + bottle->outline[1]) * 0.5f, in = m - a;
    const Vec2f at = a + in * (3.4f / std::hypot(in.x, in.y));
    bottle->kept_free = {at.x - 1.9f, at.y - 1.9f, at.x + 1.9f, at.y + 1.9f};
  }
  MakeAlike(buildings, FindNeighbours(buildings, c, reach));
  HidePartyWalls(buildings, 0);
}

void HangDowntownSigns(District& d, const std::vector<BuildingPlan>& buildings) {
  struct Sign {
    const char* name;
    const char* kind;
    uint32_t variant;
    float z, scale;
  };
  static constexpr Sign kSigns[] = {
      {"billboard BLACK & WHITE", "billboard", 0, 6.2f, 0.85f}, {"billboard person in a blue suit", "billboard", 1, 6.2f, 0.85f},
      {"billboard red car", "billboard", 2, 6.2f, 0.85f},       {"billboard black and white portrait", "billboard", 3, 6.2f, 0.85f},
      {"blue billboard", "billboard", 4, 6.2f, 0.85f},          {"bank with the purple sign", "bank_sign", 0, 4.6f, 1.0f}};
  // On long street walls around the plaza, one a building, spread over the blocks.
  const GroundRect reach = d.plan.reach();
  for (const BuildingPlan& plan : buildings) {
    if (plan.kept_free.area() <= 0) continue;
    const Vec2f at = plan.kept_free.center();
    PlaceNamed(d, "giant cola bottle", "giant_bottle", {at.x, at.y, plan.height()}, 0.8f);
  }
  size_t next = 0, last_block = ~size_t{0};
  for (const BuildingPlan& plan : buildings) {
    if (next == std::size(kSigns)) return;
    if (plan.block == last_block || plan.height() < 12.4f || !reach.Contains(plan.bounds().center())) continue;
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
      const float length = std::hypot(v.x, v.y);
      if (plan.edges[e] != EdgeKind::kStreet || length < 9.6f) continue;
      const Vec2f u = v * (1 / length), out{u.y, -u.x}, p = a + u * (length / 2) + out * 0.38f;
      const Sign& sign = kSigns[next++];
      PlaceNamed(d, sign.name, sign.kind, {p.x, p.y, sign.z}, FacingYaw(out), sign.variant, std::min(sign.scale, (length - 0.6f) / 10.3f));
      last_block = plan.block;
      break;
    }
  }
}

void PlaceDowntownLandmarks(District& d, const Block& plaza) {
  const Vec2f c = plaza.inner().center();
  Stand(d, "red telephone booth", "phone_booth", {c.x - 27.5f, c.y - 18}, 0.3f);
  Stand(d, "orange mailbox", "orange_mailbox", {c.x + 27.5f, c.y - 19}, -0.4f);
  Stand(d, "blue mailbox", "mailbox", {c.x - 27.5f, c.y - 5}, 1.5f);
  d.placer.Reserve({{c.x + 34, c.y + 4}, {2.2f, 2.2f}, 0});
  PlaceNamed(d, "small fountain", "fountain", {c.x + 34, c.y + 4, 0.004f}, 0, 0, 0.7f);
  Stand(d, "american flag on a mast", "us_flag", {c.x - 27.3f, c.y + 22.5f}, 0.5f);
  Stand(d, "blue barrier", "blue_barrier", {c.x + 27, c.y + 14.5f}, 1.2f);
  const StreetStretch street{d.plan.east_west[2], true, c.x - 40, c.x + 40};
  const Vec3f truck = street.At(c.x - 9, -(street.line.half_width - 1.25f), -0.004f);
  d.placer.Reserve({{truck.x, truck.y}, {3.3f, 1.25f}, 0});
  PlaceNamed(d, "food truck", "food_truck", truck, FacingYaw({1, 0}));
  const Vec2f tree{c.x + 27.5f, c.y - 12};
  LayTreePit(d.ground, tree);
  Stand(d, "tree with red leaves", "red_tree", tree, 0.6f);
}

}  // namespace airsim360::internal
