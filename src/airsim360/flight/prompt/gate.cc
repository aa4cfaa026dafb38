#include "airsim360/flight/prompt/gate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/laws.h"

namespace airsim360 {
namespace {

constexpr double kSpeedOfSound = 340.3;  // m/s, ISA sea level
// Below this diameter blades work at Reynolds numbers of some 10^4, with much lower figures of merit: the
// measured Crazyflie propeller (47 mm) has 0.31.
constexpr double kSmallPropeller = 0.12;

class Gate {
 public:
  void Range(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    char text[160];
    std::snprintf(text, sizeof(text), "%s %.3g is not in %g ... %g", what, value, low, high);
    problems_.push_back(text);
  }
  void Require(bool holds, const char* problem) {
    if (!holds) problems_.push_back(problem);
  }
  std::vector<std::string> Take() { return std::move(problems_); }

 private:
  std::vector<std::string> problems_;
};

/// Positive definite, and a mass distribution exists for it: no principal moment above the sum of the others.
void CheckInertia(const DroneModel& model, Gate& gate) {
  const auto& J = model.inertia_B.m;
  const double xy = J[0][0] * J[1][1] - J[0][1] * J[1][0];
  gate.Require(J[0][0] > 0 && xy > 0 && model.inertia_B.determinant() > 0, "inertia is not positive definite");
  const double trace = J[0][0] + J[1][1] + J[2][2];
  // trace / 2 - J >= 0 is that condition in any axes; for a diagonal J it reads entry by entry.
  Mat3d second;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) second.m[i][k] = (i == k ? trace / 2 : 0) - J[i][k];
  }
  const auto& S = second.m;
  const bool body = S[0][0] >= 0 && S[1][1] >= 0 && S[2][2] >= 0 && S[0][0] * S[1][1] >= S[0][1] * S[1][0] && second.determinant() >= 0;
  gate.Require(body, "inertia breaks the triangle inequality: no body has it");
}

}  // namespace

DroneFigures FiguresOf(const DroneModel& model) {
  DroneFigures figures;
  if (model.rotors.empty()) return figures;
  const RotorModel& rotor = model.rotors[0];
  const double pi = std::numbers::pi, D = rotor.diameter, rho = kSeaLevelAirDensity;
  const double per_turn = 4 * pi * pi / (rho * std::pow(D, 4));
  figures.thrust_coefficient = rotor.thrust_factor * per_turn;
  figures.torque_share = rotor.torque_ratio / D;
  const double power_coefficient = 2 * pi * figures.torque_share * figures.thrust_coefficient;
  figures.figure_of_merit = std::sqrt(2 / pi) * std::pow(figures.thrust_coefficient, 1.5) / power_coefficient;
  figures.max_thrust = MaxThrust(model);
  figures.thrust_to_weight = figures.max_thrust / (model.mass * kGravity);
  figures.hover_speed = HoverSpeed(model);
  figures.spacing = 1e9;
  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const RotorModel& a = model.rotors[i];
    figures.tip_mach = std::max(figures.tip_mach, a.max_speed * a.diameter / 2 / kSpeedOfSound);
    figures.hover_shaft_power += a.thrust_factor * a.torque_ratio * std::pow(figures.hover_speed, 3);
    for (size_t k = 0; k < i; ++k) {
      const RotorModel& b = model.rotors[k];
      const double apart = std::hypot(a.p_B.x - b.p_B.x, a.p_B.y - b.p_B.y);
      const double diameter = (a.diameter + b.diameter) / 2, spacing = apart / diameter;
      // At two heights they may overlap in part.
      const bool staggered = std::abs(a.p_B.z - b.p_B.z) >= 0.99 * internal::kStagger * diameter && spacing >= internal::kLeastStaggered;
      if (apart > 1e-6 && !staggered) figures.spacing = std::min(figures.spacing, spacing);
    }
  }
  return figures;
}

std::vector<std::string> GateProblems(const DroneModel& model) {
  Gate gate;
  const DroneFigures figures = FiguresOf(model);
  gate.Require(model.rotors.size() >= 4, "fewer than 4 rotors");
  gate.Range("C_T", figures.thrust_coefficient, 0.06, 0.22);
  gate.Range("k_m / (k_f D)", figures.torque_share, 0.05, 0.18);
  const bool small = !model.rotors.empty() && model.rotors[0].diameter < kSmallPropeller;
  gate.Range("figure of merit", figures.figure_of_merit, small ? 0.25 : 0.4, 0.8);
  gate.Range("tip Mach", figures.tip_mach, 0, 0.7);
  gate.Range("thrust to weight", figures.thrust_to_weight, 1.3, 15);
  gate.Range("rotor spacing / diameter", figures.spacing, 1 - 1e-6, 20);
  for (const RotorModel& rotor : model.rotors) {
    gate.Range("rotor lag", rotor.tau_up, 0.005, 0.15);
    gate.Range("rotor lag", rotor.tau_down, 0.005, 0.15);
  }
  CheckInertia(model, gate);
  std::vector<std::string> problems = gate.Take();
  problems.erase(std::unique(problems.begin(), problems.end()), problems.end());
  return problems;
}

}  // namespace airsim360
