#include "airsim360/eval/sphere/pixel_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/eval/sphere/panorama_ray.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

void CheckPanorama(int width, int height, const char* what) {
  if (width != 2 * height || height < 1)
    throw InputError(std::string(what) + " needs panoramas, twice as wide as high; the pictures are " + std::to_string(width) + "x" +
                     std::to_string(height));
}

PixelView Rows(int width, int height, int first, int last, PixelWeight weight) {
  PixelView view;
  const std::vector<double> weights = RowWeights(height, width, weight);
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < width; ++x) {
      view.source.push_back(static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x));
      if (weight != PixelWeight::kPixel) view.weights.push_back(weights[static_cast<size_t>(y)]);
    }
  }
  return view;
}

/// The panorama's pixel that a direction (+X right, +Y down, +Z forward) falls into.
uint32_t PixelOf(Vec3d d, int width, int height) {
  const Vec2d place = PanoramaPlace(d, width, height);
  const int x = std::clamp(static_cast<int>(place.x), 0, width - 1), y = std::clamp(static_cast<int>(place.y), 0, height - 1);
  return static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x);
}

/// Centres of the faces of an icosahedron: the corners of a dodecahedron.
std::vector<Vec3d> FaceCentres() {
  const double g = std::numbers::phi, h = 1 / g;
  std::vector<Vec3d> centres;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) centres.push_back(Normalized(Vec3d{a, b, c}));
      centres.push_back(Normalized(Vec3d{0, a * h, b * g}));
      centres.push_back(Normalized(Vec3d{a * h, b * g, 0}));
      centres.push_back(Normalized(Vec3d{a * g, 0, b * h}));
    }
  }
  return centres;
}

}  // namespace

PixelWeight ParsePixelWeight(const std::string& text) {
  const std::array<std::string, 2> choices = {"pixel", "solid_angle"};
  if (text == choices[0]) return PixelWeight::kPixel;
  if (text == choices[1]) return PixelWeight::kSolidAngle;
  throw InputError("--weights: " + UnknownChoiceMessage("weight", text, choices));
}

std::vector<double> RowWeights(int height, int width, PixelWeight weight) {
  std::vector<double> weights(static_cast<size_t>(height), 1);
  if (weight == PixelWeight::kPixel) return weights;
  for (int y = 0; y < height; ++y) {
    const double top = kPi * (0.5 - static_cast<double>(y) / height), bottom = kPi * (0.5 - (y + 1.0) / height);
    weights[static_cast<size_t>(y)] =
        weight == PixelWeight::kSolidAngle ? 2 * kPi / width * (std::sin(top) - std::sin(bottom)) : std::cos((top + bottom) / 2);
  }
  return weights;
}

PixelView WholeView(int width, int height, PixelWeight weight) {
  if (weight == PixelWeight::kPixel) return {};
  CheckPanorama(width, height, "--weights");
  PixelView view = Rows(width, height, 0, height, weight);
  view.source.clear();
  return view;
}

PixelView BandView(int width, int height, int band, int bands, PixelWeight weight) {
  CheckPanorama(width, height, "--latitude-bands");
  if (bands > height)
    throw InputError("--latitude-bands " + std::to_string(bands) + ": the pictures have " + std::to_string(height) + " rows");
  // Row y is in the band of its centre: floor((y + 0.5) / height * bands).
  const auto first = [&](int b) { return static_cast<int>(std::ceil(static_cast<double>(b) * height / bands - 0.5)); };
  return Rows(width, height, first(band), first(band + 1), weight);
}

PixelView SeamView(int width, int height, int columns, bool near, PixelWeight weight) {
  CheckPanorama(width, height, "--seam");
  if (columns < 1 || 2 * columns >= width)
    throw InputError("--seam " + std::to_string(columns) + ": must be at least 1 and less than half the width, " +
                     std::to_string(width / 2));
  const std::vector<double> weights = RowWeights(height, width, weight);
  PixelView view;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if ((x < columns || x >= width - columns) != near) continue;
      view.source.push_back(static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x));
      if (weight != PixelWeight::kPixel) view.weights.push_back(weights[static_cast<size_t>(y)]);
    }
  }
  return view;
}

PixelView CubeView(int width, int height) {
  CheckPanorama(width, height, "--projection cube");
  const int size = std::max(1, width / 4);
  PixelView view;
  for (int face = 0; face < 6; ++face) {
    for (int v = 0; v < size; ++v) {
      for (int u = 0; u < size; ++u) {
        const double a = 2 * (u + 0.5) / size - 1, b = 2 * (v + 0.5) / size - 1, s = face % 2 == 0 ? 1 : -1;
        const Vec3d d = face < 2 ? Vec3d{s, b, -s * a} : face < 4 ? Vec3d{a, s, -s * b} : Vec3d{s * a, b, s};
        view.source.push_back(PixelOf(d, width, height));
      }
    }
  }
  return view;
}

PixelView TangentView(int width, int height) {
  CheckPanorama(width, height, "--projection tangent");
  const std::vector<Vec3d> centres = FaceCentres();
  // A face reaches from its centre to a corner of the icosahedron.
  const double reach = std::tan(std::acos(std::sqrt((5 + 2 * std::sqrt(5.0)) / 15))), step = 2 * kPi / width;
  const int half = static_cast<int>(std::ceil(reach / step));
  PixelView view;
  for (const Vec3d& centre : centres) {
    const Vec3d right = Normalized(Cross(Vec3d{0, 1, 0}, centre)), down = Cross(centre, right);
    for (int v = -half; v < half; ++v) {
      for (int u = -half; u < half; ++u) {
        const Vec3d d = centre + right * ((u + 0.5) * step) + down * ((v + 0.5) * step);
        const double mine = Dot(d, centre);
        const bool nearest = std::none_of(centres.begin(), centres.end(), [&](const Vec3d& other) { return Dot(d, other) > mine; });
        if (nearest) view.source.push_back(PixelOf(d, width, height));
      }
    }
  }
  return view;
}

PixelView TurnedView(int width, int height, double yaw, double pitch, double roll) {
  CheckPanorama(width, height, "turning");
  const Mat3d turned_from_first = TurnedCamera(yaw, pitch, roll).transpose();
  PixelView view;
  view.source.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      view.source.push_back(PixelOf(turned_from_first * PanoramaRay(x + 0.5, y + 0.5, width, height), width, height));
  }
  return view;
}

PixelView ResizedView(int width, int height, int new_width, int new_height) {
  PixelView view;
  for (int y = 0; y < new_height; ++y) {
    const auto row = static_cast<uint32_t>((y + 0.5) * height / new_height) * static_cast<uint32_t>(width);
    for (int x = 0; x < new_width; ++x) view.source.push_back(row + static_cast<uint32_t>((x + 0.5) * width / new_width));
  }
  return view;
}

}  // namespace airsim360
