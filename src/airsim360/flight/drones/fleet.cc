#include "airsim360/flight/drones/fleet.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/laws.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr int kTries = 1000;

DroneModel Draw(RngStream& rng, const FleetRanges& ranges) {
  DroneModel model;
  const double size = rng.Uniform(std::cbrt(ranges.least_mass), std::cbrt(ranges.most_mass));
  model.mass = size * size * size;
  const double ratio = rng.Uniform(ranges.least_thrust_to_weight, ranges.most_thrust_to_weight);
  constexpr int kCounts[] = {4, 4, 6, 8};
  const int n = ranges.only_quads ? 4 : kCounts[rng.Index(4)];

  // Propellers from a disc loading (40 to 130 N/m^2 of the catalogue), arms from a spacing.
  const double loading = rng.Uniform(40, 130);
  const double D = std::sqrt(4 * model.mass * kGravity / (n * kPi * loading));
  const double arm = rng.Uniform(1.05, 1.5) * D / (2 * std::sin(kPi / n));
  const internal::PropellerCoefficients c = internal::CoefficientsOf(rng.Uniform(0.35, 0.9), 2 + static_cast<int>(rng.Index(2)), D);
  model.rotors = internal::PlaceRotors(n, rng.Chance(0.2) ? RotorLayout::kPlus : RotorLayout::kX, arm, rng.Uniform(0, 0.15) * arm);
  const double rho = kSeaLevelAirDensity, D3 = D * D * D;
  const double k_f = c.thrust * rho * D3 * D / (4 * kPi * kPi) * rng.Uniform(0.9, 1.1);
  const double tau = std::clamp(internal::RotorLag(D, false) * rng.Uniform(0.6, 1.6), 0.005, 0.1);
  const double slower = rng.Uniform(1, 1.5), drag = rng.Uniform(0.5, 1.5);
  const double torque = c.power * D / (2 * kPi * c.thrust) * rng.Uniform(0.85, 1.15);
  for (RotorModel& rotor : model.rotors) {
    rotor.diameter = D;
    rotor.thrust_factor = k_f;
    rotor.torque_ratio = torque;
    rotor.tau_up = tau;
    rotor.tau_down = tau * slower;
    rotor.max_speed = std::sqrt(ratio * model.mass * kGravity / (n * k_f));
    rotor.inertia = internal::PropellerMass(D, 2) * D * D / 12;
    rotor.in_plane_drag = 0.0065 * rho * D3 * drag;
    rotor.inflow = 0.012 * rho * D3 * drag;
  }

  // Inertia by the ratios that real drones have, inside the triangle inequality.
  const double unit = model.mass * arm * arm;
  const double x = unit * rng.Uniform(0.12, 0.3), y = x * rng.Uniform(0.8, 1.25);
  model.inertia_B = {{{{x, 0, 0}, {0, y, 0}, {0, 0, (x + y) * rng.Uniform(0.8, 0.98)}}}};
  model.quadratic_drag_B = Vec3d{0.2, 0.2, 0.4} * (arm * arm * drag);
  model.half_size_B = {arm + D / 2, arm + D / 2, 0.2 * arm};
  return model;
}

}  // namespace

DroneModel SampleDrone(uint64_t seed, uint64_t id, const FleetRanges& ranges) {
  const bool fits = ranges.least_mass > 0 && ranges.most_mass >= ranges.least_mass && ranges.least_thrust_to_weight > 1 &&
                    ranges.most_thrust_to_weight >= ranges.least_thrust_to_weight;
  if (!fits) throw InputError("fleet: ranges of mass and thrust to weight must be positive, the latter above 1");
  RngStream rng(seed, "fleet", id);
  for (int i = 0; i < kTries; ++i) {
    DroneModel model = Draw(rng, ranges);
    if (!GateProblems(model).empty()) continue;
    model.name = "fleet " + std::to_string(seed) + "/" + std::to_string(id);
    return model;
  }
  throw InputError("fleet: no plausible drone lies in these ranges of mass and thrust to weight");
}

}  // namespace airsim360
