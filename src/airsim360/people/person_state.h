// What of a person changes with time: where they stand, what they do. The crowd writes it, poses and labels
// read it.
#pragma once

#include <cstdint>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// What a person is seen to do (the behaviour label of a frame). Table 2.3 of the people reference.
enum class Behaviour : uint8_t {
  kIdle,
  kWalk,
  kJog,
  kRun,
  kTalk,
  kListen,
  kPhoneCall,
  kTexting,
  kTakePhoto,
  kWave,
  kSit,
  kCarry,
  kPushStroller,
  kCrouch,
  kStretch,
  kPoint,
  kWait,
  kLookUp,
  kWalkDog,
  kUmbrella,
  kCount
};

/// Index into CrowdModel::people, fixed for the life of a simulation; the entity id is the scene's.
using PersonIndex = uint32_t;
inline constexpr PersonIndex kNoPerson = ~0u;

/// What somebody sits on. Lengths are metres; height 0: not measured, as a bench of 0.45 m.
struct Seating {
  double height = 0;  ///< of the seat above the floor
  double reach = 0;   ///< from the hips to the point between the feet
  double desk = 0;    ///< height of a table top before them that their hands lie on; 0: none
  friend bool operator==(const Seating&, const Seating&) = default;
};

/// One person at one instant; a value, copied with SimState. Everything a pose needs besides the body: a pose
/// is a pure function of (body, motion state, this).
struct PersonState {
  Vec3d p_WP;                          ///< ground point between the feet, metres
  Vec3d v_WP;                          ///< velocity over the ground, m/s
  double yaw = 0.0;                    ///< heading of the body about +Z, radians, 0 = +X (east)
  Behaviour lower = Behaviour::kIdle;  ///< legs: walk, jog, run, idle, sit, crouch ...
  Behaviour upper = Behaviour::kIdle;  ///< arms and head above the spine; equal to `lower` when nothing is masked
  int64_t upper_since_ns = 0;          ///< when `upper` began: gestures are timed from here
  int64_t lower_since_ns = 0;
  bool speaking = false;            ///< whose turn it is in a talk
  bool visible = true;              ///< false: not (yet) in the world
  uint32_t group = 0;               ///< 0 = alone; people who talk or walk together share one
  PersonIndex partner = kNoPerson;  ///< whom they face
  Vec3d p_W_gaze;                   ///< where they look, if `has_gaze`
  bool has_gaze = false;
  Seating seating;  ///< of who sits, or sat last
};

}  // namespace airsim360
