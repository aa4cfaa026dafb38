#include <array>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

Tier ParseTier(std::string_view name) {
  for (size_t i = 0; i < std::size(kTierNames); ++i) {
    if (name == kTierNames[i]) return static_cast<Tier>(i);
  }
  const std::array<std::string, 4> choices = {kTierNames[0], kTierNames[1], kTierNames[2], kTierNames[3]};
  throw InputError(UnknownChoiceMessage("tier", name, choices));
}

int CheckEdgeSamples(std::string_view name, std::optional<int> given) {
  if (!given) return 0;
  const int nearest = std::clamp(*given, 1, kMostEdgeSamples);
  if (nearest == *given) return nearest;
  throw InputError(std::string(name) + ": " + std::to_string(*given) + " is not in 1 … " +
                   std::to_string(kMostEdgeSamples) + "; did you mean " + std::to_string(nearest) + "?");
}

}  // namespace airsim360
