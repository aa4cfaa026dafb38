// Traffic lights.
#include <cmath>
#include <numbers>

#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kYellowPaint{0.58f, 0.33f, 0.015f}, kBlackPaint{0.02f, 0.021f, 0.022f};

// A head of three lamps in front of the plane y = 0, its top at z = 0; `lit` = 0 red, 1 amber, 2 green.
void SignalHead(PropBuilder& b, const AffineTransform& X, int lit) {
  b.Place(X);
  b.Use(Paint(kYellowPaint, 0.45f));
  b.BevelBox({-0.17f, -0.20f, -1.07f}, {0.17f, 0.0f, 0}, 0.02f);
  b.Use(Paint(kBlackPaint, 0.6f));
  b.BevelBox({-0.30f, -0.006f, -1.20f}, {0.30f, 0.006f, 0.13f}, 0.004f);
  const Vec3f colors[3] = {{0.90f, 0.03f, 0.02f}, {0.90f, 0.45f, 0.02f}, {0.05f, 0.80f, 0.45f}};
  for (int i = 0; i < 3; ++i) {
    const Vec3f c{0, -0.20f, -0.19f - 0.345f * static_cast<float>(i)};
    Material lamp = Glow(colors[i], 10000, Burns::kAlways);
    lamp.beam = 6;  // lenses throw it along the street by night: a third of it 30 degrees aside (EN 12368)
    b.Use(i == lit ? lamp : Plastic(colors[i] * 0.10f, 0.3f));
    b.mesh().Tube(c, c + Vec3f{0, -0.02f, 0}, 0.14f, 0.12f, 24, false);
    // Visor: three quarters of a tube, open below, seen from both sides.
    b.Use(Paint(kBlackPaint, 0.6f));
    for (int k = 0; k < 14; ++k) {
      const auto at = [&](int j, float y, float r) {
        const float a = std::numbers::pi_v<float> * (-0.25f + 1.5f * static_cast<float>(j) / 14);
        return c + Vec3f{r * std::cos(a), y, r * std::sin(a)};
      };
      const float reach = -0.24f;
      b.mesh().Quad(at(k, reach, 0.155f), at(k, 0, 0.155f), at(k + 1, 0, 0.155f), at(k + 1, reach, 0.155f));
      b.mesh().Quad(at(k, 0, 0.150f), at(k, reach, 0.150f), at(k + 1, reach, 0.150f), at(k + 1, 0, 0.150f));
    }
  }
  b.Place({});
}

// Variant 0: mast with an arm over the road along +X and two heads; 1: head on a post; 2: the arm lights show
// green.
Model MakeTrafficLight(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_light");
  const bool arm = variant != 1;
  const int lit = variant == 2 ? 2 : 0;
  const float height = arm ? 6.2f : 3.4f;
  b.Use(Metal({0.46f, 0.47f, 0.47f}, 0.45f), ScratchedTexture());
  const Vec2f mast[] = {{0.22f, 0},      {0.22f, 0.03f},   {0.15f, 0.035f},         {0.14f, 0.30f},
                        {0.125f, 0.32f}, {0.085f, height}, {0.05f, height + 0.05f}, {0, height + 0.055f}};
  const Vec2f post[] = {{0.15f, 0},       {0.15f, 0.03f},          {0.07f, 0.06f},      {0.055f, 0.3f},
                        {0.055f, height}, {0.03f, height + 0.03f}, {0, height + 0.035f}};
  b.Lathe(arm ? std::span<const Vec2f>(mast) : std::span<const Vec2f>(post), 18);
  if (arm) {
    const Vec3f path[] = {{0.05f, 0, 5.55f}, {2.0f, 0, 5.78f}, {4.2f, 0, 5.92f}, {6.3f, 0, 5.98f}};
    const float radii[] = {0.075f, 0.065f, 0.052f, 0.04f};
    b.Bar(path, radii, 12);
    SignalHead(b, Move({3.4f, -0.09f, 6.42f}), lit);
    SignalHead(b, Move({6.0f, -0.09f, 6.50f}), lit);
    b.Use(CastIron());
    b.mesh().Tube({0, -0.02f, 3.0f}, {0, -0.26f, 3.0f}, 0.02f, 0.02f, 8);
    SignalHead(b, Move({0, -0.12f, 3.55f}), lit);
  } else {
    b.Use(CastIron());
    b.mesh().Tube({0, 0, 3.0f}, {0, -0.1f, 3.0f}, 0.02f, 0.02f, 8);
    SignalHead(b, Move({0, -0.07f, 3.38f}), lit);
  }
  // Push button for pedestrians.
  b.Use(Paint(kYellowPaint));
  b.BevelBox({-0.05f, -0.17f, 1.02f}, {0.05f, -0.05f, 1.20f}, 0.015f);
  b.Use(Metal());
  b.mesh().Tube({0, -0.165f, 1.08f}, {0, -0.18f, 1.08f}, 0.022f, 0.022f, 12);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> TrafficLightKinds() {
  return {{"traffic_light", "traffic/control/traffic_light", 3, MakeTrafficLight, 0.4f, 3.3f, 6.8f, 3000}};
}

}  // namespace airsim360::internal
