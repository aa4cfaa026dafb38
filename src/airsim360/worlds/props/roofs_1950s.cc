// What stood on the roofs of New York in the 1950s: aerials, ventilators.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// Television aerials on masts: 0 a comb of rods, 1 two fans, 2 dipoles one over the other.
Model MakeTelevisionAerial(uint32_t variant, uint64_t) {
  PropBuilder b("antenna_1950s");
  b.Use(Metal({0.50f, 0.51f, 0.52f}, 0.4f));
  const Vec2f foot[] = {{0.14f, 0}, {0.14f, 0.03f}, {0.05f, 0.05f}};
  b.Lathe(foot, 12);
  const float height = 3.1f + 0.3f * static_cast<float>(variant);
  b.mesh().Tube({0, 0, 0}, {0, 0, height}, 0.024f, 0.018f, 8);
  for (int i = 0; i < 3; ++i) {
    const float a = kTauF * static_cast<float>(i) / 3;
    b.mesh().Tube({0, 0, height * 0.55f}, {0.9f * std::cos(a), 0.9f * std::sin(a), 0.02f}, 0.004f, 0.004f, 4);
  }
  const auto rod = [&](Vec3f p, Vec3f q) { b.mesh().Tube(p, q, 0.007f, 0.007f, 5); };
  const float z = height - 0.12f;
  if (variant == 0) {
    b.mesh().Tube({0, -0.85f, z}, {0, 0.65f, z}, 0.013f, 0.013f, 6);
    for (int i = 0; i < 5; ++i) {
      const float y = -0.8f + 0.35f * static_cast<float>(i), half = 0.50f + 0.07f * static_cast<float>(i);
      rod({-half, y, z + 0.012f}, {half, y, z + 0.012f});
    }
  } else if (variant == 1) {
    b.mesh().Tube({0, -0.35f, z}, {0, 0.35f, z}, 0.013f, 0.013f, 6);
    for (float y : {-0.32f, 0.32f})
      for (float way : {-1.0f, 1.0f})
        for (float up : {-0.28f, 0.0f, 0.28f}) rod({0, y, z}, {way * 0.95f, y - 0.12f, z + up});
  } else {
    for (float low : {0.0f, 0.7f}) {
      b.mesh().Tube({0, -0.30f, z - low}, {0, 0.30f, z - low}, 0.013f, 0.013f, 6);
      rod({-0.85f, -0.27f, z - low}, {0.85f, -0.27f, z - low});
      rod({-0.70f, 0.27f, z - low}, {0.70f, 0.27f, z - low});
      rod({-0.70f, 0.27f, z - low + 0.07f}, {0.70f, 0.27f, z - low + 0.07f});
    }
  }
  return b.Finish();
}

// Large ventilators of sheet metal: 0 a cowl under a cone, 1 a louvred hood, 2 a stack of bricks with pots.
Model MakeRoofCowl(uint32_t variant, uint64_t) {
  PropBuilder b("roof_cowl");
  if (variant == 2) {
    b.Use(Stone({0.20f, 0.085f, 0.055f}), ConcreteTexture());
    b.BevelBox({-0.75f, -0.32f, -0.05f}, {0.75f, 0.32f, 1.75f}, 0.015f);
    b.BevelBox({-0.80f, -0.37f, 1.55f}, {0.80f, 0.37f, 1.72f}, 0.015f);
    b.Use(Stone({0.34f, 0.14f, 0.075f}, 0.8f));
    const Vec2f pot[] = {{0.15f, 1.75f}, {0.13f, 2.1f}, {0.16f, 2.12f}, {0.16f, 2.18f}, {0.11f, 2.18f}, {0.11f, 1.9f}};
    for (float x : {-0.45f, 0.0f, 0.45f}) b.Lathe(pot, 14, {x, 0, 0});
    return b.Finish();
  }
  b.Use(Metal(kZinc, 0.55f), ScratchedTexture());
  if (variant == 0) {
    const Vec2f drum[] = {{0.62f, 0}, {0.62f, 0.04f}, {0.46f, 0.10f}, {0.44f, 0.95f}};
    b.Lathe(drum, 22);
    const Vec2f cone[] = {{0.44f, 1.12f}, {0.74f, 1.08f}, {0.76f, 1.11f}, {0.40f, 1.38f}, {0.06f, 1.55f}, {0, 1.56f}};
    b.Lathe(cone, 22);
    for (int i = 0; i < 4; ++i) {
      const float a = kTauF * static_cast<float>(i) / 4;
      b.mesh().Beam({0.43f * std::cos(a), 0.43f * std::sin(a), 0.9f}, {0.5f * std::cos(a), 0.5f * std::sin(a), 1.12f}, 0.03f);
    }
    return b.Finish();
  }
  b.BevelBox({-0.8f, -0.6f, 0}, {0.8f, 0.6f, 0.35f}, 0.01f);
  b.BevelBox({-0.72f, -0.52f, 0.34f}, {0.72f, 0.52f, 1.25f}, 0.01f);
  b.BevelBox({-0.86f, -0.66f, 1.24f}, {0.86f, 0.66f, 1.32f}, 0.01f);
  b.Use(Metal(kZinc * 0.6f, 0.6f));
  for (int i = 0; i < 9; ++i) {
    const float z = 0.42f + 0.09f * static_cast<float>(i);
    for (float y : {-1.0f, 1.0f}) b.mesh().Box({-0.66f, y > 0 ? 0.52f : -0.56f, z}, {0.66f, y > 0 ? 0.56f : -0.52f, z + 0.03f});
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> Roofs1950sKinds() {
  return {
      {"antenna_1950s", "construction/rooftop/antenna", 3, MakeTelevisionAerial, 0.9f, 2.9f, 3.9f, 800},
      {"roof_cowl", "construction/rooftop/ventilation_tube", 3, MakeRoofCowl, 1.0f, 1.2f, 2.3f, 900},
  };
}

}  // namespace airsim360::internal
