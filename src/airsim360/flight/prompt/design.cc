#include "airsim360/flight/prompt/design.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/gains.h"
#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/laws.h"

namespace airsim360 {
namespace {
using namespace internal;

constexpr double kPi = std::numbers::pi;
constexpr double kFastestTip = 0.65 * 340.3;  // m/s; the gate ends at Mach 0.7
// Hover disc loadings of drones that exist, N/m^2: from indoor fliers to heavy-lift racers.
constexpr double kLeastLoading = 8, kMostLoading = 600;
constexpr double kLeastBody = 0.06;  // of the mass: plate, wiring, electronics
constexpr double kLeastRatio = 1.5;  // thrust to weight that is not gone below unasked

std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string Text(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

class Designer {
 public:
  explicit Designer(const DroneRequest& request) : said_(request) {}

  DroneDesign Run() {
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

 private:
  const std::string& Words(const char* field) const { return said_.words.at(field); }
  void Law(const char* parameter, std::string law) { out_.laws[parameter] = std::move(law); }
  std::string Said(const char* field) const { return "said: '" + Words(field) + "'"; }
  [[noreturn]] static void Refuse(const std::string& why) {
    throw InputError("no drone fits the description: " + why);
  }

  void ChooseClass() {
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

  void ChooseRotors() {
    layout_ = said_.layout.value_or(RotorLayout::kX);
    const bool coaxial = layout_ == RotorLayout::kCoaxial;
    n_ = static_cast<int>(said_.rotors.value_or(coaxial ? 8 : 4));
    // "coaxial quad" means four arms.
    if (coaxial && n_ == 4) n_ = 8;
    if (coaxial && n_ != 8) {
      Refuse("'" + Words("rotors") + "' contradicts '" + Words("layout") +
             "': coaxial pairs sit on four arms");
    }
    const bool quad_only = layout_ == RotorLayout::kH || layout_ == RotorLayout::kWideX;
    if (quad_only && n_ != 4) {
      Refuse("'" + Words("layout") + "' is a layout of four rotors, '" + Words("rotors") + "' are " +
             std::to_string(n_));
    }
    Law("rotors", said_.rotors ? Said("rotors")
                  : coaxial    ? "coaxial pairs on four arms"
                               : "four unless said");
  }

  double Disc(double diameter) const { return n_ * kPi * diameter * diameter / 4; }

  /// Mass and propeller diameter.
  void ChooseSize() {
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

  double SizeFactor() const {
    if (!said_.size) return 1;
    const std::string& size = *said_.size;
    return size == "tiny" ? 0.25 : size == "small" ? 0.5 : size == "large" ? 2 : size == "huge" ? 4 : 1;
  }

  void CheckSize() const {
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

  void ChooseArms() {
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
             (said_.propeller && said_.arm
                  ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'"
                  : ""));
    }
    if (L_ * gap > 6 * D_) {
      Refuse(Text("arms of %.0f mm are out of proportion to propellers of %.0f mm", L_ * 1000, D_ * 1000) +
             (said_.propeller && said_.arm
                  ? ": '" + Words("propeller") + "' contradicts '" + Words("arm") + "'"
                  : ""));
    }
  }

  void ChoosePropeller() {
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
    Law("pitch", said_.pitch ? Said("pitch")
                             : Text("%.2f diameters (%s)", kind_.pitch_ratio, out_.drone_class.c_str()));
    Law("blades", said_.blades ? Said("blades") : "usual for " + out_.drone_class);
    Law("thrust_factor", Text("C_T = 0.0427 + 0.144 pitch/D (Budinger 2020), (blades/2)^0.61: C_T %.4f; k_f "
                              "= C_T rho D^4 / (2 pi)^2",
                              c.thrust));
    Law("torque_ratio",
        Text("C_P = -0.00148 + 0.0972 pitch/D (Budinger 2020): C_P %.4f; k_m / k_f = C_P D / (2 pi C_T)",
             c.power));
  }

  void SetThrust(double ratio, const std::string& law) {
    ratio_ = ratio;
    law_of_thrust_ = law;
    thrust_ = ratio * m_ * kGravity / n_;
    speed_ = std::sqrt(thrust_ / k_f_);
    Law("max_speed", law + Text(": %.2f N a rotor, speed = sqrt(T / k_f)", thrust_));
  }

  void ChooseThrust() {
    if (said_.thrust_to_weight) {
      SetThrust(*said_.thrust_to_weight, Said("thrust_to_weight"));
    } else {
      SetThrust(kind_.thrust_to_weight,
                Text("thrust to weight %.1f (%s)", kind_.thrust_to_weight, out_.drone_class.c_str()));
      // Motors that belong to the propeller rather than to the weight.
      const double matched = kind_.full_disc_loading * kPi * D_ * D_ / 4 * n_ / (m_ * kGravity);
      if (matched > ratio_)
        SetThrust(matched, Text("motors matched to the propeller, %g N/m^2 at full throttle",
                                kind_.full_disc_loading));
      if (ratio_ > 14) SetThrust(14, "thrust to weight at most 14");
    }
    // Tips stay subsonic.
    const double most = std::pow(2 * kFastestTip / D_, 2) * k_f_ * n_ / (m_ * kGravity);
    if (ratio_ > most) {
      if (said_.thrust_to_weight || most < kLeastRatio) {
        Refuse(
            Text("%d propellers of %.0f mm at Mach 0.65 of their tips give %.2f times the weight of %.3g kg",
                 n_, D_ * 1000, most, m_) +
            (said_.thrust_to_weight ? ", not " + Words("thrust_to_weight") : ""));
      }
      SetThrust(most, "as much as tips at Mach 0.65 give");
    }
    most_ratio_ = std::min(most, 14.0);
    ReachSpeed();
  }

  double LevelSpeed() const {
    DroneModel model = Aerodynamics();
    const double tilt = std::min(std::acos(std::min(1.0, 1 / (0.95 * ratio_))), 1.3);
    return LevelSpeedAtTilt(model, tilt);
  }

  void ReachSpeed() {
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

  Vec3d Box() const { return Vec3d{kind_.body_x, kind_.body_y, kind_.body_z} * L_; }

  /// Rotors and drag: all that speed depends on.
  DroneModel Aerodynamics() const {
    DroneModel model;
    model.mass = m_;
    model.rotors = PlaceRotors(n_, layout_, L_, 0.08 * L_);
    const double rho = kSeaLevelAirDensity, D3 = D_ * D_ * D_;
    for (RotorModel& rotor : model.rotors) {
      rotor.diameter = D_;
      rotor.thrust_factor = k_f_;
      rotor.torque_ratio = ratio_km_;
      rotor.max_speed = speed_;
      rotor.in_plane_drag = 0.0065 * rho * D3;
      rotor.inflow = 0.012 * rho * D3;
      rotor.translational_lift = 0.03 * rho * D_ * D_;
      rotor.tau_up = rotor.tau_down = RotorLag(D_, kind_.brushed);
      rotor.inertia = PropellerMass(D_, out_.blades) * D_ * D_ / 12;
    }
    // Drag coefficient 1 for the box and for arms as wide as 8 % of the propellers.
    const Vec3d box = Box();
    const double arms = ArmsOf(n_, layout_) * L_ * 0.08 * D_;
    model.quadratic_drag_B =
        Vec3d{box.y * box.z + 0.7 * arms, box.x * box.z + 0.7 * arms, box.x * box.y + arms} * (0.5 * rho);
    return model;
  }

  double HoverPower() const {
    const double hover = m_ * kGravity / n_;
    const double shaft = n_ * hover * ratio_km_ * std::sqrt(hover / k_f_);
    return shaft / kDriveEfficiency + IdlePower();
  }
  double IdlePower() const { return 0.3 + 4 * std::min(m_, 2.0); }

  /// Distributes the mass; false when too little is left for the body.
  bool Weigh() {
    DroneParts& parts = out_.parts;
    const double torque = thrust_ * ratio_km_;
    parts.motors = n_ * MotorMass(torque) * kind_.motor_factor;
    parts.propellers = n_ * PropellerMass(D_, out_.blades);
    parts.guards = guarded_ ? 0.12 * m_ : 0;
    parts.arms = kind_.arm_share * m_;
    parts.payload = said_.payload.value_or(0);
    parts.battery = BatteryMass();
    parts.body = 0;
    parts.body = m_ - parts.Sum();
    // An ordinary battery may be somewhat smaller than usual.
    const bool free_battery = !said_.endurance && !said_.capacity_ah;
    if (free_battery && parts.body < kLeastBody * m_) {
      const double spare = parts.battery - 0.12 * m_;
      const double moved = std::clamp(kLeastBody * m_ - parts.body, 0.0, std::max(spare, 0.0));
      parts.battery -= moved;
      parts.body += moved;
    }
    return parts.body >= kLeastBody * m_ * (1 - 1e-9);
  }

  double BatteryMass() const {
    const double energy_per_kg = kSpecificEnergy * 3600;  // J/kg
    if (said_.capacity_ah) return *said_.capacity_ah * 3600 * kCellVoltage * Cells() / energy_per_kg;
    if (said_.endurance) return HoverPower() * *said_.endurance / kUsableCharge / energy_per_kg;
    return kind_.battery_share * (m_ - said_.payload.value_or(0));
  }
  int Cells() const {
    if (said_.cells) return static_cast<int>(*said_.cells);
    return CellsFor(HoverPower() * std::pow(ratio_, 1.5));
  }

  [[noreturn]] void RefuseWeights() const {
    const DroneParts& p = out_.parts;
    std::string asked;
    for (const char* field :
         {"mass", "payload", "endurance", "capacity_ah", "thrust_to_weight", "speed", "propeller"}) {
      if (said_.words.count(field)) asked += (asked.empty() ? "'" : ", '") + Words(field) + "'";
    }
    Refuse((asked.empty() ? "" : asked + " do not go together: ") +
           Text("of %.3g kg, motors take %.3g kg, propellers %.3g, arms and guards %.3g, battery %.3g and "
                "payload %.3g: nothing is left "
                "for the body",
                m_, p.motors, p.propellers, p.arms + p.guards, p.battery, p.payload));
  }

  void Finish() {
    DroneModel& model = out_.model;
    model = Aerodynamics();
    model.name = said_.prompt;
    const DroneParts& parts = out_.parts;
    const double hub = (parts.motors + parts.propellers + parts.guards) / n_;
    model.inertia_B =
        CompositeInertia(model.rotors, hub, parts.arms, parts.body + parts.battery + parts.payload, Box());
    // A guard is a ring around its hub, half of its mass on either side.
    if (parts.guards > 0) {
      const double ring = parts.guards * D_ * D_ / 4;
      for (int i = 0; i < 3; ++i) model.inertia_B.m[i][i] += i == 2 ? ring : ring / 2;
    }
    FillBattery();
    double reach_x = 0, reach_y = 0;
    for (const RotorModel& rotor : model.rotors) {
      reach_x = std::max(reach_x, std::abs(rotor.p_B.x));
      reach_y = std::max(reach_y, std::abs(rotor.p_B.y));
    }
    model.half_size_B = {reach_x + D_ / 2, reach_y + D_ / 2, std::max(Box().z / 2, 0.08 * L_ + 0.1 * D_)};
    out_.level_speed = LevelSpeed();
    FillLaws();

    // The net under all of the above.
    const std::vector<std::string> problems = GateProblems(model);
    if (problems.empty()) return;
    std::string all;
    for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
    Refuse("its figures belong to no real drone: " + all);
  }

  void FillBattery() {
    BatteryModel& battery = out_.model.battery;
    const double energy = out_.parts.battery * kSpecificEnergy;  // W h
    battery.cells = Cells();
    battery.capacity_ah = said_.capacity_ah.value_or(energy / (kCellVoltage * battery.cells));
    battery.resistance = battery.cells * 0.012 / battery.capacity_ah;
    battery.efficiency = kDriveEfficiency;
    battery.idle_power = IdlePower();
    out_.hover_power = HoverPower();
    out_.endurance =
        kUsableCharge * battery.capacity_ah * kCellVoltage * battery.cells * 3600 / out_.hover_power;
    if (said_.endurance && said_.capacity_ah && std::abs(out_.endurance / *said_.endurance - 1) > 0.3) {
      Refuse("'" + Words("endurance") + "' contradicts '" + Words("capacity_ah") +
             Text("': that battery hovers for %.0f s", out_.endurance));
    }
    // The pack must give the hover current without losing more than a quarter of its voltage.
    const double voltage = kCellVoltage * battery.cells;
    if (battery.resistance * out_.hover_power / voltage > 0.25 * voltage) {
      Refuse(Text("a battery of %.2g Ah cannot give the %.3g W of hovering", battery.capacity_ah,
                  out_.hover_power));
    }
  }

  void FillLaws() {
    Law("inertia", "motors, propellers and guards at the hubs, arms as rods, body and battery as a box (" +
                       out_.drone_class +
                       Text("): %.2f x %.2f x %.2f arm lengths", kind_.body_x, kind_.body_y, kind_.body_z));
    Law("motors",
        Text("14.5 g (torque / 0.0466 N m)^(3/3.5) (Budinger 2020), speed controllers + 25 %%, times %g (%s)",
             kind_.motor_factor, out_.drone_class.c_str()));
    Law("propellers", "3.2 g (D / 127 mm)^2 blades / 3 (Budinger 2020)");
    Law("guards", guarded_ ? "12 % of the mass" : "none");
    Law("arms", Text("%.0f %% of the mass (%s)", kind_.arm_share * 100, out_.drone_class.c_str()));
    Law("battery", said_.capacity_ah ? Said("capacity_ah") + ", 150 W h/kg"
                   : said_.endurance ? Said("endurance") + ": hover power over 80 % of the charge, 150 W h/kg"
                                     : Text("%.0f %% of the mass without payload (%s)",
                                            kind_.battery_share * 100, out_.drone_class.c_str()));
    Law("body", "what is left of the mass");
    Law("payload", said_.payload ? Said("payload") : "none");
    Law("cells",
        said_.cells ? Said("cells") : "voltage 1.84 P^0.36 (Budinger 2020) at full power, 3.7 V a cell");
    Law("capacity_ah", said_.capacity_ah ? Said("capacity_ah") : "battery mass, 150 W h/kg");
    Law("resistance", "12 mOhm Ah a cell");
    Law("efficiency", "motors and speed controllers of this kind: 0.75");
    Law("idle_power", "0.3 W + 4 W/kg up to 2 kg");
    Law("tau", kind_.brushed ? "72 ms, brushed motors of the Crazyflie (Eschmann 2024)"
                             : "33 ms (D / 127 mm)^0.5, through 5-inch racers and X500");
    Law("rotor_inertia", "propeller as a thin rod: m D^2 / 12");
    Law("in_plane_drag",
        "0.0065 rho D^3, between the Crazyflie's 0.0081 (Forster 2015) and 5-inch racers' 0.0048");
    Law("inflow", "0.012 rho D^3, between the Crazyflie's 0.006 and the Hummingbird's 0.024 (RotorPy)");
    Law("translational_lift", "0.03 rho D^2, half of the Hummingbird's (RotorPy)");
    Law("flapping", "rigid small propellers: none");
    Law("linear_drag", "none beyond the rotors'");
    Law("quadratic_drag", "1/2 rho C_d A, C_d 1, of box and arms");
    Law("half_size", "arms, propeller discs and box");
  }

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

}  // namespace

DroneDesign DesignDrone(const DroneRequest& request) { return Designer(request).Run(); }
DroneDesign DroneFromPrompt(std::string_view prompt) { return DesignDrone(ParsePrompt(prompt)); }

}  // namespace airsim360
