// Masses, inertia, drag and battery of a drone being designed, and the laws they came from.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/designer.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/laws.h"

namespace airsim360::internal {
Vec3d Designer::Box() const { return Vec3d{kind_.body_x, kind_.body_y, kind_.body_z} * L_; }

DroneModel Designer::Aerodynamics() const {
  DroneModel model;
  model.mass = m_;
  model.rotors = PlaceRotors(n_, layout_, L_, 0.08 * L_);
  if (stagger_) {  // neighbours turn against each other
    for (RotorModel& rotor : model.rotors) rotor.p_B.z += (rotor.direction > 0 ? 0.5 : -0.5) * kStagger * D_;
  }
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
  // Drag coefficient 1 for the box and for arms as wide as 8 % of the propellers, times what a said speed needs.
  const Vec3d box = Box();
  const double arms = ArmsOf(n_, layout_) * L_ * 0.08 * D_;
  model.quadratic_drag_B = Vec3d{box.y * box.z + 0.7 * arms, box.x * box.z + 0.7 * arms, box.x * box.y + arms} * (0.5 * rho * drag_);
  return model;
}

bool Designer::Weigh() {
  DroneParts& parts = out_.parts;
  const double torque = thrust_ * ratio_km_;
  parts.motors = n_ * MotorMass(torque) * kind_.motor_factor * give_.motors;
  parts.propellers = n_ * PropellerMass(D_, out_.blades);
  parts.guards = guarded_ ? 0.12 * m_ : 0;
  parts.arms = kind_.arm_share * give_.arms * m_;
  parts.payload = said_.payload.value_or(0);
  parts.battery = BatteryMass();
  parts.body = 0;
  parts.body = m_ - parts.Sum();
  // An ordinary battery may be somewhat smaller than usual.
  const bool free_battery = HoverTimeAsked() <= 0 && EnergySaid() <= 0 && !said_.battery_mass;
  if (free_battery && parts.body < give_.body * m_) {
    const double spare = parts.battery - 0.12 * m_;
    const double moved = std::clamp(give_.body * m_ - parts.body, 0.0, std::max(spare, 0.0));
    parts.battery -= moved;
    parts.body += moved;
  }
  return parts.body >= give_.body * m_ * (1 - 1e-9);
}

double Designer::BatteryMass() const {
  if (said_.battery_mass) return *said_.battery_mass;
  if (const double energy = EnergySaid()) return energy / give_.specific_energy;
  if (const double time = HoverTimeAsked()) return HoverPower() * time / 3600 / give_.usable / give_.specific_energy;
  return kind_.battery_share * (m_ - said_.payload.value_or(0));
}

void Designer::RefuseWeights() const {
  const DroneParts& p = out_.parts;
  std::string asked;
  for (const char* field : {"mass", "payload", "hover_time", "flight_time", "capacity_ah", "energy_wh", "battery_mass", "thrust_to_weight",
                            "speed", "propeller"}) {
    if (said_.words.count(field)) asked += (asked.empty() ? "'" : ", '") + Words(field) + "'";
  }
  Refuse((asked.empty() ? "" : asked + " do not go together: ") +
         Text("of %.3g kg, motors take %.3g kg, propellers %.3g, arms and guards %.3g, battery %.3g and "
              "payload %.3g: nothing is left "
              "for the body",
              m_, p.motors, p.propellers, p.arms + p.guards, p.battery, p.payload));
}

void Designer::Finish() {
  DroneModel& model = out_.model;
  model = Aerodynamics();
  model.name = said_.prompt;
  const DroneParts& parts = out_.parts;
  const double hub = (parts.motors + parts.propellers + parts.guards) / n_;
  model.inertia_B = CompositeInertia(model.rotors, hub, parts.arms, parts.body + parts.battery + parts.payload, Box());
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
  model.half_size_B = {reach_x + D_ / 2, reach_y + D_ / 2, std::max(Box().z / 2, 0.08 * L_ + (stagger_ ? 0.15 : 0.1) * D_)};
  out_.wheelbase = 2 * L_;
  out_.level_speed = speed_held_ ? *said_.speed : LevelSpeed();
  CheckJourney();
  out_.unused = said_.unused;
  out_.decided.insert(out_.decided.begin(), said_.decided.begin(), said_.decided.end());
  TellLatitude();
  FillLaws();

  // The net under all of the above.
  const std::vector<std::string> problems = GateProblems(model);
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
  Refuse("its figures belong to no real drone: " + all);
}

void Designer::FillLaws() {
  Law("inertia", "motors, propellers and guards at the hubs, arms as rods, body and battery as a box (" + out_.drone_class +
                     Text("): %.2f x %.2f x %.2f arm lengths", kind_.body_x, kind_.body_y, kind_.body_z));
  Law("motors", Text("14.5 g (torque / 0.0466 N m)^(3/3.5) (Budinger 2020), speed controllers + 25 %%, times %.3g (%s)",
                     kind_.motor_factor * give_.motors, out_.drone_class.c_str()));
  Law("propellers", "3.2 g (D / 127 mm)^2 blades / 3 (Budinger 2020)");
  Law("guards", guarded_ ? "12 % of the mass" : "none");
  Law("arms", Text("%.0f %% of the mass (%s)", kind_.arm_share * give_.arms * 100, out_.drone_class.c_str()));
  const char* energy = said_.energy_wh ? "energy_wh" : "capacity_ah";
  const char* time = said_.hover_time ? "hover_time" : "flight_time";
  const std::string pack = Text("%.0f W h/kg", give_.specific_energy);
  Law("battery", said_.battery_mass ? Said("battery_mass")
                 : EnergySaid() > 0 ? Said(energy) + ", " + pack
                 : HoverTimeAsked() > 0
                     ? Said(time) + Text(": hover power over %.0f %% of the charge, ", give_.usable * 100) + pack
                     : Text("%.0f %% of the mass without payload (%s)", kind_.battery_share * 100, out_.drone_class.c_str()));
  Law("body", "what is left of the mass");
  Law("payload", said_.payload ? Said("payload") : "none");
  Law("cells", said_.cells ? Said("cells") : "voltage 1.84 P^0.36 (Budinger 2020) at full power, 3.7 V a cell");
  Law("capacity_ah", said_.capacity_ah ? Said("capacity_ah") : "battery energy over 3.7 V a cell");
  Law("motor_kv", said_.motor_kv ? Said("motor_kv") : "full speed at 0.72 of the speed without load, 4.2 V a cell");
  Law("hover_time", said_.hover_time ? Said("hover_time") : Text("%.0f %% of the charge over hover power", give_.usable * 100));
  Law("flight_time", said_.flight_time ? Said("flight_time") : "hover time / 0.87: the best speed takes less power than hovering");
  Law("level_speed", speed_held_   ? Said("speed") + Text(": its lean is held, its thrust would reach %.1f m/s", LevelSpeed())
                     : said_.speed ? Said("speed") + Text(": drag area %.2f times that of the law", drag_)
                                   : "largest lean that keeps the height with 5 % of the thrust in reserve");
  Law("resistance", "12 mOhm Ah a cell");
  Law("efficiency", Text("of motors and speed controllers: %.2f", give_.efficiency));
  Law("idle_power", "0.3 W + 4 W/kg up to 2 kg");
  Law("tau",
      kind_.brushed ? "72 ms, brushed motors of the Crazyflie (Eschmann 2024)" : "33 ms (D / 127 mm)^0.5, through 5-inch racers and X500");
  Law("rotor_inertia", "propeller as a thin rod: m D^2 / 12");
  Law("in_plane_drag", "0.0065 rho D^3, between the Crazyflie's 0.0081 (Forster 2015) and 5-inch racers' 0.0048");
  Law("inflow", "0.012 rho D^3, between the Crazyflie's 0.006 and the Hummingbird's 0.024 (RotorPy)");
  Law("translational_lift", "0.03 rho D^2, half of the Hummingbird's (RotorPy)");
  Law("flapping", "rigid small propellers: none");
  Law("linear_drag", "none beyond the rotors'");
  Law("quadratic_drag", Text("1/2 rho C_d A, C_d %.2f, of box and arms", drag_));
  Law("half_size", "arms, propeller discs and box");
}

}  // namespace airsim360::internal
