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
  int bounces = 0;
  PathSampler sampler{0, 0};
  uint32_t sample = 0;
};

/// Buffers of one thread's work.
class PathBatch {
 public:
  PathBatch(const PathScene& scene, int max_bounces, bool next_event)
      : scene_(scene), max_bounces_(max_bounces), next_event_(next_event) {}

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
  void JoinLights(bool of_sky);
  void Scatter(uint32_t step);

  const PathScene& scene_;
  const int max_bounces_;
  const bool next_event_;
  std::vector<Path> paths_;
  std::vector<int> active_;
  RaySet at_;  // rays of the surfaces below; slot is the path
  SurfaceSet surfaces_;
  ScatterSet scatter_;
  Vec3f light_[kBatch];  // radiance of the directions in scatter_, and their densities
  float light_pdf_[kBatch];
  ShadowRays shadow_;
};

}  // namespace airsim360::internal
