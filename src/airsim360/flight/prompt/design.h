// From what was said to a whole drone, by published scaling laws: every figure with the law it came from.
#pragma once

#include <map>
#include <string>

#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/prompt/drone_class.h"
#include "airsim360/flight/prompt/request.h"

namespace airsim360 {

/// Masses of the parts, kg.
struct DroneParts {
  double motors = 0;  ///< with their speed controllers
  double propellers = 0;
  double guards = 0;
  double arms = 0;
  double battery = 0;
  double body = 0;  ///< frame plate, electronics, wiring
  double payload = 0;
  double Sum() const { return motors + propellers + guards + arms + battery + body + payload; }
};

struct DroneDesign {
  DroneModel model;
  std::string prompt, drone_class;
  DroneParts parts;
  double pitch = 0;  ///< of the propellers, metres
  int blades = 2;
  double hover_power = 0;                   ///< W, electrical
  double endurance = 0;                     ///< s of hovering to 20 % charge
  double level_speed = 0;                   ///< m/s at the largest lean that keeps the height
  std::map<std::string, std::string> laws;  ///< parameter -> where its figure comes from
};

/// Works out what the request leaves open. InputError where two things that were said exclude each other, or
/// no drone fits them (CheckPlausible): the message names both and the figures.
DroneDesign DesignDrone(const DroneRequest& request);
/// DesignDrone(ParsePrompt(prompt)).
DroneDesign DroneFromPrompt(std::string_view prompt);

}  // namespace airsim360
