// Episodes made of hand-made worlds: what starts show, how a limit is shared out, where a flight in a room may end.
#include "airsim360/vln/episodes/make_episodes.h"

#include <gtest/gtest.h>

#include <map>

#include "airsim360/math/angles.h"
#include "airsim360/vln/predicates/entity_parts.h"
#include "airsim360/vln/predicates/test_town.h"

namespace airsim360 {
namespace {

constexpr const char* kBench = "furniture/seating/bench";

VlnMade Made(const std::shared_ptr<Stage>& stage, VlnMakeOptions options) {
  options.open = [&](uint64_t) { return stage; };
  options.world = "made up";
  return MakeEpisodes(options);
}

std::string WrittenTo(const std::string& name, const std::string& templates) {
  const std::string file = testing::TempDir() + name;
  std::FILE* out = std::fopen(file.c_str(), "w");
  std::fputs(templates.c_str(), out);
  std::fclose(out);
  return file;
}

// A street with one thing of a size in the middle.
std::shared_ptr<Stage> Street(float size) {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {300, 300, 1}, -1);
  town.Box("crate", kBench, {0, 0, 0}, {size, size, size});
  return std::make_shared<Stage>(town.Build());
}

std::string Asked(const char* more) {
  return std::string(R"([{"id": "t", "text": "Fly to the crate ahead.", "query": {"noun": {"word": "crate", "names": ["crate"]},
    "predicates": [{"is": "bearing", "sector": "ahead"}, {"is": "nearest"}]}, "heading": "ahead")") +
         more + "}]";
}

TEST(MakeEpisodes, WordsThatTakeSightForGrantedBeginNearASmallThingOrNotAtAll) {
  const std::string in_sight = WrittenTo("in_sight.json", Asked(R"(, "in_sight": true)"));
  // 3 m: some 100 pixels from 30 m.
  const VlnMade large = Made(Street(3), {.templates = in_sight, .starts = 3});
  ASSERT_EQ(large.episodes.size(), 3u);
  EXPECT_EQ(large.episodes[0].radius, 20);
  // 0.8 m: 5 pixels from 30 m, 40 from 11 m.
  const VlnMade small = Made(Street(0.8f), {.templates = in_sight, .starts = 3});
  ASSERT_EQ(small.episodes.size(), 3u);
  for (const LanguageEpisode& e : small.episodes) {
    EXPECT_GE(e.seen.pixels, kInSight);
    EXPECT_LT(e.radius, 10);
    EXPECT_GT(e.geodesic_length, e.radius) << "whoever hovers where it begins has not arrived";
  }
  // 0.1 m: none from anywhere. It is refused, and said how much there is.
  const VlnMade tiny = Made(Street(0.1f), {.templates = in_sight, .starts = 3});
  EXPECT_TRUE(tiny.episodes.empty());
  ASSERT_EQ(tiny.unbound.size(), 3u);
  EXPECT_NE(tiny.unbound[0].why.find("24 are needed"), std::string::npos) << tiny.unbound[0].why;
}

TEST(MakeEpisodes, AFirstStartOutOfSightIsSaid) {
  const VlnMade tiny = Made(Street(0.1f), {.templates = WrittenTo("hidden.json", Asked("")), .starts = 3});
  EXPECT_EQ(tiny.episodes.size(), 3u);
  ASSERT_EQ(tiny.hidden.size(), 1u);
  EXPECT_EQ(tiny.hidden[0].start, 0);
  EXPECT_NE(tiny.hidden[0].why.find("pixels"), std::string::npos);
}

// A junction of streets; a booth at its north-eastern corner, behind a wall for whoever is in the middle.
TEST(MakeEpisodes, WhatIsSeenAtAnIntersectionIsSeenFromOverIt) {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {300, 300, 1}, -1);
  town.Box("junction main", "ground/road", {0, 0, 0}, {24, 24, 0.02f}, 0);
  town.Box("wall", "construction/wall", {14, 5, 0}, {1, 6, 6});
  town.Box("booth", "furniture/mail/post_box", {20, 10, 0}, {1, 1, 2.4f});
  const auto stage = std::make_shared<Stage>(town.Build());
  const auto asked = [](const char* more) {
    return std::string(R"([{"id": "t", "text": "At the intersection, you'll see a booth on your right.", "frame": "turn",
      "query": {"noun": {"word": "booth", "names": ["booth"]}, "predicates": [{"is": "bearing", "sector": "right", "at_turn": true},
      {"is": "nearest", "at_turn": true}]})") +
           more + "}]";
  };
  const VlnMade seen = Made(stage, {.templates = WrittenTo("seen_at_turn.json", asked(R"(, "in_sight": true)")), .starts = 3});
  ASSERT_EQ(seen.episodes.size(), 3u);
  const auto shows = [&](Vec3d from) {
    for (const double u : {-0.45, 0.0, 0.45})
      for (const double z : {0.2, 1.2, 2.3}) {
        const Vec3d to{20 + u, 10 - u, z};
        const auto hit = stage->solid()->Intersect(VecCast<float>(from), VecCast<float>(to - from), 1);
        if (hit && stage->scene().entity(EntityAt(stage->scene(), hit->surface)).name == "booth") return true;
      }
    return false;
  };
  EXPECT_FALSE(shows({0, 0, 2}) || shows({0, 0, 8}));
  for (const LanguageEpisode& e : seen.episodes) {
    EXPECT_TRUE(shows(e.turn->p_W));
    EXPECT_LE(std::max(std::abs(e.turn->p_W.x), std::abs(e.turn->p_W.y)), 12 + 16) << "over the junction and its crossings";
    const Vec3d on = e.turn->p_W - e.start.p_W;
    EXPECT_NEAR(std::abs(std::remainder(std::atan2(on.y, on.x) - e.start.yaw, 2 * kPi)), 0, 1e-3) << "on the way ahead";
  }
  // Who only turns there does so in its middle.
  const VlnMade turned = Made(stage, {.templates = WrittenTo("turned.json", asked("")), .starts = 3});
  ASSERT_FALSE(turned.episodes.empty());
  for (const LanguageEpisode& e : turned.episodes) EXPECT_NEAR(std::hypot(e.turn->p_W.x, e.turn->p_W.y), 0, 1e-6);
}

TEST(MakeEpisodes, ALimitIsSharedAmongNouns) {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {300, 300, 1}, -1);
  town.Box("bench", kBench, {0, 0, 0}, {2, 2, 2});
  town.Box("post box", "furniture/mail/post_box", {60, 0, 0}, {2, 2, 3});
  town.Box("kiosk", "furniture/vending/food_stall", {0, 60, 0}, {3, 3, 3});
  const auto stage = std::make_shared<Stage>(town.Build());
  const auto nouns = [&](int64_t limit) {
    std::map<std::string, int> count;
    for (const LanguageEpisode& e : Made(stage, {.templates = "any", .starts = 3, .limit = limit}).episodes) ++count[e.query.noun.word];
    return count;
  };
  EXPECT_EQ(nouns(3).size(), 3u);
  int sum = 0;
  for (const auto& [noun, count] : nouns(6)) {
    EXPECT_GE(count, 1) << noun;
    sum += count;
  }
  EXPECT_EQ(sum, 6) << "instructions that cannot be given leave room for others";
}

// A room whose door a screen hides, and behind it a small room that one thing takes up from wall to wall, as stairs do.
std::shared_ptr<Stage> Stairwell() {
  TestTown town;
  town.Box("floor", "ground/floor", {0, 0, 0}, {20, 12, 0.2f}, -0.2f);
  town.Box("ceiling", "construction/ceiling", {0, 0, 0}, {20, 12, 0.2f}, 3);
  for (const float side : {-1.0f, 1.0f}) {
    town.Box("wall", "construction/wall", {side * 8, 0, 0}, {0.2f, 8, 3});
    town.Box("wall", "construction/wall", {0, side * 4, 0}, {16, 0.2f, 3});
    town.Box("wall", "construction/wall", {0, side * 2.3f, 0}, {0.2f, 3.4f, 3});  // a door of 1.2 m is left
    town.Box("wall", "construction/wall", {3, side * 2, 0}, {6, 0.2f, 3});
  }
  town.Box("wall", "construction/wall", {6, 0, 0}, {0.2f, 4, 3});
  town.Box("screen", "construction/wall", {-1.1f, 0, 0}, {0.1f, 3.2f, 3});
  town.Boxes("stairs", "construction/stairs", 2, {0.9f, -1.3f, 0}, {4, 2.6f, 0}, {1, 1, 1});
  return std::make_shared<Stage>(town.BuildRoom());
}

TEST(MakeEpisodes, WhatFillsARoomIsReachedWithinIt) {
  const std::string file = WrittenTo("stairs.json", R"([{"id": "t", "text": "Fly to the stairs.", "distance": [2, 7], "height": [1, 2],
    "goal_distance": 1, "query": {"noun": {"word": "stairs", "names": ["stairs"]}, "predicates": [{"is": "nearest"}]}}])");
  const VlnMade made = Made(Stairwell(), {.templates = file, .starts = 3});
  ASSERT_EQ(made.episodes.size(), 3u) << (made.unbound.empty() ? "" : made.unbound[0].why);
  for (const LanguageEpisode& e : made.episodes) {
    EXPECT_GT(e.goal.x, 0) << "behind the door, for nothing of them is seen before it";
    EXPECT_LT(std::abs(e.goal.y), 2);
  }
}

// A hall with a long counter on its floor.
std::shared_ptr<Stage> Hall() {
  TestTown town;
  town.Box("floor", "ground/floor", {0, 0, 0}, {24, 16, 0.2f}, -0.2f);
  town.Box("ceiling", "construction/ceiling", {0, 0, 0}, {24, 16, 0.2f}, 3);
  for (const float side : {-1.0f, 1.0f}) {
    town.Box("wall", "construction/wall", {side * 12, 0, 0}, {0.2f, 16, 3});
    town.Box("wall", "construction/wall", {0, side * 8, 0}, {24, 0.2f, 3});
  }
  town.Box("counter", "furniture/counter", {0, 0, 0}, {8, 1, 1});
  return std::make_shared<Stage>(town.BuildRoom());
}

TEST(MakeEpisodes, InRoomsAnyFreePlaceBesideAThingIsItsGoal) {
  const auto stage = Hall();
  const std::string file = WrittenTo("counter.json", R"([{"id": "t", "text": "Fly to the counter.", "distance": [3, 8], "height": [1, 2],
    "goal_distance": 1, "query": {"noun": {"word": "counter", "names": ["counter"]}, "predicates": [{"is": "nearest"}]}}])");
  const VlnMade made = Made(stage, {.templates = file, .starts = 3});
  ASSERT_FALSE(made.episodes.empty());
  for (const LanguageEpisode& e : made.episodes) {
    // Both ends of it, both sides and above, and nowhere else.
    for (const Vec3d end : {Vec3d{-4.8, 0, 1}, Vec3d{4.8, 0, 1}, Vec3d{0, 1.3, 1}, Vec3d{0, -1.3, 1}, Vec3d{0, 0, 1.8}})
      EXPECT_TRUE(std::ranges::any_of(e.places, [&](Vec3d p) { return Norm(p - end) <= e.radius; })) << end.x << " " << end.y;
    for (const Vec3d& p : e.places) EXPECT_LE(std::max({std::abs(p.x) - 4, std::abs(p.y) - 0.5, p.z - 1}), 1.01);
    const LanguageEpisode read = ParseEpisodeLine(EpisodeLine(e), "line");
    EXPECT_EQ(read.places, e.places);
  }
  EXPECT_TRUE(CheckEpisodes(made.episodes, [&](const std::string&, uint64_t) { return stage; }).empty());
  // What is not at the thing is found.
  std::vector<LanguageEpisode> moved = made.episodes;
  moved[0].places.push_back({10, 6, 1.5});
  const auto complaints = CheckEpisodes(moved, [&](const std::string&, uint64_t) { return stage; });
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_NE(complaints[0].what.find("place"), std::string::npos) << complaints[0].what;
  // So is what is on another storey, right above it.
  moved = made.episodes;
  moved[0].places.push_back({0, 0, 5});
  const auto above = CheckEpisodes(moved, [&](const std::string&, uint64_t) { return stage; });
  ASSERT_EQ(above.size(), 1u);
  EXPECT_NE(above[0].what.find("above or below"), std::string::npos) << above[0].what;
}

}  // namespace
}  // namespace airsim360
