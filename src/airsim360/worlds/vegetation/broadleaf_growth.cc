#include "airsim360/worlds/vegetation/broadleaf_growth.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

// True for the joints of limbs that have died: they and all that grows on them carry no leaves.
std::vector<bool> DeadWood(const std::vector<BranchNode>& nodes, float share, RngStream& random) {
  std::vector<bool> dead(nodes.size(), false);
  if (share <= 0) return dead;
  const int whole = nodes[0].tips;
  for (size_t i = 1; i < nodes.size(); ++i) {
    const auto parent = static_cast<size_t>(nodes[i].parent);
    const bool forks = nodes[parent].main != static_cast<int>(i);
    // Limbs, not twigs: what carries between a hundredth and a fifteenth of all tips.
    const bool limb = forks && nodes[i].tips * 100 > whole && nodes[i].tips * 15 < whole;
    dead[i] = dead[parent] || (limb && random.Chance(share));
  }
  return dead;
}

// Directions of the leaves of one node of a shoot, across its axis.
int SpokesOf(LeafOrder order, int node, float turn, Vec3f side, Vec3f other, Vec3f (&spokes)[2]) {
  constexpr float kGoldenAngle = 2.39996f, kQuarter = 1.5707963f;
  const auto at = [&](float a) { return side * std::cos(a) + other * std::sin(a); };
  switch (order) {
    case LeafOrder::kAlternate:
      spokes[0] = node % 2 == 0 ? side : -side;
      return 1;
    case LeafOrder::kOpposite:
      spokes[0] = at(turn + kQuarter * static_cast<float>(node));
      spokes[1] = -spokes[0];
      return 2;
    case LeafOrder::kSpiral:
      break;
  }
  spokes[0] = at(turn + kGoldenAngle * static_cast<float>(node));
  return 1;
}

// Leaves of one shoot are of one age and so of one tone, but for a few; the odd one is yellow.
int LeafTone(int shoot_tone, RngStream& random) {
  if (random.Chance(0.02)) return kLeafCells - 1;
  return random.Chance(0.7) ? shoot_tone : static_cast<int>(random.Index(kLeafCells - 1));
}

// Where a shoot is at a share t of its length: it bends down towards its tip.
struct ShootLine {
  Vec3f from, along;
  float length;
  Vec3f At(float t) const { return from + along * (length * t) - Vec3f{0, 0, 0.18f * length * t * t}; }
};

// A shoot with its leaves: small at both ends, largest in the middle.
void AddShoot(const BroadleafSpecies& s, const Crown& crown, Vec3f from, Vec3f axis, Vec3f out, std::vector<PlantLayer>& layers,
              RngStream& random) {
  const float openness = crown.Openness(from);
  const ShootLine shoot{from, Normalized(axis * 0.7f + RandomDirection(random) * 0.8f + out * 0.45f + Vec3f{0, 0, 0.1f}),
                        s.shoot * (0.6f + 0.4f * openness) * static_cast<float>(random.Uniform(0.6, 1.1))};
  const Vec3f side = Normalized(Cross(shoot.along, Vec3f{0.03f, 0.02f, 1})), other = Cross(shoot.along, side);
  if (s.min_branch < 0.01f) AddNeedle(layers[0], from, shoot.At(1), side, 0.006f, other, 0);
  const float turn = static_cast<float>(random.Uniform(0, 6.2832));
  const int nodes = std::max(1, static_cast<int>(std::lround(shoot.length / s.internode))),
            tone = static_cast<int>(random.Index(kLeafCells - 1));
  for (int k = 0; k < nodes; ++k) {
    const float t = (static_cast<float>(k) + 0.7f) / static_cast<float>(nodes);
    Vec3f spokes[2];
    const int count = SpokesOf(s.order, k, turn, side, other, spokes);
    for (int l = 0; l < count; ++l) {
      const Vec3f direction = Normalized(spokes[l] * 0.9f + shoot.along * 0.6f + Vec3f{0, 0, -0.25f} + RandomDirection(random) * 0.25f);
      const Vec3f up = Vec3f{0, 0, 1} + out * 0.5f + RandomDirection(random) * 0.4f;
      const float size = (0.72f + 0.35f * std::sin(2.67f * t)) * std::clamp(1 + 0.2f * static_cast<float>(random.Normal()), 0.6f, 1.4f);
      LeafShape shape = s.leaf;
      shape.length *= size;
      shape.width *= size;
      shape.droop *= static_cast<float>(random.Uniform(0.3, 1.6));
      const float seen = openness + 0.12f * static_cast<float>(random.Normal());
      AddLeaf(LeavesAt(layers, seen), shoot.At(t), direction, up, shape, LeafTone(tone, random), out * 0.35f);
    }
  }
}

// The leaves of a shoot of mean length, for counting.
float LeavesPerShoot(const BroadleafSpecies& s) {
  const float nodes = std::max(1.0f, 0.75f * s.shoot / s.internode);
  return s.order == LeafOrder::kOpposite ? 2 * nodes : nodes;
}

// Bare twigs where the crown is dark: what died for want of light and still hangs there.
void AddDeadTwig(Vec3f from, Vec3f axis, PlantLayer& bark, RngStream& random) {
  const Vec3f along = Normalized(axis + RandomDirection(random) * 0.8f), side = Normalized(Cross(along, Vec3f{0.3f, 0.2f, 1}));
  const float length = static_cast<float>(random.Uniform(0.25, 0.7));
  const Vec3f middle = from + along * (0.5f * length);
  AddNeedle(bark, from, from + along * length, side, 0.009f, Cross(along, side), 0);
  AddNeedle(bark, middle, middle + Normalized(along + side * 0.9f) * (0.45f * length), Cross(along, side), 0.005f, side, 0);
}

// Leaves on shoots at the thin ends of branches.
void AddLeaves(const BroadleafSpecies& s, const Crown& crown, const std::vector<BranchNode>& nodes, std::vector<PlantLayer>& layers,
               uint64_t seed, RngStream& random) {
  constexpr float kDark = 0.22f, kDeadTwigs = 0.3f;
  const std::vector<bool> dead = DeadWood(nodes, s.dead, random);
  std::vector<size_t> sites;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent >= 0 && nodes[i].tips <= 4 && nodes[i].radius < 0.03f && !dead[i] && nodes[i].p.z > s.clear_trunk * 0.6f)
      sites.push_back(i);
  }
  const float per_site = static_cast<float>(s.leaves) / static_cast<float>(std::max<size_t>(1, sites.size())) / LeavesPerShoot(s);
  for (size_t site : sites) {
    const BranchNode& node = nodes[site];
    const Vec3f axis = Normalized(node.p - nodes[static_cast<size_t>(node.parent)].p), out = Normalized(node.p - crown.center());
    if (s.min_branch < 0.01f && crown.Openness(node.p) < kDark && random.Chance(kDeadTwigs)) {
      AddDeadTwig(node.p, axis, layers[0], random);
      continue;
    }
    const float density = 1 - s.clumping + s.clumping * 2.2f * std::clamp((Noise(node.p * 1.1f, seed) - 0.25f) / 0.4f, 0.0f, 1.0f);
    const int shoots = static_cast<int>(per_site * density + static_cast<float>(random.Uniform()));
    for (int t = 0; t < shoots; ++t) AddShoot(s, crown, node.p, axis, out, layers, random);
  }
}

}  // namespace

Crown::Crown(const BroadleafSpecies& s, RngStream& random) : height_(s.height - s.clear_trunk), radius_(s.crown_radius) {
  const Vec3f center{0, 0, s.clear_trunk + height_ * 0.48f};
  lobes_.push_back({center, 0.46f});
  const auto lean = static_cast<float>(random.Uniform(0, 6.2832));
  for (int i = 0; i < s.lobes; ++i) {
    // Low-discrepancy directions with jitter, so that no side stays bare.
    const float z = -0.75f + 1.65f * (static_cast<float>(i) + 0.5f) / static_cast<float>(s.lobes);
    const float a = 2.39996f * static_cast<float>(i) + 0.5f * static_cast<float>(random.Normal());
    const float ring =
        std::sqrt(std::max(0.05f, 1 - z * z)) * static_cast<float>(random.Uniform(0.55, 0.85)) * (1 + s.open_side * std::cos(a - lean));
    const float r = s.lobe_radius * static_cast<float>(random.Uniform(0.75, 1.25));
    lobes_.push_back({center + Vec3f{radius_ * ring * std::cos(a), radius_ * ring * std::sin(a), height_ * 0.40f * z}, r});
  }
  for (int i = 0; i < s.holes; ++i) {
    const Vec3f d = RandomDirection(random);
    const Vec3f at = center + Vec3f{d.x * radius_, d.y * radius_, d.z * 0.5f * height_} * 0.75f;
    holes_.push_back({at, static_cast<float>(random.Uniform(0.13, 0.30))});
  }
}

bool Crown::InOneOf(const std::vector<std::pair<Vec3f, float>>& balls, Vec3f p) const {
  const float flat = std::min(1.0f, 2 * radius_ / height_);
  return std::ranges::any_of(balls, [&](const auto& ball) {
    const Vec3f d = p - ball.first;
    return d.x * d.x + d.y * d.y + d.z * d.z * flat * flat < ball.second * ball.second * radius_ * radius_;
  });
}

bool Crown::Contains(Vec3f p) const { return InOneOf(lobes_, p) && !InOneOf(holes_, p); }

float Crown::Openness(Vec3f p) const {
  const Vec3f d{(p.x - center().x) / radius_, (p.y - center().y) / radius_, (p.z - center().z) / (0.5f * height_)};
  // A limb's leaves are a mass of their own: light on its upper and outer side, dark below and where it meets the others.
  const float flat = std::min(1.0f, 2 * radius_ / height_);
  float nearest = 1, local = 0;
  for (size_t i = 1; i < lobes_.size(); ++i) {
    const auto& [at, r] = lobes_[i];
    const Vec3f q = Vec3f{p.x - at.x, p.y - at.y, (p.z - at.z) * flat} / (r * radius_);
    if (Norm(q) >= nearest) continue;
    nearest = Norm(q);
    local = Dot(q, Normalized(Normalized(at - center()) + Vec3f{0, 0, 0.8f}));
  }
  return 0.05f + 0.66f * std::pow(Norm(d), 1.5f) + 0.20f * d.z + 0.30f * local;
}

std::vector<BranchNode> GrowTree(const BroadleafSpecies& s, const Crown& crown, RngStream& random) {
  const float crown_height = s.height - s.clear_trunk;
  // Attractors: more of them near the outside, where the twigs are.
  const Vec3f c = crown.center();
  const auto wanted = [&](Vec3f p) {
    if (p.z < s.clear_trunk * 0.8f || !crown.Contains(p)) return false;
    const Vec3f d{(p.x - c.x) / s.crown_radius, (p.y - c.y) / s.crown_radius, (p.z - c.z) / (crown_height / 2)};
    return random.Uniform() < 0.25 + 0.75 * std::clamp(Norm(d), 0.0f, 1.0f);
  };
  const float reach = s.crown_radius * 1.3f;
  const auto attractors = ScatterInside({-reach, -reach, s.clear_trunk * 0.8f}, {reach, reach, s.height}, s.attractors, wanted, random);

  // Trunk: slightly bent, leaning a little; it ends inside the crown.
  std::vector<BranchNode> nodes;
  const float lean = s.lean * s.height;
  const Vec3f top{lean * static_cast<float>(random.Normal()), lean * static_cast<float>(random.Normal()),
                  s.clear_trunk + crown_height * s.leader};
  AddStem(nodes, -1, {0, 0, -0.25f}, top, s.growth.step, 0.22f, random);
  // Limbs that leave it at different heights and rise.
  const size_t trunk_nodes = nodes.size();
  const int limbs = 5 + static_cast<int>(random.Index(3));
  for (int i = 0; i < limbs; ++i) {
    const float t = (static_cast<float>(i) + static_cast<float>(random.Uniform(0.1, 0.9))) / static_cast<float>(limbs);
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

Model GrowBroadleaf(const BroadleafSpecies& s, const Texture& atlas, uint64_t seed) {
  RngStream random(seed, s.name);
  const Crown crown(s, random);
  const std::vector<BranchNode> nodes = GrowTree(s, crown, random);
  std::vector<PlantLayer> layers = PlantLayers(s.bark, atlas, s.transmission, s.depth);
  AddBark(layers[0], nodes, s.min_branch, 0.45f);
  AddLeaves(s, crown, nodes, layers, seed, random);
  return JoinLayers(std::string(s.name), layers);
}

BroadleafSpecies Simplified(BroadleafSpecies s, float detail) {
  const float grow = 1 / std::sqrt(detail);
  s.leaves = static_cast<int>(static_cast<float>(s.leaves) * detail);
  s.leaf.length *= grow;
  s.leaf.width *= grow;
  s.leaf.form = LeafForm::kKite;
  s.internode *= grow;
  // Fewer, longer steps fill the same crown.
  const float coarse = std::min(2.2f, std::sqrt(grow));
  s.attractors = static_cast<int>(static_cast<float>(s.attractors) / (coarse * coarse));
  s.growth.step *= coarse;
  s.growth.kill *= coarse;
  s.growth.influence *= coarse;
  s.min_branch = detail < 0.04f ? 0.035f : 0.014f;
  return s;
}

}  // namespace airsim360::internal
