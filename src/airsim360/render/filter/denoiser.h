// Removes the noise of few samples from light on a panorama, along surfaces and never across them.
#pragma once

#include <cstdint>
#include <memory>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"
#include "airsim360/math/vector.h"
#include "airsim360/projection/camera.h"

namespace airsim360::internal {

/// Exact guides: one value a pixel, from the ray through its centre. All images have the camera's size.
struct FilterGuides {
  const Camera* camera = nullptr;  ///< equirectangular: columns wrap and rows go on across the poles
  RigidTransform X_WC;
  const Image<float>* range = nullptr;      ///< 0 = no surface
  const Image<uint32_t>* entity = nullptr;  ///< a hard stop
  const Image<Vec3f>* normal = nullptr;     ///< shading normal in W
};

/// Light of a pixel without its albedo, so that textures are not blurred.
struct LightSignal {
  Image<Rgb32f>* light = nullptr;           ///< in: mean of the samples; out: filtered
  const Image<uint8_t>* samples = nullptr;  ///< how many; 0 = none yet, to be filled from neighbours
  float radius_px = 16;                     ///< about how far samples may travel at the equator
};

/// Edge-avoiding a-trous wavelet (Dammertz et al. 2010) with variance guidance (SVGF, Schied et al. 2017) on
/// the sphere: steps in x grow with 1 / cos(latitude). Keeps its buffers, and with `temporal` its history,
/// between frames. Same bytes with any number of threads.
class Denoiser {
 public:
  Denoiser();
  ~Denoiser();
  /// Filters one signal. `slot` names the history (0, 1, …: one for each kind of light).
  void Run(const FilterGuides& guides, const LightSignal& signal, bool temporal, int slot = 0);
  /// Forgets all history.
  void Reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360::internal
