#include "airsim360/sim/fly_route.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/text.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

constexpr int64_t kRecordPeriodNs = 100'000'000;

void AppendNumber(std::string& text, double value) { text += ShortestText(value); }

}  // namespace

std::vector<int64_t> EvenTimes(const Route& route, int64_t n) {
  std::vector<int64_t> times;
  for (int64_t i = 0; i < n; ++i) {
    const double fraction = n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0;
    times.push_back(std::llround(route.duration() * fraction * 1e9));
  }
  return times;
}

Flight FlyRoute(const SimModel& model, std::shared_ptr<const Route> route, std::span<const int64_t> shot_times_ns) {
  const double duration = route->duration();
  const RoutePoint start = route->At(0);
  SimState state;
  StartLife(model, state);
  state.vehicles.push_back(VehicleAt(model, BodyPose(start.p, start.yaw, 0, 0)));
  Flight flight;
  flight.least_clearance = state.vehicles[0].clearance;
  const std::vector<SimCommand> commands = {{0, std::move(route)}};
  size_t next = 0;
  while (true) {
    // Take the shots that are nearer to this step than to the next one, and the record when it is due.
    const Vehicle& vehicle = state.vehicles[0];
    for (; next < shot_times_ns.size() && shot_times_ns[next] < state.t_ns + model.dt_ns / 2; ++next) {
      flight.shots.push_back({.t_ns = state.t_ns, .body = vehicle.motion, .people = state.people, .traffic = state.traffic});
    }
    const bool landed = static_cast<double>(state.t_ns) * 1e-9 >= duration && next == shot_times_ns.size();
    if (state.t_ns % kRecordPeriodNs == 0 || landed) flight.trajectory.push_back({state.t_ns, vehicle.motion, vehicle.a_WB});
    if (landed) return flight;

    std::vector<SimEvent> events;
    Step(model, state.step == 0 ? std::span(commands) : std::span<const SimCommand>(), state, &events);
    for (const SimEvent& event : events)
      if (event.kind == SimEvent::Kind::kNearMiss) flight.near_misses.push_back(event.near_miss);
    flight.least_clearance = std::min(flight.least_clearance, static_cast<double>(state.vehicles[0].clearance));
  }
}

Flight Hover(const RigidTransform& X_WB) {
  const Kinematics body{X_WB, {}, {}};
  return {{{0, body}}, {{0, body, {}}}, 0};
}

std::string TrajectoryCsv(const Flight& flight) {
  std::string text = "t_s,px,py,pz,vx,vy,vz,ax,ay,az,qw,qx,qy,qz\n";
  for (const TrajectorySample& sample : flight.trajectory) {
    AppendNumber(text, static_cast<double>(sample.t_ns) / 1e9);
    for (const Vec3d& v : {sample.body.X_WB.p, sample.body.v_WB, sample.a_WB}) {
      for (int i = 0; i < 3; ++i) AppendNumber(text += ',', v[i]);
    }
    const Quaternion q = ToQuaternion(sample.body.X_WB.R);
    for (double value : {q.w, q.x, q.y, q.z}) AppendNumber(text += ',', value);
    text += '\n';
  }
  return text;
}

}  // namespace airsim360
