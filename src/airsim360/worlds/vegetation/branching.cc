#include "airsim360/worlds/vegetation/branching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace airsim360::internal {
namespace {

// What is left to reach, with the nearest joint of each attractor. Attractors only look at new joints, so
// that no search structure is needed.
class Attractors {
 public:
  explicit Attractors(const std::vector<Vec3f>& points)
      : points_(points), nearest_(points.size(), -1), distance2_(points.size(), std::numeric_limits<float>::max()) {}

  void Look(const std::vector<BranchNode>& nodes, size_t first_new, float kill) {
    size_t kept = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
      for (size_t j = first_new; j < nodes.size(); ++j) {
        const Vec3f d = points_[i] - nodes[j].p;
        const float d2 = Dot(d, d);
        if (d2 >= distance2_[i]) continue;
        distance2_[i] = d2;
        nearest_[i] = static_cast<int>(j);
      }
      if (distance2_[i] < kill * kill) continue;
      points_[kept] = points_[i];
      nearest_[kept] = nearest_[i];
      distance2_[kept++] = distance2_[i];
    }
    points_.resize(kept);
    nearest_.resize(kept);
    distance2_.resize(kept);
  }

  // Sum of unit vectors towards the attractors that each joint is nearest to.
  void Pull(const std::vector<BranchNode>& nodes, float influence, std::vector<Vec3f>& pull) const {
    pull.assign(nodes.size(), {});
    for (size_t i = 0; i < points_.size(); ++i) {
      if (distance2_[i] >= influence * influence) continue;
      const auto j = static_cast<size_t>(nearest_[i]);
      pull[j] += (points_[i] - nodes[j].p) / std::sqrt(distance2_[i]);
    }
  }

 private:
  std::vector<Vec3f> points_;
  std::vector<int> nearest_;
  std::vector<float> distance2_;
};

Vec3f DirectionOf(const std::vector<BranchNode>& nodes, size_t i) {
  return nodes[i].parent < 0 ? Vec3f{0, 0, 1} : Normalized(nodes[i].p - nodes[static_cast<size_t>(nodes[i].parent)].p);
}

// Two passes that pull every joint halfway to the middle of its neighbours; ends stay.
void Smooth(std::vector<BranchNode>& nodes) {
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Vec3f> sum(nodes.size());
    std::vector<int> children(nodes.size(), 0);
    for (const BranchNode& node : nodes) {
      if (node.parent < 0) continue;
      sum[static_cast<size_t>(node.parent)] += node.p;
      ++children[static_cast<size_t>(node.parent)];
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].parent < 0 || children[i] == 0) continue;
      nodes[i].p = nodes[i].p * 0.5f + (nodes[static_cast<size_t>(nodes[i].parent)].p + sum[i] / static_cast<float>(children[i])) * 0.25f;
    }
  }
}

}  // namespace

Vec3f RandomDirection(RngStream& random) {
  const double z = random.Uniform(-1, 1), a = random.Uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)};
}

float Noise(Vec3f p, uint64_t seed) {
  const Vec3f cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3f f = p - cell;
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  float sum = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec3f c{static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2)};
    const auto key = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(v) & 0x1fffff); };
    const uint64_t h = MixBits(seed ^ (key(cell.x + c.x) | key(cell.y + c.y) << 21 | key(cell.z + c.z) << 42));
    const auto weight = [&](float t, float corner) { return corner > 0 ? ease(t) : 1 - ease(t); };
    sum += static_cast<float>(h >> 40) * 0x1p-24f * weight(f.x, c.x) * weight(f.y, c.y) * weight(f.z, c.z);
  }
  return sum;
}

int AddStem(std::vector<BranchNode>& nodes, int parent, Vec3f from, Vec3f to, float step, float wander, RngStream& random) {
  const int count = std::max(1, static_cast<int>(std::lround(Norm(to - from) / step)));
  Vec3f drift{};
  for (int i = parent < 0 ? 0 : 1; i <= count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    // A random walk that comes back to nothing at both ends.
    drift += RandomDirection(random) * (wander * step);
    nodes.push_back({from + (to - from) * t + drift * (4 * t * (1 - t)), parent});
    parent = static_cast<int>(nodes.size()) - 1;
  }
  return parent;
}

void Colonise(std::vector<BranchNode>& nodes, const std::vector<Vec3f>& attractors, const GrowthOptions& options, RngStream& random) {
  Attractors rest(attractors);
  std::vector<int> grown(nodes.size(), 0);
  std::vector<Vec3f> pull;
  size_t seen = 0;
  for (int round = 0; round < 250 && nodes.size() < static_cast<size_t>(options.max_nodes); ++round) {
    rest.Look(nodes, seen, options.kill);
    seen = nodes.size();
    // At first the stem reaches far, to find the crown.
    rest.Pull(nodes, options.influence * (round < 12 ? 1.6f : 1.0f), pull);
    for (size_t j = 0; j < seen; ++j) {
      if (Dot(pull[j], pull[j]) == 0 || grown[j] >= 3) continue;
      const Vec3f d =
          Normalized(pull[j]) + DirectionOf(nodes, j) * options.inertia + options.tropism + RandomDirection(random) * options.wander;
      nodes.push_back({nodes[j].p + Normalized(d) * options.step, static_cast<int>(j)});
      ++grown[j];
    }
    if (nodes.size() == seen) break;
    grown.resize(nodes.size(), 0);
  }
  Smooth(nodes);
}

void Thicken(std::vector<BranchNode>& nodes, float trunk_radius, float tip_radius) {
  // Count the tips upwards from the ends; children come after their parents.
  for (BranchNode& node : nodes) {
    node.tips = 0;
    node.main = -1;
  }
  for (size_t i = nodes.size(); i-- > 0;) {
    nodes[i].tips = std::max(1, nodes[i].tips);
    if (nodes[i].parent >= 0) nodes[static_cast<size_t>(nodes[i].parent)].tips += nodes[i].tips;
  }
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) continue;
    BranchNode& parent = nodes[static_cast<size_t>(nodes[i].parent)];
    if (parent.main < 0 || nodes[static_cast<size_t>(parent.main)].tips < nodes[i].tips) parent.main = static_cast<int>(i);
  }
  const float exponent = std::log(trunk_radius / tip_radius) / std::log(std::max(2.0f, static_cast<float>(nodes[0].tips)));
  for (BranchNode& node : nodes) node.radius = tip_radius * std::pow(static_cast<float>(node.tips), exponent);
}

std::vector<Vec3f> ScatterInside(Vec3f min, Vec3f max, int count, const std::function<bool(Vec3f)>& inside, RngStream& random) {
  std::vector<Vec3f> points;
  for (int tries = 0; tries < 400 * count && points.size() < static_cast<size_t>(count); ++tries) {
    const Vec3f p{static_cast<float>(random.Uniform(min.x, max.x)), static_cast<float>(random.Uniform(min.y, max.y)),
                  static_cast<float>(random.Uniform(min.z, max.z))};
    if (inside(p)) points.push_back(p);
  }
  return points;
}

}  // namespace airsim360::internal
