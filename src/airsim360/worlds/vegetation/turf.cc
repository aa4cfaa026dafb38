#include "airsim360/worlds/vegetation/turf.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

// One blade of a tuft: upright in its middle, leaning outwards at its rim, all a little to one side.
void AddTuftBlade(PlantLayer& layer, const Turf& turf, Vec3f middle, float radius, float comb, float shorter, RngStream& random) {
  const float r = std::sqrt(static_cast<float>(random.Uniform())), a = kTauF * static_cast<float>(random.Uniform());
  const Vec3f out{std::cos(a), std::sin(a), 0}, p = middle + out * (radius * r);
  const Vec3f lean =
      (out * (0.15f + 0.6f * r) + Vec3f{std::cos(comb), std::sin(comb), 0} * 0.2f) * static_cast<float>(random.Uniform(0.5, 1.3));
  const float height = static_cast<float>(random.Uniform(turf.low, turf.high)) * shorter,
              width = turf.width * static_cast<float>(random.Uniform(0.6, 1.5)),
              turn = a + 1.57f + 0.6f * static_cast<float>(random.Normal());
  const int cell = random.Chance(turf.straw) ? kLeafCells - 1 : static_cast<int>(random.Index(kLeafCells - 1));
  const float cut = turf.mown * shorter * static_cast<float>(random.Uniform(0.85, 1.15));
  if (turf.mown > 0 && height > cut) return AddCutBlade(layer, p, cut, width, lean, turn, cell);
  AddBlade(layer, p, height, width, lean, turn, cell);
}

}  // namespace

void AddTurf(PlantLayer& layer, const Turf& turf, int count, const std::function<Vec3f()>& place,
             const std::function<float(Vec3f)>& shorter, RngStream& random) {
  for (int left = count; left > 0;) {
    // Many small tufts and few large ones.
    const auto share = static_cast<float>(random.Uniform());
    const int blades = std::min(left, 6 + static_cast<int>(46 * share * share));
    const Vec3f middle = place();
    const float radius = 0.006f + 0.0011f * static_cast<float>(blades), comb = kTauF * static_cast<float>(random.Uniform()),
                size = shorter(middle);
    for (int i = 0; i < blades; ++i) AddTuftBlade(layer, turf, middle, radius, comb, size, random);
    left -= blades;
  }
}

}  // namespace airsim360::internal
