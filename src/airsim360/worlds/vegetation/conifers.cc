// Pines: whorls of branches on a straight trunk, flat sprays of branchlets, needles in tufts (after Weber and
// Penn 1995).
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/vegetation/park_trees.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

struct ConiferBuild {
  float height, clear_trunk, radius, trunk_radius;
  float whorl = 0.56f;  // metres between whorls at the bottom
  float taper = 0.8f;   // of the crown's outline: 1 a cone
  float skirt = 0.72f;  // length of the lowest branches, in radii
};

// How much of a pine is drawn: 1 every needle; less keeps a share of them, longer and wider.
struct Sparse {
  float detail = 1;
  float size() const { return detail < 1 ? 0.55f / std::sqrt(detail) : 1; }
};

// A twig that carries needles.
struct Branchlet {
  Vec3f from, to;
  float openness;  // share of the sky it sees: more towards the ends of branches
};

// Adds a branch of `length` that starts at node `from` towards `azimuth`, and its branchlets to both sides.
// Low branches leave level and sag, high ones rise; all turn up at the end.
void AddBranch(std::vector<BranchNode>& nodes, int from, float azimuth, float length, float rise, std::vector<Branchlet>& branchlets,
               RngStream& random) {
  const Vec3f out{std::cos(azimuth), std::sin(azimuth), 0}, side{-out.y, out.x, 0};
  const float step = 0.22f;
  const int count = std::max(2, static_cast<int>(length / step));
  Vec3f p = nodes[static_cast<size_t>(from)].p;
  int parent = from;
  for (int i = 1; i <= count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    const float slope = rise + 0.55f * t * t - 0.25f * (1 - t) * (rise < 0.2f ? 1.0f : 0.0f);
    const Vec3f along = Normalized(out + Vec3f{0, 0, slope} + RandomDirection(random) * 0.10f);
    p += along * (length / static_cast<float>(count));
    nodes.push_back({p, parent});
    parent = static_cast<int>(nodes.size()) - 1;
    if (t < 0.15f) continue;
    // Two branchlets, shorter towards the tip; the tip itself is one more.
    const float reach = (0.20f + 0.30f * length) * (1.15f - t) * static_cast<float>(random.Uniform(0.75, 1.2));
    for (float hand : {-1.0f, 1.0f}) {
      const Vec3f d = Normalized(along * 0.8f + side * hand + Vec3f{0, 0, 0.10f} + RandomDirection(random) * 0.25f);
      branchlets.push_back({p, p + d * std::max(0.14f, reach), 0.15f + 0.75f * t});
    }
    if (i == count) branchlets.push_back({p, p + along * 0.28f, 1});
  }
}

// Needles all around the outer part of every branchlet, pointing forwards.
void AddNeedles(const std::vector<Branchlet>& branchlets, int total, Sparse sparse, std::vector<PlantLayer>& layers, RngStream& random) {
  // What stands for many needles is as long and wide as they are together.
  const float needle = sparse.detail < 1 ? 0.14f : 0.095f, width = sparse.detail < 1 ? 0.018f : 0.008f;
  float length = 0;
  for (const Branchlet& b : branchlets) length += Norm(b.to - b.from) + 0.06f;
  const float per_metre = static_cast<float>(total) * sparse.detail / length;
  for (const Branchlet& b : branchlets) {
    if (sparse.detail < 0.1f && random.Chance(0.6)) continue;
    const Vec3f axis = Normalized(b.to - b.from), side = Normalized(Cross(axis, Vec3f{0.2f, 0.1f, 1})), other = Cross(axis, side);
    const float reach = Norm(b.to - b.from);
    if (sparse.detail >= 1) AddNeedle(layers[0], b.from, b.to, side, 0.012f, other, 0);
    // Two crossed ribbons stand for the inner needles, which are seen only as a dense dark mass.
    for (Vec3f ribbon : {side, other})
      AddNeedle(LeavesAt(layers, b.openness - 0.35f), b.from, b.to + axis * 0.05f, ribbon, sparse.detail < 1 ? 0.13f : 0.075f,
                Vec3f{0, 0, 1}, kLeafCells - 2);
    const int count = static_cast<int>(per_metre * (reach + 0.06f) + static_cast<float>(random.Uniform()));
    const int tone = static_cast<int>(random.Index(kLeafCells - 1));
    for (int k = 0; k < count; ++k) {
      const float t = 0.12f + 0.88f * (static_cast<float>(k) + 0.5f) / static_cast<float>(count), a = 2.39996f * static_cast<float>(k);
      const Vec3f spoke = side * std::cos(a) + other * std::sin(a);
      const Vec3f d = Normalized(spoke + axis * static_cast<float>(random.Uniform(0.45, 1.1)));
      const Vec3f base = b.from + axis * (reach * t);
      const float size = needle * std::min(2.5f, sparse.size()) * static_cast<float>(random.Uniform(0.75, 1.2));
      const Vec3f across = Normalized(Cross(d, spoke + RandomDirection(random) * 0.5f));
      AddNeedle(LeavesAt(layers, b.openness + 0.12f * static_cast<float>(random.Normal())), base, base + d * size, across,
                width * std::min(6.0f, sparse.size() * sparse.size()), Normalized(spoke + Vec3f{0, 0, 0.7f}),
                random.Chance(0.7) ? tone : static_cast<int>(random.Index(kLeafCells - 1)));
    }
  }
}

Model BuildPine(const ConiferBuild& b, Sparse sparse, uint64_t seed) {
  static const Vec3f tones[] = {{0.036f, 0.066f, 0.028f}, {0.044f, 0.076f, 0.030f}, {0.030f, 0.058f, 0.030f}};
  static const Texture atlas = LeafAtlas("needles", tones);
  RngStream random(seed, "pine");
  std::vector<BranchNode> nodes;
  std::vector<Branchlet> branchlets;
  AddStem(nodes, -1, {0, 0, -0.25f}, {0.05f * static_cast<float>(random.Normal()), 0.05f * static_cast<float>(random.Normal()), b.height},
          0.2f, 0.06f, random);
  const size_t trunk = nodes.size();

  // Whorls a year's growth apart; a few branches are missing or short.
  float turn = 0;
  for (float z = b.clear_trunk; z < b.height - 0.3f;) {
    const float h = (z - b.clear_trunk) / (b.height - b.clear_trunk);
    size_t from = 0;
    while (from + 2 < trunk && nodes[from].p.z < z) ++from;
    const int count = 6 + static_cast<int>(random.Index(3));
    for (int i = 0; i < count; ++i) {
      const float azimuth =
          turn + 6.2831853f * (static_cast<float>(i) + static_cast<float>(random.Uniform(-0.25, 0.25))) / static_cast<float>(count);
      float length =
          b.radius * std::pow(1 - h, b.taper) * static_cast<float>(random.Uniform(0.72, 1.1)) * std::min(1.0f, b.skirt + 1.6f * h) + 0.18f;
      if (random.Chance(0.08)) length *= 0.5f;
      AddBranch(nodes, static_cast<int>(from), azimuth, length, -0.05f + 0.75f * h * h, branchlets, random);
    }
    turn += 2.39996f;
    z += (b.whorl - 0.43f * b.whorl * h) * static_cast<float>(random.Uniform(0.85, 1.15));
  }
  branchlets.push_back({nodes[trunk - 1].p, nodes[trunk - 1].p + Vec3f{0, 0, 0.3f}, 1});
  Thicken(nodes, b.trunk_radius, 0.007f);
  // A pine's trunk tapers evenly to its leader.
  for (size_t i = 0; i < trunk; ++i)
    nodes[i].radius = std::min(nodes[i].radius, 0.012f + b.trunk_radius * (1 - std::max(0.0f, nodes[i].p.z) / b.height));
  std::vector<PlantLayer> layers = PlantLayers({0.20f, 0.13f, 0.09f}, atlas, 0.35f);
  AddBark(layers[0], nodes, sparse.detail >= 1 ? 0.0072f : sparse.detail > 0.1f ? 0.02f : 0.05f, 0.4f);
  AddNeedles(branchlets, sparse.detail < 1 ? 76000 : 105000, sparse, layers, random);
  return JoinLayers("tree_pine", layers);
}

Model MakePine(uint32_t variant, uint64_t seed) {
  constexpr ConiferBuild builds[4] = {
      {12.5f, 1.4f, 2.9f, 0.18f}, {15.5f, 2.4f, 3.3f, 0.23f}, {9.2f, 0.7f, 2.4f, 0.13f}, {13.8f, 3.4f, 3.0f, 0.20f}};
  return BuildPine(builds[variant], {}, seed);
}

}  // namespace

Model GrowPine(int individual, float detail, uint64_t seed) {
  // Taller and slimmer than in streets: they grew up in company.
  constexpr ConiferBuild builds[4] = {{17.0f, 2.0f, 4.3f, 0.25f, 0.86f, 1.00f, 0.92f},
                                      {14.0f, 1.4f, 3.7f, 0.21f, 0.76f, 1.05f, 0.95f},
                                      {19.0f, 3.4f, 4.1f, 0.28f, 0.92f, 0.95f, 0.80f},
                                      {10.5f, 0.7f, 3.2f, 0.16f, 0.64f, 1.10f, 1.00f}};
  return BuildPine(builds[individual % 4], {detail}, seed);
}

std::vector<PropKind> ConiferKinds() { return {{"tree_pine", "vegetation/tree/conifer/pine", 4, MakePine, 0.8f, 8.5f, 17.0f, 160000}}; }

}  // namespace airsim360::internal
