#include "airsim360/traffic/parking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "airsim360/base/random.h"
#include "airsim360/math/box_overlap.h"

namespace airsim360 {
namespace {

constexpr double kInFront = 1;  // metres from the end of a bay to the car in front

}  // namespace

namespace internal {
namespace {

constexpr double kChance = 0.4;                     // of a car that comes to a lane with a free bay
constexpr double kLeastStay = 30, kMostStay = 180;  // seconds
constexpr double kSpare = 8.5;                      // metres of a bay beyond the length of a car, to turn in and out
constexpr double kBehind = 0.5, kMostBack = 8;      // metres to the car behind, backed up; of backing up
constexpr double kBeforeTurn = 1, kPastTurn = 1;    // metres beside the cars behind and in front, where the way begins and ends to bend
constexpr double kInPlace = 0.6, kBackedUp = 0.1;   // metres to where it stands, forwards and backwards
constexpr double kStandstill = 0.1;                 // m/s
constexpr double kBackingSpeed = 1, kBackingAcceleration = 0.7, kLooksBack = 1.5;  // m/s, m/s^2, metres
constexpr double kTickSeconds = static_cast<double>(kTrafficTickNs) * 1e-9;
constexpr double kWidestCar = 2.1, kLongestCar = 6;  // metres

double Smooth(double x) {
  const double u = std::clamp(x, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

double RearAxle(const VehicleShape& shape) { return shape.front_overhang() + shape.wheelbase(); }

// How far one backs up before it leaves.
double BacksTo(const ParkingBay& bay, const VehicleShape& shape) { return bay.s - std::min(bay.run - shape.length - kBehind, kMostBack); }

// Where the way out bends: from the front axle when it left to just past the rear of the car in front.
double LeavesFrom(const DrivingVehicle& own, const VehicleShape& shape) { return own.leaves_s - shape.front_overhang(); }
double LeavesTo(const ParkingBay& bay) { return bay.s + kInFront + kPastTurn; }

}  // namespace

double ParkingShift(const TrafficModel& model, const DrivingVehicle& own, const VehicleShape& shape, double s) {
  if (own.parking == Parking::kNone) return 0;
  const ParkingBay& bay = model.bays[own.bay];
  if (IsParked(own)) return bay.aside;
  if (own.parking == Parking::kLeaving) {
    const double from = LeavesFrom(own, shape);
    return bay.aside * (1 - Smooth((s - from) / (LeavesTo(bay) - from)));
  }
  const double from = bay.s - bay.run - kBeforeTurn, to = bay.s - RearAxle(shape);
  return bay.aside * Smooth((s - from) / (to - from));
}

double ToParkingTurn(const TrafficModel& model, const DrivingVehicle& own) {
  if (own.parking != Parking::kArriving) return 0;
  const ParkingBay& bay = model.bays[own.bay];
  return std::max(0.0, bay.s - bay.run - kBeforeTurn - own.s);
}

double GapToBay(const TrafficModel& model, const DrivingVehicle& own) {
  return own.parking == Parking::kArriving ? model.bays[own.bay].s - own.s : INFINITY;
}

ParkingTick::ParkingTick(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy, const ObstacleGrid& obstacles,
                         LaneChanges& lane_changes)
    : model_(model), state_(state), occupancy_(occupancy), obstacles_(obstacles), lane_changes_(lane_changes), taken_(model.bays.size()) {
  for (const DrivingVehicle& vehicle : state.vehicles)
    if (vehicle.bay != kNoBay) taken_[vehicle.bay] = true;
}

void ParkingTick::Choose(uint32_t vehicle, DrivingVehicle& own) {
  const TrafficVehicle& car = model_.vehicles[vehicle];
  if (car.shape.bus || car.shape.bicycle || car.shape.width > kWidestCar || car.shape.length > kLongestCar) return;
  const auto on_lane = std::ranges::equal_range(model_.bays, own.lane, {}, &ParkingBay::lane);
  const double least = own.s + own.v * own.v / car.driver.braking + kBeforeTurn;
  std::vector<uint32_t> free;
  for (const ParkingBay& bay : on_lane) {
    const auto index = static_cast<uint32_t>(&bay - model_.bays.data());
    if (!taken_[index] && bay.run >= car.shape.length + kSpare && bay.s - bay.run > least) free.push_back(index);
  }
  if (free.empty()) return;
  RngStream rng(model_.seed, "parking", uint64_t{vehicle} << 32 | own.choices);
  if (!rng.Chance(kChance)) return;
  own.bay = free[rng.Index(static_cast<uint32_t>(free.size()))];
  own.parking = Parking::kArriving;
  taken_[own.bay] = true;
}

void ParkingTick::Consider(uint32_t vehicle, int64_t t_ns, DrivingVehicle& own) {
  if (own.parking == Parking::kNone) {
    if (own.lane != state_.vehicles[vehicle].lane && own.left_lane == kNoLane) Choose(vehicle, own);
  } else if (own.parking == Parking::kArriving) {
    if (own.v > kStandstill || GapToBay(model_, own) > kInPlace) return;
    RngStream rng(model_.seed, "parked", uint64_t{vehicle} << 32 | own.choices);
    own.parking = Parking::kStanding;
    own.v = own.a = 0;
    own.braking = false;
    own.indicator = 0;
    own.parks_until_ns = t_ns + std::llround(rng.Uniform(kLeastStay, kMostStay) * 1e9);
  } else if (own.s - RearAxle(model_.vehicles[vehicle].shape) > LeavesTo(model_.bays[own.bay])) {
    own.parking = Parking::kNone;
    own.bay = kNoBay;
  }
}

void ParkingTick::Stay(uint32_t vehicle, int64_t t_ns, DrivingVehicle& own) {
  const VehicleShape& shape = model_.vehicles[vehicle].shape;
  own.braking = false;
  own.indicator = own.parking == Parking::kStanding ? int8_t{0} : int8_t{1};
  if (own.parking == Parking::kStanding) {
    if (own.stopped_ns < 0) own.stopped_ns = t_ns;
    if (t_ns >= own.parks_until_ns) own.parking = Parking::kBacking;
  } else if (own.parking == Parking::kBacking) {
    if (obstacles_.IsBehind(model_, state_, vehicle, kLooksBack)) {
      own.v = own.a = 0;
      return;
    }
    const double rest = own.s - BacksTo(model_.bays[own.bay], shape), step = kBackingAcceleration * kTickSeconds, before = own.v;
    const double wanted = -std::min(kBackingSpeed, std::sqrt(kBackingAcceleration * std::max(0.0, rest)));
    own.v = rest > kBackedUp ? std::clamp(wanted, own.v - step, own.v + step) : 0;
    own.a = (own.v - before) / kTickSeconds;
    own.s += (before + own.v) / 2 * kTickSeconds;
    own.stopped_ns = -1;
    if (own.v == 0) own.parking = Parking::kWaiting;
  } else if (MayLeave(vehicle, own)) {
    own.parking = Parking::kLeaving;
    own.parks_until_ns = -1;
    own.leaves_s = own.s;
    lane_changes_.Take(own.lane, own.s);
  }
}

// Who comes must not have to brake hard: 2.5 s and a length of its own away, and none stands where it would come out.
bool ParkingTick::MayLeave(uint32_t vehicle, const DrivingVehicle& own) const {
  constexpr double kSeconds = 2.5, kBack = 8, kAhead = 12;
  if (lane_changes_.TakenThisTick(own.lane, own.s)) return false;
  const double rear = own.s - model_.vehicles[vehicle].shape.length;
  const auto comes = [&](const Occupant& o, double distance) {
    return distance < kBack + kSeconds * state_.vehicles[o.vehicle].v + 0.25 * state_.vehicles[o.vehicle].v * state_.vehicles[o.vehicle].v;
  };
  for (const Occupant& o : occupancy_.On(own.lane)) {
    if (o.vehicle == vehicle || o.rear > own.s + kAhead) continue;
    if (o.front > rear || comes(o, rear - o.front)) return false;
  }
  for (const LaneId before : model_.lanes.previous(own.lane))
    for (const Occupant& o : occupancy_.On(before))
      if (comes(o, rear + model_.lanes.length(before) - o.front)) return false;
  return true;
}

}  // namespace internal

namespace {

// A car beside a lane: its body covers rear ... front along it, its middle is `aside` metres to the left.
struct KerbCar {
  double rear = 0, front = 0, aside = 0;
  uint32_t index = 0;
};

constexpr double kFarthest = 5, kNearest = 1.8;        // metres from the middle of the lane
constexpr double kShortestGap = 14, kLongestGap = 30;  // metres between two cars
constexpr size_t kMostGone = 3;                        // cars next to each other
constexpr double kSameRow = 0.6;                       // metres aside
constexpr double kFreeWidth = 1.1;                     // metres on both sides of the middle of a bay
constexpr double kLow = 0.25, kHigh = 2;               // metres above the lane between which something is in the way
constexpr double kToTheEnd = 8;                        // metres of lane after a bay

std::map<LaneId, std::vector<KerbCar>> CarsBeside(const LaneMap& lanes, std::span<const Box3f> cars) {
  std::map<LaneId, std::vector<KerbCar>> rows;
  for (uint32_t i = 0; i < cars.size(); ++i) {
    const Box3f& box = cars[i];
    const Vec3d middle = VecCast<double>(box.center());
    const auto at_the_kerb = [](const Lane& lane) { return lane.junction < 0 && !lane.bus && !lane.cycle && lane.right == kNoLane; };
    const auto [beside, best] =
        internal::NearestLane(lanes, middle, kFarthest, at_the_kerb, [](LaneId, const NearestLanePoint&) { return true; });
    if (beside == kNoLane) continue;
    const LanePoint at = lanes.At(beside, best.s);
    const double left = internal::LeftOfLane(lanes, beside, best.s, middle);
    if (left > -kNearest) continue;
    const double half = (std::abs(at.direction.x) * box.size().x + std::abs(at.direction.y) * box.size().y) / 2;
    rows[beside].push_back({best.s - half, best.s + half, left, i});
  }
  for (auto& [lane, row] : rows) std::ranges::sort(row, {}, [](const KerbCar& car) { return std::pair(car.rear, car.index); });
  return rows;
}

Box3f BoxOfBay(const LaneMap& lanes, const ParkingBay& bay) {
  Box3f box;
  for (const double s : {bay.s + kInFront, bay.s - bay.run / 2, bay.s - bay.run}) {
    const LanePoint at = lanes.At(bay.lane, s);
    for (const double aside : {bay.aside - kFreeWidth, bay.aside + kFreeWidth})
      for (const double up : {kLow, kHigh})
        box.Add(VecCast<float>(at.p + Vec3d{-at.direction.y, at.direction.x, 0} * aside + Vec3d{0, 0, up}));
  }
  return box;
}

// A bay between two cars of a row when those between them are gone.
struct BayBetween {
  ParkingBay bay;
  std::span<const KerbCar> gone;
};

class BayFinder {
 public:
  BayFinder(const LaneMap& lanes, std::span<const Box3f> others) : lanes_(lanes), others_(others) {}

  std::optional<BayBetween> Between(LaneId lane, std::span<const KerbCar> row, size_t behind, size_t front) const {
    const KerbCar &b = row[behind], &f = row[front];
    const double gap = f.rear - b.front;
    if (gap < kShortestGap || gap > kLongestGap) return std::nullopt;
    for (size_t k = behind + 1; k <= front; ++k)
      if (std::abs(row[k].aside - b.aside) > kSameRow) return std::nullopt;
    const ParkingBay bay{lane, f.rear - kInFront, (f.aside + b.aside) / 2, gap - kInFront};
    if (bay.s + kToTheEnd >= lanes_.length(lane)) return std::nullopt;
    const Box3f box = BoxOfBay(lanes_, bay);
    if (std::ranges::any_of(others_, [&](const Box3f& other) { return Overlap(box, other); })) return std::nullopt;
    return BayBetween{bay, row.subspan(behind + 1, front - behind - 1)};
  }

 private:
  const LaneMap& lanes_;
  std::span<const Box3f> others_;
};

}  // namespace

ParkingBays ParkingBaysBeside(const LaneMap& lanes, std::span<const Box3f> cars, std::span<const Box3f> others, size_t wanted,
                              uint64_t seed) {
  const std::map<LaneId, std::vector<KerbCar>> rows = CarsBeside(lanes, cars);
  const BayFinder finder(lanes, others);
  ParkingBays found;
  std::vector<bool> used(cars.size());  // gone, or beside a bay
  std::vector<std::tuple<LaneId, size_t, size_t>> pairs;
  for (const auto& [lane, row] : rows) {
    for (size_t behind = 0; behind + 1 < row.size(); ++behind) {
      if (const std::optional<BayBetween> between = finder.Between(lane, row, behind, behind + 1)) {
        found.bays.push_back(between->bay);
        used[row[behind].index] = used[row[behind + 1].index] = true;
      }
      for (size_t gone = 1; gone <= kMostGone && behind + gone + 1 < row.size(); ++gone)
        pairs.emplace_back(lane, behind, behind + gone + 1);
    }
  }
  RngStream rng(seed, "parking bays");
  for (size_t i = 0; i < pairs.size() && found.bays.size() < wanted; ++i) {
    std::swap(pairs[i], pairs[i + rng.Index(static_cast<uint32_t>(pairs.size() - i))]);
    const auto& [lane, behind, front] = pairs[i];
    const std::span<const KerbCar> row = rows.at(lane), all = row.subspan(behind, front - behind + 1);
    if (std::ranges::any_of(all, [&](const KerbCar& car) { return used[car.index]; })) continue;
    const std::optional<BayBetween> between = finder.Between(lane, row, behind, front);
    if (!between) continue;
    found.bays.push_back(between->bay);
    for (const KerbCar& car : all) used[car.index] = true;
    for (const KerbCar& car : between->gone) found.away.push_back(car.index);
  }
  std::ranges::sort(found.bays, {}, [](const ParkingBay& bay) { return std::pair(bay.lane, bay.s); });
  std::ranges::sort(found.away);
  return found;
}

}  // namespace airsim360
