// Example 8: an agent over HTTP. It knows the range grid and the goal's direction, and flies to where the way is
// free and leads nearer: a baseline for models that see.
//   build/bin/08_agent
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "airsim360/opening/world_loader.h"
#include "airsim360/tasks/agent_server/agent_server.h"

namespace {

using Json = nlohmann::json;

// The JSON that the server answers one request with; any HTTP library would do.
Json Request(int port, const std::string& method, const std::string& path, const Json& body = Json::object()) {
  const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in where{.sin_family = AF_INET, .sin_port = htons(static_cast<uint16_t>(port)), .sin_addr = {}, .sin_zero = {}};
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(connection, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0)
    throw std::runtime_error("cannot connect");
  const std::string text = body.dump();
  const std::string request = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                              "Content-Type: application/json\r\nContent-Length: " + std::to_string(text.size()) +
                              "\r\n\r\n" + text;
  if (::send(connection, request.data(), request.size(), 0) < 0) throw std::runtime_error("send");
  std::string answer;
  char buffer[65536];
  for (ssize_t got; (got = ::recv(connection, buffer, sizeof buffer, 0)) > 0;) answer.append(buffer, static_cast<size_t>(got));
  ::close(connection);
  return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
}

}  // namespace

int main() {
  using namespace airsim360;

  // The server of `airsim360 agent --world box_room`, in this process.
  AgentApi api({.world = "box_room", .open = [](const AgentWorldKey& key) {
                  return std::make_shared<AgentWorld>(std::make_shared<Stage>(StageOptions{.world = {.world = key.name, .seed = key.seed}}));
                }});
  const AgentServer server(api, {.port = 0});

  // An episode: from one corner to the other, around the box.
  const Json observe = {{"range_grid", {{"rows", 8}, {"columns", 16}}}};
  Json answer = Request(server.port(), "POST", "/v1/episodes",
                        {{"instruction", "fly to the far corner"},
                         {"start", {{"p", {-3.5, -3.5, 1.5}}, {"yaw_deg", 45}}},
                         {"goal", {3.5, 3.5, 4.0}},
                         {"observe", observe}});
  const std::string episode = "/v1/episodes/" + answer.at("episode").get<std::string>();

  // Look, choose, act: straight to the goal as far as the sector towards it is free.
  for (int i = 0; i < 20 && !answer["observation"]["done"].get<bool>(); ++i) {
    const Json& seen = answer["observation"];
    const double distance = seen["distance_to_goal"], azimuth = seen["goal_direction"]["azimuth_deg"],
                 elevation = seen["goal_direction"]["elevation_deg"];
    const int column = static_cast<int>((azimuth + 180) / 22.5) % 16, row = static_cast<int>((90 - elevation) / 22.5) % 8;
    const Json& range = seen["range_grid"]["range"][static_cast<size_t>(row)][static_cast<size_t>(column)];
    const double room = range.is_null() ? 100.0 : range.get<double>() - 0.7;
    std::printf("step %d: %.2f m to go, %.2f m free ahead\n", i, distance, room);
    Json action = "stop";
    if (distance > 0.8)
      action = {{"type", "relative_goal"}, {"azimuth_deg", room > 0.3 ? azimuth : azimuth - 60},
                {"elevation_deg", elevation}, {"distance", std::min(distance, std::max(room, 0.5))}};
    answer = Request(server.port(), "POST", episode + "/step", {{"action", action}, {"observe", observe}});
  }
  std::printf("%s\n", answer.value("score", answer).dump().c_str());
  return answer.contains("score") && answer["score"]["success"].get<bool>() ? 0 : 1;
}
