#include "airsim360/app/picture_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "airsim360/app/arguments.h"
#include "airsim360/base/choice.h"
#include "airsim360/render/filter/tone_map.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

constexpr double kMostStops = 20;

// "normal,position,…".
std::string OptionalProductNames() {
  std::string names;
  for (const OptionalProduct& product : kOptionalProducts) names += (names.empty() ? "" : ",") + std::string(product.name);
  return names;
}

// A number of stops.
double ParseStops(const std::string& text) {
  double stops = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), stops);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(stops) <= kMostStops)) {
    throw InputError("--exposure: '" + text + "' is neither 'auto' nor a number of stops from -20 to 20");
  }
  return stops;
}

}  // namespace

void PictureArguments::AddTo(CLI::App& command) {
  camera.AddTo(command);
  command.add_option("--tier", tier, "labels, fast, high or reference (default fast)");
  command.add_option("--samples", samples,
                     "high: ambient rays of a pixel at the equator (4); reference: paths of a pixel (64)");
  command.add_flag("--no-denoise", no_denoise, "tier high: leave the noise in");
  command.add_option("--products", products, "beside rgb,range,semantic,entity: " + OptionalProductNames());
  command.add_flag("--normal", normal, "the same as --products normal");
  command.add_option("--rgb-format", rgb_format, "png or jpg (default png)");
  command.add_option("--pano-frame", pano_frame, "body or level: turn with the body or only with its heading");
  command.add_option("--tone", tone, "tone curve: filmic, agx or linear (default filmic)");
  command.add_option(
      "--exposure", exposure,
      "stops added to the fixed daylight exposure, or auto: of every picture its own (default 0)");
  command.add_option("--lens", lens,
                     "ideal, or real360: colour as of two stitched fisheyes with parallax, noise, rolling "
                     "shutter and JPEG; labels stay ideal (default ideal)");
  command.add_option("--edge-samples", edge_samples,
                     "fast, high: colour samples of a pixel on an edge, 1 … 64; 1: the middle of every pixel "
                     "alone, the fastest (fast: 2, high: 8)");
  command.add_flag("--radiance", radiance, "write linear light too: radiance/STEM.exr, half float");
}

void PictureArguments::Apply(DatasetSpec& spec) const {
  camera.Apply(spec);
  spec.tier = ParseTierArgument(tier);
  spec.samples = CheckSamples(spec.tier, samples);
  spec.denoise = !no_denoise;
  spec.normal = normal;
  if (!products.empty()) ParseProducts(products, spec);
  spec.rgb_format = ParseChoice<RgbFormat>("value", rgb_format, kRgbFormatNames, "--rgb-format");
  spec.pano_frame = ParseChoice<PanoFrame>("value", pano_frame, kPanoFrameNames, "--pano-frame");
  const auto named = [](const char* flag, const auto& parse) {
    try {
      return parse();
    } catch (const InputError& error) {
      throw InputError(std::string(flag) + ": " + error.what());
    }
  };
  spec.tone = named("--tone", [&] { return ParseToneCurve(tone); });
  spec.lens = named("--lens", [&] { return ParseLensModel(lens); });
  spec.auto_exposure = exposure == "auto";
  spec.exposure_ev = spec.auto_exposure ? 0 : ParseStops(exposure);
  spec.radiance = radiance;
  spec.edge_samples = CheckEdgeSamples("--edge-samples", edge_samples);
  if (spec.lens == LensModel::kReal360 && !IsPanoramic(spec))
    throw InputError("--lens: 'real360' makes equirectangular pictures; use --projection erp");
  const auto is_cube = [](const View& view) { return view.projection == Projection::kCube; };
  if (spec.auto_exposure && std::ranges::any_of(Views(spec), is_cube))
    throw InputError("--exposure: 'auto' would differ between the faces of a cube; use --projection erp");
  if (spec.radiance && spec.tier == Tier::kLabels)
    throw InputError("--radiance: tier 'labels' has no light; use --tier fast");
}

}  // namespace airsim360
