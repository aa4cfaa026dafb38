#include "airsim360/flight/prompt/drone_class.h"

#include <algorithm>

namespace airsim360 {
namespace {

constexpr DroneClass kClasses[] = {
    // name, mass, hover and pitch and blades, T/W, full disc loading, spacing, motors, arms, battery, box,
    // ...
    {"generic", 1.2, 70, 0.50, 2, 2.2, 0, 1.25, 1.3, 0.08, 0.28, 0.80, 0.50, 0.30, false, false},
    {"nano", 0.032, 45, 0.62, 2, 1.9, 0, 1.35, 4.0, 0.06, 0.22, 0.80, 0.60, 0.40, true, false},
    {"nano_brushless", 0.044, 50, 0.60, 2, 2.6, 0, 1.12, 5.0, 0.06, 0.22, 0.80, 0.60, 0.40, false, true},
    {"whoop", 0.045, 75, 0.60, 3, 2.6, 0, 1.12, 2.5, 0.05, 0.22, 0.70, 0.50, 0.40, false, true},
    {"racing", 0.65, 120, 0.86, 3, 6.0, 0, 1.20, 1.0, 0.06, 0.25, 0.85, 0.35, 0.35, false, false},
    {"freestyle", 0.70, 130, 0.80, 3, 5.0, 0, 1.25, 1.1, 0.07, 0.25, 0.85, 0.40, 0.35, false, false},
    {"cinematic", 0.50, 110, 0.60, 3, 3.0, 0, 1.15, 1.4, 0.06, 0.28, 0.80, 0.60, 0.45, false, true},
    {"camera", 0.90, 60, 0.50, 2, 2.0, 0, 1.20, 1.2, 0.07, 0.33, 1.00, 0.45, 0.35, false, false},
    {"research", 0.60, 40, 0.5625, 2, 2.4, 0, 1.20, 2.6, 0.12, 0.28, 0.60, 0.60, 0.30, false, false},
    {"hobby", 1.0, 60, 0.5556, 2, 1.7, 102, 1.40, 1.9, 0.05, 0.25, 0.79, 0.48, 0.18, false, false},
    {"frame_kit", 1.6, 95, 0.53, 2, 2.0, 0, 1.38, 1.10, 0.05, 0.25, 0.75, 0.45, 0.75, false, false},
    {"survey", 2.5, 60, 0.44, 2, 1.9, 0, 1.20, 1.2, 0.08, 0.36, 0.90, 0.55, 0.30, false, false},
    {"inspection", 3.8, 72, 0.444, 2, 2.0, 0, 1.16, 1.2, 0.08, 0.34, 0.90, 0.50, 0.35, false, false},
    {"delivery", 8.0, 100, 0.40, 2, 1.9, 0, 1.18, 1.1, 0.09, 0.28, 0.70, 0.60, 0.45, false, false},
    {"heavy_lift", 12.0, 110, 0.36, 2, 2.0, 0, 1.15, 1.1, 0.10, 0.30, 0.60, 0.60, 0.40, false, false},
    {"agricultural", 24.0, 115, 0.36, 2, 1.9, 0, 1.15, 1.1, 0.10, 0.25, 0.60, 0.60, 0.60, false, false},
};

}  // namespace

std::span<const DroneClass> DroneClasses() { return kClasses; }

const DroneClass& FindDroneClass(std::string_view name) {
  return *std::find_if(std::begin(kClasses), std::end(kClasses), [&](const DroneClass& c) { return c.name == name; });
}

}  // namespace airsim360
