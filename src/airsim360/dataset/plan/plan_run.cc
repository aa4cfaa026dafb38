#include "airsim360/dataset/plan/plan_run.h"

#include <algorithm>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/plan/plan_labels.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kFrameTime = 10'000'000'000;  // ns from a frame of the plan to the next, at least

CollectInput InputOf(const PlanRun& run, const DatasetSpec& spec, const Scene& labels, const Flight& flight) {
  CollectInput input{spec, labels, flight, run.out};
  input.further_files[kPlanName] = PlanJson(run.plan);
  return input;
}

// Whether the colours of this spec depend on the sky.
bool NeedsSky(const DatasetSpec& spec) { return spec.tier != Tier::kLabels; }

/// Renders blocks; keeps what the next one may need too.
class BlockWriter {
 public:
  BlockWriter(const PlanRun& run, PlanLabels& labels) : run_(run), labels_(labels), source_(run.plan, run.open) {}

  void Write(const FrameBlock& block, std::span<const int64_t> frames, const std::function<void(int64_t)>& done, CollectResult& result) {
    const RecipeRow& row = run_.plan.recipe.rows[block.row];
    const std::shared_ptr<Stage> stage = source_.StageOf(block.row);
    labels_.Fill(block.row, stage->scene());
    DatasetSpec spec = SpecOfPlan(run_.plan, run_.spec, run_.shard, run_.shards);
    const PlannedSky sky = SkyOf(run_.plan, block, stage->environment());
    spec.world = row.world;
    spec.row = row.name;
    spec.seed = block.seed;
    spec.environment = DescribeEnvironment(sky.environment);
    spec.exposure_ev += sky.exposure_ev;
    const Flight flight = source_.ShotsOf(block);
    CollectInput input = InputOf(run_, spec, labels_.scene(), flight);
    input.first_frame = block.first;
    input.t_offset_ns = (row.people > 0 ? FirstFrame(run_.plan, block.row) : block.first) * kFrameTime;
    input.renumber = labels_.Renumbering(block.row);
    input.people = stage->people();
    input.tracer = stage->tracer();
    const CollectResult part = CollectPart(input, RendererFor(*stage, spec, sky.environment), frames, done);
    result.written += part.written, result.render_ms += part.render_ms, result.write_ms += part.write_ms, result.rays += part.rays;
  }

 private:
  // Labels need no sky: one renderer for a world. Else a new one for each, after the last is gone.
  Renderer& RendererFor(Stage& stage, const DatasetSpec& spec, const Environment& sky) {
    if (!NeedsSky(spec)) return stage.renderer(spec.tier);
    renderer_.reset();
    renderer_ = stage.NewRenderer(spec.tier, sky);
    return *renderer_;
  }

  const PlanRun& run_;
  PlanLabels& labels_;
  FrameSource source_;
  std::unique_ptr<Renderer> renderer_;
};

CollectResult WriteBlocks(const PlanRun& run, std::span<const int64_t> frames, const std::function<void(int64_t)>& done, PlanLabels& labels) {
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
      LogWarning("row '" + row.name + "': world '" + row.world + "' did not exist when this was planned; its " + std::to_string(row.frames) + " frames are left out");
  }
}

}  // namespace

DatasetSpec SpecOfPlan(const DatasetPlan& plan, const DatasetSpec& pictures, int64_t shard, int64_t shards) {
  DatasetSpec spec = pictures;
  spec.command = "dataset run";
  spec.plan = plan.hash;
  spec.seed = plan.seed;
  spec.frames = plan.frames();
  spec.shard = shard, spec.shards = shards;
  spec.route = "of the plan";
  spec.environment = "of each frame";
  std::set<std::string> worlds;
  for (const RecipeRow& row : plan.recipe.rows) {
    if (plan.facts(row).exists()) worlds.insert(row.world);
    if (row.people > 0 && plan.facts(row).exists()) spec.people = "in areas of the plan";
  }
  for (const std::string& world : worlds) spec.world += (spec.world.empty() ? "" : ",") + world;
  return spec;
}

CollectResult RunPlan(const PlanRun& run, const RenderElsewhere& elsewhere) {
  CheckExposures(run.plan.recipe, run.spec, "--exposure");
  PlanLabels labels(run.plan);
  const DatasetSpec spec = SpecOfPlan(run.plan, run.spec, run.shard, run.shards);
  const Flight nothing;
  CollectInput input = InputOf(run, spec, labels.scene(), nothing);
  input.frames = FramesOfShard(run.plan, run.shard, run.shards);
  bool all_here = false;
  const RenderElsewhere here = [&](const std::vector<int64_t>& missing, const std::function<void()>& written, CollectResult& result) {
    const CollectResult part = WriteBlocks(run, missing, [&](int64_t) { written(); }, labels);
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
