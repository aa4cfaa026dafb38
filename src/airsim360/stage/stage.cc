#include "airsim360/stage/stage.h"

#include "airsim360/base/error.h"
#include "airsim360/base/freed_memory.h"
#include "airsim360/base/log.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

// The world's own with what the flags say; clouds that nobody chose are those of the world.
Environment EnvironmentOf(const Scene& scene, const StageOptions& options) {
  Environment environment = ApplyFlags(options.environment, scene.environment);
  if (environment.sky_seed == 0) environment.sky_seed = scene.environment.sky_seed;
  if (environment.sky_seed == 0) environment.sky_seed = SkySeedOf(scene.name, options.world.seed);
  return environment;
}

}  // namespace

void CheckStageOptions(const StageOptions& options) {
  CheckDevice("--device", options.device.device);
  if (options.device.gpu >= 0 && options.device.device == "cpu") throw InputError("--gpu: --device cpu uses no GPU; leave one of them out");
  ApplyFlags(options.environment, {});
}

Stage::Stage(const StageOptions& options) : options_(options) {
  CheckStageOptions(options);
  const LongTask building("building " + options.world.world);
  scene_ = LoadWorld(options.world);
  environment_ = EnvironmentOf(*scene_, options);
  Add(options.people, options.traffic, options.bodies);
  load_seconds_ = building.seconds();
}

Stage::Stage(std::shared_ptr<const Scene> scene, const StageOptions& options) : options_(options), scene_(std::move(scene)) {
  CheckStageOptions(options);
  environment_ = EnvironmentOf(*scene_, options);
  Add(options.people, options.traffic, options.bodies);
}

Stage::Stage(const std::shared_ptr<Stage>& base, const PeopleRequest& people, const BodiesOfScene& bodies)
    : options_(base->options_),
      scene_(base->scene_),
      environment_(base->environment_),
      people_(base->people_),
      traffic_(base->traffic_),
      bodies_(base->bodies_) {
  if (people.any() && people_) throw InputError("people: the world '" + name() + "' has people already");
  Add(people, {}, bodies);
  if (scene_ == base->scene_) base_ = base;
}

void Stage::Add(const PeopleRequest& people, const TrafficRequest& traffic, const BodiesOfScene& bodies) {
  if (people.any()) {
    PopulatedScene populated = Populate(std::move(scene_), people);
    scene_ = std::move(populated.scene);
    people_ = std::move(populated.people);
  }
  if (traffic.any()) {
    TrafficScene driven = AddTraffic(std::move(scene_), traffic, people_ ? people_->epoch_ns : 0);
    scene_ = std::move(driven.scene);
    traffic_ = std::move(driven.traffic);
  }
  if (!bodies) return;
  const std::vector<DroneBodySpec> specs = bodies(*scene_);
  if (specs.empty()) return;
  std::vector<DroneBodyRef> refs;
  scene_ = AddDroneBodies(std::move(scene_), specs, refs);
  bodies_.insert(bodies_.end(), refs.begin(), refs.end());
}

double Stage::load_seconds() const {
  const std::lock_guard lock(mutex_);
  return load_seconds_;
}

std::shared_ptr<const RayTracer> Stage::tracer() {
  if (base_) return base_->tracer();
  const std::lock_guard lock(mutex_);
  if (tracer_) return tracer_;
  const LongTask building("building " + name());
  tracer_ = std::make_shared<const RayTracer>(scene_);
  load_seconds_ += building.seconds();
  return tracer_;
}

std::shared_ptr<const RayTracer> Stage::solid() {
  if (base_) return base_->solid();
  const auto seen = tracer();
  const std::lock_guard lock(mutex_);
  if (!solid_) solid_ = WithoutBodies(seen, bodies_, people_.get(), traffic_.get());
  return solid_;
}

Renderer& Stage::renderer(Tier tier) {
  const auto seen = tracer();
  const std::lock_guard lock(mutex_);
  // What one renderer on a GPU draws need not be there twice.
  std::unique_ptr<Renderer>& renderer = renderers_[device().device == "cpu" ? tier : Tier::kLabels];
  if (renderer) return *renderer;
  const LongTask building("building " + name());
  renderer = MakeRenderer(seen, {.tier = tier, .environment = environment_}, device());
  ReturnFreedMemory();
  load_seconds_ += building.seconds();
  return *renderer;
}

std::unique_ptr<Renderer> Stage::NewRenderer(Tier tier) { return NewRenderer(tier, environment_); }

std::unique_ptr<Renderer> Stage::NewRenderer(Tier tier, const Environment& environment) {
  return MakeRenderer(tracer(), {.tier = tier, .environment = environment}, device());
}

SimModel Stage::Model(int64_t dt_ns) {
  SimModel model{.tracer = solid(), .dt_ns = dt_ns};
  model.world.seed = seed();
  model.wind = options_.wind;
  model.people = people_;
  model.traffic = traffic_;
  return model;
}

std::shared_ptr<const SceneState> Stage::StartState() {
  if (!people_ && !traffic_) return nullptr;
  const SimModel model = Model();
  const std::lock_guard lock(mutex_);
  if (!start_state_) start_state_ = SceneStateOf(model, airsim360::StartState(model), kNobody);
  return start_state_;
}

}  // namespace airsim360
