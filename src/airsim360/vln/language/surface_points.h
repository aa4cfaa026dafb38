// Points on the surfaces of things, to tell how much of a thing a picture shows. For the .cc files of this folder.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "airsim360/vln/predicates/entity_parts.h"

namespace airsim360::internal {

/// Of one scene. Any thread; whoever asks first changes nothing.
class SurfacePoints {
 public:
  explicit SurfacePoints(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)), parts_(PartsByEntity(*scene_)) {}
  /// About kMost points in W, spread evenly over the area of all triangles of an entity. Empty for one that has none.
  std::vector<Vec3d> Of(EntityId entity) const;
  static constexpr int kMost = 64;

 private:
  struct Spread {
    double area = 0;
    std::vector<Vec3f> points;  // kMost, in the mesh; the first few of them are spread as well as all
  };
  const Spread& SpreadOf(uint32_t mesh, uint32_t part) const;

  std::shared_ptr<const Scene> scene_;
  std::vector<std::vector<EntityPart>> parts_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<uint32_t, uint32_t>, Spread> spreads_;  // by mesh and part: trees share theirs
};

}  // namespace airsim360::internal
