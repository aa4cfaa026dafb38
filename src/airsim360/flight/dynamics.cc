#include "airsim360/flight/dynamics.h"

#include "airsim360/flight/drone_step.h"

namespace airsim360 {
namespace {

using internal::BodyState;
using internal::DroneConstants;
using internal::LaneSurroundings;

BodyState<double> Load(const DroneState& s) {
  BodyState<double> b;
  b.p = s.p_WB;
  b.v = s.v_WB;
  b.w = s.w_WB_B;
  b.q[0] = s.q_WB.w, b.q[1] = s.q_WB.x, b.q[2] = s.q_WB.y, b.q[3] = s.q_WB.z;
  for (int i = 0; i < kMaxRotors; ++i) b.speed[i] = s.rotor_speeds[i];
  b.charge = s.charge;
  return b;
}

void Store(const BodyState<double>& b, DroneState& s) {
  s.p_WB = b.p;
  s.v_WB = b.v;
  s.w_WB_B = b.w;
  s.q_WB = {b.q[0], b.q[1], b.q[2], b.q[3]};
  for (int i = 0; i < kMaxRotors; ++i) s.rotor_speeds[i] = b.speed[i];
  s.charge = b.charge;
}

LaneSurroundings<double> Load(const DroneSurroundings& s) {
  return {s.wind_W,         s.wind_rate_B, s.force_W, s.torque_B, s.air_density / kSeaLevelAirDensity,
          s.ground_distance};
}

/// Beyond this many rotor diameters the ground adds less than 0.1 % of thrust.
constexpr double kGroundEffectDiameters = 4;

bool IsNearGround(const DroneConstants<double>& c, double distance) {
  const double radius = 2 * c.rotor[0].least_height;
  return distance < kGroundEffectDiameters * 2 * radius;
}

/// Commands of failed rotors count as 0, of damaged ones in proportion.
RotorSpeeds WithHealth(const RotorSpeeds& commands, const RotorHealth& health) {
  RotorSpeeds out;
  for (int i = 0; i < kMaxRotors; ++i) out[i] = commands[i] * health[i];
  return out;
}

template <class Drive>
DroneDerivative DerivativeWith(const DroneConstants<double>& c, const DroneSurroundings& surroundings,
                               const RotorSpeeds& commands, const DroneState& state) {
  BodyState<double> s = Load(state);
  const LaneSurroundings<double> around = Load(surroundings);
  RotorSpeeds target;
  double ground[kMaxRotors];
  for (int i = 0; i < c.rotors; ++i) {
    target[i] = internal::LimitSpeed(commands[i], c.rotor[i].max_speed);
    ground[i] = 1;
  }
  if (c.has_battery) internal::UseBattery(c, around.density, commands.data(), s, target.data());
  if (IsNearGround(c, around.ground_distance)) internal::FindGround(c, around, s, ground);
  const Drive drive(c, {s.speed, target.data(), around.density, ground});
  const internal::SteadyLoads<double> loads = internal::MakeSteadyLoads(c, around);
  const internal::Motion<double> rate =
      internal::Differentiate(c, loads, drive, {s.v, s.w, {s.q[0], s.q[1], s.q[2], s.q[3]}});

  DroneDerivative out;
  out.a_WB = rate.v;
  out.angular_acceleration_B = rate.w;
  for (int i = 0; i < c.rotors; ++i) {
    out.rotor_rates[i] = internal::SpeedRate(c.rotor[i], s.speed[i], target[i]);
  }
  out.specific_force_B = internal::Rotation<double>(s.q).ToBody(rate.v + Vec3d{0, 0, kGravity});
  return out;
}

template <class Drive>
void StepWith(const DroneConstants<double>& c, const DroneSurroundings& surroundings,
              const RotorSpeeds& commands, DroneState& state) {
  BodyState<double> s = Load(state);
  const bool near_ground = IsNearGround(c, surroundings.ground_distance);
  internal::StepLanes<Drive>(c, Load(surroundings), near_ground, commands.data(), 1, s);
  Store(s, state);
}

}  // namespace

DroneDynamics::DroneDynamics(const DroneModel& model, double dt)
    : constants_(internal::MakeDroneConstants<double>(model, dt)) {}

void DroneDynamics::Step(const DroneSurroundings& surroundings, const RotorSpeeds& commands,
                         const RotorHealth& health, DroneState& state) const {
  const RotorSpeeds wanted = WithHealth(commands, health);
  if (constants_.upright) {
    StepWith<internal::UprightDrive<double>>(constants_, surroundings, wanted, state);
  } else {
    StepWith<internal::TiltedDrive<double>>(constants_, surroundings, wanted, state);
  }
}

DroneDerivative DroneDynamics::Derivative(const DroneSurroundings& surroundings, const RotorSpeeds& commands,
                                          const RotorHealth& health, const DroneState& state) const {
  const RotorSpeeds wanted = WithHealth(commands, health);
  if (constants_.upright) {
    return DerivativeWith<internal::UprightDrive<double>>(constants_, surroundings, wanted, state);
  }
  return DerivativeWith<internal::TiltedDrive<double>>(constants_, surroundings, wanted, state);
}

void StepDrone(const DroneModel& model, const DroneSurroundings& surroundings, const RotorSpeeds& commands,
               const RotorHealth& health, double dt, DroneState& state) {
  DroneDynamics(model, dt).Step(surroundings, commands, health, state);
}

double BatteryVoltage(const DroneModel& model, const DroneState& state) {
  if (model.battery.cells == 0) return 0;
  const DroneConstants<double> c = internal::MakeDroneConstants<double>(model, 1e-3);
  return internal::LoadBattery(c, 1.0, state.rotor_speeds.data(), state.charge).voltage;
}

}  // namespace airsim360
