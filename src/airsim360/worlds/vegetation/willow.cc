// Weeping willows: shoots hang from the thin branches of a dome, in clumps with gaps between.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/vegetation/broadleaf_growth.h"
#include "airsim360/worlds/vegetation/park_trees.h"

namespace airsim360::internal {
namespace {

constexpr float kSegment = 0.22f;  // metres of shoot between two turns

const Texture& WillowLeaves() {
  static const Vec3f tones[] = {{0.095f, 0.135f, 0.040f}, {0.108f, 0.146f, 0.046f}, {0.082f, 0.122f, 0.038f}};
  static const Texture atlas = LeafAtlas("leaves willow", tones);
  return atlas;
}

// One shoot: leaves in pairs along a ribbon that bends down within a metre and then hangs.
void HangShoot(Vec3f p, Vec3f direction, float length, float leaf, int per_segment, bool ribbon, float openness,
               std::vector<PlantLayer>& layers, RngStream& random) {
  const Vec3f sway{0.03f * static_cast<float>(random.Normal()), 0.03f * static_cast<float>(random.Normal()), 0};
  const int segments = 1 + static_cast<int>(length / kSegment);
  Vec3f from = p;
  for (int k = 0; k < segments; ++k) {
    direction = Normalized(direction + Vec3f{0, 0, -0.42f} + sway + RandomDirection(random) * 0.05f);
    const Vec3f q = p + direction * kSegment;
    // The twig itself is a ribbon over two segments.
    if (ribbon && (k % 2 == 1 || k + 1 == segments)) {
      AddNeedle(layers[0], from, q, Normalized(Cross(direction, Vec3f{0.4f, 0.3f, 0.2f})), 0.008f,
                Normalized(Cross(direction, Vec3f{0.3f, -0.4f, 0.1f})), 0);
      from = q;
    }
    for (int l = 0; l < per_segment; ++l) {
      const float a = 6.2832f * static_cast<float>(random.Uniform());
      const Vec3f round{std::cos(a), std::sin(a), 0};
      const Vec3f along = Normalized(round * 0.55f + direction * 0.8f + Vec3f{0, 0, -0.25f});
      const float size = leaf * static_cast<float>(random.Uniform(0.7, 1.15));
      const Vec3f at = p + (q - p) * ((static_cast<float>(l) + 0.5f) / static_cast<float>(per_segment));
      const int cell = random.Chance(0.03) ? kLeafCells - 1 : static_cast<int>(random.Index(kLeafCells - 1));
      AddLeaf(LeavesAt(layers, openness + 0.10f * static_cast<float>(random.Normal())), at, along,
              Vec3f{std::cos(a + 0.8f), std::sin(a + 0.8f), 0.7f}, {size, size * 0.17f, 0.1f, 0.1f}, cell, round * 0.3f);
    }
    p = q;
  }
}

}  // namespace

Model GrowWillow(float height, float radius, float detail, uint64_t seed) {
  BroadleafSpecies s{.name = "willow",
                     .height = height,
                     .clear_trunk = 2.6f,
                     .crown_radius = radius,
                     .trunk_radius = 0.34f,
                     .leader = 0.35f,
                     .lobes = 12,
                     .lobe_radius = 0.42f,
                     .attractors = 5200,
                     .growth = {},
                     .leaf = {0.15f, 0.025f, 0.1f, 0.1f},
                     .leaves = 70000,
                     .clumping = 0,
                     .bark = {0.17f, 0.145f, 0.115f}};
  s.growth = {.step = 0.22f, .influence = 2, .kill = 0.5f, .tropism = {0, 0, 0.05f}, .max_nodes = 8000};
  if (detail < 1) s = Simplified(s, detail);
  RngStream random(seed, s.name);
  const Crown crown(s, random);
  const std::vector<BranchNode> nodes = GrowTree(s, crown, random);
  std::vector<PlantLayer> layers = PlantLayers(s.bark, WillowLeaves(), 0.95f, 0.45f);
  AddBark(layers[0], nodes, detail < 1 ? 0.03f : 0.009f, 0.5f);

  std::vector<size_t> sites;
  for (size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i].tips <= 4 && nodes[i].p.z > s.clear_trunk) sites.push_back(i);
  }
  // Far trees have fewer and broader shoots.
  const int shoots = static_cast<int>(3400 * (detail < 1 ? 3.2f * detail : 1));
  const float leaf = detail < 1 ? std::min(0.55f, 0.15f * 0.62f / std::sqrt(detail)) : 0.15f;
  const int per_segment = detail < 1 ? 1 : 4;
  for (int i = 0; i < shoots; ++i) {
    const BranchNode& node = nodes[sites[random.Index(static_cast<uint32_t>(sites.size()))]];
    const Vec3f p = node.p;
    const float curtain = Noise(Vec3f{p.x, p.y, p.z * 0.4f} * 1.1f, seed);
    if (random.Uniform() > 0.15 + 1.0 * std::clamp((curtain - 0.36f) / 0.24f, 0.0f, 1.0f)) continue;
    const double drop = random.Uniform();
    const float end = 0.5f + 2.2f * static_cast<float>(drop * drop) + 0.6f * static_cast<float>(random.Uniform());
    const float length = std::min(p.z - end, static_cast<float>(random.Uniform(1.2, 7.0)));
    if (length < 0.6f) continue;
    const Vec3f axis = Normalized(p - nodes[static_cast<size_t>(node.parent)].p);
    const Vec3f out = Normalized(Vec3f{p.x, p.y, 0} * (0.5f / radius) + axis * 0.5f + RandomDirection(random) * 0.4f);
    const float openness = 0.25f + 0.65f * std::hypot(p.x, p.y) / radius;
    HangShoot(p, out, length, leaf, per_segment, detail >= 1, openness, layers, random);
  }
  return JoinLayers("weeping_willow", layers);
}

}  // namespace airsim360::internal
