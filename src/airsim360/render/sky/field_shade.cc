#include "airsim360/render/sky/field_shade.h"

#include <algorithm>

#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/cloud_geometry.h"

namespace airsim360::internal {
namespace {

constexpr float kFarthestShade = 60e3f;  // metres; a ray grazing the ground has left every layer before
constexpr int kPoints = 48, kMostSteps = 320;

// Optical depth of the way from a point in the direction of the sun, over the curved ground.
float DepthBeyond(const CloudLayer& layer, Vec3f p, Vec3f to_sun, float first) {
  constexpr float kShortest = 60;
  const float flat = 0.5f * (1 - to_sun.z * to_sun.z) / kEarthRadius;
  const auto altitude = [&](float t) { return p.z + t * (to_sun.z + t * flat); };
  if (altitude(first) > layer.highest()) return 0;
  float last = first;
  while (last < kFarthestShade && altitude(last) < layer.highest()) last += 500;
  const float step = std::max(kShortest, (last - first) / kMostSteps);
  float depth = 0;
  for (float t = first + 0.5f * step; t < last; t += step) {
    const float x = p.x + to_sun.x * t, y = p.y + to_sun.y * t;
    if (layer.MayBeCloud(x, y)) depth += layer.Density(x, y, altitude(t), false) * step;
  }
  return depth;
}

}  // namespace

FieldShade::FieldShade(const CloudLayer& layer, Vec3f to_sun, float first)
    : lowest_(layer.lowest()), per_metre_((kHeights - 1) / std::max(layer.highest() - layer.lowest(), 1.0f)) {
  for (int k = 0; k < kHeights; ++k) {
    float sum = 0;
    for (int i = 1; i <= kPoints; ++i) {
      // Kronecker's sequence of the plastic number: even over the tile.
      const auto even = [&](double step) { return static_cast<float>(i * step - static_cast<int>(i * step)) * layer.extent(); };
      const Vec3f p{even(0.7548776662), even(0.5698402910), lowest_ + static_cast<float>(k) / per_metre_};
      const float depth = DepthBeyond(layer, p, to_sun, first);
      // Half of what a cloud scatters goes on within a few degrees, as in Clouds::SunAt.
      sum += depth > 0 ? scalar::exp_approx(-0.5f * depth) : 1;
    }
    share_[k] = sum / kPoints;
  }
}

float FieldShade::At(float altitude) const {
  const float at = std::clamp((altitude - lowest_) * per_metre_, 0.0f, kHeights - 1.001f);
  const int k = static_cast<int>(at);
  return share_[k] + (share_[k + 1] - share_[k]) * (at - static_cast<float>(k));
}

}  // namespace airsim360::internal
