// People for a world: bodies for everyone of a crowd, as entities of the scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "airsim360/sim/people/people.h"

namespace airsim360 {

struct PeopleRequest {
  std::optional<size_t> count = {};    ///< overrides the file
  std::filesystem::path file = {};     ///< people.yaml of docs/guide/people_behaviour.md; empty: the default crowd
  std::filesystem::path sockets = {};  ///< further keypoints (ReadSockets); empty: none
  size_t reserve = 0;                  ///< people who can be brought in later
  double warm_up = 15;                 ///< seconds that people live before the simulation begins
  int level = -1;                      ///< of detail of all bodies; -1: finer for fewer people
  uint64_t seed = 0;
  std::shared_ptr<const NavMesh> navmesh = nullptr;  ///< of the scene, if there is one already

  /// Whether there are any.
  bool any() const { return count.value_or(0) > 0 || !file.empty() || reserve > 0; }
};

struct PopulatedScene {
  std::shared_ptr<const Scene> scene;       ///< with everybody hidden
  std::shared_ptr<const SimPeople> people;  ///< null: nobody
};

/// The scene with its people, after all that it has: ids of everything else stay, and depend on the request
/// alone. Entities are "person/000", … by index in the crowd. InputError for what BuildCrowd, StartCrowd and
/// ReadSockets refuse.
PopulatedScene Populate(std::shared_ptr<const Scene> scene, const PeopleRequest& request);

/// The body that fits a person of the crowd.
BodySpec SpecOf(const PersonTraits& traits);

}  // namespace airsim360
