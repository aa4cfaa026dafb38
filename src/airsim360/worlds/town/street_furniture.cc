#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town/pavement_side.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360::internal {
namespace {

struct Strip : PavementSide {
  std::vector<float> lamps;  // where along it
};

void PutAt(District& d, const Strip& strip, const char* kind, float s, float depth, Vec2f front, float scale = 1) {
  const Vec2f p = strip.line.At(s, depth);
  d.placer.Try(kind, {p.x, p.y, 0}, FacingYaw(front), scale);
}

// Individuals whose crowns stay off the walls 3.8 m away: variant and scale.
struct StreetTree {
  const char* kind;
  uint32_t variant;
  float scale;
};
constexpr StreetTree kStreetTrees[] = {{"tree_generic", 5, 1.0f},    {"tree_generic", 2, 0.85f},   {"tree_generic", 3, 0.76f},
                                       {"tree_narrowleaf", 0, 1.0f}, {"tree_narrowleaf", 2, 1.0f}, {"tree_narrowleaf", 1, 0.9f}};

// A row of trees in pits every 8.4 or 9.6 m, none where a lamp stands in the crown.
void PlantStreetTrees(District& d, const Strip& strip, bool open, RngStream& rng) {
  if (!open && !rng.Chance(0.75)) return;
  const uint32_t species = 3 * rng.Index(2);
  const float pitch = rng.Chance(0.5) ? 8.4f : 9.6f;
  for (float s = strip.s0 + 4.5f; s < strip.s1 - 3; s += pitch) {
    const bool at_lamp = std::any_of(strip.lamps.begin(), strip.lamps.end(), [&](float lamp) { return std::abs(s - lamp) < 3; });
    const float at = at_lamp ? s + 3.2f : s;
    const StreetTree& tree = kStreetTrees[species + rng.Index(3)];
    const Vec2f p = strip.line.At(at, 1.15f);
    const auto turn = static_cast<float>(rng.Uniform(0, kTauF));
    const float scale = tree.scale * static_cast<float>(rng.Uniform(0.85, 1.0));
    if (d.placer.Try(tree.kind, {p.x, p.y, 0}, turn, scale, {1, 1, 1}, tree.variant)) LayTreePit(d.ground, p);
  }
}

// Lamps, trees between them, then smaller things where there is room.
void FurnishSide(District& d, const Strip& strip, const Block& block, RngStream& rng) {
  const Vec2f street = strip.street();
  const bool open = block.kind == BlockKind::kPlaza || block.kind == BlockKind::kPark;
  for (size_t i = 0; i < strip.lamps.size(); ++i)
    PutAt(d, strip, open && i % 2 ? "lamp_post" : "street_light", strip.lamps[i], 0.65f, street);
  PlantStreetTrees(d, strip, open, rng);
  for (float s = strip.s0 + 3.1f; s < strip.s1 - 2; s += 12.4f) PutAt(d, strip, "parking_meter", s, 0.5f, strip.line.inward);
  struct Rule {
    const char* kind;
    float spacing, depth;
    bool faces_street;
  };
  static constexpr Rule kRules[] = {
      {"fire_hydrant", 70, 0.55f, true},  {"trash_can", 30, 0.8f, false}, {"recycle_bin", 44, 0.8f, false},
      {"bench_wood", 24, 1.05f, false},   {"mailbox", 90, 0.75f, false},  {"electric_box", 60, 0.8f, false},
      {"poster_stand", 55, 0.95f, false}, {"bicycle", 26, 1.2f, true},    {"traffic_sign", 40, 0.5f, true},
  };
  for (const Rule& rule : kRules) {
    for (float s = strip.s0 + static_cast<float>(rng.Uniform(0.05, 0.9)) * rule.spacing; s < strip.s1; s += rule.spacing) {
      PutAt(d, strip, rule.kind, s, rule.depth, rule.faces_street ? street : strip.line.inward);
      if (rule.kind == std::string_view("bicycle")) {
        PutAt(d, strip, rule.kind, s + 0.8f, rule.depth, street);
        PutAt(d, strip, rule.kind, s + 1.6f, rule.depth, street);
      }
    }
  }
  // Pots and menu boards by the shop doors.
  for (float s = strip.s0; !open && s < strip.s1; s += 4.9f) {
    if (rng.Chance(0.4)) PutAt(d, strip, rng.Chance(0.8) ? "pot" : "planter", s, strip.depth - 0.6f, street);
  }
}

// A pavement café: tables under umbrellas by the wall.
void PlaceCafe(District& d, const Strip& strip, float s) {
  RngStream& rng = d.placer.rng();
  for (int i = 0; i < 4; ++i) {
    const Vec2f p = strip.line.At(s + 2.6f * static_cast<float>(i), strip.depth - 1.4f);
    const auto style = static_cast<uint32_t>(rng.Index(4));
    if (!d.placer.Try("dining_table", {p.x, p.y, 0}, 0, 1, {1, 1, 1}, style)) continue;
    if (i % 2 == 0) d.placer.Put("umbrella", {p.x, p.y, 0});
    for (float a : {0.0f, 1.0f}) {
      const Vec2f along = strip.line.along * (a > 0 ? 0.9f : -0.9f), q = p + along;
      d.placer.Put("dining_chair", {q.x, q.y, 0}, FacingYaw(along * -1.0f), 1, {1, 1, 1}, style);
    }
  }
}

}  // namespace

void FurnishCorner(District& d, const Block& block, const BlockSide& side, std::string_view bollard) {
  const float r = block.corner_radius;
  const auto at = [&](float radius, float a) { return side.At(side.length - r + radius * std::sin(a), r - radius * std::cos(a)); };
  const float eighth = kTauF / 8;
  const Vec2f p = at(r - 0.55f, eighth * 0.35f), q = at(r - 0.55f, eighth * 1.65f);
  // One mast with an arm over the street, green for the east-west streets; one post for those on foot.
  const bool east_west = std::abs(side.along.x) > 0.5f;
  d.placer.Try("traffic_light", {p.x, p.y, 0}, FacingYaw(side.along * -1.0f), 1, {1, 1, 1}, east_west ? 2u : 0u);
  d.placer.Try("traffic_light", {q.x, q.y, 0}, FacingYaw(side.inward * -1.0f), 1, {1, 1, 1}, 1u);
  for (int i = 0; i < 5; ++i) {
    const Vec2f b = at(r - 0.5f, eighth * (0.7f + 0.15f * static_cast<float>(i)));
    d.placer.Try(bollard, {b.x, b.y, 0}, 0, 1, {1, 1, 1}, 0u);
  }
}

void LayCrossingCovers(District& d) {
  for (int i = d.plan.first_core; i <= d.plan.last_core; ++i) {
    for (int k = d.plan.first_core; k <= d.plan.last_core; ++k) {
      const StreetLine &ns = d.plan.north_south[static_cast<size_t>(i)], &ew = d.plan.east_west[static_cast<size_t>(k)];
      const float z = std::max(CarriagewayHeight(ns, 0), CarriagewayHeight(ew, 0));
      d.placer.shelf().Place("manhole", {ns.center, ew.center, z}, 0.3f * static_cast<float>(i + k), static_cast<uint32_t>(i + k));
    }
  }
}

void DriveAcross(District& d, std::string_view cab, double traffic) {
  for (int i = d.plan.first_core; i <= d.plan.last_core; ++i) {
    for (int k = d.plan.first_core; k <= d.plan.last_core; ++k) {
      const StreetLine &ns = d.plan.north_south[static_cast<size_t>(i)], &ew = d.plan.east_west[static_cast<size_t>(k)];
      RngStream rng(d.seed, "crossing traffic", static_cast<uint64_t>(i * 64 + k));
      const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
      const Fan fan = FanOf(ns, ew);
      const float lane = (ew.half_width - 2.35f) * 0.5f;
      const auto drive = [&](float x, float y, Vec2f heading) {
        const double pick = rng.Uniform();
        const std::string_view kind = pick < 0.33 ? cab : pick < 0.9 ? "car" : "van";
        if (!rng.Chance(std::min(1.0, traffic))) return;
        const Vec2f p{ns.center + x, ew.center + y};
        d.placer.Drive(kind, {p.x, p.y, fan.Height(p) - 0.004f}, FacingYaw(heading) + uniform(-0.02, 0.02));
      };
      // Traffic keeps right: eastbound south of the middle.
      for (float side : {-1.0f, 1.0f}) {
        for (float x = -ns.half_width + uniform(0, 5); x < ns.half_width; x += uniform(8, 14))
          if (rng.Chance(0.75)) drive(x, side * lane, {-side, 0});
      }
      if (ns.half_width < 8) continue;
      // Turning left from the east into the lane beyond the middle.
      const float a = uniform(0.5, 1.0);
      drive(-2.5f + uniform(0, 2), -1.0f - uniform(0, 2), {-std::cos(a), -std::sin(a)});
    }
  }
}

bool FacesCoreStreet(const StreetPlan& plan, const Block& block, int side) {
  const int line = side == 0 ? block.row : side == 1 ? block.column + 1 : side == 2 ? block.row + 1 : block.column;
  return line >= plan.first_core && line <= plan.last_core;
}

std::vector<float> LampsAlong(const StreetPlan& plan, const Block& block, int side, float s0, float s1, RngStream& rng) {
  constexpr float kNearest = 20.2f, kFromKerb = 0.65f;
  const auto column = static_cast<size_t>(block.column), row = static_cast<size_t>(block.row);
  const StreetLine& street = side == 0   ? plan.east_west[row]
                             : side == 1 ? plan.north_south[column + 1]
                             : side == 2 ? plan.east_west[row + 1]
                                         : plan.north_south[column];
  const float across = 2 * (street.half_width + kFromKerb);
  const bool wide = across > kNearest - 2;
  const float pitch = wide ? kNearest : 2 * std::sqrt(kNearest * kNearest - across * across);
  const float middle = (s0 + s1) / 2 + (side >= 2 && !wide ? pitch / 2 : 0);
  std::vector<float> lamps;
  for (float s = middle - pitch * std::floor((middle - s0) / pitch); s <= s1; s += pitch)
    lamps.push_back(s + static_cast<float>(rng.Uniform(-0.9, 0.9)));
  return lamps;
}

void FurnishPavements(District& d) {
  const GroundRect reach = d.plan.reach();
  for (size_t i = 0; i < d.plan.blocks.size(); ++i) {
    const Block& block = d.plan.blocks[i];
    for (int k = 0; k < 4; ++k) {
      if (!FacesCoreStreet(d.plan, block, k)) continue;
      RngStream rng(d.seed, "pavement", i * 4 + static_cast<size_t>(k));
      Strip strip{SideBetweenRamps(block, k), {}};
      strip.lamps = LampsAlong(d.plan, block, k, strip.s0, strip.s1, rng);
      if (reach.Contains(strip.line.At(strip.line.length - 1, 3))) FurnishCorner(d, block, strip.line, "car_pillar");
      if (block.kind == BlockKind::kBuilt && rng.Chance(0.45))
        PlaceCafe(d, strip, static_cast<float>(rng.Uniform(strip.s0, strip.s1 - 10)));
      if (block.kind == BlockKind::kBuilt && k == static_cast<int>(i % 4))
        PutAt(d, strip, "bus_stop", (strip.s0 + strip.s1) / 2 + 3, 1.35f, strip.street());
      FurnishSide(d, strip, block, rng);
    }
  }
}

void FurnishStreets(District& d, const std::vector<StreetStretch>& streets) {
  LayCrossingCovers(d);
  DriveAcross(d, "car", 0.7);
  for (size_t i = 0; i < streets.size(); ++i) {
    const StreetStretch& street = streets[i];
    RngStream rng(d.seed, "traffic", i);
    const float hw = street.line.half_width, s0 = street.s0 + 7.6f, s1 = street.s1 - 7.6f;
    const Vec2f forward = street.along_x ? Vec2f{1, 0} : Vec2f{0, 1};
    for (float side : {-1.0f, 1.0f}) {
      // Traffic keeps right: the left side of +s runs backwards.
      const Vec2f heading = forward * -side;
      for (float s = s0 + 3.1f; s + 3.1f < s1 + 0.1f; s += 6.2f) {
        if (!rng.Chance(0.64)) continue;
        const auto wobble = static_cast<float>(rng.Uniform(-0.25, 0.25));
        d.placer.Try(rng.Chance(0.86) ? "car" : "van", street.At(s + wobble, side * (hw - 1.22f), -0.004f),
                     FacingYaw(heading) + static_cast<float>(rng.Uniform(-0.015, 0.015)));
      }
      const float lane = side * (hw - 2.35f) * 0.52f;
      if (rng.Chance(0.75)) d.placer.Drive("car", street.At(static_cast<float>(rng.Uniform(s0, s1)), lane, -0.004f), FacingYaw(heading));
      if (i % 5 == 2 && side > 0) d.placer.Drive("bus", street.At((s0 + s1) / 2, lane, -0.004f), FacingYaw(heading));
    }
    for (int k = 0; k < 3; ++k) {
      const float d0 = static_cast<float>(rng.Uniform(0.9, hw - 3.2)) * (rng.Chance(0.5) ? 1.0f : -1.0f);
      const Vec3f p = street.At(static_cast<float>(rng.Uniform(s0, s1)), d0, 0.001f);
      d.placer.shelf().Place("manhole", p, static_cast<float>(rng.Uniform(0, kTauF)), rng.Index(2));
    }
  }
}

}  // namespace airsim360::internal
