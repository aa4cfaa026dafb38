// A world opened once, with everything that a command, a server, a script or an agent needs of it. Nothing
// else in the program loads a world, peoples it, builds its ray tracing structure or makes its renderers.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "airsim360/opening/world_environment.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/vulkan/choose_renderer.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/step.h"
#include "airsim360/sim/traffic/traffic_request.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Bodies to be added to a scene that is known by now.
using BodiesOfScene = std::function<std::vector<DroneBodySpec>(const Scene& scene)>;

/// What a stage is made of. Every front door fills in all of it, or refuses by name what it cannot offer.
struct StageOptions {
  WorldRequest world = {};            ///< its seed is also that of the simulation
  EnvironmentFlags environment = {};  ///< over the world's own
  PeopleRequest people = {};          ///< nobody unless it asks for some; the seed of the crowd is its own
  TrafficRequest traffic = {};        ///< no vehicles drive unless it asks for some
  WorldWind wind = {};
  DeviceChoice device = {};
  BodiesOfScene bodies = {};  ///< of drones, and of what is held ready to be put into the world
};

/// InputError for what is wrong whatever the world: before one is loaded.
void CheckStageOptions(const StageOptions& options);

/// Constant from the outside; the tracer and the renderers are made when they are first asked for. Thread-safe,
/// but for the renderers: each draws for one thread at a time.
class Stage {
 public:
  /// Loads the world. A line of progress every few seconds. InputError for a world, an environment or people
  /// that make no sense.
  explicit Stage(const StageOptions& options);
  /// Of a scene that is there already; of `options.world` the name and the seed count.
  Stage(std::shared_ptr<const Scene> scene, const StageOptions& options = {});
  /// The world of `base` with a crowd and bodies more. What stays the same is shared, but for
  /// renderers.
  Stage(const std::shared_ptr<Stage>& base, const PeopleRequest& people, const BodiesOfScene& bodies = {});
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const std::string& name() const { return options_.world.world; }
  uint64_t seed() const { return options_.world.seed; }
  /// With people (hidden) and bodies, after everything that the world has: ids of the rest stay.
  const Scene& scene() const { return *scene_; }
  const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  const Environment& environment() const { return environment_; }
  const std::shared_ptr<const SimPeople>& people() const { return people_; }     ///< null: nobody
  const std::shared_ptr<const SimTraffic>& traffic() const { return traffic_; }  ///< null: no vehicles drive
  const std::vector<DroneBodyRef>& bodies() const { return bodies_; }
  const DeviceChoice& device() const { return options_.device; }
  double load_seconds() const;  ///< what loading, people, ray tracing structures and renderers have taken so far

  /// What cameras see: the scene as built.
  std::shared_ptr<const RayTracer> tracer();
  /// What vehicles touch: without bodies and people.
  std::shared_ptr<const RayTracer> solid();

  /// Kept. On a GPU one renderer draws all tiers. RuntimeError where the device cannot be had.
  Renderer& renderer(Tier tier);
  /// Another one, of the caller's own, and under another sky.
  std::unique_ptr<Renderer> NewRenderer(Tier tier);
  std::unique_ptr<Renderer> NewRenderer(Tier tier, const Environment& environment);

  /// A simulation of it, with its people, wind and seed, and without drones.
  SimModel Model(int64_t dt_ns = SimModel{}.dt_ns);
  /// What people and traffic make of the scene at the beginning, for pictures without a simulation; null: neither.
  std::shared_ptr<const SceneState> StartState();

 private:
  void Add(const PeopleRequest& people, const TrafficRequest& traffic, const BodiesOfScene& bodies);

  StageOptions options_;
  std::shared_ptr<Stage> base_;  // whose ray tracing structure is this one's, where nothing was added
  std::shared_ptr<const Scene> scene_;
  Environment environment_;
  std::shared_ptr<const SimPeople> people_;
  std::shared_ptr<const SimTraffic> traffic_;
  std::vector<DroneBodyRef> bodies_;

  mutable std::mutex mutex_;  // of what follows
  double load_seconds_ = 0;
  std::shared_ptr<const RayTracer> tracer_, solid_;
  std::shared_ptr<const SceneState> start_state_;
  std::map<Tier, std::unique_ptr<Renderer>> renderers_;
};

}  // namespace airsim360
