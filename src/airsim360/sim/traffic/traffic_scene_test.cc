#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/traffic/traffic.h"
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
