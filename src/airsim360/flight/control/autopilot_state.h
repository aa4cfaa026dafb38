// Everything an autopilot remembers from one step to the next: plain data, a copy is a snapshot. All members
// are eight bytes wide, so that there is no padding and equal states have equal bytes.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/control/reference.h"

namespace airsim360 {

enum class FlightMode : int64_t {
  kDisarmed,   ///< rotors stand still
  kGround,     ///< armed, rotors idle
  kCommanded,  ///< flies its command
  kHold,       ///< hovers: asked to, or no valid command
  kTakeoff,
  kReturn,
  kLand,
};

/// Bits of AutopilotState::flags; those of a command fall with the next command.
enum AutopilotFlag : uint64_t {
  kCommandRefused = 1,  ///< the present command cannot be flown: Autopilot::Problem says why
  kCommandLost = 2,     ///< it timed out
  kCommandDone = 4,     ///< its end is reached: a position, a path, a height, the ground
  kFenceHeld = 8,       ///< the geofence holds it back
  kRotorFailed = 16,    ///< some rotor does not follow its speed (failed_rotors)
  kBatteryLow = 32,     ///< charge below AutopilotOptions::low_charge
  kBatteryEmpty = 64,   ///< charge below AutopilotOptions::empty_charge: it lands, whatever the command
  kSaturated = 128,     ///< in this step the rotors could not give all that was wanted
};

struct AutopilotState {
  FlightMode mode = FlightMode::kDisarmed;
  uint64_t flags = 0;
  uint64_t failed_rotors = 0;  ///< bit i = rotor i

  // The present command.
  uint64_t command_id = ~uint64_t{0};
  int64_t command_start_ns = 0;
  Vec3d start_p_W;       ///< where the drone was then
  double start_yaw = 0;  ///< its heading then
  int64_t phase = 0;     ///< of a return; segment of a path
  double settled = 0;    ///< seconds without motion while landing
  double touched = 0;    ///< seconds for which something has kept it from sinking as it should while landing

  Vec3d home_W;  ///< where it was armed

  // Guidance: a smooth reference that the drone can follow.
  Vec3d reference_p, reference_v, reference_a;
  double reference_yaw = 0, reference_yaw_rate = 0;
  int64_t has_reference = 0;

  // Controllers.
  int64_t has_history = 0;  ///< previous_v, previous_w, previous_thrust hold values
  Vec3d previous_v, previous_w;
  RotorWrench previous_wrench;             ///< of the rotor speeds, static
  Vec3d previous_spin_B;                   ///< angular momentum of the rotors, N m s
  double yaw_torque = 0;                   ///< N m, filtered demand
  Vec3d previous_force_W;                  ///< m/s^2 of thrust
  Vec3d disturbance_a, disturbance_alpha;  ///< filtered: what the model of the rotors does not explain
  Vec3d velocity_integral, rate_integral;  ///< m/s^2; rad/s^2
  Vec3d demanded_w;                        ///< rad/s, of the attitude loop
  double throttle_integral = 0;            ///< simple_flight
  Vec3d outer_force;                       ///< px4: m/s^2, held between runs of the position loop
  int64_t outer_count = 0;

  // Watching the rotors.
  RotorValues expected_speeds{}, commanded_speeds{}, fault_time{};
};

static_assert(std::is_trivially_copyable_v<AutopilotState>);
static_assert(alignof(AutopilotState) == 8);

}  // namespace airsim360
