// The simulation: drones in a world, commands, steps, snapshots, captures.
#include "simulation.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/sim/trajectory_reference.h"
#include "airsim360/sim/wind_limit.h"

namespace airsim360::python {
namespace {

constexpr double kSpacing = 2;  // metres between drones whose place is not given

std::vector<Drone> ToDrones(const py::object& drones) {
  if (py::isinstance<py::int_>(drones)) {
    const auto count = drones.cast<int64_t>();
    if (count < 0 || count > 10000) throw InputError("drones: " + std::to_string(count) + " is not in 0 ... 10000");
    return std::vector<Drone>(static_cast<size_t>(count), count > 0 ? MakeDrone("hummingbird") : Drone{});
  }
  if (py::isinstance<py::str>(drones) || py::isinstance<Drone>(drones)) return {ToDrone(drones)};
  if (!py::isinstance<py::sequence>(drones)) throw InputError("drones: give a number, a drone, or a list of drones");
  std::vector<Drone> list;
  for (const py::handle& drone : drones) list.push_back(ToDrone(drone));
  return list;
}

// Side by side around the spawn, in a square, unless a place is given.
RigidTransform StartOf(const Drone& drone, size_t i, size_t count, const Scene& scene) {
  if (drone.p_WB) return BodyPose(*drone.p_WB, drone.yaw, 0, 0);
  const auto columns = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const auto half = 0.5 * static_cast<double>(columns - 1);
  const Vec3d spawn = VecCast<double>(FirstViewpoint(scene));
  const Vec3d offset{static_cast<double>(i % columns) - half, static_cast<double>(i / columns) - half, 0};
  return BodyPose(spawn + kSpacing * offset, drone.yaw != 0 ? drone.yaw : scene.spawn_yaw_deg * M_PI / 180, 0, 0);
}

}  // namespace

Simulation::Simulation(std::shared_ptr<World> world, const py::object& drones, const py::object& people, const py::object& given_seed,
                       double dt, const py::object& wind)
    : world_(std::move(world)) {
  const uint64_t seed = ToSeed(given_seed);
  const PeopleRequest crowd = PeopleOf(ToWhole(people, "people", 0, kMostPeople), seed);
  if (!(dt >= 1e-5 && dt <= 0.1)) throw InputError("dt: " + std::to_string(dt) + " s is not in 0.00001 ... 0.1");
  const std::vector<Drone> list = ToDrones(drones);
  const std::optional<Vec3d> mean_wind = wind.is_none() ? std::nullopt : std::optional(ToVec3(wind, "wind"));
  CheckWind(mean_wind.value_or(Vec3d{}));
  std::vector<DroneSetup> setups;
  for (size_t i = 0; i < list.size(); ++i) {
    const Drone& drone = list[i];
    DroneSetup setup{.name = drone.name.empty() ? "drone" + std::to_string(i) : drone.name, .model = drone.model};
    setup.autopilot.controller = drone.controller;
    if (drone.sensors) setup.sensors = *drone.sensors;
    setup.X_WB = StartOf(drone, i, list.size(), world_->scene());
    setup.airborne = drone.airborne;
    for (const DroneSetup& other : setups) {
      if (other.name == setup.name) throw InputError("drones: the name '" + setup.name + "' is given twice");
    }
    setups.push_back(std::move(setup));
  }
  const py::gil_scoped_release release;
  Build(std::move(setups), crowd, seed, dt, mean_wind);
}

void Simulation::Build(std::vector<DroneSetup> setups, const PeopleRequest& people, uint64_t seed, double dt,
                       const std::optional<Vec3d>& wind) {
  // One drone never sees itself; several need bodies.
  std::vector<DroneBodySpec> bodies;
  for (size_t i = 0; setups.size() > 1 && i < setups.size(); ++i) {
    DroneBodySpec& body = bodies.emplace_back();
    body.name = setups[i].name;
    body.model = DroneBodyModel(setups[i].model);
    body.X_WB = setups[i].X_WB;
  }
  stage_ = std::make_shared<Stage>(world_->stage(), people, [&](const Scene&) { return bodies; });
  for (size_t i = 0; i < bodies.size(); ++i) {
    setups[i].instance = stage_->bodies()[i].instance;
    setups[i].entity = stage_->bodies()[i].entity;
  }
  SimModel model = stage_->Model(std::llround(dt * 1e9));
  model.world.seed = seed;
  if (wind) model.wind.mean_W = *wind;
  for (DroneSetup& setup : setups) {
    names_.push_back(setup.name);
    model.drones.push_back(std::make_shared<const SimDrone>(std::move(setup), model.dt_ns));
  }
  model_ = std::make_shared<const SimModel>(std::move(model));
  loop_ = std::make_unique<SimLoop>(model_);
}

size_t Simulation::Find(const py::object& drone) const {
  if (py::isinstance<py::str>(drone)) {
    const auto name = drone.cast<std::string>();
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) throw InputError(UnknownChoiceMessage("drone", name, names_));
    return static_cast<size_t>(found - names_.begin());
  }
  const auto i = drone.cast<int64_t>();
  if (i < 0 || i >= static_cast<int64_t>(names_.size()))
    throw InputError("drone " + std::to_string(i) + " of " + std::to_string(names_.size()) + " (from 0)");
  return static_cast<size_t>(i);
}

void Simulation::Post(const py::object& drone, Command command, double timeout) {
  const size_t i = Find(drone);
  if (!(timeout >= 0 && timeout < 1e9)) throw InputError("timeout: " + std::to_string(timeout) + " s is not 0 (none) or more");
  // What the drone cannot fly is told here and not by an event later.
  const std::string problem = CommandProblem(command, model_->drones[i]->model());
  if (!problem.empty()) throw InputError(problem);
  loop_->Post({i, FlightCommand{std::move(command), std::llround(timeout * 1e9)}});
}

void Simulation::CaptureLocked(const Rig& given, size_t i, const EntityLabels* labels, Renderer& renderer, Capture& capture,
                               std::shared_ptr<const SimState> state) {
  if (!state) state = loop_->Snapshot();
  PanoramicRig rig = Rendered(given, labels);
  rig.state = SceneStateOf(*model_, *state, i);
  NextTrigger next;
  if (rig.products.flow) next = InstantAfter(*model_, *state, i, given.flow_dt);
  CaptureRig(rig, state->vehicles[i].motion, state->t_ns, renderer, capture, rig.products.flow ? &next : nullptr);
}

std::shared_ptr<Capture> Simulation::TakeAt(const Rig& rig, size_t i, std::shared_ptr<const SimState> state) {
  auto capture = std::make_shared<Capture>();
  const std::lock_guard lock(render_mutex_);
  const auto labels = world_->labels();
  CaptureLocked(rig, i, labels.get(), stage_->renderer(rig.rig.tier), *capture, std::move(state));
  FinishCapture(rig, scene(), labels.get(), *capture);
  return capture;
}

std::shared_ptr<CudaCapture> Simulation::TakeCuda(const Rig& rig, size_t i) {
  const DeviceChoice& device = stage_->device();
  if (device.device == "cpu") throw InputError("memory: 'cuda' needs a GPU that renders: World(…, device=\"vulkan\")");
  if (rig.rig.lens != LensModel::kIdeal) throw InputError("memory: the lens real360 is made on the CPU; use memory=\"cpu\"");
  if (world_->labels() && rig.rig.products.semantic)
    throw InputError("memory: the labels of World.relabel are put in on the CPU; use memory=\"cpu\"");
  for (const char* product : {"part", "sky"}) {
    if (std::ranges::count(NamesOf(rig.shown), product) > 0)
      throw InputError("memory: the product '" + std::string(product) + "' is made on the CPU; use memory=\"cpu\"");
  }
  auto capture = std::make_shared<CudaCapture>();
  const std::lock_guard lock(render_mutex_);
  if (!cuda_)
    cuda_ = std::make_unique<CudaRenderer>(stage_->tracer(), RendererOptions{.tier = rig.rig.tier, .environment = stage_->environment()},
                                           GpuOptions{.gpu = device.gpu});
  CaptureLocked(rig, i, nullptr, *cuda_, *capture);
  capture->pictures = cuda_->Take();
  return capture;
}

SnapshotSensors& Simulation::SensorsLocked() {
  if (!sensors_) sensors_ = std::make_unique<SnapshotSensors>(model_, stage_->tracer());
  return *sensors_;
}

std::shared_ptr<LidarScan> Simulation::Scan(const Lidar& lidar, size_t i) {
  const std::shared_ptr<const SimState> state = loop_->Snapshot();
  const SensorKey key = KeyOf(model_->world, static_cast<uint32_t>(i), "python lidar", 0);
  auto scan = std::make_shared<LidarScan>();
  const std::lock_guard lock(render_mutex_);
  ScanLidar(lidar.spec, key, *SensorsLocked().TracerOf(*state, i), state->vehicles[i].motion, lidar.X_BS, state->t_ns, *scan);
  FinishScan(world_->labels().get(), *scan);
  return scan;
}

std::shared_ptr<LidarScan> Simulation::Scan(const std::string& lidar, size_t i) {
  const size_t number = FindSensor("lidar", lidar, model_->drones[i]->setup().sensors.lidars);
  const std::shared_ptr<const SimState> state = loop_->Snapshot();
  auto scan = std::make_shared<LidarScan>();
  const std::lock_guard lock(render_mutex_);
  SensorsLocked().Lidar(*state, i, number, *scan);
  FinishScan(world_->labels().get(), *scan);
  return scan;
}

py::list Simulation::Events() {
  py::list list;
  for (const SimEvent& event : loop_->TakeEvents()) {
    py::dict d;
    d["event"] = kSimEventNames[static_cast<size_t>(event.kind)];
    d["drone"] = event.vehicle == kNoDrone ? py::object(py::none()) : py::int_(event.vehicle);
    d["t_ns"] = event.t_ns;
    if (event.collision.count > 0) {
      d["entity"] = event.collision.entity;
      d["point"] = FromVec3(event.collision.p_W);
      d["normal"] = FromVec3(event.collision.normal_W);
      d["impact_speed"] = event.collision.impact_speed;
    }
    if (event.kind == SimEvent::Kind::kNearMiss) {
      d["first"] = NameOfRoadUser(*model_, event.near_miss.a);
      d["second"] = NameOfRoadUser(*model_, event.near_miss.b);
      d["time_to_collision"] = event.near_miss.seconds;
      d["braking"] = event.near_miss.braking;
      d["point"] = FromVec3(event.near_miss.p);
    }
    if (!event.text.empty()) d["text"] = event.text;
    list.append(std::move(d));
  }
  return list;
}

py::list Simulation::People() const {
  py::list list;
  const std::shared_ptr<const SimState> state = loop_->Snapshot();
  if (!model_->people || !state->people) return list;
  const PeoplePoses poses = PosesAt(*model_->people, *state->people, state->t_ns + model_->people->epoch_ns);
  for (size_t i = 0; i < poses.states.size(); ++i) {
    const PersonState& person = poses.states[i];
    py::dict d;
    d["entity"] = i < model_->people->refs.size() ? model_->people->refs[i].entity : kNoEntity;
    d["position"] = FromVec3(person.p_WP);
    d["velocity"] = FromVec3(person.v_WP);
    d["yaw"] = person.yaw;
    d["behaviour"] = BehaviourName(person.upper);
    d["locomotion"] = BehaviourName(person.lower);
    d["group_id"] = person.group;
    d["visible"] = person.visible;
    list.append(std::move(d));
  }
  return list;
}

py::list Simulation::Vehicles() const {
  py::list list;
  const std::shared_ptr<const SimState> state = loop_->Snapshot();
  if (!model_->traffic || !state->traffic) return list;
  const SimTraffic& traffic = *model_->traffic;
  for (size_t i = 0; i < traffic.bodies.size(); ++i) {
    const DrivingVehicle& vehicle = state->traffic->vehicles[i];
    const VehicleShape& shape = traffic.model.vehicles[i].shape;
    const RigidTransform X_WB = PoseOf(traffic.model, *state->traffic, i, state->t_ns + traffic.epoch_ns);
    py::dict d;
    d["entity"] = traffic.bodies[i].entity;
    d["name"] = traffic.bodies[i].name;
    d["category"] = traffic.bodies[i].kind;
    d["position"] = FromVec3(X_WB.p);
    d["orientation"] = FromQuaternion(ToQuaternion(X_WB.R));
    d["velocity"] = FromVec3(VelocityOf(traffic.model, *state->traffic, i));
    d["size"] = FromVec3({shape.length, shape.width, shape.height});
    d["track_id"] = i + 1;
    d["lane"] = vehicle.lane;
    d["lane_position"] = vehicle.s;
    d["indicator"] = IndicatorName(vehicle);
    d["braking"] = vehicle.braking;
    d["stopped"] = vehicle.stopped_ns >= 0;
    list.append(std::move(d));
  }
  return list;
}

}  // namespace airsim360::python
