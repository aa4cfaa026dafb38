// How far a design leaves what is usual so that all that was said can be met, and what it tells of that.
#include <algorithm>
#include <cmath>

#include "airsim360/flight/prompt/designer.h"

namespace airsim360::internal {
namespace {

constexpr Latitude kUsual;

/// One step of `value` towards `end`; false when it is there.
bool Step(double& value, double factor, double end) {
  if (factor > 1 ? value >= end : value <= end) return false;
  value = factor > 1 ? std::min(value * factor, end) : std::max(value * factor, end);
  return true;
}

}  // namespace

bool Designer::GiveRatio(double least) {
  if (said_.thrust_to_weight || said_.speed || said_.least_speed || ratio_ * 0.93 < least) return false;
  give_.ratio = ratio_ * 0.93;
  return true;
}

/// The said thrust turns the tips too fast: more blades, then more pitch give more of it.
bool Designer::GiveBlades() {
  if (!said_.blades && out_.blades < 3) {
    give_.blades = 3;
  } else if (!said_.pitch && out_.pitch < 0.8 * D_) {
    give_.pitch = 0.8;
  } else {
    return false;
  }
  return true;
}

/// A mass that nobody said. More of it for the body and less for the energy may undo each other: the steps
/// are counted.
bool Designer::GiveOtherMass(double factor, double end) {
  constexpr int kMostSteps = 60;
  return !said_.mass && ++mass_steps_ <= kMostSteps && Step(give_.mass, factor, end);
}

/// Too little mass is left for the body.
bool Designer::GiveMass() {
  const bool timed = HoverTimeAsked() > 0 && EnergySaid() <= 0 && !said_.battery_mass;
  const bool battery = HoverTimeAsked() > 0 || EnergySaid() > 0;
  if (GiveRatio(1.8)) return true;
  if (battery && !said_.battery_mass && Step(give_.specific_energy, 1.08, 200)) return true;
  if (timed && Step(give_.usable, 1.06, 0.97)) return true;
  if (battery && !said_.battery_mass && Step(give_.specific_energy, 1.05, 255)) return true;
  if (timed && Step(give_.efficiency, 1.02, 0.86)) return true;
  if (timed && Step(give_.merit, 0.98, merit_least_)) return true;
  if (timed && !said_.propeller && !said_.arm && Step(give_.loading, 0.93, 22 / kind_.disc_loading)) return true;
  if (GiveOtherMass(1.08, 3)) return true;
  if (GiveRatio(1.5)) return true;
  if (Step(give_.motors, 0.93, 0.5)) return true;
  if (Step(give_.arms, 0.9, 0.5)) return true;
  return Step(give_.body, 0.9, 0.04);
}

/// The said energy does not last for the said time.
bool Designer::GiveEnergy() {
  if (!said_.propeller && !said_.arm && Step(give_.loading, 0.93, 22 / kind_.disc_loading)) return true;
  return GiveOtherMass(0.95, 0.4);
}

void Designer::TellLatitude() {
  const bool times = HoverTimeAsked() > 0;
  if (give_.specific_energy > kUsual.specific_energy && !said_.lithium_ion)
    Decide(Text("the battery is a good one: %.0f Wh/kg instead of 150", give_.specific_energy));
  if (times && (give_.usable > 0.81 || give_.usable < 0.79)) {
    Decide(Text("the time leaves %.0f %% of the charge", std::max(0.0, 100 * (1 - give_.usable))));
  }
  if (give_.efficiency > kUsual.efficiency)
    Decide(Text("motors and speed controllers have an efficiency of %.2f instead of 0.75", give_.efficiency));
  if (give_.merit < 1) Decide(Text("the propellers take %.0f %% less torque than usual", 100 * (1 - give_.merit)));
  if (give_.motors < 1) Decide(Text("the motors weigh %.2f of what is usual", give_.motors));
  if (give_.blades > 2 || give_.pitch > 0)
    Decide(Text("propellers of %d blades and %.2f diameters of pitch, for the thrust", out_.blades, out_.pitch / D_));
  if (give_.arms < 1) Decide(Text("the arms weigh %.2f of what is usual", give_.arms));
  if (speed_held_) Decide("the said top speed is held by its lean: its thrust would carry it faster");
  if (!said_.mass) Decide(Text("the mass was not said: %.4g kg, ", m_) + out_.laws["mass"]);
  if (!said_.rotors && said_.layout != RotorLayout::kCoaxial) Decide("four rotors, for their number was not said");
  if (!said_.drone_class && out_.drone_class == "generic") Decide("no kind was said: the usual of all kinds is taken");
}

}  // namespace airsim360::internal
