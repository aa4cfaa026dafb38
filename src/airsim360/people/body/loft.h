// Lofted surfaces: rings along a limb, joined by triangles, with skin weights. What procedural bodies are
// made of.
#pragma once

#include <functional>
#include <span>

#include "airsim360/people/body/body.h"

namespace airsim360::internal {

/// A mixture of bones: adds `weight` of one to what is there; the four heaviest stay, with sum 1.
Influences Bone(Joint joint);
Influences MixBones(const Influences& a, const Influences& b, double t);

/// A superellipse in the plane of the loft's u and v: half-width along u, reach along +v (front) and -v.
struct LoftRing {
  Vec3d center;
  double half = 0, front = 0, back = 0;
  double power = 2.2;  ///< 2: ellipse, larger: boxier
  Influences bones;
  double v = -1;  ///< texture v; negative: by number of the ring
};

/// What may be changed of a vertex: theta is 0 at +v, pi / 2 at +u.
struct LoftVertex {
  Vec3d p;
  double theta = 0;
  Influences bones;
};

struct LoftStyle {
  uint32_t material = 0;
  int segments = 24;  ///< around
  int steps = 2;      ///< rings per given ring (Catmull-Rom between)
  Vec3d u{0, 1, 0}, v{1, 0, 0};
  bool cap_first = false, cap_last = true;
  double uv_metres = 0;  ///< 0: uv runs over [0, 1] around (0.5 = front) and along; else metres per tile
  std::function<void(LoftVertex&)> deform = {};
};

/// Collects lofts into a level; parts with the same material and prop follow each other.
class LoftMesh {
 public:
  void Loft(std::span<const LoftRing> rings, const LoftStyle& style);
  /// An ellipsoid that follows one bone.
  void Ellipsoid(Vec3d center, Vec3d radii, Joint bone, uint32_t material, int segments);
  /// What follows is a prop, rigid on a bone (kRootInfluence: the person frame).
  void BeginProp(Prop prop, uint8_t bone);
  void Box(Vec3d center, Vec3d half, const Mat3d& R, uint32_t material);
  /// A straight round bar, closed at both ends.
  void Bar(Vec3d a, Vec3d b, double radius_a, double radius_b, int segments, uint32_t material);
  BodyLevel Finish(std::string name);

 private:
  uint32_t Add(Vec3d p, Vec2f uv, const Influences& bones);
  void Face(uint32_t a, uint32_t b, uint32_t c, uint32_t material);

  struct Triangle {
    Vec3u vertices;
    uint32_t material, prop;
  };
  BodyLevel level_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> same_;  // vertex -> the one it is smoothed with (seams)
  Prop prop_ = Prop::kNone;
  uint8_t prop_bone_ = 0;
};

/// Adds a level that holds only props behind the vertices and parts of another.
void AppendLevel(const BodyLevel& props, BodyLevel& level);

}  // namespace airsim360::internal
