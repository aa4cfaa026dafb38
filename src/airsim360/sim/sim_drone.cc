#include "airsim360/sim/sim_drone.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// The ground effect of Cheeseman and Bennett is (R / 4 z)^2: below 0.1 % from 8 radii on.
constexpr double kGroundRadii = 8;

int64_t ControlPeriod(const DroneSetup& setup, int64_t dt_ns) {
  const int64_t control_ns = std::llround(setup.autopilot.control_dt * 1e9);
  if (dt_ns > 0 && control_ns > 0 && control_ns % dt_ns == 0) return control_ns;
  throw InputError("drone '" + setup.name + "': control_dt " + std::to_string(control_ns) + " ns is no multiple of the step of " +
                   std::to_string(dt_ns) + " ns");
}

}  // namespace

SimDrone::SimDrone(DroneSetup setup, int64_t dt_ns)
    : setup_(std::move(setup)),
      dynamics_(setup_.model, static_cast<double>(dt_ns) * 1e-9),
      autopilot_(setup_.model, setup_.autopilot),
      control_ns_(ControlPeriod(setup_, dt_ns)) {
  setup_.sensors.Check("drone '" + setup_.name + "'");
  for (const RotorModel& rotor : setup_.model.rotors) ground_range_ = std::max(ground_range_, kGroundRadii * rotor.diameter / 2);
  radius_ = Norm(setup_.model.half_size_B);
}

}  // namespace airsim360
