// Kinds of drones and what is usual for each: figures that words leave open.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace airsim360 {

/// Figures of a kind. docs/internals/drone_laws.md says which drones they were read from.
struct DroneClass {
  std::string_view name;
  double mass;          ///< kg, when nothing tells the size
  double disc_loading;  ///< N/m^2 in hover: joins mass and propeller when one of them is left open
  double pitch_ratio;   ///< of the propeller: pitch / diameter
  int blades;
  double thrust_to_weight;
  double full_disc_loading;       ///< N/m^2 at full throttle that a motor matched to the propeller gives at least;
                                  ///< 0 = motors are chosen for the weight alone
  double spacing;                 ///< distance of neighbouring hubs / propeller diameter
  double motor_factor;            ///< motor mass / that of the scaling law
  double arm_share;               ///< of the mass
  double battery_share;           ///< of the mass, when no endurance is asked for
  double body_x, body_y, body_z;  ///< edges of the box of body and battery / arm length
  bool brushed;                   ///< small brushed motors: slow rotors
  bool guarded;                   ///< ducts or guards around the propellers
};

std::span<const DroneClass> DroneClasses();
/// By its name; the name is one of DroneClasses().
const DroneClass& FindDroneClass(std::string_view name);

}  // namespace airsim360
