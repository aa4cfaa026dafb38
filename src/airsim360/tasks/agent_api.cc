#include "airsim360/tasks/agent_api.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "airsim360/tasks/agent_answers.h"

namespace airsim360 {
namespace {

using internal::Answer;

// An answer other than 200 that is no mistake in a field.
class StatusError : public std::runtime_error {
 public:
  StatusError(int status, const std::string& what) : std::runtime_error(what), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

AgentResponse JsonResponse(const Answer& answer, int status = 200) {
  return {status, "application/json", internal::TextOf(answer)};
}

AgentResponse JpegResponse(const Image<Rgb8>& image, int quality) {
  return {200, "image/jpeg", internal::JpegOf(image, quality)};
}

void RequireMethod(const AgentRequest& request, const char* method) {
  if (request.method != method)
    throw StatusError(405, request.method.substr(0, 16) + " is not answered here; use " + method);
}

// "goal: …" as field and message.
AgentResponse Refusal(const std::string& what) {
  const size_t colon = what.find(": ");
  const std::string field = colon == std::string::npos ? "" : what.substr(0, colon);
  const bool is_name = !field.empty() && field.find(' ') == std::string::npos;
  return {422, "application/json", internal::ErrorBody(is_name ? field : "", what, "")};
}

}  // namespace

// One episode and who may touch it.
struct AgentApi::Slot {
  std::string id, world;
  std::mutex mutex;  // of the episode
  std::unique_ptr<Episode> episode;
  double answered = 0;       // when its agent got the last answer
  double latency = 0;        // seconds of thinking charged so far
  std::atomic<double> touched{0};
};

// The right to use an episode for one request. In real time what has passed since the last answer passes in
// the episode too.
class AgentApi::Turn {
 public:
  enum class Creates { kNo, kYes };
  Turn(AgentApi& api, Slot& slot, Creates creates = Creates::kNo)
      : api_(api), slot_(slot), lock_(slot.mutex, std::try_to_lock) {
    if (!lock_) throw StatusError(409, "episode '" + slot.id + "' is busy: one request at a time");
    slot_.touched = api_.Now();
    if (creates == Creates::kYes) return;
    if (slot_.episode == nullptr) throw StatusError(404, "episode '" + slot.id + "' could not be made");
    if (!api_.options_.realtime) return;
    const double waited = std::max(0.0, slot_.touched - slot_.answered);
    const double before = slot_.episode->seconds();
    slot_.episode->Wait(waited);
    slot_.latency += slot_.episode->seconds() - before;
  }
  ~Turn() { slot_.answered = slot_.touched = api_.Now(); }

 private:
  AgentApi& api_;
  Slot& slot_;
  std::unique_lock<std::mutex> lock_;
};

AgentApi::AgentApi(AgentApiOptions options) : options_(std::move(options)) {
  if (std::ranges::find(options_.worlds, options_.world) == options_.worlds.end())
    options_.worlds.push_back(options_.world);
  WorldOf(options_.world, options_.world_seed);
}

AgentApi::~AgentApi() = default;

std::shared_ptr<AgentWorld> AgentApi::WorldOf(const std::string& name, uint64_t seed) {
  const auto find = [&]() -> std::shared_ptr<AgentWorld> {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find_if(
        worlds_, [&](const auto& entry) { return entry.first.first == name && entry.first.second == seed; });
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
      const auto unused = std::find_if(worlds_.begin() + 1, worlds_.end(),
                                       [](const auto& entry) { return entry.second.use_count() == 1; });
      if (unused == worlds_.end())
        throw StatusError(503, std::to_string(worlds_.size()) + " worlds are in use; delete an episode first");
      worlds_.erase(unused);
    }
  }
  auto world = options_.open(name, seed);
  const std::lock_guard lock(mutex_);
  worlds_.push_back({{name, seed}, world});
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
                             (nearest.empty() ? "; create one with POST /v1/episodes"
                                              : "; did you mean '" + nearest + "'?"));
}

// Forgets the episode that has been idle longest, if it was for long enough.
void AgentApi::MakeRoom() {
  if (episodes_.size() < options_.max_episodes) return;
  const auto oldest = std::ranges::min_element(
      episodes_, {}, [](const auto& entry) { return entry.second->touched.load(); });
  if (Now() - oldest->second->touched < options_.idle_seconds) {
    throw StatusError(503, std::to_string(episodes_.size()) +
                               " episodes are open already; delete one with DELETE /v1/episodes/{id}");
  }
  episodes_.erase(oldest);
}

AgentResponse AgentApi::Create(const std::string& body) {
  const CreateRequest request = DecodeCreate(body);
  const std::string name = request.world.empty() ? options_.world : request.world;
  if (std::ranges::find(options_.worlds, name) == options_.worlds.end()) {
    throw RequestError("world", UnknownChoiceMessage("world", name, options_.worlds),
                       NearestChoice(name, options_.worlds));
  }
  const auto slot = std::make_shared<Slot>();
  slot->world = name;
  // Others see it at once, and find it busy.
  const Turn turn(*this, *slot, Turn::Creates::kYes);
  {
    const std::lock_guard lock(mutex_);
    MakeRoom();
    slot->id = "e" + std::to_string(++made_);
    episodes_[slot->id] = slot;
  }
  try {
    slot->episode = std::make_unique<Episode>(
        WorldOf(name, request.world_seed.value_or(options_.world_seed)), request.spec);
    return JsonResponse({{"episode", slot->id},
                         {"world", name},
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
  for (const auto& [id, slot] : episodes_) list.push_back({{"episode", id}, {"world", slot->world}});
  return JsonResponse({{"episodes", list}, {"most", options_.max_episodes}});
}

AgentResponse AgentApi::Delete(const std::string& id) {
  const std::shared_ptr<Slot> slot = Find(id);
  const std::lock_guard lock(mutex_);
  episodes_.erase(id);
  return JsonResponse({{"deleted", id}});
}

AgentResponse AgentApi::OnEpisode(const std::string& id, const std::string& action, std::string_view query,
                                  const AgentRequest& request) {
  if (action.empty() && request.method == "DELETE") return Delete(id);
  const std::vector<std::string> actions = {"",           "reset",        "step",     "observe",
                                            "range_grid", "panorama.jpg", "view.jpg", "path"};
  if (std::ranges::find(actions, action) == actions.end()) {
    throw StatusError(404, UnknownChoiceMessage("resource of an episode", action.substr(0, 64),
                                                {actions.begin() + 1, actions.end()}));
  }
  const bool changes = action == "reset" || action == "step" || action == "observe";
  RequireMethod(request, changes ? "POST" : "GET");
  const std::shared_ptr<Slot> slot = Find(id);

  // What can be wrong with the request is found before time passes.
  if (action == "reset") {
    const ResetRequest reset = DecodeReset(request.body);
    const Turn turn(*this, *slot);
    slot->episode->Reset(reset.seed);
    slot->latency = 0;
    return JsonResponse({{"episode", id},
                         {"task", internal::SpecOf(*slot->episode)},
                         {"observation", internal::ObservationOf(*slot->episode, reset.observe)}});
  }
  if (action == "step" || action == "observe") {
    StepRequest step;
    action == "step" ? (void)(step = DecodeStep(request.body)) : (void)(step.observe = DecodeObserve(request.body));
    const Turn turn(*this, *slot);
    Episode& episode = *slot->episode;
    if (action == "step") episode.Act(step.action);
    Answer answer = {{"episode", id}, {"observation", internal::ObservationOf(episode, step.observe)}};
    if (options_.realtime) answer["latency"] = slot->latency;
    if (episode.end() != EpisodeEnd::kRunning) answer["score"] = internal::ScoreOf(episode);
    return JsonResponse(answer);
  }
  const auto X_WB = [&]() -> const RigidTransform& { return slot->episode->vehicle().motion.X_WB; };
  if (action == "panorama.jpg") {
    const PanoramaRequest panorama = DecodePanoramaQuery(query);
    const Turn turn(*this, *slot);
    return JpegResponse(slot->episode->world().Panorama(X_WB(), panorama.width, panorama.frame),
                        panorama.quality);
  }
  if (action == "view.jpg") {
    const ViewRequest view = DecodeViewQuery(query);
    const Turn turn(*this, *slot);
    return JpegResponse(slot->episode->world().View(X_WB(), view.azimuth, view.elevation, view.fov, view.width,
                                                    view.height),
                        view.quality);
  }
  if (action == "range_grid") {
    const GridRequest grid = DecodeGridQuery(query);
    const Turn turn(*this, *slot);
    return JsonResponse(internal::GridOf(slot->episode->world().Grid(X_WB(), grid.rows, grid.columns)));
  }
  const Turn turn(*this, *slot);
  if (action == "path") {
    Answer points = Answer::array();
    for (const Vec3d& p : slot->episode->path()) points.push_back(internal::VectorOf(p));
    return JsonResponse({{"period", 1e-9 * Episode::kPathPeriodNs}, {"p", std::move(points)}});
  }
  return JsonResponse({{"episode", id},
                       {"world", slot->world},
                       {"task", internal::SpecOf(*slot->episode)},
                       {"observation", internal::ObservationOf(*slot->episode, {})},
                       {"score", internal::ScoreOf(*slot->episode)}});
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
                         {"websocket", "/v1/ws"}});
  }
  if (path == "/openapi.json") {
    RequireMethod(request, "GET");
    return {200, "application/json", std::string(AgentOpenApi())};
  }
  constexpr std::string_view kEpisodes = "/v1/episodes";
  if (path == kEpisodes) {
    if (request.method == "GET") return List();
    RequireMethod(request, "POST");
    return Create(request.body);
  }
  if (path.starts_with(kEpisodes) && path.size() > kEpisodes.size() && path[kEpisodes.size()] == '/') {
    const std::string_view rest = path.substr(kEpisodes.size() + 1);
    const size_t slash = rest.find('/');
    const bool has_action = slash != std::string_view::npos;
    return OnEpisode(std::string(rest.substr(0, slash)), has_action ? std::string(rest.substr(slash + 1)) : "",
                     query, request);
  }
  const std::vector<std::string> paths = {"/", "/openapi.json", "/v1/episodes", "/v1/ws"};
  throw StatusError(404, UnknownChoiceMessage("path", path.substr(0, 128), paths));
}

AgentResponse AgentApi::Handle(const AgentRequest& request) {
  try {
    return Route(request);
  } catch (const RequestError& error) {
    return {422, "application/json", internal::ErrorBody(error.field(), error.what(), error.nearest())};
  } catch (const StatusError& error) {
    return {error.status(), "application/json", internal::ErrorBody("", error.what(), "")};
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
  return head + ",\"content_type\":\"" + response.content_type + "\",\"data\":\"" +
         internal::Base64(response.body) + "\"}";
}

}  // namespace airsim360
