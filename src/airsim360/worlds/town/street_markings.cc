#include "airsim360/worlds/town/street_markings.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "airsim360/image/draw.h"
#include "airsim360/worlds/kit/bicycle_sign.h"

namespace airsim360::internal {
namespace {

// Letters on the asphalt, read by who drives towards growing s (`way` +1) or against it.
void LayWord(Ground& ground, const StreetStretch& street, std::string_view word, float s, float d, float way, float height) {
  constexpr float kMostWidth = 2.7f;  // of a word in a lane
  const float columns = 6 * static_cast<float>(word.size()) - 1, row = height / 7, column = std::min(0.17f, kMostWidth / columns),
              width = column * columns;
  for (size_t i = 0; i < word.size(); ++i) {
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 5; ++x) {
        if (!HasInk(word[i], x, y)) continue;
        // Left of the reader is +d for way = +1; the top of a letter is further along.
        const float across = width / 2 - column * (6 * static_cast<float>(i) + static_cast<float>(x)),
                    along = height - row * static_cast<float>(y);
        const float s1 = s + way * along, s0 = s1 - way * row, d1 = d + way * across, d0 = d1 - way * column;
        StreetRect(ground, street, std::min(s0, s1), std::max(s0, s1), std::min(d0, d1), std::max(d0, d1), 2 * kPaintLift);
      }
    }
  }
}

// A straight-on arrow of 3 m.
void LayArrow(Ground& ground, const StreetStretch& street, float s, float d, float way) {
  const auto at = [&](float along, float across) { return street.At(s + way * along, d + way * across, kPaintLift); };
  ground.Quad(at(0, -0.09f), at(1.9f, -0.09f), at(1.9f, 0.09f), at(0, 0.09f));
  const Vec3f a = at(1.8f, -0.45f), b = at(3.0f, 0), c = at(1.8f, 0.45f);
  ground.mesh().Triangle(a, b, c, {a.x, -a.y}, {b.x, -b.y}, {c.x, -c.y});
}

void LayDashes(Ground& ground, const StreetStretch& street, float s0, float s1, float d) {
  for (float s = s0 + 1.5f; s + 3 < s1; s += 9) StreetRect(ground, street, s, s + 3, d - 0.06f, d + 0.06f, kPaintLift);
}

// The sign of a bicycle in a lane at `d`, for those who ride towards growing s (`way` +1) or against it.
void LayBicycle(Ground& ground, const StreetStretch& street, float s, float d, float way, float scale) {
  for (const SignStroke& line : BicycleSign()) {
    const Vec2f a = line.from * scale, b = line.to * scale;
    const float l = std::hypot(b.x - a.x, b.y - a.y), ns = -(b.y - a.y) / l * (kSignStroke / 2), nd = (b.x - a.x) / l * (kSignStroke / 2);
    const auto at = [&](Vec2f p, float side) {
      return street.At(s + way * p.x + side * way * ns, d + way * p.y + side * way * nd, 2 * kPaintLift);
    };
    ground.Quad(at(a, -1), at(b, -1), at(b, 1), at(a, 1));
  }
}

// The lane of bicycles on both sides of a two-way street: a line towards the cars, and signs. The bays have a line of their own.
void LayBikeLaneMarkings(Ground& ground, const StreetStretch& street, float s0, float s1, float parking) {
  constexpr float kNarrow = 0.8f;  // of the sign, so that it keeps off the lines
  for (float side : {-1.0f, 1.0f}) {
    const float d = side * (parking - 1.66f);
    StreetRect(ground, street, s0, s1, d - 0.06f, d + 0.06f, kPaintLift);
    for (float s = s0 + 7; s < s1 - 7; s += 24) LayBicycle(ground, street, side < 0 ? s : s + 2, side * (parking - 0.86f), -side, kNarrow);
  }
}

void LayParkingBays(Ground& ground, const StreetStretch& street, float side) {
  const float hw = street.line.half_width, s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f, d = side * (hw - 2.35f);
  StreetRect(ground, street, s0, s1, d - 0.05f, d + 0.05f, kPaintLift);
  for (float s = s0 + 2; s < s1 - 2; s += 6.2f) {
    StreetRect(ground, street, s - 0.05f, s + 0.05f, std::min(d, side * (hw - 0.5f)) + 0.05f, std::max(d, side * (hw - 0.5f)) - 0.05f,
               kPaintLift);
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
    LayBicycle(ground, street, s, -9.6f, 1, 1);
    LayWord(ground, street, "BUS", s + 4, 11.1f, -1, 2.6f);
    LayWord(ground, street, "ONLY", s, 11.1f, -1, 2.6f);
  }
}

}  // namespace

void StreetRect(Ground& ground, const StreetStretch& street, float s0, float s1, float d0, float d1, float lift) {
  if (d0 < 0 && d1 > 0) {
    StreetRect(ground, street, s0, s1, d0, 0, lift);
    StreetRect(ground, street, s0, s1, 0, d1, lift);
    return;
  }
  ground.Quad(street.At(s0, d0, lift), street.At(s1, d0, lift), street.At(s1, d1, lift), street.At(s0, d1, lift));
}

void LayMarkings(Ground& ground, const StreetStretch& street, const std::string& name, bool bike_lane) {
  if (street.line.kind != StreetKind::kTwoWay) return LayAvenueMarkings(ground, street, name);
  const float s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f, parking = street.line.half_width - 2.35f;
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
  if (bike_lane) LayBikeLaneMarkings(ground, street, s0, s1, parking);
  for (float side : {-1.0f, 1.0f}) LayParkingBays(ground, street, side);
}

void LayWhiteLines(Ground& ground, const StreetStretch& street, const std::string& name) {
  const float hw = street.line.half_width, s0 = street.s0 + 5.6f, s1 = street.s1 - 5.6f;
  const bool boulevard = street.line.kind == StreetKind::kBoulevard;
  ground.Begin("markings " + name, "ground/lane_marking", Surface::kPaintWhite);
  // The planted middle of a boulevard needs no line.
  if (!boulevard) StreetRect(ground, street, s0, s1, -0.06f, 0.06f, kPaintLift);
  const float inner = boulevard ? 2.5f : 0.3f, kerb = hw - (street.line.kind == StreetKind::kTwoWay ? 2.35f : 0.5f);
  StreetRect(ground, street, s0 - 0.5f, s0 - 0.2f, inner, kerb, kPaintLift);
  StreetRect(ground, street, s1 + 0.2f, s1 + 0.5f, -kerb, -inner, kPaintLift);
  if (street.line.kind == StreetKind::kTwoWay) return;
  for (float side : {-1.0f, 1.0f})
    for (float d : boulevard ? std::vector<float>{5.7f} : std::vector<float>{3.7f, 7.2f}) LayDashes(ground, street, s0, s1, side * d);
}

void LayJunctionGuides(Ground& ground, const Fan& fan, const StreetLine& ns, const StreetLine& ew, const std::string& name) {
  const auto on = [&](float x, float y) { return Vec3f{x, y, fan.Height({x, y}) + 0.012f}; };
  const auto rect = [&](float x0, float x1, float y0, float y1) { ground.Quad(on(x0, y0), on(x1, y0), on(x1, y1), on(x0, y1)); };
  const float reach = ew.half_width + 4.6f;
  ground.Begin("bike lane crossing " + name, "ground/bike_lane", Surface::kBikeLane);
  for (float y = -reach; y < reach - 0.6f; y += 1.2f) rect(ns.center + 8.8f, ns.center + 10.4f, ew.center + y, ew.center + y + 0.62f);
  ground.Begin("guide lines " + name, "ground/lane_marking", Surface::kPaintWhite);
  for (float d : {5.5f, -5.9f}) {
    for (float y = -reach; y < reach - 0.6f; y += 1.9f)
      rect(ns.center + d - 0.06f, ns.center + d + 0.06f, ew.center + y, ew.center + y + 0.65f);
  }
  for (float side : {-1.0f, 1.0f}) {
    const Vec2f c{ns.center - side * 11, ew.center - side * reach};
    for (int i = 1; i < 13; i += 2) {
      const auto at = [&](float r, float a) { return on(c.x + side * r * std::cos(a), c.y + side * r * std::sin(a)); };
      const float a0 = 0.11f * static_cast<float>(i), a1 = a0 + 0.07f;
      for (float r : {9.0f, 12.2f}) ground.Quad(at(r - 0.06f, a0), at(r + 0.06f, a0), at(r + 0.06f, a1), at(r - 0.06f, a1));
    }
  }
}

void LayJunctionBox(Ground& ground, const Fan& fan, const StreetLine& ns, const StreetLine& ew, const std::string& name) {
  const float hx = ns.half_width - 1, hy = ew.half_width - 0.6f, half = 0.075f;
  const auto on = [&](float x, float y) {
    return Vec3f{ns.center + x, ew.center + y, fan.Height({ns.center + x, ew.center + y}) + 0.011f};
  };
  ground.Begin("box " + name, "ground/lane_marking", Surface::kPaintWhite);
  // A line in pieces short enough to follow the crown; `n` = its unit normal.
  const auto line = [&](Vec2f a, Vec2f b, Vec2f n) {
    const int pieces = std::max(1, static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 0.8f));
    for (int i = 0; i < pieces; ++i) {
      const Vec2f p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(pieces)),
                  q = a + (b - a) * (static_cast<float>(i + 1) / static_cast<float>(pieces));
      ground.Quad(on(p.x + n.x * half, p.y + n.y * half), on(q.x + n.x * half, q.y + n.y * half), on(q.x - n.x * half, q.y - n.y * half),
                  on(p.x - n.x * half, p.y - n.y * half));
    }
  };
  line({-hx, -hy}, {hx, -hy}, {0, -1});
  line({-hx, hy}, {hx, hy}, {0, -1});
  line({-hx, -hy}, {-hx, hy}, {1, 0});
  line({hx, -hy}, {hx, hy}, {1, 0});
  constexpr float kPitch = 1.9f, kDiagonal = 0.70710678f;
  for (float c = -hx - hy + kPitch / 2; c < hx + hy; c += kPitch) {
    // x - y = c, clipped to the box, and its mirror image.
    const float y0 = std::max(-hy, -hx - c), y1 = std::min(hy, hx - c);
    if (y1 - y0 < 0.3f) continue;
    line({y0 + c, y0}, {y1 + c, y1}, {kDiagonal, -kDiagonal});
    line({-y1 - c, y1}, {-y0 - c, y0}, {-kDiagonal, -kDiagonal});
  }
}

}  // namespace airsim360::internal
