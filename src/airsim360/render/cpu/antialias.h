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
  int samples;  ///< of an edge pixel, the centre ray included
  const Image<uint8_t>* edges;
  Image<Rgb8>* colors;  ///< in: of the centre rays
};

class Antialiaser {
 public:
  /// Marks the pixels that differ from a neighbour; returns how many.
  int64_t FindEdges(const Image<EntityId>& entity, const Image<uint8_t>& luma, bool wraps,
                    Image<uint8_t>& edges) const;
  /// Replaces the colours of marked pixels by the mean, in display-linear light, of `samples` rays spread
  /// over the pixel (box filter of one pixel). Tone mapping before the mean keeps edges of highlights smooth.
  void Run(const AntialiasTask& task);

 private:
  void MakeOffsets(const CameraRays& rays, int samples);
  void RunTile(const AntialiasTask& task, int column, int row) const;

  TileKernels kernels_;
  std::vector<PixelOffset> offsets_;  // [symmetry][sample - 1]
};

}  // namespace airsim360::internal
