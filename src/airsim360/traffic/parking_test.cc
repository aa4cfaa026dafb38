#include "airsim360/traffic/parking.h"

#include <gtest/gtest.h>

#include <set>

#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

using internal::ContactOf;
using internal::GroundBox;

constexpr double kGap = 14.5, kRow = -2.8;  // metres between the two parked cars; to the right of the lane

bool Overlap(const GroundBox& a, const GroundBox& b) { return ContactOf(a, b, {0, 0}).has_value(); }

Box3f CarAt(double rear, double aside) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(rear), f(aside - 0.9), 0}, {f(rear + 4.5), f(aside + 0.9), 1.5f}};
}

// A street of which the second lane, east of the junction at 100 m, has one bay between two parked cars.
struct StreetWithABay {
  std::vector<Box3f> cars = {CarAt(250, kRow), CarAt(254.5 + kGap, kRow)};
  std::vector<GroundBox> parked;
  TrafficModel model;

  explicit StreetWithABay(size_t count) : model(ModelOf(Street(100, {}), count)) {
    model.bays = ParkingBaysBeside(model.lanes, cars, {}).bays;
    for (const Box3f& car : cars) parked.push_back({{car.center().x, car.center().y}, {1, 0}, 2.25, 0.9});
  }

  // Drives until a vehicle has been through all phases of parking; false: not in that time. `each` looks after each tick.
  template <class Each>
  bool DriveUntilParkedAndGone(double seconds, TrafficState& state, const Each& each) const {
    std::set<Parking> seen;
    for (const int64_t end = state.t_ns + static_cast<int64_t>(seconds * 1e9); state.t_ns < end;) {
      TickTraffic(model, {}, state);
      for (const DrivingVehicle& vehicle : state.vehicles) seen.insert(vehicle.parking);
      each(state);
      if (seen.size() == 6 && std::ranges::all_of(state.vehicles, [](const auto& v) { return v.parking == Parking::kNone; })) return true;
    }
    return false;
  }
};

TEST(ParkingBays, AreGapsInRowsOfCarsWithNothingInThem) {
  const LaneMap lanes(Street(100, {}));
  const std::vector<Box3f> row = {CarAt(250, kRow), CarAt(254.5 + kGap, kRow)};
  const std::vector<ParkingBay> bays = ParkingBaysBeside(lanes, row, {}).bays;
  ASSERT_EQ(bays.size(), 1u);
  EXPECT_EQ(bays[0].lane, 2u);  // which begins at 110 m
  EXPECT_NEAR(bays[0].s, 254.5 + kGap - 1 - 110, 1e-3);
  EXPECT_NEAR(bays[0].aside, kRow, 1e-3);
  EXPECT_NEAR(bays[0].run, kGap - 1, 1e-3);

  const Box3f bin{{262, -3.5f, 0}, {262.5f, -3, 1}}, on_pavement{{262, -5.5f, 0}, {262.5f, -5, 1}}, cable{{262, -3.5f, 5}, {262.5f, -3, 6}};
  EXPECT_TRUE(ParkingBaysBeside(lanes, row, {{bin}}).bays.empty());
  EXPECT_EQ(ParkingBaysBeside(lanes, row, {{on_pavement, cable}}).bays.size(), 1u);
  // Too short; too long to be one row; another row; on the left; across the street.
  for (const auto& [gap, aside] : {std::pair{13.0, kRow}, {32.0, kRow}, {kGap, kRow - 1}}) {
    const std::vector<Box3f> other = {CarAt(250, kRow), CarAt(254.5 + gap, aside)};
    EXPECT_TRUE(ParkingBaysBeside(lanes, other, {}).bays.empty()) << gap << " " << aside;
  }
  const std::vector<Box3f> left = {CarAt(250, -kRow), CarAt(254.5 + kGap, -kRow)};
  EXPECT_TRUE(ParkingBaysBeside(lanes, left, {}).bays.empty());
}

TEST(ParkingBays, CarsGoWhereMoreBaysAreWanted) {
  const LaneMap lanes(Street(100, {}));
  std::vector<Box3f> row;
  for (int i = 0; i < 30; ++i) row.push_back(CarAt(200 + 5.7 * i, kRow));
  EXPECT_TRUE(ParkingBaysBeside(lanes, row, {}).bays.empty());
  for (const uint64_t seed : {1, 2, 3}) {
    const ParkingBays found = ParkingBaysBeside(lanes, row, {}, 4, seed);
    ASSERT_EQ(found.bays.size(), 4u);
    // Two gone leave 1.2 + 2 * 5.7 m, too few; three 18.3 m.
    ASSERT_EQ(found.away.size(), 12u);
    for (const ParkingBay& bay : found.bays) {
      EXPECT_NEAR(bay.run, 1.2 + 3 * 5.7 - 1, 1e-3);
      // Nobody who stays is in a bay, and somebody stands at both of its ends.
      size_t inside = 0, at_ends = 0;
      for (uint32_t i = 0; i < row.size(); ++i) {
        if (std::ranges::binary_search(found.away, i)) continue;
        const double rear = row[i].min.x - 110, front = row[i].max.x - 110;
        inside += front > bay.s - bay.run + 0.01 && rear < bay.s + 0.99;
        at_ends += std::abs(front - (bay.s - bay.run)) < 0.01 || std::abs(rear - (bay.s + 1)) < 0.01;
      }
      EXPECT_EQ(inside, 0u);
      EXPECT_EQ(at_ends, 2u);
    }
    EXPECT_EQ(found.away, ParkingBaysBeside(lanes, row, {}, 4, seed).away);
  }
  EXPECT_NE(ParkingBaysBeside(lanes, row, {}, 4, 1).away, ParkingBaysBeside(lanes, row, {}, 4, 2).away);
}

TEST(Parking, ACarDrivesInStandsStraightAndComesOutWithoutTouchingItsNeighbours) {
  const StreetWithABay street(1);
  ASSERT_EQ(street.model.bays.size(), 1u);
  TrafficState state;
  state.vehicles = {{.lane = 2, .ahead = {0, 1}, .s = 20, .v = 12, .bay = 0, .parking = Parking::kArriving}};
  int64_t stood = 0;
  double fastest_back = 0, steepest = 0;
  ASSERT_TRUE(street.DriveUntilParkedAndGone(300, state, [&](const TrafficState& now) {
    const GroundBox own = FootprintOf(street.model, now, 0);
    for (const GroundBox& other : street.parked) ASSERT_FALSE(Overlap(own, other)) << own.center.x << " " << own.center.y;
    const DrivingVehicle& car = now.vehicles[0];
    fastest_back = std::min(fastest_back, car.v);
    if (car.parking != Parking::kNone) steepest = std::max(steepest, std::abs(own.ahead.y));
    if (car.parking != Parking::kStanding) return;
    stood += kTrafficTickNs;
    EXPECT_NEAR(own.center.y, kRow, 0.05);
    EXPECT_NEAR(own.ahead.y, 0, 0.02);
    EXPECT_NEAR(own.center.x + own.half_length, street.cars[1].min.x - 1.3, 0.5);
    EXPECT_FALSE(car.braking);
    EXPECT_EQ(car.indicator, 0);
  }));
  EXPECT_GT(stood, 29'000'000'000);
  EXPECT_LT(stood, 181'000'000'000);
  EXPECT_NEAR(fastest_back, -1, 0.1);
  EXPECT_LT(steepest, std::sin(0.6));  // radians
}

TEST(Parking, WhoStandsInABayIsInNobodysWay) {
  StreetWithABay street(2);
  const ParkingBay& bay = street.model.bays[0];
  const auto metres_in = [&](bool parked) {
    TrafficState state;
    state.vehicles = {{.lane = 2, .ahead = {0, 1}, .s = 20, .v = 12}, {.lane = 2, .ahead = {0, 1}, .s = bay.s, .bay = 0}};
    state.vehicles[1].parking = Parking::kStanding;
    state.vehicles[1].parks_until_ns = INT64_MAX;
    if (!parked) state.vehicles[1].s = 3000;
    Drive(street.model, 20, state);
    return state.vehicles[0].s;
  };
  EXPECT_DOUBLE_EQ(metres_in(true), metres_in(false));
}

TEST(Parking, NobodyBacksUpIntoWhoStandsBehind) {
  const StreetWithABay street(1);
  const ParkingBay& bay = street.model.bays[0];
  for (const double behind : {0.6, 1.2}) {
    TrafficState state;
    state.vehicles = {{.lane = 2, .ahead = {0, 1}, .s = bay.s, .bay = 0, .parking = Parking::kStanding, .parks_until_ns = 0}};
    const GroundBox own = FootprintOf(street.model, state, 0);
    const TrafficObstacle person{.p = {own.center.x - own.half_length - behind, kRow + 0.4, 0}, .v = {}};
    Drive(street.model, 60, state, {&person, 1});
    EXPECT_EQ(state.vehicles[0].s, bay.s) << behind;
    EXPECT_EQ(state.vehicles[0].parking, Parking::kBacking) << behind;
    Drive(street.model, 60, state);
    EXPECT_EQ(state.vehicles[0].parking, Parking::kNone) << behind;
  }
}

// One drives by every few seconds; nobody has to brake hard for the one that comes out.
TEST(Parking, LeavesIntoAGapAlone) {
  StreetWithABay street(12);
  const ParkingBay& bay = street.model.bays[0];
  for (const double apart : {25.0, 45.0, 70.0}) {
    TrafficState state;
    state.vehicles.assign(12, {});
    state.vehicles[0] = {.lane = 2, .ahead = {0, 1}, .s = bay.s, .bay = 0, .parking = Parking::kStanding, .parks_until_ns = 0};
    for (size_t i = 1; i < 12; ++i)
      state.vehicles[i] = {.lane = 2, .ahead = {0, 1}, .s = bay.s + 400 - apart * static_cast<double>(i), .v = 13};
    for (size_t i = 1; i < 12; ++i)
      if (state.vehicles[i].s < 10) state.vehicles[i].s = 1000 + apart * static_cast<double>(i);
    double hardest = 0;
    std::vector<NearMiss> misses;
    for (int tick = 0; tick < 2400; ++tick) {
      TickTraffic(street.model, {}, state, &misses);
      for (size_t i = 1; i < 12; ++i) hardest = std::min(hardest, state.vehicles[i].a);
      const GroundBox own = FootprintOf(street.model, state, 0);
      for (size_t i = 1; i < 12; ++i) ASSERT_FALSE(Overlap(own, FootprintOf(street.model, state, i))) << apart;
    }
    EXPECT_EQ(state.vehicles[0].parking, Parking::kNone) << apart;
    EXPECT_GT(hardest, -3.5) << apart;
    EXPECT_TRUE(misses.empty()) << apart;
  }
}

TEST(Parking, TwoNeverChooseTheSameBayAndACopyOfTheStateGoesOnAlike) {
  StreetWithABay street(40);
  TrafficState state = StartTraffic(street.model);
  int parked = 0;
  for (int second = 0; second < 1500; ++second) {
    Drive(street.model, 1, state);
    ASSERT_LE(std::ranges::count_if(state.vehicles, [](const auto& v) { return v.bay == 0; }), 1);
    parked += std::ranges::count_if(state.vehicles, IsParked) > 0;
    if (parked != 3) continue;
    ++parked;
    TrafficState copy = state;
    Drive(street.model, 120, copy);
    TrafficState other = state;
    Drive(street.model, 120, other);
    EXPECT_EQ(HashTraffic(copy), HashTraffic(other));
    other.vehicles[0].leaves_s += 1;
    EXPECT_NE(HashTraffic(copy), HashTraffic(other));
  }
  EXPECT_GT(parked, 30);
}

}  // namespace
}  // namespace airsim360
