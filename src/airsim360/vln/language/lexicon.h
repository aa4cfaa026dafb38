// What people call the things of a world: words with plurals, and what one could mistake for them in a picture.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/vln/predicates/scene_graph.h"

namespace airsim360 {

/// A word of language data.
struct Word {
  std::string one, many;                ///< "bus", "buses"
  Noun noun;                            ///< what it stands for
  std::vector<std::string> alike = {};  ///< categories that look much the same: where one is in sight, the word is no certain name
};

/// "a" or "an" before a word.
std::string WithArticle(const std::string& word);

/// The words of one scene. Immutable.
class Lexicon {
 public:
  /// Words of built-in categories of everyday size, and the leaves of categories of the scene's own. May be empty.
  explicit Lexicon(const Scene& scene);
  const std::vector<Word>& words() const { return words_; }
  /// Words that name something of the scene.
  size_t in_use() const { return in_use_; }
  /// Words that an entity surely is, and words that somebody might use for it; indices of words().
  std::span<const uint16_t> NamedBy(EntityId entity) const { return named_[entity]; }
  std::span<const uint16_t> MistakenFor(EntityId entity) const { return mistaken_[entity]; }

 private:
  std::vector<Word> words_;
  size_t in_use_ = 0;
  std::vector<std::vector<uint16_t>> named_, mistaken_;  // by entity
};

}  // namespace airsim360
