// Whole steps of a drone, one source for scalars and SIMD lanes: command limits, battery, ground effect,
// rotors, body.
#pragma once

#include "airsim360/flight/dynamics/battery_equations.h"
#include "airsim360/flight/dynamics/body_equations.h"
#include "airsim360/flight/dynamics/ground_effect.h"

namespace airsim360::internal {

/// Commanded speed that a rotor heads for: within 0 .. limit, and 0 when the command is not a number.
template <class V>
AIRSIM360_LANES V LimitSpeed(V command, V limit) {
  const V zero = V(ScalarOf<V>(0));
  const V positive = Select(command > zero, command, zero);
  return Select(positive < limit, positive, limit);
}

/// Speeds that the rotors head for, and the charge spent over the step.
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES void UseBattery(const DroneConstants<T>& c, V density, const V* command, BodyState<V>& s, V* target) {
  const BatteryLoad<V> load = LoadBattery(c, density, s.speed, s.charge);
  for (int i = 0; i < c.rotors; ++i) {
    target[i] = LimitSpeed(command[i], load.speed_factor * c.rotor[i].max_speed);
  }
  const V left = s.charge - load.current * c.charge_per_ampere;
  s.charge = Select(left > V(T(0)), left, V(T(0)));
}

/// `steps` steps with the same commands and surroundings. `near_ground`: the ground effect is asked for.
template <class Drive, class V, class T = ScalarOf<V>>
AIRSIM360_LANES void StepLanes(const DroneConstants<T>& c, const LaneSurroundings<V>& around, bool near_ground, const V* command, int steps,
                               BodyState<V>& s) {
  using L = typename Drive::Layout;
  const SteadyLoads<V> loads = MakeSteadyLoads(c, around);
  V target[kMaxRotors], middle_speed[kMaxRotors], ground[kMaxRotors];
  for (int i = 0; i < L::Rotors(c); ++i) {
    target[i] = LimitSpeed(command[i], V(c.rotor[i].max_speed));
    ground[i] = V(T(1));
  }
  // The end of a step is the start of the next, unless something besides the rotors' speeds changes.
  const bool chained = !near_ground && !L::Has(c.has_battery);
  const RotorInstant<V> now{s.speed, target, around.density, ground};
  const RotorInstant<V> middle_now{middle_speed, target, around.density, ground};
  if (L::Has(c.has_battery)) UseBattery(c, around.density, command, s, target);
  if (near_ground) FindGround(c, around, s, ground);
  Drive start(c, now);
  for (int i = 0; i < steps; ++i) {
    if (i > 0 && !chained) {
      if (L::Has(c.has_battery)) UseBattery(c, around.density, command, s, target);
      if (near_ground) FindGround(c, around, s, ground);
      start = Drive(c, now);
    }
    TurnRotors<L>(c, target, s.speed, middle_speed);
    const Drive middle(c, middle_now);
    const Drive end(c, now);
    IntegrateBody(c, loads, start, middle, end, s);
    start = end;
  }
}

/// Calls `use` with a null pointer to the quickest kind of drive that fits.
template <class V, class T, class Use>
AIRSIM360_LANES void ChooseDrive(const DroneConstants<T>& c, const Use& use) {
  if (!c.upright) {
    use(static_cast<TiltedDrive<V>*>(nullptr));
  } else if (c.rotors != 4) {
    use(static_cast<UprightDrive<V>*>(nullptr));
  } else if (!c.plain) {
    use(static_cast<UprightDrive<V, QuadLayout>*>(nullptr));
  } else {
    use(static_cast<UprightDrive<V, PlainQuadLayout>*>(nullptr));
  }
}

}  // namespace airsim360::internal
