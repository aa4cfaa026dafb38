// The streets of a map as a graph: nodes where roads meet, segments between them with widths.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "airsim360/worlds/osm/osm_scene.h"

namespace airsim360::internal {

/// One way between two nodes of the graph.
struct RoadSegment {
  std::string id;  ///< "way/123", or "way/123/2" for its second segment
  const OsmWay* way = nullptr;
  std::vector<Vec2d> line;      ///< at least two points
  size_t from = 0, to = 0;      ///< nodes of the graph
  double half = 4;              ///< centre to kerb
  double pavement[2] = {0, 0};  ///< width on the left and on the right
  int rank = 3;                 ///< 0 motorway … 6 service
  int lanes = 2;
  bool oneway = false;
  double start = 0, end = 0;  ///< metres of the junctions at both ends
  double Length() const;
};

struct RoadNode {
  int64_t id = 0;
  Vec2d p;
  std::vector<std::pair<size_t, bool>> arms;  ///< segment, true where it starts here; by angle once planned
};

struct RoadGraph {
  std::vector<RoadSegment> segments;
  std::vector<RoadNode> nodes;
};

/// Carriageways of cars that lie on the ground: no tunnels, no bridges.
RoadGraph PlanRoads(const OsmData& data, const LineIndex& walls);
inline constexpr double kCycleLane = 1.7;  ///< metres: a lane for bicycles, its line included
/// How the width of a carriageway is shared out: bays, lanes for bicycles, lanes for all from the outside to the middle.
struct Carriageway {
  bool bikes[2] = {false, false};  ///< whether there is a lane for them on the left and on the right
  double parking = 0;              ///< width of the bays at each kerb
  double width = 0;                ///< for all lanes that cars use
  double shift = 0;                ///< of their middle, to the left
  int lanes = 1;                   ///< for cars, both directions together
  double edge = 0;                 ///< from the axis to the bays, or to the kerbs where there are none
};
Carriageway CarriagewayOf(const RoadSegment& segment);
/// Whether lines are painted on a segment of this kind.
bool HasPaint(const RoadSegment& segment);
/// Whether traffic signals stand at a node of the map.
bool HasSignals(const OsmData& data, int64_t node);
/// Rank of a highway value, -1 for what cars do not use.
int RoadRank(std::string_view highway);
/// Half the width of a carriageway by its tags alone.
double HalfWidthOf(const OsmTags& tags, int rank, int lanes, bool oneway);
int LanesOf(const OsmTags& tags, int rank, bool oneway);
/// Whether the tags ask for a lane for bicycles on the left and on the right; those of one-way streets go the way of the cars.
std::pair<bool, bool> CycleLanesOf(const OsmTags& tags, bool oneway);
/// The area of a junction; sets how far it reaches into its arms. Empty where fewer than three meet.
Patch JunctionOf(RoadGraph& graph, size_t node);

/// A point of a line, `s` metres from its start, and its direction there.
struct LinePoint {
  Vec2d p, along;
};
LinePoint PointAt(const std::vector<Vec2d>& line, double s);
/// The part of a line between two distances from its start.
std::vector<Vec2d> Cut(const std::vector<Vec2d>& line, double s0, double s1);
double LengthOf(const std::vector<Vec2d>& line);

/// Markings, crosswalks and bike lanes of a segment, lifted over its surface at `z` below the kerbs.
void PaintSegment(OsmScene& scene, MeshBuilder& mesh, const RoadGraph& graph, const RoadSegment& segment, double z);

/// Crossings of the map (highway=crossing nodes) and, at junctions with signals where the map has no crossings,
/// one an arm.
void PaintCrossings(OsmScene& scene, MeshBuilder& mesh, const RoadGraph& graph, double z);

/// Bridges: decks, parapets and piers of ways with bridge=yes, and ramps to them.
void BuildBridges(OsmScene& scene, MeshBuilder& mesh);
bool OnBridge(const OsmTags& tags);
bool Underground(const OsmTags& tags);

}  // namespace airsim360::internal
