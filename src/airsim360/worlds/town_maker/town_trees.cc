#include "airsim360/worlds/town_maker/town_trees.h"

#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

float U(RngStream& rng, double low, double high) { return static_cast<float>(rng.Uniform(low, high)); }

// A slender spindle of dense foliage that stands upright.
Model Cypress(RngStream& rng) {
  static const Vec3f tones[] = {{0.026f, 0.050f, 0.020f}, {0.034f, 0.060f, 0.024f}, {0.022f, 0.044f, 0.022f}};
  static const Texture atlas = LeafAtlas("cypress scales", tones);
  std::vector<PlantLayer> layers = PlantLayers({0.17f, 0.13f, 0.10f}, atlas, 0.3f);
  const float height = U(rng, 10.4, 11.6), radius = U(rng, 0.95, 1.2);
  std::vector<BranchNode> nodes;
  AddStem(nodes, -1, {0, 0, -0.25f}, {0, 0, height * 0.9f}, 0.5f, 0.02f, rng);
  Thicken(nodes, 0.2f, 0.03f);
  AddBark(layers[0], nodes, 0.02f, 0.3f);
  for (int i = 0; i < 9000; ++i) {
    const float t = U(rng, 0.03, 1), z = 0.5f + (height - 0.5f) * t, a = U(rng, 0, 6.2831853);
    const float full = radius * std::pow(std::max(0.0f, std::sin(std::min(1.0f, 0.13f + 0.9f * t) * kTauF / 2)), 0.72f) *
                       (1 + 0.12f * std::sin(5 * a + 9 * t));
    const float share = std::sqrt(U(rng, 0.35, 1)), r = full * share;
    const Vec3f out{std::cos(a), std::sin(a), 0}, base = out * r + Vec3f{0, 0, z};
    const Vec3f up = Normalized(out * 0.28f + Vec3f{0, 0, 1} + RandomDirection(rng) * 0.22f);
    LeafShape shape{U(rng, 0.26, 0.44), U(rng, 0.07, 0.11), 0.1f, 0, LeafForm::kKite};
    AddLeaf(LeavesAt(layers, 1.4f * share - 0.45f), base, up, Normalized(out + RandomDirection(rng) * 0.4f), shape,
            static_cast<int>(rng.Index(kLeafCells)), Normalized(out + Vec3f{0, 0, 0.3f}));
  }
  return JoinLayers("cypress", layers);
}

// A bare trunk that forks below a flat parasol of needles.
Model UmbrellaPine(RngStream& rng) {
  static const Vec3f tones[] = {{0.040f, 0.078f, 0.030f}, {0.050f, 0.090f, 0.034f}, {0.034f, 0.066f, 0.030f}};
  static const Texture atlas = LeafAtlas("stone pine needles", tones);
  std::vector<PlantLayer> layers = PlantLayers({0.25f, 0.16f, 0.11f}, atlas, 0.3f);
  const float height = U(rng, 11.4, 12.6), radius = U(rng, 4.0, 4.9), fork = height * U(rng, 0.58, 0.66);
  std::vector<BranchNode> nodes;
  const Vec3f lean{U(rng, -0.5, 0.5), U(rng, -0.5, 0.5), fork};
  const int crotch = AddStem(nodes, -1, {0, 0, -0.25f}, lean, 0.35f, 0.05f, rng);
  const int limbs = 9;
  std::vector<Vec3f> tips;
  for (int i = 0; i < limbs; ++i) {
    const float a = kTauF * (static_cast<float>(i) + U(rng, -0.2, 0.2)) / limbs, r = radius * U(rng, 0.45, 0.85);
    const Vec3f tip = lean + Vec3f{r * std::cos(a), r * std::sin(a), (height - fork) * U(rng, 0.42, 0.6)};
    const int end = AddStem(nodes, crotch, lean, tip, 0.35f, 0.10f, rng);
    for (int k = 0; k < 3; ++k)
      AddStem(nodes, end, tip, tip + Vec3f{U(rng, -1.2, 1.2), U(rng, -1.2, 1.2), U(rng, 0.5, 1.0)}, 0.3f, 0.12f, rng);
  }
  Thicken(nodes, 0.32f, 0.018f);
  AddBark(layers[0], nodes, 0.016f, 0.4f);
  // Foliage: pads on a low dome, flat below.
  for (int i = 0; i < 15000; ++i) {
    const float a = U(rng, 0, 6.2831853), share = std::sqrt(U(rng, 0, 1)),
                pad = 0.5f + 0.5f * std::sin(7 * a + 5 * share) * std::cos(11 * share + 2 * a);
    const float dome = (height - fork) * (0.52f + 0.40f * std::sqrt(std::max(0.0f, 1 - share * share)) + 0.10f * pad),
                depth = (0.25f + 0.75f * (1 - share * share)) * 1.5f;
    const float below = U(rng, 0, 1) * U(rng, 0, 1) * depth;
    const Vec3f base = lean + Vec3f{radius * share * std::cos(a), radius * share * std::sin(a), dome - below};
    const Vec3f out = Normalized(Vec3f{share * std::cos(a), share * std::sin(a), 0.9f});
    const Vec3f direction = Normalized(out + RandomDirection(rng) * 0.7f);
    LeafShape shape{U(rng, 0.24, 0.4), U(rng, 0.05, 0.09), 0.1f, 0.05f, LeafForm::kKite};
    AddLeaf(LeavesAt(layers, 1 - below / depth * 0.8f), base, direction, out, shape, static_cast<int>(rng.Index(kLeafCells)), out);
  }
  return JoinLayers("umbrella pine", layers);
}

// A ringed trunk with a head of arching fronds.
Model Palm(RngStream& rng) {
  static const Vec3f tones[] = {{0.060f, 0.105f, 0.036f}, {0.075f, 0.120f, 0.040f}, {0.050f, 0.092f, 0.036f}};
  static const Texture atlas = LeafAtlas("palm leaflets", tones);
  std::vector<PlantLayer> layers = PlantLayers({0.23f, 0.19f, 0.15f}, atlas, 0.5f);
  const float height = U(rng, 6.6, 7.4);
  const Vec3f top{U(rng, -0.5, 0.5), U(rng, -0.5, 0.5), height};
  std::vector<BranchNode> nodes;
  const int head = AddStem(nodes, -1, {0, 0, -0.25f}, top, 0.3f, 0.02f, rng);
  const int fronds = 34;
  for (int f = 0; f < fronds; ++f) {
    const float a = 2.39996f * static_cast<float>(f), rise = 1.25f - 1.75f * static_cast<float>(f) / fronds, length = U(rng, 2.4, 3.0);
    const Vec3f out{std::cos(a), std::sin(a), 0}, side{-out.y, out.x, 0};
    Vec3f p = top;
    int parent = head;
    const int steps = 16;
    for (int i = 1; i <= steps; ++i) {
      const float t = static_cast<float>(i) / steps;
      const Vec3f along = Normalized(out + Vec3f{0, 0, rise - 1.9f * t * t});
      p += along * (length / steps);
      nodes.push_back({p, parent});
      parent = static_cast<int>(nodes.size()) - 1;
      if (t < 0.12f) continue;
      const float size = 0.62f * std::sqrt(std::max(0.0f, std::sin(std::min(0.96f, t) * kTauF / 2))) + 0.12f;
      for (int pair = 0; pair < 3; ++pair)
        for (float hand : {-1.0f, 1.0f}) {
          const Vec3f direction = Normalized(side * hand + along * 0.65f + Vec3f{0, 0, -0.12f} + RandomDirection(rng) * 0.1f);
          LeafShape shape{size * U(rng, 0.85, 1.1), 0.055f, 0.15f, 0.3f, LeafForm::kKite};
          AddLeaf(LeavesAt(layers, 0.55f + 0.45f * rise), p - along * (length / steps * static_cast<float>(pair) / 3), direction,
                  Normalized(Cross(direction, side * -hand) + Vec3f{0, 0, 0.8f}), shape, static_cast<int>(rng.Index(kLeafCells)));
        }
    }
  }
  Thicken(nodes, 0.19f, 0.014f);
  for (size_t i = 0; i <= static_cast<size_t>(head); ++i) nodes[i].radius = 0.17f + 0.012f * static_cast<float>(i % 2);
  AddBark(layers[0], nodes, 0.012f, 0.25f);
  return JoinLayers("palm", layers);
}

}  // namespace

Model GrowSouthernTree(std::string_view kind, uint32_t individual) {
  RngStream rng(individual, kind);
  if (kind == "cypress") return Cypress(rng);
  return kind == "palm" ? Palm(rng) : UmbrellaPine(rng);
}

double TypicalHeight(std::string_view kind) { return kind == "cypress" ? 11 : kind == "palm" ? 8 : 12; }

}  // namespace airsim360::internal
