// Ids of Cityscapes' labels (its labels.py), which its own format, KITTI-STEP and MOTS use.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace airsim360::internal {

inline constexpr int kPersonLabel = 24, kCarLabel = 26;
inline constexpr int kFirstThing = 24, kLastThing = 33;  ///< person … bicycle: those with instances

/// Train id of a label id, 255 = not evaluated or none.
constexpr uint8_t CityscapesTrainId(int label) {
  constexpr std::array<uint8_t, 34> kTrain = {255, 255, 255, 255, 255, 255, 255, 0,  1,  255, 255, 2,  3,   4,   255, 255, 255,
                                              5,   255, 6,   7,   8,   9,   10,  11, 12, 13,  14,  15, 255, 255, 16,  17,  18};
  return label >= 0 && label < 34 ? kTrain[static_cast<size_t>(label)] : 255;
}

}  // namespace airsim360::internal
