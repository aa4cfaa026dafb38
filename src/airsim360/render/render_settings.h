// How pictures are made: one description, from which the flags of the commands, the keys of YAML files, the keywords of
// Python and the parameters in meta.json follow (see base/config.h). An option is a field here and a line of Visit.
#pragma once

#include <cstdint>
#include <string_view>

#include "airsim360/base/config.h"

namespace airsim360 {

enum class Tier { kLabels, kFast, kHigh, kReference };
inline constexpr const char* kTierNames[] = {"labels", "fast", "high", "reference"};
/// Tier of a name; InputError naming the nearest if there is none.
Tier ParseTier(std::string_view name);

/// From scene radiance to display values.
enum class ToneCurve { kFilmic, kAgx, kLinear };
inline constexpr const char* kToneCurveNames[] = {"filmic", "agx", "linear"};

inline constexpr int kMaxEdgeSamples = 64;
inline constexpr double kMaxStops = 20;  ///< of exposure, either way

struct RenderSettings {
  Tier tier = Tier::kFast;
  /// high: ambient rays of a pixel at the equator; reference: paths of a pixel; 0 = the tier's own number.
  int samples = 0;
  bool denoise = true;  ///< tier high
  /// Colour samples of a pixel on an edge, the centre ray included, up to kMaxEdgeSamples; 1 = none; 0 = EdgeSamples'
  /// choice.
  int edge_samples = 0;
  ToneCurve tone = ToneCurve::kFilmic;
  /// Stops added to the scene's fixed daylight exposure; one exposure for the whole sphere.
  double exposure_ev = 0;
  bool auto_exposure = false;  ///< from the picture's own solid-angle-weighted histogram
  uint64_t seed = 0;           ///< of all random choices; given by every front in its own way, so not visited

  void Visit(ConfigVisitor& v);
};

/// InputError naming a value that does not fit the others, after `prefix` ("--" of flags): more samples than the tier
/// takes, a picture of light in a tier that has none.
void CheckRenderSettings(const RenderSettings& settings, std::string_view prefix = {});

}  // namespace airsim360
