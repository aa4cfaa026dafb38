// Bodies into meshes and scenes: linear blend skinning, and people as entities of a scene.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "airsim360/people/body/body.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360 {

/// Vertices of a level in the pose, relative to `p_W_origin` (axes of W). Props that the pose does not show
/// shrink to a millimetre inside the body. `positions` is resized. Linear blend skinning with 4 influences.
void SkinBody(const Body& body, int level, const SkeletonPose& pose, Vec3d p_W_origin, std::vector<Vec3f>& positions);

/// A person to be added to a scene.
struct PersonInScene {
  std::string name;  ///< of the entity, e.g. "person/007"; props are "person/007/phone"
  std::shared_ptr<const Body> body;
  int level = 1;         ///< of detail, the finest that is added
  bool coarser = false;  ///< all coarser levels too, so that each instant can choose
};

/// Where a person has come to in the scene. Levels of detail are meshes and instances that follow each other.
struct PersonRef {
  uint32_t instance = 0;  ///< of the finest level
  MeshId mesh = 0;
  EntityId entity = kNoEntity;
  int level = 1;                             ///< the finest
  int level_count = 1;                       ///< level ... level + level_count - 1 are there
  std::array<EntityId, kPropCount> props{};  ///< entities of the props; kNoEntity where it has none

  /// The level that is shown where `wanted` is asked for.
  int LevelFor(int wanted) const { return std::clamp(wanted, level, level + level_count - 1); }
  uint32_t InstanceOf(int shown) const { return instance + static_cast<uint32_t>(shown - level); }
  MeshId MeshOf(int shown) const { return mesh + static_cast<MeshId>(shown - level); }
};

/// The scene with people added, each an entity (category human/person) of its own with one mesh and instance for each
/// level of detail, after those that it has: ids of everything else stay. Textures are shared by people of one
/// character. In place where `scene` is the only reference, else a copy. `refs`: one for each person. People are hidden
/// until a SceneState shows them: they stand at rest below the ground.
std::shared_ptr<const Scene> AddPeople(std::shared_ptr<const Scene> scene, std::span<const PersonInScene> people,
                                       std::vector<PersonRef>& refs);

/// Appends the people to a state, skinned in parallel; `poses[i]` null = hidden, `levels[i]` the level of detail wanted
/// (no levels: the finest). Keeps `moved` and `deformed` sorted if what they hold comes before the people (as drones'
/// bodies that were added earlier do), else sorts.
void AppendPeople(std::span<const PersonInScene> people, std::span<const PersonRef> refs, std::span<const SkeletonPose* const> poses,
                  std::span<const uint8_t> levels, SceneState& state);

/// Appends people to `state.moved`, all hidden. The caller keeps the list in order.
void HidePeople(std::span<const PersonRef> refs, SceneState& state);

}  // namespace airsim360
