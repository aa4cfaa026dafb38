#include "airsim360/people/crowd/vehicle_dodging.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/steering.h"

namespace airsim360::internal {
namespace {

using Footprint = CrowdVehicle::Footprint;

constexpr double kWalkClear = 0.7;   // metres from the middle of a body to a side that moves, for who walks: drivers need not slow down
constexpr double kStandClear = 0.4;  // the same for who stands
constexpr double kCloser = 0.05;     // metres that who is nearer already may come nearer still
constexpr double kLook = 0.1;        // seconds between looks at where all will be
constexpr double kSide = 0.25;       // metres from the middle of a body that nothing may take
constexpr double kAroundReach = 0.35, kAroundCorner = 0.5;  // metres around one that stands: what bars the way, and where it leads
constexpr double kSeesStanding = 3, kRestUnknown = 6;       // metres
constexpr double kOffMesh = 50;                             // metres that a way through a wall is longer
constexpr double kTouches = 0.4;                            // seconds within which who walks towards a side stops
constexpr double kHurry = 1.8, kPushed = 1;                 // m/s
constexpr double kOtherFloor = 2;                           // metres of height

Vec2d LeftOfUnit(Vec2d a) { return {-a.y, a.x}; }

/// p as seen from the middle of a vehicle: ahead, left.
Vec2d InPlace(const Footprint& place, Vec2d p) {
  const Vec2d d = p - place.center;
  return {Dot(d, place.ahead), Dot(d, LeftOfUnit(place.ahead))};
}
Vec2d FromPlace(const Footprint& place, Vec2d q) { return place.center + place.ahead * q.x + LeftOfUnit(place.ahead) * q.y; }

double DistanceAt(const CrowdVehicle& vehicle, const Footprint& place, Vec2d p) {
  const Vec2d q = InPlace(place, p);
  const double dx = std::abs(q.x) - vehicle.half_length, dy = std::abs(q.y) - vehicle.half_width;
  return dx > 0 && dy > 0 ? std::hypot(dx, dy) : std::max(dx, dy);
}

Footprint PlaceAt(const CrowdVehicle& vehicle, double seconds) {
  const double t = seconds / kCrowdVehicleStep;
  const size_t k = std::min(static_cast<size_t>(t), vehicle.places.size() - 2);
  const double f = std::min(1.0, t - static_cast<double>(k));
  const Footprint &a = vehicle.places[k], &b = vehicle.places[k + 1];
  const Vec2d ahead = a.ahead + (b.ahead - a.ahead) * f;
  return {a.center + (b.center - a.center) * f, ahead * (1 / std::max(Norm(ahead), 1e-9))};
}

/// m/s that no place of its side is faster than.
double FastestOf(const CrowdVehicle& vehicle) {
  constexpr double kTurns = 1.1;  // between two places it turns a little unevenly
  const double half = std::hypot(vehicle.half_length, vehicle.half_width);
  double most = 0;
  for (size_t k = 1; k < vehicle.places.size(); ++k) {
    const Footprint &a = vehicle.places[k - 1], &b = vehicle.places[k];
    most = std::max(most, Norm(b.center - a.center) + half * Norm(b.ahead - a.ahead) * kTurns);
  }
  return most / kCrowdVehicleStep;
}

/// Seconds until somebody who goes on with `v` is nearer than `clear` to a vehicle that moves; infinite: not while they look.
double SecondsToContact(std::span<const CrowdVehicle* const> near, const Pedestrian& self, Vec2d v, double clear) {
  double first = INFINITY;
  for (const CrowdVehicle* vehicle : near) {
    if (vehicle->stands) continue;
    const double least = std::min(clear, DistanceTo(*vehicle, self.p) - kCloser);
    const double closing = (FastestOf(*vehicle) + Norm(v)) * kLook + 1e-3;
    for (int look = 1; look * kLook <= self.seconds && look * kLook < first;) {
      const double t = look * kLook, room = DistanceAt(*vehicle, PlaceAt(*vehicle, t), self.p + v * t) - least;
      if (room < 0) first = t;
      // Looks at which they cannot have met yet are spared.
      look += 1 + static_cast<int>(std::max(0.0, room / closing));
    }
  }
  return first;
}

/// Whether the segment from a to b, as seen from the middle of a vehicle, comes into the box `grow` metres around it.
bool Crosses(const CrowdVehicle& vehicle, double grow, Vec2d a, Vec2d b) {
  double from = 0, to = 1;
  const auto cut = [&](double start, double step, double half) {
    if (std::abs(step) < 1e-9) return std::abs(start) < half;
    const double t0 = (-half - start) / step, t1 = (half - start) / step;
    from = std::max(from, std::min(t0, t1)), to = std::min(to, std::max(t0, t1));
    return from < to;
  };
  return cut(a.x, b.x - a.x, vehicle.half_length + grow) && cut(a.y, b.y - a.y, vehicle.half_width + grow);
}

/// The first place on the way around a vehicle that stands between somebody and their goal.
Vec2d CornerAround(const CrowdVehicle& vehicle, const NavMesh& mesh, const Pedestrian& self, Vec2d goal) {
  const Footprint& place = vehicle.places[0];
  const Vec2d p = InPlace(place, self.p), g = InPlace(place, goal);
  const double x = vehicle.half_length + kAroundCorner, y = vehicle.half_width + kAroundCorner;
  const std::array<Vec2d, 4> corners{{{x, y}, {-x, y}, {-x, -y}, {x, -y}}};
  const double bare = 0.1;  // around the body: who stands close beside it still sees its corners
  double best = INFINITY;
  Vec2d chosen = goal;
  for (size_t k = 0; k < 4; ++k) {
    if (Crosses(vehicle, bare, p, corners[k])) continue;
    double onward = Norm(g - corners[k]);
    if (Crosses(vehicle, kAroundReach, corners[k], g)) {
      onward = INFINITY;
      for (const size_t next : {(k + 1) % 4, (k + 3) % 4})
        onward = std::min(onward, Norm(corners[next] - corners[k]) + Norm(g - corners[next]));
    }
    const Vec2d corner = FromPlace(place, corners[k]);
    const double length = Norm(corners[k] - p) + onward + (mesh.Straight(self.at, corner) ? 0 : kOffMesh);
    if (length >= best) continue;
    best = length;
    chosen = corner;
  }
  return chosen;
}

/// The way on past the nearest vehicle that stands across it.
Vec2d AroundStanding(std::span<const CrowdVehicle* const> near, const NavMesh& mesh, const Pedestrian& self) {
  const double speed = Norm(self.wanted);
  if (speed < 1e-6) return self.wanted;
  const Vec2d forward = self.wanted * (1 / speed);
  const double rest = self.rest > 0 ? self.rest : kRestUnknown;
  const CrowdVehicle* barrier = nullptr;
  double nearest = kSeesStanding;
  for (const CrowdVehicle* vehicle : near) {
    const double distance = DistanceTo(*vehicle, self.p);
    if (!vehicle->stands || distance >= nearest) continue;
    const Footprint& place = vehicle->places[0];
    const Vec2d end = self.p + forward * std::min(rest, kSeesStanding + 2 * vehicle->half_width);
    if (!Crosses(*vehicle, kAroundReach, InPlace(place, self.p), InPlace(place, end))) continue;
    nearest = distance;
    barrier = vehicle;
  }
  if (barrier == nullptr) return self.wanted;
  const Vec2d to = CornerAround(*barrier, mesh, self, self.p + forward * std::max(rest, 1.0)) - self.p;
  const double n = Norm(to);
  return n > 0.05 ? to * (speed / n) : self.wanted;
}

/// Out of the way of what would touch them even if they stood: forward, to a side or back, whichever keeps them free longest.
Vec2d Escape(std::span<const CrowdVehicle* const> near, const Pedestrian& self, Vec2d wanted) {
  const CrowdVehicle* nearest = nullptr;
  for (const CrowdVehicle* vehicle : near)
    if (!vehicle->stands && (nearest == nullptr || DistanceTo(*vehicle, self.p) < DistanceTo(*nearest, self.p))) nearest = vehicle;
  const Vec2d left = LeftOfUnit(nearest->places[0].ahead), out = left * (Dot(self.p - nearest->places[0].center, left) < 0 ? -1 : 1);
  const double speed = Norm(wanted);
  const Vec2d on = speed > 1e-6 ? wanted * (1 / speed) : out;
  Vec2d best = wanted;
  double longest = -1;
  for (const Vec2d v : {on * std::max(speed, kHurry), out * kHurry, out * -kHurry, on * -kHurry}) {
    const double seconds = SecondsToContact(near, self, v, kStandClear);
    if (seconds <= longest) continue;
    longest = seconds;
    best = v;
  }
  return best;
}

}  // namespace

Vehicles::Vehicles(std::span<const CrowdVehicle> vehicles) {
  for (const CrowdVehicle& vehicle : vehicles) {
    const Vec2d middle = (vehicle.places.front().center + vehicle.places.back().center) * 0.5;
    double reach = 0;
    for (const Footprint& place : vehicle.places) reach = std::max(reach, Norm(place.center - middle));
    const double seconds = kCrowdVehicleStep * static_cast<double>(vehicle.places.size() - 1);
    reach += std::hypot(vehicle.half_length, vehicle.half_width) + (vehicle.stands ? kSeesStanding : kWalkClear + kHurry * seconds);
    sorted_.push_back({middle, reach, &vehicle});
    widest_ = std::max(widest_, reach);
  }
  std::ranges::stable_sort(sorted_, {}, [](const Sorted& s) { return s.middle.x; });
}

std::vector<const CrowdVehicle*> Vehicles::Near(Vec2d p, double z) const {
  std::vector<const CrowdVehicle*> near;
  auto at = std::ranges::lower_bound(sorted_, p.x - widest_, {}, [](const Sorted& s) { return s.middle.x; });
  for (; at != sorted_.end() && at->middle.x <= p.x + widest_; ++at)
    if (std::abs(at->vehicle->z - z) < kOtherFloor && Norm(p - at->middle) < at->reach) near.push_back(at->vehicle);
  return near;
}

double DistanceTo(const CrowdVehicle& vehicle, Vec2d p) { return DistanceAt(vehicle, vehicle.places[0], p); }

Dodge DodgeVehicles(std::span<const CrowdVehicle* const> near, const NavMesh& mesh, const Pedestrian& self) {
  Dodge dodge{.wanted = AroundStanding(near, mesh, self)};
  const auto free = [&](Vec2d v, double clear) { return SecondsToContact(near, self, v, clear) > self.seconds; };
  if (free(dodge.wanted, Norm(dodge.wanted) > 0 ? kWalkClear : kStandClear)) return dodge;
  if (free({}, kStandClear)) return {.wanted = {}, .waits = true};
  return {.wanted = Escape(near, self, dodge.wanted), .escapes = true};
}

bool KeepOut(const CrowdVehicle& vehicle, Vec2d p, HalfPlane& plane) {
  const Footprint& place = vehicle.places[0];
  const double distance = DistanceTo(vehicle, p);
  if (distance > kSide + kHurry * kTouches) return false;
  const Vec2d q = InPlace(place, p);
  Vec2d on{std::clamp(q.x, -vehicle.half_length, vehicle.half_length), std::clamp(q.y, -vehicle.half_width, vehicle.half_width)};
  if (distance <= 0) {  // inside: out through the nearest side
    const bool side = std::abs(q.y) - vehicle.half_width > std::abs(q.x) - vehicle.half_length;
    (side ? on.y : on.x) = side ? std::copysign(vehicle.half_width, q.y) : std::copysign(vehicle.half_length, q.x);
  }
  const Vec2d touched = FromPlace(place, on), off = (p - touched) * (distance < 0 ? -1 : 1);
  const double n = Norm(off);
  const Vec2d normal = n > 1e-6 ? off * (1 / n)
                                : (std::abs(on.x) >= vehicle.half_length ? place.ahead * (on.x < 0 ? -1 : 1)
                                                                         : LeftOfUnit(place.ahead) * (on.y < 0 ? -1 : 1));
  const Vec2d v = (FromPlace(vehicle.places[1], on) - touched) * (1 / kCrowdVehicleStep);
  plane = {normal * std::min(Dot(v, normal) - (distance - kSide) / kTouches, kPushed), normal};
  return true;
}

}  // namespace airsim360::internal
