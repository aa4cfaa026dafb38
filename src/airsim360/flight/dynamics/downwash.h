// The air that a drone blows down on others.
//
// Below the rotors the wake contracts and speeds up to twice the induced velocity (momentum theory; on the
// axis of a vortex tube v_i (1 + x / sqrt(x^2 + R^2))); from about 5 disc diameters on it is the round
// turbulent jet of the same momentum: Schlichting, "Boundary-Layer Theory", 7th ed., eqs. 24.40 to 24.43, u
// = 7.41 sqrt(K) / x on the axis with K = thrust / density, half as fast at a radius of 0.085 x. That the
// wake of a multirotor becomes such a jet, given by mass, propeller and drone size alone, was measured by
// Bauersfeld et al., "Robotics meets fluid dynamics", arXiv 2403.13321. The two parts join where the jet has
// slowed to 2 v_i.
//
// A drone feels it as wind (DroneSurroundings::wind_W): drag, and loss of thrust by inflow.
#pragma once

#include <span>

#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/drone_state.h"

namespace airsim360 {

/// What a drone's rotors together blow.
struct RotorWake {
  Vec3d p_W;             ///< middle of the rotors
  Vec3d direction_W;     ///< unit, the way the air goes
  double momentum = 0;   ///< K = thrust / density, m^4/s^2
  double disc_area = 0;  ///< of all rotors, m^2
};

RotorWake WakeOf(const DroneModel& model, const DroneState& state, double air_density = kSeaLevelAirDensity);

/// Velocity of the wake's air at p_W, m/s; 0 upstream of the rotors.
Vec3d WakeVelocity(const RotorWake& wake, Vec3d p_W);

/// Of all wakes but number `own` at p_W: momentum fluxes add (Reichardt's superposition of jets).
Vec3d DownwashOn(std::span<const RotorWake> wakes, size_t own, Vec3d p_W);

}  // namespace airsim360
