// Cars, cabs, panel trucks and buses of the 1950s: round bodies, chrome, white walls, fins, coats of two colours.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/worlds/props/car_shape.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"

namespace airsim360::internal {
namespace {

// clang-format off
// A sedan of about 1950: high bonnet, round back.
const CarShape& RoundSedan() {
  static const CarShape shape{{{-2.34f, 0.66f}, {-2.31f, 0.78f}, {-2.16f, 0.93f}, {-1.7f, 1.03f}, {-1.05f, 1.10f}, {-0.90f, 1.13f}, {-0.42f, 1.50f}, {-0.15f, 1.575f}, {0.35f, 1.60f}, {0.8f, 1.565f}, {1.15f, 1.46f}, {1.62f, 1.12f}, {1.9f, 1.00f}, {2.16f, 0.87f}, {2.30f, 0.72f}, {2.34f, 0.60f}},
                              {{-2.34f, 0.60f}, {-2.2f, 0.82f}, {-1.9f, 0.91f}, {-1.2f, 0.98f}, {-0.8f, 1.02f}, {0.6f, 1.04f}, {1.4f, 1.02f}, {1.9f, 0.93f}, {2.2f, 0.78f}, {2.34f, 0.56f}},
                              {{-2.34f, 0.60f}, {-2.27f, 0.76f}, {-2.05f, 0.87f}, {-1.7f, 0.92f}, {-0.8f, 0.93f}, {0.9f, 0.93f}, {1.7f, 0.91f}, {2.05f, 0.84f}, {2.25f, 0.74f}, {2.34f, 0.58f}},
                              0.60f, -1.46f, 1.40f, 0.36f, {-0.88f, -0.46f}, {1.16f, 1.56f}, {-0.70f, 1.24f},
                              {{0.24f, 0.32f}, {0.92f, 1.00f}}};
  return shape;
}

// A hardtop of the later years: low roof, long straight tail.
const CarShape& Hardtop() {
  static const CarShape shape{{{-2.36f, 0.68f}, {-2.33f, 0.80f}, {-2.2f, 0.91f}, {-1.7f, 0.97f}, {-1.0f, 1.00f}, {-0.90f, 1.03f}, {-0.48f, 1.37f}, {-0.2f, 1.455f}, {0.3f, 1.485f}, {0.75f, 1.455f}, {1.02f, 1.38f}, {1.38f, 1.04f}, {1.7f, 0.985f}, {2.15f, 0.93f}, {2.32f, 0.83f}, {2.36f, 0.64f}},
                              {{-2.36f, 0.62f}, {-2.22f, 0.83f}, {-1.9f, 0.89f}, {-1.0f, 0.93f}, {0.5f, 0.935f}, {1.2f, 0.95f}, {1.9f, 0.97f}, {2.25f, 0.95f}, {2.36f, 0.68f}},
                              {{-2.36f, 0.66f}, {-2.28f, 0.82f}, {-2.05f, 0.90f}, {-1.6f, 0.935f}, {-0.6f, 0.94f}, {1.3f, 0.94f}, {1.9f, 0.92f}, {2.2f, 0.86f}, {2.36f, 0.72f}},
                              0.62f, -1.46f, 1.42f, 0.35f, {-0.88f, -0.50f}, {1.05f, 1.36f}, {-0.72f, 1.06f},
                              {{0.28f, 0.31f}}};
  return shape;
}

// An estate car.
const CarShape& Wagon() {
  static const CarShape shape{{{-2.34f, 0.68f}, {-2.31f, 0.80f}, {-2.16f, 0.93f}, {-1.7f, 1.02f}, {-1.05f, 1.07f}, {-0.90f, 1.10f}, {-0.44f, 1.47f}, {-0.15f, 1.56f}, {0.6f, 1.59f}, {1.7f, 1.57f}, {2.05f, 1.52f}, {2.22f, 1.20f}, {2.31f, 1.02f}, {2.34f, 0.70f}},
                              {{-2.34f, 0.62f}, {-2.2f, 0.84f}, {-1.9f, 0.91f}, {-1.2f, 0.97f}, {-0.8f, 1.00f}, {1.0f, 1.02f}, {1.9f, 1.01f}, {2.25f, 0.96f}, {2.34f, 0.66f}},
                              {{-2.34f, 0.62f}, {-2.27f, 0.78f}, {-2.05f, 0.88f}, {-1.7f, 0.925f}, {-0.8f, 0.935f}, {1.4f, 0.935f}, {1.9f, 0.91f}, {2.2f, 0.86f}, {2.34f, 0.76f}},
                              0.64f, -1.46f, 1.40f, 0.36f, {-0.88f, -0.48f}, {2.06f, 2.20f}, {-0.70f, 1.98f},
                              {{0.24f, 0.32f}, {1.06f, 1.14f}}};
  return shape;
}

const CarShape& PanelTruck() {
  static const CarShape shape{{{-2.55f, 0.78f}, {-2.50f, 1.00f}, {-2.3f, 1.16f}, {-1.6f, 1.27f}, {-1.42f, 1.31f}, {-1.05f, 1.86f}, {-0.80f, 2.02f}, {-0.3f, 2.14f}, {1.9f, 2.16f}, {2.32f, 2.06f}, {2.50f, 1.74f}, {2.55f, 0.90f}},
                              {{-2.55f, 0.72f}, {-2.35f, 0.98f}, {-1.6f, 1.12f}, {-1.0f, 1.18f}, {2.3f, 1.20f}, {2.55f, 0.86f}},
                              {{-2.55f, 0.62f}, {-2.45f, 0.78f}, {-2.2f, 0.90f}, {-1.7f, 0.95f}, {-1.0f, 0.97f}, {2.2f, 0.97f}, {2.45f, 0.92f}, {2.55f, 0.84f}},
                              0.80f, -1.70f, 1.55f, 0.39f, {-1.40f, -1.06f}, {9, 9}, {-1.28f, -0.42f},
                              {}};
  return shape;
}

const CarShape& OldBus() {
  static const CarShape shape{{{-5.70f, 0.9f}, {-5.66f, 1.30f}, {-5.58f, 1.52f}, {-5.30f, 2.46f}, {-5.10f, 2.72f}, {-4.6f, 2.88f}, {-3.5f, 2.92f}, {4.4f, 2.92f}, {5.0f, 2.82f}, {5.40f, 2.50f}, {5.60f, 1.95f}, {5.70f, 1.0f}},
                              {{-5.70f, 0.8f}, {-5.55f, 1.24f}, {-5.2f, 1.32f}, {5.2f, 1.32f}, {5.6f, 1.2f}, {5.70f, 0.9f}},
                              {{-5.70f, 0.90f}, {-5.60f, 1.06f}, {-5.3f, 1.18f}, {-4.9f, 1.24f}, {4.9f, 1.24f}, {5.4f, 1.14f}, {5.62f, 1.0f}, {5.70f, 0.86f}},
                              1.04f, -3.45f, 2.85f, 0.48f, {-5.56f, -5.32f}, {9, 9}, {-4.95f, 4.85f},
                              {{-3.90f, -3.82f}, {-2.80f, -2.72f}, {-1.70f, -1.62f}, {-0.60f, -0.52f}, {0.50f, 0.58f}, {1.60f, 1.68f}, {2.70f, 2.78f}, {3.80f, 3.88f}}, true};
  return shape;
}
// clang-format on

constexpr Vec3f kCream{0.62f, 0.56f, 0.42f}, kIvory{0.66f, 0.64f, 0.57f}, kInk{0.012f, 0.013f, 0.015f}, kMaroon{0.11f, 0.010f, 0.014f},
    kForest{0.014f, 0.055f, 0.030f}, kNavy{0.012f, 0.024f, 0.080f}, kTurquoise{0.06f, 0.33f, 0.33f}, kSeafoam{0.22f, 0.40f, 0.30f},
    kCoral{0.50f, 0.13f, 0.10f}, kSky{0.17f, 0.29f, 0.42f}, kDove{0.17f, 0.175f, 0.18f}, kTan{0.32f, 0.23f, 0.14f},
    kCabYellow{0.72f, 0.40f, 0.015f};

// A tyre with a white wall, a painted rim and a chrome cap.
void AddWhiteWall(PropBuilder& b, Vec3f hub, float radius, float width, float outside, const Material& rim_paint) {
  b.Place(Turn(0, outside > 0 ? 90.0f : -90.0f, 0, hub));
  const float r = radius, h = width / 2, rim = 0.60f * radius;
  b.Use(Rubber());
  const Vec2f tyre[] = {{rim, -h * 0.9f}, {r * 0.92f, -h},        {r * 0.99f, -h * 0.7f}, {r, -h * 0.4f},
                        {r, h * 0.4f},    {r * 0.99f, h * 0.75f}, {r * 0.90f, h},         {r * 0.84f, h * 1.02f}};
  b.Lathe(tyre, 22);
  b.Use(Paint({0.62f, 0.61f, 0.58f}, 0.7f));
  const Vec2f wall[] = {{r * 0.84f, h * 1.02f}, {rim, h * 0.92f}};
  b.Lathe(wall, 22);
  b.Use(rim_paint);
  const Vec2f dish[] = {{rim, h * 0.92f}, {rim * 0.92f, h * 0.55f}, {rim * 0.62f, h * 0.50f}};
  b.Lathe(dish, 18);
  b.Use(Chrome());
  const Vec2f cap[] = {
      {rim * 0.68f, h * 0.5f}, {rim * 0.66f, h * 0.70f}, {rim * 0.45f, h * 0.95f}, {rim * 0.15f, h * 1.08f}, {0, h * 1.10f}};
  b.Lathe(cap, 16);
  b.Place({});
}

// A chrome bumper around the end at y (`way` -1: the nose), with two overriders.
void AddBumper(PropBuilder& b, const CarShape& s, float y, float way, float z) {
  const float w = Lookup(s.width, y - way * 0.5f) + 0.03f;
  std::vector<Vec3f> path;
  for (int i = 0; i <= 10; ++i) {
    const float t = -1 + 2 * static_cast<float>(i) / 10, bend = t * t * t * t;
    path.push_back({w * t, y + way * (0.075f - 0.42f * bend), z});
  }
  b.Use(Chrome());
  for (float lift : {-0.045f, 0.045f}) {
    std::vector<Vec3f> bar = path;
    for (Vec3f& p : bar) p.z += lift;
    b.Bar(bar, 0.058f, 6);
  }
  for (float x : {-0.34f, 0.34f})
    b.BevelBox({x - 0.045f, y + std::min(0.0f, way * 0.16f), z - 0.11f}, {x + 0.045f, y + std::max(0.0f, way * 0.16f), z + 0.17f}, 0.03f);
}

// Grille of chrome bars in a dark mouth, head lamps in bezels, the ornament on the bonnet.
void AddFace(PropBuilder& b, const CarShape& s, uint32_t variant) {
  const float nose = s.top.front().x, high = Lookup(s.top, nose + 0.05f), w = Lookup(s.width, nose + 0.10f);
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.5f));
  b.BevelBox({-0.56f, nose - 0.02f, 0.48f}, {0.56f, nose + 0.2f, high - 0.10f}, 0.03f);
  b.Use(Chrome());
  const int bars = 3 + static_cast<int>(variant % 2);
  for (int i = 0; i < bars; ++i) {
    const float z = 0.51f + (high - 0.66f) * static_cast<float>(i) / static_cast<float>(bars - 1);
    b.BevelBox({-0.58f, nose - 0.045f, z - 0.014f}, {0.58f, nose + 0.02f, z + 0.014f}, 0.008f);
  }
  for (int i = 0; variant % 3 == 0 && i < 7; ++i) {
    const float x = -0.45f + 0.15f * static_cast<float>(i);
    b.BevelBox({x - 0.02f, nose - 0.06f, 0.50f}, {x + 0.02f, nose, high - 0.13f}, 0.01f);
  }
  for (float x : {-1.0f, 1.0f}) {
    const Vec3f c{x * (w - 0.13f), nose + 0.09f, std::min(0.80f, high + 0.02f)};
    b.Use(Chrome());
    b.Place(Turn(90, 0, 0, c));
    const Vec2f bezel[] = {{0.14f, -0.06f}, {0.145f, 0.05f}, {0.13f, 0.09f}, {0.112f, 0.085f}};
    b.Lathe(bezel, 20);
    b.Place({});
    b.Use(Glass({0.36f, 0.36f, 0.34f}));
    b.mesh().Sphere(c + Vec3f{0, -0.055f, 0}, {0.115f, 0.075f, 0.115f}, 8, 16);
  }
  b.Use(Chrome());
  const Vec3f ornament[] = {{0, nose + 0.22f, Lookup(s.top, nose + 0.22f) + 0.03f},
                            {0, nose + 0.32f, Lookup(s.top, nose + 0.32f) + 0.075f},
                            {0, nose + 0.70f, Lookup(s.top, nose + 0.70f) + 0.035f}};
  const float thick[] = {0.012f, 0.022f, 0.010f};
  b.Bar(ornament, thick, 8);
}

// A bright line along both flanks between y0 and y1, `below` the shoulder.
void AddSpear(PropBuilder& b, const CarShape& s, float y0, float y1, float below, float radius) {
  b.Use(Chrome());
  for (float side : {-1.0f, 1.0f}) {
    std::vector<Vec3f> path;
    for (int i = 0; i <= 10; ++i) {
      const float y = y0 + (y1 - y0) * static_cast<float>(i) / 10;
      path.push_back({side * (Lookup(s.width, y) * (below < 0 ? 0.95f : 0.995f) + 0.004f), y, Lookup(s.belt, y) - below});
    }
    b.Bar(path, radius, 5);
  }
}

void AddPlate(PropBuilder& b, float y, float z, float way) {
  Canvas plate(128, 64, {0.60f, 0.30f, 0.02f});
  plate.Letters("3K 41-60", {0.5f, 0.5f}, 0.36f, {0.02f, 0.02f, 0.02f});
  b.Use(Paint({1, 1, 1}), plate.Finish("plate 1950s"));
  b.Picture({way * 0.15f, y, z}, {-way * 0.15f, y, z}, {-way * 0.15f, y, z + 0.14f}, {way * 0.15f, y, z + 0.14f});
}

// Tail lamps; with fins the lamp stands at their end.
void AddTail(PropBuilder& b, const CarShape& s, const Material& paint, bool fins) {
  const float tail = s.top.back().x;
  for (float x : {-1.0f, 1.0f}) {
    const float at = x * (Lookup(s.width, tail - 0.10f) - 0.10f);
    if (fins) {
      // A blade over the rear wing, in the plane of y and z.
      b.Use(paint);
      b.Place(AffineTransform{Mat3f::FromColumns({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {}});
      const float z = Lookup(s.belt, 1.9f) - 0.10f;
      const Vec2f blade[] = {
          {1.05f, z}, {tail - 0.03f, z - 0.06f}, {tail + 0.05f, z + 0.25f}, {tail - 0.10f, z + 0.27f}, {1.75f, z + 0.17f}};
      const float inner = at - x * 0.02f;
      b.Prism(blade, inner - 0.035f, inner + 0.035f);
      b.Place({});
    }
    const float z = fins ? 0.94f : 0.74f;
    b.Use(Chrome());
    b.mesh().Sphere({at, tail - 0.03f, z}, {0.095f, 0.07f, fins ? 0.15f : 0.115f}, 8, 14);
    b.Use(Glass({0.32f, 0.010f, 0.008f}));
    b.mesh().Sphere({at, tail + 0.01f, z}, {0.072f, 0.07f, fins ? 0.125f : 0.09f}, 8, 14);
  }
}

// What all of them have below and around: the dark underside, bumpers, wheels, a mirror, plates.
void AddRunningGear(PropBuilder& b, const CarShape& s, const Material& paint) {
  const float nose = s.top.front().x, tail = s.top.back().x, inner = Lookup(s.width, 0) - 0.28f;
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.5f));
  b.BevelBox({-inner, nose + 0.25f, 0.18f}, {inner, tail - 0.25f, 0.68f}, 0.05f);
  AddBumper(b, s, nose, -1, 0.42f);
  AddBumper(b, s, tail, 1, 0.44f);
  for (float x : {-1.0f, 1.0f})
    for (float y : {s.front_axle, s.rear_axle})
      AddWhiteWall(b, {x * (Lookup(s.width, y) - 0.145f), y, s.wheel_radius}, s.wheel_radius, 0.18f, x, paint);
  const float y = s.side_glass.from + 0.05f;
  b.Use(Chrome());
  b.mesh().Sphere({Lookup(s.width, y) + 0.05f, y, Lookup(s.belt, y) + 0.10f}, {0.06f, 0.03f, 0.06f}, 6, 12);
  AddPlate(b, nose - 0.10f, 0.33f, -1);
  AddPlate(b, tail + 0.085f, 0.55f, 1);
}

void AddCar1950s(PropBuilder& b, const CarShape& s, const CarCoats& coats, uint32_t variant, bool fins) {
  AddCarBody(b, s, coats);
  AddRunningGear(b, s, coats.body);
  AddFace(b, s, variant);
  AddTail(b, s, coats.body, fins);
  AddSpear(b, s, s.side_glass.from - 0.1f, s.side_glass.to, -0.012f, 0.012f);
  AddSpear(b, s, s.front_axle - 0.3f, s.top.back().x - 0.25f, fins ? 0.17f : 0.24f, 0.016f);
}

CarCoats Coats(Vec3f body, Vec3f roof, bool swept) {
  const Material paint = CarPaint(body), second = CarPaint(roof);
  return {paint, second, swept ? second : paint, swept ? CarRange{0.35f, 2.1f} : CarRange{0, 0}};
}

Model MakeCar1950s(uint32_t variant, uint64_t) {
  struct Look {
    Vec3f body, roof;
    int shape;  // 0 round sedan, 1 hardtop, 2 estate
  };
  static constexpr Look kLooks[12] = {{kInk, kInk, 0},       {kTurquoise, kIvory, 1}, {kForest, kForest, 0}, {kCream, kCoral, 1},
                                      {kMaroon, kMaroon, 0}, {kSky, kIvory, 2},       {kDove, kDove, 0},     {kSeafoam, kCream, 1},
                                      {kNavy, kDove, 0},     {kInk, kIvory, 1},       {kTan, kCream, 2},     {kCoral, kIvory, 1}};
  const Look& look = kLooks[variant];
  const CarShape* shapes[] = {&RoundSedan(), &Hardtop(), &Wagon()};
  PropBuilder b("car_1950s");
  AddCar1950s(b, *shapes[look.shape], Coats(look.body, look.roof, look.shape == 1), variant, look.shape == 1);
  return b.Finish();
}

// Squares along both flanks.
void AddChecks(PropBuilder& b, const CarShape& s) {
  Canvas checks(256, 16, {0.70f, 0.68f, 0.60f});
  for (int i = 0; i < 32; ++i) {
    const float x = static_cast<float>(i) / 32, y = i % 2 ? 0.5f : 0.0f;
    checks.Rectangle({x, y}, {x + 1.0f / 32, y + 0.5f}, {0.012f, 0.012f, 0.012f});
  }
  b.Use(Paint({1, 1, 1}, 0.4f), checks.Finish("checks"));
  for (float x : {-1.0f, 1.0f}) {
    const float w = x * (Lookup(s.width, 0) + 0.006f);
    b.Picture({w, x * -0.85f, 0.80f}, {w, x * 0.85f, 0.80f}, {w, x * 0.85f, 0.90f}, {w, x * -0.85f, 0.90f});
  }
}

// A cab with its lamp on the roof.
Model MakeTaxi1950s(uint32_t variant, uint64_t) {
  static constexpr std::array<std::array<Vec3f, 2>, 4> kTones = {
      {{kCabYellow, kCabYellow}, {kCabYellow, {0.36f, 0.025f, 0.015f}}, {kCabYellow, kInk}, {kForest, kCream}}};
  PropBuilder b("taxi_1950s");
  const CarShape& s = RoundSedan();
  AddCar1950s(b, s, Coats(kTones[variant][0], kTones[variant][1], false), variant, false);
  AddChecks(b, s);
  const float roof = Lookup(s.top, 0.0f);
  b.Use(Chrome());
  b.BevelBox({-0.17f, -0.16f, roof - 0.02f}, {0.17f, 0.02f, roof + 0.045f}, 0.02f);
  Canvas canvas(128, 56, {0.80f, 0.62f, 0.25f});
  canvas.Letters("TAXI", {0.5f, 0.5f}, 0.6f, {0.05f, 0.02f, 0.01f});
  Material sign = Paint({1, 1, 1});
  sign.emission = Vec3f{1, 0.85f, 0.6f} * (220 * kNit);
  sign.lamp = true;
  b.Use(sign, canvas.Finish("taxi lamp"));
  b.Picture({-0.15f, -0.162f, roof + 0.03f}, {0.15f, -0.162f, roof + 0.03f}, {0.13f, -0.13f, roof + 0.15f}, {-0.13f, -0.13f, roof + 0.15f});
  b.Picture({0.15f, 0.022f, roof + 0.03f}, {-0.15f, 0.022f, roof + 0.03f}, {-0.13f, -0.01f, roof + 0.15f}, {0.13f, -0.01f, roof + 0.15f});
  b.Use(Chrome());
  b.BevelBox({-0.14f, -0.13f, roof + 0.145f}, {0.14f, -0.01f, roof + 0.165f}, 0.008f);
  return b.Finish();
}

// The name of a firm, painted on both sides.
Model MakePanelTruck(uint32_t variant, uint64_t) {
  struct Firm {
    Vec3f body, roof, letters;
    const char *name, *trade;
  };
  static constexpr Firm kFirms[3] = {{kForest, kForest, kCream, "HALLORAN", "HAND LAUNDRY"},
                                     {kIvory, kIvory, kNavy, "DAIRYFIELD", "MILK & CREAM"},
                                     {kMaroon, kInk, {0.58f, 0.42f, 0.12f}, "WEBER & SONS", "BREAD AND ROLLS"}};
  const Firm& firm = kFirms[variant];
  PropBuilder b("van_1950s");
  const CarShape& s = PanelTruck();
  AddCarBody(b, s, Coats(firm.body, firm.roof, false));
  AddRunningGear(b, s, CarPaint(firm.body));
  AddFace(b, s, variant);
  AddTail(b, s, CarPaint(firm.body), false);
  Canvas c(384, 96, firm.roof == firm.body ? firm.body : firm.roof);
  c.Letters(firm.name, {0.5f, 0.34f}, 0.38f, firm.letters, 0.85f);
  c.Letters(firm.trade, {0.5f, 0.78f}, 0.20f, firm.letters, 0.85f);
  b.Use(Paint({1, 1, 1}, 0.35f), c.Finish(std::string("truck ") + firm.name));
  // On the slanting upper half of the panel, a hand's breadth behind the cab.
  for (float x : {-1.0f, 1.0f}) {
    const auto at = [&](float y, float z) { return Vec3f{x * (z < 1.4f ? 0.945f : 0.885f), y, z}; };
    const float front = x > 0 ? -0.15f : 2.0f, back = x > 0 ? 2.0f : -0.15f;
    b.Picture(at(front, 1.26f), at(back, 1.26f), at(back, 1.76f), at(front, 1.76f));
  }
  return b.Finish();
}

// A city bus with round ends: cream above, a colour below, its line on a blind.
Model MakeBus1950s(uint32_t variant, uint64_t) {
  PropBuilder b("bus_1950s");
  const CarShape& s = OldBus();
  const Vec3f tone = variant ? Vec3f{0.30f, 0.030f, 0.020f} : Vec3f{0.025f, 0.13f, 0.075f};
  AddCarBody(b, s, {CarPaint(tone), CarPaint(kCream), CarPaint(tone)});
  const float nose = s.top.front().x, tail = s.top.back().x;
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.5f));
  b.BevelBox({-1.0f, nose + 0.3f, 0.24f}, {1.0f, tail - 0.3f, 0.9f}, 0.05f);
  AddBumper(b, s, nose, -1, 0.48f);
  AddBumper(b, s, tail, 1, 0.48f);
  for (float x : {-1.0f, 1.0f}) {
    for (float y : {s.front_axle, s.rear_axle})
      AddWhiteWall(b, {x * (Lookup(s.width, y) - 0.18f), y, 0.48f}, 0.48f, 0.28f, x, CarPaint(tone));
    const float lamp = x * (Lookup(s.width, nose + 0.12f) - 0.20f);
    b.Use(Chrome());
    b.mesh().Sphere({lamp, nose + 0.04f, 0.86f}, {0.15f, 0.09f, 0.15f}, 8, 16);
    b.Use(Glass({0.36f, 0.36f, 0.34f}));
    b.mesh().Sphere({lamp, nose - 0.02f, 0.86f}, {0.115f, 0.07f, 0.115f}, 8, 16);
    b.Use(Glass({0.32f, 0.010f, 0.008f}));
    b.mesh().Sphere({x * (Lookup(s.width, tail - 0.1f) - 0.14f), tail - 0.01f, 0.98f}, {0.08f, 0.06f, 0.08f}, 8, 14);
  }
  AddSpear(b, s, -5.1f, 5.1f, 0.06f, 0.02f);
  AddSpear(b, s, -5.1f, 5.1f, 0.50f, 0.02f);
  Canvas blind(256, 48, {0.010f, 0.010f, 0.010f});
  blind.Letters(variant ? "24 GROVE AVE" : "7 MARKET ST", {0.5f, 0.5f}, 0.62f, {0.62f, 0.60f, 0.52f});
  Material roller = Paint({1, 1, 1}, 0.6f);
  roller.emission = Vec3f{1, 0.85f, 0.6f} * (90 * kNit);
  roller.lamp = true;
  b.Use(roller, blind.Finish(variant ? "blind 24" : "blind 7"));
  const float y0 = -5.36f, y1 = -5.17f;
  b.Picture({-0.60f, y0, 2.46f}, {0.60f, y0, 2.46f}, {0.60f, y1, 2.72f}, {-0.60f, y1, 2.72f});
  return b.Finish();
}

}  // namespace

std::vector<PropKind> Cars1950sKinds() {
  return {
      {"car_1950s", "vehicle/car", 12, MakeCar1950s, 2.5f, 1.4f, 1.7f, 9000},
      {"taxi_1950s", "vehicle/car", 4, MakeTaxi1950s, 2.5f, 1.6f, 1.9f, 9000},
      {"van_1950s", "vehicle/van", 3, MakePanelTruck, 3.1f, 2.1f, 2.3f, 9000},
      {"bus_1950s", "vehicle/bus", 2, MakeBus1950s, 7.2f, 2.8f, 3.1f, 9500},
  };
}

}  // namespace airsim360::internal
