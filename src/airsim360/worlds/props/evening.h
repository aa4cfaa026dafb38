// What shines on props by night: which lamps burn in which white, and the head and tail lamps of vehicles.
#pragma once

#include <string_view>

#include "airsim360/scene/model_source.h"

namespace airsim360 {

/// Whether a vehicle stands parked or in traffic.
enum class Engine { kOff, kOn };

namespace internal {

/// White of luminance 1 at 2000 to 9000 K, linear sRGB: lamp_white of render/shared/shading_interior.h.
Vec3f LampWhite(float kelvin);

/// Instance::glow of a prop of this kind at a place; the same for the same place. Street lights are of one kind over a
/// neighbourhood: high-pressure sodium (2200 K), warm or neutral LED (3000, 4000 K). Vehicles in traffic have their lamps on
/// (halogen 3200 K, LED 5500 K; those of the 1950s about 3000 K), parked ones are dark but for one in twenty-five. White for all
/// other props.
Vec3f EveningGlow(std::string_view kind, std::string_view category, Vec3f p_W, Engine engine);

/// Makes lamps of the glasses at nose and tail of a vehicle (front towards -Y), whose shape and look by day stay: low beams
/// of 5,000 cd each on their axis (UN Regulation 149 asks for 4,000 to 35,000 below the cut-off) and red tail lamps of
/// 6 cd each (4 to 12 in UN Regulation 148), what Instance::glow is multiplied with. The windows of a vehicle `lit_inside`
/// (a bus) shine, too.
void AddVehicleLamps(Model& model, bool lit_inside = false);

}  // namespace internal
}  // namespace airsim360
