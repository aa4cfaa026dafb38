#include "airsim360/tasks/gym/vector_environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/flight/drones/catalog.h"

namespace airsim360 {
namespace {

std::shared_ptr<Stage> Room() {
  static const auto room = std::make_shared<Stage>(StageOptions{.world = {.world = "box_room"}, .device = {.device = "cpu"}});
  return room;
}

// Labels are made quickly; one test looks at colours.
VectorEnvironmentOptions Options(int count, Tier tier = Tier::kLabels) {
  VectorEnvironmentOptions options;
  options.picture.tier = tier;
  options.rgb = tier != Tier::kLabels;
  options.count = count;
  options.drone = CatalogModel("hummingbird");
  options.width = 64;
  options.height = 32;
  return options;
}

NavigationTask Task(NavigationKind kind) {
  NavigationTask task{.kind = kind};
  task.seconds = 5;
  if (kind == NavigationKind::kSearch) task.goal_radius = 3;
  return task;
}

std::vector<float> Repeat(const VectorEnvironment& e, std::initializer_list<float> action) {
  std::vector<float> all;
  for (int i = 0; i < e.count(); ++i) all.insert(all.end(), action);
  return all;
}

// Everything that a learner sees.
struct Seen {
  std::vector<Rgb8> rgb;
  std::vector<float> range, state, reward;
  uint64_t hash;
  bool operator==(const Seen&) const = default;
};
template <class T>
std::vector<T> Copy(std::span<const T> span) {
  return {span.begin(), span.end()};
}
Seen Look(const VectorEnvironment& e) { return {Copy(e.rgb()), Copy(e.range()), Copy(e.state()), Copy(e.reward()), e.Hash()}; }

TEST(VectorEnvironment, SameSeedAndActionsGiveTheSameBytesWithAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    VectorEnvironment e(Room(), Task(NavigationKind::kAvoid), Options(3, Tier::kFast));
    std::vector<Seen> seen = {Look(e)};
    RngStream random(7, "test");
    for (int step = 0; step < 12; ++step) {
      std::vector<float> actions(12);
      for (float& a : actions) a = static_cast<float>(random.Uniform(-1, 1));
      e.Step(actions);
      seen.push_back(Look(e));
    }
    return seen;
  };
  const auto one = run(1), two = run(2);
  EXPECT_TRUE(one == two);
  EXPECT_FALSE(one.front() == one.back());
}

TEST(VectorEnvironment, ResetWithASeedIsExactWhateverHappenedBefore) {
  VectorEnvironment e(Room(), Task(NavigationKind::kReach), Options(2));
  e.Reset(11);
  const Seen first = Look(e);
  for (int step = 0; step < 5; ++step) e.Step(Repeat(e, {1, 0.5f, -0.2f, 1}));
  EXPECT_FALSE(first == Look(e));
  e.Reset({});
  EXPECT_FALSE(first == Look(e)) << "without a seed the next episode begins";
  e.Reset(11);
  EXPECT_TRUE(first == Look(e));
  e.Reset(12);
  EXPECT_FALSE(first == Look(e));
}

TEST(VectorEnvironment, AnEnvironmentDoesNotDependOnHowManyThereAre) {
  VectorEnvironment few(Room(), Task(NavigationKind::kReach), Options(1));
  VectorEnvironment many(Room(), Task(NavigationKind::kReach), Options(4));
  few.Step(Repeat(few, {0.5f, 0, 0, 0.3f}));
  many.Step(Repeat(many, {0.5f, 0, 0, 0.3f}));
  EXPECT_TRUE(std::ranges::equal(few.range(), many.range().first(few.range().size())));
  EXPECT_TRUE(std::ranges::equal(few.state(), many.state().first(few.state().size())));
}

TEST(VectorEnvironment, StateHoldsTheGoalInTheLevelFrame) {
  VectorEnvironment e(Room(), Task(NavigationKind::kReach), Options(8));
  for (int step = 0; step < 3; ++step) e.Step(Repeat(e, {0.4f, 0.4f, 0, 0.8f}));
  for (int i = 0; i < e.count(); ++i) {
    if (e.terminated()[i]) continue;
    const float* s = &e.state()[static_cast<size_t>(i) * StateColumns::kCount];
    const Kinematics& motion = e.sim_state(i).vehicles[0].motion;
    // Back from L to W by the heading that the state tells.
    const double c = s[StateColumns::kHeading], n = s[StateColumns::kHeading + 1];
    const Vec3d goal = motion.X_WB.p + Vec3d{c * s[0] - n * s[1], n * s[0] + c * s[1], s[2]};
    EXPECT_LT(Norm(goal - e.episode(i).goal_W), 1e-4);
    const float* v = s + StateColumns::kVelocity;
    EXPECT_LT(Norm(Vec3d{c * v[0] - n * v[1], n * v[0] + c * v[1], v[2]} - motion.v_WB), 1e-4);
    EXPECT_NEAR(e.distance()[i], std::hypot(s[0], s[1], s[2]), 1e-4);
    EXPECT_NEAR(s[StateColumns::kTimeLeft], 1 - 0.3 / 5, 1e-6);
  }
}

TEST(VectorEnvironment, FlyingTowardsTheGoalReachesItAndEarnsTheWay) {
  VectorEnvironment e(Room(), Task(NavigationKind::kReach), Options(8));
  const std::vector<float> begun = Copy(e.distance());
  std::vector<double> earned(8);
  int reached = 0;
  std::vector<bool> done(8);
  for (int step = 0; step < 50; ++step) {
    std::vector<float> actions;
    for (int i = 0; i < 8; ++i) {
      const float* s = &e.state()[static_cast<size_t>(i) * StateColumns::kCount];
      const float length = std::max(1.0f, std::hypot(s[0], s[1], s[2]));
      for (int axis = 0; axis < 3; ++axis) actions.push_back(0.6f * s[axis] / length);
      actions.push_back(0);
    }
    e.Step(actions);
    for (size_t i = 0; i < 8; ++i) {
      if (done[i]) continue;
      earned[i] += static_cast<double>(e.reward()[i]);
      if (!e.terminated()[i] && !e.truncated()[i]) continue;
      done[i] = true;
      if (!e.reached()[i]) continue;
      ++reached;
      // The way, the goal's reward, and the cost of the steps: nothing else.
      const double expected = begun[i] - e.distance()[i] + 10 - 0.01 * static_cast<double>(e.steps()[i]);
      EXPECT_NEAR(earned[i], expected, 1e-3);
      EXPECT_LE(e.distance()[i], 1.0f);
    }
  }
  EXPECT_GE(reached, 5);  // straight on; the cube of the room may be in the way
}

TEST(VectorEnvironment, AWallEndsTheEpisodeAndTheNextStepBeginsAnother) {
  VectorEnvironment e(Room(), Task(NavigationKind::kReach), Options(1));
  int steps = 0;
  while (!e.terminated()[0] && !e.truncated()[0] && steps < 60) {
    e.Step(Repeat(e, {0, 0, -1, 0}));  // down to the floor
    ++steps;
  }
  ASSERT_TRUE(e.crashed()[0] || e.reached()[0]);
  const NavigationEpisode before = e.episode(0);
  e.Step(Repeat(e, {0, 0, 0, 0}));
  EXPECT_EQ(e.steps()[0], 0);
  EXPECT_EQ(e.reward()[0], 0);
  EXPECT_FALSE(e.terminated()[0]);
  EXPECT_GT(Norm(e.episode(0).X_WB.p - before.X_WB.p), 0);
}

TEST(VectorEnvironment, WithoutAutomaticResetAStepAfterTheEndIsAnError) {
  VectorEnvironmentOptions options = Options(1);
  options.auto_reset = false;
  NavigationTask task = Task(NavigationKind::kReach);
  task.seconds = 0.2;
  VectorEnvironment e(Room(), task, options);
  e.Step(Repeat(e, {0, 0, 0, 0}));
  EXPECT_FALSE(e.truncated()[0]);
  e.Step(Repeat(e, {0, 0, 0, 0}));
  ASSERT_TRUE(e.truncated()[0] || e.terminated()[0]);
  EXPECT_THROW(e.Step(Repeat(e, {0, 0, 0, 0})), InputError);
  e.Reset({});
  EXPECT_NO_THROW(e.Step(Repeat(e, {0, 0, 0, 0})));
}

TEST(VectorEnvironment, BadActionsAreRefusedAndChangeNothing) {
  VectorEnvironment e(Room(), Task(NavigationKind::kReach), Options(2));
  const Seen before = Look(e);
  std::vector<float> actions(8);
  actions[6] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(e.Step(actions), InputError);
  actions.resize(7);
  EXPECT_THROW(e.Step(actions), InputError);
  EXPECT_TRUE(before == Look(e));
}

TEST(VectorEnvironment, ASearchIsOverWhenTheTargetIsSeenFromNear) {
  NavigationTask task = Task(NavigationKind::kSearch);
  task.goal_radius = 20;  // of the room: as soon as the cube is in sight
  VectorEnvironment e(Room(), task, Options(4));
  const Scene& scene = Room()->scene();
  for (const EntityId target : e.world().targets()) EXPECT_TRUE(scene.tree[scene.entity(target).category].thing);
  e.Step(Repeat(e, {0, 0, 0, 0}));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(e.reached()[i]) << "there is nothing in the room to hide behind";
  task.goal_radius = 0.06;  // nearer than a drone can be
  VectorEnvironment far(Room(), task, Options(4));
  far.Step(Repeat(far, {0, 0, 0, 0}));
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(far.reached()[i]);
    EXPECT_NEAR(far.reward()[i], 0.1 - 0.01, 1e-6);
  }
}

TEST(VectorEnvironment, RotorSignalsAndRatesFly) {
  for (const ActionLevel level : {ActionLevel::kRotors, ActionLevel::kRates}) {
    VectorEnvironmentOptions options = Options(1);
    options.action = level;
    VectorEnvironment e(Room(), Task(NavigationKind::kReach), options);
    e.Step(Repeat(e, {-1, level == ActionLevel::kRates ? 0.0f : -1.0f, level == ActionLevel::kRates ? 0.0f : -1.0f,
                      level == ActionLevel::kRates ? 0.0f : -1.0f}));
    // Without thrust for 0.1 s it falls at nearly g t; the rotors take their time to stop.
    const double v = e.sim_state(0).vehicles[0].motion.v_WB.z;
    EXPECT_LT(v, -0.3);
    EXPECT_GT(v, -0.1 * kGravity - 1e-9);
  }
}

TEST(NavigationWorld, EpisodesStartFreeAndKeepTheirDistance) {
  NavigationTask task = Task(NavigationKind::kReach);
  task.least_distance = 3;
  task.most_distance = 6;
  const NavigationWorld world(Room()->solid(), task);
  for (uint64_t i = 0; i < 200; ++i) {
    const NavigationEpisode episode = world.Sample(5, i, 2 * i);
    for (const Vec3d p : {episode.X_WB.p, episode.goal_W})
      EXPECT_GE(Room()->solid()->Clearance(VecCast<float>(p), 5), 0.5 * task.clearance - 1e-5);
    const double distance = Norm(episode.goal_W - episode.X_WB.p);
    EXPECT_GE(distance, task.least_distance - task.clearance);
    EXPECT_LE(distance, task.most_distance + task.clearance);
  }
}

TEST(NavigationWorld, SomethingIsInTheWayOfMostAvoidEpisodes) {
  const NavigationWorld world(Room()->solid(), Task(NavigationKind::kAvoid));
  int blocked = 0;
  for (uint64_t i = 0; i < 100; ++i) {
    const NavigationEpisode episode = world.Sample(5, 0, i);
    blocked += Room()->solid()->Occluded(VecCast<float>(episode.X_WB.p), VecCast<float>(episode.goal_W));
  }
  EXPECT_GE(blocked, 80);
}

TEST(NavigationWorld, WrongTasksAreNamed) {
  NavigationTask task = Task(NavigationKind::kSearch);
  task.target = "no/such/thing";
  EXPECT_THROW(NavigationWorld(Room()->solid(), task), InputError);
  task = Task(NavigationKind::kReach);
  task.clearance = -1;
  EXPECT_THROW(NavigationWorld(Room()->solid(), task), InputError);
  EXPECT_THROW(ParseNavigationKind("raech"), InputError);
}

}  // namespace
}  // namespace airsim360
