// Which drafts become items: of every text each answer equally often, so that the words alone tell nothing. For the .cc files of this
// folder.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {

/// A draft with where it was made and how it is said.
struct Placed {
  uint64_t lookout = 0;
  std::vector<std::pair<std::string, Picture>> pictures;  ///< what each is called, "panorama", and what it is
  Draft draft;
  size_t text = 0;  ///< of draft.texts
  std::vector<VlnJson> choices = {};
  size_t right = 0;  ///< of choices
};

/// Collects drafts in a fixed order and gives groups of items.
class Balance {
 public:
  /// `matched`: items come in groups of one text with each of its answers; otherwise one by one, choices shuffled. At most
  /// `count` items come out.
  Balance(bool matched, int64_t count, uint64_t seed)
      : matched_(matched), left_(count), slack_(count / 40 + 4), random_(seed, "language balance") {}

  void Add(Placed placed);
  /// To be called after each round of drafts. What is ready, first of the types that have given least; none runs beyond a quarter
  /// of all, where there are enough of them.
  std::vector<Placed> Take();
  /// The last ones that no group is found for any more: without balance, to make up the number. Call once, at the end.
  std::vector<Placed> TakeRest();
  int64_t left() const { return left_; }
  /// Whether a draft lacks nothing but this answer to become an item at once.
  bool Lacks(const Draft& draft) const;

 private:
  struct Waiting {
    std::vector<std::deque<Placed>> by_answer;
  };
  std::vector<Placed> TakeAbout(bool level);
  void Ready(const std::string& type, std::vector<Placed> group);

  bool matched_;
  int64_t left_, slack_;
  int64_t round_ = 0;
  RngStream random_;
  std::map<std::string, Waiting> waiting_;                        // by key
  std::map<std::string, std::deque<std::vector<Placed>>> ready_;  // by type
  std::map<std::string, int64_t> given_;                          // items by type
};

}  // namespace airsim360::internal
