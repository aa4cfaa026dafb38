// More colour samples where neighbouring pixels differ.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/packet_tracer.h"

namespace airsim360::internal {

/// Number that everything random of a canonical pixel depends on.
inline uint64_t PixelKey(int column, int row, int width) {
  return MixBits(static_cast<uint64_t>(row) * static_cast<uint64_t>(width) + static_cast<uint64_t>(column));
}
/// Points of a pixel for samples 1 … samples - 1 (0 is the centre) in several mirror images, into `out`.
void MakeSampleOffsets(const CameraRays& rays, int samples, std::vector<PixelOffset>& out);
/// The points of one pixel among those; the first is that of sample 1.
const PixelOffset* SampleOffsets(const std::vector<PixelOffset>& offsets, uint64_t pixel_key, int samples);

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
  Image<Rgb8>* colors;         ///< in: of the centre rays
  const Image<SunPixel>* sun;  ///< of the centre rays
  ToneCurve tone = ToneCurve::kFilmic;
  /// In and out as `colors`, linear: bright samples count for less, so that edges of highlights are smooth in
  /// whatever is made of it. nullptr = not wanted.
  Image<Rgb32f>* light = nullptr;
};

class Antialiaser {
 public:
  /// Marks the pixels that differ from a neighbour.
  void FindEdges(const Image<EntityId>& entity, const Image<uint8_t>& luma, bool wraps, Image<uint8_t>& edges) const;
  /// Replaces the colours of marked pixels by the mean, in display-linear light, of `samples` rays spread
  /// over the pixel (box filter of one pixel). Tone mapping before the mean keeps edges of highlights smooth.
  /// A pixel that only contrasts with a neighbour of the same entity, or borders on another entity that looks
  /// the same, gets one ray more at first, and the rest if that one looks different. Returns the number of rays.
  int64_t Run(const AntialiasTask& task);

 private:
  int RunTiles(const AntialiasTask& task, int column, int row) const;

  TileKernels kernels_;
  std::vector<PixelOffset> offsets_;  // [symmetry][sample - 1]
};

}  // namespace airsim360::internal
