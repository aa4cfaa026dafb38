#include "airsim360/dataset/plan/plan_run.h"

#include <algorithm>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/plan/plan_block.h"
#include "airsim360/dataset/plan/plan_spec.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

CollectInput InputOf(const PlanRun& run, const DatasetSpec& spec, const Scene& labels, const Flight& flight) {
  CollectInput input{spec, labels, flight, run.out};
  input.further_files[kPlanName] = PlanJson(run.plan);
  return input;
}

/// Renders blocks; keeps what the next one may need too.
class BlockWriter {
 public:
  BlockWriter(const PlanRun& run, PlanLabels& labels) : run_(run), labels_(labels), source_(run.plan, run.open) {}

  void Write(const FrameBlock& block, std::span<const int64_t> frames, const std::function<void(int64_t)>& done, CollectResult& result) {
    const std::shared_ptr<Stage> stage = source_.StageOf(block.row);
    labels_.Fill(block.row, stage->scene());
    const PlannedSky sky = SkyOf(run_.plan, block, stage->environment());
    const DatasetSpec spec = SpecOfBlock(run_.plan, block, sky, SpecOfPlan(run_.plan, run_.spec, run_.shard, run_.shards));
    const Flight flight = source_.ShotsOf(block);
    CollectInput input = InputOf(run_, spec, labels_.scene(), flight);
    FillInput(run_.plan, block, block.first, *stage, labels_, input);
    const CollectResult part = CollectPart(input, renderer_.Get(stage, spec.tier, sky.environment), frames, done);
    result.written += part.written, result.render_ms += part.render_ms, result.write_ms += part.write_ms, result.rays += part.rays;
  }

 private:
  const PlanRun& run_;
  PlanLabels& labels_;
  FrameSource source_;
  SkyRenderer renderer_;
};

CollectResult WriteBlocks(const PlanRun& run, std::span<const int64_t> frames, const std::function<void(int64_t)>& done,
                          PlanLabels& labels) {
  CollectResult result{.frames = static_cast<int64_t>(frames.size())};
  BlockWriter writer(run, labels);
  for (size_t begin = 0; begin < frames.size();) {
    const FrameBlock block = BlockOf(run.plan, frames[begin]);
    size_t end = begin;
    while (end < frames.size() && frames[end] < block.first + block.count) ++end;
    writer.Write(block, frames.subspan(begin, end - begin), done, result);
    begin = end;
  }
  return result;
}

// Names of what is seen in frames that earlier runs or other processes have made.
void FillNames(const PlanRun& run, const std::vector<int64_t>& frames, PlanLabels& labels) {
  FrameSource source(run.plan, run.open);
  std::set<size_t> rows;
  for (const int64_t frame : frames) rows.insert(PlaceOf(run.plan, frame).row);
  for (const size_t row : rows) labels.Fill(row, source.StageOf(row)->scene());
}

void TellWaiting(const DatasetPlan& plan) {
  for (const RecipeRow& row : plan.recipe.rows) {
    if (!plan.facts(row).exists())
      LogWarning("row '" + row.name + "': world '" + row.world + "' did not exist when this was planned; its " +
                 std::to_string(row.frames) + " frames are left out");
  }
}

}  // namespace

CollectResult RunPlan(const PlanRun& run, const RenderElsewhere& elsewhere) {
  CheckExposures(run.plan.recipe, run.spec, "--exposure");
  PlanLabels labels(run.plan);
  const DatasetSpec spec = SpecOfPlan(run.plan, run.spec, run.shard, run.shards);
  const Flight nothing;
  CollectInput input = InputOf(run, spec, labels.scene(), nothing);
  input.frames = FramesOfShard(run.plan, run.shard, run.shards);
  bool all_here = false;
  const RenderElsewhere here = [&](const std::vector<int64_t>& missing, const std::function<void()>& written, CollectResult& result) {
    const CollectResult part = WriteBlocks(
        run, missing, [&](int64_t) { written(); }, labels);
    result.render_ms += part.render_ms, result.write_ms += part.write_ms, result.rays += part.rays;
    all_here = missing.size() == input.frames->size();
  };
  input.before_summaries = [&] {
    if (!all_here) FillNames(run, *input.frames, labels);
  };
  CollectResult result = Collect(input, elsewhere ? elsewhere : here);
  TellWaiting(run.plan);
  return result;
}

CollectResult RunPlanPart(const PlanRun& run, std::span<const int64_t> frames, const std::function<void(int64_t frame)>& done) {
  PlanLabels labels(run.plan);
  return WriteBlocks(run, frames, done, labels);
}

}  // namespace airsim360
