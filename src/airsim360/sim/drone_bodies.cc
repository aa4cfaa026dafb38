#include "airsim360/sim/drone_bodies.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/mesh/drone_body.h"
#include "airsim360/scene/scene_additions.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

AffineTransform PlaceOf(const RigidTransform& X_WB) {
  const Mat3d& R = X_WB.R;
  return {Mat3f::FromColumns(VecCast<float>(R.column(0)), VecCast<float>(R.column(1)), VecCast<float>(R.column(2))),
          VecCast<float>(X_WB.p)};
}

std::string UniqueName(const Scene& scene, const std::string& name) {
  const auto taken = [&](const std::string& text) {
    return std::ranges::any_of(scene.entities, [&](const Entity& entity) { return entity.name == text; });
  };
  if (!taken(name)) return name;
  int number = 2;
  while (taken(name + " " + std::to_string(number))) ++number;
  return name + " " + std::to_string(number);
}

// Its mesh with parts and materials that count on from those of the scene.
MeshId AddMesh(const DroneBodySpec& body, Scene& scene) {
  if (!body.model.textures.empty()) throw InputError("body of '" + body.name + "' has textures");
  Mesh mesh = body.model.mesh;
  const auto first_material = static_cast<MaterialId>(scene.materials.size());
  for (MeshPart& part : mesh.parts) part.material += first_material;
  scene.materials.insert(scene.materials.end(), body.model.materials.begin(), body.model.materials.end());
  scene.meshes.push_back(std::move(mesh));
  return static_cast<MeshId>(scene.meshes.size() - 1);
}

DroneBodyRef AddBody(const DroneBodySpec& body, MeshId mesh, Scene& scene) {
  const EntityId entity = AddInstanceEntity(scene, UniqueName(scene, body.name), scene.tree.At(body.category), {mesh, PlaceOf(body.X_WB)});
  return {static_cast<uint32_t>(scene.instances.size() - 1), entity};
}

// What has moved at `state`; people have the meshes for how far they were from vehicle `self` at `seen`, lamps burn as then.
std::shared_ptr<const SceneState> SceneStateAt(const SimModel& model, const SimState& state, size_t self, const SimState& seen) {
  auto scene_state = std::make_shared<SceneState>();
  scene_state->t_ns = state.t_ns;
  const size_t count = std::min(model.drones.size(), state.vehicles.size());
  for (size_t i = 0; i < count; ++i) {
    const uint32_t instance = model.drones[i]->setup().instance;
    if (instance != kMiss) scene_state->moved.push_back({instance, PlaceOf(state.vehicles[i].motion.X_WB), i == self});
  }
  if (model.people && state.people) {
    PeoplePoses poses = PosesLater(*model.people, *state.people, state.t_ns + model.people->epoch_ns);
    if (self < seen.vehicles.size() && seen.people)
      poses.levels = LevelsFor(*model.people, seen.people->crowd.people, seen.vehicles[self].motion.X_WB.p);
    ShowPeople(*model.people, poses, *scene_state);
  }
  if (model.traffic && state.traffic) {
    const int64_t epoch_ns = model.traffic->epoch_ns;
    ShowTraffic(*model.traffic, *state.traffic, state.t_ns + epoch_ns, *scene_state, {seen.traffic.get(), seen.t_ns + epoch_ns});
  }
  std::ranges::sort(scene_state->moved, {}, &MovedInstance::instance);
  return scene_state;
}

}  // namespace

Model DroneBodyModel(const DroneModel& drone) {
  constexpr float kPlastic = 0.5f;  // roughness
  const DroneBody body = MakeDroneBody(drone, {.discs = true});
  Model model;
  model.mesh.name = drone.name;
  model.mesh.positions = body.positions;
  model.mesh.triangles = body.triangles;
  for (const DronePart& part : body.parts) {
    const auto same = [&](const Material& material) { return material.base_color == part.color; };
    auto found = std::ranges::find_if(model.materials, same);
    if (found == model.materials.end()) {
      Material paint{.name = "drone " + part.name, .base_color = part.color, .roughness = kPlastic};
      found = model.materials.insert(found, std::move(paint));
    }
    const auto material = static_cast<MaterialId>(found - model.materials.begin());
    model.mesh.parts.push_back({part.first, part.count, material});
  }
  return model;
}

std::shared_ptr<const Scene> AddDroneBodies(std::shared_ptr<const Scene> scene, std::span<const DroneBodySpec> bodies,
                                            std::vector<DroneBodyRef>& refs) {
  refs.clear();
  if (bodies.empty()) return scene;
  const std::shared_ptr<Scene> own = OwnScene(std::move(scene));
  // What is kept on disk of a scene is of the scene without bodies.
  own->cache_key.clear();
  std::vector<MeshId> meshes;
  for (const DroneBodySpec& body : bodies) {
    meshes.push_back(body.same_as ? meshes.at(*body.same_as) : AddMesh(body, *own));
    refs.push_back(AddBody(body, meshes.back(), *own));
  }
  return own;
}

std::shared_ptr<const SceneState> SceneStateOf(const SimModel& model, const SimState& state, size_t self) {
  return SceneStateAt(model, state, self, state);
}

NextTrigger InstantAfter(const SimModel& model, const SimState& now, size_t self, double seconds) {
  SimState then = now;
  const auto steps = std::llround(seconds * 1e9 / static_cast<double>(model.dt_ns));
  for (int64_t step = 0; step < steps; ++step) Step(model, {}, then);
  const RigidTransform X_WB = self < then.vehicles.size() ? then.vehicles[self].motion.X_WB : RigidTransform{};
  return {X_WB, SceneStateAt(model, then, self, now)};
}

std::shared_ptr<const RayTracer> WithoutBodies(const std::shared_ptr<const RayTracer>& base, std::span<const DroneBodyRef> bodies,
                                               const SimPeople* people, const SimTraffic* traffic) {
  const bool anybody = people != nullptr && !people->refs.empty();
  if (bodies.empty() && !anybody && traffic == nullptr) return base;
  auto state = std::make_shared<SceneState>();
  for (const DroneBodyRef& body : bodies) state->moved.push_back({body.instance, {}, true});
  if (anybody) HidePeople(people->refs, *state);
  if (traffic != nullptr) HideTraffic(*traffic, *state);
  std::ranges::sort(state->moved, {}, &MovedInstance::instance);
  return DynamicTracer(base).At(state);
}

}  // namespace airsim360
