#include "airsim360/flight/prompt/lexicon.h"

#include <algorithm>
#include <deque>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace airsim360::internal {
namespace {

struct Entry {
  const Word* word = nullptr;
  bool several = false;  ///< listed as several words
};

/// All aliases by their text without spaces. A word of two languages means what English has it mean.
class Index {
 public:
  Index() {
    for (const auto words : {EnglishWords(), NounWords(), LoadWords(), ForeignWords()}) {
      for (const Word& word : words) Add(word);
    }
  }
  const Entry* Find(std::string_view key) const {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : &found->second;
  }
  const auto& entries() const { return entries_; }

 private:
  void Add(const Word& word) {
    for (std::string_view rest = word.aliases; !rest.empty();) {
      const size_t bar = std::min(rest.find('|'), rest.size());
      const std::string_view alias = rest.substr(0, bar);
      rest.remove_prefix(std::min(bar + 1, rest.size()));
      std::string key;
      std::copy_if(alias.begin(), alias.end(), std::back_inserter(key), [](char c) { return c != ' '; });
      const bool foreign_script = static_cast<unsigned char>(key[0]) >= 0x80;
      const bool several = key.size() < alias.size() || foreign_script;
      const auto [at, is_new] = entries_.try_emplace(texts_.emplace_back(key), Entry{&word, several});
      if (!is_new && at->second.word == &word) at->second.several |= several;
    }
  }
  std::deque<std::string> texts_;
  std::unordered_map<std::string_view, Entry> entries_;
};

const Index& TheIndex() {
  static const Index kIndex;
  return kIndex;
}

/// Edit distance with swaps of neighbours, at most `most`, else most + 1.
size_t Distance(std::string_view a, std::string_view b, size_t most) {
  if (a.size() > b.size() + most || b.size() > a.size() + most) return most + 1;
  std::vector<size_t> before2, before(b.size() + 1), row(b.size() + 1);
  for (size_t k = 0; k <= b.size(); ++k) before[k] = k;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t k = 1; k <= b.size(); ++k) {
      row[k] = std::min({before[k] + 1, row[k - 1] + 1, before[k - 1] + (a[i - 1] != b[k - 1])});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) row[k] = std::min(row[k], before2[k - 2] + 1);
    }
    before2 = std::exchange(before, row);
  }
  return before[b.size()];
}

/// What is left of a word by ear: its consonants, doubled ones once.
std::string Consonants(std::string_view text) {
  std::string sound;
  for (const char c : text) {
    const char heard = c == 'z' ? 's' : c == 'k' || c == 'q' ? 'c' : c;
    if (std::string_view("aeiouyh").find(c) != std::string_view::npos) continue;
    if (sound.empty() || sound.back() != heard) sound += heard;
  }
  return sound;
}

bool Matters(const Word& word) {
  switch (word.kind) {
    case WordKind::kMassUnit:
    case WordKind::kLengthUnit:
    case WordKind::kTimeUnit:
    case WordKind::kVolumeUnit:
    case WordKind::kDrone:
    case WordKind::kRotors:
    case WordKind::kPropeller:
    case WordKind::kMass:
    case WordKind::kPayload:
    case WordKind::kBattery:
    case WordKind::kHover:
    case WordKind::kFlight:
    case WordKind::kWheelbase:
    case WordKind::kGuards:
    case WordKind::kClass:
    case WordKind::kLayout:
      return true;
    default:
      return false;
  }
}

}  // namespace

const Word* FindWord(std::string_view key, bool joined) {
  const Entry* entry = TheIndex().Find(key);
  return entry != nullptr && (!joined || entry->several) ? entry->word : nullptr;
}

std::string_view Respelled(std::string_view text) {
  if (text.size() < 6) return {};
  const size_t most = text.size() >= 9 ? 2 : 1;
  std::string_view best;
  size_t least = most + 1;
  for (const auto& [alias, entry] : TheIndex().entries()) {
    if (alias.size() < (entry.word->kind == WordKind::kHover ? 5 : 6) || alias[0] != text[0] || !Matters(*entry.word)) continue;
    const size_t distance = Distance(text, alias, most);
    // Of equally near ones the first by the alphabet: the index has no order.
    if (distance < least || (distance == least && distance <= most && alias < best)) {
      best = alias;
      least = distance;
    }
  }
  return best;
}

std::string_view UnitAsHeard(std::string_view text) {
  if (text.size() < 5 || FindWord(text, false) != nullptr) return {};
  const std::string sound = Consonants(text);
  std::string_view best;
  for (const auto& [alias, entry] : TheIndex().entries()) {
    const WordKind kind = entry.word->kind;
    const bool unit =
        kind == WordKind::kMassUnit || kind == WordKind::kLengthUnit || kind == WordKind::kTimeUnit || kind == WordKind::kVolumeUnit;
    if (!unit || alias.size() < 5 || alias[0] != text[0] || alias.starts_with("pint")) continue;
    if (Consonants(alias) != sound || Distance(text, alias, 3) > 3) continue;
    if (best.empty() || alias < best) best = alias;
  }
  return best;
}

const Word* FindCompound(std::string_view text) {
  for (const std::string_view head : {"drohne", "drohnen", "copter", "kopter", "gewicht", "akku", "batterie", "kamera", "propeller",
                                      "propellern", "rotoren", "motoren", "tank", "zeit", "minuten"}) {
    if (text.size() < head.size() + 3 || !text.ends_with(head)) continue;
    if (head == "zeit") return FindWord("flugzeit", false);
    return FindWord(head.ends_with("kopter") || head.ends_with("copter") ? "copter" : head, false);
  }
  return nullptr;
}

}  // namespace airsim360::internal
