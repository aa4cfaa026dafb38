// How the area of a pixel is divided among entities, from the rays that antialiasing sends.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/packet_tracer.h"
#include "airsim360/render/renderer.h"

namespace airsim360::internal {

struct CoverageTask {
  const RayTracer* tracer;
  const CameraRays* rays;
  LabelView labels;
  Vec3f origin;
  int samples;                    ///< of a pixel on a silhouette, the centre ray included
  const Image<EntityId>* entity;  ///< of the centre rays
};

class CoveragePass {
 public:
  /// A pixel whose four neighbours show its own entity is all of it; the others get `samples` rays, at the
  /// points that antialiasing uses. Returns the number of further rays.
  int64_t Run(const CoverageTask& task, Image<CoveragePixel>& out);

 private:
  int RunTile(const CoverageTask& task, int column, int row, Image<CoveragePixel>& out) const;

  TileKernels kernels_;
  std::vector<PixelOffset> offsets_;
};

}  // namespace airsim360::internal
