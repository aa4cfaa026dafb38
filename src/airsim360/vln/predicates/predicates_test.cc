// Which thing is meant: hand-made towns with known answers, and the two methods against each other on towns that are drawn.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/vln/predicates/brute_force.h"
#include "airsim360/vln/predicates/query_json.h"
#include "airsim360/vln/predicates/test_town.h"

namespace airsim360 {
namespace {

constexpr const char* kBox = "furniture/mail/post_box";
constexpr const char* kBuilding = "construction/building";
constexpr const char* kTree = "vegetation/tree/broadleaf/generic";

Noun Named(const char* name) { return {.word = name, .names = {name}}; }
Predicate Is(PredicateKind kind) { return {.kind = kind}; }
Predicate Sector(const char* name) { return {.kind = PredicateKind::kBearing, .sector = name}; }

// The one entity that both methods find; kNoEntity if the first does not decide. Where it does, the second has to agree.
EntityId Meant(const std::shared_ptr<const Scene>& scene, const Query& query, const Standpoint& at) {
  SceneGraph graph(scene);
  const Verdict verdict = Decide(graph, query, at);
  if (!verdict.decided) {
    EXPECT_FALSE(verdict.why.empty());
    return kNoEntity;
  }
  BruteForce brute(scene);
  const auto answers = brute.Answers(query, at);
  EXPECT_EQ(answers.size(), 1u);
  if (answers.size() == 1) {
    EXPECT_EQ(answers[0], verdict.answers[0].entities);
  }
  return verdict.answers[0].entities[0];
}

TEST(SceneGraph, NamesMatchWithTheirNumbersAndPrefixesOnlyWhereAsked) {
  EXPECT_TRUE(NameMatches("lake", "lake"));
  EXPECT_TRUE(NameMatches("lake 12", "lake"));
  EXPECT_FALSE(NameMatches("lake edge", "lake"));
  EXPECT_FALSE(NameMatches("lakeside", "lake"));
  EXPECT_TRUE(NameMatches("lakeside", "lake*"));
  EXPECT_FALSE(NameMatches("lake ", "lake"));
}

TEST(SceneGraph, DistanceBoundsHoldTheFarthestAndNearestThatAFilledBoxCanBe) {
  const Box3d box{{-1, -2, 0}, {1, 2, 5}};
  const DistanceBounds bounds = PlanDistance({4, 0, 1}, box);
  EXPECT_DOUBLE_EQ(bounds.least, 3);
  // The near side, x = 1, is touched somewhere, at worst in a corner: hypot(3, 2).
  EXPECT_DOUBLE_EQ(bounds.most, std::hypot(3, 2));
}

TEST(Decide, TheNearestOfThreeIsTheOneAtTheShortestDistance) {
  TestTown town;
  town.Box("box", kBox, {20, 0, 0}, {1, 1, 1});
  const EntityId near = town.Box("box", kBox, {0, 8, 0}, {1, 1, 1});
  town.Box("box", kBox, {-30, -5, 0}, {1, 1, 1});
  EXPECT_EQ(Meant(town.Build(), {Named("box"), {Is(PredicateKind::kNearest)}}, {{{0, 0, 2}, 0}}), near);
}

TEST(Decide, TwoThatAreEquallyNearCompeteAndAreNamed) {
  TestTown town;
  town.Box("box", kBox, {10, 0, 0}, {1, 1, 1});
  town.Box("box", kBox, {-10.2f, 0, 0}, {1, 1, 1});
  SceneGraph graph(town.Build());
  const Verdict verdict = Decide(graph, {Named("box"), {Is(PredicateKind::kNearest)}}, {{{0, 0, 2}, 0}});
  EXPECT_FALSE(verdict.decided);
  EXPECT_NE(verdict.why.find("'box'"), std::string::npos) << verdict.why;
  EXPECT_NE(verdict.why.find("'box 2'"), std::string::npos) << verdict.why;
}

// 30 and 32 metres: more than half a metre apart, but nobody tells them in a picture.
TEST(Decide, TheNearestIsNearerByATenthForBothMethods) {
  const auto town = [](float second) {
    TestTown boxes;
    boxes.Box("box", kBox, {30, 0, 0}, {1, 1, 1});
    boxes.Box("box", kBox, {-second, 0, 0}, {1, 1, 1});
    return boxes.Build();
  };
  const Query query{Named("box"), {Is(PredicateKind::kNearest)}};
  const Standpoint at{{{0, 0, 2}, 0}};
  SceneGraph close(town(32));
  const Verdict verdict = Decide(close, query, at);
  EXPECT_FALSE(verdict.decided);
  EXPECT_NEAR(verdict.steps[0].needed, 2.95, 0.01);  // a tenth of the 29.5 m to its face, and a little for its corners
  EXPECT_EQ(BruteForce(town(32)).Answers(query, at).size(), 2u);
  EXPECT_NE(Meant(town(33), query, at), kNoEntity);
  // At 3 metres half a metre is needed, not 0.3.
  const Standpoint near{{{26.5, 0, 2}, 0}};
  TestTown pair;
  pair.Box("box", kBox, {30, 0, 0}, {1, 1, 1});
  pair.Box("box", kBox, {22.6f, 0, 0}, {1, 1, 1});
  EXPECT_EQ(BruteForce(pair.Build()).Answers(query, near).size(), 2u);
}

TEST(Decide, WhatIsAbsentIsSaidToBeAbsent) {
  TestTown town;
  town.Box("box", kBox, {10, 0, 0}, {1, 1, 1});
  SceneGraph graph(town.Build());
  const Verdict verdict = Decide(graph, {Named("fountain"), {Is(PredicateKind::kNearest)}}, {{{0, 0, 2}, 0}});
  EXPECT_FALSE(verdict.decided);
  EXPECT_EQ(verdict.why, "the world has no fountain");
}

TEST(Decide, SectorsAreSeenFromTheHeadingAndPositiveToTheRight) {
  TestTown town;
  const EntityId east = town.Box("box", kBox, {20, 0, 0}, {1, 1, 1}), north = town.Box("box", kBox, {0, 20, 0}, {1, 1, 1}),
                 west = town.Box("box", kBox, {-20, 0, 0}, {1, 1, 1}), south = town.Box("box", kBox, {0, -20, 0}, {1, 1, 1});
  const auto scene = town.Build();
  const auto at = [&](double yaw, const char* sector) { return Meant(scene, {Named("box"), {Sector(sector)}}, {{{0, 0, 1}, yaw}}); };
  EXPECT_EQ(at(0, "ahead"), east);
  EXPECT_EQ(at(0, "left"), north);
  EXPECT_EQ(at(0, "behind"), west);
  EXPECT_EQ(at(0, "right"), south);
  EXPECT_EQ(at(kPi / 2, "ahead"), north);
  EXPECT_EQ(at(kPi / 2, "right"), east);
  // Turned by an eighth, what was ahead is ahead to the right.
  EXPECT_EQ(at(kPi / 4, "ahead_right"), east);
  EXPECT_EQ(at(kPi / 4, "rear_left"), west);
  EXPECT_EQ(at(kPi / 4, "rear_right"), south);
}

TEST(Decide, WhatLiesOnTheEdgeOfASectorIsNotDecided) {
  TestTown town;
  town.Box("box", kBox, {20, -20, 0}, {1, 1, 1});  // 45 degrees to the right: ahead or right
  EXPECT_EQ(Meant(town.Build(), {Named("box"), {Sector("ahead")}}, {{{0, 0, 1}, 0}}), kNoEntity);
}

TEST(Decide, StraightAheadIsNarrowerThanAhead) {
  const auto meant = [](double degrees, const char* sector) {
    TestTown town;
    const double azimuth = degrees * kDegree;
    town.Box("box", kBox, {static_cast<float>(40 * std::cos(azimuth)), static_cast<float>(-40 * std::sin(azimuth)), 0}, {1, 1, 1});
    return Meant(town.Build(), {Named("box"), {Sector(sector)}}, {{{0, 0, 1}, 0}}) != kNoEntity;
  };
  EXPECT_TRUE(meant(8, "straight_ahead"));
  EXPECT_TRUE(meant(-8, "straight_ahead"));
  EXPECT_FALSE(meant(13, "straight_ahead"));  // within 4 degrees of the limit
  EXPECT_FALSE(meant(33, "straight_ahead"));
  EXPECT_TRUE(meant(33, "ahead"));
  // A hand is wider than a quarter: what one passes on it begins well ahead.
  EXPECT_TRUE(meant(36, "right_hand"));
  EXPECT_TRUE(meant(144, "right_hand"));
  EXPECT_FALSE(meant(36, "right"));
  EXPECT_FALSE(meant(24, "right_hand"));
  EXPECT_FALSE(meant(-90, "right_hand"));
}

TEST(Decide, WhatPeopleMayCallTheSameCompetes) {
  const auto meant = [](float awning) {
    TestTown town;
    town.Box("sunshade", "furniture/shade/umbrella", {30, 0, 0}, {2, 2, 2});
    town.Box("awning", "construction/awning", {-awning, 0, 0}, {2, 2, 2});
    const auto scene = town.Build();
    const Query plain{Named("sunshade"), {Is(PredicateKind::kNearest)}};
    EXPECT_EQ(Meant(scene, plain, {{{0, 0, 20}, 0}}), 1u);
    Query query = plain;
    query.rivals = Named("awning");
    const EntityId both = Meant(scene, query, {{{0, 0, 20}, 0}});
    // The second method names the awning, or both.
    const bool same = BruteForce(scene).Answers(query, {{{0, 0, 20}, 0}}) == std::vector<std::vector<EntityId>>{{1}};
    EXPECT_EQ(same, both == 1u);
    return both;
  };
  EXPECT_EQ(meant(20), kNoEntity);  // nearer
  EXPECT_EQ(meant(31), kNoEntity);  // hardly farther
  EXPECT_EQ(meant(40), 1u);
}

TEST(Decide, WhatStandsAsideOfANarrowWayMayBeCountedOrNotAndDecidesNothing) {
  const auto meant = [](float aside) {
    TestTown town;
    town.Box("column", kBox, {10, 0.3f, 0}, {0.5f, 0.5f, 3});
    town.Box("column", kBox, {15, aside, 0}, {0.5f, 0.5f, 3});
    town.Box("column", kBox, {20, -0.3f, 0}, {0.5f, 0.5f, 3});
    const Query query{Named("column"),
                      {{.kind = PredicateKind::kAlong, .width = 1.5, .clear = 6}, {.kind = PredicateKind::kOrdinal, .k = 2}}};
    const Standpoint at{{{0, 0, 2}, 0}};
    const auto scene = town.Build();
    const EntityId one = Meant(scene, query, at);
    EXPECT_EQ(BruteForce(scene).Answers(query, at).size(), one == kNoEntity ? 2u : 1u) << aside;
    return one;
  };
  EXPECT_EQ(meant(0), 2u);         // in the way
  EXPECT_EQ(meant(3), kNoEntity);  // one counts it, another does not
  EXPECT_EQ(meant(5), kNoEntity);
  EXPECT_EQ(meant(9), 3u);  // nobody counts it
}

TEST(Decide, AboveAndBelowAreElevations) {
  TestTown town;
  const EntityId high = town.Box("box", kBox, {20, 0, 0}, {1, 1, 1}, 20), low = town.Box("box", kBox, {20, 5, 0}, {1, 1, 1});
  const auto scene = town.Build();
  EXPECT_EQ(Meant(scene, {Named("box"), {Sector("above")}}, {{{0, 0, 10}, 0}}), high);
  EXPECT_EQ(Meant(scene, {Named("box"), {Sector("below")}}, {{{0, 0, 10}, 0}}), low);
}

TEST(Decide, OnThisFloorIsWhatStandsThereOrPassesThroughIt) {
  // Eyes 1.5 m over a floor at 3 m; storeys of 3 m.
  const Query here{Named("box"), {Sector("on_floor"), Is(PredicateKind::kNearest)}};
  const auto meant = [&](float base, float height) {
    TestTown town;
    town.Box("box", kBox, {6, 0, 0}, {1, 1, height}, base);
    const EntityId far = town.Box("box", kBox, {30, 0, 0}, {1, 1, 1}, 3);
    return Meant(town.Build(), here, {{{0, 0, 4.5}, 0}}) != far;
  };
  EXPECT_TRUE(meant(3, 0.5));    // low, on this floor
  EXPECT_TRUE(meant(5, 0.5));    // hangs from its ceiling
  EXPECT_TRUE(meant(0, 9));      // a shaft through all of them
  EXPECT_FALSE(meant(0, 2.1f));  // a door on the floor below
  EXPECT_FALSE(meant(6, 2));     // stands on the floor above
}

TEST(Decide, TheSecondOnTheWayIsCountedAlongTheHeading) {
  TestTown town;
  town.Box("tree", kTree, {10, 3, 0}, {2, 2, 6});
  const EntityId second = town.Box("tree", kTree, {18, -3, 0}, {2, 2, 6});
  town.Box("tree", kTree, {26, 3, 0}, {2, 2, 6});
  town.Box("tree", kTree, {14, 40, 0}, {2, 2, 6});  // beside the way
  const Query query{Named("tree"), {{.kind = PredicateKind::kAlong, .width = 10}, {.kind = PredicateKind::kOrdinal, .k = 2}}};
  const auto scene = town.Build();
  EXPECT_EQ(Meant(scene, query, {{{0, 0, 3}, 0}}), second);
  // From the other end it is again the second, for there are three.
  EXPECT_EQ(Meant(scene, query, {{{40, 0, 3}, kPi}}), second);
}

TEST(Decide, WhichOfTwoOnEitherSideComesFirstIsNotSeenFromAfar) {
  TestTown town;
  town.Box("tree", kTree, {0, 3, 0}, {1, 1, 6});
  const EntityId second = town.Box("tree", kTree, {2, -3, 0}, {1, 1, 6});
  const Query query{Named("tree"), {{.kind = PredicateKind::kAlong, .width = 10}, {.kind = PredicateKind::kOrdinal, .k = 2}}};
  const auto scene = town.Build();
  EXPECT_EQ(Meant(scene, query, {{{-15, 0, 3}, 0}}), second);     // 2 m of 17
  EXPECT_EQ(Meant(scene, query, {{{-30, 0, 3}, 0}}), kNoEntity);  // 2 m of 32
}

TEST(Decide, TheTallestAreThoseAboveAShareOfAll) {
  TestTown town;
  for (int i = 0; i < 9; ++i) town.Box("building", kBuilding, {40.0f * i, 50, 0}, {10, 10, 10.0f + i});
  const EntityId tallest = town.Box("building", kBuilding, {400, 50, 0}, {10, 10, 80});
  const Query query{Named("building"), {{.kind = PredicateKind::kHeightQuantile, .share = 0.9}}};
  EXPECT_EQ(Meant(town.Build(), query, {{{0, 0, 3}, 0}}), tallest);
}

TEST(Decide, OnTopOfNeedsARoofUnderItsFoot) {
  TestTown town;
  town.Box("building", kBuilding, {50, 0, 0}, {10, 10, 12});
  const EntityId above = town.Box("bottle", "signage/billboard", {50, 0, 0}, {2, 2, 5}, 12);
  town.Box("bottle", "signage/billboard", {20, 20, 0}, {2, 2, 5});
  const Query query{Named("bottle"), {{.kind = PredicateKind::kOnTopOf, .of = Named("building")}}};
  EXPECT_EQ(Meant(town.Build(), query, {{{0, 0, 3}, 0}}), above);
}

TEST(Decide, AStoreyHoldsWhatIsNoHigherThanOne) {
  TestTown town;
  town.Box("building", kBuilding, {50, 0, 0}, {10, 30, 24});
  for (int i = 0; i < 4; ++i) town.Box("red curtains", "furniture/curtain", {44.9f, -9.0f + 6 * i, 0}, {0.1f, 2, 2}, 10);
  Noun curtains = Named("red curtains");
  curtains.whole = true;
  EXPECT_NE(Meant(town.Build(), {curtains, {{.kind = PredicateKind::kStorey, .of = Named("building")}}}, {{{0, 0, 3}, 0}}), kNoEntity);
  TestTown other;
  other.Box("building", kBuilding, {50, 0, 0}, {10, 30, 24});
  for (int i = 0; i < 4; ++i) other.Box("red curtains", "furniture/curtain", {44.9f, -9.0f + 6 * i, 0}, {0.1f, 2, 2}, 4.0f + 4 * i);
  EXPECT_EQ(Meant(other.Build(), {curtains, {{.kind = PredicateKind::kStorey, .of = Named("building")}}}, {{{0, 0, 3}, 0}}), kNoEntity);
}

TEST(Decide, SurroundedIsAShareOfAllDirections) {
  TestTown town;
  const EntityId lake = town.Box("lake", "water/lake", {0, 0, 0}, {20, 20, 0.1f});
  town.Box("lake", "water/lake", {200, 0, 0}, {20, 20, 0.1f});
  for (int i = 0; i < 48; ++i)
    town.Box("tree", kTree, {18 * std::cos(static_cast<float>(i) * 0.1309f), 18 * std::sin(static_cast<float>(i) * 0.1309f), 0}, {2, 2, 6});
  const Query query{Named("lake"), {{.kind = PredicateKind::kSurroundedBy, .share = 0.8, .within = 20, .of = Named("tree")}}};
  EXPECT_EQ(Meant(town.Build(), query, {{{60, 0, 3}, kPi}}), lake);
}

TEST(Decide, SidesAreThoseOfTheLineAheadOrOfALongAxis) {
  TestTown town;
  const EntityId left = town.Box("box", kBox, {20, 10, 0}, {1, 1, 1}), right = town.Box("box", kBox, {20, -10, 0}, {1, 1, 1});
  const EntityId bridge = town.Box("bridge", "construction/bridge", {0, 100, 0}, {60, 4, 1});
  const auto scene = town.Build();
  const auto side = [](const char* name, bool axis) {
    return Predicate{.kind = PredicateKind::kSideOf, .sector = name, .side_of_axis = axis};
  };
  EXPECT_EQ(Meant(scene, {Named("box"), {side("left", false)}}, {{{0, 0, 1}, 0}}), left);
  EXPECT_EQ(Meant(scene, {Named("box"), {side("right", false)}}, {{{0, 0, 1}, 0}}), right);
  // Heading east, north of the bridge is its left; heading west, its right.
  EXPECT_EQ(Meant(scene, {Named("bridge"), {side("left", true)}}, {{{0, 115, 4}, 0.2}}), bridge);
  EXPECT_EQ(Meant(scene, {Named("bridge"), {side("left", true)}}, {{{0, 115, 4}, kPi - 0.2}}), kNoEntity);
}

TEST(Decide, AcrossIsWhatTheLineAheadEntersFromOutside) {
  TestTown town;
  const EntityId fence = town.Box("fence", "barrier/fence/wood_fence", {10, 0, 0}, {0.2f, 12, 1.5f});
  town.Box("fence", "barrier/fence/wood_fence", {10, 40, 0}, {0.2f, 12, 1.5f});
  EXPECT_EQ(Meant(town.Build(), {Named("fence"), {Is(PredicateKind::kAcross)}}, {{{0, 0, 2}, 0.05}}), fence);
}

TEST(Decide, AWideThingWhoseBoxIsMetNearItsEndMayBeCrossedAndDecidesNothing) {
  TestTown town;
  town.Box("fence", "barrier/fence/wood_fence", {25, 4.6f, 0}, {0.1f, 11.6f, 1.5f});
  town.Box("fence", "barrier/fence/wood_fence", {250, -9, 0}, {0.1f, 28, 1.9f});
  EXPECT_EQ(Meant(town.Build(), {Named("fence"), {Is(PredicateKind::kAcross), Is(PredicateKind::kNearest)}}, {{{0, 0, 2}, -0.037}}),
            kNoEntity);
}

// Towns of many boxes of one name: wherever the first method decides, the second finds the same single thing; and it decides
// often enough to be of use.
TEST(Decide, BothMethodsAgreeWhereverOneIsSure) {
  RngStream random(360, "vln predicates test");
  int decided = 0, asked = 0;
  const Query queries[] = {
      {Named("box"), {Is(PredicateKind::kNearest)}},
      {Named("box"), {Sector("ahead"), Is(PredicateKind::kNearest)}},
      {Named("box"), {Sector("rear_right"), Is(PredicateKind::kNearest)}},
      {Named("box"), {{.kind = PredicateKind::kAlong, .width = 15}, {.kind = PredicateKind::kOrdinal, .k = 2}}},
      {Named("box"), {{.kind = PredicateKind::kAlong, .width = 8, .clear = 12}, {.kind = PredicateKind::kOrdinal, .k = 2}}},
      {Named("box"), {Sector("straight_ahead"), Is(PredicateKind::kNearest)}},
      {Named("box"), {Sector("right_hand"), Is(PredicateKind::kNearest)}},
      {Named("box"), {{.kind = PredicateKind::kHeightQuantile, .share = 0.7}, Is(PredicateKind::kNearest)}},
      {Named("box"), {{.kind = PredicateKind::kSideOf, .sector = "left"}, Is(PredicateKind::kNearest)}},
      {Named("box"), {Is(PredicateKind::kAcross), Is(PredicateKind::kNearest)}}};
  for (int t = 0; t < 12; ++t) {
    TestTown town;
    for (int i = 0; i < 25; ++i) {
      const auto in = [&](double low, double high) { return static_cast<float>(random.Uniform(low, high)); };
      town.Box("box", kBox, {in(-80, 80), in(-80, 80), 0}, {in(0.5, 6), in(0.5, 6), in(0.5, 12)});
    }
    const auto scene = town.Build();
    for (const Query& query : queries) {
      for (int k = 0; k < 6; ++k, ++asked)
        decided += Meant(scene, query, {{{random.Uniform(-90, 90), random.Uniform(-90, 90), 3}, random.Uniform(-kPi, kPi)}}) != kNoEntity;
    }
  }
  EXPECT_GT(decided, asked / 3);
}

TEST(BruteForce, WallsSeenFromAboveAreNoLinesWithoutEnd) {
  TestTown town;
  const EntityId box = town.Box("box", "furniture/box", {0, 0, 0}, {2, 2, 2});
  BruteForce brute(town.Build());
  EXPECT_DOUBLE_EQ(brute.Distance({box}, {1, 5, 0}), 4) << "in line with a wall";
  EXPECT_DOUBLE_EQ(brute.Distance({box}, {4, 5, 0}), 5);
  EXPECT_DOUBLE_EQ(brute.Distance({box}, {0.5, -0.25, 9}), 0);
}

TEST(BruteForce, TheNearestIsFoundAmongThingsOfAllSizes) {
  TestTown town;
  // The long one's middle is farther away than that of the others.
  const EntityId wall = town.Box("box 1", "furniture/box", {30, 20, 0}, {70, 1, 2});
  town.Box("box 2", "furniture/box", {-25, 0, 0}, {1, 1, 1});
  town.Box("box 3", "furniture/box", {0, -24, 0}, {2, 2, 2});
  BruteForce brute(town.Build());
  const Query query{{.word = "box", .categories = {"furniture/box"}}, {{.kind = PredicateKind::kNearest}}};
  EXPECT_EQ(brute.Answers(query, {{{0, 0, 2}, 0}, {}}), (std::vector<std::vector<EntityId>>{{wall}}));
}

TEST(QueryJson, WritesWhatItReads) {
  const Query query{{.word = "box", .categories = {"furniture"}, .names = {"box*"}, .without = {"box 1"}, .whole = true},
                    {Sector("left"),
                     {.kind = PredicateKind::kAlong, .width = 2, .clear = 5},
                     {.kind = PredicateKind::kSurroundedBy, .share = 0.25, .within = 12, .of = Named("tree")}},
                    Named("crate")};
  const auto json = internal::ToJson(query);
  EXPECT_EQ(internal::ToJson(internal::QueryOf(json, "query")).dump(), json.dump());
}

TEST(QueryJson, MistakesNameTheFieldAndTheNearest) {
  const auto message = [](const char* text) -> std::string {
    try {
      internal::QueryOf(internal::ParseVlnJson(text, "t"), "query");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(R"({"noun": {"names": ["a"]}, "predicates": [{"is": "nearst"}]})").find("nearest"), std::string::npos);
  EXPECT_NE(message(R"({"noun": {"name": ["a"]}, "predicates": []})").find("names"), std::string::npos);
  EXPECT_NE(message(R"({"noun": {"names": ["a"]}, "predicates": [{"is": "ordinal", "k": 1e308}]})").find("predicates[0].k"),
            std::string::npos);
  EXPECT_NE(message(R"({"predicates": []})").find("noun"), std::string::npos);
  EXPECT_NE(message(R"([])").find("not an object"), std::string::npos);
}

}  // namespace
}  // namespace airsim360
