// Kitchens. EN 1116: worktops 90 cm high and 60 deep on units of a 60 cm grid; wall cabinets 35 deep, 72 high, hung at
// 145 cm; EN 50242 dishwashers and ovens 60 cm wide.
#include <array>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

constexpr float kTop = 0.90f, kThick = 0.038f, kToe = 0.10f, kHalfDepth = 0.30f;

struct KitchenLook {
  bool timber;
  Timber wood;
  Vec3f lacquer;
  Vec3f stone;
  bool handles;
  void Use(PropBuilder& b) const { timber ? UseTimber(b, wood) : UseLacquer(b, lacquer, 0.28f); }
};
const KitchenLook& LookOf(uint32_t variant) {
  static const std::array<KitchenLook, 4> looks = {{{false, Timber::kOak, {0.74f, 0.73f, 0.71f}, {0.22f, 0.215f, 0.21f}, true},
                                                    {true, Timber::kOak, {}, {0.70f, 0.69f, 0.66f}, true},
                                                    {false, Timber::kOak, {0.10f, 0.14f, 0.13f}, {0.62f, 0.60f, 0.56f}, false},
                                                    {true, Timber::kWalnut, {}, {0.09f, 0.09f, 0.092f}, false}}};
  return looks[variant];
}

void Handle(PropBuilder& b, const KitchenLook& look, float x0, float x1, float z, float y) {
  b.Use(look.handles ? Metal({0.6f, 0.6f, 0.59f}, 0.3f) : Plastic({0.03f, 0.03f, 0.03f}, 0.3f));
  if (look.handles)
    BowHandle(b, {x0, z}, {x1, z}, y, 0.006f);
  else
    b.BevelBox({x0, y - 0.012f, z - 0.008f}, {x1, y, z + 0.008f}, 0.003f);
}

// Base unit of `width` centred at x: plinth, body, doors or drawers.
void BaseUnit(PropBuilder& b, const KitchenLook& look, float x, float width, int drawers) {
  const float half = width / 2, y0 = -kHalfDepth + 0.04f, top = kTop - kThick;
  UseLacquer(b, {0.70f, 0.69f, 0.67f});
  b.mesh().Box({x - half, y0, kToe}, {x + half, kHalfDepth, top});
  b.Use(Plastic({0.04f, 0.04f, 0.042f}, 0.4f));
  b.mesh().Box({x - half, y0 + 0.05f, 0}, {x + half, kHalfDepth, kToe});
  const float gap = 0.0016f;
  if (drawers == 0) {
    for (float s : {-1.0f, 1.0f}) {
      const float x0 = s < 0 ? x - half : x, x1 = s < 0 ? x : x + half;
      look.Use(b);
      Front(b, x0 + gap, x1 - gap, kToe + gap, top - gap, y0);
      Handle(b, look, s < 0 ? x1 - 0.15f : x0 + 0.03f, s < 0 ? x1 - 0.03f : x0 + 0.15f, top - 0.05f, y0 - 0.018f);
    }
    return;
  }
  float z1 = top;
  for (int i = 0; i < drawers; ++i) {
    const float h = i == 0 ? 0.145f : (top - kToe - 0.145f) / static_cast<float>(drawers - 1);
    look.Use(b);
    Front(b, x - half + gap, x + half - gap, z1 - h + gap, z1 - gap, y0);
    Handle(b, look, x - 0.08f, x + 0.08f, z1 - 0.05f, y0 - 0.018f);
    z1 -= h;
  }
}

void Worktop(PropBuilder& b, const KitchenLook& look, float half) {
  UseStoneTop(b, look.stone);
  b.BevelBox({-half, -kHalfDepth, kTop - kThick}, {half, kHalfDepth, kTop}, 0.004f);
}

// 1.2 m of base units and worktop: doors left, drawers right, a chopping board and jars.
Model MakeKitchenCounter(uint32_t variant, uint64_t) {
  PropBuilder b("kitchen_counter");
  const KitchenLook& look = LookOf(variant);
  BaseUnit(b, look, -0.30f, 0.60f, 0);
  BaseUnit(b, look, 0.30f, 0.60f, 3);
  Worktop(b, look, 0.60f);
  UseTimber(b, Timber::kBeech);
  b.Place(Turn(-14, 0, 0, {-0.34f, 0.235f, kTop}));
  RoundedBoard(b, {-0.13f, -0.001f}, {0.13f, 0.017f}, 0.008f, 0.004f, 0.36f, 0.006f);
  b.Place({});
  for (int i = 0; i < 3; ++i) {
    const float r = 0.045f + 0.008f * static_cast<float>(i), h = 0.11f + 0.03f * static_cast<float>(i);
    const Vec3f p{0.18f + 0.125f * static_cast<float>(i), 0.20f, kTop};
    UseCeramic(b, variant == 2 ? Vec3f{0.12f, 0.20f, 0.22f} : Vec3f{0.66f, 0.63f, 0.56f});
    const Vec2f jar[] = {{0, 0}, {r * 0.92f, 0}, {r, 0.008f}, {r, h - 0.01f}, {r * 0.95f, h}, {0, h}};
    b.Lathe(jar, 20, p);
    UseTimber(b, Timber::kBeech);
    const Vec2f lid[] = {{r * 0.9f, h}, {r * 0.93f, h + 0.006f}, {r * 0.9f, h + 0.018f}, {0, h + 0.018f}};
    b.Lathe(lid, 20, p);
  }
  return b.Finish();
}

// The same length with a bowl, a drainer, a tap; a dishwasher on the right.
Model MakeKitchenSinkCounter(uint32_t variant, uint64_t) {
  PropBuilder b("kitchen_sink_counter");
  const KitchenLook& look = LookOf(variant);
  BaseUnit(b, look, -0.30f, 0.60f, 0);
  UseBrushedSteel(b);
  const float y0 = -kHalfDepth + 0.04f;
  b.mesh().Box({0, y0, kToe}, {0.60f, kHalfDepth, kTop - kThick});
  Front(b, 0.002f, 0.598f, kToe + 0.002f, kTop - kThick - 0.002f, y0, 0.02f);
  b.Use(Plastic({0.03f, 0.03f, 0.032f}, 0.25f));
  b.BevelBox({0.03f, y0 - 0.0215f, 0.775f}, {0.57f, y0 - 0.019f, 0.845f}, 0.001f);
  b.mesh().Box({0, y0 + 0.05f, 0}, {0.60f, kHalfDepth, kToe});
  b.Use(Metal({0.6f, 0.6f, 0.59f}, 0.3f));
  BowHandle(b, {0.08f, 0.75f}, {0.52f, 0.75f}, y0 - 0.02f, 0.008f);
  // Worktop around the bowl, which is a steel tray sunk by 18 cm.
  const float bx0 = -0.52f, bx1 = -0.10f, by0 = -0.20f, by1 = 0.20f;
  UseStoneTop(b, look.stone);
  b.BevelBox({-0.60f, -kHalfDepth, kTop - kThick}, {0.60f, by0, kTop}, 0.004f);
  b.BevelBox({-0.60f, by1, kTop - kThick}, {0.60f, kHalfDepth, kTop}, 0.004f);
  b.mesh().Box({-0.60f, by0, kTop - kThick}, {bx0, by1, kTop});
  b.mesh().Box({bx1, by0, kTop - kThick}, {0.60f, by1, kTop});
  UseBrushedSteel(b, 0.22f);
  const auto bowl = RoundedRectangle({bx0, by0}, {bx1, by1}, 0.06f, 5);
  const float deep = kTop - 0.18f;
  std::vector<Vec2f> inward(bowl.rbegin(), bowl.rend());
  b.mesh().Walls(inward, deep, kTop + 0.001f);
  b.mesh().Polygon(bowl, deep, true);
  const Vec3f c{(bx0 + bx1) / 2, 0, kTop};
  for (int i = 0; i < 4; ++i) {  // the rim covers the square cut
    const bool along = i % 2 == 0;
    const float s = i < 2 ? -1.0f : 1.0f;
    if (along)
      b.BevelBox({bx0 - 0.02f, s < 0 ? by0 - 0.02f : by1 - 0.012f, kTop}, {bx1 + 0.02f, s < 0 ? by0 + 0.012f : by1 + 0.02f, kTop + 0.004f},
                 0.002f);
    else
      b.BevelBox({s < 0 ? bx0 - 0.02f : bx1 - 0.012f, by0, kTop}, {s < 0 ? bx0 + 0.012f : bx1 + 0.02f, by1, kTop + 0.004f}, 0.002f);
  }
  for (int i = 0; i < 8; ++i) {  // drainer
    const float x = 0.0f + 0.045f * static_cast<float>(i);
    b.BevelBox({x, by0 + 0.02f, kTop}, {x + 0.016f, by1 - 0.02f, kTop + 0.004f}, 0.002f);
  }
  b.Use(Chrome());
  const Vec2f foot[] = {{0.027f, 0}, {0.027f, 0.012f}, {0.016f, 0.02f}, {0.015f, 0.10f}, {0, 0.10f}};
  b.Lathe(foot, 16, {c.x, 0.245f, kTop});
  const Vec3f spout[] = {{c.x, 0.245f, kTop + 0.09f}, {c.x, 0.245f, kTop + 0.27f}, {c.x, 0.225f, kTop + 0.315f},
                         {c.x, 0.17f, kTop + 0.335f}, {c.x, 0.10f, kTop + 0.315f}, {c.x, 0.075f, kTop + 0.26f},
                         {c.x, 0.075f, kTop + 0.23f}};
  b.Bar(spout, 0.011f, 12);
  b.mesh().Tube({c.x + 0.012f, 0.245f, kTop + 0.075f}, {c.x + 0.075f, 0.235f, kTop + 0.105f}, 0.006f, 0.005f, 8);
  UseCeramic(b);
  for (int i = 0; i < 4; ++i) {  // plates in the drainer
    b.Place(Turn(0, 78, 0, {0.06f + 0.045f * static_cast<float>(i), 0.02f, kTop + 0.115f}));
    Plate(b, {}, 0.11f);
  }
  b.Place({});
  return b.Finish();
}

// Free-standing cooker: oven with a window, four plates of glass ceramic or gas burners with grates.
Model MakeStove(uint32_t variant, uint64_t) {
  PropBuilder b("stove");
  const float h = kTop, y0 = -kHalfDepth;
  variant == 1 ? UseLacquer(b, {0.74f, 0.74f, 0.73f}, 0.2f) : UseBrushedSteel(b);
  b.BevelBox({-0.298f, y0 + 0.02f, 0.02f}, {0.298f, kHalfDepth, h - 0.012f}, 0.004f);
  b.BevelBox({-0.295f, y0, 0.06f}, {0.295f, y0 + 0.03f, 0.20f}, 0.006f);
  b.BevelBox({-0.295f, y0, 0.215f}, {0.295f, y0 + 0.03f, 0.735f}, 0.006f);
  b.BevelBox({-0.298f, y0, 0.75f}, {0.298f, y0 + 0.04f, h - 0.012f}, 0.006f);
  b.Use(Plastic({0.015f, 0.015f, 0.016f}, 0.08f));
  b.BevelBox({-0.235f, y0 - 0.002f, 0.285f}, {0.235f, y0 + 0.001f, 0.61f}, 0.001f);
  b.BevelBox({-0.295f, y0 + 0.005f, h - 0.014f}, {0.295f, kHalfDepth - 0.005f, h}, 0.003f);
  b.BevelBox({-0.06f, y0 - 0.002f, 0.79f}, {0.06f, y0 + 0.001f, 0.85f}, 0.001f);
  b.Use(Metal({0.62f, 0.62f, 0.61f}, 0.25f));
  BowHandle(b, {-0.24f, 0.675f}, {0.24f, 0.675f}, y0, 0.009f);
  BowHandle(b, {-0.20f, 0.165f}, {0.20f, 0.165f}, y0, 0.007f);
  for (int i = 0; i < 6; ++i) {
    const float x = (i < 3 ? -0.25f : 0.11f) + 0.07f * static_cast<float>(i % 3);
    b.mesh().Tube({x, y0, 0.82f}, {x, y0 - 0.028f, 0.82f}, 0.020f, 0.017f, 14, false);
  }
  for (int i = 0; i < 4; ++i) {
    const Vec3f p{i % 2 ? 0.14f : -0.14f, i < 2 ? -0.13f : 0.13f, h};
    const float r = i == 0 || i == 3 ? 0.105f : 0.08f;
    if (variant != 2) {  // printed rings
      b.Use(Plastic({0.26f, 0.26f, 0.27f}, 0.2f));
      const Vec2f ring[] = {{r - 0.003f, 0.0002f}, {r - 0.003f, 0.0006f}, {r, 0.0006f}, {r, 0.0002f}};
      b.Lathe(std::array<Vec2f, 4>{ring[3], ring[2], ring[1], ring[0]}, 32, p);
      continue;
    }
    b.Use(CastIron());
    const Vec2f burner[] = {{r * 0.42f, 0}, {r * 0.42f, 0.012f}, {r * 0.36f, 0.018f}, {0, 0.018f}};
    b.Lathe(burner, 18, p);
    for (int k = 0; k < 4; ++k) {
      const Vec3f d = Around(k, 4, 0.785f);
      const Vec3f grate[] = {p + d * (r * 1.15f), p + d * (r * 1.15f) + Vec3f{0, 0, 0.03f}, p + d * (r * 0.2f) + Vec3f{0, 0, 0.034f}};
      b.Bar(grate, 0.006f, 6);
    }
  }
  if (variant == 0) {  // a pot with its lid
    UseBrushedSteel(b, 0.2f);
    const Vec2f pot[] = {{0, 0.001f},     {0.098f, 0.001f}, {0.10f, 0.006f},  {0.10f, 0.125f}, {0.105f, 0.13f}, {0.09f, 0.142f},
                         {0.03f, 0.155f}, {0.01f, 0.157f},  {0.018f, 0.172f}, {0.012f, 0.18f}, {0, 0.18f}};
    b.Lathe(pot, 28, {-0.14f, -0.13f, h});
  }
  b.Use(Plastic({0.03f, 0.03f, 0.03f}));
  b.mesh().Box({-0.28f, y0 + 0.06f, 0}, {0.28f, kHalfDepth - 0.02f, 0.03f});
  return b.Finish();
}

Model MakeFridge(uint32_t variant, uint64_t) {
  PropBuilder b("fridge");
  const float half = variant == 2 ? 0.455f : 0.298f, y1 = 0.33f, y0 = variant == 2 ? -0.34f : -0.30f;
  const float top = std::array{1.86f, 1.72f, 1.79f}[variant], split = std::array{0.72f, 1.22f, 0.70f}[variant];
  const auto skin = [&] { variant == 1 ? UseLacquer(b, {0.76f, 0.76f, 0.75f}, 0.22f) : UseBrushedSteel(b, 0.32f); };
  b.Use(Plastic({0.30f, 0.30f, 0.31f}, 0.4f));
  b.BevelBox({-half, y0 + 0.055f, 0.03f}, {half, y1, top}, 0.004f);
  b.Use(Plastic({0.02f, 0.02f, 0.021f}));
  b.mesh().Box({-half + 0.01f, y0 + 0.09f, 0}, {half - 0.01f, y1 - 0.02f, 0.05f});
  skin();
  const int doors = variant == 2 ? 2 : 1;
  for (int d = 0; d < doors; ++d) {
    const float x0 = doors == 1 ? -half : d ? 0.002f : -half, x1 = doors == 1 ? half : d ? half : -0.002f;
    SoftBox(b, {x0, y0, split + 0.004f}, {x1, y0 + 0.05f, top - 0.002f}, {.round = 0.012f, .crown = 0.003f, .cells = 6});
    if (variant != 2) SoftBox(b, {x0, y0, 0.05f}, {x1, y0 + 0.05f, split - 0.004f}, {.round = 0.012f, .crown = 0.003f, .cells = 6});
  }
  if (variant == 2) SoftBox(b, {-half, y0, 0.05f}, {half, y0 + 0.05f, split - 0.004f}, {.round = 0.012f, .crown = 0.003f, .cells = 6});
  b.Use(Metal({0.58f, 0.58f, 0.57f}, 0.25f));
  if (variant == 2) {
    for (float x : {-0.045f, 0.045f}) BowHandle(b, {x, split + 0.12f}, {x, split + 0.72f}, y0, 0.010f);
    BowHandle(b, {-0.30f, split - 0.07f}, {0.30f, split - 0.07f}, y0, 0.010f);
  } else {
    BowHandle(b, {-half + 0.045f, split + 0.08f}, {-half + 0.045f, split + 0.42f}, y0, 0.009f);
    BowHandle(b, {-half + 0.045f, split - 0.38f}, {-half + 0.045f, split - 0.06f}, y0, 0.009f);
  }
  if (variant == 1) {  // notes under magnets
    const Vec3f tones[3] = {{0.72f, 0.66f, 0.30f}, {0.66f, 0.66f, 0.64f}, {0.45f, 0.58f, 0.66f}};
    for (int i = 0; i < 3; ++i) {
      const float x = -0.02f + 0.09f * static_cast<float>(i), z = 1.42f + 0.05f * static_cast<float>((i * 2) % 3);
      b.Use(Paint(tones[i], 0.8f));
      b.BevelBox({x, y0 - 0.0045f, z}, {x + 0.075f, y0 - 0.0035f, z + 0.10f}, 0.0004f);
      b.Use(Plastic({0.5f, 0.05f, 0.04f}));
      b.mesh().Tube({x + 0.037f, y0 - 0.004f, z + 0.085f}, {x + 0.037f, y0 - 0.010f, z + 0.085f}, 0.009f, 0.009f, 10, false);
    }
  }
  return b.Finish();
}

Model MakeWallCabinet(uint32_t variant, uint64_t) {
  PropBuilder b("wall_cabinet");
  const KitchenLook& look = LookOf(variant);
  const float half = 0.30f, depth = 0.35f, h = 0.72f;
  if (variant == 1) {  // open shelves with dishes
    look.Use(b);
    for (float x : {-half, half - 0.018f}) b.BevelBox({x, -depth, 0}, {x + 0.018f, 0, h}, 0.002f);
    for (float z : {0.0f, 0.35f, h - 0.018f})
      b.BevelBox({-half + 0.018f, -depth + 0.002f, z}, {half - 0.018f, -0.008f, z + 0.018f}, 0.002f);
    b.mesh().Box({-half + 0.018f, -0.008f, 0}, {half - 0.018f, 0, h});
    UseCeramic(b);
    for (int i = 0; i < 6; ++i) Plate(b, {-0.13f, -0.18f, 0.019f + 0.011f * static_cast<float>(i)}, 0.115f);
    for (int i = 0; i < 3; ++i) Bowl(b, {0.13f, -0.18f, 0.019f + 0.022f * static_cast<float>(i)}, 0.08f, 0.06f);
    UseCeramic(b, {0.20f, 0.28f, 0.32f});
    for (int i = 0; i < 4; ++i)
      Cup(b, {-0.19f + 0.12f * static_cast<float>(i), -0.16f - 0.03f * static_cast<float>(i % 2), 0.369f}, 0.042f, 0.09f);
    return b.Finish();
  }
  UseLacquer(b, {0.70f, 0.69f, 0.67f});
  b.mesh().Box({-half, -depth + 0.018f, 0}, {half, 0, h});
  for (float s : {-1.0f, 1.0f}) {
    const float x0 = s < 0 ? -half : 0.0f, x1 = s < 0 ? 0.0f : half;
    look.Use(b);
    Front(b, x0 + 0.0016f, x1 - 0.0016f, 0.0016f, h - 0.0016f, -depth + 0.018f);
    Handle(b, look, s < 0 ? x1 - 0.15f : x0 + 0.03f, s < 0 ? x1 - 0.03f : x0 + 0.15f, 0.05f, -depth);
  }
  return b.Finish();
}

Model MakeMicrowave(uint32_t variant, uint64_t) {
  PropBuilder b("microwave");
  variant == 0 ? UseBrushedSteel(b) : b.Use(Plastic(variant == 1 ? Vec3f{0.03f, 0.03f, 0.032f} : Vec3f{0.72f, 0.72f, 0.71f}, 0.3f));
  b.BevelBox({-0.24f, -0.17f, 0.012f}, {0.24f, 0.18f, 0.28f}, 0.008f);
  b.BevelBox({-0.235f, -0.185f, 0.018f}, {0.105f, -0.165f, 0.275f}, 0.006f);
  b.BevelBox({0.11f, -0.182f, 0.018f}, {0.236f, -0.165f, 0.275f}, 0.006f);
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.07f));
  b.BevelBox({-0.205f, -0.187f, 0.055f}, {0.065f, -0.184f, 0.24f}, 0.001f);
  b.BevelBox({0.125f, -0.184f, 0.225f}, {0.222f, -0.181f, 0.26f}, 0.001f);
  b.Use(Metal());
  const Vec3f handle[] = {{0.088f, -0.185f, 0.06f}, {0.088f, -0.212f, 0.07f}, {0.088f, -0.212f, 0.225f}, {0.088f, -0.185f, 0.235f}};
  b.Bar(handle, 0.006f, 8);
  b.Use(Plastic({0.45f, 0.45f, 0.45f}, 0.4f));
  for (int i = 0; i < 12; ++i) {
    const float x = 0.132f + 0.031f * static_cast<float>(i % 3), z = 0.10f + 0.026f * static_cast<float>(i / 3);
    b.BevelBox({x, -0.185f, z}, {x + 0.022f, -0.182f, z + 0.016f}, 0.001f);
  }
  b.mesh().Tube({0.173f, -0.182f, 0.06f}, {0.173f, -0.20f, 0.06f}, 0.022f, 0.020f, 18, false);
  b.Use(Rubber());
  for (float x : {-0.2f, 0.2f})
    for (float y : {-0.14f, 0.14f}) b.mesh().Tube({x, y, 0}, {x, y, 0.014f}, 0.012f, 0.014f, 10);
  return b.Finish();
}

}  // namespace

FurnishingRows KitchenRows() {
  return {{{"kitchen_counter", "furniture/counter", 4, MakeKitchenCounter, 0.7f, 0.90f, 1.30f, 3000}},
          {{"kitchen_sink_counter", "furniture/sink", 4, MakeKitchenSinkCounter, 0.7f, 0.90f, 1.30f, 3500}},
          {{"stove", "furniture/kitchen/stove", 3, MakeStove, 0.45f, 0.88f, 1.10f, 3500}},
          {{"fridge", "furniture/electronics/refrigerator", 3, MakeFridge, 0.6f, 1.60f, 1.95f, 3000}},
          {{"wall_cabinet", "furniture/cabinet", 4, MakeWallCabinet, 0.4f, 0.70f, 0.75f, 6500}, Mount::kWall, 1.45f},
          {{"microwave", "furniture/kitchen/microwave", 3, MakeMicrowave, 0.32f, 0.26f, 0.32f, 1800}, Mount::kSurface}};
}

}  // namespace airsim360::internal
