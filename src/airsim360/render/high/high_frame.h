// Tier `high` of one frame: what needs the whole image (denoising) between tracing and display.
#pragma once

#include <memory>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/label_tables.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/shading/shader.h"

namespace airsim360::internal {

/// Ambient rays that a pixel of the tile row from `row` on gets, on average, at least one: rows of a panorama are shorter towards the
/// poles, and so are the pixels' shares of the sphere.
float AmbientRays(const RenderRequest& request, const RayField& field, int row);

/// Keeps its buffers between frames.
class HighFrame {
 public:
  HighFrame();
  ~HighFrame();
  /// Makes what depends on the scene and its sun alone; Render does it otherwise.
  void Prepare(const RayTracer& tracer, const Shader& shader);
  /// Fills `radiance` (linear, edges antialiased) and the labels asked for. Returns the number of rays.
  uint64_t Render(const RayTracer& tracer, const Shader& shader, const CameraRays& rays, const LabelView& labels,
                  const RenderRequest& request, Image<Rgb32f>& radiance, Frame& frame);
  /// For tests: takes the tiles of the next frames in another order, which must not change a byte.
  void ShuffleTiles(uint64_t order);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360::internal
