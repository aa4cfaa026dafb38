#include "airsim360/worlds/props/wheels.h"

#include <cmath>

#include "airsim360/worlds/props/finishes.h"

namespace airsim360::internal {

void AddWheel(PropBuilder& b, Vec3f hub, float radius, float width, float outside) {
  // The axle of the turned shapes is Z; it looks to the outside.
  b.Place(Turn(0, outside > 0 ? 90.0f : -90.0f, 0, hub));
  const float r = radius, h = width / 2, rim = 0.66f * radius;
  b.Use(Rubber());
  const Vec2f tyre[] = {{rim, -h * 0.9f}, {r * 0.90f, -h},        {r * 0.985f, -h * 0.8f}, {r, -h * 0.55f},
                        {r, h * 0.55f},   {r * 0.985f, h * 0.8f}, {r * 0.90f, h},          {rim, h * 0.9f}};
  b.Lathe(tyre, 28);
  b.Use(Paint({0.012f, 0.012f, 0.013f}, 0.8f));
  const Vec2f dish[] = {{rim * 0.98f, h * 0.2f}, {0, h * 0.15f}};
  b.Lathe(dish, 20);
  b.Use(Metal({0.55f, 0.56f, 0.57f}, 0.3f));
  const Vec2f ring[] = {{rim, h * 0.9f}, {rim * 0.96f, h * 0.95f}, {rim * 0.90f, h * 0.8f}, {rim * 0.90f, h * 0.2f}};
  b.Lathe(ring, 28);
  b.Use(Chrome());
  const Vec2f cap[] = {{rim * 0.24f, h * 0.3f}, {rim * 0.24f, h * 0.72f}, {rim * 0.16f, h * 0.80f}, {0, h * 0.81f}};
  b.Lathe(cap, 14);
  b.Use(Metal({0.55f, 0.56f, 0.57f}, 0.3f));
  for (int i = 0; i < 5; ++i) {
    b.Place(Turn(0, outside > 0 ? 90.0f : -90.0f, 0, hub) * Turn(0, 0, 72.0f * static_cast<float>(i)));
    b.BevelBox({rim * 0.15f, -rim * 0.10f, h * 0.45f}, {rim * 0.95f, rim * 0.10f, h * 0.78f}, rim * 0.04f);
  }
  b.Place({});
}

}  // namespace airsim360::internal
