// Rugs and curtains.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// Knotted wool: every texel is one knot of slightly uneven dye.
Vec3f Knot(Vec3f dye, float u, float v, uint64_t seed) {
  return dye * (0.80f + 0.22f * TileFractal(u, v, 80, 110, 2, seed) + 0.14f * (TileFractal(u, v, 2, 3, 3, seed + 1) - 0.5f));
}

// A medallion in nested borders, after Persian carpets.
Vec3f Persian(float u, float v) {
  const Vec3f red{0.20f, 0.030f, 0.026f}, navy{0.030f, 0.040f, 0.085f}, cream{0.47f, 0.40f, 0.29f}, gold{0.34f, 0.20f, 0.06f};
  const float x = 2 * u - 1, y = 2 * v - 1, rim = std::min(1 - std::abs(x), (1 - std::abs(y)) * 1.5f);
  if (rim < 0.035f) return navy;
  if (rim < 0.055f) return cream;
  if (rim < 0.20f) {  // palmettes along the border
    const float along = std::abs(x) > std::abs(y) * 1.0f && 1 - std::abs(x) < (1 - std::abs(y)) * 1.5f ? y * 13.5f : x * 9;
    const float s = std::abs(along - std::round(along)), t = std::abs(rim - 0.127f) * 12;
    return s * 2 + t < 0.55f ? cream : s * 2 + t < 0.8f ? gold : red;
  }
  if (rim < 0.225f) return gold;
  const float r = std::hypot(x * 1.25f, y * 1.05f), a = std::atan2(y, x);
  const float star = r * (1 + 0.10f * std::cos(8 * a));
  if (star < 0.12f) return cream;
  if (star < 0.26f) return red;
  if (star < 0.30f) return cream;
  if (star < 0.50f) return std::sin(16 * a) * std::sin(40 * r) > 0.35f ? gold : navy;
  if (star < 0.53f) return cream;
  const float vine = std::sin(11 * kPiF * x) * std::sin(15 * kPiF * y) + 0.4f * std::sin(23 * kPiF * (x + y));
  return vine > 0.85f ? cream : vine < -0.9f ? navy : red;
}
Vec3f Stripes(float u, float v) {
  const Vec3f tones[4] = {{0.46f, 0.42f, 0.35f}, {0.08f, 0.11f, 0.15f}, {0.46f, 0.42f, 0.35f}, {0.40f, 0.20f, 0.10f}};
  const float s = v * 15 + 0.03f * std::sin(60 * u);
  const int i = static_cast<int>(s);
  return s - static_cast<float>(i) < 0.10f ? Vec3f{0.60f, 0.57f, 0.50f} : tones[static_cast<size_t>(i * 7 % 4)];
}
Vec3f Lozenges(float u, float v) {
  const float p = std::abs(std::fmod(u * 5, 1.0f) - 0.5f) + std::abs(std::fmod(v * 7.5f, 1.0f) - 0.5f);
  return std::abs(p - 0.5f) < 0.045f || std::abs(p - 0.22f) < 0.03f ? Vec3f{0.10f, 0.10f, 0.105f} : Vec3f{0.58f, 0.55f, 0.49f};
}

// Persian, striped kilim, ivory with lozenges, a round one of plain pile.
Model MakeRug(uint32_t variant, uint64_t) {
  PropBuilder b("rug");
  const Vec2f half = std::array<Vec2f, 4>{{{0.85f, 1.2f}, {0.80f, 1.15f}, {1.0f, 1.5f}, {0.75f, 0.75f}}}[variant];
  const float thick = std::array{0.011f, 0.007f, 0.018f, 0.026f}[variant];
  if (variant == 3) {
    UsePile(b, {0.40f, 0.42f, 0.40f});
    const Vec2f disc[] = {{half.x, 0.0005f}, {half.x + 0.006f, thick * 0.5f}, {half.x - 0.004f, thick}, {0, thick}};
    b.Lathe(disc, 64);
    return b.Finish();
  }
  const auto dye = std::array{Persian, Stripes, Lozenges}[variant];
  const std::string name = std::array{"persian rug", "striped rug", "lozenge rug"}[variant];
  const Texture picture = Texture::FromImage(
      name,
      Shade(448, 640,
            [&](float u, float v) {
              Vec3f mean{};  // 3 x 3 samples a texel
              for (int k = 0; k < 9; ++k)
                mean = mean + dye(u + static_cast<float>(k % 3 - 1) / 1344, v + static_cast<float>(k / 3 - 1) / 1920) * (1.0f / 9);
              return Knot(mean, u, v, 700 + variant);
            }),
      true);
  b.Use(Stone({0.9f, 0.9f, 0.9f}, 0.98f), picture);
  const float z = thick;
  b.Picture({-half.x, -half.y, z}, {half.x, -half.y, z}, {half.x, half.y, z}, {-half.x, half.y, z});
  UsePile(b, variant == 0 ? Vec3f{0.06f, 0.07f, 0.11f} : Vec3f{0.50f, 0.46f, 0.40f});
  b.mesh().Box({-half.x, -half.y, 0.0005f}, {half.x, half.y, z}, MeshBuilder::kAllSides & ~MeshBuilder::kTop);
  if (variant < 2) {  // fringes at both ends
    b.Use(Fabric({0.60f, 0.55f, 0.45f}));
    for (float s : {-1.0f, 1.0f})
      for (int i = 0; i < 70; ++i) {
        const float x = -half.x + 2 * half.x * (static_cast<float>(i) + 0.5f) / 70, sway = 0.010f * std::sin(2.9f * static_cast<float>(i));
        b.mesh().Triangle({x - 0.007f * s, s * half.y, z * 0.6f}, {x + 0.007f * s, s * half.y, z * 0.6f},
                          {x + sway, s * (half.y + 0.055f), 0.002f});
      }
  }
  return b.Finish();
}

// A pair of drawn-back curtains on a rod over a window 1.5 m wide, or sheer ones before all of it; to the floor from 2.3 m.
Model MakeCurtain(uint32_t variant, uint64_t seed) {
  PropBuilder b("curtain");
  const float top = 2.28f, half = 1.05f, y = -0.10f;
  variant == 1 ? b.Use(Paint({0.03f, 0.03f, 0.033f})) : b.Use(Metal({0.55f, 0.54f, 0.52f}, 0.3f));
  b.mesh().Tube({-half - 0.06f, y, top + 0.03f}, {half + 0.06f, y, top + 0.03f}, 0.013f, 0.013f, 12);
  for (float s : {-1.0f, 1.0f}) {
    b.mesh().Sphere({s * (half + 0.075f), y, top + 0.03f}, {0.026f, 0.026f, 0.026f}, 8, 14);
    b.mesh().Tube({s * (half - 0.03f), 0, top + 0.03f}, {s * (half - 0.03f), y, top + 0.03f}, 0.007f, 0.007f, 8);
    b.mesh().Tube({s * (half - 0.03f), 0, top + 0.03f}, {s * (half - 0.03f), -0.008f, top + 0.03f}, 0.026f, 0.024f, 14);
  }
  const Vec3f tones[4] = {{0.50f, 0.46f, 0.38f}, {0.12f, 0.17f, 0.22f}, {0.72f, 0.72f, 0.70f}, {0.36f, 0.13f, 0.08f}};
  const bool sheer = variant == 2;
  sheer ? UseSheerCloth(b, {0.85f, 0.85f, 0.83f}, 0.45f) : UseLinedCloth(b, tones[variant]);
  b.Place(Move({0, y, 0.012f}));
  if (sheer) {
    Hanging(b, -half, half, top, 0.035f, 19, seed);
  } else {
    const float drawn = variant == 3 ? 0.72f : 0.42f;
    Hanging(b, -half, -half + drawn, top, 0.05f, 8, seed);
    Hanging(b, half - drawn, half, top, 0.05f, 8, seed + 5);
  }
  b.Place({});
  return b.Finish();
}

}  // namespace

FurnishingRows TextileRows() {
  return {{{"rug", "furniture/rug", 4, MakeRug, 1.5f, 0.005f, 0.04f, 800}},
          {{"curtain", "furniture/curtain", 4, MakeCurtain, 0.9f, 2.25f, 2.40f, 5000}, Mount::kWall, 0}};
}

}  // namespace airsim360::internal
