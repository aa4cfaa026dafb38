// What a consumer 360 degree camera does between light and picture: the options of `--look photo`.
#pragma once

#include <cstdint>
#include <string_view>

#include "airsim360/base/config.h"
#include "airsim360/render/shared/dimmest_white.h"

namespace airsim360 {

/// kClean: the exposed light through a tone curve (render/filter/tone_map.h). kPhoto: as of a CameraLook.
enum class Look { kClean, kPhoto };
inline constexpr const char* kLookNames[] = {"clean", "photo"};
/// Look of a name; InputError naming the nearest if there is none.
Look ParseLook(std::string_view name);

/// A camera's effects, each with its strength; 0 switches one off. "White" is the light that comes out as 255 where
/// nothing compresses highlights. Typical of such cameras, chosen by us beside photographed panoramas; not the
/// figures of a product.
struct CameraLook {
  // Exposure
  double metering = 0.56;                ///< mean of the sRGB-encoded picture that exposure aims at, 0 … 1; 0: fixed daylight exposure
  double metering_spread = 0.03;         ///< standard deviation of that aim, drawn
  double dimmest_white = kDimmestWhite;  ///< cd/m2 that exposure makes white at the most: nights stay dark

  // Lens
  double glare = 0.04;       ///< share of the light that the lens scatters
  double glare_deg = 2;      ///< about half of that stays within so many degrees
  double softness_px = 0.6;  ///< standard deviation of the blur by lens and demosaicing, pixels, at most 0.8

  // Sensor: noise of a channel of the picture's light in units of white has the variance
  // signal gain / full_well + (read_noise gain / full_well)^2.
  double full_well = 15000;  ///< electrons at white without gain; 0: no noise
  double read_noise = 3;     ///< electrons, standard deviation
  double base_white = 40;    ///< cd/m2 at white with the longest time and no gain; darker whites need gain: base_white / white

  // Colour
  double white_balance = 0.85;  ///< share of the light's colour that is taken out, 0 … 1
  double white_error = 0.035;   ///< standard deviation of the gains of red (and, against it, blue), drawn
  double saturation = 1.05;     ///< 1: as it is

  // Tone
  double shoulder = 2.2;          ///< highlights: white is reached at 1 where 0, at 2.2 by default; middle grey stays
  double contrast = 0.72;         ///< of an S about the middle of the encoded values
  double contrast_spread = 0.12;  ///< standard deviation, drawn
  double sharpening = 0.45;       ///< of luminance against its blur by 1.3 pixels

  bool each_frame = false;  ///< draw again for every frame; else one draw for all frames of a seed

  /// Everything switched off: the sRGB of the light in units of white, clipped at 1.
  static CameraLook Neutral();
  void Visit(ConfigVisitor& v);
};

/// InputError naming the first field that makes no sense, after `prefix` ("--" of flags).
void CheckCameraLook(const CameraLook& look, std::string_view prefix = {});

/// What is drawn of a look, by (seed) or (seed, frame).
struct DrawnLook {
  double metering = 0;                  ///< as CameraLook::metering
  double red = 1, green = 1, blue = 1;  ///< gains on top of the white balance
  double contrast = 0;
};
DrawnLook DrawLook(const CameraLook& look, uint64_t seed, uint64_t frame);

/// Variance of the noise of one channel at a signal in units of white: see CameraLook::full_well.
double NoiseVariance(const CameraLook& look, double gain, double signal);

}  // namespace airsim360
