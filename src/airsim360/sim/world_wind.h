// The air of a world: mean wind with a profile over height, shadows of buildings, gusts and turbulence.
#pragma once

#include <string>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/flight/wind/wind.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct WorldWind {
  Vec3d mean_W;                      ///< m/s, 10 m above the ground
  double profile_exponent = 0;       ///< power law over height: 0 = the same everywhere, 0.14 open land, 0.3 town
  bool shelter = false;              ///< buildings upwind slow the air, see ShelterFactor
  double turbulence_6m = 0;          ///< m/s at 6 m that the strength of turbulence follows (WindSettings); 0 = none
  std::vector<WindGust> gusts = {};  ///< of the whole world, by the time of the simulation

  void Visit(ConfigVisitor& v);
};

/// The wind of a file (docs/guide/flying.md); calm where `file` is empty. InputError naming file and line.
WorldWind ReadWindFile(const std::string& file);

inline constexpr double kShelterTime = 1;                ///< seconds
inline constexpr int64_t kShelterPeriodNs = 50'000'000;  ///< between looks at the buildings

/// What the mean wind at p is multiplied by behind obstacles: 1 - 0.8 mean(exp(-d / 25 m)), d the distance to
/// what each of nine rays into the wind meets (upwards by 2, 12 and 25 degrees, turned by -12, 0 and 12
/// degrees), rays that meet nothing counting 0. A stand-in for wakes: it costs nine rays, is a function of
/// place and direction alone, and makes streets across the wind calm and crossings windy; it does not speed
/// air up around corners.
double ShelterFactor(const RayTracer& tracer, Vec3d p_W, Vec3d wind_W);

/// Mean wind of a profile at a height over the ground, metres, without shelter.
Vec3d WindAtHeight(const WorldWind& wind, Vec3d wind_10m_W, double height);

}  // namespace airsim360
