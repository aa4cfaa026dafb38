#include "airsim360/worlds/building_spec.h"

#include <cstdio>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// What is usual for a use, and the least that its plan needs.
struct Usual {
  double width, depth;
  uint64_t storeys;
  double storey_height;
  double least_width, least_depth, least_height, most_height;
  uint64_t least_storeys;
};
constexpr Usual kUsual[] = {
    {16.0, 11.2, 1, 2.95, 13.5, 10.4, 2.75, 3.6, 1},  // apartment
    {36, 20.4, 1, 3.6, 30, 19.4, 3.3, 5, 1},          // office
    {60, 42, 1, 12.4, 36, 30, 10.5, 14, 1},           // warehouse
    {66, 38, 2, 5.0, 54, 34, 4.2, 6, 1},              // mall
    {66, 32.6, 3, 3.1, 54, 32.6, 2.9, 3.4, 1},        // car park
    {40, 28, 2, 4.4, 34, 26, 3.8, 6, 1},              // library
};
const Usual& UsualOf(BuildingUse use) { return kUsual[static_cast<size_t>(use)]; }

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

void BuildingSpec::Visit(ConfigVisitor& v) {
  v.Field("use", "what it is for", use, kBuildingUses);
  v.Field("width", "metres east; 0 = as usual for the use", width, 0, kMostSide);
  v.Field("depth", "metres north; 0 = as usual for the use", depth, 0, kMostSide);
  v.Field("storeys", "1 to 6; 0 = as usual for the use", storeys);
  v.Field("storey_height", "metres from floor to floor; 0 = as usual for the use", storey_height, 0, 14);
  v.Field("open_doors", "share of the doors that stand open", open_doors, 0, 1);
  v.Field("clutter", "how much stands about, 1 = as in use", clutter, 0, 1.5);
  v.Field("furnished", "false: no furniture, goods and cars", furnished);
  v.Field("atrium", "a hall through all storeys", atrium);
}

void BuildingSpec::Check(const char* prefix) const {
  const Usual& usual = UsualOf(use);
  const std::string name = kBuildingUses[static_cast<size_t>(use)];
  const auto refuse = [&](const std::string& why) { throw InputError(prefix + why); };
  const auto at_least = [&](const char* field, double value, double least, double most) {
    if (value != 0 && !(value >= least && value <= most))
      refuse(std::string(field) + ": " + Number(value) + " is not from " + Number(least) + " to " + Number(most) + " for use: " + name);
  };
  at_least("width", width, usual.least_width, kMostSide);
  at_least("depth", depth, usual.least_depth, kMostSide);
  at_least("storey_height", storey_height, usual.least_height, usual.most_height);
  if (storeys > kMostStoreys) refuse("storeys: " + std::to_string(storeys) + " is not from 1 to " + std::to_string(kMostStoreys));
  if (use == BuildingUse::kWarehouse && storeys > 1) refuse("storeys: " + std::to_string(storeys) + ": a warehouse has 1");
  if (atrium && (use == BuildingUse::kApartment || use == BuildingUse::kWarehouse || use == BuildingUse::kCarPark))
    refuse("atrium: true goes with use: office, mall or library, not " + name);
  if (atrium && Settled().storeys < 2) refuse("atrium: true needs storeys: 2 or more");
}

std::pair<double, double> BuildingSpec::LeastSides(BuildingUse use) { return {UsualOf(use).least_width, UsualOf(use).least_depth}; }

BuildingSpec BuildingSpec::Settled() const {
  BuildingSpec s = *this;
  const Usual& usual = UsualOf(use);
  if (s.width == 0) s.width = usual.width;
  if (s.depth == 0) s.depth = usual.depth;
  if (s.storeys == 0) s.storeys = usual.storeys;
  if (s.storey_height == 0) s.storey_height = usual.storey_height;
  return s;
}

}  // namespace airsim360
