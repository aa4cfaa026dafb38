// Inside DesignDrone: one drone being worked out, step by step.
#pragma once

#include <string>

#include "airsim360/flight/prompt/design.h"

namespace airsim360::internal {

/// printf into a string.
std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));

class Designer {
 public:
  explicit Designer(const DroneRequest& request) : said_(request) {}
  DroneDesign Run();

 private:
  const std::string& Words(const char* field) const;
  void Law(const char* parameter, std::string law);
  std::string Said(const char* field) const;
  [[noreturn]] static void Refuse(const std::string& why);
  void ChooseClass();
  void ChooseRotors();
  double Disc(double diameter) const;
  /// Mass and propeller diameter.
  void ChooseSize();
  double SizeFactor() const;
  void CheckSize() const;
  void ChooseArms();
  void ChoosePropeller();
  void SetThrust(double ratio, const std::string& law);
  void ChooseThrust();
  double LevelSpeed() const;
  void ReachSpeed();
  Vec3d Box() const;
  /// Rotors and drag: all that speed depends on.
  DroneModel Aerodynamics() const;
  double HoverPower() const;
  double IdlePower() const;
  /// Distributes the mass; false when too little is left for the body.
  bool Weigh();
  double BatteryMass() const;
  int Cells() const;
  [[noreturn]] void RefuseWeights() const;
  void Finish();
  void FillBattery();
  void FillLaws();

  const DroneRequest& said_;
  DroneDesign out_;
  DroneClass kind_{};
  RotorLayout layout_ = RotorLayout::kX;
  int n_ = 4;
  bool guarded_ = false;
  double m_ = 0, D_ = 0, L_ = 0, k_f_ = 0, ratio_km_ = 0, ratio_ = 0, most_ratio_ = 14, thrust_ = 0,
         speed_ = 0;
  std::string law_of_thrust_;
};

}  // namespace airsim360::internal
