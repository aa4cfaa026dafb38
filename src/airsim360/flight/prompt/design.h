// From what was said to a whole drone, by published scaling laws: every figure with the law it came from.
#pragma once

#include <map>
#include <string>
#include <vector>

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
  double wheelbase = 0;  ///< metres between motors that face each other: twice the arm
  double pitch = 0;      ///< of the propellers, metres
  int blades = 2;
  double motor_kv = 0;                      ///< rpm per volt without load
  double energy_wh = 0;                     ///< of the battery
  double hover_power = 0;                   ///< W, electrical
  double hover_time = 0;                    ///< s of hovering
  double flight_time = 0;                   ///< s at the speed of least power
  double endurance = 0;                     ///< s: the time that was said, else hover_time
  double level_speed = 0;                   ///< m/s at the largest lean that keeps the height, or as said
  std::map<std::string, std::string> laws;  ///< parameter -> where its figure comes from
  std::vector<std::string> unused;          ///< words of the description that say nothing of a drone
  std::vector<std::string> decided;         ///< what was chosen for the user, one sentence each
};

/// Works out what the request leaves open. Facts of a real drone (request.facts) give way where they do not go
/// with what was said. InputError where two things that were said exclude each other, or no drone fits them
/// (GateProblems): the message names both and the figures.
DroneDesign DesignDrone(const DroneRequest& request);
/// DesignDrone(ParsePrompt(prompt)).
DroneDesign DroneFromPrompt(std::string_view prompt);

}  // namespace airsim360
