#include "airsim360/sim/traffic/traffic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/scene/scene_additions.h"
#include "airsim360/sim/traffic/bicycle_parts.h"
#include "airsim360/sim/traffic/riders.h"
#include "airsim360/sim/traffic/vehicle_lamps.h"
#include "airsim360/traffic/bus_stops.h"
#include "airsim360/traffic/disc_grid.h"
#include "airsim360/traffic/parking.h"
#include "airsim360/traffic/pedalling.h"
#include "airsim360/worlds/props/bicycle.h"

namespace airsim360 {
namespace {

constexpr double kMaxWarmUp = 3600;  // seconds
constexpr size_t kMaxVehicles = 20000;
constexpr double kBicycles = 0.08;     // share of the vehicles, where a world has any
constexpr double kRiderHeight = 1.75;  // metres from the road to the top of the head
constexpr float kInLane = 0.5f;        // of the width of a lane: nearer to its middle one stands in it

// A vehicle of the scene that others can look like.
struct Pattern {
  MeshId mesh = 0;
  CategoryId category = kVoid;
  Vec3f tint, glow;
  float scale = 1;
  Box3f box;  // of the mesh
  bool in_lane = false;
  const BicycleMeasures* measures = nullptr;  // of a bicycle
};

bool IsVehicle(const Scene& scene, const Instance& instance) {
  if (instance.entity == kNoEntity) return false;
  const std::string& path = scene.tree[scene.entity(instance.entity).category].path;
  return std::ranges::any_of(std::array{"vehicle/car", "vehicle/van", "vehicle/bus", "vehicle/truck"},
                             [&](const char* kind) { return path.starts_with(kind); });
}

// Where one stands in a lane: discs along the middles of all.
DiscGrid LanesOf(const RoadNetwork& roads) {
  DiscGrid grid;
  for (const Lane& lane : roads.lanes) {
    for (size_t i = 1; i < lane.points.size(); ++i) {
      const Vec3d a = VecCast<double>(lane.points[i - 1]), step = VecCast<double>(lane.points[i]) - a;
      const int steps = std::max(1, static_cast<int>(std::ceil(Norm(step))));
      for (int k = 0; k < steps; ++k) grid.Add(a + step * (static_cast<double>(k) / steps), lane.width * kInLane);
    }
  }
  grid.Sort();
  return grid;
}

Box3f BoxOf(const Mesh& mesh) {
  Box3f box;
  for (const Vec3f& p : mesh.positions) box.Add(p);
  return box;
}

// Vehicles of the scene, and those of its instances that stand in lanes.
std::vector<Pattern> FindPatterns(const Scene& scene, std::vector<uint32_t>& standing) {
  constexpr double kHeight = 2.5;  // metres between lanes that cross above each other
  const DiscGrid lanes = LanesOf(*scene.roads);
  std::map<MeshId, Box3f> boxes;
  std::vector<Pattern> patterns;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!IsVehicle(scene, instance)) continue;
    const bool in_lane = lanes.Meets(VecCast<double>(instance.X_WM.p), 0, kHeight);
    if (in_lane) standing.push_back(i);
    const auto [box, fresh] = boxes.try_emplace(instance.mesh);
    if (fresh) box->second = BoxOf(scene.meshes[instance.mesh]);
    const Pattern pattern{instance.mesh, scene.entity(instance.entity).category, instance.tint,
                          instance.glow, Norm(instance.X_WM.A.column(2)),        box->second,
                          in_lane};
    if (pattern.box.empty()) continue;
    const Vec3f size = (pattern.box.max - pattern.box.min) * pattern.scale;
    if (size.y > 2.5f && size.y < 20 && size.x > 1.2f && size.x < 3.5f) patterns.push_back(pattern);
  }
  // Those in lanes have their lamps on at night.
  if (std::ranges::count(patterns, true, &Pattern::in_lane) >= 6) std::erase_if(patterns, [](const Pattern& p) { return !p.in_lane; });
  return patterns;
}

// Bicycles of the scene.
std::vector<Pattern> FindBicycles(const Scene& scene) {
  std::map<MeshId, Pattern> bicycles;
  for (const Instance& instance : scene.instances) {
    if (instance.entity == kNoEntity || bicycles.contains(instance.mesh)) continue;
    const CategoryId category = scene.entity(instance.entity).category;
    if (scene.tree[category].path != "vehicle/bicycle") continue;
    const Box3f box = BoxOf(scene.meshes[instance.mesh]);
    const float scale = Norm(instance.X_WM.A.column(2));
    const Vec3f size = box.empty() ? Vec3f{} : (box.max - box.min) * scale;
    if (size.y < 1.4f || size.y > 2.2f || size.x > 0.9f) continue;  // a rack, or one of many wheels
    const BicycleMeasures* known = internal::MeasuresOf(scene.meshes[instance.mesh]);
    bicycles[instance.mesh] = {instance.mesh, category, instance.tint, instance.glow,
                               scale,         box,      false,         known != nullptr ? known : kBicycleMeasures.data()};
  }
  std::vector<Pattern> patterns;
  for (const auto& [mesh, pattern] : bicycles) patterns.push_back(pattern);
  return patterns;
}

// Finds bays between parked cars where nothing else stands (of a plant the stem counts), and takes cars away where there are too few.
void AddBays(const Scene& scene, SimTraffic& traffic) {
  constexpr float kStem = 0.5f;           // metres
  constexpr size_t kVehiclesForABay = 6;  // of the traffic
  std::vector<bool> in_lane(scene.entities.size() + 1);
  for (const uint32_t instance : traffic.standing) in_lane[scene.instances[instance].entity] = true;
  std::vector<EntityId> parked;
  std::vector<Box3f> cars, others;
  for (const Entity& entity : scene.entities) {
    const std::string& path = scene.tree[entity.category].path;
    if (entity.bounds.empty() || in_lane[entity.id]) continue;
    const auto is = [&](const char* kind) { return path.starts_with(kind); };
    if (is("vehicle/car") || is("vehicle/van")) {
      parked.push_back(entity.id);
      cars.push_back(entity.bounds);
    } else if (is("vegetation")) {
      const Vec3f middle = entity.bounds.center(), half{kStem, kStem, entity.bounds.size().z / 2};
      others.push_back({middle - half, middle + half});
    } else if (!is("ground") && !is("sky") && !is("nature") && !is("construction")) {
      others.push_back(entity.bounds);
    }
  }
  TrafficModel& model = traffic.model;
  ParkingBays found = ParkingBaysBeside(model.lanes, cars, others, model.vehicles.size() / kVehiclesForABay, model.seed);
  model.bays = std::move(found.bays);
  std::vector<bool> away(scene.entities.size() + 1);
  for (const uint32_t car : found.away) away[parked[car]] = true;
  for (uint32_t i = 0; i < scene.instances.size(); ++i)
    if (scene.instances[i].entity != kNoEntity && away[scene.instances[i].entity]) traffic.standing.push_back(i);
}

// Shelters and signs of bus stops.
std::vector<Vec3d> BusStopPlaces(const Scene& scene) {
  std::vector<Vec3d> places;
  for (const Entity& entity : scene.entities) {
    if (entity.bounds.empty() || scene.tree[entity.category].path != "furniture/transit/bus_stop") continue;
    Vec3f foot = entity.bounds.center();
    foot.z = entity.bounds.min.z;
    places.push_back(VecCast<double>(foot));
  }
  return places;
}

Driver MakeDriver(RngStream& rng, bool heavy) {
  Driver driver;
  driver.speed_factor = std::clamp(1 + 0.08 * rng.Normal(), 0.8, 1.2);
  driver.headway = rng.Uniform(1.1, 1.8);
  driver.acceleration = heavy ? rng.Uniform(0.8, 1.0) : rng.Uniform(1.1, 1.7);
  driver.braking = rng.Uniform(1.7, 2.3);
  return driver;
}

std::string NameOf(size_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "traffic/%03zu", index);
  return name;
}

// The pose of its mesh: +Y of the mesh is backwards (PropKind).
AffineTransform PlaceOf(const TrafficBody& body, const RigidTransform& X_WB) {
  const Vec3f x = VecCast<float>(X_WB.R.column(0)), y = VecCast<float>(X_WB.R.column(1)), z = VecCast<float>(X_WB.R.column(2));
  const Mat3f A = Mat3f::FromColumns(y * body.scale, -x * body.scale, z * body.scale);
  return {A, VecCast<float>(X_WB.p) - A * body.offset_M};
}

// 14 to 20 km/h, chosen by us for mixed traffic: FHWA-RD-98-108 (1998) takes 25 km/h where bicycles have lanes of their own.
TrafficVehicle MakeCyclist(const Vec3f& size, float wheel_radius, RngStream& rng) {
  TrafficVehicle vehicle;
  vehicle.shape = {.length = size.y, .width = std::max(0.65f, size.x), .height = kRiderHeight, .bicycle = true};
  vehicle.shape.wheel_radius = wheel_radius;
  vehicle.driver = {.top_speed = rng.Uniform(4, 5.6), .headway = 1.2, .acceleration = rng.Uniform(0.6, 1.0), .braking = 2};
  return vehicle;
}

TrafficVehicle MakeVehicle(const Scene& scene, const Pattern& pattern, RngStream& rng) {
  const Vec3f size = (pattern.box.max - pattern.box.min) * pattern.scale;
  if (scene.tree[pattern.category].path == "vehicle/bicycle") return MakeCyclist(size, pattern.measures->wheel_radius * pattern.scale, rng);
  TrafficVehicle vehicle;
  vehicle.shape = {size.y, size.x, size.z, scene.tree[pattern.category].path.starts_with("vehicle/bus")};
  vehicle.driver = MakeDriver(rng, size.y > 6.5f);
  return vehicle;
}

// Metres a unit to a third of a percent, so that turned copies of one model, whose scale is told from their transforms, share lamps.
float LampScale(float scale) { return std::exp2(std::round(std::log2(scale) * 128) / 128); }

// Lit glasses and turning parts of the models, made once for each.
struct MadeOfMeshes {
  std::map<std::pair<MeshId, float>, internal::LampMeshes> lamps;  // by mesh and metres a unit
  std::map<MeshId, std::optional<internal::BicycleMeshes>> bicycles;
};

void AddBody(const Pattern& pattern, size_t index, const TrafficModel& model, const TrafficState& state, MadeOfMeshes& made, Scene& scene,
             TrafficBody& body) {
  body.name = NameOf(index);
  body.kind = scene.tree[pattern.category].path;
  body.scale = pattern.scale;
  const Vec3f middle = pattern.box.center();
  body.offset_M = {middle.x, middle.y, 0};
  body.instance = static_cast<uint32_t>(scene.instances.size());
  const AffineTransform X_WM = PlaceOf(body, PoseOf(model, state, index, state.t_ns));
  body.entity = AddInstanceEntity(scene, body.name, pattern.category, {pattern.mesh, X_WM, kNoEntity, pattern.tint, pattern.glow});
  const auto [of_mesh, fresh] = made.lamps.try_emplace({pattern.mesh, LampScale(pattern.scale)});
  if (fresh) of_mesh->second = internal::AddLampMeshes(pattern.mesh, of_mesh->first.second, scene);
  body.lamps = internal::AddLamps(of_mesh->second, body.entity, scene);
  if (!model.vehicles[index].shape.bicycle) return;

  // Its entity keeps the box of the whole.
  body.measures = pattern.measures;
  const auto [cut, new_bicycle] = made.bicycles.try_emplace(pattern.mesh);
  if (new_bicycle) cut->second = internal::AddBicycleMeshes(pattern.mesh, scene);
  if (!cut->second) return;
  scene.instances[body.instance].mesh = cut->second->frame;
  body.first_part = static_cast<uint32_t>(scene.instances.size());
  for (const MeshId part : cut->second->part) scene.instances.push_back({part, X_WM, body.entity, pattern.tint, pattern.glow});
}

// How a bicycle is at t_ns: its pose as it leans, its cranks.
struct BicycleNow {
  RigidTransform X_WB;
  Cycling cycling;
  double standing = 0;
};

BicycleNow BicycleAt(const TrafficModel& model, const TrafficState& state, size_t i, int64_t t_ns) {
  BicycleNow now{PoseOf(model, state, i, t_ns), CyclingOf(model, state, i, t_ns), internal::StandingAt(state.vehicles[i].v)};
  now.X_WB.R = now.X_WB.R * RotationX(-internal::LeanOf(now.standing));
  return now;
}

// Its parts, after its frame.
void ShowParts(const TrafficBody& body, const BicycleNow& now, const AffineTransform& X_WM, SceneState& scene_state) {
  if (body.first_part == 0) return;
  for (size_t k = 0; k < kBicycleParts; ++k) {
    const auto part = static_cast<BicyclePart>(k);
    const double pitch = internal::FootPitch(part == BicyclePart::kLeftPedal, now.cycling.crank);
    const AffineTransform X_MP = internal::PlaceOfPart(*body.measures, part, now.cycling, pitch);
    scene_state.moved.push_back({body.first_part + static_cast<uint32_t>(k), X_WM * X_MP, false});
  }
}

void ShowRiders(const SimTraffic& traffic, const std::vector<BicycleNow>& bicycles, SceneState& scene_state) {
  std::vector<SkeletonPose> poses(bicycles.size());
  std::vector<const SkeletonPose*> shown;
  size_t k = 0;
  for (const TrafficBody& body : traffic.bodies) {
    if (body.rider == kNoRider) continue;
    const BicycleNow& now = bicycles[k];
    const internal::Perch perch = internal::PerchOf(*body.measures, body.offset_M, body.scale);
    poses[k] = internal::RidingPose(*traffic.riders[k].body, perch, now.cycling.crank, now.standing);
    for (RigidTransform& X : poses[k].X_WJ) X = now.X_WB * X;
    poses[k].X_WP = now.X_WB;
    shown.push_back(&poses[k++]);
  }
  AppendPeople(traffic.riders, traffic.rider_refs, shown, {}, scene_state);
}

}  // namespace

TrafficScene AddTraffic(std::shared_ptr<const Scene> scene, const TrafficRequest& request, int64_t people_epoch_ns) {
  if (!(request.warm_up >= 0 && request.warm_up <= kMaxWarmUp))
    throw InputError("traffic: a warm-up of " + std::to_string(request.warm_up) + " s is not in 0 … 3600");
  if (!request.any()) return {std::move(scene), nullptr};
  if (request.count > kMaxVehicles)
    throw InputError("traffic: " + std::to_string(request.count) + " vehicles are not in 0 … " + std::to_string(kMaxVehicles));
  if (!scene->roads || scene->roads->lanes.empty()) throw InputError("traffic: the world '" + scene->name + "' has no roads to drive on");
  auto traffic = std::make_shared<SimTraffic>(TrafficModel{.lanes = LaneMap(scene->roads), .vehicles = {}, .seed = request.seed});
  const std::vector<Pattern> patterns = FindPatterns(*scene, traffic->standing);
  if (patterns.empty()) throw InputError("traffic: the world '" + scene->name + "' has no vehicles that others could look like");

  const std::vector<Pattern> bicycles = FindBicycles(*scene);
  std::vector<const Pattern*> chosen;
  for (size_t i = 0; i < request.count; ++i) {
    RngStream rng(request.seed, "traffic vehicle", i);
    chosen.push_back(&patterns[rng.Index(static_cast<uint32_t>(patterns.size()))]);
    if (RngStream rides(request.seed, "traffic bicycle", i); !bicycles.empty() && rides.Chance(kBicycles))
      chosen.back() = &bicycles[rides.Index(static_cast<uint32_t>(bicycles.size()))];
    traffic->model.vehicles.push_back(MakeVehicle(*scene, *chosen.back(), rng));
  }
  traffic->model.bus_stops = BusStopsBeside(traffic->model.lanes, BusStopPlaces(*scene));
  AddBays(*scene, *traffic);
  traffic->epoch_ns = std::llround(request.warm_up * 1e9) / kTrafficTickNs * kTrafficTickNs;
  traffic->model.signal_ns = people_epoch_ns - traffic->epoch_ns;
  auto start = std::make_shared<TrafficState>(StartTraffic(traffic->model));
  while (start->t_ns < traffic->epoch_ns) TickTraffic(traffic->model, {}, *start);

  std::shared_ptr<Scene> own = OwnScene(std::move(scene));
  own->cache_key.clear();  // what is kept on disk is of the scene without them
  traffic->bodies.resize(request.count);
  MadeOfMeshes made;
  for (size_t i = 0; i < request.count; ++i) AddBody(*chosen[i], i, traffic->model, *start, made, *own, traffic->bodies[i]);
  own = internal::AddRiders(std::move(own), *traffic);
  traffic->start = std::move(start);
  return {own, std::move(traffic)};
}

void ShowTraffic(const SimTraffic& traffic, const TrafficState& state, int64_t t_ns, SceneState& scene_state, const LampsAt& lamps) {
  const TrafficState& lit = lamps.state != nullptr ? *lamps.state : state;
  const int64_t lit_ns = lamps.state != nullptr ? lamps.t_ns : t_ns;
  for (const uint32_t instance : traffic.standing) scene_state.moved.push_back({instance, {}, true});
  std::vector<BicycleNow> bicycles;
  for (size_t i = 0; i < traffic.bodies.size(); ++i) {
    const TrafficBody& body = traffic.bodies[i];
    const bool rides = body.rider != kNoRider;
    if (rides) bicycles.push_back(BicycleAt(traffic.model, state, i, t_ns));
    const AffineTransform X_WM = PlaceOf(body, rides ? bicycles.back().X_WB : PoseOf(traffic.model, state, i, t_ns));
    scene_state.moved.push_back({body.instance, X_WM, false});
    const auto show = [&](uint32_t lamp, bool burns) {
      if (lamp != kNoLamp) scene_state.moved.push_back({lamp, X_WM, !burns});
    };
    const DrivingVehicle& vehicle = lit.vehicles[i];
    const bool blinks = vehicle.indicator != 0 && internal::BlinksAt(i, lit_ns);
    show(body.lamps.brake, vehicle.braking);
    show(body.lamps.left, blinks && vehicle.indicator > 0);
    show(body.lamps.right, blinks && vehicle.indicator < 0);
    if (rides) ShowParts(body, bicycles.back(), X_WM, scene_state);
  }
  ShowRiders(traffic, bicycles, scene_state);
}

std::shared_ptr<const TrafficState> TrafficLater(const SimTraffic& traffic, std::shared_ptr<const TrafficState> state, int64_t t_ns) {
  if (state->t_ns + kTrafficTickNs > t_ns) return state;
  auto later = std::make_shared<TrafficState>(*state);
  while (later->t_ns + kTrafficTickNs <= t_ns) TickTraffic(traffic.model, {}, *later);
  return later;
}

void HideTraffic(const SimTraffic& traffic, SceneState& scene_state) {
  for (const uint32_t instance : traffic.standing) scene_state.moved.push_back({instance, {}, true});
  for (const TrafficBody& body : traffic.bodies)
    for (const uint32_t instance : {body.instance, body.lamps.brake, body.lamps.left, body.lamps.right})
      if (instance != kNoLamp) scene_state.moved.push_back({instance, {}, true});
  for (const TrafficBody& body : traffic.bodies)
    for (uint32_t k = 0; body.first_part != 0 && k < kBicycleParts; ++k) scene_state.moved.push_back({body.first_part + k, {}, true});
  HidePeople(traffic.rider_refs, scene_state);
}

std::optional<size_t> VehicleOf(const SimTraffic& traffic, EntityId entity) {
  if (entity == kNoEntity) return std::nullopt;
  auto found = std::ranges::lower_bound(traffic.bodies, entity, {}, &TrafficBody::entity);
  if (found == traffic.bodies.end() || found->entity != entity)
    found = std::ranges::find(traffic.bodies, entity, &TrafficBody::rider_entity);
  if (found == traffic.bodies.end()) return std::nullopt;
  return static_cast<size_t>(found - traffic.bodies.begin());
}

const char* IndicatorName(const DrivingVehicle& vehicle) {
  return vehicle.indicator > 0 ? "left" : vehicle.indicator < 0 ? "right" : "off";
}

std::vector<VehicleBox> VehiclesNear(const SimTraffic& traffic, const TrafficState& state, int64_t t_ns, Vec3d p_W, double reach) {
  std::vector<VehicleBox> boxes;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const VehicleShape& shape = traffic.model.vehicles[i].shape;
    const DrivingVehicle& vehicle = state.vehicles[i];
    // Cheaper than its pose, and never nearer than the lane lets it be.
    const Vec3d front = traffic.model.lanes.At(vehicle.lane, vehicle.s).p;
    if (std::hypot(front.x - p_W.x, front.y - p_W.y) > reach + shape.length + 4) continue;
    RigidTransform X = PoseOf(traffic.model, state, i, t_ns);
    X.p = X.p + X.R.column(2) * (shape.height / 2);
    if (Norm(X.p - p_W) > reach + shape.length / 2) continue;
    boxes.push_back(
        {X, {shape.length / 2, shape.width / 2, shape.height / 2}, VelocityOf(traffic.model, state, i), traffic.bodies[i].entity});
  }
  return boxes;
}

}  // namespace airsim360
