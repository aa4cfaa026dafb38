// The things of a scene as AirSim's calls see them: by name, with poses, scales and segmentation ids.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360 {

/// Where an object has been put. Its pose is that of the centre of its bounds, unturned as the scene has it.
struct ObjectPlace {
  RigidTransform X_WO;
  Vec3d scale = {1, 1, 1};
  bool hidden = false;
  bool is_body = false;             ///< of a drone, a person or a vehicle of the traffic: X_WO is the pose of a body that looks along +X
  std::optional<Box3f> box_O = {};  ///< around it, where its bounds in the scene are not those of a body at X_WO
};
/// Its attitude in N. An object that is not turned has the unit quaternion, whatever the axes.
Mat3d NedAttitude(const ObjectPlace& place);

/// Names that calls have given to objects of the scene that were held ready without one.
using ObjectNames = std::map<EntityId, std::string>;

/// What never changes of a scene's objects.
class ObjectIndex {
 public:
  explicit ObjectIndex(std::shared_ptr<const Scene> scene);

  const Scene& scene() const { return *scene_; }
  /// Entity of a name; kNoEntity if there is none.
  EntityId Find(const std::string& name, const ObjectNames& given = {}) const;
  const std::string& NameOf(EntityId entity, const ObjectNames& given) const;
  /// Instances that are wholly this entity's: what can be moved. Empty for parts of larger meshes.
  const std::vector<uint32_t>& InstancesOf(EntityId entity) const;
  ObjectPlace PlaceOf(EntityId entity) const;
  /// Things whose names a regular expression (base/pattern.h) matches as a whole, letters of either case, in the
  /// order of their ids. InputError for an expression that is none.
  std::vector<EntityId> Match(const std::string& regex, const ObjectNames& given = {}) const;
  /// Where the instances of an entity are when it is put elsewhere.
  void Move(EntityId entity, const ObjectPlace& place, std::vector<MovedInstance>& moved) const;

 private:
  std::shared_ptr<const Scene> scene_;
  std::map<std::string, EntityId, std::less<>> by_name_;
  std::vector<std::pair<std::string_view, EntityId>> sorted_names_;  // as patterns are quickest asked
  std::vector<std::vector<uint32_t>> instances_;                     // by entity - 1
};

struct Snapshot;
struct WorldView;
/// Where the scene or a call has put an object.
ObjectPlace PlaceIn(const WorldView& world, const ObjectIndex& objects, EntityId entity);
/// Where an object is in a snapshot: drones where they fly, people where they walk, vehicles of the traffic where they drive
/// (the ground below their middle), other things as PlaceIn says. `hidden` for people who are not in the world, and for vehicles
/// of the world that would stand in the way of the traffic.
ObjectPlace PlaceNow(const Snapshot& now, const ObjectIndex& objects, EntityId entity);

/// AirSim's id of a name: a sum of its letters (Unreal/Plugins/AirSim/Source/AirBlueprintLib.h).
int DefaultSegmentationId(const std::string& name);
/// AirSim's SegmentationSettings.InitMethod: "None" gives 0 to all.
std::vector<uint32_t> InitialSegmentation(const Scene& scene, const std::string& init_method);

}  // namespace airsim360
