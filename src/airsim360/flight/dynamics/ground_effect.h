// The ground effect: thrust gained near a surface below. docs/internals/flight.md.
#pragma once

#include "airsim360/flight/dynamics/body_equations.h"

namespace airsim360::internal {

/// Beyond this many rotor radii the ground adds less than 0.1 % of thrust: (R / 4 z)^2 = 1 / 1024.
inline constexpr int kGroundEffectRadii = 8;

/// Whether a surface `distance` metres below the rotors is near enough to matter.
template <class T>
AIRSIM360_LANES bool FeelsGround(const DroneConstants<T>& c, double distance) {
  return distance < 2 * kGroundEffectRadii * double{c.rotor[0].least_height};
}

/// Factor of thrust (Cheeseman and Bennett, ARC R&M 3021, 1955, with their term for forward flight):
/// 1 / (1 - (R / 4 z)^2 / (1 + (V / v_i)^2)), z held at R / 2 or more. `standing` is 1 / (1 + (V / v_i)^2).
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES V GroundFactor(const RotorConstants<T>& r, V distance, V standing) {
  const V one = V(T(1)), least = V(r.least_height);
  const V z = Select(distance > least, distance, least);
  return one / (one - standing * (V(r.ground) / (z * z)));
}

/// Factors of all rotors (of the first only, when upright), for the state at the start of a step; 1 for a
/// drone upside down. V is the speed along the ground, v_i the induced velocity in hover at the rotors' mean
/// square speed.
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES void FindGround(const DroneConstants<T>& c, const LaneSurroundings<V>& around, const BodyState<V>& s, V* ground) {
  const V zero = V(T(0));
  V induced2 = zero;
  for (int i = 0; i < c.rotors; ++i) induced2 = induced2 + s.speed[i] * s.speed[i] * c.rotor[i].induced;
  induced2 = induced2 * V(T(1) / T(c.rotors));
  const V vx = s.v.x - around.wind.x, vy = s.v.y - around.wind.y;
  const V moving = induced2 / (induced2 + (vx * vx + vy * vy) + V(T(1e-12)));
  const V upright = V(T(1)) - V(T(2)) * (s.q[1] * s.q[1] + s.q[2] * s.q[2]);
  // Drones out of reach get exactly 1, whether or not others of the batch are near.
  const V reach = V(T(2 * kGroundEffectRadii) * c.rotor[0].least_height);
  const V standing = Select(upright > zero, Select(around.ground_distance < reach, moving, zero), zero);
  const int count = c.upright ? 1 : c.rotors;
  for (int i = 0; i < count; ++i) ground[i] = GroundFactor(c.rotor[i], around.ground_distance, standing);
}

}  // namespace airsim360::internal
