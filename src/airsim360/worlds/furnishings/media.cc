// Television and what it stands on. Diagonals of 32, 43, 55 and 65 inches, 16:9.
#include <array>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// A landscape at dusk, as demonstration pictures show.
const Texture& Programme() {
  static const Texture texture =
      Texture::FromImage("programme",
                         Shade(256, 144,
                               [](float u, float v) {
                                 const float ridge = 0.55f + 0.12f * (TileFractal(u, 0.3f, 3, 1, 4, 91) - 0.5f),
                                             near_ridge = 0.72f + 0.16f * (TileFractal(u, 0.7f, 4, 1, 4, 92) - 0.5f);
                                 if (v > 0.86f) return Vec3f{0.05f, 0.09f, 0.16f} * (0.7f + 0.6f * TileFractal(u, v, 6, 40, 2, 93));
                                 if (v > near_ridge) return Vec3f{0.03f, 0.06f, 0.035f} * (0.6f + 0.8f * TileFractal(u, v, 24, 24, 3, 94));
                                 if (v > ridge) return Vec3f{0.11f, 0.13f, 0.22f} * (0.8f + 0.3f * (1 - v));
                                 const float t = v / 0.6f;
                                 return Vec3f{0.16f, 0.27f, 0.55f} * (1 - t) + Vec3f{0.85f, 0.45f, 0.20f} * t;
                               }),
                         true);
  return texture;
}

// Even variants are off, odd ones on (180 cd/m^2 white).
Model MakeTelevision(uint32_t variant, uint64_t) {
  PropBuilder b("television");
  const float inches = std::array{43.0f, 55.0f, 65.0f, 32.0f}[variant];
  const float w = inches * 0.0254f * 0.8716f / 2, h = inches * 0.0254f * 0.4903f, z = 0.055f, rim = 0.008f;
  b.Use(Plastic({0.018f, 0.018f, 0.019f}, 0.35f));
  b.BevelBox({-w - rim, -0.018f, z}, {w + rim, 0.018f, z + h + 2 * rim}, 0.004f);
  b.BevelBox({-w * 0.55f, 0.015f, z + 0.02f}, {w * 0.55f, 0.055f, z + h * 0.62f}, 0.02f);
  for (float s : {-1.0f, 1.0f}) {
    const Vec3f foot[] = {{s * w * 0.72f, -0.11f, 0.006f}, {s * w * 0.72f, 0, 0.030f}, {s * w * 0.72f, 0, z + 0.02f}};
    const Vec3f rear[] = {{s * w * 0.72f, 0.11f, 0.006f}, {s * w * 0.72f, 0, 0.030f}};
    b.Bar(foot, 0.006f, 8);
    b.Bar(rear, 0.006f, 8);
  }
  const float y = -0.0185f;
  const Vec3f p[4] = {{-w, y, z + rim}, {w, y, z + rim}, {w, y, z + rim + h}, {-w, y, z + rim + h}};
  if (variant % 2)
    b.Use(Screen(180), Programme());
  else
    b.Use(Plastic({0.010f, 0.010f, 0.011f}, 0.08f));
  b.Picture(p[0], p[1], p[2], p[3]);
  return b.Finish();
}

// Low board with drawers, an open bay with a player and a game console.
Model MakeTvStand(uint32_t variant, uint64_t) {
  PropBuilder b("tv_stand");
  const float half = std::array{0.80f, 0.60f, 0.90f}[variant], top = std::array{0.48f, 0.45f, 0.52f}[variant];
  const float y0 = -0.20f, y1 = 0.20f, foot = variant == 1 ? 0.04f : 0.14f;
  const auto body = [&](Grain g) {
    variant == 1 ? UseLacquer(b, {0.72f, 0.71f, 0.69f}, 0.25f) : UseTimber(b, variant ? Timber::kWalnut : Timber::kOak, g);
  };
  body(Grain::kAlongX);
  b.BevelBox({-half, y0, top - 0.022f}, {half, y1, top}, 0.004f);
  b.BevelBox({-half, y0, foot}, {half, y1, foot + 0.02f}, 0.004f);
  b.mesh().Box({-half + 0.01f, y1 - 0.01f, foot + 0.02f}, {half - 0.01f, y1 - 0.002f, top - 0.022f});
  b.BevelBox({-half * 0.33f, y0 + 0.02f, (foot + top) / 2 - 0.009f}, {half * 0.33f, y1 - 0.012f, (foot + top) / 2 + 0.009f}, 0.001f);
  body(Grain::kUpright);
  for (float x : {-half + 0.009f, -half * 0.33f, half * 0.33f, half - 0.009f})
    b.BevelBox({x - 0.009f, y0 + 0.006f, foot + 0.02f}, {x + 0.009f, y1 - 0.01f, top - 0.022f}, 0.001f);
  body(Grain::kAlongX);
  for (float s : {-1.0f, 1.0f}) {
    const float x0 = s > 0 ? half * 0.33f + 0.004f : -half + 0.004f, x1 = s > 0 ? half - 0.004f : -half * 0.33f - 0.004f;
    Front(b, x0, x1, foot + 0.023f, top - 0.025f, y0 + 0.006f);
    b.Use(Metal());
    BowHandle(b, {(x0 + x1) / 2 - 0.07f, top - 0.08f}, {(x0 + x1) / 2 + 0.07f, top - 0.08f}, y0 - 0.012f);
    body(Grain::kAlongX);
  }
  b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.3f));
  b.BevelBox({-0.20f, y0 + 0.05f, foot + 0.022f}, {0.16f, y1 - 0.06f, foot + 0.085f}, 0.004f);
  b.BevelBox({-0.15f, y0 + 0.06f, (foot + top) / 2 + 0.011f}, {0.15f, y1 - 0.06f, (foot + top) / 2 + 0.055f}, 0.006f);
  body(Grain::kUpright);
  for (float x : {-half + 0.10f, half - 0.10f})
    for (float y : {y0 + 0.06f, y1 - 0.06f}) {
      if (variant == 1)
        b.BevelBox({x - 0.05f, y - 0.03f, 0}, {x + 0.05f, y + 0.03f, foot}, 0.003f);
      else
        b.mesh().Tube({x * 1.02f, y * 1.1f, 0}, {x, y, foot}, 0.011f, 0.020f, 12);
    }
  return b.Finish();
}

}  // namespace

FurnishingRows MediaRows() {
  return {{{"television", "furniture/electronics/television", 4, MakeTelevision, 0.8f, 0.45f, 1.0f, 800}, Mount::kSurface},
          {{"tv_stand", "furniture/cabinet", 3, MakeTvStand, 0.95f, 0.42f, 0.55f, 1500}}};
}

}  // namespace airsim360::internal
