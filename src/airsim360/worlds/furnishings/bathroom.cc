// Bathrooms. EN 33 pans 36 x 54 to 70 cm with seats 40 to 43 cm high; EN 31 basins 55 to 65 cm wide at 85 cm; EN 198 baths
// 170 x 75 cm; shower trays 90 x 90 (Neufert). Washing machines 60 x 60 x 85 cm.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

// One level of an egg-shaped body: half width, front and rear reach, where its middle lies, height.
struct EggRing {
  float half, front, rear, y, z;
};
Vec3f OnEgg(const EggRing& e, float u) {
  const float a = kTauF * u, c = std::cos(a), s = std::sin(a);
  return {e.half * c, e.y + (s < 0 ? e.front : e.rear) * s, e.z};
}
// Skin through rings from bottom to top, outside outwards.
void Egg(PropBuilder& b, std::span<const EggRing> rings, int around = 28) {
  const auto n = static_cast<int>(rings.size()) - 1;
  b.Sheet(around, n * 3,
          [&](float u, float v) {
            const float s = v * static_cast<float>(n);
            const int i = std::min(n - 1, static_cast<int>(s));
            const float t = s - static_cast<float>(i);
            const EggRing &lo = rings[static_cast<size_t>(i)], &hi = rings[static_cast<size_t>(i) + 1];
            return OnEgg(lo, u) * (1 - t) + OnEgg(hi, u) * t;
          },
          {1, 0.4f});
}

// Close-coupled pan with cistern, or a wall-hung one before a boxed-in cistern; seat and lid down or up.
Model MakeToilet(uint32_t variant, uint64_t) {
  PropBuilder b("toilet");
  UseCeramic(b);
  const bool hung = variant == 2;
  const float base = hung ? 0.16f : 0.0f;
  const EggRing rings[] = {{0.105f, 0.17f, 0.24f, 0.05f, base},   {0.115f, 0.19f, 0.25f, 0.04f, base + 0.04f},
                           {0.125f, 0.22f, 0.25f, 0.0f, 0.24f},   {0.165f, 0.29f, 0.25f, 0.0f, 0.34f},
                           {0.180f, 0.315f, 0.25f, 0.0f, 0.395f}, {0.172f, 0.305f, 0.24f, 0.0f, 0.402f},
                           {0.135f, 0.265f, 0.20f, 0.0f, 0.400f}, {0.12f, 0.24f, 0.17f, -0.01f, 0.33f},
                           {0.06f, 0.12f, 0.10f, -0.02f, 0.22f},  {0.001f, 0.001f, 0.001f, -0.02f, 0.215f}};
  Egg(b, rings);
  if (hung) {
    const EggRing under[] = {{0.001f, 0.001f, 0.001f, 0.05f, base}, {0.105f, 0.17f, 0.24f, 0.05f, base}};
    Egg(b, under);
    UseLacquer(b, {0.72f, 0.71f, 0.69f});
    b.BevelBox({-0.30f, 0.22f, 0}, {0.30f, 0.36f, 1.12f}, 0.004f);
    b.Use(Chrome());
    b.BevelBox({-0.12f, 0.214f, 0.92f}, {0.12f, 0.222f, 1.06f}, 0.004f);
    b.BevelBox({-0.055f, 0.210f, 0.945f}, {0.055f, 0.215f, 1.035f}, 0.003f);
  } else {
    SoftBox(b, {-0.19f, 0.20f, 0.385f}, {0.19f, 0.37f, 0.76f}, {.round = 0.035f, .crown = 0.004f, .cells = 7});
    SoftBox(b, {-0.20f, 0.19f, 0.755f}, {0.20f, 0.375f, 0.795f}, {.round = 0.018f, .crown = 0.003f, .cells = 6});
    b.Use(Chrome());
    const Vec2f button[] = {{0.024f, 0.795f}, {0.024f, 0.801f}, {0.02f, 0.804f}, {0, 0.804f}};
    b.Lathe(button, 18, {0, 0.28f, 0});
  }
  b.Use(Plastic({0.76f, 0.76f, 0.75f}, 0.18f));
  // Seat ring and lid.
  const EggRing seat[] = {{0.185f, 0.32f, 0.215f, 0.0f, 0.404f},
                          {0.188f, 0.323f, 0.218f, 0.0f, 0.414f},
                          {0.180f, 0.314f, 0.21f, 0.0f, 0.424f},
                          {0.128f, 0.25f, 0.14f, -0.01f, 0.424f},
                          {0.120f, 0.24f, 0.13f, -0.01f, 0.410f}};
  Egg(b, seat);
  if (variant == 1) b.Place(Turn(-98, 0, 0, {0, 0.20f, 0.44f}) * Move({0, -0.20f, -0.424f}));
  const EggRing lid[] = {{0.186f, 0.321f, 0.21f, 0.0f, 0.426f},
                         {0.186f, 0.321f, 0.21f, 0.0f, 0.434f},
                         {0.172f, 0.305f, 0.195f, 0.0f, 0.444f},
                         {0.001f, 0.001f, 0.001f, 0.0f, 0.450f}};
  Egg(b, lid);
  if (variant == 1) {
    const EggRing below[] = {{0.001f, 0.001f, 0.001f, 0.0f, 0.426f}, {0.186f, 0.321f, 0.21f, 0.0f, 0.426f}};
    Egg(b, below);
  }
  b.Place({});
  return b.Finish();
}

void Tap(PropBuilder& b, Vec3f p) {
  b.Use(Chrome());
  const Vec2f body[] = {{0.024f, 0}, {0.024f, 0.008f}, {0.018f, 0.014f}, {0.018f, 0.10f}, {0.020f, 0.105f}, {0.016f, 0.125f}, {0, 0.128f}};
  b.Lathe(body, 18, p);
  const Vec3f spout[] = {p + Vec3f{0, 0, 0.065f}, p + Vec3f{0, -0.06f, 0.075f}, p + Vec3f{0, -0.115f, 0.068f}, p + Vec3f{0, -0.12f, 0.05f}};
  b.Bar(spout, 0.010f, 10);
  b.mesh().Tube(p + Vec3f{0, 0, 0.118f}, p + Vec3f{0, -0.075f, 0.142f}, 0.008f, 0.005f, 10);
}

// Basin on a cabinet with drawers, on a pedestal, or a bowl on a wooden board.
Model MakeWashbasin(uint32_t variant, uint64_t) {
  PropBuilder b("washbasin");
  const float top = 0.85f, half = variant == 1 ? 0.28f : 0.32f;
  if (variant == 0) {
    UseTimber(b, Timber::kOak, Grain::kAlongX);
    b.BevelBox({-0.31f, -0.20f, 0.28f}, {0.31f, 0.24f, top - 0.10f}, 0.003f);
    for (float z : {0.283f, 0.520f}) Front(b, -0.309f, 0.309f, z, z + 0.228f, -0.20f);
    b.Use(Plastic({0.03f, 0.03f, 0.03f}));
    for (float z : {0.49f, 0.727f}) b.BevelBox({-0.12f, -0.226f, z}, {0.12f, -0.216f, z + 0.010f}, 0.002f);
    b.Use(Chrome());  // waste and supply go down the wall
    b.mesh().Tube({0, 0.20f, 0}, {0, 0.20f, 0.29f}, 0.020f, 0.020f, 14);
    for (float x : {-0.10f, 0.10f}) b.mesh().Tube({x, 0.22f, 0}, {x, 0.22f, 0.29f}, 0.007f, 0.007f, 8);
  } else if (variant == 1) {
    UseCeramic(b);
    const Vec2f column[] = {{0.10f, 0}, {0.105f, 0.015f}, {0.085f, 0.06f}, {0.07f, 0.30f}, {0.09f, 0.70f}, {0.12f, top - 0.10f}};
    b.Lathe(column, 24, {0, 0.08f, 0});
  } else {
    UseTimber(b, Timber::kWalnut, Grain::kAlongX);
    b.BevelBox({-0.45f, -0.24f, top - 0.17f}, {0.45f, 0.24f, top - 0.12f}, 0.004f);
    b.BevelBox({-0.43f, -0.22f, 0.22f}, {0.43f, 0.22f, 0.25f}, 0.004f);
    b.Use(Paint({0.03f, 0.03f, 0.033f}));
    for (float x : {-0.43f, 0.43f})
      for (float y : {-0.22f, 0.22f}) b.BevelBox({x - 0.014f, y - 0.014f, 0}, {x + 0.014f, y + 0.014f, top - 0.17f}, 0.002f);
    UsePile(b, {0.62f, 0.58f, 0.50f});
    for (int i = 0; i < 3; ++i)
      SoftBox(b, {-0.30f, -0.15f, 0.25f + 0.06f * static_cast<float>(i)}, {0.05f, 0.15f, 0.31f + 0.06f * static_cast<float>(i)},
              {.round = 0.028f, .crown = 0.006f, .cells = 6});
  }
  UseCeramic(b);
  const float depth = variant == 2 ? 0.19f : 0.235f;
  const EggRing rings[] = {{half * 0.45f, depth * 0.45f, depth * 0.45f, 0, top - 0.14f},
                           {half * 0.80f, depth * 0.82f, depth * 0.85f, 0, top - 0.09f},
                           {half * 0.97f, depth * 0.98f, depth, 0, top - 0.02f},
                           {half, depth, depth, 0, top - 0.004f},
                           {half * 0.985f, depth * 0.98f, depth * 0.98f, 0, top},
                           {half * 0.86f, depth * 0.84f, depth * 0.62f, 0, top - 0.002f},
                           {half * 0.75f, depth * 0.74f, depth * 0.5f, 0, top - 0.06f},
                           {half * 0.4f, depth * 0.4f, depth * 0.3f, 0, top - 0.115f},
                           {0.022f, 0.022f, 0.022f, 0, top - 0.122f}};
  Egg(b, rings, 32);
  b.Use(Chrome());
  const Vec2f drain[] = {{0.024f, top - 0.124f}, {0.022f, top - 0.119f}, {0, top - 0.1185f}};
  b.Lathe(drain, 16);
  Tap(b, {0, depth * 0.80f, top - 0.002f});
  return b.Finish();
}

// A towel over the front rim of a tub of half depth y.
void TowelOverRim(PropBuilder& b, float y, float top, Vec3f color) {
  UsePile(b, color);
  b.Place(Move({0.45f, 0, 0}) * Turn(0, 0, 90));
  b.Sheet(16, 4,
          [&](float u, float v) {
            const float s = (u - 0.35f) * 0.9f, w = 0.22f * (2 * v - 1);
            const float edge = -y;  // hangs over the front rim
            if (s < 0) return Vec3f{edge - 0.012f - 0.01f * std::sin(9 * v), -w, top + 0.012f + s};
            if (s < 0.07f) return Vec3f{edge - 0.012f + s, -w, top + 0.013f};
            return Vec3f{edge + 0.058f + 0.035f * std::min(1.0f, (s - 0.07f) * 4), -w, top + 0.013f - (s - 0.07f) * 0.55f};
          },
          {0.9f, 0.44f});
  b.Place({});
}

// A tub in a tiled apron, or a free-standing one.
Model MakeBathtub(uint32_t variant, uint64_t) {
  PropBuilder b("bathtub");
  const float x = variant == 1 ? 0.85f : 0.85f, y = variant == 1 ? 0.38f : 0.375f, top = 0.58f;
  const auto ring = [&](float inset, float z) {
    auto flat = RoundedRectangle({-x + inset, -y + inset}, {x - inset, y - inset},
                                 variant == 1 ? 0.34f - inset * 0.5f : std::max(0.15f, 0.02f + inset), 8);
    std::vector<Vec3f> out;
    for (Vec2f p : flat) out.push_back({p.x, p.y, z});
    return out;
  };
  UseCeramic(b, {0.80f, 0.80f, 0.79f});
  std::vector<std::vector<Vec3f>> rings;
  if (variant == 1)
    rings = {ring(0.10f, 0.001f), ring(0.07f, 0.03f), ring(0.03f, 0.35f),      ring(0.0f, top - 0.02f),
             ring(0.004f, top),   ring(0.03f, top),   ring(0.05f, top - 0.02f)};
  else
    rings = {ring(0.002f, top - 0.025f), ring(0.0f, top - 0.008f), ring(0.006f, top), ring(0.055f, top), ring(0.068f, top - 0.012f)};
  for (const auto& [inset, z] : {std::pair{0.085f, 0.35f}, std::pair{0.12f, 0.20f}, std::pair{0.17f, 0.155f}, std::pair{0.25f, 0.145f}})
    rings.push_back(ring(inset, z));
  const auto n = static_cast<int>(rings.size()) - 1, m = static_cast<int>(rings[0].size());
  b.Sheet(m, n * 2,
          [&](float u, float v) {
            const float s = std::min(v * static_cast<float>(n), static_cast<float>(n) - 1e-4f), w = u * static_cast<float>(m);
            const int i = static_cast<int>(s), j = static_cast<int>(w);
            const float t = s - static_cast<float>(i), q = w - static_cast<float>(j);
            const auto at = [&](int k) {
              const auto& r = rings[static_cast<size_t>(k)];
              return r[static_cast<size_t>(j % m)] * (1 - q) + r[static_cast<size_t>((j + 1) % m)] * q;
            };
            return at(i) * (1 - t) + at(i + 1) * t;
          },
          {4, 1.5f});
  std::vector<Vec2f> floor;
  for (Vec3f p : rings.back()) floor.push_back({p.x, p.y});
  b.mesh().Polygon(floor, rings.back()[0].z, true);
  if (variant != 1) {
    UseLacquer(b, variant == 0 ? Vec3f{0.72f, 0.72f, 0.70f} : Vec3f{0.33f, 0.38f, 0.38f}, 0.15f);
    b.BevelBox({-x + 0.01f, -y + 0.01f, 0}, {x - 0.01f, y - 0.01f, 0.12f}, 0.002f);
    for (float s : {-1.0f, 1.0f}) {
      b.BevelBox({-x + 0.008f, s * (y - 0.016f) - 0.012f, 0}, {x - 0.008f, s * (y - 0.016f) + 0.012f, top - 0.022f}, 0.002f);
      b.BevelBox({s * (x - 0.016f) - 0.012f, -y + 0.02f, 0}, {s * (x - 0.016f) + 0.012f, y - 0.02f, top - 0.022f}, 0.002f);
    }
  }
  b.Use(Chrome());
  const Vec3f spout[] = {{-0.30f, y - 0.03f, top - 0.002f},
                         {-0.30f, y - 0.03f, top + 0.06f},
                         {-0.30f, y - 0.10f, top + 0.075f},
                         {-0.30f, y - 0.15f, top + 0.055f}};
  b.Bar(spout, 0.013f, 12);
  for (float s : {-0.09f, 0.09f}) {
    const Vec2f knob[] = {{0.018f, 0}, {0.018f, 0.02f}, {0.024f, 0.026f}, {0.022f, 0.05f}, {0, 0.052f}};
    b.Lathe(knob, 14, {-0.30f + s, y - 0.03f, top - 0.002f});
  }
  TowelOverRim(b, y, top, variant == 2 ? Vec3f{0.30f, 0.42f, 0.46f} : Vec3f{0.66f, 0.63f, 0.57f});
  return b.Finish();
}

// Tray, two walls of glass on a frame, thermostat, rail with a hand shower, an overhead rose.
Model MakeShower(uint32_t variant, uint64_t) {
  PropBuilder b("shower");
  const float h = 0.45f, top = 2.0f;
  UseCeramic(b, variant == 1 ? Vec3f{0.14f, 0.14f, 0.145f} : Vec3f{0.78f, 0.78f, 0.77f});
  RoundedBoard(b, {-h, -h}, {h, h}, 0.02f, 0, 0.045f, 0.012f);
  b.Use(Chrome());
  const Vec2f drain[] = {{0.055f, 0.045f}, {0.05f, 0.049f}, {0, 0.05f}};
  b.Lathe(drain, 20, {0, 0.1f, 0});
  b.Use(variant == 1 ? Paint({0.02f, 0.02f, 0.022f}) : Chrome());
  for (const Vec2f p :
       {Vec2f{-h + 0.012f, -h + 0.012f}, Vec2f{h - 0.012f, -h + 0.012f}, Vec2f{h - 0.012f, h - 0.012f}, Vec2f{-h + 0.012f, h - 0.012f}})
    b.BevelBox({p.x - 0.012f, p.y - 0.012f, 0.045f}, {p.x + 0.012f, p.y + 0.012f, top}, 0.002f);
  for (float z : {0.045f, top - 0.03f}) {
    b.BevelBox({-h + 0.02f, -h + 0.002f, z}, {h - 0.02f, -h + 0.022f, z + 0.03f}, 0.002f);
    b.BevelBox({h - 0.022f, -h + 0.02f, z}, {h - 0.002f, h - 0.02f, z + 0.03f}, 0.002f);
  }
  // Fittings on the wall at the left.
  b.mesh().Tube({-h + 0.06f, 0, 0.95f}, {-h + 0.06f, 0, 2.05f}, 0.011f, 0.011f, 10);
  const Vec3f arm[] = {{-h + 0.06f, 0, 2.04f}, {-h + 0.07f, 0, 2.09f}, {-h + 0.12f, 0, 2.10f}, {-0.02f, 0, 2.10f}, {0, 0, 2.07f}};
  b.Bar(arm, 0.010f, 10);
  const Vec2f rose[] = {{0, 2.045f}, {0.11f, 2.045f}, {0.115f, 2.052f}, {0.11f, 2.06f}, {0.02f, 2.075f}, {0, 2.076f}};
  b.Lathe(rose, 28);
  b.mesh().Tube({-h + 0.055f, -0.13f, 1.05f}, {-h + 0.055f, 0.13f, 1.05f}, 0.022f, 0.022f, 16);
  b.mesh().Tube({-h + 0.01f, 0, 1.05f}, {-h + 0.055f, 0, 1.05f}, 0.015f, 0.015f, 10);
  b.mesh().Tube({-h + 0.07f, 0.03f, 1.60f}, {-h + 0.14f, 0.03f, 1.72f}, 0.012f, 0.014f, 10);
  b.mesh().Tube({-h + 0.14f, 0.03f, 1.725f}, {-h + 0.165f, 0.03f, 1.715f}, 0.04f, 0.045f, 16);
  std::vector<Vec3f> hose;
  for (int i = 0; i <= 14; ++i) {
    const float t = static_cast<float>(i) / 14;
    hose.push_back({-h + 0.075f + 0.04f * std::sin(3.1f * t), 0.03f - 0.03f * t + 0.10f * std::sin(3.14159f * t),
                    1.60f - 0.55f * t - 0.55f * std::sin(3.14159f * t)});
  }
  b.Bar(hose, 0.006f, 6);
  b.Use(ClearGlass());
  b.mesh().Quad({-h + 0.02f, -h + 0.012f, 0.07f}, {h - 0.02f, -h + 0.012f, 0.07f}, {h - 0.02f, -h + 0.012f, top - 0.03f},
                {-h + 0.02f, -h + 0.012f, top - 0.03f});
  b.mesh().Quad({h - 0.012f, -h + 0.02f, 0.07f}, {h - 0.012f, h - 0.02f, 0.07f}, {h - 0.012f, h - 0.02f, top - 0.03f},
                {h - 0.012f, -h + 0.02f, top - 0.03f});
  b.Use(Metal());
  BowHandle(b, {h - 0.10f, 0.95f}, {h - 0.10f, 1.15f}, -h + 0.010f, 0.007f);
  return b.Finish();
}

Model MakeWashingMachine(uint32_t variant, uint64_t) {
  PropBuilder b("washing_machine");
  const float y0 = -0.28f, y1 = 0.30f, h = 0.85f;
  const Vec3f shell = variant == 1 ? Vec3f{0.22f, 0.225f, 0.23f} : Vec3f{0.76f, 0.76f, 0.75f};
  UseLacquer(b, shell, 0.25f);
  b.BevelBox({-0.298f, y0, 0.02f}, {0.298f, y1, h - 0.035f}, 0.008f);
  b.BevelBox({-0.298f, y0 - 0.01f, h - 0.03f}, {0.298f, y1, h}, 0.008f);
  b.BevelBox({-0.296f, y0 - 0.012f, h - 0.16f}, {0.296f, y0 + 0.01f, h - 0.035f}, 0.006f);
  b.Use(Plastic({0.55f, 0.56f, 0.57f}, 0.3f));
  b.BevelBox({-0.285f, y0 - 0.016f, h - 0.14f}, {-0.11f, y0, h - 0.05f}, 0.004f);
  b.mesh().Tube({0.02f, y0 - 0.010f, h - 0.095f}, {0.02f, y0 - 0.035f, h - 0.095f}, 0.032f, 0.028f, 24, false);
  b.Use(Plastic({0.012f, 0.013f, 0.015f}, 0.1f));
  b.BevelBox({0.085f, y0 - 0.0145f, h - 0.125f}, {0.255f, y0 - 0.011f, h - 0.065f}, 0.001f);
  // The door: a ring, and behind its bowl of glass the dark drum.
  b.Place(Turn(90, 0, 0, {0, y0, 0.42f}));
  b.Use(variant == 1 ? Chrome() : Plastic({0.66f, 0.67f, 0.68f}, 0.25f));
  const Vec2f ring[] = {{0.205f, -0.004f}, {0.21f, 0.012f}, {0.20f, 0.028f}, {0.165f, 0.034f}, {0.150f, 0.022f}};
  b.Lathe(ring, 40);
  b.Use(Plastic({0.018f, 0.019f, 0.022f}, 0.05f));
  const Vec2f bowl[] = {{0.155f, 0.018f}, {0.13f, 0.010f}, {0.08f, 0.004f}, {0, 0.0015f}};
  b.Lathe(bowl, 32);
  b.Place({});
  b.Use(Plastic({0.03f, 0.03f, 0.03f}));
  for (float x : {-0.24f, 0.24f})
    for (float y : {y0 + 0.05f, y1 - 0.05f}) b.mesh().Tube({x, y, 0}, {x, y, 0.025f}, 0.018f, 0.022f, 10);
  b.BevelBox({0.15f, y0 - 0.003f, 0.06f}, {0.27f, y0 + 0.002f, 0.14f}, 0.002f);
  return b.Finish();
}

}  // namespace

FurnishingRows BathroomRows() {
  return {{{"toilet", "furniture/toilet", 3, MakeToilet, 0.5f, 0.75f, 1.20f, 7500}},
          {{"washbasin", "furniture/sink", 3, MakeWashbasin, 0.5f, 0.90f, 1.05f, 5500}},
          {{"bathtub", "furniture/bathtub", 3, MakeBathtub, 1.0f, 0.55f, 0.75f, 4500}},
          {{"shower", "furniture/shower", 2, MakeShower, 0.65f, 2.0f, 2.2f, 4500}},
          {{"washing_machine", "furniture/electronics/washing_machine", 2, MakeWashingMachine, 0.45f, 0.84f, 0.87f, 2000}}};
}

}  // namespace airsim360::internal
