#include "airsim360/traffic/lane_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

constexpr double kSideways = 2;     // m/s^2 in bends: comfortable
constexpr double kFollowWidth = 3;  // metres between who turn away from each other: a bus is 3 m wide with its mirrors
constexpr double kVansPass = 3.05;  // metres between the middles of two ways on which vans turn beside each other
// Metres between ways that are told apart: for cars that go straight on, ... for buses that swing out.
constexpr std::array kPassingWidths = {kPassingWidth, 2.5, 2.7, kVansPass, 3.5, 4.0, 4.6};

Vec3d PointOf(const Lane& lane, size_t i) { return VecCast<double>(lane.points[i]); }

double Heading(Vec3d d) { return std::atan2(d.y, d.x); }

double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// The smallest radius that three points in a row lie on.
double SmallestRadius(const Lane& lane) {
  double least = INFINITY;
  for (size_t i = 2; i < lane.points.size(); ++i) {
    const Vec3d a = PointOf(lane, i - 1) - PointOf(lane, i - 2), b = PointOf(lane, i) - PointOf(lane, i - 1);
    const double bend = std::abs(Wrapped(Heading(b) - Heading(a)));
    if (bend > 1e-3) least = std::min(least, (Norm(a) + Norm(b)) / 2 / bend);
  }
  return least;
}

constexpr double kStep = 0.5;  // metres between samples of ways

std::vector<Vec3d> Samples(const LaneMap& map, LaneId id) {
  std::vector<Vec3d> samples;
  for (double s = 0; s <= map.length(id); s += kStep) samples.push_back(map.At(id, s).p);
  return samples;
}

// How far samples of `b` are from `a`, squared metres.
std::vector<double> Apart(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::vector<double> apart;
  for (const Vec3d p : b) {
    double least = INFINITY;
    for (const Vec3d q : a) {
      const double dx = p.x - q.x, dy = p.y - q.y;
      if (std::abs(p.z - q.z) < 3) least = std::min(least, dx * dx + dy * dy);
    }
    apart.push_back(least);
  }
  return apart;
}

// Metres to the last sample that is less than `width` away; negative: none is.
double LastOverlap(const std::vector<double>& apart, double width) {
  for (size_t i = apart.size(); i-- > 0;)
    if (apart[i] < width * width) return kStep * static_cast<double>(i);
  return -1;
}

bool SameOrigin(const LaneMap& map, LaneId a, LaneId b) {
  return std::ranges::any_of(map.previous(a), [&](LaneId id) { return std::ranges::count(map.previous(b), id) > 0; });
}

}  // namespace

LaneMap::LaneMap(std::shared_ptr<const RoadNetwork> roads) : roads_(std::move(roads)) {
  CheckRoads(*roads_);
  tables_.resize(roads_->lanes.size());
  for (LaneId id = 0; id < tables_.size(); ++id) {
    const Lane& lane = roads_->lanes[id];
    Table& table = tables_[id];
    table.lengths = {0};
    for (size_t i = 1; i < lane.points.size(); ++i)
      table.lengths.push_back(table.lengths.back() + Norm(PointOf(lane, i) - PointOf(lane, i - 1)));
    const size_t n = lane.points.size();
    table.turn = Wrapped(Heading(PointOf(lane, n - 1) - PointOf(lane, n - 2)) - Heading(PointOf(lane, 1) - PointOf(lane, 0)));
    table.radius = SmallestRadius(lane);
    table.speed = std::max(1.5, std::min<double>(lane.speed, std::sqrt(kSideways * table.radius)));
    for (const LaneId next : lane.next) tables_[next].previous.push_back(id);
  }
  FindConflicts();
}

void LaneMap::FindConflicts() {
  std::vector<std::vector<LaneId>> ways(roads_->junctions.size());
  for (LaneId id = 0; id < tables_.size(); ++id)
    if (roads_->lanes[id].junction >= 0) ways[static_cast<size_t>(roads_->lanes[id].junction)].push_back(id);
  for (const std::vector<LaneId>& junction : ways) {
    std::vector<std::vector<Vec3d>> samples;
    for (const LaneId way : junction) samples.push_back(Samples(*this, way));
    for (size_t a = 0; a < junction.size(); ++a) {
      for (size_t b = 0; b < junction.size(); ++b) {
        if (a == b) continue;
        // Those who come from the same lane follow each other until their ways part.
        const std::vector<double> apart = Apart(samples[a], samples[b]);
        if (SameOrigin(*this, junction[a], junction[b])) {
          if (const double last = LastOverlap(apart, kFollowWidth); last >= 0) {
            tables_[junction[a]].diverging.push_back({junction[b], last});
            tables_[junction[a]].shared = true;
          }
          continue;
        }
        double before = -1, narrower = 0;
        for (const double width : kPassingWidths) {
          const double last = LastOverlap(apart, width);
          if (last > before) tables_[junction[a]].conflicts.push_back({junction[b], last, narrower});
          if (last >= 0 && width <= kVansPass) tables_[junction[a]].shared = true;
          before = last;
          narrower = width;
        }
      }
    }
  }
}

LanePoint LaneMap::At(LaneId id, double s) const {
  const Lane& lane = roads_->lanes[id];
  const std::vector<double>& lengths = tables_[id].lengths;
  const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, s);
  const auto i = static_cast<size_t>(above - lengths.begin());
  const Vec3d a = PointOf(lane, i - 1), d = Normalized(PointOf(lane, i) - a);
  return {a + d * (s - lengths[i - 1]), d};
}

NearestLanePoint LaneMap::Nearest(LaneId id, Vec3d p) const {
  NearestLanePoint best{.distance = INFINITY};
  const Lane& lane = roads_->lanes[id];
  const std::vector<double>& lengths = tables_[id].lengths;
  for (size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const Vec3d a = PointOf(lane, i), along = PointOf(lane, i + 1) - a;
    const double squared = Dot(along, along), t = squared > 0 ? std::clamp(Dot(p - a, along) / squared, 0.0, 1.0) : 0;
    const double distance = Norm(p - (a + along * t));
    if (distance < best.distance) best = {lengths[i] + t * std::sqrt(squared), distance};
  }
  return best;
}

SignalLight LaneMap::LightAt(LaneId id, int64_t t_ns) const {
  const Lane& lane = roads_->lanes[id];
  if (lane.signal < 0) return SignalLight::kGreen;
  const Junction& junction = roads_->junctions[static_cast<size_t>(lane.junction)];
  double cycle = 0;
  for (const SignalPhase& phase : junction.phases) cycle += phase.seconds + phase.amber + phase.all_red;
  if (cycle <= 0) return SignalLight::kGreen;
  double t = std::fmod(static_cast<double>(t_ns) * 1e-9 + junction.offset, cycle);
  if (t < 0) t += cycle;
  for (const SignalPhase& phase : junction.phases) {
    const bool ours = (phase.green >> lane.signal & 1) != 0;
    if (t < phase.seconds) return ours ? SignalLight::kGreen : SignalLight::kRed;
    t -= phase.seconds;
    if (t < phase.amber) return ours ? SignalLight::kAmber : SignalLight::kRed;
    t -= phase.amber;
    if (t < phase.all_red) return ours ? SignalLight::kClearing : SignalLight::kRed;
    t -= phase.all_red;
  }
  return SignalLight::kRed;
}

}  // namespace airsim360
