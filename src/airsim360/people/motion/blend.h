// Transitions: the difference between the old motion and the new one is kept and decays, so that nothing
// jumps (inertialisation, after Bollo, GDC 2018; decay of a critically damped spring).
#pragma once

#include "airsim360/people/motion/legs.h"

namespace airsim360::internal {

PostureInput InputOf(const Body& body, const MotionState& motion, const PersonState& state);
LegInput LegInputOf(const Body& body, const MotionState& motion, const PersonState& state, const Posture& posture, Vec3d shift);

/// Adds what is left of a transition to a posture; returns the shift of the pelvis in P.
Vec3d AddOffsets(const MotionState& motion, Posture& posture);

/// Switches `motion` to the behaviours, speech and gaze of `state`: afterwards the pose is what it was.
void SwitchMotion(const Body& body, const PersonState& state, MotionState& motion);

/// Whether SwitchMotion is needed.
bool NeedsSwitch(const MotionState& motion, const PersonState& state);

}  // namespace airsim360::internal
