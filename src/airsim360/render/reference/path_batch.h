// Up to 256 paths on their way together: traced sixteen at a time, shaded by kernels, step by step.
#pragma once

#include <vector>

#include "airsim360/render/reference/path_rays.h"
#include "airsim360/render/reference/path_sampler.h"

namespace airsim360::internal {

struct Path {
  Vec3f origin, direction;
  Vec3f throughput{1, 1, 1}, radiance{};
  float width = 0, spread = 0;  ///< ray cone: at the origin, growth per metre
  float pdf = 0;                ///< of the direction; 0 = from the camera
  Vec3f from, from_normal;      ///< the surface that chose the direction: point, normal as in SampleLamp
  int bounces = 0;
  PathSampler sampler{0, 0};
  uint32_t sample = 0;
};

/// Buffers of one thread's work.
class PathBatch {
 public:
  /// `cone_angle`: between neighbouring pixels.
  PathBatch(const PathScene& scene, int max_bounces, bool next_event, float cone_angle)
      : scene_(scene), max_bounces_(max_bounces), next_event_(next_event), cone_angle_(cone_angle) {}

  void Clear() { paths_.clear(); }
  /// At most kBatch.
  void Add(const Path& path) { paths_.push_back(path); }
  /// Follows all paths to their ends.
  void Run();
  const Path& path(int i) const { return paths_[i]; }
  int size() const { return static_cast<int>(paths_.size()); }

 private:
  void FillRays(RaySet& rays) const;
  void Escape(RaySet& misses);
  void Arrive(RaySet& hits, uint32_t step);
  void JoinSun(uint32_t step);
  void JoinSky(uint32_t step);
  void JoinLamps(uint32_t step);
  void SetLight(int i, const LightRay& ray);
  float EmissionWeight(const Path& path, int i) const;
  void AddPrecipitation(const RaySet& rays, bool sky);
  void JoinLights(bool of_sky);
  void Scatter(uint32_t step);

  const PathScene& scene_;
  const int max_bounces_;
  const bool next_event_;
  const float cone_angle_;
  std::vector<Path> paths_;
  std::vector<int> active_;
  RaySet at_;  // rays of the surfaces below; slot is the path
  SurfaceSet surfaces_;
  ScatterSet scatter_;
  LightRay lights_[kBatch];  // of the directions in scatter_
  ShadowRays shadow_;
  RaySet camera_hits_, camera_misses_;  // where it rains or snows
};

}  // namespace airsim360::internal
