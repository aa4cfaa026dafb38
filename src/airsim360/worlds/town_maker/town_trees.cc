#include "airsim360/worlds/town_maker/town_trees.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

float U(RngStream& rng, double low, double high) { return static_cast<float>(rng.Uniform(low, high)); }

// Pictures of living leaves; the last of an atlas is yellowed.
int GreenCell(RngStream& rng) { return static_cast<int>(rng.Index(kLeafCells - 1)); }

// A slender spindle of dense sprays from the ground up, ragged by spires that end at heights of their own.
Model Cypress(RngStream& rng) {
  static const Vec3f tones[] = {{0.022f, 0.041f, 0.018f}, {0.027f, 0.047f, 0.021f}, {0.019f, 0.037f, 0.019f}};
  static const Texture atlas = LeafAtlas("cypress scales", tones);
  std::vector<PlantLayer> layers = PlantLayers({0.17f, 0.13f, 0.10f}, atlas, 0.3f);
  const float height = U(rng, 10.4, 11.6), radius = U(rng, 0.75, 1.1);
  std::vector<BranchNode> nodes;
  AddStem(nodes, -1, {0, 0, -0.25f}, {0, 0, height * 0.9f}, 0.5f, 0.02f, rng);
  Thicken(nodes, 0.2f, 0.03f);
  AddBark(layers[0], nodes, 0.02f, 0.3f);
  struct Spire {
    Vec3f from, to;
    float width;
  };
  std::vector<Spire> spires{{{0, 0, 0.15f}, {U(rng, -0.15, 0.15), U(rng, -0.15, 0.15), height}, 0.62f * radius}};
  for (int i = 0; i < 26; ++i) {
    const float a = U(rng, 0, 6.2831853), low = U(rng, 0.1, 0.62 * static_cast<double>(height)), high = low + U(rng, 2.2, 4.2);
    const Vec3f out{std::cos(a), std::sin(a), 0};
    // The crown is widest at a third of its height.
    const auto reach = [&](float z) {
      return radius * std::sqrt(std::max(0.05f, 1 - std::pow((z - 0.33f * height) / (0.72f * height), 2.0f)));
    };
    spires.push_back({out * (0.45f * reach(low)) + Vec3f{0, 0, low},
                      out * (0.80f * reach(high)) + Vec3f{0, 0, std::min(high, 0.96f * height)}, U(rng, 0.24, 0.38)});
  }
  for (int i = 0; i < 24000; ++i) {
    const Spire& spire = spires[i % 4 == 0 ? 0 : static_cast<size_t>(rng.Index(static_cast<uint32_t>(spires.size())))];
    const float t = U(rng, 0, 1), a = U(rng, 0, 6.2831853);
    const float full = spire.width * std::min(1.0f, 0.35f + 3 * t) * std::pow(1 - t, 0.45f);
    const float share = std::sqrt(U(rng, 0.25, 1));
    const Vec3f out{std::cos(a), std::sin(a), 0}, base = spire.from + (spire.to - spire.from) * t + out * (full * share);
    const Vec3f up = Normalized(out * 0.25f + Vec3f{0, 0, 1} + RandomDirection(rng) * 0.25f);
    const float open = std::hypot(base.x, base.y) / radius;
    LeafShape shape{U(rng, 0.13, 0.26), U(rng, 0.03, 0.055), 0.1f, 0, LeafForm::kKite};
    AddLeaf(LeavesAt(layers, 1.3f * open - 0.25f), base, up, Normalized(out + RandomDirection(rng) * 0.4f), shape, GreenCell(rng),
            Normalized(out + Vec3f{0, 0, 0.3f}));
  }
  return JoinLayers("cypress", layers);
}

// Where pads of needles sit on the low dome of an umbrella pine: a sunflower's pattern, shaken, within an uneven rim.
std::vector<Vec3f> PadsOnDome(float radius, float rise, RngStream& rng) {
  std::vector<Vec3f> pads;
  const float p1 = U(rng, 0, 6.2831853), p2 = U(rng, 0, 6.2831853), count = 64;
  for (float k = 0.5f; k < count; ++k) {
    const float a = 2.39996f * k + U(rng, -0.25, 0.25), share = std::sqrt(k / count);
    if (rng.Chance(0.08)) continue;
    const float rim = radius * (1 + 0.13f * std::sin(2 * a + p1) + 0.09f * std::sin(3 * a + p2)) * U(rng, 0.92, 1.06);
    const float r = rim * share;
    pads.push_back(
        {r * std::cos(a), r * std::sin(a), rise * (0.46f + 0.44f * std::sqrt(std::max(0.0f, 1 - share * share)) + U(rng, -0.06, 0.06))});
  }
  return pads;
}

// A bare trunk that forks below a flat parasol of needles, made of pads with sky between some of them.
Model UmbrellaPine(RngStream& rng) {
  static const Vec3f tones[] = {{0.036f, 0.068f, 0.027f}, {0.044f, 0.078f, 0.030f}, {0.031f, 0.059f, 0.027f}};
  static const Texture atlas = LeafAtlas("stone pine needles", tones);
  std::vector<PlantLayer> layers = PlantLayers({0.25f, 0.16f, 0.11f}, atlas, 0.3f);
  const float height = U(rng, 11.4, 12.6), radius = U(rng, 3.8, 4.9), fork = height * U(rng, 0.58, 0.66);
  std::vector<BranchNode> nodes;
  const Vec3f lean{U(rng, -0.5, 0.5), U(rng, -0.5, 0.5), fork};
  const int crotch = AddStem(nodes, -1, {0, 0, -0.25f}, lean, 0.35f, 0.05f, rng);
  constexpr int kLimbs = 9;
  std::vector<std::pair<Vec3f, int>> tips;
  for (int i = 0; i < kLimbs; ++i) {
    const float a = kTauF * (static_cast<float>(i) + U(rng, -0.3, 0.3)) / kLimbs, r = radius * U(rng, 0.35, 0.75);
    const Vec3f tip = lean + Vec3f{r * std::cos(a), r * std::sin(a), (height - fork) * U(rng, 0.36, 0.55)};
    tips.emplace_back(tip, AddStem(nodes, crotch, lean, tip, 0.35f, 0.14f, rng));
  }
  for (const Vec3f& at : PadsOnDome(radius, height - fork, rng)) {
    const Vec3f pad = lean + at;
    const auto limb = std::ranges::min_element(tips, {}, [&](const auto& tip) { return Norm(tip.first - pad); });
    AddStem(nodes, limb->second, limb->first, pad - Vec3f{0, 0, 0.2f}, 0.3f, 0.12f, rng);
    const float wide = U(rng, 0.55, 0.95), thick = U(rng, 0.28, 0.42);
    for (int i = 0; i < 420; ++i) {
      const Vec3f in = RandomDirection(rng) * std::cbrt(U(rng, 0.1, 1));
      const Vec3f base = pad + Vec3f{wide * in.x, wide * in.y, thick * (in.z < 0 ? 0.5f * in.z : in.z)};
      const Vec3f out = Normalized(Vec3f{in.x, in.y, 0.5f + in.z});
      LeafShape shape{U(rng, 0.13, 0.24), U(rng, 0.025, 0.05), 0.1f, 0.05f, LeafForm::kKite};
      AddLeaf(LeavesAt(layers, 0.5f + 0.5f * in.z), base, Normalized(out + RandomDirection(rng) * 0.8f), out, shape, GreenCell(rng), out);
    }
  }
  Thicken(nodes, 0.32f, 0.018f);
  AddBark(layers[0], nodes, 0.016f, 0.4f);
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
