// Choosing one of many lamps by an estimate of what each sends to a surface: Conty Estevez & Kulla,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018 (without the splitting).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// What a set of lamps can do.
struct LightBounds {
  Box3f box;
  float power = 0;
  Vec3f axis{0, 0, 1};
  float spread = 0;  ///< half angle of the cone of normals, radians

  LightBounds Join(const LightBounds& other) const;
  /// Upper estimate of what reaches a surface at p, up to a common factor. 0 only if nothing can, by place
  /// and orientation; a zero normal takes light from all sides.
  float Importance(Vec3f p, Vec3f normal) const;
};

/// A binary tree over lamps; leaves are single lamps. Immutable.
class LightTree {
 public:
  struct Choice {
    uint32_t lamp = 0;
    float probability = 0;  ///< 0 = none
    float u = 0;            ///< what is left of the random number, uniform in [0, 1)
  };

  LightTree() = default;
  explicit LightTree(std::span<const LightBounds> lamps);
  Choice Choose(Vec3f p, Vec3f normal, float u) const;
  /// Choose(p, normal, u[k]) for all k but for rounding; u ascends. Looks at every node once, where as many single choices would
  /// each look at all nodes on their way.
  void ChooseAll(Vec3f p, Vec3f normal, std::span<const float> u, std::span<Choice> choices) const;
  /// Probability of Choose for that lamp.
  float Probability(Vec3f p, Vec3f normal, uint32_t lamp) const;

  struct Node {
    LightBounds bounds;
    uint32_t second = 0;  ///< index of the second child, the first follows its parent; 0 = leaf
    uint32_t parent = 0;
    uint32_t lamp = 0;  ///< of a leaf
  };
  std::span<const Node> nodes() const { return nodes_; }
  /// By lamp, index of its node.
  std::span<const uint32_t> leaf_of() const { return leaf_of_; }

 private:
  void Descend(Vec3f p, Vec3f normal, uint32_t at, std::span<Choice> choices) const;
  /// Importance of a node to a surface, without angles.
  float Reach(uint32_t node, Vec3f p, Vec3f normal) const;
  uint32_t Build(std::span<uint32_t> order, std::span<const LightBounds> lamps, uint32_t parent);

  std::vector<Node> nodes_;
  std::vector<uint32_t> leaf_of_;
  std::vector<Vec2f> cone_;  ///< by node, cosine and sine of its spread
};

}  // namespace airsim360::internal
