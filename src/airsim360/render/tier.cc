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

}  // namespace airsim360
