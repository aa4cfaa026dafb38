#include "airsim360/worlds/osm/osm_lanes.h"

#include <algorithm>
#include <cmath>

#include "airsim360/worlds/kit/road_builder.h"

namespace airsim360::internal {
namespace {

constexpr int kWorstRank = 5;               // service ways and worse are left to walkers
constexpr double kStreetDepth = 0.13;       // metres below the pavements
constexpr double kBend = 3;                 // metres that even a bend without a junction takes of its arms
constexpr double kSignalledCrossing = 5.5;  // metres more where a crossing with signals lies before the junction
constexpr double kShortest = 4;             // metres of road
constexpr double kMeeting = 4.4;            // metres of carriageway in which two cars pass each other
constexpr double kPassing = 2.5;            // metres between the middles of two vans that pass each other

int32_t HeadOf(Vec2d along) { return std::abs(along.x) > std::abs(along.y) ? kEastWestHead : kNorthSouthHead; }

// Lanes to the right of the middle (or, on a one-way road, all over it) from left to right, along the axis or against it.
std::vector<RoadLane> LanesOf(const Carriageway& way, bool oneway, bool along) {
  std::vector<RoadLane> lanes;
  const int count = oneway ? way.lanes : std::max(1, way.lanes / 2);
  const double width = (oneway ? way.width : way.width / 2) / count, middle = along ? -way.shift : way.shift;
  const RoadLane bikes{.offset = static_cast<float>(way.edge - kCycleLane / 2), .width = static_cast<float>(kCycleLane), .cycle = true};
  if (oneway && way.bikes[0]) {
    lanes.push_back(bikes);
    lanes.back().offset *= -1;
  }
  for (int i = 0; i < count; ++i) {
    double offset = (oneway ? -way.width / 2 + middle : middle) + width * (i + 0.5);
    if (!oneway && i == 0) offset = std::max(offset, middle + kPassing / 2);
    lanes.push_back({static_cast<float>(offset), static_cast<float>(width)});
  }
  if (way.bikes[along ? 1 : 0]) lanes.push_back(bikes);
  return lanes;
}

std::vector<Vec2f> Axis(const RoadSegment& segment, double s0, double s1) {
  std::vector<Vec2f> axis;
  for (const Vec2d p : Cut(segment.line, s0, s1)) axis.push_back(ToFloat(p));
  return axis;
}

// By the class of the road, m/s: 50 km/h on main roads, 30 elsewhere.
float SpeedOf(int rank) { return rank <= 3 ? 13.9f : 8.3f; }

// The bigger road goes first, and whoever is in a roundabout before all who come into it.
uint8_t PriorityOf(const RoadSegment& segment) {
  const OsmTags& tags = segment.way->tags;
  const bool ring = tags.Is("junction", "roundabout") || tags.Is("junction", "circular");
  return static_cast<uint8_t>(kWorstRank - segment.rank + (ring ? kWorstRank + 1 : 0));
}

void AddSegment(const OsmScene& scene, const RoadGraph& graph, const RoadSegment& segment, RoadBuilder& builder) {
  const Carriageway way = CarriagewayOf(segment);
  const double length = segment.Length();
  if (segment.rank > kWorstRank || (!segment.oneway && way.width < kMeeting) || way.width < 2.4) return;
  const bool signal0 = HasSignals(scene.data, graph.nodes[segment.from].id), signal1 = HasSignals(scene.data, graph.nodes[segment.to].id);
  const double most = length / 2 - kShortest / 4;
  const double s0 = std::min(std::max(segment.start, kBend) + (signal0 ? kSignalledCrossing : 0), most),
               s1 = length - std::min(std::max(segment.end, kBend) + (signal1 ? kSignalledCrossing : 0), most);
  const std::vector<Vec2f> axis = Axis(segment, s0, s1);
  if (axis.size() < 2) return;
  builder.AddRoad({.from = segment.from,
                   .to = segment.to,
                   .axis = axis,
                   .forward = LanesOf(way, segment.oneway, true),
                   .backward = segment.oneway ? std::vector<RoadLane>{} : LanesOf(way, false, false),
                   .speed = SpeedOf(segment.rank),
                   .priority = PriorityOf(segment),
                   .signal_to = HeadOf(PointAt(segment.line, s1).along),
                   .signal_from = HeadOf(PointAt(segment.line, s0).along)});
}

}  // namespace

RoadNetwork OsmLanes(const OsmScene& scene, const RoadGraph& graph) {
  RoadBuilder builder([&](Vec2f p) { return scene.On({p.x, p.y}, -kStreetDepth).z; });
  for (const RoadNode& node : graph.nodes)
    builder.AddJunction(ToFloat(node.p), 12, HasSignals(scene.data, node.id) ? CrossStreetSignals() : std::vector<SignalPhase>{});
  for (const RoadSegment& segment : graph.segments) AddSegment(scene, graph, segment, builder);
  return builder.Build();
}

}  // namespace airsim360::internal
