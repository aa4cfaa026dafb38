// Small things of New York's pavements and road works.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// Box on a pedestal with a window that shows the front page.
Model MakeNewspaperBox(uint32_t variant, uint64_t) {
  PropBuilder b("newspaper_box");
  constexpr Vec3f kTones[4] = {{0.30f, 0.045f, 0.040f}, {0.045f, 0.075f, 0.19f}, {0.46f, 0.31f, 0.09f}, {0.05f, 0.14f, 0.08f}};
  constexpr const char* kTitles[4] = {"THE DAILY", "CITY POST", "VOICE", "METRO"};
  b.Use(Paint(kTones[variant], 0.4f), ScratchedTexture());
  b.BevelBox({-0.24f, -0.20f, 0.42f}, {0.24f, 0.20f, 1.10f}, 0.03f);
  b.BevelBox({-0.10f, -0.10f, 0.03f}, {0.10f, 0.10f, 0.43f}, 0.01f);
  b.BevelBox({-0.22f, -0.18f, 0}, {0.22f, 0.18f, 0.04f}, 0.01f);
  b.BevelBox({-0.13f, -0.16f, 1.09f}, {0.13f, 0.02f, 1.24f}, 0.02f);
  Canvas page(128, 112, {0.62f, 0.61f, 0.56f});
  page.Rectangle({0, 0}, {1, 0.24f}, kTones[variant] * 0.8f);
  page.Letters(kTitles[variant], {0.5f, 0.12f}, 0.12f, {0.8f, 0.8f, 0.76f});
  page.Rectangle({0.06f, 0.30f}, {0.60f, 0.68f}, {0.18f, 0.20f, 0.22f});
  for (int i = 0; i < 9; ++i) {
    const float y = 0.32f + 0.07f * static_cast<float>(i);
    page.Line({i < 6 ? 0.66f : 0.06f, y}, {0.94f, y}, 0.025f, {0.22f, 0.22f, 0.21f});
  }
  b.Use(Plastic({1, 1, 1}, 0.2f), page.Finish(std::string("news ") + kTitles[variant]));
  b.Picture({-0.20f, -0.203f, 0.64f}, {0.20f, -0.203f, 0.64f}, {0.20f, -0.203f, 1.00f}, {-0.20f, -0.203f, 1.00f});
  b.Use(Metal());
  b.BevelBox({-0.12f, -0.23f, 0.55f}, {0.12f, -0.20f, 0.58f}, 0.006f);
  return b.Finish();
}

// Jersey barrier, 2.4 m along X.
Model MakeConcreteBlock(uint32_t variant, uint64_t) {
  PropBuilder b("concrete_block");
  b.Use(Stone(variant ? Vec3f{0.36f, 0.35f, 0.33f} : Vec3f{0.44f, 0.43f, 0.40f}), ConcreteTexture());
  const std::vector<Vec2f> side = {{-0.30f, 0},    {0.30f, 0},      {0.30f, 0.08f},  {0.15f, 0.33f},
                                   {0.09f, 0.81f}, {-0.09f, 0.81f}, {-0.15f, 0.33f}, {-0.30f, 0.08f}};
  b.Place(AffineTransform{Mat3f::FromColumns({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {}});
  b.Prism(side, -1.2f, 1.2f);
  b.Place({});
  if (variant == 2) {
    Canvas stripes(256, 48, {0.75f, 0.42f, 0.02f});
    for (int i = -1; i < 9; ++i) {
      const float x = 0.125f * static_cast<float>(i);
      stripes.Line({x, 1.2f}, {x + 0.14f, -0.2f}, 0.3f, {0.72f, 0.72f, 0.70f});
    }
    b.Use(Paint({1, 1, 1}, 0.6f), stripes.Finish("barrier stripes"));
    b.Picture({-1.1f, -0.135f, 0.50f}, {1.1f, -0.135f, 0.50f}, {1.1f, -0.115f, 0.68f}, {-1.1f, -0.115f, 0.68f});
    b.Picture({1.1f, 0.135f, 0.50f}, {-1.1f, 0.135f, 0.50f}, {-1.1f, 0.115f, 0.68f}, {1.1f, 0.115f, 0.68f});
  }
  return b.Finish();
}

Model MakeCone(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_cone");
  const float h = variant ? 0.92f : 0.72f;
  b.Use(Rubber());
  b.BevelBox({-0.19f, -0.19f, 0}, {0.19f, 0.19f, 0.035f}, 0.012f);
  const auto ring = [&](float from, float to, Vec3f color) {
    b.Use(Plastic(color, 0.5f));
    const auto r = [&](float t) { return 0.145f - 0.115f * t; };
    b.mesh().Tube({0, 0, 0.035f + (h - 0.035f) * from}, {0, 0, 0.035f + (h - 0.035f) * to}, r(from), r(to), 20, false, to > 0.99f);
  };
  const Vec3f orange{0.80f, 0.16f, 0.015f}, white{0.74f, 0.74f, 0.72f};
  ring(0, 0.45f, orange);
  ring(0.45f, 0.62f, white);
  ring(0.62f, 0.74f, orange);
  ring(0.74f, 0.86f, white);
  ring(0.86f, 1, orange);
  return b.Finish();
}

// Two metres along X of iron pickets with spear heads, or of a chain-link panel on a frame.
Model MakeMetalFence(uint32_t variant, uint64_t) {
  PropBuilder b("metal_fence");
  if (variant == 0) {
    b.Use(Paint({0.018f, 0.019f, 0.020f}, 0.45f));
    for (float z : {0.14f, 0.92f}) b.BevelBox({-1, -0.018f, z}, {1, 0.018f, z + 0.035f}, 0.003f);
    for (int i = 0; i < 16; ++i) {
      const float x = -0.9375f + 0.125f * static_cast<float>(i);
      b.mesh().Tube({x, 0, 0.04f}, {x, 0, 1.06f}, 0.010f, 0.010f, 6, false, false);
      b.mesh().Tube({x, 0, 1.06f}, {x, 0, 1.17f}, 0.022f, 0.0f, 6, true, false);
    }
    b.BevelBox({-1.02f, -0.03f, 0}, {-0.96f, 0.03f, 1.22f}, 0.006f);
  } else {
    b.Use(Metal({0.46f, 0.47f, 0.47f}, 0.45f));
    for (float z : {0.08f, 1.82f}) b.mesh().Tube({-1, 0, z}, {1, 0, z}, 0.02f, 0.02f, 8);
    for (float x : {-0.98f, 0.98f}) b.mesh().Tube({x, 0, 0}, {x, 0, 1.85f}, 0.024f, 0.024f, 8);
    // Diamonds of wire, 16 cm wide: coarser than real mesh, as thin.
    for (int i = -11; i < 12; ++i) {
      for (float way : {-1.0f, 1.0f}) {
        const float x0 = 0.16f * static_cast<float>(i), x1 = x0 + way * 1.72f;
        const auto clip = [&](float x) { return std::clamp(x, -0.97f, 0.97f); };
        const float t0 = (clip(x0) - x0) / (x1 - x0), t1 = (clip(x1) - x0) / (x1 - x0);
        if (t1 - t0 < 0.02f) continue;
        b.mesh().Beam({x0 + (x1 - x0) * t0, 0, 0.09f + 1.72f * t0}, {x0 + (x1 - x0) * t1, 0, 0.09f + 1.72f * t1}, 0.006f);
      }
    }
  }
  return b.Finish();
}

// Steel bollard with a reflective band.
Model MakeRoadColumn(uint32_t variant, uint64_t) {
  PropBuilder b("road_column");
  const Vec3f tone = variant ? Vec3f{0.62f, 0.36f, 0.01f} : Vec3f{0.30f, 0.31f, 0.32f};
  b.Use(variant ? Paint(tone, 0.45f) : Metal(tone, 0.4f));
  const Vec2f post[] = {{0.105f, -0.1f}, {0.105f, 0.92f}, {0.09f, 0.98f}, {0.05f, 1.01f}, {0, 1.015f}};
  b.Lathe(post, 20);
  b.Use(Paint(variant ? Vec3f{0.02f, 0.02f, 0.02f} : Vec3f{0.7f, 0.7f, 0.68f}, 0.3f));
  b.mesh().Tube({0, 0, 0.72f}, {0, 0, 0.84f}, 0.107f, 0.107f, 20, false, false);
  return b.Finish();
}

// One bay of a sidewalk shed: 2.4 m along X, 3 m deep, planked roof with a green parapet to the street (-Y).
Model MakeScaffold(uint32_t variant, uint64_t) {
  PropBuilder b("scaffold");
  b.Use(Metal({0.40f, 0.39f, 0.37f}, 0.5f), ScratchedTexture());
  for (float x : {-1.15f, 1.15f}) {
    for (float y : {-1.4f, 1.4f}) {
      b.mesh().Tube({x, y, 0}, {x, y, 3.0f}, 0.04f, 0.04f, 8);
      b.BevelBox({x - 0.11f, y - 0.11f, 0}, {x + 0.11f, y + 0.11f, 0.03f}, 0.005f);
    }
    b.mesh().Beam({x, -1.4f, 2.9f}, {x, 1.4f, 2.9f}, 0.10f);
    b.mesh().Beam({x, -1.4f, 2.1f}, {x, -0.7f, 2.88f}, 0.035f);
  }
  for (float y : {-1.4f, 1.4f}) b.mesh().Beam({-1.2f, y, 2.95f}, {1.2f, y, 2.95f}, 0.12f);
  b.mesh().Beam({-1.15f, 1.4f, 0.3f}, {1.15f, 1.4f, 2.8f}, 0.035f);
  b.mesh().Beam({1.15f, 1.4f, 0.3f}, {-1.15f, 1.4f, 2.8f}, 0.035f);
  UseWood(b, {0.75f, 0.66f, 0.55f}, Grain::kAlongX);
  for (int i = 0; i < 10; ++i) {
    const float y = -1.5f + 0.3f * static_cast<float>(i);
    b.mesh().Box({-1.2f, y, 3.02f}, {1.2f, y + 0.29f, 3.08f});
  }
  b.Use(Paint(variant ? Vec3f{0.03f, 0.09f, 0.25f} : Vec3f{0.02f, 0.115f, 0.06f}, 0.7f), ScratchedTexture());
  b.mesh().Box({-1.2f, -1.56f, 2.98f}, {1.2f, -1.50f, 4.05f});
  b.Use(Glow({0.9f, 0.88f, 0.8f}, 2500));
  b.BevelBox({-0.5f, -0.05f, 2.92f}, {0.5f, 0.05f, 2.97f}, 0.01f);
  return b.Finish();
}

// Stone column with base and capital.
Model MakePillar(uint32_t variant, uint64_t) {
  PropBuilder b("pillar");
  b.Use(Stone(variant ? Vec3f{0.42f, 0.38f, 0.31f} : Vec3f{0.55f, 0.53f, 0.48f}, 0.7f), ConcreteTexture());
  b.BevelBox({-0.42f, -0.42f, 0}, {0.42f, 0.42f, 0.22f}, 0.02f);
  const Vec2f shaft[] = {{0.40f, 0.22f}, {0.40f, 0.32f}, {0.34f, 0.40f}, {0.31f, 0.46f}, {0.30f, 2.0f},
                         {0.26f, 3.7f},  {0.29f, 3.74f}, {0.27f, 3.80f}, {0.36f, 3.95f}, {0.36f, 4.0f}};
  b.Lathe(shaft, 28);
  b.BevelBox({-0.42f, -0.42f, 4.0f}, {0.42f, 0.42f, 4.16f}, 0.02f);
  return b.Finish();
}

// Steel cart with a blue and yellow umbrella.
Model MakeHotdogCart(uint32_t variant, uint64_t) {
  PropBuilder b("hotdog_cart");
  b.Use(Metal({0.60f, 0.60f, 0.59f}, 0.3f), ScratchedTexture());
  b.BevelBox({-0.95f, -0.42f, 0.42f}, {0.95f, 0.42f, 1.12f}, 0.02f);
  b.BevelBox({-1.05f, -0.52f, 1.10f}, {1.05f, 0.50f, 1.15f}, 0.01f);
  for (float x : {-0.6f, -0.1f, 0.4f}) b.BevelBox({x - 0.2f, -0.2f, 1.15f}, {x + 0.2f, 0.2f, 1.22f}, 0.02f);
  Canvas board(256, 96, variant ? Vec3f{0.045f, 0.085f, 0.22f} : Vec3f{0.46f, 0.31f, 0.09f});
  board.Letters("HOT DOGS", {0.5f, 0.34f}, 0.36f, variant ? Vec3f{0.60f, 0.45f, 0.16f} : Vec3f{0.33f, 0.050f, 0.045f}, 0.85f);
  board.Letters("PRETZEL   COLD DRINKS", {0.5f, 0.78f}, 0.14f, {0.62f, 0.62f, 0.58f});
  const Texture face = board.Finish(variant ? "hot dogs blue" : "hot dogs yellow");
  b.Use(Paint({1, 1, 1}, 0.4f), face);
  b.Picture({-0.88f, -0.424f, 0.48f}, {0.88f, -0.424f, 0.48f}, {0.88f, -0.424f, 1.06f}, {-0.88f, -0.424f, 1.06f});
  b.Picture({0.88f, 0.424f, 0.48f}, {-0.88f, 0.424f, 0.48f}, {-0.88f, 0.424f, 1.06f}, {0.88f, 0.424f, 1.06f});
  b.Use(Rubber());
  for (float x : {-0.7f, 0.7f})
    for (float y : {-0.36f, 0.36f}) b.mesh().Tube({x, y - 0.05f, 0.2f}, {x, y + 0.05f, 0.2f}, 0.2f, 0.2f, 18);
  b.Use(CastIron());
  for (float x : {-0.7f, 0.7f}) b.mesh().Tube({x, 0, 0.2f}, {x, 0, 0.45f}, 0.03f, 0.03f, 6);
  b.Use(Metal());
  b.mesh().Tube({0.55f, 0.2f, 1.1f}, {0.55f, 0.2f, 2.62f}, 0.02f, 0.02f, 8);
  // Eight gores by turns, each with a valance.
  for (int i = 0; i < 8; ++i) {
    b.Use(Fabric(i % 2 ? Vec3f{0.58f, 0.42f, 0.12f} : Vec3f{0.09f, 0.14f, 0.32f}));
    const auto rim = [&](int k, float z) {
      const float a = kTauF * static_cast<float>(k) / 8;
      return Vec3f{0.55f + 1.25f * std::cos(a), 0.2f + 1.25f * std::sin(a), z};
    };
    b.mesh().Triangle(rim(i, 2.2f), rim(i + 1, 2.2f), {0.55f, 0.2f, 2.62f}, {0, 1}, {1, 1}, {0.5f, 0});
    b.mesh().Quad(rim(i, 2.04f), rim(i + 1, 2.04f), rim(i + 1, 2.2f), rim(i, 2.2f));
  }
  return b.Finish();
}

// Water-filled road barrier of blue plastic, 1.5 m along X.
Model MakeBlueBarrier(uint32_t, uint64_t) {
  PropBuilder b("blue_barrier");
  b.Use(Plastic({0.045f, 0.105f, 0.27f}, 0.5f), ScratchedTexture());
  b.BevelBox({-0.75f, -0.22f, 0}, {0.75f, 0.22f, 0.25f}, 0.04f);
  b.BevelBox({-0.73f, -0.14f, 0.24f}, {0.73f, 0.14f, 0.95f}, 0.05f);
  for (float x : {-0.4f, 0.4f}) b.BevelBox({x - 0.2f, -0.17f, 0.40f}, {x + 0.2f, 0.17f, 0.80f}, 0.03f);
  b.Use(Plastic({0.72f, 0.72f, 0.70f}, 0.4f));
  b.BevelBox({-0.7f, -0.147f, 0.83f}, {0.7f, 0.147f, 0.91f}, 0.003f);
  return b.Finish();
}

// Full bags put out for the night, heaped, with a flattened box or two leaning on them.
Model MakeTrashBags(uint32_t variant, uint64_t seed) {
  PropBuilder b("trash_bags");
  RngStream rng(seed, "trash bags", variant);
  const auto uniform = [&](double from, double to) { return static_cast<float>(rng.Uniform(from, to)); };
  const int bags = 2 + static_cast<int>(variant % 3);
  for (int i = 0; i < bags; ++i) {
    b.Use(Plastic(i % 4 == 3 ? Vec3f{0.34f, 0.36f, 0.37f} : Vec3f{0.017f, 0.017f, 0.019f}, 0.34f));
    const float r = uniform(0.24, 0.34), h = uniform(0.42, 0.60), p1 = uniform(0, kTauF), p2 = uniform(0, kTauF);
    const Vec3f foot{0.42f * static_cast<float>(i) - 0.21f * static_cast<float>(bags - 1) + uniform(-0.06, 0.06), uniform(-0.16, 0.16),
                     -0.01f};
    // A sack: wide and creased below, drawn together under the knot, the ends of which stand up.
    b.Sheet(
        14, 10,
        [&](float u, float v) {
          const float a = kTauF * u, neck = std::max(0.0f, v - 0.72f) / 0.28f;
          const float belly = std::sqrt(std::max(0.0f, 1 - std::pow(std::abs(2 * std::min(v, 0.72f) / 0.9f - 0.72f), 2.6f)));
          const float crease = 1 + 0.09f * std::sin(3 * a + p1 + 4 * v) + 0.05f * std::sin(7 * a + p2 - 9 * v);
          const float radius = v <= 0 ? 0.0f : neck > 0 ? r * (0.62f * (1 - neck) * (1 - neck) + 0.06f + 0.10f * neck) : r * belly * crease;
          return foot + Vec3f{radius * std::cos(a), radius * std::sin(a), h * std::max(0.0f, v - 0.04f)};
        },
        {1, 1});
  }
  for (int i = 0; i < 1 + static_cast<int>(variant % 2); ++i) {
    b.Use(Stone({0.30f, 0.205f, 0.125f}, 0.85f));
    b.Place(Turn(72 + uniform(-6, 6), 0, uniform(-12, 12), {uniform(-0.5, 0.5), -0.42f, 0.0f}));
    b.mesh().Box({-0.4f, 0, 0}, {0.4f, uniform(0.45, 0.7), 0.03f});
    b.Place({});
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> NewYorkKinds() {
  return {
      {"newspaper_box", "furniture/misc", 4, MakeNewspaperBox, 0.35f, 1.1f, 1.3f, 500},
      {"trash_bags", "furniture/misc", 6, MakeTrashBags, 1.0f, 0.4f, 0.75f, 2200},
      {"concrete_block", "traffic/barrier/concrete_block", 3, MakeConcreteBlock, 1.25f, 0.75f, 0.9f, 200},
      {"traffic_cone", "traffic/temporary/cone", 2, MakeCone, 0.25f, 0.7f, 0.95f, 400},
      {"metal_fence", "barrier/fence/metal_fence", 2, MakeMetalFence, 1.0f, 1.1f, 1.9f, 1600},
      {"road_column", "traffic/bollard/road_column", 2, MakeRoadColumn, 0.2f, 0.95f, 1.05f, 400},
      {"scaffold", "construction/scaffolding", 2, MakeScaffold, 1.6f, 3.9f, 4.2f, 1200},
      {"pillar", "construction/pillar", 2, MakePillar, 0.5f, 4.0f, 4.3f, 1500},
      {"hotdog_cart", "furniture/vending/hotdog_cart", 2, MakeHotdogCart, 1.4f, 2.5f, 2.7f, 1600},
      {"blue_barrier", "traffic/barrier/barrier", 1, MakeBlueBarrier, 0.8f, 0.9f, 1.0f, 600},
  };
}

}  // namespace airsim360::internal
