#include "airsim360/dataset/plan/plan_frames.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/dataset/people/person_record.h"
#include "airsim360/dataset/plan/plan_spec.h"
#include "airsim360/dataset/shot_source.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCacheVersion = 1;

// Everything that pictures depend on beside the number of the frame.
std::string KeyOf(const std::string& meta, const PlanFramesOptions& options, bool uses_gpu) {
  CacheKey key("panoramas", kCacheVersion);
  key.AddProgram().Add(meta).Add(uses_gpu).Add(options.device.gpu);
  const EnvironmentFlags& e = options.environment;
  for (const std::string* text : {&e.weather, &e.sun, &e.time, &e.place, &e.hdri, &e.settings, &e.clouds, &e.sky_seed}) key.Add(*text);
  if (!e.hdri.empty()) key.AddFile(e.hdri);
  return key.Name();
}

// InputError for options that make no sense.
const PlanFramesOptions& Checked(const PlanFramesOptions& options) {
  StageOptions stage;
  stage.environment = options.environment, stage.device = options.device;
  CheckStageOptions(stage);
  return options;
}

}  // namespace

/// A row whose world is open.
struct PlanFrames::OpenRow {
  size_t row;
  std::unique_ptr<FrameSource> source;
  std::shared_ptr<Stage> stage = nullptr;    // with people
  airsim360::Take take = {};                 // of the last frame
  std::optional<EncodeContext> people = {};  // of rows of people
};

PlanFrames::PlanFrames(DatasetPlan plan, const PlanFramesOptions& options)
    : plan_(std::move(plan)),
      options_(Checked(options)),
      spec_(SpecOfPlan(plan_, options.pictures, 0, 1)),
      labels_(plan_),
      wide_(NeedsWideSemantics(labels_.scene())),
      views_(Views(spec_)),
      uses_gpu_(ChoosesGpu(options.device)),
      cache_(options.cache, options.cache_bytes) {
  CheckExposures(plan_.recipe, spec_, "exposure");
  key_ = KeyOf(MetaText(), options_, uses_gpu_);
}

PlanFrames::~PlanFrames() = default;

std::string PlanFrames::MetaText() const { return MetaJson(spec_, labels_.scene()); }

std::vector<PlanFrames::Thing> PlanFrames::Things() {
  const std::lock_guard lock(mutex_);
  std::vector<Thing> things;
  for (const Entity& entity : labels_.scene().entities) {
    if (entity.name.empty()) continue;
    const Category& category = labels_.scene().tree[entity.category];
    things.push_back({entity.id, entity.name, category.path, category.thing});
  }
  return things;
}

std::vector<std::pair<int64_t, int64_t>> PlanFrames::Blocks() const {
  std::vector<std::pair<int64_t, int64_t>> blocks;
  for (const auto& [first, last] : RunsThatExist(plan_)) {
    for (int64_t frame = first; frame < last;) {
      const FrameBlock block = BlockOf(plan_, frame);
      blocks.emplace_back(frame, block.first + block.count);
      frame = blocks.back().second;
    }
  }
  return blocks;
}

std::shared_ptr<Stage> PlanFrames::StageOf(const RecipeRow& row) {
  const std::string key = WorldKey(row);
  for (auto it = worlds_.begin(); it != worlds_.end(); ++it) {
    if (it->first != key) continue;
    worlds_.splice(worlds_.begin(), worlds_, it);
    return worlds_.front().second;
  }
  while (worlds_.size() >= kMostWorlds) {
    // Memory first: whatever holds the world goes with it.
    const std::string oldest = worlds_.back().first;
    rows_.remove_if([&](const OpenRow& open) { return WorldKey(plan_.recipe.rows[open.row]) == oldest; });
    renderer_ = {};
    worlds_.pop_back();
  }
  worlds_.emplace_front(key, WorldOpener(options_.device)(row));
  return worlds_.front().second;
}

PlanFrames::OpenRow& PlanFrames::Enter(size_t row) {
  for (auto it = rows_.begin(); it != rows_.end(); ++it) {
    if (it->row != row) continue;
    rows_.splice(rows_.begin(), rows_, it);
    StageOf(plan_.recipe.rows[row]);  // was used now
    return rows_.front();
  }
  if (rows_.size() >= kMostRows) rows_.pop_back();
  OpenRow open{row, std::make_unique<FrameSource>(plan_, [this](const RecipeRow& r) { return StageOf(r); })};
  open.stage = open.source->StageOf(row);
  labels_.Fill(row, open.stage->scene());
  if (open.stage->people()) open.people.emplace(MakeEncodeContext(spec_, labels_.scene(), open.stage->people().get()));
  rows_.push_front(std::move(open));
  return rows_.front();
}

PlanFrames::OpenRow& PlanFrames::Prepare(int64_t frame) {
  const FramePlace place = PlaceOf(plan_, frame);
  const RecipeRow& row = plan_.recipe.rows[place.row];
  if (!plan_.facts(row).exists()) {
    throw InputError("frame " + std::to_string(frame) + " is of world '" + row.world +
                     "', which did not exist when this was planned; plan again when it does");
  }
  OpenRow& open = Enter(place.row);
  const auto end = open.take.first + static_cast<int64_t>(open.take.flight.shots.size());
  if (frame < open.take.first || frame >= end) open.take = open.source->TakeOf(frame);
  return open;
}

PlannedSky PlanFrames::SkyOf(OpenRow& row, const FrameBlock& block) {
  PlannedSky sky = airsim360::SkyOf(plan_, block, row.stage->environment());
  sky.environment = ApplyFlags(options_.environment, sky.environment);
  return sky;
}

void PlanFrames::Open() {
  const std::lock_guard lock(mutex_);
  for (size_t row = 0; row < plan_.recipe.rows.size() && rows_.size() < kMostRows; ++row) {
    const RecipeRow& wanted = plan_.recipe.rows[row];
    const auto is_open = [&](const auto& world) { return world.first == WorldKey(wanted); };
    if (!plan_.facts(wanted).exists() || (worlds_.size() >= kMostWorlds && std::ranges::none_of(worlds_, is_open))) continue;
    const OpenRow& open = Enter(row);
    if (spec_.tier == Tier::kLabels) open.stage->renderer(Tier::kLabels);
  }
}

std::string PlanFrames::Describe(int64_t frame) {
  const std::lock_guard lock(mutex_);
  OpenRow& row = Prepare(frame);
  const FrameBlock block = BlockOf(plan_, frame);
  return PlannedFrameJson(plan_, frame, row.take.flight.shots[static_cast<size_t>(frame - row.take.first)], SkyOf(row, block), spec_);
}

PlanFrame PlanFrames::Take(int64_t frame) {
  const CacheKey key = CacheKey("panorama", kCacheVersion).Add(key_).Add(frame);
  if (const auto found = cache_.Load(key)) {
    PlanFrame kept;
    if (UnpackPictures(found->bytes(), kept.about, kept.pictures)) return kept;
  }
  PlanFrame drawn = Draw(frame);
  if (!cache_.folder().empty()) cache_.Store(key, PackPictures(drawn.about, drawn.pictures));
  return drawn;
}

PlanFrame PlanFrames::Draw(int64_t frame) {
  const std::lock_guard lock(mutex_);
  OpenRow& row = Prepare(frame);
  const FrameBlock block = BlockOf(plan_, frame);
  const PlannedSky sky = SkyOf(row, block);
  const DatasetSpec spec = SpecOfBlock(plan_, block, sky, spec_);
  CollectInput input{spec, labels_.scene(), row.take.flight, {}};
  FillInput(plan_, block, row.take.first, *row.stage, labels_, input);
  internal::ShotSource source(input);
  captures_.resize(views_.size());
  const FrameLabels people = source.TakeForDataset(frame, views_, renderer_.Get(row.stage, spec.tier, sky.environment), captures_);
  const Shot& shot = row.take.flight.shots[static_cast<size_t>(frame - row.take.first)];
  PlanFrame drawn{.about = PlannedFrameJson(plan_, frame, shot, sky, spec_),
                  .pictures = StoredPictures(spec, views_, captures_, input.renumber(row.stage->scene().sky_entity), wide_)};
  if (!people.empty() && spec.products.entity && spec.products.semantic) {
    Json about = Json::parse(drawn.about);
    about["persons"] = Json::parse(PersonsJson(row, people));
    drawn.about = about.dump();
  }
  return drawn;
}

// "[…]": the entries of people.jsonl of all views.
std::string PlanFrames::PersonsJson(const OpenRow& row, const FrameLabels& people) const {
  const EncodeContext& context = *row.people;
  std::string text = "[";
  for (size_t v = 0; v < people.size(); ++v) {
    const Frame& frame = captures_[v].frame;
    const Projection projection = context.views[v].projection;
    const std::vector<Segment> segments =
        FindSegments(frame.entity, frame.semantic, context.scene, context.solid_angles[v],
                     {.wraps = projection == Projection::kErp, .allows_void = projection == Projection::kFisheye});
    for (const PersonRow& person : PersonRows({*context.people, context.views[v].camera, frame.entity, segments}, people[v]))
      text += (text.size() > 1 ? "," : "") + person.json;
  }
  return text + "]";
}

}  // namespace airsim360
