#include "airsim360/sim/traffic/riders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "airsim360/scene/scene_state.h"
#include "airsim360/traffic/test_roads.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360 {
namespace {

// A ring road of 600 m, a car and, if wanted, a bicycle 1.75 m long that leans at a wall.
std::shared_ptr<const Scene> RingWith(bool bicycle) {
  SceneBuilder builder("ring of bicycles");
  builder.AddSky();
  builder.AddMaterial({});
  const auto add = [&](const char* category, float half_width, float half_length, float height, float at) {
    Mesh mesh;
    for (const float x : {-half_width, half_width})
      for (const float y : {-half_length, half_length})
        for (const float z : {0.0f, height}) mesh.positions.push_back({x, y, z});
    mesh.normals.assign(8, {0, 0, 1});
    mesh.uvs.assign(8, {});
    mesh.triangles = {{0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    const EntityId entity = builder.AddEntity(category, builder.tree().At(category));
    builder.AddInstance({builder.AddMesh(mesh), PlaceUpright({at, 300, 0}), entity, {0.2f, 0.3f, 0.4f}, {}});
  };
  add("vehicle/car", 0.9f, 2.2f, 1.5f, 300);
  if (bicycle) add("vehicle/bicycle", 0.3f, 0.875f, 1.0f, 310);
  builder.SetRoads(RingRoad(600, 10));
  return builder.Build();
}

TEST(Riders, HoldTheGripsStandOnThePedalsAndKeepTheirBones) {
  for (const double stature : {1.62, 1.72, 1.84}) {
    const auto body = MakeProceduralBody({.stature = stature}, 3);
    const SkeletonPose pose = internal::RidingPose(*body);
    for (const double side : {1.0, -1.0}) {
      const bool left = side > 0;
      const auto at = [&](Joint l, Joint r) { return pose[left ? l : r].p; };
      EXPECT_LT(Norm(at(Joint::kLeftWrist, Joint::kRightWrist) - Vec3d{0.17, side * 0.27, 1.03}), 0.1) << stature;
      const Vec3d pedal = left ? Vec3d{-0.09, 0.125, 0.13} : Vec3d{-0.09, -0.125, 0.47};
      const Vec3d ball = at(Joint::kLeftToes, Joint::kRightToes);
      EXPECT_LT(Norm(ball - pedal), 0.12) << stature << ' ' << side;
      // Knees bend forward, elbows down.
      const Vec3d hip = at(Joint::kLeftHip, Joint::kRightHip), knee = at(Joint::kLeftKnee, Joint::kRightKnee);
      const Vec3d ankle = at(Joint::kLeftAnkle, Joint::kRightAnkle);
      EXPECT_GT(knee.x, hip.x + (ankle.x - hip.x) * (hip.z - knee.z) / (hip.z - ankle.z));
    }
    EXPECT_GT(pose[Joint::kHead].p.x, pose[Joint::kPelvis].p.x + 0.1);
    for (int j = 1; j < kJointCount; ++j) {
      const auto joint = static_cast<Joint>(j), parent = ParentOf(joint);
      const double rest = Norm(body->p_PJ[static_cast<size_t>(joint)] - body->p_PJ[static_cast<size_t>(parent)]);
      EXPECT_NEAR(Norm(pose[joint].p - pose[parent].p), rest, 1e-9) << JointName(joint);
      EXPECT_NEAR(pose[joint].R.determinant(), 1, 1e-9) << JointName(joint);
    }
  }
}

TEST(Riders, AShareOfTheVehiclesAreBicyclesWhoseRidersGoWithThem) {
  const TrafficScene scene = AddTraffic(RingWith(true), {.count = 40, .seed = 2});
  const SimTraffic& traffic = *scene.traffic;
  SceneState shown, hidden;
  ShowTraffic(traffic, *traffic.start, traffic.epoch_ns, shown);
  HideTraffic(traffic, hidden);
  EXPECT_TRUE(std::ranges::is_sorted(shown.moved, {}, &MovedInstance::instance));
  int bicycles = 0;
  for (size_t i = 0; i < 40; ++i) {
    const TrafficBody& body = traffic.bodies[i];
    const VehicleShape& shape = traffic.model.vehicles[i].shape;
    EXPECT_EQ(body.kind, shape.bicycle ? "vehicle/bicycle" : "vehicle/car");
    EXPECT_EQ(body.rider != kNoRider, shape.bicycle);
    EXPECT_EQ(VehicleOf(traffic, body.entity), i);
    if (!shape.bicycle) continue;
    ++bicycles;
    EXPECT_NEAR(shape.length, 1.75, 1e-6);
    EXPECT_GE(traffic.model.vehicles[i].driver.top_speed, 4);
    EXPECT_LE(traffic.model.vehicles[i].driver.top_speed, 5.6);
    const Instance& rider = scene.scene->instances[body.rider];
    EXPECT_EQ(scene.scene->entity(rider.entity).name, "rider/" + body.name.substr(8));
    EXPECT_EQ(VehicleOf(traffic, rider.entity), i);
    EXPECT_EQ(scene.scene->tree[scene.scene->entity(rider.entity).category].path, "human/rider");
    const auto moved = std::ranges::find(shown.moved, body.rider, &MovedInstance::instance);
    ASSERT_NE(moved, shown.moved.end());
    EXPECT_FALSE(moved->hidden);
    // From the road to the head, over the bicycle.
    const RigidTransform X_WB = PoseOf(traffic.model, *traffic.start, i, traffic.epoch_ns);
    Box3f box;
    const Mesh& mesh = scene.scene->meshes[rider.mesh];
    for (const Vec3u t : mesh.triangles)
      for (int k = 0; k < 3; ++k) box.Add(VecCast<float>(X_WB.inverse() * VecCast<double>(moved->X_WM * mesh.positions[t[k]])));
    EXPECT_GT(box.min.x, -0.8f);
    EXPECT_LT(box.max.x, 0.6f);
    EXPECT_LT(std::max(-box.min.y, box.max.y), 0.5f);
    EXPECT_NEAR(box.min.z, 0.1f, 0.1f);
    EXPECT_NEAR(box.max.z, 1.75f, 0.2f);
    const auto gone = std::ranges::find(hidden.moved, body.rider, &MovedInstance::instance);
    EXPECT_TRUE(gone != hidden.moved.end() && gone->hidden);
  }
  EXPECT_GE(bicycles, 1);
  EXPECT_LE(bicycles, 9);
}

TEST(Riders, WhereAWorldHasNoBicycleNobodyRides) {
  const TrafficScene scene = AddTraffic(RingWith(false), {.count = 40, .seed = 2});
  for (const TrafficVehicle& vehicle : scene.traffic->model.vehicles) EXPECT_FALSE(vehicle.shape.bicycle);
  // Vehicles that are no bicycles are the same in both.
  const TrafficScene other = AddTraffic(RingWith(true), {.count = 40, .seed = 2});
  for (size_t i = 0; i < 40; ++i) {
    if (other.traffic->model.vehicles[i].shape.bicycle) continue;
    EXPECT_EQ(other.traffic->model.vehicles[i].driver.headway, scene.traffic->model.vehicles[i].driver.headway);
  }
}

}  // namespace
}  // namespace airsim360
