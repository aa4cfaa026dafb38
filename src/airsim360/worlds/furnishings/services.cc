// Building services: safety, air, pipes, cables, switches, radiators. EN 3 extinguishers; EN 12845 sprinklers of 15 mm;
// radiators after EN 442 (60 cm high); switches in 80 mm plates at 1.05 m (DIN 18015-3).
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kWhitePaint{0.76f, 0.76f, 0.75f};

// On a bracket on the wall (variant 0: 6 kg powder, 1: CO2 with its horn), or in a box with a glass door.
Model MakeFireExtinguisher(uint32_t variant, uint64_t) {
  PropBuilder b("fire_extinguisher");
  const Vec3f red{0.46f, 0.020f, 0.016f};
  const float r = variant == 1 ? 0.055f : 0.078f, h = variant == 1 ? 0.40f : 0.42f, y = variant == 2 ? -0.11f : -r - 0.025f,
              z0 = variant == 2 ? 0.08f : 0.0f;
  b.Use(Paint(red, 0.22f));
  const Vec2f body[] = {{0, z0 + 0.012f},    {r * 0.85f, z0 + 0.004f}, {r * 0.95f, z0},
                        {r, z0 + 0.02f},     {r, z0 + h - 0.05f},      {r * 0.85f, z0 + h - 0.015f},
                        {r * 0.45f, z0 + h}, {0.02f, z0 + h + 0.012f}, {0.02f, z0 + h + 0.03f}};
  b.Lathe(body, 28, {0, y, 0});
  b.Use(Stone({0.74f, 0.73f, 0.68f}, 0.5f));
  for (int i = 0; i < 8; ++i) {  // label
    const float a0 = -2.35f + 0.2f * static_cast<float>(i), a1 = a0 + 0.2f;
    const Vec3f n0{std::cos(a0), std::sin(a0), 0}, n1{std::cos(a1), std::sin(a1), 0}, c{0, y, z0};
    const auto at = [&](Vec3f n, float z) { return c + n * (r + 0.0007f) + Vec3f{0, 0, z}; };
    const float lo = h * 0.28f, hi = h * 0.70f;
    b.mesh().SmoothTriangle({at(n0, lo), at(n1, lo), at(n1, hi)}, {n0, n1, n1}, {{}, {}, {}});
    b.mesh().SmoothTriangle({at(n0, lo), at(n1, hi), at(n0, hi)}, {n0, n1, n0}, {{}, {}, {}});
  }
  b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.4f));
  b.BevelBox({-0.016f, y - 0.05f, z0 + h + 0.025f}, {0.016f, y + 0.035f, z0 + h + 0.05f}, 0.005f);
  b.Bar(
      std::array<Vec3f, 3>{Vec3f{0, y + 0.02f, z0 + h + 0.05f}, Vec3f{0, y - 0.03f, z0 + h + 0.085f}, Vec3f{0, y - 0.10f, z0 + h + 0.075f}},
      0.008f, 8);
  b.Bar(std::array<Vec3f, 2>{Vec3f{0, y, z0 + h + 0.035f}, Vec3f{0, y - 0.10f, z0 + h + 0.045f}}, 0.007f, 8);
  std::vector<Vec3f> hose = {{0.016f, y, z0 + h + 0.035f},
                             {r * 0.9f, y - 0.01f, z0 + h + 0.02f},
                             {r + 0.022f, y - 0.015f, z0 + h * 0.75f},
                             {r + 0.020f, y - 0.01f, z0 + h * 0.35f}};
  b.Bar(hose, 0.009f, 8);
  if (variant == 1)
    b.Bar(std::array<Vec3f, 2>{Vec3f{r + 0.020f, y - 0.01f, z0 + h * 0.40f}, Vec3f{r + 0.030f, y - 0.01f, z0 + h * 0.02f + 0.01f}},
          std::array<float, 2>{0.014f, 0.032f}, 14);
  else
    b.Bar(std::array<Vec3f, 2>{Vec3f{r + 0.020f, y - 0.01f, z0 + h * 0.35f}, Vec3f{r + 0.018f, y - 0.01f, z0 + h * 0.20f}},
          std::array<float, 2>{0.012f, 0.008f}, 10);
  if (variant == 2) {
    b.Use(Paint(red, 0.35f));
    for (float s : {-1.0f, 1.0f}) b.BevelBox({s > 0 ? 0.17f : -0.18f, -0.22f, 0}, {s > 0 ? 0.18f : -0.17f, 0, 0.70f}, 0.004f);
    b.BevelBox({-0.17f, -0.22f, 0}, {0.17f, 0, 0.012f}, 0.003f);
    b.BevelBox({-0.17f, -0.22f, 0.688f}, {0.17f, 0, 0.70f}, 0.003f);
    b.mesh().Box({-0.17f, -0.006f, 0.012f}, {0.17f, 0, 0.688f});
    b.Use(ClearGlass());
    b.mesh().Quad({-0.17f, -0.215f, 0.012f}, {0.17f, -0.215f, 0.012f}, {0.17f, -0.215f, 0.688f}, {-0.17f, -0.215f, 0.688f});
  } else {
    b.Use(Metal());
    b.BevelBox({-0.02f, -0.012f, h * 0.55f}, {0.02f, 0, h * 0.95f}, 0.002f);
    std::vector<Vec3f> strap;
    for (int i = 0; i <= 16; ++i) strap.push_back(Vec3f{0, y, h * 0.72f} + Around(i, 16) * (r + 0.002f));
    b.Bar(strap, 0.003f, 5);
  }
  return b.Finish();
}

// Pendent head on its drop of pipe, or with a rosette in a ceiling.
Model MakeSprinkler(uint32_t variant, uint64_t) {
  PropBuilder b("sprinkler");
  const float drop = variant == 0 ? 0.12f : 0.0f;
  b.Use(variant == 0 ? Metal({0.60f, 0.45f, 0.20f}, 0.3f) : Chrome());
  const Vec2f deflector[] = {{0, 0.0f}, {0.006f, 0.0f}, {0.018f, 0.003f}, {0.0185f, 0.0045f}, {0.006f, 0.004f}, {0.004f, 0.012f}};
  b.Lathe(deflector, 16);
  for (float s : {-1.0f, 1.0f})
    b.Bar(std::array<Vec3f, 3>{Vec3f{s * 0.004f, 0, 0.006f}, Vec3f{s * 0.013f, 0, 0.022f}, Vec3f{s * 0.010f, 0, 0.040f}}, 0.0022f, 6);
  const Vec2f thread[] = {{0.012f, 0.038f}, {0.014f, 0.042f}, {0.014f, 0.052f}, {0.010f, 0.055f}, {0.010f, 0.065f}};
  b.Lathe(thread, 12);
  b.Use(Plastic({0.55f, 0.04f, 0.03f}, 0.1f));  // the bulb, red for 68 C
  b.mesh().Tube({0, 0, 0.012f}, {0, 0, 0.038f}, 0.0022f, 0.0022f, 8);
  if (variant == 0) {
    b.Use(Paint({0.45f, 0.03f, 0.025f}, 0.4f));
    b.mesh().Tube({0, 0, 0.062f}, {0, 0, 0.065f + drop}, 0.0135f, 0.0135f, 12);
  } else {
    b.Use(Paint(kWhitePaint));
    const Vec2f rose[] = {{0.012f, 0.050f}, {0.032f, 0.054f}, {0.036f, 0.065f}, {0, 0.065f}};
    b.Lathe(rose, 20);
  }
  return b.Finish();
}

// Swirl diffuser of 0.6 m in a ceiling grid, slotted return grille.
Model MakeAirVent(uint32_t variant, uint64_t) {
  PropBuilder b("air_vent");
  b.Use(Paint(kWhitePaint, 0.45f));
  const float half = 0.298f, rim = 0.03f, h = 0.014f;
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({-half, s > 0 ? half - rim : -half, 0.004f}, {half, s > 0 ? half : -half + rim, h}, 0.003f);
    b.BevelBox({s > 0 ? half - rim : -half, -half + rim, 0.004f}, {s > 0 ? half : -half + rim, half - rim, h}, 0.003f);
  }
  if (variant == 0) {
    for (int i = 0; i < 24; ++i) {  // vanes like a turbine's
      b.Place(Turn(0, 0, 15.0f * static_cast<float>(i)) * Turn(24, 0, 0, {0.16f, 0, 0.008f}));
      b.BevelBox({-0.095f, -0.013f, -0.001f}, {0.095f, 0.013f, 0.001f}, 0.0005f);
    }
    b.Place({});
    const Vec2f hub[] = {{0, 0.0f}, {0.055f, 0.002f}, {0.06f, 0.010f}, {0, 0.010f}};
    b.Lathe(hub, 24);
  } else {
    for (int i = 0; i < 14; ++i) {
      b.Place(Turn(35, 0, 0, {0, -0.25f + 0.0385f * static_cast<float>(i), 0.008f}));
      b.BevelBox({-half + rim, -0.014f, -0.001f}, {half - rim, 0.014f, 0.001f}, 0.0005f);
    }
    b.Place({});
  }
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.9f));
  const float back = h - 0.002f;  // clear of the ceiling
  b.mesh().Quad({-half + 0.01f, half - 0.01f, back}, {half - 0.01f, half - 0.01f, back}, {half - 0.01f, -half + 0.01f, back},
                {-half + 0.01f, -half + 0.01f, back});
  return b.Finish();
}

// One metre along X. Rectangular 0.5 x 0.3 m with its flanges, spiral-seamed 0.4 m, flat 0.8 x 0.25. Open ends meet the next
// piece.
Model MakeDuct(uint32_t variant, uint64_t) {
  PropBuilder b("duct");
  UseGalvanised(b);
  if (variant == 1) {
    const float r = 0.20f;
    const auto at = [&](float u, float v) {
      const float a = 6.2831853f * v, seam = std::fmod(u * 8 + v, 1.0f) < 0.10f ? 0.004f : 0.0f;
      return Vec3f{u - 0.5f, -(r + seam) * std::cos(a), r + 0.004f + (r + seam) * std::sin(a)};
    };
    b.Sheet(64, 28, [&](float u, float v) { return at(u, 1 - v); }, {1.0f, 1.26f});
    return b.Finish();
  }
  const float y = variant == 0 ? 0.25f : 0.40f, h = variant == 0 ? 0.30f : 0.25f;
  b.mesh().Box({-0.5f, -y, 0.02f}, {0.5f, y, h + 0.02f}, MeshBuilder::kAllSides & ~(MeshBuilder::kLeft | MeshBuilder::kRight));
  for (float x : {-0.5f, 0.47f}) {
    b.BevelBox({x, -y - 0.02f, 0}, {x + 0.03f, y + 0.02f, 0.02f}, 0.002f);
    b.BevelBox({x, -y - 0.02f, h + 0.02f}, {x + 0.03f, y + 0.02f, h + 0.04f}, 0.002f);
    for (float s : {-1.0f, 1.0f}) b.BevelBox({x, s > 0 ? y : -y - 0.02f, 0.02f}, {x + 0.03f, s > 0 ? y + 0.02f : -y, h + 0.02f}, 0.002f);
  }
  for (int i = 1; i < 4; ++i) {  // cross breaks stiffen the sheets
    const float x = -0.5f + 0.25f * static_cast<float>(i);
    b.mesh().Beam({x, -y + 0.02f, 0.0195f}, {x, y - 0.02f, 0.0195f}, 0.006f);
    for (float s : {-1.0f, 1.0f}) b.mesh().Beam({x, s * (y + 0.0005f), 0.04f}, {x, s * (y + 0.0005f), h}, 0.006f);
  }
  return b.Finish();
}

// One metre along X: red sprinkler main, a pair of insulated heating pipes, grey drain.
Model MakePipeRun(uint32_t variant, uint64_t) {
  PropBuilder b("pipe_run");
  if (variant == 0) {
    b.Use(Paint({0.42f, 0.025f, 0.02f}, 0.35f));
    b.mesh().Tube({-0.5f, 0, 0.05f}, {0.5f, 0, 0.05f}, 0.038f, 0.038f, 18, false, false);
    b.Use(CastIron());
    b.mesh().Tube({-0.04f, 0, 0.05f}, {0.04f, 0, 0.05f}, 0.048f, 0.048f, 18);
    for (float s : {-1.0f, 1.0f}) b.BevelBox({-0.035f, s * 0.052f - 0.014f, 0.03f}, {0.035f, s * 0.052f + 0.014f, 0.07f}, 0.004f);
  } else if (variant == 1) {
    for (float y : {-0.08f, 0.08f}) {
      b.Use(Metal({0.66f, 0.66f, 0.66f}, 0.42f));
      b.mesh().Tube({-0.5f, y, 0.065f}, {0.5f, y, 0.065f}, 0.055f, 0.055f, 20, false, false);
      for (float x : {-0.25f, 0.25f}) b.mesh().Tube({x - 0.012f, y, 0.065f}, {x + 0.012f, y, 0.065f}, 0.0565f, 0.0565f, 20);
      b.Use(y < 0 ? Paint({0.45f, 0.05f, 0.03f}) : Paint({0.04f, 0.12f, 0.38f}));
      b.mesh().Tube({0.05f, y, 0.065f}, {0.13f, y, 0.065f}, 0.0562f, 0.0562f, 20);
    }
    b.Use(Metal());
    b.BevelBox({-0.02f, -0.16f, 0}, {0.02f, 0.16f, 0.010f}, 0.002f);
  } else {
    b.Use(Plastic({0.36f, 0.37f, 0.38f}, 0.5f));
    b.mesh().Tube({-0.5f, 0, 0.07f}, {0.5f, 0, 0.07f}, 0.055f, 0.055f, 20, false, false);
    b.mesh().Tube({-0.10f, 0, 0.07f}, {0.02f, 0, 0.07f}, 0.064f, 0.064f, 20);
    b.Use(Metal());
    for (float x : {-0.35f, 0.35f}) b.mesh().Tube({x - 0.013f, 0, 0.07f}, {x + 0.013f, 0, 0.07f}, 0.060f, 0.060f, 20);
  }
  return b.Finish();
}

// One metre along X: perforated tray 0.3 m wide with cables, wire basket.
Model MakeCableTray(uint32_t variant, uint64_t) {
  PropBuilder b("cable_tray");
  UseGalvanised(b);
  const float y = 0.15f;
  if (variant == 0) {
    b.mesh().Box({-0.5f, -y, 0}, {0.5f, y, 0.002f});
    for (float s : {-1.0f, 1.0f}) b.mesh().Box({-0.5f, s > 0 ? y - 0.002f : -y, 0}, {0.5f, s > 0 ? y : -y + 0.002f, 0.06f});
    b.Use(Plastic({0.02f, 0.02f, 0.021f}, 0.9f));  // slots
    for (int i = 0; i < 10; ++i)
      for (int k = 0; k < 5; ++k) {
        const float x = -0.47f + 0.1f * static_cast<float>(i) + (k % 2 ? 0.05f : 0), py = -0.11f + 0.055f * static_cast<float>(k);
        b.mesh().Quad({x, py + 0.004f, -0.0004f}, {x + 0.025f, py + 0.004f, -0.0004f}, {x + 0.025f, py - 0.004f, -0.0004f},
                      {x, py - 0.004f, -0.0004f});
      }
  } else {
    for (int i = 0; i <= 6; ++i)
      b.mesh().Tube({-0.5f, -y + 0.05f * static_cast<float>(i), 0.004f}, {0.5f, -y + 0.05f * static_cast<float>(i), 0.004f}, 0.0025f,
                    0.0025f, 6, false, false);
    for (int i = 0; i < 10; ++i) {
      const float x = -0.45f + 0.1f * static_cast<float>(i);
      b.Bar(std::array<Vec3f, 4>{Vec3f{x, -y, 0.06f}, Vec3f{x, -y, 0.002f}, Vec3f{x, y, 0.002f}, Vec3f{x, y, 0.06f}}, 0.0025f, 6);
    }
    for (float s : {-1.0f, 1.0f}) b.mesh().Tube({-0.5f, s * y, 0.058f}, {0.5f, s * y, 0.058f}, 0.0025f, 0.0025f, 6, false, false);
  }
  const Vec3f tones[4] = {{0.03f, 0.03f, 0.033f}, {0.42f, 0.42f, 0.40f}, {0.05f, 0.10f, 0.32f}, {0.50f, 0.28f, 0.03f}};
  for (int i = 0; i < 9; ++i) {
    b.Use(Plastic(tones[i % 4], 0.5f));
    const float py = -0.11f + 0.027f * static_cast<float>(i), r = 0.006f + 0.003f * static_cast<float>(i % 3);
    std::vector<Vec3f> cable;
    for (int k = 0; k <= 5; ++k)
      cable.push_back({-0.5f + 0.2f * static_cast<float>(k), py + (k % 5 ? 0.006f * std::sin(2.3f * static_cast<float>(i + k)) : 0.0f),
                       0.003f + r + (i % 4 == 3 ? 0.012f : 0)});
    b.Bar(cable, r, 7);
  }
  return b.Finish();
}

Model MakeSmokeDetector(uint32_t variant, uint64_t) {
  PropBuilder b("smoke_detector");
  b.Use(Plastic(kWhitePaint, 0.4f));
  const Vec2f dome[] = {{0, 0}, {0.022f, 0.0f}, {0.030f, 0.004f}, {0.034f, 0.010f}};
  b.Lathe(dome, 28);
  const Vec2f base[] = {{0.036f, 0.022f}, {0.046f, 0.026f}, {0.052f, 0.034f}, {0.052f, 0.045f}, {0, 0.045f}};
  b.Lathe(base, 28);
  for (int i = 0; i < 12; ++i)
    b.mesh().Tube(Around(i, 12) * 0.035f + Vec3f{0, 0, 0.009f}, Around(i, 12) * 0.037f + Vec3f{0, 0, 0.024f}, 0.003f, 0.003f, 6);
  b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.8f));
  b.mesh().Tube({0, 0, 0.008f}, {0, 0, 0.024f}, 0.031f, 0.031f, 20, false, false);
  b.Use(variant == 0 ? Glow({0.8f, 0.05f, 0.03f}, 60, Burns::kAlways) : Plastic({0.30f, 0.02f, 0.02f}, 0.2f));
  b.mesh().Sphere({0.042f, 0, 0.0275f}, {0.0025f, 0.0025f, 0.0025f}, 6, 10);
  return b.Finish();
}

// Rocker, two rockers, a socket (sill 0.30 m), a thermostat.
Model MakeSwitchPlate(uint32_t variant, uint64_t) {
  PropBuilder b("switch_plate");
  b.Use(Plastic(kWhitePaint, 0.3f));
  const float half = 0.0405f;
  b.BevelBox({-half, -0.009f, 0}, {half, 0, 2 * half}, 0.003f);
  if (variant == 2) {
    b.Place(Turn(90, 0, 0, {0, -0.0092f, half}));
    b.Use(Plastic({0.60f, 0.60f, 0.59f}, 0.4f));
    b.Lathe(std::array<Vec2f, 3>{Vec2f{0.0215f, 0.0002f}, Vec2f{0.0205f, 0.0006f}, Vec2f{0, 0.0004f}}, 28);
    b.Use(Plastic({0.01f, 0.01f, 0.011f}, 0.9f));
    for (float x : {-0.0095f, 0.0095f}) b.Lathe(std::array<Vec2f, 2>{Vec2f{0.0026f, 0.0012f}, Vec2f{0, 0.0012f}}, 10, {x, 0, 0});
    b.Place({});
  } else if (variant == 3) {
    b.Use(Plastic({0.012f, 0.013f, 0.014f}, 0.1f));
    b.BevelBox({-0.028f, -0.011f, 0.030f}, {0.028f, -0.008f, 0.066f}, 0.002f);
    b.Use(Plastic({0.55f, 0.55f, 0.55f}, 0.4f));
    for (float x : {-0.015f, 0.015f}) b.mesh().Tube({x, -0.009f, 0.016f}, {x, -0.012f, 0.016f}, 0.006f, 0.006f, 12, false);
  } else {
    const int keys = variant == 0 ? 1 : 2;
    for (int k = 0; k < keys; ++k) {
      const float w = 0.052f / static_cast<float>(keys), x = -0.026f + w * static_cast<float>(k);
      b.Place(Turn(k ? -4.0f : 4.0f, 0, 0, {0, -0.009f, half}));
      b.BevelBox({x + 0.0005f, -0.005f, -0.026f}, {x + w - 0.0005f, 0.002f, 0.026f}, 0.0015f);
    }
    b.Place({});
  }
  return b.Finish();
}

// Panel radiator with its valve, column radiator, towel rail.
Model MakeRadiator(uint32_t variant, uint64_t) {
  PropBuilder b("radiator");
  b.Use(Paint(kWhitePaint, 0.3f));
  const float half = variant == 2 ? 0.25f : 0.50f, y = -0.10f;
  if (variant == 0) {
    for (float py : {y - 0.0f, y + 0.065f}) {
      b.BevelBox({-half, py - 0.006f, 0.0f}, {half, py + 0.006f, 0.60f}, 0.005f);
      for (int i = 0; i < 24; ++i) {
        const float x = -half + 0.03f + 0.0412f * static_cast<float>(i);
        if (py < -0.05f) b.BevelBox({x - 0.012f, py - 0.013f, 0.035f}, {x + 0.012f, py, 0.565f}, 0.006f);
      }
    }
    b.BevelBox({-half, y - 0.004f, 0.595f}, {half, y + 0.07f, 0.61f}, 0.003f);
    for (int i = 0; i < 30; ++i) {
      const float x = -half + 0.025f + 0.0328f * static_cast<float>(i);
      b.mesh().Box({x, y + 0.008f, 0.609f}, {x + 0.018f, y + 0.06f, 0.6112f});
    }
  } else if (variant == 1) {
    for (int i = 0; i < 16; ++i) {
      const float x = -half + 0.03f + 0.0625f * static_cast<float>(i);
      for (float py : {-0.135f, -0.085f, -0.035f}) b.mesh().Tube({x, py, 0.03f}, {x, py, 0.57f}, 0.0125f, 0.0125f, 8, false, false);
      for (float z : {0.03f, 0.57f}) b.mesh().Sphere({x, -0.085f, z}, {0.024f, 0.070f, 0.03f}, 6, 10);
    }
    for (float z : {0.03f, 0.57f}) b.mesh().Tube({-half, -0.085f, z}, {half, -0.085f, z}, 0.018f, 0.018f, 10);
  } else {
    for (float s : {-1.0f, 1.0f}) b.mesh().Tube({s * half, -0.06f, 0}, {s * half, -0.06f, 1.40f}, 0.017f, 0.017f, 12);
    for (int i = 0; i < 20; ++i) {
      if (i % 7 == 6) continue;
      const float z = 0.06f + 0.067f * static_cast<float>(i);
      b.Bar(std::array<Vec3f, 4>{Vec3f{-half, -0.06f, z}, Vec3f{-half * 0.5f, -0.085f, z}, Vec3f{half * 0.5f, -0.085f, z},
                                 Vec3f{half, -0.06f, z}},
            0.010f, 8);
    }
    for (float z : {0.2f, 1.2f})
      for (float s : {-1.0f, 1.0f}) b.mesh().Tube({s * half, -0.06f, z}, {s * half, 0, z}, 0.010f, 0.010f, 8);
  }
  if (variant < 2) {
    for (float s : {-1.0f, 1.0f}) b.BevelBox({s * half * 0.7f - 0.015f, y + 0.04f, 0.1f}, {s * half * 0.7f + 0.015f, 0, 0.55f}, 0.002f);
    b.Use(Plastic(kWhitePaint, 0.35f));
    b.mesh().Tube({half, -0.07f, 0.05f}, {half + 0.035f, -0.07f, 0.05f}, 0.012f, 0.012f, 10);
    const Vec3f knob[] = {{half + 0.03f, -0.07f, 0.05f}, {half + 0.05f, -0.07f, 0.05f}, {half + 0.10f, -0.07f, 0.05f}};
    const float radii[] = {0.016f, 0.024f, 0.021f};
    b.Bar(knob, radii, 16);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows ServiceRows() {
  return {{{"fire_extinguisher", "construction/service/fire_extinguisher", 3, MakeFireExtinguisher, 0.25f, 0.45f, 0.72f, 2000},
           Mount::kWall,
           0.45f},
          {{"sprinkler", "construction/service/sprinkler", 2, MakeSprinkler, 0.1f, 0.06f, 0.20f, 700}, Mount::kCeiling},
          {{"air_vent", "construction/service/air_vent", 2, MakeAirVent, 0.45f, 0.012f, 0.02f, 1800}, Mount::kCeiling},
          {{"duct", "construction/service/duct", 3, MakeDuct, 0.6f, 0.27f, 0.42f, 4000}, Mount::kCeiling},
          {{"pipe_run", "construction/service/pipe", 3, MakePipeRun, 0.5f, 0.08f, 0.14f, 1000}, Mount::kCeiling},
          {{"cable_tray", "construction/service", 2, MakeCableTray, 0.5f, 0.05f, 0.07f, 1800}, Mount::kCeiling},
          {{"smoke_detector", "construction/service", 2, MakeSmokeDetector, 0.1f, 0.044f, 0.046f, 1200}, Mount::kCeiling},
          {{"switch_plate", "construction/service", 4, MakeSwitchPlate, 0.1f, 0.08f, 0.085f, 300}, Mount::kWall, 1.05f},
          {{"radiator", "furniture/radiator", 3, MakeRadiator, 0.6f, 0.58f, 1.45f, 6000}, Mount::kWall, 0.15f}};
}

}  // namespace airsim360::internal
