// Episodes: what actions do, how episodes end, how they are scored.
#include "airsim360/tasks/agent_server/episode.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

std::shared_ptr<AgentWorld> Room() {
  static const auto room = std::make_shared<AgentWorld>(std::make_shared<Stage>(StageOptions{.world = {.world = "box_room"}}));
  return room;
}

EpisodeSpec InTheRoom(Vec3d start = {-3, 0, 2}, double yaw = 0) {
  EpisodeSpec spec;
  spec.start = start;
  spec.start_yaw = yaw;
  spec.goal = Vec3d{3, 3, 3};
  spec.presets = {.forward = 1, .lateral = 1, .vertical = 1};
  spec.speed = 2;
  return spec;
}

Vec3d Place(const Episode& episode) { return episode.vehicle().motion.X_WB.p; }
double Heading(const Episode& episode) { return HeadingOfBody(episode.vehicle().motion.X_WB); }

TEST(PlanAction, ARelativeGoalIsWhereTheLevelPanoramaShowsIt) {
  const AgentPose from{{1, 2, 3}, kPi / 2};  // looks north
  const auto plan = PlanAction(RelativeGoalAction{.azimuth = kPi / 2, .elevation = 0, .distance = 4}, from, {}, 3);
  // To the right of north is east.
  EXPECT_NEAR(plan.target->p_W.x, 5, 1e-12);
  EXPECT_NEAR(plan.target->p_W.y, 2, 1e-12);
  EXPECT_NEAR(plan.target->yaw, 0, 1e-12);
  const auto up = PlanAction(RelativeGoalAction{.elevation = kPi / 2, .distance = 4, .face = false}, from, {}, 3);
  EXPECT_NEAR(Norm(up.target->p_W - Vec3d{1, 2, 7}), 0, 1e-12);
}

TEST(Episode, PresetsMoveByTheirSizesInTheHeadingFrame) {
  Episode episode(Room(), InTheRoom({-3, -2, 2}, kPi / 2));
  const Vec3d start = Place(episode);
  const std::pair<Preset, Vec3d> moves[] = {{Preset::kForward, {0, 1, 0}},  {Preset::kRight, {1, 1, 0}}, {Preset::kUp, {1, 1, 1}},
                                            {Preset::kBackward, {1, 0, 1}}, {Preset::kLeft, {0, 0, 1}},  {Preset::kDown, {0, 0, 0}}};
  for (const auto& [preset, expected] : moves) {
    episode.Act(PresetAction{preset});
    EXPECT_LT(Norm(Place(episode) - start - expected), 0.3) << kPresetNames[static_cast<int>(preset)];
  }
  EXPECT_EQ(episode.steps(), 6);
  EXPECT_EQ(episode.end(), EpisodeEnd::kRunning);
}

TEST(Episode, TwentyFourTurnsOfFifteenDegreesAreAFullOne) {
  Episode episode(Room(), InTheRoom());
  episode.Act(PresetAction{Preset::kTurnLeft});
  EXPECT_NEAR(Heading(episode), kPi / 12, 0.05);
  for (int i = 1; i < 24; ++i) episode.Act(PresetAction{Preset::kTurnLeft});
  EXPECT_NEAR(Heading(episode), 0, 0.05);
  EXPECT_LT(Norm(Place(episode) - episode.start()), 0.3);
}

TEST(Episode, VelocityAndWaypointsGoWhereTheySay) {
  Episode episode(Room(), InTheRoom({-3, -3, 2}, kPi / 2));
  for (int i = 0; i < 4; ++i) episode.Act(VelocityAction{.v = {1, 0, 0}, .duration = 0.5});
  EXPECT_NEAR(episode.seconds(), 2, 1e-9);
  EXPECT_NEAR(episode.vehicle().motion.v_WB.y, 1, 0.1);
  EXPECT_NEAR(Place(episode).x, -3, 0.1);
  episode.Act(WaypointsAction{.points = {{-2, 0, 2}, {0, 2, 3}}, .speed = 2});
  EXPECT_LT(Norm(Place(episode) - Vec3d{0, 2, 3}), 0.5);
}

TEST(Episode, RatesReachTheRotors) {
  Episode episode(Room(), InTheRoom());
  for (int i = 0; i < 5; ++i) episode.Act(RatesAction{.w_B = {0, 0, 1}, .throttle = 0.6, .duration = 0.06});
  EXPECT_GT(episode.vehicle().motion.v_WB.z, 0.5);  // more throttle than hover takes climbs
  EXPECT_GT(Heading(episode), 0.05);                // and it turns left
}

TEST(Episode, StoppingNearTheGoalIsSuccessAndElsewhereIsNot) {
  EpisodeSpec spec = InTheRoom();
  spec.goal = Vec3d{-1, 0, 2};
  spec.success_radius = 0.5;
  Episode good(Room(), spec), bad(Room(), spec);
  good.Act(PresetAction{Preset::kForward});
  good.Act(PresetAction{Preset::kForward});
  good.Act(PresetAction{Preset::kStop});
  bad.Act(PresetAction{Preset::kStop});
  EXPECT_EQ(good.end(), EpisodeEnd::kStopped);
  EXPECT_TRUE(good.Score().success && good.Score().oracle_success);
  EXPECT_NEAR(good.Score().shortest_length, 2, 1e-9);
  EXPECT_NEAR(good.Score().path_length, 2, 0.4);
  EXPECT_NEAR(good.Score().spl, 2 / std::max(2.0, good.Score().path_length), 1e-12);
  EXPECT_GT(good.Score().ndtw, 0.6);
  EXPECT_LT(bad.Score().ndtw, good.Score().ndtw);
  EXPECT_FALSE(bad.Score().success || bad.Score().oracle_success);
  EXPECT_EQ(bad.Score().spl, 0);
  EXPECT_THROW(good.Act(PresetAction{Preset::kForward}), InputError);
  // Passing the goal without a word is oracle success alone.
  Episode passing(Room(), spec);
  for (int i = 0; i < 4; ++i) passing.Act(PresetAction{Preset::kForward});
  passing.Act(PresetAction{Preset::kStop});
  EXPECT_TRUE(passing.Score().oracle_success);
  EXPECT_FALSE(passing.Score().success);
}

TEST(Episode, GoalReachingEndsByItself) {
  EpisodeSpec spec = InTheRoom();
  spec.goal = Vec3d{0, 0, 2};
  spec.success = SuccessRule::kReach;
  Episode episode(Room(), spec);
  episode.Act(RelativeGoalAction{.distance = 5.5});
  EXPECT_EQ(episode.end(), EpisodeEnd::kReached);
  EXPECT_NEAR(episode.distance_to_goal(), 1, 0.05);  // at the rim of the default radius of rooms
  EXPECT_TRUE(episode.Score().success);
}

TEST(Episode, FlyingIntoAWallEndsItUnlessToldOtherwise) {
  EpisodeSpec spec = InTheRoom({-4, 0, 2}, kPi);
  Episode episode(Room(), spec);
  episode.Act(VelocityAction{.v = {2, 0, 0}, .duration = 3});
  EXPECT_EQ(episode.end(), EpisodeEnd::kCollision);
  EXPECT_LT(episode.seconds(), 3);
  EXPECT_EQ(episode.world().scene().entity(episode.vehicle().collision.entity).category, episode.world().scene().entity(3).category);
  spec.end_on_collision = false;
  Episode tough(Room(), spec);
  tough.Act(VelocityAction{.v = {2, 0, 0}, .duration = 3});
  EXPECT_EQ(tough.end(), EpisodeEnd::kRunning);
  EXPECT_GT(tough.vehicle().collision.count, 0u);
}

TEST(Episode, LimitsEndIt) {
  EpisodeSpec spec = InTheRoom();
  spec.max_steps = 2;
  Episode steps(Room(), spec);
  for (int i = 0; i < 2; ++i) steps.Act(PresetAction{Preset::kHover});
  EXPECT_EQ(steps.end(), EpisodeEnd::kMaxSteps);
  spec.max_seconds = 0.5;
  Episode seconds(Room(), spec);
  seconds.Act(PresetAction{Preset::kHover});
  EXPECT_EQ(seconds.end(), EpisodeEnd::kMaxSeconds);
  EXPECT_NEAR(seconds.seconds(), 0.5, 1e-9);
}

TEST(Episode, TheSameActionsGiveTheSameBytesAgainAfterAReset) {
  EpisodeSpec spec = InTheRoom();
  spec.seed = 7;
  const auto fly = [](Episode& episode) {
    episode.Act(RelativeGoalAction{.azimuth = 0.3, .elevation = 0.1, .distance = 2});
    episode.Act(VelocityAction{.v = {0.5, 0.5, 0}, .yaw_rate = 0.2, .duration = 0.7});
    return HashState(episode.state());
  };
  Episode one(Room(), spec), two(Room(), spec);
  const uint64_t first = fly(one);
  EXPECT_EQ(fly(two), first);
  two.Reset();
  EXPECT_EQ(two.steps(), 0);
  EXPECT_EQ(fly(two), first);
}

TEST(Episode, WithoutAGoalTheSeedChoosesAFreeOne) {
  EpisodeSpec spec = InTheRoom();
  spec.goal.reset();
  spec.seed = 3;
  Episode one(Room(), spec), same(Room(), spec);
  EXPECT_EQ(one.goal(), same.goal());
  EXPECT_GT(one.distance_to_goal(), 2 * one.success_radius());
  EXPECT_GE(Room()->stage().solid()->Clearance(VecCast<float>(one.goal()), 1), 0.25f);
  same.Reset(4);
  EXPECT_NE(one.goal(), same.goal());
}

TEST(Episode, WaitingFliesOnWithTheLastAction) {
  EpisodeSpec spec = InTheRoom();
  Episode episode(Room(), spec);
  episode.Act(VelocityAction{.v = {1, 0, 0}, .duration = 1});
  const double x = Place(episode).x;
  episode.Wait(0.5);
  EXPECT_NEAR(episode.seconds(), 1.5, 1e-9);
  EXPECT_NEAR(Place(episode).x - x, 0.5, 0.1);
  // But not for ever: the autopilot hovers when nothing follows.
  episode.Wait(5);
  EXPECT_LT(Norm(episode.vehicle().motion.v_WB), 0.2);
}

TEST(Episode, AStartInsideAThingNamesAFreePlace) {
  const std::pair<Vec3d, const char*> faults[] = {{{3, 0, 0.9}, "is inside of something solid"},
                                                  {{3, 0, 0.5}, "is inside of something solid"},
                                                  {{3, 0, 1.05}, "is 0.05 m from a surface"},
                                                  {{50, 0, 1}, "is outside the world"},
                                                  {{0, 0, -3}, "is outside the world"}};
  for (const auto& [start, fault] : faults) {
    try {
      Episode episode(Room(), InTheRoom(start));
      ADD_FAILURE() << start.x << " " << start.z;
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with("start.p: (")) << text;
      EXPECT_NE(text.find(std::string("is not free: it ") + fault), std::string::npos) << text;
      EXPECT_NE(text.find("the nearest free place known is ("), std::string::npos) << text;
    }
  }
  EpisodeSpec spec = InTheRoom();
  spec.drone = "humingbird";
  EXPECT_THROW(Episode(Room(), spec), InputError);
}

TEST(AgentWorld, TheRangeGridHoldsTheNearestWallOfEachSector) {
  // Looks along +x from the middle of the room; the sector ahead sees the wall at x = 5.
  const RangeGrid grid = Room()->Grid(BodyPose({0, 0, 3}, 0, 0, 0), 8, 16);
  EXPECT_NEAR(grid.range[3 * 16 + 8], 5, 0.02);
  EXPECT_NEAR(grid.range[0], 3, 0.02);       // ceiling
  EXPECT_NEAR(grid.range[7 * 16], 3, 0.02);  // floor
  // Turned left and rolled: the grid is level, the room is square.
  const RangeGrid turned = Room()->Grid(BodyPose({0, 0, 3}, kPi / 2, 0.3, 0.2), 8, 16);
  for (size_t i = 0; i < 16; ++i) EXPECT_NEAR(turned.range[3 * 16 + i], grid.range[3 * 16 + i], 0.05);
}

TEST(AgentWorld, AViewIsThePanoramaCutOut) {
  const RigidTransform X_WB = BodyPose({0, 1, 2}, 0.4, 0.2, 0.1);
  const Image<Rgb8> panorama = Room()->Panorama(X_WB, 1024);
  const Image<Rgb8> view = Room()->View(X_WB, kPi / 3, 0.1, kPi / 2, 65, 65);
  // The middle of the view is the panorama's pixel at that azimuth and elevation.
  const int x = static_cast<int>(1024 * (1.0 / 6 + 0.5)), y = static_cast<int>(512 * (0.5 - 0.1 / kPi));
  EXPECT_NEAR(view(32, 32).r, panorama(x, y).r, 12);
  EXPECT_NEAR(view(32, 32).g, panorama(x, y).g, 12);
  EXPECT_NEAR(view(32, 32).b, panorama(x, y).b, 12);
}

}  // namespace
}  // namespace airsim360
