#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

#include "airsim360/math/angles.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/vln/agents/vln_agent.h"

namespace airsim360 {
namespace {

constexpr double kRoom = 0.45;                         // metres free around a step
constexpr double kOnLeg = 0.01;                        // metres from a straight leg that rounding makes
constexpr double kLongestLeg = 200;                    // metres of a decision: after a minute another one is asked for
constexpr double kBetter = 1;                          // metres less to go that make steps worth it
constexpr double kOff = 1.5, kAside = 15, kLost = 10;  // a metre beside the way as metres along it; so far beside; where it is out of sight
constexpr double kHorizon = 5;                         // moves that steps are planned for at a time
constexpr int kMostExpanded = 3000, kMostInNeed = 60000;  // places looked at for that; where the first find nothing
constexpr double kLeastRoom = 0.25;                       // metres free around a step where nothing else helps
constexpr double kSurely = 0.9;                           // of the radius: near enough where no steps lead nearer
constexpr double kSlow = 0.7;                             // m/s along legs with less room
constexpr double kSpacing = 1;                            // metres between points of the way that progress is measured on

std::vector<Vec3d> Dense(const std::vector<Vec3d>& way) {
  std::vector<Vec3d> points = {way.front()};
  for (size_t i = 1; i < way.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil(Norm(way[i] - way[i - 1]) / kSpacing)));
    for (int k = 1; k <= parts; ++k) points.push_back(way[i - 1] + (way[i] - way[i - 1]) * (static_cast<double>(k) / parts));
  }
  return points;
}

// Without the points that lie on straight legs, as far as a decision is flown before the next is asked for.
std::vector<Vec3d> Corners(const std::vector<Vec3d>& way) {
  std::vector<Vec3d> corners = {way.front()};
  for (size_t i = 1; i + 1 < way.size(); ++i) {
    const Vec3d leg = way[i + 1] - corners.back();
    if (Norm(leg) > kLongestLeg || Norm(Cross(way[i] - corners.back(), Normalized(leg))) > kOnLeg) corners.push_back(way[i]);
  }
  corners.push_back(way.back());
  return corners;
}

class OracleAgent : public VlnAgent {
 public:
  Decision Decide(VlnSituation& s) override {
    if (way_.empty()) {
      way_ = Dense(s.episode.ref);
      corners_ = Corners(s.episode.ref);
    }
    switch (s.decisions) {
      case Decisions::kWaypoints:
        return Waypoints(s);
      case Decisions::kYomo:
        return OneMove(s);
      case Decisions::kDiscrete:
        return Step(s);
    }
    return {};
  }

 private:
  bool IsFreeWay(const VlnSituation& s, Vec3d a, Vec3d b) const { return IsFree(s.solid, a, b, kRoom); }

  // Corner by corner: legs are proved clear, what a drone that does not stop makes of corners is not. Through gaps that are hardly
  // wider than the drone it goes slowly, for from 3 m/s it runs past a corner by centimetres.
  Decision Waypoints(const VlnSituation& s) {
    if (next_ >= corners_.size()) return {{.stop = true}};
    const bool last = next_ + 1 == corners_.size(), wide = IsFreeWay(s, corners_[next_ - 1], corners_[next_]);
    return {{WaypointsAction{.points = {corners_[next_++]}, .speed = wide ? 0 : kSlow}, last}};
  }

  // The farthest place of the way that one straight move reaches.
  Decision OneMove(VlnSituation& s) const {
    const Viewpoint view = s.Pose();
    for (size_t i = way_.size(); i-- > 1;) {
      if (!IsFreeWay(s, view.p_W, way_[i])) continue;
      const Vec3d d = way_[i] - view.p_W;
      const double flat = std::hypot(d.x, d.y);
      return {{RelativeGoalAction{.azimuth = std::remainder(view.yaw - std::atan2(d.y, d.x), 2 * kPi),
                                  .elevation = std::atan2(d.z, flat),
                                  .distance = Norm(d)},
               true}};
    }
    return {{.stop = true}};
  }

  // Metres to go from a place: to a point of the way that is near and in sight, and along it. Where the way leads around a block,
  // its end is near through the block too; that would lead into bays.
  double ToGo(const VlnSituation& s, Vec3d p) const {
    double best = 1e9, behind = 0;
    for (size_t i = way_.size(); i-- > 0;) {
      const double off = Norm(p - way_[i]), near = kOff * off + behind;
      if (off <= kAside && near < best && Sees(s, p, way_[i])) best = near;
      best = std::min(best, kLost * off + behind);
      if (i > 0) behind += Norm(way_[i] - way_[i - 1]);
    }
    return best;
  }

  static bool Sees(const VlnSituation& s, Vec3d from, Vec3d to) {
    const double distance = Norm(to - from);
    return distance < 1e-6 ||
           !s.solid.Intersect(VecCast<float>(from), VecCast<float>((to - from) * (1 / distance)), static_cast<float>(distance));
  }

  // A place that steps lead to, on the way of a search.
  struct Node {
    Vec3d p;
    double yaw = 0, to_go = 0;
    int decisions = 0;           ///< so far
    int parent = -1, turns = 0;  ///< turns to the right, then `last`
    Preset last = Preset::kForward;
  };

  // Where one step, after some turns, can lead.
  std::vector<Node> StepsFrom(const VlnSituation& s, const Node& from, int parent, double room) const {
    const PresetSizes& sizes = s.flight.spec().presets;
    std::vector<Node> steps;
    const auto add = [&](Vec3d step, int turns, Preset last) {
      const double yaw = from.yaw - turns * sizes.turn;
      const Vec3d p = from.p + RotationZ(yaw) * step;
      if (IsFree(s.solid, from.p, p, room))
        steps.push_back({p, yaw, ToGo(s, p), from.decisions + std::abs(turns) + 1, parent, turns, last});
    };
    const int half = static_cast<int>(std::lround(kPi / sizes.turn));
    for (int turns = 1 - half; turns <= half; ++turns) add({sizes.forward, 0, 0}, turns, Preset::kForward);
    add({0, sizes.lateral, 0}, 0, Preset::kLeft);
    add({0, -sizes.lateral, 0}, 0, Preset::kRight);
    add({-sizes.forward, 0, 0}, 0, Preset::kBackward);
    add({0, 0, sizes.vertical}, 0, Preset::kUp);
    add({0, 0, -sizes.vertical}, 0, Preset::kDown);
    return steps;
  }

  // The fewest steps to where clearly less is to go than from here (Hart, Nilsson and Raphael 1968, what is to go counted
  // more than it costs): turns count as much as moves do. Empty: there is none within the effort.
  std::vector<Preset> PlanSteps(const VlnSituation& s, double to_go, int effort, double wide) const {
    constexpr double kGreed = 2;
    const Viewpoint view = s.Pose();
    // A drone that came to rest a little off may have less room than is kept from things on the way.
    const double room = std::clamp(static_cast<double>(s.solid.Clearance(VecCast<float>(view.p_W), 1)) - 0.02, kLeastRoom, wide);
    const double pace = s.flight.spec().presets.forward, enough = std::max(to_go - kHorizon * pace, 0.25 * s.radius);
    std::vector<Node> nodes = {{view.p_W, view.yaw, to_go}};
    std::map<std::array<int64_t, 4>, int> reached;  // by place and heading: decisions
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.push({0, 0});
    int best = 0;
    for (int expanded = 0; expanded < effort && !open.empty(); ++expanded) {
      const int at = open.top().second;
      open.pop();
      const Node from = nodes[static_cast<size_t>(at)];
      if (from.to_go < nodes[static_cast<size_t>(best)].to_go) best = at;
      if (from.to_go <= enough) break;
      for (const Node& next : StepsFrom(s, from, at, room)) {
        const auto [entry, is_new] = reached.try_emplace(CellOf(next), next.decisions);
        if (!is_new && entry->second <= next.decisions) continue;
        entry->second = next.decisions;
        open.push({next.decisions + kGreed * next.to_go / pace, static_cast<int>(nodes.size())});
        nodes.push_back(next);
      }
    }
    return nodes[static_cast<size_t>(best)].to_go < to_go - kBetter ? StepsTo(nodes, best) : std::vector<Preset>{};
  }

  static std::array<int64_t, 4> CellOf(const Node& node) {
    const auto cell = [](double v) { return std::llround(v / 0.8); };
    return {cell(node.p.x), cell(node.p.y), cell(node.p.z), std::llround(std::remainder(node.yaw, 2 * kPi) / 0.1)};
  }

  static std::vector<Preset> StepsTo(const std::vector<Node>& nodes, int at) {
    std::vector<Preset> steps;
    for (; nodes[static_cast<size_t>(at)].parent >= 0; at = nodes[static_cast<size_t>(at)].parent) {
      const Node& node = nodes[static_cast<size_t>(at)];
      steps.push_back(node.last);
      steps.insert(steps.end(), static_cast<size_t>(std::abs(node.turns)), node.turns > 0 ? Preset::kTurnRight : Preset::kTurnLeft);
    }
    std::ranges::reverse(steps);
    return steps;
  }

  Decision Step(VlnSituation& s) {
    const Vec3d p = s.Pose().p_W;
    const double here = Norm(s.episode.goal - p);
    if (planned_.empty()) {
      if (here <= 0.3 * s.radius) return {{.stop = true}};
      planned_ = PlanSteps(s, ToGo(s, p), kMostExpanded, kRoom);
      // Out of a bay the way leads away from the goal first, and through gaps that are hardly wider than the drone.
      if (planned_.empty() && here > s.radius * kSurely) planned_ = PlanSteps(s, ToGo(s, p), kMostInNeed, kLeastRoom);
      if (planned_.empty()) return {{.stop = true}};
    }
    const Preset preset = planned_.front();
    planned_.erase(planned_.begin());
    return {{PresetAction{preset}}};
  }

  std::vector<Vec3d> way_, corners_;
  std::vector<Preset> planned_;
  size_t next_ = 1;
};

}  // namespace

std::unique_ptr<VlnAgent> MakeOracleAgent() { return std::make_unique<OracleAgent>(); }

}  // namespace airsim360
