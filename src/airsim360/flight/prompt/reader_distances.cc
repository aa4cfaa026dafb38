// How high, how far and for how many days it is to fly, and how many packs feed it.
#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {
namespace {

constexpr size_t kNear = 5;  // tokens on either side that say what a distance is of
constexpr double kMostPacks = 8;

bool SaysAltitude(const std::string& text) {
  return StartsAny(text, {"altitude", "ceiling", "elevation", "hohe", "flughohe", "altura", "stratosphere"}) ||
         IsOneOf(text, {"asl", "amsl", "msl", "agl", "above", "high", "up", "sea level", "hoch", "高", "高度", "海拔"});
}

bool SaysJourney(const std::string& text) {
  return StartsAny(text, {"fly", "flies", "flight", "flown", "travel", "cover", "cross", "journey", "fliegt", "vole", "vuela",
                          "flugstrecke", "reichweite", "autonomie", "autonomia", "飞", "航程"}) ||
         IsOneOf(text, {"range", "trip", "nonstop", "non stop", "goes", "go", "away"});
}

/// What a radio, a camera or a survey reaches is no journey.
bool SaysOtherReach(const std::string& text) {
  return StartsAny(text, {"radio",  "telemetry", "video", "transmission", "transmit", "link",        "control",     "elrs", "crossfire",
                          "signal", "antenna",   "lidar", "remote",       "laser",    "rangefinder", "receiver",    "lora", "detection",
                          "radar",  "day",       "week",  "month",        "year",     "total",       "battery swap"}) ||
         IsOneOf(text, {"rc", "o3", "o4", "rx", "tx", "vtx", "fpv", "lte", "4g", "5g", "per", "swaps"});
}

}  // namespace

/// Whether a word around a quantity, up to the next figure and the end of the phrase, is so.
bool Reader::HasNear(const Quantity& q, bool (*is_word)(const std::string&)) const {
  for (size_t k = q.first; k-- > 0 && q.first - k <= kNear && tokens_[k].kind != Token::Kind::kComma;) {
    if (tokens_[k].kind == Token::Kind::kNumber) break;
    if (is_word(tokens_[k].text)) return true;
  }
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + kNear && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (tokens_[k].kind == Token::Kind::kNumber) break;
    if (is_word(tokens_[k].text)) return true;
  }
  return false;
}

/// "At 5000 m altitude", "30 km high", "flies 20 km": kept for the laws of thrust and energy; true when it was read.
bool Reader::ReadDistance(const Quantity& q) {
  const double metres = tokens_[q.first].value * q.unit->value;
  if (metres < 1000 || HasNear(q, SaysOtherReach)) return false;
  const bool high = HasNear(q, SaysAltitude);
  // So far that its verb may stand anywhere: "from London to New York nonstop (5,500 km)".
  const bool journey = HasNear(q, SaysJourney) || (metres >= 300e3 && std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
                                                     return StartsAny(token.text, {"flies", "fly", "nonstop", "cross"});
                                                   }));
  if (!high && !journey) return false;
  Field& field = high ? request_.altitude : request_.range;
  if (field.value_or(0) < metres) {
    field = metres;
    request_.words[high ? "altitude" : "range"] = q.words;
  }
  NameElse(q, kNone);
  return true;
}

/// "Two 6S 16000 mAh packs in parallel", "2x 10 Ah (parallel)": how many packs share the current, else 1. The charge
/// of a pack whose cells are parallel inside ("6S2P 8400 mAh") is that of the pack.
double Reader::PacksInParallel(const Quantity& q) const {
  bool parallel = false;
  for (size_t k = q.last + 1; k < tokens_.size() && k < q.last + 8 && tokens_[k].text != "."; ++k) {
    if (tokens_[k].kind == Token::Kind::kNumber && !Is(k + 1, WordKind::kCells)) break;
    if (tokens_[k].text == "series" || StartsAny(tokens_[k].text, {"spare", "swap", "extra"})) return 1;
    parallel |= tokens_[k].text.find("parallel") != std::string::npos;
  }
  size_t k = q.first;
  // "Two packs in parallel (4S 5200 each)"
  const bool each = q.last + 1 < tokens_.size() && tokens_[q.last + 1].text == "each";
  for (size_t n = k; each && n-- > 0 && k - n <= 9 && tokens_[n].text != ".";) {
    parallel |= tokens_[n].text.find("parallel") != std::string::npos;
    if (parallel && tokens_[n].Counts(kMostPacks) && Is(n + 1, WordKind::kBattery)) return tokens_[n].value;
  }
  // "Six batteries in parallel, each 6S 4500 mAh"
  for (size_t n = k; n-- > 0 && k - n <= 4;) {
    if (tokens_[n].text != "each") continue;
    bool before = false;
    for (size_t m = q.last + 1; m < tokens_.size() && m <= q.last + 6 && tokens_[m].text != "."; ++m)
      before |= tokens_[m].text.find("parallel") != std::string::npos;  // "two packs, each 5 Ah, in parallel"
    for (size_t m = n; m-- > 0 && n - m <= 12 && tokens_[m].text != ".";) {
      before |= tokens_[m].text.find("parallel") != std::string::npos;
      const bool counts = before && tokens_[m].Counts(kMostPacks) && Is(m + 1, WordKind::kBattery);
      if (counts) return tokens_[m].value;
    }
  }
  while (k > 0 && (IsOneOf(tokens_[k - 1].text, {"pcs", "pc", "pieces", "units", "off", "stuck", "stk"}) || Is(k - 1, WordKind::kCells) ||
                   Is(k - 1, WordKind::kBattery) || Is(k - 1, WordKind::kLithiumIon) || SaysLittle(k - 1) ||
                   (tokens_[k - 1].kind == Token::Kind::kNumber && Is(k, WordKind::kCells))))
    --k;
  // "2x 16000 mAh", "5000 mAh x2": packs that are counted so fly together.
  const bool times = k > 1 && Is(k - 1, WordKind::kTimes) && tokens_[k - 2].kind == Token::Kind::kNumber;
  const size_t after = q.last + (Is(q.last + 1, WordKind::kBattery) ? 2 : 1);
  bool kept = false;  // "450 mAh x 4 (four packs included)"
  for (size_t n = after; n < tokens_.size() && n < after + 7; ++n) kept |= StartsAny(tokens_[n].text, {"includ", "pack", "spare"});
  if (!kept && Is(after, WordKind::kTimes) && after + 1 < tokens_.size() && tokens_[after + 1].Counts(kMostPacks) &&
      (after + 2 >= tokens_.size() || !Is(after + 2, WordKind::kLengthUnit)))
    return tokens_[after + 1].value;
  if (times) --k;
  if (k == 0) return 1;
  const Token& count = tokens_[k - 1];
  const bool pair = IsOneOf(count.text, {"dual", "twin", "pair"});
  parallel |= times;
  if (!parallel || (!pair && !count.Counts(kMostPacks))) return 1;
  return pair ? 2 : count.value;
}

/// "Two batteries of 274 Wh each", "2x 99 Wh packs": energies add up however packs are wired.
double Reader::PacksOf(const Quantity& q) const {
  const bool each = q.last + 1 < tokens_.size() && tokens_[q.last + 1].text == "each";
  const auto is_packs = [&](size_t k) { return IsOneOf(tokens_[k].text, {"packs", "batteries", "lipos", "akkus", "baterias"}); };
  bool packs = q.last + 1 < tokens_.size() && is_packs(q.last + 1);
  for (size_t k = q.first; k-- > 0 && q.first - k <= 6 && tokens_[k].text != ".";) {
    packs |= is_packs(k);
    const Token& token = tokens_[k];
    if (token.kind != Token::Kind::kNumber || Is(k + 1, WordKind::kCells)) continue;
    const bool counts = (packs || each) && token.Counts(kMostPacks);
    return counts && (is_packs(k + 1) || Is(k + 1, WordKind::kTimes) || k + 1 == q.first) ? token.value : 1;
  }
  return 1;
}

/// Cells of a pack that is described by its cells: "6S4P from 5 Ah 21700 cells".
double Reader::CellsInParallel(const Quantity& q) const {
  bool of_cell = false;
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 3; ++k)
    of_cell |= IsOneOf(tokens_[k].text, {"21700", "18650", "21700s", "18650s", "cells", "cell"});
  if (!of_cell) return 1;
  for (size_t k = 1; k < tokens_.size(); ++k) {
    const Token& count = tokens_[k - 1];
    if (tokens_[k].text == "p" && count.Counts(20)) return count.value;
  }
  return 1;
}

/// "In the last five years", "a 2 year warranty": no days of flight.
bool Reader::IsOfCalendar(const Quantity& q) const {
  const size_t next = q.last + 1;
  const auto is_calendar = [](const std::string& text) {
    return StartsAny(text, {"warrant", "guarant", "project", "contract", "program", "course", "campaign", "licen", "insur", "experience",
                            "service", "support", "garant", "lease", "mission", "return", "trip", "notice"}) ||
           IsOneOf(text,
                   {"old", "ago", "later", "study", "plan", "window", "break", "apart", "before", "after", "earlier", "each", "since"});
  };
  for (size_t k = next; k < tokens_.size() && k <= next + 2 && !EndsPhrase(k); ++k) {
    if (is_calendar(tokens_[k].text)) return true;
  }
  const auto before = [&](size_t n) { return q.first >= n ? tokens_[q.first - n].text : std::string(); };
  if (IsOneOf(before(1), {"past", "next", "every", "within", "after", "each", "in", "previous", "first", "since", "until"})) return true;
  if (before(1) == "last" && IsOneOf(before(2), {"the", "our", "my", "your", "his", "her", "their", "its", "these"})) return true;
  // A time that is flown is said elsewhere.
  for (size_t k = 1; k < tokens_.size(); ++k) {
    if (Is(k, WordKind::kTimeUnit) && tokens_[k - 1].kind == Token::Kind::kNumber && tokens_[k - 1].value * WordAt(k)->value <= 36000)
      return true;
  }
  return false;
}

/// Days of flight are more than any multirotor has; days of anything else are none of its figures.
void Reader::ReadDays(const Quantity& q) {
  const std::string& text = tokens_[q.last].text;
  const bool days = text.starts_with("day") || text.starts_with("week") || text.starts_with("month") || text.starts_with("year");
  const bool flown = PhraseHas(q, WordKind::kFlight) || PhraseHas(q, WordKind::kHover);
  if (days && flown && !IsOfCalendar(q)) throw InputError("'" + q.words + "': the flight time of a drone is 10 to 36000 s");
  NameElse(q, kNone);
}

}  // namespace airsim360::internal
