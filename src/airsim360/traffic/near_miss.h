// Near misses: two road users who would have met, had nobody braked or turned.
#pragma once

#include <compare>
#include <cstdint>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Somebody on a road: a vehicle of the traffic, a person of the crowd, a drone of the simulation, by index.
struct RoadUser {
  enum class Kind : uint8_t { kVehicle, kPerson, kDrone };
  Kind kind = Kind::kVehicle;
  uint32_t index = 0;
  auto operator<=>(const RoadUser&) const = default;
};

/// An encounter that was critical, as it was when its time to collision was least.
///
/// Time to collision: until the two touch if both go on along their ways at the speeds that they have (J. C. Hayward, Highway
/// Research Record 384, 1972). Critical is one below kCriticalSeconds that also asks for braking of kCriticalBraking or more: the
/// deceleration rate to avoid the crash (J. Archer, KTH 2005). Careful drivers come near what stands, but brake gently.
struct NearMiss {
  RoadUser a, b;       ///< a < b: the vehicle before the person or drone
  int64_t t_ns = 0;    ///< when it was nearest to a crash
  double seconds = 0;  ///< time to collision then
  double braking = 0;  ///< m/s^2 that would have avoided it: speed towards each other / (2 seconds)
  Vec3d p;             ///< where a was, in W
};

inline constexpr double kCriticalSeconds = 1.5;   ///< Gettman et al., FHWA-HRT-08-051, 2008
inline constexpr double kCriticalBraking = 3.35;  ///< m/s^2, Archer

/// A near miss that is not over yet.
struct Encounter {
  NearMiss worst;
  int64_t seen_ns = 0;  ///< last time that it was critical
};

}  // namespace airsim360
