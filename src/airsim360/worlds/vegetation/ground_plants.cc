// Grass tufts, fallen leaves and flower beds.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"
#include "airsim360/worlds/vegetation/turf.h"

namespace airsim360::internal {
namespace {

constexpr float kLawnDensity = 10500;  // blades a square metre

const Texture& GrassBlades() {
  static const Vec3f tones[] = {{0.090f, 0.135f, 0.028f}, {0.110f, 0.150f, 0.036f}, {0.080f, 0.122f, 0.030f}, {0.150f, 0.150f, 0.055f}};
  static const Texture atlas = LeafAtlas("grass blades", tones);
  return atlas;
}

PlantLayer GrassLayer() {
  PlantLayer layer = LeafLayer(GrassBlades(), 0.7f);
  layer.material.ground = GroundWear::kLawn;
  return layer;
}

Vec3f OnDisc(float radius, RngStream& random) {
  const float r = radius * std::sqrt(static_cast<float>(random.Uniform())), a = kTauF * static_cast<float>(random.Uniform());
  return {r * std::cos(a), r * std::sin(a), 0};
}

// 40 blades within a hand's breadth; variants 0 and 1 are lawn, 2 and 3 are long.
Model MakeGrassTuft(uint32_t variant, uint64_t seed) {
  RngStream random(seed, "grass_tuft");
  const bool tall = variant >= 2;
  std::array<PlantLayer, 1> layers = {GrassLayer()};
  for (int i = 0; i < 40; ++i) {
    const Vec3f p = OnDisc(tall ? 0.10f : 0.16f, random) - Vec3f{0, 0, 0.01f};
    const float height = static_cast<float>(tall ? random.Uniform(0.14, 0.34) : random.Uniform(0.05, 0.12));
    const float a = kTauF * static_cast<float>(random.Uniform());
    const Vec3f lean = Vec3f{std::cos(a), std::sin(a), 0} * static_cast<float>(random.Uniform(0.15, 0.9));
    AddBlade(layers[0], p, height, static_cast<float>(random.Uniform(0.005, 0.010)), lean, a + 1.57f,
             static_cast<int>(random.Index(kLeafCells)));
  }
  return JoinLayers("grass_tuft", layers);
}

constexpr Turf kMownTurf{.low = 0.035f, .high = 0.075f, .mown = 0.055f};

// A round patch of mown lawn, lower towards its rim: for the borders of lawns.
Model MakeLawnPatch(uint32_t, uint64_t seed) {
  RngStream random(seed, "lawn_patch");
  std::array<PlantLayer, 1> layers = {GrassLayer()};
  AddTurf(
      layers[0], kMownTurf, 3600,
      [&] {
        return OnDisc(0.49f, random) - Vec3f{0, 0, 0.008f};
      },
      [](Vec3f p) { return 1 - 0.5f * std::hypot(p.x, p.y); }, random);
  return JoinLayers("lawn_patch", layers);
}

// A square of mown lawn: tiles meet edge to edge, so that a ray enters one of them where it would enter five patches.
Model MakeLawnTile(uint32_t, uint64_t seed) {
  RngStream random(seed, "lawn_tile");
  std::array<PlantLayer, 1> layers = {GrassLayer()};
  const auto coordinate = [&] { return kLawnTile * static_cast<float>(random.Uniform(-0.5, 0.5)); };
  AddTurf(
      layers[0], kMownTurf, static_cast<int>(kLawnDensity * kLawnTile * kLawnTile),
      [&] {
        const float x = coordinate(), y = coordinate();
        return Vec3f{x, y, -0.008f};
      },
      [](Vec3f) { return 1.0f; }, random);
  return JoinLayers("lawn_tile", layers);
}

// 45 dry leaves scattered over a disc, curled a little.
Model MakeLeafLitter(uint32_t, uint64_t seed) {
  static const Vec3f tones[] = {
      {0.22f, 0.12f, 0.045f}, {0.28f, 0.17f, 0.05f}, {0.15f, 0.085f, 0.04f}, {0.30f, 0.21f, 0.06f}, {0.12f, 0.11f, 0.035f}};
  static const Texture atlas = LeafAtlas("leaves dry", tones);
  RngStream random(seed, "leaf_litter");
  std::array<PlantLayer, 1> layers = {LeafLayer(atlas, 0.3f)};
  for (int i = 0; i < 45; ++i) {
    const float a = kTauF * static_cast<float>(random.Uniform()), size = static_cast<float>(random.Uniform(0.05, 0.11));
    const Vec3f direction = Normalized(Vec3f{std::cos(a), std::sin(a), static_cast<float>(random.Uniform(-0.05, 0.15))});
    const Vec3f up = Normalized(Vec3f{0.25f * static_cast<float>(random.Normal()), 0.25f * static_cast<float>(random.Normal()), 1});
    AddLeaf(layers[0], OnDisc(0.55f, random) + Vec3f{0, 0, static_cast<float>(random.Uniform(0.006, 0.02))}, direction, up,
            {size, size * 0.7f, 0.12f, static_cast<float>(random.Uniform(-0.15, 0.03))}, static_cast<int>(random.Index(kLeafCells)));
  }
  return JoinLayers("leaf_litter", layers);
}

// Fronds that rise from one crown and bend over, leaflets in pairs along each, longest below the middle.
Model MakeFern(uint32_t variant, uint64_t seed) {
  static const Vec3f tones[] = {{0.055f, 0.105f, 0.020f}, {0.075f, 0.125f, 0.026f}, {0.045f, 0.085f, 0.022f}, {0.095f, 0.120f, 0.030f}};
  static const Texture atlas = LeafAtlas("leaves fern", tones);
  RngStream random(seed, "fern", variant);
  std::array<PlantLayer, 1> layers = {LeafLayer(atlas, 0.8f)};
  const int fronds = 8 + static_cast<int>(variant);
  for (int i = 0; i < fronds; ++i) {
    const float a = kTauF * (static_cast<float>(i) + static_cast<float>(random.Uniform(-0.35, 0.35))) / static_cast<float>(fronds),
                length = static_cast<float>(random.Uniform(0.38, 0.68)), rise = static_cast<float>(random.Uniform(0.75, 1.25));
    const Vec3f out{std::cos(a), std::sin(a), 0}, side{-out.y, out.x, 0};
    const auto at = [&](float t) { return out * (length * (0.06f + 0.94f * t)) + Vec3f{0, 0, length * rise * t * (1.15f - 0.85f * t)}; };
    const int pairs = 17;
    for (int k = 1; k <= pairs; ++k) {
      const float t = static_cast<float>(k) / pairs, s = t < 0.3f ? 0.35f + 2.1f * t : 1.4f * (1 - t) + 0.04f;
      const Vec3f p = at(t), along = Normalized(at(t + 0.02f) - at(t - 0.02f)), up = Normalized(Cross(along, side));
      const float size = 0.20f * length * std::min(s, 1.0f);
      for (float hand : {-1.0f, 1.0f})
        AddLeaf(layers[0], p, Normalized(side * hand + along * 0.42f + up * static_cast<float>(random.Uniform(-0.1, 0.2))),
                up.z < 0 ? up * -1.0f : up, {size, size * 0.36f, 0.08f, 0.15f}, static_cast<int>(random.Index(kLeafCells - 1)));
    }
    for (int k = 0; k < 4; ++k)
      AddNeedle(layers[0], at(0.25f * static_cast<float>(k)), at(0.25f * static_cast<float>(k + 1)), side, 0.008f, {0, 0, 1}, 0);
  }
  return JoinLayers("fern", layers);
}

// Patch of one metre of low green with blossoms of one colour: five petals and a yellow heart each.
Model MakeFlowerBed(uint32_t variant, uint64_t seed) {
  static const Vec3f leaf_tones[] = {{0.060f, 0.105f, 0.028f}, {0.080f, 0.120f, 0.034f}};
  static const Texture leaves = LeafAtlas("leaves bedding", leaf_tones);
  constexpr Vec3f petals[4] = {{0.44f, 0.07f, 0.08f}, {0.60f, 0.43f, 0.08f}, {0.64f, 0.61f, 0.58f}, {0.25f, 0.12f, 0.34f}};
  RngStream random(seed, "flower_bed");
  std::array<PlantLayer, 3> layers = {LeafLayer(leaves), PlantLayer{}, PlantLayer{}};
  layers[0].material.base_color = {0.8f, 0.8f, 0.8f};
  layers[1].material = Leaf(petals[variant], 0.5f);
  layers[1].material.name = "petal";
  layers[2].material = Leaf({0.60f, 0.36f, 0.02f}, 0.2f);
  layers[2].material.name = "flower heart";
  for (int i = 0; i < 90; ++i) {
    const Vec3f foot = OnDisc(0.48f, random);
    const float height = static_cast<float>(random.Uniform(0.14, 0.26));
    for (int k = 0; k < 9; ++k) {
      const float a = kTauF * static_cast<float>(random.Uniform()), t = static_cast<float>(random.Uniform(0.05, 0.8));
      const Vec3f d = Normalized(Vec3f{std::cos(a), std::sin(a), 0.55f});
      AddLeaf(layers[0], foot + Vec3f{0, 0, height * t}, d, {0, 0, 1}, {0.075f, 0.034f, 0.12f, 0.3f},
              static_cast<int>(random.Index(kLeafCells - 1)), {0, 0, 0.5f});
    }
    if (random.Chance(0.35)) continue;
    const Vec3f head = foot + Vec3f{0, 0, height};
    AddNeedle(layers[0], foot, head, {1, 0, 0}, 0.006f, {0, -1, 0}, 0);
    const Vec3f up = Normalized(Vec3f{0.3f * static_cast<float>(random.Normal()), 0.3f * static_cast<float>(random.Normal()), 1});
    const Vec3f side = Normalized(Cross(up, Vec3f{0.1f, 1, 0.2f})), other = Cross(up, side);
    for (int k = 0; k < 6; ++k) {
      const float a = kTauF * static_cast<float>(k) / 6;
      AddLeaf(layers[1], head, Normalized(side * std::cos(a) + other * std::sin(a) + up * 0.35f), up, {0.034f, 0.026f, 0.1f, 0.15f}, 0,
              up * 0.5f);
    }
    for (int k = 0; k < 5; ++k) {
      const float a = kTauF * static_cast<float>(k) / 5, b = a + kTauF / 5;
      const auto rim = [&](float q) { return head + up * 0.009f + (side * std::cos(q) + other * std::sin(q)) * 0.010f; };
      const uint32_t c = layers[2].Add(head + up * 0.014f, up, {});
      layers[2].Add(rim(a), up, {});
      layers[2].Add(rim(b), up, {});
      layers[2].triangles.push_back({c, c + 1, c + 2});
    }
  }
  return JoinLayers("flower_bed", layers);
}

}  // namespace

std::vector<PropKind> GroundPlantKinds() {
  return {
      {"grass_tuft", "vegetation/grass_tuft", 4, MakeGrassTuft, 0.1f, 0.05f, 0.35f, 150},
      {"lawn_patch", "vegetation/grass_tuft", 3, MakeLawnPatch, 0.1f, 0.03f, 0.09f, 11000},
      {"lawn_tile", "vegetation/grass_tuft", 4, MakeLawnTile, 0.1f, 0.03f, 0.09f, 52000},
      {"leaf_litter", "vegetation/plant", 3, MakeLeafLitter, 0.1f, 0.01f, 0.08f, 150},
      {"fern", "vegetation/plant", 4, MakeFern, 0.4f, 0.15f, 0.75f, 1600},
      {"flower_bed", "vegetation/flower", 4, MakeFlowerBed, 0.5f, 0.15f, 0.40f, 4000},
  };
}

}  // namespace airsim360::internal
