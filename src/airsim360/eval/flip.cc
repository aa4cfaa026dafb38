// LDR-FLIP. Section and symbol names in comments are those of Andersson et al. 2020.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "airsim360/eval/check_images.h"
#include "airsim360/eval/image_metrics.h"
#include "airsim360/image/color.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

// Section 4.1.3: exponent of the colour difference, and where it is bent.
constexpr double kQc = 0.7, kPc = 0.4, kPt = 0.95;
// Section 4.2: width of edges in degrees, exponent of the feature difference.
constexpr double kFeatureWidth_deg = 0.082, kQf = 0.5;

/// One Gaussian of a contrast sensitivity function, in the frequency domain a exp(-b f^2) (Table 1).
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

// ---- colour spaces, relative to the white (1, 1, 1) of linear sRGB

/// Linear sRGB to XYZ (IEC 61966-2-1 primaries, D65).
Vec3d ToXyz(Vec3d c) {
  return {0.4123865632529917 * c.x + 0.35759149092062537 * c.y + 0.18045049120356368 * c.z,
          0.21263682167732384 * c.x + 0.7151829818412507 * c.y + 0.07218019648142547 * c.z,
          0.019330620152483987 * c.x + 0.11919716364020845 * c.y + 0.9503725870054354 * c.z};
}
Vec3d FromXyz(Vec3d c) {
  return {3.241003232976358 * c.x - 1.5373989694887855 * c.y - 0.4986158819963629 * c.z,
          -0.9692242522025164 * c.x + 1.875929983695176 * c.y + 0.041554226340084724 * c.z,
          0.055639419851975444 * c.x - 0.20401120612390997 * c.y + 1.0571489771875335 * c.z};
}

const Vec3d kWhite = ToXyz({1, 1, 1});

/// Linearised L*a*b*.
Vec3d ToOpponent(Vec3d rgb) {
  const Vec3d c = ToXyz(rgb);
  const double x = c.x / kWhite.x, y = c.y / kWhite.y, z = c.z / kWhite.z;
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Vec3d FromOpponent(Vec3d c) {
  const double y = (c.x + 16) / 116;
  return FromXyz({(y + c.y / 500) * kWhite.x, y * kWhite.y, (y - c.z / 200) * kWhite.z});
}

/// L*a*b* with chroma scaled by lightness (Hunt effect).
Vec3d ToHuntLab(Vec3d rgb) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const Vec3d c = ToXyz(rgb);
  const double x = f(c.x / kWhite.x), y = f(c.y / kWhite.y), z = f(c.z / kWhite.z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double HyAb(Vec3d a, Vec3d b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// ---- filters

using Plane = Image<double>;
using Kernel = std::vector<double>;  // 2 r + 1 values

template <class Function>
Kernel MakeKernel(int radius, const Function& value) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(value(static_cast<double>(i)));
  return kernel;
}

double Sum(const Kernel& kernel) {
  double sum = 0;
  for (const double w : kernel) sum += w;
  return sum;
}

/// Separable filter; rows are held at their borders, columns too or wrapped.
Plane Convolve(const Plane& image, const Kernel& across, const Kernel& down, bool wrap) {
  const int w = image.width(), h = image.height(), r = static_cast<int>(across.size()) / 2;
  Plane rows(w, h), result(w, h);
  std::vector<double> line(static_cast<size_t>(w + 2 * r));
  for (int y = 0; y < h; ++y) {
    for (int x = -r; x < w + r; ++x) {
      const int from = wrap ? (x % w + w) % w : std::clamp(x, 0, w - 1);
      line[static_cast<size_t>(x + r)] = image(from, y);
    }
    for (int x = 0; x < w; ++x) {
      double sum = 0;
      for (int i = 0; i <= 2 * r; ++i) sum += across[static_cast<size_t>(i)] * line[static_cast<size_t>(x + i)];
      rows(x, y) = sum;
    }
  }
  for (int y = 0; y < h; ++y) {
    for (int i = -r; i <= r; ++i) {
      const auto from = rows.row(std::clamp(y + i, 0, h - 1));
      const double weight = down[static_cast<size_t>(i + r)];
      for (int x = 0; x < w; ++x) result(x, y) += weight * from[static_cast<size_t>(x)];
    }
  }
  return result;
}

/// Contrast sensitivity in the image domain: a sum of Gaussians, normalised to 1.
Plane FilterSensitivity(const Plane& image, std::span<const Sensitivity> parts, const FlipOptions& options) {
  const double ppd = options.pixels_per_degree;
  // All channels use the radius of the widest Gaussian.
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * ppd));
  Plane result(image.width(), image.height());
  double total = 0;
  for (const auto& [a, b] : parts) {
    const Kernel kernel = MakeKernel(radius, [&, b = b](double d) { return std::exp(-kPi * kPi * d * d / (ppd * ppd * b)); });
    const double weight = a * std::sqrt(kPi / b);
    const Plane part = Convolve(image, kernel, kernel, options.wrap_columns);
    for (size_t i = 0; i < result.size(); ++i) result.pixels()[i] += weight * part.pixels()[i];
    total += weight * Sum(kernel) * Sum(kernel);
  }
  for (double& v : result.pixels()) v /= total;
  return result;
}

/// A derivative of a Gaussian whose positive and negative parts each sum to 1 with the Gaussian across it.
Kernel Normalised(Kernel kernel, double across) {
  double positive = 0, negative = 0;
  for (const double w : kernel) (w > 0 ? positive : negative) += w;
  for (double& w : kernel) w /= across * (w > 0 ? positive : -negative);
  return kernel;
}

/// Magnitudes of edges and points (Section 4.2).
struct Features {
  Plane edges, points;
};
Features FindFeatures(const Plane& luminance, const FlipOptions& options) {
  const double sigma = 0.5 * kFeatureWidth_deg * options.pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  const Kernel smooth = MakeKernel(radius, gaussian);
  const auto magnitude = [&](const Kernel& derivative) {
    const Kernel kernel = Normalised(derivative, Sum(smooth));
    Plane result = Convolve(luminance, kernel, smooth, options.wrap_columns);
    const Plane down = Convolve(luminance, smooth, kernel, options.wrap_columns);
    for (size_t i = 0; i < result.size(); ++i) result.pixels()[i] = std::hypot(result.pixels()[i], down.pixels()[i]);
    return result;
  };
  return {magnitude(MakeKernel(radius, [&](double x) { return -x * gaussian(x); })),
          magnitude(MakeKernel(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }))};
}

/// A picture as FLIP compares it.
struct Perceived {
  Image<Vec3d> color;  // filtered, L*a*b* with Hunt's chroma
  Features features;
};

Perceived Perceive(const Image<Rgb8>& image, const FlipOptions& options) {
  std::array<Plane, 3> opponent;
  for (Plane& plane : opponent) plane = Plane(image.width(), image.height());
  Plane luminance(image.width(), image.height());
  for (size_t i = 0; i < image.size(); ++i) {
    const Rgb8 c = image.pixels()[i];
    const Vec3d o = ToOpponent({SrgbToLinear(c.r), SrgbToLinear(c.g), SrgbToLinear(c.b)});
    for (int k = 0; k < 3; ++k) opponent[static_cast<size_t>(k)].pixels()[i] = o[k];
    luminance.pixels()[i] = (o.x + 16) / 116;
  }
  opponent[0] = FilterSensitivity(opponent[0], {&kAchromatic, 1}, options);
  opponent[1] = FilterSensitivity(opponent[1], {&kRedGreen, 1}, options);
  opponent[2] = FilterSensitivity(opponent[2], kBlueYellow, options);
  Image<Vec3d> color(image.width(), image.height());
  for (size_t i = 0; i < color.size(); ++i) {
    const Vec3d rgb = FromOpponent({opponent[0].pixels()[i], opponent[1].pixels()[i], opponent[2].pixels()[i]});
    const auto clamp = [](double v) { return std::clamp(v, 0.0, 1.0); };
    color.pixels()[i] = ToHuntLab({clamp(rgb.x), clamp(rgb.y), clamp(rgb.z)});
  }
  return {std::move(color), FindFeatures(luminance, options)};
}

/// Maps a HyAB distance to [0, 1], large ones compressed.
double ColorDifference(double distance) {
  static const double largest = std::pow(HyAb(ToHuntLab({0, 1, 0}), ToHuntLab({0, 0, 1})), kQc);
  const double e = std::pow(distance, kQc), bend = kPc * largest;
  return e < bend ? kPt / bend * e : kPt + (e - bend) / (largest - bend) * (1 - kPt);
}

}  // namespace

Image<float> Flip(const Image<Rgb8>& reference, const Image<Rgb8>& test, const FlipOptions& options) {
  internal::CheckComparable(reference, test);
  if (!(options.pixels_per_degree > 0) || options.pixels_per_degree > 1000) {
    throw InputError("FLIP: " + std::to_string(options.pixels_per_degree) + " pixels per degree (more than 0, at most 1000)");
  }
  const Perceived a = Perceive(reference, options), b = Perceive(test, options);
  Image<float> result(reference.width(), reference.height());
  for (size_t i = 0; i < result.size(); ++i) {
    const double color = ColorDifference(HyAb(a.color.pixels()[i], b.color.pixels()[i]));
    const double edges = std::abs(a.features.edges.pixels()[i] - b.features.edges.pixels()[i]);
    const double points = std::abs(a.features.points.pixels()[i] - b.features.points.pixels()[i]);
    const double feature = std::pow(std::max(edges, points) / std::numbers::sqrt2, kQf);
    result.pixels()[i] = static_cast<float>(std::pow(color, 1 - feature));
  }
  return result;
}

double MeanFlip(const Image<Rgb8>& reference, const Image<Rgb8>& test, const FlipOptions& options) {
  const Image<float> map = Flip(reference, test, options);
  double sum = 0;
  for (const float v : map.pixels()) sum += v;
  return sum / static_cast<double>(map.size());
}

}  // namespace airsim360
