// Numbers beside the figures of a drone: of names, money, work and calendars.
#include "airsim360/flight/prompt/figure_words.h"

namespace airsim360::internal {
namespace {

/// What is numbered rather than counted: "turbine 14", "job 93", "chapter 3".
bool IsNumbered(const std::string& text) {
  return IsOneOf(
      text, {"job",     "ticket",    "order",      "work order", "invoice",  "customer",  "contract",  "serial",   "number",     "nr",
             "lot",     "batch",     "item",       "part",       "sample",   "specimen",  "test",      "trial",    "run",        "attempt",
             "step",    "stage",     "phase",      "task",       "issue",    "bug",       "request",   "case",     "entry",      "record",
             "sortie",  "mission",   "round",      "heat",       "day",      "week",      "month",     "year",     "season",     "session",
             "lesson",  "lecture",   "course",     "module",     "chapter",  "section",   "paragraph", "article",  "appendix",   "annex",
             "page",    "slide",     "figure",     "fig",        "table",    "equation",  "example",   "problem",  "question",   "exercise",
             "version", "revision",  "rev",        "release",    "firmware", "mark",      "mk",        "rule",     "form",       "category",
             "room",    "floor",     "building",   "house",      "flat",     "apartment", "suite",     "office",   "lab",        "unit",
             "hangar",  "hall",      "bay",        "gate",       "dock",     "berth",     "pad",       "shelf",    "locker",     "slot",
             "box",     "crate",     "bench",      "station",    "stop",     "platform",  "bus",       "tram",     "train",      "line",
             "route",   "road",      "street",     "highway",    "exit",     "junction",  "bridge",    "pier",     "tunnel",     "turbine",
             "tower",   "mast",      "pylon",      "pole",       "well",     "tank",      "silo",      "shaft",    "pit",        "site",
             "zone",    "sector",    "block",      "plot",       "field",    "parcel",    "row",       "barn",     "greenhouse", "team",
             "group",   "crew",      "squad",      "pilot",      "player",   "student",   "party",     "district", "ward",       "workshop",
             "project", "programme", "experiment", "scenario",   "level",    "grade",     "aged",      "buoy",     "substation"});
}

/// "June", "spring", "2024", "the", "parallel": "in" before it is no inch.
bool BeginsNoThing(const std::string& text) {
  return IsOneOf(
      text, {"january",  "february", "march",  "april",    "may",     "june",     "july",     "august", "september", "october", "november",
             "december", "jan",      "feb",    "mar",      "apr",     "jun",      "jul",      "aug",    "sep",       "sept",    "oct",
             "nov",      "dec",      "spring", "summer",   "autumn",  "winter",   "fall",     "monday", "tuesday",   "friday",  "saturday",
             "sunday",   "the",      "a",      "an",       "my",      "our",      "your",     "his",    "her",       "its",     "their",
             "this",     "that",     "these",  "those",    "it",      "them",     "us",       "each",   "every",     "all",     "both",
             "some",     "any",      "which",  "parallel", "series",  "total",    "hover",    "still",  "calm",      "wind",    "winds",
             "service",  "stock",    "use",    "case",     "advance", "front",    "between",  "europe", "hand",      "time",    "one",
             "practice", "town",     "school", "row",      "storage", "progress", "question", "real",   "operation", "reserve", "gusts",
             "rain",     "cash",     "person", "public",   "japan",   "germany",  "france",   "spain",  "italy",     "china"});
}

bool IsWrittenOut(const std::string& text) { return !text.empty() && text[0] >= 'a' && text[0] <= 'z'; }

bool IsPaidWord(const std::string& text) {
  return IsOneOf(text, {"bid",    "bids",   "price", "priced", "cost",   "costs", "costing", "paid",    "pay",     "pays",
                        "fee",    "fees",   "worth", "sell",   "sells",  "sold",  "rent",    "rental",  "deposit", "reward",
                        "budget", "asking", "offer", "fine",   "salary", "spent", "earned",  "charged", "bought"});
}

class SideNumbers : public FigureWords {
 public:
  using FigureWords::FigureWords;

  void Run() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      MarkTool(i);
      if (tokens_[i].kind == Token::Kind::kPropellerCode && IsTyre(i)) apart_[i] = true;
      if (tokens_[i].kind != Token::Kind::kNumber) continue;
      if (IsName(i) || IsMoney(i) || IsWork(i) || IsMaterial(i) || IsBaggage(i) || IsCounted(i)) apart_[i] = true;
    }
  }

 private:
  /// "hex key", "octo socket": no kind of drone.
  void MarkTool(size_t i) {
    if (!tokens_[i].Is(WordKind::kRotors) || !IsOneOf(tokens_[i].text, {"hex", "tri", "quad", "octo", "octa"})) return;
    const size_t next = i + 1 < tokens_.size() && tokens_[i + 1].kind == Token::Kind::kDash ? i + 2 : i + 1;
    if (!Is(next, {"key",    "keys",     "bolt",      "bolts",  "nut",     "nuts", "head", "driver", "drivers", "screw", "screws", "wrench",
                   "socket", "standoff", "standoffs", "spacer", "spacers", "bit",  "bits", "grid",   "code",    "core",  "bike"}))
      return;
    tokens_[i].kind = Token::Kind::kUnknown;
    tokens_[i].word = nullptr;
  }

  /// Whether the number counts or measures what follows it, in its phrase.
  bool HasFollower(size_t i) const {
    const Figure figure = FigureAt(i);
    if (figure.is) return Text(figure.unit) != "in" || tokens_[figure.unit].glued || !IsPreposition(tokens_, figure.unit);
    size_t next = i + 1;
    while (next < tokens_.size() && tokens_[next].kind == Token::Kind::kDash) ++next;
    if (next >= tokens_.size()) return false;
    const Token& token = tokens_[next];
    if (token.kind == Token::Kind::kNumber || token.kind == Token::Kind::kPropellerCode) return true;
    if (token.kind != Token::Kind::kWord) return false;
    const WordKind kind = token.word->kind;
    return kind == WordKind::kTimes || kind == WordKind::kBattery || kind == WordKind::kRotors || kind == WordKind::kFactor ||
           (kind >= WordKind::kRotorNoun && kind <= WordKind::kPitch) || kind == WordKind::kBrushless;
  }

  /// "Workshop job 0093", "turbine 14": a name that counts nothing.
  bool IsName(size_t i) const {
    const Token& token = tokens_[i];
    if (token.high > 0 || IsWrittenOut(token.text) || HasFollower(i)) return false;
    const std::string& text = token.text;
    const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (digits && text.size() > 1 && text[0] == '0') return true;
    size_t noun = i;
    while (noun-- > 0 && Is(noun, {"no", "nr", "number", "#", "-"})) {
    }
    if (i > 0 && Is(i - 1, {"number", "nr"})) return true;
    return noun < tokens_.size() && IsNumbered(Text(noun));
  }

  /// "Starting bid 350 pounds", "sold for 90 pounds"
  bool IsMoney(size_t i) const {
    const Figure figure = FigureAt(i);
    if (!figure.is || !Is(figure.unit, {"pound", "pounds"})) return false;
    if (Is(figure.unit + 1, {"sterling", "deposit", "reward", "ono", "vat"})) return true;
    for (size_t k = i; k-- > 0 && i - k <= 4 && tokens_[k].kind != Token::Kind::kNumber;) {
      if (IsPaidWord(Text(k))) return true;
      if (EndsSegment(k)) break;
    }
    return false;
  }

  /// "The battery 300 cycles"
  bool IsCounted(size_t i) const {
    return !FigureAt(i).is && Is(i + 1, {"cycle", "cycles", "charges", "recharges", "landings", "launches", "takeoffs", "flights"});
  }

  /// "Tyre size 26 x 2.1"
  bool IsTyre(size_t i) const {
    for (size_t k = i; k-- > 0 && i - k <= 3 && !EndsSegment(k);) {
      if (StartsAny(Text(k), {"tyre", "tire", "wheels", "bolt", "screw", "photo", "paper", "poster", "plywood", "score"})) return true;
    }
    return StartsAny(Text(i + 1), {"tyre", "tire", "bolt", "screw", "photo", "print"});
  }

  /// "Cabin bag 8 kg allowed", "20 kg of luggage"
  bool IsBaggage(size_t i) const {
    const Figure figure = FigureAt(i);
    if (!figure.is || !HasUnit(figure, WordKind::kMassUnit) || !HasOther(figure)) return false;
    const size_t next = figure.unit + (Is(figure.unit + 1, {"of"}) ? 2 : 1);
    if (Is(next, {"allowed", "allowance", "luggage", "baggage"}) || (i > 0 && Is(i - 1, {"luggage", "baggage"}))) return true;
    return i > 1 && Is(i - 1, {"bag", "bags", "suitcase"}) && Is(i - 2, {"cabin", "checked", "hand", "hold"});
  }

  /// "1.2 kg of filament"
  bool IsMaterial(size_t i) const {
    const Figure figure = FigureAt(i);
    if (!figure.is || !HasUnit(figure, WordKind::kMassUnit) || !Is(figure.unit + 1, {"of"}) || !HasOther(figure)) return false;
    return Is(figure.unit + 2, {"filament", "pla", "petg", "abs", "tpu", "resin", "nylon", "plastic"});
  }

  /// "45 hours of printing", "6 hours of homework": what persons and tools do.
  bool IsWork(size_t i) const {
    const Figure figure = FigureAt(i);
    if (!figure.is || !HasUnit(figure, WordKind::kTimeUnit)) return false;
    for (size_t k = i; k-- > 0 && i - k <= 3 && !EndsSegment(k);) {  // "printed in 45 hours"
      if (StartsAny(Text(k), {"printed", "assembled", "soldered", "spent", "repaired", "painted"})) return true;
      if (StartsAny(Text(k), {"film", "movie", "match", "talk", "meeting", "call"}) && Is(figure.unit + 1, {"long"})) return true;
    }
    size_t next = figure.unit + 1;
    if (!Is(next, {"of"})) return false;
    while (Is(next, {"of", "the", "my", "our", "3d", "pure", "careful"})) ++next;
    return StartsAny(Text(next),
                     {"print",    "solder", "sanding", "paint",    "assembl",  "labour",   "labor",  "lesson",      "study",   "homework",
                      "teaching", "lectur", "waiting", "sunlight", "sunshine", "daylight", "coding", "programming", "driving", "footage",
                      "video",    "rework", "repair",  "training", "sleep",    "wiring",   "tuning", "theory",      "reading"}) ||
           Is(next, {"work", "cad", "sun", "queueing", "notice", "rain", "film", "building", "design"});
  }
};

}  // namespace

bool IsPreposition(const std::vector<Token>& tokens, size_t in) {
  const size_t next = in + 1;
  if (next >= tokens.size()) return false;
  const Token& token = tokens[next];
  if (BeginsNoThing(token.text)) return true;
  if (token.kind == Token::Kind::kNumber && token.text.size() == 4 && token.value >= 1900 && token.value <= 2100) return true;
  const bool out = in > 0 && IsWrittenOut(tokens[in - 1].text) && !tokens[in].glued;
  const bool doing = token.kind == Token::Kind::kUnknown && token.text.size() > 5 && token.text.ends_with("ing");
  if (!out && !doing) return false;
  // "Two in white" has no part that is as long; "five in props", "13 in folding propellers" have one.
  for (size_t k = next; k < tokens.size() && k <= next + 2 && tokens[k].kind != Token::Kind::kComma; ++k) {
    if (tokens[k].kind == Token::Kind::kWord && tokens[k].word->kind >= WordKind::kDrone && tokens[k].word->kind <= WordKind::kPitch)
      return false;
  }
  return true;
}

void SetSideNumbersApart(std::vector<Token>& tokens, std::vector<bool>& apart) { SideNumbers(tokens, apart).Run(); }

}  // namespace airsim360::internal
