// Episodes made of hand-made worlds: what starts show, how a limit is shared out, where a flight in a room may end.
#include "airsim360/vln/episodes/make_episodes.h"

#include <gtest/gtest.h>

#include <map>

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
}

}  // namespace
}  // namespace airsim360
