// Things that lie about in a home.
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

Model MakeVase(uint32_t variant, uint64_t seed) {
  PropBuilder b("vase");
  RngStream rng(seed, "vase");
  const Vec3f glaze[3] = {{0.10f, 0.20f, 0.30f}, {0.66f, 0.63f, 0.56f}, {0.36f, 0.14f, 0.07f}};
  UseCeramic(b, glaze[variant]);
  const Vec2f shapes[3][10] = {{{0, 0},
                                {0.055f, 0},
                                {0.085f, 0.05f},
                                {0.095f, 0.11f},
                                {0.075f, 0.17f},
                                {0.038f, 0.21f},
                                {0.046f, 0.235f},
                                {0.040f, 0.235f},
                                {0.030f, 0.205f},
                                {0, 0.18f}},
                               {{0, 0},
                                {0.05f, 0},
                                {0.056f, 0.01f},
                                {0.050f, 0.12f},
                                {0.060f, 0.24f},
                                {0.074f, 0.30f},
                                {0.078f, 0.31f},
                                {0.070f, 0.31f},
                                {0.052f, 0.22f},
                                {0, 0.2f}},
                               {{0, 0},
                                {0.06f, 0},
                                {0.078f, 0.02f},
                                {0.068f, 0.07f},
                                {0.05f, 0.13f},
                                {0.056f, 0.17f},
                                {0.062f, 0.18f},
                                {0.055f, 0.18f},
                                {0.042f, 0.14f},
                                {0, 0.12f}}};
  b.Lathe(shapes[variant], 28);
  if (variant == 1) {  // dry branches
    b.Use(Stone({0.24f, 0.17f, 0.11f}, 0.9f));
    for (int i = 0; i < 7; ++i) {
      const Vec3f d = Around(i, 7, 0.4f * static_cast<float>(i % 3)) * static_cast<float>(rng.Uniform(0.06, 0.20));
      const Vec3f twig[] = {
          {d.x * 0.1f, d.y * 0.1f, 0.22f}, {d.x * 0.5f, d.y * 0.5f, 0.46f}, {d.x, d.y, static_cast<float>(rng.Uniform(0.55, 0.78))}};
      const float radii[] = {0.004f, 0.003f, 0.0015f};
      b.Bar(twig, radii, 5);
    }
  } else if (variant == 2) {  // tulips
    for (int i = 0; i < 8; ++i) {
      const Vec3f d = Around(i, 8) * static_cast<float>(rng.Uniform(0.03, 0.11));
      const float z = static_cast<float>(rng.Uniform(0.30, 0.38));
      b.Use(Leaf({0.12f, 0.24f, 0.07f}, 0.3f));
      const Vec3f stem[] = {{d.x * 0.2f, d.y * 0.2f, 0.14f}, {d.x * 0.6f, d.y * 0.6f, 0.25f}, {d.x, d.y, z}};
      b.Bar(stem, 0.003f, 5);
      BroadLeaf(b, Turn(0, -60, 45.0f * static_cast<float>(i), {d.x * 0.2f, d.y * 0.2f, 0.15f}), 0.17f, 0.03f, 0.2f);
      b.Use(Leaf(i % 3 ? Vec3f{0.62f, 0.10f, 0.09f} : Vec3f{0.66f, 0.42f, 0.06f}, 0.4f));
      const Vec2f cup[] = {{0.006f, 0}, {0.020f, 0.012f}, {0.022f, 0.028f}, {0.014f, 0.046f}, {0, 0.05f}};
      b.Lathe(cup, 8, {d.x, d.y, z});
    }
  }
  return b.Finish();
}

// 25 to 60 cm of books between nothing, bookends and a pile lying.
Model MakeBookRow(uint32_t variant, uint64_t seed) {
  PropBuilder b("book_row");
  const float half = std::array{0.13f, 0.20f, 0.30f, 0.12f}[variant];
  if (variant == 3) {
    RngStream rng(seed, "pile");
    float z = 0;
    for (int i = 0; i < 6; ++i) {
      const float t = static_cast<float>(rng.Uniform(0.014, 0.04)), w = static_cast<float>(rng.Uniform(0.075, 0.10)), d = w * 1.4f;
      const Vec3f cover = Vec3f{static_cast<float>(rng.Uniform(0.05, 0.5)), static_cast<float>(rng.Uniform(0.05, 0.3)),
                                static_cast<float>(rng.Uniform(0.05, 0.3))};
      b.Place(Turn(0, 0, static_cast<float>(rng.Uniform(-12, 12)), {0, 0, z}));
      b.Use(Plastic(cover, 0.5f));
      b.BevelBox({-d, -w, 0}, {d, w, 0.003f}, 0.001f);
      b.BevelBox({-d, -w, t - 0.003f}, {d, w, t}, 0.001f);
      b.BevelBox({-d, -w, 0}, {-d + 0.003f, w, t}, 0.001f);
      b.Use(Stone({0.66f, 0.62f, 0.52f}, 0.9f));
      b.mesh().Box({-d + 0.003f, -w + 0.004f, 0.003f}, {d - 0.004f, w - 0.004f, t - 0.003f});
      z += t + 0.0005f;
    }
    b.Place({});
    return b.Finish();
  }
  BooksOnShelf(b, -half, half, -0.085f, 0, 0.30f, seed);
  if (variant == 2) {
    b.Use(Paint({0.03f, 0.03f, 0.03f}));
    for (float s : {-1.0f, 1.0f}) {
      b.BevelBox({s * (half + 0.004f) - 0.0015f, -0.06f, 0}, {s * (half + 0.004f) + 0.0015f, 0.06f, 0.15f}, 0.001f);
      b.BevelBox({s > 0 ? half - 0.09f : -half - 0.005f, -0.06f, 0}, {s > 0 ? half + 0.005f : -half + 0.09f, 0.06f, 0.002f}, 0.0008f);
    }
  }
  return b.Finish();
}

void Shoe(PropBuilder& b, const AffineTransform& X, Vec3f upper, Vec3f sole, float scale, float shaft) {
  b.Place(X);
  b.Use(Plastic(upper, 0.5f));
  // Along Y from heel to toe at -Y.
  b.Sheet(16, 14,
          [&](float u, float v) {
            const float a = 3.14159265f * u, t = v;
            const float wide = 0.036f + 0.014f * std::sin(3.1f * t) - 0.010f * (t > 0.85f ? (t - 0.85f) / 0.15f : 0);
            const float end = std::min({1.0f, 7 * t + 0.12f, 5 * (1 - t) + 0.05f});
            const float high = (t < 0.36f ? shaft : std::max(0.045f, shaft - (t - 0.36f) * 0.30f) - 0.01f * t);
            return Vec3f{wide * end * std::cos(a) * scale, (0.14f - 0.28f * t) * scale,
                         (0.022f + high * std::pow(std::max(0.0f, std::sin(a)), 0.7f) * end) * scale};
          },
          {0.2f, 0.28f});
  b.Use(sole.x > 0.1f ? Plastic(sole, 0.6f) : Rubber());
  std::vector<Vec2f> outline;
  for (int i = 0; i < 24; ++i) {
    const Vec3f d = Around(i, 24);
    outline.push_back({(0.045f + 0.006f * (d.y < 0 ? 1.0f : -1.0f)) * d.x * scale, 0.142f * d.y * scale});
  }
  b.Prism(outline, 0, 0.024f * scale);
  b.Place({});
}

// Pairs beside each other, as by a door.
Model MakeShoes(uint32_t variant, uint64_t) {
  PropBuilder b("shoes");
  const Vec3f uppers[3] = {{0.05f, 0.035f, 0.025f}, {0.62f, 0.61f, 0.58f}, {0.16f, 0.085f, 0.04f}},
              soles[3] = {{0, 0, 0}, {0.70f, 0.69f, 0.66f}, {0, 0, 0}};
  const float shaft[3] = {0.075f, 0.08f, 0.16f};
  Shoe(b, Turn(0, 0, 4, {-0.055f, 0, 0}), uppers[variant], soles[variant], 1, shaft[variant]);
  Shoe(b, Turn(0, 0, -9, {0.06f, variant == 1 ? 0.05f : 0.01f, 0}), uppers[variant], soles[variant], 1, shaft[variant]);
  return b.Finish();
}

// Steel, glass-and-plastic.
Model MakeKettle(uint32_t variant, uint64_t) {
  PropBuilder b("kettle");
  b.Use(Plastic({0.025f, 0.025f, 0.027f}, 0.35f));
  const Vec2f base[] = {{0, 0}, {0.08f, 0}, {0.083f, 0.012f}, {0.075f, 0.02f}, {0, 0.02f}};
  b.Lathe(base, 28);
  const Vec3f grip[] = {{0.058f, 0, 0.215f}, {0.105f, 0, 0.215f}, {0.118f, 0, 0.19f},
                        {0.115f, 0, 0.09f},  {0.10f, 0, 0.065f},  {0.072f, 0, 0.06f}};
  b.Bar(grip, 0.010f, 10);
  const Vec2f knob[] = {{0.012f, 0.225f}, {0.016f, 0.235f}, {0.012f, 0.245f}, {0, 0.246f}};
  b.Lathe(knob, 12);
  variant == 0 ? UseBrushedSteel(b, 0.2f) : UseCeramic(b, {0.70f, 0.66f, 0.56f});
  const Vec2f body[] = {{0.075f, 0.02f}, {0.08f, 0.03f}, {0.072f, 0.12f}, {0.058f, 0.20f}, {0.054f, 0.212f}, {0.03f, 0.224f}, {0, 0.227f}};
  b.Lathe(body, 28);
  const Vec3f spout[] = {{-0.05f, 0, 0.165f}, {-0.075f, 0, 0.195f}, {-0.088f, 0, 0.212f}};
  const float radii[] = {0.022f, 0.015f, 0.010f};
  b.Bar(spout, radii, 10);
  return b.Finish();
}

// On a table: a laid place, breakfast left over, a pile of plates, fruit, bottles and glasses.
Model MakeDishes(uint32_t variant, uint64_t seed) {
  PropBuilder b("dishes");
  RngStream rng(seed, "dishes");
  if (variant == 0) {
    UseCeramic(b);
    Plate(b, {0, 0, 0}, 0.135f);
    Plate(b, {0, 0, 0.007f}, 0.10f);
    b.Use(Metal({0.62f, 0.62f, 0.61f}, 0.15f));
    for (float x : {-0.17f, 0.17f, 0.195f}) {
      b.BevelBox({x - 0.004f, -0.10f, 0}, {x + 0.004f, 0.04f, 0.003f}, 0.001f);
      b.BevelBox({x - 0.010f, 0.04f, 0}, {x + 0.010f, 0.10f, 0.0035f}, 0.0015f);
    }
    b.Use(ClearGlass());
    const Vec2f glass[] = {{0, 0.001f}, {0.030f, 0.001f}, {0.032f, 0.006f}, {0.036f, 0.11f}};
    b.Lathe(glass, 18, {0.13f, 0.15f, 0});
  } else if (variant == 1) {
    UseCeramic(b, {0.24f, 0.33f, 0.36f});
    Plate(b, {0, 0, 0}, 0.11f);
    Cup(b, {0.19f, 0.06f, 0}, 0.042f, 0.095f);
    Bowl(b, {-0.19f, 0.05f, 0}, 0.075f, 0.06f);
    b.Use(Stone({0.42f, 0.24f, 0.09f}, 0.9f));
    b.mesh().Sphere({-0.01f, 0.01f, 0.028f}, {0.055f, 0.04f, 0.025f}, 8, 14);
    b.mesh().Sphere({0.05f, -0.03f, 0.018f}, {0.022f, 0.018f, 0.012f}, 6, 10);
  } else if (variant == 2) {
    UseCeramic(b);
    for (int i = 0; i < 5; ++i) Plate(b, {0, 0, 0.0115f * static_cast<float>(i)}, 0.125f);
    for (int i = 0; i < 3; ++i) Bowl(b, {0.22f, 0, 0.02f * static_cast<float>(i)}, 0.075f, 0.06f);
    UseCeramic(b, {0.46f, 0.13f, 0.07f});
    Cup(b, {-0.19f, 0.03f, 0}, 0.04f, 0.095f);
    Cup(b, {-0.16f, -0.11f, 0}, 0.04f, 0.095f);
  } else {
    UseTimber(b, Timber::kOak);
    Bowl(b, {}, 0.15f, 0.085f);
    const Vec3f fruit[3] = {{0.50f, 0.05f, 0.03f}, {0.62f, 0.30f, 0.03f}, {0.36f, 0.44f, 0.06f}};
    for (int i = 0; i < 7; ++i) {
      b.Use(Plastic(fruit[i % 3], 0.35f));
      const Vec3f d = i == 6 ? Vec3f{0, 0, 0.06f} : Around(i, 6) * 0.078f;
      b.mesh().Sphere(d + Vec3f{0, 0, 0.068f}, {0.038f, 0.038f, 0.036f}, 8, 14);
    }
    b.Use(Plastic({0.02f, 0.05f, 0.02f}, 0.1f));
    Bottle(b, {0.26f, 0.05f, 0}, 0.037f, 0.31f);
  }
  return b.Finish();
}

void WashingInABasket(PropBuilder& b, RngStream& rng, uint64_t seed) {
  b.Use(Plastic({0.62f, 0.61f, 0.58f}, 0.4f));
  const auto ring = RoundedRectangle({-0.27f, -0.18f}, {0.27f, 0.18f}, 0.08f, 5);
  std::vector<Vec2f> inner;
  for (Vec2f p : ring) inner.push_back(p * 0.96f);
  b.mesh().Walls(ring, 0, 0.24f);
  b.mesh().Polygon(ring, 0, false);
  std::vector<Vec2f> inward(inner.rbegin(), inner.rend());
  b.mesh().Walls(inward, 0.01f, 0.24f);
  std::vector<Vec3f> rim;
  for (Vec2f p : ring) rim.push_back({p.x, p.y, 0.24f});
  rim.push_back(rim.front());
  b.Bar(rim, 0.010f, 6);
  const Vec3f tones[4] = {{0.66f, 0.65f, 0.62f}, {0.10f, 0.16f, 0.28f}, {0.42f, 0.14f, 0.12f}, {0.30f, 0.34f, 0.30f}};
  for (int i = 0; i < 7; ++i) {
    UseLinen(b, tones[i % 4]);
    const float x = static_cast<float>(rng.Uniform(-0.11, 0.11)), y = static_cast<float>(rng.Uniform(-0.03, 0.03)),
                z = 0.15f + 0.02f * static_cast<float>(i);
    Pillow(b,
           Turn(static_cast<float>(rng.Uniform(-25, 25)), static_cast<float>(rng.Uniform(-25, 25)), static_cast<float>(rng.Uniform(0, 180)),
                {x, y, z}),
           {0.22f, 0.18f}, 0.13f, seed + static_cast<uint64_t>(i), 8);
  }
}

// What gathers on desks, sills and floors: keys and letters, toys, a bag, cushions, a basket of washing.
Model MakeClutter(uint32_t variant, uint64_t seed) {
  PropBuilder b("clutter");
  RngStream rng(seed, "clutter");
  if (variant == 0) {  // a bowl of keys and letters
    UseCeramic(b, {0.10f, 0.16f, 0.15f});
    Bowl(b, {-0.10f, 0, 0}, 0.08f, 0.04f);
    b.Use(Metal({0.55f, 0.48f, 0.30f}, 0.3f));
    for (int i = 0; i < 4; ++i)
      b.mesh().Beam({-0.12f + 0.015f * static_cast<float>(i), -0.02f, 0.018f}, {-0.10f + 0.012f * static_cast<float>(i), 0.03f, 0.026f},
                    0.005f);
    for (int i = 0; i < 4; ++i) {
      b.Place(Turn(0, 0, static_cast<float>(rng.Uniform(-25, 25)), {0.10f, 0, 0.0012f * static_cast<float>(i)}));
      b.Use(Stone(i % 2 ? Vec3f{0.72f, 0.71f, 0.68f} : Vec3f{0.52f, 0.44f, 0.30f}, 0.9f));
      b.BevelBox({-0.11f, -0.055f, 0}, {0.11f, 0.055f, 0.001f}, 0.0003f);
    }
    b.Place({});
  } else if (variant == 1) {  // building blocks and a ball
    const Vec3f tones[4] = {{0.55f, 0.06f, 0.04f}, {0.06f, 0.16f, 0.45f}, {0.62f, 0.45f, 0.05f}, {0.08f, 0.32f, 0.10f}};
    for (int i = 0; i < 16; ++i) {
      b.Use(Plastic(tones[rng.Index(4)], 0.3f));
      const float w = rng.Chance(0.5) ? 0.02f : 0.035f;
      b.Place(Turn(0, 0, static_cast<float>(rng.Uniform(0, 180)),
                   {static_cast<float>(rng.Uniform(-0.28, 0.28)), static_cast<float>(rng.Uniform(-0.22, 0.22)), 0}));
      b.BevelBox({-w, -0.02f, 0}, {w, 0.02f, 0.04f}, 0.003f);
    }
    b.Place({});
    b.Use(Plastic({0.50f, 0.20f, 0.04f}, 0.5f));
    b.mesh().Sphere({0.16f, 0.14f, 0.11f}, {0.11f, 0.11f, 0.11f}, 14, 22);
  } else if (variant == 2) {  // a rucksack leaning on itself
    UseWeave(b, {0.07f, 0.10f, 0.14f});
    SoftBox(b, {-0.15f, -0.09f, 0}, {0.15f, 0.09f, 0.43f}, {.round = 0.08f, .crown = 0.02f, .fold = 0.012f, .seed = seed, .cells = 10});
    SoftBox(b, {-0.12f, -0.155f, 0.02f}, {0.12f, -0.07f, 0.21f},
            {.round = 0.04f, .crown = 0.015f, .fold = 0.008f, .seed = seed + 2, .cells = 8});
    UseWeave(b, {0.03f, 0.03f, 0.033f});
    for (float s : {-1.0f, 1.0f}) {
      const Vec3f strap[] = {{s * 0.07f, 0.085f, 0.40f}, {s * 0.10f, 0.14f, 0.30f}, {s * 0.11f, 0.13f, 0.15f}, {s * 0.10f, 0.09f, 0.06f}};
      b.Bar(strap, 0.012f, 6);
    }
    const Vec3f loop[] = {{-0.03f, 0.06f, 0.425f}, {-0.02f, 0.06f, 0.465f}, {0.02f, 0.06f, 0.465f}, {0.03f, 0.06f, 0.425f}};
    b.Bar(loop, 0.006f, 6);
  } else {
    WashingInABasket(b, rng, seed);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows SmallThingRows() {
  return {{{"vase", "furniture/vase", 3, MakeVase, 0.12f, 0.15f, 0.85f, 2500}, Mount::kSurface},
          {{"book_row", "furniture/book", 4, MakeBookRow, 0.3f, 0.08f, 0.32f, 1500}, Mount::kSurface},
          {{"shoes", "furniture/clothes", 3, MakeShoes, 0.2f, 0.06f, 0.25f, 2500}},
          {{"kettle", "furniture/kitchen", 2, MakeKettle, 0.12f, 0.22f, 0.28f, 2000}, Mount::kSurface},
          {{"dishes", "furniture/kitchen/tableware", 4, MakeDishes, 0.3f, 0.02f, 0.35f, 6000}, Mount::kSurface},
          {{"clutter", "furniture/misc", 4, MakeClutter, 0.35f, 0.02f, 0.50f, 4500}}};
}

}  // namespace airsim360::internal
