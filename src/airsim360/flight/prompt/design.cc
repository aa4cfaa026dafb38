#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/gains.h"
#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/designer.h"
#include "airsim360/flight/prompt/laws.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace internal {
namespace {
// Hover disc loadings of drones that exist, N/m^2: from indoor fliers to heavy-lift racers.
constexpr double kLeastLoading = 8, kMostLoading = 600;
constexpr double kLeastGap = 1;  // of neighbouring hubs over the diameter: the discs touch

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
  CheckBatterySaid();
  if (said_.lithium_ion) give_.specific_energy = 220;
  for (;;) {
    ChooseSize();
    ChooseArms();
    ChoosePropeller();
    ChooseThrust();
    if (!MatchEnergy()) {
      if (!GiveEnergy()) RefuseEnergy();
    } else if (Weigh()) {
      break;
    } else if (!GiveMass()) {
      RefuseWeights();
    }
  }
  Finish();
  return std::move(out_);
}

const std::string& Designer::Words(const char* field) const { return said_.words.at(field); }

std::string Designer::WordsOr(const char* field, const std::string& otherwise) const {
  const auto found = said_.words.find(field);
  return found == said_.words.end() ? otherwise : "'" + found->second + "'";
}

void Designer::Decide(const std::string& sentence) { out_.decided.push_back(sentence); }

void Designer::Law(const char* parameter, std::string law) { out_.laws[parameter] = std::move(law); }

std::string Designer::Said(const char* field) const {
  return (said_.facts.count(field) ? "known of " : "said: ") + ("'" + Words(field) + "'");
}

void Designer::Refuse(const std::string& why) { throw InputError("no drone fits the description: " + why); }

void Designer::ChooseClass() {
  std::string name = "generic";
  std::string law = "no kind was said";
  if (said_.drone_class) {
    name = *said_.drone_class;
    law = Said("drone_class");
  } else if (said_.propeller.value_or(1) < 0.07 || said_.mass.value_or(1) < 0.06) {
    name = said_.cells.value_or(1) > 1 || said_.motor_kv || said_.brushless ? "nano_brushless" : "nano";
    law = "as small as a nano drone";
  } else if (said_.thrust_to_weight.value_or(0) >= 4 && said_.propeller.value_or(1) < 0.2) {
    name = "freestyle";
    law = "thrust to weight of 4 and more, below 8 inches";
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
  if (coaxial && n_ == 6) Decide("six coaxial rotors sit on three arms, as a Y6");
  if (coaxial && n_ % 2 == 1) Refuse("'" + Words("rotors") + "' are no coaxial pairs");
  if (n_ % 2 == 1) Decide("an odd number of rotors: their torques cancel at unequal thrusts");
  const bool quad_only = layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX;
  if (quad_only && n_ != 4) {
    Refuse("'" + Words("layout") + "' is a layout of four rotors, '" + Words("rotors") + "' are " + std::to_string(n_));
  }
  Law("rotors", said_.rotors ? Said("rotors") : coaxial ? "coaxial pairs on four arms" : "four unless said");
}

double Designer::Disc(double diameter) const { return n_ * kPi * diameter * diameter / 4; }

void Designer::ChooseSize() {
  const double loading = kind_.disc_loading * give_.loading;
  D_ = 0;
  if (said_.propeller) {
    D_ = *said_.propeller;
    Law("diameter", Said("propeller"));
  } else if (said_.arm) {
    D_ = *said_.arm * 2 * std::sin(kPi / ArmsOf(n_, layout_)) / kind_.spacing;
    Law("diameter", Text("neighbouring hubs %.2f diameters apart (%s)", kind_.spacing, out_.drone_class.c_str()));
  }
  ChooseMass();
  if (D_ <= 0) {
    D_ = std::sqrt(4 * m_ * kGravity / (n_ * kPi * loading));
    Law("diameter", Text("disc loading %.3g N/m^2 (%s)", loading, out_.drone_class.c_str()));
  }
  CheckSize();
}

void Designer::ChooseMass() {
  if (said_.mass) {
    m_ = *said_.mass;
    Law("mass", Said("mass"));
    return;
  }
  const double loading = kind_.disc_loading;
  const double energy = EnergySaid();
  if (said_.bare_mass) {
    const double payload = said_.payload.value_or(0);
    const double usual = *said_.bare_mass * kind_.battery_share / (1 - kind_.battery_share);
    m_ = *said_.bare_mass + payload + (energy > 0 ? energy / give_.specific_energy : usual);
    Law("mass", Said("bare_mass") + ", with battery and payload");
    return;
  }
  if (D_ > 0) {
    m_ = loading * Disc(D_) / kGravity;
    Law("mass", Text("disc loading %g N/m^2 (%s)", loading, out_.drone_class.c_str()));
    if (said_.payload && m_ < *said_.payload / 0.45) {
      m_ = *said_.payload / 0.45;
      Law("mass", "payload / 0.45");
    }
  } else if (said_.payload && !said_.facts.count("payload")) {
    m_ = *said_.payload / 0.3;
    Law("mass", "payload / 0.3");
  } else if (energy > 0 && !said_.size) {
    m_ = energy / give_.specific_energy / kind_.battery_share + said_.payload.value_or(0);
    Law("mass", Text("battery / %.2f (%s)", kind_.battery_share, out_.drone_class.c_str()));
  } else {
    m_ = kind_.mass * SizeFactor() + said_.payload.value_or(0);
    Law("mass", "usual for " + out_.drone_class + (said_.size ? ", " + Words("size") : ""));
  }
  m_ *= give_.mass;
}

double Designer::SizeFactor() const {
  if (!said_.size) return 1;
  const std::string& size = *said_.size;
  return size == "tiny" ? 0.25 : size == "small" ? 0.5 : size == "large" ? 2 : size == "huge" ? 4 : 1;
}

void Designer::CheckSize() const {
  const double loading = m_ * kGravity / Disc(D_);
  if (loading < kLeastLoading || loading > kMostLoading) {
    const std::string size = said_.propeller ? "'" + Words("propeller") + "'" : said_.arm ? "'" + Words("arm") + "'" : "its propellers";
    const std::string mass = said_.mass ? "'" + Words("mass") + "'" : Text("%.3g kg", m_);
    Refuse(mass + " contradicts " + size +
           Text(": %d propellers of %.0f mm would carry %.3g N per square metre of disc, "
                "where drones have %g to %g",
                n_, D_ * 1000, loading, kLeastLoading, kMostLoading));
  }
  if (said_.payload && *said_.payload > 0.6 * m_) {
    Refuse("the payload '" + Words("payload") + "' is too much of " + (said_.mass ? "'" + Words("mass") + "'" : Text("%.3g kg", m_)) +
           " in all (at most 60 %)");
  }
  if (!said_.size || !said_.mass) return;
  const std::string& size = *said_.size;
  const bool fits = size == "tiny" ? m_ < 5 : size == "small" ? m_ < 30 : size == "large" ? m_ > 0.08 : size == "huge" ? m_ > 0.5 : true;
  if (!fits) Refuse("'" + Words("size") + Text("' contradicts a mass of %.3g kg", m_) + " ('" + Words("mass") + "')");
}

void Designer::ChooseArms() {
  const int arms = ArmsOf(n_, layout_);
  // Where the longer sides of an H or a wide X leave the propellers no room, its motors stand in a square.
  const bool oblong = layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX;
  if (oblong && said_.arm && *said_.arm * 1.2 < kLeastGap * D_ && *said_.arm * 2 * std::sin(kPi / 4) >= kLeastGap * D_) {
    layout_ = RotorLayout::kX;
    Decide("the motors of the frame stand in a square, for the propellers to have room");
  }
  // Distance of neighbouring hubs over arm length; H and wide X have their shorter side in between.
  const double gap = layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX ? 1.2 : 2 * std::sin(kPi / arms);
  L_ = said_.arm.value_or(D_ * kind_.spacing / gap);
  Law("arm", said_.arm ? Said("arm") : Text("neighbouring hubs %.2f diameters apart (%s)", kind_.spacing, out_.drone_class.c_str()));
  const bool told = stagger_;
  stagger_ = n_ % 2 == 0 && layout_ != RotorLayout::kCoaxial && L_ * gap < kLeastGap * D_ && L_ * gap >= kLeastStaggered * D_;
  if (stagger_ && !told) {
    Decide(
        Text("neighbouring propellers overlap by %.0f %% of their diameter: they stand at two heights, and no loss of thrust is reckoned",
             100 * (1 - L_ * gap / D_)));
  } else if (!stagger_ && L_ * gap < kLeastGap * D_) {
    Refuse(Text("propellers of %.0f mm overlap on arms of %.0f mm", D_ * 1000, L_ * 1000) +
           (said_.propeller && said_.arm ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'" : ""));
  }
  if (L_ * gap > 6 * D_) {
    Refuse(Text("arms of %.0f mm are out of proportion to propellers of %.0f mm", L_ * 1000, D_ * 1000) +
           (said_.propeller && said_.arm ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'" : ""));
  }
}

void Designer::ChoosePropeller() {
  out_.blades = static_cast<int>(said_.blades.value_or(std::max(kind_.blades, give_.blades)));
  out_.pitch = said_.pitch.value_or(std::max(kind_.pitch_ratio, give_.pitch) * D_);
  const double b = out_.pitch / D_;
  if (b < 0.15 || b > 1.3) {
    Refuse(Text("a pitch of %.0f mm contradicts a diameter of %.0f mm", out_.pitch * 1000, D_ * 1000) + " ('" + Words("pitch") +
           "'): propellers have 0.15 to 1.3 diameters");
  }
  const PropellerCoefficients c = CoefficientsOf(b, out_.blades, D_);
  // The figure of merit stays below what the gate lets pass.
  const double figure = std::sqrt(2 / kPi) * std::pow(c.thrust, 1.5) / c.power;
  merit_least_ = std::min(1.0, std::max(0.8, figure / 0.78));
  k_f_ = c.thrust * kSeaLevelAirDensity * std::pow(D_, 4) / (4 * kPi * kPi);
  ratio_km_ = give_.merit * c.power * D_ / (2 * kPi * c.thrust);
  Law("pitch", said_.pitch ? Said("pitch") : Text("%.2f diameters (%s)", kind_.pitch_ratio, out_.drone_class.c_str()));
  Law("blades", said_.blades ? Said("blades") : "usual for " + out_.drone_class);
  Law("thrust_factor", Text("C_T = 0.0427 + 0.144 pitch/D (Budinger 2020), (blades/2)^0.61: C_T %.4f; k_f "
                            "= C_T rho D^4 / (2 pi)^2",
                            c.thrust));
  Law("torque_ratio", Text("C_P = -0.00148 + 0.0972 pitch/D (Budinger 2020): C_P %.4f; k_m / k_f = C_P D / (2 pi C_T)", c.power));
}

}  // namespace internal

namespace {

/// The figure of that name, else nullptr.
std::optional<double>* FieldOf(DroneRequest& request, const std::string& field) {
  const std::pair<const char*, std::optional<double>*> fields[] = {{"thrust_to_weight", &request.thrust_to_weight},
                                                                   {"speed", &request.speed},
                                                                   {"hover_time", &request.hover_time},
                                                                   {"flight_time", &request.flight_time},
                                                                   {"pitch", &request.pitch},
                                                                   {"energy_wh", &request.energy_wh},
                                                                   {"cells", &request.cells},
                                                                   {"capacity_ah", &request.capacity_ah},
                                                                   {"arm", &request.arm},
                                                                   {"propeller", &request.propeller},
                                                                   {"payload", &request.payload},
                                                                   {"mass", &request.mass}};
  for (const auto& [name, value] : fields) {
    if (field == name) return value;
  }
  return nullptr;
}

void DropField(DroneRequest& request, const std::string& field) {
  if (auto* value = FieldOf(request, field)) value->reset();
  if (field == "layout") request.layout.reset();
  request.words.erase(field);
  request.facts.erase(field);
}

}  // namespace

namespace {

DroneDesign DesignWithFacts(const DroneRequest& request) {
  // Facts give way in this order, the most derived ones first.
  static constexpr const char* kOrder[] = {"thrust_to_weight", "speed",     "hover_time", "flight_time", "pitch",
                                           "capacity_ah",      "energy_wh", "cells",      "arm",         "propeller",
                                           "payload",          "layout",    "mass"};
  DroneRequest said = request;
  for (const char* field : kOrder) {
    if (said.facts.empty()) break;
    try {
      return internal::Designer(said).Run();
    } catch (const InputError&) {
      if (!said.facts.count(field)) continue;
      said.decided.push_back(said.words.at(field) + "'s " + field + " does not go with what was said and is left open");
      DropField(said, field);
    }
  }
  return internal::Designer(said).Run();
}

/// Where the middle of the said ranges is impossible, one of their ends may not be: the easier end of each.
std::optional<DroneDesign> DesignAtEnds(const DroneRequest& request) {
  DroneRequest said = request;
  for (const auto& [field, range] : request.ranges) {
    auto* value = FieldOf(said, field);
    if (value == nullptr || !*value) continue;
    // A propeller that is larger carries more; of everything else less is easier.
    *value = field == "propeller" || field == "capacity_ah" || field == "arm" ? range.second : range.first;
    said.decided.push_back("of '" + said.words.at(field) + "' that end is taken which can be built");
    try {
      return DesignWithFacts(said);
    } catch (const InputError&) {
    }
  }
  return std::nullopt;
}

}  // namespace

DroneDesign DesignDrone(const DroneRequest& request) {
  try {
    return DesignWithFacts(request);
  } catch (const InputError&) {
    if (request.ranges.empty()) throw;
    if (std::optional<DroneDesign> design = DesignAtEnds(request)) return std::move(*design);
    throw;
  }
}

DroneDesign DroneFromPrompt(std::string_view prompt) { return DesignDrone(ParsePrompt(prompt)); }

}  // namespace airsim360
