// Poster stands and traffic signs with drawn faces.
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kWhite{0.80f, 0.80f, 0.80f}, kBlack{0.015f, 0.015f, 0.015f}, kRed{0.50f, 0.015f, 0.02f}, kGreen{0.0f, 0.13f, 0.06f},
    kYellow{0.85f, 0.50f, 0.01f};

// Four posters of our own: a concert, a market, an exhibition, a run along the river.
Texture Poster(uint32_t variant) {
  const Vec3f grounds[4] = {{0.02f, 0.03f, 0.09f}, {0.70f, 0.60f, 0.38f}, {0.72f, 0.70f, 0.64f}, {0.03f, 0.22f, 0.33f}};
  Canvas c(256, 384, grounds[variant]);
  switch (variant) {
    case 0:
      for (int i = 6; i > 0; --i)
        c.Disc({0.5f, 0.42f}, 0.045f * static_cast<float>(i), i % 2 ? Vec3f{0.75f, 0.20f, 0.05f} : Vec3f{0.85f, 0.55f, 0.08f});
      c.Letters("NIGHT", {0.5f, 0.09f}, 0.085f, kWhite);
      c.Letters("MUSIC", {0.5f, 0.76f}, 0.085f, {0.85f, 0.55f, 0.08f});
      c.Letters("PLAZA STAGE 8 PM", {0.5f, 0.90f}, 0.032f, kWhite);
      break;
    case 1:
      c.Rectangle({0, 0}, {1, 0.22f}, {0.28f, 0.05f, 0.03f});
      c.Letters("MARKET", {0.5f, 0.11f}, 0.09f, {0.80f, 0.72f, 0.50f});
      for (int i = 0; i < 5; ++i)
        c.Disc({0.18f + 0.16f * static_cast<float>(i), 0.50f + 0.06f * static_cast<float>(i % 2)}, 0.075f,
               i % 2 ? Vec3f{0.55f, 0.04f, 0.02f} : Vec3f{0.30f, 0.38f, 0.04f});
      for (int i = 0; i < 5; ++i)
        c.Line({0.18f + 0.16f * static_cast<float>(i), 0.45f}, {0.20f + 0.16f * static_cast<float>(i), 0.38f}, 0.012f,
               {0.08f, 0.12f, 0.02f});
      c.Rectangle({0.08f, 0.68f}, {0.92f, 0.72f}, {0.20f, 0.10f, 0.04f});
      c.Letters("EVERY SATURDAY", {0.5f, 0.82f}, 0.042f, kBlack);
      c.Letters("9 - 14", {0.5f, 0.91f}, 0.05f, {0.28f, 0.05f, 0.03f});
      break;
    case 2:
      c.Rectangle({0.10f, 0.08f}, {0.58f, 0.52f}, {0.62f, 0.05f, 0.03f});
      c.Rectangle({0.62f, 0.08f}, {0.90f, 0.26f}, {0.02f, 0.06f, 0.30f});
      c.Rectangle({0.62f, 0.29f}, {0.90f, 0.52f}, {0.78f, 0.55f, 0.03f});
      for (float y : {0.055f, 0.275f, 0.54f}) c.Line({0.06f, y}, {0.94f, y}, 0.014f, kBlack);
      for (float x : {0.08f, 0.60f, 0.92f}) c.Line({x, 0.04f}, {x, 0.56f}, 0.014f, kBlack);
      c.Letters("FORM", {0.5f, 0.67f}, 0.10f, kBlack);
      c.Letters("& COLOR", {0.5f, 0.79f}, 0.07f, kBlack);
      c.Letters("CITY GALLERY", {0.5f, 0.91f}, 0.042f, kBlack);
      break;
    default:
      c.Disc({0.72f, 0.22f}, 0.10f, {0.85f, 0.62f, 0.15f});
      for (int i = 0; i < 4; ++i)
        c.Line({-0.1f, 0.50f + 0.05f * static_cast<float>(i)}, {1.1f, 0.40f + 0.05f * static_cast<float>(i)}, 0.022f,
               i % 2 ? Vec3f{0.10f, 0.45f, 0.60f} : kWhite);
      c.Letters("RIVER", {0.36f, 0.13f}, 0.075f, kWhite);
      c.Letters("RUN", {0.36f, 0.23f}, 0.075f, kWhite);
      c.Letters("10 K", {0.5f, 0.75f}, 0.12f, {0.85f, 0.62f, 0.15f});
      c.Letters("JOIN US IN MAY", {0.5f, 0.90f}, 0.042f, kWhite);
  }
  return c.Finish("poster " + std::to_string(variant));
}

// Two-sided street case on two legs with a roof strip; the posters sit in a frame behind the plane of the
// frame.
Model MakePosterStand(uint32_t variant, uint64_t) {
  PropBuilder b("poster_stand");
  b.Use(Paint({0.035f, 0.037f, 0.04f}, 0.35f));
  for (float x : {-0.52f, 0.52f}) {
    b.BevelBox({x - 0.045f, -0.06f, 0}, {x + 0.045f, 0.06f, 2.05f}, 0.015f);
    b.BevelBox({x - 0.09f, -0.16f, 0}, {x + 0.09f, 0.16f, 0.03f}, 0.01f);
  }
  b.BevelBox({-0.50f, -0.06f, 0.40f}, {0.50f, 0.06f, 0.52f}, 0.012f);
  b.BevelBox({-0.60f, -0.09f, 1.98f}, {0.60f, 0.09f, 2.10f}, 0.03f);
  b.mesh().Box({-0.48f, -0.03f, 0.52f}, {0.48f, 0.03f, 1.98f}, MeshBuilder::kFront | MeshBuilder::kBack);
  for (uint32_t side = 0; side < 2; ++side) {
    b.Place(Turn(0, 0, side ? 180 : 0));
    b.Use(Plastic({1, 1, 1}, 0.25f), Poster((variant + side) % 4));
    b.Picture({-0.44f, -0.034f, 0.58f}, {0.44f, -0.034f, 0.58f}, {0.44f, -0.034f, 1.90f}, {-0.44f, -0.034f, 1.90f});
  }
  return b.Finish();
}

// Faces of the traffic signs.
Texture SignFace(uint32_t variant) {
  switch (variant) {
    case 0: {
      Canvas c(256, 256, kWhite);
      c.RegularPolygon({0.5f, 0.5f}, 0.515f, 8, kTauF / 16, kRed);
      c.Letters("STOP", {0.5f, 0.5f}, 0.23f, kWhite);
      return c.Finish("sign stop");
    }
    case 1: {
      Canvas c(192, 256, kWhite);
      c.Letters("NO", {0.5f, 0.12f}, 0.11f, kRed);
      c.Disc({0.5f, 0.47f}, 0.25f, kRed);
      c.Disc({0.5f, 0.47f}, 0.20f, kWhite);
      c.Letters("P", {0.51f, 0.47f}, 0.27f, kBlack);
      c.Line({0.28f, 0.31f}, {0.72f, 0.63f}, 0.045f, kRed);
      c.Letters("ANY TIME", {0.5f, 0.86f}, 0.09f, kRed);
      return c.Finish("sign no parking");
    }
    case 2:
    case 3: {
      Canvas c(512, 96, kGreen);
      c.Letters(variant == 2 ? "MARKET ST" : "GROVE AVE", {0.5f, 0.5f}, 0.58f, kWhite);
      return c.Finish(variant == 2 ? "sign market st" : "sign grove ave");
    }
    case 4: {
      Canvas c(192, 256, kWhite);
      c.Letters("SPEED", {0.5f, 0.16f}, 0.13f, kBlack);
      c.Letters("LIMIT", {0.5f, 0.33f}, 0.13f, kBlack);
      c.Letters("25", {0.5f, 0.68f}, 0.38f, kBlack);
      return c.Finish("sign speed limit");
    }
    default: {
      Canvas c(256, 256, kYellow);
      c.Disc({0.5f, 0.24f}, 0.06f, kBlack);
      c.Line({0.5f, 0.34f}, {0.48f, 0.55f}, 0.085f, kBlack);
      c.Line({0.48f, 0.55f}, {0.38f, 0.80f}, 0.055f, kBlack);
      c.Line({0.48f, 0.55f}, {0.58f, 0.78f}, 0.055f, kBlack);
      c.Line({0.5f, 0.36f}, {0.38f, 0.52f}, 0.045f, kBlack);
      c.Line({0.5f, 0.36f}, {0.63f, 0.50f}, 0.045f, kBlack);
      return c.Finish("sign pedestrians");
    }
  }
}

// Outline of a sign plate in its plane, counter-clockwise, centred on 0.
std::vector<Vec2f> PlateOutline(uint32_t variant) {
  switch (variant) {
    case 0: {
      std::vector<Vec2f> octagon;
      for (int i = 0; i < 8; ++i)
        octagon.push_back(
            Vec2f{std::cos(kTauF * (static_cast<float>(i) + 0.5f) / 8), std::sin(kTauF * (static_cast<float>(i) + 0.5f) / 8)} * 0.40f);
      return octagon;
    }
    case 2:
    case 3:
      return RoundedRectangle({-0.48f, -0.09f}, {0.48f, 0.09f}, 0.02f, 3);
    case 5:
      return {{0.44f, 0}, {0, 0.44f}, {-0.44f, 0}, {0, -0.44f}};
    default:
      return RoundedRectangle({-0.2275f, -0.305f}, {0.2275f, 0.305f}, 0.035f, 4);
  }
}

// A plate with its picture towards -Y and bare metal behind, centred on (0, y, z).
void SignPlate(PropBuilder& b, uint32_t variant, float y, float z, bool both_sides) {
  const auto outline = PlateOutline(variant);
  Vec2f half{};
  for (Vec2f p : outline) half = {std::max(half.x, p.x), std::max(half.y, p.y)};
  // The diamond shows an upright picture square inside of it.
  b.Place(Turn(90, 0, 0, {0, y, z}));
  b.Use(Metal({0.55f, 0.56f, 0.57f}, 0.45f));
  b.Prism(outline, -0.0015f, 0.0015f);
  b.Use(Paint({1, 1, 1}, 0.5f), SignFace(variant), half * 2.0f);
  for (float side : {1.0f, -1.0f}) {
    if (side < 0 && !both_sides) break;
    b.Place(Turn(90, 0, side > 0 ? 0 : 180, {0, y, z}));
    for (Vec3u t : TriangulatePolygon(outline)) {
      const auto at = [&](uint32_t i) { return Vec3f{outline[i].x, outline[i].y, 0.0035f}; };
      const auto uv = [&](uint32_t i) { return Vec2f{half.x + outline[i].x, half.y - outline[i].y}; };
      b.mesh().Triangle(at(t.x), at(t.y), at(t.z), uv(t.x), uv(t.y), uv(t.z));
    }
  }
  b.Place({});
}

Model MakeTrafficSign(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_sign");
  const bool street_name = variant == 2 || variant == 3;
  const float height = street_name ? 3.05f : 2.75f;
  b.Use(Metal({0.50f, 0.51f, 0.52f}, 0.45f), ScratchedTexture());
  b.mesh().Tube({0, 0, -0.2f}, {0, 0, height}, 0.030f, 0.030f, 12);
  if (street_name) {
    SignPlate(b, variant, 0, height + 0.10f, true);
    b.Use(Metal());
    b.BevelBox({-0.03f, -0.012f, height - 0.01f}, {0.03f, 0.012f, height + 0.015f}, 0.003f);
  } else {
    SignPlate(b, variant, -0.036f, height - (variant == 0 || variant == 5 ? 0.44f : 0.34f), false);
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> SignageKinds() {
  return {
      {"poster_stand", "signage/poster_stand", 4, MakePosterStand, 0.8f, 2.0f, 2.2f, 500},
      {"traffic_sign", "signage/traffic_sign", 6, MakeTrafficSign, 0.2f, 2.6f, 3.4f, 400},
  };
}

}  // namespace airsim360::internal
