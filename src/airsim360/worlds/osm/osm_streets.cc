#include "airsim360/worlds/osm/osm_streets.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace airsim360::internal {
namespace {

struct RoadClass {
  std::string_view name;
  int rank;
  double lane;     // metres
  int lanes;       // both ways together
  double parking;  // both sides together
};
constexpr RoadClass kClasses[] = {
    {"motorway", 0, 3.6, 4, 0},      {"motorway_link", 0, 3.8, 1, 0}, {"trunk", 1, 3.5, 4, 0},          {"trunk_link", 1, 3.8, 1, 0},
    {"primary", 1, 3.3, 4, 0},       {"primary_link", 1, 3.8, 1, 0},  {"secondary", 2, 3.3, 3, 2.2},    {"secondary_link", 2, 3.8, 1, 0},
    {"tertiary", 3, 3.2, 2, 4.2},    {"tertiary_link", 3, 3.6, 1, 0}, {"unclassified", 4, 3.1, 2, 4.2}, {"residential", 4, 3.0, 2, 4.2},
    {"living_street", 5, 3.0, 2, 0}, {"busway", 4, 3.4, 2, 0},        {"road", 4, 3.1, 2, 0},           {"service", 6, 3.0, 1, 0},
};
constexpr double kMostArm = 24;  // metres a junction reaches at most

const RoadClass* ClassOf(std::string_view highway) {
  for (const RoadClass& row : kClasses)
    if (row.name == highway) return &row;
  return nullptr;
}

// Free ground on one side of a segment: metres from the centre line to walls, a low quantile along it.
double Clearance(const LineIndex& walls, const std::vector<Vec2d>& line, int side) {
  std::vector<double> found;
  const double length = LengthOf(line);
  const int samples = std::clamp(static_cast<int>(length / 6), 2, 60);
  for (int i = 0; i < samples; ++i) {
    const LinePoint at = PointAt(line, length * (i + 0.5) / samples);
    const Vec2d n = Vec2d{-at.along.y, at.along.x} * static_cast<double>(side);
    const LineIndex::Near wall = walls.Find(at.p + n * 6.0, 26);
    double d = 40;
    if (wall.owner != UINT32_MAX) {
      const Vec2d to = wall.point - at.p;
      d = to.x * n.x + to.y * n.y > 0 ? std::hypot(to.x, to.y) : d;
    }
    found.push_back(d);
  }
  std::sort(found.begin(), found.end());
  return found[found.size() / 6];
}

void FitWidths(RoadSegment& segment, const LineIndex& walls) {
  const OsmTags& tags = segment.way->tags;
  const double left = Clearance(walls, segment.line, 1), right = Clearance(walls, segment.line, -1);
  const bool tagged = ParseOsmLength(tags.Get("width"), 60).has_value();
  if (!tagged) segment.half = std::clamp(std::min(left, right) - 2.0, std::min(segment.half, 1.6), segment.half);
  const std::string_view sidewalk = tags.Get("sidewalk");
  const bool none = sidewalk == "no" || sidewalk == "none" || segment.rank == 0 || segment.rank == 6;
  for (int side = 0; side < 2; ++side) {
    const double free = (side == 0 ? left : right) - segment.half;
    const bool wanted = !none && !(sidewalk == "left" && side == 1) && !(sidewalk == "right" && side == 0);
    segment.pavement[side] = wanted ? std::clamp(free < 8.5 ? free + 0.25 : 3.2, 0.8, 8.0) : 0;
  }
}

}  // namespace

double LengthOf(const std::vector<Vec2d>& line) {
  double sum = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) sum += std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
  return sum;
}

double RoadSegment::Length() const { return LengthOf(line); }

LinePoint PointAt(const std::vector<Vec2d>& line, double s) {
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2d v = line[i + 1] - line[i];
    const double length = std::hypot(v.x, v.y);
    if (length < 1e-9) continue;
    if (s <= length || i + 2 == line.size()) return {line[i] + v * (s / length), v * (1 / length)};
    s -= length;
  }
  return {line.empty() ? Vec2d{} : line.back(), {1, 0}};
}

std::vector<Vec2d> Cut(const std::vector<Vec2d>& line, double s0, double s1) {
  std::vector<Vec2d> part{PointAt(line, s0).p};
  double s = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    s += std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
    if (s > s0 + 0.01 && s < s1 - 0.01) part.push_back(line[i + 1]);
  }
  part.push_back(PointAt(line, s1).p);
  return part;
}

int RoadRank(std::string_view highway) {
  const RoadClass* row = ClassOf(highway);
  return row ? row->rank : -1;
}

bool OnBridge(const OsmTags& tags) { return tags.Has("bridge"); }
bool Underground(const OsmTags& tags) {
  return tags.Has("tunnel") || (ParseOsmNumber(tags.Get("layer"), -20, -0.5) && !tags.Has("building"));
}

int LanesOf(const OsmTags& tags, int rank, bool oneway) {
  if (const auto lanes = ParseOsmNumber(tags.Get("lanes"), 1, 12)) return static_cast<int>(*lanes);
  const RoadClass* row = ClassOf(tags.Get("highway"));
  const int both = row ? row->lanes : 2;
  static_cast<void>(rank);
  return oneway ? std::max(1, both / 2) : both;
}

double HalfWidthOf(const OsmTags& tags, int rank, int lanes, bool oneway) {
  if (const auto width = ParseOsmLength(tags.Get("width"), 60)) return std::max(1.2, *width / 2);
  const RoadClass* row = ClassOf(tags.Get("highway"));
  const double lane = row ? row->lane : 3, parking = row ? row->parking : 0;
  double width = lane * lanes + parking;
  if (rank >= 4 && !oneway && !tags.Has("lanes")) width = std::min(width, 9.0);
  const auto [left, right] = CycleLanesOf(tags, oneway);
  return std::max(1.5, (width + kCycleLane * (left + right)) / 2);
}

std::pair<bool, bool> CycleLanesOf(const OsmTags& tags, bool oneway) {
  const auto has = [&](const char* key) { return tags.Is(key, "lane") || tags.Is(key, "track"); };
  const bool both = has("cycleway:both"), along = has("cycleway");
  // Against the cars of a one-way street nobody of ours rides.
  const bool against = oneway && (tags.Is("cycleway:left:oneway", "-1") || tags.Is("cycleway:left:oneway", "no"));
  return {!against && (both || has("cycleway:left") || (along && !oneway)), both || along || has("cycleway:right")};
}

Carriageway CarriagewayOf(const RoadSegment& segment) {
  constexpr double kLeast = 2.5;  // metres of a lane for cars beside one for bicycles
  const OsmTags& tags = segment.way->tags;
  Carriageway way{.parking = segment.rank >= 3 && segment.half > 4.2 ? 2.1 : 0};
  const auto [left, right] = CycleLanesOf(tags, segment.oneway);
  const double bikes = kCycleLane * (left + right), cars = 2 * segment.half - bikes, least = kLeast * (segment.oneway ? 1 : 2);
  if (bikes > 0 && HasPaint(segment) && cars >= least) {
    // What the map says goes before bays that we guess.
    if (cars - 2 * way.parking < least) way.parking = 0;
    way.bikes[0] = left;
    way.bikes[1] = right;
    way.shift = kCycleLane * (right - left) / 2;
  }
  way.edge = segment.half - way.parking;
  way.width = 2 * way.edge - kCycleLane * (way.bikes[0] + way.bikes[1]);
  way.lanes = std::max(1, std::min(segment.lanes, static_cast<int>(way.width / 2.6)));
  return way;
}

bool HasPaint(const RoadSegment& segment) {
  const std::string_view surface = segment.way->tags.Get("surface");
  const bool paved = surface.empty() || surface == "asphalt" || surface == "paved" || surface == "concrete";
  return paved && segment.rank <= 4 && segment.half >= 2.4;
}

RoadGraph PlanRoads(const OsmData& data, const LineIndex& walls) {
  RoadGraph graph;
  // Nodes that more than one way uses, and the ends.
  std::map<int64_t, int> uses;
  std::vector<const OsmWay*> ways;
  for (const OsmWay& way : data.ways) {
    const bool area = way.tags.Is("area", "yes");
    if (RoadRank(way.tags.Get("highway")) < 0 || area || way.line.size() < 2) continue;
    if (Underground(way.tags) || OnBridge(way.tags)) continue;
    ways.push_back(&way);
    for (size_t i = 0; i < way.nodes.size(); ++i) uses[way.nodes[i]] += i == 0 || i + 1 == way.nodes.size() ? 2 : 1;
  }
  std::map<int64_t, size_t> index;
  const auto node_at = [&](int64_t id, Vec2d p) {
    const auto [it, fresh] = index.try_emplace(id, graph.nodes.size());
    if (fresh) graph.nodes.push_back({id, p, {}});
    return it->second;
  };
  for (const OsmWay* way : ways) {
    int count = 0;
    size_t first = 0;
    std::vector<RoadSegment> made;
    for (size_t i = 1; i < way->nodes.size(); ++i) {
      if (uses[way->nodes[i]] < 2 && i + 1 < way->nodes.size()) continue;
      RoadSegment segment;
      segment.way = way;
      segment.line.assign(way->line.begin() + static_cast<std::ptrdiff_t>(first), way->line.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      segment.rank = RoadRank(way->tags.Get("highway"));
      segment.oneway = way->tags.Is("oneway", "yes") || way->tags.Is("oneway", "1") || way->tags.Is("oneway", "-1") ||
                       way->tags.Is("junction", "roundabout");
      segment.lanes = LanesOf(way->tags, segment.rank, segment.oneway);
      segment.half = HalfWidthOf(way->tags, segment.rank, segment.lanes, segment.oneway);
      segment.from = node_at(way->nodes[first], way->line[first]);
      segment.to = node_at(way->nodes[i], way->line[i]);
      first = i;
      // What lies wholly outside the extract is not built.
      bool near = false;
      for (Vec2d p : segment.line) near = near || data.extent.Contains(p, 60);
      if (!near || LengthOf(segment.line) < 0.05) continue;
      segment.id = OsmId("way", way->id) + (count++ ? "/" + std::to_string(count) : "");
      made.push_back(std::move(segment));
    }
    for (RoadSegment& segment : made) {
      FitWidths(segment, walls);
      graph.nodes[segment.from].arms.emplace_back(graph.segments.size(), true);
      graph.nodes[segment.to].arms.emplace_back(graph.segments.size(), false);
      graph.segments.push_back(std::move(segment));
    }
  }
  return graph;
}

namespace {

/// A road that leaves a junction.
struct Arm {
  RoadSegment* segment;
  bool out;     // from its start
  Vec2d along;  // unit vector away from the junction
  double angle, half, reach, most;

  Vec2d left() const { return {-along.y, along.x}; }
};

/// Where the left edge of an arm meets the right edge of the next.
struct JunctionCorner {
  bool meets = false;
  Vec2d p;
  double s = 0, t = 0;  // along this arm and the next
};

// Counter-clockwise.
std::vector<Arm> ArmsOf(RoadGraph& graph, const RoadNode& node) {
  std::vector<Arm> arms;
  for (const auto& entry : node.arms) {
    RoadSegment& segment = graph.segments[entry.first];
    const double length = segment.Length(), look = std::min(8.0, length);
    const Vec2d q = PointAt(segment.line, entry.second ? look : length - look).p - node.p;
    const double d = std::max(std::hypot(q.x, q.y), 1e-9);
    arms.push_back({&segment, entry.second, q * (1 / d), std::atan2(q.y, q.x), segment.half, 0, std::min(kMostArm, length * 0.48)});
  }
  std::stable_sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) { return a.angle < b.angle; });
  return arms;
}

// The corner between two arms, which then reach beyond it.
JunctionCorner Meet(Vec2d node, Arm& a, Arm& b) {
  const Vec2d na = a.left(), nb = b.left() * -1;
  const double cross = a.along.x * b.along.y - a.along.y * b.along.x;
  double gap = b.angle - a.angle;
  if (gap <= 0) gap += 2 * M_PI;
  const double radius = std::min(a.segment->rank, b.segment->rank) >= 6 ? 2 : 5;
  if (std::abs(cross) < 0.08 || gap > M_PI) {
    const double reach = std::max(a.half, b.half) * (gap > M_PI ? 0.4 : 0.8);
    a.reach = std::max(a.reach, reach);
    b.reach = std::max(b.reach, reach);
    return {};
  }
  const Vec2d d = node + nb * b.half - (node + na * a.half);
  const double s = (d.x * b.along.y - d.y * b.along.x) / cross, t = (d.x * a.along.y - d.y * a.along.x) / cross;
  const double fillet = radius / std::tan(std::max(gap, 0.2) / 2);
  a.reach = std::max(a.reach, s + std::clamp(fillet, 0.5, 9.0));
  b.reach = std::max(b.reach, t + std::clamp(fillet, 0.5, 9.0));
  return {true, node + na * a.half + a.along * s, s, t};
}

}  // namespace

Patch JunctionOf(RoadGraph& graph, size_t index) {
  RoadNode& node = graph.nodes[index];
  if (node.arms.size() < 3) return {};
  std::vector<Arm> arms = ArmsOf(graph, node);
  const size_t n = arms.size();
  std::vector<JunctionCorner> corners(n);
  for (size_t i = 0; i < n; ++i) corners[i] = Meet(node.p, arms[i], arms[(i + 1) % n]);
  Patch patch;
  for (Arm& a : arms) a.reach = std::clamp(a.reach, 0.3, a.most);
  for (size_t i = 0; i < n; ++i) {
    const Arm &a = arms[i], &b = arms[(i + 1) % n];
    const Vec2d na = a.left(), nb = b.left() * -1;
    const Vec2d right = node.p + a.along * a.reach - na * a.half, left = node.p + a.along * a.reach + na * a.half,
                next = node.p + b.along * b.reach + nb * b.half;
    patch.outer.push_back(right);
    patch.outer.push_back(left);
    const JunctionCorner& c = corners[i];
    if (!c.meets || c.s > a.reach - 0.05 || c.t > b.reach - 0.05) continue;
    // The kerb return, as a parabola through both edges' ends towards their meeting point.
    for (int k = 1; k < 6; ++k) {
      const double t = k / 6.0;
      patch.outer.push_back(left * ((1 - t) * (1 - t)) + c.p * (2 * t * (1 - t)) + next * (t * t));
    }
  }
  for (Arm& a : arms) (a.out ? a.segment->start : a.segment->end) = a.reach;
  return patch;
}

}  // namespace airsim360::internal
