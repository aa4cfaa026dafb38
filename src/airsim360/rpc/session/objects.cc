#include "airsim360/rpc/session/objects.h"

#include <algorithm>

#include "airsim360/base/pattern.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {

ObjectIndex::ObjectIndex(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
  for (const Entity& entity : scene_->entities) {
    by_name_[entity.name] = entity.id;
    sorted_names_.emplace_back(entity.name, entity.id);
  }
  std::ranges::sort(sorted_names_);
  instances_.resize(scene_->entities.size());
  // Meshes with parts of several entities are fixed.
  for (uint32_t i = 0; i < scene_->instances.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    const auto& parts = scene_->meshes[instance.mesh].parts;
    EntityId owner = instance.entity;
    const bool one = std::all_of(parts.begin(), parts.end(), [&](const MeshPart& part) {
      const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
      if (&part == &parts.front()) owner = entity;
      return entity == owner;
    });
    if (one && owner != kNoEntity) instances_[owner - 1].push_back(i);
  }
}

EntityId ObjectIndex::Find(const std::string& name, const ObjectNames& given) const {
  for (const auto& [entity, other] : given) {
    if (other == name) return entity;
  }
  const auto found = by_name_.find(name);
  return found == by_name_.end() || given.contains(found->second) ? kNoEntity : found->second;
}

const std::string& ObjectIndex::NameOf(EntityId entity, const ObjectNames& given) const {
  const auto found = given.find(entity);
  return found == given.end() ? scene_->entity(entity).name : found->second;
}

const std::vector<uint32_t>& ObjectIndex::InstancesOf(EntityId entity) const { return instances_[entity - 1]; }

ObjectPlace ObjectIndex::PlaceOf(EntityId entity) const {
  ObjectPlace place;
  const Box3f& bounds = scene_->entity(entity).bounds;
  if (!bounds.empty()) place.X_WO.p = VecCast<double>(bounds.center());
  return place;
}

std::vector<EntityId> ObjectIndex::Match(const std::string& regex, const ObjectNames& given) const {
  const Pattern pattern = Pattern::Regex(regex, true);
  PatternMatcher matcher(pattern);
  std::vector<EntityId> matches;
  for (const auto& [name, entity] : sorted_names_) {
    if (matcher.Matches(given.empty() ? std::string_view(name) : NameOf(entity, given))) matches.push_back(entity);
  }
  std::ranges::sort(matches);
  return matches;
}

void ObjectIndex::Move(EntityId entity, const ObjectPlace& place, std::vector<MovedInstance>& moved) const {
  const Vec3f centre = VecCast<float>(PlaceOf(entity).X_WO.p);
  AffineTransform X;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      X.A.m[i][j] = static_cast<float>(place.X_WO.R.m[i][j] * place.scale[static_cast<int>(j)]);
    }
  }
  X.p = VecCast<float>(place.X_WO.p) - X.A * centre;
  for (const uint32_t instance : InstancesOf(entity)) {
    moved.push_back({instance, X * scene_->instances[instance].X_WM, place.hidden});
  }
}

Mat3d NedAttitude(const ObjectPlace& place) { return place.is_body ? NedRotation(place.X_WO.R) : ObjectRotation(place.X_WO.R); }

ObjectPlace PlaceIn(const WorldView& world, const ObjectIndex& objects, EntityId entity) {
  const auto found = world.places.find(entity);
  return found == world.places.end() ? objects.PlaceOf(entity) : found->second;
}

namespace {

// Of a vehicle that drives, or that the traffic hides; nullopt: it is none.
std::optional<ObjectPlace> PlaceInTraffic(const Snapshot& now, const ObjectIndex& objects, EntityId entity) {
  if (!now.model->traffic || !now.state.traffic) return std::nullopt;
  const SimTraffic& traffic = *now.model->traffic;
  if (const auto i = VehicleOf(traffic, entity)) {
    const VehicleShape& shape = traffic.model.vehicles[*i].shape;
    ObjectPlace place{.X_WO = PoseOf(traffic.model, *now.state.traffic, *i, now.state.t_ns + traffic.epoch_ns), .is_body = true};
    place.box_O = Box3f{VecCast<float>(Vec3d{-shape.length / 2, -shape.width / 2, 0}),
                        VecCast<float>(Vec3d{shape.length / 2, shape.width / 2, shape.height})};
    return place;
  }
  const std::vector<uint32_t>& instances = objects.InstancesOf(entity);
  const bool gone = !instances.empty() && std::ranges::binary_search(traffic.standing, instances.front());
  return gone ? std::optional(ObjectPlace{.X_WO = {}, .hidden = true}) : std::nullopt;
}

}  // namespace

ObjectPlace PlaceNow(const Snapshot& now, const ObjectIndex& objects, EntityId entity) {
  for (size_t i = 0; i < now.model->drones.size(); ++i) {
    if (now.model->drones[i]->setup().entity == entity) return {.X_WO = now.state.vehicles[i].motion.X_WB, .is_body = true};
  }
  if (now.model->people && now.state.people && IsPerson(*now.model->people, entity)) {
    const SimPeople& people = *now.model->people;
    const auto X = PlaceOfPerson(people, *now.state.people, now.state.t_ns + people.epoch_ns, entity);
    return X ? ObjectPlace{.X_WO = *X, .is_body = true} : ObjectPlace{.X_WO = {}, .hidden = true};
  }
  if (const auto place = PlaceInTraffic(now, objects, entity)) return *place;
  return PlaceIn(*now.world, objects, entity);
}

int DefaultSegmentationId(const std::string& name) {
  int sum = 5;
  for (const unsigned char c : name) {
    if (c >= 97) sum += c;
  }
  return sum % 256;
}

std::vector<uint32_t> InitialSegmentation(const Scene& scene, const std::string& init_method) {
  std::vector<uint32_t> ids(scene.entities.size() + 1, 0);
  if (init_method == "None") return ids;
  for (const Entity& entity : scene.entities) {
    // The sky is no mesh of AirSim's and has no id.
    if (entity.id != scene.sky_entity) ids[entity.id] = static_cast<uint32_t>(DefaultSegmentationId(entity.name));
  }
  return ids;
}

}  // namespace airsim360
