// Demonstrations as lines of JSON beside videos.
#include <cstdio>

#include "airsim360/video/video_writer.h"
#include "airsim360/vln/demos/demo_writer.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {
namespace {

std::string Numbered(int64_t number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%06lld", static_cast<long long>(number));
  return text;
}

class JsonlDemos : public DemoWriter {
 public:
  JsonlDemos(ExportFolder& folder, const DemoShape& shape) : folder_(folder), shape_(shape), lines_(folder, "jsonl/demos.jsonl") {}

  void Begin(const LanguageEpisode&) override {
    name_ = "videos/" + Numbered(count_) + ".mp4";
    video_ =
        std::make_unique<VideoWriter>(folder_.Place("jsonl/" + name_), shape_.width, shape_.height, VideoOptions{.frame_rate = kDemoRate});
  }
  void AddPicture(const Image<Rgb8>& picture, int64_t t_ns) override { video_->Add(picture, t_ns); }

  void End(const LanguageEpisode& episode, const std::vector<DemoStep>& steps, bool keep) override {
    if (!keep) {
      video_.reset();
      return;
    }
    video_->Finish();
    ++count_;
    VlnJson list = VlnJson::array();
    for (const DemoStep& step : steps)
      list.push_back({{"t", 1e-9 * static_cast<double>(step.t_ns)},
                      {"state", step.State()},
                      {"rotor_speeds", step.rotor_speeds},
                      {"action", {{"velocity", step.velocity}, {"waypoint", step.waypoint}, {"rotor", step.rotor_commands}}},
                      {"is_last", &step == &steps.back()}});
    const VlnJson line = {{"id", episode.id},
                          {"instruction", episode.instruction},
                          {"world", episode.world},
                          {"world_seed", episode.world_seed},
                          {"weather", episode.weather},
                          {"split", episode.split},
                          {"goal", ToJson(episode.goal)},
                          {"video", name_},
                          {"rate", kDemoRate},
                          {"state_names", kDemoStateNames},
                          {"steps", list}};
    lines_.Append(line.dump() + "\n");
  }

  void Finish() override { lines_.Close(); }

 private:
  ExportFolder& folder_;
  DemoShape shape_;
  GrowingFile lines_;
  std::unique_ptr<VideoWriter> video_;
  std::string name_;
  int64_t count_ = 0;
};

}  // namespace

std::unique_ptr<DemoWriter> MakeJsonlDemos(ExportFolder& folder, const DemoShape& shape) {
  return std::make_unique<JsonlDemos>(folder, shape);
}

}  // namespace airsim360::internal
