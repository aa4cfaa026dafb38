// Eyes of the people who are baked.
#pragma once

#include <array>
#include <vector>

#include "piece.h"

namespace airsim360::bake {

struct Ball {
  Vec3d center;  ///< in P
  double radius = 0;
};

/// Of the left (0) or right (1) eye, which the lids of the base mesh with vertices `v` fit.
Ball EyeBall(const std::vector<Vec3f>& v, size_t eye);

/// Eyeballs of our own, the package's are not on the list: white, iris and pupil, one ball before the other.
void AddEyes(const std::vector<Vec3f>& v, std::vector<Piece>& pieces, const std::array<uint32_t, 3>& materials);

}  // namespace airsim360::bake
