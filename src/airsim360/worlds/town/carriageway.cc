#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/worlds/town/street_markings.h"
#include "airsim360/worlds/town/street_wear.h"

namespace airsim360 {
namespace {

using internal::Fan;
using internal::StreetRect;

constexpr float kGutterWidth = 0.35f;
constexpr float kIronLift = 0.004f;

// Lanes of one side: where each begins, counted from the middle of the street, and its centre line.
struct Lane {
  float from, center;
};
std::vector<Lane> LanesOf(StreetKind kind) {
  if (kind == StreetKind::kAvenue) return {{0, 2.0f}, {3.72f, 5.45f}, {7.12f, 8.8f}};
  if (kind == StreetKind::kBoulevard) return {{0, 4.0f}, {5.65f, 7.35f}};
  return {{0, 1.72f}};
}

// Lanes were resurfaced piece by piece: each is cut into a few lengths of different age. `worn` false = all alike.
void LayStretch(Ground& ground, const StreetStretch& street, const std::string& name, Surface asphalt, bool worn, RngStream& rng) {
  static constexpr Surface kAges[] = {Surface::kCarriagewayFresh, Surface::kCarriagewayOld, Surface::kCarriagewayPale};
  const float hw = street.line.half_width;
  ground.Begin("road " + name, "ground/road", asphalt);
  // Texture coordinates follow the street, across and along. The shader's wheel tracks lie around a lane whose centre is
  // 1.72 m off: each lane has that there.
  const float edge = hw - kGutterWidth, s0 = street.s0, s1 = street.s1;
  const std::vector<Lane> lanes = LanesOf(street.line.kind);
  for (float side : {-1.0f, 1.0f}) {
    for (size_t i = 0; i < lanes.size(); ++i) {
      const float from = lanes[i].from, to = i + 1 < lanes.size() ? lanes[i + 1].from : edge, shift = 1.72f - lanes[i].center;
      const float d0 = side > 0 ? from : -to, d1 = side > 0 ? to : -from, u0 = d0 + side * shift, u1 = d1 + side * shift;
      for (float s = s0; s < s1;) {
        float end = worn ? s + static_cast<float>(rng.Uniform(12, 60)) : s1;
        if (end > s1 - 8) end = s1;
        if (worn) ground.Use(rng.Chance(0.45) ? kAges[rng.Index(3)] : asphalt);
        ground.mesh().QuadUv(street.At(s, d0), street.At(end, d0), street.At(end, d1), street.At(s, d1), {u0, s}, {u0, end}, {u1, end},
                             {u1, s});
        s = end;
      }
    }
  }
  ground.Use(Surface::kGutter);
  StreetRect(ground, street, street.s0, street.s1, -hw, -hw + kGutterWidth, 0);
  StreetRect(ground, street, street.s0, street.s1, hw - kGutterWidth, hw, 0);
}

void LayDrains(Ground& ground, const StreetStretch& street) {
  const float hw = street.line.half_width;
  for (float s = street.s0 + 8; s < street.s1 - 8; s += 26) {
    for (float side : {-1.0f, 1.0f}) {
      ground.Begin("drain", "ground/manhole", Surface::kIron);
      for (int bar = 0; bar < 7; ++bar) {
        const float at = s + 0.09f * static_cast<float>(bar), d = side * (hw - 0.2f);
        StreetRect(ground, street, at, at + 0.055f, d - 0.17f, d + 0.17f, kIronLift);
      }
    }
  }
}

// A crossing of two lines. The wheel tracks of the wider street run through.
Fan LayJunction(Ground& ground, const StreetLine& ns, const StreetLine& ew, const std::string& name, Surface asphalt) {
  ground.Begin("junction " + name, "ground/road", asphalt);
  Fan fan = internal::FanOf(ns, ew);
  const bool north = ns.half_width >= ew.half_width;
  const auto uv = [&](Vec3f p) { return north ? Vec2f{p.x - ns.center, p.y} : Vec2f{p.y - ew.center, p.x}; };
  for (size_t i = 0; i < fan.rim.size(); ++i) {
    const Vec3f a = fan.rim[i], b = fan.rim[(i + 1) % fan.rim.size()];
    ground.mesh().Triangle(fan.middle, a, b, uv(fan.middle), uv(a), uv(b));
  }
  return fan;
}

}  // namespace

namespace internal {

Fan FanOf(const StreetLine& ns, const StreetLine& ew) {
  std::vector<Vec3f> rim;
  const float hx = ns.half_width, hy = ew.half_width, r = kCornerRadius;
  for (int arm = 0; arm < 4; ++arm) {
    // The mouth, in directions (out, left) of the arm: 0 east, 1 north, 2 west, 3 south.
    const bool along_x = arm % 2 == 0;
    const StreetLine& line = along_x ? ew : ns;
    const float reach = (along_x ? hx : hy) + r, w = line.half_width, next = along_x ? hx : hy;
    const Vec2f out = arm == 0 ? Vec2f{1, 0} : arm == 1 ? Vec2f{0, 1} : arm == 2 ? Vec2f{-1, 0} : Vec2f{0, -1};
    const Vec2f left{-out.y, out.x};
    const auto add = [&](float o, float l, float z) {
      rim.push_back({ns.center + out.x * o + left.x * l, ew.center + out.y * o + left.y * l, z});
    };
    for (float d : {-w, -w + kGutterWidth, 0.0f, w - kGutterWidth}) add(reach, d, CarriagewayHeight(line, d));
    // The kerb return between this arm and the next one to the left.
    for (int i = 0; i <= 9; ++i) {
      const float a = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / 10;
      add(next + r - r * std::sin(a), w + r - r * std::cos(a), -0.13f);
    }
  }
  const Vec3f middle{ns.center, ew.center, std::max(CarriagewayHeight(ns, 0), CarriagewayHeight(ew, 0))};
  return {middle, rim};
}

}  // namespace internal

std::vector<StreetStretch> LayStreets(Ground& ground, const StreetPlan& plan, uint64_t seed) {
  std::vector<StreetStretch> core;
  const bool white = plan.paint == RoadPaint::kWhiteLines;
  const auto lay_crosswalk = white ? internal::LayLinedCrosswalk : internal::LayCrosswalk;
  const auto is_core = [&](size_t i) { return static_cast<int>(i) >= plan.first_core && static_cast<int>(i) <= plan.last_core; };
  RngStream rng(seed, "street wear");

  for (bool along_x : {true, false}) {
    const auto& lines = along_x ? plan.east_west : plan.north_south;
    const auto& crossings = along_x ? plan.north_south : plan.east_west;
    for (size_t i = 0; i < lines.size(); ++i) {
      for (size_t k = 0; k + 1 < crossings.size(); ++k) {
        const StreetStretch street{lines[i], along_x, crossings[k].center + crossings[k].half_width + kCornerRadius,
                                   crossings[k + 1].center - crossings[k + 1].half_width - kCornerRadius};
        const std::string name = std::string(along_x ? "EW" : "NS") + std::to_string(i) + "." + std::to_string(k);
        LayStretch(ground, street, name, rng.Chance(0.3) ? Surface::kCarriagewayOld : Surface::kCarriageway, is_core(i), rng);
        if (!is_core(i)) continue;
        internal::LayWear(ground, street, rng);
        LayDrains(ground, street);
        if (white)
          internal::LayWhiteLines(ground, street, name);
        else
          internal::LayMarkings(ground, street, name, plan.bike_lane_row >= 0 && along_x && static_cast<int>(i) == plan.bike_lane_row);
        if (is_core(k)) lay_crosswalk(ground, street, true, name + " start");
        if (is_core(k + 1)) lay_crosswalk(ground, street, false, name + " end");
        core.push_back(street);
      }
    }
  }
  for (size_t i = 0; i < plan.north_south.size(); ++i) {
    for (size_t k = 0; k < plan.east_west.size(); ++k) {
      const Fan fan = LayJunction(ground, plan.north_south[i], plan.east_west[k], std::to_string(i) + "." + std::to_string(k),
                                  rng.Chance(0.4) ? Surface::kCarriagewayOld : Surface::kCarriageway);
      if (!is_core(i) || !is_core(k)) continue;
      internal::LayJunctionWear(ground, fan, rng);
      if (white) continue;
      if (plan.north_south[i].kind == StreetKind::kBoulevard)
        internal::LayJunctionGuides(ground, fan, plan.north_south[i], plan.east_west[k], std::to_string(i) + "." + std::to_string(k));
      else if (plan.north_south[i].kind == StreetKind::kAvenue && (i + k) % 2 == 1)
        internal::LayJunctionBox(ground, fan, plan.north_south[i], plan.east_west[k], std::to_string(i) + "." + std::to_string(k));
    }
  }
  return core;
}

}  // namespace airsim360
