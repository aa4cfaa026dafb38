// What the frames of one block of a plan are taken with.
#pragma once

#include <memory>
#include <string>

#include "airsim360/dataset/collector.h"
#include "airsim360/dataset/plan/plan.h"
#include "airsim360/dataset/plan/plan_labels.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// Sets of `input` what a block decides: times, ids and people. `first` is the frame of the plan of its first shot.
void FillInput(const DatasetPlan& plan, const FrameBlock& block, int64_t first, Stage& stage, const PlanLabels& labels,
               CollectInput& input);

/// What a frame is, as a line of JSON: index, row, world, t_ns, X_WC (of the first view of `spec`), v_WB, w_WB_B, environment (which
/// `render --environment` takes), exposure (stops, or "auto"), people, seed and block, the frames that share its sky.
std::string PlannedFrameJson(const DatasetPlan& plan, int64_t frame, const Shot& shot, const PlannedSky& sky, const DatasetSpec& spec);

/// Keeps the renderer of the last sky: preparing one takes seconds.
class SkyRenderer {
 public:
  /// Draws `stage` under `sky`. Labels need no sky: all skies of a stage share the stage's own renderer then. The one that was
  /// got before may be gone.
  Renderer& Get(const std::shared_ptr<Stage>& stage, Tier tier, const Environment& sky);

 private:
  std::shared_ptr<Stage> stage_;  // of renderer_
  std::string key_;               // of its sky
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace airsim360
