// Demonstrations: flights of the oracle as what a model that acts learns from.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/vln/flights/run_episodes.h"

namespace airsim360 {

inline constexpr const char* kDemoLayouts[] = {"jsonl", "rlds", "lerobot"};

struct DemoOptions {
  std::vector<std::string> layouts = {"jsonl"};
  int width = 512;    ///< of panoramas, pixels
  int64_t limit = 0;  ///< episodes; 0 = all
  RenderSettings picture = {};
  std::filesystem::path out = {};  ///< a folder that does not exist or is empty
  /// Opens a world with its people.
  std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed, int64_t people)> open = {};
};

struct DemoSummary {
  int64_t episodes = 0, steps = 0;
  double seconds = 0;                                         ///< of flight
  std::vector<std::pair<std::string, std::string>> left_out;  ///< episodes that the oracle did not fly well, and why
};

/// Flies episodes under protocol `ours` and writes 10 panoramas, states and actions a second (docs/guide/demonstrations.md), in every layout
/// into a folder of its name. The same episodes and options give the same bytes. InputError naming the option; RuntimeError if no
/// episode is flown well.
DemoSummary RecordDemos(const std::vector<LanguageEpisode>& episodes, const DemoOptions& options);

}  // namespace airsim360
