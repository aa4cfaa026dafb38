#include "airsim360/flight/drones/catalog.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/choice.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/laws.h"

namespace airsim360 {
namespace {

constexpr CatalogDrone kDrones[] = {
    {"crazyflie", "Crazyflie 2.x (brushed, 47 mm propellers)",
     "learnsyslab/drone-models cf2x_L250, measured: mass, inertia, k_f, k_m; drag and lag: Forster 2015 as "
     "in RotorPy 9b760b8",
     "a 32 g nano quad with 47 mm propellers and 46 mm arms"},
    {"crazyflie_rotorpy", "Crazyflie 2.x as RotorPy has it (for comparisons with RotorPy)",
     "RotorPy 9b760b8 crazyflie_params.py: k_m is its own guess, J_z > J_x + J_y", ""},
    {"crazyflie_brushless", "Crazyflie Brushless with propeller guards",
     "RotorPy 9b760b8 crazyfliebrushless_params.py (Grafe 2026, Folk 2026); k_m is not measured",
     "a 44 g brushless nano quad with guards, 55 mm propellers and 43 mm arms"},
    {"hummingbird", "AscTec Hummingbird", "RotorPy 9b760b8 hummingbird_params.py",
     "a 500 g research quad with 200 mm propellers and 17 cm arms"},
    {"airsim_quad", "AirSim's generic quad X", "AirSim 1.8.1 MultiRotorParams.hpp, RotorParams.hpp",
     "a 1 kg hobby quad with 9 inch propellers and 22.75 cm arms"},
    {"airsim_hexa", "AirSim's generic hexa X", "AirSim 1.8.1 MultiRotorParams.hpp; its propellers overlap", ""},
    {"airsim_octo", "AirSim's generic octo X", "AirSim 1.8.1 MultiRotorParams.hpp; its propellers overlap", ""},
    {"f450", "DJI Flamewheel F450 as AirSim has it", "AirSim 1.8.1 MultiRotorParams.hpp (Flamewheel)",
     "a 1.635 kg flamewheel kit quad with 9 inch propellers and a 450 mm wheelbase"},
    {"f550", "DJI Flamewheel F550, hexa",
     "MRS uav_system: 2.3 kg, 270 mm arms, k_f 1.2216e-7 N/rpm^2, lag 30 ms; 9.4 x 5 in propellers; its "
     "inertia is a "
     "formula and its torque constant 4 times too large: both, and drag, by our laws",
     "a 2.3 kg flamewheel kit hexacopter with 9.4x5 propellers and 27 cm arms", false, true},
    {"octo", "DJI S1000 class, octo",
     "maker's sheet as remembered: 1045 mm diagonal, 15 x 5.2 in propellers, 9.5 kg ready to fly; the rest "
     "by our laws",
     "a 9.5 kg heavy lift octocopter with 15x5.2 propellers and a 1045 mm wheelbase", false, false},
    {"agilicious", "Agilicious 5-inch quad (NeuroBEM)",
     "Foehn et al. 2022, Bauersfeld et al. 2021: mass, inertia, k_f, k_m, lag; drag by our laws",
     "a 752 g five-inch wide X racing quad with a 250 mm wheelbase"},
    {"racer", "5-inch racer (ARPL)",
     "rl-tools arpl.h: mass, inertia, arms, full thrust 7.5 N a rotor, lag; its thrust curve is in other "
     "units: k_f by our laws",
     "a 782 g five-inch wide X racing quad with a 250 mm wheelbase", true, false},
    {"matrice", "DJI Matrice class (M30)",
     "DJI M30 sheet: 3.77 kg, 668 mm diagonal, 16 x 7.1 in propellers, 23 m/s, 41 min; the rest by our laws",
     "a 3.77 kg matrice class inspection quad with 16x7.1 propellers and a 668 mm wheelbase", false, false},
};

void SetRotors(DroneModel& model, double k_f, double ratio, double tau, double max_speed, double diameter) {
  for (RotorModel& rotor : model.rotors) {
    rotor.thrust_factor = k_f;
    rotor.torque_ratio = ratio;
    rotor.tau_up = rotor.tau_down = tau;
    rotor.max_speed = max_speed;
    rotor.diameter = diameter;
  }
}

Mat3d Diagonal(double x, double y, double z) { return {{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}}; }

void SetDrag(DroneModel& model, double k_d, double k_z, double k_h, Vec3d quadratic) {
  for (RotorModel& rotor : model.rotors) {
    rotor.in_plane_drag = k_d;
    rotor.inflow = k_z;
    rotor.translational_lift = k_h;
  }
  model.quadratic_drag_B = quadratic;
}

/// The box around hubs and discs.
void SetSize(DroneModel& model, double height) {
  for (const RotorModel& rotor : model.rotors) {
    model.half_size_B.x = std::max(model.half_size_B.x, std::abs(rotor.p_B.x) + rotor.diameter / 2);
    model.half_size_B.y = std::max(model.half_size_B.y, std::abs(rotor.p_B.y) + rotor.diameter / 2);
  }
  model.half_size_B.z = height;
}

DroneModel QuadX(double mass, double arm, double above = 0, RotorLayout layout = RotorLayout::kX) {
  DroneModel model;
  model.mass = mass;
  model.rotors = internal::PlaceRotors(4, layout, arm, above);
  return model;
}

DroneModel Crazyflie() {
  DroneModel model = QuadX(0.0319, 0.046);
  model.inertia_B = Diagonal(16.8e-6, 16.8e-6, 29.8e-6);
  SetRotors(model, 2.24e-8, 7.35e-3, 0.072, 2500, 0.0471);
  SetDrag(model, 10.2506e-7, 7.553e-7, 0, {});
  SetSize(model, 0.015);
  return model;
}

DroneModel CrazyflieRotorPy() {
  DroneModel model = QuadX(0.03, 0.043);
  model.inertia_B = Diagonal(1.43e-5, 1.43e-5, 2.89e-5);
  SetRotors(model, 2.3e-8, 7.8e-10 / 2.3e-8, 0.072, 2500, 0.047);
  SetDrag(model, 10.2506e-7, 7.553e-7, 0, {});
  SetSize(model, 0.015);
  return model;
}

DroneModel CrazyflieBrushless() {
  DroneModel model = QuadX(0.044, 0.043);
  model.inertia_B = Diagonal(3.3e-5, 3.6e-5, 5.9e-5);
  SetRotors(model, 4.052e-8, 7.8e-10 / 4.052e-8, 0.05, 3100, 0.055);
  SetDrag(model, 5.09e-6, 1.19e-5, 1.11e-3, {});
  SetSize(model, 0.015);
  return model;
}

DroneModel Hummingbird() {
  DroneModel model = QuadX(0.5, 0.17);
  model.inertia_B = Diagonal(3.65e-3, 3.68e-3, 7.03e-3);
  SetRotors(model, 5.57e-6, 1.36e-7 / 5.57e-6, 0.005, 1500, 0.2);
  SetDrag(model, 1.19e-4, 2.32e-4, 3.39e-3, {0.5e-2, 0.5e-2, 1e-2});
  SetSize(model, 0.05);
  return model;
}

/// AirSim's frames: a box, and motors at hubs `above` it; `drag` times its coefficient.
DroneModel AirSim(int count, double mass, double motor, double arm, Vec3d box, double c_t, double c_p, double rpm, double above = 0.025,
                  double drag = 1) {
  const double pi = std::numbers::pi, D = 0.2286, speed = rpm * 2 * pi / 60;
  DroneModel model;
  model.mass = mass;
  model.rotors = internal::PlaceRotors(count, RotorLayout::kX, arm, above);
  model.inertia_B = internal::CompositeInertia(model.rotors, motor, 0, mass - count * motor, box);
  SetRotors(model, c_t * kSeaLevelAirDensity * std::pow(D, 4) / (4 * pi * pi), c_p * D / (2 * pi * c_t), 0.005, speed, D);
  // Six faces with the propellers' discs (its disc is pi D^2) and blade edges (1 cm) shared out among them,
  // times its linear drag coefficient 1.3 / 4 and rho / 2 (folded into rho F).
  const double disc = count * pi * D * D, edge = count * pi * D * 0.01;
  const double k = drag * 1.3 / 4 / 2 * kSeaLevelAirDensity;
  model.quadratic_drag_B = {(box.y * box.z + edge) * k, (box.x * box.z + edge) * k, (box.x * box.y + disc) * k};
  SetSize(model, std::max(0.05, above + 0.02));
  return model;
}

DroneModel Agilicious() {
  DroneModel model = QuadX(0.752, 0.125, 0, RotorLayout::kWideX);
  model.inertia_B = Diagonal(2.5e-3, 2.1e-3, 4.3e-3);
  // 8.5 N a rotor.
  SetRotors(model, 1.5625e-6, 16e-3, 0.033, std::sqrt(8.5 / 1.5625e-6), 0.13);
  SetDrag(model, 1.2e-5, 0.012 * kSeaLevelAirDensity * std::pow(0.13, 3), 0, {0.01, 0.01, 0.02});
  SetSize(model, 0.05);
  return model;
}

DroneModel Racer() {
  DroneModel model = DroneFromPrompt("a 782 g five-inch wide X racing quad with a 250 mm wheelbase").model;
  model.battery = {};
  model.inertia_B = Diagonal(1.77e-3, 1.38e-3, 2.95e-3);
  const double places[4][2] = {{0.0775, -0.0981}, {-0.0775, 0.0981}, {0.0775, 0.0981}, {-0.0775, -0.0981}};
  for (size_t i = 0; i < 4; ++i) {
    RotorModel& rotor = model.rotors[i];
    rotor.p_B = {places[i][0], places[i][1], 0};
    rotor.torque_ratio = 5.96e-3;
    rotor.tau_up = rotor.tau_down = 0.033;
    rotor.max_speed = std::sqrt(7.5 / rotor.thrust_factor);
  }
  SetSize(model, 0.05);
  return model;
}

DroneModel F550(std::string_view prompt) {
  DroneModel model = DroneFromPrompt(prompt).model;
  model.battery = {};
  for (RotorModel& rotor : model.rotors) {
    rotor.thrust_factor = 1.2216e-7 * std::pow(60 / (2 * std::numbers::pi), 2);
    rotor.tau_up = rotor.tau_down = 0.03;
    rotor.max_speed = 9068 * 2 * std::numbers::pi / 60;
  }
  return model;
}

}  // namespace

std::span<const CatalogDrone> DroneCatalog() { return kDrones; }

DroneModel CatalogModel(const std::string& name) {
  std::vector<std::string> names;
  for (const CatalogDrone& drone : kDrones) names.emplace_back(drone.name);
  const size_t found = ParseChoice("drone", name, names);

  const Vec3d generic{0.18, 0.11, 0.04};
  const auto make = [&]() -> DroneModel {
    if (name == "crazyflie") return Crazyflie();
    if (name == "crazyflie_rotorpy") return CrazyflieRotorPy();
    if (name == "crazyflie_brushless") return CrazyflieBrushless();
    if (name == "hummingbird") return Hummingbird();
    if (name == "airsim_quad") return AirSim(4, 1, 0.055, 0.2275, generic, 0.109919, 0.040164, 6396.667);
    if (name == "airsim_hexa") return AirSim(6, 1, 0.055, 0.2275, generic, 0.109919, 0.040164, 6396.667);
    if (name == "airsim_octo") return AirSim(8, 1, 0.055, 0.2275, generic, 0.109919, 0.040164, 6396.667);
    if (name == "f450") return AirSim(4, 1.635, 0.052, 0.225, {0.16, 0.10, 0.14}, 0.11, 0.047, 9500, 0.15, 4);
    if (name == "agilicious") return Agilicious();
    if (name == "racer") return Racer();
    if (name == "f550") return F550(kDrones[found].prompt);
    return DroneFromPrompt(kDrones[found].prompt).model;
  };
  DroneModel model = make();
  model.name = name;
  return model;
}

}  // namespace airsim360
