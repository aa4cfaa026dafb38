// Escalators and lift doors. EN 115-1: 30 degrees, steps 1.0 m wide, 0.40 m deep (0.38 at least) and at most 0.24 m high,
// handrails 0.90 to 1.10 m above them; EN 81-20 doors 0.9 to 1.1 m by 2.1 m.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr float kTread = 0.40f, kSlope = 0.57735f, kHalfStep = 0.50f, kPlate = 1.20f, kRail = 0.98f, kTruss = 0.95f;
constexpr int kFlatSteps = 2;

// Side view of one escalator: where its parts begin along Y, and how high its steps are there.
struct Flight {
  float rise, riser;
  int risers;
  float y_low, y_comb, y_foot, y_head, y_end;  // lower end, first step, foot and head of the slope, upper end

  explicit Flight(float height) : rise(height) {
    risers = static_cast<int>(std::lround(rise / (kTread * kSlope)));
    riser = rise / static_cast<float>(risers);
    const float slope = static_cast<float>(risers) * kTread, length = slope + 2 * kPlate + 2 * kFlatSteps * kTread;
    y_low = -length / 2;
    y_comb = y_low + kPlate;
    y_foot = y_comb + kFlatSteps * kTread;
    y_head = y_foot + slope;
    y_end = -y_low;
  }
  float NoseAt(float y) const { return std::clamp((y - y_foot) / (y_head - y_foot), 0.0f, 1.0f) * rise; }
  // Sharp corners of the side view, rounded by small steps.
  std::vector<float> Stations() const {
    std::vector<float> y = {y_low, y_comb};
    for (int i = -3; i <= 3; ++i) y.push_back(y_foot + 0.15f * static_cast<float>(i));
    for (int i = -3; i <= 3; ++i) y.push_back(y_head + 0.15f * static_cast<float>(i));
    y.push_back(y_end - kPlate);
    y.push_back(y_end);
    return y;
  }
  // The same line with its corners eased over 0.45 m.
  float Eased(float y) const {
    float sum = 0;
    for (int i = -2; i <= 2; ++i) sum += NoseAt(y + 0.18f * static_cast<float>(i));
    return sum / 5;
  }
};

// Ribbed aluminium with yellow lines along the sides.
const Texture& TreadTexture() {
  static const Texture texture =
      Texture::FromImage("escalator tread",
                         Shade(256, 64,
                               [](float u, float v) {
                                 const float rib = std::fmod(u * 64, 1.0f) < 0.55f ? 1.0f : 0.25f;
                                 if (u < 0.035f || u > 0.965f || v > 0.93f) return Vec3f{0.72f, 0.48f, 0.03f} * (0.5f + 0.5f * rib);
                                 return Vec3f{0.36f, 0.36f, 0.37f} * rib * (0.9f + 0.15f * TileFractal(u, v, 4, 3, 3, 931));
                               }),
                         true);
  return texture;
}

void Steps(PropBuilder& b, const Flight& f) {
  Material tread = Metal({0.9f, 0.9f, 0.9f}, 0.45f);
  tread.metallic = 0.5f;
  b.Use(tread, TreadTexture());
  const int count = f.risers + 2 * kFlatSteps;
  const auto height = [&](int k) { return f.riser * static_cast<float>(std::clamp(k - kFlatSteps + 1, 0, f.risers)); };
  for (int k = 0; k < count; ++k) {
    const float y0 = f.y_comb + kTread * static_cast<float>(k), y1 = y0 + kTread, z = height(k);
    // The belt moves: seen at rest, the flat steps lie level with the plates.
    b.Picture({-kHalfStep, y0, z}, {kHalfStep, y0, z}, {kHalfStep, y1, z}, {-kHalfStep, y1, z});
    const float below = k ? height(k - 1) : z;
    if (z > below)
      b.Picture({-kHalfStep, y0 + 0.004f, below}, {kHalfStep, y0 + 0.004f, below}, {kHalfStep, y0 + 0.004f, z},
                {-kHalfStep, y0 + 0.004f, z});
  }
}

void Plates(PropBuilder& b, const Flight& f) {
  UseBrushedSteel(b, 0.4f);
  const float wide = kHalfStep + 0.28f;
  for (const auto& [y0, y1, z] : {std::array{f.y_low, f.y_comb, 0.0f}, std::array{f.y_end - kPlate, f.y_end, f.rise}}) {
    b.mesh().Quad({-wide, y0, z + 0.002f}, {wide, y0, z + 0.002f}, {wide, y1, z + 0.002f}, {-wide, y1, z + 0.002f});
  }
  b.Use(Plastic({0.62f, 0.40f, 0.02f}, 0.5f));  // combs
  for (const auto& [y, z] : {std::pair{f.y_comb, 0.0f}, std::pair{f.y_end - kPlate, f.rise}}) {
    const float d = z > 0 ? -0.05f : 0.05f;
    for (int i = 0; i < 24; ++i) {
      const float x = -kHalfStep + 0.0417f * static_cast<float>(i);
      b.mesh().Box({x, std::min(y, y + d), z}, {x + 0.02f, std::max(y, y + d), z + 0.006f});
    }
  }
}

// A ribbon between two lines over Y at x, facing the side of `face` (its sign along X).
void Ribbon(PropBuilder& b, const std::vector<float>& y, float x, float face, const std::function<Vec2f(float)>& low_high) {
  for (size_t i = 0; i + 1 < y.size(); ++i) {
    const Vec2f a = low_high(y[i]), c = low_high(y[i + 1]);
    if (a.y <= a.x && c.y <= c.x) continue;
    const Vec3f p[4] = {{x, y[i], a.x}, {x, y[i + 1], c.x}, {x, y[i + 1], c.y}, {x, y[i], a.y}};
    face > 0 ? b.mesh().Quad(p[0], p[1], p[2], p[3]) : b.mesh().Quad(p[1], p[0], p[3], p[2]);
  }
}

// Skirts, decking, glass, cladding of one side (s = -1 or 1).
void Side(PropBuilder& b, const Flight& f, float s, bool glass) {
  const auto y = f.Stations();
  const float inner = s * (kHalfStep + 0.01f), outer = s * (kHalfStep + 0.28f), pane = s * (kHalfStep + 0.10f);
  UseBrushedSteel(b, 0.35f);
  Ribbon(b, y, inner, -s, [&](float v) { return Vec2f{f.Eased(v) - 0.30f, f.Eased(v) + 0.08f}; });
  for (size_t i = 0; i + 1 < y.size(); ++i) {  // decks beside the panes
    const float z0 = f.Eased(y[i]) + 0.08f, z1 = f.Eased(y[i + 1]) + 0.08f, lo = std::min(inner, outer), hi = std::max(inner, outer);
    b.mesh().Quad({lo, y[i], z0}, {hi, y[i], z0}, {hi, y[i + 1], z1}, {lo, y[i + 1], z1});
  }
  UseCoatedSteel(b, {0.60f, 0.61f, 0.62f}, 0.3f);
  const auto cladding = [&](float v) { return Vec2f{std::max(0.0f, f.Eased(v) - kTruss), f.Eased(v) + 0.08f}; };
  Ribbon(b, y, outer, s, cladding);
  glass ? b.Use(ClearGlass({0.90f, 0.96f, 0.95f})) : UseBrushedSteel(b, 0.25f);
  std::vector<float> within;
  for (float v : y) within.push_back(std::clamp(v, f.y_low + 0.75f, f.y_end - 0.75f));
  Ribbon(b, within, pane, s, [&](float v) { return Vec2f{f.Eased(v) + 0.075f, f.Eased(v) + kRail - 0.03f}; });
  if (!glass) Ribbon(b, within, pane - s * 0.01f, -s, [&](float v) { return Vec2f{f.Eased(v) + 0.075f, f.Eased(v) + kRail - 0.03f}; });
  // Handrail: along the top, round the newels, back below.
  b.Use(Rubber());
  std::vector<Vec3f> rail;
  constexpr float kNewel = 0.36f;
  for (int i = 0; i <= 8; ++i) {
    const float a = -1.5708f + 3.14159f * static_cast<float>(i) / 8;
    rail.push_back({pane, f.y_low + 0.75f - kNewel * std::cos(a), kRail - kNewel + kNewel * std::sin(a)});
  }
  for (float v : y)
    if (v > f.y_low + 0.8f && v < f.y_end - 0.8f) rail.push_back({pane, v, f.Eased(v) + kRail});
  for (int i = 0; i <= 8; ++i) {
    const float a = 1.5708f - 3.14159f * static_cast<float>(i) / 8;
    rail.push_back({pane, f.y_end - 0.75f + kNewel * std::cos(a), f.rise + kRail - kNewel + kNewel * std::sin(a)});
  }
  b.Bar(rail, 0.038f, 10);
  // Panels under the newels.
  UseBrushedSteel(b, 0.25f);
  for (const auto& [yc, z, way] : {std::array{f.y_low + 0.75f, 0.0f, -1.0f}, std::array{f.y_end - 0.75f, f.rise, 1.0f}}) {
    std::vector<Vec3f> arc;
    for (int i = 0; i <= 8; ++i) {
      const float a = -1.5708f + 3.14159f * static_cast<float>(i) / 8;
      arc.push_back({pane, yc + way * (kNewel - 0.02f) * std::cos(a), z + kRail - kNewel + (kNewel - 0.02f) * std::sin(a)});
    }
    const Vec3f middle{pane, yc, z + kRail - kNewel};
    for (size_t i = 0; i + 1 < arc.size(); ++i) {
      b.mesh().Triangle(middle, arc[i], arc[i + 1]);
      b.mesh().Triangle(middle, arc[i + 1], arc[i]);
    }
    b.mesh().Box({pane - 0.004f, std::min(yc, yc + way * 0.30f), z + 0.08f},
                 {pane + 0.004f, std::max(yc, yc + way * 0.30f), z + kRail - 2 * kNewel + 0.02f});
  }
}

// Goes up from its lower end (towards -Y, at z = 0) to its upper plate (at z = rise); its truss is clad. Variants: rise 4.5 m
// with glass, 5.0 m with glass, 4.5 m with steel.
Model MakeEscalator(uint32_t variant, uint64_t) {
  PropBuilder b("escalator");
  const Flight f(variant == 1 ? 5.0f : 4.5f);
  Steps(b, f);
  Plates(b, f);
  for (float s : {-1.0f, 1.0f}) Side(b, f, s, variant != 2);
  UseCoatedSteel(b, {0.60f, 0.61f, 0.62f}, 0.3f);
  const float wide = kHalfStep + 0.28f;
  const auto y = f.Stations();
  for (size_t i = 0; i + 1 < y.size(); ++i) {  // soffit
    const float z0 = f.Eased(y[i]) - kTruss, z1 = f.Eased(y[i + 1]) - kTruss;
    if (z0 <= 0 && z1 <= 0) continue;
    b.mesh().Quad({-wide, y[i + 1], std::max(0.0f, z1)}, {wide, y[i + 1], std::max(0.0f, z1)}, {wide, y[i], std::max(0.0f, z0)},
                  {-wide, y[i], std::max(0.0f, z0)});
  }
  b.mesh().Quad({wide, f.y_end, f.rise - kTruss}, {-wide, f.y_end, f.rise - kTruss}, {-wide, f.y_end, f.rise + 0.002f},
                {wide, f.y_end, f.rise + 0.002f});
  b.Use(LampSurface(600, 2 * kTread * static_cast<float>(f.risers) * 0.02f, 4000, Burns::kAlways));  // lines of light over the skirts
  for (float s : {-1.0f, 1.0f})
    Ribbon(b, {f.y_foot + 0.3f, f.y_head - 0.3f}, s * (kHalfStep + 0.008f), -s, [&](float v) {
      return Vec2f{f.Eased(v) + 0.045f, f.Eased(v) + 0.065f};
    });
  return b.Finish();
}

// Two steel leaves that meet in the middle (or slide to one side), their frame, a call panel, the floor's number above.
Model MakeLiftDoor(uint32_t variant, uint64_t) {
  PropBuilder b("lift_door");
  const float half = variant == 1 ? 0.45f : 0.55f, h = 2.10f, frame = 0.12f;
  UseBrushedSteel(b, 0.22f);
  for (float s : {-1.0f, 1.0f})
    b.BevelBox({s > 0 ? half : -half - frame, -0.05f, 0}, {s > 0 ? half + frame : -half, 0, h + frame + 0.18f}, 0.006f);
  b.BevelBox({-half, -0.05f, h}, {half, 0, h + frame + 0.18f}, 0.006f);
  UseBrushedSteel(b, 0.3f);
  const float split = variant == 1 ? -half * 0.0f : 0.0f;
  for (float s : {-1.0f, 1.0f})
    b.BevelBox({s > 0 ? split + 0.0015f : -half, s > 0 && variant == 1 ? -0.022f : -0.028f, 0.006f},
               {s > 0 ? half : split - 0.0015f, -0.004f, h}, 0.003f);
  b.Use(Metal({0.45f, 0.45f, 0.44f}, 0.4f));
  b.BevelBox({-half - frame, -0.12f, 0}, {half + frame, 0, 0.006f}, 0.001f);
  b.Use(Plastic({0.012f, 0.012f, 0.014f}, 0.08f));
  b.BevelBox({-0.16f, -0.053f, h + 0.08f}, {0.16f, -0.049f, h + 0.22f}, 0.002f);
  Canvas canvas(96, 48, {0.004f, 0.004f, 0.005f});
  canvas.Letters(variant == 0 ? "2" : variant == 1 ? "G" : "1", {0.62f, 0.5f}, 0.6f, {0.75f, 0.22f, 0.03f});
  canvas.RegularPolygon({0.28f, 0.5f}, 0.26f, 3, -1.5708f, {0.75f, 0.22f, 0.03f});
  b.Use(Screen(160), canvas.Finish("lift " + std::to_string(variant)));
  b.Picture({-0.13f, -0.0535f, h + 0.09f}, {0.13f, -0.0535f, h + 0.09f}, {0.13f, -0.0535f, h + 0.21f}, {-0.13f, -0.0535f, h + 0.21f});
  const float x = half + frame + 0.16f;
  UseBrushedSteel(b, 0.25f);
  b.BevelBox({x - 0.05f, -0.012f, 0.95f}, {x + 0.05f, 0, 1.25f}, 0.004f);
  for (float z : {1.06f, 1.15f}) {
    b.Use(Chrome());
    b.mesh().Tube({x, -0.012f, z}, {x, -0.018f, z}, 0.022f, 0.021f, 18, false);
    b.Use(Glow({0.80f, 0.45f, 0.10f}, z > 1.1f ? 150.0f : 15.0f, Burns::kAlways));
    b.mesh().Tube({x, -0.0165f, z}, {x, -0.0185f, z}, 0.012f, 0.012f, 14, false);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows EscalatorRows() {
  return {{{"escalator", "construction/escalator", 3, MakeEscalator, 6.5f, 5.4f, 6.1f, 6000}},
          {{"lift_door", "construction/door/lift_door", 3, MakeLiftDoor, 0.8f, 2.35f, 2.45f, 1200}, Mount::kWall, 0}};
}

}  // namespace airsim360::internal
