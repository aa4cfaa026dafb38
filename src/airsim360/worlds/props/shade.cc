// Umbrellas and market tarps.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

const Vec3f kCloth[4] = {{0.62f, 0.58f, 0.47f}, {0.30f, 0.085f, 0.070f}, {0.070f, 0.135f, 0.105f}, {0.085f, 0.115f, 0.19f}};

// Cloth of two colours in stripes across u, with a weave.
Texture Stripes(const char* name, Vec3f a, Vec3f b) {
  return Texture::FromImage(name,
                            Shade(256, 64,
                                  [&](float u, float v) {
                                    const float weave = 0.92f + 0.08f * TileNoise(u * 128, v * 32, 128, 32, 51);
                                    return (u < 0.5f ? a : b) * weave;
                                  }),
                            true);
}

// Canvas of eight gores on ribs: the cloth sags between the ribs and hangs as a valance at the rim.
Model MakeUmbrella(uint32_t variant, uint64_t) {
  PropBuilder b("umbrella");
  const int gores = 8;
  const float radius = 1.45f, top = 2.62f, rim = 2.12f;
  UseWood(b);
  b.mesh().Tube({0, 0, 0.05f}, {0, 0, top}, 0.024f, 0.022f, 14);
  b.Use(CastIron());
  const Vec2f base[] = {{0.30f, 0}, {0.30f, 0.035f}, {0.27f, 0.055f}, {0.08f, 0.075f}, {0.045f, 0.10f}, {0.04f, 0.34f}, {0.02f, 0.345f}};
  b.Lathe(base, 28);
  const auto rib = [&](int i) {
    const float a = kTauF * (static_cast<float>(i) + 0.5f) / gores;
    return Vec3f{std::cos(a), std::sin(a), 0};
  };
  const auto crown = [&](float t) { return top - (top - rim) * (0.62f * t + 0.38f * t * t); };
  b.Use(Metal());
  for (int i = 0; i < gores; ++i) {
    const Vec3f end = rib(i) * (radius * 0.985f) + Vec3f{0, 0, rim - 0.012f},
                middle = rib(i) * (radius * 0.5f) + Vec3f{0, 0, crown(0.5f) - 0.02f};
    const Vec3f path[] = {Vec3f{0, 0, top - 0.03f}, middle, end};
    b.Bar(path, 0.006f, 5);
    b.mesh().Tube({0, 0, 1.75f}, middle, 0.005f, 0.005f, 5, false, false);
  }
  b.Use(Fabric(kCloth[variant]), ConcreteTexture());
  for (int i = 0; i < gores; ++i) {
    // A point of the gore: t from the hub to the rim, s from one rib to the next; straight chords with a
    // little sag.
    const auto at = [&](float t, float s) {
      const Vec3f p = (rib(i) * (1 - s) + rib(i + 1) * s) * (radius * t);
      const float sag = 4 * s * (1 - s) * t;
      return Vec3f{p.x, p.y, crown(t) - 0.05f * sag};
    };
    b.Sheet(4, 5, [&](float s, float t) { return at(t, s); }, {1.1f, radius});
    // The valance hangs from the rim; it is drawn upside down, so that its front is outside.
    const auto valance = [&](float s, float t) {
      const Vec3f rim_point = at(1, s);
      return Vec3f{rim_point.x * 1.003f, rim_point.y * 1.003f, rim_point.z - 0.15f * (1 - t)};
    };
    b.Sheet(4, 1, valance, {1.1f, 0.15f});
  }
  UseWood(b);
  b.mesh().Sphere({0, 0, top + 0.03f}, {0.03f, 0.03f, 0.04f}, 8, 12);
  return b.Finish();
}

// Cloth of 3 m x 3 m whose corners (+-1.5, +-1.5) are at the hooks of four tarp posts, sagging between its
// corners; seen from both sides.
Model MakeTarp(uint32_t variant, uint64_t) {
  PropBuilder b("tarp");
  const Vec3f white{0.72f, 0.70f, 0.65f};
  const Texture cloth =
      Stripes("tarp stripes", {1, 1, 1}, {kCloth[variant].x / white.x, kCloth[variant].y / white.y, kCloth[variant].z / white.z});
  b.Use(Fabric(white), cloth, {0.6f, 0.6f});
  const auto at = [](float u, float v) {
    const float x = 2 * u - 1, y = 2 * v - 1;
    // A ridge in the middle; the edges hang between the corners, which are at the hooks of tarp posts.
    const float edge = 0.16f * (1 - x * x) * y * y + 0.12f * (1 - y * y) * x * x;
    const float ridge = 0.42f * (1 - x * x) * (0.55f + 0.45f * (1 - y * y));
    return Vec3f{1.5f * x * (1 - 0.05f * (1 - y * y)), 1.5f * y * (1 - 0.05f * (1 - x * x)), 2.46f + ridge - edge};
  };
  b.Sheet(12, 12, at, {3, 3});
  // Valance along the front edge.
  b.Sheet(12, 1, [&](float u, float v) { return at(u, 0) + Vec3f{0, -0.01f * (1 - v), -0.22f * (1 - v)}; }, {3, 0.22f});
  return b.Finish();
}

// Wooden or steel post that holds a tarp: foot plate, post, hook.
Model MakeTarpPost(uint32_t variant, uint64_t) {
  PropBuilder b("tarp_post");
  b.Use(CastIron());
  b.BevelBox({-0.16f, -0.16f, 0}, {0.16f, 0.16f, 0.02f}, 0.005f);
  if (variant == 0) {
    UseWood(b, {0.9f, 0.85f, 0.8f});
    b.BevelBox({-0.04f, -0.04f, 0.015f}, {0.04f, 0.04f, 2.42f}, 0.006f);
  } else {
    b.Use(Metal({0.55f, 0.56f, 0.57f}, 0.4f));
    b.mesh().Tube({0, 0, 0.015f}, {0, 0, 2.42f}, 0.03f, 0.03f, 16);
  }
  b.Use(Metal());
  const Vec3f hook[] = {{0, 0, 2.40f}, {0, 0, 2.46f}, {0.02f, 0, 2.49f}, {0.045f, 0, 2.48f}, {0.05f, 0, 2.455f}};
  b.Bar(hook, 0.006f, 6);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> ShadeKinds() {
  return {
      {"umbrella", "furniture/shade/umbrella", 4, MakeUmbrella, 1.5f, 2.5f, 2.8f, 3000},
      {"tarp", "furniture/shade/tarp", 4, MakeTarp, 1.6f, 2.4f, 3.0f, 400},
      {"tarp_post", "furniture/shade/tarp_post", 2, MakeTarpPost, 0.2f, 2.3f, 2.6f, 400},
  };
}

}  // namespace airsim360::internal
