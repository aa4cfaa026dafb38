// What a picture shows, by rays that are no pixels, and what things measure, by their triangles. For check_language.cc.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "airsim360/trace/ray_tracer.h"
#include "airsim360/vln/language/language_item.h"
#include "airsim360/vln/predicates/entity_parts.h"

namespace airsim360::internal {

/// Rays of one thing in one picture.
struct Glimpse {
  int64_t rays = 0;
  Vec3d sum;                                                  // of unit directions: east, north, up as in W
  double column = 0;                                          // sum
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;  // columns and rows
  std::vector<double> azimuths;                               // degrees, clockwise from the heading
};

using Glimpses = std::map<EntityId, Glimpse>;

class SecondLook {
 public:
  explicit SecondLook(std::shared_ptr<const RayTracer> tracer);
  const Scene& scene() const { return tracer_->scene(); }

  /// One ray for each pixel of a picture, off its centre. The last pictures' are kept; what Points gave before is gone.
  const Glimpses& LookAt(const LanguagePicture& picture);
  /// Share of a thing's surface, front and back, that nothing else hides and that lies within the picture.
  double Shown(const LanguagePicture& picture, EntityId entity);
  /// Metres from a place to the nearest triangle of a thing, and between two things.
  double Distance(Vec3d from, EntityId to);
  double Apart(EntityId a, EntityId b);
  const std::vector<Vec3d>& Points(EntityId entity);  ///< corners of its triangles
  /// Largest extent of its corners, metres.
  double Extent(EntityId entity);

 private:
  const std::vector<std::array<Vec3d, 3>>& Triangles(EntityId entity);
  std::shared_ptr<const RayTracer> tracer_;
  std::vector<std::vector<EntityPart>> parts_;  // by entity
  std::map<EntityId, std::vector<std::array<Vec3d, 3>>> triangles_;
  std::map<EntityId, std::vector<Vec3d>> points_;
  std::map<std::string, Glimpses> seen_;
  size_t kept_ = 0;  // triangles
};

}  // namespace airsim360::internal
