// A simple visible shape of any drone, as plain triangles; whoever has a scene makes meshes of it.
#pragma once

#include <string>
#include <vector>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

/// A closed surface of one colour.
struct DronePart {
  std::string name;               ///< "body", "arm 1", "motor 1", "propeller 1", "leg 1", "front"
  Vec3f color;                    ///< linear RGB reflectance, 0 to 1
  uint32_t first = 0, count = 0;  ///< triangles
  int rotor = -1;                 ///< it turns with this rotor about its hub and axis; -1 = fixed to the body
};

struct DroneBody {
  std::vector<Vec3f> positions;  ///< in B, metres
  std::vector<Vec3u> triangles;  ///< counter-clockwise from outside
  std::vector<DronePart> parts;  ///< in order of their triangles
};

struct DroneBodyOptions {
  int blades = 2;      ///< of each propeller
  bool discs = false;  ///< propellers as thin discs, as turning ones look, instead of blades
};

/// Body, arms, motors, propellers and legs in the proportions of the model. It stays inside the box
/// `half_size_B` where the model has one that holds its discs.
DroneBody MakeDroneBody(const DroneModel& model, const DroneBodyOptions& options = {});

}  // namespace airsim360
