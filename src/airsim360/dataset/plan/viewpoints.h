// Places for a camera that hovers: even over the ground and the logarithm of the height, free, outside of everything or in the rooms of
// a building; some of them where a rare category is seen.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/dataset/plan/plan.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

class ViewpointSampler {
 public:
  /// `tracer` must outlive it.
  ViewpointSampler(const RayTracer& tracer, const RecipeRow& row, uint64_t seed, const std::vector<Aim>& aims);
  /// Pose of the body at frame `k` of the row: a pure function, the same whatever else is asked and however many frames the
  /// row has. InputError if among 200 places none is free. Any thread.
  RigidTransform Pose(int64_t k) const;

  /// Categories of which frames without aims see too few, with the shares that make up for it: found by rays from the first
  /// 256 viewpoints.
  std::vector<Aim> FindAims() const;

 private:
  Vec3d Even(int64_t k) const;
  bool Near(CategoryId category, int64_t k, Vec3d& p_W) const;
  std::optional<Vec3d> Candidate(uint64_t n, const double offset[3]) const;
  bool IsGood(Vec3d p_W) const;
  bool SeesTheSky(Vec3d p_W) const;
  std::optional<double> FloorUnder(Vec3d p_W) const;

  const RayTracer& tracer_;
  RecipeRow row_;
  uint64_t seed_;
  SurveyedGround ground_;
  bool has_area_ = false;
  Box2d limit_;  ///< no viewpoint lies outside: the row's area, or the ground before a backdrop
  std::vector<std::pair<CategoryId, double>> aims_;
  std::map<CategoryId, std::vector<EntityId>> entities_;
};

/// Height of the lowest surface below or above a point of the ground plan; nullopt where there is none.
std::optional<double> GroundUnder(const RayTracer& tracer, Vec2d at);

/// `n` directions spread evenly over the sphere.
std::vector<Vec3f> EvenDirections(int n);

}  // namespace airsim360
