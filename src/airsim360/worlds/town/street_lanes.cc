#include "airsim360/worlds/town/street_lanes.h"

#include <cmath>

#include "airsim360/worlds/kit/road_builder.h"
#include "airsim360/worlds/town/ground.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360 {
namespace {

constexpr float kStopLine = 5.8f;                           // metres from the end of a stretch: just before the bar (street_markings.cc)
constexpr float kParking = 2.35f;                           // metres of bay at the kerb
constexpr float kStreetSpeed = 8.9f, kAvenueSpeed = 11.2f;  // m/s: 20 and 25 mph

// Lanes of one side as LayMarkings paints them: `d` of StreetStretch, whose sign is the side's.
std::vector<RoadLane> LanesOf(const StreetLine& line, bool with_axis, bool bike_lane, bool green) {
  const float parking = line.half_width - kParking;
  switch (line.kind) {
    case StreetKind::kTwoWay: {
      const float outer = bike_lane ? parking - 1.6f : parking;
      std::vector<RoadLane> lanes{{(0.2f + outer) / 2, outer - 0.2f}};
      if (bike_lane) lanes.push_back({.offset = parking - 0.86f, .width = 1.48f, .cycle = true});
      return lanes;
    }
    case StreetKind::kAvenue:
      return {{1.95f, 3.5f}, {5.45f, 3.5f}, {(7.2f + parking) / 2, parking - 7.2f}};
    case StreetKind::kBoulevard:
      if (with_axis && green) return {{4.0f, 3}, {7.1f, 3.1f}, {.offset = 9.6f, .width = 1.7f, .cycle = true}};
      if (with_axis) return {{4.0f, 3}, {7.1f, 3.1f}};
      return {{4.1f, 3.5f}, {7.65f, 3.5f}, {(9.5f + line.half_width - 0.4f) / 2, line.half_width - 9.9f, true}};
  }
  return {};
}

// Height of the streets: crowned, and the fans of crossings.
float HeightAt(const StreetPlan& plan, Vec2f p) {
  const auto nearest = [](const std::vector<StreetLine>& lines, float at) {
    const StreetLine* best = &lines.front();
    for (const StreetLine& line : lines)
      if (std::abs(line.center - at) < std::abs(best->center - at)) best = &line;
    return best;
  };
  const StreetLine& ns = *nearest(plan.north_south, p.x);
  const StreetLine& ew = *nearest(plan.east_west, p.y);
  const float x = p.x - ns.center, y = p.y - ew.center;
  if (std::abs(x) <= ns.half_width + kCornerRadius && std::abs(y) <= ew.half_width + kCornerRadius)
    return internal::FanOf(ns, ew).Height(p);
  return std::abs(x) <= ns.half_width ? CarriagewayHeight(ns, x) : CarriagewayHeight(ew, y);
}

}  // namespace

RoadNetwork RoadsOf(const StreetPlan& plan) {
  RoadBuilder builder([&](Vec2f p) { return HeightAt(plan, p); });
  const size_t columns = plan.north_south.size(), rows = plan.east_west.size();
  for (size_t i = 0; i < columns; ++i) {
    for (size_t k = 0; k < rows; ++k) {
      const StreetLine &ns = plan.north_south[i], &ew = plan.east_west[k];
      const bool four_ways = i > 0 && k > 0 && i + 1 < columns && k + 1 < rows;
      builder.AddJunction({ns.center, ew.center}, std::max(ns.half_width, ew.half_width) + kCornerRadius + kStopLine,
                          four_ways ? CrossStreetSignals() : std::vector<SignalPhase>{});
    }
  }
  const auto add = [&](const StreetLine& line, bool along_x, bool bike_lane, const StreetLine& start, const StreetLine& end, size_t from,
                       size_t to) {
    const float s0 = start.center + start.half_width + kCornerRadius + kStopLine,
                s1 = end.center - end.half_width - kCornerRadius - kStopLine;
    const auto at = [&](float s) { return along_x ? Vec2f{s, line.center} : Vec2f{line.center, s}; };
    const bool wide = line.kind != StreetKind::kTwoWay;
    const int32_t head = along_x ? kEastWestHead : kNorthSouthHead;
    builder.AddRoad({.from = from,
                     .to = to,
                     .axis = {at(s0), at(s1)},
                     .forward = LanesOf(line, true, bike_lane, plan.paint == RoadPaint::kToday),
                     .backward = LanesOf(line, false, bike_lane, plan.paint == RoadPaint::kToday),
                     .speed = wide ? kAvenueSpeed : kStreetSpeed,
                     .priority = static_cast<uint8_t>(wide),
                     .signal_to = head,
                     .signal_from = head});
  };
  for (size_t i = 0; i < columns; ++i)
    for (size_t k = 0; k + 1 < rows; ++k)
      add(plan.north_south[i], false, false, plan.east_west[k], plan.east_west[k + 1], i * rows + k, i * rows + k + 1);
  for (size_t k = 0; k < rows; ++k)
    for (size_t i = 0; i + 1 < columns; ++i)
      add(plan.east_west[k], true, static_cast<int>(k) == plan.bike_lane_row, plan.north_south[i], plan.north_south[i + 1], i * rows + k,
          (i + 1) * rows + k);
  return builder.Build();
}

}  // namespace airsim360
