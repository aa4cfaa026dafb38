#include "airsim360/vln/flights/flight_rules.h"

#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr FlightRules kRules[] = {
    {"ours", "ours", 0, true, 200, Decisions::kWaypoints, 5, 5, 2, 15, "the radius of the episode, a collision ends the flight"},
    {"aerialvln", "aerialvln", 20, false, 500, Decisions::kDiscrete, 5, 5, 2, 15, "Liu et al., AerialVLN, ICCV 2023"},
    {"openfly", "openfly", 20, false, 100, Decisions::kDiscrete, 3, 3, 3, 30, "OpenFly: the steps of its code"},
    {"citynav", "citynav-vlnce", 20, false, 200, Decisions::kDiscrete, 5, 5, 2, 30, "CityNav: its sequence-to-sequence and CMA agents"},
    {"traveluav", "traveluav", 20, true, 200, Decisions::kWaypoints, 5, 5, 2, 15, "TravelUAV (OpenUAV)"},
    {"uavon", "uavon", 20, true, 150, Decisions::kDiscrete, 5, 5, 2, 15, "UAV-ON"},
};

}  // namespace

std::span<const FlightRules> AllFlightRules() { return kRules; }

const FlightRules& FindFlightRules(const std::string& name) {
  std::vector<std::string> names;
  for (const FlightRules& rules : kRules) {
    if (name == rules.name) return rules;
    names.emplace_back(rules.name);
  }
  throw InputError("--protocol: " + UnknownChoiceMessage("protocol", name, names));
}

}  // namespace airsim360
