// Many people at once: who they are (constant), where they are and what they do (copyable), and one step.
// docs/guide/people_behaviour.md describes trees, states, messages and the file that authors write.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "airsim360/people/navigation/navmesh.h"
#include "airsim360/people/person_state.h"

namespace airsim360 {

struct CrowdPlan;       // behaviour: trees, states, messages, areas with their outlines
struct CrowdInternals;  // what the people think

/// Where people live: they start in it and wander in it.
struct CrowdArea {
  std::string name;
  std::vector<Vec2d> outline;  ///< metres in W; empty = the whole mesh
};

/// Who a person is. Drawn from (seed, index) alone.
struct PersonTraits {
  std::string name;  ///< "person 17"; unique
  double age = 35;   ///< years
  bool female = false;
  double stature = 1.72;     ///< metres
  double free_speed = 1.34;  ///< m/s they like to walk at
  uint64_t look = 0;         ///< uniform 64 bits: which of the bodies that fit, which clothes
  uint32_t area = 0;         ///< CrowdModel::areas
  bool reserve = false;      ///< not in the world until a SpawnPerson names them
};

/// What never changes. Shared, read-only.
struct CrowdModel {
  std::shared_ptr<const NavMesh> navmesh;
  std::vector<CrowdArea> areas;
  std::vector<PersonTraits> people;
  std::shared_ptr<const CrowdPlan> plan;
  uint64_t seed = 0;
};

/// The crowd thinks and steers at 20 Hz; between, people move evenly.
inline constexpr int64_t kCrowdTickNs = 50'000'000;

/// Everything that changes; a copy is a snapshot, and continues with the same bytes.
class CrowdState {
 public:
  CrowdState();
  CrowdState(const CrowdState& other);
  CrowdState(CrowdState&&) noexcept;
  CrowdState& operator=(const CrowdState& other);
  CrowdState& operator=(CrowdState&&) noexcept;
  ~CrowdState();

  int64_t t_ns = 0;
  std::vector<PersonState> people;  ///< as CrowdModel::people, at t_ns
  std::unique_ptr<CrowdInternals> internals;
};

/// A drone as people see it.
struct CrowdDrone {
  Vec3d p_W;
  Vec3d v_W;
  double radius = 0.3;  ///< metres
};

/// A vehicle as people see it: a box on the ground, now and every kCrowdVehicleStep seconds from now.
inline constexpr double kCrowdVehicleStep = 0.5;
struct CrowdVehicle {
  struct Footprint {
    Vec2d center;
    Vec2d ahead{1, 0};  ///< unit vector along its length
  };
  std::array<Footprint, 7> places;
  double half_length = 2.2, half_width = 0.9;  ///< metres
  double z = 0;                                ///< of the ground below it
  bool stands = false;
};

/// Something that happened. `person` did or suffered it; `text` says what and why.
struct CrowdEvent {
  enum class Kind {
    kTransition,  ///< state `from` -> `to`, because of `text`
    kNearPass,    ///< a drone (`drone`) came within kNearPass of a person's body, distance `value`, metres
    kStuck,       ///< no progress for 30 s while there is a way: the person gives that goal up
    kMessageLost  ///< an inbox was full
  };
  Kind kind = Kind::kTransition;
  int64_t t_ns = 0;
  PersonIndex person = kNoPerson;
  std::string from = {}, to = {};  ///< names of states
  std::string text = {};           ///< cause: "tree: Chat", "message: greet from person 4", "command"
  PersonIndex other = kNoPerson;
  size_t drone = 0;
  double value = 0;
};
inline constexpr const char* kCrowdEventNames[] = {"transition", "near pass", "stuck", "message lost"};
inline constexpr double kNearPass = 1.5;  ///< metres between a drone's sphere and a body; leaving needs 2.0

/// Places everybody. InputError if more people are asked for than fit their areas.
CrowdState StartCrowd(const CrowdModel& model);

/// Advances by dt_ns > 0 (any; the crowd ticks at multiples of kCrowdTickNs). Adds what happened to `events` in
/// order of time, then person. The result depends neither on threads nor on how a span is cut into steps at
/// multiples of kCrowdTickNs.
void StepCrowd(const CrowdModel& model, CrowdState& state, int64_t dt_ns, std::span<const CrowdDrone> drones,
               std::vector<CrowdEvent>* events = nullptr, std::span<const CrowdVehicle> vehicles = {});

/// 64-bit hash of every number of the state.
uint64_t HashCrowd(const CrowdState& state);

// Commands to single persons, given between steps.
struct SpawnPerson {  ///< a reserve person appears
  Vec3d p_W;
  double yaw = 0;
};
struct MovePerson {  ///< is elsewhere at once
  Vec3d p_W;
  double yaw = 0;
};
struct RemovePerson {};
struct SendPerson {  ///< walks there and waits for the next command
  Vec3d p_W;
  double speed = 0;  ///< m/s; 0 = as they like
};
struct SetPersonState {  ///< a state of the plan ("on_phone_call"), for so long; 0 = as the state says
  std::string state;
  double seconds = 0;
};
struct MessagePerson {  ///< of a type of the plan, from nobody
  std::string type;
};
struct ReleasePerson {};  ///< back to their own tree
using PersonAction = std::variant<SpawnPerson, MovePerson, RemovePerson, SendPerson, SetPersonState, MessagePerson, ReleasePerson>;
/// InputError naming the nearest valid choice: no such person, place off the mesh or taken, goal that cannot
/// be reached, unknown state or message. The state is then as it was.
void CommandPerson(const CrowdModel& model, CrowdState& state, PersonIndex person, const PersonAction& action,
                   std::vector<CrowdEvent>* events = nullptr);

/// The InputError of CommandPerson if it would give one; changes and copies nothing.
void CheckPersonCommand(const CrowdModel& model, const CrowdState& state, PersonIndex person, const PersonAction& action);

/// Index of a person by name; InputError naming the nearest.
PersonIndex PersonByName(const CrowdModel& model, std::string_view name);
/// Name of the state a person is in ("walking").
std::string_view PersonStateName(const CrowdModel& model, const CrowdState& state, PersonIndex person);

/// How a person came into the state they are in: the last of their transitions.
struct PersonTransition {
  std::string_view from, to, cause;  ///< "walking", "chatting", "tree: Chat with person 12"; cause "start": none yet
  int64_t t_ns = 0;
};
PersonTransition LastTransition(const CrowdModel& model, const CrowdState& state, PersonIndex person);

// Making a model.
struct CrowdRequest {
  std::filesystem::path file = {};  ///< people.yaml; empty = the default crowd
  std::optional<size_t> count;      ///< overrides the file: spread over its areas
  size_t reserve = 0;               ///< people that SpawnPerson can bring
  uint64_t seed = 0;
};
/// The people of a world: from a file, or `count` people over everything that can be reached from the world's
/// spawn, mostly on pavements. InputError file:line for what is wrong: an area outside the world or without a
/// place to walk, more people than fit, an unknown behaviour, tree, state or message, malformed XML. Without a
/// `navmesh` it builds one of what the default region and the file's areas and people need.
std::shared_ptr<const CrowdModel> BuildCrowd(const Scene& scene, std::shared_ptr<const NavMesh> navmesh, const CrowdRequest& request);

}  // namespace airsim360
