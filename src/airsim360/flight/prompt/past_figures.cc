// Figures of the drone as it was, of another drone, and of conditions besides the usual one.
#include "airsim360/flight/prompt/figure_words.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {
namespace {

class PastFigures : public FigureWords {
 public:
  using FigureWords::FigureWords;

  void Run() {
    MarkOtherDrones();
    MarkExamples();
    for (size_t i = 0; i < tokens_.size(); ++i) MarkPast(i);
    MarkRules();
    MarkClaims();
    MarkConditions();
    MarkAlternatives();
  }

 private:
  /// "30 min at 2500 m", "14 min in winter" beside another time: one condition of several.
  void MarkConditions() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure time = FigureAt(i);
      if (!time.is || apart_[i] || !HasUnit(time, WordKind::kTimeUnit) || Value(time) < 60) continue;
      const size_t next = time.unit + 1;
      if (!Is(next, {"at", "in", "when", "if", "during", "under", "against", "below", "while", "on"})) continue;
      const bool usual = next + 1 >= tokens_.size() || Is(next + 1, {"hover", "hovering", "flight", "forward", "cruise", "total", "the",
                                                                     "all", "one", "a", "calm", "still", "sea", "take-off", "takeoff"});
      bool other = false;
      for (size_t k = 0; k < tokens_.size(); ++k) {
        const Figure figure = FigureAt(k);
        other |= figure.is && k != i && !apart_[k] && HasUnit(figure, WordKind::kTimeUnit) && Value(figure) >= 60;
      }
      if (other && !usual) apart_[i] = true;
    }
  }

  bool EndsClause(size_t k) const {
    return EndsSegment(k) || Is(k, {"but", "while", "whereas", "mine", "ours", "now", "so", "then", "moved", "switched", "changed"});
  }

  /// "(like the one in the paper: 1.5 kg, 10 inch) but mine is 1.8 kg"
  void MarkExamples() {
    for (size_t open = 0; open < tokens_.size(); ++open) {
      if (!Is(open, {"("}) || !(Is(open + 1, {"like", "unlike", "compare", "as", "cf"}) || Is(open + 2, {"like"}))) continue;
      size_t close = open;
      while (close < tokens_.size() && !Is(close, {")"})) ++close;
      if (IsContrasted(close)) MarkClause(open, close);
    }
  }

  /// "1.1 kg with the 4 Ah pack, 1.3 kg with the 6 Ah pack": the first of such pairs.
  void MarkAlternatives() {
    bool first = true;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure mass = FigureAt(i);
      if (!mass.is || apart_[i] || !HasUnit(mass, WordKind::kMassUnit) || !Is(mass.unit + 1, {"with", "on"})) continue;
      size_t k = mass.unit + 2;
      while (k < tokens_.size() && k <= mass.unit + 4 && tokens_[k].kind != Token::Kind::kNumber && !EndsSegment(k)) ++k;
      const Figure pack = FigureAt(k);
      if (!pack.is || !(HasUnit(pack, WordKind::kCapacityUnit) || HasUnit(pack, WordKind::kCells) || HasUnit(pack, WordKind::kEnergyUnit)))
        continue;
      if (!first) {
        for (size_t n = i; n < tokens_.size() && !EndsSegment(n); ++n) MarkFigure(n);
      }
      first = false;
    }
  }

  /// Whether a later word says that the drone is another one.
  bool IsContrasted(size_t from) const {
    for (size_t k = from; k < tokens_.size(); ++k) {
      if (Is(k, {"mine", "ours", "this one", "this", "my", "our", "new", "here"})) return true;
    }
    return false;
  }

  /// "My last one had 7 inch", "my friend's hexa weighs 7 kg, mine only 5": clauses of another drone.
  void MarkOtherDrones() {
    for (size_t begin = 0; begin < tokens_.size();) {
      size_t end = begin;
      while (end < tokens_.size() && !EndsClause(end)) ++end;
      MarkClauseOfOther(begin, end);
      begin = std::max(end, begin) + 1;
    }
  }

  void MarkClauseOfOther(size_t begin, size_t end) {
    const auto in_clause = [&](std::initializer_list<const char*> words) {
      for (size_t k = begin; k < end; ++k) {
        if (Is(k, words)) return true;
      }
      return false;
    };
    // "There is also a pro version with 13 inch and 2.1 kg"
    if (in_clause({"version", "variant", "edition", "sibling", "model"}) &&
        in_clause({"also", "another", "other", "second", "different"})) {
      for (size_t k = begin; k < end; ++k) MarkIfOther(k);
      return;
    }
    // "We also own an octo with 15 kg"
    if (in_clause({"also", "another", "other", "second"}) && in_clause({"own", "have", "fly", "got", "sell", "built"}) &&
        IsContrasted(end)) {
      MarkClause(begin, end);
      return;
    }
    bool former = false, other = false, drone = false, past = false, verb = false, figure = false;
    size_t k = begin;
    for (; k < end && k < begin + 8 && !verb; ++k) {
      const bool possessive = Is(k, {"s"}) && tokens_[k].glued;
      former |= Is(k, {"old", "last", "previous", "former", "first", "earlier", "predecessor"});
      other |= possessive || tokens_[k].kind == Token::Kind::kModel ||
               Is(k, {"his", "her", "their", "other", "another", "competitor", "rival", "brother", "sister", "bigger", "smaller"});
      drone |= IsDrone(k) || Is(k, {"predecessor", "competitor"});
      past |= Is(k, {"was", "had", "weighed", "flew", "used", "ran", "were", "spun", "carried"});
      verb |= past || Is(k, {"is", "has", "weighs", "comes", "measures", "flies", "uses", "runs", "spins", "carries"});
      figure |= tokens_[k].kind == Token::Kind::kNumber;
    }
    if (!verb || !drone || figure) return;
    if (!(former && past) && !((former || other) && IsContrasted(end))) return;
    if (HasFigureOutside(begin, end)) MarkClause(begin, end);
  }
  bool HasFigureOutside(size_t begin, size_t end) const {
    for (size_t k = 0; k < tokens_.size(); ++k) {
      if ((k < begin || k >= end) && (FigureAt(k).is || tokens_[k].kind == Token::Kind::kPropellerCode)) return true;
    }
    return false;
  }
  void MarkClause(size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) {
      MarkFigure(n);
      if (!IsRotors(n)) continue;
      for (size_t m = end; m < tokens_.size(); ++m) {  // where the other kind is said
        if (IsRotors(m)) apart_[n] = true;
      }
    }
  }

  void MarkIfOther(size_t k) {
    if (tokens_[k].kind == Token::Kind::kPropellerCode) apart_[k] = true;
    if (const Figure figure = FigureAt(k); figure.is && HasOther(figure)) apart_[k] = true;
  }

  /// "Anything above 4 kg is forbidden": a bound of a law beside the drone's own figure.
  void MarkRules() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure figure = FigureAt(i);
      if (!figure.is || !HasUnit(figure, WordKind::kMassUnit) || !HasOther(figure)) continue;
      const bool rule = HasNear(figure, 7,
                                {"forbidden", "illegal", "legal", "law", "rule", "regulation", "licen", "permit", "paperwork", "insurance",
                                 "certificat", "threshold", "registration"});
      if (rule) apart_[i] = true;
    }
  }

  /// What was before a change: "used to run 4S", "old weight 10.2 kg", "from 10 inch to 12 inch", "no longer 4S".
  void MarkPast(size_t i) {
    const size_t next = i + 1;
    const auto is_noun = [&](size_t k) {
      if (k >= tokens_.size()) return false;
      const Token& token = tokens_[k];
      return Is(k, {"version", "setup", "weight", "motors", "best", "record", "attempt"}) ||
             (token.kind == Token::Kind::kWord && token.word->kind >= WordKind::kRotorNoun && token.word->kind <= WordKind::kThrust);
    };
    const bool used_to = Is(i, {"used"}) && Is(next, {"to"}) &&
                         (Is(next + 1, {"run", "be", "have", "weigh", "swing", "spin", "use", "fly", "take", "carry"}) ||
                          (next + 1 < tokens_.size() && tokens_[next + 1].Is(WordKind::kMass)));
    const bool old = Is(i, {"old", "previous", "former", "earlier", "original"}) && is_noun(next);
    // "Our record of last year was 16 min"
    bool record = false;
    for (size_t k = next; Is(i, {"record"}) && k < tokens_.size() && k <= i + 5 && !EndsSegment(k); ++k) record |= Is(k, {"was", "stood"});
    const bool strong = used_to || old || record || Is(i, {"previously", "formerly", "originally", "initially"});
    const bool weak = Is(i, {"was", "were", "had", "weighed", "ran"});
    const bool change = StartsAny(Text(i), {"replac", "swap", "exchang", "traded", "upgrad", "went", "chang", "moved", "switch", "dropped",
                                            "convert", "down", "reduced", "increased", "instead", "grew", "modified"});
    for (size_t k = next; strong && k < tokens_.size() && k <= next + kClause && !EndsPast(k); ++k) {
      MarkIfOther(k);
      if (tokens_[k].kind == Token::Kind::kNumber && k + 1 < tokens_.size() && tokens_[k + 1].Is(WordKind::kRotorNoun)) apart_[k] = true;
    }
    if (weak || change) MarkReplaced(i, change);
    MarkLost(i);
    MarkAfter(i);
    MarkNegated(i);
  }

  /// "The tricopter died, now a proper quad"
  void MarkLost(size_t i) {
    if (!IsRotors(i)) return;
    bool lost = false;
    for (size_t k = i + 1; k < tokens_.size() && k <= i + 4 && !EndsSegment(k); ++k)
      lost |= Is(k, {"died", "dead", "crashed", "broke", "drowned", "retired", "sold", "gone", "burnt", "burned", "lost"});
    for (size_t k = i + 1; lost && k < tokens_.size(); ++k) {
      if (IsRotors(k) && tokens_[k].word->value != tokens_[i].word->value) apart_[i] = true;
    }
  }

  bool EndsPast(size_t k) const {
    return EndsSegment(k) ||
           Is(k, {"now", "new", "today", "currently", "but", "then", "moved", "switched", "changed", "until", "converted"});
  }

  /// "1.5 kg before the diet", "2.4 kg with the old gimbal"
  void MarkAfter(size_t i) {
    const Figure figure = FigureAt(i);
    if (!figure.is || HasUnit(figure, WordKind::kOtherUnit)) return;
    const size_t next = figure.unit + 1;
    const bool before = Is(next, {"before", "formerly", "previously", "originally", "initially", "earlier"}) &&
                        !Is(next + 1, {"payload", "drop", "dropping", "release", "landing"}) &&
                        !Is(next + 2, {"payload", "drop", "load", "release", "flight", "landing"});
    const bool with_old =
        Is(next, {"with", "on"}) && (Is(next + 1, {"old", "previous", "former"}) || Is(next + 2, {"old", "previous", "former"}));
    const auto is_option = [&](size_t k) { return Is(k, {"optional", "second", "extra", "bigger", "larger", "additional"}); };
    const bool option = Is(next, {"if"}) || (Is(next, {"with", "on"}) && (is_option(next + 1) || is_option(next + 2)));
    const bool mass = HasUnit(figure, WordKind::kMassUnit);
    if ((before || with_old || (option && mass)) && HasOther(figure)) apart_[i] = true;
  }

  /// "I no longer fly 4S", "not 10 inch", "instead of the usual 15 inch"
  void MarkNegated(size_t i) {
    const Figure figure = FigureAt(i);
    if (!figure.is || HasUnit(figure, WordKind::kOtherUnit)) return;
    size_t k = i;
    while (k-- > 0 && i - k <= 4 &&
           (IsArticle(Text(k)) || Is(k, {"usual", "standard", "old", "any", "fly", "run", "use", "flying", "running", "carry"}))) {
    }
    if (k >= tokens_.size()) return;
    const bool negated = Is(k, {"no longer", "not", "never", "instead of", "rather than", "than"}) ||
                         (Is(k, {"longer"}) && k > 0 && Is(k - 1, {"no"})) || (Is(k, {"of"}) && k > 0 && Is(k - 1, {"instead"}));
    if (negated && !Is(k, {"than"}) && HasOther(figure)) apart_[i] = true;
  }

  /// "Was 1.9 kg, now 1.7 kg", "swapped the 10 inch props for 12 inch ones".
  void MarkReplaced(size_t i, bool change) {
    size_t end = i + 1;
    bool anew = false;
    for (; end < tokens_.size() && end <= i + kClause; ++end) {
      Token& range = tokens_[end];
      if (change && range.kind == Token::Kind::kNumber && range.high > 0 && Is(end - 1, {"from"})) {  // "from 2200 mAh to 5000 mAh"
        range.value = range.high;
        range.low = range.high = 0;
        return;
      }
      anew = change ? Is(end, {"to", "for", "with", "by", "against"}) && tokens_[end - 1].kind != Token::Kind::kNumber
                    : Is(end, {"now", "new", "today", "currently", "since"});
      if (anew || (change && EndsSegment(end))) break;
    }
    if (!anew) return;
    // "The tests with 14 inch propellers were bad, so it has 15 inch now": what the verb is said of as well.
    size_t begin = i;
    while (!change && begin > 0 && i - begin < 8 && !EndsSegment(begin - 1)) --begin;
    for (size_t k = change ? i + 1 : begin; k < end; ++k) {
      if (change && IsRotors(k)) {  // "replaced the old quad by a hexacopter"
        for (size_t n = end; n < tokens_.size() && n <= end + 3; ++n) apart_[k] = apart_[k] || IsRotors(n);
      }
      const Figure figure = FigureAt(k);
      for (size_t n = end; figure.is && n < tokens_.size() && n <= end + kClause; ++n) {
        const Figure other = FigureAt(n);
        if (other.is && HasUnit(other, tokens_[figure.unit].word->kind)) apart_[k] = true;
      }
    }
  }

  /// "30 min advertised, 24 min in practice": what is claimed gives way to what is true.
  void MarkClaims() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure claimed = FigureAt(i);
      if (!claimed.is || apart_[i] ||
          !HasNear(claimed, 3, {"advertis", "claim", "brochure", "promis", "official", "on paper", "manual", "datasheet", "data sheet"}))
        continue;
      for (size_t k = 0; k < tokens_.size(); ++k) {
        const Figure other = FigureAt(k);
        if (!other.is || k == i || apart_[k] || !HasUnit(other, tokens_[claimed.unit].word->kind)) continue;
        if (HasNear(other, 4,
                    {"real", "actual", "practice", "measur", "weighed", "scale", "more like", "i get", "we get", "truth", "ours", "mine"}))
          apart_[i] = true;
      }
    }
  }
};

}  // namespace

void SetPastFiguresApart(std::vector<Token>& tokens, std::vector<bool>& apart) { PastFigures(tokens, apart).Run(); }

}  // namespace airsim360::internal
