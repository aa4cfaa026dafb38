// Binding instructions to worlds: episodes with proofs.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"
#include "airsim360/vln/episodes/language_episode.h"

namespace airsim360 {

/// What "mix" draws from.
inline constexpr const char* kMixedWeathers[] = {"clear", "golden", "overcast", "rain", "fog"};

struct VlnMakeOptions {
  std::string world = {}, templates = "paper37";
  uint64_t seed = 0;  ///< worlds of `seeds` seeds from this one on
  int starts = 3, seeds = 1;
  int64_t people = 0;        ///< in episodes when they are flown
  std::string weather = {};  ///< of pictures; "mix": of every episode one of `kMixedWeathers`
  int64_t limit = 0;         ///< episodes of a seed, of all nouns in turn; 0 = all
  std::string split = {};    ///< of all episodes; "" = by seeds and ids
  /// Opens the world of a seed, without people.
  std::function<std::shared_ptr<Stage>(uint64_t seed)> open = {};
};

/// An instruction that a world cannot give, and what competes or is missing.
struct Unbound {
  std::string template_id, world;
  uint64_t world_seed = 0;
  int start = 0;
  std::string why;
};

struct VlnMade {
  std::vector<LanguageEpisode> episodes;
  std::vector<Unbound> unbound;
  /// Episodes that were to begin in sight of the thing and do not, and how much of it they show.
  std::vector<Unbound> hidden = {};
};

/// The same options give the same episodes, whatever the number of threads. A bar of progress. InputError for options that make
/// no sense.
VlnMade MakeEpisodes(const VlnMakeOptions& options);

/// What is wrong with an episode, by the second method.
struct VlnComplaint {
  std::string id, what;
};
/// Proves again that each instruction means one thing, by brute force, that the way is free and ends there, and that the goal
/// is at the thing. `open` as above, by world and seed.
std::vector<VlnComplaint> CheckEpisodes(const std::vector<LanguageEpisode>& episodes,
                                        const std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed)>& open);

}  // namespace airsim360
