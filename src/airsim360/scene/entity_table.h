// The entities of a scene as a table: what each is, where it stands and how large it is.
#pragma once

#include <string>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

/// One entity. Things that are one placed mesh have that mesh's pose (rotation without scale); what is merged
/// into larger meshes, or shown by several, stands at the middle of its box's floor, unturned.
struct EntityRow {
  EntityId id = kNoEntity;
  std::string name;
  CategoryId category = kVoid;
  std::string path;   ///< of the category: "vegetation/tree/conifer/pine"
  bool thing = true;  ///< countable
  RigidTransform X_WE;
  bool has_box = false;    ///< false: the sky, and things without a surface
  Box3f box;               ///< in W, axis-aligned
  uint32_t instances = 0;  ///< placed meshes that are its own
};

/// All entities, by id.
std::vector<EntityRow> EntityTable(const Scene& scene);

}  // namespace airsim360
