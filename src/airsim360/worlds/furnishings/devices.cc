// Screens, computers and printers. Panels of 24 and 27 inches and ultra-wide 34; laptops of 14 inches.
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kBlackPlastic{0.02f, 0.021f, 0.023f};
constexpr float kNits = 150;

// What is on a screen: an editor, a table of figures, a plan.
const Texture& Desktop(uint32_t kind) {
  static const std::array<Texture, 3> pictures = [] {
    std::array<Texture, 3> all;
    for (uint32_t k = 0; k < 3; ++k) {
      const bool dark = k == 0;
      Canvas canvas(256, 144, dark ? Vec3f{0.012f, 0.014f, 0.020f} : Vec3f{0.70f, 0.71f, 0.72f});
      RngStream rng(97 + k, "desktop");
      canvas.Rectangle({0, 0}, {1, 0.05f}, dark ? Vec3f{0.03f, 0.033f, 0.045f} : Vec3f{0.07f, 0.16f, 0.30f});
      canvas.Rectangle({0, 0.05f}, {0.16f, 1}, dark ? Vec3f{0.02f, 0.023f, 0.03f} : Vec3f{0.52f, 0.54f, 0.56f});
      const Vec3f inks[4] = {{0.40f, 0.50f, 0.60f}, {0.55f, 0.32f, 0.12f}, {0.20f, 0.45f, 0.22f}, {0.50f, 0.50f, 0.48f}};
      for (float y = 0.10f; y < 0.95f; y += 0.036f) {
        canvas.Rectangle({0.02f, y}, {0.04f + static_cast<float>(rng.Uniform(0.02, 0.10)), y + 0.014f},
                         dark ? Vec3f{0.25f, 0.27f, 0.3f} : Vec3f{0.2f, 0.22f, 0.25f});
        if (k == 2) continue;
        float x = 0.19f + (dark ? 0.03f * static_cast<float>(rng.Index(4)) : 0.0f);
        while (x < (dark ? 0.75f : 0.96f) && rng.Chance(0.86)) {
          const float w = dark ? static_cast<float>(rng.Uniform(0.02, 0.09)) : 0.07f;
          canvas.Rectangle({x, y}, {x + w * (dark ? 1 : 0.7f), y + 0.016f}, dark ? inks[rng.Index(4)] : Vec3f{0.15f, 0.16f, 0.18f});
          x += w + (dark ? 0.012f : 0.03f);
        }
      }
      if (k == 2) {
        for (int i = 0; i < 9; ++i)
          canvas.Rectangle({0.24f + 0.08f * static_cast<float>(i), 0.9f - static_cast<float>(rng.Uniform(0.1, 0.45))},
                           {0.29f + 0.08f * static_cast<float>(i), 0.9f}, inks[i % 3] * 0.9f);
        for (int i = 0; i < 12; ++i)
          canvas.Line({0.22f + 0.06f * static_cast<float>(i), 0.30f + 0.08f * std::sin(static_cast<float>(i))},
                      {0.28f + 0.06f * static_cast<float>(i), 0.30f + 0.08f * std::sin(static_cast<float>(i + 1))}, 0.012f,
                      {0.45f, 0.08f, 0.06f});
      }
      all[k] = canvas.Finish("desktop " + std::to_string(k));
    }
    return all;
  }();
  return pictures[kind % 3];
}

void ScreenFace(PropBuilder& b, float half, float z0, float z1, float y, int picture) {
  if (picture < 0)
    b.Use(Plastic({0.010f, 0.010f, 0.011f}, 0.12f));
  else
    b.Use(Screen(kNits), Desktop(static_cast<uint32_t>(picture)));
  b.Picture({-half, y, z0}, {half, y, z0}, {half, y, z1}, {-half, y, z1});
}

// On, off, wide and on, on an arm-like foot.
Model MakeMonitor(uint32_t variant, uint64_t) {
  PropBuilder b("monitor");
  const float half = std::array{0.266f, 0.266f, 0.405f, 0.299f}[variant], h = std::array{0.30f, 0.30f, 0.345f, 0.337f}[variant], z = 0.13f;
  b.Use(Plastic(variant == 3 ? Vec3f{0.55f, 0.56f, 0.57f} : kBlackPlastic, 0.4f));
  b.BevelBox({-half - 0.008f, -0.012f, z}, {half + 0.008f, 0.014f, z + h + 0.022f}, 0.004f);
  SoftBox(b, {-half * 0.55f, 0.008f, z + 0.06f}, {half * 0.55f, 0.055f, z + h - 0.03f}, {.round = 0.03f, .crown = 0.004f, .cells = 6});
  b.BevelBox({-0.03f, 0.05f, 0.01f}, {0.03f, 0.075f, z + h * 0.6f}, 0.008f);
  RoundedBoard(b, {-0.13f, -0.09f}, {0.13f, 0.11f}, 0.02f, 0, 0.014f, 0.005f);
  ScreenFace(b, half, z + 0.016f, z + 0.016f + h, -0.0125f, variant == 1 ? -1 : static_cast<int>(variant) % 3);
  return b.Finish();
}

// Tower beside or under a desk, small box, all black or silver.
Model MakeComputer(uint32_t variant, uint64_t) {
  PropBuilder b("computer");
  const float w = variant == 1 ? 0.05f : 0.09f, d = variant == 1 ? 0.15f : 0.21f, h = std::array{0.40f, 0.29f, 0.45f}[variant];
  UseCoatedSteel(b, variant == 2 ? Vec3f{0.42f, 0.43f, 0.44f} : kBlackPlastic, 0.4f);
  b.BevelBox({-w, -d + 0.012f, 0.012f}, {w, d, h}, 0.004f);
  b.Use(Plastic(variant == 2 ? Vec3f{0.10f, 0.10f, 0.11f} : Vec3f{0.03f, 0.03f, 0.033f}, 0.3f));
  b.BevelBox({-w, -d, 0.012f}, {w, -d + 0.014f, h}, 0.005f);
  for (float x : {-w + 0.015f, w - 0.015f}) b.BevelBox({x - 0.012f, -d + 0.02f, 0}, {x + 0.012f, d - 0.03f, 0.014f}, 0.003f);
  b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.5f));
  for (int i = 0; i < 9; ++i)
    b.BevelBox({-w * 0.75f, -d - 0.0008f, 0.05f + 0.014f * static_cast<float>(i)},
               {w * 0.75f, -d + 0.002f, 0.056f + 0.014f * static_cast<float>(i)}, 0.0005f);
  b.BevelBox({-w * 0.8f, -d - 0.001f, h - 0.07f}, {w * 0.8f, -d + 0.002f, h - 0.035f}, 0.001f);
  b.Use(Chrome());
  b.mesh().Tube({w * 0.55f, -d, h - 0.10f}, {w * 0.55f, -d - 0.003f, h - 0.10f}, 0.009f, 0.008f, 14, false);
  Material led = Glow({0.25f, 0.5f, 1.0f}, 120, Burns::kAlways);
  b.Use(led);
  b.BevelBox({w * 0.25f, -d - 0.0015f, h - 0.104f}, {w * 0.32f, -d, h - 0.096f}, 0.0005f);
  return b.Finish();
}

// With a mouse on its right, and a mat under it in one variant.
Model MakeKeyboard(uint32_t variant, uint64_t) {
  PropBuilder b("keyboard");
  const Vec3f shell = variant == 1 ? Vec3f{0.62f, 0.63f, 0.64f} : kBlackPlastic,
              key = variant == 1 ? Vec3f{0.72f, 0.72f, 0.72f} : Vec3f{0.035f, 0.036f, 0.04f};
  const float z0 = variant == 2 ? 0.003f : 0.0f;
  if (variant == 2) {
    UsePile(b, {0.035f, 0.04f, 0.05f});
    RoundedBoard(b, {-0.32f, -0.16f}, {0.32f, 0.14f}, 0.015f, 0, 0.003f, 0.001f);
  }
  b.Place(Move({-0.07f, 0, z0}));
  b.Use(Plastic(shell, 0.45f));
  b.BevelBox({-0.22f, -0.065f, 0}, {0.22f, 0.065f, 0.014f}, 0.003f);
  b.Use(Plastic(key, 0.55f));
  for (int row = 0; row < 6; ++row) {
    const float y = 0.053f - 0.019f * static_cast<float>(row) - (row > 0 ? 0.004f : 0);
    float x = -0.213f;
    for (int k = 0; x < 0.205f; ++k) {
      float w = row == 5 && k == 3 ? 0.11f : k == 0 && row > 1 ? 0.026f : 0.0165f;
      if (x > 0.065f && x < 0.08f) x = 0.083f;  // gaps between the blocks
      if (x > 0.135f && x < 0.145f) x = 0.148f;
      b.mesh().Box({x, y - 0.0155f, 0.013f}, {x + w, y, 0.0185f}, MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
      x += w + 0.0025f;
    }
  }
  b.Place(Move({0.235f, -0.01f, z0}));
  b.Use(Plastic(shell, 0.35f));
  SoftBox(b, {-0.031f, -0.056f, 0}, {0.031f, 0.056f, 0.03f}, {.round = 0.028f, .crown = 0.006f, .cells = 7});
  b.Use(Rubber());
  b.mesh().Tube({-0.004f, -0.030f, 0.031f}, {0.004f, -0.030f, 0.031f}, 0.009f, 0.009f, 12);
  b.Place({});
  return b.Finish();
}

// Open with the screen on, open and dark, closed.
Model MakeLaptop(uint32_t variant, uint64_t) {
  PropBuilder b("laptop");
  const Vec3f shell = variant == 1 ? kBlackPlastic : Vec3f{0.50f, 0.51f, 0.52f};
  const float half = 0.16f, d = 0.11f;
  b.Use(Metal(shell, 0.4f));
  RoundedBoard(b, {-half, -d}, {half, d}, 0.010f, 0.002f, 0.014f, 0.003f);
  b.Use(Plastic({0.03f, 0.03f, 0.033f}, 0.5f));
  b.mesh().Box({-half + 0.02f, -d + 0.02f, 0}, {half - 0.02f, d - 0.02f, 0.003f});
  if (variant < 2) {
    for (int row = 0; row < 5; ++row)
      for (int k = 0; k < 14; ++k) {
        const float x = -0.14f + 0.0202f * static_cast<float>(k), y = 0.075f - 0.0195f * static_cast<float>(row);
        b.mesh().Box({x, y - 0.0165f, 0.0135f}, {x + 0.0172f, y, 0.0152f}, MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
      }
    b.mesh().Box({-0.05f, -d + 0.012f, 0.0135f}, {0.05f, -0.03f, 0.0143f}, MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
  }
  b.Place(Turn(variant == 2 ? 90.0f : -18.0f, 0, 0, {0, d - 0.004f, 0.015f}));
  b.Use(Metal(shell, 0.4f));
  b.BevelBox({-half, -0.003f, 0}, {half, 0.003f, 0.215f}, 0.002f);
  if (variant < 2) ScreenFace(b, half - 0.008f, 0.015f, 0.208f, -0.0034f, variant == 0 ? 2 : -1);
  b.Place({});
  return b.Finish();
}

// Desk telephone with its receiver, or a mobile telephone lying.
Model MakePhone(uint32_t variant, uint64_t) {
  PropBuilder b("phone");
  if (variant == 1) {
    b.Use(Plastic({0.012f, 0.012f, 0.014f}, 0.08f));
    RoundedBoard(b, {-0.036f, -0.074f}, {0.036f, 0.074f}, 0.010f, 0, 0.008f, 0.002f);
    b.Use(Metal({0.4f, 0.4f, 0.42f}, 0.3f));
    b.BevelBox({-0.0366f, -0.06f, 0.001f}, {0.0366f, 0.06f, 0.006f}, 0.001f);
    return b.Finish();
  }
  b.Use(Plastic(kBlackPlastic, 0.4f));
  b.Place(Turn(14, 0, 0, {0, 0, 0.025f}));
  RoundedBoard(b, {-0.09f, -0.09f}, {0.09f, 0.09f}, 0.012f, 0, 0.022f, 0.005f);
  const Vec3f receiver[] = {{-0.06f, -0.095f, 0.036f}, {-0.06f, -0.06f, 0.048f}, {-0.06f, 0.06f, 0.048f}, {-0.06f, 0.095f, 0.036f}};
  const float radii[] = {0.026f, 0.017f, 0.017f, 0.026f};
  b.Bar(receiver, radii, 12);
  b.Use(Plastic({0.25f, 0.26f, 0.27f}, 0.4f));
  for (int i = 0; i < 12; ++i) {
    const float x = 0.0f + 0.024f * static_cast<float>(i % 3), y = 0.0f - 0.022f * static_cast<float>(i / 3);
    b.BevelBox({x, y - 0.014f, 0.021f}, {x + 0.018f, y, 0.025f}, 0.001f);
  }
  b.Use(Plastic({0.20f, 0.26f, 0.22f}, 0.15f));
  b.BevelBox({-0.005f, 0.025f, 0.021f}, {0.07f, 0.072f, 0.024f}, 0.001f);
  b.Place({});
  b.Use(Plastic(kBlackPlastic, 0.5f));
  b.BevelBox({-0.07f, -0.06f, 0}, {0.07f, 0.085f, 0.035f}, 0.004f);
  std::vector<Vec3f> cord;
  for (int i = 0; i <= 60; ++i) {
    const float t = static_cast<float>(i) / 60, a = 6.283f * 12 * t;
    cord.push_back({-0.085f - 0.03f * std::sin(3.14f * t) + 0.004f * std::cos(a), -0.09f + 0.16f * t, 0.010f + 0.004f * std::sin(a)});
  }
  b.Bar(cord, 0.0018f, 4);
  return b.Finish();
}

// Multifunction device on its paper drawers, or a small one for a table.
Model MakePrinter(uint32_t variant, uint64_t) {
  PropBuilder b("printer");
  const Vec3f shell{0.68f, 0.68f, 0.67f};
  const float half = variant == 0 ? 0.30f : 0.21f, d = variant == 0 ? 0.32f : 0.19f, base = variant == 0 ? 0.56f : 0.12f,
              h = variant == 0 ? 1.08f : 0.30f;
  b.Use(Plastic(shell, 0.4f));
  b.BevelBox({-half, -d, variant == 0 ? 0.05f : 0.008f}, {half, d, base}, 0.008f);
  b.BevelBox({-half, -d + 0.02f, base + 0.004f}, {half, d, base + (h - base) * 0.45f}, 0.008f);
  b.BevelBox({-half, d - 0.12f, base + (h - base) * 0.4f}, {half, d, h - (h - base) * 0.3f}, 0.008f);
  b.BevelBox({-half, -d, h - (h - base) * 0.34f}, {half, d, h - 0.03f * (h - base) - 0.02f}, 0.010f);
  b.Use(Plastic({0.10f, 0.105f, 0.11f}, 0.4f));
  b.BevelBox({-half + 0.004f, -d + 0.01f, h - (h - base) * 0.06f - 0.02f}, {half - 0.004f, d - 0.004f, h}, 0.012f);
  b.BevelBox({-half + 0.02f, -d + 0.03f, base + (h - base) * 0.45f}, {half - 0.02f, d - 0.12f, base + (h - base) * 0.47f}, 0.002f);
  const int drawers = variant == 0 ? 3 : 1;
  for (int i = 0; i < drawers; ++i) {
    const float z = (variant == 0 ? 0.07f : 0.02f) + (base - 0.06f) / static_cast<float>(drawers) * static_cast<float>(i);
    b.BevelBox({-half * 0.35f, -d - 0.004f, z + 0.05f}, {half * 0.35f, -d + 0.004f, z + 0.075f}, 0.002f);
    b.mesh().Box({-half + 0.002f, -d - 0.0006f, z}, {half - 0.002f, -d + 0.001f, z + 0.004f});
  }
  b.Use(Plastic({0.05f, 0.05f, 0.055f}, 0.3f));
  b.Place(Turn(-32, 0, 0, {half * 0.25f, -d - 0.005f, h - (h - base) * 0.30f}));
  b.BevelBox({-half * 0.55f, -0.012f, 0}, {half * 0.55f, 0.010f, variant == 0 ? 0.13f : 0.06f}, 0.004f);
  b.Use(Screen(120), Desktop(1));
  b.Picture({-half * 0.45f, -0.0125f, 0.012f}, {half * 0.2f, -0.0125f, 0.012f}, {half * 0.2f, -0.0125f, variant == 0 ? 0.118f : 0.05f},
            {-half * 0.45f, -0.0125f, variant == 0 ? 0.118f : 0.05f});
  b.Place({});
  b.Use(Stone({0.76f, 0.75f, 0.72f}, 0.9f));
  b.BevelBox({-0.105f, -d + 0.04f, base + (h - base) * 0.47f}, {0.105f, d - 0.16f, base + (h - base) * 0.47f + 0.012f}, 0.001f);
  b.Use(Plastic({0.03f, 0.03f, 0.03f}));
  for (float x : {-half + 0.06f, half - 0.06f})
    for (float y : {-d + 0.06f, d - 0.06f}) b.mesh().Tube({x, y, 0}, {x, y, variant == 0 ? 0.055f : 0.012f}, 0.022f, 0.022f, 12);
  return b.Finish();
}

// Bottle of 19 litres on a stand with two taps, or a slim one without.
Model MakeWaterDispenser(uint32_t variant, uint64_t) {
  PropBuilder b("water_dispenser");
  const float half = 0.155f, d = 0.165f, h = variant == 0 ? 0.96f : 1.15f;
  b.Use(Plastic(variant == 0 ? Vec3f{0.72f, 0.73f, 0.73f} : kBlackPlastic, 0.35f));
  SoftBox(b, {-half, -d + 0.02f, 0}, {half, d, h}, {.round = 0.02f, .crown = 0.002f, .cells = 6});
  SoftBox(b, {-half, -d, 0}, {half, d - 0.05f, h * 0.62f}, {.round = 0.02f, .crown = 0.003f, .cells = 6});
  b.BevelBox({-half, -d, h * 0.86f}, {half, d, h}, 0.015f);
  b.Use(Plastic({0.05f, 0.052f, 0.055f}, 0.4f));
  b.BevelBox({-half + 0.02f, -d - 0.008f, h * 0.62f}, {half - 0.02f, -d + 0.05f, h * 0.64f}, 0.004f);
  for (const auto& [x, tone] : {std::pair{-0.05f, Vec3f{0.05f, 0.10f, 0.45f}}, std::pair{0.05f, Vec3f{0.5f, 0.04f, 0.03f}}}) {
    b.Use(Plastic(tone, 0.35f));
    b.mesh().Tube({x, -d + 0.03f, h * 0.81f}, {x, -d - 0.045f, h * 0.80f}, 0.013f, 0.011f, 12);
    b.mesh().Tube({x, -d - 0.035f, h * 0.80f}, {x, -d - 0.035f, h * 0.755f}, 0.009f, 0.007f, 10);
  }
  if (variant == 0) {
    b.Use(ClearGlass({0.55f, 0.75f, 0.92f}));
    const Vec2f bottle[] = {{0.03f, h - 0.01f},  {0.05f, h + 0.03f},  {0.132f, h + 0.08f}, {0.135f, h + 0.17f},
                            {0.128f, h + 0.18f}, {0.135f, h + 0.19f}, {0.135f, h + 0.28f}, {0.128f, h + 0.29f},
                            {0.135f, h + 0.30f}, {0.132f, h + 0.38f}, {0.11f, h + 0.40f},  {0, h + 0.40f}};
    b.Lathe(bottle, 28);
  } else {
    Material panel = Screen(80);
    b.Use(panel, Desktop(2));
    b.Picture({-0.06f, -d - 0.0005f, h * 0.90f}, {0.06f, -d - 0.0005f, h * 0.90f}, {0.06f, -d - 0.0005f, h * 0.96f},
              {-0.06f, -d - 0.0005f, h * 0.96f});
  }
  return b.Finish();
}

}  // namespace

FurnishingRows DeviceRows() {
  return {{{"monitor", "furniture/electronics/monitor", 4, MakeMonitor, 0.4f, 0.42f, 0.52f, 1200}, Mount::kSurface},
          {{"computer", "furniture/electronics/computer", 3, MakeComputer, 0.25f, 0.28f, 0.47f, 1500}},
          {{"keyboard", "furniture/electronics", 3, MakeKeyboard, 0.3f, 0.02f, 0.06f, 3000}, Mount::kSurface},
          {{"laptop", "furniture/electronics/computer", 3, MakeLaptop, 0.22f, 0.015f, 0.25f, 1500}, Mount::kSurface},
          {{"phone", "object/phone", 2, MakePhone, 0.15f, 0.007f, 0.13f, 2500}, Mount::kSurface},
          {{"printer", "furniture/electronics", 2, MakePrinter, 0.45f, 0.28f, 1.12f, 1200}},
          {{"water_dispenser", "furniture/electronics", 2, MakeWaterDispenser, 0.25f, 1.1f, 1.40f, 1800}}};
}

}  // namespace airsim360::internal
