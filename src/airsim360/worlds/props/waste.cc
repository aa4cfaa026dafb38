// Bins.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// The label of a recycling bin: three chasing arrows and a word.
Texture RecycleLabel(const char* word, Vec3f ground) {
  Canvas canvas(128, 192, ground);
  const Vec3f white{0.85f, 0.85f, 0.85f};
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](float turn, float r) {
      const float a = kTauF * (turn + static_cast<float>(i) / 3) - kTauF / 4;
      return Vec2f{0.5f + 1.5f * r * std::cos(a), 0.38f + r * std::sin(a)};
    };
    canvas.Line(at(0.03f, 0.20f), at(0.21f, 0.20f), 0.055f, white);
    const float a = kTauF * (0.24f + static_cast<float>(i) / 3) - kTauF / 4;
    canvas.RegularPolygon(at(0.24f, 0.19f), 0.065f, 3, -a - kTauF / 4, white);
  }
  canvas.Letters(word, {0.5f, 0.80f}, 0.085f, white);
  return canvas.Finish(std::string("recycle ") + word);
}

// Street recycling bin: box with rounded upright edges, slanted hood with a round opening, label on the
// front.
Model MakeRecycleBin(uint32_t variant, uint64_t) {
  PropBuilder b("recycle_bin");
  const Vec3f tones[3] = {{0.02f, 0.11f, 0.27f}, {0.03f, 0.20f, 0.06f}, {0.16f, 0.17f, 0.17f}};
  const char* words[3] = {"PAPER", "GLASS", "RECYCLE"};
  const auto body = RoundedRectangle({-0.28f, -0.24f}, {0.28f, 0.24f}, 0.06f, 4);
  const auto foot = RoundedRectangle({-0.26f, -0.22f}, {0.26f, 0.22f}, 0.05f, 3);
  b.Use(Paint({0.03f, 0.03f, 0.032f}));
  b.Prism(foot, 0, 0.06f);
  b.Use(Plastic(tones[variant]), ScratchedTexture());
  b.Prism(body, 0.06f, 0.86f);
  const auto rim = RoundedRectangle({-0.295f, -0.255f}, {0.295f, 0.255f}, 0.065f, 4);
  b.Prism(rim, 0.84f, 0.88f);
  // Hood: a wedge that slopes to the front.
  const Vec2f hood[] = {{-0.22f, 0.88f}, {0.22f, 0.88f}, {0.22f, 1.14f}, {0.14f, 1.18f}, {-0.05f, 1.16f}, {-0.20f, 0.96f}};
  b.Place(AffineTransform{Mat3f::FromColumns({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {}});
  b.Prism(hood, -0.26f, 0.26f);
  // Opening: a dark disc with a ring, flush on the slope of the hood.
  const Vec3f n = Normalized(Vec3f{0, -0.20f, 0.15f});
  b.Place({});
  const Vec3f c{0, -0.130f, 1.055f};
  b.Use(Rubber());
  b.mesh().Tube(c, c + n * 0.012f, 0.085f, 0.085f, 24, false, false);
  b.Use(Paint({0.006f, 0.006f, 0.006f}, 0.9f));
  b.mesh().Tube(c - n * 0.01f, c + n * 0.008f, 0.083f, 0.083f, 24, false);
  b.Use(Plastic({1, 1, 1}), RecycleLabel(words[variant], tones[variant] * 0.7f));
  b.Picture({-0.14f, -0.2415f, 0.28f}, {0.14f, -0.2415f, 0.28f}, {0.14f, -0.2415f, 0.70f}, {-0.14f, -0.2415f, 0.70f});
  return b.Finish();
}

// Round park bin of vertical steel slats that flare out at the top, with a liner and a dished lid.
Model MakeTrashCan(uint32_t variant, uint64_t) {
  PropBuilder b("trash_can");
  const Vec3f tones[2] = {{0.018f, 0.05f, 0.032f}, {0.03f, 0.031f, 0.034f}};
  const Material iron = Paint(tones[variant], 0.4f);
  b.Use(Plastic({0.02f, 0.02f, 0.022f}));
  const Vec2f liner[] = {{0, 0.08f}, {0.215f, 0.08f}, {0.235f, 0.82f}, {0.215f, 0.825f}, {0.20f, 0.30f}, {0, 0.30f}};
  b.Lathe(liner, 24);
  b.Use(iron);
  for (int i = 0; i < 26; ++i) {
    b.Place(Turn(0, 0, 360.0f * static_cast<float>(i) / 26));
    const float profile[][2] = {{0.245f, 0.03f}, {0.250f, 0.40f}, {0.255f, 0.65f}, {0.275f, 0.80f}, {0.315f, 0.90f}};
    for (int k = 0; k + 1 < 5; ++k) {
      const auto at = [&](int j, float y, float t) { return Vec3f{profile[j][0] + t, y, profile[j][1]}; };
      const float h = 0.016f, t = 0.007f;
      b.mesh().Quad(at(k, -h, t), at(k, h, t), at(k + 1, h, t), at(k + 1, -h, t));
      b.mesh().Quad(at(k, h, 0), at(k, -h, 0), at(k + 1, -h, 0), at(k + 1, h, 0));
      b.mesh().Quad(at(k, h, t), at(k, h, 0), at(k + 1, h, 0), at(k + 1, h, t));
      b.mesh().Quad(at(k, -h, 0), at(k, -h, t), at(k + 1, -h, t), at(k + 1, -h, 0));
    }
  }
  b.Place({});
  for (const auto& [r, z] : {std::pair(0.247f, 0.05f), std::pair(0.252f, 0.45f), std::pair(0.316f, 0.905f)}) {
    std::vector<Vec3f> ring;
    for (int k = 0; k <= 28; ++k) {
      const float a = kTauF * static_cast<float>(k) / 28;
      ring.push_back({r * std::cos(a), r * std::sin(a), z});
    }
    b.Bar(ring, 0.011f, 6);
  }
  const Vec2f foot[] = {{0.16f, 0}, {0.16f, 0.03f}, {0.08f, 0.05f}, {0.08f, 0.09f}};
  b.Lathe(foot, 20);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> WasteKinds() {
  return {
      {"recycle_bin", "furniture/waste/recycle_bin", 3, MakeRecycleBin, 0.45f, 1.1f, 1.25f, 1500},
      {"trash_can", "furniture/waste/trash_can", 2, MakeTrashCan, 0.4f, 0.85f, 1.05f, 3000},
  };
}

}  // namespace airsim360::internal
