// The shots of a flight as a renderer sees them: the rig, where flow leads to, the people of that moment.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "airsim360/dataset/collector.h"
#include "airsim360/dataset/encode.h"

namespace airsim360::internal {

class ShotSource {
 public:
  /// `input` must outlive it.
  explicit ShotSource(const CollectInput& input);
  /// Fills one capture for each of `views` at a shot of the flight and returns the state that they show (nullptr if nothing moves).
  std::shared_ptr<const SceneState> Take(size_t frame, const std::vector<View>& views, const Products& products, Renderer& renderer,
                                         std::vector<Capture>& captures);
  /// Frame `frame` of the dataset as its files show it, and what is to be written of its people: entities have the ids that they
  /// have in the dataset, times count from its start.
  FrameLabels TakeForDataset(int64_t frame, const std::vector<View>& views, Renderer& renderer, std::vector<Capture>& captures);

 private:
  FrameLabels Label(size_t frame, const std::shared_ptr<const SceneState>& state, const std::vector<View>& views,
                    const std::vector<Capture>& captures);
  std::shared_ptr<const SceneState> StateOf(const Shot& shot) const;
  std::shared_ptr<const SceneState> StateAfter(size_t frame) const;
  PeoplePoses PosesOf(const Shot& shot) const;
  std::vector<uint8_t> LevelsOf(const Shot& shot) const;
  std::shared_ptr<const SceneState> Shown(const std::optional<PeoplePoses>& poses, const std::shared_ptr<const TrafficState>& traffic,
                                          int64_t t_ns, const Shot& seen) const;

  const CollectInput& input_;
  std::optional<DynamicTracer> dynamic_;
};

}  // namespace airsim360::internal
