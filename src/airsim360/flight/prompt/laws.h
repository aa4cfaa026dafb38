// Scaling laws of multirotors: small formulas with their sources.
#pragma once

#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/prompt/drone_class.h"
#include "airsim360/flight/prompt/request.h"

namespace airsim360::internal {

/// Static coefficients of a propeller of pitch / diameter `pitch_ratio` (Budinger, Reysset, Ochotorena,
/// Delbecq 2020, Aerospace Science and Technology 98:105658: two-blade APC multirotor propellers), for more
/// blades, and for small diameters.
struct PropellerCoefficients {
  double thrust = 0;  ///< C_T
  double power = 0;   ///< C_P
};
PropellerCoefficients CoefficientsOf(double pitch_ratio, int blades, double diameter);

/// Motor and speed controller for a torque (N m), kg: mass ~ torque^(3/3.5) (Budinger et al.) from 14.5 g at
/// 0.0466 N m; the speed controller adds a quarter.
double MotorMass(double torque);
/// Propeller: mass ~ diameter^2 (Budinger et al.) from 3.2 g for three blades of 127 mm.
double PropellerMass(double diameter, int blades);
/// First-order lag of the rotor's speed, s.
double RotorLag(double diameter, bool brushed);
/// Voltage that a power (W) is drawn at: 1.84 P^0.36 (Budinger et al.), as cells of 3.7 V of a pack that is sold.
int CellsFor(double power);
inline constexpr double kCellVoltage = 3.7;
inline constexpr double kFullCell = 4.2;  ///< volts of a charged cell
/// Power at the speed of least power over that of hovering (DJI's Mavic 3 hovers 40 minutes and flies 46).
inline constexpr double kFlightPower = 0.87;

/// Hubs for a layout with arms of length `arm`, `above` metres above the centre of mass; directions and order
/// of quads as AirSim's: front right, rear left, front left, rear right.
std::vector<RotorModel> PlaceRotors(int count, RotorLayout layout, double arm, double above);
/// Neighbouring propellers at two heights may overlap: the least distance of their hubs over the diameter, and the
/// difference of their heights over it.
inline constexpr double kLeastStaggered = 0.8, kStagger = 0.1;
/// Number of arms.
int ArmsOf(int count, RotorLayout layout);

/// Point masses at the hubs, rods from the centre to them, and a box at the centre, kg m^2.
Mat3d CompositeInertia(const std::vector<RotorModel>& rotors, double mass_at_hub, double arms_mass, double box_mass, Vec3d box);

}  // namespace airsim360::internal
