#include "airsim360/tasks/agent_server/agent_request.h"

#include <charconv>
#include <cmath>
#include <map>

#include "airsim360/flight/drones/catalog.h"
#include "airsim360/math/angles.h"
#include "airsim360/tasks/agent_server/json_fields.h"

namespace airsim360 {
namespace {

using internal::Json;
using internal::JsonFields;

constexpr double kFarthest = 1e5;      // metres
constexpr double kFastest = 100;       // m/s
constexpr size_t kLongestText = 4096;  // bytes of an instruction
constexpr size_t kMostWaypoints = 256, kMostViews = 8;
constexpr int kWidestPanorama = 4096, kWidestView = 2048;

template <size_t N>
std::vector<std::string> Names(const char* const (&names)[N]) {
  return {names, names + N};
}

PanoramaRequest ReadPanorama(JsonFields fields) {
  PanoramaRequest request;
  size_t frame = 0;
  fields.Integer("width", request.width, 16, kWidestPanorama);
  fields.Integer("quality", request.quality, 1, 100);
  fields.Choice("frame", frame, {"level", "body"});
  fields.Finish();
  if (request.width % 2 != 0)
    throw RequestError(fields.PathOf("width"),
                       std::to_string(request.width) +
                           " is odd: a panorama is twice as "
                           "wide as high",
                       std::to_string(request.width - 1));
  request.frame = frame == 0 ? PanoFrame::kLevel : PanoFrame::kBody;
  return request;
}

ViewRequest ReadView(JsonFields fields) {
  ViewRequest request;
  fields.Number("azimuth_deg", request.azimuth, -360, 360, kDegree);
  fields.Number("elevation_deg", request.elevation, -90, 90, kDegree);
  fields.Number("fov_deg", request.fov, 1, 170, kDegree);
  fields.Integer("width", request.width, 16, kWidestView);
  fields.Integer("height", request.height, 16, kWidestView);
  fields.Integer("quality", request.quality, 1, 100);
  fields.Finish();
  return request;
}

GridRequest ReadGrid(JsonFields fields) {
  GridRequest request;
  fields.Integer("rows", request.rows, 1, 64);
  fields.Integer("columns", request.columns, 1, 128);
  fields.Finish();
  return request;
}

// An object, or `true` for one with nothing but defaults; nullptr for `false` too.
const Json* ObjectOrTrue(const Json* value) {
  static const Json kDefaults = Json::object();
  if (value == nullptr || !value->is_boolean()) return value;
  return value->get<bool>() ? &kDefaults : nullptr;
}

ObserveRequest ReadObserve(JsonFields fields) {
  ObserveRequest request;
  if (const Json* value = ObjectOrTrue(fields.Find("panorama"))) request.panorama = ReadPanorama({*value, fields.PathOf("panorama")});
  if (const Json* value = ObjectOrTrue(fields.Find("range_grid"))) request.grid = ReadGrid({*value, fields.PathOf("range_grid")});
  if (const Json* views = fields.Find("views")) {
    const std::string path = fields.PathOf("views");
    if (!views->is_array()) throw RequestError(path, "not a list of views");
    if (views->size() > kMostViews) {
      throw RequestError(path, std::to_string(views->size()) + " views are more than " + std::to_string(kMostViews));
    }
    for (size_t i = 0; i < views->size(); ++i) request.views.push_back(ReadView({(*views)[i], path + "[" + std::to_string(i) + "]"}));
  }
  fields.Finish();
  return request;
}

ObserveRequest TakeObserve(JsonFields& fields) {
  const Json* value = fields.Find("observe");
  return value == nullptr ? ObserveRequest{} : ReadObserve({*value, fields.PathOf("observe")});
}

PresetAction ReadPreset(const std::string& field, const std::string& name) {
  return {static_cast<Preset>(internal::FindChoice(field, "preset", name, Names(kPresetNames)))};
}

// RequestError for a field that an action cannot do without.
void Require(bool given, const JsonFields& fields, const char* name, const char* example) {
  if (!given) throw RequestError(fields.PathOf(name), std::string("is missing; for instance ") + example, example);
}

AgentAction ReadRelativeGoal(JsonFields& fields) {
  RelativeGoalAction action;
  fields.Number("azimuth_deg", action.azimuth, -360, 360, kDegree);
  fields.Number("elevation_deg", action.elevation, -90, 90, kDegree);
  Require(fields.Find("distance") != nullptr, fields, "distance", "5");
  fields.Number("distance", action.distance, 0, 1000);
  fields.Number("speed", action.speed, 0, kFastest);
  fields.Flag("face", action.face);
  return action;
}

AgentAction ReadWaypoints(JsonFields& fields) {
  WaypointsAction action;
  size_t frame = 0;
  Require(fields.Vectors("points", action.points, kMostWaypoints, kFarthest), fields, "points", "[[1, 0, 2], [4, 2, 2]]");
  fields.Choice("frame", frame, {"world", "body"});
  fields.Number("speed", action.speed, 0, kFastest);
  fields.Flag("face", action.face);
  action.body_frame = frame == 1;
  return action;
}

AgentAction ReadVelocity(JsonFields& fields) {
  VelocityAction action;
  size_t frame = 0;
  Require(fields.Vector("v", action.v, kFastest), fields, "v", "[1, 0, 0]");
  fields.Choice("frame", frame, {"body", "world"});
  fields.Number("yaw_rate_deg", action.yaw_rate, -720, 720, kDegree);
  fields.Number("duration", action.duration, 0.001, kLongestAction);
  action.world_frame = frame == 1;
  return action;
}

AgentAction ReadRates(JsonFields& fields) {
  RatesAction action;
  Require(fields.Vector("w", action.w_B, 50), fields, "w", "[0, 0, 0]");
  Require(fields.Find("throttle") != nullptr, fields, "throttle", "0.5");
  fields.Number("throttle", action.throttle, 0, 1);
  fields.Number("duration", action.duration, 0.001, kLongestAction);
  return action;
}

AgentAction ReadAction(const Json* value, const std::string& path) {
  if (value == nullptr) throw RequestError(path, "is missing; for instance \"forward\"", "forward");
  if (value->is_string()) return ReadPreset(path, value->get<std::string>());
  JsonFields fields(*value, path);
  size_t type = 0;
  fields.Choice("type", type, Names(kActionNames));
  AgentAction action;
  switch (type) {
    case 0: {
      std::string name;
      fields.Text("name", name, 64);
      action = ReadPreset(fields.PathOf("name"), name);
      break;
    }
    case 1:
      action = ReadRelativeGoal(fields);
      break;
    case 2:
      action = ReadWaypoints(fields);
      break;
    case 3:
      action = ReadVelocity(fields);
      break;
    default:
      action = ReadRates(fields);
  }
  fields.Finish();
  return action;
}

void ReadStart(JsonFields fields, EpisodeSpec& spec) {
  Vec3d p;
  if (fields.Vector("p", p, kFarthest)) spec.start = p;
  fields.Number("yaw_deg", spec.start_yaw, -360, 360, kDegree);
  fields.Finish();
}

void ReadSuccess(JsonFields fields, EpisodeSpec& spec) {
  size_t rule = static_cast<size_t>(spec.success);
  fields.Choice("rule", rule, Names(kSuccessRuleNames));
  fields.Number("radius", spec.success_radius, 0.01, 1000);
  fields.Finish();
  spec.success = static_cast<SuccessRule>(rule);
}

void ReadPresets(JsonFields fields, PresetSizes& sizes) {
  fields.Number("forward", sizes.forward, 0.05, 100);
  fields.Number("lateral", sizes.lateral, 0.05, 100);
  fields.Number("vertical", sizes.vertical, 0.05, 100);
  fields.Number("turn_deg", sizes.turn, 0.5, 180, kDegree);
  fields.Number("hover", sizes.hover, 0.01, kLongestAction);
  fields.Finish();
}

void ReadLimits(JsonFields fields, EpisodeSpec& spec) {
  fields.Integer("max_steps", spec.max_steps, 1, 100'000);
  fields.Number("max_seconds", spec.max_seconds, 0.1, 3600);
  fields.Flag("end_on_collision", spec.end_on_collision);
  fields.Finish();
}

// "a=1&b=x" as a JSON object: values that look like JSON numbers are numbers.
Json QueryObject(std::string_view query) {
  constexpr size_t kMostParameters = 32, kLongest = 64;
  Json object = Json::object();
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const size_t equals = pair.find('=');
    const std::string key(pair.substr(0, std::min(equals, kLongest)));
    const std::string_view text = equals == std::string_view::npos ? "" : pair.substr(equals + 1);
    double number = 0;
    int64_t whole = 0;
    const char* end = text.data() + text.size();
    if (const auto [at, error] = std::from_chars(text.data(), end, whole); error == std::errc() && at == end) {
      object[key] = whole;
    } else if (const auto [at2, error2] = std::from_chars(text.data(), end, number);
               error2 == std::errc() && at2 == end && std::isfinite(number)) {
      object[key] = number;
    } else {
      object[key] = std::string(text.substr(0, kLongest));
    }
    if (object.size() > kMostParameters) throw RequestError("query", "more than 32 parameters");
  }
  return object;
}

}  // namespace

RequestError::RequestError(std::string field, const std::string& message, std::string nearest)
    : InputError(field.empty() ? message : field + ": " + message), field_(std::move(field)), nearest_(std::move(nearest)) {}

CreateRequest DecodeCreate(std::string_view text) {
  const Json json = internal::ParseJson(text);
  JsonFields fields(json, "");
  CreateRequest request;
  EpisodeSpec& spec = request.spec;
  fields.Text("world", request.world, 256);
  uint64_t world_seed = 0;
  if (fields.Seed("world_seed", world_seed)) request.world_seed = world_seed;
  fields.Text("instruction", spec.instruction, kLongestText);
  Vec3d goal;
  if (fields.Vector("goal", goal, kFarthest)) spec.goal = goal;
  if (const Json* start = fields.Find("start")) ReadStart({*start, "start"}, spec);
  fields.Vectors("reference_path", spec.reference_path, kMostReferencePoints, kFarthest);
  fields.Seed("seed", spec.seed);
  fields.Text("drone", spec.drone, 256);
  std::vector<std::string> drones;
  for (const CatalogDrone& drone : DroneCatalog()) drones.emplace_back(drone.name);
  internal::FindChoice("drone", "drone", spec.drone, drones);
  if (const Json* success = fields.Find("success")) ReadSuccess({*success, "success"}, spec);
  fields.Number("speed", spec.speed, 0.05, kFastest);
  if (const Json* presets = fields.Find("presets")) ReadPresets({*presets, "presets"}, spec.presets);
  if (const Json* limits = fields.Find("limits")) ReadLimits({*limits, "limits"}, spec);
  request.observe = TakeObserve(fields);
  if (fields.Text("task", request.task, 1024); !request.task.empty()) {
    for (const auto& [key, value] : json.items())
      if (key != "task" && key != "observe") throw RequestError(key, "is that of the task; leave it out, or the task");
  }
  fields.Finish();
  return request;
}

ResetRequest DecodeReset(std::string_view text) {
  const Json json = internal::ParseJson(text);
  JsonFields fields(json, "");
  ResetRequest request;
  uint64_t seed = 0;
  if (fields.Seed("seed", seed)) request.seed = seed;
  request.observe = TakeObserve(fields);
  fields.Finish();
  return request;
}

StepRequest DecodeStep(std::string_view text) {
  const Json json = internal::ParseJson(text);
  JsonFields fields(json, "");
  StepRequest request;
  request.action = ReadAction(fields.Find("action"), "action");
  request.observe = TakeObserve(fields);
  fields.Finish();
  return request;
}

ObserveRequest DecodeObserve(std::string_view text) {
  const Json json = internal::ParseJson(text);
  return ReadObserve({json, ""});
}

SocketRequest DecodeSocketRequest(std::string_view text) {
  const Json json = internal::ParseJson(text);
  JsonFields fields(json, "");
  SocketRequest request{.id = "null", .method = "GET", .path = {}, .body = {}};
  if (const Json* id = fields.Find("id")) {
    if (!id->is_number_integer() && !id->is_string()) throw RequestError("id", "is neither a whole number nor a text");
    if (id->is_string() && id->get_ref<const std::string&>().size() > 128) throw RequestError("id", "is longer than 128 bytes");
    request.id = id->dump(-1, ' ', true, Json::error_handler_t::replace);
  }
  size_t method = 0;
  const std::vector<std::string> methods = {"GET", "POST", "DELETE"};
  fields.Choice("method", method, methods);
  request.method = methods[method];
  fields.Text("path", request.path, 1024);
  if (const Json* body = fields.Find("body")) request.body = body->dump(-1, ' ', true, Json::error_handler_t::replace);
  fields.Finish();
  return request;
}

PanoramaRequest DecodePanoramaQuery(std::string_view query) {
  const Json json = QueryObject(query);
  return ReadPanorama({json, ""});
}
WatchRequest DecodeWatchQuery(std::string_view query) {
  const Json json = QueryObject(query);
  WatchRequest request;
  int labels = 0;
  JsonFields fields{json, ""};
  fields.Integer("width", request.width, 16, kWidestPanorama);
  fields.Integer("quality", request.quality, 1, 100);
  fields.Integer("labels", labels, 0, 1);
  fields.Integer("since", request.since, -1, int64_t{1} << 53);
  fields.Finish();
  request.width -= request.width % 2;
  request.labels = labels == 1;
  return request;
}
ViewRequest DecodeViewQuery(std::string_view query) {
  const Json json = QueryObject(query);
  return ReadView({json, ""});
}
GridRequest DecodeGridQuery(std::string_view query) {
  const Json json = QueryObject(query);
  return ReadGrid({json, ""});
}

}  // namespace airsim360
