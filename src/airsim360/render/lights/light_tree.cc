#include "airsim360/render/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr int kBins = 12;

float AngleBetween(Vec3f a, Vec3f b) { return std::acos(std::clamp(Dot(a, b), -1.0f, 1.0f)); }

// Cosine of an angle after a cone has been taken off it; 0 beyond a right angle.
float CosineWithin(float angle, float cone) {
  const float left = std::max(0.0f, angle - cone);
  return left > kPiF / 2 + kLampMargin ? 0 : std::max(std::cos(left), kLampLeastCosine);
}

// Rotates `a` by `angle` towards `b`.
Vec3f TurnTowards(Vec3f a, Vec3f b, float angle) {
  const Vec3f side = Normalized(b - a * Dot(a, b));
  return Normalized(a * std::cos(angle) + side * std::sin(angle));
}

// Solid angle measure of the directions that a cone of normals can shine to (Conty Estevez & Kulla, eq. 1).
float Spread(float cone) {
  const float w = std::min(cone + kPiF / 2, kPiF);
  return 2 * kPiF * (1 - std::cos(cone)) +
         kPiF / 2 * (2 * w * std::sin(cone) - std::cos(cone - 2 * w) - 2 * cone * std::sin(cone) + std::cos(cone));
}

float Area(const Box3f& box) {
  if (box.empty()) return 0;
  const Vec3f s = box.size();
  return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
}

float Cost(const LightBounds& b) { return b.box.empty() ? 0 : b.power * Spread(b.spread) * (Area(b.box) + 1e-6f); }

}  // namespace

LightBounds LightBounds::Join(const LightBounds& other) const {
  if (box.empty()) return other;
  if (other.box.empty()) return *this;
  LightBounds out;
  out.box = box;
  out.box.Add(other.box);
  out.power = power + other.power;
  const LightBounds &a = spread >= other.spread ? *this : other, &b = spread >= other.spread ? other : *this;
  const float between = AngleBetween(a.axis, b.axis);
  if (std::min(between + b.spread, kPiF) <= a.spread) {
    out.axis = a.axis, out.spread = a.spread;
    return out;
  }
  const float cone = (a.spread + between + b.spread) / 2;
  // Opposite axes have no way between them that is better than another.
  if (cone >= kPiF || between > kPiF - 1e-3f) {
    out.axis = a.axis, out.spread = kPiF;
    return out;
  }
  out.axis = between > 1e-4f ? TurnTowards(a.axis, b.axis, cone - a.spread) : a.axis;
  out.spread = std::min(kPiF, cone + 1e-3f);
  return out;
}

float LightBounds::Importance(Vec3f p, Vec3f normal) const {
  const Vec3f to = box.center() - p;
  const float radius2 = 0.25f * Dot(box.size(), box.size()), distance2 = Dot(to, to);
  const float clamped2 = std::max(std::max(distance2, radius2), kLampDistance2);
  // Inside the sphere about the box light may come from anywhere.
  if (distance2 <= radius2) return power / clamped2;
  const Vec3f w = to / std::sqrt(distance2);
  const float subtended = std::asin(std::sqrt(std::min(1.0f, radius2 / distance2)));
  const float emitted = CosineWithin(AngleBetween(axis, -w), spread + subtended);
  const float received = normal == Vec3f{} ? 1.0f : CosineWithin(AngleBetween(normal, w), subtended);
  return power * emitted * received / clamped2;
}

LightTree::LightTree(std::span<const LightBounds> lamps) {
  if (lamps.empty()) return;
  std::vector<uint32_t> order(lamps.size());
  std::iota(order.begin(), order.end(), 0u);
  leaf_of_.resize(lamps.size());
  nodes_.reserve(2 * lamps.size());
  Build(order, lamps, 0);
  for (const Node& node : nodes_) cone_.push_back({std::cos(node.bounds.spread), std::sin(node.bounds.spread)});
}

// Bins along every axis; the cheapest border between two bins wins, else the median.
uint32_t LightTree::Build(std::span<uint32_t> order, std::span<const LightBounds> lamps, uint32_t parent) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_[index].parent = parent;
  if (order.size() == 1) {
    nodes_[index].bounds = lamps[order[0]];
    nodes_[index].lamp = order[0];
    leaf_of_[order[0]] = index;
    return index;
  }

  Box3f centers;
  for (uint32_t i : order) centers.Add(lamps[i].box.center());
  float best = std::numeric_limits<float>::infinity();
  int best_axis = -1, best_bin = 0;
  const auto bin_of = [&](uint32_t i, int axis) {
    const float low = centers.min[axis], size = centers.size()[axis];
    return std::min(kBins - 1, static_cast<int>((lamps[i].box.center()[axis] - low) / size * static_cast<float>(kBins)));
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centers.size()[axis] > 0)) continue;
    std::array<LightBounds, kBins> bins;
    for (uint32_t i : order) {
      LightBounds& bin = bins[bin_of(i, axis)];
      bin = bin.Join(lamps[i]);
    }
    std::array<LightBounds, kBins> above = bins;
    for (int k = kBins - 2; k >= 0; --k) above[k] = above[k].Join(above[k + 1]);
    LightBounds below;
    for (int k = 0; k + 1 < kBins; ++k) {
      below = below.Join(bins[k]);
      if (below.box.empty() || above[k + 1].box.empty()) continue;
      const float cost = Cost(below) + Cost(above[k + 1]);
      if (cost < best) best = cost, best_axis = axis, best_bin = k;
    }
  }
  size_t middle = order.size() / 2;
  if (best_axis >= 0) {
    const auto split = std::stable_partition(order.begin(), order.end(), [&](uint32_t i) { return bin_of(i, best_axis) <= best_bin; });
    middle = static_cast<size_t>(split - order.begin());
  }
  Build(order.first(middle), lamps, index);
  const uint32_t second = Build(order.subspan(middle), lamps, index);
  nodes_[index].second = second;
  nodes_[index].bounds = nodes_[index + 1].bounds.Join(nodes_[second].bounds);
  return index;
}

LightTree::Choice LightTree::Choose(Vec3f p, Vec3f normal, float u) const {
  if (nodes_.empty() || nodes_[0].bounds.Importance(p, normal) <= 0) return {};
  Choice choice{0, 1, u};
  uint32_t at = 0;
  while (nodes_[at].second != 0) {
    const float first = nodes_[at + 1].bounds.Importance(p, normal), second = nodes_[nodes_[at].second].bounds.Importance(p, normal);
    const float sum = first + second;
    if (!(sum > 0)) return {};
    const float share = first / sum;
    const bool to_first = choice.u < share;
    choice.u = to_first ? choice.u / share : (choice.u - share) / (1 - share);
    choice.u = std::clamp(choice.u, 0.0f, 1 - 0x1p-24f);
    choice.probability *= to_first ? share : second / sum;
    at = to_first ? at + 1 : nodes_[at].second;
  }
  choice.lamp = nodes_[at].lamp;
  return choice;
}

void LightTree::ChooseAll(Vec3f p, Vec3f normal, std::span<const float> u, std::span<Choice> choices) const {
  const bool any = !nodes_.empty() && Reach(0, p, normal) > 0;
  for (size_t k = 0; k < u.size(); ++k) choices[k] = any ? Choice{0, 1, u[k]} : Choice{};
  if (any) Descend(p, normal, 0, choices.first(u.size()));
}

namespace {

// CosineWithin of an angle and a cone given by cosines and sines; `whole`: the cone is all directions.
float CosineOutside(float cosine, float cone_cosine, float cone_sine, bool whole) {
  if (whole || cosine >= cone_cosine) return 1;
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  const float left = cosine * cone_cosine + sine * cone_sine;
  return left < -kLampMargin ? 0 : std::max(left, kLampLeastCosine);
}

}  // namespace

float LightTree::Reach(uint32_t node, Vec3f p, Vec3f normal) const {
  const LightBounds& bounds = nodes_[node].bounds;
  const Vec3f to = bounds.box.center() - p;
  const float radius2 = 0.25f * Dot(bounds.box.size(), bounds.box.size()), distance2 = Dot(to, to);
  const float clamped2 = std::max(std::max(distance2, radius2), kLampDistance2);
  if (distance2 <= radius2) return bounds.power / clamped2;
  const Vec3f w = to / std::sqrt(distance2);
  const float sine2 = radius2 / distance2, sine = std::sqrt(sine2), cosine = std::sqrt(1 - sine2);  // of half of what it subtends
  const Vec2f cone = cone_[node];
  const float both = cone.x * cosine - cone.y * sine, both_sine = cone.y * cosine + cone.x * sine;
  const float emitted = CosineOutside(-Dot(bounds.axis, w), both, both_sine, bounds.spread > kPiF / 2 && both_sine <= 0);
  const float received = normal == Vec3f{} ? 1.0f : CosineOutside(Dot(normal, w), cosine, sine, false);
  return bounds.power * emitted * received / clamped2;
}

// The same numbers as in Choose: those of choices that go the same way keep their order.
void LightTree::Descend(Vec3f p, Vec3f normal, uint32_t at, std::span<Choice> choices) const {
  while (nodes_[at].second != 0) {
    const float first = Reach(at + 1, p, normal), second = Reach(nodes_[at].second, p, normal);
    const float sum = first + second;
    if (!(sum > 0)) {
      for (Choice& choice : choices) choice = {};
      return;
    }
    const float share = first / sum;
    size_t to_first = 0;
    for (Choice& choice : choices) {
      const bool goes_first = choice.u < share;
      choice.u = goes_first ? choice.u / share : (choice.u - share) / (1 - share);
      choice.u = std::clamp(choice.u, 0.0f, 1 - 0x1p-24f);
      choice.probability *= goes_first ? share : second / sum;
      to_first += goes_first;
    }
    if (to_first > 0 && to_first < choices.size()) Descend(p, normal, at + 1, choices.first(to_first));
    at = to_first == choices.size() ? at + 1 : nodes_[at].second;
    if (to_first < choices.size()) choices = choices.subspan(to_first);
  }
  for (Choice& choice : choices) choice.lamp = nodes_[at].lamp;
}

float LightTree::Probability(Vec3f p, Vec3f normal, uint32_t lamp) const {
  if (nodes_[0].bounds.Importance(p, normal) <= 0) return 0;
  float probability = 1;
  for (uint32_t at = leaf_of_[lamp]; at != 0; at = nodes_[at].parent) {
    const Node& parent = nodes_[nodes_[at].parent];
    const uint32_t first = nodes_[at].parent + 1, other = at == first ? parent.second : first;
    const float own = nodes_[at].bounds.Importance(p, normal), sum = own + nodes_[other].bounds.Importance(p, normal);
    if (!(sum > 0)) return 0;
    probability *= own / sum;
  }
  return probability;
}

}  // namespace airsim360::internal
