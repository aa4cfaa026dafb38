// The blurred copies of the sky for rough reflections.
#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/sky.h"

namespace airsim360::internal {
namespace {

// One direction of a coarse sky with its radiance and solid angle.
struct CoarseSample {
  Vec3f direction, radiance;
  float solid_angle;
};

std::vector<CoarseSample> CoarseSky(const Sky& sky, int width, int height) {
  const SkyTable grid{width, height, true, {}};
  std::vector<CoarseSample> samples(static_cast<size_t>(width) * height);
  ParallelFor(height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      CoarseSample& sample = samples[static_cast<size_t>(y) * width + x];
      sample = {DirectionOfTexel(grid, x, y), {}, std::max(RowSolidAngle(grid, y), 1e-7f)};
      for (int k = 0; k < 16; ++k) {
        const float azimuth = (static_cast<float>(x) + (static_cast<float>(k % 4) + 0.5f) / 4) * 2 * kPiF / static_cast<float>(width);
        const float elevation =
            grid.ElevationOfRow(y) + ((static_cast<float>(k / 4) + 0.5f) / 4 - 0.5f) * kPiF / static_cast<float>(height - 1);
        sample.radiance += sky.Radiance(DirectionOf(azimuth, std::clamp(elevation, -kPiF / 2, kPiF / 2))) * (1 / 16.0f);
      }
    }
  });
  return samples;
}

// Mean of the sky over a cosine-power lobe about d.
Vec3f LobeMean(const std::vector<CoarseSample>& sky, Vec3f d, float exponent) {
  Vec3f sum{};
  float total = 0;
  const float least = std::exp2(-12.0f / exponent);  // the rest of the lobe is below 2^-12 of its peak
  for (const CoarseSample& sample : sky) {
    const float mu = Dot(sample.direction, d);
    if (mu < least) continue;
    const float weight = scalar::pow_approx(mu, exponent) * sample.solid_angle;
    sum += sample.radiance * weight;
    total += weight;
  }
  return sum * (1 / total);
}

}  // namespace

// Cosine-power lobes about as wide as the GGX lobes of the same roughness: the reflected direction turns
// twice as far as the microfacet, hence a quarter of its exponent.
void Sky::BakeBlurred() {
  for (int level = 0; level < kBlurLevels; ++level) {
    const int width = level == 0 ? 128 : 64, height = width / 2 + 1;
    const std::vector<CoarseSample> source = CoarseSky(*this, width, height);
    const float alpha = kBlurRoughness[level] * kBlurRoughness[level];
    const float exponent = std::max(1.0f, (2 / (alpha * alpha) - 2) * 0.25f);
    SkyTable& table = blurred_[level] = MakeTable(width, height, true);
    ParallelFor(height, [&](int64_t row) {
      for (int x = 0; x < width; ++x) {
        table.SetTexel(x, static_cast<int>(row), LobeMean(source, DirectionOfTexel(table, x, static_cast<int>(row)), exponent));
      }
    });
  }
}

}  // namespace airsim360::internal
