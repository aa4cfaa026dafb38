#include "airsim360/app/view/viewed_run.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/json_depth.h"
#include "airsim360/math/angles.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int64_t kMostPlaces = 500'000;
constexpr size_t kMostWorlds = 2;
constexpr std::string_view kTranscriptEnd = ".transcript.jsonl";
constexpr const char* kShown[] = {"range", "semantic", "entity", "normal"};

Json PointJson(Vec3d p) { return {p.x, p.y, p.z}; }

Json PointsJson(const std::vector<Vec3d>& points) {
  Json list = Json::array();
  for (const Vec3d& p : points) list.push_back(PointJson(p));
  return list;
}

// The heading at a place: as it was written, else that of the way on.
double HeadingAt(const VlnResult& r, size_t place, double start) {
  if (place < r.heading_deg.size()) return r.heading_deg[place] * kDegree;
  for (size_t i = place + 1; i-- > 0;) {
    if (i + 1 >= r.pred.size()) continue;
    const Vec3d move = r.pred[i + 1] - r.pred[i];
    if (std::hypot(move.x, move.y) > 0.1) return std::atan2(move.y, move.x);
  }
  return start;
}

// results.jsonl of a transcript or of itself.
fs::path ResultsOf(const fs::path& file) {
  const std::string text = file.string();
  return text.ends_with(kTranscriptEnd) ? fs::path(text.substr(0, text.size() - kTranscriptEnd.size()) + ".jsonl") : file;
}

fs::path TranscriptOf(const fs::path& results) { return fs::path(results).replace_extension("").string() + std::string(kTranscriptEnd); }

}  // namespace

// A world that was opened, under a weather, with its people at a time.
struct ViewedRun::World {
  std::string key;
  std::shared_ptr<Stage> stage;
  std::string weather;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<SimLoop> loop;  // of people; null: nobody
  airsim360::Frame frame;

  std::shared_ptr<const SceneState> MovedAt(double seconds) {
    if (!stage->people() && !stage->traffic()) return stage->StartState();
    if (!loop || 1e-9 * static_cast<double>(loop->t_ns()) > seconds + 1e-6)
      loop = std::make_unique<SimLoop>(std::make_shared<const SimModel>(stage->Model()));
    loop->Advance(std::max<int64_t>(0, (std::llround(seconds * 1e9) - loop->t_ns()) / loop->model().dt_ns));
    return SceneStateOf(loop->model(), loop->state(), kNobody);
  }
};

ViewedRun::ViewedRun(const fs::path& results, ViewedRunOptions options)
    : name_(ResultsOf(results).filename().string()), options_(std::move(options)) {
  CheckRenderSettings(options_.picture, "--");
  results_ = ReadResults(ResultsOf(results));
  std::map<std::string, const LanguageEpisode*> by_id;
  const std::vector<LanguageEpisode> all = ReadEpisodes(options_.episodes);
  for (const LanguageEpisode& episode : all) by_id[episode.id] = &episode;
  first_.push_back(0);
  for (const VlnResult& r : results_) {
    const auto found = by_id.find(r.id);
    if (found == by_id.end())
      throw InputError(ResultsOf(results).string() + ": flight '" + r.id + "' is no episode of " + options_.episodes.string());
    episodes_.push_back(*found->second);
    first_.push_back(first_.back() + static_cast<int64_t>(r.pred.size()));
  }
  if (first_.back() > kMostPlaces)
    throw InputError(ResultsOf(results).string() + ": its flights have " + std::to_string(first_.back()) + " places; at most " +
                     std::to_string(kMostPlaces) + " are shown");
  ReadTranscript(TranscriptOf(ResultsOf(results)));
}

ViewedRun::~ViewedRun() = default;

// What a model's answers cost; the last attempt of a decision counts.
void ViewedRun::ReadTranscript(const fs::path& file) {
  if (!fs::exists(file)) return;
  std::istringstream lines(ReadTextFile(file, uint64_t{8} << 30));
  for (std::string line; std::getline(lines, line);) {
    const Json json = JsonDepth(line) > 8 ? Json() : Json::parse(line, nullptr, false);
    if (!json.is_object() || !json.contains("episode") || !json.contains("step")) continue;  // cut off by a run that was killed
    Json said = Json::object();
    for (const char* key : {"model", "attempt", "tokens_in", "tokens_out", "seconds", "cost"})
      if (json.contains(key)) said[key] = json[key];
    exchanges_[json["episode"].get<std::string>() + "#" + json["step"].dump()] = said.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

std::optional<std::string> ViewedRun::Made(std::string_view path) {
  if (path == "index.json") return Index();
  if (path == "entities.json") return Entities();
  const std::optional<int64_t> number = FrameNumber(path, first_.back());
  if (!number) return std::nullopt;
  return Frame(*number);
}

std::string ViewedRun::Index() const {
  Json products{{"rgb", ""}}, stems = Json::array(), times = Json::array(), worlds = Json::array(), flights = Json::array();
  for (const char* name : kShown) products[name] = "";
  for (size_t i = 0; i < results_.size(); ++i) {
    const VlnResult& r = results_[i];
    const LanguageEpisode& e = episodes_[i];
    Json log = Json::array();
    for (const VlnStep& step : r.log) {
      const auto frame = std::min<int64_t>(std::llround(step.t * 1e9) / kPathEveryNs, static_cast<int64_t>(r.pred.size()) - 1);
      Json& said = log.emplace_back(
          Json{{"frame", first_[i] + frame}, {"t", step.t}, {"p", PointJson(step.p)}, {"said", step.said}, {"told", step.told}});
      const auto exchange = exchanges_.find(r.id + "#" + std::to_string(log.size() - 1));
      if (exchange != exchanges_.end()) said["model"] = Json::parse(exchange->second);
    }
    flights.push_back({{"id", r.id},
                       {"first", first_[i]},
                       {"last", first_[i + 1] - 1},
                       {"instruction", e.instruction},
                       {"agent", r.agent},
                       {"view", r.view},
                       {"goal", PointJson(e.goal)},
                       {"radius", r.radius},
                       {"parts", PointsJson(r.parts)},
                       {"ref", PointsJson(r.ref)},
                       {"pred", PointsJson(r.pred)},
                       {"success", r.success},
                       {"end", r.end},
                       {"explanation", r.explanation},
                       {"distance", r.distance},
                       {"path_length", r.path_length},
                       {"geodesic_length", r.geodesic_length},
                       {"seconds", r.seconds},
                       {"decisions", log}});
    for (size_t k = 0; k < r.pred.size(); ++k) {
      stems.push_back(FrameStem(first_[i] + static_cast<int64_t>(k)));
      times.push_back(std::min(1e-9 * static_cast<double>(kPathEveryNs) * static_cast<double>(k), r.seconds));
      worlds.push_back(r.world);
    }
  }
  return Json{{"name", name_},
              {"planned", true},
              {"world", results_.front().world},
              {"seed", episodes_.front().world_seed},
              {"people", false},
              {"products", products},
              {"categories", Json::parse(CategoriesJson(SemanticTree()))},
              {"frames", {{"stem", stems}, {"t", times}, {"range", Json::array()}, {"world", worlds}}},
              {"views", {{{"suffix", ""}, {"projection", "erp"}}}},
              {"flights", flights}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string ViewedRun::Entities() {
  const std::lock_guard lock(mutex_);
  Json entities = Json::object();
  if (worlds_.empty()) return "{}";
  const Scene& scene = worlds_.front().stage->scene();
  for (const Entity& entity : scene.entities) {
    const Category& category = scene.tree[entity.category];
    entities[std::to_string(entity.id)] = {
        {"name", entity.name}, {"category_path", category.path}, {"kind", category.thing ? "thing" : "stuff"}};
  }
  return entities.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ViewedRun::World& ViewedRun::Enter(const LanguageEpisode& e) {
  const std::string key = e.world + "#" + std::to_string(e.world_seed) + "#" + std::to_string(e.people);
  const auto found = std::ranges::find(worlds_, key, &World::key);
  if (found != worlds_.end()) {
    worlds_.splice(worlds_.begin(), worlds_, found);
  } else {
    while (worlds_.size() >= kMostWorlds) worlds_.pop_back();
    worlds_.emplace_front();
    worlds_.front().key = key;
    worlds_.front().stage = options_.open(e.world, e.world_seed, e.people);
  }
  World& world = worlds_.front();
  if (!world.renderer || world.weather != e.weather) {
    world.renderer = e.weather.empty()
                         ? world.stage->NewRenderer(options_.picture.tier)
                         : world.stage->NewRenderer(options_.picture.tier, ApplyFlags({.weather = e.weather}, world.stage->environment()));
    world.weather = e.weather;
  }
  return world;
}

std::string ViewedRun::Frame(int64_t number) {
  const std::lock_guard lock(mutex_);
  const auto flight = static_cast<size_t>(std::ranges::upper_bound(first_, number) - first_.begin() - 1);
  const VlnResult& r = results_[flight];
  const LanguageEpisode& e = episodes_[flight];
  const auto place = static_cast<size_t>(number - first_[flight]);
  World& world = Enter(e);
  RenderRequest request;
  static_cast<RenderSettings&>(request) = options_.picture;
  request.camera = Equirectangular{options_.width, options_.width / 2};
  request.X_WC = BodyPose(r.pred[place], HeadingAt(r, place, e.start.yaw), 0, 0) * CameraInBody();
  request.products = {.rgb = true, .range = true, .semantic = true, .entity = true};
  request.products.normal = true;
  request.state = world.MovedAt(std::min(1e-9 * static_cast<double>(kPathEveryNs) * static_cast<double>(place), r.seconds));
  world.renderer->Render(request, world.frame);
  PlaneMessage planes;
  planes.AddPicture(world.frame.rgb);
  for (const char* name : kShown) planes.AddProduct(world.frame, name);
  const Quaternion q = ToQuaternion(request.X_WC.R);
  const Json header{{"flight", flight}, {"p", PointJson(r.pred[place])}, {"q", {q.w, q.x, q.y, q.z}}, {"persons", Json::array()}};
  const std::string text = header.dump();
  return planes.Finish(text.substr(1, text.size() - 2));
}

}  // namespace airsim360
