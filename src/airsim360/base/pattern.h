// Patterns from strangers, regular expressions and wildcards, matched in linear time whatever they say.
//
// A pattern becomes an automaton whose states are its places for a character (Glushkov's construction), so
// that the places a text can have reached are the bits of a few words. The sets that texts lead to are kept
// as states of a deterministic automaton, which grows while it is used; a pattern that makes it grow too
// large is followed set by set.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace airsim360 {

/// Characters of a pattern at most, its places for a character once repetitions are written out, and the
/// words that have to be looked at for one character of a text.
inline constexpr size_t kLongestPattern = 1000, kMostPatternPlaces = 1024, kMostPatternWork = 96;

/// Immutable. Characters are bytes, letters those of ASCII.
class Pattern {
 public:
  /// The regular language part of ECMAScript's expressions, as std::regex reads them: literals, '.' (all but
  /// ends of lines), [classes] with ranges and [:names:], \d \w \s \D \W \S, groups, '|', * + ? {m,n} and
  /// their lazy forms, ^ $ \b \B, \t \n \r \f \v \0 \cX \xHH. InputError naming the place and the reason for
  /// anything else (back-references, lookaheads) and beyond the limits above.
  static Pattern Regex(std::string_view text, bool ignore_case);
  /// '*' is any text, '?' any character. InputError beyond the limits.
  static Pattern Wildcard(std::string_view text);

 private:
  friend class PatternMatcher;
  using Places = std::vector<uint64_t>;  // a set of places, as bits; or several, one after another
  explicit Pattern(const struct PatternProgram& program);
  void MakeClasses(const PatternProgram& program);
  void MakeFollow(const PatternProgram& program);
  void CheckWork() const;
  bool Advance(const uint64_t* from, bool is_start, bool after_word, size_t byte_class, uint64_t* to) const;
  bool IsEnd(const uint64_t* places, bool after_word) const;

  // The places after each, by whether the last and the next character are of words.
  struct Follow {
    Places simple;   // those that only the place below them follows
    Places others;   // those that something else follows
    Places of_half;  // for every half byte of a set, by its value: what follows the others in it
  };

  size_t words_ = 0;                  // of a set of places
  bool asserts_ = false;              // what follows depends on which characters are of words; else none counts as one
  std::array<uint8_t, 256> class_{};  // of a byte: bytes of a class are alike to all places
  std::vector<uint8_t> class_is_word_;
  Places class_places_;  // by class: the places that its bytes fit
  std::array<std::array<Follow, 2>, 2> follow_;
  std::array<Places, 2> first_;  // by whether the first character is of a word
  std::array<Places, 2> last_;   // by whether the last one is: places where a text may end
  bool matches_empty_ = false;
};

/// Asks a pattern, which must outlive it, about texts. Quickest where neighbouring texts begin alike, as in a
/// sorted list.
class PatternMatcher {
 public:
  explicit PatternMatcher(const Pattern& pattern);
  /// Whether the pattern matches the whole text.
  bool Matches(std::string_view text);

 private:
  struct State {
    bool after_word, is_end;
    std::vector<uint64_t> places;
  };
  bool MatchesByStates(std::string_view text, size_t alike);
  bool MatchesBySets(std::string_view text, size_t alike);
  int32_t Next(int32_t state, size_t byte_class);
  int32_t FindOrAdd(const std::vector<uint64_t>& places, bool after_word);

  const Pattern& pattern_;
  std::vector<State> states_;
  std::vector<int32_t> next_;  // by state and class
  std::unordered_multimap<uint64_t, int32_t> by_hash_;
  std::vector<uint64_t> scratch_;
  bool is_full_ = false;  // too many states: sets from now on

  // What the last text led to, before each of its characters and at its end, until nothing could match any
  // more.
  std::string text_;
  std::vector<int32_t> passed_;
  std::vector<uint64_t> passed_sets_;
  size_t known_sets_ = 1;     // how many of those hold
  bool is_dead_end_ = false;  // after the last of them nothing could match
};

}  // namespace airsim360
