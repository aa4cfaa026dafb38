// The leaves by which one person acts: what a tree asks for becomes goals, states and messages.
#pragma once

#include <cmath>
#include <string>

#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {

inline Vec2d Flat(Vec3d p) { return {p.x, p.y}; }
/// Over the ground.
inline double FlatDistance(Vec3d a, Vec3d b) { return std::hypot(a.x - b.x, a.y - b.y); }

class Mind : public Leaves {
 public:
  Mind(CrowdTick& tick, PersonIndex i) : tick_(tick), self_(i), agent_(tick.in.agents[i]), walker_(tick.in.walkers[i]) {}
  Status Tick(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) override;
  void Halt(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) override;

 private:
  static Status Yes(bool yes) { return yes ? Status::kSuccess : Status::kFailure; }
  static int64_t Seconds(double s) { return static_cast<int64_t>(s * 1e9); }
  static std::string Cause(const TreeNode& node) { return "tree: " + node.label; }

  /// Index of the state, message, kind of place or area that a port names; -1 = none.
  int Choice(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i) const;

  Status SetState(bool fresh, const Tree& tree, const TreeNode& node, TreeRun& run);
  Status WaitMessage(bool fresh, const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run);
  Status FacePerson(PersonIndex other);
  Status Every(NodeMemory& memory, double period, double first);
  Status Condition(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run);

  // errands.cc
  Status OnTheWay();
  Status WanderTo(bool fresh, uint32_t area, double speed);
  Status GoTo(bool fresh, const Value& point, double speed);
  Status GoToPlace(bool fresh, PlaceKind kind, double reach);
  // queueing.cc
  int32_t EndOfLine(double reach) const;
  void TakePlaceInLine(int32_t place);
  Status Queue(bool fresh, NodeMemory& memory, double reach, double min_s, double max_s, const std::string& cause);
  void Face(Vec3d p);
  bool Turned() const;
  Status LookAtDrone(bool fresh, double distance, double min_s, double max_s, const std::string& cause);
  Status StepAway(bool fresh, double distance);

  // mind_social.cc
  bool Free(PersonIndex i) const;
  Status Meet(bool fresh, NodeMemory& memory, double distance, double chance, double cooldown);
  Status Answer(double chance);
  Status Chat(bool fresh, NodeMemory& memory, double min_s, double max_s, const std::string& cause);
  Status Accompany(bool fresh);
  Status Gather(bool fresh, NodeMemory& memory, double min_s, double max_s, const std::string& cause);
  Status Send(uint8_t type, const Value& to, PersonIndex person, double distance);

  template <class Filter>
  PersonIndex Nearest(double reach, const Filter& filter) const {
    PersonIndex best = kNoPerson;
    double best_d = reach;
    tick_.in.steering.Near(Flat(walker_.at.p_W), reach, [&](PersonIndex other, Vec2d p, double z) {
      if (other == self_ || std::abs(z - walker_.at.p_W.z) > 1.5) return;
      const double d = std::hypot(p.x - walker_.at.p_W.x, p.y - walker_.at.p_W.y);
      if ((d < best_d || (d == best_d && other < best)) && filter(other)) {
        best_d = d;
        best = other;
      }
    });
    return best;
  }

  CrowdTick& tick_;
  PersonIndex self_;
  Agent& agent_;
  Walker& walker_;
};

}  // namespace airsim360::internal
