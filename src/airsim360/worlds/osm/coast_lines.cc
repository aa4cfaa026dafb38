#include "airsim360/worlds/osm/coast_lines.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace airsim360::internal {
namespace {

// A way, or what of it lies between nodes that the file lacks.
struct Stretch {
  int64_t way = 0, first = 0, last = 0;  // the nodes at its ends
  Ring line;
  double length = 0;
};

double LengthOfLine(const Ring& line) {
  double sum = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) sum += std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
  return sum;
}

std::vector<Stretch> StretchesOf(const OsmData& data) {
  std::vector<Stretch> stretches;
  for (const OsmWay& way : data.ways) {
    if (!way.tags.Is("natural", "coastline")) continue;
    std::vector<size_t> stops = way.gaps;
    stops.push_back(way.nodes.size());
    size_t begin = 0;
    for (size_t end : stops) {
      if (end - begin >= 2) {
        const auto at = [&](size_t i) { return way.line.begin() + static_cast<std::ptrdiff_t>(i); };
        Stretch stretch{way.id, way.nodes[begin], way.nodes[end - 1], Ring(at(begin), at(end)), 0};
        stretch.length = LengthOfLine(stretch.line);
        stretches.push_back(std::move(stretch));
      }
      begin = end;
    }
  }
  return stretches;
}

// How many of the ends at a node begin and end there.
struct Ends {
  int begin = 0, end = 0;
};

// Ways that run against their neighbours: the shorter of two gives way.
void TurnRound(std::vector<Stretch>& stretches, std::vector<std::string>& faults) {
  std::map<int64_t, Ends> ends;
  for (const Stretch& stretch : stretches) {
    ++ends[stretch.first].begin;
    ++ends[stretch.last].end;
  }
  std::vector<Stretch*> order;
  for (Stretch& stretch : stretches)
    if (stretch.first != stretch.last) order.push_back(&stretch);
  std::stable_sort(order.begin(), order.end(), [](const Stretch* a, const Stretch* b) { return a->length < b->length; });
  for (Stretch* stretch : order) {
    Ends &first = ends[stretch->first], &last = ends[stretch->last];
    // Good joints before and after the turn.
    const int now = (first.end > 0) + (last.begin > 0), then = (first.begin > 1) + (last.end > 1);
    if (then <= now) continue;
    --first.begin, ++first.end, --last.end, ++last.begin;
    std::swap(stretch->first, stretch->last);
    std::reverse(stretch->line.begin(), stretch->line.end());
    faults.push_back(OsmId("way", stretch->way) + ": a coastline against the direction of those it touches; it is turned round");
  }
}

}  // namespace

std::vector<CoastLine> JoinCoast(const OsmData& data, std::vector<std::string>& faults) {
  std::vector<Stretch> stretches = StretchesOf(data);
  TurnRound(stretches, faults);
  std::multimap<int64_t, size_t> starts;
  std::map<int64_t, int> ended;
  for (size_t i = 0; i < stretches.size(); ++i) {
    starts.emplace(stretches[i].first, i);
    ++ended[stretches[i].last];
  }
  std::vector<bool> used(stretches.size(), false);
  std::vector<CoastLine> lines;
  const auto follow = [&](size_t first) {
    CoastLine line;
    size_t i = first;
    while (true) {
      used[i] = true;
      const Ring& points = stretches[i].line;
      line.points.insert(line.points.end(), points.begin() + (line.points.empty() ? 0 : 1), points.end());
      if (stretches[i].last == stretches[first].first) {
        line.points.pop_back();
        line.closed = true;
        break;
      }
      const auto [low, high] = starts.equal_range(stretches[i].last);
      const auto next = std::find_if(low, high, [&](const auto& entry) { return !used[entry.second]; });
      if (next == high) break;
      i = next->second;
    }
    if (line.points.size() >= (line.closed ? 3u : 2u)) lines.push_back(std::move(line));
  };
  // Open lines from their beginnings first, then what is left: rings.
  for (size_t i = 0; i < stretches.size(); ++i)
    if (!used[i] && !ended.contains(stretches[i].first)) follow(i);
  for (size_t i = 0; i < stretches.size(); ++i)
    if (!used[i]) follow(i);
  return lines;
}

std::optional<bool> OnTheRight(const std::vector<CoastLine>& lines, Vec2d p) {
  double best = 1e300, best_side = 0;
  for (const CoastLine& line : lines)
    for (size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i) {
      const Vec2d a = line.points[i], v = line.points[(i + 1) % line.points.size()] - a, w = p - a;
      const double length = std::hypot(v.x, v.y);
      if (length < 1e-9) continue;
      const double t = std::clamp((w.x * v.x + w.y * v.y) / (length * length), 0.0, 1.0);
      const double distance = std::hypot(w.x - v.x * t, w.y - v.y * t), side = (v.x * w.y - v.y * w.x) / length;
      // Nearest to a corner, the edge that p lies farther beside tells.
      if (distance > best + 1e-6 || (distance > best - 1e-6 && std::abs(side) <= std::abs(best_side))) continue;
      best = distance;
      best_side = side;
    }
  if (best > 1e299) return std::nullopt;
  return best_side < 0;
}

}  // namespace airsim360::internal
