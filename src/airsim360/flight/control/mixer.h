// From a wanted torque and thrust to the thrust of each rotor, for any layout, within what the rotors can do.
#pragma once

#include <array>
#include <cstdint>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

using RotorValues = std::array<double, kMaxRotors>;

/// Rotors idle rather than stop in flight: a share of their top speed.
inline constexpr double kIdleShare = 0.05;

/// Torque about the axes of B (N m) and collective thrust along +Z of B (N).
struct RotorWrench {
  Vec3d torque_B;
  double thrust = 0;
};

/// Static thrust of each rotor (k_f speed^2 at the density in use) that gives a wrench.
class Mixer {
 public:
  /// `failed`: bit i set = rotor i gives nothing and is left out. With fewer than four independent rotors yaw
  /// is given up first.
  explicit Mixer(const DroneModel& model, uint64_t failed = 0);

  struct Result {
    RotorValues thrust{};
    bool saturated = false;  ///< the wrench could not be given in full
  };
  /// With room for it, the thrusts of least weighted squares that give exactly `wanted` (each rotor weighted
  /// by its strength). Else: roll and pitch come first (scaled down together only when the rotors' whole
  /// range is too small), then the thrust as near as possible to the wanted one, then as much yaw as fits.
  Result Allocate(const RotorWrench& wanted, double density_ratio = 1) const;

  /// What thrusts give.
  RotorWrench WrenchOf(const RotorValues& thrust) const;
  bool has_yaw() const { return has_yaw_; }
  bool usable() const { return usable_; }  ///< roll, pitch and thrust can all be given
  int rotors() const { return n_; }
  double max_thrust(int i) const { return max_[i]; }  ///< N at sea level, 0 when failed

 private:
  struct Row {
    double roll, pitch, yaw, thrust;
  };
  RotorValues TiltAndThrust(const RotorWrench& wanted, const RotorValues& low, const RotorValues& high) const;
  void AddYaw(double yaw_torque, const RotorValues& low, const RotorValues& high, RotorValues& thrust) const;
  bool Invert(bool with_yaw, std::array<Row, kMaxRotors>& inverse) const;

  int n_ = 0;
  bool has_yaw_ = false, usable_ = false;
  RotorValues max_{}, min_{};
  std::array<Row, kMaxRotors> effect_{};   ///< wrench per newton of a rotor
  std::array<Row, kMaxRotors> inverse_{};  ///< newtons of a rotor per unit of the wrench
  std::array<Row, kMaxRotors> loose_{};    ///< the same with whatever yaw results
};

/// Largest static thrust of all rotors, N at sea level.
double MaxThrust(const DroneModel& model);
/// Speed of rotor i for a static thrust (N) and back.
double SpeedForThrust(const RotorModel& rotor, double thrust, double density_ratio = 1);
double ThrustAtSpeed(const RotorModel& rotor, double speed, double density_ratio = 1);

}  // namespace airsim360
