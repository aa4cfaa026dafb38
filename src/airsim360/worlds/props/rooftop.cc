// What stands on roofs.
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kGalvanised{0.52f, 0.53f, 0.54f};

// Louvres on the front (y = y0) of a box between x0, x1 and z0, z1.
void Louvres(PropBuilder& b, float x0, float x1, float y0, float z0, float z1) {
  const int count = static_cast<int>((z1 - z0) / 0.06f);
  for (int i = 0; i < count; ++i) {
    const float z = z0 + (z1 - z0) * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    b.mesh().Quad({x0, y0 - 0.025f, z - 0.02f}, {x1, y0 - 0.025f, z - 0.02f}, {x1, y0 - 0.002f, z + 0.018f}, {x0, y0 - 0.002f, z + 0.018f});
  }
}

// A round grille over a fan at height z: rings and spokes over a dark throat with blades.
void FanTop(PropBuilder& b, Vec3f c, float r) {
  b.Use(Paint({0.012f, 0.012f, 0.012f}, 0.9f));
  b.mesh().Tube(c, c + Vec3f{0, 0, 0.004f}, r, r, 24, false);
  b.Use(Paint({0.10f, 0.10f, 0.11f}));
  for (int i = 0; i < 5; ++i) {
    b.Place(Turn(18, 0, 72.0f * static_cast<float>(i), c + Vec3f{0, 0, 0.035f}));
    b.mesh().Box({0.04f, -r * 0.22f, -0.002f}, {r * 0.9f, r * 0.22f, 0.002f});
  }
  b.Place(Move(c));
  const Vec2f collar[] = {{r + 0.03f, 0}, {r + 0.03f, 0.07f}, {r, 0.09f}, {r, 0.005f}};
  b.Use(Metal(kGalvanised));
  b.Lathe(collar, 28);
  for (int k = 1; k <= 4; ++k) {
    const float q = r * static_cast<float>(k) / 4;
    const Vec2f ring[] = {{q - 0.004f, 0.08f}, {q + 0.004f, 0.08f}, {q + 0.004f, 0.086f}, {q - 0.004f, 0.086f}, {q - 0.004f, 0.08f}};
    b.Lathe(ring, 24);
  }
  for (int i = 0; i < 4; ++i) {
    b.Place(Turn(0, 0, 45.0f * static_cast<float>(i), c));
    b.mesh().Box({-r, -0.004f, 0.078f}, {r, 0.004f, 0.083f});
  }
  b.Place({});
}

// Packaged unit on rails, a fan (or two) on top, louvres at the sides, a pipe into the roof.
Model MakeAcUnit(uint32_t variant, uint64_t) {
  PropBuilder b("ac_unit");
  const float w = variant == 0 ? 0.55f : 1.1f, d = 0.5f, h = variant == 0 ? 0.95f : 1.25f;
  b.Use(Metal({0.35f, 0.35f, 0.36f}, 0.5f));
  for (float y : {-d + 0.1f, d - 0.1f}) b.BevelBox({-w - 0.05f, y - 0.04f, 0}, {w + 0.05f, y + 0.04f, 0.10f}, 0.006f);
  b.Use(Paint({0.55f, 0.55f, 0.52f}, 0.5f), ScratchedTexture());
  b.BevelBox({-w, -d, 0.10f}, {w, d, h}, 0.02f);
  for (int side = 0; side < 2; ++side) {
    b.Place(Turn(0, 0, side ? 180 : 0));
    Louvres(b, -w + 0.08f, w - 0.08f, -d, 0.25f, h - 0.2f);
  }
  b.Place({});
  if (variant == 0) {
    FanTop(b, {0, 0, h}, 0.36f);
  } else {
    for (float x : {-0.53f, 0.53f}) FanTop(b, {x, 0, h}, 0.38f);
  }
  b.Use(Metal({0.5f, 0.3f, 0.2f}, 0.4f));
  const Vec3f pipe[] = {{w - 0.02f, 0.3f, 0.35f}, {w + 0.10f, 0.3f, 0.35f}, {w + 0.15f, 0.3f, 0.30f}, {w + 0.15f, 0.3f, 0.0f}};
  b.Bar(pipe, 0.025f, 8);
  return b.Finish();
}

// Variant 0: turbine vent; 1: mushroom exhaust; 2: goose-neck duct.
Model MakeRoofVent(uint32_t variant, uint64_t) {
  PropBuilder b("roof_vent");
  b.Use(Metal(kGalvanised, 0.4f), ScratchedTexture());
  if (variant == 2) {
    std::vector<Vec3f> path = {{0, 0, 0}, {0, 0, 0.7f}};
    for (int i = 1; i <= 8; ++i) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(i) / 8 * 0.85f;
      path.push_back({0, -0.22f * (1 - std::cos(a)), 0.7f + 0.22f * std::sin(a)});
    }
    b.Bar(path, 0.14f, 18);
    const Vec2f flange[] = {{0.26f, 0}, {0.26f, 0.02f}, {0.15f, 0.05f}};
    b.Lathe(flange, 20);
    return b.Finish();
  }
  const Vec2f pipe[] = {{0.30f, 0}, {0.30f, 0.03f}, {0.17f, 0.08f}, {0.16f, 0.45f}};
  b.Lathe(pipe, 20);
  if (variant == 0) {
    for (int i = 0; i < 22; ++i) {
      b.Place(Turn(0, 0, 360.0f * static_cast<float>(i) / 22));
      for (int k = 0; k < 6; ++k) {
        const auto at = [&](int j, bool inner) {
          const float t = std::numbers::pi_v<float> * static_cast<float>(j) / 6;
          return Vec3f{(inner ? 0.10f : 0.14f) + 0.10f * std::sin(t), inner ? 0.035f : -0.015f, 0.45f + 0.15f * (1 - std::cos(t))};
        };
        b.mesh().Quad(at(k, false), at(k, true), at(k + 1, true), at(k + 1, false));
        b.mesh().Quad(at(k, true), at(k, false), at(k + 1, false), at(k + 1, true));
      }
    }
    b.Place({});
    const Vec2f cap[] = {{0.16f, 0.735f}, {0.12f, 0.76f}, {0, 0.775f}};
    b.Lathe(cap, 20);
  } else {
    const Vec2f hood[] = {{0.16f, 0.50f}, {0.32f, 0.48f}, {0.34f, 0.50f}, {0.30f, 0.58f}, {0.16f, 0.65f}, {0, 0.67f}};
    b.Lathe(hood, 24);
  }
  return b.Finish();
}

// Wooden tank with hoops and a conical roof on a steel frame.
Model MakeWaterTank(uint32_t variant, uint64_t) {
  PropBuilder b("water_tank");
  const float legs = variant == 0 ? 2.6f : 1.6f, r = 1.55f, h = 3.2f;
  b.Use(Paint({0.055f, 0.045f, 0.04f}, 0.7f));
  for (float x : {-1.05f, 1.05f}) {
    for (float y : {-1.05f, 1.05f}) b.BevelBox({x - 0.08f, y - 0.08f, 0}, {x + 0.08f, y + 0.08f, legs}, 0.01f);
    b.mesh().Beam({x, -1.05f, 0.15f}, {x, 1.05f, legs - 0.15f}, 0.05f);
    b.mesh().Beam({x, 1.05f, 0.15f}, {x, -1.05f, legs - 0.15f}, 0.05f);
    b.mesh().Beam({-1.05f, x, 0.15f}, {1.05f, x, legs - 0.15f}, 0.05f);
    b.mesh().Beam({1.05f, x, 0.15f}, {-1.05f, x, legs - 0.15f}, 0.05f);
  }
  for (float y : {-1.05f, -0.35f, 0.35f, 1.05f}) b.BevelBox({-1.6f, y - 0.07f, legs}, {1.6f, y + 0.07f, legs + 0.16f}, 0.008f);
  UseWood(b, {0.62f, 0.58f, 0.54f});
  const int staves = 40;
  for (int i = 0; i < staves; ++i) {
    b.Place(Turn(0, 0, 360.0f * static_cast<float>(i) / staves));
    const float half = r * std::tan(std::numbers::pi_v<float> / staves) * 0.985f;
    b.BevelBox({r - 0.05f, -half, legs + 0.16f}, {r + (i % 2 ? 0.004f : 0.0f), half, legs + 0.16f + h}, 0.012f);
  }
  b.Place({});
  b.Use(Metal({0.25f, 0.20f, 0.17f}, 0.6f));
  for (int k = 0; k < 9; ++k) {
    const float z = legs + 0.32f + h * std::pow(static_cast<float>(k) / 9, 1.25f);
    const Vec2f hoop[] = {{r + 0.016f, z}, {r + 0.026f, z + 0.004f}, {r + 0.026f, z + 0.026f}, {r + 0.016f, z + 0.03f}};
    b.Lathe(hoop, 40);
  }
  b.Use(Stone({0.10f, 0.095f, 0.09f}), ConcreteTexture());
  const Vec2f roof[] = {{0, legs + h + 0.14f},     {r + 0.12f, legs + h + 0.13f}, {r + 0.14f, legs + h + 0.16f},
                        {0.12f, legs + h + 1.05f}, {0.10f, legs + h + 1.12f},     {0, legs + h + 1.14f}};
  b.Lathe(roof, 40);
  b.Use(Metal(kGalvanised, 0.5f));
  b.mesh().Tube({0, 0, 0}, {0, 0, legs + 0.2f}, 0.10f, 0.10f, 14, false, false);
  for (float x : {-0.2f, 0.2f}) b.mesh().Tube({x, -r - 0.14f, legs + 0.1f}, {x, -r - 0.14f, legs + h + 0.5f}, 0.015f, 0.015f, 6);
  for (int k = 0; k < 12; ++k)
    b.mesh().Tube({-0.2f, -r - 0.14f, legs + 0.35f + 0.26f * static_cast<float>(k)},
                  {0.2f, -r - 0.14f, legs + 0.35f + 0.26f * static_cast<float>(k)}, 0.01f, 0.01f, 5);
  return b.Finish();
}

// Variant 0: Yagi on a mast; 1: dish; 2: lattice of mobile-phone panels.
Model MakeAntenna(uint32_t variant, uint64_t) {
  PropBuilder b("antenna");
  b.Use(Metal(kGalvanised, 0.4f));
  const Vec2f foot[] = {{0.22f, 0}, {0.22f, 0.03f}, {0.06f, 0.05f}};
  b.Lathe(foot, 16);
  const float height = variant == 0 ? 3.0f : variant == 1 ? 0.9f : 3.6f;
  b.mesh().Tube({0, 0, 0}, {0, 0, height}, variant == 2 ? 0.05f : 0.025f, variant == 2 ? 0.05f : 0.02f, 10);
  if (variant == 0) {
    b.mesh().Tube({0, -0.7f, 2.85f}, {0, 0.5f, 2.85f}, 0.012f, 0.012f, 6);
    for (int i = 0; i < 9; ++i) {
      const float y = -0.66f + 0.13f * static_cast<float>(i), half = 0.22f + 0.025f * static_cast<float>(i);
      b.mesh().Tube({-half, y, 2.86f}, {half, y, 2.86f}, 0.006f, 0.006f, 5);
    }
  } else if (variant == 1) {
    b.Place(Turn(55, 0, 0, {0, -0.05f, 0.95f}));
    b.Use(Paint({0.66f, 0.66f, 0.64f}));
    const Vec2f outside[] = {{0, 0}, {0.15f, 0.012f}, {0.30f, 0.05f}, {0.45f, 0.112f}, {0.455f, 0.118f}};
    const Vec2f inside[] = {{0.455f, 0.118f}, {0.44f, 0.115f}, {0.30f, 0.058f}, {0.15f, 0.020f}, {0, 0.008f}};
    b.Lathe(outside, 28);
    b.Lathe(inside, 28);
    b.Use(Metal());
    b.mesh().Tube({0, -0.44f, 0.115f}, {0, 0, 0.45f}, 0.01f, 0.01f, 6);
    b.mesh().Tube({0, 0, 0.42f}, {0, 0, 0.50f}, 0.03f, 0.025f, 10);
  } else {
    for (int i = 0; i < 3; ++i) {
      b.Place(Turn(0, 0, 120.0f * static_cast<float>(i)));
      b.Use(Metal(kGalvanised, 0.4f));
      for (float z : {2.2f, 3.2f}) b.mesh().Tube({0, 0, z}, {0, -0.38f, z}, 0.02f, 0.02f, 6);
      b.Use(Plastic({0.62f, 0.62f, 0.60f}));
      b.BevelBox({-0.14f, -0.48f, 1.8f}, {0.14f, -0.36f, 3.6f}, 0.03f);
    }
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> RooftopKinds() {
  return {
      {"ac_unit", "construction/rooftop/air_conditioner", 2, MakeAcUnit, 1.3f, 0.9f, 1.5f, 2500},
      {"roof_vent", "construction/rooftop/ventilation_tube", 3, MakeRoofVent, 0.4f, 0.6f, 1.2f, 1500},
      {"water_tank", "construction/rooftop/water_tank", 2, MakeWaterTank, 1.9f, 5.5f, 7.5f, 6000},
      {"antenna", "construction/rooftop/antenna", 3, MakeAntenna, 0.6f, 1.0f, 3.8f, 1000},
  };
}

}  // namespace airsim360::internal
