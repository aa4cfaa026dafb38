// What calls change in a session, beyond commands to vehicles.
#include <algorithm>
#include <cstdio>
#include <set>

#include "airsim360/base/file_name.h"
#include "airsim360/base/printable.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/session/notice.h"
#include "airsim360/rpc/session/session.h"
#include "airsim360/rpc/session/start_place.h"
#include "airsim360/sim/en_route.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/step_drone.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

// Names of the engine's own cubes, which scripts for AirSim spawn; here both are the asset "Cube".
constexpr const char* kEngineCubes[] = {"1M_Cube", "1M_Cube_Chamfer"};

bool IsEngineCube(const std::string& asset) { return std::ranges::find(kEngineCubes, asset) != std::end(kEngineCubes); }

}  // namespace

void Session::ObjectsMoved() {
  auto scene_state = std::make_shared<SceneState>();
  scene_state->t_ns = loop_->state().t_ns;
  // Drones meet each other otherwise: their bodies are not there. Nor do people stand in the way of free space.
  std::set<EntityId> drones;
  for (const DroneBodyRef& body : extras_.drones) {
    drones.insert(body.entity);
    scene_state->moved.push_back({body.instance, {}, true});
  }
  if (loop_->model().people) HidePeople(loop_->model().people->refs, *scene_state);
  if (loop_->model().traffic) HideTraffic(*loop_->model().traffic, *scene_state);
  for (const auto& [entity, place] : world().places) {
    if (!drones.contains(entity)) objects_.Move(entity, place, scene_state->moved);
  }
  std::sort(scene_state->moved.begin(), scene_state->moved.end(),
            [](const MovedInstance& a, const MovedInstance& b) { return a.instance < b.instance; });
  auto model = std::make_shared<SimModel>(loop_->model());
  model->tracer = dynamic_tracer_.At(scene_state);
  loop_->SetModel(model);
  // Free space is measured anew.
  for (Vehicle& vehicle : state().vehicles) vehicle.contact.free_distance = 0;
}

void Session::GainsChanged(const VehicleControl& control) {
  const SimDrone& old = *loop_->model().drones[control.index()];
  DroneSetup setup = old.setup();
  setup.autopilot.simple_flight = control.gains;
  auto model = std::make_shared<SimModel>(loop_->model());
  model->drones[control.index()] = std::make_shared<const SimDrone>(setup, model->dt_ns);
  loop_->SetModel(model);
}

bool Session::AddVehicle(const std::string& name, const std::string& type, const RigidTransform& X_WB) {
  std::string lower = type;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr size_t kMostVehicles = 256;
  const char* why = HasVehicle(name) || name.empty()    ? "the name is empty or taken"
                    : lower != "simpleflight"           ? "there are vehicles of type SimpleFlight alone"
                    : controls_.size() >= kMostVehicles ? "256 vehicles are the most"
                    : loop_->model().drones.empty() && !controls_.empty()
                        ? "where all vehicles are of type ComputerVision there are no drones"
                        : nullptr;
  if (why != nullptr) {
    NoticeOnce("simAddVehicle: '" + name.substr(0, 100) + "' was not added: " + why);
    return false;
  }
  CheckFileName("vehicle_name", name);  // recordings name pictures after it
  CheckReach(X_WB.p, origin_W_);
  AddToModel(name, VehicleSettings{}, X_WB);
  NoticeBadStart(name, X_WB);
  return true;
}

void Session::NoticeBadStart(const std::string& name, const RigidTransform& X_WB) const {
  const double body = Norm(AirSimQuad().half_size_B), whole = body + Norm(AirSimQuad().rotors.front().p_B);
  const std::string fault = StartFault(*base_tracer_, X_WB.p, body);
  if (fault.empty()) return;
  const auto text = [&](Vec3d p_W) {
    const Vec3d p_N = NedFromWorld(p_W - origin_W_);
    char place[100];
    std::snprintf(place, sizeof place, "X %.2f, Y %.2f, Z %.2f", p_N.x, p_N.y, p_N.z);
    return std::string(place);
  };
  std::string notice = "vehicle '" + name.substr(0, 100) + "' starts " + fault + " at " + text(X_WB.p) + ": it will be pushed out or fall";
  const auto free = NearestStart(*base_tracer_, X_WB.p, whole);
  NoticeOnce(notice + (free ? "; the nearest free place found is " + text(*free) : std::string()));
}

std::vector<std::string> Session::AssetNames() const {
  std::vector<std::string> names;
  for (const SpawnStock& stock : extras_.stock) names.push_back(stock.asset);
  names.insert(names.end(), std::begin(kEngineCubes), std::end(kEngineCubes));
  return names;
}

std::string Session::Spawn(const std::string& name, const std::string& asset, const ObjectPlace& place) {
  constexpr size_t kLongestName = 200;
  const std::string& known = IsEngineCube(asset) ? "Cube" : asset;
  const auto stock = std::ranges::find(extras_.stock, known, &SpawnStock::asset);
  if (stock == extras_.stock.end())
    throw std::runtime_error("There were no assets with name " + Printable(asset) + " found in the Registry");
  if (name.empty() || name.size() > kLongestName) throw std::invalid_argument("object_name has 1 ... 200 bytes");
  const auto free = std::ranges::find_if(stock->copies, [&](const DroneBodyRef& copy) {
    const auto at = world().places.find(copy.entity);
    return at != world().places.end() && at->second.hidden;
  });
  if (free == stock->copies.end()) {
    throw std::runtime_error("All " + std::to_string(stock->copies.size()) + " objects of asset " + asset +
                             " are in the world already; destroy one first");
  }
  // Taken names get a number, as in AirSim.
  const auto taken = [&](const std::string& text) {
    const EntityId entity = objects_.Find(text, world().names);
    return entity != kNoEntity && entity != free->entity;
  };
  std::string given = name;
  for (int number = 2; taken(given) || HasVehicle(given); ++number) given = name + std::to_string(number);
  world().names[free->entity] = given;
  world().places[free->entity] = place;
  if (options_.settings.segmentation_init != "None")
    world().segmentation[free->entity] = static_cast<uint32_t>(DefaultSegmentationId(given));
  ObjectsMoved();
  return given;
}

void Session::CheckReach(Vec3d p_W, Vec3d origin_W) const {
  const Box3f& bounds = objects_.scene().bounds;
  const Vec3d margin{kWorldMargin, kWorldMargin, kWorldMargin};
  const Vec3d low = VecCast<double>(bounds.min) - margin, high = VecCast<double>(bounds.max) + margin;
  bool inside = true;
  for (int i = 0; i < 3; ++i) inside = inside && p_W[i] >= low[i] && p_W[i] <= high[i];
  if (inside) return;
  const Vec3d p_N = NedFromWorld(p_W - origin_W), a = NedFromWorld(low - origin_W), b = NedFromWorld(high - origin_W);
  char text[300];
  // North and east grow with the world's axes; down is turned round.
  std::snprintf(text, sizeof text,
                "position: (%.10g, %.10g, %.10g) is out of drones' reach, %g m around the world: (%.1f, %.1f, %.1f) to (%.1f, %.1f, %.1f)",
                p_N.x, p_N.y, p_N.z, kWorldMargin, a.x, a.y, b.z, b.x, b.y, a.z);
  throw std::invalid_argument(text);
}

void Session::Teleport(const VehicleControl& control, const RigidTransform& X_WB) {
  if (control.status().is_drone) CheckReach(X_WB.p, control.status().origin_W);
  Vehicle& moved = vehicle(control);
  moved.motion.X_WB = X_WB;
  moved.clearance = loop_->model().tracer->Clearance(VecCast<float>(X_WB.p), loop_->model().contact_range);
  if (!control.status().is_drone) return;
  moved.drone.p_WB = X_WB.p;
  moved.drone.q_WB = ToQuaternion(X_WB.R);
  moved.contact = {};
  moved.autopilot.has_reference = moved.autopilot.has_history = 0;
}

void Session::SampleSensors(size_t index) {
  constexpr int64_t kLongest = 1'000'000'000;  // no sensor is slower
  Vehicle& vehicle = state().vehicles[index];
  StepSensors(loop_->model().drones[index]->setup().sensors, loop_->model().world, static_cast<uint32_t>(index), MotionOf(vehicle),
              loop_->state().t_ns, kLongest, vehicle.sensors);
}

void Session::FlyMission(VehicleControl& control, std::shared_ptr<const Mission> mission) {
  std::shared_ptr<MissionPilot>& pilot = missions_[control.status().name];
  if (pilot) loop_->Detach(pilot.get());
  control.LetGo();
  pilot = std::make_shared<MissionPilot>(std::move(mission));
  loop_->Attach(pilot);
}

std::shared_ptr<const MissionPilot> Session::MissionOf(const VehicleControl& control) const {
  const auto found = missions_.find(control.status().name);
  return found == missions_.end() ? nullptr : found->second;
}

void Session::StopMission(const VehicleControl& control) {
  const auto found = missions_.find(control.status().name);
  if (found == missions_.end()) return;
  const bool flies = !found->second->done();
  loop_->Detach(found->second.get());
  missions_.erase(found);
  if (flies && IsEnRoute(vehicle(control))) loop_->Post({control.index(), FlightCommand{HoverCommand{}}});
}

void Session::Reset() {
  for (const auto& [name, pilot] : missions_) loop_->Detach(pilot.get());
  missions_.clear();
  for (const auto& control : controls_) {
    control->Reset(false);
    Vehicle& reset = vehicle(*control);
    const RigidTransform X_WB = {reset.motion.X_WB.R, control->status().origin_W};
    if (!control->status().is_drone) {
      Teleport(*control, StartPose(control->settings()));
      continue;
    }
    const uint64_t id = reset.command.id;
    const RigidTransform start = {loop_->model().drones[control->index()]->setup().X_WB.R, X_WB.p};
    reset = DroneAt(loop_->model(), loop_->state(), control->index(), start, false);
    reset.motion.X_WB = start;
    reset.drone.p_WB = start.p;
    reset.drone.q_WB = ToQuaternion(start.R);
    reset.command.id = id + 1;
    SampleSensors(control->index());
  }
  state().wind_W = loop_->model().wind.mean_W;
}

}  // namespace airsim360
