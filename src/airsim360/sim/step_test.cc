#include "airsim360/sim/step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/routes/survey.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

// The analytic room, traced once for all tests.
std::shared_ptr<const RayTracer> Room() {
  static const auto tracer = std::make_shared<const RayTracer>(BuildWorld("box_room", {}));
  return tracer;
}

std::shared_ptr<const Route> RoomRoute(uint64_t seed = 0) { return std::make_shared<const Route>(PlanSurvey(*Room(), {.seed = seed})); }

SimState RoomState(const SimModel& model) {
  SimState state;
  state.vehicles.push_back(VehicleAt(model, BodyPose({0, 0, 2}, 0, 0, 0)));
  return state;
}

// Steps `n` times, giving the route at the first step.
void Advance(const SimModel& model, const std::shared_ptr<const Route>& route, int n, SimState& state) {
  const std::vector<SimCommand> commands = {{0, route}};
  for (int i = 0; i < n; ++i) Step(model, i == 0 && route ? std::span(commands) : std::span<const SimCommand>(), state);
}

TEST(Step, ThousandStepsGiveTheSameHashEveryTime) {
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs};
  SimState a = RoomState(model), b = RoomState(model);
  Advance(model, RoomRoute(), 1000, a);
  Advance(model, RoomRoute(), 1000, b);
  EXPECT_EQ(HashState(a), HashState(b));
  EXPECT_EQ(a.step, 1000);
  EXPECT_EQ(a.t_ns, 1000 * model.dt_ns);
}

TEST(Step, ARestoredSnapshotContinuesWithTheSameBytes) {
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs};
  SimState state = RoomState(model);
  Advance(model, RoomRoute(), 400, state);
  const SimState snapshot = state;
  Advance(model, nullptr, 600, state);
  const uint64_t hash = HashState(state);
  EXPECT_NE(hash, HashState(snapshot));
  state = snapshot;
  Advance(model, nullptr, 600, state);
  EXPECT_EQ(HashState(state), hash);
}

TEST(Step, HashSeesEveryPartOfTheState) {
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs};
  const SimState state = RoomState(model);
  std::vector<SimState> changed(7, state);
  changed[0].step = 1;
  changed[1].t_ns = 1;
  changed[2].vehicles[0].motion.X_WB.p.y += 1e-12;
  changed[3].vehicles[0].motion.v_WB.z = 1;
  changed[4].vehicles[0].a_WB.x = 1;
  changed[5].vehicles[0].clearance += 0.5f;
  changed[6].vehicles[0].motion.w_WB_B.z = 1;
  for (const SimState& other : changed) EXPECT_NE(HashState(other), HashState(state));
}

TEST(Step, ClearanceIsTheDistanceToTheNearestSurface) {
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs, .contact_range = 10};
  EXPECT_NEAR(VehicleAt(model, BodyPose({-4.25, 0, 3}, 0, 0, 0)).clearance, 0.75, 1e-5);
  EXPECT_NEAR(VehicleAt(model, BodyPose({3, 0, 2}, 0, 0, 0)).clearance, 1, 1e-5);  // above the box
}

TEST(Step, RefusesACommandForAVehicleThatDoesNotExist) {
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs};
  SimState state = RoomState(model);
  const std::vector<SimCommand> commands = {{3, RoomRoute()}};
  EXPECT_THROW(Step(model, commands, state), InputError);
}

TEST(PlanSurvey, KeepsClearOfEverySurfaceAndVisitsManyHeights) {
  for (uint64_t seed = 0; seed < 3; ++seed) {
    const auto route = RoomRoute(seed);
    double low = 1e9, high = -1e9;
    for (double t = 0; t <= route->duration(); t += 0.05) {
      const Vec3d p = route->At(t).p;
      ASSERT_GE(Room()->Clearance(VecCast<float>(p), 2), 1.0f) << "seed " << seed << ", t " << t;
      ASSERT_LT(std::max(std::abs(p.x), std::abs(p.y)), 4.0);
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
    EXPECT_LT(low, 2.0);
    EXPECT_GT(high, 4.0);
  }
}

TEST(PlanSurvey, IsAFunctionOfWorldAndSeedAlone) {
  const auto a = RoomRoute(4);
  const ThreadLimit one(1);
  const auto b = RoomRoute(4), c = RoomRoute(5);
  ASSERT_EQ(a->nodes().size(), b->nodes().size());
  for (size_t i = 0; i < a->nodes().size(); ++i) {
    EXPECT_EQ(a->nodes()[i].p, b->nodes()[i].p);
    EXPECT_EQ(a->nodes()[i].t, b->nodes()[i].t);
  }
  EXPECT_NE(a->duration(), c->duration());
}

TEST(PlanSurvey, GoesAroundASingleModelInTheOpen) {
  // A pillar of 1 x 1 x 4 m under the sky, without any ground.
  SceneBuilder builder("pillar");
  builder.AddSky();
  const EntityId pillar = builder.AddEntity("pillar", builder.tree().At("construction/pillar"));
  MeshBuilder shape;
  shape.Box({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 4});
  builder.AddInstance({.mesh = builder.AddMesh(shape.Finish("pillar")), .X_WM = {}, .entity = pillar});
  const RayTracer tracer(builder.Build());
  const Route route = PlanSurvey(tracer, {});
  bool side[4] = {};
  for (double t = 0; t <= route.duration(); t += 0.1) {
    const Vec3d p = route.At(t).p;
    ASSERT_GE(tracer.Clearance(VecCast<float>(p), 2), 1.0f) << t;
    side[0] |= p.x > 2;
    side[1] |= p.x < -2;
    side[2] |= p.y > 2;
    side[3] |= p.y < -2;
  }
  for (bool seen : side) EXPECT_TRUE(seen);
}

TEST(FlyRoute, TakesEveryShotAtItsTimeOnTheRoute) {
  const auto route = RoomRoute();
  const SimModel model{.tracer = Room(), .dt_ns = kRouteStepNs};
  const std::vector<int64_t> times = EvenTimes(*route, 7);
  const Flight flight = FlyRoute(model, route, times);
  ASSERT_EQ(flight.shots.size(), 7u);
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_LE(std::abs(flight.shots[i].t_ns - times[i]), model.dt_ns / 2);
    const Vec3d expected = route->At(static_cast<double>(flight.shots[i].t_ns) * 1e-9).p;
    EXPECT_LT(Norm(flight.shots[i].body.X_WB.p - expected), 1e-12);
  }
  EXPECT_GE(flight.least_clearance, 1.0);
}

TEST(TrajectoryCsv, NumbersReadBackExactly) {
  const Flight flight = FlyRoute({.tracer = Room(), .dt_ns = kRouteStepNs}, RoomRoute(), std::vector<int64_t>{0});
  std::istringstream csv(TrajectoryCsv(flight));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "t_s,px,py,pz,vx,vy,vz,ax,ay,az,qw,qx,qy,qz");
  size_t row = 0;
  while (std::getline(csv, line)) {
    double t, x, y, z;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &t, &x, &y, &z), 4);
    const TrajectorySample& sample = flight.trajectory.at(row++);
    EXPECT_EQ(sample.body.X_WB.p, (Vec3d{x, y, z}));
    EXPECT_EQ(t, static_cast<double>(sample.t_ns) / 1e9);
  }
  EXPECT_EQ(row, flight.trajectory.size());
  EXPECT_GT(row, 100u);
}

}  // namespace
}  // namespace airsim360
