// Where a model file lies in W: what the user says of its units, its up axis and its place.
#pragma once

#include <optional>
#include <string>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// In this order: scaled, its up axis turned to +Z, put on the ground, moved.
struct ModelPlacement {
  /// Range of `scale`.
  static constexpr double kLeastScale = 1e-6, kMostScale = 1e6;
  /// Range of each number of `offset`, metres.
  static constexpr double kMostOffset = 1e6;

  std::optional<double> scale = {};  ///< metres a unit of the file; not given = as the format says, and a guess is told
  std::string up = {};               ///< axis of the file that points up: x, y, z, -x, -y, -z; "" = the format's own
  bool ground = false;               ///< stands with its lowest point on z = 0, on a plain that goes all round
  std::optional<bool> baked = {};    ///< the light of rooms is in the colours; not given = guessed, and told
  Vec3d offset = {};                 ///< metres in W, for all of the model (the plain stays)

  bool empty() const { return !scale && up.empty() && !ground && !baked && offset == Vec3d{}; }
};

/// InputError that names the value and its range; `where` (a flag, a file) starts it.
void ValidatePlacement(const ModelPlacement& placement, const std::string& where);

}  // namespace airsim360
