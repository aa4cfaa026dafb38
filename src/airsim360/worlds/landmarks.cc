// What flight instructions name, in downtown_west: each exactly once.
#include <cmath>

#include "airsim360/worlds/district.h"
#include "airsim360/worlds/new_york_city/city.h"

namespace airsim360::internal {
namespace {

void Stand(District& d, std::string name, std::string_view kind, Vec2f at, float yaw, float z = 0) {
  d.placer.Reserve(FootprintOf(kind, at, yaw));
  PlaceNamed(d, std::move(name), kind, {at.x, at.y, z}, yaw);
}

}  // namespace

void HangDowntownSigns(District& d, const std::vector<BuildingPlan>& buildings) {
  struct Sign {
    const char* name;
    const char* kind;
    uint32_t variant;
    float z, scale;
  };
  static constexpr Sign kSigns[] = {{"billboard BLACK & WHITE", "billboard", 0, 6.2f, 0.85f},
                                    {"billboard person in a blue suit", "billboard", 1, 6.2f, 0.85f},
                                    {"billboard red car", "billboard", 2, 6.2f, 0.85f},
                                    {"billboard black and white portrait", "billboard", 3, 6.2f, 0.85f},
                                    {"blue billboard", "billboard", 4, 6.2f, 0.85f},
                                    {"bank with the purple sign", "bank_sign", 0, 4.6f, 1.0f}};
  // On long street walls around the plaza, one a building, spread over the blocks.
  const GroundRect reach = d.plan.reach();
  size_t next = 0, last_block = ~size_t{0};
  for (const BuildingPlan& plan : buildings) {
    if (next == std::size(kSigns)) return;
    if (plan.block == last_block || plan.height() < 16 || !reach.Contains(plan.bounds().center())) continue;
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
      const float length = std::hypot(v.x, v.y);
      if (plan.edges[e] != EdgeKind::kStreet || length < 12.5f) continue;
      const Vec2f u = v * (1 / length), out{u.y, -u.x}, p = a + u * (length / 2) + out * 0.38f;
      const Sign& sign = kSigns[next++];
      PlaceNamed(d, sign.name, sign.kind, {p.x, p.y, sign.z}, FacingYaw(out), sign.variant, sign.scale);
      last_block = plan.block;
      break;
    }
  }
}

void PlaceDowntownLandmarks(District& d, const Block& plaza) {
  const Vec2f c = plaza.inner().center();
  Stand(d, "red telephone booth", "phone_booth", {c.x - 27.5f, c.y - 18}, 0.3f);
  Stand(d, "orange mailbox", "orange_mailbox", {c.x + 27.5f, c.y - 19}, -0.4f);
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
