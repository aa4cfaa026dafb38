// The agent interface without a socket: requests, answers, mistakes.
#include "airsim360/tasks/agent_server/agent_api.h"
#include "airsim360/base/base64.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "airsim360/image/codecs.h"
#include "airsim360/tasks/agent_server/agent_answers.h"

namespace airsim360 {
namespace {

using Json = nlohmann::json;

// One room for all tests.
std::shared_ptr<AgentWorld> Open(const AgentWorldKey&) {
  static const auto room = std::make_shared<AgentWorld>(std::make_shared<Stage>(StageOptions{.world = {.world = "box_room"}}));
  return room;
}

struct Agent {
  explicit Agent(AgentApiOptions options = {}) : api(With(std::move(options))) {}
  static AgentApiOptions With(AgentApiOptions options) {
    options.world = "box_room";
    options.worlds = {"box_room", "plaza"};
    options.open = Open;
    return options;
  }
  Json Call(const std::string& method, const std::string& target, const Json& body = Json::object(), int status = 200) {
    const AgentResponse response = api.Handle({method, target, body.dump()});
    EXPECT_EQ(response.status, status) << method << " " << target << " " << response.body;
    return response.content_type == "application/json" ? Json::parse(response.body) : Json(response.body);
  }
  std::string Create(Json body = {{"start", {{"p", {-3, 0, 2}}}}, {"goal", {0, 0, 2}}}) {
    return Call("POST", "/v1/episodes", body, 201)["episode"];
  }
  AgentApi api;
};

TEST(AgentApi, AnEpisodeIsFlownAndScored) {
  Agent agent;
  const Json made = agent.Call("POST", "/v1/episodes",
                               {{"instruction", "fly to the middle"},
                                {"start", {{"p", {-3, 0, 2}}, {"yaw_deg", 0}}},
                                {"goal", {0, 0, 2}},
                                {"success", {{"radius", 0.5}}},
                                {"presets", {{"forward", 1}}}},
                               201);
  const std::string at = "/v1/episodes/" + made["episode"].get<std::string>();
  EXPECT_EQ(made["task"]["instruction"], "fly to the middle");
  EXPECT_NEAR(made["observation"]["distance_to_goal"].get<double>(), 3, 0.05);
  EXPECT_NEAR(made["observation"]["goal_direction"]["azimuth_deg"].get<double>(), 0, 1);
  // Every level of action.
  agent.Call("POST", at + "/step", {{"action", "forward"}});
  agent.Call("POST", at + "/step", {{"action", {{"type", "velocity"}, {"v", {0, 1, 0}}, {"duration", 1}}}});
  agent.Call("POST", at + "/step", {{"action", {{"type", "rates"}, {"w", {0, 0, 0}}, {"throttle", 0.5}}}});
  agent.Call("POST", at + "/step", {{"action", {{"type", "relative_goal"}, {"azimuth_deg", 45}, {"distance", 0.5}}}});
  const Json there = agent.Call("POST", at + "/step", {{"action", {{"type", "waypoints"}, {"points", {{0, 0, 2}}}}}});
  EXPECT_FALSE(there["observation"]["done"].get<bool>());
  EXPECT_LT(there["observation"]["distance_to_goal"].get<double>(), 0.5);
  EXPECT_FALSE(there.contains("score"));
  const Json over = agent.Call("POST", at + "/step", {{"action", "stop"}});
  EXPECT_TRUE(over["score"]["success"].get<bool>());
  EXPECT_EQ(over["observation"]["end"], "stopped");
  EXPECT_EQ(agent.Call("GET", at)["score"], over["score"]);
  EXPECT_GT(agent.Call("GET", at + "/path")["p"].size(), 10u);
  agent.Call("POST", at + "/step", {{"action", "forward"}}, 422);
  EXPECT_EQ(agent.Call("POST", at + "/reset", {{"seed", 5}})["observation"]["step"], 0);
  agent.Call("DELETE", at);
  agent.Call("GET", at, {}, 404);
}

AgentTask MiddleOfTheRoom(bool tells_goal) {
  AgentTask task{.id = "box_room/0/middle/0", .world = {"box_room", 0}, .spec = {}};
  task.spec.instruction = "Fly to the middle and stop.";
  task.spec.start = Vec3d{-3, 0, 2};
  task.spec.goal = Vec3d{4, 4, 5};
  task.spec.more_goals = {{0, 0, 2}, {0, 3, 2}};
  task.spec.success_radius = 0.5;
  task.spec.reference_path = {{-3, 0, 2}, {0, 0, 2}};
  task.spec.tells_goal = tells_goal;
  return task;
}

TEST(AgentApi, ATaskIsFlownWithoutBeingToldWhereItsGoalIs) {
  Agent agent({.tasks = {MiddleOfTheRoom(false)}});
  EXPECT_EQ(agent.Call("GET", "/v1/tasks")["tasks"][0]["instruction"], "Fly to the middle and stop.");
  const Json made = agent.Call("POST", "/v1/episodes", {{"task", "box_room/0/middle/0"}}, 201);
  const std::string at = "/v1/episodes/" + made["episode"].get<std::string>();
  EXPECT_EQ(made["task"]["instruction"], "Fly to the middle and stop.");
  const auto tells = [](const Json& answer) {
    return !answer["task"]["goal"].is_null() || !answer["observation"]["distance_to_goal"].is_null() ||
           !answer["observation"]["goal_direction"].is_null() || answer.contains("score");
  };
  EXPECT_FALSE(tells(made));
  EXPECT_FALSE(tells(agent.Call("GET", at)));
  EXPECT_FALSE(tells(agent.Call("POST", at + "/reset")));
  EXPECT_FALSE(tells(agent.Call("GET", at + "/watch")));
  agent.Call("POST", at + "/step", {{"action", {{"type", "waypoints"}, {"points", {{0, 0, 2}}}}}});
  // Any place of the goal will do.
  const Json over = agent.Call("POST", at + "/step", {{"action", "stop"}});
  EXPECT_TRUE(over["score"]["success"].get<bool>());
  EXPECT_LT(over["score"]["navigation_error"].get<double>(), 0.5);
  EXPECT_TRUE(over["observation"]["distance_to_goal"].is_null());
}

TEST(AgentApi, AGoalIsToldWhereTheServerSaysSo) {
  Agent agent({.tasks = {MiddleOfTheRoom(true)}});
  const Json made = agent.Call("POST", "/v1/episodes", {{"task", "box_room/0/middle/0"}}, 201);
  EXPECT_NEAR(made["observation"]["distance_to_goal"].get<double>(), 3, 0.05);  // of the nearest of its places
  EXPECT_EQ(made["task"]["goal"][0], 4);
}

TEST(AgentApi, ATaskThatIsNotThereOrIsChangedIsRefused) {
  Agent agent({.tasks = {MiddleOfTheRoom(false)}});
  const Json unknown = agent.Call("POST", "/v1/episodes", {{"task", "box_room/0/midle/0"}}, 422)["error"];
  EXPECT_EQ(unknown["field"], "task");
  EXPECT_EQ(unknown["nearest"], "box_room/0/middle/0");
  EXPECT_EQ(agent.Call("POST", "/v1/episodes", {{"task", "box_room/0/middle/0"}, {"goal", {0, 0, 2}}}, 422)["error"]["field"], "goal");
  Agent without;
  EXPECT_EQ(without.Call("POST", "/v1/episodes", {{"task", "x"}}, 422)["error"]["field"], "task");
}

TEST(AgentApi, ObservationsHoldThePicturesAskedFor) {
  Agent agent;
  const std::string at = "/v1/episodes/" + agent.Create();
  const Json seen = agent.Call("POST", at + "/observe",
                               {{"panorama", {{"width", 128}}},
                                {"views", {{{"azimuth_deg", 90}, {"width", 64}, {"height", 48}}, Json::object()}},
                                {"range_grid", true}})["observation"];
  EXPECT_EQ(seen["panorama"]["height"], 64);
  EXPECT_EQ(seen["views"].size(), 2u);
  EXPECT_EQ(seen["views"][0]["azimuth_deg"], 90);
  EXPECT_EQ(seen["range_grid"]["range"].size(), 8u);
  EXPECT_EQ(seen["range_grid"]["range"][0].size(), 16u);
  // The picture by itself is the same bytes.
  const AgentResponse jpeg = agent.api.Handle({"GET", at + "/panorama.jpg?width=128", ""});
  EXPECT_EQ(jpeg.content_type, "image/jpeg");
  EXPECT_EQ(seen["panorama"]["data"].get<std::string>(), Base64(jpeg.body));
  const Image<Rgba8> decoded = DecodeRgba8(std::as_bytes(std::span(jpeg.body)), "panorama");
  EXPECT_EQ(decoded.width(), 128);
  const AgentResponse view = agent.api.Handle({"GET", at + "/view.jpg?azimuth_deg=90&width=64&height=48", ""});
  EXPECT_EQ(seen["views"][0]["data"].get<std::string>(), Base64(view.body));
  EXPECT_EQ(agent.Call("GET", at + "/range_grid?rows=2&columns=4")["range"].size(), 2u);
}

// What is sent, the field that the answer names, the nearest choice.
struct Mistake {
  const char *path, *body, *field, *nearest;
};
class AgentMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(AgentMistakes, AreAnsweredWithTheFieldAndTheNearestChoice) {
  Agent agent;
  const std::string id = agent.Create();
  const Mistake& mistake = GetParam();
  std::string path = mistake.path;
  if (const size_t at = path.find("{id}"); at != std::string::npos) path.replace(at, 4, id);
  const AgentResponse response = agent.api.Handle({"POST", path, mistake.body});
  EXPECT_EQ(response.status, 422) << response.body;
  const Json error = Json::parse(response.body)["error"];
  EXPECT_EQ(error.value("field", ""), mistake.field) << response.body;
  EXPECT_EQ(error.value("nearest", ""), mistake.nearest) << response.body;
  EXPECT_EQ(agent.Call("GET", "/v1/episodes/" + id)["observation"]["t"], 0);  // nothing has changed
}

constexpr const char *kMake = "/v1/episodes", *kStep = "/v1/episodes/{id}/step", *kLook = "/v1/episodes/{id}/observe";
INSTANTIATE_TEST_SUITE_P(
    All, AgentMistakes,
    testing::Values(Mistake{kMake, R"({"word": "plaza"})", "word", "world"}, Mistake{kMake, R"({"world": "plasa"})", "world", "plaza"},
                    Mistake{kMake, R"({"drone": "humingbird"})", "drone", "hummingbird"}, Mistake{kMake, R"({"goal": [1, 2]})", "goal", ""},
                    Mistake{kMake, R"({"goal": [1, 2, "x"]})", "goal[2]", ""},
                    Mistake{kMake, R"({"start": {"p": [3, 0, 0.9]}})", "start.p", ""},
                    Mistake{kMake, R"({"limits": {"max_steps": 0}})", "limits.max_steps", "1"},
                    Mistake{kMake, R"({"success": {"rule": "stopp"}})", "success.rule", "stop"},
                    Mistake{kMake, R"({"seed": -1})", "seed", ""}, Mistake{kMake, "[]", "", ""},
                    Mistake{kMake, R"({"seed": 1, "seed": 2})", "seed", ""}, Mistake{kMake, "{", "", ""},
                    Mistake{kStep, "{}", "action", "forward"}, Mistake{kStep, R"({"action": "forwrad"})", "action", "forward"},
                    Mistake{kStep, R"({"action": {"type": "velocty"}})", "action.type", "velocity"},
                    Mistake{kStep, R"({"action": {"type": "velocity"}})", "action.v", "[1, 0, 0]"},
                    Mistake{kStep, R"({"action": {"type": "velocity", "v": [1e9, 0, 0]}})", "action.v[0]", "100"},
                    Mistake{kStep, R"({"action": {"type": "rates", "w": [0, 0, 0], "throttle": 2}})", "action.throttle", "1"},
                    Mistake{kStep, R"({"action": {"type": "waypoints", "points": []}})", "action.points", ""},
                    Mistake{kLook, R"({"panorama": {"width": 100000}})", "panorama.width", "4096"},
                    Mistake{kLook, R"({"panorama": {"width": 33}})", "panorama.width", "32"},
                    Mistake{kLook, R"({"views": [{"fov": 3}]})", "views[0].fov", "fov_deg"}));

TEST(AgentApi, EveryFieldIsListedOnce) {
  Agent agent;
  const std::string id = agent.Create();
  const Json error = agent.Call("POST", "/v1/episodes/" + id + "/step",
                                {{"action", {{"type", "relative_goal"}, {"distance", 1}, {"foo", 2}}}}, 422)["error"];
  EXPECT_NE(error["message"].get<std::string>().find("elevation_deg, distance, speed"), std::string::npos) << error;
}

TEST(AgentApi, NumbersThatAreNoneHaveNoNearest) {
  Agent agent;
  const std::string id = agent.Create();
  for (const char* text : {"nan", "inf", "-inf", "NaN", "abc"}) {
    const Json error = agent.Call("GET", "/v1/episodes/" + id + "/view.jpg?fov_deg=" + text, {}, 422)["error"];
    EXPECT_EQ(error.value("field", ""), "fov_deg");
    EXPECT_FALSE(error.contains("nearest")) << error;
    EXPECT_NE(error["message"].get<std::string>().find(text), std::string::npos) << error;
  }
}

TEST(AgentApi, TheSocketIsNoPathForRequests) {
  Agent agent;
  const std::string message = agent.Call("GET", "/v1/ws", {}, 426)["error"]["message"].get<std::string>();
  EXPECT_EQ(message.find("did you mean"), std::string::npos) << message;
  EXPECT_NE(message.find("WebSocket"), std::string::npos) << message;
}

TEST(AgentApi, WhatIsNotThereIsToldWithWhatIs) {
  Agent agent;
  const std::string id = agent.Create();
  const auto message = [&](const std::string& method, const std::string& target, int status) {
    return agent.Call(method, target, {}, status)["error"]["message"].get<std::string>();
  };
  EXPECT_NE(message("GET", "/v1/episode", 404).find("'/v1/episodes'"), std::string::npos);
  EXPECT_NE(message("GET", "/v1/episodes/e9", 404).find("did you mean 'e1'"), std::string::npos);
  EXPECT_NE(message("POST", "/v1/episodes/" + id + "/stepp", 404).find("'step'"), std::string::npos);
  EXPECT_NE(message("GET", "/v1/episodes/" + id + "/step", 405).find("use POST"), std::string::npos);
  EXPECT_NE(message("GET", "/v1/episodes/" + id + "/view.jpg?fov_deg=300", 422).find("170"), std::string::npos);
}

TEST(AgentApi, RealTimeChargesWhatTheAgentTakesToThink) {
  double now = 0;
  Agent agent({.realtime = true, .clock = [&] { return now; }});
  const std::string at = "/v1/episodes/" + agent.Create();
  agent.Call("POST", at + "/step", {{"action", {{"type", "velocity"}, {"v", {0.5, 0, 0}}, {"duration", 1}}}});
  now += 0.4;
  const Json seen = agent.Call("POST", at + "/observe");
  EXPECT_NEAR(seen["observation"]["t"].get<double>(), 1.4, 1e-9);
  EXPECT_NEAR(seen["latency"].get<double>(), 0.4, 1e-9);
  // In lockstep no time passes.
  Agent patient({.clock = [&] { return now; }});
  const std::string there = "/v1/episodes/" + patient.Create();
  now += 5;
  EXPECT_EQ(patient.Call("POST", there + "/observe")["observation"]["t"], 0);
}

TEST(AgentApi, EpisodesAreBoundedAndIdleOnesMakeRoom) {
  double now = 0;
  Agent agent({.clock = [&] { return now; }, .max_episodes = 2, .idle_seconds = 100});
  agent.Create();
  agent.Create();
  agent.Call("POST", "/v1/episodes", Json::object(), 503);
  now = 50;
  agent.Call("GET", "/v1/episodes/e1");
  now = 120;  // e2 has been idle for longer than 100 s
  agent.Create();
  agent.Call("GET", "/v1/episodes/e2", {}, 404);
  agent.Call("GET", "/v1/episodes/e1");
}

TEST(AgentApi, AMessageOfAWebSocketIsARequestInJson) {
  Agent agent;
  const Json made =
      Json::parse(agent.api.HandleMessage(R"({"id": 7, "method": "POST", "path": "/v1/episodes", "body": {"start": {"p": [-3, 0, 2]}}})"));
  EXPECT_EQ(made["id"], 7);
  EXPECT_EQ(made["status"], 201);
  const Json jpeg = Json::parse(agent.api.HandleMessage(R"({"id": "x", "path": "/v1/episodes/e1/panorama.jpg?width=64"})"));
  EXPECT_EQ(jpeg["id"], "x");
  EXPECT_EQ(jpeg["content_type"], "image/jpeg");
  EXPECT_EQ(jpeg["data"].get<std::string>().substr(0, 4), "/9j/");
  EXPECT_EQ(Json::parse(agent.api.HandleMessage("nonsense"))["status"], 422);
}

TEST(AgentOpenApi, IsJsonAndEveryPathOfItIsAnswered) {
  Agent agent;
  const Json api = Json::parse(AgentOpenApi());
  EXPECT_EQ(api["openapi"], "3.0.3");
  for (const auto& [path, operations] : api["paths"].items()) {
    for (const auto& [method, operation] : operations.items()) {
      if (method == "parameters") continue;
      const std::string id = agent.Create();
      std::string target = path;
      if (const size_t at = target.find("{id}"); at != std::string::npos) target.replace(at, 4, id);
      std::string verb = method;
      for (char& c : verb) c = static_cast<char>(std::toupper(c));
      const std::string body = path.ends_with("/step") ? R"({"action": "hover"})" : "";
      const int status = agent.api.Handle({verb, target, body}).status;
      EXPECT_TRUE(status == 200 || status == 201) << verb << " " << target << " " << status;
      EXPECT_TRUE(operation["responses"].contains("default")) << "what mistakes are answered with: " << target;
    }
  }
  // Names of presets and kinds of actions are those that the decoder knows.
  const Json& kinds = api["components"]["schemas"]["Action"]["oneOf"];
  EXPECT_EQ(kinds[0]["enum"].size(), std::size(kPresetNames));
  for (size_t i = 0; i < std::size(kActionNames); ++i) EXPECT_EQ(kinds[i + 1]["properties"]["type"]["enum"][0], kActionNames[i]);
}

}  // namespace
}  // namespace airsim360
