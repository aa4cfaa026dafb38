// How a person moves: gait, foot locking, gestures. StepMotion advances what has memory (phase, planted
// feet, transitions), PoseOf gives the joints; both are deterministic and free of allocation.
#pragma once

#include <array>
#include <cstdint>

#include "airsim360/base/state_hash.h"
#include "airsim360/people/body/body.h"
#include "airsim360/people/person_state.h"

namespace airsim360 {

/// The ground under a foot.
struct GroundPoint {
  double z = 0;           ///< height in W
  Vec3d normal{0, 0, 1};  ///< unit, upwards
};

/// The ground that feet are set on; a navigation mesh, rays, or a plane.
class Ground {
 public:
  virtual ~Ground() = default;
  /// The ground at (p.x, p.y) nearest in height to p.z.
  virtual GroundPoint At(Vec3d p_W) const = 0;
};

/// One foot: planted at a place of the world, or on its way to the next. Plain numbers.
struct FootMotion {
  enum class Mode : uint32_t { kPlanted, kSwing, kStep };  // swing: by the gait's phase; step: by time
  Mode mode = Mode::kPlanted;
  double u = 0;  ///< of a step: 0 at lift-off, 1 at landing; planted: 1 = came down flat, 0 = on its heel
  Vec3d p_W;     ///< planted: ball of the foot on the ground; else where it left the ground
  Vec3d p_W_to;  ///< where it is going to land
  double yaw = 0, yaw_to = 0;
  Vec3d offset;           ///< swing: ankle less the gait's own at lift-off, axes of P
  double pitch = 0;       ///< at lift-off, radians, toe down positive
  double toes = 1;        ///< of a step: 1 if its toes were on the ground at lift-off
  double phase = 0;       ///< of its stride at lift-off
  Vec3d normal{0, 0, 1};  ///< of the ground it stands on
};

inline constexpr int kBlendedJoints = 14;  ///< pelvis, spine, neck, head, clavicles, arms

/// What the motion of one person remembers. A value: part of SimState, copied and hashed with it.
struct MotionState {
  int64_t t_ns = 0;
  uint64_t seed = 0;
  double phase = 0;       ///< of the left leg: 0 at heel strike, 1 one stride later
  double speed = 0;       ///< smoothed, m/s, along the heading
  double side_speed = 0;  ///< smoothed, m/s, to the left
  double gait = 0;        ///< 0 stands, 1 walks or runs
  double run = 0;         ///< 0 walks, 1 runs
  double yaw_rate = 0;    ///< smoothed, rad/s
  double last_yaw = 0;
  Vec3d last_p_WP, gaze;  ///< of the step before
  uint32_t speaking = 0, has_gaze = 0;
  Behaviour lower = Behaviour::kIdle, upper = Behaviour::kIdle;
  int64_t lower_since_ns = 0, upper_since_ns = 0;
  std::array<FootMotion, 2> feet;  ///< left, right
  // Inertialised transitions: offsets from the new motion and their rates at blend_since_ns, decaying as a
  // critically damped spring.
  int64_t blend_since_ns = 0;
  float blend_rate = 0;                               ///< 1/s; 0 = no transition under way
  std::array<Vec3f, kBlendedJoints> turn, turn_rate;  ///< rotation vectors
  Vec3f shift, shift_rate;                            ///< of the pelvis in P, metres
  std::array<float, 2> curl{};                        ///< of the fingers, left and right
};

/// A person who has just come into the world and stands at state.p_WP.
MotionState StartMotion(const Body& body, const PersonState& state, uint64_t seed, int64_t t_ns, const Ground* ground = nullptr);

/// Advances to t_ns (a step of at most 0.2 s at a time). `ground` null: a plane at state.p_WP.z. Jumps of more
/// than 1 m set the feet anew.
void StepMotion(const Body& body, const PersonState& state, int64_t t_ns, const Ground* ground, MotionState& motion);

/// The joints at motion.t_ns. A pure function.
SkeletonPose PoseOf(const Body& body, const MotionState& motion, const PersonState& state);

/// Adds every number of a motion state to a hash.
void HashMotion(const MotionState& motion, StateHasher& hasher);

/// Step length of a walk at `speed` for a leg of `leg` metres: L = sqrt(W v), W = 0.0064 m per step/min,
/// scaled by equal Froude numbers (PMC5430280).
double WalkStepLength(double speed, double leg);
/// Likewise of a run: cadence 2.5 to 2.9 steps/s.
double RunStepLength(double speed, double leg);
/// Speed at which people of this leg change from walk to run: Froude number 0.5.
double WalkRunSpeed(double leg);

}  // namespace airsim360
