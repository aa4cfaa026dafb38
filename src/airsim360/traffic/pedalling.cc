#include "airsim360/traffic/pedalling.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/traffic/obstacles.h"

namespace airsim360 {
namespace {

// What slows a bicycle down that nobody pushes: 90 kg whose tyres roll at 0.006 of the weight, 0.6 m^2 in air of 1.2 kg/m^3.
constexpr double kRolls = 0.006 * 9.81, kAir = 0.5 * 1.2 * 0.6 / 90;
constexpr double kPace = 1;         // m/s: who is slower and slows down lets it roll to its end
constexpr double kLevel = kPi / 2;  // both pedals as high; again half a turn on

// Whoever slows down by more than by himself does not push.
bool Pushes(double v, double a) { return v < kPace ? a >= 0 : a >= -(kRolls + kAir * v * v); }

double Forwards(const RigidTransform& from, const RigidTransform& to) {
  return Dot(to.p - from.p, Normalized(from.R.column(0) + to.R.column(0)));
}

}  // namespace

namespace internal {

double CrankAfter(const VehicleShape& shape, double crank, double distance, double v, double a) {
  const double turn = std::max(0.0, distance) / (shape.wheel_radius * shape.gear);
  if (Pushes(v, a)) return crank + turn;
  const double beyond = crank - kLevel, to_level = kPi * std::ceil(beyond / kPi - 1e-9) - beyond;
  return crank + std::min(turn, std::max(0.0, to_level));
}

void Pedal(const TrafficModel& model, const TrafficState& before, uint32_t vehicle, TrafficState& state) {
  // Whether the rider pushes is what it was at the beginning of the tick, as CyclingOf has shown until now: else cranks jumped back.
  const DrivingVehicle& was = before.vehicles[vehicle];
  DrivingVehicle& own = state.vehicles[vehicle];
  const double way = Forwards(PoseOf(model, before, vehicle, before.t_ns), PoseOf(model, state, vehicle, state.t_ns));
  own.rolled = was.rolled + way;
  own.crank = CrankAfter(model.vehicles[vehicle].shape, was.crank, way, was.v, was.a);
}

double LeanInBend(const TrafficModel& model, const DrivingVehicle& own, const VehicleShape& shape, double moved) {
  // Lanes are polylines with up to 4 m between their points: chords of that length turn evenly, and riders lean in before the bend.
  constexpr double kChord = 4, kGravity = 9.81;
  const auto at = [&](double ahead) { return AlongWay(model, own, shape, moved - shape.length / 2 + ahead).p; };
  const Vec3d back = at(0) - at(-kChord), on = at(kChord) - at(0);
  const double turn = std::atan2(back.x * on.y - back.y * on.x, back.x * on.x + back.y * on.y);
  return std::atan(own.v * own.v * turn / kChord / kGravity);
}

}  // namespace internal

Cycling CyclingOf(const TrafficModel& model, const TrafficState& state, size_t vehicle, int64_t t_ns) {
  const DrivingVehicle& own = state.vehicles[vehicle];
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const double way = t_ns == state.t_ns ? 0 : Forwards(PoseOf(model, state, vehicle, state.t_ns), PoseOf(model, state, vehicle, t_ns));
  return {(own.rolled + way) / shape.wheel_radius, internal::CrankAfter(shape, own.crank, way, own.v, own.a)};
}

}  // namespace airsim360
