// What authors decide about a crowd: states and how they follow one another, messages, trees, places.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/behaviour/tree.h"
#include "airsim360/people/navigation/navmesh.h"
#include "airsim360/people/person_state.h"

namespace airsim360 {
namespace internal {
using namespace behaviour;  // trees are the larger part of what is internal here

inline constexpr size_t kMaxStates = 48, kMaxMessages = 64;
inline constexpr uint8_t kAnyState = 255, kNoMessage = 255;

/// A state of the machine that every person is; names are unique.
struct StateDef {
  std::string name;
  std::optional<Behaviour> lower;  ///< none: by how fast they move
  std::optional<Behaviour> upper;  ///< none: as `lower`
  double speed = 1;                ///< factor of how fast they like to walk
  bool stop = false;               ///< they stand (or sit) still
  double min_s = 0, max_s = 0;     ///< how long it lasts; 0 = until something changes it
  double cooldown_s = 0;           ///< after leaving, before it may be entered again
  uint8_t next = 0;                ///< state that follows
};

/// `from` -> `to` when a message comes (`message`), or at random (`rate_per_min`).
struct TransitionDef {
  uint8_t from = kAnyState, to = 0;
  uint8_t message = kNoMessage;
  double chance = 1;  ///< that a message has the effect
  double rate_per_min = 0;
};

// States and messages that the code refers to; the first of their lists, in this order.
enum BuiltInState : uint8_t {
  kWalking,
  kStanding,
  kChatting,
  kOnPhoneCall,
  kTexting,
  kTakingPhoto,
  kWaving,
  kSitting,
  kCarrying,
  kPushingStroller,
  kCrouching,
  kStretching,
  kPointing,
  kWaiting,
  kLookingUp,
  kWithUmbrella,
  kWithDog,
  kSittingWithPhone,
  kBuiltInStates
};
enum BuiltInMessage : uint8_t { kGreet, kAccept, kDecline, kTurn, kBye, kCall, kAlarm, kDroneNear, kHello, kBuiltInMessages };

enum class PlaceKind : uint8_t { kBench, kShop, kFood, kSight, kStop, kQueue, kCount };
inline constexpr const char* kPlaceKindNames[] = {"bench", "shop", "food", "sight", "stop", "queue"};

/// Somewhere to go: one person at a time.
struct Place {
  PlaceKind kind = PlaceKind::kShop;
  NavPoint approach;  ///< on the mesh
  Vec3d p_W;          ///< where they stand or sit, feet
  double yaw = 0;     ///< how they face there
  Seating seating = {};
  int rank = 0;  ///< of a queue: 0 is the first; the others of the line follow it in the list
};

/// People who are out together; who they are is in crowd/parties.h.
struct Party {
  std::vector<PersonIndex> members;  ///< two to four; the first of them who is there and free leads
  double spacing = 0.75;             ///< metres between neighbours
};

std::vector<StateDef> DefaultStates();
std::vector<TransitionDef> DefaultTransitions();
std::vector<std::string> DefaultMessages();
/// What may stand in the ports of people's trees: choices become their numbers, points points.
struct TreeVocabulary {
  std::vector<std::string> states, messages, areas;
  bool any_area = false;  ///< names of areas are not looked up
};
/// Reads ports with those words, and with the kinds of places.
ParsePort PersonPorts(TreeVocabulary words);
/// "x;y" or "x;y;z", metres; InputError otherwise.
Value ParsePoint(const std::string& text);
/// Trees of the default crowd, as XML that an author could have written.
std::string_view DefaultTreesXml();
/// Tree name and weight of the default mix: outdoors, and in furnished rooms.
const std::vector<std::pair<std::string, double>>& DefaultMix(bool furnished);
/// Boxes of the entities of `construction/ceiling`: a scene that has some has rooms.
std::vector<Box3f> Ceilings(const Scene& scene);
/// Whether somebody is tall enough for a seat that was measured: the back of their knees is above its edge.
inline bool Fits(const Place& place, double stature) {
  return place.seating.height == 0 || (stature >= 1.5 && place.seating.height <= 0.295 * stature);
}
/// Benches, shops and the like of a scene that can be reached over the mesh, in the order of the entities; `furnished`: the scene has
/// rooms, where seats are measured and counters have lines.
std::vector<Place> FindPlaces(const Scene& scene, const NavMesh& mesh, bool furnished);

/// "walk", "phone_call" …: by Behaviour.
extern const char* const kBehaviourNames[];

}  // namespace internal

/// Behaviour of a CrowdModel.
struct CrowdPlan {
  std::vector<internal::StateDef> states;
  std::vector<internal::TransitionDef> transitions;
  std::vector<std::string> messages;
  internal::TreeSet trees;
  std::vector<internal::Place> places;
  std::vector<NavArea> ground;           ///< of each CrowdModel::areas: where people start and wander
  std::vector<uint16_t> tree_of_person;  ///< index into trees
  std::vector<NavPoint> starts;          ///< of each person; reserve ones have none
  std::vector<internal::Party> parties = {};
  std::vector<uint32_t> party_of_person = {};  ///< number of a party, from 1; 0 = alone
  // In rooms, by person: the seat that they begin on, -1 = none; whom they begin to talk with, kNoPerson = nobody.
  std::vector<int32_t> start_seats = {};
  std::vector<PersonIndex> start_partners = {};
};

}  // namespace airsim360
