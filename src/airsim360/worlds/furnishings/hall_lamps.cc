// Lamps of offices, shops, halls and car parks, which burn day and night. Flux and colour as in makers' data sheets: a
// 0.6 m panel 3600 lm at 4000 K, a batten of 1.5 m 5000 lm, a high bay 20,000 lm at 5000 K, a downlight 900 lm at 3000 K;
// luminance of exit signs at least 2 cd/m^2 on green and 10 on white when lit from within (EN 1838), 200 in use.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/lamp_area.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// A rectangle that faces down, at height z.
void FaceDown(PropBuilder& b, Vec2f lo, Vec2f hi, float z) {
  b.mesh().Quad({lo.x, hi.y, z}, {hi.x, hi.y, z}, {hi.x, lo.y, z}, {lo.x, lo.y, z});
}

// Recessed: only its frame, 6 mm, hangs below the ceiling. Variant 1 is 1.2 x 0.3 m.
Model MakeCeilingPanel(uint32_t variant, uint64_t) {
  PropBuilder b("ceiling_panel");
  const Vec2f half = variant == 0 ? Vec2f{0.298f, 0.298f} : Vec2f{0.598f, 0.148f};
  const float rim = 0.014f, h = 0.012f;
  b.Use(Paint({0.76f, 0.76f, 0.75f}));
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({-half.x, s > 0 ? half.y - rim : -half.y, 0}, {half.x, s > 0 ? half.y : -half.y + rim, h}, 0.003f);
    b.BevelBox({s > 0 ? half.x - rim : -half.x, -half.y + rim, 0}, {s > 0 ? half.x : -half.x + rim, half.y - rim, h}, 0.003f);
  }
  b.mesh().Quad({-half.x + rim, -half.y + rim, h}, {half.x - rim, -half.y + rim, h}, {half.x - rim, half.y - rim, h},
                {-half.x + rim, half.y - rim, h});
  const Vec2f inner{half.x - rim, half.y - rim};
  b.Use(LampSurface(3600, 4 * inner.x * inner.y, 4000, Burns::kAlways));
  FaceDown(b, inner * -1, inner, 0.004f);
  return b.Finish();
}

// Closed batten against damp, an open tube on its gear, or a thin line for offices that hangs on wires 0.5 m long.
Model MakeTubeLight(uint32_t variant, uint64_t) {
  PropBuilder b("tube_light");
  const float half = 0.75f;
  if (variant == 2) {
    b.Use(Paint({0.03f, 0.031f, 0.033f}));
    b.BevelBox({-half, -0.03f, 0.004f}, {half, 0.03f, 0.07f}, 0.003f);
    for (float x : {-0.6f, 0.6f}) {
      b.mesh().Tube({x, 0, 0.07f}, {x, 0, 0.56f}, 0.0012f, 0.0012f, 5);
      b.mesh().Tube({x, 0, 0.55f}, {x, 0, 0.57f}, 0.025f, 0.03f, 12);
    }
    b.Use(LampSurface(5000, 2 * (half - 0.004f) * 0.052f, 4000, Burns::kAlways));
    FaceDown(b, {-half + 0.004f, -0.026f}, {half - 0.004f, 0.026f}, 0.0035f);
    b.Use(Paint({0.03f, 0.031f, 0.033f}));
    for (float s : {-1.0f, 1.0f}) b.BevelBox({-half, s * 0.028f - 0.002f, 0}, {half, s * 0.028f + 0.002f, 0.006f}, 0.001f);
    return b.Finish();
  }
  b.Use(Plastic({0.60f, 0.61f, 0.61f}, 0.4f));
  b.BevelBox({-half, -0.045f, 0.055f}, {half, 0.045f, 0.10f}, 0.006f);
  if (variant == 0) {
    // Diffuser: half a cylinder below the tray.
    constexpr int kSteps = 10;
    const float r = 0.048f;
    b.Use(LampSurface(5000, kPiF * r * 2 * (half - 0.02f), 4000, Burns::kAlways));
    for (int i = 0; i < kSteps; ++i) {
      const float a0 = kPiF * static_cast<float>(i) / kSteps, a1 = kPiF * static_cast<float>(i + 1) / kSteps;
      const auto at = [&](float x, float a) { return Vec3f{x, -r * std::cos(a), 0.056f - r * std::sin(a)}; };
      const auto n = [](float a) { return Vec3f{0, -std::cos(a), -std::sin(a)}; };
      const float x0 = -half + 0.02f, x1 = half - 0.02f;
      b.mesh().SmoothTriangle({at(x0, a1), at(x1, a1), at(x1, a0)}, {n(a1), n(a1), n(a0)}, {{}, {}, {}});
      b.mesh().SmoothTriangle({at(x0, a1), at(x1, a0), at(x0, a0)}, {n(a1), n(a0), n(a0)}, {{}, {}, {}});
    }
    b.Use(Plastic({0.60f, 0.61f, 0.61f}, 0.4f));
    for (float s : {-1.0f, 1.0f}) b.mesh().Tube({s * (half - 0.02f), 0, 0.054f}, {s * half, 0, 0.054f}, 0.052f, 0.050f, 20);
    for (float x : {-0.5f, 0.0f, 0.5f})
      for (float s : {-1.0f, 1.0f}) b.BevelBox({x - 0.012f, s * 0.047f - 0.006f, 0.035f}, {x + 0.012f, s * 0.047f + 0.006f, 0.09f}, 0.002f);
  } else {
    for (float s : {-1.0f, 1.0f})
      b.BevelBox({s * (half - 0.02f) - 0.012f, -0.02f, 0.0f}, {s * (half - 0.02f) + 0.012f, 0.02f, 0.06f}, 0.004f);
    const float r = 0.013f;
    b.Use(LampSurface(5000, 2 * kPiF * r * 2 * (half - 0.03f), 4000, Burns::kAlways));
    b.mesh().Tube({-half + 0.03f, 0, 0.022f}, {half - 0.03f, 0, 0.022f}, r, r, 14, false, false);
  }
  return b.Finish();
}

// LED disc or the older bell with a lens; on a hook 0.3 m below the roof.
Model MakeHighBayLamp(uint32_t variant, uint64_t) {
  PropBuilder b("high_bay_lamp");
  const float r = variant == 0 ? 0.19f : 0.24f;
  if (variant == 0) {
    b.Use(Paint({0.035f, 0.036f, 0.038f}, 0.5f));
    const Vec2f body[] = {{r - 0.01f, 0.0f}, {r, 0.008f}, {r, 0.05f}, {r - 0.02f, 0.06f}, {0.09f, 0.07f}, {0.085f, 0.16f}, {0, 0.165f}};
    b.Lathe(body, 40);
    for (int i = 0; i < 20; ++i) {  // cooling fins
      const float a = 18.0f * static_cast<float>(i);
      b.Place(Turn(0, 0, a, {}));
      b.BevelBox({0.085f, -0.002f, 0.058f}, {r - 0.03f, 0.002f, 0.12f}, 0.001f);
    }
    b.Place({});
  } else {
    b.Use(Metal({0.62f, 0.62f, 0.61f}, 0.25f));
    const Vec2f bell[] = {{r, 0}, {r * 0.96f, 0.08f}, {r * 0.78f, 0.20f}, {r * 0.50f, 0.28f}};
    b.Lathe(bell, 40);
    const Vec2f inside[] = {{r * 0.49f, 0.28f}, {r * 0.77f, 0.197f}, {r * 0.95f, 0.078f}, {r * 0.99f, 0}};
    b.Lathe(inside, 40);
    b.Use(Paint({0.30f, 0.31f, 0.32f}, 0.5f));
    const Vec2f gear[] = {{r * 0.50f, 0.28f}, {0.10f, 0.30f}, {0.10f, 0.44f}, {0.08f, 0.46f}, {0, 0.46f}};
    b.Lathe(gear, 28);
  }
  const float body_top = variant == 0 ? 0.16f : 0.46f, top = body_top + 0.30f;
  b.Use(Metal());
  b.mesh().Tube({0, 0, body_top}, {0, 0, top}, 0.006f, 0.006f, 8);
  b.mesh().Tube({0, 0, body_top}, {0, 0, body_top + 0.04f}, 0.022f, 0.012f, 12);
  const float lens = r - 0.012f, z = variant == 0 ? 0.004f : 0.06f;
  b.Use(LampSurface(20000, kPiF * lens * lens, 5000, Burns::kAlways));
  const Vec2f disc[] = {{0, z}, {lens, z}};
  b.Lathe(disc, 40);
  return b.Finish();
}

// Recessed spot: a ring, a reflector, an LED. Variants 0 and 1 burn always, 2 and 3 in the dark hours (homes).
Model MakeDownlight(uint32_t variant, uint64_t) {
  PropBuilder b("downlight");
  const Burns burns = variant < 2 ? Burns::kAlways : Burns::kAtNight;
  const float kelvin = variant == 0 ? 4000.0f : variant == 1 ? 3000.0f : 2700.0f;
  b.Use(variant % 2 ? Paint({0.03f, 0.03f, 0.032f}) : Paint({0.76f, 0.76f, 0.75f}));
  const Vec2f ring[] = {{0.055f, 0.0008f}, {0.068f, 0}, {0.075f, 0.003f}, {0.076f, 0.008f}, {0, 0.008f}};
  b.Lathe(ring, 36);
  const float lens = 0.054f;
  b.Use(LampSurface(900, kPiF * lens * lens, kelvin, burns));
  const Vec2f disc[] = {{0, 0.0015f}, {lens, 0.0015f}};
  b.Lathe(disc, 32);
  return b.Finish();
}

// Running figure, arrow and door in white on green (ISO 7010 E001, E002).
const Texture& ExitPicture(bool left) {
  static const std::array<Texture, 2> pictures = [] {
    std::array<Texture, 2> both;
    for (int k = 0; k < 2; ++k) {
      Canvas canvas(256, 128, {0.0f, 0.24f, 0.09f});
      const Vec3f white{0.85f, 0.87f, 0.85f};
      const auto x = [&](float u) { return k == 1 ? 1 - u : u; };
      const auto bar = [&](float u0, float v0, float u1, float v1, float t) { canvas.Line({x(u0), v0}, {x(u1), v1}, t, white); };
      const auto box = [&](float u0, float v0, float u1, float v1) {
        canvas.Rectangle({std::min(x(u0), x(u1)), v0}, {std::max(x(u0), x(u1)), v1}, white);
      };
      box(0.56f, 0.14f, 0.60f, 0.88f);  // the door's frame
      box(0.56f, 0.14f, 0.86f, 0.20f);
      box(0.83f, 0.14f, 0.86f, 0.88f);
      canvas.Disc({x(0.66f), 0.27f}, 0.065f, white);
      bar(0.66f, 0.36f, 0.70f, 0.58f, 0.11f);
      bar(0.66f, 0.40f, 0.75f, 0.46f, 0.05f);
      bar(0.66f, 0.40f, 0.60f, 0.52f, 0.05f);
      bar(0.70f, 0.58f, 0.76f, 0.70f, 0.07f);
      bar(0.76f, 0.70f, 0.74f, 0.84f, 0.06f);
      bar(0.69f, 0.58f, 0.65f, 0.74f, 0.07f);
      bar(0.65f, 0.74f, 0.60f, 0.76f, 0.06f);
      box(0.20f, 0.46f, 0.44f, 0.54f);  // the arrow
      bar(0.20f, 0.50f, 0.28f, 0.36f, 0.08f);
      bar(0.20f, 0.50f, 0.28f, 0.64f, 0.08f);
      both[static_cast<size_t>(k)] = canvas.Finish(k ? "exit right" : "exit left");
    }
    return both;
  }();
  return pictures[left ? 0 : 1];
}

// Hung from a ceiling, both faces lit; its length of rods is 0.10 m.
Model MakeExitSign(uint32_t variant, uint64_t) {
  PropBuilder b("exit_sign");
  b.Use(Paint({0.72f, 0.72f, 0.71f}));
  b.BevelBox({-0.17f, -0.022f, 0}, {0.17f, 0.022f, 0.18f}, 0.004f);
  for (float x : {-0.12f, 0.12f}) b.mesh().Tube({x, 0, 0.18f}, {x, 0, 0.28f}, 0.004f, 0.004f, 6);
  b.BevelBox({-0.15f, -0.02f, 0.265f}, {0.15f, 0.02f, 0.28f}, 0.003f);
  Material face = Screen(200);
  face.name = "lit sign";
  face.base_color = {0.5f, 0.5f, 0.5f};
  b.Use(face, ExitPicture(variant == 0));
  b.Picture({-0.16f, -0.0225f, 0.012f}, {0.16f, -0.0225f, 0.012f}, {0.16f, -0.0225f, 0.168f}, {-0.16f, -0.0225f, 0.168f});
  b.Use(face, ExitPicture(variant != 0));
  b.Picture({0.16f, 0.0225f, 0.012f}, {-0.16f, 0.0225f, 0.012f}, {-0.16f, 0.0225f, 0.168f}, {0.16f, 0.0225f, 0.168f});
  return b.Finish();
}

}  // namespace

FurnishingRows HallLampRows() {
  return {{{"ceiling_panel", "furniture/lighting/ceiling_light", 2, MakeCeilingPanel, 0.5f, 0.011f, 0.013f, 300}, Mount::kCeiling},
          {{"tube_light", "furniture/lighting/ceiling_light", 3, MakeTubeLight, 0.8f, 0.09f, 0.60f, 800}, Mount::kCeiling},
          {{"high_bay_lamp", "furniture/lighting/ceiling_light", 2, MakeHighBayLamp, 0.3f, 0.44f, 0.80f, 2500}, Mount::kCeiling},
          {{"downlight", "furniture/lighting/ceiling_light", 4, MakeDownlight, 0.1f, 0.007f, 0.009f, 500}, Mount::kCeiling},
          {{"exit_sign", "signage/exit_sign", 2, MakeExitSign, 0.2f, 0.275f, 0.285f, 300}, Mount::kCeiling}};
}

}  // namespace airsim360::internal
