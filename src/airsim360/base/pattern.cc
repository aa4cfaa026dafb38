#include "airsim360/base/pattern.h"

#include <algorithm>
#include <bit>
#include <map>

#include "airsim360/base/pattern_program.h"

namespace airsim360 {
namespace {

using Kind = PatternProgram::Kind;

constexpr size_t kHalfBytes = 16;            // in a word, and values of one
constexpr int32_t kDead = 0, kStart = 1, kUnknown = -1;
constexpr size_t kMostStates = 8192;         // of a matcher, before it begins anew
constexpr uint64_t kMixer = 0x9e3779b97f4a7c15;

enum class Side : uint8_t { kNothing, kWord, kOther };  // of a character beside a place between characters

bool Holds(Kind assertion, Side before, Side after) {
  const bool edge = (before == Side::kWord) != (after == Side::kWord);
  switch (assertion) {
    case Kind::kLineBegin:
      return before == Side::kNothing;
    case Kind::kLineEnd:
      return after == Side::kNothing;
    case Kind::kWordEdge:
      return edge;
    default:
      return !edge;
  }
}

// Which places, and whether the end, can come next at a node between two characters.
struct Reached {
  std::vector<uint64_t> places;
  bool end = false;
};

class Explorer {
 public:
  Explorer(const PatternProgram& program, size_t words)
      : program_(program), words_(words), seen_(program.nodes.size()) {}

  Reached From(uint32_t node, Side before, Side after) {
    Reached reached{std::vector<uint64_t>(words_)};
    ++round_;
    waiting_.assign(1, node);
    while (!waiting_.empty()) {
      const uint32_t at = waiting_.back();
      waiting_.pop_back();
      if (seen_[at] == round_) continue;
      seen_[at] = round_;
      const PatternProgram::Node& n = program_.nodes[at];
      if (n.kind == Kind::kPlace) {
        reached.places[n.place / 64] |= uint64_t{1} << n.place % 64;
      } else if (n.kind == Kind::kEnd) {
        reached.end = true;
      } else if (n.kind == Kind::kSplit) {
        waiting_.push_back(n.next);
        waiting_.push_back(n.other);
      } else if (Holds(n.kind, before, after)) {
        waiting_.push_back(n.next);
      }
    }
    return reached;
  }

 private:
  const PatternProgram& program_;
  size_t words_;
  std::vector<uint32_t> seen_;  // by node: the round that was there last
  std::vector<uint32_t> waiting_;
  uint32_t round_ = 0;
};

constexpr Side SideOf(bool is_word) { return is_word ? Side::kWord : Side::kOther; }

}  // namespace

Pattern Pattern::Regex(std::string_view text, bool ignore_case) {
  return Pattern(ParseRegex(text, ignore_case));
}
Pattern Pattern::Wildcard(std::string_view text) { return Pattern(ParseWildcard(text)); }

Pattern::Pattern(const PatternProgram& program) : words_((program.places.size() + 63) / 64) {
  asserts_ = std::ranges::any_of(program.nodes, [](const PatternProgram::Node& node) {
    return node.kind != Kind::kPlace && node.kind != Kind::kSplit && node.kind != Kind::kEnd;
  });
  MakeClasses(program);
  MakeFollow(program);
}

// Bytes that the same places fit are one class, which keeps the tables of matchers small.
void Pattern::MakeClasses(const PatternProgram& program) {
  std::vector<uint8_t> of_byte(256);
  for (size_t byte = 0; byte < 256; ++byte) of_byte[byte] = asserts_ && IsWordByte(static_cast<uint8_t>(byte));
  const auto split_by = [&](const auto& key) {
    std::map<std::pair<uint8_t, bool>, uint8_t> classes;
    for (size_t byte = 0; byte < 256; ++byte) {
      const auto found = classes.try_emplace({of_byte[byte], key(byte)}, static_cast<uint8_t>(classes.size()));
      of_byte[byte] = found.first->second;
    }
  };
  split_by([](size_t) { return false; });
  std::vector<PatternProgram::ByteSet> done;
  for (const PatternProgram::ByteSet& bytes : program.places) {
    // Long patterns repeat few different sets.
    if (std::ranges::find(done, bytes) != done.end()) continue;
    done.push_back(bytes);
    split_by([&](size_t byte) { return bytes[byte]; });
  }
  const size_t count = 1u + *std::ranges::max_element(of_byte);
  class_places_.assign(count * words_, 0);
  class_is_word_.assign(count, 0);
  for (size_t byte = 0; byte < 256; ++byte) {
    const uint8_t c = class_[byte] = of_byte[byte];
    class_is_word_[c] = asserts_ && IsWordByte(static_cast<uint8_t>(byte));
    for (size_t place = 0; place < program.places.size(); ++place) {
      if (program.places[place][byte]) class_places_[c * words_ + place / 64] |= uint64_t{1} << place % 64;
    }
  }
}

void Pattern::MakeFollow(const PatternProgram& program) {
  Explorer explorer(program, words_);
  matches_empty_ = explorer.From(program.start, Side::kNothing, Side::kNothing).end;
  const size_t sides = asserts_ ? 2 : 1;
  for (size_t next = 0; next < sides; ++next)
    first_[next] = explorer.From(program.start, Side::kNothing, SideOf(next)).places;
  for (size_t last = 0; last < sides; ++last) {
    last_[last].assign(words_, 0);
    for (size_t next = 0; next < sides; ++next) follow_[last][next].assign(words_ * kHalfBytes * 16 * words_, 0);
    for (const PatternProgram::Node& node : program.nodes) {
      if (node.kind != Kind::kPlace) continue;
      const uint64_t bit = uint64_t{1} << node.place % 64;
      if (explorer.From(node.next, SideOf(last), Side::kNothing).end) last_[last][node.place / 64] |= bit;
      for (size_t next = 0; next < sides; ++next) {
        const Reached reached = explorer.From(node.next, SideOf(last), SideOf(next));
        // In the row of every value of its half byte that has this place.
        for (size_t value = 0; value < 16; ++value) {
          if ((value >> node.place % 4 & 1) == 0) continue;
          uint64_t* row = &follow_[last][next][(node.place / 4 * 16 + value) * words_];
          for (size_t w = 0; w < words_; ++w) row[w] |= reached.places[w];
        }
      }
    }
  }
}

void Pattern::AddFollow(bool after_word, bool before_word, const Places& from, Places& to) const {
  const Places& follow = follow_[after_word][before_word];
  for (size_t w = 0; w < words_; ++w) {
    for (uint64_t left = from[w]; left != 0;) {
      const auto half_byte = static_cast<size_t>(std::countr_zero(left)) / 4;
      const uint64_t value = left >> 4 * half_byte & 15;
      left &= ~(uint64_t{15} << 4 * half_byte);
      const uint64_t* row = &follow[((w * kHalfBytes + half_byte) * 16 + value) * words_];
      for (size_t i = 0; i < words_; ++i) to[i] |= row[i];
    }
  }
}

PatternMatcher::PatternMatcher(const Pattern& pattern) : pattern_(pattern), scratch_(pattern.words_) { Restart(); }

void PatternMatcher::Restart() {
  by_hash_.clear();
  const std::vector<uint64_t> none(pattern_.words_);
  states_.assign({State{false, false, none}, State{false, pattern_.matches_empty_, none}});
  next_.assign(2 * pattern_.class_is_word_.size(), kUnknown);
  std::fill_n(next_.begin(), pattern_.class_is_word_.size(), kDead);
  passed_.assign(1, kStart);
  text_.clear();
}

int32_t PatternMatcher::FindOrAdd(const std::vector<uint64_t>& places, bool after_word) {
  uint64_t hash = after_word ? kMixer : 0;
  for (const uint64_t word : places) hash = (std::rotl(hash, 29) ^ word) * kMixer;
  if (std::ranges::all_of(places, [](uint64_t word) { return word == 0; })) return kDead;
  const auto [begin, end] = by_hash_.equal_range(hash);
  for (auto it = begin; it != end; ++it) {
    const State& state = states_[static_cast<size_t>(it->second)];
    if (state.after_word == after_word && state.places == places) return it->second;
  }
  bool is_end = false;
  for (size_t w = 0; w < places.size(); ++w) is_end |= (places[w] & pattern_.last_[after_word][w]) != 0;
  const auto added = static_cast<int32_t>(states_.size());
  states_.push_back({after_word, is_end, places});
  next_.resize(next_.size() + pattern_.class_is_word_.size(), kUnknown);
  by_hash_.emplace(hash, added);
  return added;
}

int32_t PatternMatcher::Next(int32_t state, size_t byte_class) {
  const bool before_word = pattern_.class_is_word_[byte_class];
  const uint64_t* fits = &pattern_.class_places_[byte_class * pattern_.words_];
  if (state == kStart) {
    scratch_ = pattern_.first_[before_word];
  } else {
    std::ranges::fill(scratch_, 0);
    const State& from = states_[static_cast<size_t>(state)];
    pattern_.AddFollow(from.after_word, before_word, from.places, scratch_);
  }
  for (size_t w = 0; w < scratch_.size(); ++w) scratch_[w] &= fits[w];
  return FindOrAdd(scratch_, before_word);
}

bool PatternMatcher::Matches(std::string_view text) {
  // What the last text began with alike led to the same states.
  const auto differs = std::ranges::mismatch(text, text_).in1;
  passed_.resize(std::min(static_cast<size_t>(differs - text.begin()) + 1, passed_.size()));
  text_ = text;
  int32_t state = passed_.back();
  for (size_t i = passed_.size() - 1; i < text.size() && state != kDead; ++i) {
    const size_t byte_class = pattern_.class_[static_cast<uint8_t>(text[i])];
    const size_t at = static_cast<size_t>(state) * pattern_.class_is_word_.size() + byte_class;
    if (next_[at] == kUnknown && states_.size() >= kMostStates) {
      // Full: begun anew in the middle of the text, of which nothing is known to the next one then.
      const State here = states_[static_cast<size_t>(state)];
      Restart();
      state = FindOrAdd(here.places, here.after_word);
      i -= 1;
      continue;
    }
    int32_t next = next_[at];
    if (next == kUnknown) next = next_[at] = Next(state, byte_class);
    state = next;
    if (passed_.size() == i + 1) passed_.push_back(state);
  }
  return states_[static_cast<size_t>(state)].is_end;
}

}  // namespace airsim360
