// Tables and chairs of homes. Table tops 72 to 76 cm, seats 45 (EN 1729 size 6, EN 12520); low tables 38 to 45.
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

void Magazines(PropBuilder& b, Vec3f p, int count, uint64_t seed) {
  RngStream rng(seed, "magazines");
  for (int i = 0; i < count; ++i) {
    b.Place(Turn(0, 0, static_cast<float>(rng.Uniform(-14, 14)), p + Vec3f{0, 0, 0.006f * static_cast<float>(i)}));
    const float ink = static_cast<float>(rng.Uniform(0.06, 0.5)), tone = static_cast<float>(rng.Uniform(0.6, 1.3));
    b.Use(Paint({ink, ink * tone, ink * std::sqrt(tone)}, 0.3f));
    b.BevelBox({-0.105f, -0.148f, 0}, {0.105f, 0.148f, 0.0055f}, 0.001f);
  }
  b.Place({});
}

// Glass on steel, a round of oak on three legs, a walnut slab with a shelf, a stone drum.
Model MakeCoffeeTable(uint32_t variant, uint64_t seed) {
  PropBuilder b("coffee_table");
  const float top = std::array{0.42f, 0.40f, 0.43f, 0.36f}[variant];
  if (variant == 0) {
    UseTimber(b, Timber::kOak, Grain::kAlongX);
    RoundedBoard(b, {-0.55f, -0.30f}, {0.55f, 0.30f}, 0.03f, top - 0.03f, top, 0.008f);
    b.BevelBox({-0.50f, -0.25f, 0.13f}, {0.50f, 0.25f, 0.148f}, 0.004f);
    UseTimber(b, Timber::kOak);
    for (float x : {-0.48f, 0.48f})
      for (float y : {-0.235f, 0.235f}) b.BevelBox({x - 0.022f, y - 0.022f, 0}, {x + 0.022f, y + 0.022f, top - 0.03f}, 0.004f);
    Magazines(b, {-0.25f, 0.02f, 0.148f}, 4, seed);
  } else if (variant == 1) {
    UseTimber(b, Timber::kBeech);
    RoundBoard(b, 0.40f, top - 0.028f, top, 0.008f);
    for (int i = 0; i < 3; ++i) {
      const Vec3f d = Around(i, 3, 0.5f);
      b.mesh().Tube(d * 0.34f, d * 0.24f + Vec3f{0, 0, top - 0.026f}, 0.012f, 0.021f, 14);
    }
  } else if (variant == 2) {
    b.Use(ClearGlass({0.90f, 0.97f, 0.94f}));
    b.BevelBox({-0.60f, -0.35f, top - 0.010f}, {0.60f, 0.35f, top}, 0.002f);
    b.Use(Chrome());
    for (float x : {-0.56f, 0.56f}) {
      const Vec3f hoop[] = {{x, -0.31f, top - 0.012f}, {x, -0.31f, 0.02f}, {x, -0.29f, 0.012f},
                            {x, 0.29f, 0.012f},        {x, 0.31f, 0.02f},  {x, 0.31f, top - 0.012f}};
      b.Bar(hoop, 0.011f, 10);
    }
    for (float y : {-0.31f, 0.31f}) b.mesh().Tube({-0.56f, y, 0.20f}, {0.56f, y, 0.20f}, 0.009f, 0.009f, 10);
  } else {
    UseStoneTop(b, {0.52f, 0.50f, 0.47f});
    const Vec2f drum[] = {{0.28f, 0},    {0.30f, 0.02f}, {0.26f, 0.18f}, {0.27f, top - 0.05f}, {0.345f, top - 0.03f}, {0.35f, top - 0.006f},
                          {0.344f, top}, {0, top}};
    b.Lathe(drum, 40);
  }
  if (variant != 3) Magazines(b, {0.16f, -0.06f, top}, 2, seed + 1);
  UseCeramic(b, {0.20f, 0.26f, 0.28f});
  Bowl(b, {-0.13f, 0.10f, top}, 0.12f, 0.07f);
  return b.Finish();
}

struct TableLook {
  float length, width;
  Timber timber;
  int base;  // 0 four legs and an apron, 1 steel trestles, 2 round pedestal, 3 white with tapered legs
};

Model MakeDiningTableHome(uint32_t variant, uint64_t) {
  PropBuilder b("dining_table_home");
  const TableLook look = std::array<TableLook, 4>{{{1.60f, 0.90f, Timber::kOak, 0},
                                                   {1.80f, 0.90f, Timber::kWalnut, 1},
                                                   {1.15f, 1.15f, Timber::kBeech, 2},
                                                   {1.20f, 0.75f, Timber::kPine, 3}}}[variant];
  const float x = look.length / 2, y = look.width / 2, top = 0.745f;
  if (look.base == 2) {
    UseTimber(b, look.timber);
    RoundBoard(b, x, top - 0.032f, top, 0.012f);
    const Vec2f column[] = {{0.29f, 0},      {0.30f, 0.012f}, {0.27f, 0.03f}, {0.10f, 0.075f},
                            {0.055f, 0.17f}, {0.05f, 0.45f},  {0.08f, 0.62f}, {0.20f, top - 0.034f}};
    UseLacquer(b, {0.72f, 0.71f, 0.68f}, 0.25f);
    b.Lathe(column, 40);
    return b.Finish();
  }
  look.base == 3 ? UseLacquer(b, {0.73f, 0.72f, 0.69f}) : UseTimber(b, look.timber, Grain::kAlongX);
  RoundedBoard(b, {-x, -y}, {x, y}, look.base == 1 ? 0.015f : 0.03f, top - 0.03f, top, 0.007f);
  if (look.base == 1) {
    b.Use(Paint({0.03f, 0.031f, 0.034f}, 0.4f));
    for (float s : {-1.0f, 1.0f}) {
      const float px = s * (x - 0.22f);
      for (float e : {-1.0f, 1.0f}) b.mesh().Beam({px, e * (y - 0.05f), 0}, {px, e * (y - 0.20f), top - 0.035f}, 0.05f);
      b.mesh().Beam({px, -y + 0.04f, 0.0251f}, {px, y - 0.04f, 0.0251f}, 0.05f);
      b.mesh().Beam({px, -y + 0.12f, top - 0.0551f}, {px, y - 0.12f, top - 0.0551f}, 0.05f);
    }
    return b.Finish();
  }
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({-x + 0.10f, s * (y - 0.075f) - 0.011f, top - 0.12f}, {x - 0.10f, s * (y - 0.075f) + 0.011f, top - 0.03f}, 0.003f);
    b.BevelBox({s * (x - 0.095f) - 0.011f, -y + 0.08f, top - 0.12f}, {s * (x - 0.095f) + 0.011f, y - 0.08f, top - 0.03f}, 0.003f);
  }
  UseTimber(b, look.timber);
  for (float px : {-x + 0.09f, x - 0.09f})
    for (float py : {-y + 0.075f, y - 0.075f}) {
      if (look.base == 0)
        b.BevelBox({px - 0.035f, py - 0.035f, 0}, {px + 0.035f, py + 0.035f, top - 0.03f}, 0.006f);
      else
        b.mesh().Tube({px * 1.05f, py * 1.07f, 0}, {px, py, top - 0.03f}, 0.014f, 0.030f, 14);
    }
  return b.Finish();
}

// Wooden chair: tapered legs, a moulded seat, a bent back rest.
void WoodChair(PropBuilder& b, Timber timber, bool padded, Vec3f cloth, uint64_t seed) {
  UseTimber(b, timber);
  for (float s : {-1.0f, 1.0f}) {
    b.mesh().Tube({s * 0.215f, -0.235f, 0}, {s * 0.185f, -0.19f, 0.435f}, 0.012f, 0.018f, 12);
    const Vec3f rear[] = {{s * 0.20f, 0.27f, 0},
                          {s * 0.175f, 0.21f, 0.25f},
                          {s * 0.170f, 0.20f, 0.45f},
                          {s * 0.172f, 0.24f, 0.66f},
                          {s * 0.175f, 0.285f, 0.82f}};
    const float radii[] = {0.012f, 0.017f, 0.018f, 0.016f, 0.011f};
    b.Bar(rear, radii, 12);
    b.mesh().Tube({s * 0.195f, -0.20f, 0.26f}, {s * 0.183f, 0.225f, 0.26f}, 0.009f, 0.009f, 8);
  }
  b.mesh().Tube({-0.19f, -0.19f, 0.415f}, {0.19f, -0.19f, 0.415f}, 0.016f, 0.016f, 10);
  b.mesh().Tube({-0.17f, 0.20f, 0.415f}, {0.17f, 0.20f, 0.415f}, 0.016f, 0.016f, 10);
  UseTimber(b, timber, Grain::kAlongX);
  const auto rest = [](float z0, float z1, float y, float lean) {
    return [=](float u, float v) {
      const float x = 0.20f * (2 * u - 1);
      return Vec3f{x, y + lean * v + 0.045f * (1 - (2 * u - 1) * (2 * u - 1)),
                   z0 + (z1 - z0) * v + 0.012f * (1 - (2 * u - 1) * (2 * u - 1)) * v};
    };
  };
  for (float side : {0.0f, 0.016f}) {
    const auto front = rest(0.70f, 0.84f, 0.245f, 0.035f);
    if (side == 0)
      b.Sheet(12, 3, front, {0.4f, 0.14f});
    else
      b.Sheet(12, 3, [&](float u, float v) { return front(1 - u, v) + Vec3f{0, side, -0.003f}; }, {0.4f, 0.14f});
  }
  for (const bool top : {true, false})
    b.Sheet(12, 1,
            [&](float u, float v) {
              const auto edge = rest(0.70f, 0.84f, 0.245f, 0.035f);
              return top ? edge(u, 1) + Vec3f{0, 0.016f * v, -0.003f * v} : edge(1 - u, 0) + Vec3f{0, 0.016f * v, -0.003f * v};
            },
            {0.4f, 0.016f});
  if (padded) {
    UseWeave(b, cloth);
    SoftBox(b, {-0.22f, -0.225f, 0.425f}, {0.22f, 0.205f, 0.475f},
            {.round = 0.022f, .crown = 0.012f, .fold = 0.001f, .seed = seed, .cells = 8});
  } else {
    RoundedBoard(b, {-0.215f, -0.225f}, {0.215f, 0.215f}, 0.06f, 0.428f, 0.455f, 0.010f);
  }
}

// Shell of moulded plastic on wooden dowel legs or a steel frame.
void ShellChair(PropBuilder& b, Vec3f color, bool wood) {
  wood ? UseTimber(b, Timber::kBeech) : b.Use(Chrome());
  for (float sx : {-1.0f, 1.0f})
    for (float sy : {-1.0f, 1.0f})
      b.mesh().Tube({sx * 0.235f, sy * 0.225f, 0}, {sx * 0.12f, sy * 0.12f, 0.415f}, 0.010f, wood ? 0.017f : 0.010f, 12);
  b.Use(Paint({0.03f, 0.03f, 0.03f}));
  for (float s : {-1.0f, 1.0f}) {
    b.mesh().Tube({-0.16f, s * 0.15f, 0.30f}, {0.16f, s * 0.15f, 0.30f}, 0.004f, 0.004f, 6);
    b.mesh().Tube({s * 0.16f, -0.15f, 0.30f}, {s * 0.16f, 0.15f, 0.30f}, 0.004f, 0.004f, 6);
    b.mesh().Tube({-0.14f, s * 0.125f, 0.405f}, {0.14f, s * 0.125f, 0.405f}, 0.007f, 0.007f, 6);
  }
  b.Use(Plastic(color, 0.38f));
  // Profile in YZ from the front lip over the seat to the top of the back, dished across.
  constexpr std::array<Vec2f, 8> line = {{{-0.245f, 0.425f},
                                          {-0.20f, 0.452f},
                                          {-0.05f, 0.440f},
                                          {0.10f, 0.430f},
                                          {0.175f, 0.465f},
                                          {0.205f, 0.56f},
                                          {0.235f, 0.70f},
                                          {0.265f, 0.83f}}};
  const auto at = [&](float u, float v, float back) {
    const float s = v * 7, x = 2 * u - 1;
    const int i = std::min(6, static_cast<int>(s));
    const float t = s - static_cast<float>(i), e = t * t * (3 - 2 * t);
    const Vec2f p =
        line[static_cast<size_t>(i)] + (line[static_cast<size_t>(i) + 1] - line[static_cast<size_t>(i)]) * (0.5f * t + 0.5f * e);
    const float dish = x * x * (v < 0.5f ? 0.035f : 0.015f), wide = 0.235f - 0.03f * std::max(0.0f, v - 0.55f) / 0.45f - 0.03f * v * v;
    const float wing = v > 0.5f ? 0.055f * x * x : 0.0f;
    return Vec3f{wide * x, p.x - wing + back * (v > 0.55f ? 1.0f : 0.2f), p.y + dish - back * (v > 0.55f ? 0.2f : 1.0f)};
  };
  b.Sheet(12, 21, [&](float u, float v) { return at(u, v, 0); }, {0.47f, 0.8f});
  b.Sheet(12, 21, [&](float u, float v) { return at(1 - u, v, 0.007f); }, {0.47f, 0.8f});
  // The rim between the two.
  for (const bool right : {false, true})
    b.Sheet(21, 1, [&](float u, float v) { return at(right ? 1.0f : 0.0f, right ? u : 1 - u, 0.007f * (1 - v)); }, {0.8f, 0.007f});
  b.Sheet(12, 1, [&](float u, float v) { return at(u, 1, 0.007f * v); }, {0.47f, 0.007f});
  b.Sheet(12, 1, [&](float u, float v) { return at(1 - u, 0, 0.007f * v); }, {0.47f, 0.007f});
}

Model MakeDiningChairHome(uint32_t variant, uint64_t seed) {
  PropBuilder b("dining_chair_home");
  if (variant == 0) WoodChair(b, Timber::kOak, false, {}, seed);
  if (variant == 1) WoodChair(b, Timber::kWalnut, true, {0.30f, 0.28f, 0.25f}, seed);
  if (variant == 2) ShellChair(b, {0.70f, 0.70f, 0.68f}, true);
  if (variant == 3) ShellChair(b, {0.035f, 0.05f, 0.055f}, false);
  return b.Finish();
}

}  // namespace

FurnishingRows TableRows() {
  return {{{"coffee_table", "furniture/table/coffee_table", 4, MakeCoffeeTable, 0.7f, 0.38f, 0.55f, 3000}},
          {{"dining_table_home", "furniture/table/dining_table", 4, MakeDiningTableHome, 1.05f, 0.72f, 0.78f, 3000}},
          {{"dining_chair_home", "furniture/seating/chair", 4, MakeDiningChairHome, 0.36f, 0.78f, 0.95f, 4000}}};
}

}  // namespace airsim360::internal
