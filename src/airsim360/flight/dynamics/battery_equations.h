// The battery: voltage under load, the speed it allows the rotors, and its charge. docs/internals/flight.md.
#pragma once

#include "airsim360/flight/drone_constants.h"
#include "airsim360/flight/dynamics/lane_math.h"

namespace airsim360::internal {

template <class V>
struct BatteryLoad {
  V voltage;       ///< at the terminals
  V current;       ///< ampere
  V speed_factor;  ///< of the rotors' max_speed: voltage / full voltage, 0 when empty
};

/// e^x for -1.1 < x <= 0, raised to the 32nd power: Taylor's series to degree 8, relative error 2e-4.
template <class V>
AIRSIM360_LANES V ExpOf32(V x) {
  using T = ScalarOf<V>;
  V sum = V(T(1));
  for (int n = 8; n > 0; --n) sum = V(T(1)) + sum * x * V(T(1.0 / n));
  for (int i = 0; i < 5; ++i) sum = sum * sum;
  return sum;
}

/// Open-circuit voltage of a lithium polymer cell by its charge (Chen and Rincon-Mora, "Accurate electrical
/// battery model capable of predicting runtime and I-V performance", IEEE Trans. Energy Conv. 21(2), 2006,
/// eq. 2): 4.10 V full, 2.65 V empty.
template <class V>
AIRSIM360_LANES V CellVoltage(V charge) {
  using T = ScalarOf<V>;
  const V polynomial = V(T(3.685)) + charge * (V(T(0.2156)) + charge * (V(T(-0.1178)) + charge * V(T(0.3201))));
  return polynomial - V(T(1.031)) * ExpOf32(charge * V(T(-35.0 / 32)));
}
inline constexpr double kFullCellVoltage = 3.685 + 0.2156 - 0.1178 + 0.3201;

/// Constant-power load P = U I on a source of resistance R: I = (U0 - sqrt(U0^2 - 4 R P)) / 2 R, written so
/// that R = 0 is allowed. More power than the source can give is cut to what it can.
template <class V, class T = ScalarOf<V>>
AIRSIM360_LANES BatteryLoad<V> LoadBattery(const DroneConstants<T>& c, V density, const V* speed, V charge) {
  V shaft = V(T(0));
  for (int i = 0; i < c.rotors; ++i) {
    shaft = shaft + speed[i] * speed[i] * (speed[i] * c.rotor[i].power);
  }
  const V power = shaft * density * c.inverse_efficiency + c.idle_power;
  const V open = CellVoltage(charge) * c.cells;
  // What the load asks of open^2; above it, the source gives its most, open^2 / 4 R, and the rotors get
  // slower.
  const V most = open * open, asked = power * V(T(4) * c.resistance);
  const V given = Select(asked > most, most / asked, V(T(1)));
  const V rest = most - asked;
  BatteryLoad<V> load;
  load.voltage = (open + SquareRoot(Select(rest > V(T(0)), rest, V(T(0))))) * V(T(0.5));
  load.current = power * given / load.voltage;
  load.speed_factor = Select(charge > V(T(0)), given * load.voltage / V(c.cells * T(kFullCellVoltage)), V(T(0)));
  return load;
}

}  // namespace airsim360::internal
