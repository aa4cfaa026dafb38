// Bicycles, parked on their stands; the front wheel points to -Y.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/bicycle.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

void SpokedWheel(PropBuilder& b, Vec3f hub, float r) {
  std::array<Vec3f, 37> circle;
  const auto at = [&](float radius, float turn) { return hub + Vec3f{0, radius * std::cos(turn), radius * std::sin(turn)}; };
  const auto ring = [&](float radius, float thickness, int sides) {
    for (size_t k = 0; k < circle.size(); ++k) circle[k] = at(radius, kTauF * static_cast<float>(k % 36) / 36);
    b.Bar(circle, thickness, sides);
  };
  b.Use(Rubber());
  ring(r - 0.017f, 0.017f, 8);
  b.Use(Metal({0.6f, 0.6f, 0.6f}, 0.25f));
  ring(r - 0.042f, 0.010f, 6);
  for (int i = 0; i < 18; ++i) {
    const float a = kTauF * static_cast<float>(i) / 18;
    b.mesh().Tube(hub + Vec3f{i % 2 ? 0.025f : -0.025f, 0, 0}, at(r - 0.045f, a), 0.0015f, 0.0015f, 3, false, false);
  }
  b.mesh().Tube(hub - Vec3f{0.05f, 0, 0}, hub + Vec3f{0.05f, 0, 0}, 0.02f, 0.02f, 10);
}

Model MakeBicycle(uint32_t variant, uint64_t) {
  PropBuilder b("bicycle");
  constexpr Vec3f tones[3] = {{0.30f, 0.03f, 0.02f}, {0.02f, 0.10f, 0.14f}, {0.03f, 0.03f, 0.032f}};
  const BicycleMeasures& m = kBicycleMeasures[0];
  const float r = m.wheel_radius;
  const Vec3f front = m.front_hub, rear = m.rear_hub, bracket = m.bracket, seat_top{0, 0.26f, 0.80f}, head_top{0, -0.33f, 0.86f},
              head_low{0, -0.375f, 0.72f};
  SpokedWheel(b, front, r);
  SpokedWheel(b, rear, r);
  b.Use(Paint(tones[variant], 0.25f));
  const auto tube = [&](Vec3f p, Vec3f q, float radius) { b.mesh().Tube(p, q, radius, radius, 10); };
  tube(bracket, seat_top, 0.016f);
  tube(bracket, head_low, 0.019f);
  tube(Vec3f{0, 0.235f, 0.74f}, head_top - Vec3f{0, -0.005f, 0.02f}, 0.017f);
  tube(head_low, head_top, 0.019f);
  for (float x : {-0.055f, 0.055f}) {
    tube({x * 0.6f, bracket.y, bracket.z}, rear + Vec3f{x, 0, 0}, 0.010f);
    tube({x * 0.4f, 0.24f, 0.74f}, rear + Vec3f{x, 0, 0}, 0.008f);
    const Vec3f fork[] = {{x * 0.4f, -0.378f, 0.71f}, {x, -0.40f, 0.64f}, {x, -0.54f, r}};
    b.Bar(fork, 0.010f, 8);
  }
  // Handlebar, saddle, cranks, mudguards, stand.
  b.Use(Metal({0.55f, 0.55f, 0.55f}, 0.25f));
  tube(head_top, {0, -0.30f, 0.97f}, 0.013f);
  const Vec3f bar[] = {{-0.30f, -0.16f, 1.00f}, {-0.24f, -0.22f, 1.01f}, {-0.08f, -0.31f, 0.975f},
                       {0.08f, -0.31f, 0.975f}, {0.24f, -0.22f, 1.01f},  {0.30f, -0.16f, 1.00f}};
  b.Bar(bar, 0.011f, 8);
  tube(seat_top, {0, 0.285f, 0.90f}, 0.012f);
  b.mesh().Tube(bracket - Vec3f{0.012f, 0, 0}, bracket + Vec3f{0.012f, 0, 0}, 0.085f, 0.085f, 24);
  for (float side : {1.0f, -1.0f})
    tube({side * 0.07f, bracket.y, bracket.z}, {side * 0.075f, bracket.y, bracket.z - side * m.crank}, 0.009f);
  tube({0.05f, 0.42f, 0.30f}, {0.16f, 0.44f, 0.005f}, 0.008f);
  b.Use(Rubber());
  for (float side : {-1.0f, 1.0f}) {
    tube({side * 0.245f, -0.215f, 1.01f}, {side * 0.31f, -0.15f, 1.0f}, 0.016f);
    const Vec3f pedal = m.Pedal(side > 0), half{0.045f, 0.035f, m.pedal_half_height};
    b.BevelBox(pedal - half, pedal + half, 0.006f);
  }
  const Vec3f saddle[] = {{0, 0.12f, 0.915f}, {0, 0.22f, 0.92f}, {0, 0.34f, 0.925f}, {0, 0.40f, 0.93f}};
  const float widths[] = {0.022f, 0.035f, 0.07f, 0.055f};
  b.Bar(saddle, widths, 12);
  return b.Finish();
}

Model MakeBicycle1950s(uint32_t variant, uint64_t seed) {
  Model model = MakeBicycle(variant, seed);
  model.mesh.name = "bicycle_1950s";
  return model;
}

}  // namespace

std::vector<PropKind> CycleKinds() {
  const std::vector<LibraryModel> models = {{"bicycle", 0.98f}, {""}, {""}};
  return {{"bicycle", "vehicle/bicycle", 3, MakeBicycle, 0.9f, 0.9f, 1.1f, 4500, models},
          {"bicycle_1950s", "vehicle/bicycle", 3, MakeBicycle1950s, 0.9f, 0.9f, 1.1f, 4500}};
}

}  // namespace airsim360::internal
