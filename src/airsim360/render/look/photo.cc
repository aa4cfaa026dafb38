#include "airsim360/render/look/photo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/look/metering.h"
#include "airsim360/render/look/photo_geometry.h"
#include "airsim360/render/sky/atmosphere.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr int kBandRows = 64;
constexpr float kMostWhite = 400, kDiscWhite = 30;  // of light that is scattered, and of the sun's disc; of daylight's white
constexpr double kBrightestWhite = 1e7;             // cd/m2
// From the first to the second luminance of white, cd/m2, the meter's aim falls by a share.
constexpr double kDayWhite = 500, kDimWhite = 5, kDimmer = 0.35;
// Of the solid angle, what may burn out where white is at the second: a dark sky does not make a city's windows white.
constexpr double kMostBurnt = 0.04;

// Everything that the rows of a picture need.
struct Plan {
  PhotoGeometry geometry;
  LightCells scattered{};  // empty planes: none
  float kept = 1, share = 0;
  float exposure = 1, side = 0, sharpening = 0;
  float slope = 0, floor = 0;  // of the variance of noise over light, as it shall be after the blur
  ToneRowTask tone{};
  std::vector<float> curve{};
  uint64_t noise_key = 0;
};

// Rows of floats with pads and 64-byte alignment.
class Rows {
 public:
  Rows(int count, int width)
      : stride_((static_cast<size_t>(width) + 15) / 16 * 16 + 2 * kRowPad), memory_(static_cast<size_t>(count) * stride_ + 16) {
    while (reinterpret_cast<uintptr_t>(memory_.data() + offset_) % 64 != 0) ++offset_;
  }
  float* operator[](int i) { return memory_.data() + offset_ + static_cast<size_t>(i) * stride_ + kRowPad; }
  ColorRow Color(int first) { return {(*this)[first], (*this)[first + 1], (*this)[first + 2]}; }

 private:
  size_t stride_, offset_ = 0;
  std::vector<float> memory_;
};

// What lies beyond the ends of a row: the other end of a panorama, else the last pixel again.
void PadRow(bool wraps, int width, float* row) {
  for (int i = 1; i <= kRowPad; ++i) {
    row[-i] = wraps ? row[(width - i % width) % width] : row[0];
    row[width - 1 + i] = wraps ? row[(i - 1) % width] : row[width - 1];
  }
}
void PadRow(bool wraps, int width, ColorRow row) {
  for (float* plane : {row.r, row.g, row.b}) PadRow(wraps, width, plane);
}
ConstColorRow Const(ColorRow row) { return {row.r, row.g, row.b}; }

// Share of the variance of noise that the blur leaves, where `grain` columns of noise lie in one of the picture:
// neighbours are the same by the chance 1 - grain, those two columns apart by 1 - 2 grain.
double NoiseLeft(double side, double grain) {
  const double own = 1 - 2 * side, down = own * own + 2 * side * side;
  const double across = down + 4 * own * side * (1 - grain) + 2 * side * side * std::max(0.0, 1 - 2 * grain);
  return down * across;
}

// The rows `first` to `last` - 1: exposed rows go through a ring of three, encoded ones through one of five.
class Band {
 public:
  Band(const Plan& plan, const Image<Rgb32f>& light)
      : plan_(plan),
        g_(plan.geometry),
        light_(light),
        exposed_(9, g_.width),
        encoded_(15, g_.width),
        luminance_(5, g_.width),
        scratch_(3, g_.width),
        cells_(1, g_.cells_across),
        canonical_(static_cast<size_t>(g_.width)) {}

  void Develop(int first, int last, Image<Rgb8>& rgb) {
    const auto sharpen = AIRSIM360_SELECT_KERNEL(SharpenRow);
    Expose(first - 3), Expose(first - 2);
    for (int y = first - 2; y < last + 2; ++y) {
      Expose(y + 1);
      Encode(y);
      const int done = y - 2;
      if (done < first) continue;
      const float* rows[5];
      for (int k = 0; k < 5; ++k) rows[k] = luminance_[Ring(done - 2 + k, 5)];
      sharpen(g_.width, plan_.sharpening, Const(encoded_.Color(3 * Ring(done, 5))), rows, scratch_[0], canonical_.data());
      std::copy(canonical_.begin() + g_.shift, canonical_.end(), &rgb(0, done));
      std::copy_n(canonical_.begin(), g_.shift, rgb.row(done).begin() + (g_.width - g_.shift));
    }
  }

 private:
  static int Ring(int y, int size) { return (y % size + size) % size; }

  void Expose(int y) {
    const PhotoRow from = FindPhotoRow(g_.sphere, y, g_.height);
    const ColorRow row = exposed_.Color(3 * Ring(y, 3));
    // The scattered light of the row, then its own: image column `begin` comes first.
    if (plan_.share > 0) {
      SpreadCells(g_, plan_.scattered, plan_.share, from.y, cells_[0], scratch_.Color(0));
    } else {
      for (int k = 0; k < 3; ++k) std::fill_n(scratch_[k], g_.width, 0.0f);
    }
    AIRSIM360_SELECT_KERNEL(LoadRow)(&light_(0, from.y), g_.width, g_.ImageColumn(0), plan_.kept, Const(scratch_.Color(0)), row);
    // Grains are as wide as high on the sphere, too.
    const double latitude = std::numbers::pi * (0.5 - (from.y + 0.5) / g_.height), grain = g_.sphere ? std::cos(latitude) : 1;
    const auto scale = static_cast<float>(1 / NoiseLeft(plan_.side, grain));
    const ExposeRowTask task{g_.width,
                             plan_.exposure,
                             plan_.slope * scale,
                             plan_.floor * scale,
                             static_cast<uint32_t>(MixBits(plan_.noise_key + static_cast<uint64_t>(from.y)) >> 32),
                             static_cast<float>(grain)};
    AIRSIM360_SELECT_KERNEL(ExposeRow)(task, row);
    if (from.turned) Turn(row);
    PadRow(g_.sphere, g_.width, row);
  }

  void Turn(ColorRow row) const {
    for (float* plane : {row.r, row.g, row.b}) std::rotate(plane, plane + g_.width / 2, plane + g_.width);
  }

  void Encode(int y) {
    const ConstColorRow rows[3] = {Const(exposed_.Color(3 * Ring(y - 1, 3))), Const(exposed_.Color(3 * Ring(y, 3))),
                                   Const(exposed_.Color(3 * Ring(y + 1, 3)))};
    const int at = Ring(y, 5);
    AIRSIM360_SELECT_KERNEL(ToneRow)(plan_.tone, rows, scratch_.Color(0), encoded_.Color(3 * at), luminance_[at]);
    PadRow(g_.sphere, g_.width, luminance_[at]);
  }

  const Plan& plan_;
  const PhotoGeometry& g_;
  const Image<Rgb32f>& light_;
  Rows exposed_, encoded_, luminance_, scratch_, cells_;
  std::vector<Rgb8> canonical_;
};

// Pixels without a ray, of fisheyes and of calibrated lenses, are black.
void BlackenOutside(const Camera& camera, Image<Rgb8>& rgb) {
  if (!std::holds_alternative<Fisheye>(camera) && !std::holds_alternative<CalibratedLens>(camera)) return;
  ParallelFor(rgb.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < rgb.width(); ++x)
      if (!PixelToRay(camera, {x + 0.5, y + 0.5})) rgb(x, y) = {};
  });
}

// Exposure, white balance and noise by what the picture shows. Adds to `figures`.
void Meter(const CameraLook& look, const PhotoRequest& request, const DrawnLook& drawn, const LightCells& cells, Plan& plan,
           PhotoFigures& figures) {
  const double clip = ClipOfShoulder(look.shoulder), fixed = request.exposure;
  std::array<double, 3> gains{1, 1, 1};
  double exposure = fixed;
  if (look.metering > 0 || look.white_balance > 0) {
    const LightHistogram histogram(cells, plan.kept, plan.scattered, plan.share);
    gains = WhiteBalance(look.white_balance, request.daylight, histogram);
    if (drawn.metering > 0) {
      // Dim scenes are meant to look dim.
      const double low = kLuxPerUnit / kBrightestWhite, high = std::max(low, kLuxPerUnit / look.dimmest_white);
      const double full = MeterExposure(histogram, plan.curve, clip, gains, drawn.metering, low, high);
      const double dim = std::clamp(1 - std::log10(kLuxPerUnit / full / kDimWhite) / std::log10(kDayWhite / kDimWhite), 0.0, 1.0);
      exposure = MeterExposure(histogram, plan.curve, clip, gains, drawn.metering * (1 - kDimmer * dim), low, high);
      if (dim > 0) exposure = std::min(exposure, clip / histogram.BrighterThan(1 - (1 - kMostBurnt) * dim));
    }
  }
  exposure *= std::exp2(request.exposure_ev);
  figures.exposure_ev = std::log2(exposure / fixed);
  figures.white_cd_m2 = kLuxPerUnit / exposure;
  figures.gain = std::max(1.0, look.base_white / figures.white_cd_m2);
  figures.red = gains[0] * drawn.red, figures.green = gains[1] * drawn.green, figures.blue = gains[2] * drawn.blue;
  plan.exposure = static_cast<float>(exposure);
}

void SetSensor(const CameraLook& look, const PhotoFigures& figures, Plan& plan) {
  plan.side = static_cast<float>(look.softness_px * look.softness_px / 2);
  if (!(look.full_well > 0)) return;
  plan.floor = static_cast<float>(NoiseVariance(look, figures.gain, 0));
  plan.slope = static_cast<float>(NoiseVariance(look, figures.gain, 1)) - plan.floor;
}

void SetTone(const CameraLook& look, const PhotoFigures& figures, Plan& plan) {
  plan.sharpening = static_cast<float>(look.sharpening);
  plan.tone = {plan.geometry.width,
               plan.side,
               {static_cast<float>(figures.red), static_cast<float>(figures.green), static_cast<float>(figures.blue)},
               static_cast<float>(1 / ClipOfShoulder(look.shoulder)),
               plan.curve.data(),
               static_cast<float>(look.saturation)};
}

}  // namespace

namespace internal {

double ClipOfShoulder(double shoulder) {
  if (shoulder < 1e-6) return 1;
  // (1 - exp(-shoulder u)) / (1 - exp(-shoulder)) is 0.18 at the u that 0.18 is scaled to.
  const double u = -std::log(1 - 0.18 * (1 - std::exp(-shoulder))) / shoulder;
  return 0.18 / u;
}

double EncodeTone(double shoulder, double contrast, double light) {
  const double u = std::clamp(light / ClipOfShoulder(shoulder), 0.0, 1.0);
  const double x = shoulder < 1e-6 ? u : (1 - std::exp(-shoulder * u)) / (1 - std::exp(-shoulder));
  const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return std::clamp(y + contrast * y * (1 - y) * (y - 0.52), 0.0, 1.0);
}

}  // namespace internal

PhotoFigures TakePhoto(const CameraLook& look, const PhotoRequest& request, Image<Rgb32f>& light, Image<Rgb8>& rgb) {
  CheckCameraLook(look);
  const DrawnLook drawn = DrawLook(look, request.seed, request.frame);
  Plan plan{.geometry = PhotoGeometry(request)};
  const PhotoGeometry& g = plan.geometry;
  PhotoFigures figures;
  figures.contrast = drawn.contrast;
  const double clip = ClipOfShoulder(look.shoulder);
  for (int i = 0; i <= kCurveSize; ++i) {
    const double root = static_cast<double>(i) / kCurveSize;
    plan.curve.push_back(static_cast<float>(EncodeTone(look.shoulder, drawn.contrast, clip * root * root)));
  }

  // The sun's light is known; its disc in the picture is a few pixels, each in it or not.
  const std::optional<Vec2d> sun = FindSun(g, request);
  if (sun) {
    figures.sun_seen = request.daylight.sun_seen;
    ClipSunDisc(g, request, *sun, kDiscWhite / request.exposure, light);
  }
  LightCells cells;
  if (look.glare > 0 || look.metering > 0 || look.white_balance > 0) cells = Reduce(g, light, kMostWhite / request.exposure);
  if (look.glare > 0) {
    LightCells source = cells;
    const Rgb32f& e = request.daylight.sun;
    const auto seen = static_cast<float>(figures.sun_seen);
    if (sun) AddSun(g, *sun, {e.r * seen, e.g * seen, e.b * seen}, source);
    const ScatterMixture mixture = MakeScatterMixture(look.glare_deg, g.column * g.width / g.cells_across);
    Scatter(mixture, source, plan.scattered);
    plan.share = static_cast<float>(look.glare);
    plan.kept = static_cast<float>(1 - look.glare + look.glare * mixture.kept);
  }
  Meter(look, request, drawn, cells, plan, figures);
  SetSensor(look, figures, plan);
  SetTone(look, figures, plan);
  plan.noise_key = RngStream(request.seed, "look noise", request.frame).Bits();

  if (rgb.width() != g.width || rgb.height() != g.height) rgb = Image<Rgb8>(g.width, g.height);
  ParallelFor((g.height + kBandRows - 1) / kBandRows, [&](int64_t task) {
    const int first = static_cast<int>(task) * kBandRows;
    Band(plan, light).Develop(first, std::min(first + kBandRows, g.height), rgb);
  });
  BlackenOutside(request.camera, rgb);
  return figures;
}

}  // namespace airsim360
