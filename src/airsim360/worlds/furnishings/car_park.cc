// Car parks: wheel stops 1.8 m, corner guards of pillars, signs over aisles, ticket machines, barriers with a boom of 3 m.
#include <array>
#include <cmath>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kYellow{0.68f, 0.42f, 0.01f}, kBumper{0.025f, 0.025f, 0.027f};

// Rubber with yellow bands, or concrete.
Model MakeWheelStop(uint32_t variant, uint64_t) {
  PropBuilder b("wheel_stop");
  const float half = 0.90f, h = 0.10f, d = 0.075f;
  const auto piece = [&](float x0, float x1) {
    const auto at = [&](float u, float v) {
      const float y = d * (1 - 2 * v), s = std::abs(2 * v - 1);
      return Vec3f{
          x0 + (x1 - x0) * u, y,
          h * (s < 0.55f ? 1.0f : std::sqrt(std::max(0.0f, 1 - std::pow((s - 0.55f) / 0.45f, 2.0f) * 0.92f)) * (s > 0.999f ? 0.0f : 1.0f))};
    };
    b.Sheet(2, 20, [&](float u, float v) { return at(u, 1 - v); }, {x1 - x0, 0.3f});
  };
  if (variant == 1) {
    b.Use(Stone({0.48f, 0.47f, 0.45f}, 0.9f), ConcreteTexture());
    piece(-half, half);
    b.mesh().Box({-half, -d + 0.006f, 0}, {-half + 0.001f, d - 0.006f, h * 0.96f});
    b.mesh().Box({half - 0.001f, -d + 0.006f, 0}, {half, d - 0.006f, h * 0.96f});
    return b.Finish();
  }
  for (int i = 0; i < 6; ++i) {
    b.Use(i % 2 ? Plastic(kYellow, 0.5f) : Rubber());
    piece(-half + 0.30f * static_cast<float>(i), -half + 0.30f * static_cast<float>(i + 1));
    if (i == 0) b.mesh().Box({-half, -d + 0.006f, 0}, {-half + 0.001f, d - 0.006f, h * 0.96f});
    if (i == 5) b.mesh().Box({half - 0.001f, -d + 0.006f, 0}, {half, d - 0.006f, h * 0.96f});
  }
  b.Use(Metal({0.4f, 0.4f, 0.4f}, 0.5f));
  for (float x : {-0.6f, 0.0f, 0.6f}) b.mesh().Tube({x, 0, h - 0.004f}, {x, 0, h + 0.006f}, 0.018f, 0.014f, 12, false);
  return b.Finish();
}

// Corner guard of rubber, 0.8 m high: the pillar's edge is the z axis, the pillar lies at x < 0, y > 0; or a collar of foam
// around a pillar 0.4 m square.
Model MakePillarGuard(uint32_t variant, uint64_t) {
  PropBuilder b("pillar_guard");
  const int bands = 5;
  const float h = variant == 0 ? 0.80f : 1.0f;
  for (int i = 0; i < bands; ++i) {
    const float z0 = h * static_cast<float>(i) / bands, z1 = h * static_cast<float>(i + 1) / bands;
    b.Use(i % 2 ? Plastic(kYellow, 0.5f) : Plastic(kBumper, 0.7f));
    if (variant == 0) {
      b.BevelBox({-0.10f, -0.012f, z0}, {0.012f, 0, z1}, 0.003f);
      b.BevelBox({0, 0, z0}, {0.012f, 0.10f, z1}, 0.003f);
    } else {
      const auto ring = RoundedRectangle({-0.22f, -0.22f}, {0.22f, 0.22f}, 0.035f, 4);
      b.mesh().Walls(ring, z0, z1);
      const auto inner = RoundedRectangle({-0.201f, -0.201f}, {0.201f, 0.201f}, 0.016f, 4);
      if (i == bands - 1)
        for (size_t k = 0; k < ring.size(); ++k) {
          const size_t n = (k + 1) % ring.size();
          b.mesh().Quad({ring[k].x, ring[k].y, z1}, {ring[n].x, ring[n].y, z1}, {inner[n].x, inner[n].y, z1}, {inner[k].x, inner[k].y, z1});
        }
    }
  }
  return b.Finish();
}

const Texture& SignPicture(uint32_t variant) {
  static const std::array<Texture, 4> pictures = [] {
    std::array<Texture, 4> all;
    const Vec3f blue{0.01f, 0.07f, 0.32f}, green{0.01f, 0.20f, 0.08f}, white{0.80f, 0.80f, 0.78f}, red{0.48f, 0.02f, 0.02f};
    for (uint32_t k = 0; k < 4; ++k) {
      Canvas canvas(256, 96, k == 1 ? green : k == 3 ? red : blue);
      canvas.Rectangle({0.012f, 0.03f}, {0.988f, 0.06f}, white);
      canvas.Rectangle({0.012f, 0.94f}, {0.988f, 0.97f}, white);
      if (k == 0) {
        canvas.Rectangle({0.05f, 0.16f}, {0.33f, 0.84f}, white);
        canvas.Letters("P", {0.19f, 0.5f}, 0.50f, blue);
        canvas.Letters("LEVEL 2", {0.66f, 0.5f}, 0.30f, white, 0.8f);
      } else if (k == 3) {
        canvas.Letters("NO ENTRY", {0.5f, 0.5f}, 0.36f, white, 0.85f);
      } else {
        canvas.Letters(k == 1 ? "EXIT" : "2.1 M", {k == 1 ? 0.38f : 0.5f, 0.5f}, 0.44f, white);
        if (k == 1) {
          canvas.Line({0.64f, 0.5f}, {0.88f, 0.5f}, 0.12f, white);
          canvas.Line({0.90f, 0.5f}, {0.79f, 0.26f}, 0.12f, white);
          canvas.Line({0.90f, 0.5f}, {0.79f, 0.74f}, 0.12f, white);
        }
      }
      all[k] = canvas.Finish("parking sign " + std::to_string(k));
    }
    return all;
  }();
  return pictures[variant];
}

// Hung on two rods, 0.35 m of them; both faces.
Model MakeParkingSign(uint32_t variant, uint64_t) {
  PropBuilder b("parking_sign");
  const float half = 0.60f, h = 0.45f;
  b.Use(Metal({0.55f, 0.55f, 0.55f}, 0.4f));
  b.BevelBox({-half, -0.02f, 0}, {half, 0.02f, h}, 0.006f);
  for (float x : {-0.45f, 0.45f}) b.mesh().Tube({x, 0, h}, {x, 0, h + 0.35f}, 0.009f, 0.009f, 8);
  b.Use(Paint({0.9f, 0.9f, 0.9f}, 0.35f), SignPicture(variant));
  for (float s : {1.0f, -1.0f})
    b.Picture({-(half - 0.006f) * s, -0.0205f * s, 0.006f}, {(half - 0.006f) * s, -0.0205f * s, 0.006f},
              {(half - 0.006f) * s, -0.0205f * s, h - 0.006f}, {-(half - 0.006f) * s, -0.0205f * s, h - 0.006f});
  return b.Finish();
}

// Column at an entry, or a pay station on foot.
Model MakeTicketMachine(uint32_t variant, uint64_t) {
  PropBuilder b("ticket_machine");
  const float half = variant == 0 ? 0.16f : 0.38f, d = variant == 0 ? 0.18f : 0.30f, h = variant == 0 ? 1.25f : 1.75f;
  const Vec3f tone = variant == 0 ? kYellow : Vec3f{0.02f, 0.09f, 0.28f};
  UseCoatedSteel(b, {0.10f, 0.105f, 0.11f});
  b.BevelBox({-half, -d + 0.02f, 0}, {half, d, 0.12f}, 0.006f);
  UseCoatedSteel(b, tone, 0.3f);
  SoftBox(b, {-half, -d + 0.03f, 0.11f}, {half, d, h}, {.round = 0.03f, .crown = 0.002f, .cells = 6});
  UseBrushedSteel(b);
  b.BevelBox({-half + 0.03f, -d + 0.012f, h * 0.45f}, {half - 0.03f, -d + 0.04f, h - 0.05f}, 0.006f);
  const float y = -d + 0.011f;
  b.Use(Plastic({0.012f, 0.012f, 0.014f}, 0.1f));
  b.BevelBox({-half * 0.5f, y - 0.004f, h * 0.52f}, {half * 0.5f, y + 0.004f, h * 0.535f}, 0.001f);
  b.BevelBox({-half * 0.6f, y - 0.003f, h * 0.72f}, {half * 0.6f, y + 0.003f, h * 0.90f}, 0.002f);
  Canvas canvas(96, 64, {0.03f, 0.10f, 0.30f});
  canvas.Letters(variant == 0 ? "PRESS" : "PAY HERE", {0.5f, 0.35f}, 0.2f, {0.75f, 0.78f, 0.8f}, 0.8f);
  canvas.Rectangle({0.2f, 0.6f}, {0.8f, 0.8f}, {0.10f, 0.45f, 0.15f});
  b.Use(Screen(200), canvas.Finish("ticket screen " + std::to_string(variant)));
  b.Picture({-half * 0.55f, y - 0.0035f, h * 0.735f}, {half * 0.55f, y - 0.0035f, h * 0.735f}, {half * 0.55f, y - 0.0035f, h * 0.885f},
            {-half * 0.55f, y - 0.0035f, h * 0.885f});
  b.Use(Glow({0.10f, 0.8f, 0.15f}, 200, Burns::kAlways));
  b.mesh().Tube({0, y, h * 0.63f}, {0, y - 0.012f, h * 0.63f}, 0.03f, 0.027f, 18, false);
  b.Use(Plastic({0.03f, 0.03f, 0.033f}, 0.5f));
  for (int i = 0; i < 9; ++i)
    b.mesh().Tube({-0.02f + 0.02f * static_cast<float>(i % 3), y, h * 0.47f + 0.02f * static_cast<float>(i / 3)},
                  {-0.02f + 0.02f * static_cast<float>(i % 3), y - 0.002f, h * 0.47f + 0.02f * static_cast<float>(i / 3)}, 0.005f, 0.005f,
                  8, false);
  if (variant == 0) {  // its guard hoop
    b.Use(Paint(kYellow, 0.4f));
    b.Bar(std::array<Vec3f, 6>{Vec3f{-0.30f, -0.22f, 0}, Vec3f{-0.30f, -0.22f, 0.62f}, Vec3f{-0.24f, -0.22f, 0.70f},
                               Vec3f{0.24f, -0.22f, 0.70f}, Vec3f{0.30f, -0.22f, 0.62f}, Vec3f{0.30f, -0.22f, 0}},
          0.03f, 12);
  }
  return b.Finish();
}

// Cabinet with a boom of 3 m along +X: down (variants 0, 2) or up.
Model MakeBarrierGate(uint32_t variant, uint64_t) {
  PropBuilder b("barrier_gate");
  UseCoatedSteel(b, variant == 2 ? Vec3f{0.50f, 0.51f, 0.52f} : Vec3f{0.58f, 0.22f, 0.02f}, 0.35f);
  // The model is centred: the cabinet stands at its left end.
  const float x = variant == 1 ? 0.0f : -1.55f;
  SoftBox(b, {x - 0.17f, -0.15f, 0.04f}, {x + 0.17f, 0.19f, 1.02f}, {.round = 0.03f, .crown = 0.002f, .cells = 6});
  b.Use(Plastic(kBumper, 0.5f));
  b.BevelBox({x - 0.20f, -0.18f, 0}, {x + 0.20f, 0.22f, 0.045f}, 0.006f);
  b.mesh().Tube({x, -0.15f, 0.90f}, {x, -0.24f, 0.90f}, 0.07f, 0.065f, 20);
  b.Use(Paint({0.74f, 0.74f, 0.72f}));
  b.BevelBox({x - 0.06f, -0.152f, 0.55f}, {x + 0.06f, -0.148f, 0.75f}, 0.001f);
  b.Place(Turn(0, variant == 1 ? -86.0f : 0.0f, 0, {x, -0.21f, 0.90f}));
  for (int i = 0; i < 10; ++i) {
    b.Use(i % 2 ? Plastic({0.50f, 0.03f, 0.025f}, 0.4f) : Plastic({0.74f, 0.74f, 0.73f}, 0.4f));
    const float x0 = 0.05f + 0.305f * static_cast<float>(i);
    b.BevelBox({x0, -0.02f, -0.045f}, {x0 + 0.305f, 0.02f, 0.045f}, 0.010f);
  }
  b.Use(Plastic(kBumper, 0.6f));
  b.BevelBox({-0.35f, -0.025f, -0.05f}, {0.06f, 0.025f, 0.05f}, 0.006f);
  b.BevelBox({0.10f, -0.018f, -0.06f}, {3.1f, 0.018f, -0.043f}, 0.004f);
  b.Place({});
  b.Use(Glow({0.9f, 0.05f, 0.03f}, 300, Burns::kAlways));
  b.mesh().Sphere({x, 0.02f, 1.03f}, {0.045f, 0.045f, 0.045f}, 10, 16);
  return b.Finish();
}

}  // namespace

FurnishingRows CarParkRows() {
  return {{{"wheel_stop", "traffic/barrier/concrete_block", 2, MakeWheelStop, 0.95f, 0.09f, 0.12f, 800}},
          {{"pillar_guard", "traffic/barrier/barrier", 2, MakePillarGuard, 0.35f, 0.78f, 1.02f, 600}},
          {{"parking_sign", "signage/traffic_sign", 4, MakeParkingSign, 0.65f, 0.78f, 0.82f, 200}, Mount::kCeiling},
          {{"ticket_machine", "traffic/control/parking_meter", 2, MakeTicketMachine, 0.5f, 1.2f, 1.8f, 1200}},
          {{"barrier_gate", "traffic/control/barrier_gate", 3, MakeBarrierGate, 1.8f, 1.0f, 4.1f, 2000}}};
}

}  // namespace airsim360::internal
