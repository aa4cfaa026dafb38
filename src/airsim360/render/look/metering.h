// What a camera finds out from the picture itself: exposure and white balance.
#pragma once

#include <array>
#include <vector>

#include "airsim360/render/look/camera_look.h"
#include "airsim360/render/look/scatter.h"
#include "airsim360/render/renderer.h"

namespace airsim360::internal {

/// The light of a picture by solid angle: a histogram of each channel in sixteenths of an octave.
class LightHistogram {
 public:
  /// Of kept * light + share * scattered (empty planes: without).
  LightHistogram(const LightCells& light, float kept, const LightCells& scattered, float share);

  /// Mean over the solid angle of the luminance of encoded values, where `curve` encodes the root of light / clip.
  double MeanEncoded(const std::vector<float>& curve, double clip, const std::array<double, 3>& scale) const;
  /// Light of green, which most of luminance is, that `share` of the solid angle is brighter than.
  double BrighterThan(double share) const;
  /// Share of the solid angle whose green is below `limit`, of all but the darkest (below 2^-20).
  double ShareBelow(double limit) const;
  /// Geometric mean of a channel, without the darkest (below 2^-20).
  double LogMean(int channel) const;

 private:
  static constexpr int kLowest = -20, kHighest = 16, kBins = 16 * (kHighest - kLowest);
  using Counts = std::array<std::array<double, kBins>, 3>;
  Counts share_{};  // of the solid angle
  std::array<double, kBins> middle_{};
};

/// Gains of the white balance without errors, green 1. By day what the sun and the sky bring is made neutral to a large
/// part, in a picture of shade what the sky brings, less where the sun is low; part of what is left, and more indoors and by lamps, is by the mean of the picture.
std::array<double, 3> WhiteBalance(double strength, const Daylight& day, const LightHistogram& picture);

/// Factor to light so that MeanEncoded is `aim`; within [low, high].
double MeterExposure(const LightHistogram& picture, const std::vector<float>& curve, double clip, const std::array<double, 3>& gains,
                     double aim, double low, double high);

}  // namespace airsim360::internal
