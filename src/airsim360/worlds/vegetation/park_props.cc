// What parks have: playground, picnic tables, round fences, barriers of road works, ivy.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

Vec3f Round(float r, float a, float z) { return {r * std::cos(a), r * std::sin(a), z}; }

// A tower with a roof, a ladder behind and a slide to the front.
void AddSlide(PropBuilder& b) {
  UseWood(b);
  for (float x : {-0.55f, 0.55f}) {
    for (float y : {-0.4f, 0.7f}) b.BevelBox({x - 0.05f, y - 0.05f, -0.2f}, {x + 0.05f, y + 0.05f, 2.45f}, 0.012f);
  }
  b.BevelBox({-0.60f, -0.45f, 1.25f}, {0.60f, 0.75f, 1.31f}, 0.01f);
  for (float x : {-0.55f, 0.53f}) b.BevelBox({x, -0.35f, 1.55f}, {x + 0.02f, 0.65f, 1.95f}, 0.005f);
  b.Use(Paint({0.05f, 0.16f, 0.32f}, 0.5f));
  const auto roof = [](float side) {
    return [side](float u, float v) {
      return Vec3f{side * (0.75f * (1 - v)), side * (-0.85f + 1.9f * u) + (side > 0 ? 0.0f : 0.2f), 2.35f + 0.55f * v};
    };
  };
  for (float side : {1.0f, -1.0f}) b.Sheet(1, 1, roof(side), {1.9f, 0.9f});
  // The slide: a trough of sheet metal that levels out at the end.
  b.Use(Metal({0.62f, 0.63f, 0.64f}, 0.25f));
  b.Sheet(6, 14,
          [](float u, float v) {
            const float x = 0.56f * (0.5f - u), lip = 4 * (u - 0.5f) * (u - 0.5f);
            const float fall = v * v * (3 - 2 * v);
            return Vec3f{x, -0.45f - 2.35f * v, 1.31f - 1.08f * fall + 0.14f * lip * lip};
          },
          {0.6f, 2.6f});
  b.Use(Paint({0.42f, 0.05f, 0.04f}, 0.4f));
  for (float x : {-0.29f, 0.29f}) {
    std::vector<Vec3f> rim;
    for (int i = 0; i <= 14; ++i) {
      const float v = static_cast<float>(i) / 14;
      rim.push_back({x, -0.45f - 2.35f * v, 1.46f - 1.08f * v * v * (3 - 2 * v)});
    }
    b.Bar(rim, 0.02f, 8);
    const Vec3f leg[] = {{x * 0.9f, -2.55f, -0.1f}, {x * 0.9f, -2.55f, 0.34f}};
    b.Bar(leg, 0.02f, 8);
    const Vec3f ladder[] = {{x, 1.25f, -0.1f}, {x, 0.72f, 1.75f}};
    b.Bar(ladder, 0.02f, 8);
  }
  for (int i = 1; i <= 5; ++i) {
    const float t = static_cast<float>(i) / 6.2f;
    const Vec3f rung[] = {{-0.29f, 1.22f - 0.53f * t, 1.75f * t}, {0.29f, 1.22f - 0.53f * t, 1.75f * t}};
    b.Bar(rung, 0.016f, 8);
  }
}

// Two swings under a beam on slanted legs.
void AddSwing(PropBuilder& b) {
  b.Use(Paint({0.40f, 0.26f, 0.03f}, 0.45f));
  const Vec3f beam[] = {{-1.7f, 0, 2.3f}, {1.7f, 0, 2.3f}};
  b.Bar(beam, 0.05f, 12);
  for (float x : {-1.6f, 1.6f}) {
    for (float y : {-0.9f, 0.9f}) {
      const Vec3f leg[] = {{x * 1.12f, y, -0.2f}, {x, 0, 2.3f}};
      b.Bar(leg, 0.04f, 10);
    }
  }
  for (float x : {-0.75f, 0.75f}) {
    b.Use(Metal());
    for (float e : {-0.21f, 0.21f}) {
      const Vec3f chain[] = {{x + e, 0, 2.28f}, {x + e, 0.04f, 0.52f}};
      b.Bar(chain, 0.008f, 6);
    }
    b.Use(Rubber());
    b.BevelBox({x - 0.24f, -0.05f, 0.48f}, {x + 0.24f, 0.13f, 0.52f}, 0.008f);
  }
}

// A dome of bars to climb.
void AddDome(PropBuilder& b) {
  b.Use(Paint({0.04f, 0.22f, 0.10f}, 0.4f));
  const float radius = 1.5f;
  const auto at = [&](int ring, float k) {
    const float tilt = kTauF / 4 * static_cast<float>(ring) / 4;
    return Round(radius * std::cos(tilt), kTauF * k / 10, radius * std::sin(tilt) * 1.15f);
  };
  for (int k = 0; k < 10; ++k) {
    const float half = 0.5f;
    for (int ring = 0; ring < 4; ++ring) {
      const float from = static_cast<float>(k) + half * static_cast<float>(ring);
      for (float step : {half, -half}) {
        const Vec3f bar[] = {at(ring, from), at(ring + 1, from + step)};
        b.Bar(bar, 0.02f, 6);
      }
      if (ring == 0) continue;
      const Vec3f hoop[] = {at(ring, from), at(ring, from + 1)};
      b.Bar(hoop, 0.02f, 6);
    }
  }
}

Model MakePlayground(uint32_t variant, uint64_t) {
  PropBuilder b("playground");
  if (variant == 0) AddSlide(b);
  if (variant == 1) AddSwing(b);
  if (variant == 2) AddDome(b);
  return b.Finish();
}

// Table and two benches of planks on A-frames.
Model MakePicnicTable(uint32_t variant, uint64_t) {
  PropBuilder b("picnic_table");
  const Vec3f tone = variant == 0 ? Vec3f{1, 1, 1} : Vec3f{0.72f, 0.70f, 0.68f};
  UseWood(b, tone, Grain::kAlongX);
  for (int i = 0; i < 5; ++i) {
    const float y = -0.38f + 0.155f * static_cast<float>(i);
    b.BevelBox({-0.9f, y, 0.71f}, {0.9f, y + 0.14f, 0.75f}, 0.006f);
  }
  for (float y : {-0.80f, -0.655f, 0.515f, 0.66f}) b.BevelBox({-0.9f, y, 0.42f}, {0.9f, y + 0.135f, 0.46f}, 0.006f);
  UseWood(b, tone);
  for (float x : {-0.65f, 0.60f}) {
    b.BevelBox({x, -0.75f, 0.36f}, {x + 0.05f, 0.75f, 0.42f}, 0.006f);
    b.BevelBox({x, -0.36f, 0.64f}, {x + 0.05f, 0.36f, 0.71f}, 0.006f);
    for (float hand : {-1.0f, 1.0f}) b.mesh().Beam({x + 0.07f, 0.62f * hand, -0.02f}, {x + 0.07f, 0.24f * hand, 0.70f}, 0.06f);
  }
  return b.Finish();
}

// Ring of iron hoops around a bed.
Model MakeCircleFence(uint32_t variant, uint64_t) {
  PropBuilder b("circle_fence");
  b.Use(Paint(variant == 0 ? Vec3f{0.02f, 0.03f, 0.025f} : Vec3f{0.05f, 0.05f, 0.055f}, 0.45f));
  const int hoops = variant == 0 ? 14 : 10;
  const float radius = variant == 0 ? 0.85f : 0.70f, height = 0.55f;
  for (int i = 0; i < hoops; ++i) {
    const float a0 = kTauF * static_cast<float>(i) / static_cast<float>(hoops), a1 = a0 + kTauF / static_cast<float>(hoops) * 1.35f;
    std::vector<Vec3f> hoop;
    for (int k = 0; k <= 10; ++k) {
      const float t = static_cast<float>(k) / 10, up = std::min(1.0f, std::sin(t * kTauF / 2) * 1.6f);
      hoop.push_back(Round(radius, a0 + (a1 - a0) * t, -0.1f + (height + 0.1f) * up));
    }
    b.Bar(hoop, 0.010f, 6);
  }
  std::vector<Vec3f> ring;
  for (int k = 0; k <= 40; ++k) ring.push_back(Round(radius, kTauF * static_cast<float>(k) / 40, 0.22f));
  b.Bar(ring, 0.009f, 6);
  return b.Finish();
}

// Water-filled barrier of plastic, red or white.
Model MakeRoadBlock(uint32_t variant, uint64_t) {
  PropBuilder b("road_block");
  b.Use(Plastic(variant == 0 ? Vec3f{0.48f, 0.045f, 0.03f} : Vec3f{0.66f, 0.65f, 0.62f}, 0.5f));
  b.BevelBox({-0.75f, -0.24f, 0}, {0.75f, 0.24f, 0.26f}, 0.05f);
  b.BevelBox({-0.75f, -0.15f, 0.24f}, {0.75f, 0.15f, 0.82f}, 0.05f);
  b.Use(Plastic(variant == 0 ? Vec3f{0.66f, 0.65f, 0.62f} : Vec3f{0.48f, 0.045f, 0.03f}, 0.5f));
  for (float x : {-0.5f, 0.1f}) b.BevelBox({x, -0.156f, 0.46f}, {x + 0.4f, 0.156f, 0.68f}, 0.01f);
  return b.Finish();
}

// Channelising drum: orange with bright bands on a rubber base.
Model MakeTrafficBarrel(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_barrel");
  b.Use(Rubber());
  const Vec2f base[] = {{0.36f, 0}, {0.36f, 0.05f}, {0.29f, 0.08f}, {0, 0.08f}};
  b.Lathe(base, 20);
  const Material orange = Plastic({0.70f, 0.17f, 0.02f}, 0.5f), white = Plastic({0.68f, 0.67f, 0.64f}, 0.4f);
  for (int i = 0; i < 5; ++i) {
    b.Use(i % 2 == (variant == 0 ? 0 : 1) ? orange : white);
    const float z0 = 0.08f + 0.18f * static_cast<float>(i), z1 = z0 + 0.18f, r0 = 0.285f - 0.012f * static_cast<float>(i);
    const Vec2f band[] = {{r0, z0}, {r0 - 0.010f, z1 - 0.02f}, {r0 - 0.022f, z1}, {0, z1}};
    b.Lathe(band, 22);
  }
  b.Use(Plastic({0.70f, 0.17f, 0.02f}, 0.5f));
  b.BevelBox({-0.12f, -0.02f, 0.97f}, {0.12f, 0.02f, 1.06f}, 0.01f);
  return b.Finish();
}

// A wall's width of ivy: leaves over a fan of stems, thinner and ragged towards its border; it faces -Y.
Model MakeIvy(uint32_t variant, uint64_t seed) {
  static const Vec3f tones[] = {{0.045f, 0.080f, 0.022f}, {0.060f, 0.098f, 0.026f}, {0.038f, 0.066f, 0.022f}};
  static const Texture atlas = LeafAtlas("leaves ivy", tones);
  RngStream random(seed, "ivy");
  std::vector<PlantLayer> layers = {BarkLayer({0.16f, 0.13f, 0.10f}), LeafLayer(atlas, 0.4f)};
  const float width = 1.3f + 0.3f * static_cast<float>(variant);
  for (int i = 0; i < 9; ++i) {
    const float x = width * (static_cast<float>(i) / 8 - 0.5f);
    AddNeedle(layers[0], {0.3f * x, -0.02f, 0}, {1.6f * x, -0.03f, 2.0f + 0.4f * static_cast<float>(random.Uniform())}, {1, 0, 0}, 0.025f,
              {0, -1, 0}, 0);
  }
  for (int i = 0; i < 2600; ++i) {
    const auto x = static_cast<float>(random.Uniform(-1, 1)), z = static_cast<float>(random.Uniform());
    const float edge = (0.45f + 0.55f * z) * (1 - 0.75f * std::max(0.0f, z - 0.55f) / 0.45f);
    if (std::abs(x) > edge * (0.65f + 0.5f * Noise({3 * x, 4 * z, 0.5f}, seed))) continue;
    const Vec3f p{width * x, -0.03f - 0.06f * static_cast<float>(random.Uniform()), 2.55f * z};
    const float size = static_cast<float>(random.Uniform(0.05, 0.10));
    AddLeaf(layers[1], p, Normalized(Vec3f{0.5f * static_cast<float>(random.Normal()), -0.35f, -0.8f}),
            Vec3f{0.3f * static_cast<float>(random.Normal()), -1, 0.5f}, {size, size * 0.9f, 0.1f, 0.15f, LeafForm::kLobed},
            static_cast<int>(random.Index(kLeafCells - 1)), {0, -0.4f, 0});
  }
  return JoinLayers("ivy", layers);
}

}  // namespace

std::vector<PropKind> ParkKinds() {
  return {
      {"circle_fence", "barrier/fence/circle_fence", 2, MakeCircleFence, 1.0f, 0.4f, 0.6f, 6000},
      {"ivy", "vegetation/climber/ivy", 3, MakeIvy, 1.0f, 1.9f, 2.8f, 12000},
      {"picnic_table", "furniture/table", 2, MakePicnicTable, 1.1f, 0.7f, 0.8f, 1500},
      {"playground", "furniture/recreation/playground", 3, MakePlayground, 2.2f, 1.5f, 3.0f, 6000},
      {"road_block", "traffic/barrier/road_block", 2, MakeRoadBlock, 0.8f, 0.8f, 0.9f, 400},
      {"traffic_barrel", "traffic/temporary/traffic_barrel", 2, MakeTrafficBarrel, 0.4f, 0.95f, 1.1f, 2000},
  };
}

}  // namespace airsim360::internal
