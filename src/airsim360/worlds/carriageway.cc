#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/worlds/street_markings.h"

namespace airsim360 {
namespace {

using internal::Fan;
using internal::kPaintLift;
using internal::StreetRect;

constexpr float kCornerRadius = 6, kGutterWidth = 0.35f;
constexpr float kPatchLift = 0.003f, kIronLift = 0.005f;

// Lanes of one side: where each begins, counted from the middle of the street, and its centre line.
struct Lane {
  float from, center;
};
std::vector<Lane> LanesOf(StreetKind kind) {
  if (kind == StreetKind::kAvenue) return {{0, 2.0f}, {3.72f, 5.45f}, {7.12f, 8.8f}};
  if (kind == StreetKind::kBoulevard) return {{0, 4.0f}, {5.65f, 7.35f}};
  return {{0, 1.72f}};
}

void LayStretch(Ground& ground, const StreetStretch& street, const std::string& name, Surface asphalt) {
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
      ground.mesh().QuadUv(street.At(s0, d0), street.At(s1, d0), street.At(s1, d1), street.At(s0, d1), {u0, s0}, {u0, s1},
                           {u1, s1}, {u1, s0});
    }
  }
  ground.Use(Surface::kGutter);
  StreetRect(ground, street, street.s0, street.s1, -hw, -hw + kGutterWidth, 0);
  StreetRect(ground, street, street.s0, street.s1, hw - kGutterWidth, hw, 0);
}

// Repairs and cracks: part of the road entity that was laid last.
void LayWear(Ground& ground, const StreetStretch& street, RngStream& rng) {
  const float hw = street.line.half_width - 0.6f;
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  for (int i = 0; i < 4; ++i) {
    const float s = uniform(street.s0 + 6, street.s1 - 12), d = uniform(0.3f, hw - 2.2f),
                side = rng.Chance(0.5) ? 1.0f : -1.0f;
    const float d0 = side > 0 ? d : -d - 1.7f, length = uniform(1.2f, 5);
    ground.Use(Surface::kTar);
    StreetRect(ground, street, s - 0.03f, s + length + 0.03f, d0 - 0.03f, d0 + 1.73f, kPatchLift);
    ground.Use(rng.Chance(0.6) ? Surface::kAsphaltPatch : Surface::kAsphaltOld);
    StreetRect(ground, street, s, s + length, d0, d0 + 1.7f, kPatchLift + 0.001f);
  }
  // Sealed cracks wander along the street within one half of it.
  ground.Use(Surface::kTar);
  for (int i = 0; i < 7; ++i) {
    const float side = rng.Chance(0.5) ? 1.0f : -1.0f;
    float s = uniform(street.s0 + 2, street.s1 - 14), d = uniform(0.8f, hw - 0.8f);
    for (int k = 0; k < 14; ++k) {
      const float next_s = s + uniform(0.3f, 0.9f), next_d = std::clamp(d + uniform(-0.35f, 0.35f), 0.3f, hw);
      const float w = uniform(0.012f, 0.028f);
      const float a0 = side * d - w, a1 = side * d + w, b0 = side * next_d - w, b1 = side * next_d + w;
      ground.Quad(street.At(s, a0, kPatchLift), street.At(next_s, b0, kPatchLift),
                  street.At(next_s, b1, kPatchLift), street.At(s, a1, kPatchLift));
      s = next_s;
      d = next_d;
    }
  }
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

void LayCrosswalk(Ground& ground, const StreetStretch& street, bool at_start, const std::string& name) {
  const float hw = street.line.half_width;
  const float from = at_start ? street.s0 + kCrosswalkStart : street.s1 - kCrosswalkStart - kCrosswalkWidth;
  ground.Begin("crosswalk " + name, "ground/crosswalk", Surface::kPaintWhite);
  const int bars = static_cast<int>((2 * hw - 0.8f) / 1.0f);
  const float first = -0.5f * static_cast<float>(bars) + 0.25f;
  for (int i = 0; i < bars; ++i) {
    const float d = first + static_cast<float>(i);
    StreetRect(ground, street, from, from + kCrosswalkWidth, d, d + 0.5f, kPaintLift);
  }
}

// A crossing of two lines: a fan from its middle over the four mouths and the four kerb returns.
Fan LayJunction(Ground& ground, const StreetLine& ns, const StreetLine& ew, const std::string& name,
                Surface asphalt) {
  ground.Begin("junction " + name, "ground/road", asphalt);
  std::vector<Vec3f> rim;
  const float hx = ns.half_width, hy = ew.half_width, r = kCornerRadius;
  for (int arm = 0; arm < 4; ++arm) {
    // The mouth, in directions (out, left) of the arm: 0 east, 1 north, 2 west, 3 south.
    const bool along_x = arm % 2 == 0;
    const StreetLine& line = along_x ? ew : ns;
    const float reach = (along_x ? hx : hy) + r, w = line.half_width, next = along_x ? hx : hy;
    const Vec2f out = arm == 0   ? Vec2f{1, 0}
                      : arm == 1 ? Vec2f{0, 1}
                      : arm == 2 ? Vec2f{-1, 0}
                                 : Vec2f{0, -1};
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
  // The wheel tracks of the wider street run through.
  const bool north = ns.half_width >= ew.half_width;
  const auto uv = [&](Vec3f p) { return north ? Vec2f{p.x - ns.center, p.y} : Vec2f{p.y - ew.center, p.x}; };
  for (size_t i = 0; i < rim.size(); ++i) {
    const Vec3f a = rim[i], b = rim[(i + 1) % rim.size()];
    ground.mesh().Triangle(middle, a, b, uv(middle), uv(a), uv(b));
  }
  return {middle, rim};
}

// Sealed cracks and repairs on a crossing, draped over its fan; part of the entity laid last.
void LayJunctionWear(Ground& ground, const Fan& fan, RngStream& rng) {
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  const auto on = [&](float x, float y, float lift) { return Vec3f{x, y, fan.Height({x, y}) + lift}; };
  const float reach = 8.5f;
  for (int i = 0; i < 6; ++i) {
    const float x0 = fan.middle.x + uniform(-reach, reach - 3),
                y0 = fan.middle.y + uniform(-reach, reach - 3);
    const int nx = 4 + static_cast<int>(rng.Index(8)), ny = 3 + static_cast<int>(rng.Index(5));
    ground.Use(rng.Chance(0.6) ? Surface::kAsphaltPatch : Surface::kAsphaltOld);
    for (int k = 0; k < nx * ny; ++k) {
      const float x = x0 + 0.4f * static_cast<float>(k % nx), y = y0 + 0.4f * static_cast<float>(k / nx);
      if (std::hypot(x + 0.2f - fan.middle.x, y + 0.2f - fan.middle.y) < 0.9f)
        continue;  // the cover in the middle
      ground.Quad(on(x, y, 0.006f), on(x + 0.4f, y, 0.006f), on(x + 0.4f, y + 0.4f, 0.006f),
                  on(x, y + 0.4f, 0.006f));
    }
  }
  ground.Use(Surface::kTar);
  for (int i = 0; i < 18; ++i) {
    float x = fan.middle.x + uniform(-reach, reach), y = fan.middle.y + uniform(-reach, reach),
          a = uniform(0, 6.28f);
    for (int k = 0; k < 12; ++k) {
      a += uniform(-0.5f, 0.5f);
      const float step = uniform(0.3f, 0.7f), nx = x + step * std::cos(a), ny = y + step * std::sin(a),
                  w = uniform(0.012f, 0.026f);
      const float px = -std::sin(a) * w, py = std::cos(a) * w;
      if (std::max(std::abs(nx - fan.middle.x), std::abs(ny - fan.middle.y)) > reach + 2) break;
      ground.Quad(on(x - px, y - py, 0.009f), on(nx - px, ny - py, 0.009f), on(nx + px, ny + py, 0.009f),
                  on(x + px, y + py, 0.009f));
      x = nx;
      y = ny;
    }
  }
}

}  // namespace

std::vector<StreetStretch> LayStreets(Ground& ground, const StreetPlan& plan, uint64_t seed) {
  std::vector<StreetStretch> core;
  const auto is_core = [&](size_t i) {
    return static_cast<int>(i) >= plan.first_core && static_cast<int>(i) <= plan.last_core;
  };
  RngStream rng(seed, "street wear");

  for (bool along_x : {true, false}) {
    const auto& lines = along_x ? plan.east_west : plan.north_south;
    const auto& crossings = along_x ? plan.north_south : plan.east_west;
    for (size_t i = 0; i < lines.size(); ++i) {
      for (size_t k = 0; k + 1 < crossings.size(); ++k) {
        const StreetStretch street{lines[i], along_x,
                                   crossings[k].center + crossings[k].half_width + kCornerRadius,
                                   crossings[k + 1].center - crossings[k + 1].half_width - kCornerRadius};
        const std::string name =
            std::string(along_x ? "EW" : "NS") + std::to_string(i) + "." + std::to_string(k);
        LayStretch(ground, street, name, rng.Chance(0.3) ? Surface::kCarriagewayOld : Surface::kCarriageway);
        if (!is_core(i)) continue;
        LayWear(ground, street, rng);
        LayDrains(ground, street);
        internal::LayMarkings(
            ground, street, name,
            plan.bike_lane_row >= 0 && along_x && static_cast<int>(i) == plan.bike_lane_row);
        if (is_core(k)) LayCrosswalk(ground, street, true, name + " start");
        if (is_core(k + 1)) LayCrosswalk(ground, street, false, name + " end");
        core.push_back(street);
      }
    }
  }
  for (size_t i = 0; i < plan.north_south.size(); ++i) {
    for (size_t k = 0; k < plan.east_west.size(); ++k) {
      const Fan fan = LayJunction(ground, plan.north_south[i], plan.east_west[k],
                                  std::to_string(i) + "." + std::to_string(k),
                                  rng.Chance(0.4) ? Surface::kCarriagewayOld : Surface::kCarriageway);
      if (!is_core(i) || !is_core(k)) continue;
      LayJunctionWear(ground, fan, rng);
      if (plan.north_south[i].kind == StreetKind::kBoulevard)
        internal::LayJunctionGuides(ground, fan, plan.north_south[i], plan.east_west[k],
                                    std::to_string(i) + "." + std::to_string(k));
    }
  }
  return core;
}

}  // namespace airsim360
