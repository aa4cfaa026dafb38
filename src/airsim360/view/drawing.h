// What is drawn in the page, checked by the code that reads the files.
#pragma once

#include <string>

#include "airsim360/sim/step.h"

namespace airsim360 {

/// `kind` people: a people.yaml, whose areas and people must fit the world's ground; route: the YAML of a route file; cameras: a
/// rig; labels: a label file, each rule of which must match something; world: a world file, whose lamps must be in the world.
/// Says how much there is: "2 areas, 1 person". InputError as the commands that read the file; for people without a crowd in
/// the world.
std::string CheckDrawing(const SimModel& model, const std::string& kind, const std::string& text);

}  // namespace airsim360
