// Inside DesignDrone: one drone being worked out, step by step.
#pragma once

#include <string>

#include "airsim360/flight/prompt/design.h"

namespace airsim360::internal {

/// printf into a string.
std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// What is usual, and how far it was left so that all that was said can be met.
struct Latitude {
  double loading = 1;            ///< disc loading / that of the kind
  double mass = 1;               ///< mass / the usual one
  double ratio = 14;             ///< thrust to weight at most
  double specific_energy = 150;  ///< W h/kg of the battery
  double usable = 0.8;           ///< share of the charge that is flown
  double efficiency = 0.75;      ///< of motors and speed controllers
  double merit = 1;              ///< torque of the propellers / that of the law
  double motors = 1;             ///< motor mass / that of the law and the kind
  double arms = 1;               ///< arm mass / that of the kind
  double body = 0.06;            ///< least share of the mass for plate, wiring, electronics
  int blades = 2;                ///< of the propellers, at least
  double pitch = 0;              ///< of the propellers / diameter, at least
};

class Designer {
 public:
  explicit Designer(const DroneRequest& request) : said_(request) {}
  DroneDesign Run();

 private:
  const std::string& Words(const char* field) const;
  std::string WordsOr(const char* field, const std::string& otherwise) const;
  void Law(const char* parameter, std::string law);
  void Decide(const std::string& sentence);
  std::string Said(const char* field) const;
  [[noreturn]] static void Refuse(const std::string& why);
  void ChooseClass();
  void ChooseRotors();
  double Disc(double diameter) const;
  /// Mass and propeller diameter.
  void ChooseSize();
  void ChooseMass();
  double SizeFactor() const;
  void CheckSize() const;
  void ChooseArms();
  void ChoosePropeller();

  // design_thrust.cc
  void SetThrust(double ratio, const std::string& law);
  void ChooseThrust();
  void HoldToMotors();
  double LevelSpeed() const;
  double LargestLean() const;
  void ReachSpeed();
  void FitDrag(double speed);

  // design_mass.cc
  Vec3d Box() const;
  /// Rotors and drag: all that speed depends on.
  DroneModel Aerodynamics() const;
  /// Distributes the mass; false when too little is left for the body.
  bool Weigh();
  double BatteryMass() const;
  [[noreturn]] void RefuseWeights() const;
  void Finish();
  void FillLaws();

  // design_energy.cc
  double HoverPower() const;
  double IdlePower() const;
  /// Seconds of hovering that were asked for, 0 = none.
  double HoverTimeAsked() const;
  /// Watt hours that were said, 0 = none.
  double EnergySaid() const;
  /// Makes said energy and said time meet; false when the energy is too small.
  bool MatchEnergy();
  int Cells() const;
  void CheckBatterySaid() const;
  void FillBattery();
  [[noreturn]] void RefuseEnergy() const;
  /// The said altitude and range against thrust and energy.
  void CheckJourney() const;

  // design_latitude.cc
  /// Leaves what is usual one step further; false at the end of what is possible.
  bool GiveMass();
  bool GiveEnergy();
  bool GiveRatio(double least);
  bool GiveBlades();
  bool GiveOtherMass(double factor, double end);
  void TellLatitude();

  const DroneRequest& said_;
  DroneDesign out_;
  DroneClass kind_{};
  Latitude give_;
  RotorLayout layout_ = RotorLayout::kX;
  int n_ = 4, mass_steps_ = 0;
  bool guarded_ = false, speed_held_ = false;
  bool stagger_ = false;  ///< neighbouring propellers at two heights
  double m_ = 0, D_ = 0, L_ = 0, k_f_ = 0, ratio_km_ = 0, merit_least_ = 1, ratio_ = 0, most_ratio_ = 14, thrust_ = 0, speed_ = 0,
         drag_ = 1;
  std::string law_of_thrust_;
};

}  // namespace airsim360::internal
