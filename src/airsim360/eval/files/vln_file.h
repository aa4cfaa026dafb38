// Paths of navigation episodes and of those who flew them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/eval/navigation/vln_scores.h"

namespace airsim360 {

struct NamedVlnEpisode {
  std::string id;
  VlnEpisode episode;
};

/// JSON or JSON lines: a list of episodes, {"episodes": [...]}, or an object id -> episode. `episodes` has under each id (`id` or `episode_id`) the reference
/// (`ref` or `reference_path`) and perhaps `goal` (a point, or an object with its `position`), `shortest` (or `geodesic_length`, `geodesic_distance`); `results` the flown path (`pred`, `path`) and perhaps `stop`, `collision`.
/// Either file may hold both, and they may be the same. Points are [x, y, z, …] or [x, y]. In the order of `episodes`. InputError naming the file
/// and the field, or how many episodes have no result and which is the first.
std::vector<NamedVlnEpisode> ReadVlnFiles(const std::filesystem::path& episodes, const std::filesystem::path& results);
std::vector<NamedVlnEpisode> ParseVlnFiles(std::string_view episodes, const std::string& name, std::string_view results,
                                           const std::string& results_name, bool lines);

}  // namespace airsim360
