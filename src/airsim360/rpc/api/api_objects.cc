// Objects of the scene by name, and segmentation ids.
#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

using Text = const std::string&;

// Vehicles can be asked for like objects.
const VehicleStatus* VehicleNamed(const Snapshot& now, Text name, size_t& index) {
  for (index = 0; index < now.vehicles.size(); ++index) {
    if (now.vehicles[index].name == name) return &now.vehicles[index];
  }
  return nullptr;
}

bool IsThere(const WorldView& world, EntityId entity) {
  const auto found = world.places.find(entity);
  return found == world.places.end() || !found->second.hidden;
}

// NaN is what AirSim gives for a name that it does not know.
airsim::Pose NoPose() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  return {{kNan, kNan, kNan}, {kNan, kNan, kNan, kNan}};
}

// Changes the place of an object that can be moved; false if there is none.
template <class ChangePlace>
bool MoveObject(Session& s, Text name, const ChangePlace& change) {
  const ObjectIndex& objects = s.objects();
  const EntityId entity = objects.Find(name, s.world().names);
  // Vehicles have calls of their own.
  if (entity == kNoEntity || !IsThere(s.world(), entity) || s.HasVehicle(name)) return false;
  if (s.model().people && IsPerson(*s.model().people, entity)) {
    NoticeOnce("'" + name + "' is a person and walks by itself");
    return false;
  }
  if (s.model().traffic && VehicleOf(*s.model().traffic, entity)) {
    NoticeOnce("'" + name + "' is a vehicle of the traffic and drives by itself");
    return false;
  }
  if (objects.InstancesOf(entity).empty()) {
    NoticeOnce("'" + name + "' is part of a larger mesh and cannot be moved");
    return false;
  }
  ObjectPlace place = PlaceIn(s.world(), objects, entity);
  change(place);
  s.world().places[entity] = place;
  s.ObjectsMoved();
  return true;
}

Vec3d CheckedScale(const airsim::Vector3r& scale) {
  constexpr double kSmallest = 1e-4, kLargest = 1e4;  // smaller ones cannot be undone in float
  const Vec3d factor = airsim::FromVector(scale);
  for (int i = 0; i < 3; ++i) {
    if (!(factor[i] >= kSmallest && factor[i] <= kLargest)) throw std::invalid_argument("scale must be in 0.0001 ... 10000");
  }
  return factor;
}

void AddPoseCalls(Api& api) {
  api.Read(
      "simGetObjectPose",
      [&api](const Snapshot& now, Text name, bool /*ned*/) {
        // Cosys' second argument asks for an engine's own axes, which there are none of here.
        size_t index = 0;
        const Vec3d origin_W = api.session().origin_W();
        if (VehicleNamed(now, name, index)) return airsim::ToPose(now.state.vehicles[index].motion.X_WB, origin_W);
        const EntityId entity = api.session().objects().Find(name, now.world->names);
        if (entity == kNoEntity) return NoPose();
        const ObjectPlace place = PlaceNow(now, api.session().objects(), entity);
        if (place.hidden) return NoPose();
        return airsim::Pose{airsim::ToVector(NedFromWorld(place.X_WO.p - origin_W)), airsim::ToQuaternionr(NedAttitude(place))};
      },
      1);
  api.Change("simSetObjectPose", [](Session& s, Text name, const airsim::PoseChange& pose, bool /*teleport*/) {
    const Vec3d p_W = airsim::FromPose(pose, s.origin_W()).p;
    const Mat3d R = ObjectRotation(airsim::FromQuaternionr(pose.orientation));
    return MoveObject(s, name, [&](ObjectPlace& place) {
      if (!pose.keeps_position) place.X_WO.p = p_W;
      if (!pose.keeps_orientation) place.X_WO.R = R;
    });
  });
  api.Read("simGetObjectScale", [&api](const Snapshot& now, Text name) {
    const EntityId entity = api.session().objects().Find(name, now.world->names);
    if (entity == kNoEntity) return airsim::Vector3r{};  // as AirSim
    const ObjectPlace place = PlaceIn(*now.world, api.session().objects(), entity);
    return place.hidden ? airsim::Vector3r{} : airsim::ToVector(place.scale);
  });
  api.Change("simSetObjectScale", [](Session& s, Text name, const airsim::Vector3r& scale) {
    const Vec3d factor = CheckedScale(scale);
    return MoveObject(s, name, [&](ObjectPlace& place) { place.scale = factor; });
  });
}

void AddListCalls(Api& api) {
  api.Picture("simListSceneObjects", [&api](ImageService&, const SnapshotPointer& now, Text regex) {
    std::vector<std::string> names;
    const ObjectIndex& objects = api.session().objects();
    for (const EntityId entity : objects.Match(regex, now->world->names)) {
      if (!PlaceNow(*now, objects, entity).hidden) names.push_back(objects.NameOf(entity, now->world->names));
    }
    return names;
  });
  api.Picture("simListSceneObjectsTags", [&api](ImageService&, const SnapshotPointer& now, Text regex) {
    std::vector<std::pair<std::string, std::string>> tags;
    const Scene& scene = api.session().objects().scene();
    for (const EntityId id : api.session().objects().Match(regex, now->world->names)) {
      const Entity& entity = scene.entity(id);
      const ObjectIndex& objects = api.session().objects();
      if (!PlaceNow(*now, objects, id).hidden) tags.emplace_back(objects.NameOf(id, now->world->names), scene.tree[entity.category].path);
    }
    return tags;
  });
  api.Change("simDestroyObject",
             [](Session& s, Text name) { return MoveObject(s, name, [](ObjectPlace& place) { place.hidden = true; }); });
}

std::vector<EntityId> Named(Session& s, Text name, bool is_regex) {
  if (is_regex) return s.objects().Match(name, s.world().names);
  const EntityId entity = s.objects().Find(name, s.world().names);
  return entity == kNoEntity ? std::vector<EntityId>{} : std::vector<EntityId>{entity};
}

void AddSegmentationCalls(Api& api) {
  api.Change("simSetSegmentationObjectID", [](Session& s, Text name, int id, bool is_regex) {
    // Ids beyond 255 are ours; 24 bits fit the colours.
    if (id < 0 || id >= 1 << 24) throw std::invalid_argument("object_id must be in 0 ... 16777215");
    const std::vector<EntityId> entities = Named(s, name, is_regex);
    for (const EntityId entity : entities) s.world().segmentation[entity] = static_cast<uint32_t>(id);
    return !entities.empty();
  });
  api.Read("simGetSegmentationObjectID", [&api](const Snapshot& now, Text name) {
    const EntityId entity = api.session().objects().Find(name, now.world->names);
    return entity == kNoEntity ? -1 : static_cast<int>(now.world->segmentation[entity]);
  });
}

void AddSpawnCalls(Api& api) {
  api.Read("simListAssets", [&api](const Snapshot&) { return api.session().AssetNames(); });
  api.Change("simSpawnObject", [](Session& s, Text name, Text asset, const airsim::Pose& pose, const airsim::Vector3r& scale, bool physics,
                                  bool /*is_blueprint*/) {
    if (physics) NoticeOnce("simSpawnObject: objects stay where they are put, also with physics_enabled");
    const Vec3d p_W = airsim::FromPose(pose, s.origin_W()).p;
    const Mat3d R = ObjectRotation(airsim::FromQuaternionr(pose.orientation));
    return s.Spawn(name, asset, {{R, p_W}, CheckedScale(scale)});
  });
}

}  // namespace

void AddObjectCalls(Api& api) {
  AddSpawnCalls(api);
  AddPoseCalls(api);
  AddListCalls(api);
  AddSegmentationCalls(api);
}

}  // namespace airsim360
