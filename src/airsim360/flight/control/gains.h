// Gains and limits of a drone's controllers, from its own inertia, rotor lag and thrust: no drone is tuned by
// hand. docs/internals/autopilot.md derives the law.
#pragma once

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

struct ControlGains {
  double lead = 1;       ///< rotor speeds are commanded past their goal by this factor of the error
  double lag = 0.02;     ///< of rotor thrust with the lead, s
  double spin_time = 0;  ///< s: rotors that speed up turn the drone at once by their inertia, as much as
                         ///< their torque would this much later; the yaw demand is slowed by it in turn
  Vec3d rate;            ///< 1/s: angular acceleration per error of body rate
  Vec3d attitude;        ///< 1/s: body rate per error of attitude
  double velocity = 1;   ///< 1/s: acceleration per error of velocity
  double position = 1;   ///< 1/s: velocity per error of position

  double max_thrust = 0;        ///< N, all rotors
  Vec3d authority;              ///< rad/s^2 that the rotors can give about each axis while hovering
  double drag_rate = 0;         ///< 1/s: linear drag over mass
  double quadratic_drag = 0;    ///< 1/m: quadratic drag over mass
  double max_tilt = 0;          ///< rad, at which the height is kept with a tenth of the thrust in reserve
  Vec3d max_rate;               ///< rad/s
  double max_acceleration = 0;  ///< m/s^2, of what guidance asks for
  double max_climb_acceleration = 0;
  double max_speed = 0, max_climb = 0, max_descent = 0;  ///< m/s, of what guidance asks for
};

/// The gains for a control period. InputError when the drone cannot fly: no rotors, thrust below weight, a
/// mass, inertia or factor that is not positive, or rotors that cannot give roll, pitch and thrust.
ControlGains SynthesizeGains(const DroneModel& model, double control_dt);

/// Force on the drone from air moving past it, as a rate: N/(m/s) of horizontal air velocity near hover
/// (in-plane drag of the rotors and the body's own linear drag).
double LinearDrag(const DroneModel& model);

/// Steady level speed at a tilt: where drag equals the horizontal thrust, m/s.
double LevelSpeedAtTilt(const DroneModel& model, double tilt);

}  // namespace airsim360
