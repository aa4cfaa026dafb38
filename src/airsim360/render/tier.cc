#include <string>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

Tier ParseTier(std::string_view name) {
  return ParseChoice<Tier>("tier", name, kTierNames);
}

int CheckEdgeSamples(std::string_view name, std::optional<int> given) {
  if (!given) return 0;
  const int nearest = std::clamp(*given, 1, kMostEdgeSamples);
  if (nearest == *given) return nearest;
  throw InputError(std::string(name) + ": " + std::to_string(*given) + " is not in 1 … " +
                   std::to_string(kMostEdgeSamples) + "; did you mean " + std::to_string(nearest) + "?");
}

}  // namespace airsim360
