// More colour samples where neighbouring pixels differ.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "airsim360/render/cpu/camera_rays.h"
#include "airsim360/render/cpu/packet_tracer.h"

namespace airsim360::internal {

/// What the antialiasing pass reads and writes.
struct AntialiasTask {
  const RayTracer* tracer;
  const Shader* shader;
  const CameraRays* rays;
  LabelView labels;
  Vec3f origin;
  double exposure_ev;
  int samples;  ///< of a pixel on a silhouette, the centre ray included
  const Image<uint8_t>* edges;
  Image<Rgb8>* colors;  ///< in: of the centre rays
  ToneCurve tone = ToneCurve::kFilmic;
};

class Antialiaser {
 public:
  /// Marks the pixels that differ from a neighbour.
  void FindEdges(const Image<EntityId>& entity, const Image<uint8_t>& luma, bool wraps,
                 Image<uint8_t>& edges) const;
  /// Replaces the colours of marked pixels by the mean, in display-linear light, of `samples` rays spread
  /// over the pixel (box filter of one pixel). Tone mapping before the mean keeps edges of highlights smooth.
  /// A pixel that only contrasts with a neighbour of the same entity gets one ray more at first, and the rest
  /// if that one looks different. Returns the number of rays.
  int64_t Run(const AntialiasTask& task);

 private:
  void MakeOffsets(const CameraRays& rays, int samples);
  int RunTile(const AntialiasTask& task, int column, int row) const;

  TileKernels kernels_;
  std::vector<PixelOffset> offsets_;  // [symmetry][sample - 1]
};

}  // namespace airsim360::internal
