// Pinhole pictures of single persons.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/dataset/people/person_record.h"
#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

constexpr double kMargin = 1.25;
constexpr int kSamples = 2;  // along each side of a pixel

struct Light {
  float r = 0, g = 0, b = 0;
};

const std::array<float, 256>& LinearTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) {
      const float s = static_cast<float>(i) / 255;
      values[static_cast<size_t>(i)] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    }
    return values;
  }();
  return table;
}

uint8_t Code(float linear) {
  const float s = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(std::clamp(s, 0.0f, 1.0f) * 255));
}

// Bilinear; columns of panoramas go on across the seam.
Light Sample(const Image<Rgb8>& rgb, bool panorama, Vec2d at) {
  const int w = rgb.width(), h = rgb.height();
  const double fx = at.x - 0.5, fy = at.y - 0.5;
  const int x0 = static_cast<int>(std::floor(fx)), y0 = static_cast<int>(std::floor(fy));
  const auto tx = static_cast<float>(fx - x0), ty = static_cast<float>(fy - y0);
  Light sum;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const int x = panorama ? (x0 + dx + w) % w : std::clamp(x0 + dx, 0, w - 1), y = std::clamp(y0 + dy, 0, h - 1);
      const float weight = (dx == 0 ? 1 - tx : tx) * (dy == 0 ? 1 - ty : ty);
      const Rgb8 pixel = rgb(x, y);
      sum.r += weight * LinearTable()[pixel.r];
      sum.g += weight * LinearTable()[pixel.g];
      sum.b += weight * LinearTable()[pixel.b];
    }
  }
  return sum;
}

}  // namespace

PersonCrop CropOf(const PersonLabel& label) {
  constexpr double kNarrowest = 2 * std::numbers::pi / 180, kWidest = 140 * std::numbers::pi / 180;
  const FieldOfView& view = label.amodal.bfov;
  const double fov = std::clamp(kMargin * std::max(view.width, view.height), kNarrowest, kWidest);
  const double f = 0.5 * kCropSize / std::tan(fov / 2), c = 0.5 * kCropSize;
  const ViewAxes axes = AxesOf({.lon = view.lon, .lat = view.lat});
  return {{.width = kCropSize, .height = kCropSize, .fx = f, .fy = f, .cx = c, .cy = c},
          Mat3d::FromColumns(axes.right, axes.down, axes.forward)};
}

Image<Rgb8> RenderCrop(const Image<Rgb8>& rgb, const Camera& camera, const PersonCrop& crop) {
  const bool panorama = std::holds_alternative<Equirectangular>(camera);
  Image<Rgb8> picture(crop.camera.width, crop.camera.height);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      Light sum;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const Vec3d ray{(x + (k % kSamples + 0.5) / kSamples - crop.camera.cx) / crop.camera.fx,
                        (y + (k / kSamples + 0.5) / kSamples - crop.camera.cy) / crop.camera.fy, 1};
        const auto at = RayToPixel(camera, crop.R_CK * ray);
        if (!at) continue;
        const Light light = Sample(rgb, panorama, *at);
        sum.r += light.r, sum.g += light.g, sum.b += light.b;
      }
      constexpr float kMean = 1.0f / (kSamples * kSamples);
      picture(x, y) = {Code(sum.r * kMean), Code(sum.g * kMean), Code(sum.b * kMean)};
    }
  }
  return picture;
}

std::string CropStem(int64_t frame, const std::string& view, PersonIndex person) {
  char number[24];
  std::snprintf(number, sizeof number, "_p%03u", person);
  return "crops/" + Stem(frame) + number + view;
}

}  // namespace airsim360
