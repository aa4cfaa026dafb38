// Bodies into meshes and scenes: linear blend skinning, and people as entities of a scene.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "airsim360/people/body/body.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360 {

/// Vertices of a level in the pose, relative to `p_W_origin` (axes of W). Props that the pose does not show
/// shrink to a point inside the body. `positions` is resized. Linear blend skinning with 4 influences.
void SkinBody(const Body& body, int level, const SkeletonPose& pose, Vec3d p_W_origin,
              std::vector<Vec3f>& positions);

/// A person to be added to a scene.
struct PersonInScene {
  std::string name;  ///< of the entity, e.g. "person/007"; props are "person/007/phone"
  std::shared_ptr<const Body> body;
  int level = 1;  ///< of detail
};

/// Where a person has come to in the scene.
struct PersonRef {
  uint32_t instance = 0;
  MeshId mesh = 0;
  EntityId entity = kNoEntity;
  int level = 1;
  std::array<EntityId, kPropCount> props{};  ///< entities of the props; kNoEntity where it has none
};

/// The scene with people added, each a mesh, an instance and an entity (category human/person) of its own,
/// after those that it has: ids of everything else stay. Textures are shared by people of one character. In
/// place where `scene` is the only reference, else a copy. `refs`: one for each person. People are hidden
/// until a SceneState shows them: they stand at rest below the ground.
std::shared_ptr<const Scene> AddPeople(std::shared_ptr<const Scene> scene,
                                       std::span<const PersonInScene> people, std::vector<PersonRef>& refs);

/// Appends the people to a state, skinned in parallel; `poses[i]` null = hidden. Keeps `moved` and `deformed`
/// sorted if what they hold comes before the people (as drones' bodies that were added earlier do), else sorts.
void AppendPeople(std::span<const PersonInScene> people, std::span<const PersonRef> refs,
                  std::span<const SkeletonPose* const> poses, SceneState& state);

}  // namespace airsim360
