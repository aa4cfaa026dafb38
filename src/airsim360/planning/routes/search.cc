#include "airsim360/planning/routes/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>

#include "airsim360/base/error.h"
#include "airsim360/planning/certificate.h"

namespace airsim360 {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr double kJoin = 1.8;  // spacings around the goal from which it is joined: more than half a diagonal

constexpr size_t kHeadStart = 2000;  // nodes looked at before the goal's side is

// The nodes and what is known of them.
class Lattice {
 public:
  Lattice(Vec3d origin, const BoundedClearance& world, const SearchOptions& options) : world_(world), options_(options) {
    const Box3d& box = world.box();
    double nodes = 1;
    for (int i = 0; i < 3; ++i) {
      const double below = std::floor((origin[i] - box.min[i]) / options.spacing);
      corner_[i] = origin[i] - below * options.spacing;
      const double count = below + 1 + std::floor((box.max[i] - origin[i]) / options.spacing);
      nodes *= count;
      if (!(nodes <= static_cast<double>(options.max_nodes)))
        throw InputError("search: the lattice has more than " + std::to_string(options.max_nodes) + " nodes");
      size_[i] = static_cast<int>(count);
    }
    clearance_.assign(static_cast<size_t>(nodes), std::numeric_limits<float>::quiet_NaN());
  }

  size_t size() const { return clearance_.size(); }
  Vec3d At(uint32_t node) const {
    const int x = static_cast<int>(node % size_[0]), y = static_cast<int>(node / size_[0] % size_[1]),
              z = static_cast<int>(node / size_[0] / size_[1]);
    return corner_ + Vec3d{double(x), double(y), double(z)} * options_.spacing;
  }
  uint32_t Nearest(Vec3d p) const {
    int c[3];
    for (int i = 0; i < 3; ++i) c[i] = std::clamp(static_cast<int>(std::lround((p[i] - corner_[i]) / options_.spacing)), 0, size_[i] - 1);
    return static_cast<uint32_t>((c[2] * size_[1] + c[1]) * size_[0] + c[0]);
  }
  // A bound of the clearance of a node, asked for once.
  double Clearance(uint32_t node) {
    float& known = clearance_[node];
    if (std::isnan(known)) {
      // Enough to know its edges free without a look at them.
      const double enough = options_.radius + options_.spacing;
      known = std::nextafter(static_cast<float>(world_.LowerBound(At(node), enough, enough)), 0.0f);
    }
    return known;
  }
  bool Free(uint32_t node) { return Clearance(node) >= options_.radius + kCertificateSlack; }
  // True if the straight way between two free places is clear.
  bool Joined(Vec3d a, double clearance_a, Vec3d b, double clearance_b) const {
    const double covered = clearance_a + clearance_b - 2 * (options_.radius + kCertificateSlack);
    return covered >= Norm(b - a) || SegmentIsClear(a, b, world_, options_.radius);
  }
  // Calls visit(neighbour) for up to 26 neighbours.
  template <class Visit>
  void ForNeighbours(uint32_t node, const Visit& visit) const {
    const int x = static_cast<int>(node % size_[0]), y = static_cast<int>(node / size_[0] % size_[1]),
              z = static_cast<int>(node / size_[0] / size_[1]);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx, ny = y + dy, nz = z + dz;
          if ((dx | dy | dz) == 0 || nx < 0 || ny < 0 || nz < 0 || nx >= size_[0] || ny >= size_[1] || nz >= size_[2]) continue;
          visit(static_cast<uint32_t>((nz * size_[1] + ny) * size_[0] + nx));
        }
      }
    }
  }

 private:
  const BoundedClearance& world_;
  const SearchOptions& options_;
  Vec3d corner_;
  int size_[3];
  std::vector<float> clearance_;
};

class Search {
 public:
  Search(Vec3d start, Vec3d goal, const BoundedClearance& world, const SearchOptions& options)
      : lattice_(start, world, options), goal_(goal), options_(options), from_(lattice_.Nearest(start)) {
    cost_.assign(lattice_.size(), std::numeric_limits<double>::infinity());
    previous_.assign(lattice_.size(), kNone);
    goal_clearance_ = world.LowerBound(goal, options.radius + options.spacing, options.radius + options.spacing);
  }

  SearchOutcome Run() {
    Offer(from_, kNone, 0);
    while (!open_.empty()) {
      const auto [estimate, node] = open_.top();
      open_.pop();
      if (estimate >= goal_cost_) return SearchOutcome::kFound;
      if (estimate > cost_[node] + ToGo(node)) continue;  // a cheaper way came later
      if (++expanded_ > options_.max_expanded) return SearchOutcome::kGaveUp;
      Expand(node);
      // A goal that is shut in is found out by its own side, which is small.
      if (expanded_ == kHeadStart) BeginFlood();
      if (expanded_ >= kHeadStart && !flood_met_ && !FloodOne()) return SearchOutcome::kGoalEnclosed;
    }
    return goal_cost_ < std::numeric_limits<double>::infinity() ? SearchOutcome::kFound : SearchOutcome::kStartEnclosed;
  }

  SearchResult Found(Vec3d start) const {
    SearchResult result;
    result.path = {goal_};
    for (uint32_t node = goal_from_; node != kNone; node = previous_[node]) result.path.push_back(lattice_.At(node));
    result.path.back() = start;
    std::reverse(result.path.begin(), result.path.end());
    result.length = goal_cost_;
    result.expanded = expanded_;
    return result;
  }
  SearchResult Failed(SearchOutcome outcome) const {
    SearchResult result;
    result.outcome = outcome;
    result.expanded = expanded_;
    const size_t side = outcome == SearchOutcome::kGoalEnclosed ? flooded_ : expanded_;
    result.reached_volume = static_cast<double>(side) * std::pow(options_.spacing, 3);
    return result;
  }

 private:
  // All that the goal can reach, one node after another.
  void BeginFlood() {
    seen_.assign(lattice_.size(), false);
    const uint32_t nearest = lattice_.Nearest(goal_);
    const auto join = [&](uint32_t node) {
      if (lattice_.Free(node) && lattice_.Joined(lattice_.At(node), lattice_.Clearance(node), goal_, goal_clearance_)) Flood(node);
    };
    join(nearest);
    lattice_.ForNeighbours(nearest, join);
  }
  void Flood(uint32_t node) {
    if (seen_[node]) return;
    seen_[node] = true;
    ++flooded_;
    // What the other side has reached is not shut in.
    flood_met_ |= cost_[node] < std::numeric_limits<double>::infinity();
    flood_.push(node);
  }
  bool FloodOne() {
    if (flood_.empty()) return false;
    const uint32_t node = flood_.front();
    flood_.pop();
    lattice_.ForNeighbours(node, [&](uint32_t next) {
      if (!seen_[next] && lattice_.Free(next) &&
          lattice_.Joined(lattice_.At(node), lattice_.Clearance(node), lattice_.At(next), lattice_.Clearance(next)))
        Flood(next);
    });
    return true;
  }
  double ToGo(uint32_t node) const { return options_.heuristic * Norm(goal_ - lattice_.At(node)); }
  void Offer(uint32_t node, uint32_t previous, double cost) {
    if (!(cost < cost_[node])) return;
    cost_[node] = cost;
    previous_[node] = previous;
    open_.emplace(cost + ToGo(node), node);
  }
  void Expand(uint32_t node) {
    const Vec3d p = lattice_.At(node);
    const double to_goal = Norm(goal_ - p);
    if (to_goal <= kJoin * options_.spacing && cost_[node] + to_goal < goal_cost_ &&
        lattice_.Joined(p, lattice_.Clearance(node), goal_, goal_clearance_)) {
      goal_cost_ = cost_[node] + to_goal;
      goal_from_ = node;
    }
    lattice_.ForNeighbours(node, [&](uint32_t next) {
      const double cost = cost_[node] + Norm(lattice_.At(next) - p);
      if (cost < cost_[next] && lattice_.Free(next) &&
          lattice_.Joined(p, lattice_.Clearance(node), lattice_.At(next), lattice_.Clearance(next)))
        Offer(next, node, cost);
    });
  }

  Lattice lattice_;
  Vec3d goal_;
  const SearchOptions& options_;
  uint32_t from_;
  std::vector<double> cost_;
  std::vector<uint32_t> previous_;
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  double goal_clearance_ = 0, goal_cost_ = std::numeric_limits<double>::infinity();
  uint32_t goal_from_ = kNone;
  size_t expanded_ = 0, flooded_ = 0;
  std::vector<bool> seen_;  // by the flood
  std::queue<uint32_t> flood_;
  bool flood_met_ = false;
};

bool IsFree(Vec3d p, const ClearanceQuery& world, double radius) {
  return world.LowerBound(p, radius + 1, radius + 1) >= radius + kCertificateSlack;
}

}  // namespace

SearchResult FindPath(Vec3d start, Vec3d goal, const BoundedClearance& world, const SearchOptions& options) {
  SearchResult failed;
  failed.outcome = SearchOutcome::kStartBlocked;
  if (!IsFree(start, world, options.radius)) return failed;
  failed.outcome = SearchOutcome::kGoalBlocked;
  if (!IsFree(goal, world, options.radius)) return failed;
  if (SegmentIsClear(start, goal, world, options.radius)) return {SearchOutcome::kFound, {start, goal}, Norm(goal - start), 0, 0};

  Search search(start, goal, world, options);
  const SearchOutcome outcome = search.Run();
  return outcome == SearchOutcome::kFound ? search.Found(start) : search.Failed(outcome);
}

double PolylineLength(const std::vector<Vec3d>& points) {
  double length = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) length += Norm(points[i + 1] - points[i]);
  return length;
}

Box3d BoxAround(Vec3d a, Vec3d b, double margin, const Box3d& limits) {
  const Vec3d grow{margin, margin, margin};
  return {Max(Min(a, b) - grow, limits.min), Min(Max(a, b) + grow, limits.max)};
}

}  // namespace airsim360
