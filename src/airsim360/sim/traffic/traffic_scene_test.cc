#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "airsim360/base/error.h"
#include "airsim360/scene/luminance.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/sim/traffic_survey.h"
#include "airsim360/traffic/test_roads.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360 {
namespace {

// A ring road of 600 m with a car that stands on it and one that is parked elsewhere; cars look towards -Y of their mesh.
std::shared_ptr<const Scene> RingScene(bool with_roads = true, bool with_cars = true) {
  SceneBuilder builder("ring");
  builder.AddSky();
  builder.AddMaterial({});
  Mesh car;
  for (const float x : {-0.9f, 0.9f})
    for (const float y : {-2.2f, 2.2f})
      for (const float z : {0.0f, 1.5f}) car.positions.push_back({x, y, z});
  car.normals.assign(8, {0, 0, 1});
  car.uvs.assign(8, {});
  car.triangles = {{0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  const MeshId mesh = builder.AddMesh(car);
  if (with_cars) {
    for (const Vec3f p : {Vec3f{95.5f, 0, 0}, Vec3f{300, 300, 0}}) {
      const EntityId entity = builder.AddEntity("car", builder.tree().At("vehicle/car"));
      builder.AddInstance({mesh, PlaceUpright(p), entity, {0.2f, 0.3f, 0.4f}, {0.5f, 0.5f, 0.5f}});
    }
  }
  if (with_roads) builder.SetRoads(RingRoad(600, 10));
  return builder.Build();
}

SimModel ModelOf(const TrafficScene& scene) {
  SimModel model{.tracer = std::make_shared<const RayTracer>(scene.scene), .dt_ns = 10'000'000};
  model.traffic = scene.traffic;
  return model;
}

TEST(TrafficScene, VehiclesComeAfterEverythingElseAndLookLikeThoseOfTheScene) {
  const auto bare = RingScene();
  const TrafficScene scene = AddTraffic(bare, {.count = 8, .seed = 4});
  ASSERT_EQ(scene.scene->entities.size(), bare->entities.size() + 8);
  for (size_t i = 0; i < bare->entities.size(); ++i) EXPECT_EQ(scene.scene->entities[i].name, bare->entities[i].name);
  EXPECT_EQ(scene.traffic->standing, std::vector<uint32_t>{0});  // the one on the road, not the parked one
  for (size_t i = 0; i < 8; ++i) {
    const TrafficBody& body = scene.traffic->bodies[i];
    EXPECT_EQ(body.name, "traffic/00" + std::to_string(i));
    EXPECT_EQ(scene.scene->entity(body.entity).name, body.name);
    EXPECT_EQ(scene.scene->instances[body.instance].tint, (Vec3f{0.2f, 0.3f, 0.4f}));
    EXPECT_NEAR(scene.traffic->model.vehicles[i].shape.length, 4.4, 1e-6);
  }
}

TEST(TrafficScene, MeshesStandOnTheRoadWithTheirFrontAhead) {
  const TrafficScene scene = AddTraffic(RingScene(), {.count = 5});
  SceneState shown;
  ShowTraffic(*scene.traffic, *scene.traffic->start, scene.traffic->epoch_ns, shown);
  ASSERT_EQ(shown.moved.size(), 6u);
  EXPECT_TRUE(shown.moved[0].hidden);
  for (size_t i = 0; i < 5; ++i) {
    const RigidTransform X_WB = PoseOf(scene.traffic->model, *scene.traffic->start, i, scene.traffic->epoch_ns);
    const AffineTransform& X_WM = shown.moved[i + 1].X_WM;
    const Vec3f front = X_WM * Vec3f{0, -2.2f, 0}, expected = VecCast<float>(X_WB * Vec3d{2.2, 0, 0});
    EXPECT_LT(Norm(front - expected), 1e-3f);
    EXPECT_NEAR((X_WM * Vec3f{0, 0, 1.5f}).z - X_WM.p.z, 1.5f, 1e-3f);
    EXPECT_NEAR(Norm(X_WB.p), 600 / (2 * M_PI), 0.2);
  }
}

// The ring with cars that have glasses: tail lamps at y = 2.2 and head lamps at y = -2.2 of the mesh, one each at x = -0.7 and 0.7.
// `unit`: metres of a unit of the mesh.
std::shared_ptr<const Scene> RingWithLamps(float unit = 1) {
  SceneBuilder builder("lit ring");
  builder.AddSky();
  builder.AddMaterial({});
  Material head{.name = "head"}, tail{.name = "tail"};
  head.lamp = tail.lamp = true;
  head.emission = tail.emission = {1, 1, 1};
  head.beam = 30, tail.beam = -3;
  builder.AddMaterial(head);
  builder.AddMaterial(tail);
  Mesh car;
  const auto plate = [&](float x, float y, float half, float low, float high) {
    const auto first = static_cast<uint32_t>(car.positions.size());
    for (const Vec2f c : {Vec2f{-1, low}, Vec2f{1, low}, Vec2f{1, high}, Vec2f{-1, high}})
      car.positions.push_back({x + half * c.x * (y > 0 ? -1.0f : 1.0f), y, c.y});
    car.triangles.push_back({first, first + 1, first + 2});
    car.triangles.push_back({first, first + 2, first + 3});
  };
  plate(0, -2.1f, 0.9f, 0, 1.5f), plate(0, 2.1f, 0.9f, 0, 1.5f);
  plate(-0.7f, -2.2f, 0.1f, 0.6f, 0.8f), plate(0.7f, -2.2f, 0.1f, 0.6f, 0.8f);
  plate(-0.7f, 2.2f, 0.1f, 0.6f, 0.8f), plate(0.7f, 2.2f, 0.1f, 0.6f, 0.8f);
  car.parts = {{0, 4, 0, kNoEntity}, {4, 4, 1, kNoEntity}, {8, 4, 2, kNoEntity}};
  for (Vec3f& p : car.positions) p = p / unit;
  AffineTransform X_WM = PlaceUpright({300, 300, 0});
  X_WM.A = X_WM.A * Mat3f::FromColumns({unit, 0, 0}, {0, unit, 0}, {0, 0, unit});
  builder.AddInstance({builder.AddMesh(car), X_WM, builder.AddEntity("car", builder.tree().At("vehicle/car"))});
  builder.SetRoads(RingRoad(600, 10));
  return builder.Build();
}

// Where lamps of vehicle 0 are seen that burn: {tail left, tail right, nose left, nose right}.
std::array<bool, 4> Burning(const TrafficScene& scene, const TrafficState& state, int64_t t_ns) {
  auto shown = std::make_shared<SceneState>();
  ShowTraffic(*scene.traffic, state, t_ns, *shown);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(scene.scene));
  const auto tracer = dynamic.At(shown);
  const RigidTransform X_WB = PoseOf(scene.traffic->model, state, 0, t_ns);
  std::array<bool, 4> burning{};
  for (size_t k = 0; k < 4; ++k) {
    const double end = k < 2 ? -1 : 1, left = k % 2 == 0 ? 0.7 : -0.7;
    const Vec3f from = VecCast<float>(X_WB * Vec3d{end * 4, left, 0.7}), ahead = VecCast<float>(X_WB.R * Vec3d{-end, 0, 0});
    const auto hit = tracer->Intersect(from, ahead);
    if (!hit) {
      ADD_FAILURE() << "lamp " << k << " is not where it should be";
      continue;
    }
    EXPECT_EQ(scene.scene->instances[hit->surface.instance].entity, scene.traffic->bodies[0].entity);
    burning[k] = hit->distance < 1.8f - 0.004f;
  }
  return burning;
}

TEST(TrafficScene, BrakeLampsAndIndicatorsAreSeenWhenTheyBurn) {
  const TrafficScene scene = AddTraffic(RingWithLamps(), {.count = 2, .seed = 1, .warm_up = 0});
  TrafficState state = *scene.traffic->start;
  using Four = std::array<bool, 4>;
  EXPECT_EQ(Burning(scene, state, state.t_ns), (Four{}));
  state.vehicles[0].braking = true;
  EXPECT_EQ(Burning(scene, state, state.t_ns), (Four{true, true, false, false}));
  state.vehicles[0].braking = false;
  for (const int8_t side : {int8_t{1}, int8_t{-1}}) {
    state.vehicles[0].indicator = side;
    int lit = 0;
    for (int k = 0; k < 40; ++k) {
      // A vehicle that stands: the same place at all times.
      const Four burning = Burning(scene, state, state.t_ns + k * 50'000'000);
      EXPECT_TRUE(burning == (Four{}) || burning == (Four{side > 0, side<0, side> 0, side < 0}));
      lit += burning != Four{};
    }
    EXPECT_NEAR(lit, 20, 2);  // half of the time
  }
  // Of vehicle 1 nothing burns meanwhile: its lamps are its own.
  SceneState shown;
  ShowTraffic(*scene.traffic, state, state.t_ns, shown);
  const VehicleLamps& other = scene.traffic->bodies[1].lamps;
  for (const MovedInstance& m : shown.moved) {
    const bool is_other = m.instance == other.brake || m.instance == other.left || m.instance == other.right;
    EXPECT_TRUE(!is_other || m.hidden);
  }
  EXPECT_TRUE(std::ranges::is_sorted(shown.moved, {}, &MovedInstance::instance));
}

// Luminance times the area that is seen from behind or from the front is what the lamps of one end throw there.
TEST(TrafficScene, LampsThrowWhatRegulationsAskForAndKeepTheirHue) {
  const TrafficScene scene = AddTraffic(RingWithLamps(), {.count = 1, .seed = 1, .warm_up = 0});
  // The same car in centimetres: lamps as bright, as far before its glasses.
  const TrafficScene small = AddTraffic(RingWithLamps(0.01f), {.count = 1, .seed = 1, .warm_up = 0});
  for (const auto lamp : {&VehicleLamps::brake, &VehicleLamps::left, &VehicleLamps::right}) {
    const auto mesh = [&](const TrafficScene& of) -> const Mesh& {
      return of.scene->meshes[of.scene->instances[of.traffic->bodies[0].lamps.*lamp].mesh];
    };
    const Mesh &a = mesh(scene), &b = mesh(small);
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (size_t k = 0; k < a.positions.size(); ++k) EXPECT_LT(Norm(a.positions[k] - b.positions[k] * 0.01f), 1e-4f);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (size_t k = 0; k < a.parts.size(); ++k) {
      const float nits = Luminance(scene.scene->materials[a.parts[k].material].emission);
      EXPECT_NEAR(Luminance(small.scene->materials[b.parts[k].material].emission), nits, 0.01f * nits);
    }
  }
  const auto thrown = [&](uint32_t lamp, float end) {
    const Mesh& mesh = scene.scene->meshes[scene.scene->instances[lamp].mesh];
    double candela = 0;
    for (const MeshPart& part : mesh.parts) {
      const Material& glass = scene.scene->materials[part.material];
      EXPECT_EQ(glass.emission.z, 0);
      EXPECT_LT(glass.emission.y, 0.2f * glass.emission.x);
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        const Vec3u t = mesh.triangles[k];
        const Vec3f n = Cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]) * 0.5f;
        candela += double{std::max(0.0f, n.y * end)} * double{Luminance(glass.emission) / kNit};
      }
    }
    return candela;
  };
  const VehicleLamps& lamps = scene.traffic->bodies[0].lamps;
  EXPECT_NEAR(thrown(lamps.brake, 1), 2 * 100, 1);
  EXPECT_EQ(thrown(lamps.brake, -1), 0);
  for (const uint32_t side : {lamps.left, lamps.right}) {
    EXPECT_NEAR(thrown(side, 1), 100, 1);
    EXPECT_NEAR(thrown(side, -1), 250, 1);
  }
}

TEST(TrafficScene, FlowSeesTheLampsOfNowLaterToo) {
  const TrafficScene scene = AddTraffic(RingWithLamps(), {.count = 1, .seed = 1, .warm_up = 0});
  const TrafficState dark = *scene.traffic->start;
  TrafficState lit = dark;
  lit.vehicles[0].braking = true;
  SceneState later;
  ShowTraffic(*scene.traffic, dark, dark.t_ns, later, {&lit, lit.t_ns});
  const auto lamp = std::ranges::find(later.moved, scene.traffic->bodies[0].lamps.brake, &MovedInstance::instance);
  ASSERT_NE(lamp, later.moved.end());
  EXPECT_FALSE(lamp->hidden);
}

TEST(TrafficScene, StepsMoveThemAndASnapshotGoesOnWithTheSameBytes) {
  const SimModel model = ModelOf(AddTraffic(RingScene(), {.count = 12, .seed = 2}));
  SimState state = StartState(model);
  const RigidTransform before = PoseOf(model.traffic->model, *state.traffic, 3, model.traffic->epoch_ns);
  for (int i = 0; i < 200; ++i) Step(model, {}, state);
  EXPECT_EQ(state.traffic->t_ns, model.traffic->epoch_ns + 2'000'000'000);
  const RigidTransform after = PoseOf(model.traffic->model, *state.traffic, 3, state.traffic->t_ns);
  EXPECT_GT(Norm(after.p - before.p), 5);
  SimState snapshot = state;
  for (int i = 0; i < 100; ++i) Step(model, {}, state);
  EXPECT_NE(HashState(state), HashState(snapshot));
  for (int i = 0; i < 100; ++i) Step(model, {}, snapshot);
  EXPECT_EQ(HashState(state), HashState(snapshot));
}

TEST(TrafficScene, VehiclesStopForADroneThatHoversOverTheRoad) {
  const SimModel model = ModelOf(AddTraffic(RingScene(), {.count = 3, .seed = 2}));
  const double radius = 600 / (2 * M_PI);
  for (const double height : {1.0, 5.0}) {
    SimState state = StartState(model);
    state.vehicles.push_back(VehicleAt(model, {{}, {0, radius, height}}));
    for (int i = 0; i < 9000; ++i) Step(model, {}, state);
    int standing = 0;
    for (const DrivingVehicle& vehicle : state.traffic->vehicles) standing += vehicle.stopped_ns >= 0;
    EXPECT_EQ(standing, height < 2 ? 3 : 0);
  }
}

// A drone that has set down on the road: who comes stops before it, and goes on when it has flown away.
TEST(TrafficScene, VehiclesWaitForADroneThatHasLandedOnTheRoadAndGoOnWhenItHasLeft) {
  SimModel model = ModelOf(AddTraffic(RingScene(), {.count = 3, .seed = 2}));
  const double radius = 600 / (2 * M_PI);
  const Vec3d landed{0, radius, 0.1};
  SimState state = StartState(model);
  state.vehicles.push_back(VehicleAt(model, {{}, landed}));
  std::vector<SimEvent> events;
  double nearest = INFINITY;
  for (int i = 0; i < 9000; ++i) {
    Step(model, {}, state, &events);
    for (size_t k = 0; k < 3; ++k)
      nearest = std::min(nearest, Norm(PoseOf(model.traffic->model, *state.traffic, k, state.traffic->t_ns).p - landed));
  }
  for (const DrivingVehicle& vehicle : state.traffic->vehicles) EXPECT_GE(vehicle.stopped_ns, 0);
  EXPECT_GT(nearest, 2.2 + 0.5);  // from the middle of a car of 4.4 m, and the drone's radius
  EXPECT_LT(nearest, 2.2 + 0.5 + 4);
  EXPECT_TRUE(std::ranges::none_of(events, [](const SimEvent& event) { return event.kind == SimEvent::Kind::kNearMiss; }));
  state.vehicles[0] = VehicleAt(model, {{}, {0, radius, 12}});
  for (int i = 0; i < 1000; ++i) Step(model, {}, state);
  for (const DrivingVehicle& vehicle : state.traffic->vehicles) EXPECT_GT(vehicle.v, 3);
}

// A drone is put down right in front of somebody who drives: told as an event with both their names.
TEST(TrafficScene, ADroneThatDropsBeforeAVehicleIsANearMissOnceItIsOver) {
  const SimModel model = ModelOf(AddTraffic(RingScene(), {.count = 1, .seed = 2}));
  SimState state = StartState(model);
  state.vehicles.push_back(VehicleAt(model, {{}, {0, 0, 50}}));
  const RigidTransform X_WB = PoseOf(model.traffic->model, *state.traffic, 0, state.traffic->t_ns);
  ASSERT_GT(state.traffic->vehicles[0].v, 6);
  const auto run = [&](Vec3d p, int steps, std::vector<SimEvent>& events) {
    state.vehicles[0] = VehicleAt(model, {{}, p});
    for (int i = 0; i < steps; ++i) Step(model, {}, state, &events);
  };
  std::vector<SimEvent> events;
  run(X_WB * Vec3d{2.2 + 6, 0, 0.5}, 30, events);
  EXPECT_TRUE(events.empty());
  SimState snapshot = state;
  run({0, 0, 50}, 300, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, SimEvent::Kind::kNearMiss);
  EXPECT_EQ(events[0].vehicle, 0u);
  EXPECT_LT(events[0].near_miss.seconds, 0.9);
  EXPECT_LE(events[0].t_ns, 300'000'000);
  EXPECT_TRUE(events[0].text.starts_with("traffic/000 and a drone 0.")) << events[0].text;
  // The same from the snapshot.
  const uint64_t hash = HashState(state);
  state = snapshot;
  std::vector<SimEvent> again;
  run({0, 0, 50}, 300, again);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].text, events[0].text);
  EXPECT_EQ(HashState(state), hash);
}

TEST(TrafficSurvey, MeansAreThoseOfTheStepsAndTwoInOnePlaceOverlap) {
  SimModel model = ModelOf(AddTraffic(RingScene(), {.count = 6, .seed = 2}));
  const TrafficSurvey survey = SurveyTraffic(model, 20);
  EXPECT_EQ(survey.overlaps, 0);
  EXPECT_EQ(survey.seconds, 20);
  TrafficState state = *model.traffic->start;
  double speed = 0, hardest = 0;
  for (int tick = 1; tick <= 400; ++tick) {
    TickTraffic(model.traffic->model, {}, state);
    for (const DrivingVehicle& vehicle : state.vehicles) {
      hardest = std::max(hardest, -vehicle.a);
      if (tick % 20 == 0) speed += vehicle.v / (20 * 6);
    }
  }
  EXPECT_NEAR(survey.mean_speed, speed, 1e-9);
  EXPECT_EQ(survey.hardest_braking, hardest);
  // One that begins 3 m behind the front of another is in it, and 5 m is enough for 4.4.
  for (const double behind : {3.0, 5.0}) {
    auto traffic = std::make_shared<SimTraffic>(*model.traffic);
    auto start = std::make_shared<TrafficState>(*traffic->start);
    start->vehicles.resize(2);
    traffic->bodies.resize(2);
    traffic->model.vehicles.resize(2);
    start->vehicles[0] = {.lane = 0, .ahead = {1, 0}, .s = 100, .v = 0};
    start->vehicles[1] = {.lane = 0, .ahead = {1, 0}, .s = 100 - behind, .v = 0};
    traffic->start = start;
    model.traffic = traffic;
    EXPECT_EQ(SurveyTraffic(model, 1).overlaps, behind < 4.4) << behind;
  }
}

TEST(TrafficScene, WithoutRoadsOrVehiclesOrWithTooManyTheWorldIsNamed) {
  const auto error = [](std::shared_ptr<const Scene> scene, const TrafficRequest& request) -> std::string {
    try {
      AddTraffic(std::move(scene), request);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(error(RingScene(false), {.count = 1}).find("'ring' has no roads"), std::string::npos);
  EXPECT_NE(error(RingScene(true, false), {.count = 1}).find("'ring' has no vehicles"), std::string::npos);
  EXPECT_NE(error(RingScene(), {.count = 500}).find("hold "), std::string::npos);
  EXPECT_NE(error(RingScene(), {.count = size_t{1} << 60}).find("not in 0"), std::string::npos);
  EXPECT_NE(error(RingScene(), {.count = 1, .warm_up = NAN}).find("warm-up"), std::string::npos);
  EXPECT_EQ(error(RingScene(false), {}), "");  // none are none
}

}  // namespace
}  // namespace airsim360
