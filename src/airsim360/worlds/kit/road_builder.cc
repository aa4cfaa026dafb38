#include "airsim360/worlds/kit/road_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace airsim360 {
namespace {

using Height = std::function<float(Vec2f)>;

constexpr float kMaxStep = 4;       // metres between points, so that lanes follow the ground
constexpr float kTurn = 0.6f;       // radians: more is no longer straight on
constexpr float kBack = 2.7f;       // radians: more is back
constexpr float kWayStep = 1.2f;    // metres between points in junctions
constexpr float kLeastWay = 1.2f;   // metres of a way through a junction
constexpr float kTurnsWithin = 60;  // metres between one-way roads at the edge of a map that those who leave come back on

float Length(Vec2f v) { return std::hypot(v.x, v.y); }
Vec2f Unit(Vec2f v) { return v * (1 / Length(v)); }

// One end of the lanes of a road at a junction, from the inner to the outer one.
struct Mouth {
  size_t node = 0;  // as roads name it, before junctions become one
  int32_t signal = -1;
  std::vector<LaneId> in, out;
};

std::vector<Vec2f> Finer(const std::vector<Vec2f>& axis) {
  std::vector<Vec2f> points{axis.front()};
  for (size_t i = 1; i < axis.size(); ++i) {
    const Vec2f a = axis[i - 1], d = axis[i] - a;
    const int pieces = std::max(1, static_cast<int>(std::ceil(Length(d) / kMaxStep)));
    if (Length(d) < 1e-3f) continue;
    for (int k = 1; k <= pieces; ++k) points.push_back(a + d * (static_cast<float>(k) / static_cast<float>(pieces)));
  }
  return points;
}

// The axis moved `offset` metres to its right.
std::vector<Vec2f> Beside(const std::vector<Vec2f>& axis, float offset) {
  std::vector<Vec2f> moved;
  for (size_t i = 0; i < axis.size(); ++i) {
    const Vec2f before = i > 0 ? Unit(axis[i] - axis[i - 1]) : Unit(axis[1] - axis[0]);
    const Vec2f after = i + 1 < axis.size() ? Unit(axis[i + 1] - axis[i]) : before;
    const Vec2f along = Unit(before + after);
    const float miter = std::max(0.5f, along.x * before.x + along.y * before.y);
    moved.push_back(axis[i] + Vec2f{along.y, -along.x} * (offset / miter));
  }
  return moved;
}

std::vector<Vec3f> OnGround(const std::vector<Vec2f>& points, const Height& height) {
  std::vector<Vec3f> lane;
  for (const Vec2f p : points) {
    const Vec3f at{p.x, p.y, height(p)};
    if (lane.empty() || !(lane.back() == at)) lane.push_back(at);
  }
  return lane;
}

float LengthOf(const std::vector<Vec2f>& axis) {
  float length = 0;
  for (size_t i = 1; i < axis.size(); ++i) length += Length(axis[i] - axis[i - 1]);
  return length;
}

// Which nodes are one junction, and to which others of it one gets from each of them.
class JoinedNodes {
 public:
  JoinedNodes(const std::vector<RoadSpec>& inner, size_t nodes) : joined_(nodes), reached_(nodes) {
    std::iota(joined_.begin(), joined_.end(), size_t{0});
    std::vector<std::vector<size_t>> next(nodes);
    for (const RoadSpec& road : inner) {
      const size_t a = joined_[road.from], b = joined_[road.to];
      std::ranges::replace(joined_, std::max(a, b), std::min(a, b));
      if (!road.forward.empty()) next[road.from].push_back(road.to);
      if (!road.backward.empty()) next[road.to].push_back(road.from);
    }
    for (size_t node = 0; node < nodes; ++node) {
      reached_[node] = {node};
      for (size_t i = 0; i < reached_[node].size(); ++i)
        for (const size_t on : next[reached_[node][i]])
          if (std::ranges::count(reached_[node], on) == 0) reached_[node].push_back(on);
    }
  }

  // The first node of its junction.
  size_t FirstOf(size_t node) const { return joined_[node]; }
  // Where one gets from a node within its junction, itself among them.
  const std::vector<size_t>& ReachedFrom(size_t node) const { return reached_[node]; }
  bool Leads(size_t from, size_t to) const { return std::ranges::count(reached_[from], to) > 0; }

 private:
  std::vector<size_t> joined_;
  std::vector<std::vector<size_t>> reached_;
};

// Whether each lane of a road, also one inside of its bends, is as long as a network asks.
bool HasRoomForLanes(const RoadSpec& road) {
  constexpr float kLeastLane = 1.1f;
  std::vector<Vec2f> axis = Finer(road.axis);
  if (axis.size() < 2) return false;
  const auto fit = [&](const std::vector<RoadLane>& lanes) {
    return std::ranges::all_of(lanes, [&](const RoadLane& lane) {
      const std::vector<Vec2f> points = Beside(axis, lane.offset);
      float length = 0;
      for (size_t i = 1; i < points.size(); ++i) length += Length(points[i] - points[i - 1]);
      return length >= kLeastLane;
    });
  };
  if (!fit(road.forward)) return false;
  std::ranges::reverse(axis);
  return fit(road.backward);
}

// Adds the lanes of one direction; their ids from the inner to the outer one.
std::vector<LaneId> AddLanes(const RoadSpec& road, std::vector<Vec2f> axis, const std::vector<RoadLane>& lanes, const Height& height,
                             RoadNetwork& network) {
  std::vector<LaneId> ids;
  for (const RoadLane& lane : lanes) {
    ids.push_back(static_cast<LaneId>(network.lanes.size()));
    network.lanes.push_back({.points = OnGround(Beside(axis, lane.offset), height),
                             .width = lane.width,
                             .speed = road.speed,
                             .next = {},
                             .priority = road.priority,
                             .bus = lane.bus,
                             .cycle = lane.cycle});
  }
  // Out of a cycle lane at the left kerb nobody changes into the cars' lanes.
  for (size_t k = lanes.size() > 1 && lanes.front().cycle ? 1 : 0; k + 1 < ids.size(); ++k) {
    network.lanes[ids[k]].right = ids[k + 1];
    network.lanes[ids[k + 1]].left = ids[k];
  }
  return ids;
}

Vec2f Flat(Vec3f p) { return {p.x, p.y}; }
Vec2f EndDirection(const Lane& lane) { return Unit(Flat(lane.points.back()) - Flat(lane.points[lane.points.size() - 2])); }
Vec2f StartDirection(const Lane& lane) { return Unit(Flat(lane.points[1]) - Flat(lane.points[0])); }

float TurnOf(Vec2f from, Vec2f to) { return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y); }

// A curve from the end of one lane to the beginning of another that touches both: a cubic with the handles of a circular arc.
std::vector<Vec3f> CurveBetween(const Lane& from, const Lane& to, const Height& height) {
  const Vec2f a = Flat(from.points.back()), d = Flat(to.points.front()), u = EndDirection(from), w = StartDirection(to);
  const float chord = Length(d - a), turn = std::max(std::abs(TurnOf(u, w)), 1e-3f);
  const float handle = 4.0f / 3 * std::tan(turn / 4) * chord / (2 * std::sin(turn / 2));
  const Vec2f b = a + u * handle, c = d - w * handle;
  const int steps = std::max(6, static_cast<int>(std::ceil((chord + handle) / kWayStep)));
  std::vector<Vec2f> points;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps), s = 1 - t;
    points.push_back(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
  }
  std::vector<Vec3f> curve = OnGround(points, height);
  curve.front() = from.points.back();
  curve.back() = to.points.front();
  return curve;
}

// Mouths of roads that meet at a sharp angle nearly touch: nobody turns there on the spot.
bool Touch(const Lane& from, const Lane& to) { return Length(Flat(to.points.front()) - Flat(from.points.back())) < kLeastWay; }

void Connect(LaneId from, LaneId to, size_t junction, int32_t signal, const Height& height, RoadNetwork& network) {
  Lane way{.points = CurveBetween(network.lanes[from], network.lanes[to], height),
           .width = std::min(network.lanes[from].width, network.lanes[to].width),
           .speed = std::min(network.lanes[from].speed, network.lanes[to].speed),
           .next = {to},
           .junction = static_cast<int32_t>(junction),
           .signal = signal,
           .priority = network.lanes[from].priority,
           .bus = network.lanes[from].bus && network.lanes[to].bus,
           .cycle = network.lanes[to].cycle};
  network.lanes[from].next.push_back(static_cast<LaneId>(network.lanes.size()));
  network.lanes.push_back(std::move(way));
}

// The only way on begins next to where the lane ends: the lane itself goes there.
void LeadInto(LaneId from, LaneId to, RoadNetwork& network) {
  const Vec3f goal = network.lanes[to].points.front();
  if (!(network.lanes[from].points.back() == goal)) network.lanes[from].points.push_back(goal);
  network.lanes[from].next.push_back(to);
}

std::vector<LaneId> ForAllVehicles(const std::vector<LaneId>& lanes, const RoadNetwork& network) {
  std::vector<LaneId> some;
  std::ranges::copy_if(lanes, std::back_inserter(some), [&](LaneId id) { return !network.lanes[id].bus && !network.lanes[id].cycle; });
  return some.empty() ? lanes : some;
}

// The cycle lane at the right or the left edge.
LaneId CycleLane(const std::vector<LaneId>& lanes, bool right, const RoadNetwork& network) {
  const LaneId edge = right ? lanes.back() : lanes.front();
  return network.lanes[edge].cycle && (right || lanes.size() > 1) ? edge : kNoLane;
}

// From the lanes of one road into those of another.
void ConnectRoads(const Mouth& from, const Mouth& to, size_t junction, const Height& height, RoadNetwork& network) {
  if (from.in.empty() || to.out.empty()) return;
  const std::vector<LaneId> in = ForAllVehicles(from.in, network), out = ForAllVehicles(to.out, network);
  const float turn = TurnOf(EndDirection(network.lanes[in.front()]), StartDirection(network.lanes[out.front()]));
  const auto connect = [&](LaneId a, LaneId b) {
    if (!Touch(network.lanes[a], network.lanes[b])) Connect(a, b, junction, from.signal, height, network);
  };
  if (std::abs(turn) > kBack) return;
  // Bicycles: into the cycle lanes of the other road, out of those of this one, but not across its cars.
  const auto connect_cycles = [&] {
    for (const bool right : {true, false}) {
      const LaneId cycle_in = CycleLane(from.in, right, network), cycle_out = CycleLane(to.out, right, network);
      const bool across = right ? turn > kTurn : turn < -kTurn;
      const LaneId edge_in = right ? in.back() : in.front(), edge_out = right ? out.back() : out.front();
      if (cycle_out != kNoLane) connect(across ? (right ? in.front() : in.back()) : edge_in, cycle_out);
      if (cycle_in != kNoLane && !across) connect(cycle_in, cycle_out != kNoLane ? cycle_out : edge_out);
    }
  };
  if (turn > kTurn) return connect(in.front(), out.front()), connect_cycles();
  if (turn < -kTurn) return connect(in.back(), out.back()), connect_cycles();
  // Straight on, the outer lanes side by side; where lanes end, into the one beside.
  for (size_t k = 0; k < in.size(); ++k) connect(in[k], out[std::min(k, out.size() - 1)]);
  if (network.lanes[from.in.back()].bus && network.lanes[to.out.back()].bus) connect(from.in.back(), to.out.back());
  connect_cycles();
}

// Lanes that lead nowhere yet: to the road that turns least, side by side, back only where there is no other.
void ConnectRest(const std::vector<Mouth>& mouths, const JoinedNodes& nodes, size_t junction, const Height& height, RoadNetwork& network) {
  for (const Mouth& from : mouths) {
    for (size_t rank = 0; rank < from.in.size(); ++rank) {
      const LaneId in = from.in[rank];
      if (!network.lanes[in].next.empty()) continue;
      const Mouth* best = nullptr;
      float least = INFINITY;
      for (const Mouth& to : mouths) {
        if (to.out.empty() || !nodes.Leads(from.node, to.node)) continue;
        const float turn = std::abs(TurnOf(EndDirection(network.lanes[in]), StartDirection(network.lanes[to.out.front()])));
        const std::vector<LaneId> there = ForAllVehicles(to.out, network);
        const Lane& goal = network.lanes[there[&to == &from ? 0 : std::min(rank, there.size() - 1)]];
        const float cost = turn + (&to == &from ? 10 : 0) + (Touch(network.lanes[in], goal) ? 20 : 0);
        if (cost < least) least = cost, best = &to;
      }
      if (best == nullptr) continue;
      const std::vector<LaneId> out = ForAllVehicles(best->out, network);
      const LaneId on = out[best == &from ? 0 : std::min(rank, out.size() - 1)];
      if (Touch(network.lanes[in], network.lanes[on])) {
        LeadInto(in, on, network);
      } else {
        Connect(in, on, junction, from.signal, height, network);
      }
    }
  }
}

// Without directions of roads that end where no lane begins: nobody could drive on from there.
std::vector<RoadSpec> WithoutDeadEnds(std::vector<RoadSpec> roads, const JoinedNodes& nodes, size_t count) {
  for (bool changed = true; changed;) {
    std::vector<bool> leads_on(count);
    for (const RoadSpec& road : roads) {
      if (!road.forward.empty()) leads_on[road.from] = true;
      if (!road.backward.empty()) leads_on[road.to] = true;
    }
    changed = false;
    for (RoadSpec& road : roads) {
      const auto drop = [&](std::vector<RoadLane>& lanes, size_t end) {
        if (lanes.empty() || std::ranges::any_of(nodes.ReachedFrom(end), [&](size_t node) { return leads_on[node]; })) return;
        lanes.clear();
        changed = true;
      };
      drop(road.forward, road.to);
      drop(road.backward, road.from);
    }
  }
  return roads;
}

// The place of an axis that is nearest to `p`: metres from its beginning, and metres to there.
std::pair<float, float> NearestOn(const std::vector<Vec2f>& axis, Vec2f p) {
  std::pair<float, float> best{0, INFINITY};
  float s = 0;
  for (size_t i = 1; i < axis.size(); ++i) {
    const Vec2f along = axis[i] - axis[i - 1], to = p - axis[i - 1];
    const float length = Length(along);
    if (length < 1e-3f) continue;
    const float at = std::clamp((to.x * along.x + to.y * along.y) / length, 0.0f, length);
    const float distance = Length(to - along * (at / length));
    if (distance < best.second) best = {s + at, distance};
    s += length;
  }
  return best;
}

// The first `s` metres of an axis.
std::vector<Vec2f> UpTo(const std::vector<Vec2f>& axis, float s) {
  std::vector<Vec2f> part{axis.front()};
  for (size_t i = 1; i < axis.size() && s > 1e-3f; ++i) {
    const float length = Length(axis[i] - axis[i - 1]);
    if (length < 1e-3f) continue;
    part.push_back(s < length ? axis[i - 1] + (axis[i] - axis[i - 1]) * (s / length) : axis[i]);
    s -= length;
  }
  return part;
}
std::vector<Vec2f> From(std::vector<Vec2f> axis, float s) {
  const float length = LengthOf(axis);
  std::ranges::reverse(axis);
  axis = UpTo(axis, length - s);
  std::ranges::reverse(axis);
  return axis;
}

std::vector<RoadSpec> Reversed(std::vector<RoadSpec> roads) {
  for (RoadSpec& road : roads) std::swap(road.from, road.to);
  return roads;
}

// One-way roads out of a map lead to where nobody can drive on, and those into it begin where nobody comes from. Where two such pass
// each other at the end of the one or the beginning of the other, those who leave turn round and come back: else whatever they lead
// out of, as a roundabout, would be a trap.
class TurnsBack {
 public:
  TurnsBack(const std::vector<RoadSpec>& inner, std::vector<RoadSpec>& roads, std::vector<Junction>& junctions, const Height& height)
      : roads_(roads), out_(Lost(roads, inner, junctions.size())), in_(Lost(Reversed(roads), Reversed(inner), junctions.size())) {
    while (TurnOnce(height, junctions)) {
    }
  }

 private:
  struct OneWay {
    size_t road = 0;
    bool last = false;  // no other road goes on from it, or leads to it
  };
  struct Turn {
    float distance = 0;  // metres between the roads
    size_t out = 0, in = 0;
    RoadSpec leaves, enters;  // up to there, and from there on
  };

  // One-way roads that lead to nowhere.
  static std::vector<OneWay> Lost(const std::vector<RoadSpec>& roads, const std::vector<RoadSpec>& inner, size_t count) {
    const JoinedNodes nodes(inner, count);
    const std::vector<RoadSpec> kept = WithoutDeadEnds(roads, nodes, count);
    std::vector<bool> leads_on(count);
    for (const RoadSpec& road : roads) {
      if (!road.forward.empty()) leads_on[road.from] = true;
      if (!road.backward.empty()) leads_on[road.to] = true;
    }
    std::vector<OneWay> lost;
    for (size_t i = 0; i < roads.size(); ++i) {
      if (roads[i].forward.empty() || !roads[i].backward.empty() || !kept[i].forward.empty()) continue;
      lost.push_back({i, std::ranges::none_of(nodes.ReachedFrom(roads[i].to), [&](size_t node) { return leads_on[node]; })});
    }
    return lost;
  }

  // The two that pass each other nearest, in opposite directions.
  bool TurnOnce(const Height& height, std::vector<Junction>& junctions) {
    std::optional<Turn> best;
    const auto consider = [&](size_t out, size_t in, float leaves, float enters, float distance) {
      if (out == in || distance >= (best ? best->distance : kTurnsWithin)) return;
      Turn turn{distance, out, in, roads_[out], roads_[in]};
      turn.leaves.axis = UpTo(turn.leaves.axis, leaves);
      turn.enters.axis = From(turn.enters.axis, enters);
      for (const RoadSpec* road : {&turn.leaves, &turn.enters})
        if (LengthOf(road->axis) < kHoldsACar || !HasRoomForLanes(*road)) return;
      const std::vector<Vec2f>&a = turn.leaves.axis, &b = turn.enters.axis;
      const Vec2f end = a.back() - a[a.size() - 2], start = b[1] - b[0];
      if (end.x * start.x + end.y * start.y < 0) best = std::move(turn);
    };
    for (const OneWay& out : out_) {
      for (const OneWay& in : in_) {
        const std::vector<Vec2f>&a = roads_[out.road].axis, &b = roads_[in.road].axis;
        if (in.last) {
          const auto [s, distance] = NearestOn(a, b.front());
          consider(out.road, in.road, s, 0, distance);
        }
        if (out.last) {
          const auto [s, distance] = NearestOn(b, a.back());
          consider(out.road, in.road, LengthOf(a), s, distance);
        }
      }
    }
    if (!best) return false;
    const Vec2f middle = (best->leaves.axis.back() + best->enters.axis.front()) * 0.5f;
    best->leaves.to = best->enters.from = junctions.size();
    junctions.push_back({{middle.x, middle.y, height(middle)}, best->distance, {}, 0});
    roads_[best->out] = std::move(best->leaves);
    roads_[best->in] = std::move(best->enters);
    std::erase_if(out_, [&](const OneWay& way) { return way.road == best->out; });
    std::erase_if(in_, [&](const OneWay& way) { return way.road == best->in; });
    return true;
  }

  std::vector<RoadSpec>& roads_;
  std::vector<OneWay> out_, in_;  // lead to nowhere, come from nowhere
};

// A junction grows by another one.
void Join(Junction& junction, const Junction& other) {
  const Vec3f apart = other.center - junction.center;
  const float distance = Norm(apart);
  if (junction.phases.empty()) junction.phases = other.phases, junction.offset = other.offset;
  if (distance + other.radius <= junction.radius) return;
  // The smallest circle around both.
  const float radius = std::max(other.radius, (distance + junction.radius + other.radius) / 2);
  if (distance > 0) junction.center = junction.center + apart * ((radius - junction.radius) / distance);
  junction.radius = radius;
}

}  // namespace

std::vector<SignalPhase> CrossStreetSignals() { return {{1u << kEastWestHead, 17, 3, 2}, {1u << kNorthSouthHead, 17, 3, 2}}; }

void RoadBuilder::AddRoad(RoadSpec road) {
  if (LengthOf(road.axis) < kHoldsACar) {
    inner_.push_back(std::move(road));
    return;
  }
  if (!HasRoomForLanes(road)) {
    road.axis = {road.axis.front(), road.axis.back()};
    if (!HasRoomForLanes(road)) return;
  }
  roads_.push_back(std::move(road));
}

size_t RoadBuilder::AddJunction(Vec2f center, float radius, std::vector<SignalPhase> phases, float offset) {
  junctions_.push_back({{center.x, center.y, height_(center)}, radius, std::move(phases), offset});
  return junctions_.size() - 1;
}

RoadNetwork RoadBuilder::Build() const {
  std::vector<RoadSpec> roads = roads_;
  std::vector<Junction> junctions = junctions_;
  TurnsBack(inner_, roads, junctions, height_);

  RoadNetwork network;
  const JoinedNodes nodes(inner_, junctions.size());
  std::vector<size_t> junction_of(junctions.size());
  for (size_t node = 0; node < junctions.size(); ++node) {
    const size_t first = nodes.FirstOf(node);
    junction_of[node] = first == node ? network.junctions.size() : junction_of[first];
    if (first == node) {
      network.junctions.push_back(junctions[node]);
    } else {
      Join(network.junctions[junction_of[node]], junctions[node]);
    }
  }
  std::vector<std::vector<Mouth>> mouths(network.junctions.size());
  for (const RoadSpec& road : WithoutDeadEnds(std::move(roads), nodes, junctions.size())) {
    std::vector<Vec2f> axis = Finer(road.axis);
    const std::vector<LaneId> forward = AddLanes(road, axis, road.forward, height_, network);
    std::ranges::reverse(axis);
    const std::vector<LaneId> backward = AddLanes(road, axis, road.backward, height_, network);
    const auto meets = [&](size_t node, int32_t signal, const std::vector<LaneId>& in, const std::vector<LaneId>& out) {
      const size_t junction = junction_of[node];
      mouths[junction].push_back({node, network.junctions[junction].phases.empty() ? -1 : signal, in, out});
    };
    meets(road.from, road.signal_from, backward, forward);
    meets(road.to, road.signal_to, forward, backward);
  }
  for (size_t j = 0; j < mouths.size(); ++j) {
    for (const Mouth& from : mouths[j])
      for (const Mouth& to : mouths[j])
        if (&from != &to && nodes.Leads(from.node, to.node)) ConnectRoads(from, to, j, height_, network);
    ConnectRest(mouths[j], nodes, j, height_, network);
  }
  return network;
}

}  // namespace airsim360
