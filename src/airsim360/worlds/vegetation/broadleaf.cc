// Broad-leaved trees: crowns of overlapping lobes filled by space colonisation, leaves on the thin twigs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

// One individual of a species; metres.
struct Species {
  std::string_view name;
  float height, clear_trunk, crown_radius, trunk_radius;
  float leader;       // how far up the crown the trunk goes on, 0..1
  int lobes;          // the crown is the union of so many ellipsoids round an axis
  float lobe_radius;  // in crown radii
  int attractors;
  GrowthOptions growth;
  LeafShape leaf;
  int leaves;
  float clumping;  // 0 even … 1 leaves in clumps with gaps between
  Vec3f bark;
};

// The crown: ellipsoids scattered round its axis, wider below the middle than above.
class Crown {
 public:
  Crown(const Species& s, RngStream& random) : height_(s.height - s.clear_trunk), radius_(s.crown_radius) {
    const Vec3f center{0, 0, s.clear_trunk + height_ * 0.48f};
    lobes_.push_back({center, 0.55f});
    for (int i = 0; i < s.lobes; ++i) {
      // Low-discrepancy directions with jitter, so that no side stays bare.
      const float z = -0.75f + 1.65f * (static_cast<float>(i) + 0.5f) / static_cast<float>(s.lobes);
      const float a = 2.39996f * static_cast<float>(i) + 0.5f * static_cast<float>(random.Normal());
      const float ring =
          std::sqrt(std::max(0.05f, 1 - z * z)) * static_cast<float>(random.Uniform(0.55, 0.85));
      const float r = s.lobe_radius * static_cast<float>(random.Uniform(0.75, 1.25));
      lobes_.push_back(
          {center + Vec3f{radius_ * ring * std::cos(a), radius_ * ring * std::sin(a), height_ * 0.40f * z},
           r});
    }
  }
  bool Contains(Vec3f p) const {
    for (const auto& [c, r] : lobes_) {
      const Vec3f d = p - c;
      const float flat = std::min(1.0f, 2 * radius_ / height_);
      if (d.x * d.x + d.y * d.y + d.z * d.z * flat * flat < r * r * radius_ * radius_) return true;
    }
    return false;
  }
  Vec3f center() const { return lobes_[0].first; }
  /// About the share of the sky that a leaf at p sees: less deep inside and on the underside.
  float Openness(Vec3f p) const {
    const Vec3f d{(p.x - center().x) / radius_, (p.y - center().y) / radius_,
                  (p.z - center().z) / (0.5f * height_)};
    return 0.05f + 0.72f * std::pow(Norm(d), 1.5f) + 0.22f * d.z;
  }

 private:
  float height_, radius_;
  std::vector<std::pair<Vec3f, float>> lobes_;
};

std::vector<BranchNode> GrowTree(const Species& s, const Crown& crown, RngStream& random) {
  const float crown_height = s.height - s.clear_trunk;
  // Attractors: more of them near the outside, where the twigs are.
  const Vec3f c = crown.center();
  const auto wanted = [&](Vec3f p) {
    if (p.z < s.clear_trunk * 0.8f || !crown.Contains(p)) return false;
    const Vec3f d{(p.x - c.x) / s.crown_radius, (p.y - c.y) / s.crown_radius,
                  (p.z - c.z) / (crown_height / 2)};
    return random.Uniform() < 0.25 + 0.75 * std::clamp(Norm(d), 0.0f, 1.0f);
  };
  const float reach = s.crown_radius * 1.3f;
  const auto attractors = ScatterInside({-reach, -reach, s.clear_trunk * 0.8f}, {reach, reach, s.height},
                                        s.attractors, wanted, random);

  // Trunk: slightly bent, leaning a little; it ends inside the crown.
  std::vector<BranchNode> nodes;
  const float lean = 0.03f * s.height;
  const Vec3f top{lean * static_cast<float>(random.Normal()), lean * static_cast<float>(random.Normal()),
                  s.clear_trunk + crown_height * s.leader};
  AddStem(nodes, -1, {0, 0, -0.25f}, top, s.growth.step, 0.22f, random);
  // Limbs that leave it at different heights and rise.
  const size_t trunk_nodes = nodes.size();
  const int limbs = 5 + static_cast<int>(random.Index(3));
  for (int i = 0; i < limbs; ++i) {
    const float t =
        (static_cast<float>(i) + static_cast<float>(random.Uniform(0.1, 0.9))) / static_cast<float>(limbs);
    const float z = s.clear_trunk * 0.92f + t * (top.z - s.clear_trunk) * 0.8f;
    size_t from = 0;
    while (from + 1 < trunk_nodes && nodes[from].p.z < z) ++from;
    const float a = 2.39996f * static_cast<float>(i) + static_cast<float>(random.Uniform(-0.4, 0.4));
    const float length = s.crown_radius * static_cast<float>(random.Uniform(0.40, 0.62)) * (1 - 0.45f * t);
    const float rise = 0.75f + s.growth.tropism.z * 3;
    const Vec3f to = nodes[from].p + Vec3f{std::cos(a), std::sin(a), rise} * length;
    AddStem(nodes, static_cast<int>(from), nodes[from].p, to, s.growth.step, 0.5f, random);
  }
  Colonise(nodes, attractors, s.growth, random);
  Thicken(nodes, s.trunk_radius, 0.006f);
  return nodes;
}

// Leaves in spirals on short twigs at the thin ends of branches.
void AddLeaves(const Species& s, const Crown& crown, const std::vector<BranchNode>& nodes,
               std::vector<PlantLayer>& layers, uint64_t seed, RngStream& random) {
  std::vector<size_t> sites;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent >= 0 && nodes[i].tips <= 4 && nodes[i].radius < 0.03f &&
        nodes[i].p.z > s.clear_trunk * 0.6f)
      sites.push_back(i);
  }
  constexpr int kPerTwig = 6;
  const float per_site =
      static_cast<float>(s.leaves) / static_cast<float>(std::max<size_t>(1, sites.size())) / kPerTwig;
  for (size_t site : sites) {
    const BranchNode& node = nodes[site];
    const Vec3f axis = Normalized(node.p - nodes[static_cast<size_t>(node.parent)].p),
                out = Normalized(node.p - crown.center());
    const float density =
        1 - s.clumping +
        s.clumping * 2.2f * std::clamp((Noise(node.p * 1.1f, seed) - 0.25f) / 0.4f, 0.0f, 1.0f);
    const int twigs = static_cast<int>(per_site * density + static_cast<float>(random.Uniform()));
    for (int t = 0; t < twigs; ++t) {
      const Vec3f along =
          Normalized(axis * 0.6f + RandomDirection(random) * 0.9f + out * 0.4f + Vec3f{0, 0, 0.1f});
      const float length = s.leaf.length * static_cast<float>(random.Uniform(1.4, 2.8));
      const Vec3f side = Normalized(Cross(along, Vec3f{0.3f, 0.2f, 1})), other = Cross(along, side);
      AddNeedle(layers[0], node.p, node.p + along * length, side, 0.010f, other, 0);
      for (int k = 0; k < kPerTwig; ++k) {
        const float a = 2.39996f * static_cast<float>(k) + static_cast<float>(t);
        const Vec3f spoke = side * std::cos(a) + other * std::sin(a);
        const Vec3f direction =
            Normalized(spoke * 0.9f + along * 0.55f + Vec3f{0, 0, -0.25f} + RandomDirection(random) * 0.25f);
        const Vec3f up = Vec3f{0, 0, 1} + out * 0.55f + RandomDirection(random) * 0.55f;
        LeafShape shape = s.leaf;
        const float size = static_cast<float>(random.Uniform(0.7, 1.2));
        shape.length *= size;
        shape.width *= size;
        shape.droop *= static_cast<float>(random.Uniform(0.3, 1.6));
        const bool yellow = random.Chance(0.03);
        const int cell = yellow ? kLeafCells - 1 : static_cast<int>(random.Index(kLeafCells - 1));
        const Vec3f base = node.p + along * (length * (static_cast<float>(k) + 0.6f) / kPerTwig);
        const float openness = crown.Openness(base) + 0.12f * static_cast<float>(random.Normal());
        AddLeaf(LeavesAt(layers, openness), base, direction, up, shape, cell, out * 0.35f);
      }
    }
  }
}

Model MakeTree(const Species& s, const Texture& atlas, uint64_t seed) {
  RngStream random(seed, s.name);
  const Crown crown(s, random);
  const std::vector<BranchNode> nodes = GrowTree(s, crown, random);
  std::vector<PlantLayer> layers = PlantLayers(s.bark, atlas);
  AddBark(layers[0], nodes, 0.0075f, 0.45f);
  AddLeaves(s, crown, nodes, layers, seed, random);
  return JoinLayers(std::string(s.name), layers);
}

// Street and park trees of the size of limes and planes: six of different age and build.
Model MakeGeneric(uint32_t variant, uint64_t seed) {
  static const Vec3f fresh[] = {{0.078f, 0.118f, 0.028f}, {0.066f, 0.104f, 0.028f}, {0.090f, 0.128f, 0.034f}};
  static const Vec3f deep[] = {{0.058f, 0.092f, 0.026f}, {0.066f, 0.098f, 0.030f}, {0.050f, 0.083f, 0.027f}};
  static const Texture atlases[2] = {LeafAtlas("leaves fresh", fresh), LeafAtlas("leaves deep", deep)};
  struct Build {
    float height, clear, radius, trunk, leader;
  };
  constexpr Build builds[6] = {{10.5f, 2.7f, 4.0f, 0.19f, 0.55f}, {12.5f, 3.1f, 4.8f, 0.24f, 0.50f},
                               {8.6f, 2.4f, 3.1f, 0.14f, 0.62f},  {11.4f, 2.9f, 3.7f, 0.20f, 0.66f},
                               {9.4f, 2.5f, 3.9f, 0.17f, 0.45f},  {7.4f, 2.2f, 2.5f, 0.11f, 0.66f}};
  const Build& b = builds[variant];
  Species s{"tree_generic",
            b.height,
            b.clear,
            b.radius,
            b.trunk,
            b.leader,
            15,
            0.40f,
            5200,
            {},
            {0.195f, 0.132f, 0.12f, 0.25f},
            0,
            0.75f,
            {0.17f, 0.14f, 0.11f}};
  s.growth.step = 0.20f;
  s.growth.influence = 1.7f;
  s.growth.kill = 0.42f * b.radius / 4.0f;
  s.leaves = static_cast<int>(17000 * std::min(1.0f, b.radius / 4.0f * b.radius / 4.0f * 1.15f + 0.1f));
  return MakeTree(s, atlases[variant % 2], seed);
}

// Upright oval crowns with ascending branches and narrow leaves (willow oak, poplar).
Model MakeNarrowleaf(uint32_t variant, uint64_t seed) {
  static const Vec3f tones[] = {{0.074f, 0.112f, 0.040f}, {0.088f, 0.122f, 0.046f}, {0.062f, 0.098f, 0.034f}};
  static const Texture atlas = LeafAtlas("leaves narrow", tones);
  struct Build {
    float height, clear, radius, trunk;
  };
  constexpr Build builds[4] = {{12.5f, 2.2f, 1.9f, 0.18f},
                               {14.5f, 2.5f, 2.3f, 0.22f},
                               {10.0f, 2.0f, 1.6f, 0.13f},
                               {13.2f, 2.3f, 2.7f, 0.20f}};
  const Build& b = builds[variant];
  Species s{"tree_narrowleaf",
            b.height,
            b.clear,
            b.radius,
            b.trunk,
            0.86f,
            14,
            0.52f,
            4600,
            {},
            {0.210f, 0.059f, 0.15f, 0.2f},
            20000,
            0.6f,
            {0.20f, 0.18f, 0.15f}};
  s.growth.step = 0.20f;
  s.growth.influence = 1.5f;
  s.growth.kill = 0.34f;
  s.growth.tropism = {0, 0, 0.45f};
  return MakeTree(s, atlas, seed);
}

}  // namespace

std::vector<PropKind> BroadleafKinds() {
  return {
      {"tree_generic", "vegetation/tree/broadleaf/generic", 6, MakeGeneric, 1.0f, 6.5f, 14.0f, 100000},
      {"tree_narrowleaf", "vegetation/tree/broadleaf/narrowleaf", 4, MakeNarrowleaf, 0.8f, 9.0f, 16.0f,
       100000},
  };
}

}  // namespace airsim360::internal
