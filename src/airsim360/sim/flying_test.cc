// Drones that fly, land, bump and fail in the analytic room: x = +-5, y = +-5, z = 0 … 6.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/sensors/surface_label.h"
#include "airsim360/sim/en_route.h"
#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::FindEvent;
using internal::Fly;
using internal::HummingbirdAt;
using internal::RoomModel;
using internal::Wait;
using Kind = SimEvent::Kind;

const std::string& EntityName(const SimModel& model, EntityId id) { return model.tracer->scene().entity(id).name; }

double BottomOf(const SimModel& model, const Vehicle& vehicle) { return vehicle.drone.p_WB.z - model.drones[0]->model().half_size_B.z; }

TEST(Flying, TakesOffHoversAndLandsOnTheFloor) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 2}, false)});
  SimState state = StartState(*model);
  EXPECT_NEAR(BottomOf(*model, state.vehicles[0]), 0, 1e-6);
  auto events = Fly(*model, state, 0, TakeoffCommand{.height = 2}, 6);
  EXPECT_NE(FindEvent(events, Kind::kCommandDone), nullptr);
  EXPECT_NEAR(state.vehicles[0].drone.p_WB.z, 2 + model->drones[0]->model().half_size_B.z, 0.1);
  EXPECT_LT(Norm(state.vehicles[0].drone.v_WB), 0.1);

  events = Fly(*model, state, 0, LandCommand{}, 8);
  EXPECT_NE(FindEvent(events, Kind::kCommandDone), nullptr);
  EXPECT_EQ(state.vehicles[0].collision.count, 0u);  // neither standing, nor taking off, nor landing is a collision
  EXPECT_NEAR(BottomOf(*model, state.vehicles[0]), 0, 0.01);
  EXPECT_LT(Norm(state.vehicles[0].drone.v_WB), 0.01);
  EXPECT_EQ(state.vehicles[0].autopilot.mode, FlightMode::kDisarmed);

  // It lies there without moving at all, its accelerometer feels the floor, and it takes off again.
  Wait(*model, state, 1);
  const Vec3d p = state.vehicles[0].drone.p_WB;
  Wait(*model, state, 1);
  EXPECT_EQ(state.vehicles[0].drone.p_WB, p);
  EXPECT_NEAR(state.vehicles[0].sensors.imus[0].last.specific_force.z, kGravity, 0.3);
  Fly(*model, state, 0, TakeoffCommand{.height = 1}, 4);
  EXPECT_GT(state.vehicles[0].drone.p_WB.z, 0.9);
}

TEST(Flying, StandingForLongIsNoCollision) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 2}, false)});
  SimState state = StartState(*model);
  auto events = Wait(*model, state, 2);  // asleep by then
  for (const Command& command : {Command{ArmCommand{}}, Command{DisarmCommand{}}, Command{ArmCommand{}}}) {
    const auto more = Fly(*model, state, 0, command, 2);
    events.insert(events.end(), more.begin(), more.end());
  }
  EXPECT_EQ(FindEvent(events, Kind::kCollision), nullptr);
  EXPECT_EQ(state.vehicles[0].collision.count, 0u);
}

// The floor is touched at about the speed of the command.
TEST(Flying, TheFloorIsACollisionInFlightAndWhereALandingIsHard) {
  const auto collisions = [](const Command& down) {
    const auto model = RoomModel({HummingbirdAt({0, 0, 1})});
    SimState state = StartState(*model);
    const auto events = Fly(*model, state, 0, down, 7);
    const SimEvent* hit = FindEvent(events, Kind::kCollision);
    if (hit == nullptr) {
      EXPECT_EQ(state.vehicles[0].collision.count, 0u);
      return 0.0;
    }
    EXPECT_EQ(EntityName(*model, hit->collision.entity), "floor");
    EXPECT_NEAR(hit->collision.normal_W.z, 1, 1e-6);
    return hit->collision.impact_speed;
  };
  EXPECT_EQ(collisions(LandCommand{}), 0);
  EXPECT_GT(collisions(LandCommand{.speed = 1.6}), 1);
  EXPECT_EQ(collisions(VelocityCommand{.v = {0, 0, -0.2}}), 0);
  EXPECT_GT(collisions(VelocityCommand{.v = {0, 0, -0.6}}), 0.3);
}

TEST(Flying, ADroneThatStandsTakesOffReturnsOrLandsIsNotEnRoute) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 2}, false)});
  SimState state = StartState(*model);
  const auto en_route = [&](const Command& command, double seconds) {
    Fly(*model, state, 0, command, seconds);
    return IsEnRoute(state.vehicles[0]);
  };
  EXPECT_FALSE(IsEnRoute(state.vehicles[0]));
  EXPECT_FALSE(en_route(TakeoffCommand{.height = 2}, 1));
  EXPECT_TRUE(en_route(HoverCommand{}, 4));
  EXPECT_TRUE(en_route(PositionCommand{.p_W = {2, 2, 2}}, 4));
  EXPECT_TRUE(en_route(ReturnCommand{.height = 3}, 0.5));  // on its way up
  EXPECT_FALSE(en_route(ReturnCommand{.height = 3}, 12));  // down again
  EXPECT_EQ(state.vehicles[0].collision.count, 0u);
}

TEST(Flying, HittingAWallIsReportedWithItsEntityNormalAndSpeed) {
  const auto model = RoomModel({HummingbirdAt({0, 2, 3})});
  SimState state = StartState(*model);
  std::vector<SimEvent> events;
  std::vector<SimCommand> commands = {{0, FlightCommand{VelocityCommand{.v = {2, 0, 0}}}}};
  double speed = 0;
  while (FindEvent(events, Kind::kCollision) == nullptr && state.t_ns < 10'000'000'000) {
    speed = state.vehicles[0].drone.v_WB.x;
    Step(*model, commands, state, &events);
    commands.clear();
  }
  const SimEvent* hit = FindEvent(events, Kind::kCollision);
  ASSERT_NE(hit, nullptr);
  EXPECT_EQ(EntityName(*model, hit->collision.entity), "wall east");
  EXPECT_LT(Norm(hit->collision.normal_W - Vec3d{-1, 0, 0}), 1e-6);
  EXPECT_NEAR(hit->collision.p_W.x, 5, 1e-3);
  EXPECT_NEAR(hit->collision.impact_speed, speed, 0.2 * speed);
  EXPECT_EQ(hit->collision.t_ns, hit->t_ns);
  EXPECT_EQ(state.vehicles[0].collision.count, 1u);
  Wait(*model, state, 2);
  EXPECT_LT(state.vehicles[0].drone.p_WB.x, 5);
}

TEST(Flying, AHardImpactIsACrashAndStopsTheRotors) {
  DroneSetup setup = HummingbirdAt({3.5, 2, 3});
  const auto model = RoomModel({setup});
  SimState state = StartState(*model);
  state.vehicles[0].drone.v_WB = {8, 0, 0};
  const auto events = Wait(*model, state, 4);
  const SimEvent* crash = FindEvent(events, Kind::kCrash);
  ASSERT_NE(crash, nullptr);
  EXPECT_GT(crash->collision.impact_speed, 3);
  EXPECT_EQ(state.vehicles[0].autopilot.mode, FlightMode::kDisarmed);
  // It lies on the floor.
  EXPECT_LT(state.vehicles[0].drone.p_WB.z, 0.4);
  EXPECT_LT(*std::ranges::max_element(state.vehicles[0].drone.rotor_speeds), 1);
  // It takes no commands until a reset makes it whole.
  const auto refused = Fly(*model, state, 0, TakeoffCommand{}, 1);
  EXPECT_NE(FindEvent(refused, Kind::kCommandRefused), nullptr);
  EXPECT_LT(state.vehicles[0].drone.p_WB.z, 0.4);
  Step(*model, std::vector<SimCommand>{{0, ResetCommand{}}}, state);
  EXPECT_FALSE(state.vehicles[0].contact.crashed);
  EXPECT_LT(Norm(state.vehicles[0].drone.p_WB - setup.X_WB.p), 0.01);
}

TEST(Flying, ABatteryThatRunsOutLandsTheDrone) {
  DroneSetup setup = HummingbirdAt({0, 0, 2});
  setup.model.battery = {.cells = 3, .capacity_ah = 2, .resistance = 0.01};
  const auto model = RoomModel({setup});
  SimState state = StartState(*model);
  state.vehicles[0].drone.charge = 0.0505;  // just above empty
  const auto events = Wait(*model, state, 12);
  EXPECT_NE(FindEvent(events, Kind::kBatteryLow), nullptr);
  ASSERT_NE(FindEvent(events, Kind::kBatteryEmpty), nullptr);
  EXPECT_NEAR(BottomOf(*model, state.vehicles[0]), 0, 0.02);
  EXPECT_EQ(FindEvent(events, Kind::kCrash), nullptr);
}

TEST(Flying, ADeadBatteryLetsTheDroneFall) {
  DroneSetup setup = HummingbirdAt({0, 0, 4});
  setup.model.battery = {.cells = 3, .capacity_ah = 2, .resistance = 0.01};
  const auto model = RoomModel({setup});
  SimState state = StartState(*model);
  state.vehicles[0].drone.charge = 0;
  const auto events = Wait(*model, state, 3);
  EXPECT_NE(FindEvent(events, Kind::kCrash), nullptr);
  EXPECT_LT(state.vehicles[0].drone.p_WB.z, 0.4);
}

TEST(Flying, AFailedRotorIsToldAndTheDroneStaysInTheRoom) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 3})});
  SimState state = StartState(*model);
  RotorHealthCommand failed;
  failed.health[2] = 0;
  std::vector<SimEvent> events;
  Step(*model, std::vector<SimCommand>{{0, failed}}, state, &events);
  for (const SimEvent& event : Wait(*model, state, 5)) events.push_back(event);
  EXPECT_NE(FindEvent(events, Kind::kRotorFailed), nullptr);
  EXPECT_LT(state.vehicles[0].drone.rotor_speeds[2], 1);
  const Vec3d p = state.vehicles[0].drone.p_WB;
  EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 5);
  EXPECT_GT(p.z, 0);
}

TEST(Flying, ACommandThatIsNoNumberIsRefusedAndTheDroneHolds) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 3})});
  SimState state = StartState(*model);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto events = Fly(*model, state, 0, VelocityCommand{.v = {nan, 0, 0}}, 2);
  const SimEvent* refused = FindEvent(events, Kind::kCommandRefused);
  ASSERT_NE(refused, nullptr);
  EXPECT_NE(refused->text.find("nan"), std::string::npos) << refused->text;
  EXPECT_LT(Norm(state.vehicles[0].drone.p_WB - Vec3d{0, 0, 3}), 0.05);
}

TEST(Flying, AGeofenceHoldsTheDroneBackAndTells) {
  DroneSetup setup = HummingbirdAt({0, 0, 3});
  setup.autopilot.fence = Geofence{.low = {-2, -2, 0}, .high = {2, 2, 5}};
  const auto model = RoomModel({setup});
  SimState state = StartState(*model);
  const auto events = Fly(*model, state, 0, PositionCommand{.p_W = {4, 0, 3}, .speed = 1}, 8);
  EXPECT_NE(FindEvent(events, Kind::kFence), nullptr);
  EXPECT_LT(state.vehicles[0].drone.p_WB.x, 2.3);
  EXPECT_EQ(FindEvent(events, Kind::kCollision), nullptr);
}

TEST(Flying, DronesThatMeetCollideWithEachOther) {
  const auto model = RoomModel({HummingbirdAt({-1.5, 0, 3}), HummingbirdAt({1.5, 0, 3})});
  SimState state = StartState(*model);
  const std::vector<SimCommand> at_each_other = {{0, FlightCommand{VelocityCommand{.v = {1, 0, 0}}}},
                                                 {1, FlightCommand{VelocityCommand{.v = {-1, 0, 0}}}}};
  std::vector<SimEvent> events;
  Step(*model, at_each_other, state, &events);
  const Vec3d half = model->drones[0]->model().half_size_B;
  for (int i = 0; i < 3000; ++i) {
    Step(*model, {}, state, &events);
    // The centre of one is never in the box of the other.
    const Kinematics &a = state.vehicles[0].motion, &b = state.vehicles[1].motion;
    const Vec3d d = a.X_WB.R.transpose() * (b.X_WB.p - a.X_WB.p);
    ASSERT_TRUE(std::abs(d.x) > half.x || std::abs(d.y) > half.y || std::abs(d.z) > half.z) << i;
  }
  const SimEvent* hit = FindEvent(events, Kind::kCollision);
  ASSERT_NE(hit, nullptr);
  EXPECT_NEAR(std::abs(hit->collision.p_W.x), 0, 0.4);
}

TEST(Flying, ADroneOnARouteTakesOverInMidAir) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 2})});
  SimState state = StartState(*model);
  const auto route = std::make_shared<const Route>(RouteThrough({{.p = {-2, 0, 2}}, {.p = {2, 0, 3}}}, 2));
  Step(*model, std::vector<SimCommand>{{0, route}}, state);
  Wait(*model, state, route->duration() / 2);
  const RoutePoint middle = route->At(static_cast<double>(state.t_ns) * 1e-9);
  EXPECT_LT(Norm(state.vehicles[0].motion.X_WB.p - middle.p), 1e-9);
  EXPECT_LT(Norm(state.vehicles[0].motion.v_WB - middle.v), 1e-9);
  Fly(*model, state, 0, HoverCommand{}, 4);
  EXPECT_LT(Norm(state.vehicles[0].drone.v_WB), 0.1);
  EXPECT_LT(Norm(state.vehicles[0].drone.p_WB - middle.p), 2);
}

TEST(Flying, SensorsOfAHoveringDroneAgreeWithItsState) {
  DroneSetup setup = HummingbirdAt({0.5, -0.5, 2.5});
  setup.sensors = SensorSet::Standard();
  const auto model = RoomModel({setup});
  SimState state = StartState(*model);
  Vec3d force, turn;
  for (int i = 0; i < 400; ++i) {
    Wait(*model, state, 0.005);
    force += state.vehicles[0].sensors.imus[0].last.specific_force / 400;
    turn += state.vehicles[0].sensors.imus[0].last.angular_velocity / 400;
  }
  EXPECT_LT(Norm(force - Vec3d{0, 0, kGravity}), 0.15);  // turn-on bias of 0.02, walk, noise
  EXPECT_LT(Norm(turn), 0.03);
  const GnssReading& fix = state.vehicles[0].sensors.gnss[0].last;
  EXPECT_TRUE(fix.has_fix);
  EXPECT_EQ(fix.t_ns - fix.measured_ns, 200'000'000);
  EXPECT_LT(Norm(model->world.frame.ToWorld(fix.place) - fix.p_WS), 1e-6);
  const double height = state.vehicles[0].sensors.barometers[0].last.altitude;
  EXPECT_NEAR(height, 122 + 2.5, 5);
}

TEST(Flying, HoldsItsPlaceInWind) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 3})});
  SimState state = StartState(*model);
  Step(*model, std::vector<SimCommand>{{0, WindCommand{{4, 0, 0}}}}, state);
  Wait(*model, state, 6);
  EXPECT_EQ(state.vehicles[0].wind_W, (Vec3d{4, 0, 0}));
  EXPECT_LT(Norm(state.vehicles[0].drone.p_WB - Vec3d{0, 0, 3}), 0.1);
  // It leans into the wind.
  EXPECT_LT(state.vehicles[0].motion.X_WB.R.column(2).x, -0.005);
}

TEST(Flying, LandsOnTheGroundOfATown) {
  auto model = std::make_shared<SimModel>();
  const auto scene = BuildWorld("downtown_west", {});
  model->tracer = std::make_shared<const RayTracer>(scene);
  const auto street = model->tracer->Intersect(*scene->spawn, {0, 0, -1});
  ASSERT_TRUE(street);
  DroneSetup setup = HummingbirdAt(VecCast<double>(*scene->spawn) - Vec3d{0, 0, street->distance - 2.5});
  model->drones.push_back(std::make_shared<const SimDrone>(setup, model->dt_ns));
  SimState state = StartState(*model);
  const auto below = model->tracer->Intersect(VecCast<float>(setup.X_WB.p), {0, 0, -1});
  ASSERT_TRUE(below);
  const auto events = Fly(*model, state, 0, LandCommand{}, 8);
  EXPECT_NE(FindEvent(events, Kind::kCommandDone), nullptr);
  EXPECT_EQ(FindEvent(events, Kind::kCollision), nullptr);
  const Entity& ground = scene->entity(LabelOf(*model->tracer, below->surface).entity);
  EXPECT_EQ(scene->tree[ground.category].path.substr(0, 6), "ground") << ground.name;
  EXPECT_NEAR(BottomOf(*model, state.vehicles[0]), setup.X_WB.p.z - below->distance, 0.05);
  EXPECT_LT(Norm(state.vehicles[0].drone.v_WB), 0.02);
}

TEST(ShelterFactor, IsLowBehindAWallAndOneWhereNothingStandsUpwind) {
  const RayTracer& room = *internal::TestRoom();
  const double close = ShelterFactor(room, {4.5, 0, 3}, {-5, 0, 0});
  const double far = ShelterFactor(room, {-4.5, 0, 3}, {-5, 0, 0});
  EXPECT_LT(close, far);
  EXPECT_NEAR(close, 1 - 0.8 * std::exp(-0.5 / 25), 0.01);
  EXPECT_EQ(ShelterFactor(room, {0, 0, 20}, {3, 3, 0}), 1);  // above the roof
  EXPECT_EQ(ShelterFactor(room, {0, 0, 3}, {}), 1);
}

}  // namespace
}  // namespace airsim360
