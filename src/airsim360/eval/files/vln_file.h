// Paths of navigation episodes and of those who flew them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/navigation/vln_scores.h"

namespace airsim360 {

struct NamedVlnEpisode {
  std::string id;
  VlnEpisode episode;
};

/// JSON or JSON lines: a list of episodes, {"episodes": [...]}, or an object id -> episode. `episodes` has under each id (`id` or
/// `episode_id`) the reference (`ref` or `reference_path`) and perhaps `goal` (a point, or an object with its `position`, `radius` and other
/// `places`), `radius`, `shortest` (or `geodesic_length`, `geodesic_distance`); `results` the flown path (`pred`, `path`) and perhaps `stop`,
/// `collision`. One file may be both. Of two files the truth is the episodes' alone: results that name another goal, reference, shortest
/// way or radius are refused. `radius` replaces what files say of it. Points are [x, y, z, …], or all of an episode [x, y]. In the order of
/// `episodes`. InputError naming the file and the field, how many episodes have no result and which is the first, and files that are swapped.
std::vector<NamedVlnEpisode> ReadVlnFiles(const std::filesystem::path& episodes, const std::filesystem::path& results,
                                          std::optional<double> radius = {});
std::vector<NamedVlnEpisode> ParseVlnFiles(std::string_view episodes, const std::string& name, std::string_view results,
                                           const std::string& results_name, bool lines);

/// Flown paths in centimetres or millimetres: most lead as many times farther than their references; surely where nearly all would have arrived.
LikelyMistake VlnUnitMistake(const std::vector<NamedVlnEpisode>& episodes);

}  // namespace airsim360
