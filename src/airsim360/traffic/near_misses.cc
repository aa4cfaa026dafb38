#include "airsim360/traffic/near_misses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <tuple>

namespace airsim360::internal {
namespace {

constexpr int kPathSteps = 15;
constexpr double kPathStep = kCriticalSeconds / kPathSteps;  // seconds
constexpr double kTooSlow = 0.5;                             // m/s: no vehicle so slow has to brake hard for anybody
constexpr double kVehicleCell = 40;                          // metres: a vehicle and a person of one encounter are nearer
constexpr int64_t kOverNs = 500'000'000;
constexpr double kLeastSeconds = 0.01;  // what braking is measured with at least

Vec2d OnGround(Vec3d p) { return {p.x, p.y}; }
double DotOf(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
Vec2d LeftOf(Vec2d a) { return {-a.y, a.x}; }

constexpr ContactTimes kAlways{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

// When |x + v t| <= reach.
std::optional<ContactTimes> Within(double x, double v, double reach) {
  if (v == 0) return std::abs(x) <= reach ? std::optional(kAlways) : std::nullopt;
  const double t0 = (-reach - x) / v, t1 = (reach - x) / v;
  return ContactTimes{std::min(t0, t1), std::max(t0, t1)};
}

std::optional<ContactTimes> Both(std::optional<ContactTimes> a, std::optional<ContactTimes> b) {
  if (!a || !b) return std::nullopt;
  const ContactTimes both{std::max(a->begin, b->begin), std::min(a->end, b->end)};
  return both.begin <= both.end ? std::optional(both) : std::nullopt;
}

// Of parts of something convex: the whole time from the first to the last.
std::optional<ContactTimes> Either(std::optional<ContactTimes> a, std::optional<ContactTimes> b) {
  if (!a || !b) return a ? a : b;
  return ContactTimes{std::min(a->begin, b->begin), std::max(a->end, b->end)};
}

// When |p + v t| <= radius.
std::optional<ContactTimes> WithinDisc(Vec2d p, Vec2d v, double radius) {
  const double a = DotOf(v, v), b = DotOf(p, v), c = DotOf(p, p) - radius * radius;
  if (a == 0) return c <= 0 ? std::optional(kAlways) : std::nullopt;
  const double root = b * b - a * c;
  if (root < 0) return std::nullopt;
  return ContactTimes{(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

double ReachAlong(const GroundBox& box, Vec2d axis) {
  return box.half_length * std::abs(DotOf(box.ahead, axis)) + box.half_width * std::abs(DotOf(LeftOf(box.ahead), axis));
}

// Where a vehicle will be if it keeps its speed: one box after the other.
using Path = std::array<GroundBox, kPathSteps + 1>;

NearMiss MissOf(RoadUser a, RoadUser b, int64_t t_ns, double seconds, double speed, Vec3d p) {
  if (b < a) std::swap(a, b);
  return {.a = a, .b = b, .t_ns = t_ns, .seconds = seconds, .braking = speed / (2 * std::max(seconds, kLeastSeconds)), .p = p};
}

RoadUser VehicleUser(uint32_t i) { return {RoadUser::Kind::kVehicle, i}; }

/// One look at everybody.
class CriticalSearch {
 public:
  CriticalSearch(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy)
      : model_(model), state_(state), occupancy_(occupancy), path_of_(state.vehicles.size()) {
    for (uint32_t i = 0; i < state.vehicles.size(); ++i) {
      const LanePoint front = model.lanes.At(state.vehicles[i].lane, state.vehicles[i].s);
      middles_.push_back(front.p - front.direction * (model.vehicles[i].shape.length / 2));
    }
  }

  void Following() {
    for (uint32_t i = 0; i < state_.vehicles.size(); ++i) {
      if (state_.vehicles[i].v < kTooSlow) continue;
      const InFront front = FindInFront(model_, state_, occupancy_, i);
      const double closing = state_.vehicles[i].v - front.v;
      if (closing <= 0 || !std::isfinite(front.gap)) continue;
      Add(VehicleUser(i), VehicleUser(front.vehicle), std::max(0.0, front.gap) / closing, closing);
    }
  }

  void InJunctions() {
    std::vector<std::pair<int32_t, uint32_t>> inside;
    for (uint32_t i = 0; i < state_.vehicles.size(); ++i)
      if (const int32_t junction = JunctionOf(i); junction >= 0) inside.emplace_back(junction, i);
    std::ranges::sort(inside);
    for (size_t a = 0; a < inside.size(); ++a)
      for (size_t b = a + 1; b < inside.size() && inside[b].first == inside[a].first; ++b) Cross(inside[a].second, inside[b].second);
  }

  void With(std::span<const TrafficObstacle> obstacles) {
    if (obstacles.empty()) return;
    SortIntoCells();
    for (const TrafficObstacle& obstacle : obstacles) {
      // A fast drone comes from farther than the next cell.
      const bool far = Norm(obstacle.v) * kCriticalSeconds > kVehicleCell / 2;
      if (far) {
        for (uint32_t i = 0; i < middles_.size(); ++i) Meet(i, obstacle);
        continue;
      }
      const auto [x, y] = CellOf(obstacle.p);
      for (int32_t dx = -1; dx <= 1; ++dx)
        for (int32_t dy = -1; dy <= 1; ++dy) VisitCell({x + dx, y + dy}, [&](uint32_t i) { Meet(i, obstacle); });
    }
  }

  std::vector<NearMiss> Finish() {
    std::ranges::sort(found_, {}, [](const NearMiss& miss) { return std::tuple(miss.a, miss.b, miss.seconds); });
    const auto same = [](const NearMiss& p, const NearMiss& q) { return p.a == q.a && p.b == q.b; };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    return std::move(found_);
  }

 private:
  using Cell = std::pair<int32_t, int32_t>;

  static Cell CellOf(Vec3d p) {
    const auto index = [](double x) { return static_cast<int32_t>(std::floor(std::clamp(x, -1e9, 1e9) / kVehicleCell)); };
    return {index(p.x), index(p.y)};
  }

  void SortIntoCells() {
    for (uint32_t i = 0; i < middles_.size(); ++i) cells_.emplace_back(CellOf(middles_[i]), i);
    std::ranges::sort(cells_);
  }

  template <class Body>
  void VisitCell(Cell cell, const Body& body) const {
    auto at = std::ranges::lower_bound(cells_, std::pair(cell, uint32_t{0}));
    for (; at != cells_.end() && at->first == cell; ++at) body(at->second);
  }

  // The junction that a vehicle is in with some part of it, or has been let into; -1: none.
  int32_t JunctionOf(uint32_t i) const {
    const DrivingVehicle& own = state_.vehicles[i];
    if (const int32_t here = model_.lanes.lane(own.lane).junction; here >= 0) return here;
    if (own.granted) return model_.lanes.lane(own.ahead[0]).junction;
    const bool leaves = own.s < model_.vehicles[i].shape.length && own.behind[0] != kNoLane;
    return leaves ? model_.lanes.lane(own.behind[0]).junction : -1;
  }

  const Path& PathOf(uint32_t i) {
    if (path_of_[i] != nullptr) return *path_of_[i];
    Path& path = paths_.emplace_back();
    path_of_[i] = &path;
    const VehicleShape& shape = model_.vehicles[i].shape;
    for (int k = 0; k <= kPathSteps; ++k) {
      const RigidTransform X = PoseOf(model_, state_, i, state_.t_ns + std::llround(k * kPathStep * 1e9));
      const Vec3d x = X.R.column(0);
      const double level = std::hypot(x.x, x.y);
      path[static_cast<size_t>(k)] = {OnGround(X.p), {x.x / level, x.y / level}, shape.length / 2, shape.width / 2};
    }
    return path;
  }

  Vec2d VelocityOnGround(uint32_t i) { return PathOf(i)[0].ahead * state_.vehicles[i].v; }

  void Add(RoadUser a, RoadUser b, double seconds, double speed) {
    if (seconds > kCriticalSeconds || speed / (2 * std::max(seconds, kLeastSeconds)) < kCriticalBraking) return;
    found_.push_back(MissOf(a, b, state_.t_ns, seconds, speed, middles_[std::min(a, b).index]));
  }

  // The first time at which the paths meet; `between`: contact within a step that begins with these two places.
  template <class Between>
  static double FirstMeeting(const Between& between) {
    for (size_t k = 0; k < kPathSteps; ++k) {
      const std::optional<ContactTimes> times = between(k);
      if (times && times->end >= 0 && times->begin <= kPathStep) return static_cast<double>(k) * kPathStep + std::max(0.0, times->begin);
    }
    return INFINITY;
  }

  void Cross(uint32_t i, uint32_t k) {
    const DrivingVehicle &a = state_.vehicles[i], &b = state_.vehicles[k];
    const double reach = (a.v + b.v) * kCriticalSeconds + (model_.vehicles[i].shape.length + model_.vehicles[k].shape.length) / 2 + 3;
    if (a.lane == b.lane || std::max(a.v, b.v) < kTooSlow || Norm(middles_[i] - middles_[k]) > reach) return;
    const Path &p = PathOf(i), &q = PathOf(k);
    const double seconds = FirstMeeting([&](size_t at) {
      const Vec2d v = (q[at + 1].center - q[at].center - (p[at + 1].center - p[at].center)) * (1 / kPathStep);
      return ContactOf(p[at], q[at], v);
    });
    const Vec2d v = VelocityOnGround(i) - VelocityOnGround(k);
    Add(VehicleUser(i), VehicleUser(k), seconds, std::hypot(v.x, v.y));
  }

  // Whether somebody stands on the carriageway before the vehicle, as far as its own lane tells: on the pavement people walk
  // towards the kerb and stop.
  bool OnCarriageway(uint32_t i, Vec3d p) {
    const Lane& lane = model_.lanes.lane(state_.vehicles[i].lane);
    const Path& path = PathOf(i);
    const auto nearest = std::ranges::min_element(path, {}, [&](const GroundBox& box) {
      const Vec2d away = OnGround(p) - box.center;
      return DotOf(away, away);
    });
    const double left = DotOf(OnGround(p) - nearest->center, LeftOf(nearest->ahead)) + model_.vehicles[i].shape.aside(lane);
    const bool at_kerb = lane.junction < 0 && lane.right == kNoLane;
    return left > -(at_kerb ? 0.5 : 1.5) * lane.width && left < 1.5 * lane.width;
  }

  void Meet(uint32_t i, const TrafficObstacle& other) {
    const double v = state_.vehicles[i].v, u = std::hypot(other.v.x, other.v.y);
    const VehicleShape& shape = model_.vehicles[i].shape;
    const Vec3d away = other.p - middles_[i];
    const bool drone = other.who.kind == RoadUser::Kind::kDrone;
    const double reach = (v + u) * kCriticalSeconds + (shape.length + shape.width) / 2 + other.radius;
    if ((drone ? v + Norm(other.v) : v) < kTooSlow || std::hypot(away.x, away.y) > reach) return;
    if (!drone && !OnCarriageway(i, other.p)) return;
    // Heights: of a person from the feet, of a drone around its middle.
    const double half = drone ? other.radius : 0.9, middle = drone ? away.z : away.z + half;
    const auto high = Within(middle - shape.height / 2, other.v.z, shape.height / 2 + half);
    const Path& path = PathOf(i);
    const double seconds = FirstMeeting([&](size_t at) {
      const double t = static_cast<double>(at) * kPathStep;
      const Vec2d step = (path[at + 1].center - path[at].center) * (1 / kPathStep), own{other.v.x, other.v.y};
      const auto level = ContactOf(path[at], OnGround(other.p) + own * t, other.radius, own - step);
      return Both(level, high ? std::optional(ContactTimes{high->begin - t, high->end - t}) : std::nullopt);
    });
    const Vec2d apart = VelocityOnGround(i) - Vec2d{other.v.x, other.v.y};
    Add(VehicleUser(i), other.who, seconds, std::hypot(apart.x, apart.y, other.v.z));
  }

  const TrafficModel& model_;
  const TrafficState& state_;
  const Occupancy& occupancy_;
  std::vector<Vec3d> middles_;  // by vehicle
  std::deque<Path> paths_;      // of those that somebody may meet
  std::vector<const Path*> path_of_;
  std::vector<std::pair<Cell, uint32_t>> cells_;
  std::vector<NearMiss> found_;
};

}  // namespace

std::optional<ContactTimes> ContactOf(const GroundBox& a, const GroundBox& b, Vec2d v) {
  std::optional<ContactTimes> times = kAlways;
  for (const Vec2d axis : {a.ahead, LeftOf(a.ahead), b.ahead, LeftOf(b.ahead)})
    times = Both(times, Within(DotOf(b.center - a.center, axis), DotOf(v, axis), ReachAlong(a, axis) + ReachAlong(b, axis)));
  return times;
}

std::optional<ContactTimes> ContactOf(const GroundBox& a, Vec2d center, double radius, Vec2d v) {
  // A point against the rectangle with rounded corners: two rectangles and four discs.
  const auto own = [&](Vec2d u) { return Vec2d{DotOf(u, a.ahead), DotOf(u, LeftOf(a.ahead))}; };
  const Vec2d p = own(center - a.center), w = own(v);
  const auto inside = [&](double length, double width) { return Both(Within(p.x, w.x, length), Within(p.y, w.y, width)); };
  auto times = Either(inside(a.half_length + radius, a.half_width), inside(a.half_length, a.half_width + radius));
  for (const double x : {-a.half_length, a.half_length})
    for (const double y : {-a.half_width, a.half_width}) times = Either(times, WithinDisc(p - Vec2d{x, y}, w, radius));
  return times;
}

std::vector<NearMiss> CriticalPairs(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy,
                                    std::span<const TrafficObstacle> obstacles) {
  CriticalSearch search(model, state, occupancy);
  search.Following();
  search.InJunctions();
  search.With(obstacles);
  return search.Finish();
}

void UpdateEncounters(std::span<const NearMiss> critical, int64_t t_ns, std::vector<Encounter>& encounters, std::vector<NearMiss>* over) {
  const auto pair_of = [](const Encounter& encounter) { return std::pair(encounter.worst.a, encounter.worst.b); };
  for (const NearMiss& miss : critical) {
    const auto at = std::ranges::lower_bound(encounters, std::pair(miss.a, miss.b), {}, pair_of);
    if (at == encounters.end() || pair_of(*at) != std::pair(miss.a, miss.b)) {
      encounters.insert(at, {miss, t_ns});
    } else {
      at->seen_ns = t_ns;
      if (miss.seconds < at->worst.seconds) at->worst = miss;
    }
  }
  const auto is_over = [&](const Encounter& encounter) { return t_ns - encounter.seen_ns >= kOverNs; };
  for (const Encounter& encounter : encounters)
    if (over != nullptr && is_over(encounter)) over->push_back(encounter.worst);
  std::erase_if(encounters, is_over);
}

}  // namespace airsim360::internal
