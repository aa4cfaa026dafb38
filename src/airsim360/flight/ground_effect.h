// The ground effect: thrust gained near a surface below. docs/flight.md.
#pragma once

#include "airsim360/flight/body_equations.h"

namespace airsim360::internal {

/// Beyond this many rotor radii the ground adds less than 0.1 % of thrust: (R / 4 z)^2 = 1 / 1024.
inline constexpr int kGroundEffectRadii = 8;

/// Whether a surface `distance` metres below the rotors is near enough to matter.
template <class T>
AIRSIM360_LANES bool FeelsGround(const DroneConstants<T>& c, double distance) {
  return distance < kGroundEffectRadii * 2 * double{c.rotor[0].least_height};
}

/// Factor of thrust (Cheeseman and Bennett, ARC R&M 3021, 1955, with their term for forward flight):
/// 1 / (1 - (R / 4 z)^2 / (1 + (V / v_i)^2)), z held at R / 2 or more; 1 upside down.
/// `across2` is V^2 along the ground, v_i the induced velocity in hover at this speed.
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES V GroundFactor(const RotorConstants<T>& r, V distance, V speed, V upright, V across2) {
  const V one = V(T(1)), zero = V(T(0)), least = V(r.least_height);
  const V z = Select(distance > least, distance, least);
  const V induced2 = speed * speed * r.induced;
  const V standing = induced2 / (induced2 + across2 + V(T(1e-12)));
  const V share = Select(upright > zero, standing * (V(r.ground) / (z * z)), zero);
  return one / (one - share);
}

/// Factors of all rotors (of the first only, when upright), for the state at the start of a step.
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES void FindGround(const DroneConstants<T>& c, const LaneSurroundings<V>& around,
                                const BodyState<V>& s, V* ground) {
  const V upright = V(T(1)) - V(T(2)) * (s.q[1] * s.q[1] + s.q[2] * s.q[2]);
  const V vx = s.v.x - around.wind.x, vy = s.v.y - around.wind.y;
  const V across2 = vx * vx + vy * vy;
  const int count = c.upright ? 1 : c.rotors;
  for (int i = 0; i < count; ++i) {
    ground[i] = GroundFactor(c.rotor[i], around.ground_distance, s.speed[i], upright, across2);
  }
}

}  // namespace airsim360::internal
