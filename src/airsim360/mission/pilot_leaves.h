// The leaves of a mission at one tick: what they want becomes commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "airsim360/mission/flying.h"
#include "airsim360/mission/mission.h"
#include "airsim360/mission/mission_nodes.h"

namespace airsim360 {

/// Which node has the drone, and how far it has come.
struct DroneInHand {
  enum class Phase : uint8_t { kNone, kStopping, kGoing, kTurning, kCircling };
  const behaviour::TreeNode* owner = nullptr;
  Phase phase = Phase::kNone;
  int64_t since_ns = 0;  ///< beginning of the phase
  double duration = 0;   ///< of the way
  Vec3d goal;
  ThingNow thing;                      ///< as it was when the node began
  std::optional<uint64_t> command_id;  ///< of the last command; none: it was given in this tick
  bool commanded = false;              ///< the node has given a command
  bool taken = false;                  ///< somebody else has given one since
};

/// What a mission remembers besides its tree.
struct MissionMemory {
  int64_t start_ns = 0;
  DroneInHand hand;
  std::vector<MissionCapture> captures;
  std::vector<std::string> log;
  std::string refused;  ///< why the last command was, by its event
};

/// One tick.
class PilotLeaves : public behaviour::Leaves {
 public:
  using Node = behaviour::TreeNode;
  using Status = behaviour::Status;

  PilotLeaves(const Mission& mission, const SimModel& model, const SimState& state, MissionPlanner& planner, MissionMemory& memory,
              std::vector<SimCommand>& commands)
      : mission_(mission),
        model_(model),
        state_(state),
        drone_(state.vehicles[mission.vehicle]),
        planner_(planner),
        memory_(memory),
        hand_(memory.hand),
        commands_(commands) {}

  Status Tick(const behaviour::Tree& tree, const Node& node, behaviour::NodeMemory& memory, behaviour::TreeRun& run) override;
  void Halt(const behaviour::Tree& tree, const Node& node, behaviour::NodeMemory& memory, behaviour::TreeRun& run) override;

 private:
  static Status Yes(bool yes) { return yes ? Status::kSuccess : Status::kFailure; }
  Status Act(const Node& node, behaviour::NodeMemory& memory);
  void Note(const Node& node, const std::string& what);

  // Ports. InputError for what came over the blackboard and makes no sense.
  double Number(const Node& node, size_t i) const;
  behaviour::Value Named(const Node& node, size_t i) const;
  ThingNow Thing(const Node& node, size_t i) const;
  std::string Text(const Node& node, size_t i) const;

  double Seconds(int64_t since_ns) const { return 1e-9 * static_cast<double>(state_.t_ns - since_ns); }
  bool Flies() const;
  double Heading() const;
  double Bearing(Vec3d p_W) const;
  bool FacesWithin(Vec3d p_W, double error) const;
  void Command(const airsim360::Command& command, int64_t timeout_ns = 0);
  void Go(const MissionWay& way, std::optional<Vec3d> look_at = {});
  void Enter(DroneInHand::Phase phase);
  void CheckHand(const Node& node) const;

  // Flying leaves: begun with the drone in hand, then asked again.
  Status Fly(const Node& node, bool fresh);
  Status UntilDone(bool fresh, const airsim360::Command& command);
  Status Stopped(bool fresh);
  Status Arrived() const;
  Status Goto(const Node& node, bool fresh);
  Status Orbit(const Node& node, bool fresh);
  Status Circle(const MissionPlanner::OrbitRequest& request);
  Status Follow(const Node& node, bool fresh);
  Vec3d FreeVelocity(Vec3d wanted, double clearance) const;
  Status Look(const Node& node, bool fresh);

  Status Gimbal(const Node& node, behaviour::NodeMemory& memory, bool fresh);
  Status Capture(const Node& node, behaviour::NodeMemory& memory, bool fresh);
  Status Sees(const Node& node);

  const Mission& mission_;
  const SimModel& model_;
  const SimState& state_;
  const Vehicle& drone_;
  MissionPlanner& planner_;
  MissionMemory& memory_;
  DroneInHand& hand_;
  std::vector<SimCommand>& commands_;
  behaviour::TreeRun* run_ = nullptr;  // while a leaf is ticked
};

}  // namespace airsim360
