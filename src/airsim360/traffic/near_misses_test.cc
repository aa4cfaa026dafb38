#include "airsim360/traffic/near_misses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

using internal::ContactOf;
using internal::ContactTimes;
using internal::GroundBox;
using Kind = RoadUser::Kind;

const GroundBox kCar{.center = {0, 0}, .ahead = {1, 0}, .half_length = 2.25, .half_width = 0.9};

TEST(ContactOf, RectanglesMeetWhenTheClosedFormSays) {
  GroundBox other = kCar;
  other.center = {20, 0};
  const auto head_on = ContactOf(kCar, other, {-10, 0});
  ASSERT_TRUE(head_on);
  EXPECT_NEAR(head_on->begin, (20 - 4.5) / 10, 1e-12);
  EXPECT_NEAR(head_on->end, (20 + 4.5) / 10, 1e-12);
  // From the side, at 5 m/s against 10: the later of the two axes decides.
  other = {.center = {20, -12}, .ahead = {0, 1}, .half_length = 2.25, .half_width = 0.9};
  const auto crossing = ContactOf(kCar, other, {-10, 5});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->begin, std::max((20 - 2.25 - 0.9) / 10, (12 - 0.9 - 2.25) / 5), 1e-12);
  // A square on its corner reaches farther.
  const double h = std::sqrt(0.5);
  const auto corner = ContactOf({{0, 0}, {1, 0}, 1, 1}, {{10, 0}, {h, h}, 1, 1}, {-2, 0});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->begin, (10 - 1 - std::sqrt(2)) / 2, 1e-12);
  EXPECT_FALSE(ContactOf(kCar, {{20, 2}, {1, 0}, 2.25, 0.9}, {-10, 0}));  // passes beside it
  EXPECT_FALSE(ContactOf(kCar, {{20, 0}, {1, 0}, 2.25, 0.9}, {0, 0}));    // keeps its distance
}

TEST(ContactOf, ADiscMeetsSidesAndRoundedCorners) {
  const double r = 0.5;
  const auto front = ContactOf(kCar, {12, 0}, r, {-10, 0});
  ASSERT_TRUE(front);
  EXPECT_NEAR(front->begin, (12 - 2.25 - r) / 10, 1e-12);
  // 0.6 of the radius beside the corner: 0.8 of it before.
  const auto corner = ContactOf(kCar, {12, 0.9 + 0.6 * r}, r, {-10, 0});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->begin, (12 - 2.25 - 0.8 * r) / 10, 1e-12);
  EXPECT_FALSE(ContactOf(kCar, {12, 0.9 + 1.01 * r}, r, {-10, 0}));
}

// Second method: where both are in small steps of time.
TEST(ContactOf, AgreesWithSmallStepsOfTime) {
  RngStream rng(7, "contacts");
  constexpr double kStep = 0.002;
  int met = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto any = [&] {
      const double angle = rng.Uniform(0, 6.28);
      return GroundBox{
          {rng.Uniform(-12, 12), rng.Uniform(-12, 12)}, {std::cos(angle), std::sin(angle)}, rng.Uniform(0.5, 4), rng.Uniform(0.3, 2)};
    };
    const GroundBox a = any(), b = any();
    const Vec2d v{rng.Uniform(-10, 10), rng.Uniform(-10, 10)};
    const auto times = ContactOf(a, b, v);
    double first = INFINITY;
    for (double t = 0; t < 3 && !std::isfinite(first); t += kStep)
      if (const auto now = ContactOf(a, {b.center + v * t, b.ahead, b.half_length, b.half_width}, {0, 0})) first = t;
    const double expected = times && times->end >= 0 ? std::max(0.0, times->begin) : INFINITY;
    if (expected < 2.9) {
      ++met;
      EXPECT_NEAR(first, expected, kStep + 1e-9) << trial;
    } else {
      EXPECT_GT(first, 2.9) << trial;
    }
  }
  EXPECT_GT(met, 40);
}

// A vehicle of 4.5 m with its front at x = 100 that drives east at v.
TrafficState OneAt100(double v) {
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = v}};
  return state;
}

std::vector<NearMiss> Critical(const TrafficModel& model, const TrafficState& state, std::vector<TrafficObstacle> obstacles = {}) {
  return internal::CriticalPairs(model, state, internal::Occupancy(model, state), obstacles);
}

TEST(NearMisses, BehindAStandingVehicleTheTimeIsGapOverSpeed) {
  const TrafficModel model = ModelOf(Street(900, {}), 2);
  for (const double gap : {30.0, 12.0, 4.0}) {
    TrafficState state = OneAt100(12);
    state.vehicles.push_back({.lane = 0, .ahead = {1, 2}, .s = 100 + gap + 4.5});
    const std::vector<NearMiss> found = Critical(model, state);
    ASSERT_EQ(found.size(), gap / 12 <= kCriticalSeconds ? 1u : 0u) << gap;
    if (found.empty()) continue;
    EXPECT_EQ(found[0].a, (RoadUser{Kind::kVehicle, 0}));
    EXPECT_EQ(found[0].b, (RoadUser{Kind::kVehicle, 1}));
    EXPECT_NEAR(found[0].seconds, gap / 12, 1e-12);
    EXPECT_NEAR(found[0].braking, 12 * 12 / (2 * gap), 1e-9);
  }
  // As near, but so slow that it brakes gently.
  TrafficState slow = OneAt100(2);
  slow.vehicles.push_back({.lane = 0, .ahead = {1, 2}, .s = 100 + 2 + 4.5});
  EXPECT_TRUE(Critical(model, slow).empty());
}

// Two streets that cross at 0, 0, each with a way back of its own far away.
std::shared_ptr<const RoadNetwork> Cross() {
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{-200, 0, 0}, {-10, 0, 0}}, .next = {1}},
                  {.points = {{-10, 0, 0}, {10, 0, 0}}, .next = {2}, .junction = 0},
                  {.points = {{10, 0, 0}, {900, 0, 0}, {900, 900, 0}, {-200, 900, 0}, {-200, 0, 0}}, .next = {0}},
                  {.points = {{0, -200, 0}, {0, -10, 0}}, .next = {4}},
                  {.points = {{0, -10, 0}, {0, 10, 0}}, .next = {5}, .junction = 0},
                  {.points = {{0, 10, 0}, {0, 800, 0}, {-900, 800, 0}, {-900, -200, 0}, {0, -200, 0}}, .next = {3}}};
  roads->junctions = {{.center = {0, 0, 0}, .radius = 10, .phases = {}}};
  return roads;
}

TEST(NearMisses, TwoThatWereLetIntoOneJunctionMeetWhenBothReachTheOthersWay) {
  const TrafficModel model = ModelOf(Cross(), 2);
  TrafficState state;
  // Front 12 m before the crossing at 12 m/s, and 9.9 m before it at 9: both are 0.9 m wide to each side.
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 188, .v = 12, .granted = true},
                    {.lane = 3, .ahead = {4, 5}, .s = 190.1, .v = 9, .granted = true}};
  const std::vector<NearMiss> found = Critical(model, state);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].seconds, std::max((12 - 0.9) / 12, (9.9 - 0.9) / 9), 1e-9);
  EXPECT_NEAR(found[0].braking, 15 / (2 * found[0].seconds), 1e-9);
  // One that waits to be let in is no danger, nor one that comes when the other has passed.
  TrafficState waits = state, late = state;
  waits.vehicles[1].granted = false;
  EXPECT_TRUE(Critical(model, waits).empty());
  late.vehicles[1].s = 175;
  EXPECT_TRUE(Critical(model, late).empty());
}

TEST(NearMisses, APersonInTheWayCountsFromTheFrontAndOneWhoWalksOnDoesNot) {
  const TrafficModel model = ModelOf(Street(900, {}), 1);
  const TrafficState state = OneAt100(12);
  const auto seconds = [&](Vec3d p, Vec3d v = {}, RoadUser who = {Kind::kPerson, 3}) {
    const std::vector<NearMiss> found = Critical(model, state, {{p, v, 0.3, who}});
    if (found.empty()) return static_cast<double>(INFINITY);
    EXPECT_EQ(found[0].b, who);
    return found[0].seconds;
  };
  EXPECT_NEAR(seconds({112.3, 0, 0}), 1, 1e-9);
  EXPECT_NEAR(seconds({112.3, 0, 0}, {-2, 0, 0}), 12 / 14.0, 1e-9);
  EXPECT_EQ(seconds({112.3, 1.25, 0}), INFINITY);              // beside it
  EXPECT_EQ(seconds({112.3, 0, 4}), INFINITY);                 // on a bridge
  EXPECT_EQ(seconds({112.3, 0.5, 0}, {0, 1.5, 0}), INFINITY);  // leaves its way in time: 0.7 m in half a second
  // Comes from the left into its front half a second before it has passed.
  EXPECT_NEAR(seconds({112, 2.7, 0}, {0, -1.5, 0}), 1, 1e-9);
  // Walks towards the kerb 2 m to the right of the middle of the lane: on the pavement.
  EXPECT_EQ(seconds({112, -2.7, 0}, {0, 1.5, 0}), INFINITY);
}

TEST(NearMisses, ADroneCountsInAllThreeDirections) {
  TrafficModel model = ModelOf(Street(900, {}), 1);
  const TrafficState state = OneAt100(12);
  const auto seconds = [&](Vec3d p, Vec3d v) {
    const std::vector<NearMiss> found = Critical(model, state, {{p, v, 0.5, {Kind::kDrone, 0}}});
    return found.empty() ? INFINITY : found[0].seconds;
  };
  // Falls onto the roof, 1.5 m high, of the place where the vehicle will be.
  EXPECT_NEAR(seconds({97.75 + 12 * 0.8, 0, 1.5 + 0.5 + 8}, {0, 0, -10}), 0.8, 1e-9);
  EXPECT_EQ(seconds({97.75 + 12 * 0.8, 0, 1.5 + 0.5 + 8}, {0, 0, 10}), INFINITY);
  EXPECT_EQ(seconds({97.75, 0, 1.5 + 0.6}, {12, 0, 0}), INFINITY);  // flies along above it
  // From the side at 20 m/s, from farther than the next cell of the search.
  EXPECT_NEAR(seconds({97.75 + 12 * 1.2, 0.9 + 0.5 + 40 * 1.2, 0.8}, {0, -40, 0}), 1.2, 1e-9);
}

TEST(NearMisses, AnEncounterIsToldOnceWithItsWorstMomentAndSnapshotsGoOn) {
  const TrafficModel model = ModelOf(Street(900, {}), 1);
  TrafficState state = OneAt100(12);
  // Somebody jumps into the street 9.3 m ahead and out of it again after a second.
  const auto drive = [&](TrafficState& driven, double until, std::vector<NearMiss>& over) {
    while (driven.t_ns < until * 1e9) {
      const TrafficObstacle jumper{{109.3, driven.t_ns < 1'000'000'000 ? 0.0 : 30.0, 0}, {}};
      TickTraffic(model, std::span(&jumper, 1), driven, &over);
    }
  };
  std::vector<NearMiss> over, again;
  drive(state, 0.5, over);
  EXPECT_TRUE(over.empty());
  ASSERT_EQ(state.encounters.size(), 1u);
  TrafficState snapshot = state;
  drive(state, 4, over);
  drive(snapshot, 4, again);
  ASSERT_EQ(over.size(), 1u);
  EXPECT_LE(over[0].seconds, 9 / 12.0 + 1e-9);
  EXPECT_GE(over[0].braking, 12 * 12 / 18.0 - 1e-9);
  EXPECT_TRUE(state.encounters.empty());
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].t_ns, over[0].t_ns);
  EXPECT_EQ(again[0].seconds, over[0].seconds);
  EXPECT_EQ(HashTraffic(snapshot), HashTraffic(state));
  TrafficState other = state;
  other.encounters.push_back({over[0], 0});
  EXPECT_NE(HashTraffic(other), HashTraffic(state));
}

TEST(NearMisses, WhoBrakesInTimeForPeopleVehiclesAndRedLightsHasNone) {
  const TrafficModel model = ModelOf(Street(300, {{0, 40, 0, 0}, {1, 30, 3, 2}}), 2);
  TrafficState state = OneAt100(12);
  state.vehicles.push_back({.lane = 0, .ahead = {1, 2}, .s = 50, .v = 13});
  std::vector<NearMiss> over;
  while (state.t_ns < 60'000'000'000) {
    const TrafficObstacle person{{180, state.t_ns < 20'000'000'000 ? 0.0 : 9.0, 0}, {}};
    TickTraffic(model, std::span(&person, 1), state, &over);
  }
  EXPECT_TRUE(over.empty());
  EXPECT_TRUE(state.encounters.empty());
  EXPECT_NE(state.vehicles[0].lane, 0u);
}

}  // namespace
}  // namespace airsim360
