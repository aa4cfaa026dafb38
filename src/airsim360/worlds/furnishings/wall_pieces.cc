// Pictures in frames, and mirrors. Backs on y = 0.
#include <array>
#include <cmath>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// Four mitred bars of `wide` x `deep` around the opening of half width w from z0 to z1.
void Frame(PropBuilder& b, float w, float z0, float z1, float wide, float deep) {
  const Vec2f outer[4] = {{-w, z0}, {w, z0}, {w, z1}, {-w, z1}};
  const Vec2f inner[4] = {{-w + wide, z0 + wide}, {w - wide, z0 + wide}, {w - wide, z1 - wide}, {-w + wide, z1 - wide}};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const auto at = [](Vec2f p, float y) { return Vec3f{p.x, y, p.y}; };
    const Vec2f ridge_i = outer[i] * 0.65f + inner[i] * 0.35f, ridge_j = outer[j] * 0.65f + inner[j] * 0.35f;
    b.mesh().Quad(at(outer[i], 0), at(outer[j], 0), at(outer[j], -deep * 0.8f), at(outer[i], -deep * 0.8f));
    b.mesh().Quad(at(outer[i], -deep * 0.8f), at(outer[j], -deep * 0.8f), at(ridge_j, -deep), at(ridge_i, -deep));
    b.mesh().Quad(at(ridge_i, -deep), at(ridge_j, -deep), at(inner[j], -deep * 0.55f), at(inner[i], -deep * 0.55f));
  }
}

Vec3f Hills(float u, float v) {
  const float sky = 0.48f + 0.08f * std::sin(4 * u) + 0.10f * (TileFractal(u, 0.2f, 3, 1, 4, 811) - 0.5f);
  const float brush = 0.85f + 0.3f * TileFractal(u, v, 14, 40, 3, 812);
  if (v < sky) return (Vec3f{0.35f, 0.48f, 0.62f} * (1 - v) + Vec3f{0.72f, 0.62f, 0.45f} * v) * brush;
  if (v < sky + 0.14f) return Vec3f{0.16f, 0.22f, 0.26f} * brush;
  if (v < 0.78f + 0.04f * std::sin(9 * u)) return Vec3f{0.20f, 0.26f, 0.08f} * brush;
  return Vec3f{0.36f, 0.30f, 0.10f} * brush;
}
Vec3f Shapes(float u, float v) {
  const float grain = 0.93f + 0.1f * TileFractal(u, v, 60, 60, 2, 821);
  if (std::hypot(u - 0.36f, (v - 0.36f) * 1.35f) < 0.20f) return Vec3f{0.52f, 0.20f, 0.08f} * grain;
  if (std::hypot(u - 0.66f, (v - 0.62f) * 1.35f) < 0.24f && v > 0.62f) return Vec3f{0.08f, 0.13f, 0.16f} * grain;
  if (std::abs(u - 0.60f - 0.2f * v) < 0.018f && v < 0.6f) return Vec3f{0.10f, 0.10f, 0.10f} * grain;
  return Vec3f{0.66f, 0.61f, 0.52f} * grain;
}
Vec3f Leaves(float u, float v) {
  const Vec3f paper{0.72f, 0.71f, 0.67f};
  const float stem = 0.5f + 0.05f * std::sin(5 * v);
  if (std::abs(u - stem) < 0.008f && v > 0.15f && v < 0.92f) return {0.08f, 0.12f, 0.06f};
  for (int i = 0; i < 7; ++i) {
    const float side = i % 2 ? 1.0f : -1.0f, vy = 0.20f + 0.10f * static_cast<float>(i);
    const float dx = (u - stem) * side, dy = v - vy + 0.35f * dx;
    const float s = dx / 0.26f;
    if (s > 0 && s < 1 && std::abs(dy) < 0.055f * std::sin(3.14159265f * s)) return Vec3f{0.10f, 0.20f, 0.09f} * (0.8f + 0.5f * s);
  }
  return paper;
}
Vec3f Tower(float u, float v) {  // a black and white photograph of a street
  const float t = TileFractal(u, v, 30, 40, 3, 841);
  const float block = TileNoise(u * 9, 0.5f, 9, 1, 842), height = 0.25f + 0.4f * block + 0.3f * std::abs(u - 0.5f);
  if (1 - v < height)
    return Vec3f{1, 1, 1} *
           ((0.06f + 0.16f * block + (std::fmod(u * 54, 1.0f) < 0.4f && std::fmod(v * 42, 1.0f) < 0.5f ? 0.12f : 0)) * (0.8f + 0.4f * t));
  return Vec3f{1, 1, 1} * (0.50f + 0.25f * (1 - v) + 0.12f * (t - 0.5f));
}

struct PictureLook {
  float half, height, frame;
  Vec3f (*paint)(float, float);
  int moulding;  // 0 oak, 1 black, 2 gilt, 3 white
  float mat;     // of card around the picture
};

Model MakePictureFrame(uint32_t variant, uint64_t) {
  PropBuilder b("picture_frame");
  const PictureLook look = std::array<PictureLook, 4>{{{0.45f, 0.66f, 0.05f, Hills, 2, 0},
                                                       {0.30f, 0.80f, 0.018f, Shapes, 0, 0.03f},
                                                       {0.25f, 0.70f, 0.016f, Leaves, 1, 0.06f},
                                                       {0.40f, 0.60f, 0.022f, Tower, 3, 0.05f}}}[variant];
  switch (look.moulding) {
    case 0:
      UseTimber(b, Timber::kOak);
      break;
    case 1:
      b.Use(Paint({0.02f, 0.02f, 0.022f}, 0.4f));
      break;
    case 2:
      b.Use(Metal({0.42f, 0.30f, 0.12f}, 0.38f));
      break;
    default:
      UseLacquer(b, {0.74f, 0.73f, 0.71f});
      break;
  }
  Frame(b, look.half, 0, look.height, look.frame, 0.022f);
  const float w = look.half - look.frame, z0 = look.frame, z1 = look.height - look.frame, y = -0.010f;
  if (look.mat > 0) {
    b.Use(Stone({0.76f, 0.75f, 0.72f}, 0.9f));
    b.mesh().Quad({-w, y, z0}, {w, y, z0}, {w, y, z1}, {-w, y, z1});
  }
  const Texture picture = Texture::FromImage("painting " + std::to_string(variant), Shade(192, 256, look.paint), true);
  b.Use(Paint({0.9f, 0.9f, 0.9f}, look.moulding == 2 ? 0.35f : 0.6f), picture);
  const float m = look.mat, yp = y - 0.0008f;
  b.Picture({-w + m, yp, z0 + m}, {w - m, yp, z0 + m}, {w - m, yp, z1 - m}, {-w + m, yp, z1 - m});
  return b.Finish();
}

Model MakeMirrorWall(uint32_t variant, uint64_t) {
  PropBuilder b("mirror_wall");
  if (variant == 1) {  // round
    b.Place(Turn(90, 0, 0, {0, 0, 0.35f}));
    b.Use(Paint({0.02f, 0.02f, 0.022f}, 0.4f));
    const Vec2f ring[] = {{0.35f, 0}, {0.35f, 0.020f}, {0.335f, 0.020f}, {0.335f, 0.012f}};
    b.Lathe(ring, 64);
    b.Use(Mirror());
    const Vec2f glass[] = {{0.336f, 0.012f}, {0, 0.012f}};
    b.Lathe(glass, 64);
    b.Place({});
    return b.Finish();
  }
  const float half = variant == 0 ? 0.30f : 0.25f, h = variant == 0 ? 0.80f : 1.60f;
  variant == 0 ? b.Use(Metal({0.6f, 0.6f, 0.6f}, 0.25f)) : UseTimber(b, Timber::kOak);
  Frame(b, half, 0, h, variant == 0 ? 0.012f : 0.03f, 0.022f);
  b.Use(Mirror());
  const float r = variant == 0 ? 0.012f : 0.03f;
  b.mesh().Quad({-half + r, -0.010f, r}, {half - r, -0.010f, r}, {half - r, -0.010f, h - r}, {-half + r, -0.010f, h - r});
  return b.Finish();
}

}  // namespace

FurnishingRows WallPieceRows() {
  return {{{"picture_frame", "furniture/painting", 4, MakePictureFrame, 0.4f, 0.55f, 0.85f, 100}, Mount::kWall, 1.25f},
          {{"mirror_wall", "furniture/mirror", 3, MakeMirrorWall, 0.28f, 0.65f, 1.65f, 900}, Mount::kWall, 1.05f}};
}

}  // namespace airsim360::internal
