#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/gains.h"
#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/designer.h"
#include "airsim360/flight/prompt/laws.h"

namespace airsim360 {
namespace internal {
namespace {
constexpr double kPi = std::numbers::pi;
constexpr double kFastestTip = 0.65 * 340.3;  // m/s; the gate ends at Mach 0.7
// Hover disc loadings of drones that exist, N/m^2: from indoor fliers to heavy-lift racers.
constexpr double kLeastLoading = 8, kMostLoading = 600;
constexpr double kLeastRatio = 1.5;  // thrust to weight that is not gone below unasked

}  // namespace

std::string Text(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

DroneDesign Designer::Run() {
  ChooseClass();
  ChooseRotors();
  ChooseSize();
  ChooseArms();
  ChoosePropeller();
  ChooseThrust();
  // Motors for much thrust may leave no mass for the rest: unless it was asked for, less thrust will do.
  while (!Weigh()) {
    if (said_.thrust_to_weight || said_.speed || ratio_ * 0.93 < kLeastRatio) RefuseWeights();
    SetThrust(ratio_ * 0.93, law_of_thrust_ + ", lowered to leave mass for the body");
  }
  Finish();
  return std::move(out_);
}

const std::string& Designer::Words(const char* field) const { return said_.words.at(field); }

void Designer::Law(const char* parameter, std::string law) { out_.laws[parameter] = std::move(law); }

std::string Designer::Said(const char* field) const { return "said: '" + Words(field) + "'"; }

void Designer::Refuse(const std::string& why) { throw InputError("no drone fits the description: " + why); }

void Designer::ChooseClass() {
  std::string name = "generic";
  std::string law = "no kind was said";
  if (said_.drone_class) {
    name = *said_.drone_class;
    law = Said("drone_class");
  } else if (said_.propeller.value_or(1) < 0.07 || said_.mass.value_or(1) < 0.06) {
    name = "nano";
    law = "as small as a nano drone";
  } else if (said_.blades.value_or(2) >= 3 && said_.propeller.value_or(1) < 0.2) {
    name = "freestyle";
    law = "three blades below 8 inches";
  }
  kind_ = FindDroneClass(name);
  guarded_ = kind_.guarded || said_.guarded;
  out_.drone_class = name;
  out_.prompt = said_.prompt;
  Law("drone_class", law);
}

void Designer::ChooseRotors() {
  layout_ = said_.layout.value_or(RotorLayout::kX);
  const bool coaxial = layout_ == RotorLayout::kCoaxial;
  n_ = static_cast<int>(said_.rotors.value_or(coaxial ? 8 : 4));
  // "coaxial quad" means four arms.
  if (coaxial && n_ == 4) n_ = 8;
  if (coaxial && n_ != 8) {
    Refuse("'" + Words("rotors") + "' contradicts '" + Words("layout") + "': coaxial pairs sit on four arms");
  }
  const bool quad_only = layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX;
  if (quad_only && n_ != 4) {
    Refuse("'" + Words("layout") + "' is a layout of four rotors, '" + Words("rotors") + "' are " +
           std::to_string(n_));
  }
  Law("rotors", said_.rotors ? Said("rotors") : coaxial ? "coaxial pairs on four arms" : "four unless said");
}

double Designer::Disc(double diameter) const { return n_ * kPi * diameter * diameter / 4; }

void Designer::ChooseSize() {
  const double loading = kind_.disc_loading;
  const bool arm_only = said_.arm && !said_.propeller;
  if (said_.propeller) {
    D_ = *said_.propeller;
    Law("diameter", Said("propeller"));
  } else if (arm_only) {
    D_ = *said_.arm * 2 * std::sin(kPi / ArmsOf(n_, layout_)) / kind_.spacing;
    Law("diameter",
        Text("neighbouring hubs %.2f diameters apart (%s)", kind_.spacing, out_.drone_class.c_str()));
  }
  if (said_.mass) {
    m_ = *said_.mass;
    Law("mass", Said("mass"));
  } else if (D_ > 0) {
    m_ = loading * Disc(D_) / kGravity;
    Law("mass", Text("disc loading %g N/m^2 (%s)", loading, out_.drone_class.c_str()));
  } else if (said_.payload) {
    m_ = *said_.payload / 0.3;
    Law("mass", "payload / 0.3");
  } else {
    m_ = kind_.mass * SizeFactor();
    Law("mass", "usual for " + out_.drone_class + (said_.size ? ", " + Words("size") : ""));
  }
  if (D_ <= 0) {
    D_ = std::sqrt(4 * m_ * kGravity / (n_ * kPi * loading));
    Law("diameter", Text("disc loading %g N/m^2 (%s)", loading, out_.drone_class.c_str()));
  }
  CheckSize();
}

double Designer::SizeFactor() const {
  if (!said_.size) return 1;
  const std::string& size = *said_.size;
  return size == "tiny" ? 0.25 : size == "small" ? 0.5 : size == "large" ? 2 : size == "huge" ? 4 : 1;
}

void Designer::CheckSize() const {
  const double loading = m_ * kGravity / Disc(D_);
  if (loading < kLeastLoading || loading > kMostLoading) {
    const std::string size = said_.propeller ? "'" + Words("propeller") + "'"
                             : said_.arm     ? "'" + Words("arm") + "'"
                                             : "its propellers";
    const std::string mass = said_.mass ? "'" + Words("mass") + "'" : Text("%.3g kg", m_);
    Refuse(mass + " contradicts " + size +
           Text(": %d propellers of %.0f mm would carry %.3g N per square metre of disc, "
                "where drones have %g to %g",
                n_, D_ * 1000, loading, kLeastLoading, kMostLoading));
  }
  if (said_.payload && *said_.payload > 0.6 * m_) {
    Refuse("the payload '" + Words("payload") + "' is too much of " +
           (said_.mass ? "'" + Words("mass") + "'" : Text("%.3g kg", m_)) + " in all (at most 60 %)");
  }
  if (!said_.size) return;
  const std::string& size = *said_.size;
  const bool fits = size == "tiny"    ? m_ < 0.5
                    : size == "small" ? m_ < 5
                    : size == "large" ? m_ > 0.5
                    : size == "huge"  ? m_ > 3
                                      : true;
  if (!fits)
    Refuse("'" + Words("size") + Text("' contradicts a mass of %.3g kg", m_) +
           (said_.mass ? " ('" + Words("mass") + "')" : ""));
}

void Designer::ChooseArms() {
  const int arms = ArmsOf(n_, layout_);
  // Distance of neighbouring hubs over arm length; H and wide X have their shorter side in between.
  const double gap =
      layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX ? 1.2 : 2 * std::sin(kPi / arms);
  L_ = said_.arm.value_or(D_ * kind_.spacing / gap);
  Law("arm", said_.arm ? Said("arm")
                       : Text("neighbouring hubs %.2f diameters apart (%s)", kind_.spacing,
                              out_.drone_class.c_str()));
  if (L_ * gap < 1.02 * D_) {
    Refuse(Text("propellers of %.0f mm overlap on arms of %.0f mm", D_ * 1000, L_ * 1000) +
           (said_.propeller && said_.arm ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'"
                                         : ""));
  }
  if (L_ * gap > 6 * D_) {
    Refuse(Text("arms of %.0f mm are out of proportion to propellers of %.0f mm", L_ * 1000, D_ * 1000) +
           (said_.propeller && said_.arm ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'"
                                         : ""));
  }
}

void Designer::ChoosePropeller() {
  out_.blades = static_cast<int>(said_.blades.value_or(kind_.blades));
  out_.pitch = said_.pitch.value_or(kind_.pitch_ratio * D_);
  const double b = out_.pitch / D_;
  if (b < 0.15 || b > 1.3) {
    Refuse(Text("a pitch of %.0f mm contradicts a diameter of %.0f mm", out_.pitch * 1000, D_ * 1000) +
           " ('" + Words("pitch") + "'): propellers have 0.15 to 1.3 diameters");
  }
  const PropellerCoefficients c = CoefficientsOf(b, out_.blades, D_);
  k_f_ = c.thrust * kSeaLevelAirDensity * std::pow(D_, 4) / (4 * kPi * kPi);
  ratio_km_ = c.power * D_ / (2 * kPi * c.thrust);
  Law("pitch",
      said_.pitch ? Said("pitch") : Text("%.2f diameters (%s)", kind_.pitch_ratio, out_.drone_class.c_str()));
  Law("blades", said_.blades ? Said("blades") : "usual for " + out_.drone_class);
  Law("thrust_factor", Text("C_T = 0.0427 + 0.144 pitch/D (Budinger 2020), (blades/2)^0.61: C_T %.4f; k_f "
                            "= C_T rho D^4 / (2 pi)^2",
                            c.thrust));
  Law("torque_ratio",
      Text("C_P = -0.00148 + 0.0972 pitch/D (Budinger 2020): C_P %.4f; k_m / k_f = C_P D / (2 pi C_T)",
           c.power));
}

void Designer::SetThrust(double ratio, const std::string& law) {
  ratio_ = ratio;
  law_of_thrust_ = law;
  thrust_ = ratio * m_ * kGravity / n_;
  speed_ = std::sqrt(thrust_ / k_f_);
  Law("max_speed", law + Text(": %.2f N a rotor, speed = sqrt(T / k_f)", thrust_));
}

void Designer::ChooseThrust() {
  if (said_.thrust_to_weight) {
    SetThrust(*said_.thrust_to_weight, Said("thrust_to_weight"));
  } else {
    SetThrust(kind_.thrust_to_weight,
              Text("thrust to weight %.1f (%s)", kind_.thrust_to_weight, out_.drone_class.c_str()));
    // Motors that belong to the propeller rather than to the weight.
    const double matched = kind_.full_disc_loading * kPi * D_ * D_ / 4 * n_ / (m_ * kGravity);
    if (matched > ratio_)
      SetThrust(matched,
                Text("motors matched to the propeller, %g N/m^2 at full throttle", kind_.full_disc_loading));
    if (ratio_ > 14) SetThrust(14, "thrust to weight at most 14");
  }
  // Tips stay subsonic.
  const double most = std::pow(2 * kFastestTip / D_, 2) * k_f_ * n_ / (m_ * kGravity);
  if (ratio_ > most) {
    if (said_.thrust_to_weight || most < kLeastRatio) {
      Refuse(Text("%d propellers of %.0f mm at Mach 0.65 of their tips give %.2f times the weight of %.3g kg",
                  n_, D_ * 1000, most, m_) +
             (said_.thrust_to_weight ? ", not " + Words("thrust_to_weight") : ""));
    }
    SetThrust(most, "as much as tips at Mach 0.65 give");
  }
  most_ratio_ = std::min(most, 14.0);
  ReachSpeed();
}

double Designer::LevelSpeed() const {
  DroneModel model = Aerodynamics();
  const double tilt = std::min(std::acos(std::min(1.0, 1 / (0.95 * ratio_))), 1.3);
  return LevelSpeedAtTilt(model, tilt);
}

void Designer::ReachSpeed() {
  if (!said_.speed) return;
  while (LevelSpeed() < *said_.speed) {
    if (said_.thrust_to_weight || ratio_ * 1.05 > most_ratio_) {
      Refuse("'" + Words("speed") + "' contradicts " +
             (said_.thrust_to_weight ? "'" + Words("thrust_to_weight") + "'"
                                     : Text("a thrust of %.1f times the weight", ratio_)) +
             Text(": level flight ends at %.1f m/s", LevelSpeed()));
    }
    SetThrust(ratio_ * 1.05, "raised until level flight reaches " + Words("speed"));
  }
}

}  // namespace internal

DroneDesign DesignDrone(const DroneRequest& request) { return internal::Designer(request).Run(); }
DroneDesign DroneFromPrompt(std::string_view prompt) { return DesignDrone(ParsePrompt(prompt)); }

}  // namespace airsim360
