#include "airsim360/worlds/kit/bicycle_sign.h"

#include <cmath>

namespace airsim360 {

std::vector<SignStroke> BicycleSign() {
  std::vector<SignStroke> sign;
  for (float hub : {-0.45f, 0.45f}) {
    for (int i = 0; i < 12; ++i) {
      const float a0 = 0.5236f * static_cast<float>(i), a1 = a0 + 0.5236f;
      sign.push_back(
          {{0.5f + 0.55f * std::cos(a0), hub + 0.28f * std::sin(a0)}, {0.5f + 0.55f * std::cos(a1), hub + 0.28f * std::sin(a1)}});
    }
  }
  constexpr SignStroke kFrame[] = {{{0.5f, -0.45f}, {1.3f, -0.12f}}, {{1.3f, -0.12f}, {1.35f, 0.33f}}, {{1.35f, 0.33f}, {0.5f, 0.45f}},
                                   {{0.5f, 0.0f}, {1.3f, -0.12f}},   {{0.5f, 0.0f}, {1.35f, 0.33f}},   {{0.5f, -0.45f}, {0.5f, 0.0f}},
                                   {{1.35f, 0.33f}, {1.7f, 0.36f}},  {{1.7f, 0.2f}, {1.7f, 0.5f}}};
  sign.insert(sign.end(), std::begin(kFrame), std::end(kFrame));
  return sign;
}

}  // namespace airsim360
