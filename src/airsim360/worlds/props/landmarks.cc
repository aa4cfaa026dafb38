// Things that flight instructions name: phone booth, flags, food truck, orange mailbox, a giant bottle.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/car_shape.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/mailbox.h"
#include "airsim360/worlds/props/prop_builder.h"
#include "airsim360/worlds/props/wheels.h"

namespace airsim360::internal {
namespace {

// Red telephone booth: domed cap, glazed sides of small panes.
Model MakePhoneBooth(uint32_t, uint64_t) {
  PropBuilder b("phone_booth");
  const Material red = Paint({0.46f, 0.010f, 0.012f}, 0.35f);
  b.Use(Stone({0.30f, 0.29f, 0.28f}));
  b.BevelBox({-0.48f, -0.48f, 0}, {0.48f, 0.48f, 0.10f}, 0.01f);
  b.Use(red);
  for (float x : {-0.40f, 0.40f})
    for (float y : {-0.40f, 0.40f}) b.BevelBox({x - 0.06f, y - 0.06f, 0.1f}, {x + 0.06f, y + 0.06f, 2.2f}, 0.01f);
  b.BevelBox({-0.46f, -0.46f, 0.1f}, {0.46f, 0.46f, 0.32f}, 0.01f);
  b.BevelBox({-0.48f, -0.48f, 2.12f}, {0.48f, 0.48f, 2.38f}, 0.02f);
  b.BevelBox({-0.43f, -0.43f, 2.38f}, {0.43f, 0.43f, 2.44f}, 0.02f);
  b.mesh().Sphere({0, 0, 2.40f}, {0.42f, 0.42f, 0.22f}, 10, 24);
  Canvas sign(192, 40, {0.78f, 0.76f, 0.70f});
  sign.Letters("TELEPHONE", {0.5f, 0.5f}, 0.6f, {0.02f, 0.02f, 0.02f}, 0.8f);
  const Texture letters = sign.Finish("telephone");
  for (int side = 0; side < 4; ++side) {
    b.Place(Turn(0, 0, 90.0f * static_cast<float>(side)));
    b.Use(red);
    for (int i = 1; i < 3; ++i) {
      const float x = -0.34f + 0.2267f * static_cast<float>(i);
      b.mesh().Box({x - 0.012f, -0.425f, 0.32f}, {x + 0.012f, -0.395f, 2.12f});
    }
    for (int i = 1; i < 8; ++i) {
      const float z = 0.32f + 0.225f * static_cast<float>(i);
      b.mesh().Box({-0.35f, -0.425f, z - 0.012f}, {0.35f, -0.395f, z + 0.012f});
    }
    b.Use(Glass({0.10f, 0.105f, 0.10f}));
    b.mesh().Quad({-0.35f, -0.405f, 0.32f}, {0.35f, -0.405f, 0.32f}, {0.35f, -0.405f, 2.12f}, {-0.35f, -0.405f, 2.12f});
    b.Use(Paint({1, 1, 1}), letters);
    b.Picture({-0.34f, -0.484f, 2.19f}, {0.34f, -0.484f, 2.19f}, {0.34f, -0.484f, 2.32f}, {-0.34f, -0.484f, 2.32f});
  }
  b.Place({});
  return b.Finish();
}

// `stars`: 50, or the 48 of before 1959.
Texture FlagPicture(int stars) {
  Canvas c(380, 200, {0.72f, 0.72f, 0.70f});
  for (int i = 0; i < 13; i += 2) {
    const float y = static_cast<float>(i) / 13;
    c.Rectangle({0, y}, {1, y + 1.0f / 13}, {0.40f, 0.010f, 0.025f});
  }
  c.Rectangle({0, 0}, {0.4f, 7.0f / 13}, {0.012f, 0.025f, 0.13f});
  const bool even = stars == 48;  // six rows of eight
  for (int row = 0; row < (even ? 6 : 9); ++row) {
    for (int i = 0; i < (even ? 8 : row % 2 ? 5 : 6); ++i) {
      const float x = even ? 0.4f * (static_cast<float>(i) + 0.5f) / 8 : 0.4f * (static_cast<float>(2 * i + (row % 2 ? 2 : 1))) / 12,
                  y = 7.0f / 13 * static_cast<float>(row + 1) / (even ? 7 : 10);
      // A star of five points: two triangles of lines are too coarse at this size, a small pentagon does.
      c.RegularPolygon({x, y}, 0.018f, 5, kTauF / 4, {0.75f, 0.75f, 0.73f});
    }
  }
  return c.Finish(even ? "flag usa 48" : "flag usa");
}

// A waving flag of width w from its mast at the origin of X towards +x, hanging from z = 0 downwards.
void AddFlag(PropBuilder& b, const AffineTransform& X, float w, int stars) {
  Material cloth = Fabric({1, 1, 1});
  cloth.transmission = 0.35f;
  const float h = w / 1.9f;
  b.Use(cloth, FlagPicture(stars), {w, h});
  b.Place(X);
  b.Sheet(24, 8,
          [&](float u, float v) {
            const float sway = 0.07f * w * u * std::sin(7.5f * u + 1.2f * v);
            return Vec3f{u * w * 0.97f, sway, -h * (1 - v) - 0.10f * w * u * u};
          },
          {w, h});
  b.Place({});
}

// Variant 0: a mast of 9 m in the ground; 1: a mast of 2.6 m slanting from a wall (y = 0) over the street.
Model FlagOf(uint32_t variant, int stars) {
  PropBuilder b(stars == 48 ? "us_flag_1950s" : "us_flag");
  b.Use(Metal({0.55f, 0.55f, 0.54f}, 0.35f));
  if (variant == 0) {
    const Vec2f mast[] = {{0.22f, 0}, {0.22f, 0.06f}, {0.09f, 0.10f}, {0.08f, 0.2f}, {0.035f, 8.9f}, {0, 8.91f}};
    b.Lathe(mast, 16);
    b.mesh().Sphere({0, 0, 8.96f}, {0.08f, 0.08f, 0.08f}, 8, 12);
    AddFlag(b, Move({0.05f, 0, 8.75f}), 2.6f, stars);
  } else {
    const Vec3f foot{0, 0, 0.75f}, tip{0, -2.0f, 2.35f};
    b.BevelBox({-0.08f, -0.06f, 0.62f}, {0.08f, 0.0f, 0.90f}, 0.01f);
    b.mesh().Tube(foot, tip, 0.035f, 0.022f, 10);
    b.mesh().Sphere(tip, {0.06f, 0.06f, 0.06f}, 8, 10);
    // The cloth hangs along the mast: its mast edge follows the slope, its free end droops.
    Material cloth = Fabric({1, 1, 1});
    cloth.transmission = 0.35f;
    b.Use(cloth, FlagPicture(stars), {2.2f, 1.25f});
    b.Sheet(24, 8,
            [&](float u, float v) {
              const Vec3f top = foot + (tip - foot) * (0.16f + 0.8f * u);
              return Vec3f{0.10f * std::sin(8 * u + v) * (1 - 0.5f * v), top.y, top.z - 1.25f * (1 - v) * (1 - 0.25f * u)};
            },
            {2.2f, 1.25f});
  }
  return b.Finish();
}

Model MakeUsFlag(uint32_t variant, uint64_t) { return FlagOf(variant, 50); }
Model MakeUsFlag1950s(uint32_t variant, uint64_t) { return FlagOf(variant, 48); }

// Step van with a serving window towards +X (the kerb when parked on the right), awning and menu.
Model FoodTruckOf(const char* kind, const char* lettering, const char* picture, Vec3f tone) {
  PropBuilder b(kind);
  const Vec3f cream{0.74f, 0.68f, 0.54f};
  b.Use(Paint(tone, 0.35f));
  b.BevelBox({-1.12f, -2.3f, 0.55f}, {1.12f, 3.2f, 2.95f}, 0.10f);
  b.BevelBox({-1.05f, -3.05f, 0.55f}, {1.05f, -2.2f, 1.55f}, 0.12f);
  b.Use(Paint(cream, 0.35f));
  b.BevelBox({-1.135f, -2.25f, 0.95f}, {1.135f, 3.15f, 1.25f}, 0.01f);
  b.Use(Glass());
  b.BevelBox({-0.98f, -2.33f, 1.75f}, {0.98f, -2.25f, 2.60f}, 0.02f);
  for (float x : {-1.0f, 1.0f}) b.BevelBox({x * 1.05f - 0.085f, -2.0f, 1.65f}, {x * 1.05f + 0.085f, -1.2f, 2.45f}, 0.01f);
  b.Use(Plastic({0.015f, 0.015f, 0.016f}));
  b.BevelBox({-1.08f, -3.12f, 0.45f}, {1.08f, -2.95f, 0.72f}, 0.03f);
  b.BevelBox({-0.55f, -3.08f, 0.85f}, {0.55f, -3.03f, 1.25f}, 0.01f);
  b.BevelBox({-1.0f, -2.6f, 0.35f}, {1.0f, 3.0f, 0.6f}, 0.02f);
  for (float x : {-0.82f, 0.82f}) {
    b.Use(Glass({0.4f, 0.4f, 0.4f}));
    b.BevelBox({x - 0.16f, -3.09f, 0.95f}, {x + 0.16f, -3.03f, 1.18f}, 0.03f);
  }
  for (float x : {-1.0f, 1.0f})
    for (float y : {-2.1f, 2.0f}) AddWheel(b, {x * 1.0f, y, 0.42f}, 0.42f, 0.26f, x);
  // Serving window with a counter, dark inside, and an awning of stripes.
  b.Use(Plastic({0.03f, 0.028f, 0.025f}, 0.8f));
  b.BevelBox({1.10f, -0.7f, 1.45f}, {1.138f, 2.3f, 2.45f}, 0.004f);
  b.Use(Metal());
  b.BevelBox({1.12f, -0.8f, 1.38f}, {1.50f, 2.4f, 1.43f}, 0.01f);
  for (int i = 0; i < 10; ++i) {
    b.Use(Fabric(i % 2 ? Vec3f{0.74f, 0.72f, 0.66f} : tone));
    const float y0 = -0.8f + 0.32f * static_cast<float>(i), y1 = y0 + 0.32f;
    b.mesh().Quad({2.05f, y0, 2.35f}, {2.05f, y1, 2.35f}, {1.13f, y1, 2.75f}, {1.13f, y0, 2.75f});
    b.mesh().Quad({2.05f, y0, 2.18f}, {2.05f, y1, 2.18f}, {2.05f, y1, 2.35f}, {2.05f, y0, 2.35f});
  }
  Canvas name(512, 96, cream);
  name.Letters(lettering, {0.5f, 0.5f}, 0.62f, {0.42f, 0.04f, 0.01f}, 0.9f);
  const Texture board = name.Finish(picture);
  b.Use(Paint({1, 1, 1}), board);
  b.Picture({1.126f, -2.0f, 2.50f}, {1.126f, 3.0f, 2.50f}, {1.126f, 3.0f, 2.86f}, {1.126f, -2.0f, 2.86f});
  b.Picture({-1.126f, 2.9f, 1.6f}, {-1.126f, -1.0f, 1.6f}, {-1.126f, -1.0f, 2.35f}, {-1.126f, 2.9f, 2.35f});
  Canvas menu(160, 192, {0.012f, 0.013f, 0.012f});
  menu.Letters("MENU", {0.5f, 0.1f}, 0.1f, {0.8f, 0.55f, 0.1f});
  for (int i = 0; i < 6; ++i) {
    const float y = 0.25f + 0.12f * static_cast<float>(i);
    menu.Line({0.1f, y}, {0.65f, y}, 0.03f, {0.7f, 0.7f, 0.65f});
    menu.Line({0.78f, y}, {0.92f, y}, 0.03f, {0.7f, 0.7f, 0.65f});
  }
  b.Use(Paint({1, 1, 1}), menu.Finish("truck menu"));
  b.Picture({1.140f, 2.42f, 1.45f}, {1.140f, 3.08f, 1.45f}, {1.140f, 3.08f, 2.35f}, {1.140f, 2.42f, 2.35f});
  b.Use(Metal({0.5f, 0.5f, 0.5f}, 0.4f));
  b.BevelBox({-0.4f, 0.3f, 2.94f}, {0.4f, 1.3f, 3.20f}, 0.04f);
  b.mesh().Tube({-0.7f, 2.4f, 2.9f}, {-0.7f, 2.4f, 3.35f}, 0.09f, 0.09f, 12);
  return b.Finish();
}

Model MakeFoodTruck(uint32_t, uint64_t) { return FoodTruckOf("food_truck", "FOOD TRUCK", "food truck", {0.60f, 0.10f, 0.02f}); }
Model MakeLunchWagon(uint32_t, uint64_t) { return FoodTruckOf("food_truck_1950s", "LUNCH WAGON", "lunch wagon", {0.30f, 0.030f, 0.020f}); }

Model MakeOrangeMailbox(uint32_t, uint64_t) { return MailboxOf({0.78f, 0.20f, 0.012f}); }

// A bottle of 9 m with a cap, on a round base: an advertisement on a roof.
Model MakeGiantBottle(uint32_t, uint64_t) {
  PropBuilder b("giant_bottle");
  b.Use(Paint({0.10f, 0.10f, 0.10f}, 0.5f));
  const Vec2f base[] = {{1.9f, 0}, {1.9f, 0.35f}, {1.6f, 0.45f}, {0, 0.45f}};
  b.Lathe(base, 32);
  Material glass = Paint({0.09f, 0.022f, 0.010f}, 0.08f);
  glass.clear_coat = 1;
  b.Use(glass);
  const Vec2f body[] = {{1.15f, 0.45f}, {1.25f, 0.7f}, {1.25f, 2.0f}, {1.08f, 2.9f}, {1.06f, 3.4f}, {1.25f, 4.5f},
                        {1.22f, 5.4f},  {0.95f, 6.4f}, {0.55f, 7.4f}, {0.42f, 8.4f}, {0.42f, 8.7f}};
  b.Lathe(body, 36);
  b.Use(Paint({0.55f, 0.015f, 0.015f}, 0.3f));
  const Vec2f cap[] = {{0.47f, 8.65f}, {0.50f, 9.0f}, {0.44f, 9.1f}, {0, 9.12f}};
  b.Lathe(cap, 24);
  Canvas label(512, 128, {0.55f, 0.012f, 0.015f});
  label.Letters("COLA", {0.25f, 0.5f}, 0.62f, {0.80f, 0.80f, 0.78f}, 1.1f);
  label.Letters("COLA", {0.75f, 0.5f}, 0.62f, {0.80f, 0.80f, 0.78f}, 1.1f);
  b.Use(Paint({1, 1, 1}, 0.3f), label.Finish("cola label"));
  b.Sheet(40, 1,
          [](float u, float v) {
            const float a = kTauF * u;
            return Vec3f{1.275f * std::cos(a), 1.275f * std::sin(a), 4.15f + 1.1f * v};
          },
          {1, 1});
  return b.Finish();
}

// Projecting bank sign, purple with white letters, 5 m wide, to hang on a wall (y = 0).
Model MakeBankSign(uint32_t, uint64_t) {
  PropBuilder b("bank_sign");
  const Vec3f purple{0.17f, 0.012f, 0.36f};
  b.Use(Paint(purple, 0.35f));
  b.BevelBox({-3.0f, -0.30f, 0}, {3.0f, 0.0f, 1.5f}, 0.03f);
  Canvas c(512, 128, purple);
  c.Disc({0.11f, 0.5f}, 0.36f, {0.75f, 0.72f, 0.80f});
  c.RegularPolygon({0.11f, 0.46f}, 0.24f, 3, kTauF / 4, purple);
  c.Letters("UNION BANK", {0.59f, 0.5f}, 0.52f, {0.80f, 0.79f, 0.82f}, 0.82f);
  Material face = Paint({1, 1, 1}, 0.4f);
  face.emission = Vec3f{1, 1, 1} * (120 * kNit);
  b.Use(face, c.Finish("union bank"));
  b.Picture({-2.92f, -0.304f, 0.08f}, {2.92f, -0.304f, 0.08f}, {2.92f, -0.304f, 1.42f}, {-2.92f, -0.304f, 1.42f});
  return b.Finish();
}

// A maple in October: the generic broadleaf in red.
Model MakeRedTree(uint32_t, uint64_t seed) {
  Model model = FindPropKind("tree_generic").make(2, seed);
  for (Material& m : model.materials)
    if (m.kind == SurfaceKind::kFoliage) m.base_color = m.base_color * Vec3f{2.4f, 0.36f, 0.9f};  // of a purple-leaved maple
  return model;
}

}  // namespace

std::vector<PropKind> LandmarkKinds() {
  return {
      {"phone_booth", "construction/phone_booth", 1, MakePhoneBooth, 0.6f, 2.4f, 2.7f, 2500},
      {"us_flag", "signage/flag/usa", 2, MakeUsFlag, 0.4f, 2.3f, 9.1f, 1500},
      {"us_flag_1950s", "signage/flag/usa", 2, MakeUsFlag1950s, 0.4f, 2.3f, 9.1f, 1500},
      {"food_truck", "vehicle/food_truck", 1, MakeFoodTruck, 3.3f, 3.0f, 3.4f, 4500},
      {"food_truck_1950s", "vehicle/food_truck", 1, MakeLunchWagon, 3.3f, 3.0f, 3.4f, 4500},
      {"orange_mailbox", "furniture/mail/post_box", 1, MakeOrangeMailbox, 0.5f, 1.15f, 1.3f, 800},
      {"giant_bottle", "signage/billboard", 1, MakeGiantBottle, 2.0f, 9.0f, 9.3f, 3000},
      {"red_tree", "vegetation/tree/broadleaf/maple", 1, MakeRedTree, 1.0f, 6.5f, 14.0f, 100000},
      {"bank_sign", "signage/shop_sign", 1, MakeBankSign, 3.0f, 1.4f, 1.6f, 200},
  };
}

}  // namespace airsim360::internal
