// Splits of Omni360-Human that share nothing: where their subsets are, who lives in them, and the proof.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "airsim360/dataset/people/human_set.h"

namespace airsim360 {

/// The split of subset `k` of a scene: every fifth is of test, one in ten of val, the others of train.
std::string SplitOf(uint64_t k);

/// A subset with its area. `split` is the subset's, or "none" where the world has no place for it apart from other splits: then
/// it is as lively as it gets, and in no split.
struct PlacedSubset {
  HumanSubset subset;
  HumanArea area;
};

/// The subsets of one world, in their order. Those of test and val are placed first; areas of different splits are kSplitGap
/// apart. A pure function of its arguments. InputError as PickArea, for a subset that no place of the world has room for.
std::vector<PlacedSubset> PlaceSubsets(const Scene& scene, const NavMesh& mesh, std::span<const HumanSubset> subsets, uint64_t seed);

/// The seed of a subset's people: other ones in every subset.
uint64_t PeopleSeedOf(const HumanSubset& subset, uint64_t seed);

/// What two splits of a folder of `collect --recipe` have in common; nothing if `ok`.
struct SplitLeaks {
  struct Split {
    std::string name;
    int64_t subsets = 0, pictures = 0, persons = 0;
    int64_t characters = 0;  ///< different bodies
  };
  std::vector<Split> splits;
  int64_t places = 0;      ///< pairs of subsets of different splits whose areas are nearer than kSplitGap
  int64_t characters = 0;  ///< bodies in more than one split: of the procedural ones stature, age, sex and outfit
  int64_t seconds = 0;     ///< seconds of one subset in more than one split
  std::string example;     ///< names what is shared first

  bool ok() const { return places == 0 && characters == 0 && seconds == 0; }
};

/// Reads subsets.json and every people.jsonl. InputError naming the file for what cannot be read.
SplitLeaks FindSplitLeaks(const std::filesystem::path& folder);

}  // namespace airsim360
