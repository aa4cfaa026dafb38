#include "airsim360/flight/prompt/laws.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {
// The propeller at which the laws are anchored: 5 inches.
constexpr double kReferenceDiameter = 0.127;
constexpr double kMostTorqueShare = 0.179;  // k_m / (k_f D); the gate ends at 0.18
}  // namespace

PropellerCoefficients CoefficientsOf(double pitch_ratio, int blades, double diameter) {
  // The linear fits hold between these ratios.
  const double b = std::clamp(pitch_ratio, 0.3, 0.95);
  PropellerCoefficients c{4.27e-2 + 1.44e-1 * b, -1.48e-3 + 9.72e-2 * b};
  // Three blades give 1.28 times the thrust of two; a factor f of thrust takes f^1.5 of power at one figure
  // of merit. Real propellers stay below C_T 0.215 (those with more solidity stall).
  const double more = std::min(std::pow(blades / 2.0, 0.61), 0.215 / c.thrust);
  c.thrust *= more;
  c.power *= std::pow(more, 1.5);
  // Low Reynolds numbers cost power; the exponent meets the measured Crazyflie propeller (47 mm, k_m / k_f
  // 7.35 mm), the bound keeps smaller ones plausible.
  if (diameter < kReferenceDiameter) c.power *= std::min(std::pow(kReferenceDiameter / diameter, 0.7), 2.2);
  // No measured propeller turns more than this share of its thrust times diameter into torque.
  c.power = std::min(c.power, 2 * kPi * kMostTorqueShare * c.thrust);
  return c;
}

double MotorMass(double torque) { return 1.25 * 14.5e-3 * std::pow(torque / 0.0466, 3 / 3.5); }

double PropellerMass(double diameter, int blades) { return 3.2e-3 * std::pow(diameter / kReferenceDiameter, 2) * blades / 3; }

double RotorLag(double diameter, bool brushed) {
  // 33 ms measured for 5-inch racers (Agilicious, rl-tools), 54 to 65 ms for 12 to 15 inches (X500, FS
  // large): lag ~ diameter^0.5. Brushed 7 mm motors: 72 ms (Eschmann et al. 2024, Crazyflie).
  return brushed ? 0.072 : std::clamp(0.033 * std::sqrt(diameter / kReferenceDiameter), 0.015, 0.12);
}

int CellsFor(double power) {
  const double cells = 1.84 * std::pow(power, 0.36) / kCellVoltage;
  // Packs that are sold.
  int best = 1;
  for (const int sold : {2, 3, 4, 6, 8, 12, 14}) {
    if (std::abs(sold - cells) < std::abs(best - cells)) best = sold;
  }
  return best;
}

int ArmsOf(int count, RotorLayout layout) { return layout == RotorLayout::kCoaxial ? count / 2 : count; }

std::vector<RotorModel> PlaceRotors(int count, RotorLayout layout, double arm, double above) {
  std::vector<RotorModel> rotors;
  const auto add = [&](double x, double y, double direction, double z) {
    RotorModel rotor;
    rotor.p_B = {x * arm, y * arm, z};
    rotor.direction = direction;
    rotors.push_back(rotor);
  };
  if (layout == RotorLayout::kCoaxial && count == 6) {
    // Y6: arms at the front left, the front right and behind; all upper rotors turn alike, all lower ones against.
    for (const double side : {1.0, -1.0}) {
      for (const double angle : {-kPi / 3, kPi, kPi / 3}) add(std::cos(angle), std::sin(angle), side, side * above);
    }
    return rotors;
  }
  if (ArmsOf(count, layout) == 4) {
    // Forward and left reach of an arm of length 1; rotors that face each other turn alike.
    const bool wide = layout == RotorLayout::kWideX, h = layout == RotorLayout::kH;
    const double x = wide ? 0.6 : h ? 0.8 : std::sqrt(0.5), y = wide ? 0.8 : h ? 0.6 : std::sqrt(0.5);
    const bool plus = layout == RotorLayout::kPlus;
    const double places[4][3] = {{x, -y, -1}, {-x, y, -1}, {x, y, 1}, {-x, -y, 1}};
    const double crossed[4][3] = {{1, 0, -1}, {-1, 0, -1}, {0, 1, 1}, {0, -1, 1}};
    for (const auto& p : plus ? crossed : places) add(p[0], p[1], p[2], above);
    if (layout == RotorLayout::kCoaxial) {
      for (const auto& p : places) add(p[0], p[1], -p[2], -above);
    }
    return rotors;
  }
  // Evenly around, turning in turns; X has a gap in front, plus an arm.
  const double first = layout == RotorLayout::kPlus ? 0 : kPi / count;
  for (int i = 0; i < count; ++i) {
    const double angle = -first - 2 * kPi * i / count;
    add(std::cos(angle), std::sin(angle), i % 2 ? 1 : -1, above);
  }
  return rotors;
}

Mat3d CompositeInertia(const std::vector<RotorModel>& rotors, double mass_at_hub, double arms_mass, double box_mass, Vec3d box) {
  // Hubs; a rod from the centre to a hub has a third of its mass there. Coaxial pairs share one rod.
  Vec3d J;
  for (const RotorModel& rotor : rotors) {
    const Vec3d p = rotor.p_B;
    const double m = mass_at_hub + arms_mass / 3 / static_cast<double>(rotors.size());
    J += Vec3d{p.y * p.y + p.z * p.z, p.x * p.x + p.z * p.z, p.x * p.x + p.y * p.y} * m;
  }
  const Vec3d square = box * box;
  J += Vec3d{square.y + square.z, square.x + square.z, square.x + square.y} * (box_mass / 12);
  return {{{{J.x, 0, 0}, {0, J.y, 0}, {0, 0, J.z}}}};
}

}  // namespace airsim360::internal
