// What the words around a mass let it be of.
#include <algorithm>

#include "airsim360/flight/prompt/reader.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {
namespace {

constexpr size_t kLabel = 12;  // tokens that a mass's label may have before it

bool IsSpacedDash(const std::vector<Token>& tokens, size_t k) { return tokens[k].kind == Token::Kind::kDash && !tokens[k].glued; }

}  // namespace

/// What the mass of which token `k` is a label is of; nothing: no label.
std::optional<MassRole> Reader::RoleOf(size_t k) const {
  const Word* word = WordAt(k);
  const std::string& text = tokens_[k].text;
  if (IsPartWord(text)) return MassRole::kPart;
  if (text == "arm" && IsThing(k)) return MassRole::kThing;
  if (word && word->kind == WordKind::kBare) return MassRole::kBare;
  if (word && word->kind == WordKind::kEmpty) return MassRole::kEmpty;
  if (word && word->kind == WordKind::kMass) return IsWhole(k) ? std::optional(MassRole::kWhole) : std::nullopt;
  if (word && word->kind == WordKind::kBattery) return MassRole::kBattery;
  if (word && word->kind == WordKind::kPayload) return IsCarryVerb(text) ? MassRole::kThing : MassRole::kPayload;
  if (IsPart(k) && !Is(k, WordKind::kCells)) return Is(k, WordKind::kLithiumIon) ? MassRole::kBattery : MassRole::kPart;
  const bool named = (word == nullptr || word->kind == WordKind::kVehicle) && k > 0 && Is(k - 1, WordKind::kLoad);  // "sensor bird"
  if (IsDroneWord(k) && !named) return MassRole::kWhole;
  if (named) return MassRole::kThing;
  if (IsThing(k) || (word && word->kind == WordKind::kLoad)) return MassRole::kThing;
  return std::nullopt;
}

/// "With battery 630 g", "mit 1300er Akku", "incl. camera": what is in the mass that follows, no label of it.
bool Reader::IsIncludedBefore(size_t k) const {
  for (size_t n = k; n-- > 0 && k - n <= 4;) {
    const std::string& text = tokens_[n].text;
    if (IsOneOf(text, {"with", "w", "mit", "avec", "con", "com"}) || MeansIncluding(text)) return true;
    if (tokens_[n].kind == Token::Kind::kComma || IsSpacedDash(tokens_, n) || Is(n, WordKind::kMassUnit)) return false;
  }
  return false;
}

/// Whether a label says for certain what a mass is of, so that what stands before it says no more.
bool Reader::EndsLabel(size_t k) const {
  if (IsOneOf(tokens_[k].text, {"all in", "total", "in total", "in all", "total of", "total weight"})) return false;
  return RoleOf(k) == MassRole::kWhole || Is(k, WordKind::kMass) || Is(k, WordKind::kBare) || Is(k, WordKind::kEmpty) ||
         Is(k, WordKind::kBattery) || (Is(k, WordKind::kPayload) && !IsCarryVerb(tokens_[k].text));
}

std::vector<Quantity> Reader::Masses() const {
  std::vector<Quantity> masses;
  for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
    const size_t unit = i + (tokens_[i + 1].kind == Token::Kind::kDash ? 2 : 1);
    const bool goes_on = !masses.empty() && masses.back().last + 1 == i;  // "2 lb 3 oz"
    if (tokens_[i].kind != Token::Kind::kNumber || !Is(unit, WordKind::kMassUnit) || goes_on) continue;
    masses.push_back({i, unit, tokens_[i].value * tokens_[unit].word->value, tokens_[unit].word, tokens_[i].text});
  }
  return masses;
}

namespace {

void AddClaim(std::vector<MassClaim>& claims, MassRole role, int cost) {
  const bool known = std::any_of(claims.begin(), claims.end(), [&](const MassClaim& claim) { return claim.role == role; });
  if (!known) claims.push_back({role, cost});
}

}  // namespace

/// What is written right after a mass: "620 g 6S 4000 lipo", "1.6 kg carried".
std::vector<MassClaim> Reader::ClaimsAfter(const Quantity& q) const {
  std::vector<MassClaim> claims;
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 6; ++k) {
    const bool pack = tokens_[k].kind == Token::Kind::kNumber || Is(k, WordKind::kCells) || Is(k, WordKind::kCapacityUnit);
    if (!pack && EndsPhrase(k) && tokens_[k].text != "on") break;
    if (IsCarryVerb(tokens_[k].text) || IsOneOf(tokens_[k].text, {"that", "which", "who", "+", "plus"})) break;
    if (pack && k == q.last + 1) continue;
    const std::optional<MassRole> role = RoleOf(k);
    if (!role || (pack && *role != MassRole::kBattery)) continue;
    AddClaim(claims, *role, 0);
    if (*role != MassRole::kThing) break;
  }
  return claims;
}

/// What stands before a mass, nearest first, back to the comma; where nothing does, the phrase before.
void Reader::AddClaimsBefore(const Quantity& q, std::vector<MassClaim>& claims) const {
  int cost = claims.empty() ? 0 : 2;
  bool beyond = false, pack = false;
  const bool apposed = q.first > 0 && tokens_[q.first - 1].text == "(";  // "850 mAh (95 g)"
  for (size_t k = q.first; k-- > 0 && q.first - k <= kLabel;) {
    if (Is(k, WordKind::kMassUnit) && k > 0 && tokens_[k - 1].kind == Token::Kind::kNumber) break;
    const bool ends = (tokens_[k].kind == Token::Kind::kComma && tokens_[k].text != "/") || IsSpacedDash(tokens_, k);
    if (ends) {
      // A mass that stands alone between commas is the drone's own.
      const bool alone = k + 1 == q.first && tokens_[k].text == "," && q.last + 1 < tokens_.size() && EndsPhrase(q.last + 1);
      if (alone) AddClaim(claims, MassRole::kWhole, cost++);
      if (pack && claims.empty()) break;
      if ((!claims.empty() && !alone) || beyond || IsOneOf(tokens_[k].text, {".", "!", ";"})) break;
      beyond = true;
      continue;
    }
    pack |= (Is(k, WordKind::kCells) || Is(k, WordKind::kCapacityUnit)) && (!beyond || apposed) && q.first - k <= 6;
    const std::optional<MassRole> role = RoleOf(k);
    if (!role) continue;
    const bool included = *role == MassRole::kBattery && IsIncludedBefore(k);
    AddClaim(claims, included ? MassRole::kWhole : *role, cost);
    cost += 2;
    if (EndsLabel(k)) break;
  }
  if (pack && claims.empty()) claims = {{MassRole::kBattery, 1}};  // "6S 1100s which are 185 g each"
}

/// The labels of a mass, the likelier first; where there are none, unless `alone`, that of the mass that this one is
/// joined to: "two boxes of 1.2 kg and one of 600 g".
std::vector<MassClaim> Reader::ClaimsOf(const Quantity& q, bool alone) const {
  if (BareInParentheses(q) != kNone) return {{MassRole::kBare, 0}};
  std::vector<MassClaim> claims = ClaimsAfter(q);
  const bool sum = q.first > 0 && IsSumAfter(q.first - 1);
  if (claims.empty() && (sum || WholeBefore(q) != kNone)) return {{MassRole::kWhole, 0}};
  AddClaimsBefore(q, claims);
  const size_t before = claims.empty() && !alone ? MassBefore(q) : kNone;
  if (before == kNone) return claims;
  for (const Quantity& other : Masses()) {
    if (other.last != before) continue;
    claims = ClaimsOf(other, true);
    claims.resize(std::min<size_t>(claims.size(), 1));
  }
  return claims;
}

/// The unit of the mass that "and", "plus" join to this one, with little in between; else kNone.
size_t Reader::MassBefore(const Quantity& q) const {
  bool joined = false;
  for (size_t k = q.first; k-- > 0 && q.first - k <= 5;) {
    if (Is(k, WordKind::kMassUnit) && k > 0 && tokens_[k - 1].kind == Token::Kind::kNumber) return joined ? k : kNone;
    if (tokens_[k].kind == Token::Kind::kComma && tokens_[k].text != ",") return kNone;
    joined |= IsOneOf(tokens_[k].text, {"and", "plus", "+", "und", "et", "y", "e"});
  }
  return kNone;
}

void Reader::ReadMassAs(MassRole role, const Quantity& q) {
  switch (role) {
    case MassRole::kWhole:
      whole_of_mass_ = whole_said_ = true;
      mass_quantity_ = q;
      return Set({"mass", 0.01, 400, "kg"}, request_.mass, q.value, q.words);
    case MassRole::kEmpty:
      return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
    case MassRole::kBare:
      return Set({"bare_mass", 0.004, 400, "kg"}, request_.bare_mass, q.value, q.words);
    case MassRole::kPayload:
      if (things_said_ && request_.payload && *request_.payload < q.value) {  // "... payload 3 kg in all"
        request_.payload.reset();
        request_.words.erase("payload");
        things_said_ = false;
      }
      return Set({"payload", 0.0005, 1000, "kg"}, request_.payload, q.value, q.words);
    case MassRole::kThing:
      if (request_.payload && !things_said_ && q.value <= *request_.payload) return;  // of that payload
      if (request_.payload && things_said_) {
        *request_.payload += q.value;
        request_.words["payload"] += " and " + q.words;
        return;
      }
      return SetThing(q);
    case MassRole::kBattery:
      return Set({"battery_mass", 0.001, 200, "kg"}, request_.battery_mass, q.value, q.words);
    case MassRole::kPart:
      return loose_masses_.push_back({q, false, true, false, CountOfParts(q)});
  }
}

}  // namespace airsim360::internal
