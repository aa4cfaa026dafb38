// How many different boards the kinds "billboard" and "light_box" have.
#pragma once

#include <cstdint>

namespace airsim360::internal {

inline constexpr uint32_t kDrawnBoards = 12;  ///< variants 0 … of "billboard" that are drawn one by one
inline constexpr uint32_t kVistaBoards = 20;  ///< those after them: landscapes, no two with the same words
inline constexpr uint32_t kLightBoxes = 16;

}  // namespace airsim360::internal
