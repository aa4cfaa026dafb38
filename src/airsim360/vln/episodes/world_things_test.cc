#include "airsim360/vln/episodes/world_things.h"

#include <gtest/gtest.h>

#include "airsim360/vln/predicates/test_town.h"

namespace airsim360 {
namespace {

struct Change {
  const char* name = "bench";
  const char* category = "furniture/seating/bench";
  float x = 5, height = 1;
  bool more = false, less = false;
};

std::shared_ptr<const Scene> Town(const Change& change = {}) {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {40, 8, 0.1f});
  if (!change.less) town.Box(change.name, change.category, {change.x, 6, 0}, {2, 0.5f, change.height});
  if (change.more) town.Box("person", "human/person", {1, 1, 0}, {0.5f, 0.5f, 1.7f});
  return town.Build();
}

TEST(WorldThings, TheSameWorldBuiltAgainIsTheSame) {
  EXPECT_EQ(ThingsOf(*Town()), ThingsOf(*Town()));
  EXPECT_EQ(ThingsDiffer(ThingsOf(*Town()), *Town()), "");
  EXPECT_EQ(ThingsOf(*Town()).sha256.size(), 64U);
}

TEST(WorldThings, ANameACategoryABoxOrAThingLessIsAnotherWorld) {
  const WorldThings made_in = ThingsOf(*Town());
  for (const Change& change : {Change{.name = "seat"}, Change{.category = "furniture/mail/post_box"}, Change{.x = 5.001f},
                               Change{.height = 1.001f}, Change{.less = true}})
    EXPECT_NE(ThingsDiffer(made_in, *Town(change)), "") << change.name << change.category << change.x << change.height;
}

TEST(WorldThings, WhatComesAfterAllElseDoesNotCount) {
  // The sky of a test town comes last: without it, as people come after it.
  WorldThings first = ThingsOf(*Town(), 2);
  EXPECT_EQ(first.count, 2U);
  EXPECT_EQ(ThingsDiffer(first, *Town({.more = true})), "");
  EXPECT_EQ(ThingsDiffer({}, *Town()), "");
}

}  // namespace
}  // namespace airsim360
