#include "airsim360/render/render_settings.h"

#include <string>

#include "airsim360/base/choice.h"

namespace airsim360 {
namespace {

constexpr int kMaxHighSamples = 256, kMaxPaths = 1 << 20;

}  // namespace

Tier ParseTier(std::string_view name) { return ParseChoice<Tier>("tier", name, kTierNames); }

void RenderSettings::Visit(ConfigVisitor& v) {
  v.Field("tier", "labels, fast, high or reference", tier, kTierNames);
  v.Count("samples", "high: ambient rays of a pixel at the equator, more where light is noisy (4); reference: paths of a pixel (64)",
          samples, kMaxPaths);
  v.Field("denoise", "noise filter of tier high", denoise);
  v.Count("edge_samples",
          "fast, high: colour samples of a pixel on an edge; 1: the middle of every pixel alone, the fastest "
          "(fast: 2, "
          "high: 8)",
          edge_samples, kMaxEdgeSamples);
  v.Field("tone", "tone curve: filmic, agx or linear", tone, kToneCurveNames);
  v.NumberOr("exposure", "stops added to the fixed daylight exposure, or auto: of every picture its own", "auto", auto_exposure,
             exposure_ev, -kMaxStops, kMaxStops);
}

void CheckRenderSettings(const RenderSettings& settings, std::string_view prefix) {
  const int most = settings.tier == Tier::kReference ? kMaxPaths : kMaxHighSamples;
  if (settings.samples > most) {
    throw InputError(std::string(prefix) + "samples: " + std::to_string(settings.samples) + " is not in 1 … " + std::to_string(most) +
                     " of tier " + kTierNames[static_cast<int>(settings.tier)] + "; did you mean " + std::to_string(most) + "?");
  }
}

}  // namespace airsim360
