// Shops: gondolas 1.25 m long, 1.6 m high with shelves 40 cm deep on both sides; rails 1.4 to 1.7 m; checkouts with a belt
// 85 cm high (EN ISO 14738 heights for sitting and standing work).
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr std::array<Vec3f, 6> kClothes = {{{0.05f, 0.07f, 0.14f},
                                            {0.60f, 0.58f, 0.53f},
                                            {0.34f, 0.07f, 0.06f},
                                            {0.20f, 0.24f, 0.17f},
                                            {0.03f, 0.03f, 0.033f},
                                            {0.50f, 0.36f, 0.20f}}};

// Two-sided gondola; variant 2 is one-sided against a wall, 2 m high.
Model MakeShopShelf(uint32_t variant, uint64_t seed) {
  PropBuilder b("shop_shelf");
  RngStream rng(seed, "gondola");
  const bool wall = variant == 2;
  const float half = 0.625f, h = wall ? 2.0f : variant == 1 ? 1.35f : 1.60f, deep = 0.40f;
  const int shelves = wall ? 5 : variant == 1 ? 3 : 4;
  UseCoatedSteel(b, {0.70f, 0.70f, 0.68f}, 0.4f);
  const float y_back = wall ? deep / 2 + 0.03f : 0.0f;
  b.mesh().Box({-half, y_back - 0.02f, 0.1f}, {half, y_back + 0.02f, h});
  for (float x : {-half, half}) b.BevelBox({x - 0.015f, y_back - 0.035f, 0}, {x + 0.015f, y_back + 0.035f, h + 0.02f}, 0.003f);
  const float pitch = (h - 0.15f) / static_cast<float>(shelves);
  for (float side : wall ? std::vector<float>{1.0f} : std::vector<float>{1.0f, -1.0f}) {
    b.Place(Turn(0, 0, side > 0 ? 0.0f : 180.0f, {0, side > 0 ? y_back : -y_back, 0}));
    UseCoatedSteel(b, {0.70f, 0.70f, 0.68f}, 0.4f);
    for (int i = 0; i < shelves; ++i) {
      const float z = 0.15f + pitch * static_cast<float>(i), d = i == 0 ? deep + 0.05f : deep;
      b.mesh().Box({-half + 0.01f, -0.02f - d, z - 0.025f}, {half - 0.01f, -0.02f, z});
      if (i == 0) b.mesh().Box({-half + 0.01f, -d, 0}, {half - 0.01f, -0.02f, z - 0.025f});
    }
    b.Use(Plastic({0.72f, 0.62f, 0.10f}, 0.3f));  // price rails
    for (int i = 0; i < shelves; ++i) {
      const float z = 0.15f + pitch * static_cast<float>(i), d = i == 0 ? deep + 0.05f : deep;
      b.mesh().Box({-half + 0.01f, -0.026f - d, z - 0.034f}, {half - 0.01f, -0.02f - d, z + 0.004f});
    }
    b.Use(Stone({0.78f, 0.77f, 0.74f}, 0.8f));
    for (int i = 0; i < shelves; ++i) {
      const float z = 0.15f + pitch * static_cast<float>(i), d = i == 0 ? deep + 0.05f : deep;
      for (float x = -half + 0.06f; x < half - 0.08f; x += Random(rng, 0.11f, 0.2f))
        b.mesh().Box({x, -0.0275f - d, z - 0.031f}, {x + 0.055f, -0.026f - d, z + 0.001f}, MeshBuilder::kFront);
    }
    const AffineTransform X = Turn(0, 0, side > 0 ? 0.0f : 180.0f, {0, side > 0 ? y_back : -y_back, 0});
    for (int i = 0; i < shelves; ++i) {
      const float z = 0.15f + pitch * static_cast<float>(i), d = i == 0 ? deep + 0.05f : deep;
      b.Place(X);
      GoodsOnShelf(b, -half + 0.03f, half - 0.03f, -d - 0.005f, d - 0.03f, z, std::min(0.34f, pitch - 0.03f), rng.Bits());
    }
  }
  b.Place({});
  return b.Finish();
}

// One rail on castors; a round one; two arms at different heights.
Model MakeClothesRail(uint32_t variant, uint64_t seed) {
  PropBuilder b("clothes_rail");
  RngStream rng(seed, "rail");
  const float top = 1.55f;
  b.Use(Chrome());
  if (variant == 1) {
    std::vector<Vec3f> ring;
    for (int i = 0; i <= 40; ++i) ring.push_back(Around(i % 40, 40) * 0.45f + Vec3f{0, 0, top - 0.20f});
    b.Bar(ring, 0.0125f, 8);
    b.mesh().Tube({0, 0, 0.02f}, {0, 0, top - 0.20f}, 0.02f, 0.02f, 12);
    for (int i = 0; i < 4; ++i) {
      b.mesh().Tube({0, 0, top - 0.22f}, Around(i, 4) * 0.45f + Vec3f{0, 0, top - 0.20f}, 0.008f, 0.008f, 8);
      b.mesh().Tube({0, 0, 0.05f}, Around(i, 4, 0.4f) * 0.36f + Vec3f{0, 0, 0.02f}, 0.014f, 0.012f, 8);
    }
    for (int i = 0; i < 30; ++i) {
      if (i % 10 == 0) continue;
      UseLinen(b, kClothes[(static_cast<size_t>(i) / 5) % kClothes.size()]);
      const Vec3f d = Around(i, 30);
      HangingGarment(b, Turn(0, 0, 12.0f * static_cast<float>(i), d * 0.45f + Vec3f{0, 0, top - 0.21f}), 0.40f, Random(rng, 0.6f, 0.85f),
                     rng.Bits());
    }
    return b.Finish();
  }
  const float half = 0.75f;
  for (float s : {-1.0f, 1.0f}) {
    b.Bar(std::array<Vec3f, 2>{Vec3f{s * half, 0, 0.09f}, Vec3f{s * half, 0, top}}, 0.015f, 10);
    b.Bar(std::array<Vec3f, 2>{Vec3f{s * half, -0.25f, 0.09f}, Vec3f{s * half, 0.25f, 0.09f}}, 0.015f, 10);
  }
  b.mesh().Tube({-half, 0, top}, {half, 0, top}, 0.015f, 0.015f, 10);
  b.mesh().Tube({-half, 0, 0.09f}, {half, 0, 0.09f}, 0.012f, 0.012f, 10);
  for (float s : {-1.0f, 1.0f})
    for (float y : {-0.23f, 0.23f}) Castor(b, {s * half, y, 0.085f});
  float x = -half + 0.08f;
  size_t tone = variant;
  while (x < half - 0.08f) {
    const int run = 3 + static_cast<int>(rng.Index(4));
    const float length = Random(rng, 0.58f, variant == 2 ? 1.15f : 0.85f);
    for (int i = 0; i < run && x < half - 0.08f; ++i) {
      UseLinen(b, kClothes[tone % kClothes.size()] * Random(rng, 0.92f, 1.08f));
      HangingGarment(b, Turn(0, 0, 90 + Random(rng, -6, 6), {x, 0, top - 0.01f}), 0.42f, length, rng.Bits());
      x += Random(rng, 0.045f, 0.07f);
    }
    ++tone;
    if (rng.Chance(0.4)) x += 0.10f;
  }
  return b.Finish();
}

// Flared skirt from a waist at 1.10 m, outside and inside.
void Skirt(PropBuilder& b, Vec3f color) {
  UseLinen(b, color);
  b.Sheet(48, 8,
          [&](float u, float v) {
            const float a = kTauF * u, down = 1 - v, r = 0.155f + 0.13f * down,
                        fold = 1 + 0.10f * down * std::sin(11 * a) + 0.04f * std::sin(5 * a) * down;
            return Vec3f{r * fold * std::cos(a) * 1.05f, r * fold * std::sin(a) * 0.85f, 1.10f - 0.60f * down};
          },
          {1.2f, 0.6f});
  b.Sheet(24, 8,
          [&](float u, float v) {  // its inside
            const float a = -kTauF * u, down = 1 - v, r = 0.15f + 0.13f * down;
            return Vec3f{r * std::cos(a) * 1.04f, r * std::sin(a) * 0.84f, 1.10f - 0.60f * down};
          },
          {1.2f, 0.6f});
}

// Torso on a stand, dressed.
Model MakeMannequinBust(uint32_t variant, uint64_t seed) {
  PropBuilder b("mannequin_bust");
  b.Use(Metal({0.5f, 0.5f, 0.5f}, 0.3f));
  const Vec2f foot[] = {{0.15f, 0}, {0.155f, 0.008f}, {0.14f, 0.015f}, {0.014f, 0.03f}, {0.014f, 0.95f}};
  b.Lathe(foot, 28);
  const bool male = variant == 1;
  struct Ring {
    float z, wide, deep;
  };
  const std::array<Ring, 9> body = male ? std::array<Ring, 9>{{{0.90f, 0.165f, 0.11f},
                                                               {1.00f, 0.175f, 0.12f},
                                                               {1.12f, 0.155f, 0.105f},
                                                               {1.28f, 0.18f, 0.12f},
                                                               {1.40f, 0.205f, 0.125f},
                                                               {1.50f, 0.215f, 0.10f},
                                                               {1.56f, 0.12f, 0.07f},
                                                               {1.60f, 0.058f, 0.058f},
                                                               {1.68f, 0.054f, 0.056f}}}
                                        : std::array<Ring, 9>{{{0.88f, 0.170f, 0.115f},
                                                               {0.98f, 0.178f, 0.125f},
                                                               {1.12f, 0.125f, 0.095f},
                                                               {1.26f, 0.15f, 0.13f},
                                                               {1.36f, 0.165f, 0.12f},
                                                               {1.45f, 0.175f, 0.085f},
                                                               {1.50f, 0.09f, 0.06f},
                                                               {1.54f, 0.046f, 0.05f},
                                                               {1.62f, 0.044f, 0.048f}}};
  const auto skin = [&](float grow, size_t first, size_t last) {
    b.Sheet(28, 3 * static_cast<int>(last - first),
            [&](float u, float v) {
              const float s = v * static_cast<float>(last - first), a = kTauF * u;
              const size_t i = std::min(last - first - 1, static_cast<size_t>(s)) + first;
              const float t = s - static_cast<float>(i - first), e = t * t * (3 - 2 * t);
              const auto mix = [&](float p, float q) { return p + (q - p) * e; };
              const float fold = grow > 0 ? 0.006f * std::sin(7 * a + static_cast<float>(seed % 7)) * (1 - v) : 0.0f;
              const float chest =
                  !male && body[i].z > 1.15f && body[i].z < 1.37f && std::sin(a) < 0 ? 0.02f * std::abs(std::sin(2 * a)) : 0.0f;
              return Vec3f{(mix(body[i].wide, body[i + 1].wide) + grow + fold) * std::cos(a),
                           (mix(body[i].deep, body[i + 1].deep) + grow + fold + chest) * std::sin(a),
                           body[i].z + (body[i + 1].z - body[i].z) * t};
            },
            {0.9f, 0.7f});
  };
  UseLinen(b, {0.62f, 0.56f, 0.46f});
  skin(0, 0, 8);
  UseTimber(b, Timber::kWalnut);
  const float neck = body[8].z;
  const Vec2f cap[] = {{0.05f, neck - 0.002f}, {0.052f, neck + 0.012f}, {0.02f, neck + 0.02f},
                       {0.016f, neck + 0.04f}, {0.022f, neck + 0.055f}, {0, neck + 0.065f}};
  b.Lathe(cap, 20);
  UseWeave(b, kClothes[std::array{2, 0, 3}[variant]]);
  skin(0.012f, male ? 0 : 2, variant == 2 ? 5 : 6);
  if (variant != 1) Skirt(b, variant == 0 ? Vec3f{0.04f, 0.04f, 0.045f} : Vec3f{0.55f, 0.50f, 0.40f});
  return b.Finish();
}

// Belt, scanner, till with screen and terminal, rails; the customer passes along -Y.
Model MakeCheckout(uint32_t variant, uint64_t seed) {
  PropBuilder b("checkout");
  const float half = 1.30f, top = 0.86f;
  variant == 0 ? UseLacquer(b, {0.62f, 0.63f, 0.63f}) : UseTimber(b, Timber::kOak, Grain::kAlongX);
  b.BevelBox({-half, -0.30f, 0.08f}, {half, 0.22f, top - 0.03f}, 0.006f);
  b.Use(Plastic({0.03f, 0.03f, 0.033f}, 0.5f));
  b.mesh().Box({-half + 0.03f, -0.26f, 0}, {half - 0.03f, 0.18f, 0.08f});
  UseBrushedSteel(b);
  for (float y : {-0.31f, 0.19f}) b.BevelBox({-half, y, top - 0.04f}, {half, y + 0.05f, top + 0.005f}, 0.005f);
  b.BevelBox({0.02f, -0.27f, top - 0.035f}, {0.42f, 0.20f, top - 0.002f}, 0.003f);
  b.BevelBox({0.42f, -0.27f, top - 0.10f}, {half, 0.20f, top - 0.06f}, 0.003f);  // the bagging tray, lower
  b.Use(Rubber());
  b.mesh().Box({-half + 0.02f, -0.262f, top - 0.03f}, {0.02f, 0.192f, top - 0.006f});
  b.Use(Plastic({0.012f, 0.012f, 0.014f}, 0.06f));
  b.BevelBox({0.12f, -0.12f, top - 0.002f}, {0.32f, 0.08f, top + 0.001f}, 0.001f);  // scanner glass
  b.BevelBox({0.10f, 0.17f, top}, {0.34f, 0.21f, top + 0.17f}, 0.01f);
  // Screen on a post, card terminal, divider bars, goods on the belt.
  b.Use(Plastic({0.04f, 0.042f, 0.045f}, 0.4f));
  b.mesh().Tube({0.50f, 0.20f, top}, {0.50f, 0.20f, top + 0.40f}, 0.02f, 0.02f, 12);
  b.BevelBox({0.33f, 0.19f, top + 0.30f}, {0.67f, 0.225f, top + 0.54f}, 0.01f);
  b.mesh().Tube({0.62f, -0.28f, top - 0.02f}, {0.62f, -0.28f, top + 0.20f}, 0.014f, 0.014f, 10);
  b.Place(Turn(-40, 0, 0, {0.62f, -0.28f, top + 0.20f}));
  b.BevelBox({-0.045f, -0.02f, -0.02f}, {0.045f, 0.02f, 0.14f}, 0.008f);
  b.Place({});
  b.Use(Plastic({0.45f, 0.05f, 0.04f}, 0.4f));
  b.mesh().Beam({-0.75f, -0.20f, top + 0.012f}, {-0.75f, 0.14f, top + 0.012f}, 0.035f);
  b.Use(Screen(150));
  b.mesh().Quad({0.66f, 0.2255f, top + 0.32f}, {0.34f, 0.2255f, top + 0.32f}, {0.34f, 0.2255f, top + 0.52f}, {0.66f, 0.2255f, top + 0.52f});
  GoodsOnShelf(b, -0.70f, -0.10f, -0.16f, 0.25f, top - 0.005f, 0.30f, seed);
  if (variant == 0) {  // the number of the till, lit
    b.Use(Plastic({0.5f, 0.5f, 0.5f}, 0.4f));
    b.mesh().Tube({0.9f, 0.20f, 0.7f}, {0.9f, 0.20f, 2.05f}, 0.018f, 0.018f, 10);
    Canvas canvas(64, 64, {0.10f, 0.32f, 0.12f});
    canvas.Letters("3", {0.5f, 0.5f}, 0.62f, {0.85f, 0.85f, 0.82f});
    const Texture number = canvas.Finish("till 3");
    Material lit = Screen(250);
    lit.name = "lit number";
    b.Use(lit, number);
    for (float s : {-1.0f, 1.0f})
      b.Picture({0.9f - 0.11f * s, 0.20f - 0.055f * s, 2.05f}, {0.9f + 0.11f * s, 0.20f - 0.055f * s, 2.05f},
                {0.9f + 0.11f * s, 0.20f - 0.055f * s, 2.27f}, {0.9f - 0.11f * s, 0.20f - 0.055f * s, 2.27f});
    b.Use(Plastic({0.5f, 0.5f, 0.5f}, 0.4f));
    for (float s : {-1.0f, 1.0f})
      b.BevelBox({0.9f + s * 0.115f - 0.006f, 0.145f, 2.04f}, {0.9f + s * 0.115f + 0.006f, 0.255f, 2.28f}, 0.003f);
    b.BevelBox({0.785f, 0.145f, 2.27f}, {1.015f, 0.255f, 2.28f}, 0.003f);
    b.BevelBox({0.785f, 0.145f, 2.04f}, {1.015f, 0.255f, 2.05f}, 0.003f);
  }
  return b.Finish();
}

Model MakeShopCounter(uint32_t variant, uint64_t) {
  PropBuilder b("shop_counter");
  const float half = 0.90f, h = 1.0f;
  switch (variant) {
    case 0:
      UseTimber(b, Timber::kOak);
      break;
    case 1:
      UseLacquer(b, {0.05f, 0.08f, 0.09f}, 0.25f);
      break;
    default:
      UseLacquer(b, {0.74f, 0.73f, 0.71f}, 0.25f);
  }
  b.BevelBox({-half, -0.28f, 0.08f}, {half, -0.255f, h - 0.03f}, 0.003f);
  for (float s : {-1.0f, 1.0f})
    b.BevelBox({s * (half - 0.0125f) - 0.0125f, -0.255f, 0}, {s * (half - 0.0125f) + 0.0125f, 0.28f, h - 0.03f}, 0.003f);
  if (variant == 0)
    for (int i = 0; i < 30; ++i) {  // fluted front
      const float x = -half + 0.03f + 0.06f * static_cast<float>(i);
      b.mesh().Tube({x, -0.278f, 0.085f}, {x, -0.278f, h - 0.035f}, 0.022f, 0.022f, 10, false, false);
    }
  b.mesh().Box({-half + 0.02f, -0.25f, 0.45f}, {half - 0.02f, 0.25f, 0.47f});
  UseStoneTop(b, variant == 1 ? Vec3f{0.60f, 0.59f, 0.56f} : Vec3f{0.14f, 0.14f, 0.145f});
  b.BevelBox({-half - 0.03f, -0.32f, h - 0.03f}, {half + 0.03f, 0.30f, h}, 0.005f);
  b.Use(Plastic({0.03f, 0.03f, 0.033f}, 0.4f));
  b.BevelBox({-half + 0.03f, -0.22f, 0}, {half - 0.03f, -0.20f, 0.08f}, 0.002f);
  b.Place(Turn(18, 0, 180, {0.35f, 0.05f, h + 0.07f}));
  b.BevelBox({-0.16f, -0.012f, 0}, {0.16f, 0.012f, 0.24f}, 0.006f);
  b.Place({});
  b.mesh().Tube({0.35f, 0.05f, h}, {0.35f, 0.03f, h + 0.12f}, 0.025f, 0.018f, 12);
  b.BevelBox({-0.10f, -0.20f, h}, {0.0f, -0.06f, h + 0.04f}, 0.008f);
  UseCardboard(b, 1);
  for (int i = 0; i < 3; ++i)
    b.BevelBox({-0.62f + 0.015f * static_cast<float>(i), -0.05f, h + 0.03f * static_cast<float>(i)},
               {-0.36f + 0.01f * static_cast<float>(i), 0.16f, h + 0.03f + 0.03f * static_cast<float>(i)}, 0.003f);
  return b.Finish();
}

// Folded clothes on a table, or things under glass.
Model MakeDisplayTable(uint32_t variant, uint64_t seed) {
  PropBuilder b("display_table");
  RngStream rng(seed, "display");
  const float x = 0.70f, y = 0.40f, top = variant == 1 ? 0.95f : 0.80f;
  if (variant == 1) {
    UseLacquer(b, {0.72f, 0.71f, 0.69f}, 0.25f);
    b.BevelBox({-x, -y, 0.06f}, {x, y, top - 0.20f}, 0.006f);
    b.Use(Plastic({0.03f, 0.03f, 0.033f}));
    b.mesh().Box({-x + 0.04f, -y + 0.04f, 0}, {x - 0.04f, y - 0.04f, 0.06f});
    UsePile(b, {0.08f, 0.09f, 0.12f});
    b.mesh().Box({-x + 0.02f, -y + 0.02f, top - 0.21f}, {x - 0.02f, y - 0.02f, top - 0.195f});
    for (int i = 0; i < 14; ++i) {
      const float px = -0.58f + 0.195f * static_cast<float>(i % 7), py = i < 7 ? -0.17f : 0.15f;
      i % 3 ? b.Use(Metal({0.6f, 0.45f, 0.18f}, 0.2f)) : b.Use(Chrome());
      const Vec2f watch[] = {{0.02f, 0}, {0.022f, 0.005f}, {0.018f, 0.009f}, {0, 0.010f}};
      b.Lathe(watch, 18, {px, py, top - 0.185f});
      UseLeather(b, {0.10f, 0.05f, 0.03f});
      b.BevelBox({px - 0.009f, py - 0.09f, top - 0.194f}, {px + 0.009f, py + 0.09f, top - 0.188f}, 0.002f);
    }
    b.Use(ClearGlass());
    b.BevelBox({-x, -y, top - 0.008f}, {x, y, top}, 0.002f);
    b.mesh().Box({-x + 0.002f, -y + 0.002f, top - 0.20f}, {x - 0.002f, y - 0.002f, top - 0.008f},
                 MeshBuilder::kFront | MeshBuilder::kBack | MeshBuilder::kLeft | MeshBuilder::kRight);
    return b.Finish();
  }
  UseTimber(b, variant == 0 ? Timber::kOak : Timber::kWalnut, Grain::kAlongX);
  RoundedBoard(b, {-x, -y}, {x, y}, 0.02f, top - 0.035f, top, 0.006f);
  b.BevelBox({-x + 0.06f, -y + 0.05f, 0.22f}, {x - 0.06f, y - 0.05f, 0.245f}, 0.004f);
  b.Use(Paint({0.03f, 0.03f, 0.033f}, 0.4f));
  for (float px : {-x + 0.05f, x - 0.05f})
    for (float py : {-y + 0.05f, y - 0.05f}) b.BevelBox({px - 0.02f, py - 0.02f, 0}, {px + 0.02f, py + 0.02f, top - 0.035f}, 0.003f);
  for (float z : {top, 0.245f})
    for (int i = 0; i < 8; ++i) {
      const float px = -0.50f + 0.335f * static_cast<float>(i % 4), py = i < 4 ? -0.17f : 0.17f;
      const int pile = 2 + static_cast<int>(rng.Index(4));
      for (int k = 0; k < pile; ++k) {
        UseLinen(b, kClothes[static_cast<size_t>(i + (k > 1 ? 1 : 0)) % kClothes.size()]);
        b.Place(Turn(0, 0, Random(rng, -3, 3), {px, py, z + 0.036f * static_cast<float>(k)}));
        SoftBox(b, {-0.13f, -0.15f, 0}, {0.13f, 0.15f, 0.038f},
                {.round = 0.016f,
                 .crown = 0.004f,
                 .fold = 0.003f,
                 .seed = rng.Bits(),
                 .cells = 5,
                 .faces = MeshBuilder::kAllSides & ~MeshBuilder::kBottom});
      }
    }
  b.Place({});
  return b.Finish();
}

// Wire basket on four castors, empty or with goods.
Model MakeShoppingCart(uint32_t variant, uint64_t seed) {
  PropBuilder b("shopping_cart");
  const float z0 = 0.48f, z1 = 0.95f;
  // The basket widens towards the handle (+Y) and upwards.
  const auto corner = [&](float u, float v, float w) {  // u across, v along from the front, w up
    const float half = 0.19f + 0.06f * v + 0.02f * w;
    return Vec3f{half * (2 * u - 1), -0.42f + 0.80f * v + (v - 0.5f) * 0.06f * w, z0 + 0.05f * (1 - v) + (z1 - z0 - 0.05f * (1 - v)) * w};
  };
  b.Use(Chrome());
  const auto wire = [&](Vec3f p, Vec3f q, float r) { b.mesh().Tube(p, q, r, r, 5, false, false); };
  for (int i = 0; i <= 8; ++i) {
    const float t = static_cast<float>(i) / 8;
    wire(corner(t, 0, 0), corner(t, 1, 0), 0.0028f);
    wire(corner(t, 0, 0), corner(t, 0, 1), 0.0028f);
    wire(corner(t, 1, 0), corner(t, 1, 1), 0.0028f);
  }
  for (int i = 0; i <= 12; ++i) {
    const float t = static_cast<float>(i) / 12;
    wire(corner(0, t, 0), corner(0, t, 1), 0.0028f);
    wire(corner(1, t, 0), corner(1, t, 1), 0.0028f);
    wire(corner(0, t, 0), corner(1, t, 0), 0.0028f);
  }
  for (int k = 0; k <= 3; ++k) {
    const float w = static_cast<float>(k) / 3, r = k == 3 ? 0.006f : 0.0035f;
    wire(corner(0, 0, w), corner(0, 1, w), r);
    wire(corner(1, 0, w), corner(1, 1, w), r);
    wire(corner(0, 0, w), corner(1, 0, w), r);
    wire(corner(0, 1, w), corner(1, 1, w), r);
  }
  for (float s : {-1.0f, 1.0f}) {
    b.Bar(std::array<Vec3f, 4>{Vec3f{s * 0.25f, 0.46f, 1.01f}, Vec3f{s * 0.25f, 0.36f, 0.60f}, Vec3f{s * 0.24f, 0.34f, 0.20f},
                               Vec3f{s * 0.23f, 0.36f, 0.13f}},
          0.012f, 8);
    b.Bar(std::array<Vec3f, 3>{Vec3f{s * 0.24f, 0.34f, 0.20f}, Vec3f{s * 0.19f, -0.35f, 0.16f}, Vec3f{s * 0.18f, -0.40f, 0.13f}}, 0.011f,
          8);
  }
  for (float y : {-0.28f, 0.0f, 0.28f}) b.mesh().Tube({-0.215f, y, 0.175f}, {0.215f, y, 0.175f}, 0.006f, 0.006f, 6);
  b.Use(Plastic(variant == 1 ? Vec3f{0.05f, 0.25f, 0.10f} : Vec3f{0.50f, 0.05f, 0.04f}, 0.4f));
  b.mesh().Tube({-0.26f, 0.46f, 1.02f}, {0.26f, 0.46f, 1.02f}, 0.016f, 0.016f, 12);
  for (float s : {-1.0f, 1.0f})
    for (float y : {-0.38f, 0.34f}) Castor(b, {s * (y < 0 ? 0.18f : 0.23f), y, 0.13f});
  if (variant == 1) {
    GoodsOnShelf(b, -0.17f, 0.17f, -0.30f, 0.2f, z0 + 0.06f, 0.28f, seed);
    GoodsOnShelf(b, -0.19f, 0.19f, 0.02f, 0.2f, z0 + 0.04f, 0.30f, seed + 1);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows ShopRows() {
  return {{{"shop_shelf", "furniture/shelf", 3, MakeShopShelf, 0.85f, 1.30f, 2.10f, 9000}},
          {{"clothes_rail", "furniture/clothes", 3, MakeClothesRail, 0.85f, 1.30f, 1.60f, 20000}},
          {{"mannequin_bust", "furniture/clothes", 3, MakeMannequinBust, 0.35f, 1.60f, 1.80f, 6000}},
          {{"checkout", "furniture/counter", 2, MakeCheckout, 1.4f, 1.30f, 2.30f, 4000}},
          {{"shop_counter", "furniture/counter", 3, MakeShopCounter, 1.0f, 1.15f, 1.35f, 1800}},
          {{"display_table", "furniture/table", 3, MakeDisplayTable, 0.85f, 0.85f, 1.1f, 20000}},
          {{"shopping_cart", "furniture/misc", 2, MakeShoppingCart, 0.5f, 0.95f, 1.10f, 5000}}};
}

}  // namespace airsim360::internal
