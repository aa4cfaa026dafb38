#include "airsim360/worlds/osm/osm_sea.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "airsim360/worlds/osm/coast_lines.h"

namespace airsim360::internal {
namespace {

constexpr double kGap = 1;      // metres: joints wider than this are worth a word
constexpr double kDeep = 250;   // metres from the border: ends farther inside were not cut off there
constexpr double kChord = 400;  // metres of the coast that tell where it goes on

double Distance(Vec2d a, Vec2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

// A line within the box: from border to border, or with ends inside.
struct Piece {
  Ring line;
  bool enters = false, leaves = false;  // begins, ends on the border
};

// The part of a-b inside the box as shares of its length (Liang and Barsky); false: none.
bool ClipSegment(const OsmBox& box, Vec2d a, Vec2d b, double& s0, double& s1) {
  s0 = 0;
  s1 = 1;
  const double d[4] = {a.x - b.x, b.x - a.x, a.y - b.y, b.y - a.y};
  const double q[4] = {a.x - box.x0, box.x1 - a.x, a.y - box.y0, box.y1 - a.y};
  for (int i = 0; i < 4; ++i) {
    if (d[i] == 0) {
      if (q[i] < 0) return false;
    } else if (d[i] < 0) {
      s0 = std::max(s0, q[i] / d[i]);
    } else {
      s1 = std::min(s1, q[i] / d[i]);
    }
  }
  return s0 < s1;
}

bool Within(const OsmBox& box, Vec2d p) { return p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1; }

// What of a line lies in the box.
void Clip(const OsmBox& box, const Ring& line, std::vector<Piece>& pieces) {
  Piece piece;
  const auto finish = [&](bool leaves) {
    piece.leaves = leaves;
    if (piece.line.size() >= 2) pieces.push_back(std::move(piece));
    piece = {};
  };
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2d a = line[i], b = line[i + 1];
    double s0 = 0, s1 = 1;
    if (!ClipSegment(box, a, b, s0, s1)) {
      finish(true);
      continue;
    }
    if (piece.line.empty()) {
      piece.enters = s0 > 0 || !Within(box, a);
      piece.line.push_back(a + (b - a) * s0);
    }
    piece.line.push_back(a + (b - a) * s1);
    if (s1 < 1 || !Within(box, b)) finish(true);
  }
  finish(false);
}

double ToBorder(const OsmBox& box, Vec2d p) { return std::min({p.x - box.x0, box.x1 - p.x, p.y - box.y0, box.y1 - p.y}); }

Vec2d NearestOnBorder(const OsmBox& box, Vec2d p) {
  const double d = ToBorder(box, p);
  if (d == p.x - box.x0) return {box.x0, p.y};
  if (d == box.x1 - p.x) return {box.x1, p.y};
  return d == p.y - box.y0 ? Vec2d{p.x, box.y0} : Vec2d{p.x, box.y1};
}

// Where a line that ends at the back of `line` meets the border: in its general direction, or where that is far, at
// the nearest place.
Vec2d GoesOnTo(const OsmBox& box, const Ring& line) {
  const Vec2d end = line.back();
  const Vec2d nearest = NearestOnBorder(box, end);
  double run = 0;
  size_t i = line.size() - 1;
  while (i > 0 && run < kChord) {
    run += Distance(line[i], line[i - 1]);
    --i;
  }
  const Vec2d v = end - line[i];
  const double length = std::hypot(v.x, v.y);
  if (length < 1e-3) return nearest;
  const Vec2d far = end + v * ((box.width() + box.depth()) / length);
  double s0 = 0, s1 = 1;
  if (!ClipSegment(box, end, far, s0, s1)) return nearest;
  const Vec2d hit = end + (far - end) * s1;
  return Distance(end, hit) > 3 * Distance(end, nearest) + kGap ? nearest : hit;
}

// Clockwise way along the border from its north-western corner, in metres.
double Along(const OsmBox& box, Vec2d p) {
  const double w = box.width(), h = box.depth();
  const double d[4] = {std::abs(p.y - box.y1), std::abs(p.x - box.x1), std::abs(p.y - box.y0), std::abs(p.x - box.x0)};
  switch (std::min_element(d, d + 4) - d) {
    case 0:
      return p.x - box.x0;
    case 1:
      return w + box.y1 - p.y;
    case 2:
      return w + h + box.x1 - p.x;
    default:
      return 2 * w + h + p.y - box.y0;
  }
}

class SeaMaker {
 public:
  explicit SeaMaker(const OsmBox& box) : box_(box) {}

  void Add(const CoastLine& line) {
    // A closed line begins outside, so that no piece is cut in two.
    Ring points = line.points;
    if (line.closed) {
      const auto outside = std::find_if(points.begin(), points.end(), [&](Vec2d p) { return !Within(box_, p); });
      if (outside == points.end()) {
        rings_.push_back(std::move(points));
        return;
      }
      std::rotate(points.begin(), outside, points.end());
      points.push_back(Vec2d(points.front()));
    }
    Clip(box_, points, pieces_);
  }

  // Ends within the box are joined to each other or led to the border.
  void MendEnds() {
    struct Joint {
      double gap;
      size_t from, to;
    };
    std::vector<Joint> joints;
    for (size_t i = 0; i < pieces_.size(); ++i)
      for (size_t k = 0; k < pieces_.size(); ++k) {
        if (pieces_[i].leaves || pieces_[k].enters) continue;
        const Vec2d a = pieces_[i].line.back(), b = pieces_[k].line.front();
        const double gap = Distance(a, b);
        if (gap < 0.5 * std::min(ToBorder(box_, a), ToBorder(box_, b))) joints.push_back({gap, i, k});
      }
    std::sort(joints.begin(), joints.end(),
              [](const Joint& a, const Joint& b) { return std::tie(a.gap, a.from, a.to) < std::tie(b.gap, b.from, b.to); });
    std::map<size_t, size_t> next;
    std::vector<bool> follows(pieces_.size(), false);
    for (const Joint& joint : joints) {
      if (next.contains(joint.from) || follows[joint.to]) continue;
      next[joint.from] = joint.to;
      follows[joint.to] = true;
      if (joint.gap > kGap) Fault(pieces_[joint.from].line.back(), "a gap of " + std::to_string(std::lround(joint.gap)) + " m is closed");
    }
    Merge(next, follows);
    for (Piece& piece : pieces_) {
      if (!piece.leaves) piece.line.push_back(LeadOut(piece.line));
      if (piece.enters) continue;
      std::reverse(piece.line.begin(), piece.line.end());
      piece.line.push_back(LeadOut(piece.line));
      std::reverse(piece.line.begin(), piece.line.end());
    }
  }

  Patches Water(const std::vector<CoastLine>& lines) {
    Patches water;
    for (Ring& ring : WalkAround()) water.push_back({std::move(ring), {}});
    water = water.empty() ? BaseOf(lines) : Unite(water);
    // Islands and the waters in them, from the largest to the smallest.
    std::stable_sort(rings_.begin(), rings_.end(),
                     [](const Ring& a, const Ring& b) { return std::abs(SignedArea(a)) > std::abs(SignedArea(b)); });
    for (size_t i = 0; i < rings_.size();) {
      const bool island = SignedArea(rings_[i]) > 0;
      Patches same;
      for (; i < rings_.size() && (SignedArea(rings_[i]) > 0) == island; ++i) same.push_back({rings_[i], {}});
      if (!island) same.insert(same.end(), water.begin(), water.end());
      water = island ? Subtract(water, same) : Unite(same);
    }
    return Intersect(water, Patches{Whole()});
  }
  std::vector<std::string> TakeFaults() { return std::move(faults_); }

 private:
  void Fault(Vec2d p, const std::string& what) {
    faults_.push_back("the coastline ends at x = " + std::to_string(std::lround(p.x)) + ", y = " + std::to_string(std::lround(p.y)) +
                      " m: " + what);
  }

  Vec2d LeadOut(const Ring& line) {
    const Vec2d to = GoesOnTo(box_, line);
    if (ToBorder(box_, line.back()) > kDeep)
      Fault(line.back(), "it goes on straight for " + std::to_string(std::lround(Distance(line.back(), to))) + " m");
    return to;
  }

  // Chains of joined pieces; those that close are rings.
  void Merge(const std::map<size_t, size_t>& next, const std::vector<bool>& follows) {
    std::vector<Piece> merged;
    std::vector<bool> used(pieces_.size(), false);
    const auto chain = [&](size_t first) {
      Piece whole;
      whole.enters = pieces_[first].enters;
      size_t i = first;
      while (!used[i]) {
        used[i] = true;
        whole.line.insert(whole.line.end(), pieces_[i].line.begin(), pieces_[i].line.end());
        whole.leaves = pieces_[i].leaves;
        const auto it = next.find(i);
        if (it == next.end()) break;
        i = it->second;
      }
      return whole;
    };
    for (size_t i = 0; i < pieces_.size(); ++i)
      if (!follows[i]) merged.push_back(chain(i));
    for (size_t i = 0; i < pieces_.size(); ++i)
      if (!used[i])
        if (Piece ring = chain(i); ring.line.size() >= 3) rings_.push_back(std::move(ring.line));
    pieces_ = std::move(merged);
  }

  // Along each piece, then clockwise along the border to the next that begins there.
  std::vector<Ring> WalkAround() {
    const double around = 2 * (box_.width() + box_.depth());
    std::multimap<double, size_t> starts;
    for (size_t i = 0; i < pieces_.size(); ++i) starts.emplace(Along(box_, pieces_[i].line.front()), i);
    CheckTurns();
    std::vector<bool> used(pieces_.size(), false);
    std::vector<Ring> rings;
    for (size_t first = 0; first < pieces_.size(); ++first) {
      if (used[first]) continue;
      Ring ring;
      for (size_t i = first; !used[i];) {
        used[i] = true;
        ring.insert(ring.end(), pieces_[i].line.begin(), pieces_[i].line.end());
        const double from = Along(box_, pieces_[i].line.back());
        auto it = starts.lower_bound(from);
        if (it == starts.end()) it = starts.begin();
        const double to = it->first < from ? it->first + around : it->first;
        AddCorners(from, to, ring);
        i = it->second;
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

  // Along the border lines begin and end by turns, else they contradict each other.
  void CheckTurns() {
    std::vector<std::pair<double, bool>> ends;
    for (const Piece& piece : pieces_) {
      ends.emplace_back(Along(box_, piece.line.front()), true);
      ends.emplace_back(Along(box_, piece.line.back()), false);
    }
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i < ends.size(); ++i) {
      const auto &one = ends[i], &next = ends[(i + 1) % ends.size()];
      if (one.second != next.second || std::abs(one.first - next.first) < kGap) continue;
      faults_.push_back("two coastlines contradict each other: between them lies land for one and water for the other");
      return;
    }
  }

  void AddCorners(double from, double to, Ring& ring) const {
    const double w = box_.width(), h = box_.depth();
    const std::pair<double, Vec2d> corners[] = {
        {w, {box_.x1, box_.y1}}, {w + h, {box_.x1, box_.y0}}, {2 * w + h, {box_.x0, box_.y0}}, {2 * w + 2 * h, {box_.x0, box_.y1}}};
    for (double turn : {0.0, 2 * (w + h)})
      for (const auto& corner : corners)
        if (corner.first + turn > from && corner.first + turn < to) ring.push_back(corner.second);
  }

  Patch Whole() const { return {{{box_.x0, box_.y0}, {box_.x1, box_.y0}, {box_.x1, box_.y1}, {box_.x0, box_.y1}}, {}}; }

  // No line crosses the border: all of it is sea, or land.
  Patches BaseOf(const std::vector<CoastLine>& lines) const {
    const Vec2d corner{box_.x0, box_.y0};
    return OnTheRight(lines, corner).value_or(false) ? Patches{Whole()} : Patches{};
  }

  OsmBox box_;
  std::vector<Piece> pieces_;
  std::vector<Ring> rings_;  // wholly inside
  std::vector<std::string> faults_;
};

}  // namespace

Sea FindSea(const OsmData& data, const OsmBox& box) {
  Sea sea;
  const std::vector<CoastLine> lines = JoinCoast(data, sea.faults);
  if (lines.empty() || !(box.width() > 0 && box.depth() > 0)) return sea;
  SeaMaker maker(box);
  for (const CoastLine& line : lines) maker.Add(line);
  maker.MendEnds();
  sea.water = maker.Water(lines);
  for (std::string& fault : maker.TakeFaults()) sea.faults.push_back(std::move(fault));
  return sea;
}

}  // namespace airsim360::internal
