#include "airsim360/base/pattern.h"

#include <algorithm>
#include <bit>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/pattern_program.h"

namespace airsim360 {
namespace {

using Kind = PatternProgram::Kind;

constexpr size_t kHalfBytes = 16;  // in a word, and values of one
constexpr int32_t kDead = 0, kStart = 1, kUnknown = -1;
constexpr int32_t kMostStates = 4096;
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
  Explorer(const PatternProgram& program, size_t words) : program_(program), words_(words), seen_(program.nodes.size()) {}

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

void SetBit(std::vector<uint64_t>& bits, size_t i) { bits[i / 64] |= uint64_t{1} << i % 64; }

constexpr Side SideOf(bool is_word) { return is_word ? Side::kWord : Side::kOther; }

}  // namespace

Pattern Pattern::Regex(std::string_view text, bool ignore_case) { return Pattern(ParseRegex(text, ignore_case)); }
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
  for (size_t next = 0; next < sides; ++next) first_[next] = explorer.From(program.start, Side::kNothing, SideOf(next)).places;
  for (size_t last = 0; last < sides; ++last) {
    last_[last].assign(words_, 0);
    for (size_t next = 0; next < sides; ++next)
      follow_[last][next] = {Places(words_), Places(words_), Places(words_ * kHalfBytes * 16 * words_)};
    for (const PatternProgram::Node& node : program.nodes) {
      if (node.kind != Kind::kPlace) continue;
      const size_t place = node.place;
      if (explorer.From(node.next, SideOf(last), Side::kNothing).end) SetBit(last_[last], place);
      for (size_t next = 0; next < sides; ++next) {
        const Places after = explorer.From(node.next, SideOf(last), SideOf(next)).places;
        Follow& follow = follow_[last][next];
        // Programs are written from their end: the next place is the one below.
        Places below(words_);
        if (place > 0) SetBit(below, place - 1);
        if (after == below) {
          SetBit(follow.simple, place);
          continue;
        }
        if (after == Places(words_)) continue;
        SetBit(follow.others, place);
        // In the row of every value of its half byte that has this place.
        for (size_t value = 0; value < 16; ++value) {
          uint64_t* row = &follow.of_half[(place / 4 * 16 + value) * words_];
          for (size_t w = 0; w < words_ && (value >> place % 4 & 1) != 0; ++w) row[w] |= after[w];
        }
      }
    }
  }
  CheckWork();
}

// What the text of one character can cost at the most, held against the limit.
void Pattern::CheckWork() const {
  size_t most = 0;
  for (size_t c = 0; c < class_is_word_.size(); ++c) {
    for (const auto& [last, next] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
      const Places& others = follow_[last][next].others;
      size_t rows = 0;
      for (size_t half = 0; half < others.size() * kHalfBytes; ++half) {
        const size_t w = half / kHalfBytes;
        rows += (class_places_[c * words_ + w] & others[w] & uint64_t{15} << 4 * (half % kHalfBytes)) != 0;
      }
      most = std::max(most, rows * words_);
    }
  }
  if (most > kMostPatternWork) {
    throw InputError("pattern: too many ways to go on: work of " + std::to_string(most) + " for one character is more than " +
                     std::to_string(kMostPatternWork) + "; leave repetitions of repetitions out");
  }
}

// Whether there is any place to go to.
bool Pattern::Advance(const uint64_t* from, bool is_start, bool after_word, size_t byte_class, uint64_t* to) const {
  const bool before_word = class_is_word_[byte_class];
  const uint64_t* fits = &class_places_[byte_class * words_];
  if (is_start) {
    uint64_t any = 0;
    for (size_t w = 0; w < words_; ++w) any |= to[w] = first_[before_word][w] & fits[w];
    return any != 0;
  }
  const Follow& follow = follow_[after_word][before_word];
  for (size_t w = 0; w < words_; ++w) {
    to[w] = (from[w] & follow.simple[w]) >> 1;
    if (w + 1 < words_) to[w] |= (from[w + 1] & follow.simple[w + 1]) << 63;
  }
  for (size_t w = 0; w < words_; ++w) {
    for (uint64_t left = from[w] & follow.others[w]; left != 0;) {
      const auto half = static_cast<size_t>(std::countr_zero(left)) / 4;
      const uint64_t value = left >> 4 * half & 15;
      left &= ~(uint64_t{15} << 4 * half);
      const uint64_t* row = &follow.of_half[((w * kHalfBytes + half) * 16 + value) * words_];
      for (size_t i = 0; i < words_; ++i) to[i] |= row[i];
    }
  }
  uint64_t any = 0;
  for (size_t w = 0; w < words_; ++w) any |= to[w] &= fits[w];
  return any != 0;
}

bool Pattern::IsEnd(const uint64_t* places, bool after_word) const {
  uint64_t ends = 0;
  for (size_t w = 0; w < words_; ++w) ends |= places[w] & last_[after_word][w];
  return ends != 0;
}

PatternMatcher::PatternMatcher(const Pattern& pattern)
    : pattern_(pattern), scratch_(pattern.words_), passed_{kStart}, passed_sets_(pattern.words_) {
  const std::vector<uint64_t> none(pattern.words_);
  states_ = {State{false, false, none}, State{false, pattern.matches_empty_, none}};
  next_.assign(2 * pattern.class_is_word_.size(), kUnknown);
}

int32_t PatternMatcher::FindOrAdd(const std::vector<uint64_t>& places, bool after_word) {
  if (std::ranges::all_of(places, [](uint64_t word) { return word == 0; })) return kDead;
  uint64_t hash = after_word ? kMixer : 0;
  for (const uint64_t word : places) hash = (std::rotl(hash, 29) ^ word) * kMixer;
  const auto [begin, end] = by_hash_.equal_range(hash);
  for (auto it = begin; it != end; ++it) {
    const State& state = states_[static_cast<size_t>(it->second)];
    if (state.after_word == after_word && state.places == places) return it->second;
  }
  const auto added = static_cast<int32_t>(states_.size());
  states_.push_back({after_word, pattern_.IsEnd(places.data(), after_word), places});
  next_.resize(next_.size() + pattern_.class_is_word_.size(), kUnknown);
  by_hash_.emplace(hash, added);
  return added;
}

int32_t PatternMatcher::Next(int32_t state, size_t byte_class) {
  const State& from = states_[static_cast<size_t>(state)];
  pattern_.Advance(from.places.data(), state == kStart, from.after_word, byte_class, scratch_.data());
  return FindOrAdd(scratch_, pattern_.class_is_word_[byte_class]);
}

bool PatternMatcher::Matches(std::string_view text) {
  // What the last text began with alike led to the same.
  const auto alike = static_cast<size_t>(std::ranges::mismatch(text, text_).in1 - text.begin());
  text_ = text;
  return is_full_ ? MatchesBySets(text, alike) : MatchesByStates(text, alike);
}

bool PatternMatcher::MatchesByStates(std::string_view text, size_t alike) {
  const size_t classes = pattern_.class_is_word_.size();
  passed_.resize(std::min(alike + 1, passed_.size()));
  int32_t state = passed_.back();
  for (size_t i = passed_.size() - 1; i < text.size() && state != kDead; ++i) {
    const size_t byte_class = pattern_.class_[static_cast<uint8_t>(text[i])];
    const size_t at = static_cast<size_t>(state) * classes + byte_class;
    int32_t next = next_[at];
    if (next == kUnknown) next = next_[at] = Next(state, byte_class);
    if (next > kMostStates) {
      is_full_ = true;
      return MatchesBySets(text, 0);
    }
    passed_.push_back(state = next);
  }
  return states_[static_cast<size_t>(state)].is_end;
}

bool PatternMatcher::MatchesBySets(std::string_view text, size_t alike) {
  const size_t words = pattern_.words_;
  passed_sets_.resize(std::max(passed_sets_.size(), (text.size() + 1) * words));
  // A text that begins as one that came to a dead end does so too.
  if (is_dead_end_ && alike >= known_sets_) return false;
  known_sets_ = std::min(alike + 1, known_sets_);
  size_t i = known_sets_ - 1;
  const auto class_of = [&](size_t n) -> size_t { return pattern_.class_[static_cast<uint8_t>(text[n])]; };
  bool after_word = i > 0 && pattern_.class_is_word_[class_of(i - 1)] != 0;
  for (is_dead_end_ = false; i < text.size(); ++i, ++known_sets_) {
    const size_t byte_class = class_of(i);
    uint64_t* from = &passed_sets_[i * words];
    is_dead_end_ = !pattern_.Advance(from, i == 0, after_word, byte_class, from + words);
    if (is_dead_end_) return false;
    after_word = pattern_.class_is_word_[byte_class] != 0;
  }
  return i == 0 ? pattern_.matches_empty_ : pattern_.IsEnd(&passed_sets_[i * words], after_word);
}

}  // namespace airsim360
