// The pictures of a real 360 degree camera: two fisheye lenses back to back, stitched as such cameras do it.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "airsim360/base/config.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

enum class LensModel { kIdeal, kReal360 };
inline constexpr const char* kLensModelNames[] = {"ideal", "real360"};

/// A consumer 360 camera. Light is in units of the display's white, after exposure, before the tone curve.
struct Real360 {
  double fov_deg = 195;       ///< of each equidistant fisheye; 180 + blend_deg … 220
  double baseline = 0.030;    ///< metres between the optical centres, along C's forward axis
  double blend_deg = 4;       ///< width of the seam over which the two pictures are mixed
  double vignetting = 0.12;   ///< share of light that is missing at the rim: 1 - vignetting (theta / theta_max)^2
  double mismatch_ev = 0.08;  ///< the rear picture is brighter by so many stops
  double full_well = 6000;    ///< photo-electrons of a pixel at white: shot noise has variance 1 / full_well
  double read_noise = 4;      ///< electrons, standard deviation
  double readout = 1.0 / 60;  ///< seconds from the first row to the last (rolling shutter); 0 = at once
  double fringe = 0.0004;     ///< red is magnified and blue shrunk by this part (lateral colour)
  double jpeg_quality = 90;   ///< 1 … 100; 0 = not compressed

  /// No parallax, noise, fringe, fall-off or compression: what is left is resampling.
  static Real360 Perfect();
  void Visit(ConfigVisitor& v);
};

/// InputError naming the first field that makes no sense.
void CheckReal360(const Real360& lens);

/// Variance of the noise of one channel of a sensor's pixel at a signal: signal / full_well +
/// (read_noise / full_well)^2.
double NoiseVariance(const Real360& lens, double signal);

/// From the stitched light, exposed, to a picture.
using DevelopLight = std::function<void(Image<Rgb32f>& light, Image<Rgb8>& rgb)>;

/// Where the camera is at a time relative to the trigger, seconds.
using PoseAt = std::function<RigidTransform(double t)>;

/// Renders both sensors and stitches them to `target` as if everything were far away: what is near does not
/// fit at the seam. Rows of a sensor are exposed one after the other, top row first, the middle row at t = 0
/// (in bands of 16 rows where `X_WC` moves). `request` gives tier, state and seed; its
/// camera, pose and products are not used. Radiance times `exposure` is what a sensor sees. Noise is keyed by
/// (seed, frame, sensor, pixel). Returns the counters of all rendering.
RenderStats RenderReal360(const Real360& lens, const RenderRequest& request, const PoseAt& X_WC, bool moving, float exposure,
                          uint64_t frame, const Equirectangular& target, Renderer& renderer, const DevelopLight& develop, Image<Rgb8>& rgb);

namespace internal {

/// The picture of one sensor of `target`'s resolution.
Fisheye SensorCamera(const Real360& lens, const Equirectangular& target);
/// Pose of the front or rear sensor in C.
RigidTransform SensorPose(const Real360& lens, bool rear);
/// Fall-off, mismatch and noise of a sensor's exposed light.
void ExposeSensor(const Real360& lens, const Fisheye& camera, bool rear, uint64_t seed, uint64_t frame, Image<Rgb32f>& light);
/// Both pictures on the sphere.
Image<Rgb32f> StitchSensors(const Real360& lens, const Fisheye& camera, const Image<Rgb32f>& front, const Image<Rgb32f>& rear,
                            const Equirectangular& target);

}  // namespace internal
}  // namespace airsim360
