// Real drones by their published parameters.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

struct CatalogDrone {
  std::string_view name;                                 ///< "crazyflie", "hummingbird", …
  std::string_view title;                                ///< what it is
  std::string_view source;                               ///< where the figures come from, and what they lack
  std::string_view prompt;                               ///< mass, size and kind in words: what the laws make of it is compared with it
  bool measured_inertia = true, measured_thrust = true;  ///< false: figures of our own sizing laws
};

std::span<const CatalogDrone> DroneCatalog();
/// The model of a catalogue entry; InputError naming the nearest one.
DroneModel CatalogModel(const std::string& name);

}  // namespace airsim360
