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
  const Image<Vec3f>* normal = nullptr;     ///< unit shading normal in W
  /// Unit geometric normal in W, for the distance from a pixel's plane; nullptr = `normal`, with more
  /// tolerance.
  const Image<Vec3f>* geometric_normal = nullptr;
};

/// Light of a pixel without its albedo, so that textures are not blurred. Finite and not negative.
struct LightSignal {
  Image<Rgb32f>* light = nullptr;           ///< in: mean of the samples; out: filtered. Unchanged where no surface is
  const Image<uint8_t>* samples = nullptr;  ///< how many; 0 = none yet, to be filled from neighbours;
                                            ///< nullptr = one each
  float radius_px = 12;                     ///< about how far samples may travel at the equator: the step of the last level, at
                                            ///< most 12
};

/// Edge-avoiding a-trous wavelet (Dammertz et al. 2010) with variance guidance (after SVGF, Schied et al.
/// 2017) on the sphere: steps in x grow with 1 / cos(latitude). Light mixes only within an entity, within a
/// distance from the pixel's plane of about a pixel's width there, and between similar normals; leaves and
/// other surfaces without like neighbours mix with what the entity has nearby. How different light may be
/// follows from the noise that is there. Constant light is returned bit for bit. Same bytes with any number
/// of threads and any instruction set; turning the camera by k columns rolls the result by k columns.
///
/// `temporal`: what the last Run of the slot saw of the same surface point counts too, up to 16 frames;
/// rejected by entity, plane and normal. Things that move along their own surface are not told apart.
/// Keeps its buffers, and its history, between frames. InputError for a null guide or sizes that differ.
class Denoiser {
 public:
  Denoiser();
  Denoiser(Denoiser&&) noexcept;
  ~Denoiser();
  /// Filters one signal. `slot` names the history (0, 1, …: one for each kind of light).
  void Run(const FilterGuides& guides, const LightSignal& signal, bool temporal, int slot = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360::internal
