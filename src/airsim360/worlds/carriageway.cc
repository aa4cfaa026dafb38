#include <algorithm>
#include <cmath>
#include <numbers>

#include <string_view>

#include "airsim360/base/random.h"
#include "airsim360/image/draw.h"
#include "airsim360/worlds/ground.h"

namespace airsim360 {
namespace {

constexpr float kCornerRadius = 6, kGutterWidth = 0.35f;
constexpr float kPaintLift = 0.006f, kPatchLift = 0.003f, kIronLift = 0.005f;

// A rectangle on a stretch, following the crown.
void StreetRect(Ground& ground, const StreetStretch& street, float s0, float s1, float d0, float d1,
                float lift) {
  if (d0 < 0 && d1 > 0) {
    StreetRect(ground, street, s0, s1, d0, 0, lift);
    StreetRect(ground, street, s0, s1, 0, d1, lift);
    return;
  }
  ground.Quad(street.At(s0, d0, lift), street.At(s1, d0, lift), street.At(s1, d1, lift),
              street.At(s0, d1, lift));
}

void LayStretch(Ground& ground, const StreetStretch& street, const std::string& name, Surface asphalt) {
  const float hw = street.line.half_width;
  ground.Begin("road " + name, "ground/road", asphalt);
  // Texture coordinates follow the street: across, along.
  const float edge = hw - kGutterWidth, s0 = street.s0, s1 = street.s1;
  for (float d0 : {-edge, 0.0f}) {
    const float d1 = d0 + edge;
    ground.mesh().QuadUv(street.At(s0, d0), street.At(s1, d0), street.At(s1, d1), street.At(s0, d1), {d0, s0},
                         {d0, s1}, {d1, s1}, {d1, s0});
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

// Letters on the asphalt, read by who drives towards growing s (`way` +1) or against it.
void LayWord(Ground& ground, const StreetStretch& street, std::string_view word, float s, float d, float way,
             float height) {
  const float row = height / 7, column = 0.17f, width = column * (6 * static_cast<float>(word.size()) - 1);
  for (size_t i = 0; i < word.size(); ++i) {
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 5; ++x) {
        if (!HasInk(word[i], x, y)) continue;
        // Left of the reader is +d for way = +1; the top of a letter is further along.
        const float across = width / 2 - column * (6 * static_cast<float>(i) + static_cast<float>(x)),
                    along = height - row * static_cast<float>(y);
        const float s1 = s + way * along, s0 = s1 - way * row, d1 = d + way * across, d0 = d1 - way * column;
        StreetRect(ground, street, std::min(s0, s1), std::max(s0, s1), std::min(d0, d1), std::max(d0, d1),
                   2 * kPaintLift);
      }
    }
  }
}

// A straight-on arrow of 3 m.
void LayArrow(Ground& ground, const StreetStretch& street, float s, float d, float way) {
  const auto at = [&](float along, float across) {
    return street.At(s + way * along, d + way * across, kPaintLift);
  };
  ground.Quad(at(0, -0.09f), at(1.9f, -0.09f), at(1.9f, 0.09f), at(0, 0.09f));
  const Vec3f a = at(1.8f, -0.45f), b = at(3.0f, 0), c = at(1.8f, 0.45f);
  ground.mesh().Triangle(a, b, c, {a.x, -a.y}, {b.x, -b.y}, {c.x, -c.y});
}

void LayDashes(Ground& ground, const StreetStretch& street, float s0, float s1, float d) {
  for (float s = s0 + 1.5f; s + 3 < s1; s += 9)
    StreetRect(ground, street, s, s + 3, d - 0.06f, d + 0.06f, kPaintLift);
}

// Bicycle: two wheels and a frame, for riders towards growing s.
void LayBicycle(Ground& ground, const StreetStretch& street, float s, float d) {
  const auto stroke = [&](float s0, float d0, float s1, float d1) {
    const float l = std::hypot(s1 - s0, d1 - d0), ns = -(d1 - d0) / l * 0.04f, nd = (s1 - s0) / l * 0.04f;
    ground.Quad(street.At(s + s0 - ns, d + d0 - nd, 2 * kPaintLift), street.At(s + s1 - ns, d + d1 - nd, 2 * kPaintLift),
                street.At(s + s1 + ns, d + d1 + nd, 2 * kPaintLift), street.At(s + s0 + ns, d + d0 + nd, 2 * kPaintLift));
  };
  for (float hub : {-0.45f, 0.45f}) {
    for (int i = 0; i < 12; ++i) {
      const float a0 = 0.5236f * static_cast<float>(i), a1 = a0 + 0.5236f;
      stroke(0.5f + 0.55f * std::cos(a0), hub + 0.28f * std::sin(a0), 0.5f + 0.55f * std::cos(a1),
             hub + 0.28f * std::sin(a1));
    }
  }
  stroke(0.5f, -0.45f, 1.3f, -0.12f);
  stroke(1.3f, -0.12f, 1.35f, 0.33f);
  stroke(1.35f, 0.33f, 0.5f, 0.45f);
  stroke(0.5f, 0.0f, 1.3f, -0.12f);
  stroke(0.5f, 0.0f, 1.35f, 0.33f);
  stroke(0.5f, -0.45f, 0.5f, 0.0f);
  stroke(1.35f, 0.33f, 1.7f, 0.36f);
  stroke(1.7f, 0.2f, 1.7f, 0.5f);
}

void LayParkingBays(Ground& ground, const StreetStretch& street, float side) {
  const float hw = street.line.half_width, s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f, d = side * (hw - 2.35f);
  StreetRect(ground, street, s0, s1, d - 0.05f, d + 0.05f, kPaintLift);
  for (float s = s0 + 2; s < s1 - 2; s += 6.2f) {
    StreetRect(ground, street, s - 0.05f, s + 0.05f, std::min(d, side * (hw - 0.5f)) + 0.05f,
               std::max(d, side * (hw - 0.5f)) - 0.05f, kPaintLift);
  }
}

// Avenues and boulevards. Traffic keeps right: left of +s (d > 0) it runs towards smaller s.
void LayAvenueMarkings(Ground& ground, const StreetStretch& street, const std::string& name) {
  const float hw = street.line.half_width, s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f;
  const bool boulevard = street.line.kind == StreetKind::kBoulevard;
  if (boulevard) {
    ground.Begin("bike lane " + name, "ground/bike_lane", Surface::kBikeLane);
    StreetRect(ground, street, s0, s1, -10.45f, -8.75f, kPaintLift);
    ground.Begin("bus lane " + name, "ground/lane_marking", Surface::kBusLane);
    StreetRect(ground, street, s0, s1, 9.5f, hw - 0.4f, kPaintLift);
  }
  ground.Begin("markings " + name, "ground/lane_marking", Surface::kPaintYellow);
  if (boulevard) {
    for (float d : {-2.35f, 2.35f}) StreetRect(ground, street, s0, s1, d - 0.06f, d + 0.06f, kPaintLift);
  } else {
    StreetRect(ground, street, s0, s1, 0.08f, 0.19f, kPaintLift);
    StreetRect(ground, street, s0, s1, -0.19f, -0.08f, kPaintLift);
  }
  ground.Use(Surface::kPaintWhite);
  const float inner = boulevard ? 2.5f : 0.3f;
  StreetRect(ground, street, s0 - 0.6f, s0 - 0.15f, inner, hw - 0.5f, kPaintLift);
  StreetRect(ground, street, s1 + 0.15f, s1 + 0.6f, 0.5f - hw, -inner, kPaintLift);
  for (float side : {-1.0f, 1.0f}) {
    if (!boulevard || side < 0) LayParkingBays(ground, street, side);
    const std::vector<float> lines = !boulevard ? std::vector<float>{3.7f, 7.2f}
                                     : side < 0 ? std::vector<float>{5.5f}
                                                : std::vector<float>{5.9f};
    for (float d : lines) LayDashes(ground, street, s0, s1, side * d);
    for (float d : boulevard ? std::vector<float>{4.0f} : std::vector<float>{2.0f, 5.4f}) {
      LayArrow(ground, street, side < 0 ? s1 - 9 : s0 + 9, side * d, -side);
      LayArrow(ground, street, side < 0 ? s0 + 12 : s1 - 12, side * d, -side);
    }
  }
  if (!boulevard) return;
  for (float d : {-8.65f, -10.55f, 9.4f}) StreetRect(ground, street, s0, s1, d - 0.06f, d + 0.06f, 2 * kPaintLift);
  for (float s = s0 + 6; s < s1 - 8; s += 22) {
    LayBicycle(ground, street, s, -9.6f);
    LayWord(ground, street, "BUS", s + 4, 11.1f, -1, 2.6f);
    LayWord(ground, street, "ONLY", s, 11.1f, -1, 2.6f);
  }
}

void LayMarkings(Ground& ground, const StreetStretch& street, const std::string& name, bool bike_lane) {
  if (street.line.kind != StreetKind::kTwoWay) return LayAvenueMarkings(ground, street, name);
  const float hw = street.line.half_width, s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f, parking = hw - 2.35f;
  if (bike_lane) {
    ground.Begin("bike lane " + name, "ground/bike_lane", Surface::kBikeLane);
    StreetRect(ground, street, s0, s1, parking - 1.6f, parking - 0.12f, kPaintLift);
    StreetRect(ground, street, s0, s1, -parking + 0.12f, -parking + 1.6f, kPaintLift);
  }
  // Two yellow lines in the middle, white along the parking bays, and a stop bar before each crosswalk.
  ground.Begin("markings " + name, "ground/lane_marking", Surface::kPaintYellow);
  StreetRect(ground, street, s0, s1, 0.08f, 0.19f, kPaintLift);
  StreetRect(ground, street, s0, s1, -0.19f, -0.08f, kPaintLift);
  ground.Use(Surface::kPaintWhite);
  StreetRect(ground, street, s0 - 0.6f, s0 - 0.15f, 0.3f, parking, kPaintLift);
  StreetRect(ground, street, s1 + 0.15f, s1 + 0.6f, -parking, -0.3f, kPaintLift);
  for (float side : {-1.0f, 1.0f}) {
    const float d = side * parking;
    StreetRect(ground, street, s0, s1, d - 0.05f, d + 0.05f, kPaintLift);
    for (float s = s0 + 2; s < s1 - 2; s += 6.2f) {
      StreetRect(ground, street, s - 0.05f, s + 0.05f, std::min(d, side * (hw - 0.5f)) + 0.05f,
                 std::max(d, side * (hw - 0.5f)) - 0.05f, kPaintLift);
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

// The surface of a crossing: triangles from the middle to the rim.
struct Fan {
  Vec3f middle;
  std::vector<Vec3f> rim;
  float Height(Vec2f p) const {
    for (size_t i = 0; i < rim.size(); ++i) {
      const Vec3f a = rim[i] - middle, b = rim[(i + 1) % rim.size()] - middle;
      const float x = p.x - middle.x, y = p.y - middle.y, det = a.x * b.y - a.y * b.x;
      const float s = (x * b.y - y * b.x) / det, t = (a.x * y - a.y * x) / det;
      if (s >= -1e-4f && t >= -1e-4f) return middle.z + a.z * s + b.z * t;
    }
    return middle.z;
  }
};

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
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
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
  for (int i = 0; i < 3; ++i) {
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
  for (int i = 0; i < 9; ++i) {
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

// A boulevard's lines through a crossing: green bars of the bike lane, dashes between the lanes, arcs for those
// who turn left; draped over the fan.
void LayJunctionGuides(Ground& ground, const Fan& fan, const StreetLine& ns, const StreetLine& ew,
                       const std::string& name) {
  const auto on = [&](float x, float y) { return Vec3f{x, y, fan.Height({x, y}) + 0.012f}; };
  const auto rect = [&](float x0, float x1, float y0, float y1) {
    ground.Quad(on(x0, y0), on(x1, y0), on(x1, y1), on(x0, y1));
  };
  const float reach = ew.half_width + 4.6f;
  ground.Begin("bike lane crossing " + name, "ground/bike_lane", Surface::kBikeLane);
  for (float y = -reach; y < reach - 0.6f; y += 1.2f)
    rect(ns.center + 8.8f, ns.center + 10.4f, ew.center + y, ew.center + y + 0.62f);
  ground.Begin("guide lines " + name, "ground/lane_marking", Surface::kPaintWhite);
  for (float d : {5.5f, -5.9f}) {
    for (float y = -reach; y < reach - 0.6f; y += 1.9f)
      rect(ns.center + d - 0.06f, ns.center + d + 0.06f, ew.center + y, ew.center + y + 0.65f);
  }
  for (float side : {-1.0f, 1.0f}) {
    const Vec2f c{ns.center - side * 11, ew.center - side * reach};
    for (int i = 1; i < 13; i += 2) {
      const auto at = [&](float r, float a) {
        return on(c.x + side * r * std::cos(a), c.y + side * r * std::sin(a));
      };
      const float a0 = 0.11f * static_cast<float>(i), a1 = a0 + 0.07f;
      for (float r : {9.0f, 12.2f}) ground.Quad(at(r - 0.06f, a0), at(r + 0.06f, a0), at(r + 0.06f, a1), at(r - 0.06f, a1));
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
        LayMarkings(ground, street, name, plan.bike_lane_row >= 0 && along_x && static_cast<int>(i) == plan.bike_lane_row);
        if (is_core(k)) LayCrosswalk(ground, street, true, name + " start");
        if (is_core(k + 1)) LayCrosswalk(ground, street, false, name + " end");
        core.push_back(street);
      }
    }
  }
  for (size_t i = 0; i < plan.north_south.size(); ++i) {
    for (size_t k = 0; k < plan.east_west.size(); ++k) {
      const Fan fan = LayJunction(ground, plan.north_south[i], plan.east_west[k],
                                  std::to_string(i) + "." + std::to_string(k), Surface::kAsphalt);
      if (!is_core(i) || !is_core(k)) continue;
      LayJunctionWear(ground, fan, rng);
      if (plan.north_south[i].kind == StreetKind::kBoulevard)
        LayJunctionGuides(ground, fan, plan.north_south[i], plan.east_west[k], std::to_string(i) + "." + std::to_string(k));
    }
  }
  return core;
}

}  // namespace airsim360
