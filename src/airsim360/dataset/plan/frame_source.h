// The frames of a plan: worlds opened when they are needed, one at a time, and what the camera does in them.
#pragma once

#include <functional>
#include <memory>

#include "airsim360/dataset/plan/flight_frames.h"
#include "airsim360/dataset/plan/plan.h"
#include "airsim360/dataset/plan/viewpoints.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// Opens the world of a row, without people.
using OpenWorld = std::function<std::shared_ptr<Stage>(const RecipeRow& row)>;
/// As plans need them: without anything that flags could change.
OpenWorld WorldOpener(const DeviceChoice& device);

/// Frames that follow one another in one movement: a viewpoint alone, a flight, the views of people of a row.
struct Take {
  int64_t first = 0;  ///< frame of the plan of flight.shots[0]
  Flight flight;
};

class FrameSource {
 public:
  /// `plan` must outlive it.
  FrameSource(const DatasetPlan& plan, OpenWorld open);
  ~FrameSource();
  /// The world of a row with its people. InputError if it is not the one that was planned with.
  const std::shared_ptr<Stage>& StageOf(size_t row);
  /// One shot for each frame of a block, in order; times count from the start of the block (of the row, with people).
  Flight ShotsOf(const FrameBlock& block);
  /// The take of one frame, as far as its block holds it; its shots are those of ShotsOf.
  Take TakeOf(int64_t frame);
  /// One frame alone; the same as within its block.
  Shot ShotOf(int64_t frame);

 private:
  struct RowState;
  RowState& Enter(size_t row);
  const Flight& FilmOf(RowState& state);
  /// Shots [first, last) of a block, counted from its first; whole takes but at its end.
  Flight PartOf(const FrameBlock& block, int64_t first, int64_t last);

  const DatasetPlan& plan_;
  OpenWorld open_;
  std::string world_;  // key of the one that is open
  std::shared_ptr<Stage> stage_;
  std::shared_ptr<const NavMesh> mesh_;
  std::unique_ptr<RowState> row_;
};

/// What a plan keeps of a world.
WorldFacts FactsOf(const Scene& scene);

/// A plan of a recipe: opens every world that exists once. Rows of other worlds are kept, without facts.
DatasetPlan MakePlan(const Recipe& recipe, uint64_t seed, const std::function<bool(const std::string& world)>& exists,
                     const OpenWorld& open);

}  // namespace airsim360
