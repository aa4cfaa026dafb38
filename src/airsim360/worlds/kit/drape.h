// Lays what was built on a flat plan over hills and round bends, so that its layers stay as far apart as they were.
#pragma once

#include <functional>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

/// A map from the plan (x, y, height over the ground) to W that is affine on each triangle of a lattice, the rectangles of
/// which are cut from their lower left to their upper right corner. A mesh that is split along the lattice before it is moved
/// lies on the ground exactly: paint stays its six millimetres above the road, kerbs stay closed.
class Drape {
 public:
  /// Lines of the lattice, growing, two at least each way; `ground` gives where a point of the plan comes to lie. Beyond the
  /// lattice the outermost triangles go on.
  Drape(std::vector<float> xs, std::vector<float> ys, const std::function<Vec3f(Vec2f)>& ground);

  /// A point of the plan at p.z over the ground.
  Vec3f At(Vec3f p) const;
  /// The ground around a plan's point: columns of A are what the plan's x and y become, and up; p is the point itself.
  AffineTransform Frame(Vec2f p) const;
  /// The mesh of the plan in W: split along the lattice, moved, with normals that turn smoothly. Colours are not kept.
  Mesh Lay(const Mesh& flat) const;

 private:
  struct Node {
    Vec3f p, dx, dy;  // where it lies, derivatives there
  };
  struct Weights {
    size_t node[3];
    float w[3];
  };
  size_t Column(float x) const;
  size_t Row(float y) const;
  Weights Locate(Vec2f p, size_t column, size_t row, bool upper) const;
  Weights Locate(Vec2f p) const;
  Node Mix(const Weights& weights) const;

  std::vector<float> xs_, ys_;
  std::vector<Node> nodes_;  // row by row
};

}  // namespace airsim360
