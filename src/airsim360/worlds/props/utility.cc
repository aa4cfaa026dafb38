// Hydrants, mailboxes, parking meters and electric boxes.
#include <cmath>
#include <numbers>

#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/mailbox.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kMailBlue{0.012f, 0.045f, 0.17f};

// Barrel with flanges, bonnet, two hose nozzles and one pumper nozzle (front).
Model MakeFireHydrant(uint32_t variant, uint64_t) {
  PropBuilder b("fire_hydrant");
  const Vec3f tones[3] = {{0.42f, 0.02f, 0.015f}, {0.62f, 0.42f, 0.02f}, {0.55f, 0.56f, 0.57f}};
  b.Use(Paint(tones[variant], 0.45f), ScratchedTexture());
  const Vec2f body[] = {{0.16f, -0.1f},  {0.16f, 0.03f},   {0.155f, 0.04f}, {0.105f, 0.042f}, {0.105f, 0.10f}, {0.15f, 0.102f},
                        {0.15f, 0.125f}, {0.105f, 0.13f},  {0.10f, 0.50f},  {0.14f, 0.505f},  {0.14f, 0.535f}, {0.115f, 0.54f},
                        {0.11f, 0.60f},  {0.085f, 0.655f}, {0.05f, 0.69f},  {0.03f, 0.70f},   {0.03f, 0.745f}, {0, 0.745f}};
  b.Lathe(body, 24);
  const auto nozzle = [&](float turn, float radius, float z) {
    b.Place(Turn(90, 0, turn, {0, 0, z}));
    const Vec2f profile[] = {{radius, 0.05f},         {radius, 0.125f},       {radius * 1.28f, 0.128f}, {radius * 1.28f, 0.175f},
                             {radius * 1.1f, 0.185f}, {radius * 0.4f, 0.19f}, {radius * 0.4f, 0.215f},  {0, 0.215f}};
    b.Lathe(profile, 16);
    b.Place({});
  };
  nozzle(0, 0.062f, 0.38f);
  nozzle(90, 0.045f, 0.42f);
  nozzle(-90, 0.045f, 0.42f);
  b.Use(CastIron());
  for (int i = 0; i < 8; ++i) {
    const float a = std::numbers::pi_v<float> * (static_cast<float>(i) + 0.5f) / 4;
    const Vec3f d{std::cos(a), std::sin(a), 0};
    b.mesh().Tube(d * 0.128f + Vec3f{0, 0, 0.096f}, d * 0.128f + Vec3f{0, 0, 0.142f}, 0.010f, 0.010f, 6);
    b.mesh().Tube(d * 0.124f + Vec3f{0, 0, 0.498f}, d * 0.124f + Vec3f{0, 0, 0.55f}, 0.009f, 0.009f, 6);
  }
  return b.Finish();
}

Model MakeMailbox(uint32_t, uint64_t) { return MailboxOf(kMailBlue); }

// Single-space meter: post, rounded housing with a dome window, slot and key plate.
Model MakeParkingMeter(uint32_t variant, uint64_t) {
  PropBuilder b("parking_meter");
  b.Use(Metal({0.45f, 0.46f, 0.47f}, 0.4f), ScratchedTexture());
  const Vec2f post[] = {{0.09f, 0},      {0.09f, 0.012f}, {0.04f, 0.02f}, {0.032f, 0.06f},
                        {0.032f, 1.10f}, {0.06f, 1.13f},  {0.06f, 1.15f}, {0, 1.15f}};
  b.Lathe(post, 16);
  std::vector<Vec2f> face = {{-0.085f, 1.14f}, {0.085f, 1.14f}, {0.10f, 1.34f}};
  for (int i = 1; i < 10; ++i) {
    const float a = std::numbers::pi_v<float> * static_cast<float>(i) / 10;
    face.push_back({0.10f * std::cos(a), 1.34f + 0.105f * std::sin(a)});
  }
  face.push_back({-0.10f, 1.34f});
  b.Use(Paint(variant ? Vec3f{0.04f, 0.045f, 0.05f} : Vec3f{0.20f, 0.22f, 0.23f}, 0.35f));
  b.Place(Turn(90, 0, 0));
  b.Prism(face, -0.065f, 0.065f);
  b.Place({});
  b.Use(Glass({0.05f, 0.07f, 0.06f}));
  b.BevelBox({-0.065f, -0.070f, 1.31f}, {0.065f, -0.064f, 1.39f}, 0.003f);
  b.Use(Metal({0.6f, 0.6f, 0.6f}, 0.25f));
  b.BevelBox({-0.05f, -0.072f, 1.19f}, {0.05f, -0.064f, 1.27f}, 0.004f);
  b.Use(Rubber());
  b.BevelBox({0.012f, -0.0735f, 1.215f}, {0.018f, -0.0715f, 1.25f}, 0.0005f);
  return b.Finish();
}

// Cabinet for signals: doors with a seam, louvres, a sloping lid, on a concrete plinth.
Model MakeElectricBox(uint32_t variant, uint64_t) {
  PropBuilder b("electric_box");
  const Vec3f tones[2] = {{0.26f, 0.29f, 0.27f}, {0.055f, 0.095f, 0.07f}};
  b.Use(Stone({0.40f, 0.39f, 0.37f}), ConcreteTexture());
  b.BevelBox({-0.50f, -0.30f, -0.1f}, {0.50f, 0.30f, 0.12f}, 0.015f);
  b.Use(Paint(tones[variant], 0.5f), ScratchedTexture());
  b.BevelBox({-0.45f, -0.25f, 0.115f}, {0.45f, 0.25f, 1.38f}, 0.012f);
  b.BevelBox({-0.47f, -0.28f, 1.375f}, {0.47f, 0.27f, 1.42f}, 0.012f);
  for (float x : {-0.425f, 0.012f}) b.BevelBox({x, -0.262f, 0.17f}, {x + 0.413f, -0.245f, 1.33f}, 0.006f);
  for (int i = 0; i < 8; ++i) {
    for (float x : {-0.35f, 0.09f}) {
      b.Place(Turn(-30, 0, 0, {x, -0.264f, 1.02f + 0.028f * static_cast<float>(i)}));
      b.mesh().Box({0, -0.010f, -0.002f}, {0.26f, 0.006f, 0.002f});
    }
  }
  b.Place({});
  b.Use(Metal());
  b.BevelBox({-0.03f, -0.285f, 0.70f}, {-0.015f, -0.262f, 0.86f}, 0.004f);
  Canvas label(64, 64, {0.75f, 0.50f, 0.02f});
  label.RegularPolygon({0.5f, 0.56f}, 0.46f, 3, std::numbers::pi_v<float> / 2, {0.015f, 0.015f, 0.015f});
  label.Line({0.54f, 0.34f}, {0.44f, 0.58f}, 0.07f, {0.75f, 0.50f, 0.02f});
  label.Line({0.44f, 0.58f}, {0.56f, 0.58f}, 0.06f, {0.75f, 0.50f, 0.02f});
  label.Line({0.56f, 0.58f}, {0.47f, 0.76f}, 0.06f, {0.75f, 0.50f, 0.02f});
  b.Use(Paint({1, 1, 1}), label.Finish("high voltage"));
  b.Picture({0.15f, -0.2635f, 0.78f}, {0.27f, -0.2635f, 0.78f}, {0.27f, -0.2635f, 0.90f}, {0.15f, -0.2635f, 0.90f});
  return b.Finish();
}

}  // namespace

Model MailboxOf(Vec3f paint) {
  PropBuilder b("mailbox");
  b.Use(Paint(paint, 0.35f), ScratchedTexture());
  // Side outline in (y, z), swept along x.
  std::vector<Vec2f> side = {{-0.26f, 0.18f}, {0.26f, 0.18f}, {0.26f, 0.95f}};
  for (int i = 1; i < 12; ++i) {
    const float a = std::numbers::pi_v<float> * static_cast<float>(i) / 12;
    side.push_back({0.26f * std::cos(a), 0.95f + 0.27f * std::sin(a)});
  }
  side.push_back({-0.26f, 0.95f});
  b.Place(AffineTransform{Mat3f::FromColumns({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {}});
  b.Prism(side, -0.25f, 0.25f);
  b.Place({});
  for (float x : {-0.21f, 0.21f}) {
    for (float y : {-0.22f, 0.22f}) b.BevelBox({x - 0.025f, y - 0.025f, 0}, {x + 0.025f, y + 0.025f, 0.19f}, 0.004f);
  }
  b.BevelBox({-0.26f, -0.27f, 0.17f}, {0.26f, 0.27f, 0.20f}, 0.006f);
  // Door: a panel over the front of the rounded top with a handle.
  b.Place(Turn(-18, 0, 0, {0, -0.245f, 1.00f}));
  b.BevelBox({-0.20f, -0.035f, -0.09f}, {0.20f, 0.0f, 0.13f}, 0.008f);
  b.Use(Metal());
  b.BevelBox({-0.12f, -0.055f, 0.08f}, {0.12f, -0.034f, 0.10f}, 0.005f);
  b.Place({});
  Canvas label(256, 96, {0.75f, 0.75f, 0.75f});
  label.Letters("CITY MAIL", {0.5f, 0.34f}, 0.30f, kMailBlue);
  label.Letters("PICK UP 5 PM", {0.5f, 0.75f}, 0.16f, {0.35f, 0.02f, 0.02f});
  b.Use(Paint({1, 1, 1}), label.Finish("city mail"));
  b.Picture({-0.18f, -0.2615f, 0.62f}, {0.18f, -0.2615f, 0.62f}, {0.18f, -0.2615f, 0.755f}, {-0.18f, -0.2615f, 0.755f});
  return b.Finish();
}

std::vector<PropKind> UtilityKinds() {
  return {
      {"fire_hydrant", "furniture/utility/fire_hydrant", 3, MakeFireHydrant, 0.35f, 0.7f, 0.8f, 3500},
      {"mailbox", "furniture/mail/post_box", 1, MakeMailbox, 0.5f, 1.15f, 1.3f, 800},
      {"parking_meter", "furniture/utility/parking_meter", 2, MakeParkingMeter, 0.2f, 1.4f, 1.5f, 700},
      {"electric_box", "furniture/utility/electric_box", 2, MakeElectricBox, 0.7f, 1.3f, 1.5f, 800},
  };
}

}  // namespace airsim360::internal
