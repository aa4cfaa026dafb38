// Where a scene is indoors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/render/indoor/ray_packet.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Whether a ray along `direction` meets the back of a triangle (of the scene as built).
bool SeenFromBehind(const RayTracer& tracer, const SurfaceRef& ref, Vec3f direction);

/// Space cut into cubes, each marked as enclosed or not: most of what is around its middle and above it is near, panes
/// included, and it is not inside a solid. Immutable; the same with any number of threads.
///
/// A scene is looked at if it says that it has rooms (an entity of construction/ceiling) or is small enough to be a
/// scanned house (kScanned m each way); none of it is enclosed where surfaces glow by themselves (Scene::interior_light).
class Enclosure {
 public:
  static constexpr float kScanned = 80;

  explicit Enclosure(const RayTracer& tracer);
  bool any() const { return enclosed_ > 0; }
  /// m^3 that are enclosed.
  float volume() const { return static_cast<float>(enclosed_) * size_ * size_ * size_; }
  /// Whether some cube in or beside the box is enclosed.
  bool Touches(const Box3f& box) const;
  /// Whether a camera at p stands indoors: in an enclosed cube, or in sight of the middle of one beside it.
  bool Holds(const RayTracer& tracer, Vec3f p) const;
  float size() const { return size_; }  ///< of a cube, m

 private:
  bool At(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < n_[0] && y < n_[1] && z < n_[2] &&
           cubes_[(static_cast<size_t>(z) * n_[1] + y) * n_[0] + x] != 0;
  }
  void Look(const RayTracer& tracer, const Box3f& box);

  std::vector<uint8_t> cubes_;
  Vec3f origin_;
  float size_ = 1;
  int n_[3] = {};
  int64_t enclosed_ = 0;
};

}  // namespace airsim360::internal
