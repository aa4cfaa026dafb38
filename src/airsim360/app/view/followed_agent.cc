#include "airsim360/app/view/followed_agent.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <thread>

#include "airsim360/app/view/followed_pictures.h"
#include "airsim360/base/base64.h"
#include "airsim360/base/error.h"
#include "airsim360/base/json_depth.h"
#include "airsim360/http/http_client.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/transform.h"
#include "airsim360/view/live_messages.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr size_t kMostAnswer = size_t{256} << 20;
constexpr int kDeepest = 12;
constexpr double kPatience = 10, kFirstPatience = 3;  // seconds
constexpr double kShortest = 0.05, kLongest = 0.5;    // seconds of a move
constexpr std::chrono::milliseconds kPause{100};      // between looks at an episode that stands still

std::string UrlOf(const std::string& address, const std::string& path) { return "http://" + address + path; }

Json Parsed(const std::string& body) {
  if (JsonDepth(body) > kDeepest) throw RuntimeError("the server's answer is not understood");
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) throw RuntimeError("the server's answer is not understood");
  return json;
}

// What the server says is wrong with a request.
std::string Complaint(const HttpAnswer& answer) {
  const Json json = Json::parse(answer.body, nullptr, false);
  if (json.is_object() && json.contains("error") && json["error"].is_object()) return json["error"].value("message", answer.fault);
  return answer.fault;
}

template <class Pixel>
Image<Pixel> ImageOf(const Json& json, const char* key, int width, int height) {
  const auto bytes = FromBase64(json.at(key).get_ref<const std::string&>());
  Image<Pixel> image(width, height);
  if (!bytes || bytes->size() != image.size() * sizeof(Pixel)) throw RuntimeError("the server's pictures have another size than they say");
  std::memcpy(image.pixels().data(), bytes->data(), bytes->size());
  return image;
}

struct WatchedPicture {
  std::string jpeg;
  Frame labels;  // range and entity
};

WatchedPicture PictureOf(const Json& watched) {
  const Json& panorama = watched.at("panorama");
  const int width = panorama.at("width").get<int>(), height = panorama.at("height").get<int>();
  if (width < 16 || width > 8192 || height != width / 2) throw RuntimeError("the server's pictures are not understood");
  auto jpeg = FromBase64(panorama.at("data").get_ref<const std::string&>());
  if (!jpeg) throw RuntimeError("the server's pictures are not understood");
  WatchedPicture picture{std::move(*jpeg), {}};
  picture.labels.range = ImageOf<float>(watched, "range", width, height);
  picture.labels.entity = ImageOf<EntityId>(watched, "entity", width, height);
  return picture;
}

}  // namespace

bool IsAgentServer(const std::string& address) {
  const HttpAnswer answer = GetHttp(UrlOf(address, "/"), kFirstPatience, kMostAnswer);
  const Json json = Json::parse(answer.body, nullptr, false);
  return json.is_object() && json.contains("name") && json["name"] == "airsim360 agent";
}

struct FollowedAgent::Impl {
  Json Get(const std::string& path) const;
  std::optional<std::string> Newest() const;
  std::string Episode();
  void Fly(const std::string& episode, const Json& input);
  SocketMessage Picture(const Json& message, bool may_fly);
  SocketMessage Planes(const Json& message);
  SocketMessage Reset();
  std::string HeaderOf(const Json& watched) const;
  SocketMessage Do(const Json& message, bool may_fly);

  FollowOptions options;
  std::string world;
  std::mutex mutex;   // of what follows
  std::string shown;  // the episode of the last picture
  int64_t shown_moment = -1;
  int shown_width = 0;
  SocketMessage last;  // picture
  Clock::time_point moved_at = {};
  int64_t next_number = 1;
  FollowedPictures pictures;
};

Json FollowedAgent::Impl::Get(const std::string& path) const {
  const HttpAnswer answer = GetHttp(UrlOf(options.address, path), kPatience, kMostAnswer);
  if (answer.status == 0) throw RuntimeError("the server at " + options.address + " is gone: " + answer.fault);
  if (!answer.fault.empty()) throw InputError("the server at " + options.address + " says: " + Complaint(answer));
  return Parsed(answer.body);
}

std::optional<std::string> FollowedAgent::Impl::Newest() const {
  const Json list = Get("/v1/episodes");
  int64_t newest = -1;
  for (const Json& entry : list.at("episodes"))
    newest = std::max<int64_t>(newest, std::atoll(entry.at("episode").get<std::string>().c_str() + 1));
  if (newest < 0) return std::nullopt;
  return "e" + std::to_string(newest);
}

std::string FollowedAgent::Impl::Episode() {
  if (!options.episode.empty()) return options.episode;
  if (const auto newest = Newest()) return *newest;
  if (!options.lease) throw InputError("no episode is open at " + options.address + " yet: an agent makes one with POST /v1/episodes");
  const HttpAnswer made = PostJson(UrlOf(options.address, "/v1/episodes"), "", "{}", kPatience, kMostAnswer);
  if (!made.fault.empty()) throw RuntimeError("the server at " + options.address + " makes no episode: " + Complaint(made));
  return Parsed(made.body).at("episode").get<std::string>();
}

// Time in the episode passes in moves alone: as much as has passed here.
void FollowedAgent::Impl::Fly(const std::string& episode, const Json& input) {
  const auto [ahead, left, up, turn] = SticksOf(input);
  if (ahead == 0 && left == 0 && up == 0 && turn == 0) return;
  const auto now = Clock::now();
  const double passed = std::clamp(std::chrono::duration<double>(now - moved_at).count(), kShortest, kLongest);
  moved_at = now;
  const Json action{{"type", "velocity"},
                    {"v", {ahead * kStickSpeed, left * kStickSpeed, up * kStickSpeed}},
                    {"yaw_rate_deg", turn * kStickTurnRate / kDegree},
                    {"duration", passed}};
  const HttpAnswer answer =
      PostJson(UrlOf(options.address, "/v1/episodes/" + episode + "/step"), "", Json{{"action", action}}.dump(), kPatience, kMostAnswer);
  if (answer.status == 0) throw RuntimeError("the server at " + options.address + " is gone: " + answer.fault);
  // Busy with its agent, or over: the picture says so.
}

// Pose, time and task, as fields of the header.
std::string FollowedAgent::Impl::HeaderOf(const Json& watched) const {
  const Json &observation = watched.at("observation"), &pose = observation.at("pose"), &p = pose.at("p");
  const RigidTransform X_WC = BodyPose({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()},
                                       pose.at("yaw_deg").get<double>() * std::numbers::pi / 180, 0, 0) *
                              CameraInBody();
  const Quaternion q = ToQuaternion(X_WC.R);
  Json fields{{"number", next_number},
              {"t", observation.at("t")},
              {"p", p},
              {"q", {q.w, q.x, q.y, q.z}},
              {"v", observation.at("velocity").at("v")},
              {"episode", watched.at("episode")},
              {"instruction", watched.at("task").at("instruction")},
              {"goal", watched.at("task").at("goal")},
              {"step", observation.at("step")},
              {"end", observation.at("end")},
              {"distance", observation.at("distance_to_goal")}};
  if (watched.contains("score")) fields["score"] = watched["score"];
  const std::string text = fields.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

SocketMessage FollowedAgent::Impl::Picture(const Json& message, bool may_fly) {
  const std::lock_guard lock(mutex);
  const int width =
      std::clamp(message.contains("width") && message["width"].is_number_integer() ? message["width"].get<int>() : 1024, 128, 4096);
  const std::string episode = Episode();
  if (options.lease && message.contains("input")) {
    if (!may_fly) throw InputError("token: flying needs the page's token");
    Fly(episode, message["input"]);
  }
  const bool known = episode == shown && width == shown_width;
  const Json watched = Get("/v1/episodes/" + episode + "/watch?labels=1&width=" + std::to_string(width) +
                           "&since=" + std::to_string(known ? shown_moment : -1));
  if (!watched.contains("panorama")) {
    std::this_thread::sleep_for(kPause);
    return last;
  }
  WatchedPicture picture = PictureOf(watched);
  PlaneMessage planes;
  planes.AddJpeg(picture.jpeg, picture.labels.range.width(), picture.labels.range.height());
  planes.AddProduct(picture.labels, "range");
  planes.AddProduct(picture.labels, "entity");
  last = {planes.Finish(HeaderOf(watched)), true};
  pictures.Add(next_number++, std::move(picture.labels));
  shown = episode, shown_width = width, shown_moment = watched.at("number").get<int64_t>();
  return last;
}

SocketMessage FollowedAgent::Impl::Planes(const Json& message) {
  const std::lock_guard lock(mutex);
  const int64_t number = message.contains("number") && message["number"].is_number_integer() ? message["number"].get<int64_t>() : -1;
  return pictures.Planes(number);
}

SocketMessage FollowedAgent::Impl::Reset() {
  const HttpAnswer answer = PostJson(UrlOf(options.address, "/v1/episodes/" + Episode() + "/reset"), "", "{}", kPatience, kMostAnswer);
  if (!answer.fault.empty()) throw InputError("the server at " + options.address + " says: " + Complaint(answer));
  return {R"({"done":"reset"})"};
}

SocketMessage FollowedAgent::Impl::Do(const Json& message, bool may_fly) {
  const std::string what = message.contains("do") && message["do"].is_string() ? message["do"].get<std::string>() : "";
  if (what == "planes") return Planes(message);
  if (what == "picture") return Picture(message, may_fly);
  if (what == "reset" && options.lease) {
    if (!may_fly) throw InputError("token: 'reset' needs the page's token");
    return Reset();
  }
  throw InputError("do: '" + what + "' is none of picture, planes" + (options.lease ? ", reset" : "") + ": the world is elsewhere");
}

FollowedAgent::FollowedAgent(const FollowOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  if (!options.vehicle.empty()) throw InputError("--vehicle: an agent server has episodes; give --episode");
  impl_->world = impl_->Get("/").at("world").get<std::string>();
  if (!options.episode.empty()) impl_->Get("/v1/episodes/" + options.episode + "/entities");
}

FollowedAgent::~FollowedAgent() = default;

std::string FollowedAgent::DescriptionJson() const {
  return Json{{"world", impl_->world + ", agents at " + impl_->options.address},
              {"products", {"range", "entity"}},
              {"scale", {kNearestColor, kFarthestColor}},
              {"weathers", Json::array()},
              {"keeps", false},
              {"flies", impl_->options.lease},
              {"follows", true},
              {"resets", impl_->options.lease},
              {"categories", Json::array()}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string FollowedAgent::EntitiesJson() const {
  const std::string episode = impl_->options.episode.empty() ? impl_->Newest().value_or("") : impl_->options.episode;
  if (episode.empty()) return "{}";
  return impl_->Get("/v1/episodes/" + episode + "/entities").dump(-1, ' ', false, Json::error_handler_t::replace);
}

SocketMessage FollowedAgent::Answer(std::string_view text, const std::string& token) {
  return AnswerMessage<Json>(text, {}, token, [&](const Json& message, bool may_fly) { return impl_->Do(message, may_fly); });
}

}  // namespace airsim360
