// A pattern as instructions: what parsing gives, before it becomes an automaton.
#pragma once

#include <bitset>
#include <cstdint>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Thompson's construction.
struct PatternProgram {
  enum class Kind : uint8_t { kPlace, kSplit, kLineBegin, kLineEnd, kWordEdge, kNoWordEdge, kEnd };
  using ByteSet = std::bitset<256>;
  struct Node {
    Kind kind;
    uint32_t next = 0;   ///< index of a node; of kPlace: after the character
    uint32_t other = 0;  ///< of kSplit: the other way
    uint32_t place = 0;  ///< of kPlace: index into `places`
  };
  std::vector<Node> nodes;
  std::vector<ByteSet> places;  ///< what fits each place for a character
  uint32_t start = 0;
};

/// Whether a byte is of a word, for \b and \w.
bool IsWordByte(uint8_t byte);

/// InputError as Pattern::Regex and Pattern::Wildcard.
PatternProgram ParseRegex(std::string_view text, bool ignore_case);
PatternProgram ParseWildcard(std::string_view text);

}  // namespace airsim360
