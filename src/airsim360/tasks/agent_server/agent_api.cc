#include "airsim360/tasks/agent_server/agent_api.h"

#include <algorithm>
#include <utility>

#include "airsim360/base/base64.h"
#include "airsim360/tasks/agent_server/agent_slot.h"

namespace airsim360 {
namespace {

using internal::Answer;
using internal::JsonResponse;
using internal::RequireMethod;
using internal::StatusError;

// "goal: …" as field and message.
AgentResponse Refusal(const std::string& what) {
  const size_t colon = what.find(": ");
  const std::string field = colon == std::string::npos ? "" : what.substr(0, colon);
  const bool is_name = !field.empty() && field.find(' ') == std::string::npos;
  return {422, "application/json", internal::ErrorBody(is_name ? field : "", what, "")};
}

}  // namespace

AgentApi::AgentApi(AgentApiOptions options) : options_(std::move(options)) {
  if (std::ranges::find(options_.worlds, options_.world) == options_.worlds.end()) options_.worlds.push_back(options_.world);
  // With tasks, the world of the first of them.
  WorldOf(options_.tasks.empty() ? AgentWorldKey{options_.world, options_.world_seed} : options_.tasks.front().world);
}

AgentApi::~AgentApi() = default;

std::shared_ptr<AgentWorld> AgentApi::WorldOf(const AgentWorldKey& key) {
  const auto find = [&]() -> std::shared_ptr<AgentWorld> {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(worlds_, key, [](const auto& entry) { return entry.first; });
    return found == worlds_.end() ? nullptr : found->second;
  };
  if (auto world = find()) return world;
  // Nobody waits for a world that somebody else builds: threads stay free for the other episodes.
  const std::unique_lock building(open_mutex_, std::try_to_lock);
  if (!building) throw StatusError(503, "another world is being built; try again in a few seconds");
  if (auto world = find()) return world;
  {
    // Room for it: the oldest that no episode uses, but the server's own.
    const std::lock_guard lock(mutex_);
    if (worlds_.size() >= options_.max_worlds) {
      const auto unused = std::find_if(worlds_.begin() + 1, worlds_.end(), [](const auto& entry) { return entry.second.use_count() == 1; });
      if (unused == worlds_.end()) throw StatusError(503, std::to_string(worlds_.size()) + " worlds are in use; delete an episode first");
      worlds_.erase(unused);
    }
  }
  auto world = options_.open(key);
  const std::lock_guard lock(mutex_);
  worlds_.push_back({key, world});
  return world;
}

std::shared_ptr<AgentApi::Slot> AgentApi::Find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = episodes_.find(id);
  if (found != episodes_.end()) return found->second;
  std::vector<std::string> ids;
  for (const auto& [other, slot] : episodes_) ids.push_back(other);
  const std::string nearest = NearestChoice(id.substr(0, 64), ids);
  throw StatusError(404, "there is no episode '" + id.substr(0, 64) + "'" +
                             (nearest.empty() ? "; create one with POST /v1/episodes" : "; did you mean '" + nearest + "'?"));
}

// Forgets the episode that has been idle longest, if it was for long enough.
void AgentApi::MakeRoom() {
  if (episodes_.size() < options_.max_episodes) return;
  const auto oldest = std::ranges::min_element(episodes_, {}, [](const auto& entry) { return entry.second->touched.load(); });
  if (Now() - oldest->second->touched < options_.idle_seconds) {
    throw StatusError(503, std::to_string(episodes_.size()) + " episodes are open already; delete one with DELETE /v1/episodes/{id}");
  }
  episodes_.erase(oldest);
}

const AgentTask& AgentApi::TaskOf(const std::string& id) const {
  const auto found = std::ranges::find(options_.tasks, id, &AgentTask::id);
  if (found != options_.tasks.end()) return *found;
  if (options_.tasks.empty()) throw RequestError("task", "the server has no tasks: start it with --tasks EPISODES.jsonl");
  std::vector<std::string> ids;
  for (const AgentTask& task : options_.tasks) ids.push_back(task.id);
  const std::string nearest = NearestChoice(id.substr(0, 256), ids);
  throw RequestError("task", "there is no task '" + id.substr(0, 256) + "'; GET /v1/tasks lists them",
                     nearest.empty() ? ids.front() : nearest);
}

AgentResponse AgentApi::Tasks() const {
  Answer list = Answer::array();
  for (const AgentTask& task : options_.tasks)
    list.push_back(
        {{"task", task.id}, {"world", task.world.name}, {"world_seed", task.world.seed}, {"instruction", task.spec.instruction}});
  return JsonResponse({{"tasks", list}});
}

AgentResponse AgentApi::Create(const std::string& body) {
  CreateRequest request = DecodeCreate(body);
  AgentWorldKey key{request.world.empty() ? options_.world : request.world, request.world_seed.value_or(options_.world_seed)};
  if (!request.task.empty()) {
    const AgentTask& task = TaskOf(request.task);
    key = task.world;
    request.spec = task.spec;
  } else if (std::ranges::find(options_.worlds, key.name) == options_.worlds.end()) {
    throw RequestError("world", UnknownChoiceMessage("world", key.name, options_.worlds), NearestChoice(key.name, options_.worlds));
  }
  const auto slot = std::make_shared<Slot>();
  slot->world = key.name;
  slot->task = request.task;
  // Others see it at once, and find it busy.
  const Turn turn(*this, *slot, Turn::Creates::kYes);
  {
    const std::lock_guard lock(mutex_);
    MakeRoom();
    slot->id = "e" + std::to_string(++made_);
    episodes_[slot->id] = slot;
  }
  try {
    slot->episode = std::make_unique<Episode>(WorldOf(key), request.spec);
    return JsonResponse({{"episode", slot->id},
                         {"world", key.name},
                         {"task", internal::SpecOf(*slot->episode)},
                         {"observation", internal::ObservationOf(*slot->episode, request.observe)}},
                        201);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    episodes_.erase(slot->id);
    throw;
  }
}

AgentResponse AgentApi::List() {
  const std::lock_guard lock(mutex_);
  Answer list = Answer::array();
  for (const auto& [id, slot] : episodes_) {
    list.push_back({{"episode", id}, {"world", slot->world}});
    if (!slot->task.empty()) list.back()["task"] = slot->task;
  }
  return JsonResponse({{"episodes", list}, {"most", options_.max_episodes}});
}

AgentResponse AgentApi::Route(const AgentRequest& request) {
  const std::string_view target = request.target;
  const std::string_view path = target.substr(0, target.find('?'));
  const std::string_view query = path.size() < target.size() ? target.substr(path.size() + 1) : "";
  if (path == "/") {
    RequireMethod(request, "GET");
    return JsonResponse({{"name", "airsim360 agent"},
                         {"world", options_.world},
                         {"worlds", options_.worlds},
                         {"realtime", options_.realtime},
                         {"openapi", "/openapi.json"},
                         {"episodes", "/v1/episodes"},
                         {"tasks", "/v1/tasks"},
                         {"websocket", "/v1/ws"}});
  }
  if (path == "/openapi.json") {
    RequireMethod(request, "GET");
    return {200, "application/json", std::string(AgentOpenApi())};
  }
  if (path == "/v1/tasks") {
    RequireMethod(request, "GET");
    return Tasks();
  }
  constexpr std::string_view kEpisodes = "/v1/episodes";
  if (path == kEpisodes) {
    if (request.method == "GET") return List();
    RequireMethod(request, "POST", "GET, HEAD, POST");
    return Create(request.body);
  }
  if (path.starts_with(kEpisodes) && path.size() > kEpisodes.size() && path[kEpisodes.size()] == '/') {
    const std::string_view rest = path.substr(kEpisodes.size() + 1);
    const size_t slash = rest.find('/');
    const bool has_action = slash != std::string_view::npos;
    return OnEpisode(std::string(rest.substr(0, slash)), has_action ? std::string(rest.substr(slash + 1)) : "", query, request);
  }
  if (path == "/v1/ws")
    throw StatusError(426, "/v1/ws is the WebSocket itself: connect to it with an upgrade, and send it requests for other paths");
  const std::vector<std::string> paths = {"/", "/openapi.json", "/v1/episodes", "/v1/tasks", "/v1/ws"};
  throw StatusError(404, UnknownChoiceMessage("path", path.substr(0, 128), paths));
}

AgentResponse AgentApi::Handle(const AgentRequest& request) {
  try {
    return Route(request);
  } catch (const RequestError& error) {
    return {422, "application/json", internal::ErrorBody(error.field(), error.what(), error.nearest())};
  } catch (const StatusError& error) {
    return {error.status(), "application/json", internal::ErrorBody("", error.what(), ""), error.allow()};
  } catch (const InputError& error) {
    return Refusal(error.what());
  } catch (const std::exception& error) {
    return {500, "application/json", internal::ErrorBody("", error.what(), "")};
  }
}

std::string AgentApi::HandleMessage(std::string_view text) {
  SocketRequest request{.id = "null"};
  AgentResponse response;
  try {
    request = DecodeSocketRequest(text);
    response = Handle({request.method, request.path, request.body});
  } catch (const RequestError& error) {
    response = {422, "application/json", internal::ErrorBody(error.field(), error.what(), error.nearest())};
  }
  // The body is JSON already, or bytes.
  const std::string head = "{\"id\":" + request.id + ",\"status\":" + std::to_string(response.status);
  if (response.content_type == "application/json") return head + ",\"body\":" + response.body + "}";
  return head + ",\"content_type\":\"" + response.content_type + "\",\"data\":\"" + Base64(response.body) + "\"}";
}

}  // namespace airsim360
