// The agent interface without its protocol: requests in, answers out. docs/guide/agents.md and AgentOpenApi say
// what there is.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/tasks/agent_server/agent_request.h"
#include "airsim360/tasks/agent_server/agent_world.h"

namespace airsim360 {

struct AgentRequest {
  std::string method, target;  ///< "POST", "/v1/episodes/e1/step?…"
  std::string body;
};
struct AgentResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::string body;
  std::string allow = {};  ///< of status 405: the methods that are answered
};

/// A world as an episode wants it.
struct AgentWorldKey {
  std::string name;
  uint64_t seed = 0;
  std::optional<int64_t> people = {};  ///< none: as the server has it
  std::string weather = {};            ///< "": as the server has it
  friend bool operator==(const AgentWorldKey&, const AgentWorldKey&) = default;
};

/// An episode that was made before: whoever asks for it needs to know its name alone.
struct AgentTask {
  std::string id;
  AgentWorldKey world;
  EpisodeSpec spec;
};

struct AgentApiOptions {
  std::string world = {};  ///< of episodes that name none
  uint64_t world_seed = 0;
  std::vector<std::string> worlds = {};  ///< names that episodes may ask for
  std::vector<AgentTask> tasks = {};     ///< that episodes may ask for
  /// Builds a world; slow.
  std::function<std::shared_ptr<AgentWorld>(const AgentWorldKey& key)> open = {};
  bool realtime = false;               ///< what an agent takes to think passes in its episode
  std::function<double()> clock = {};  ///< seconds, for idle episodes and `realtime`; none: stands still
  size_t max_episodes = 64;
  size_t max_worlds = 4;       ///< kept in memory
  double idle_seconds = 3600;  ///< after which an episode that nobody touches is forgotten, where room is needed
};

/// Thread-safe. One request at a time for one episode: another one meanwhile is refused with status 409. `watch` and
/// `entities` are for those who look on, and neither hold nor change it.
class AgentApi {
 public:
  /// Opens the default world. InputError as `open`.
  explicit AgentApi(AgentApiOptions options);
  ~AgentApi();

  /// Never throws; mistakes are answered with {"error": {"field", "message", "nearest"}}.
  AgentResponse Handle(const AgentRequest& request);
  /// One message of a WebSocket: a request wrapped in JSON, answered in JSON.
  std::string HandleMessage(std::string_view text);

 private:
  struct Slot;
  class Turn;
  AgentResponse Route(const AgentRequest& request);
  AgentResponse Create(const std::string& body);
  AgentResponse List();
  AgentResponse Tasks() const;
  const AgentTask& TaskOf(const std::string& id) const;
  AgentResponse Delete(const std::string& id);
  AgentResponse OnEpisode(const std::string& id, const std::string& call, std::string_view query, const AgentRequest& request);
  AgentResponse Describe(Slot& slot);
  AgentResponse Reset(Slot& slot, const std::string& body);
  AgentResponse Step(Slot& slot, const std::string& body);
  AgentResponse Observe(Slot& slot, const std::string& body);
  AgentResponse Look(Slot& slot, const ObserveRequest& request);
  AgentResponse Picture(Slot& slot, const std::string& name, std::string_view query);
  AgentResponse Path(Slot& slot);
  AgentResponse Watch(Slot& slot, std::string_view query);
  AgentResponse Entities(Slot& slot);
  std::shared_ptr<AgentWorld> WorldOf(const AgentWorldKey& key);
  std::shared_ptr<Slot> Find(const std::string& id);
  void MakeRoom();
  double Now() const { return options_.clock ? options_.clock() : 0; }

  AgentApiOptions options_;
  std::mutex open_mutex_;  // worlds are built one at a time
  std::mutex mutex_;       // of what follows
  std::vector<std::pair<AgentWorldKey, std::shared_ptr<AgentWorld>>> worlds_;
  std::map<std::string, std::shared_ptr<Slot>> episodes_;
  uint64_t made_ = 0;
};

/// The OpenAPI 3.0 description of everything that Handle answers, as JSON.
std::string_view AgentOpenApi();

}  // namespace airsim360
