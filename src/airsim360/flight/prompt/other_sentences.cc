// Sentences that speak of another drone, of one that is gone, or of what can be bought besides: what they say again is not the drone's.
#include <algorithm>

#include "airsim360/flight/prompt/figure_words.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {
namespace {

/// Tokens from begin to before end.
struct Span {
  size_t begin = 0, end = 0;
  bool Contains(size_t k) const { return k >= begin && k < end; }
};

class OtherSentences : public FigureWords {
 public:
  using FigureWords::FigureWords;

  void Run() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      if (SpeaksOfAnother(i)) SetApart(ReachOf(i));
    }
  }

 private:
  bool EndsSentence(size_t k) const { return Is(k, {".", ";", "!", "?"}); }

  /// From a token on, within its sentence, before another number of tokens is over.
  bool Follows(size_t i, size_t most, std::initializer_list<const char*> words) const {
    for (size_t k = i; k < tokens_.size() && k <= i + most && !EndsSentence(k); ++k) {
      if (Is(k, words)) return true;
    }
    return false;
  }
  bool HasPastVerb(size_t i, size_t most) const {
    return Follows(
        i, most,
        {"was", "were", "had", "weighed", "flew", "used", "ran", "spun", "carried", "lifted", "managed", "lasted", "came", "did", "swung"});
  }
  bool IsBuild(size_t k) const {
    return IsDrone(k) || Is(k, {"model", "machine", "version", "setup", "prototype", "drone", "copter", "generation", "aircraft", "kit"});
  }

  bool SpeaksOfAnother(size_t i) const { return IsFormer(i) || IsElse(i) || IsBesides(i) || IsOfAYear(i) || IsSaidOfBefore(i); }

  /// "My last one was 4S", "the previous frame", "it used to be on 3S", "v2 was 190 g", "before this I had a Y6"
  bool IsFormer(size_t i) const {
    if (Is(i, {"predecessor"})) return true;
    if (Is(i, {"previous", "former", "earlier"})) return IsBuild(i + 1) || IsBuild(i + 2) || HasPastVerb(i + 1, 2);
    if (Is(i, {"sold"}) && Follows(i + 1, 3, {"old"})) return true;
    if (Is(i, {"last", "old", "first", "original"})) {
      const bool built = IsBuild(i + 1) || (IsBuild(i + 2) && tokens_[i + 1].kind != Token::Kind::kNumber);
      return built && (HasPastVerb(i + 1, 5) || Is(i + 1, {"prototype"}) || Is(i + 1, {"version"}));
    }
    if (Is(i, {"used"}) && Is(i + 1, {"to be"})) return true;
    if (Is(i, {"used"}) && Is(i + 1, {"to"})) return Is(i + 2, {"sit", "live", "come", "run", "fly", "have", "weigh", "carry", "swing"});
    if (Is(i, {"v1", "v2", "v3", "v4", "mk1", "mk2"})) return HasPastVerb(i + 1, 1);
    return Is(i, {"before"}) && Is(i + 1, {"this", "that", "it"}) && Follows(i + 2, 3, {"had", "flew", "owned", "built", "used", "ran"});
  }

  /// "The competitor's hexa", "his other one", "the baseline in chapter 2"
  bool IsElse(size_t i) const {
    if (StartsAny(Text(i), {"competitor", "rival"})) return true;
    if (Is(i, {"comparison"}) && i > 0 && Is(i - 1, {"for"})) return true;
    if (Is(i, {"s"}) && tokens_[i].glued && Is(i + 1, {"one"})) return true;  // "my mate's one"
    const bool owned = i > 0 && Is(i - 1, {"his", "her", "my", "our", "their", "the"});
    if (Is(i, {"other"})) return owned && IsBuild(i + 1);
    return Is(i, {"baseline"}) && owned && Is(i + 1, {"in", "had", "was", "design", "used", "from", "of", "configuration", "model"});
  }

  /// "Stretch goal: a 45 Ah pack", "a second battery (6S 16 Ah) available for another 120"
  bool IsBesides(size_t i) const {
    if (Is(i, {"stretch"}) && Is(i + 1, {"goal", "goals"})) return true;
    if (Is(i, {"stretch goal", "stretch goals"})) return true;
    const bool extra = Is(i, {"second", "spare", "bigger", "larger", "additional", "extra", "optional"});
    return extra && Follows(i + 1, 1, {"battery", "pack", "batteries", "packs", "lipo"}) &&
           Follows(i + 1, kClause, {"available", "separately", "extra", "optional", "optionally", "another", "order"});
  }

  /// "In 2019 we used a hexacopter"
  bool IsOfAYear(size_t i) const {
    if (i >= tokens_.size() || tokens_[i].kind != Token::Kind::kNumber || i == 0 || !Is(i - 1, {"in", "until", "back in"})) return false;
    const double year = tokens_[i].value;
    return year >= 1900 && year < 2100 && !FigureAt(i).is && HasPastVerb(i + 1, 3);
  }

  /// What is said of what stands before: "… had N = 6, ignore it", "the 16 Ah pack was tried and given up".
  bool IsSaidOfBefore(size_t i) const {
    if (Is(i, {"ignore", "disregard"}) || (Is(i, {"earlier", "previous", "last"}) && Is(i + 1, {"chapter"}))) return i > 0;
    const bool no = i > 0 && Is(i - 1, {"not", "never"});
    return (no && Is(i, {"bought", "ordered", "used", "chosen"})) || (Is(i, {"given"}) && Is(i + 1, {"up"})) ||
           Is(i, {"given up", "rejected"});
  }

  /// What the words at a token are said of: the rest of the sentence, up to where this drone is said to be otherwise. "Ignore it"
  /// is said of what is before.
  Span ReachOf(size_t i) const {
    const auto contrasts = [&](size_t k) {
      return Is(k, {"but", "now", "new", "mine", "ours", "present", "currently", "today", "this one", "whereas"}) ||
             (Is(k, {"this"}) && (IsDrone(k + 1) || Is(k + 1, {"has", "is", "runs", "flies", "weighs", "uses"})));
    };
    Span span{i, i + 1};
    if (IsSaidOfBefore(i)) {
      span.end = std::min(i + 3, tokens_.size());
      while (span.begin > 0 && !EndsSentence(span.begin - 1) && !contrasts(span.begin - 1) && !Is(span.begin - 1, {"("})) --span.begin;
      while (Is(i + 1, {"chapter"}) && span.end < tokens_.size() && !EndsSentence(span.end)) ++span.end;
      return span;
    }
    while (span.end < tokens_.size() && !EndsSentence(span.end) && !contrasts(span.end)) ++span.end;
    return span;
  }

  bool HasOtherOutside(const Figure& figure, Span span) const {
    for (size_t k = 0; k < tokens_.size(); ++k) {
      if (span.Contains(k) || apart_[k]) continue;
      const Figure other = FigureAt(k);
      if (other.is && HasUnit(other, tokens_[figure.unit].word->kind)) return true;
      // "12S 22000"
      const bool charge = tokens_[k].kind == Token::Kind::kNumber && tokens_[k].value >= 300 && k > 0 && Is(k - 1, WordKind::kCells);
      if (charge && !other.is && HasUnit(figure, WordKind::kCapacityUnit)) return true;
    }
    return false;
  }

  void SetApart(Span span) {
    bool any = false;
    for (size_t k = 0; k < tokens_.size(); ++k) any |= !span.Contains(k) && !apart_[k] && (FigureAt(k).is || IsRotors(k));
    if (!any) return;
    for (size_t k = span.begin; k < span.end; ++k) {
      const Figure figure = FigureAt(k);
      if (figure.is && HasOtherOutside(figure, span)) apart_[k] = true;
      if (tokens_[k].kind == Token::Kind::kNumber && !figure.is && !Is(k + 1, WordKind::kRotorNoun)) apart_[k] = true;
      for (size_t m = 0; IsRotors(k) && m < tokens_.size(); ++m) {
        if (!span.Contains(m) && IsRotors(m)) apart_[k] = true;
      }
    }
  }
};

}  // namespace

void SetOtherSentencesApart(std::vector<Token>& tokens, std::vector<bool>& apart) { OtherSentences(tokens, apart).Run(); }

}  // namespace airsim360::internal
