#include "airsim360/render/look/camera_look.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/choice.h"
#include "airsim360/base/random.h"

namespace airsim360 {

Look ParseLook(std::string_view name) { return ParseChoice<Look>("look", name, kLookNames); }

CameraLook CameraLook::Neutral() {
  CameraLook look;
  look.metering = look.metering_spread = 0;
  look.glare = look.softness_px = 0;
  look.full_well = 0;
  look.white_balance = look.white_error = 0;
  look.saturation = 1;
  look.shoulder = look.contrast = look.contrast_spread = look.sharpening = 0;
  return look;
}

void CameraLook::Visit(ConfigVisitor& v) {
  v.Field("metering", "mean of the encoded picture that exposure aims at; 0 = fixed daylight exposure", metering, 0, 0.9);
  v.Field("metering_spread", "standard deviation of that aim, drawn", metering_spread, 0, 0.2);
  v.Field("dimmest_white", "cd/m2 that exposure makes white at the most", dimmest_white, 1e-4, 1e5);
  v.Field("glare", "share of the light that the lens scatters", glare, 0, 0.5);
  v.Field("glare_deg", "about half of the scattered light stays within so many degrees", glare_deg, 0.1, 30);
  v.Field("softness_px", "standard deviation of the blur, pixels", softness_px, 0, 0.8);
  v.Field("full_well", "electrons at white without gain; 0 = no noise", full_well, 0, 1e9);
  v.Field("read_noise", "electrons, standard deviation", read_noise, 0, 1e4);
  v.Field("base_white", "cd/m2 at white with the longest time and no gain", base_white, 1e-3, 1e6);
  v.Field("white_balance", "share of the light's colour that is taken out", white_balance, 0, 1);
  v.Field("white_error", "standard deviation of the gains of red and blue, drawn", white_error, 0, 0.3);
  v.Field("saturation", "1 = as it is", saturation, 0, 2);
  v.Field("shoulder", "compression of highlights; 0 = clipped at white", shoulder, 0, 6);
  v.Field("contrast", "of an S about the middle of the encoded values", contrast, 0, 1.5);
  v.Field("contrast_spread", "its standard deviation, drawn", contrast_spread, 0, 0.5);
  v.Field("sharpening", "of luminance, at edges", sharpening, 0, 2);
  v.Field("each_frame", "draw again for every frame", each_frame);
}

void CheckCameraLook(const CameraLook& look, std::string_view prefix) {
  const auto refuse = [&](const char* field, double value, const char* range) {
    throw InputError(std::string(prefix) + field + " " + std::to_string(value) + " is not " + range);
  };
  const auto within = [&](const char* field, double value, double low, double high, const char* range) {
    if (!(value >= low && value <= high)) refuse(field, value, range);
  };
  within("metering", look.metering, 0, 0.9, "in 0 … 0.9");
  within("glare", look.glare, 0, 0.5, "in 0 … 0.5");
  within("glare_deg", look.glare_deg, 0.1, 30, "in 0.1 … 30");
  within("softness_px", look.softness_px, 0, 0.8, "in 0 … 0.8");
  within("full_well", look.full_well, 0, 1e9, "in 0 … 1e9");
  within("white_balance", look.white_balance, 0, 1, "in 0 … 1");
  within("shoulder", look.shoulder, 0, 6, "in 0 … 6");
  within("contrast", look.contrast, 0, 1.5, "in 0 … 1.5");
  within("dimmest_white", look.dimmest_white, 1e-4, 1e5, "in 1e-4 … 1e5");
  within("base_white", look.base_white, 1e-3, 1e6, "in 1e-3 … 1e6");
}

DrawnLook DrawLook(const CameraLook& look, uint64_t seed, uint64_t frame) {
  RngStream random(seed, "look", look.each_frame ? frame : 0);
  // Two standard deviations at the most: no picture is a failure.
  const auto draw = [&](double spread) { return spread * std::clamp(random.Normal(), -2.0, 2.0); };
  DrawnLook drawn;
  const double aim = draw(look.metering_spread), tint = draw(look.white_error), green = draw(look.white_error / 3),
               contrast = draw(look.contrast_spread);
  drawn.metering = look.metering > 0 ? std::clamp(look.metering + aim, 0.05, 0.9) : 0;
  drawn.red = 1 + tint, drawn.green = 1 + green, drawn.blue = 1 - tint;
  drawn.contrast = look.contrast > 0 ? std::max(0.0, look.contrast + contrast) : 0;
  return drawn;
}

double NoiseVariance(const CameraLook& look, double gain, double signal) {
  if (!(look.full_well > 0)) return 0;
  const double read = look.read_noise * gain / look.full_well;
  return std::max(signal, 0.0) * gain / look.full_well + read * read;
}

}  // namespace airsim360
