// What can be asked of one episode.
#include <algorithm>

#include "airsim360/base/base64.h"
#include "airsim360/tasks/agent_server/agent_slot.h"

namespace airsim360 {
namespace {

using internal::Answer;
using internal::JsonResponse;
using internal::StatusError;

AgentResponse JpegResponse(const Image<Rgb8>& image, int quality) { return {200, "image/jpeg", internal::JpegOf(image, quality)}; }

const RigidTransform& PoseOf(const Episode& episode) { return episode.vehicle().motion.X_WB; }

}  // namespace

AgentApi::Turn::Turn(AgentApi& api, Slot& slot, Creates creates) : api_(api), slot_(slot), lock_(slot.mutex, std::try_to_lock) {
  if (!lock_) throw StatusError(409, "episode '" + slot.id + "' is busy: one request at a time");
  slot_.touched = api_.Now();
  if (creates == Creates::kYes) return;
  if (slot_.episode == nullptr) throw StatusError(404, "episode '" + slot.id + "' could not be made");
  if (!api_.options_.realtime) return;
  const double before = slot_.episode->seconds();
  slot_.episode->Wait(std::max(0.0, slot_.touched - slot_.answered));
  slot_.latency += slot_.episode->seconds() - before;
}

void AgentApi::Slot::Publish() noexcept {
  if (episode == nullptr) return;
  try {
    auto moment = std::make_shared<internal::WatchedMoment>();
    moment->state = {
        {"episode", id}, {"world", world}, {"task", internal::SpecOf(*episode)}, {"observation", internal::ObservationOf(*episode, {})}};
    if (episode->end() != EpisodeEnd::kRunning) moment->state["score"] = internal::ScoreOf(*episode);
    moment->X_WB = PoseOf(*episode);
    moment->moved = episode->moved();
    moment->world = episode->shared_world();
    const std::lock_guard lock(watched_mutex);
    moment->number = watched ? watched->number + 1 : 1;
    watched = std::move(moment);
  } catch (const std::exception&) {
    // Those who look on see the moment before.
  }
}

AgentResponse AgentApi::Watch(Slot& slot, std::string_view query) {
  const WatchRequest request = DecodeWatchQuery(query);
  std::shared_ptr<const internal::WatchedMoment> moment;
  {
    const std::lock_guard lock(slot.watched_mutex);
    moment = slot.watched;
  }
  if (!moment) throw StatusError(503, "episode '" + slot.id + "' is being made; try again in a second");
  if (moment->number == request.since) return JsonResponse({{"episode", slot.id}, {"number", moment->number}});
  const Frame frame = moment->world->Watched(moment->X_WB, request.width, moment->moved);
  Answer answer = moment->state;
  answer["number"] = moment->number;
  answer["panorama"] = {
      {"width", frame.rgb.width()}, {"height", frame.rgb.height()}, {"data", Base64(internal::JpegOf(frame.rgb, request.quality))}};
  const auto bytes = [](const auto& image) {
    return Base64({reinterpret_cast<const char*>(image.pixels().data()), image.size() * sizeof(image.pixels()[0])});
  };
  if (request.labels) {
    answer["range"] = bytes(frame.range);
    answer["entity"] = bytes(frame.entity);
  }
  return JsonResponse(answer);
}

AgentResponse AgentApi::Entities(Slot& slot) {
  std::shared_ptr<const internal::WatchedMoment> moment;
  {
    const std::lock_guard lock(slot.watched_mutex);
    moment = slot.watched;
  }
  if (!moment) throw StatusError(503, "episode '" + slot.id + "' is being made; try again in a second");
  const Scene& scene = moment->world->scene();
  Answer entities = Answer::object();
  for (const Entity& entity : scene.entities) {
    const Category& category = scene.tree[entity.category];
    entities[std::to_string(entity.id)] = {
        {"name", entity.name}, {"category_path", category.path}, {"kind", category.thing ? "thing" : "stuff"}};
  }
  return JsonResponse(entities);
}

AgentResponse AgentApi::Delete(const std::string& id) {
  const std::shared_ptr<Slot> slot = Find(id);
  const std::lock_guard lock(mutex_);
  episodes_.erase(id);
  return JsonResponse({{"deleted", id}});
}

// In each of these, what can be wrong with the request is found before time passes.

AgentResponse AgentApi::Reset(Slot& slot, const std::string& body) {
  const ResetRequest request = DecodeReset(body);
  const Turn turn(*this, slot);
  slot.episode->Reset(request.seed);
  slot.latency = 0;
  return JsonResponse({{"episode", slot.id},
                       {"task", internal::SpecOf(*slot.episode)},
                       {"observation", internal::ObservationOf(*slot.episode, request.observe)}});
}

AgentResponse AgentApi::Step(Slot& slot, const std::string& body) {
  const StepRequest request = DecodeStep(body);
  const Turn turn(*this, slot);
  slot.episode->Act(request.action);
  return Look(slot, request.observe);
}

AgentResponse AgentApi::Observe(Slot& slot, const std::string& body) {
  const ObserveRequest request = DecodeObserve(body);
  const Turn turn(*this, slot);
  return Look(slot, request);
}

AgentResponse AgentApi::Look(Slot& slot, const ObserveRequest& request) {
  Episode& episode = *slot.episode;
  Answer answer = {{"episode", slot.id}, {"observation", internal::ObservationOf(episode, request)}};
  if (options_.realtime) answer["latency"] = slot.latency;
  if (episode.end() != EpisodeEnd::kRunning) answer["score"] = internal::ScoreOf(episode);
  return JsonResponse(answer);
}

AgentResponse AgentApi::Picture(Slot& slot, const std::string& name, std::string_view query) {
  if (name == "panorama.jpg") {
    const PanoramaRequest panorama = DecodePanoramaQuery(query);
    const Turn turn(*this, slot);
    Episode& episode = *slot.episode;
    return JpegResponse(episode.world().Panorama(PoseOf(episode), panorama.width, panorama.frame, episode.moved()), panorama.quality);
  }
  if (name == "view.jpg") {
    const ViewRequest v = DecodeViewQuery(query);
    const Turn turn(*this, slot);
    Episode& episode = *slot.episode;
    return JpegResponse(episode.world().View(PoseOf(episode), v.azimuth, v.elevation, v.fov, v.width, v.height, episode.moved()),
                        v.quality);
  }
  const GridRequest grid = DecodeGridQuery(query);
  const Turn turn(*this, slot);
  Episode& episode = *slot.episode;
  return JsonResponse(internal::GridOf(episode.world().Grid(PoseOf(episode), grid.rows, grid.columns, episode.moved())));
}

AgentResponse AgentApi::Describe(Slot& slot) {
  const Turn turn(*this, slot);
  Answer answer = {{"episode", slot.id},
                   {"world", slot.world},
                   {"task", internal::SpecOf(*slot.episode)},
                   {"observation", internal::ObservationOf(*slot.episode, {})}};
  // How far it is to the goal would show in the score.
  if (slot.episode->spec().tells_goal || slot.episode->end() != EpisodeEnd::kRunning) answer["score"] = internal::ScoreOf(*slot.episode);
  return JsonResponse(answer);
}

AgentResponse AgentApi::Path(Slot& slot) {
  const Turn turn(*this, slot);
  Answer points = Answer::array();
  for (const Vec3d& p : slot.episode->path()) points.push_back(internal::VectorOf(p));
  return JsonResponse({{"period", 1e-9 * Episode::kPathPeriodNs}, {"p", std::move(points)}});
}

AgentResponse AgentApi::OnEpisode(const std::string& id, const std::string& call, std::string_view query, const AgentRequest& request) {
  if (call.empty() && request.method == "DELETE") return Delete(id);
  static const std::vector<std::string> kCalls = {"reset",    "step", "observe", "range_grid", "panorama.jpg",
                                                  "view.jpg", "path", "watch",   "entities"};
  if (!call.empty() && std::ranges::find(kCalls, call) == kCalls.end())
    throw StatusError(404, UnknownChoiceMessage("resource of an episode", call.substr(0, 64), kCalls));
  const bool changes = call == "reset" || call == "step" || call == "observe";
  internal::RequireMethod(request, changes ? "POST" : "GET", call.empty() ? "GET, HEAD, DELETE" : "");
  const std::shared_ptr<Slot> slot = Find(id);
  if (call == "reset") return Reset(*slot, request.body);
  if (call == "step") return Step(*slot, request.body);
  if (call == "observe") return Observe(*slot, request.body);
  if (call == "path") return Path(*slot);
  if (call == "watch") return Watch(*slot, query);
  if (call == "entities") return Entities(*slot);
  return call.empty() ? Describe(*slot) : Picture(*slot, call, query);
}

}  // namespace airsim360
