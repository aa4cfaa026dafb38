// Halls of shopping centres: benches, planters, kiosks, vending machines.
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// Slats on steel.
void BuildSlatBench(PropBuilder& b) {
  UseTimber(b, Timber::kOak, Grain::kAlongX);
  for (int i = 0; i < 7; ++i)
    b.BevelBox({-0.90f, -0.255f + 0.0735f * static_cast<float>(i), 0.415f}, {0.90f, -0.195f + 0.0735f * static_cast<float>(i), 0.45f},
               0.006f);
  for (int i = 0; i < 3; ++i) {
    b.Place(Turn(-12, 0, 0, {0, 0.25f, 0.52f + 0.10f * static_cast<float>(i)}));
    b.BevelBox({-0.90f, -0.015f + 0.02f * static_cast<float>(i), 0}, {0.90f, 0.015f + 0.02f * static_cast<float>(i), 0.075f}, 0.006f);
  }
  b.Place({});
  b.Use(Paint({0.04f, 0.042f, 0.045f}, 0.4f));
  for (float x : {-0.70f, 0.70f}) {
    b.Bar(std::array<Vec3f, 4>{Vec3f{x, 0.18f, 0.02f}, Vec3f{x, 0.21f, 0.40f}, Vec3f{x, 0.275f, 0.55f}, Vec3f{x, 0.34f, 0.82f}}, 0.020f, 8);
    b.Bar(std::array<Vec3f, 3>{Vec3f{x, -0.20f, 0.02f}, Vec3f{x, -0.22f, 0.39f}, Vec3f{x, 0.22f, 0.40f}}, 0.020f, 8);
    for (float y : {-0.20f, 0.18f}) b.BevelBox({x - 0.05f, y - 0.05f, 0}, {x + 0.05f, y + 0.05f, 0.02f}, 0.005f);
  }
}

// A padded island.
void BuildIslandBench(PropBuilder& b) {
  UseLacquer(b, {0.05f, 0.052f, 0.055f});
  const Vec2f plinth[] = {{0.62f, 0}, {0.62f, 0.10f}, {0, 0.10f}};
  b.Lathe(plinth, 48);
  for (int i = 0; i < 6; ++i) {
    UseLeather(b, i % 2 ? Vec3f{0.10f, 0.26f, 0.28f} : Vec3f{0.44f, 0.36f, 0.24f});
    const float a0 = 1.0472f * static_cast<float>(i) + 0.012f, a1 = a0 + 1.0472f - 0.024f;
    const auto at = [&](float u, float v) {
      // From the plinth up the outside, over the seat to the middle.
      const float a = a0 + (a1 - a0) * u, edge = 1 - std::pow(std::abs(2 * u - 1), 14.0f);
      const float r = v < 0.4f ? 0.80f : 0.80f - 0.56f * (v - 0.4f) / 0.6f, z = v < 0.4f ? 0.10f + 0.33f * v / 0.4f : 0.43f;
      const float round = std::max(0.0f, 1 - std::abs(v - 0.4f) / 0.08f);
      return Vec3f{(r - 0.04f * round) * std::cos(a), (r - 0.04f * round) * std::sin(a),
                   z - 0.02f * round + (v > 0.45f ? 0.015f * edge : -0.01f * (1 - edge))};
    };
    b.Sheet(14, 20, at, {0.85f, 0.9f});
  }
  UseLeather(b, {0.06f, 0.062f, 0.066f});
  const Vec2f back[] = {{0.25f, 0.42f}, {0.24f, 0.60f}, {0.21f, 0.84f}, {0.17f, 0.88f}, {0, 0.885f}};
  b.Lathe(back, 40);
}

// A curved one of solid surface.
void BuildCurvedBench(PropBuilder& b) {
  UseCeramic(b, {0.70f, 0.69f, 0.66f});
  const auto at = [&](float u, float v) {
    // A loop of section swept along a shallow arc.
    const float a = 6.2831853f * v, s = 2 * u - 1;
    const float y = 0.23f * std::copysign(std::pow(std::abs(std::cos(a)), 0.5f), std::cos(a)) + 0.28f * s * s - 0.10f;
    const float z = 0.225f + 0.22f * std::copysign(std::pow(std::abs(std::sin(a)), 0.5f), std::sin(a));
    return Vec3f{1.1f * s, y, z};
  };
  b.Sheet(24, 24, [&](float u, float v) { return at(u, v); }, {2.2f, 1.4f});
  for (const bool right : {false, true}) {
    std::vector<Vec3f> rim;
    for (int i = 0; i < 24; ++i) rim.push_back(at(right ? 1.0f : 0.0f, static_cast<float>(i) / 24));
    Vec3f middle{};
    for (Vec3f p : rim) middle = middle + p * (1.0f / 24);
    for (size_t i = 0; i < rim.size(); ++i) {
      const Vec3f p = rim[i], q = rim[(i + 1) % rim.size()];
      right ? b.mesh().Triangle(middle, p, q) : b.mesh().Triangle(middle, q, p);
    }
  }
}

Model MakeBenchMall(uint32_t variant, uint64_t) {
  PropBuilder b("bench_mall");
  if (variant == 0)
    BuildSlatBench(b);
  else if (variant == 1)
    BuildIslandBench(b);
  else
    BuildCurvedBench(b);
  return b.Finish();
}

void UseMallLeaf(PropBuilder& b, Vec3f tint) {
  Material m = Leaf(tint, 0.35f);
  m.roughness = 0.4f;
  b.Use(m);
}

// Trunk and arching fronds from `foot`.
void MallPalm(PropBuilder& b, RngStream& rng, Vec3f foot) {
  const float trunk = Random(rng, 0.7f, 1.1f);
  b.Use(Stone({0.19f, 0.14f, 0.09f}, 0.95f), BarkTexture(), {0.2f, 0.3f});
  b.Bar(std::array<Vec3f, 3>{foot, foot + Vec3f{0.03f, 0.02f, trunk * 0.5f}, foot + Vec3f{0.01f, 0, trunk}},
        std::array<float, 3>{0.055f, 0.045f, 0.04f}, 10);
  for (int f = 0; f < 14; ++f) {
    const float turn = 137.5f * static_cast<float>(f), length = Random(rng, 0.75f, 1.05f), rise = Random(rng, 0.25f, 1.25f);
    const Vec3f d{std::cos(turn * 0.01745f), std::sin(turn * 0.01745f), 0};
    std::vector<Vec3f> rib;
    for (int j = 0; j <= 7; ++j) {
      const float t = static_cast<float>(j) / 7;
      rib.push_back(foot + Vec3f{0.01f, 0, trunk} + d * (length * t * (0.55f + 0.45f * (1.3f - rise) * 0.8f)) +
                    Vec3f{0, 0, length * (rise * t - (0.45f + 0.5f * rise) * t * t)});
    }
    UseMallLeaf(b, {0.09f, 0.19f, 0.055f});
    b.Bar(rib, 0.006f, 5);
    for (int j = 1; j < 8; ++j)
      for (float s : {-1.0f, 1.0f}) {
        const float t = static_cast<float>(j) / 7;
        BroadLeaf(b, Turn(0, 5 - 45 * t, turn + s * (58 - 25 * t), rib[static_cast<size_t>(j)]), 0.36f * (1.1f - 0.5f * t), 0.04f, 0.4f);
      }
  }
}

// A large tub with palms and ground cover: round, long, square.
Model MakePlanterMall(uint32_t variant, uint64_t seed) {
  PropBuilder b("planter_mall");
  RngStream rng(seed, "mall planter");
  const float h = 0.60f;
  const Vec2f half = std::array<Vec2f, 3>{{{0.60f, 0.60f}, {1.0f, 0.35f}, {0.45f, 0.45f}}}[variant];
  if (variant == 0) {
    UseCeramic(b, {0.68f, 0.67f, 0.64f});
    const Vec2f tub[] = {{0.44f, 0}, {0.46f, 0.01f}, {0.58f, h - 0.05f}, {0.60f, h - 0.03f}, {0.60f, h}, {0.55f, h}, {0.54f, h - 0.06f}};
    b.Lathe(tub, 48);
  } else {
    variant == 1 ? UseTimber(b, Timber::kOak, Grain::kAlongX) : UseBrushedSteel(b);
    b.BevelBox({-half.x, -half.y, 0.04f}, {half.x, -half.y + 0.03f, h}, 0.006f);
    b.BevelBox({-half.x, half.y - 0.03f, 0.04f}, {half.x, half.y, h}, 0.006f);
    b.BevelBox({-half.x, -half.y + 0.03f, 0.04f}, {-half.x + 0.03f, half.y - 0.03f, h}, 0.006f);
    b.BevelBox({half.x - 0.03f, -half.y + 0.03f, 0.04f}, {half.x, half.y - 0.03f, h}, 0.006f);
    b.Use(Plastic({0.03f, 0.03f, 0.033f}));
    b.mesh().Box({-half.x + 0.05f, -half.y + 0.05f, 0}, {half.x - 0.05f, half.y - 0.05f, 0.045f});
  }
  b.Use(Stone({0.05f, 0.036f, 0.025f}, 0.95f), ConcreteTexture(), {0.2f, 0.2f});
  if (variant == 0) {
    const Vec2f soil[] = {{0.545f, h - 0.06f}, {0.3f, h - 0.04f}, {0, h - 0.03f}};
    b.Lathe(soil, 32);
  } else {
    b.mesh().Quad({-half.x + 0.03f, -half.y + 0.03f, h - 0.05f}, {half.x - 0.03f, -half.y + 0.03f, h - 0.05f},
                  {half.x - 0.03f, half.y - 0.03f, h - 0.05f}, {-half.x + 0.03f, half.y - 0.03f, h - 0.05f});
  }
  for (int i = 0; i < 90; ++i) {  // ground cover
    UseMallLeaf(b, i % 3 ? Vec3f{0.07f, 0.17f, 0.05f} : Vec3f{0.11f, 0.22f, 0.06f});
    const Vec3f p{Random(rng, -0.85f, 0.85f) * half.x * (variant ? 1 : 0.72f), Random(rng, -0.85f, 0.85f) * half.y * (variant ? 1 : 0.72f),
                  h - 0.04f};
    BroadLeaf(b, Turn(0, -Random(rng, 10, 65), Random(rng, 0, 360), p), Random(rng, 0.14f, 0.26f), Random(rng, 0.05f, 0.09f),
              Random(rng, 0.2f, 0.6f));
  }
  const int palms = variant == 1 ? 3 : 1;
  for (int k = 0; k < palms; ++k) {
    const Vec3f foot{palms == 1 ? 0.0f : -0.62f + 0.62f * static_cast<float>(k), 0, h - 0.05f};
    MallPalm(b, rng, foot);
  }
  return b.Finish();
}

const Texture& KioskSign(uint32_t variant) {
  static const std::array<Texture, 3> signs = [] {
    std::array<Texture, 3> all;
    const std::array<const char*, 3> words = {"COFFEE BAR", "JUICE", "MOBILE FIX"};
    const Vec3f tones[3] = {{0.05f, 0.10f, 0.07f}, {0.55f, 0.22f, 0.02f}, {0.04f, 0.10f, 0.30f}};
    for (size_t k = 0; k < 3; ++k) {
      Canvas canvas(256, 48, tones[k]);
      canvas.Letters(words[k], {0.5f, 0.5f}, 0.55f, {0.85f, 0.83f, 0.76f});
      all[k] = canvas.Finish(std::string("kiosk ") + words[k]);
    }
    return all;
  }();
  return signs[variant];
}

// Island of counters 3 x 2 m under a canopy on four posts.
Model MakeKiosk(uint32_t variant, uint64_t seed) {
  PropBuilder b("kiosk");
  const float x = 1.5f, y = 1.0f, top = 1.08f, roof = 2.55f;
  const auto body = [&] {
    variant == 0   ? UseTimber(b, Timber::kWalnut)
    : variant == 1 ? UseTimber(b, Timber::kBeech)
                   : UseLacquer(b, {0.72f, 0.72f, 0.71f}, 0.25f);
  };
  for (int side = 0; side < 4; ++side) {
    const bool along = side % 2 == 0;
    if (side == 2) continue;  // way in at the back
    const float half = along ? x : y, off = along ? y : x;
    b.Place(Turn(0, 0, side == 0 ? 0.0f : side == 1 ? 90.0f : -90.0f));
    body();
    b.BevelBox({-half, -off, 0.08f}, {half, -off + 0.55f, top - 0.035f}, 0.006f);
    b.Use(Plastic({0.03f, 0.03f, 0.033f}));
    b.mesh().Box({-half + 0.04f, -off + 0.05f, 0}, {half - 0.04f, -off + 0.50f, 0.08f});
    UseStoneTop(b, variant == 1 ? Vec3f{0.66f, 0.65f, 0.62f} : Vec3f{0.16f, 0.16f, 0.165f});
    b.BevelBox({-half - 0.03f, -off - 0.04f, top - 0.035f}, {half + 0.03f, -off + 0.57f, top}, 0.006f);
  }
  b.Place({});
  b.Use(Paint({0.04f, 0.042f, 0.045f}, 0.4f));
  for (float px : {-x + 0.06f, x - 0.06f})
    for (float py : {-y + 0.06f, y - 0.06f}) b.BevelBox({px - 0.03f, py - 0.03f, py > 0 ? 0 : top}, {px + 0.03f, py + 0.03f, roof}, 0.004f);
  body();
  b.BevelBox({-x - 0.08f, -y - 0.08f, roof}, {x + 0.08f, y + 0.08f, roof + 0.05f}, 0.01f);
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({-x - 0.08f, s * (y + 0.07f) - 0.012f, roof + 0.05f}, {x + 0.08f, s * (y + 0.07f) + 0.012f, roof + 0.42f}, 0.004f);
    b.BevelBox({s * (x + 0.07f) - 0.012f, -y - 0.06f, roof + 0.05f}, {s * (x + 0.07f) + 0.012f, y + 0.06f, roof + 0.42f}, 0.004f);
  }
  Material lit = Screen(180);
  lit.name = "lit sign";
  b.Use(lit, KioskSign(variant));
  const float zs = roof + 0.08f;
  b.Picture({-0.9f, -y - 0.083f, zs}, {0.9f, -y - 0.083f, zs}, {0.9f, -y - 0.083f, zs + 0.32f}, {-0.9f, -y - 0.083f, zs + 0.32f});
  b.Picture({0.9f, y + 0.083f, zs}, {-0.9f, y + 0.083f, zs}, {-0.9f, y + 0.083f, zs + 0.32f}, {0.9f, y + 0.083f, zs + 0.32f});
  b.Use(LampSurface(2400, 2 * (2 * x - 0.6f) * 0.06f, 3000, Burns::kAlways));  // strips under the canopy
  for (float py : {-y + 0.3f, y - 0.3f})
    b.mesh().Quad({-x + 0.3f, py + 0.03f, roof - 0.001f}, {x - 0.3f, py + 0.03f, roof - 0.001f}, {x - 0.3f, py - 0.03f, roof - 0.001f},
                  {-x + 0.3f, py - 0.03f, roof - 0.001f});
  // On the counters.
  if (variant < 2) {
    UseBrushedSteel(b, 0.22f);
    SoftBox(b, {0.35f, -y + 0.10f, top}, {1.10f, -y + 0.52f, top + 0.46f}, {.round = 0.04f, .crown = 0.004f, .cells = 7});
    b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.3f));
    for (int i = 0; i < 2; ++i)
      b.mesh().Tube({0.55f + 0.35f * static_cast<float>(i), -y + 0.08f, top + 0.24f},
                    {0.55f + 0.35f * static_cast<float>(i), -y - 0.04f, top + 0.22f}, 0.035f, 0.018f, 14);
    UseCeramic(b);
    for (int i = 0; i < 8; ++i)
      Cup(b, {-0.1f - 0.10f * static_cast<float>(i % 4), -y + 0.18f + 0.11f * static_cast<float>(i / 4), top}, 0.04f, 0.065f);
    GoodsOnShelf(b, -1.3f, -0.65f, -y + 0.06f, 0.3f, top, 0.28f, seed);
  } else {
    GoodsOnShelf(b, -1.3f, 1.2f, -y + 0.06f, 0.3f, top, 0.24f, seed);
  }
  b.Use(ClearGlass());
  b.mesh().Quad({-1.35f, -y + 0.03f, top}, {-0.05f, -y + 0.03f, top}, {-0.05f, -y + 0.03f, top + 0.30f}, {-1.35f, -y + 0.03f, top + 0.30f});
  return b.Finish();
}

// Drinks behind glass, snacks, coffee. Lit from within.
Model MakeVendingMachine(uint32_t variant, uint64_t seed) {
  PropBuilder b("vending_machine");
  const Vec3f tone = std::array<Vec3f, 3>{{{0.45f, 0.03f, 0.03f}, {0.03f, 0.09f, 0.30f}, {0.05f, 0.052f, 0.056f}}}[variant];
  const float half = 0.46f, d = 0.40f, h = 1.83f;
  b.Use(Paint(tone, 0.3f));
  b.BevelBox({-half, -d + 0.05f, 0.05f}, {half, d, h}, 0.012f);
  b.mesh().Box({-half + 0.05f, -d + 0.1f, 0}, {half - 0.05f, d - 0.05f, 0.05f});
  if (variant == 2) {
    b.BevelBox({-half, -d, 0.05f}, {half, -d + 0.06f, h}, 0.015f);
    Canvas canvas(128, 192, {0.045f, 0.022f, 0.012f});
    canvas.Letters("COFFEE", {0.5f, 0.15f}, 0.10f, {0.75f, 0.62f, 0.42f});
    canvas.Disc({0.5f, 0.55f}, 0.20f, {0.72f, 0.70f, 0.66f});
    canvas.Disc({0.5f, 0.55f}, 0.16f, {0.13f, 0.06f, 0.03f});
    canvas.Disc({0.5f, 0.55f}, 0.12f, {0.22f, 0.12f, 0.06f});
    Material lit = Screen(140);
    lit.name = "lit front";
    b.Use(lit, canvas.Finish("coffee front"));
    b.Picture({-half + 0.04f, -d - 0.001f, 0.95f}, {half - 0.24f, -d - 0.001f, 0.95f}, {half - 0.24f, -d - 0.001f, h - 0.06f},
              {-half + 0.04f, -d - 0.001f, h - 0.06f});
    b.Use(Plastic({0.01f, 0.01f, 0.011f}, 0.2f));
    b.BevelBox({-0.16f, -d - 0.003f, 0.55f}, {0.16f, -d + 0.01f, 0.85f}, 0.004f);
  } else {
    for (float s : {-1.0f, 1.0f})
      b.BevelBox({s > 0 ? half - 0.20f : -half, -d, 0.05f}, {s > 0 ? half : -half + 0.04f, -d + 0.06f, h}, 0.01f);
    b.BevelBox({-half + 0.04f, -d, 0.05f}, {half - 0.20f, -d + 0.06f, 0.42f}, 0.01f);
    b.BevelBox({-half + 0.04f, -d, h - 0.10f}, {half - 0.20f, -d + 0.06f, h}, 0.01f);
    b.Use(Stone({0.74f, 0.74f, 0.73f}, 0.5f));  // the cabinet behind the glass is only as deep as its front row
    b.mesh().Quad({-half + 0.04f, -d + 0.048f, 0.42f}, {half - 0.20f, -d + 0.048f, 0.42f}, {half - 0.20f, -d + 0.048f, h - 0.10f},
                  {-half + 0.04f, -d + 0.048f, h - 0.10f});
    for (int i = 0; i < 5; ++i)
      GoodsOnShelf(b, -half + 0.05f, half - 0.21f, -d + 0.006f, 0.04f, 0.46f + 0.25f * static_cast<float>(i), 0.22f,
                   seed + static_cast<uint64_t>(i));
    b.Use(Metal());
    for (int i = 0; i < 5; ++i)
      b.BevelBox({-half + 0.04f, -d + 0.004f, 0.435f + 0.25f * static_cast<float>(i)},
                 {half - 0.20f, -d + 0.05f, 0.458f + 0.25f * static_cast<float>(i)}, 0.002f);
    b.Use(LampSurface(900, 2 * 1.25f * 0.02f, 5000, Burns::kAlways));
    for (float x : {-half + 0.048f, half - 0.226f})
      b.mesh().Quad({x, -d + 0.046f, 0.45f}, {x + 0.02f, -d + 0.046f, 0.45f}, {x + 0.02f, -d + 0.046f, h - 0.13f},
                    {x, -d + 0.046f, h - 0.13f});
    b.Use(ClearGlass());
    b.mesh().Quad({-half + 0.04f, -d + 0.002f, 0.42f}, {half - 0.20f, -d + 0.002f, 0.42f}, {half - 0.20f, -d + 0.002f, h - 0.10f},
                  {-half + 0.04f, -d + 0.002f, h - 0.10f});
    b.Use(Plastic({0.01f, 0.01f, 0.011f}, 0.3f));
    b.BevelBox({-half + 0.12f, -d - 0.004f, 0.16f}, {half - 0.30f, -d + 0.01f, 0.34f}, 0.004f);
  }
  b.Use(Plastic({0.03f, 0.032f, 0.035f}, 0.3f));
  b.BevelBox({half - 0.175f, -d - 0.006f, 0.95f}, {half - 0.025f, -d + 0.01f, 1.45f}, 0.004f);
  b.Use(Metal());
  for (int i = 0; i < 12; ++i) {
    const float x = half - 0.15f + 0.036f * static_cast<float>(i % 3), z = 1.08f + 0.036f * static_cast<float>(i / 3);
    b.BevelBox({x, -d - 0.010f, z}, {x + 0.026f, -d - 0.004f, z + 0.026f}, 0.002f);
  }
  b.BevelBox({half - 0.125f, -d - 0.009f, 0.985f}, {half - 0.075f, -d - 0.005f, 1.03f}, 0.002f);
  b.Use(Screen(90));
  b.mesh().Quad({half - 0.15f, -d - 0.0065f, 1.32f}, {half - 0.05f, -d - 0.0065f, 1.32f}, {half - 0.05f, -d - 0.0065f, 1.40f},
                {half - 0.15f, -d - 0.0065f, 1.40f});
  return b.Finish();
}

}  // namespace

FurnishingRows MallRows() {
  return {{{"bench_mall", "furniture/seating/bench", 3, MakeBenchMall, 1.15f, 0.42f, 0.95f, 4500}},
          {{"planter_mall", "furniture/planter/pot", 3, MakePlanterMall, 1.1f, 1.2f, 3.2f, 22000}},
          {{"kiosk", "furniture/vending/food_stall", 3, MakeKiosk, 1.9f, 2.9f, 3.1f, 7000}},
          {{"vending_machine", "furniture/vending/machine", 3, MakeVendingMachine, 0.65f, 1.80f, 1.86f, 3500}}};
}

}  // namespace airsim360::internal
