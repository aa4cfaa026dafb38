// Drones in each other's sensors.
#include <gtest/gtest.h>

#include <map>

#include "airsim360/base/error.h"
#include "airsim360/sim/capture.h"
#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;

// Two drones 2 m apart that look at each other, with bodies in the room.
struct TwoInTheRoom {
  std::shared_ptr<SimModel> model = std::make_shared<SimModel>();
  std::shared_ptr<const RayTracer> base;
  std::vector<DroneBodyRef> refs;

  TwoInTheRoom() {
    DroneSetup setups[2] = {HummingbirdAt({-1, 0, 3}), HummingbirdAt({1, 0, 3})};
    setups[1].X_WB = BodyPose({1, 0, 3}, 3.14159265358979, 0, 0);
    std::vector<DroneBodySpec> bodies;
    for (DroneSetup& setup : setups) {
      setup.sensors.lidars = {{"lidar", {.channels = 32, .columns = 720, .low_deg = -20, .high_deg = 20, .sigma = 0}}};
      setup.sensors.range_finders = {{"ahead", {.mount = {}, .beam_deg = 6, .sigma = 0, .sigma_per_metre = 0}}};
      CameraSpec panorama;
      panorama.width = 512, panorama.height = 256;
      panorama.tier = Tier::kLabels;
      setup.sensors.cameras = {{"panorama", panorama}};
      bodies.push_back({"drone", DroneBodyModel(setup.model), setup.X_WB});
    }
    base = std::make_shared<const RayTracer>(AddDroneBodies(BuildWorld("box_room", {}), bodies, refs));
    model->tracer = WithoutBodies(base, refs);
    for (int i = 0; i < 2; ++i) {
      setups[i].instance = refs[i].instance;
      setups[i].entity = refs[i].entity;
      model->drones.push_back(std::make_shared<const SimDrone>(setups[i], model->dt_ns));
    }
  }
};

std::map<EntityId, int> PixelsOf(const Capture& capture) {
  std::map<EntityId, int> pixels;
  for (int y = 0; y < capture.frame.entity.height(); ++y) {
    for (int x = 0; x < capture.frame.entity.width(); ++x) ++pixels[capture.frame.entity(x, y)];
  }
  return pixels;
}

TEST(AddDroneBodies, KeepsTheIdsOfTheSceneAndNamesEveryDrone) {
  const TwoInTheRoom room;
  const Scene& scene = room.base->scene();
  ASSERT_EQ(scene.entities.size(), 9u);
  EXPECT_EQ(scene.entity(1).name, "floor");
  EXPECT_EQ(scene.entity(room.refs[0].entity).name, "drone");
  EXPECT_EQ(scene.entity(room.refs[1].entity).name, "drone 2");
  EXPECT_EQ(scene.entity(room.refs[1].entity).category, scene.tree.At("uav/other"));
}

TEST(DroneSight, APanoramaShowsTheOtherDroneWithItsEntityAndNeverItsOwn) {
  const TwoInTheRoom room;
  SnapshotSensors sensors(room.model, room.base);
  SimState state = StartState(*room.model);
  const auto renderer = MakeCpuRenderer(room.base, {.tier = Tier::kLabels});
  for (size_t i = 0; i < 2; ++i) {
    Capture capture;
    sensors.Camera(state, i, 0, {}, *renderer, capture);
    const auto pixels = PixelsOf(capture);
    EXPECT_GT(pixels.count(room.refs[1 - i].entity), 0u);
    EXPECT_EQ(pixels.count(room.refs[i].entity), 0u);
    EXPECT_EQ(capture.t_ns, state.t_ns);
    // The other is straight ahead.
    EXPECT_EQ(capture.frame.entity(256, 128), room.refs[1 - i].entity);
  }
}

TEST(DroneSight, TheOtherDroneIsSeenWhereItHasFlownTo) {
  const TwoInTheRoom room;
  SnapshotSensors sensors(room.model, room.base);
  SimState state = StartState(*room.model);
  internal::Fly(*room.model, state, 1, PositionCommand{.p_W = {-1, 3, 3}, .speed = 2}, 5);
  const auto renderer = MakeCpuRenderer(room.base, {.tier = Tier::kLabels});
  Capture capture;
  sensors.Camera(state, 0, 0, {}, *renderer, capture);
  EXPECT_NE(capture.frame.entity(256, 128), room.refs[1].entity);
  // Now it is to the left: a quarter of the width before the middle.
  bool found = false;
  for (int x = 118; x <= 138; ++x) found |= capture.frame.entity(x, 128) == room.refs[1].entity;
  EXPECT_TRUE(found);
}

TEST(DroneSight, LidarAndRangeFinderMeetTheOtherDroneButNotTheirOwn) {
  const TwoInTheRoom room;
  SnapshotSensors sensors(room.model, room.base);
  const SimState state = StartState(*room.model);
  LidarScan scan;
  sensors.Lidar(state, 0, 0, scan);
  int other = 0;
  for (const LidarPoint& point : scan.points) {
    EXPECT_NE(point.entity, room.refs[0].entity);
    if (point.entity != room.refs[1].entity) continue;
    ++other;
    EXPECT_NEAR(point.range, 2, 0.4);
    EXPECT_EQ(point.category, room.base->scene().tree.At("uav/other"));
  }
  EXPECT_GT(other, 5);
  const RangeReading ahead = sensors.Range(state, 0, 0);
  EXPECT_EQ(ahead.entity, room.refs[1].entity);
  EXPECT_NEAR(ahead.range, 2, 0.4);
}

TEST(DroneSight, ADroneDoesNotCollideWithItsOwnBody) {
  const TwoInTheRoom room;
  SimState state = StartState(*room.model);
  const auto events = internal::Fly(*room.model, state, 0, HoverCommand{}, 1);
  EXPECT_EQ(internal::FindEvent(events, SimEvent::Kind::kCollision), nullptr);
}

TEST(FindSensor, NamesTheNearestOfAKind) {
  const SensorSet set = SensorSet::Standard();
  EXPECT_EQ(FindSensor("imu", "", set.imus), 0u);
  EXPECT_EQ(FindSensor("imu", "imu", set.imus), 0u);
  EXPECT_THROW(FindSensor("imu", "imo", set.imus), InputError);
  EXPECT_THROW(FindSensor("lidar", "", set.lidars), InputError);
}

}  // namespace
}  // namespace airsim360
