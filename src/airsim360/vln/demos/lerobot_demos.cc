// Demonstrations as LeRobot takes them: one episode a flight, its instruction as the task.
#include "airsim360/dataset/export/lerobot_writer.h"
#include "airsim360/vln/demos/demo_writer.h"

namespace airsim360::internal {
namespace {

class LeRobotDemos : public DemoWriter {
 public:
  LeRobotDemos(ExportFolder& folder, const DemoShape& shape)
      : writer_(folder, "lerobot/",
                {.rate = kDemoRate,
                 .width = shape.width,
                 .height = shape.height,
                 .spherical = true,
                 .state_names = {std::begin(kDemoStateNames), std::end(kDemoStateNames)},
                 .action_names = {std::begin(kDemoActionNames), std::end(kDemoActionNames)}}) {}

  void Begin(const LanguageEpisode& episode) override { writer_.Begin(episode.instruction); }
  void AddPicture(const Image<Rgb8>& picture, int64_t t_ns) override { writer_.AddPicture(picture, t_ns); }
  void End(const LanguageEpisode&, const std::vector<DemoStep>& steps, bool keep) override {
    if (!keep) {
      writer_.Drop();
      return;
    }
    for (const DemoStep& step : steps) writer_.AddRow(step.State(), {step.velocity.begin(), step.velocity.end()});
    writer_.End();
  }
  void Finish() override { writer_.Finish(); }

 private:
  LeRobotWriter writer_;
};

}  // namespace

std::unique_ptr<DemoWriter> MakeLeRobotDemos(ExportFolder& folder, const DemoShape& shape) {
  return std::make_unique<LeRobotDemos>(folder, shape);
}

}  // namespace airsim360::internal
