// Forces and torques of the rotors, one source for scalars and SIMD lanes. docs/internals/flight.md has the equations.
//
// A drive is what the rotors' speeds at one instant amount to; it then gives the wrench for any motion of the
// body at that instant. UprightDrive is for the common layout (DroneConstants::upright), TiltedDrive for all.
#pragma once

#include "airsim360/flight/dynamics/drive_layout.h"
#include "airsim360/flight/dynamics/lane_math.h"

namespace airsim360::internal {

/// Force and torque about the centre of mass, in B.
template <class V>
struct Wrench {
  Vec3<V> force, torque;
};

/// How the air moves past the body, and how the body turns, all in B.
template <class V>
struct AirMotion {
  Vec3<V> v;      ///< of the centre of mass against the air
  Vec3<V> w_air;  ///< of the body against the air
  Vec3<V> w;      ///< of the body
};

/// The rotors at an instant: speeds, commanded speeds, density ratio, and thrust gained near the ground.
template <class V>
struct RotorInstant {
  const V* speed;
  const V* target;
  V density;
  const V* ground;  ///< factor of thrust, one for each rotor
};

/// Rate of change of a speed that follows its target exponentially.
template <class V, class T>
AIRSIM360_LANES V SpeedRate(const RotorConstants<T>& r, V speed, V target) {
  const V gap = target - speed;
  return gap * Select(gap > V(T(0)), V(r.rate_up), V(r.rate_down));
}

/// Rotors along +Z at one height: their hubs move with u = v at the middle of the rotor plane, and w_z.
template <class V, class L = AnyLayout>
struct UprightDrive {
  using Layout = L;
  using T = ScalarOf<V>;
  V thrust{}, roll{}, pitch{}, yaw{};                 // of k_f speed^2 and of the reaction torques
  V drag{}, drag_x{}, drag_y{}, drag_r2{};            // k_d speed times 1, x, y, x^2 + y^2
  V in{}, in_x{}, in_y{}, in_xx{}, in_xy{}, in_yy{};  // k_z speed times 1, x, y, xx, xy, yy
  V flap{}, flap_x{}, flap_y{};                       // k_flap speed times 1, x, y
  V spin{};                                           // angular momentum along +Z
  V density{};

  AIRSIM360_LANES UprightDrive(const DroneConstants<T>& c, const RotorInstant<V>& now) : density(now.density) {
    for (int i = 0; i < L::Rotors(c); ++i) AddLoad(c.rotor[i], now.speed[i]);
    if (L::Has(c.has_inflow)) {
      for (int i = 0; i < L::Rotors(c); ++i) AddInflow(c.rotor[i], now.speed[i]);
    }
    if (L::Has(c.has_flapping)) {
      for (int i = 0; i < L::Rotors(c); ++i) AddFlapping(c.rotor[i], now.speed[i]);
    }
    Scale(c, now.ground[0]);
    if (L::Has(c.has_spin)) {
      for (int i = 0; i < L::Rotors(c); ++i) AddSpin(c.rotor[i], now.speed[i], now.target[i]);
    }
  }

  AIRSIM360_LANES Wrench<V> WrenchIn(const DroneConstants<T>& c, const AirMotion<V>& air) const {
    const V turn = air.w_air.z;
    V ux = air.v.x, uy = air.v.y;
    if (L::Has(c.has_height)) ux = ux + air.w_air.y * c.height, uy = uy - air.w_air.x * c.height;
    // H-force, in the plane of the rotors.
    const V fx = turn * drag_y - ux * drag, fy = -(uy * drag + turn * drag_x);
    Wrench<V> out;
    out.force = {fx, fy, thrust};
    out.torque = {roll, pitch, yaw - (turn * drag_r2 + (uy * drag_x - ux * drag_y))};
    if (L::Has(c.has_height)) out.torque.x -= fy * c.height, out.torque.y += fx * c.height;
    if (L::Has(c.has_inflow)) ApplyInflow(air, out);
    if (L::Has(c.has_lift)) ApplyLift(c.lift, ux, uy, turn, out);
    if (L::Has(c.has_flapping)) {
      out.torque.x += uy * flap + turn * flap_x;
      out.torque.y += turn * flap_y - ux * flap;
    }
    if (L::Has(c.has_spin)) {
      out.torque.x -= air.w.y * spin;
      out.torque.y += air.w.x * spin;
    }
    return out;
  }

 private:
  AIRSIM360_LANES void AddLoad(const RotorConstants<T>& r, V speed) {
    const V square = speed * speed, lift = square * r.thrust, k = speed * r.drag;
    const V kx = k * r.p.x, ky = k * r.p.y;
    thrust = thrust + lift;
    roll = roll + lift * r.p.y;
    pitch = pitch - lift * r.p.x;
    yaw = yaw + square * r.torque;
    drag = drag + k;
    drag_x = drag_x + kx;
    drag_y = drag_y + ky;
    drag_r2 = drag_r2 + k * r.p2;
  }
  AIRSIM360_LANES void AddInflow(const RotorConstants<T>& r, V speed) {
    const V k = speed * r.inflow, kx = k * r.p.x, ky = k * r.p.y;
    in = in + k;
    in_x = in_x + kx;
    in_y = in_y + ky;
    in_xx = in_xx + kx * r.p.x;
    in_xy = in_xy + kx * r.p.y;
    in_yy = in_yy + ky * r.p.y;
  }
  AIRSIM360_LANES void AddFlapping(const RotorConstants<T>& r, V speed) {
    const V k = speed * r.flap;
    flap = flap + k;
    flap_x = flap_x + k * r.p.x;
    flap_y = flap_y + k * r.p.y;
  }
  /// Momentum, and the torque that its change takes.
  AIRSIM360_LANES void AddSpin(const RotorConstants<T>& r, V speed, V target) {
    spin = spin + r.spin * speed;
    yaw = yaw - r.spin * SpeedRate(r, speed, target);
  }
  /// Coefficients hold at sea level; nearness of the ground adds to the thrust alone.
  AIRSIM360_LANES void Scale(const DroneConstants<T>& c, V ground) {
    const V k = density * ground;
    thrust = thrust * k, roll = roll * k, pitch = pitch * k;
    yaw = yaw * density;
    drag = drag * density, drag_x = drag_x * density, drag_y = drag_y * density, drag_r2 = drag_r2 * density;
    if (L::Has(c.has_inflow)) {
      in = in * density, in_x = in_x * density, in_y = in_y * density;
      in_xx = in_xx * density, in_xy = in_xy * density, in_yy = in_yy * density;
    }
    if (L::Has(c.has_flapping)) flap = flap * density, flap_x = flap_x * density, flap_y = flap_y * density;
  }
  /// Thrust lost at each hub: k_z speed (v_z + w_x y - w_y x).
  AIRSIM360_LANES void ApplyInflow(const AirMotion<V>& air, Wrench<V>& out) const {
    const Vec3<V> w = air.w_air;
    const V z = air.v.z;
    out.force.z -= z * in + (w.x * in_y - w.y * in_x);
    out.torque.x -= z * in_y + (w.x * in_yy - w.y * in_xy);
    out.torque.y += z * in_x + (w.x * in_xy - w.y * in_xx);
  }
  /// Thrust gained at each hub: k_h ((u_x - w_z y)^2 + (u_y + w_z x)^2).
  AIRSIM360_LANES void ApplyLift(const LiftSums<T>& h, V ux, V uy, V turn, Wrench<V>& out) const {
    const V a = density * (ux * ux + uy * uy), b = density * (turn + turn), d = density * (turn * turn);
    const V bx = b * ux, by = b * uy;
    out.force.z += a * h.one + (by * h.x - bx * h.y) + d * (h.xx + h.yy);
    out.torque.x += a * h.y + (by * h.xy - bx * h.yy) + d * h.yr2;
    out.torque.y -= a * h.x + (by * h.xx - bx * h.xy) + d * h.xr2;
  }
};

/// Rotors in any places and directions, each on its own.
template <class V>
struct TiltedDrive {
  using Layout = AnyLayout;
  using T = ScalarOf<V>;
  V speed[kMaxRotors];   // times the density ratio
  V thrust[kMaxRotors];  // k_f speed^2
  V density;
  Vec3<V> torque, spin;  // reaction and rotor acceleration; angular momentum

  AIRSIM360_LANES TiltedDrive(const DroneConstants<T>& c, const RotorInstant<V>& now) : density(now.density) {
    torque = spin = Broadcast<V>({T(0), T(0), T(0)});
    for (int i = 0; i < c.rotors; ++i) {
      const RotorConstants<T>& r = c.rotor[i];
      const Vec3<V> axis = Broadcast<V>(r.axis);
      const V square = now.speed[i] * now.speed[i];
      speed[i] = now.speed[i] * density;
      thrust[i] = square * r.thrust * density * now.ground[i];
      torque += axis * (square * r.torque * density);
      if (!c.has_spin) continue;
      spin += axis * (r.spin * now.speed[i]);
      torque -= axis * (r.spin * SpeedRate(r, now.speed[i], now.target[i]));
    }
  }

  AIRSIM360_LANES Wrench<V> WrenchIn(const DroneConstants<T>& c, const AirMotion<V>& air) const {
    Wrench<V> out{Broadcast<V>({T(0), T(0), T(0)}), torque};
    for (int i = 0; i < c.rotors; ++i) AddRotor(c.rotor[i], air, i, out);
    if (c.has_spin) out.torque -= Cross(air.w, spin);
    return out;
  }

 private:
  AIRSIM360_LANES void AddRotor(const RotorConstants<T>& r, const AirMotion<V>& air, int i, Wrench<V>& out) const {
    const Vec3<V> p = Broadcast<V>(r.p), axis = Broadcast<V>(r.axis);
    const Vec3<V> hub = air.v + Cross(air.w_air, p);
    const V axial = Dot(hub, axis);
    const Vec3<V> in_plane = hub - axis * axial;
    const V along = thrust[i] - speed[i] * r.inflow * axial + density * r.lift * Dot(in_plane, in_plane);
    const Vec3<V> force = axis * along - in_plane * (speed[i] * r.drag);
    out.force += force;
    out.torque += Cross(p, force) + Cross(hub, axis) * (speed[i] * r.flap);
  }
};

}  // namespace airsim360::internal
