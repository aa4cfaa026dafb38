// Questions about a straight flight, shown by a panorama before and one after it.
#include <algorithm>
#include <cmath>

#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {
namespace {

constexpr double kAhead = 70, kPast = 110;          // degrees from the heading: what was ahead and is past was passed
constexpr double kNever = 55;                       // still ahead after the flight: not passed
constexpr double kNearer = 0.75, kChangedBy = 1.5;  // share and metres of a range that has changed for sure
constexpr double kBeside = 25;                      // metres: what is farther away is not said to be passed
constexpr int kTries = 24;

class FlightAsker {
 public:
  FlightAsker(const NamedPlace& named, RngStream& random) : named_(named), random_(random) {}

  std::vector<Draft> Ask() {
    for (uint16_t word = 0; word < named_.lexicon().words().size(); ++word) {
      const Sighted &before = named_.groups(0)[word], &after = named_.groups(kFlight)[word];
      const Seen *first = before.only(), *second = after.only();
      if (first != nullptr && second != nullptr && first->entity == second->entity) same_.push_back({word, first, second});
      if (before.none() && !after.clear.empty()) appeared_.push_back({word, nullptr, after.clear[0]});
      if (!before.clear.empty() && after.none()) gone_.push_back({word, before.clear[0], nullptr});
    }
    for (const Pair& a : same_) {
      AskSide(a);
      AskApproach(a);
    }
    for (int i = 0; i < kTries && same_.size() >= 2; ++i) AskPassed(Pick(same_), Pick(same_));
    for (int i = 0; i < kTries / 4 && !appeared_.empty() && !gone_.empty(); ++i) AskAppeared(Pick(appeared_), Pick(gone_));
    return std::move(drafts_);
  }

 private:
  struct Pair {
    uint16_t word;
    const Seen *before, *after;
  };
  const Pair& Pick(const std::vector<Pair>& list) { return list[random_.Index(static_cast<uint32_t>(list.size()))]; }
  std::string The(const Pair& a) const { return "the " + named_.lexicon().words()[a.word].one; }

  Draft& Add(const char* type, const std::string& key, std::initializer_list<const Pair*> things) {
    Draft& d = drafts_.emplace_back();
    d.type = type;
    d.picture = kFlight;
    d.key = std::string(type) + "|" + key;
    d.query = {{"is", type}};
    VlnJson of = VlnJson::array(), before = VlnJson::array(), after = VlnJson::array();
    for (const Pair* a : things) {
      d.words.push_back(a->word);
      d.entities.push_back((a->before != nullptr ? a->before : a->after)->entity);
      of.push_back({{"word", named_.lexicon().words()[a->word].one}, {"where", "only"}});
      before.push_back(a->before != nullptr ? Figures(*a->before, named_.scene()) : VlnJson());
      after.push_back(a->after != nullptr ? Figures(*a->after, named_.scene()) : VlnJson());
    }
    d.query["of"] = of;
    d.proof = {{"before", before}, {"after", after}};
    return d;
  }

  static bool WasPassed(const Pair& a) {
    const double before = a.before->azimuth_deg, after = a.after->azimuth_deg;
    return std::abs(before) < kAhead && std::abs(after) > kPast && (before > 0) == (after > 0) && std::abs(before) > 3 &&
           std::abs(after) < 177 && a.after->nearest < kBeside && std::abs(a.after->elevation_deg) < 50;
  }
  static bool WasNotPassed(const Pair& a) { return std::abs(a.after->azimuth_deg) < kNever && std::abs(a.before->azimuth_deg) < kNever; }

  void AskPassed(const Pair& a, const Pair& b) {
    if (a.word == b.word || a.before->entity == b.before->entity || !WasPassed(a) || !WasNotPassed(b)) return;
    const std::string x = The(a), y = The(b);
    Draft& d = Add("passed", std::min(x, y) + "|" + std::max(x, y), {&a, &b});
    d.answer_type = "thing";
    d.answers = {std::min(x, y), std::max(x, y)};
    d.answer = x < y ? 0 : 1;
    for (int turned : {0, 1})
      d.texts.push_back("You fly straight ahead from the first panorama to the second. What do you pass, " +
                        d.answers[turned].get<std::string>() + " or " + d.answers[1 - turned].get<std::string>() + "?");
  }

  void AskSide(const Pair& a) {
    if (!WasPassed(a)) return;
    Draft& d = Add("passed_side", The(a), {&a});
    d.texts = {
        "You fly straight ahead from the first panorama to the second. On which side of you does " + The(a) + " pass, left or right?",
        "Between the two panoramas you flew straight ahead. Did " + The(a) + " pass you on the left or on the right?"};
    d.answer_type = "direction";
    d.answers = {"left", "right"};
    d.answer = a.before->azimuth_deg < 0 ? 0 : 1;
  }

  // By what surely holds of the whole thing, not only of what is seen of it.
  void AskApproach(const Pair& a) {
    const DistanceBounds before = named_.Range(*a.before, named_.glance(0).picture),
                         after = named_.Range(*a.after, named_.glance(kFlight).picture);
    const bool nearer = after.most + kChangedBy < before.least * kNearer, farther = before.most + kChangedBy < after.least * kNearer;
    if (nearer == farther) return;
    Draft& d = Add("approach", The(a), {&a});
    d.texts = {"From the first panorama to the second, do you come nearer to " + The(a) + " or move away from it?",
               "Comparing the two panoramas, are you nearer to " + The(a) + " in the second one or farther from it?"};
    d.answer_type = "direction";
    d.answers = {"nearer", "farther"};
    d.answer = nearer ? 0 : 1;
    d.proof["range_between"] = {{Rounded(before.least), Rounded(before.most)}, {Rounded(after.least), Rounded(after.most)}};
  }

  void AskAppeared(const Pair& shown, const Pair& hidden) {
    const auto a = WithArticle(named_.lexicon().words()[shown.word].one), b = WithArticle(named_.lexicon().words()[hidden.word].one);
    Draft& d = Add("came_into_view", std::min(a, b) + "|" + std::max(a, b), {&shown, &hidden});
    d.query["of"][0]["where"] = d.query["of"][1]["where"] = "any";
    d.answer_type = "thing";
    d.answers = {std::min(a, b), std::max(a, b)};
    d.answer = a < b ? 0 : 1;
    for (int turned : {0, 1})
      d.texts.push_back("What can you see in the second panorama that you could not see in the first, " +
                        d.answers[turned].get<std::string>() + " or " + d.answers[1 - turned].get<std::string>() + "?");
  }

  const NamedPlace& named_;
  RngStream& random_;
  std::vector<Pair> same_, appeared_, gone_;
  std::vector<Draft> drafts_;
};

}  // namespace

std::vector<Draft> QuestionsOfFlight(const NamedPlace& named, RngStream& random) {
  if (!named.lookout().later) return {};
  return FlightAsker(named, random).Ask();
}

}  // namespace airsim360::internal
