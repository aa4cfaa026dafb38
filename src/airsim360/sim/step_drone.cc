#include "airsim360/sim/step_drone.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/coordinate_limit.h"
#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/sim/en_route.h"
#include "airsim360/sim/people/people.h"

namespace airsim360::internal {
namespace {

using Kind = SimEvent::Kind;

// A contact harder than this is a collision even while another lasts, m/s.
constexpr double kNewImpact = 0.3;
// Standing on what faces up, or setting down on it as softly as this, is none: at most 45 degrees of slope, m/s.
constexpr double kSupportSlope = 0.7, kTouchdownSpeed = 1;
// Leaning on a surface is none, m/s; being put into one is, metres.
constexpr double kLeanSpeed = 0.02, kPutInto = 0.005;
// A drone that lies on something need not touch it in every step: it is the same contact within this time.
constexpr int64_t kContactGapNs = 100'000'000;
// Drones farther away than this do not meet within a step, metres: closing at 500 m/s.
constexpr double kMeetingRange = 2;
// Wakes of drones farther away than this are not felt, metres.
constexpr double kWakeReach = 20;
// Flags of the autopilot that are told once, when they rise.
constexpr std::pair<uint64_t, Kind> kToldFlags[] = {{kCommandRefused, Kind::kCommandRefused}, {kCommandLost, Kind::kCommandLost},
                                                    {kCommandDone, Kind::kCommandDone},       {kFenceHeld, Kind::kFence},
                                                    {kRotorFailed, Kind::kRotorFailed},       {kBatteryLow, Kind::kBatteryLow},
                                                    {kBatteryEmpty, Kind::kBatteryEmpty}};

void TellFlags(uint64_t before, uint64_t after, size_t i, int64_t t_ns, std::vector<SimEvent>& events) {
  for (const auto& [flag, kind] : kToldFlags) {
    if ((after & ~before & flag) != 0) events.push_back({.kind = kind, .vehicle = i, .t_ns = t_ns});
  }
}

// Follows what shelters the vehicle from the mean wind.
void UpdateShelter(const StepContext& context, Vec3d mean, Vehicle& vehicle) {
  if (!context.model.wind.shelter || context.t_ns % kShelterPeriodNs >= context.model.dt_ns) return;
  const double period = static_cast<double>(std::max(kShelterPeriodNs, context.model.dt_ns)) * 1e-9;
  const double follow = 1 - std::exp(-period / kShelterTime);
  const double now = ShelterFactor(*context.model.tracer, vehicle.drone.p_WB, mean);
  vehicle.shelter += follow * (now - vehicle.shelter);
}

// The air at the vehicle: mean wind of its height behind what shelters it, gusts, turbulence.
WindSample WindAt(const StepContext& context, const SimDrone& drone, Vehicle& vehicle) {
  const WorldWind& wind = context.model.wind;
  if (context.wind_W == Vec3d{} && wind.turbulence_6m == 0 && wind.gusts.empty()) return {};
  const double height = vehicle.drone.p_WB.z - context.model.tracer->scene().bounds.min.z;
  const Vec3d mean = WindAtHeight(wind, context.wind_W, height);
  UpdateShelter(context, mean, vehicle);
  const WindSettings settings{mean * vehicle.shelter, wind.turbulence_6m, wind.gusts};
  return StepWind(settings, static_cast<double>(context.t_ns) * 1e-9, drone.dynamics().dt(), height, vehicle.drone.v_WB,
                  2 * drone.model().half_size_B.y, vehicle.gusts);
}

// Largest speed of drones that may be met in this step.
double NeighbourSpeed(const StepContext& context, size_t i, const SimDrone& drone, const Vehicle& vehicle) {
  double speed = 0;
  context.boxes.Near(vehicle.drone.p_WB, drone.radius() + kMeetingRange, i,
                     [&](const DroneBox& box) { speed = std::max(speed, Norm(box.v_WB)); });
  return speed;
}

// Whether nothing happens to the drone in this step: it lies still, and has for a while.
bool Sleeps(const StepContext& context, size_t i, const SimDrone& drone, Vec3d wind, Vehicle& vehicle) {
  constexpr double kStillSpeed = 0.02, kStillTurn = 0.1, kStillRotor = 1;  // m/s, rad/s, rad/s
  DroneState& state = vehicle.drone;
  const bool lies = vehicle.touched_ns >= 0 && context.t_ns - vehicle.touched_ns <= kContactGapNs;
  const bool still = (lies || vehicle.still_ns >= kSleepNs) && vehicle.autopilot.mode == FlightMode::kDisarmed &&
                     std::ranges::max(vehicle.rotor_commands) == 0 && std::ranges::max(state.rotor_speeds) < kStillRotor &&
                     Norm(state.v_WB) < kStillSpeed && Norm(state.w_WB_B) < kStillTurn && wind == Vec3d{} &&
                     NeighbourSpeed(context, i, drone, vehicle) < kStillSpeed;
  vehicle.still_ns = still ? std::min(vehicle.still_ns + context.model.dt_ns, kSleepNs) : 0;
  if (vehicle.still_ns < kSleepNs) return false;
  state.v_WB = state.w_WB_B = vehicle.a_WB = vehicle.alpha_WB_B = {};
  state.rotor_speeds.fill(0);
  return true;
}

// Whether a wake can be felt at p: downstream, within a cone on whose edge a jet has half a percent of the
// speed on its axis (Schlichting's profile, see downwash.h).
bool IsInWake(const RotorWake& wake, Vec3d p) {
  const Vec3d d = p - wake.p_W;
  const double along = Dot(d, wake.direction_W);
  if (!(wake.momentum > 0 && along > 0)) return false;
  const double reach = std::sqrt(wake.disc_area) + 0.5 * along;
  return Dot(d, d) - along * along < reach * reach;
}

// What the rotors of other drones blow at the vehicle.
Vec3d Downwash(const StepContext& context, size_t i, const Vehicle& vehicle) {
  std::vector<RotorWake> wakes;
  context.boxes.Near(vehicle.drone.p_WB, kWakeReach, i, [&](const DroneBox& box) {
    if (IsInWake(box.wake, vehicle.drone.p_WB)) wakes.push_back(box.wake);
  });
  return wakes.empty() ? Vec3d{} : DownwashOn(wakes, wakes.size(), vehicle.drone.p_WB);
}

// Metres from the rotor plane down to the surface below, where its effect is felt.
double GroundDistance(const StepContext& context, const SimDrone& drone, const Vehicle& vehicle) {
  constexpr double kFar = 1e9;
  if (vehicle.contact.free_distance > drone.ground_range()) return kFar;
  const RotorModel& rotor = drone.model().rotors.front();
  const Vec3d hub = vehicle.drone.p_WB + ToMatrix(vehicle.drone.q_WB) * Vec3d{0, 0, rotor.p_B.z};
  const auto hit = context.model.tracer->Intersect(VecCast<float>(hub), {0, 0, -1}, static_cast<float>(drone.ground_range()));
  return hit ? static_cast<double>(hit->distance) : kFar;
}

// After a crash: the rotors stand still and every new command is refused, until a reset.
void LieBroken(const StepContext& context, size_t i, Vehicle& vehicle, std::vector<SimEvent>& events) {
  vehicle.rotor_commands.fill(0);
  vehicle.autopilot.mode = FlightMode::kDisarmed;
  if (vehicle.autopilot.command_id == vehicle.command.id) return;
  vehicle.autopilot.command_id = vehicle.command.id;
  events.push_back({.kind = Kind::kCommandRefused,
                    .vehicle = i,
                    .t_ns = context.t_ns,
                    .text = CommandName(vehicle.command.command) + ": the drone has crashed; reset it first"});
}

// Whether a contact is more than standing, setting down and leaning. Nothing stands or leans on people.
bool Collides(const SimModel& model, const ContactReport& report, const Vehicle& vehicle, int64_t t_ns) {
  if (!report.touching) return false;
  if (report.crashed) return true;
  const bool lasts = vehicle.touched_ns >= 0 && t_ns - vehicle.touched_ns <= kContactGapNs;
  if (model.people && IsPerson(*model.people, report.point.entity)) return !lasts || report.impact_speed > kNewImpact;
  if (report.point.normal_W.z > kSupportSlope) return report.impact_speed > (IsEnRoute(vehicle) ? kNewImpact : kTouchdownSpeed);
  if (!lasts && report.penetration > kPutInto) return true;
  return report.impact_speed > (lasts ? kNewImpact : kLeanSpeed);
}

void NoteCollision(const SimModel& model, const ContactReport& report, int64_t t_ns, size_t i, Vehicle& vehicle,
                   std::vector<SimEvent>& events) {
  const bool collides = Collides(model, report, vehicle, t_ns);
  vehicle.touching = report.touching;
  if (report.touching) vehicle.touched_ns = t_ns;
  if (!collides) return;
  CollisionInfo& collision = vehicle.collision;
  collision = {
      collision.count + 1, t_ns, report.point.p_W, report.point.normal_W, vehicle.drone.p_WB, report.impact_speed, report.penetration,
      report.point.entity};
  events.push_back({Kind::kCollision, i, t_ns, collision});
  if (report.crashed) events.push_back({Kind::kCrash, i, t_ns, collision});
}

// Nothing leaves the neighbourhood of the scene: an invisible wall takes the speed through it.
void KeepInWorld(const StepContext& context, size_t i, Vehicle& vehicle, std::vector<SimEvent>& events) {
  const Box3f& bounds = context.model.tracer->scene().bounds;
  if (bounds.empty()) return;
  bool outside = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = bounds.min[axis] - kWorldMargin, high = bounds.max[axis] + kWorldMargin;
    double& p = vehicle.drone.p_WB[axis];
    if (p >= low && p <= high) continue;
    p = std::clamp(p, low, high);
    double& v = vehicle.drone.v_WB[axis];
    // Told when it arrives, not while it is held there.
    outside |= (p == low ? v < -kNewImpact : v > kNewImpact);
    v = p == low ? std::max(v, 0.0) : std::min(v, 0.0);
  }
  if (outside) events.push_back({.kind = Kind::kWorldEdge, .vehicle = i, .t_ns = context.t_ns});
}

// Commands and winds without measure can take the equations beyond what numbers hold: then the drone is put back
// to where it was, at rest. Whether that was needed.
bool KeepSane(const DroneState& before, DroneState& now) {
  constexpr double kFastest = 1e4, kFastestTurn = 1e4;  // m/s, rad/s
  const Quaternion& q = now.q_WB;
  const bool sane = Norm(now.v_WB) <= kFastest && Norm(now.w_WB_B) <= kFastestTurn && IsWithinLimit(now.p_WB) &&
                    std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-3 &&
                    std::ranges::all_of(now.rotor_speeds, [](double speed) { return std::isfinite(speed); });
  if (sane) return false;
  const double charge = now.charge;
  now = {.p_WB = before.p_WB, .q_WB = before.q_WB, .v_WB = {}, .w_WB_B = {}};
  now.charge = std::isfinite(charge) ? charge : before.charge;
  return true;
}

}  // namespace

void CopyMotion(Vehicle& vehicle) {
  const DroneState& drone = vehicle.drone;
  vehicle.motion = {{ToMatrix(drone.q_WB), drone.p_WB}, drone.v_WB, drone.w_WB_B};
}

void FollowMotion(const SimDrone& drone, Vehicle& vehicle) {
  DroneState& state = vehicle.drone;
  state.p_WB = vehicle.motion.X_WB.p;
  state.q_WB = ToQuaternion(vehicle.motion.X_WB.R);
  state.v_WB = vehicle.motion.v_WB;
  state.w_WB_B = vehicle.motion.w_WB_B;
  state.rotor_speeds.fill(0);
  const double hover = HoverSpeed(drone.model());
  std::fill_n(state.rotor_speeds.begin(), drone.model().rotors.size(), hover);
  vehicle.contact = {};
}

void PlanDrone(const StepContext& context, size_t i, Vehicle& vehicle, std::vector<SimEvent>& events) {
  const SimDrone& drone = *context.model.drones[i];
  if (context.t_ns % drone.control_ns() != 0) return;
  if (vehicle.contact.crashed && drone.setup().crash_disarms) {
    LieBroken(context, i, vehicle, events);
    return;
  }
  const uint64_t before = vehicle.autopilot.flags, last_id = vehicle.autopilot.command_id;
  const StateEstimate estimate = EstimateOf(vehicle.drone, context.t_ns);
  vehicle.rotor_commands = drone.autopilot().Step(estimate, vehicle.command, vehicle.autopilot);
  // Flags of a command rise anew with each command.
  constexpr uint64_t kOfCommand = kCommandRefused | kCommandLost | kCommandDone | kFenceHeld;
  const bool is_new = vehicle.autopilot.command_id != last_id;
  const size_t first = events.size();
  TellFlags(is_new ? before & ~kOfCommand : before, vehicle.autopilot.flags, i, context.t_ns, events);
  for (size_t k = first; k < events.size(); ++k) {
    if (events[k].kind == Kind::kCommandRefused) events[k].text = drone.autopilot().Problem(vehicle.command.command, vehicle.autopilot);
  }
}

DroneSurroundings Surround(const StepContext& context, size_t i, Vehicle& vehicle) {
  const SimDrone& drone = *context.model.drones[i];
  const SimModel& model = context.model;
  if (context.t_ns % kClearancePeriodNs < model.dt_ns) {
    vehicle.clearance = model.tracer->Clearance(VecCast<float>(vehicle.drone.p_WB), model.contact_range);
  }
  const WindSample wind = WindAt(context, drone, vehicle);
  vehicle.wind_W = wind.velocity_W + Downwash(context, i, vehicle);
  DroneSurroundings around;
  around.wind_W = vehicle.wind_W;
  if (wind.rate_W != Vec3d{}) around.wind_rate_B = ToMatrix(vehicle.drone.q_WB).transpose() * wind.rate_W;
  const double height = model.world.frame.origin().altitude + vehicle.drone.p_WB.z;
  around.air_density = StandardAir(height, model.world.sea_level_pressure).density;
  around.ground_distance = GroundDistance(context, drone, vehicle);
  return around;
}

void FlyDrone(const StepContext& context, size_t i, const DroneSurroundings& surroundings, Vehicle& vehicle,
              std::vector<SimEvent>& events) {
  const SimModel& model = context.model;
  const SimDrone& drone = *model.drones[i];
  const double dt = drone.dynamics().dt();
  if (Sleeps(context, i, drone, surroundings.wind_W, vehicle)) {
    CopyMotion(vehicle);
    return;
  }
  const DroneState before = vehicle.drone;
  drone.dynamics().Step(surroundings, vehicle.rotor_commands, vehicle.health, vehicle.drone);
  const WorldContacts contacts(*model.tracer, context.boxes, i);
  const ContactReport report = ResolveContacts(drone.model(), drone.setup().contact, contacts, before, dt,
                                               NeighbourSpeed(context, i, drone, vehicle), vehicle.drone, vehicle.contact);
  NoteCollision(model, report, context.t_ns + model.dt_ns, i, vehicle, events);
  const bool mended = KeepSane(before, vehicle.drone);
  KeepInWorld(context, i, vehicle, events);
  vehicle.a_WB = mended ? Vec3d{} : (vehicle.drone.v_WB - before.v_WB) / dt;
  vehicle.alpha_WB_B = mended ? Vec3d{} : (vehicle.drone.w_WB_B - before.w_WB_B) / dt;
  CopyMotion(vehicle);
}

}  // namespace airsim360::internal
