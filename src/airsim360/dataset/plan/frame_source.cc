#include "airsim360/dataset/plan/frame_source.h"

#include <unistd.h>

#include <algorithm>
#include <set>
#include <utility>

#include "airsim360/base/choice.h"
#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_exists.h"
#include "airsim360/scene/scene_archive.h"

namespace airsim360 {
namespace {

constexpr int64_t kBetweenViewpoints = 10'000'000'000;  // ns: lone frames lie far apart in time

Sampler SamplerOf(const RecipeRow& row) { return ParseChoice<Sampler>("sampler", row.sampler, kSamplerNames); }

HumanSubset SubsetOf(const RecipeRow& row) {
  return {.world = row.world,
          .name = row.name,
          .width = row.width,
          .depth = row.depth,
          .people = row.people,
          .pitch_deg = row.pitch_deg,
          .frames = static_cast<int64_t>(row.frames)};
}

// A file that is gone when this is.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("airsim360_people_" + std::to_string(::getpid()) + ".yaml")) {
    WriteFileAtomically(path_, text);
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Hashing a city takes seconds: kept beside the city.
std::string HashOfScene(const Scene& scene) {
  CacheKey key("scene_hash", 2);
  key.Add(scene.cache_key);
  const DiskCache cache = DiskCache::OfUser();
  if (!scene.cache_key.empty()) {
    if (const auto kept = cache.Load(key); kept && kept->bytes().size() == 64) return std::string(AsText(kept->bytes()));
  }
  const std::string hash = Sha256Hex(ArchivePictured(scene));
  if (!scene.cache_key.empty() && !cache.folder().empty()) cache.Store(key, AsBytes(hash));
  return hash;
}

}  // namespace

/// What belongs to one row.
struct FrameSource::RowState {
  size_t row;
  std::shared_ptr<Stage> stage;  // with people
  std::unique_ptr<ViewpointSampler> viewpoints = {};
  std::unique_ptr<FlightFrames> flights = {};
  HumanArea area = {};  // of people
  Flight film = {};     // of people: all frames of the row, once some are asked for
};

OpenWorld WorldOpener(const DeviceChoice& device) {
  return [device](const RecipeRow& row) {
    StageOptions options;
    options.world.world = row.world;
    options.world.seed = row.world_seed;
    options.device = device;
    return std::make_shared<Stage>(options);
  };
}

FrameSource::FrameSource(const DatasetPlan& plan, OpenWorld open) : plan_(plan), open_(std::move(open)) {}
FrameSource::~FrameSource() = default;

// People live from the first frame on, so all frames of a row are filmed together.
const Flight& FrameSource::FilmOf(RowState& state) {
  if (!state.film.shots.empty()) return state.film;
  const RecipeRow& row = plan_.recipe.rows[state.row];
  const HumanRecipe recipe{
      .scenes = {}, .interval = row.interval, .lowest = row.lowest, .highest = row.highest, .frames_a_view = row.view_frames};
  state.film = FilmSubset(recipe, SubsetOf(row), state.area, *state.stage->people(), *stage_->tracer(), plan_.seed);
  // What follows a view is another one.
  std::vector<Shot>& shots = state.film.shots;
  for (size_t k = row.view_frames; k < shots.size(); k += row.view_frames) shots[k - 1].last = true;
  return state.film;
}

FrameSource::RowState& FrameSource::Enter(size_t index) {
  if (row_ && row_->row == index) return *row_;
  const RecipeRow& row = plan_.recipe.rows[index];
  row_.reset();
  if (world_ != WorldKey(row)) {
    // One world at a time.
    stage_.reset(), mesh_.reset(), world_.clear();
    stage_ = open_(row);
    const std::string hash = HashOfScene(stage_->scene());
    if (hash != plan_.facts(row).hash) {
      throw InputError("world '" + WorldKey(row) + "' is not the one that was planned with: its hash is " + hash + ", the plan has " +
                       plan_.facts(row).hash + "; plan again, or use the program and models of then");
    }
    world_ = WorldKey(row);
  }
  row_ = std::make_unique<RowState>(RowState{.row = index, .stage = stage_});
  switch (SamplerOf(row)) {
    case Sampler::kViewpoints: {
      const auto aims = plan_.aims.find(row.name);
      row_->viewpoints = std::make_unique<ViewpointSampler>(*stage_->tracer(), row, plan_.seed,
                                                            aims == plan_.aims.end() ? std::vector<Aim>{} : aims->second);
      break;
    }
    case Sampler::kFlights:
      row_->flights = std::make_unique<FlightFrames>(*stage_, row, plan_.seed);
      break;
    case Sampler::kPeople: {
      if (!mesh_) mesh_ = NavMesh::Build(stage_->scene());
      const HumanArea area = PickArea(stage_->scene(), *mesh_, SubsetOf(row), plan_.seed);
      const ScratchFile file(PeopleFileOf(area, row.people));
      const uint64_t seed = RngStream(plan_.seed, "plan people " + row.name).Bits();
      row_->stage = std::make_shared<Stage>(stage_, PeopleRequest{.file = file.path(), .seed = seed, .navmesh = mesh_});
      row_->area = area;
      break;
    }
  }
  return *row_;
}

const std::shared_ptr<Stage>& FrameSource::StageOf(size_t row) { return Enter(row).stage; }

Flight FrameSource::PartOf(const FrameBlock& block, int64_t first, int64_t last) {
  RowState& state = Enter(block.row);
  const int64_t in_row = block.first - FirstFrame(plan_, block.row), count = last - first;
  Flight flight;
  if (state.viewpoints) {
    flight.shots.resize(static_cast<size_t>(count));
    ParallelFor(count, [&](int64_t i) {
      Shot& shot = flight.shots[static_cast<size_t>(i)];
      const int64_t k = first + i;
      shot.t_ns = k * kBetweenViewpoints;
      shot.body.X_WB = state.viewpoints->Pose(in_row + k);
      shot.last = true;
    });
  } else if (state.flights) {
    const auto size = static_cast<int64_t>(plan_.recipe.rows[block.row].flight_frames);
    const int64_t flights = (count + size - 1) / size;
    std::vector<std::vector<Shot>> shots(static_cast<size_t>(flights));
    ParallelFor(flights, [&](int64_t i) { shots[static_cast<size_t>(i)] = state.flights->Shots((in_row + first) / size + i); });
    for (int64_t k = first; k < last; ++k) {
      flight.shots.push_back(shots[static_cast<size_t>((k - first) / size)][static_cast<size_t>(k % size)]);
      flight.shots.back().t_ns += k / size * size * kBetweenViewpoints;
    }
  } else {
    const auto begin = FilmOf(state).shots.begin() + in_row;
    flight.shots.assign(begin + first, begin + last);
  }
  return flight;
}

Flight FrameSource::ShotsOf(const FrameBlock& block) { return PartOf(block, 0, block.count); }

Take FrameSource::TakeOf(int64_t frame) {
  const FrameBlock block = BlockOf(plan_, frame);
  const RecipeRow& row = plan_.recipe.rows[block.row];
  const Sampler sampler = SamplerOf(row);
  const int64_t size = sampler == Sampler::kViewpoints ? 1
                       : sampler == Sampler::kFlights  ? static_cast<int64_t>(row.flight_frames)
                                                       : block.count;
  const int64_t first = (frame - block.first) / size * size;
  return {block.first + first, PartOf(block, first, std::min(first + size, block.count))};
}

Shot FrameSource::ShotOf(int64_t frame) {
  const Take take = TakeOf(frame);
  return take.flight.shots[static_cast<size_t>(frame - take.first)];
}

WorldFacts FactsOf(const Scene& scene) {
  WorldFacts facts;
  facts.hash = HashOfScene(scene);
  facts.entities = static_cast<int64_t>(scene.entities.size());
  facts.triangles = static_cast<int64_t>(scene.Count().instanced_triangles);
  facts.attributions = scene.attributions;
  std::set<CategoryId> used;
  for (const Entity& entity : scene.entities) used.insert(entity.category);
  for (const CategoryId id : used) facts.categories.push_back(scene.tree[id].path);
  return facts;
}

DatasetPlan MakePlan(const Recipe& recipe, uint64_t seed, const std::function<bool(const std::string& world)>& exists,
                     const OpenWorld& open) {
  constexpr int64_t kMostIds = (1 << 24) - 1;  // of entity pictures
  DatasetPlan plan;
  plan.recipe = recipe;
  plan.seed = seed;
  // World by world, whatever the order of the rows.
  for (const RecipeRow& first : recipe.rows) {
    if (plan.worlds.contains(WorldKey(first))) continue;
    WorldFacts& facts = plan.worlds[WorldKey(first)];
    if (!exists(first.world)) continue;
    const std::shared_ptr<Stage> stage = open(first);
    facts = FactsOf(stage->scene());
    for (const RecipeRow& row : recipe.rows) {
      if (WorldKey(row) != WorldKey(first) || SamplerOf(row) != Sampler::kViewpoints) continue;
      plan.aims[row.name] = ViewpointSampler(*stage->tracer(), row, seed, {}).FindAims();
      if (plan.aims[row.name].empty()) plan.aims.erase(row.name);
    }
  }
  if (EntityCount(plan) > kMostIds)
    throw InputError("plan: its worlds and people have more than 16,777,215 entities, as many as entity pictures can tell apart");
  for (const auto& [key, facts] : plan.worlds) {
    if (!facts.exists())
      LogWarning("world '" + key + "' does not exist yet" + DidYouMean(key, WorldNames()) + ": its rows are kept for later");
  }
  SealPlan(plan);
  return plan;
}

}  // namespace airsim360
