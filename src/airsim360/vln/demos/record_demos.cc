#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/math/transform.h"
#include "airsim360/tasks/agent_server/episode.h"
#include "airsim360/video/video_writer.h"
#include "airsim360/vln/demos/demo_writer.h"
#include "airsim360/vln/demos/demos.h"

namespace airsim360 {
namespace internal {

std::vector<float> DemoStep::State() const {
  const Quaternion q = ToQuaternion(motion.X_WB.R);
  const Vec3d &p = motion.X_WB.p, &v = motion.v_WB, &w = motion.w_WB_B;
  std::vector<float> state;
  for (const double value : {p.x, p.y, p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z}) state.push_back(static_cast<float>(value));
  return state;
}

}  // namespace internal

namespace {

using internal::DemoStep;

// What leads from one step to a later one, in the axes of the first one's heading.
std::array<double, 4> Way(const DemoStep& from, const DemoStep& to) {
  const double yaw = HeadingOfBody(from.motion.X_WB), turn = std::remainder(HeadingOfBody(to.motion.X_WB) - yaw, 2 * std::numbers::pi);
  const Vec3d d = to.motion.X_WB.p - from.motion.X_WB.p;
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * d.x + s * d.y, -s * d.x + c * d.y, d.z, turn};
}

// Actions follow from what is flown later. After the last step nothing is done any more.
void AddActions(std::vector<DemoStep>& steps) {
  for (size_t i = 0; i < steps.size(); ++i) {
    const DemoStep &next = steps[std::min(i + 1, steps.size() - 1)], &later = steps[std::min(i + internal::kDemoAhead, steps.size() - 1)];
    const double dt = 1e-9 * static_cast<double>(next.t_ns - steps[i].t_ns);
    const auto velocity = Way(steps[i], next), waypoint = Way(steps[i], later);
    for (size_t k = 0; k < 4; ++k) {
      steps[i].velocity[k] = dt > 0 ? static_cast<float>(velocity[k] / dt) : 0;
      steps[i].waypoint[k] = static_cast<float>(waypoint[k]);
    }
  }
}

class DemoRecorder {
 public:
  explicit DemoRecorder(const DemoOptions& options) : options_(options), folder_(options.out) {}

  DemoSummary Record(const std::vector<LanguageEpisode>& episodes) {
    const size_t count = options_.limit > 0 ? std::min(episodes.size(), static_cast<size_t>(options_.limit)) : episodes.size();
    ProgressBar bar("vln demos", static_cast<int64_t>(count));
    for (size_t i = 0; i < count; ++i) {
      Fly(episodes[i]);
      bar.Update(static_cast<int64_t>(i + 1));
    }
    if (summary_.episodes == 0)
      throw RuntimeError("no episode was flown well: " + summary_.left_out.front().first + ": " + summary_.left_out.front().second);
    for (auto& writer : writers_) writer->Finish();
    folder_.Commit();
    return std::move(summary_);
  }

 private:
  void Fly(const LanguageEpisode& episode) {
    steps_.clear();
    begun_ = false;
    VlnRunOptions run;
    run.width = options_.width;
    run.open = [this](const std::string& world, uint64_t seed, int64_t people) { return StageOf(world, seed, people); };
    run.watch = [&](const Episode& flight) { Watch(episode, flight); };
    const VlnResult result = RunEpisodes({episode}, run).front();
    const bool keep = result.success && steps_.size() > 1;
    if (keep) {
      AddActions(steps_);
      ++summary_.episodes;
      summary_.steps += static_cast<int64_t>(steps_.size());
      summary_.seconds += 1e-9 * static_cast<double>(steps_.back().t_ns);
    } else {
      summary_.left_out.emplace_back(episode.id, result.explanation.empty() ? "it is over at once" : result.explanation);
    }
    if (!begun_) return;
    for (auto& writer : writers_) writer->End(episode, steps_, keep);
  }

  std::shared_ptr<Stage> StageOf(const std::string& world, uint64_t seed, int64_t people) {
    const std::string key = world + "#" + std::to_string(seed) + "#" + std::to_string(people);
    if (key == key_) return stage_;
    weather_.reset();
    renderer_.reset();
    stage_ = options_.open(world, seed, people);
    key_ = key;
    return stage_;
  }

  void Watch(const LanguageEpisode& episode, const Episode& flight) {
    const Vehicle& vehicle = flight.vehicle();
    DemoStep step{.t_ns = flight.state().t_ns, .motion = vehicle.motion};
    const auto rotors = static_cast<size_t>(flight.rotors());
    for (size_t i = 0; i < rotors; ++i) {
      step.rotor_speeds.push_back(static_cast<float>(vehicle.drone.rotor_speeds[i]));
      step.rotor_commands.push_back(static_cast<float>(vehicle.rotor_commands[i]));
    }
    if (writers_.empty()) MakeWriters({options_.width, options_.width / 2, static_cast<int>(rotors)});
    if (!begun_)
      for (auto& writer : writers_) writer->Begin(episode);
    begun_ = true;
    const Image<Rgb8>& picture = Draw(episode, flight);
    for (auto& writer : writers_) writer->AddPicture(picture, step.t_ns);
    steps_.push_back(std::move(step));
  }

  void MakeWriters(const internal::DemoShape& shape) {
    for (const std::string& layout : options_.layouts) {
      if (layout == "jsonl") writers_.push_back(internal::MakeJsonlDemos(folder_, shape));
      if (layout == "rlds") writers_.push_back(internal::MakeRldsDemos(folder_, shape));
      if (layout == "lerobot") writers_.push_back(internal::MakeLeRobotDemos(folder_, shape));
    }
  }

  // A level panorama in the heading of the drone, as agents see.
  const Image<Rgb8>& Draw(const LanguageEpisode& episode, const Episode& flight) {
    if (!renderer_ || weather_ != episode.weather) {
      renderer_ = episode.weather.empty()
                      ? stage_->NewRenderer(options_.picture.tier)
                      : stage_->NewRenderer(options_.picture.tier, ApplyFlags({.weather = episode.weather}, stage_->environment()));
      weather_ = episode.weather;
    }
    const RigidTransform& X_WB = flight.vehicle().motion.X_WB;
    RenderRequest request;
    static_cast<RenderSettings&>(request) = options_.picture;
    request.camera = Equirectangular{options_.width, options_.width / 2};
    request.X_WC = BodyPose(X_WB.p, HeadingOfBody(X_WB), 0, 0) * CameraInBody();
    request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
    request.state = flight.moved();
    renderer_->Render(request, frame_);
    return frame_.rgb;
  }

  const DemoOptions& options_;
  ExportFolder folder_;
  std::vector<std::unique_ptr<internal::DemoWriter>> writers_;
  std::shared_ptr<Stage> stage_;
  std::string key_;
  std::unique_ptr<Renderer> renderer_;
  std::optional<std::string> weather_;
  Frame frame_;
  std::vector<DemoStep> steps_;
  bool begun_ = false;
  DemoSummary summary_;
};

}  // namespace

DemoSummary RecordDemos(const std::vector<LanguageEpisode>& episodes, const DemoOptions& options) {
  const std::vector<std::string> known(std::begin(kDemoLayouts), std::end(kDemoLayouts));
  for (const std::string& layout : options.layouts)
    if (std::ranges::find(known, layout) == known.end()) throw InputError("--layout: " + UnknownChoiceMessage("layout", layout, known));
  if (options.width < 64 || options.width > 4096 || options.width % 4 != 0)
    throw InputError("--width: " + std::to_string(options.width) + " is not in 64 … 4096 or no multiple of 4");
  if (options.limit < 0) throw InputError("--limit: " + std::to_string(options.limit) + " is below 0");
  CheckRenderSettings(options.picture, "--");
  if (options.picture.tier == Tier::kLabels) throw InputError("--tier: labels has no pictures; choices: fast, high, reference");
  if (std::ranges::find(options.layouts, "rlds") == options.layouts.end() || options.layouts.size() > 1) CheckVideoOptions({});
  return DemoRecorder(options).Record(episodes);
}

}  // namespace airsim360
