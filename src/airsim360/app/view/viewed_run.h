// Flights of a run of language navigation in the browser: what was asked, decided and seen on the way.
#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"
#include "airsim360/view/drawn_frames.h"
#include "airsim360/vln/flights/run_episodes.h"

namespace airsim360 {

struct ViewedRunOptions {
  std::filesystem::path episodes = {};  ///< that were flown
  RenderSettings picture = {};
  int width = 1024;  ///< of panoramas, pixels
  /// Opens a world with its people.
  std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed, int64_t people)> open = {};
};

/// A frame for each place of each flight, every half second; a level panorama by the heading of the drone. People walk as they
/// do without the drone. index.json has "flights" too: id, first and last frame, instruction, goal, radius, parts, ref, end,
/// explanation, scores, and its decisions.
class ViewedRun : public DrawnFrames {
 public:
  /// `results`: results.jsonl of `vln run`, or the transcript beside it. InputError for what is none, for flights of episodes
  /// that are not in the file, and for more than 500,000 places.
  ViewedRun(const std::filesystem::path& results, ViewedRunOptions options);
  ~ViewedRun() override;

  std::optional<std::string> Made(std::string_view path) override;

 private:
  struct World;
  std::string Index() const;
  std::string Entities();
  std::string Frame(int64_t number);
  World& Enter(const LanguageEpisode& episode);
  void ReadTranscript(const std::filesystem::path& file);

  std::string name_;
  ViewedRunOptions options_;
  std::vector<VlnResult> results_;
  std::vector<LanguageEpisode> episodes_;         // of results_
  std::vector<int64_t> first_;                    // frame of each flight, and the end of the last
  std::map<std::string, std::string> exchanges_;  // EPISODE#STEP -> JSON: model, tokens, seconds, cost

  std::mutex mutex_;         // of what follows
  std::list<World> worlds_;  // the last used first
};

}  // namespace airsim360
