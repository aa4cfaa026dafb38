// What moves and stands about in warehouses. Counterbalance truck of 1.6 t (VDI 2198 type sheet sizes): 1.10 m wide, 2.0 m
// long without forks, mast 2.1 m lowered; drums of 200 l (ISO 15750-2): 58.5 cm across, 88 high.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

void Tyre(PropBuilder& b, Vec3f hub, float r, float wide) {
  b.Place(Turn(0, 90, 0, hub));
  b.Use(Rubber());
  const Vec2f tyre[] = {{r * 0.62f, -wide / 2}, {r * 0.93f, -wide / 2}, {r, -wide * 0.36f},
                        {r, wide * 0.36f},      {r * 0.93f, wide / 2},  {r * 0.62f, wide / 2}};
  b.Lathe(tyre, 28);
  b.Use(Paint({0.62f, 0.62f, 0.60f}));
  const Vec2f rim[] = {
      {0, -wide * 0.42f}, {r * 0.62f, -wide * 0.46f}, {r * 0.62f, wide * 0.46f}, {r * 0.3f, wide * 0.38f}, {0, wide * 0.40f}};
  b.Lathe(rim, 20);
  b.Place({});
}

void Mast(PropBuilder& b, float y, float lift) {
  b.Use(Paint({0.035f, 0.036f, 0.04f}, 0.45f));
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({s * 0.30f - 0.035f, y - 0.06f, 0.08f}, {s * 0.30f + 0.035f, y + 0.06f, 2.10f}, 0.006f);
    b.BevelBox({s * 0.24f - 0.025f, y - 0.05f, 0.10f + lift * 0.5f}, {s * 0.24f + 0.025f, y + 0.05f, 2.08f + lift * 0.5f}, 0.006f);
    b.mesh().Tube({s * 0.17f, y + 0.02f, 0.15f}, {s * 0.17f, y + 0.02f, 1.15f}, 0.035f, 0.035f, 12);
  }
  for (float z : {0.25f, 1.1f, 2.02f}) b.BevelBox({-0.30f, y - 0.03f, z}, {0.30f, y + 0.03f, z + 0.07f}, 0.005f);
  b.Use(Chrome());
  for (float x : {-0.17f, 0.17f}) b.mesh().Tube({x, y + 0.02f, 1.15f}, {x, y + 0.02f, 1.95f}, 0.022f, 0.022f, 12);
  b.Use(CastIron());
  for (float x : {-0.06f, 0.06f}) b.mesh().Beam({x, y, 0.3f + lift}, {x, y, 1.95f}, 0.022f);  // chains
  // Carriage and forks.
  b.Use(Paint({0.035f, 0.036f, 0.04f}, 0.5f));
  for (float z : {0.18f, 0.52f}) b.BevelBox({-0.50f, y - 0.12f, z + lift}, {0.50f, y - 0.07f, z + 0.09f + lift}, 0.006f);
  for (int i = 0; i < 7; ++i) {
    const float x = -0.48f + 0.16f * static_cast<float>(i);
    b.BevelBox({x - 0.012f, y - 0.11f, 0.55f + lift}, {x + 0.012f, y - 0.08f, 1.15f + lift}, 0.003f);
  }
  b.BevelBox({-0.50f, y - 0.115f, 1.13f + lift}, {0.50f, y - 0.075f, 1.17f + lift}, 0.004f);
  b.Use(Metal({0.30f, 0.30f, 0.31f}, 0.5f));
  for (float x : {-0.27f, 0.27f}) {
    b.BevelBox({x - 0.06f, y - 0.16f, 0.05f + lift}, {x + 0.06f, y - 0.12f, 0.62f + lift}, 0.004f);
    const Vec2f blade[] = {{y - 0.16f, 0.05f}, {y - 0.16f, 0.095f}, {y - 1.20f, 0.07f}, {y - 1.24f, 0.05f}};
    for (int i = 0; i < 4; ++i) {
      const Vec2f p = blade[i], q = blade[(i + 1) % 4];
      b.mesh().Quad({x - 0.06f, q.x, q.y + lift}, {x + 0.06f, q.x, q.y + lift}, {x + 0.06f, p.x, p.y + lift}, {x - 0.06f, p.x, p.y + lift});
    }
    for (float s : {-1.0f, 1.0f}) {
      const auto at = [&](int i) { return Vec3f{x + 0.06f * s, blade[i].x, blade[i].y + lift}; };
      if (s > 0) {
        b.mesh().Triangle(at(0), at(1), at(2));
        b.mesh().Triangle(at(0), at(2), at(3));
      } else {
        b.mesh().Triangle(at(2), at(1), at(0));
        b.mesh().Triangle(at(3), at(2), at(0));
      }
    }
  }
}

// Counterweight, bonnet, seat, overhead guard, mast with forks towards -Y.
Model MakeForklift(uint32_t variant, uint64_t) {
  PropBuilder b("forklift");
  const Vec3f tone = std::array<Vec3f, 3>{{{0.62f, 0.33f, 0.01f}, {0.55f, 0.05f, 0.03f}, {0.10f, 0.28f, 0.16f}}}[variant];
  const float front = -0.55f;
  Mast(b, front - 0.12f, std::array{0.05f, 0.0f, 1.1f}[variant]);
  for (float s : {-1.0f, 1.0f}) {
    Tyre(b, {s * 0.44f, front + 0.20f, 0.30f}, 0.30f, 0.19f);
    Tyre(b, {s * 0.42f, 0.80f, 0.23f}, 0.23f, 0.15f);
  }
  b.Use(Paint(tone, 0.3f));
  // Body in profile, extruded across: counterweight behind, step in the middle.
  SoftBox(b, {-0.53f, 0.52f, 0.22f}, {0.53f, 1.28f, 1.02f}, {.round = 0.14f, .crown = 0.01f, .cells = 8});
  SoftBox(b, {-0.50f, -0.12f, 0.42f}, {0.50f, 0.72f, 0.88f}, {.round = 0.06f, .crown = 0.004f, .cells = 6});
  for (float s : {-1.0f, 1.0f})
    SoftBox(b, {s * 0.44f - 0.11f, front - 0.06f, 0.58f}, {s * 0.44f + 0.11f, front + 0.50f, 0.70f},
            {.round = 0.05f, .crown = 0.01f, .cells = 6});
  b.BevelBox({-0.34f, front - 0.04f, 0.20f}, {0.34f, front + 0.10f, 0.98f}, 0.03f);
  b.Use(Paint({0.05f, 0.052f, 0.055f}, 0.6f));
  b.BevelBox({-0.52f, front + 0.05f, 0.30f}, {0.52f, 0.60f, 0.44f}, 0.02f);
  b.BevelBox({-0.24f, front + 0.06f, 0.95f}, {0.24f, front + 0.16f, 1.10f}, 0.03f);
  // Overhead guard.
  for (float s : {-1.0f, 1.0f}) {
    b.Bar(std::array<Vec3f, 5>{Vec3f{s * 0.46f, front + 0.05f, 0.60f}, Vec3f{s * 0.45f, front + 0.12f, 1.30f},
                               Vec3f{s * 0.43f, front + 0.36f, 2.05f}, Vec3f{s * 0.43f, front + 0.50f, 2.12f},
                               Vec3f{s * 0.43f, 0.72f, 2.12f}},
          0.032f, 8);
    b.Bar(std::array<Vec3f, 3>{Vec3f{s * 0.43f, 0.72f, 2.12f}, Vec3f{s * 0.44f, 0.80f, 2.02f}, Vec3f{s * 0.46f, 0.90f, 0.95f}}, 0.032f, 8);
  }
  for (int i = 0; i < 7; ++i) {
    const float y = front + 0.46f + 0.135f * static_cast<float>(i);
    b.mesh().Beam({-0.43f, y, 2.125f}, {0.43f, y, 2.125f}, 0.028f);
  }
  UseLeather(b, {0.03f, 0.03f, 0.032f});
  SoftBox(b, {-0.25f, 0.02f, 0.88f}, {0.25f, 0.50f, 1.02f}, {.round = 0.05f, .crown = 0.01f, .cells = 7});
  b.Place(Turn(-10, 0, 0, {0, 0.50f, 0.98f}));
  SoftBox(b, {-0.23f, -0.06f, 0}, {0.23f, 0.06f, 0.52f}, {.round = 0.05f, .crown = 0.015f, .cells = 7});
  b.Place({});
  b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.5f));
  b.Bar(std::array<Vec3f, 2>{Vec3f{0, front + 0.14f, 1.02f}, Vec3f{0, front + 0.32f, 1.28f}}, 0.022f, 10);
  std::vector<Vec3f> wheel;
  for (int i = 0; i <= 24; ++i) {
    const float a = kTauF * static_cast<float>(i % 24) / 24;
    wheel.push_back({0.16f * std::cos(a), front + 0.32f - 0.09f * std::sin(a), 1.29f + 0.13f * std::sin(a)});
  }
  b.Bar(wheel, 0.013f, 8);
  for (int i = 0; i < 3; ++i)
    b.Bar(std::array<Vec3f, 2>{Vec3f{0.20f + 0.05f * static_cast<float>(i), front + 0.14f, 0.98f},
                               Vec3f{0.20f + 0.05f * static_cast<float>(i), front + 0.20f, 1.18f}},
          0.008f, 6);
  // Beacon and lamps.
  b.Use(Plastic({0.70f, 0.25f, 0.01f}, 0.2f));
  b.mesh().Tube({0.30f, 0.60f, 2.14f}, {0.30f, 0.60f, 2.25f}, 0.045f, 0.038f, 14);
  b.Use(Plastic({0.74f, 0.74f, 0.72f}, 0.15f));
  for (float s : {-1.0f, 1.0f}) b.mesh().Tube({s * 0.44f, front + 0.13f, 1.62f}, {s * 0.44f, front + 0.06f, 1.62f}, 0.055f, 0.065f, 16);
  return b.Finish();
}

Model MakeDrum(uint32_t variant, uint64_t) {
  PropBuilder b("drum");
  const Vec3f tone =
      std::array<Vec3f, 4>{{{0.03f, 0.09f, 0.26f}, {0.45f, 0.04f, 0.03f}, {0.06f, 0.22f, 0.10f}, {0.05f, 0.11f, 0.30f}}}[variant];
  const float r = 0.285f;
  if (variant == 3)
    b.Use(Plastic(tone, 0.45f));
  else
    UseCoatedSteel(b, tone, 0.4f);
  const Vec2f body[] = {{0, 0.012f},          {r - 0.012f, 0.012f}, {r, 0.0f},
                        {r + 0.006f, 0.008f}, {r, 0.02f},           {r, 0.27f},
                        {r + 0.012f, 0.285f}, {r + 0.012f, 0.295f}, {r, 0.31f},
                        {r, 0.57f},           {r + 0.012f, 0.585f}, {r + 0.012f, 0.595f},
                        {r, 0.61f},           {r, 0.858f},          {r + 0.007f, 0.866f},
                        {r + 0.004f, 0.878f}, {r - 0.008f, 0.878f}, {r - 0.014f, 0.862f},
                        {0, 0.862f}};
  b.Lathe(body, 40);
  b.Use(Metal({0.45f, 0.45f, 0.44f}, 0.4f));
  for (const Vec2f p : {Vec2f{0.19f, 0}, Vec2f{-0.20f, 0.04f}}) {
    const Vec2f bung[] = {{0.035f, 0.862f}, {0.035f, 0.872f}, {0.03f, 0.877f}, {0, 0.877f}};
    b.Lathe(bung, 16, {p.x, p.y, 0});
  }
  b.Use(Stone({0.74f, 0.74f, 0.71f}, 0.7f));  // label
  for (int i = 0; i < 6; ++i) {
    const float a0 = -2.1f + 0.18f * static_cast<float>(i), a1 = a0 + 0.18f;
    const auto at = [&](float a, float z) { return Vec3f{(r + 0.001f) * std::cos(a), (r + 0.001f) * std::sin(a), z}; };
    const Vec3f n0{std::cos(a0), std::sin(a0), 0}, n1{std::cos(a1), std::sin(a1), 0};
    b.mesh().SmoothTriangle({at(a0, 0.36f), at(a1, 0.36f), at(a1, 0.54f)}, {n0, n1, n1}, {{}, {}, {}});
    b.mesh().SmoothTriangle({at(a0, 0.36f), at(a1, 0.54f), at(a0, 0.54f)}, {n0, n1, n0}, {{}, {}, {}});
  }
  return b.Finish();
}

// Two-wheeled truck for sacks; variant 1 is a pallet truck with its tiller.
Model MakeHandTruck(uint32_t variant, uint64_t) {
  PropBuilder b("hand_truck");
  if (variant == 0) {
    b.Use(Paint({0.42f, 0.05f, 0.03f}, 0.35f));
    for (float s : {-1.0f, 1.0f})
      b.Bar(std::array<Vec3f, 5>{Vec3f{s * 0.17f, -0.10f, 0.03f}, Vec3f{s * 0.17f, -0.06f, 0.30f}, Vec3f{s * 0.17f, 0.05f, 1.05f},
                                 Vec3f{s * 0.17f, 0.12f, 1.18f}, Vec3f{s * 0.17f, 0.20f, 1.22f}},
            0.014f, 10);
    for (float z : {0.25f, 0.50f, 0.75f, 1.0f})
      b.mesh().Tube({-0.17f, -0.10f + 0.145f * z, z}, {0.17f, -0.10f + 0.145f * z, z}, 0.010f, 0.010f, 8);
    b.BevelBox({-0.22f, -0.34f, 0.012f}, {0.22f, -0.09f, 0.020f}, 0.003f);
    for (float s : {-1.0f, 1.0f}) b.Bar(std::array<Vec3f, 2>{Vec3f{s * 0.17f, -0.05f, 0.40f}, Vec3f{s * 0.19f, 0.10f, 0.13f}}, 0.011f, 8);
    b.mesh().Tube({-0.25f, 0.10f, 0.13f}, {0.25f, 0.10f, 0.13f}, 0.010f, 0.010f, 8);
    for (float s : {-1.0f, 1.0f}) Tyre(b, {s * 0.225f, 0.10f, 0.13f}, 0.13f, 0.075f);
    b.Use(Rubber());
    for (float s : {-1.0f, 1.0f}) b.mesh().Tube({s * 0.17f, 0.17f, 1.21f}, {s * 0.17f, 0.29f, 1.24f}, 0.018f, 0.018f, 10);
    return b.Finish();
  }
  b.Use(Paint({0.60f, 0.30f, 0.01f}, 0.35f));
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({s * 0.19f - 0.08f, -1.05f, 0.035f}, {s * 0.19f + 0.08f, 0.12f, 0.085f}, 0.012f);
    b.mesh().Tube({s * 0.19f - 0.035f, -0.95f, 0.04f}, {s * 0.19f + 0.035f, -0.95f, 0.04f}, 0.04f, 0.04f, 14);
  }
  b.BevelBox({-0.27f, 0.10f, 0.035f}, {0.27f, 0.24f, 0.40f}, 0.03f);
  b.Use(Chrome());
  b.mesh().Tube({0, 0.30f, 0.20f}, {0, 0.30f, 0.52f}, 0.035f, 0.035f, 14);
  b.Use(Paint({0.03f, 0.03f, 0.033f}));
  b.Bar(std::array<Vec3f, 3>{Vec3f{0, 0.32f, 0.42f}, Vec3f{0, 0.42f, 0.90f}, Vec3f{0, 0.46f, 1.05f}}, 0.018f, 10);
  b.Bar(std::array<Vec3f, 6>{Vec3f{0, 0.46f, 1.05f}, Vec3f{-0.10f, 0.47f, 1.10f}, Vec3f{-0.12f, 0.49f, 1.20f}, Vec3f{0.12f, 0.49f, 1.20f},
                             Vec3f{0.10f, 0.47f, 1.10f}, Vec3f{0, 0.46f, 1.05f}},
        0.013f, 8);
  for (float s : {-1.0f, 1.0f}) Tyre(b, {s * 0.06f, 0.30f, 0.10f}, 0.10f, 0.05f);
  return b.Finish();
}

// Step ladder of aluminium, a platform ladder on wheels, a leaning one without a wall stands closed on end.
Model MakeLadder(uint32_t variant, uint64_t) {
  PropBuilder b("ladder");
  if (variant == 0) {
    const float top = 1.75f;
    b.Use(Metal({0.66f, 0.67f, 0.68f}, 0.35f));
    for (float s : {-1.0f, 1.0f}) {
      b.mesh().Beam({s * 0.27f, -0.50f, 0.03f}, {s * 0.19f, 0.0f, top}, 0.034f);
      b.mesh().Beam({s * 0.27f, 0.48f, 0.03f}, {s * 0.19f, 0.06f, top - 0.04f}, 0.026f);
    }
    for (int i = 1; i <= 6; ++i) {
      const float t = 0.25f * static_cast<float>(i) / top, y = -0.50f + 0.50f * t;
      b.BevelBox({-0.27f + 0.08f * t, y - 0.04f, 0.25f * static_cast<float>(i) - 0.012f},
                 {0.27f - 0.08f * t, y + 0.045f, 0.25f * static_cast<float>(i) + 0.012f}, 0.004f);
    }
    for (float z : {0.45f, 1.0f}) b.mesh().Tube({-0.24f, 0.48f - 0.24f * z, z}, {0.24f, 0.48f - 0.24f * z, z}, 0.010f, 0.010f, 8);
    b.Use(Plastic({0.42f, 0.04f, 0.03f}, 0.45f));
    b.BevelBox({-0.22f, -0.06f, top - 0.02f}, {0.22f, 0.12f, top + 0.03f}, 0.012f);
    b.Use(Rubber());
    for (float s : {-1.0f, 1.0f})
      for (float y : {-0.505f, 0.485f}) b.BevelBox({s * 0.27f - 0.024f, y - 0.024f, 0}, {s * 0.27f + 0.024f, y + 0.024f, 0.05f}, 0.005f);
    return b.Finish();
  }
  b.Use(Paint({0.05f, 0.16f, 0.36f}, 0.4f));  // platform ladder, eight steps to 2 m
  for (int i = 0; i < 8; ++i) {
    const float y = -0.95f + 0.17f * static_cast<float>(i), z = 0.25f * static_cast<float>(i + 1);
    b.BevelBox({-0.34f, y - 0.10f, z - 0.02f}, {0.34f, y + (i == 7 ? 0.55f : 0.10f), z}, 0.004f);
  }
  for (float s : {-1.0f, 1.0f}) {
    b.mesh().Beam({s * 0.36f, -1.05f, 0.05f}, {s * 0.36f, 0.24f, 1.97f}, 0.04f);
    b.mesh().Beam({s * 0.38f, 0.85f, 0.05f}, {s * 0.36f, 0.75f, 1.98f}, 0.04f);
    b.mesh().Beam({s * 0.38f, -1.0f, 0.08f}, {s * 0.38f, 0.85f, 0.08f}, 0.04f);
    b.Bar(std::array<Vec3f, 5>{Vec3f{s * 0.37f, -0.80f, 0.55f}, Vec3f{s * 0.37f, -0.86f, 1.30f}, Vec3f{s * 0.37f, 0.20f, 2.92f},
                               Vec3f{s * 0.37f, 0.75f, 2.95f}, Vec3f{s * 0.37f, 0.76f, 1.98f}},
          0.018f, 8);
    b.mesh().Beam({s * 0.37f, 0.25f, 1.98f}, {s * 0.37f, 0.82f, 0.6f}, 0.028f);
  }
  b.Bar(std::array<Vec3f, 2>{Vec3f{-0.37f, 0.76f, 2.94f}, Vec3f{0.37f, 0.76f, 2.94f}}, 0.018f, 8);
  for (float x : {-0.38f, 0.38f})
    for (float y : {-0.92f, 0.80f}) Tyre(b, {x, y, 0.06f}, 0.06f, 0.03f);
  return b.Finish();
}

// Guard rail of rack ends (two beams on posts, 1.2 m), or a hoop; yellow with black bands.
Model MakeSafetyBarrier(uint32_t variant, uint64_t) {
  PropBuilder b("safety_barrier");
  const Vec3f yellow{0.68f, 0.42f, 0.01f}, black{0.03f, 0.03f, 0.03f};
  UseCoatedSteel(b, yellow, 0.45f);
  if (variant == 0) {
    for (float x : {-0.58f, 0.58f}) {
      b.BevelBox({x - 0.045f, -0.045f, 0.01f}, {x + 0.045f, 0.045f, 0.62f}, 0.008f);
      b.BevelBox({x - 0.11f, -0.11f, 0}, {x + 0.11f, 0.11f, 0.012f}, 0.003f);
    }
    for (float z : {0.16f, 0.44f})
      SoftBox(b, {-0.70f, -0.09f, z}, {0.70f, -0.035f, z + 0.15f}, {.round = 0.02f, .crown = 0.006f, .cells = 6});
    UseCoatedSteel(b, black, 0.45f);
    for (float z : {0.16f, 0.44f})
      for (int i = 0; i < 6; ++i) {
        const float x = -0.62f + 0.22f * static_cast<float>(i);
        b.mesh().Quad({x, -0.0985f, z + 0.012f}, {x + 0.09f, -0.0985f, z + 0.012f}, {x + 0.15f, -0.0985f, z + 0.138f},
                      {x + 0.06f, -0.0985f, z + 0.138f});
      }
  } else {
    std::vector<Vec3f> hoop = {{-0.40f, 0, 0}, {-0.40f, 0, 0.85f}};
    for (int i = 1; i < 6; ++i)
      hoop.push_back(
          {-0.40f + 0.15f * (1 - std::cos(0.2618f * static_cast<float>(i))), 0, 0.85f + 0.15f * std::sin(0.2618f * static_cast<float>(i))});
    hoop.push_back({-0.25f, 0, 1.0f});
    const size_t n = hoop.size();
    for (size_t i = 0; i < n; ++i) hoop.push_back({-hoop[n - 1 - i].x, 0, hoop[n - 1 - i].z});
    b.Bar(hoop, 0.038f, 14);
    b.mesh().Tube({-0.40f, 0, 0.5f}, {0.40f, 0, 0.5f}, 0.030f, 0.030f, 12);
    for (float x : {-0.40f, 0.40f}) b.BevelBox({x - 0.10f, -0.08f, 0}, {x + 0.10f, 0.08f, 0.012f}, 0.003f);
    b.Use(Plastic(black, 0.5f));
    for (float x : {-0.40f, 0.40f})
      for (float z : {0.2f, 0.65f}) b.mesh().Tube({x, 0, z}, {x, 0, z + 0.14f}, 0.0395f, 0.0395f, 14, false, false);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows WarehouseRows() {
  return {{{"forklift", "vehicle/forklift", 3, MakeForklift, 1.4f, 2.1f, 3.3f, 10000}},
          {{"drum", "furniture/misc", 4, MakeDrum, 0.35f, 0.86f, 0.90f, 2000}},
          {{"hand_truck", "furniture/misc", 2, MakeHandTruck, 0.9f, 1.15f, 1.30f, 3000}},
          {{"ladder", "furniture/misc", 2, MakeLadder, 0.95f, 1.7f, 3.0f, 2500}},
          {{"safety_barrier", "traffic/barrier/barrier", 2, MakeSafetyBarrier, 0.75f, 0.60f, 1.05f, 1500}}};
}

}  // namespace airsim360::internal
