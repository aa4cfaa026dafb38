// What of a crowd changes besides places: where people want to go, what they think, what they heard.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/behaviour/tree_run.h"
#include "airsim360/people/behaviour/plan.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/crowd/gates.h"
#include "airsim360/people/crowd/steering.h"

namespace airsim360 {
namespace internal {

inline constexpr int kThinkEvery = 4;  // ticks: 5 Hz, a quarter of the people at each tick
inline constexpr size_t kMaxInbox = 8, kMaxGroup = 4;
inline constexpr size_t kPathsPerTick = 12;
inline constexpr int64_t kSecond = 1'000'000'000;
inline constexpr int64_t kLetterLife = 2 * kSecond;  // unread messages are forgotten after that

struct Message {
  uint8_t type = 0;
  PersonIndex from = kNoPerson;  ///< kNoPerson: a command
  PersonIndex to = kNoPerson;
  uint32_t sequence = 0;  ///< of the sender
  uint32_t value = 0;     ///< of accept: the group
  int64_t t_ns = 0;       ///< sent
};

/// People who talk, around a point.
struct Group {
  uint32_t id = 0;
  std::vector<PersonIndex> members;
  Vec2d centre;
  double angle = 0;  ///< of the first member as seen from the centre
  int64_t ends_ns = 0, since_ns = 0, silent_since_ns = 0;
  int64_t changed_ns = 0;  ///< when somebody came or went: all take their places anew
};

enum class Walk : uint8_t { kNone, kWaitsForPath, kOnTheWay, kArrived, kFailed };

struct Agent {
  RngStream rng{0, "crowd"};
  // Where to
  Walk walk = Walk::kNone;
  NavPoint goal;
  double goal_speed = 0;    ///< m/s; 0 = as they like
  double goal_reach = 0.5;  ///< metres
  std::vector<Gate> gates;  ///< one after the other, to the goal
  uint32_t gate = 0;        ///< the next one
  Vec3d progress_p;         ///< place of the last progress
  int64_t progress_ns = 0;
  Vec3d stuck_p;  ///< the same, whatever the goals
  int64_t stuck_ns = 0;
  int64_t way_ns = 0;  ///< when they last had somewhere to go
  NavPoint errand;     ///< of WanderTo, until it is reached
  bool has_errand = false;
  bool hold = false;           ///< red light ahead
  bool accompanies = false;    ///< walks beside the leader of the party
  Vec2d slot;                  ///< where, in metres ahead and to the left of the leader
  Vec2d heading{1, 0};         ///< of a leader: where the party goes, smoothed; a unit vector
  double party_pace = 1;       ///< of a leader: share of the speed that is left for those who fall behind
  int64_t waits_since_ns = 0;  ///< of a leader, for somebody
  double sway = 0;             ///< tangent of the angle that they walk off the straight way
  Vec2d shift;                 ///< metres that somebody who stands is off their place, from one foot to the other
  int64_t shifts_until_ns = 0;
  Vec2d stand;            ///< where they came to stand
  bool stands = false;    ///< the last time that was asked
  double pace = 1;        ///< share of the speed on the plain that stairs and slopes leave
  int32_t place = -1;     ///< index into CrowdPlan::places that is theirs
  bool at_place = false;  ///< stands or sits there, perhaps beside the mesh
  bool begins = false;    ///< on a seat, in a line or in a talk, which their tree has still to find out
  Vec3d offset;           ///< of the feet from where they belong, dying out
  int64_t offset_ns = -1'000'000'000'000;
  // State machine
  uint8_t state = kWalking;
  int64_t state_since_ns = 0, state_until_ns = 0;  ///< until 0 = open
  std::vector<int64_t> left_ns;                    ///< when each state was left last
  uint8_t state_before = kWalking;
  std::string cause = "start";  ///< why the state was entered
  // Tree
  uint16_t tree = 0;
  TreeRun run;
  bool commanded = false;  ///< does what a command said; the tree rests
  // Others
  std::vector<Message> inbox;
  uint32_t sequence = 0;
  uint32_t group = 0;
  PersonIndex greeted = kNoPerson, last_met = kNoPerson;
  int64_t social_after_ns = 0;  ///< no greeting before
  int64_t turn_until_ns = 0;
  // Looks
  double face_yaw = 0;
  bool has_face = false;
  int32_t gaze_drone = -1;
  uint64_t near_drones = 0;  ///< bits: a near pass goes on
};

}  // namespace internal

struct CrowdInternals {
  std::vector<internal::Walker> walkers;  // as at the end of the current tick
  std::vector<internal::Agent> agents;
  std::vector<internal::Group> groups;
  std::vector<internal::Message> post;   // sent in this tick, delivered in the next
  std::vector<PersonIndex> place_taken;  // by place; kNoPerson = free
  std::vector<PersonIndex> path_queue;   // who waits for a way, first come first served
  std::vector<Vec3d> from;               // where the tick began
  std::vector<double> from_yaw, to_yaw;
  int64_t tick = 0;  // ticks done
  uint32_t next_group = 1;
  uint64_t lost_messages = 0;
  internal::Steering steering;  // scratch: copies start empty
};

namespace internal {

/// Everything that one tick reads and writes.
struct CrowdTick {
  const CrowdModel& model;
  const CrowdPlan& plan;
  CrowdState& state;
  CrowdInternals& in;
  std::span<const CrowdDrone> drones;
  std::vector<CrowdEvent>* events;
  int64_t t_ns;
};

// states.cc
/// Enters `to` unless it is cooling down; `seconds` < 0: drawn from the state's own range. False if refused.
bool EnterState(CrowdTick& tick, PersonIndex i, uint8_t to, double min_s, double max_s, const std::string& cause);
/// Time, messages and chance.
void RunStateMachine(CrowdTick& tick, PersonIndex i);

// messages.cc
void Post(CrowdTick& tick, PersonIndex from, PersonIndex to, uint8_t type, uint32_t value = 0);
void Deliver(CrowdTick& tick);
/// Takes the oldest message of a type out of an inbox.
bool TakeMessage(Agent& agent, uint8_t type, Message* message = nullptr);
void ForgetOld(Agent& agent, int64_t t_ns);

// groups.cc
Group* FindGroup(CrowdInternals& in, uint32_t id);
uint32_t FoundGroup(CrowdTick& tick, PersonIndex a, PersonIndex b);
bool JoinGroup(CrowdTick& tick, PersonIndex i, uint32_t group);
void LeaveGroup(CrowdTick& tick, PersonIndex i);
/// A talk of a party, under its number.
void FoundPartyTalk(CrowdTick& tick, uint32_t party, const std::vector<PersonIndex>& members);
/// Where a member stands.
Vec2d SlotOf(const Group& group, PersonIndex i);
/// Turns, ends, people who stand alone.
void RunGroups(CrowdTick& tick);

// walking.cc
void SetGoal(CrowdTick& tick, PersonIndex i, const NavPoint& goal, double speed, double reach);
void DropGoal(CrowdTick& tick, PersonIndex i);
void LeavePlace(CrowdTick& tick, PersonIndex i);
/// On to the place that is theirs, or off it: the feet get there within a moment.
void MoveFeet(CrowdTick& tick, PersonIndex i, bool to_place);
/// Where the feet are: on the mesh, or at a place beside it.
Vec3d FeetOf(const CrowdPlan& plan, const CrowdInternals& in, PersonIndex i, int64_t t_ns);
/// Paths for those who wait for one.
void FindWays(CrowdTick& tick);
/// At 5 Hz: crossings, short cuts, progress.
void WatchWay(CrowdTick& tick, PersonIndex i);
/// Reports who has not moved for 30 s though they want to.
void WatchStuck(CrowdTick& tick, PersonIndex i);
/// Whether a straight line is free and does not lead onto a road that the way avoids.
bool ShortCut(const NavMesh& mesh, const NavPoint& at, Vec2d target);
/// Velocities wanted by all.
void WantVelocities(CrowdTick& tick);

// mind.cc
void Think(CrowdTick& tick, PersonIndex i);
void HaltPerson(CrowdTick& tick, PersonIndex i);
/// The drone nearest to someone's head; -1 = none.
int NearestDrone(const CrowdTick& tick, PersonIndex i, double* distance);

// crowd.cc
void AddEvent(CrowdTick& tick, CrowdEvent event);

}  // namespace internal
}  // namespace airsim360
