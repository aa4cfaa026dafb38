// What agents may say: the grammar takes what it describes and refuses everything else by name.
#include <gtest/gtest.h>

#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/vln/agents/answer.h"

namespace airsim360 {
namespace {

std::string Refusal(const std::string& text, Decisions decisions) {
  try {
    ParseAnswer(text, decisions);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Answer, OneMoveIsADirectionAndADistanceAndEndsTheFlight) {
  const Answer answer =
      ParseAnswer(R"( {"azimuth_deg": -90, "elevation_deg": 10, "distance_m": 30, "reason": "seen left"} )", Decisions::kYomo);
  const auto& move = std::get<RelativeGoalAction>(*answer.action);
  EXPECT_DOUBLE_EQ(move.azimuth, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(move.distance, 30);
  EXPECT_TRUE(answer.stop);
  EXPECT_FALSE(ParseAnswer(R"({"azimuth_deg": 90, "distance_m": 0})", Decisions::kYomo).stop);
}

TEST(Answer, StepsAndWaypointsAreRead) {
  EXPECT_EQ(std::get<PresetAction>(*ParseAnswer(R"({"action": "turn_left"})", Decisions::kDiscrete).action).preset, Preset::kTurnLeft);
  EXPECT_TRUE(ParseAnswer(R"({"action": "stop"})", Decisions::kDiscrete).stop);
  const Answer way = ParseAnswer(R"({"waypoints": [[1, 2, 3], [4, 5, 6]], "stop": true})", Decisions::kWaypoints);
  EXPECT_EQ(std::get<WaypointsAction>(*way.action).points.size(), 2u);
  EXPECT_TRUE(std::get<WaypointsAction>(*way.action).body_frame);
  EXPECT_TRUE(way.stop);
}

TEST(Answer, ItsTextIsReadAsTheSameAnswer) {
  const std::pair<const char*, Decisions> cases[] = {{R"({"azimuth_deg":-90.0,"elevation_deg":10.0,"distance_m":30.0})", Decisions::kYomo},
                                                     {R"({"action":"turn_left"})", Decisions::kDiscrete},
                                                     {R"({"waypoints":[[1.0,2.0,3.0]],"stop":true})", Decisions::kWaypoints}};
  for (const auto& [text, decisions] : cases) {
    const Answer answer = ParseAnswer(text, decisions);
    const std::string said = AnswerText(answer);
    EXPECT_EQ(said.substr(0, std::string_view(text).size() - 1), std::string_view(text).substr(0, std::string_view(text).size() - 1));
    EXPECT_EQ(said.find("stop") != std::string::npos, answer.stop);
  }
}

TEST(Answer, WhateverElseIsRefusedWithItsField) {
  struct Case {
    const char* text;
    Decisions decisions;
    const char* says;
  };
  const std::string deep(100'000, '[');
  const Case cases[] = {
      {"", Decisions::kYomo, "empty"},
      {"forward", Decisions::kDiscrete, "{"},
      {"```json\n{\"action\": \"forward\"}\n```", Decisions::kDiscrete, "{"},
      {"{\"action\": \"forward\"} and then stop", Decisions::kDiscrete, "JSON"},
      {"{\"action\": \"forwrd\"}", Decisions::kDiscrete, "forward"},
      {"{\"action\": 3}", Decisions::kDiscrete, "action"},
      {"{\"action\": \"forward\", \"repeat\": 5}", Decisions::kDiscrete, "repeat"},
      {"{\"azimuth_deg\": NaN, \"distance_m\": 3}", Decisions::kYomo, "JSON"},
      {"{\"azimuth_deg\": 1e999, \"distance_m\": 3}", Decisions::kYomo, "answer"},
      {"{\"azimuth_deg\": 10, \"distance_m\": -1}", Decisions::kYomo, "distance_m"},
      {"{\"azimuth_deg\": 10, \"distance_m\": 2e18}", Decisions::kYomo, "distance_m"},
      {"{\"azimuth_deg\": 10}", Decisions::kYomo, "distance_m"},
      {"{\"azimuth_deg\": \"10\", \"distance_m\": 3}", Decisions::kYomo, "azimuth_deg"},
      {"{\"waypoints\": [[1, 2]]}", Decisions::kWaypoints, "waypoints[0]"},
      {"{\"waypoints\": [[1e9, 0, 0]]}", Decisions::kWaypoints, "waypoints"},
      {"{}", Decisions::kWaypoints, "waypoints"},
  };
  for (const Case& c : cases)
    EXPECT_NE(Refusal(c.text, c.decisions).find(c.says), std::string::npos) << c.text << ": " << Refusal(c.text, c.decisions);
  EXPECT_FALSE(Refusal("{\"action\": " + deep, Decisions::kDiscrete).empty());
  EXPECT_FALSE(Refusal(std::string(kLongestAnswer + 1, ' ') + "{}", Decisions::kDiscrete).empty());
}

}  // namespace
}  // namespace airsim360
