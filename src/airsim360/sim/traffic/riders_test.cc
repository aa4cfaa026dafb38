#include "airsim360/sim/traffic/riders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "airsim360/base/parallel.h"
#include "airsim360/scene/scene_state.h"
#include "airsim360/sim/traffic/bicycle_parts.h"
#include "airsim360/traffic/test_roads.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/props/props.h"

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

const internal::Perch kPerch = internal::PerchOf(kBicycleMeasures[0], {0, -0.01f, 0}, 1);

void ExpectBones(const Body& body, const SkeletonPose& pose) {
  for (int j = 1; j < kJointCount; ++j) {
    const auto joint = static_cast<Joint>(j), parent = ParentOf(joint);
    const double rest = Norm(body.p_PJ[static_cast<size_t>(joint)] - body.p_PJ[static_cast<size_t>(parent)]);
    EXPECT_NEAR(Norm(pose[joint].p - pose[parent].p), rest, 1e-9) << JointName(joint);
    EXPECT_NEAR(pose[joint].R.determinant(), 1, 1e-9) << JointName(joint);
  }
}

// How high the ball of a foot is over its sole when it stands flat.
double BallHeight(const Body& body, bool left) {
  const auto at = [&](Joint l, Joint r) { return static_cast<size_t>(left ? l : r); };
  const Vec3d ball = body.R_zero[at(Joint::kLeftAnkle, Joint::kRightAnkle)] *
                     (body.p_PJ[at(Joint::kLeftToes, Joint::kRightToes)] - body.p_PJ[at(Joint::kLeftAnkle, Joint::kRightAnkle)]);
  return std::max(0.0, body.size.ankle_height + ball.z);
}

// Whatever the turn of the cranks: soles on the pedals, knees forward and in the plane of hip and ankle.
TEST(Riders, FeetGoRoundWithThePedals) {
  for (const double stature : {1.62, 1.72, 1.84}) {
    const auto body = MakeProceduralBody({.stature = stature}, 3);
    Vec3d last_knee;
    for (int phase = 0; phase < 48; ++phase) {
      const double crank = phase * M_PI / 24;
      const SkeletonPose pose = internal::RidingPose(*body, kPerch, crank);
      ExpectBones(*body, pose);
      for (const bool left : {true, false}) {
        const auto at = [&](Joint l, Joint r) { return pose[left ? l : r].p; };
        // A pedal on a circle about the bracket: the closed form.
        const double side = left ? 1 : -1;
        const Vec3d pedal{-0.10 - side * 0.17 * std::sin(crank), side * 0.125, 0.29 - side * 0.17 * std::cos(crank)};
        EXPECT_LT(Norm(internal::PedalAt(kPerch, left, crank) - pedal), 1e-6);
        const double over = 0.012 + BallHeight(*body, left), pitch = internal::FootPitch(left, crank);
        const Vec3d ball = pedal + Vec3d{std::sin(pitch), 0, std::cos(pitch)} * over;
        EXPECT_LT(Norm(at(Joint::kLeftToes, Joint::kRightToes) - ball), 0.01) << stature << ' ' << crank << ' ' << side;
        const Vec3d hip = at(Joint::kLeftHip, Joint::kRightHip), knee = at(Joint::kLeftKnee, Joint::kRightKnee);
        const Vec3d ankle = at(Joint::kLeftAnkle, Joint::kRightAnkle);
        const double share = (hip.z - knee.z) / (hip.z - ankle.z);
        EXPECT_GT(knee.x, hip.x + (ankle.x - hip.x) * share);
        EXPECT_NEAR(knee.y, hip.y + (ankle.y - hip.y) * share, 0.03);
        if (left && phase > 0) {
          EXPECT_LT(Norm(knee - last_knee), 0.06);
        }
        if (left) last_knee = knee;
      }
      EXPECT_LT(Norm(pose[Joint::kLeftWrist].p - Vec3d{0.17, 0.27, 1.03}), 0.1) << stature;
      EXPECT_LT(Norm(pose[Joint::kRightWrist].p - Vec3d{0.17, -0.27, 1.03}), 0.1) << stature;
    }
  }
}

TEST(Riders, HaveTheLeftFootOnTheGroundWhenTheyStandAndTheRightOneOnItsPedal) {
  EXPECT_EQ(internal::StandingAt(0), 1);
  EXPECT_EQ(internal::StandingAt(1.4), 0);
  for (const double stature : {1.62, 1.72, 1.84}) {
    const auto body = MakeProceduralBody({.stature = stature}, 3);
    for (const double crank : {M_PI / 2, 3 * M_PI / 2}) {
      const SkeletonPose pose = internal::RidingPose(*body, kPerch, crank, 1);
      ExpectBones(*body, pose);
      EXPECT_LT(Norm(pose[Joint::kRightToes].p - internal::PedalAt(kPerch, false, crank)), 0.012 + BallHeight(*body, false) + 0.01)
          << stature;
    }
    const SkeletonPose pose = internal::RidingPose(*body, kPerch, M_PI / 2, 1);
    // In the frame of the ground, over which the bicycle leans to the left.
    const double lean = internal::LeanOf(1);
    const Vec3d ball = RotationX(-lean) * pose[Joint::kLeftToes].p;
    EXPECT_NEAR(ball.z, BallHeight(*body, true), 0.01) << stature;
    EXPECT_GT(ball.y, 0.15);
    // From saddle to ground nothing jumps.
    Vec3d last = internal::RidingPose(*body, kPerch, M_PI / 2, 0)[Joint::kLeftToes].p;
    for (int k = 1; k <= 50; ++k) {
      const SkeletonPose now = internal::RidingPose(*body, kPerch, M_PI / 2, k / 50.0);
      ExpectBones(*body, now);
      EXPECT_LT(Norm(now[Joint::kLeftToes].p - last), 0.03) << stature << ' ' << k;
      last = now[Joint::kLeftToes].p;
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
    const auto deformed = std::ranges::find(shown.deformed, rider.mesh, &DeformedMesh::mesh);
    ASSERT_NE(deformed, shown.deformed.end());
    for (const Vec3u t : mesh.triangles)
      for (int k = 0; k < 3; ++k) box.Add(VecCast<float>(X_WB.inverse() * VecCast<double>(moved->X_WM * (*deformed->positions)[t[k]])));
    EXPECT_GT(box.min.x, -0.8f);
    EXPECT_LT(box.max.x, 0.6f);
    EXPECT_LT(std::max(-box.min.y, box.max.y), 0.5f);
    EXPECT_NEAR(box.min.z, 0.13f, 0.13f);  // the lowest foot, wherever the cranks are
    EXPECT_NEAR(box.max.z, 1.75f, 0.2f);
    const auto gone = std::ranges::find(hidden.moved, body.rider, &MovedInstance::instance);
    EXPECT_TRUE(gone != hidden.moved.end() && gone->hidden);
  }
  EXPECT_GE(bicycles, 1);
  EXPECT_LE(bicycles, 9);
}

// The ready-made bicycle: its bar is far away and its cranks were built turned.
TEST(Riders, ReachTheBarAndThePedalsOfTheReadyMadeBicycle) {
  const internal::Perch perch = internal::PerchOf(kBicycleMeasures[1], {}, 1);
  for (const double stature : {1.62, 1.72, 1.84}) {
    const auto body = MakeProceduralBody({.stature = stature}, 3);
    for (const double standing : {0.0, 0.5, 1.0}) {
      for (int phase = 0; phase < 24; ++phase) {
        const double crank = phase * M_PI / 12;
        const SkeletonPose pose = internal::RidingPose(*body, perch, crank, standing);
        ExpectBones(*body, pose);
        EXPECT_LT(Norm(pose[Joint::kLeftWrist].p - perch.grip), 0.1) << stature << ' ' << standing;
        const double over = 0.013 + BallHeight(*body, false);
        EXPECT_LT(Norm(pose[Joint::kRightToes].p - internal::PedalAt(perch, false, crank)), over + 0.015) << stature << ' ' << crank;
      }
    }
  }
  // Pedals as built: at the crank angle of the mesh.
  for (const bool left : {true, false}) {
    const Vec3f p = kBicycleMeasures[1].Pedal(left);
    EXPECT_LT(Norm(internal::PedalAt(perch, left, kBicycleMeasures[1].built_crank) - Vec3d{-p.y, p.x, p.z}), 1e-6);
    EXPECT_LT(Norm(p - (left ? Vec3f{0.125f, 0.0205f, 0.48f} : Vec3f{-0.125f, 0.1735f, 0.1395f})), 0.003f);
  }
}

// The bicycle of the prop library comes apart into what turns and what does not, and loses nothing but its stand.
TEST(Riders, TheBicycleOfTheLibraryComesApart) {
  for (const char* kind : {"bicycle", "bicycle_1950s"}) {
    const Model bicycle = MakeProp(FindPropKind(kind), 1, 0, nullptr);
    Scene scene;
    scene.meshes.push_back(bicycle.mesh);
    const auto meshes = internal::AddBicycleMeshes(0, scene);
    ASSERT_TRUE(meshes.has_value());
    const auto box = [&](BicyclePart part) { return scene.meshes[meshes->part[static_cast<size_t>(part)]].Bounds(); };
    const auto near = [](const Box3f& b, Vec3f middle, Vec3f size) {
      EXPECT_LT(Norm(b.center() - middle), 0.01f);
      EXPECT_LT(Norm(b.size() - size), 0.02f);
    };
    near(box(BicyclePart::kFrontWheel), {0, -0.54f, 0.345f}, {0.1f, 0.69f, 0.69f});
    near(box(BicyclePart::kRearWheel), {0, 0.52f, 0.345f}, {0.1f, 0.69f, 0.69f});
    near(box(BicyclePart::kCranks), {0, 0.09f, 0.29f}, {0.17f, 0.17f, 0.34f});
    near(box(BicyclePart::kLeftPedal), {0.125f, 0.09f, 0.12f}, {0.09f, 0.07f, 0.024f});
    near(box(BicyclePart::kRightPedal), {-0.125f, 0.09f, 0.46f}, {0.09f, 0.07f, 0.024f});
    size_t triangles = scene.meshes[meshes->frame].triangles.size();
    for (const MeshId part : meshes->part) triangles += scene.meshes[part].triangles.size();
    EXPECT_LT(triangles, bicycle.mesh.triangles.size());
    EXPECT_GT(triangles, bicycle.mesh.triangles.size() - 100);
    EXPECT_GT(scene.meshes[meshes->frame].Bounds().min.z, 0.1f);

    // Pedals of the mesh go where those of its rider are.
    Box3f whole = bicycle.mesh.Bounds();
    const Vec3f offset{whole.center().x, whole.center().y, 0};
    const internal::Perch perch = internal::PerchOf(*meshes->measures, offset, 1);
    for (int phase = 0; phase < 12; ++phase) {
      const Cycling cycling{.crank = phase * M_PI / 6};
      for (const bool left : {true, false}) {
        const auto part = left ? BicyclePart::kLeftPedal : BicyclePart::kRightPedal;
        const AffineTransform X = internal::PlaceOfPart(*meshes->measures, part, cycling, internal::FootPitch(left, cycling.crank));
        const Vec3f p = X * box(part).center() - offset;
        EXPECT_LT(Norm(internal::PedalAt(perch, left, cycling.crank) - Vec3d{-p.y, p.x, p.z}), 1e-4) << phase;
      }
      // The foot of a wheel that has turned: where the tyre was at the turn's angle behind. It rolls forwards, to -Y.
      const Vec3f top =
          internal::PlaceOfPart(*meshes->measures, BicyclePart::kFrontWheel, {.wheel = M_PI / 2}, 0) * Vec3f{0, -0.54f, 0.69f};
      EXPECT_LT(Norm(top - Vec3f{0, -0.885f, 0.345f}), 1e-4f);
    }
  }
}

// Riders at one instant are the same bytes with one thread and with many, and from a copy of the state.
TEST(Riders, AreTheSameWhateverTheNumberOfThreads) {
  const TrafficScene scene = AddTraffic(RingWith(true), {.count = 40, .seed = 2});
  const auto shown = [&](int threads) {
    const ThreadLimit limit(threads);
    TrafficState state = *scene.traffic->start;
    for (int k = 0; k < 40; ++k) TickTraffic(scene.traffic->model, {}, state);
    SceneState now;
    ShowTraffic(*scene.traffic, state, state.t_ns + 17'000'000, now);
    return now;
  };
  const SceneState one = shown(1), many = shown(0);
  ASSERT_EQ(one.deformed.size(), many.deformed.size());
  ASSERT_GE(one.deformed.size(), 1u);
  for (size_t k = 0; k < one.deformed.size(); ++k) EXPECT_EQ(*one.deformed[k].positions, *many.deformed[k].positions);
  ASSERT_EQ(one.moved.size(), many.moved.size());
  ASSERT_GE(one.moved.size(), 1u);
  for (size_t k = 0; k < one.moved.size(); ++k) EXPECT_EQ(one.moved[k].X_WM, many.moved[k].X_WM);
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
