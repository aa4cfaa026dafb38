#include "airsim360/dataset/plan/plan_block.h"

#include <nlohmann/json.hpp>

#include "airsim360/dataset/record/record.h"
#include "airsim360/scene/scene_archive.h"

namespace airsim360 {
namespace {

constexpr int64_t kFrameTime = 10'000'000'000;  // ns from a frame of the plan to the next, at least

// Time at which the shots of a block begin to count; people live on from block to block.
int64_t TimeOffset(const DatasetPlan& plan, const FrameBlock& block) {
  return (plan.recipe.rows[block.row].people > 0 ? FirstFrame(plan, block.row) : block.first) * kFrameTime;
}

nlohmann::ordered_json Three(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

void FillInput(const DatasetPlan& plan, const FrameBlock& block, int64_t first, Stage& stage, const PlanLabels& labels,
               CollectInput& input) {
  input.first_frame = first;
  input.t_offset_ns = TimeOffset(plan, block);
  input.renumber = labels.Renumbering(block.row);
  input.people = stage.people();
  input.tracer = stage.tracer();
}

std::string PlannedFrameJson(const DatasetPlan& plan, int64_t frame, const Shot& shot, const PlannedSky& sky, const DatasetSpec& spec) {
  const FrameBlock block = BlockOf(plan, frame);
  const RecipeRow& row = plan.recipe.rows[block.row];
  const View view = Views(spec).front();
  const RigidTransform X_WC = CameraPose(PanoramicRig{spec, view.camera, view.X_BC}, shot.body.X_WB);
  const Quaternion q = ToQuaternion(X_WC.R);
  const nlohmann::ordered_json exposure =
      HasOwnExposure(spec) ? nlohmann::ordered_json("auto") : nlohmann::ordered_json(spec.exposure_ev + sky.exposure_ev);
  const nlohmann::ordered_json json = {{"index", frame},
                                       {"row", row.name},
                                       {"world", row.world},
                                       {"t_ns", shot.t_ns + TimeOffset(plan, block)},
                                       {"X_WC", {{"p", Three(X_WC.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}},
                                       {"v_WB", Three(shot.body.v_WB)},
                                       {"w_WB_B", Three(shot.body.w_WB_B)},
                                       {"environment", DescribeEnvironment(sky.environment)},
                                       {"exposure", exposure},
                                       {"people", row.people},
                                       {"seed", block.seed},
                                       {"block", {block.first, block.first + block.count}}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Renderer& SkyRenderer::Get(const std::shared_ptr<Stage>& stage, Tier tier, const Environment& sky) {
  if (tier == Tier::kLabels) return stage->renderer(tier);
  CacheKey values("sky", 1);
  AddToKey(values, sky);
  const std::string key = values.Add(static_cast<int>(tier)).Name();
  if (renderer_ && stage_ == stage && key_ == key) return *renderer_;
  // The last one goes before the next comes.
  renderer_.reset();
  renderer_ = stage->NewRenderer(tier, sky);
  stage_ = stage, key_ = key;
  return *renderer_;
}

}  // namespace airsim360
