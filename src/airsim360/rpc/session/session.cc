#include "airsim360/rpc/session/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "airsim360/base/log.h"
#include "airsim360/base/printable.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/settings/time_of_day.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

// Steps between two looks at the jobs that wait: at most so much simulated time, so that answers come soon.
constexpr int64_t kSliceNs = 3'000'000;

// What AirSim calls PlayerStart: the ground below the scene's first viewpoint.
Vec3d FindOrigin(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  const Vec3f spawn = scene.spawn.value_or(scene.bounds.empty() ? Vec3f{} : scene.bounds.center());
  const auto below = tracer.Intersect(spawn, {0, 0, -1});
  return VecCast<double>(below ? spawn - Vec3f{0, 0, below->distance} : spawn);
}

uint64_t WallClockNs() {
  return static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count());
}

}  // namespace

std::string NoVehicleText(const std::string& name) {
  return "Vehicle API for '" + Printable(name.substr(0, 256)) +
         "' is not available. This could either because this is simulation-only API or this vehicle does not "
         "exist";
}

size_t Snapshot::Find(const std::string& name) const {
  if (name.empty() && !vehicles.empty()) return 0;
  for (size_t i = 0; i < vehicles.size(); ++i) {
    if (vehicles[i].name == name) return i;
  }
  throw std::runtime_error(NoVehicleText(name));
}

Session::Session(Stage& stage, SceneExtras extras, const SessionOptions& options)
    : options_(options),
      objects_(stage.shared_scene()),
      earth_(GeoPoint{options.settings.origin.latitude, options.settings.origin.longitude, options.settings.origin.altitude}),
      extras_(std::move(extras)),
      base_tracer_(stage.solid()),
      dynamic_tracer_(stage.tracer()),
      origin_W_(FindOrigin(*base_tracer_)),
      pacer_(options.lockstep, options.settings.clock_speed),
      recorder_(options.settings.recording) {
  auto world = std::make_shared<WorldView>();
  world->segmentation = InitialSegmentation(objects_.scene(), options_.settings.segmentation_init);
  // What is held ready is not there yet.
  for (const DroneBodyRef& body : stage.bodies()) world->places[body.entity] = {objects_.PlaceOf(body.entity).X_WO, {1, 1, 1}, true};
  world->external_cameras = MakeExternalCameras(options_.settings);
  world->base_environment = world->first_environment = stage.environment();
  SetTimeOfDay(options_.settings.time_of_day, options_.settings.origin, world->base_environment);
  world->environment = world->base_environment;
  // The stage is lit as its world is.
  if (!options_.settings.time_of_day.empty()) ++world->environment_version;
  world_ = std::move(world);
  BuildVehicles(stage);
  // Lockstep runs are the same every time: their clock starts at zero.
  auto first = std::make_shared<Snapshot>();
  first->epoch_ns = options_.lockstep ? 0 : WallClockNs();
  snapshot_ = first;
  Publish();
  thread_ = std::thread([this] { Run(); });
}

Session::~Session() {
  jobs_.Stop();
  thread_.join();
}

RigidTransform Session::StartPose(const VehicleSettings& settings) const {
  constexpr double kClearance = 0.02;  // above the ground that it then stands on, metres
  RigidTransform X = MountOf(settings.pose, {});
  // The file's place is in the global N frame.
  const Vec3d p_N = FrdFromBody(X.p);
  const airsim::Pose pose{airsim::ToVector(p_N), airsim::ToQuaternionr(FrdRotation(X.R))};
  RigidTransform X_WB = airsim::FromPose(pose, origin_W_);
  X_WB.p.z += AirSimQuad().half_size_B.z + kClearance;
  return X_WB;
}

void Session::AddToModel(const std::string& name, const VehicleSettings& settings, const RigidTransform& X_WB) {
  const bool is_drone = settings.type != "ComputerVision";
  auto model = std::make_shared<SimModel>(loop_->model());
  // Drones come before all others in the simulation.
  const size_t index = is_drone ? loop_->model().drones.size() : loop_->state().vehicles.size();
  MakeRoomAt(index);
  const auto place = static_cast<std::ptrdiff_t>(index);
  RigidTransform start = X_WB;
  if (is_drone) {
    DroneSetup setup = MakeDroneSetup(name, options_.settings, settings, {}, X_WB);
    if (index < extras_.drones.size()) {
      const DroneBodyRef& body = extras_.drones[index];
      setup.instance = body.instance;
      setup.entity = body.entity;
      // From now on it is where the simulation has it.
      world().places.erase(body.entity);
      world().names[body.entity] = name;
      if (options_.settings.segmentation_init != "None")
        world().segmentation[body.entity] = static_cast<uint32_t>(DefaultSegmentationId(name));
    } else {
      LogWarning("vehicle '" + name + "' is not seen by others: " + std::to_string(extras_.drones.size()) + " drones have bodies");
    }
    model->drones.push_back(std::make_shared<const SimDrone>(std::move(setup), model->dt_ns));
    loop_->SetModel(model);
    // Where the file gives a height it starts there, in free fall as in AirSim; else on the ground.
    const bool on_ground = std::isnan(settings.pose.z) || settings.pose.z >= 0;
    Vehicle vehicle = DroneAt(loop_->model(), loop_->state(), index, X_WB, false);
    if (!on_ground) vehicle.motion.X_WB = vehicle.drone.p_WB.z < X_WB.p.z ? X_WB : vehicle.motion.X_WB;
    vehicle.drone.p_WB = vehicle.motion.X_WB.p;
    start = vehicle.motion.X_WB;
    state().vehicles.insert(state().vehicles.begin() + place, vehicle);
    SampleSensors(index);
  } else {
    state().vehicles.push_back(VehicleAt(loop_->model(), X_WB));
  }
  controls_.insert(controls_.begin() + place, std::make_unique<VehicleControl>(index, name, settings, is_drone, start.p));
  world().cameras.insert(world().cameras.begin() + place, MakeCameras(options_.settings, settings));
  world().ray_sensors.insert(world().ray_sensors.begin() + place, MakeRaySensors(options_.settings, settings));
}

// Vehicles from `index` on are one further back.
void Session::MakeRoomAt(size_t index) {
  if (index == controls_.size()) return;
  for (size_t i = index; i < controls_.size(); ++i) controls_[i]->MoveUp();
  decltype(WorldView::detection) detection;
  for (auto& [key, filter] : world().detection) detection[{key.first + (key.first >= index ? 1 : 0), key.second}] = std::move(filter);
  world().detection = std::move(detection);
}

void Session::BuildVehicles(Stage& stage) {
  auto model = std::make_shared<SimModel>(stage.Model(kPhysicsStepNs));
  model->world.frame = earth_;
  // The wind of the settings is that of simSetWind; a wind file says more.
  if (const Vec3d wind_W = NedFromWorld(airsim::FromVector(options_.settings.wind)); Norm(wind_W) > 0) model->wind.mean_W = wind_W;
  SimState start;
  start.wind_W = model->wind.mean_W;
  StartLife(*model, start);
  loop_ = std::make_unique<SimLoop>(model, std::move(start));
  // Drones come first in the simulation, in the order of their names as AirSim has them.
  for (const bool drones : {true, false}) {
    for (const auto& [name, settings] : options_.settings.vehicles) {
      if (!settings.auto_create || (settings.type != "ComputerVision") != drones) continue;
      const RigidTransform start = StartPose(settings);
      AddToModel(name, settings, start);
      if (drones) NoticeBadStart(name, start);
    }
  }
}

void Session::Post(Job job) { jobs_.Post(std::move(job)); }

SnapshotPointer Session::snapshot() const {
  const std::lock_guard lock(snapshot_mutex_);
  return snapshot_;
}

WorldView& Session::world() {
  if (!new_world_) new_world_ = std::make_shared<WorldView>(*world_);
  return *new_world_;
}

void Session::Publish() {
  if (new_world_) world_ = std::move(new_world_);
  new_world_.reset();
  auto next = std::make_shared<Snapshot>();
  next->state = loop_->state();
  next->model = loop_->shared_model();
  next->world = world_;
  next->near_misses = near_misses_;
  next->paused = pacer_.paused();
  next->epoch_ns = snapshot_->epoch_ns;
  next->real_time_factor = pacer_.real_time_factor();
  for (const auto& control : controls_) next->vehicles.push_back(control->status());
  const std::lock_guard lock(snapshot_mutex_);
  snapshot_ = std::move(next);
}

bool Session::RunJobs() {
  const std::vector<Job> jobs = jobs_.TakeAll();
  for (const Job& job : jobs) {
    const std::function<void()> answer = job(*this);
    Publish();
    if (answer) answer();
  }
  return !jobs.empty();
}

void Session::StepOnce() {
  if (loop_->state().t_ns % kControlStepNs == 0) {
    for (const auto& control : controls_) {
      if (!control->status().is_drone) continue;
      if (auto command = control->Plan(loop_->state().vehicles[control->index()], loop_->state().t_ns)) {
        loop_->Post({control->index(), std::move(*command)});
      }
    }
  }
  // Nobody is told of events: calls ask for what they want to know.
  loop_->AdvanceWhile(1, [&](const SimState&, std::span<const SimEvent> happened) {
    NoteNearMisses(happened);
    return true;
  });
  for (const auto& control : controls_) {
    if (control->status().is_drone) control->Observe(AirSimQuad(), loop_->state().vehicles[control->index()]);
  }
}

void Session::NoteNearMisses(std::span<const SimEvent> happened) {
  for (const SimEvent& event : happened) {
    if (event.kind != SimEvent::Kind::kNearMiss) continue;
    // Snapshots keep the list that they have.
    auto longer = near_misses_ ? std::make_shared<std::vector<NearMiss>>(*near_misses_) : std::make_shared<std::vector<NearMiss>>();
    if (longer->size() >= kMostNearMisses) longer->erase(longer->begin());
    longer->push_back(event.near_miss);
    near_misses_ = std::move(longer);
  }
}

void Session::Run() {
  while (!jobs_.stopped()) {
    RunJobs();
    const int64_t due = std::min(pacer_.Due(loop_->state().t_ns), loop_->state().t_ns + kSliceNs);
    bool stepped = false;
    for (; loop_->state().t_ns + loop_->model().dt_ns <= due; stepped = true) StepOnce();
    const std::vector<Reply> reached = pacer_.Reached(loop_->state().t_ns);
    if (stepped || !reached.empty()) {
      Publish();
      for (const Reply& reply : reached) reply.Nil();
      recorder_.Observe(snapshot());
      continue;
    }
    // In small slices: answers to questions about the state need not be newer than that.
    jobs_.WaitUntil(pacer_.NextDue(loop_->state().t_ns, kSliceNs));
  }
  for (const auto& control : controls_) control->Cancel();
}

bool Session::HasVehicle(const std::string& name) const {
  return std::any_of(controls_.begin(), controls_.end(), [&](const auto& control) { return control->status().name == name; });
}

VehicleControl& Session::control(const std::string& name) {
  if (name.empty() && !controls_.empty()) return *controls_.front();
  for (const auto& control : controls_) {
    if (control->status().name == name) return *control;
  }
  throw std::runtime_error(NoVehicleText(name));
}

VehicleControl& Session::drone(const std::string& name) {
  VehicleControl& found = control(name);
  if (!found.status().is_drone) throw std::runtime_error(NoVehicleText(name));
  return found;
}

}  // namespace airsim360
