#include "airsim360/mpde/sample.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

// COCO's order has right after left from the eyes on: 1 and 2, 3 and 4, …
constexpr size_t Opposite(size_t i) { return i == 0 ? 0 : i % 2 == 1 ? i + 1 : i - 1; }

constexpr size_t kShoulders = 5, kHips = 11, kAnkles = 15;
constexpr double kSmallest = 1e-4;  // of sizes that are divided by: a person 10 km away

struct ImagePoint {
  double x = 0, y = 0;
};

ImagePoint Middle(const KeypointRays& rays, size_t pair) {
  return {0.5 * (rays[2 * pair] + rays[2 * pair + 2]), 0.5 * (rays[2 * pair + 1] + rays[2 * pair + 3])};
}

// A person of `length` metres that spans `size` on the plane one metre ahead, in the direction of (x, y).
double DistanceOf(double length, double size, ImagePoint p) {
  return length / std::max(size, kSmallest) * std::sqrt(1 + p.x * p.x + p.y * p.y);
}

}  // namespace

MpdeSample Mirrored(const MpdeSample& sample) {
  MpdeSample mirrored = sample;
  for (size_t i = 0; i < kMpdeKeypoints; ++i) {
    mirrored.rays[2 * i] = -sample.rays[2 * Opposite(i)];
    mirrored.rays[2 * i + 1] = sample.rays[2 * Opposite(i) + 1];
  }
  mirrored.truth.angle = WrapAngle(std::numbers::pi - sample.truth.angle);
  return mirrored;
}

int InputCount(MpdeEncoding encoding) { return encoding == MpdeEncoding::kRays ? 2 * kMpdeKeypoints : 2 * kMpdeKeypoints + 3; }

void Encode(const KeypointRays& rays, MpdeEncoding encoding, std::span<float> inputs) {
  if (encoding == MpdeEncoding::kRays) {
    std::ranges::transform(rays, inputs.begin(), [](float v) { return 10 * v; });
    return;
  }
  const ImagePoint shoulders = Middle(rays, kShoulders), hips = Middle(rays, kHips);
  const ImagePoint middle{0.5 * (shoulders.x + hips.x), 0.5 * (shoulders.y + hips.y)};
  double square = 0;
  for (size_t i = 0; i < kMpdeKeypoints; ++i) square += std::pow(rays[2 * i] - middle.x, 2) + std::pow(rays[2 * i + 1] - middle.y, 2);
  const double size = std::max(std::sqrt(square / kMpdeKeypoints), kSmallest);
  for (size_t i = 0; i < kMpdeKeypoints; ++i) {
    inputs[2 * i] = static_cast<float>((rays[2 * i] - middle.x) / size);
    inputs[2 * i + 1] = static_cast<float>((rays[2 * i + 1] - middle.y) / size);
  }
  inputs[rays.size()] = static_cast<float>(middle.x);
  inputs[rays.size() + 1] = static_cast<float>(middle.y);
  inputs[rays.size() + 2] = static_cast<float>(std::log(size));
}

double ConstantHeightDistance(const KeypointRays& rays) {
  constexpr double kStature = 1.72, kEyesToAnkles = 0.936 - 0.039;
  const ImagePoint eyes = Middle(rays, 1), ankles = Middle(rays, kAnkles);
  return DistanceOf(kStature * kEyesToAnkles, ankles.y - eyes.y, {0.5 * (eyes.x + ankles.x), 0.5 * (eyes.y + ankles.y)});
}

double ConstantTrunkDistance(const KeypointRays& rays) {
  constexpr double kTrunk = 0.5;
  const ImagePoint shoulders = Middle(rays, kShoulders), hips = Middle(rays, kHips);
  return DistanceOf(kTrunk, std::hypot(shoulders.x - hips.x, shoulders.y - hips.y), hips);
}

}  // namespace airsim360
