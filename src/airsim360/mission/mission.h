// Missions: behaviour trees by which a drone flies and takes frames, and who flies them in a simulation.
// docs/guide/missions.md describes the nodes.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/behaviour/tree_run.h"
#include "airsim360/mission/things.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/sim_loop.h"

namespace airsim360 {

/// A mission for one drone of a model. Immutable.
struct Mission {
  MissionWorld world;
  size_t vehicle = 0;
  behaviour::TreeSet trees;
  size_t main = 0;  ///< of trees

  const behaviour::Tree& tree() const { return trees.trees[main]; }
};

/// What is wrong with a file whatever the world: InputError as ReadMission, but names of things are not looked up.
void CheckMission(std::string_view xml, std::string_view name);
/// Reads the XML of BehaviorTree.CPP 4. The tree that is flown is main_tree_to_execute, else the last one. InputError
/// "name:line: node: …" with the nearest valid choice for what ReadTrees refuses, numbers out of range, things that the world
/// does not have, gimbals that the drone does not have, and captures into one dataset with different products.
std::shared_ptr<const Mission> ReadMission(std::string_view xml, std::string_view name, MissionWorld world, size_t vehicle = 0);

/// A frame that a mission has taken.
struct MissionCapture {
  std::string to;                     ///< name of its dataset
  std::vector<std::string> products;  ///< further ones
  Shot shot;
};

/// How far a mission has come.
struct MissionProgress {
  enum class Result : uint8_t { kRunning, kSuccess, kFailure };
  struct ActiveNode {
    int line = 0, order = 0;  ///< of the file; order as behaviour::XmlElement
    std::string label;
  };
  Result result = Result::kRunning;
  double seconds = 0;              ///< since it began
  std::vector<ActiveNode> active;  ///< nodes that run, from the root on
  std::vector<std::string> log;    ///< "12.34 s, line 5, Goto: …": what failed and why; the newest kMostLines
  size_t captures = 0;
  std::vector<behaviour::BoardEntry> board;  ///< what the keys of the tree hold
};
inline constexpr const char* kMissionResultNames[] = {"running", "success", "failure"};

inline constexpr int64_t kMissionTickNs = 20'000'000;
inline constexpr size_t kMostMissionCaptures = 100'000;

/// Flies a mission from the first step on in which it is asked; to be attached to the loop of its model. Nodes are ticked
/// every kMissionTickNs. When the tree has ended the drone is left as it is. All functions may be called from any thread.
class MissionPilot : public SimPilot {
 public:
  explicit MissionPilot(std::shared_ptr<const Mission> mission);
  ~MissionPilot() override;
  void BeforeStep(const SimModel& model, const SimState& state, std::span<const SimEvent> happened,
                  std::vector<SimCommand>& commands) override;

  const Mission& mission() const;
  MissionProgress progress() const;
  bool done() const;
  /// Captures from the `first`-th on, in order of time.
  std::vector<MissionCapture> CapturesFrom(size_t first) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
