// A world opened once: what is added, what is shared, what is refused before anything is loaded.
#include "airsim360/stage/stage.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/flight/drones/catalog.h"

namespace airsim360 {
namespace {

StageOptions Room() { return {.world = {.world = "box_room", .seed = 7}, .device = {.device = "cpu"}}; }

// A drone's body in front of the east wall (x = 5), where a ray from the middle of the room meets it.
BodiesOfScene OneDrone() {
  return [](const Scene&) {
    DroneBodySpec body;
    body.name = "watched";
    body.model = DroneBodyModel(CatalogModel("hummingbird"));
    body.X_WB = BodyPose({0, 3, 3}, 0, 0, 0);
    return std::vector<DroneBodySpec>{body};
  };
}

std::string MessageOf(const StageOptions& options) {
  try {
    CheckStageOptions(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Stage, IsTheWorldWithItsSeedAndWind) {
  StageOptions options = Room();
  options.wind.mean_W = {1, 2, 0};
  Stage stage(options);
  const SimModel model = stage.Model(4'000'000);
  EXPECT_EQ(stage.name(), "box_room");
  EXPECT_EQ(model.world.seed, 7u);
  EXPECT_EQ(model.dt_ns, 4'000'000);
  EXPECT_EQ(model.wind.mean_W.y, 2);
  EXPECT_EQ(model.people, nullptr);
  EXPECT_EQ(stage.StartState(), nullptr);
  // The room's inner faces are at x = ±5, y = ±5 (docs/reference/contracts.md).
  EXPECT_NEAR(model.tracer->Intersect({0, 0, 3}, {0, 1, 0})->distance, 5, 1e-5);
}

TEST(Stage, ShowsBodiesToCamerasAndNotToWhatVehiclesTouch) {
  StageOptions options = Room();
  const size_t without = Stage(options).scene().entities.size();
  options.bodies = OneDrone();
  Stage stage(options);
  ASSERT_EQ(stage.bodies().size(), 1u);
  EXPECT_EQ(stage.scene().entities.size(), without + 1);
  EXPECT_EQ(stage.scene().entity(stage.bodies()[0].entity).name, "watched");
  EXPECT_LT(stage.tracer()->Intersect({0, 0, 3}, {0, 1, 0})->distance, 3.01f);
  EXPECT_NEAR(stage.solid()->Intersect({0, 0, 3}, {0, 1, 0})->distance, 5, 1e-5);
}

TEST(Stage, SharesWhatStaysTheSame) {
  const auto base = std::make_shared<Stage>(Room());
  Stage same(base, {});
  EXPECT_EQ(same.tracer(), base->tracer());
  EXPECT_EQ(same.shared_scene(), base->shared_scene());
  // With a body it is a scene of its own, and the first one has not changed.
  Stage more(base, {}, OneDrone());
  EXPECT_NE(more.tracer(), base->tracer());
  EXPECT_EQ(more.scene().entities.size(), base->scene().entities.size() + 1);
  EXPECT_NEAR(base->tracer()->Intersect({0, 0, 3}, {0, 1, 0})->distance, 5, 1e-5);
}

TEST(Stage, KeepsARendererForEachTierAndGivesOthersAway) {
  Stage stage(Room());
  Renderer& labels = stage.renderer(Tier::kLabels);
  EXPECT_EQ(&stage.renderer(Tier::kLabels), &labels);
  EXPECT_NE(&stage.renderer(Tier::kFast), &labels);
  RenderRequest request{{}, Equirectangular{64, 32}, BodyPose({0, 0, 3}, 0, 0, 0) * CameraInBody()};
  request.tier = Tier::kFast;
  Frame kept, other;
  stage.renderer(Tier::kFast).Render(request, kept);
  stage.NewRenderer(Tier::kFast)->Render(request, other);
  EXPECT_TRUE(std::ranges::equal(kept.rgb.pixels(), other.rgb.pixels()));
}

TEST(Stage, PeopleStandWhereTheirLifeBegins) {
  StageOptions options = Room();
  options.people = {.count = 2, .warm_up = 0, .level = 3, .seed = 1};
  Stage stage(options);
  ASSERT_NE(stage.people(), nullptr);
  const auto state = stage.StartState();
  ASSERT_NE(state, nullptr);
  EXPECT_FALSE(state->moved.empty() && state->deformed.empty());
  EXPECT_EQ(stage.Model().people, stage.people());
  const auto peopled = std::make_shared<Stage>(options);
  EXPECT_THROW(Stage(peopled, {.count = 1}), InputError);
}

TEST(Stage, FlagsAreCheckedBeforeAWorldIsLoaded) {
  StageOptions options{.world = {.world = "no such world"}};
  options.environment.weather = "raining cats";
  EXPECT_NE(MessageOf(options).find("--weather"), std::string::npos) << MessageOf(options);
  EXPECT_THROW(Stage{options}, InputError);
  options.environment = {};
  options.device = {.device = "gpu"};
  EXPECT_NE(MessageOf(options).find("--device"), std::string::npos);
  options.device = {.device = "cpu", .gpu = 0};
  EXPECT_NE(MessageOf(options).find("--gpu"), std::string::npos);
  options.device = {};
  EXPECT_EQ(MessageOf(options), "");
}

TEST(Stage, TheEnvironmentIsTheWorldsWithWhatTheFlagsSay) {
  StageOptions options = Room();
  const Environment own = Stage(options).environment();
  options.environment.sun = "90,30";
  const Environment turned = Stage(options).environment();
  EXPECT_NE(own.sun_elevation_deg, turned.sun_elevation_deg);
  EXPECT_NEAR(turned.sun_elevation_deg, 30, 1e-9);
}

}  // namespace
}  // namespace airsim360
