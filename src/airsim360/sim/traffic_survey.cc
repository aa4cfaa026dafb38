#include "airsim360/sim/traffic_survey.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/traffic/near_misses.h"

namespace airsim360 {
namespace {

using internal::ContactOf;
using internal::GroundBox;

constexpr double kInside = 0.05;    // metres from each side that count as inside
constexpr double kStoryHeight = 2;  // metres between those on bridges and those below
constexpr int64_t kLookNs = 1'000'000'000;

struct PlacedBox {
  GroundBox box;
  double z = 0;
};

std::vector<PlacedBox> BoxesOf(const SimTraffic& traffic, const TrafficState& state) {
  std::vector<PlacedBox> boxes;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const VehicleShape& shape = traffic.model.vehicles[i].shape;
    const RigidTransform X = PoseOf(traffic.model, state, i, state.t_ns);
    const Vec3d ahead = Normalized(Vec3d{X.R.column(0).x, X.R.column(0).y, 0});
    boxes.push_back({{{X.p.x, X.p.y}, {ahead.x, ahead.y}, shape.length / 2 - kInside, shape.width / 2 - kInside}, X.p.z});
  }
  return boxes;
}

double Distance(const PlacedBox& a, Vec2d p) { return std::hypot(a.box.center.x - p.x, a.box.center.y - p.y); }

int64_t CountOverlaps(const std::vector<PlacedBox>& boxes) {
  constexpr double kFar = 30;
  int64_t count = 0;
  for (size_t i = 0; i < boxes.size(); ++i)
    for (size_t k = i + 1; k < boxes.size(); ++k)
      count += std::abs(boxes[i].z - boxes[k].z) < kStoryHeight && Distance(boxes[i], boxes[k].box.center) < kFar &&
               ContactOf(boxes[i].box, boxes[k].box, {0, 0}).has_value();
  return count;
}

int64_t CountHit(const std::vector<PlacedBox>& boxes, const TrafficState& state, const PeopleState& people) {
  int64_t count = 0;
  for (const TrafficObstacle& person : ObstaclesOf(people))
    for (size_t i = 0; i < boxes.size(); ++i)
      count += std::abs(state.vehicles[i].v) > 0.5 && std::abs(boxes[i].z - person.p.z) < kStoryHeight &&
               Distance(boxes[i], {person.p.x, person.p.y}) < boxes[i].box.half_length + 1 &&
               ContactOf(boxes[i].box, {person.p.x, person.p.y}, 0, {0, 0}).has_value();
  return count;
}

/// Sums of looks.
class Looks {
 public:
  Looks(const SimTraffic& traffic, TrafficSurvey& survey) : traffic_(traffic), survey_(survey) {}

  void Add(const TrafficState& state, const PeopleState* people) {
    for (const DrivingVehicle& vehicle : state.vehicles) {
      ++count_;
      speed_ += vehicle.v;
      if (vehicle.stopped_ns < 0 || IsParked(vehicle)) continue;
      ++standing_;
      survey_.longest_standstill = std::max(survey_.longest_standstill, static_cast<double>(state.t_ns - vehicle.stopped_ns) * 1e-9);
    }
    const std::vector<PlacedBox> boxes = BoxesOf(traffic_, state);
    survey_.overlaps += CountOverlaps(boxes);
    if (people != nullptr) survey_.people_hit += CountHit(boxes, state, *people);
  }
  void Finish() {
    const double count = std::max(1.0, static_cast<double>(count_));
    survey_.mean_speed = speed_ / count;
    survey_.standing = static_cast<double>(standing_) / count;
  }

 private:
  const SimTraffic& traffic_;
  TrafficSurvey& survey_;
  int64_t count_ = 0, standing_ = 0;
  double speed_ = 0;
};

}  // namespace

TrafficSurvey SurveyTraffic(const SimModel& model, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point begin) { return std::chrono::duration<double, std::milli>(Clock::now() - begin).count(); };
  const SimTraffic& traffic = *model.traffic;
  TrafficSurvey survey;
  Looks looks(traffic, survey);
  TrafficState state = *traffic.start;
  std::optional<PeopleState> people;
  if (model.people) people = *model.people->start;
  const int64_t ticks = std::llround(seconds * 1e9) / kTrafficTickNs;
  for (int64_t tick = 1; tick <= ticks; ++tick) {
    const Clock::time_point begin = Clock::now();
    if (people) TickPeopleAmong(model, &state, {}, *people);
    survey.people_ms += since(begin);
    const Clock::time_point middle = Clock::now();
    TickTrafficAmong(model, people ? &*people : nullptr, state, &survey.near_misses);
    survey.tick_ms += since(middle);
    for (const DrivingVehicle& vehicle : state.vehicles) survey.hardest_braking = std::max(survey.hardest_braking, -vehicle.a);
    if (tick * kTrafficTickNs % kLookNs == 0) looks.Add(state, people ? &*people : nullptr);
  }
  looks.Finish();
  survey.seconds = static_cast<double>(ticks * kTrafficTickNs) * 1e-9;
  survey.tick_ms /= std::max(1.0, static_cast<double>(ticks));
  survey.people_ms /= std::max(1.0, static_cast<double>(ticks));
  for (NearMiss& miss : survey.near_misses) miss.t_ns -= traffic.epoch_ns;
  return survey;
}

}  // namespace airsim360
