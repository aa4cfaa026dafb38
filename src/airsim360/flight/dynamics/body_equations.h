// Motion of the rigid body and of the rotors over steps, one source for scalars and SIMD lanes.
// docs/internals/flight.md.
//
// Rotor speeds follow dw/dt = (target - w) / tau exactly, whatever the step. The body is integrated by
// classical RK4 with the exact speeds at the start, middle and end; position, which nothing depends on within
// a step, needs no stages of its own.
#pragma once

#include "airsim360/flight/dynamics/rotor_equations.h"

namespace airsim360::internal {

template <class V>
struct BodyState {
  Vec3<V> p, p_low;  ///< p + p_low is the position: what float loses of a small step is kept in p_low
  Vec3<V> v;
  V q[4];  ///< w, x, y, z
  Vec3<V> w;
  V speed[kMaxRotors];
  V charge;
};

/// DroneSurroundings; density as a ratio to kSeaLevelAirDensity.
template <class V>
struct LaneSurroundings {
  Vec3<V> wind, wind_rate, force, torque;
  V density, ground_distance;
};

/// What RK4 integrates, or its rate of change.
template <class V>
struct Motion {
  Vec3<V> v, w;
  V q[4];
};

/// What stays the same over the steps of one call; drag coefficients divided by the mass.
template <class V>
struct SteadyLoads {
  Vec3<V> wind, wind_rate, acceleration, torque, linear_drag, quadratic_drag;
};

template <class V>
struct Rotation {
  V m[3][3];

  AIRSIM360_LANES explicit Rotation(const V* q) {
    const V x2 = q[1] + q[1], y2 = q[2] + q[2], z2 = q[3] + q[3];
    const V xx = q[1] * x2, yy = q[2] * y2, zz = q[3] * z2, xy = q[1] * y2, xz = q[1] * z2, yz = q[2] * z2;
    const V wx = q[0] * x2, wy = q[0] * y2, wz = q[0] * z2, one = V(ScalarOf<V>(1));
    m[0][0] = one - (yy + zz), m[0][1] = xy - wz, m[0][2] = xz + wy;
    m[1][0] = xy + wz, m[1][1] = one - (xx + zz), m[1][2] = yz - wx;
    m[2][0] = xz - wy, m[2][1] = yz + wx, m[2][2] = one - (xx + yy);
  }
  AIRSIM360_LANES Vec3<V> ToWorld(Vec3<V> a) const {
    return {m[0][0] * a.x + m[0][1] * a.y + m[0][2] * a.z, m[1][0] * a.x + m[1][1] * a.y + m[1][2] * a.z,
            m[2][0] * a.x + m[2][1] * a.y + m[2][2] * a.z};
  }
  AIRSIM360_LANES Vec3<V> ToBody(Vec3<V> a) const {
    return {m[0][0] * a.x + m[1][0] * a.y + m[2][0] * a.z, m[0][1] * a.x + m[1][1] * a.y + m[2][1] * a.z,
            m[0][2] * a.x + m[1][2] * a.y + m[2][2] * a.z};
  }
};

template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES Vec3<V> Times(const Mat3<T>& a, Vec3<V> v) {
  return {v.x * a.m[0][0] + v.y * a.m[0][1] + v.z * a.m[0][2], v.x * a.m[1][0] + v.y * a.m[1][1] + v.z * a.m[1][2],
          v.x * a.m[2][0] + v.y * a.m[2][1] + v.z * a.m[2][2]};
}

/// Euler's equation J dw/dt = M - w x J w; the rotors' own momentum is part of M.
template <class L, class V, class T = ScalarOf<V>>
AIRSIM360_LANES Vec3<V> AngularAcceleration(const DroneConstants<T>& c, Vec3<V> torque, Vec3<V> w) {
  if (L::Has(c.has_products)) return Times(c.inverse_inertia, torque - Cross(w, Times(c.inertia, w)));
  const auto& inverse = c.inverse_inertia.m;
  return {(torque.x - w.y * w.z * c.inertia_gaps.x) * inverse[0][0], (torque.y - w.z * w.x * c.inertia_gaps.y) * inverse[1][1],
          (torque.z - w.x * w.y * c.inertia_gaps.z) * inverse[2][2]};
}

template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES SteadyLoads<V> MakeSteadyLoads(const DroneConstants<T>& c, const LaneSurroundings<V>& s) {
  const Vec3<V> gravity = Broadcast<V>({T(0), T(0), T(-kGravity)});
  return {s.wind,
          s.wind_rate,
          s.force * V(c.inverse_mass) + gravity,
          s.torque,
          Broadcast<V>(c.linear_drag) * (s.density * c.inverse_mass),
          Broadcast<V>(c.quadratic_drag) * (s.density * c.inverse_mass)};
}

/// Deceleration by the air's force on the body, in B: (linear_i + quadratic_i |v|) v_i / m. The air speed is
/// taken in W, so that it need not wait for the rotation.
template <class V>
AIRSIM360_LANES Vec3<V> BodyDrag(const SteadyLoads<V>& loads, Vec3<V> v_W, Vec3<V> v_B) {
  const V speed = SquareRoot(Dot(v_W, v_W));
  return (loads.linear_drag + loads.quadratic_drag * speed) * v_B;
}

/// Newton's and Euler's equations and the quaternion's, dq/dt = q (0, w) / 2.
template <class Drive, class V, class T = ScalarOf<V>>
AIRSIM360_LANES Motion<V> Differentiate(const DroneConstants<T>& c, const SteadyLoads<V>& loads, const Drive& drive, const Motion<V>& s) {
  const Rotation<V> R(s.q);
  const Vec3<V> air_W = s.v - loads.wind;
  const AirMotion<V> air{R.ToBody(air_W), s.w - loads.wind_rate, s.w};
  const Wrench<V> rotors = drive.WrenchIn(c, air);
  const Vec3<V> specific_force = rotors.force * V(c.inverse_mass) - BodyDrag(loads, air_W, air.v);
  const Vec3<V> h = s.w * V(T(0.5));
  Motion<V> rate;
  rate.v = R.ToWorld(specific_force) + loads.acceleration;
  rate.w = AngularAcceleration<typename Drive::Layout>(c, rotors.torque + loads.torque, s.w);
  rate.q[0] = -(s.q[1] * h.x + s.q[2] * h.y + s.q[3] * h.z);
  rate.q[1] = s.q[0] * h.x + s.q[2] * h.z - s.q[3] * h.y;
  rate.q[2] = s.q[0] * h.y - s.q[1] * h.z + s.q[3] * h.x;
  rate.q[3] = s.q[0] * h.z + s.q[1] * h.y - s.q[2] * h.x;
  return rate;
}

template <class V>
AIRSIM360_LANES Motion<V> After(const Motion<V>& s, const Motion<V>& rate, V time) {
  Motion<V> out;
  out.v = s.v + rate.v * time;
  out.w = s.w + rate.w * time;
  for (int i = 0; i < 4; ++i) out.q[i] = s.q[i] + rate.q[i] * time;
  return out;
}

/// k1 + 2 (k2 + k3) + k4.
template <class V>
AIRSIM360_LANES V Simpson(V k1, V k2, V k3, V k4) {
  const V middle = k2 + k3;
  return (k1 + k4) + (middle + middle);
}

/// a + step, keeping what rounding loses in `low` (Dekker's fast two-sum; a is the larger).
template <class V>
AIRSIM360_LANES void AddExactly(V step, V& a, V& low) {
  const V all = step + low, sum = a + all;
  low = all - (sum - a);
  a = sum;
}

/// Keeps RK4 stable whatever the torque: no component of the turning above 1.5 rad a step (1500 rad/s at 1
/// ms).
template <class V>
AIRSIM360_LANES V LimitTurning(V w, V most) {
  const V high = Select(w < most, w, most);
  return Select(high > -most, high, -most);
}

/// One RK4 step of the body, given the rotors at its start, middle and end.
template <class Drive, class V, class T = ScalarOf<V>>
AIRSIM360_LANES void IntegrateBody(const DroneConstants<T>& c, const SteadyLoads<V>& loads, const Drive& start, const Drive& middle,
                                   const Drive& end, BodyState<V>& s) {
  const Motion<V> now{s.v, s.w, {s.q[0], s.q[1], s.q[2], s.q[3]}};
  const V half = V(c.half_dt), sixth = V(c.sixth_dt), dt = V(c.dt);
  const Motion<V> k1 = Differentiate(c, loads, start, now);
  const Motion<V> k2 = Differentiate(c, loads, middle, After(now, k1, half));
  const Motion<V> k3 = Differentiate(c, loads, middle, After(now, k2, half));
  const Motion<V> k4 = Differentiate(c, loads, end, After(now, k3, dt));

  const Vec3<V> step = (s.v + (k1.v + k2.v + k3.v) * sixth) * dt;
  AddExactly(step.x, s.p.x, s.p_low.x);
  AddExactly(step.y, s.p.y, s.p_low.y);
  AddExactly(step.z, s.p.z, s.p_low.z);
  for (int i = 0; i < 3; ++i) {
    s.v[i] = s.v[i] + sixth * Simpson(k1.v[i], k2.v[i], k3.v[i], k4.v[i]);
    const V w = s.w[i] + sixth * Simpson(k1.w[i], k2.w[i], k3.w[i], k4.w[i]);
    s.w[i] = LimitTurning(w, V(c.most_turning));
  }
  for (int i = 0; i < 4; ++i) s.q[i] = s.q[i] + sixth * Simpson(k1.q[i], k2.q[i], k3.q[i], k4.q[i]);
  // One Newton step for 1 / |q| about 1: the error of a step squares.
  const V norm2 = (s.q[0] * s.q[0] + s.q[1] * s.q[1]) + (s.q[2] * s.q[2] + s.q[3] * s.q[3]);
  const V scale = V(T(1.5)) - V(T(0.5)) * norm2;
  for (int i = 0; i < 4; ++i) s.q[i] = s.q[i] * scale;
}

/// Speeds half a step later and a whole step later, the latter into `speed`.
template <class L, class V, class T = ScalarOf<V>>
AIRSIM360_LANES void TurnRotors(const DroneConstants<T>& c, const V* target, V* speed, V* middle) {
  for (int i = 0; i < L::Rotors(c); ++i) {
    const RotorConstants<T>& r = c.rotor[i];
    const V gap = speed[i] - target[i];
    const V decay = Select(gap < V(T(0)), V(r.half_decay_up), V(r.half_decay_down));
    const V half_gap = gap * decay;
    middle[i] = target[i] + half_gap;
    speed[i] = target[i] + half_gap * decay;
  }
}

}  // namespace airsim360::internal
