// The people of a simulation: who they are (constant), what changes, and one tick of it. Crowd decides where
// people are and what they do, motion how their limbs move; both are deterministic.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/people/body/body.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/motion/pose.h"

namespace airsim360 {

/// What never changes of the people of a simulation. Shared, read-only. The lists are as long as
/// CrowdModel::people.
struct SimPeople {
  std::shared_ptr<const CrowdModel> crowd;
  std::vector<PersonInScene> cast;  ///< bodies
  std::vector<PersonRef> refs;      ///< where they are in the scene; empty: nobody is seen
  std::vector<Socket> sockets;      ///< of users: labelled beside those of the body
  uint64_t seed = 0;
  std::shared_ptr<const struct PeopleState> start;  ///< at simulation time 0
  int64_t epoch_ns = 0;                             ///< crowd time at simulation time 0: how long people had lived before
};

/// Everything that changes, at a multiple of kCrowdTickNs. Immutable once shared: snapshots hold the pointer.
struct PeopleState {
  CrowdState crowd;
  std::vector<MotionState> motions;
};

/// Everybody where the crowd starts, at crowd time 0, then `epoch_ns` of life without drones. InputError as
/// StartCrowd.
std::shared_ptr<const PeopleState> StartPeople(const SimPeople& people);

/// One tick of kCrowdTickNs.
void TickPeople(const SimPeople& people, std::span<const CrowdDrone> drones, PeopleState& state, std::vector<CrowdEvent>* events = nullptr,
                std::span<const CrowdVehicle> vehicles = {});

/// Hash of every number of the state.
uint64_t HashPeople(const PeopleState& state);

/// The people at one instant, ready to be seen. Lists as long as CrowdModel::people.
struct PeoplePoses {
  int64_t t_ns = 0;
  std::vector<PersonState> states;
  std::vector<SkeletonPose> poses;  ///< of those who are not visible: unspecified
  std::vector<uint8_t> levels;      ///< of detail that they are shown with; empty: the finest of each
};

/// The people at t_ns of crowd time, at most one tick after the state: people move on evenly.
PeoplePoses PosesAt(const SimPeople& people, const PeopleState& state, int64_t t_ns);

/// The people at any later t_ns of crowd time, as they go on without drones near them: for optical flow.
PeoplePoses PosesLater(const SimPeople& people, const PeopleState& state, int64_t t_ns);

/// Levels of detail for a viewer at p_WC, by the angle that each person fills: finest where they are 200 pixels tall in a
/// panorama of 4096 x 2048 (a man at 5.7 m), then from 60 (19 m) and 20 pixels (57 m) on. Independent of the picture, so
/// that all pictures of an instant show the same. Bodies that lack a level show the next.
std::vector<uint8_t> LevelsFor(const SimPeople& people, std::span<const PersonState> states, Vec3d p_WC);

/// Adds the people, skinned, to a scene state; nothing if they have no place in the scene.
void ShowPeople(const SimPeople& people, const PeoplePoses& poses, SceneState& scene_state);

/// What a drone can touch of a person: an upright box around the body, at the time of `state`.
struct PersonBox {
  RigidTransform X_WB;
  Vec3d half_size_B;
  Vec3d v_W;
  EntityId entity = kNoEntity;
};
/// Boxes of the people who may come within `reach` metres of p, carried on to t_ns
/// of crowd time.
std::vector<PersonBox> PeopleNear(const SimPeople& people, const PeopleState& state, int64_t t_ns, Vec3d p_W, double reach);

/// Where the person of an entity stands at t_ns of crowd time: ground point and heading. nullopt for entities
/// that are nobody's body, and people who are not in the world.
std::optional<RigidTransform> PlaceOfPerson(const SimPeople& people, const PeopleState& state, int64_t t_ns, EntityId entity);
/// Whether an entity is the body of one of the people, in the world or not.
bool IsPerson(const SimPeople& people, EntityId entity);

/// Name of a behaviour in labels: "walk", "phone_call".
const char* BehaviourName(Behaviour behaviour);

}  // namespace airsim360
