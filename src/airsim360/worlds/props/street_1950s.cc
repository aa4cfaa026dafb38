// What stood on the pavements of New York in the 1950s: lamps on crooks, signals of two lamps, call boxes, stairs to the subway, ash
// cans.
#include <array>
#include <cmath>
#include <string>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kIronGreen{0.022f, 0.040f, 0.030f}, kEnamelWhite{0.62f, 0.61f, 0.56f}, kEnamelBlue{0.012f, 0.030f, 0.12f};

// A cast post with a moulded foot, `height` to its top.
void IronPost(PropBuilder& b, float height, float foot) {
  const Vec2f post[] = {{foot, -0.1f},         {foot, 0.10f},          {foot * 0.86f, 0.13f}, {foot * 0.80f, 0.55f}, {foot * 0.92f, 0.60f},
                        {foot * 0.92f, 0.66f}, {foot * 0.52f, 0.76f},  {foot * 0.44f, 1.3f},  {foot * 0.50f, 1.33f}, {foot * 0.50f, 1.38f},
                        {foot * 0.40f, 1.42f}, {foot * 0.28f, height}, {0, height + 0.01f}};
  b.Lathe(post, 18);
}

// A tall post that ends in a crook over the road (towards -Y), with scrolls in its bend and a bell with a globe below.
Model MakeBishopsCrook(uint32_t variant, uint64_t) {
  PropBuilder b("street_light_1950s");
  b.Use(Paint(variant ? Vec3f{0.020f, 0.021f, 0.023f} : kIronGreen, 0.4f));
  constexpr float kShaft = 6.1f;
  IronPost(b, kShaft, 0.24f);
  const float r = variant ? 0.62f : 0.72f;
  std::vector<Vec3f> crook;
  std::vector<float> radii;
  for (int i = 0; i <= 18; ++i) {
    const float a = kTauF * 0.53f * static_cast<float>(i) / 18;
    crook.push_back({0, -r * (1 - std::cos(a)), kShaft - 0.02f + 1.15f * r * std::sin(a)});
    radii.push_back(0.062f - 0.0012f * static_cast<float>(i));
  }
  b.Bar(crook, radii, 12);
  // A scroll inside the bend, a leaf on its back.
  std::vector<Vec3f> scroll;
  for (int i = 0; i <= 16; ++i) {
    const float a = kTauF * (0.02f + 0.85f * static_cast<float>(i) / 16), q = 0.10f + 0.30f * r * (1 - static_cast<float>(i) / 18);
    scroll.push_back({0, -0.45f * r - q * std::cos(a), kShaft + 0.20f * r + q * std::sin(a)});
  }
  b.Bar(scroll, 0.020f, 8);
  const Vec3f tip = crook.back();
  const Vec2f bell[] = {{0.27f, -0.38f}, {0.26f, -0.32f}, {0.20f, -0.22f}, {0.12f, -0.14f}, {0.075f, -0.08f}, {0.06f, 0.02f}, {0, 0.05f}};
  b.Lathe(bell, 22, tip);
  // A gumball of opal glass: 450 cd below the horizon.
  b.Use(WhiteGlow({0.92f, 0.78f, 0.52f}, 3600));
  b.mesh().Sphere(tip + Vec3f{0, 0, -0.45f}, {0.20f, 0.20f, 0.22f}, 12, 20);
  return b.Finish();
}

// A head with a red lamp over a green one on each of its four faces; along Y `red` burns, across the other.
void TwoLampHead(PropBuilder& b, float z, bool red) {
  b.Place({});
  b.Use(Paint({0.045f, 0.060f, 0.030f}, 0.45f));
  b.BevelBox({-0.15f, -0.15f, z}, {0.15f, 0.15f, z + 0.68f}, 0.03f);
  const Vec2f cap[] = {{0.20f, 0.66f}, {0.17f, 0.72f}, {0.06f, 0.80f}, {0.05f, 0.86f}, {0, 0.92f}};
  b.Lathe(cap, 16, {0, 0, z});
  for (int face = 0; face < 4; ++face) {
    b.Place(Turn(0, 0, 90.0f * static_cast<float>(face), {0, 0, z}));
    const bool red_burns = face % 2 == 0 ? red : !red;
    for (int i = 0; i < 2; ++i) {
      const Vec3f color = i == 0 ? Vec3f{0.90f, 0.03f, 0.02f} : Vec3f{0.05f, 0.75f, 0.40f};
      const Vec3f c{0, -0.15f, i == 0 ? 0.49f : 0.19f};
      Material lamp = Glow(color, 6000, Burns::kAlways);
      lamp.beam = 6;
      b.Use((i == 0) == red_burns ? lamp : Plastic(color * 0.12f, 0.3f));
      b.mesh().Tube(c, c + Vec3f{0, -0.02f, 0}, 0.10f, 0.085f, 18, false);
      b.Use(Paint({0.030f, 0.040f, 0.022f}, 0.6f));
      for (int k = 0; k < 10; ++k) {
        const auto at = [&](int j, float y, float r) {
          const float a = kTauF / 2 * (-0.1f + 1.2f * static_cast<float>(j) / 10);
          return c + Vec3f{r * std::cos(a), y, r * std::sin(a)};
        };
        b.mesh().Quad(at(k, -0.16f, 0.112f), at(k, 0, 0.112f), at(k + 1, 0, 0.112f), at(k + 1, -0.16f, 0.112f));
        b.mesh().Quad(at(k, 0, 0.108f), at(k, -0.16f, 0.108f), at(k + 1, -0.16f, 0.108f), at(k + 1, 0, 0.108f));
      }
    }
  }
  b.Place({});
}

// A signal on a post at the corner. Variant 2 shows green, the others red.
Model MakeCornerSignal(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_light_1950s");
  b.Use(Paint({0.045f, 0.060f, 0.030f}, 0.45f));
  IronPost(b, variant == 1 ? 2.62f : 2.95f, 0.19f);
  TwoLampHead(b, variant == 1 ? 2.60f : 2.93f, variant != 2);
  return b.Finish();
}

Texture OldSignFace(uint32_t variant) {
  constexpr Vec3f kInkBlack{0.015f, 0.015f, 0.015f}, kSignYellow{0.62f, 0.40f, 0.03f};
  static constexpr std::array<const char*, 6> kNames = {"old stop",      "old no parking", "old market st",
                                                        "old grove ave", "old speed",      "old one way"};
  const bool plate = variant == 2 || variant == 3 || variant == 5;
  Canvas c(plate ? 384 : 192, plate ? 96 : 256, variant == 0 ? kSignYellow : variant == 2 || variant == 3 ? kEnamelBlue : kEnamelWhite);
  switch (variant) {
    case 0:
      c.Letters("STOP", {0.5f, 0.5f}, 0.19f, kInkBlack);
      break;
    case 1:
      c.Letters("NO", {0.5f, 0.2f}, 0.15f, {0.42f, 0.02f, 0.02f});
      c.Letters("PARKING", {0.5f, 0.43f}, 0.12f, {0.42f, 0.02f, 0.02f}, 0.8f);
      c.Letters("8 AM TO 6 PM", {0.5f, 0.68f}, 0.06f, kInkBlack, 0.9f);
      c.Letters("POLICE DEPT.", {0.5f, 0.87f}, 0.05f, kInkBlack, 0.9f);
      break;
    case 2:
    case 3:
      c.Letters(variant == 2 ? "MARKET ST" : "GROVE AVE", {0.5f, 0.5f}, 0.52f, kEnamelWhite, 0.9f);
      break;
    case 4:
      c.Letters("SPEED", {0.5f, 0.17f}, 0.12f, kInkBlack);
      c.Letters("LIMIT", {0.5f, 0.33f}, 0.12f, kInkBlack);
      c.Letters("25", {0.5f, 0.66f}, 0.34f, kInkBlack);
      break;
    default:
      c.Rectangle({0, 0}, {1, 1}, kInkBlack);
      c.Rectangle({0.12f, 0.42f}, {0.80f, 0.58f}, kEnamelWhite);
      for (int i = 0; i < 10; ++i) {
        const float t = static_cast<float>(i) / 10;
        c.Rectangle({0.78f + 0.014f * static_cast<float>(i), 0.22f + 0.28f * t},
                    {0.795f + 0.014f * static_cast<float>(i), 0.78f - 0.28f * t}, kEnamelWhite);
      }
      c.Letters("ONE WAY", {0.42f, 0.5f}, 0.17f, kInkBlack, 0.9f);
  }
  return c.Finish(kNames[variant]);
}

// Enamel plates on a pipe; names of streets stand on both sides.
Model MakeOldTrafficSign(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_sign_1950s");
  b.Use(Paint(kIronGreen, 0.5f));
  const bool name = variant == 2 || variant == 3;
  const float height = name ? 3.0f : 2.5f,
              half = name           ? 0.42f
                     : variant == 5 ? 0.40f
                                    : 0.23f,
              half_z = name           ? 0.105f
                       : variant == 5 ? 0.10f
                                      : 0.31f,
              z = height - half_z - 0.03f;
  const Vec2f pipe[] = {{0.07f, 0}, {0.07f, 0.03f}, {0.032f, 0.05f}, {0.032f, height}, {0, height + 0.01f}};
  b.Lathe(pipe, 12);
  b.Use(Metal({0.30f, 0.30f, 0.30f}, 0.6f));
  b.BevelBox({-half - 0.012f, -0.050f, z - half_z - 0.012f}, {half + 0.012f, -0.034f, z + half_z + 0.012f}, 0.004f);
  b.Use(Paint({1, 1, 1}, 0.35f), OldSignFace(variant));
  b.Picture({-half, -0.0515f, z - half_z}, {half, -0.0515f, z - half_z}, {half, -0.0515f, z + half_z}, {-half, -0.0515f, z + half_z});
  if (name)
    b.Picture({half, -0.0325f, z - half_z}, {-half, -0.0325f, z - half_z}, {-half, -0.0325f, z + half_z}, {half, -0.0325f, z + half_z});
  return b.Finish();
}

// A post with a round plate and a bench behind it.
Model MakeOldBusStop(uint32_t variant, uint64_t) {
  PropBuilder b("bus_stop_1950s");
  b.Use(Paint(kIronGreen, 0.45f));
  const Vec2f pipe[] = {{0.12f, 0}, {0.12f, 0.05f}, {0.04f, 0.08f}, {0.04f, 2.55f}, {0, 2.56f}};
  b.Place(Move({1.2f, -0.45f, 0}));
  b.Lathe(pipe, 14);
  Canvas c(192, 192, kEnamelWhite);
  c.Disc({0.5f, 0.5f}, 0.47f, kEnamelBlue);
  c.Letters("BUS", {0.5f, 0.34f}, 0.20f, kEnamelWhite);
  c.Letters("STOP", {0.5f, 0.62f}, 0.17f, kEnamelWhite);
  c.Letters(variant ? "NO 24" : "NO 7", {0.5f, 0.82f}, 0.07f, kEnamelWhite);
  b.Use(Metal({0.30f, 0.30f, 0.30f}, 0.6f));
  b.BevelBox({-0.26f, -0.062f, 2.03f}, {0.26f, -0.042f, 2.55f}, 0.005f);
  b.Use(Paint({1, 1, 1}, 0.35f), c.Finish(variant ? "bus stop 24" : "bus stop 7"));
  b.Picture({-0.25f, -0.0635f, 2.04f}, {0.25f, -0.0635f, 2.04f}, {0.25f, -0.0635f, 2.54f}, {-0.25f, -0.0635f, 2.54f});
  b.Place({});
  // The bench: planks on iron legs.
  b.Use(Paint(kIronGreen, 0.5f));
  for (float x : {-1.5f, -0.1f}) {
    b.BevelBox({x - 0.03f, 0.10f, 0}, {x + 0.03f, 0.16f, 0.43f}, 0.008f);
    b.BevelBox({x - 0.03f, 0.50f, 0}, {x + 0.03f, 0.56f, 0.88f}, 0.008f);
    b.BevelBox({x - 0.03f, 0.10f, 0.39f}, {x + 0.03f, 0.56f, 0.43f}, 0.008f);
  }
  UseWood(b, {0.55f, 0.75f, 0.55f}, Grain::kAlongX);
  for (int i = 0; i < 4; ++i) {
    const float y = 0.09f + 0.105f * static_cast<float>(i);
    b.BevelBox({-1.75f, y, 0.43f}, {0.15f, y + 0.09f, 0.46f}, 0.006f);
  }
  for (float z : {0.60f, 0.76f}) b.BevelBox({-1.75f, 0.475f, z}, {0.15f, 0.50f, z + 0.11f}, 0.006f);
  return b.Finish();
}

// Two boards that lean on each other, a bill pasted on both.
Model MakeSandwichBoard(uint32_t variant, uint64_t) {
  PropBuilder b("poster_stand_1950s");
  struct Bill {
    Vec3f ground, ink;
    const char *top, *middle, *foot;
  };
  static constexpr std::array<Bill, 4> kBills = {
      {{{0.60f, 0.55f, 0.40f}, {0.40f, 0.02f, 0.02f}, "TONIGHT", "BIG BAND", "DANCING TO ONE"},
       {{0.58f, 0.40f, 0.08f}, {0.02f, 0.02f, 0.02f}, "FIGHTS", "FRIDAY", "ARENA 8 PM"},
       {{0.03f, 0.09f, 0.20f}, {0.62f, 0.58f, 0.45f}, "CIRCUS", "3 RINGS", "SEATS 50 CENTS"},
       {{0.60f, 0.58f, 0.52f}, {0.02f, 0.08f, 0.05f}, "LUNCH", "65 CENTS", "SOUP - PIE - COFFEE"}}};
  const Bill& bill = kBills[variant];
  Canvas c(192, 288, bill.ground);
  c.Rectangle({0.05f, 0.035f}, {0.95f, 0.05f}, bill.ink);
  c.Letters(bill.top, {0.5f, 0.19f}, 0.11f, bill.ink, 0.9f);
  c.Letters(bill.middle, {0.5f, 0.46f}, 0.12f, bill.ink, 0.8f);
  c.Disc({0.5f, 0.66f}, 0.09f, bill.ink * 0.7f + bill.ground * 0.3f);
  c.Letters(bill.foot, {0.5f, 0.88f}, 0.045f, bill.ink, 0.8f);
  const Texture face = c.Finish("bill " + std::to_string(variant));
  for (int side = 0; side < 2; ++side) {
    b.Place(Turn(0, 0, 180.0f * static_cast<float>(side)) * Turn(-14, 0, 0, {0, -0.34f, 0.01f}));
    UseWood(b, {0.8f, 0.75f, 0.7f});
    b.BevelBox({-0.40f, 0.0f, 0}, {0.40f, 0.025f, 1.32f}, 0.008f);
    b.Use(Paint({1, 1, 1}, 0.8f), face);
    b.Picture({-0.36f, -0.003f, 0.16f}, {0.36f, -0.003f, 0.16f}, {0.36f, -0.003f, 1.26f}, {-0.36f, -0.003f, 1.26f});
  }
  b.Place({});
  return b.Finish();
}

// The case of the signals on a cast foot, with a rounded lid.
Model MakeSignalCase(uint32_t variant, uint64_t) {
  PropBuilder b("electric_box_1950s");
  b.Use(Paint(variant ? Vec3f{0.045f, 0.060f, 0.030f} : Vec3f{0.10f, 0.105f, 0.10f}, 0.5f), ScratchedTexture());
  const Vec2f foot[] = {{0.26f, -0.1f}, {0.26f, 0.06f}, {0.16f, 0.12f}, {0.12f, 0.42f}, {0.18f, 0.47f}, {0, 0.47f}};
  b.Lathe(foot, 16);
  b.BevelBox({-0.30f, -0.22f, 0.46f}, {0.30f, 0.22f, 1.30f}, 0.03f);
  b.BevelBox({-0.33f, -0.25f, 1.28f}, {0.33f, 0.25f, 1.34f}, 0.02f);
  b.BevelBox({-0.20f, -0.16f, 1.33f}, {0.20f, 0.16f, 1.40f}, 0.03f);
  b.BevelBox({-0.25f, -0.235f, 0.53f}, {0.25f, -0.215f, 1.23f}, 0.008f);
  b.Use(Metal({0.45f, 0.40f, 0.25f}, 0.4f));
  b.BevelBox({0.17f, -0.26f, 0.84f}, {0.20f, -0.235f, 0.94f}, 0.005f);
  return b.Finish();
}

// Dented cans of zinc with lids, a crate beside them.
Model MakeAshCans(uint32_t variant, uint64_t seed) {
  PropBuilder b("trash_bags_1950s");
  RngStream rng(seed, "ash cans", variant);
  const auto uniform = [&](double from, double to) { return static_cast<float>(rng.Uniform(from, to)); };
  const int cans = 2 + static_cast<int>(variant % 2);
  for (int i = 0; i < cans; ++i) {
    const Vec3f at{0.56f * (static_cast<float>(i) - 0.5f * static_cast<float>(cans - 1)), uniform(-0.08, 0.08), 0};
    b.Use(Metal(kZinc, 0.5f), ScratchedTexture());
    const Vec2f can[] = {{0, 0},          {0.20f, 0},      {0.205f, 0.03f}, {0.235f, 0.22f}, {0.247f, 0.23f}, {0.238f, 0.25f},
                         {0.250f, 0.46f}, {0.262f, 0.47f}, {0.252f, 0.49f}, {0.258f, 0.62f}, {0.27f, 0.63f},  {0.262f, 0.645f}};
    b.Lathe(can, 22, at);
    if (rng.Chance(0.25)) {
      b.Use(Plastic({0.05f, 0.045f, 0.04f}, 0.9f));
      b.mesh().Sphere(at + Vec3f{0, 0, 0.58f}, {0.23f, 0.23f, 0.12f}, 6, 14);
      continue;
    }
    b.Place(Turn(uniform(-7, 7), uniform(-7, 7), 0, at + Vec3f{0, 0, 0.645f}));
    const Vec2f lid[] = {{0.285f, -0.01f}, {0.285f, 0.02f}, {0.20f, 0.055f}, {0.05f, 0.075f}, {0, 0.077f}};
    b.Lathe(lid, 22);
    const Vec3f handle[] = {{-0.08f, 0, 0.06f}, {-0.06f, 0, 0.115f}, {0.06f, 0, 0.115f}, {0.08f, 0, 0.06f}};
    b.Bar(handle, 0.010f, 6);
    b.Place({});
  }
  UseWood(b, {1.0f, 0.9f, 0.75f}, Grain::kAlongX);
  b.Place(Turn(0, 0, uniform(-20, 20), {uniform(-0.3, 0.3), -0.47f, 0}));
  for (int k = 0; k < 3; ++k) {
    const float z = 0.02f + 0.11f * static_cast<float>(k);
    for (float y : {-0.14f, 0.13f}) b.BevelBox({-0.24f, y, z}, {0.24f, y + 0.012f, z + 0.085f}, 0.003f);
    for (float x : {-0.24f, 0.228f}) b.BevelBox({x, -0.14f, z}, {x + 0.012f, 0.14f, z + 0.085f}, 0.003f);
  }
  b.Place({});
  return b.Finish();
}

// Rough cast blocks with an iron eye, 2.4 m along X.
Model MakeKerbBlocks(uint32_t variant, uint64_t) {
  PropBuilder b("concrete_block_1950s");
  for (int i = 0; i < 2; ++i) {
    const float x = -0.62f + 1.24f * static_cast<float>(i),
                shade = 1 - 0.08f * static_cast<float>((variant + static_cast<uint32_t>(i)) % 3);
    b.Use(Stone(Vec3f{0.38f, 0.36f, 0.32f} * shade), ConcreteTexture());
    b.BevelBox({x - 0.56f, -0.28f, 0}, {x + 0.56f, 0.28f, 0.55f}, 0.05f);
    b.Use(CastIron());
    const Vec3f eye[] = {{x - 0.06f, 0, 0.54f}, {x - 0.05f, 0, 0.63f}, {x + 0.05f, 0, 0.63f}, {x + 0.06f, 0, 0.54f}};
    b.Bar(eye, 0.014f, 6);
  }
  return b.Finish();
}

// Bollard of cast iron with a ball.
Model MakeIronBollard(uint32_t, uint64_t) {
  PropBuilder b("road_column_1950s");
  b.Use(Paint({0.020f, 0.021f, 0.022f}, 0.45f));
  const Vec2f post[] = {{0.13f, -0.1f}, {0.13f, 0.10f}, {0.095f, 0.16f}, {0.085f, 0.66f}, {0.11f, 0.69f},
                        {0.11f, 0.74f}, {0.06f, 0.79f}, {0.05f, 0.82f},  {0, 0.83f}};
  b.Lathe(post, 16);
  b.mesh().Sphere({0, 0, 0.90f}, {0.095f, 0.095f, 0.095f}, 10, 16);
  return b.Finish();
}

// A trestle of blue planks: POLICE LINE.
Model MakePoliceLine(uint32_t, uint64_t) {
  PropBuilder b("blue_barrier_1950s");
  constexpr Vec3f kPoliceBlue{0.02f, 0.075f, 0.33f};
  b.Use(Paint(kPoliceBlue, 0.6f), ScratchedTexture());
  for (float x : {-0.62f, 0.62f}) {
    for (float y : {-0.22f, 0.22f}) b.mesh().Beam({x, y, 0}, {x, y * 0.1f, 0.98f}, 0.07f);
    b.mesh().Beam({x, -0.14f, 0.36f}, {x, 0.14f, 0.36f}, 0.05f);
  }
  b.BevelBox({-0.75f, -0.045f, 0.74f}, {0.75f, 0.045f, 0.96f}, 0.01f);
  b.BevelBox({-0.72f, -0.03f, 0.40f}, {0.72f, 0.03f, 0.56f}, 0.01f);
  Canvas c(384, 56, kPoliceBlue);
  c.Letters("POLICE LINE", {0.5f, 0.5f}, 0.62f, kEnamelWhite, 0.95f);
  b.Use(Paint({1, 1, 1}, 0.6f), c.Finish("police line"));
  b.Picture({-0.72f, -0.047f, 0.76f}, {0.72f, -0.047f, 0.76f}, {0.72f, -0.047f, 0.94f}, {-0.72f, -0.047f, 0.94f});
  b.Picture({0.72f, 0.047f, 0.76f}, {-0.72f, 0.047f, 0.76f}, {-0.72f, 0.047f, 0.94f}, {0.72f, 0.047f, 0.94f});
  return b.Finish();
}

// A red pillar with the fire alarm, a lamp on its top.
Model MakeFireAlarm(uint32_t, uint64_t) {
  PropBuilder b("fire_alarm_box");
  const Material red = Paint({0.36f, 0.012f, 0.010f}, 0.4f);
  b.Use(red);
  IronPost(b, 1.35f, 0.20f);
  b.BevelBox({-0.20f, -0.15f, 1.15f}, {0.20f, 0.15f, 1.75f}, 0.04f);
  const Vec2f top[] = {{0.24f, 1.73f}, {0.20f, 1.80f}, {0.10f, 1.92f}, {0.05f, 2.0f}, {0.03f, 2.25f}, {0, 2.26f}};
  b.Lathe(top, 14);
  Canvas c(128, 160, {0.36f, 0.012f, 0.010f});
  c.Letters("FIRE", {0.5f, 0.22f}, 0.17f, kEnamelWhite);
  c.Letters("ALARM", {0.5f, 0.46f}, 0.13f, kEnamelWhite);
  c.Letters("NO 360", {0.5f, 0.76f}, 0.08f, kEnamelWhite);
  b.Use(Paint({1, 1, 1}, 0.4f), c.Finish("fire alarm"));
  b.Picture({-0.15f, -0.153f, 1.24f}, {0.15f, -0.153f, 1.24f}, {0.15f, -0.153f, 1.66f}, {-0.15f, -0.153f, 1.66f});
  b.Use(Glow({0.9f, 0.10f, 0.05f}, 1500));
  b.mesh().Sphere({0, 0, 2.36f}, {0.09f, 0.09f, 0.12f}, 8, 14);
  return b.Finish();
}

// The telephone of the police on a green post.
Model MakePoliceBox(uint32_t, uint64_t) {
  PropBuilder b("police_box");
  b.Use(Paint({0.015f, 0.065f, 0.035f}, 0.4f));
  IronPost(b, 1.30f, 0.17f);
  b.BevelBox({-0.17f, -0.16f, 1.18f}, {0.17f, 0.14f, 1.66f}, 0.02f);
  const Vec2f gable[] = {{-0.21f, 1.65f}, {0.21f, 1.65f}, {0, 1.82f}};
  b.Place(Turn(90, 0, 0));
  b.Prism(gable, -0.17f, 0.19f);
  b.Place({});
  Canvas c(128, 160, {0.015f, 0.065f, 0.035f});
  c.Letters("POLICE", {0.5f, 0.25f}, 0.12f, kEnamelWhite, 0.9f);
  c.Letters("TELEPHONE", {0.5f, 0.50f}, 0.085f, kEnamelWhite, 0.8f);
  c.Letters("PULL", {0.5f, 0.80f}, 0.08f, kEnamelWhite);
  b.Use(Paint({1, 1, 1}, 0.4f), c.Finish("police telephone"));
  b.Picture({-0.13f, -0.163f, 1.24f}, {0.13f, -0.163f, 1.24f}, {0.13f, -0.163f, 1.60f}, {-0.13f, -0.163f, 1.60f});
  return b.Finish();
}

// Stairs down to the subway between railings, along X: their head is at -X, where two posts carry globes.
Model MakeSubwayStairs(uint32_t variant, uint64_t) {
  PropBuilder b("subway_stairs");
  constexpr float kLong = 2.1f, kWide = 0.78f;
  // A kerb of stone, the flight in its own shadow: each tread is darker than the one before.
  b.Use(Stone({0.40f, 0.39f, 0.37f}), ConcreteTexture());
  for (float y : {-1.0f, 1.0f}) b.BevelBox({-kLong, y * kWide - 0.09f, 0}, {kLong, y * kWide + 0.09f, 0.20f}, 0.015f);
  b.BevelBox({kLong - 0.18f, -kWide, 0}, {kLong, kWide, 0.20f}, 0.015f);
  Canvas c(256, 96, {0.004f, 0.004f, 0.004f});
  for (int i = 0; i < 15; ++i) {
    const float t = static_cast<float>(i) / 15, light = 0.30f * (1 - t) * (1 - t) * (1 - t);
    c.Rectangle({t, 0}, {t + 1.0f / 15, 1}, Vec3f{light, light, 0.96f * light});
    c.Rectangle({t, 0}, {t + 0.012f, 1}, Vec3f{light, light, light} * 0.35f);
  }
  b.Use(Paint({1, 1, 1}, 0.95f), c.Finish("subway flight"));
  b.Picture({-kLong, -kWide + 0.08f, 0.012f}, {kLong - 0.15f, -kWide + 0.08f, 0.012f}, {kLong - 0.15f, kWide - 0.08f, 0.012f},
            {-kLong, kWide - 0.08f, 0.012f});
  b.Use(Paint(kIronGreen, 0.45f));
  const auto rail = [&](Vec2f p, Vec2f q) {
    for (float z : {0.32f, 1.08f}) b.mesh().Beam({p.x, p.y, z}, {q.x, q.y, z}, 0.045f);
    const int bars = static_cast<int>(std::hypot(q.x - p.x, q.y - p.y) / 0.13f);
    for (int i = 0; i <= bars; ++i) {
      const Vec2f at = p + (q - p) * (static_cast<float>(i) / static_cast<float>(bars));
      b.mesh().Tube({at.x, at.y, 0.2f}, {at.x, at.y, 1.08f}, 0.011f, 0.011f, 5, false, false);
    }
  };
  rail({-kLong + 0.1f, -kWide}, {kLong - 0.09f, -kWide});
  rail({-kLong + 0.1f, kWide}, {kLong - 0.09f, kWide});
  rail({kLong - 0.09f, -kWide}, {kLong - 0.09f, kWide});
  // A chain across the head: the stairs are a picture, nobody goes down.
  b.mesh().Beam({-kLong + 0.1f, -kWide, 0.9f}, {-kLong + 0.1f, kWide, 0.9f}, 0.03f);
  for (float y : {-kWide, kWide}) {
    b.Use(Paint(kIronGreen, 0.45f));
    const Vec2f post[] = {{0.14f, 0},      {0.14f, 0.25f}, {0.085f, 0.32f}, {0.06f, 1.2f},
                          {0.045f, 2.35f}, {0.11f, 2.40f}, {0.11f, 2.44f},  {0, 2.45f}};
    b.Lathe(post, 14, {-kLong + 0.1f, y, 0});
    b.Use(Glow(variant ? Vec3f{0.75f, 0.72f, 0.62f} : Vec3f{0.10f, 0.62f, 0.30f}, 700));
    b.mesh().Sphere({-kLong + 0.1f, y, 2.63f}, {0.20f, 0.20f, 0.20f}, 12, 20);
  }
  b.Use(Paint(kEnamelBlue, 0.4f));
  b.BevelBox({-kLong + 0.06f, -kWide, 2.02f}, {-kLong + 0.14f, kWide, 2.32f}, 0.01f);
  Canvas sign(256, 48, kEnamelBlue);
  sign.Letters("SUBWAY", {0.5f, 0.5f}, 0.66f, kEnamelWhite, 1.1f);
  b.Use(Paint({1, 1, 1}, 0.35f), sign.Finish("subway"));
  const float x0 = -kLong + 0.057f, x1 = -kLong + 0.143f;
  b.Picture({x0, kWide - 0.05f, 2.04f}, {x0, -kWide + 0.05f, 2.04f}, {x0, -kWide + 0.05f, 2.30f}, {x0, kWide - 0.05f, 2.30f});
  b.Picture({x1, -kWide + 0.05f, 2.04f}, {x1, kWide - 0.05f, 2.04f}, {x1, kWide - 0.05f, 2.30f}, {x1, -kWide + 0.05f, 2.30f});
  return b.Finish();
}

}  // namespace

std::vector<PropKind> Street1950sKinds() {
  return {
      {"street_light_1950s", "furniture/lighting/street_light", 2, MakeBishopsCrook, 0.3f, 6.6f, 7.2f, 3500},
      {"traffic_light_1950s", "traffic/control/traffic_light", 3, MakeCornerSignal, 0.4f, 3.4f, 4.0f, 3000},
      {"traffic_sign_1950s", "signage/traffic_sign", 6, MakeOldTrafficSign, 0.3f, 2.4f, 3.1f, 600},
      {"bus_stop_1950s", "furniture/transit/bus_stop", 2, MakeOldBusStop, 2.2f, 2.5f, 2.6f, 1500},
      {"poster_stand_1950s", "signage/poster_stand", 4, MakeSandwichBoard, 0.5f, 1.2f, 1.4f, 300},
      {"electric_box_1950s", "furniture/utility/electric_box", 2, MakeSignalCase, 0.5f, 1.3f, 1.5f, 800},
      {"trash_bags_1950s", "furniture/misc", 6, MakeAshCans, 1.0f, 0.6f, 0.8f, 3500},
      {"concrete_block_1950s", "traffic/barrier/concrete_block", 3, MakeKerbBlocks, 1.25f, 0.55f, 0.7f, 400},
      {"road_column_1950s", "traffic/bollard/road_column", 1, MakeIronBollard, 0.2f, 0.95f, 1.05f, 900},
      {"blue_barrier_1950s", "traffic/barrier/barrier", 1, MakePoliceLine, 0.8f, 0.9f, 1.05f, 400},
      {"fire_alarm_box", "furniture/misc", 1, MakeFireAlarm, 0.3f, 2.3f, 2.6f, 1500},
      {"police_box", "furniture/misc", 1, MakePoliceBox, 0.3f, 1.7f, 1.9f, 800},
      {"subway_stairs", "construction/stairs", 2, MakeSubwayStairs, 2.3f, 2.7f, 2.9f, 4500},
  };
}

}  // namespace airsim360::internal
