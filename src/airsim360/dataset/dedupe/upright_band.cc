#include "airsim360/dataset/dedupe/upright_band.h"

#include <algorithm>
#include <cmath>

#include "airsim360/image/draw.h"
#include "airsim360/projection/resample.h"

namespace airsim360::internal {
namespace {

constexpr int kWidth = 960, kHeight = 480;  // of the panorama that is turned: three columns for each of a network's 320

}  // namespace

Image<Rgb8> UprightBand(const Image<Rgb8>& panorama, const Mat3d& R_WC, int width, int height) {
  const Image<Rgb8> small = panorama.width() > kWidth ? ResizeBox(panorama, kWidth, kHeight) : panorama;
  Image<Rgb32f> values(small.width(), small.height());
  std::ranges::transform(small.pixels(), values.pixels().begin(), [](Rgb8 c) { return Rgb32f{float(c.r), float(c.g), float(c.b)}; });

  const Equirectangular source{small.width(), small.height()}, target{kWidth, kHeight};
  const Mat3d R_WT = CameraInBody().R;
  const Image<Rgb32f> upright = ResampleBilinear(values, source, ResamplingMap(target, source, R_WC.transpose() * R_WT));

  constexpr int kPole = kHeight / 6;  // rows beyond 60 degrees
  Image<Rgb8> band(kWidth, kHeight - 2 * kPole);
  const auto byte = [](float v) { return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0f, 255.0f))); };
  for (int y = 0; y < band.height(); ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Rgb32f c = upright(x, y + kPole);
      band(x, y) = {byte(c.r), byte(c.g), byte(c.b)};
    }
  }
  return ResizeBox(band, width, height);
}

}  // namespace airsim360::internal
