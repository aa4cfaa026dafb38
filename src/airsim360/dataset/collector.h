// Collecting a dataset: captures along a flight, written so that any interruption can be finished later.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/dataset/record/spec.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {

struct CollectInput {
  const DatasetSpec& spec;
  const Scene& scene;
  const Flight& flight;  ///< its shots are all frames of the dataset; this shard takes its own
  std::filesystem::path out;
  std::string trajectory_json = {};  ///< content of trajectory.json beside trajectory.csv; empty = no such file
  /// Of the scene, whose states the shots hold; null = nobody. `tracer` is of the scene too.
  std::shared_ptr<const SimPeople> people = nullptr;
  std::shared_ptr<const RayTracer> tracer = nullptr;
  std::shared_ptr<const SimTraffic> traffic = nullptr;  ///< likewise; null = no vehicles drive

  // Datasets of a plan, whose frames are of several worlds and taken block by block.
  int64_t first_frame = 0;  ///< of the dataset: that of flight.shots[0]
  int64_t t_offset_ns = 0;  ///< added to the times of the shots
  /// Frames of this shard; unset: those with index % shards == shard.
  std::optional<std::vector<int64_t>> frames = {};
  /// From the entity ids of the world to those of the dataset, which `scene` holds; empty: they are the same.
  std::function<EntityId(EntityId)> renumber = {};
  std::map<std::string, std::string> further_files = {};  ///< name -> content, written with the summaries
  std::function<void()> before_summaries = {};            ///< called when all frames are there
};

/// What a run did.
struct CollectResult {
  int64_t frames = 0;             ///< frames of this shard
  int64_t written = 0;            ///< of them written by this run; 0 if the dataset was complete already
  bool already_complete = false;  ///< nothing was changed
  double render_ms = 0;           ///< rays and shading, all frames written
  double write_ms = 0;            ///< encoding, hashing and writing, all frames written
  double wall_ms = 0;             ///< rendering and writing together, which overlap
  uint64_t rays = 0;
};

/// Renders and writes every frame that is not there yet, then the files that describe them all. The frame is
/// done once the journal names its files' SHA-256. The result depends only on spec, scene and flight: not on
/// threads, interruptions or time. InputError if `out` holds something else; RuntimeError if writing fails:
/// what was done so far stays valid.
CollectResult Collect(const CollectInput& input, Renderer& renderer);

/// Has other processes write the frames `missing` by CollectPart; calls `written` after each and adds to the times and rays
/// of the result. Returns when all are in the journal; throws if that cannot be.
using RenderElsewhere =
    std::function<void(const std::vector<int64_t>& missing, const std::function<void()>& written, CollectResult& result)>;

/// The same dataset, byte for byte, with the frames rendered elsewhere.
CollectResult Collect(const CollectInput& input, const RenderElsewhere& elsewhere);

/// The files that describe the frames in the journal, all of which are there, and last the checksums of everything.
void FinishDataset(const CollectInput& input);

/// Writes those of `frames` that are not in the journal yet into a dataset that another process has begun and will finish;
/// several may do so at once, with different frames. `done` is told of each.
CollectResult CollectPart(const CollectInput& input, Renderer& renderer, std::span<const int64_t> frames,
                          const std::function<void(int64_t frame)>& done);

}  // namespace airsim360
