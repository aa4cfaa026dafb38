// From commands to goals: modes, phases, limits, geofence, and a smooth reference to follow.
#pragma once

#include "airsim360/flight/control/autopilot.h"
#include "airsim360/flight/control/goal.h"

namespace airsim360::internal {

/// The goal of this step. Takes up a new command, notices its end and its loss, and moves the reference.
Goal Guide(const Autopilot& autopilot, const StateEstimate& estimate, const ActiveCommand& command, AutopilotState& state);

/// A drone's reference where it is now, as it moves now.
void ResetReference(const StateEstimate& estimate, AutopilotState& state);

/// Moves the reference one step: towards the goal's position or velocity within the drone's limits, or along
/// its trajectory. Fills goal.reference.
void MoveReference(const ControlGains& gains, const StateEstimate& estimate, double dt, Goal& goal, AutopilotState& state);

/// Draws the goal back into the fence; true when it had to.
bool KeepInside(const Geofence& fence, const ControlGains& gains, const StateEstimate& estimate, Goal& goal, AutopilotState& state);

}  // namespace airsim360::internal
