// Captions: what is to be seen in each direction of a panorama, or in each third of a camera's picture, and three others that
// put the same things elsewhere: as plausible in words, for whoever sees no picture.
#include <algorithm>
#include <cmath>

#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostClauses = 4, kLeastClauses = 2, kMostOfAKind = 4;
constexpr const char* kNumbers[] = {"no", "one", "two", "three", "four", "five"};
constexpr double kThird = 1.0 / 3, kBand = 0.05;  // shares of a picture's width: thirds, and what is in neither

struct Place {
  const char *name, *said;
};
constexpr Place kAround[] = {{"front", "in front of you"}, {"right", "on your right"}, {"behind", "behind you"}, {"left", "on your left"}};
constexpr Place kAcross[] = {{"left", "on the left"}, {"middle", "in the middle"}, {"right", "on the right"}};

struct Clause {
  uint16_t word = 0;
  size_t count = 0, place = 0;
  std::vector<const Seen*> things = {};
};

class Teller {
 public:
  Teller(const NamedPlace& named, RngStream& random, size_t picture) : named_(named), random_(random), picture_(picture) {
    if (picture == 0)
      places_.assign(std::begin(kAround), std::end(kAround));
    else
      places_.assign(std::begin(kAcross), std::end(kAcross));
  }

  void Tell(std::vector<Draft>& drafts) {
    std::vector<Clause> clauses = Clauses();
    if (clauses.size() < kLeastClauses) return;
    Draft& d = drafts.emplace_back();
    d.type = picture_ == 0 ? "panorama" : "camera";
    d.picture = picture_;
    d.answer_type = "caption";
    d.texts = {picture_ == 0 ? "Describe what is around you." : "Describe this picture."};
    d.answers = {Said(clauses)};
    for (const auto& order : Orders()) {
      const std::vector<Clause> moved = Moved(clauses, order);
      const VlnJson said = Said(moved);
      if (!IsTrue(moved) && std::ranges::find(d.answers, said) == d.answers.end()) d.answers.push_back(said);
    }
    if (d.answers.size() < 4) {
      drafts.pop_back();
      return;
    }
    d.key = d.answers[0].get<std::string>();
    d.query = {{"is", "caption"}, {"clauses", VlnJson::array()}};
    d.proof = {{"clauses", VlnJson::array()}};
    for (const Clause& clause : clauses) AddTo(d, clause);
  }

 private:
  // Where a thing is; places_.size() where it could be in two.
  size_t PlaceOf(const Seen& seen) const {
    if (picture_ == 0) {
      const std::string sector = NamedPlace::SectorOf(seen);
      return static_cast<size_t>(std::ranges::find_if(places_, [&](const Place& p) { return sector == p.name; }) - places_.begin());
    }
    const double share = seen.x / named_.glance(picture_).picture.width;
    for (size_t i = 0; i < places_.size(); ++i)
      if (share > (i == 0 ? -1 : i * kThird + kBand) && share < (i == 2 ? 2 : (i + 1) * kThird - kBand)) return i;
    return places_.size();
  }

  // Words of which every thing in sight is clear and has a clear place.
  std::vector<Clause> Clauses() {
    std::vector<Clause> all;
    for (uint16_t word = 0; word < named_.groups(picture_).size(); ++word) {
      const Sighted& sighted = named_.groups(picture_)[word];
      if (sighted.clear.empty() || !sighted.doubtful.empty()) continue;
      std::vector<Clause> own(places_.size());
      bool sure = true;
      for (const Seen* s : sighted.clear) {
        const size_t place = PlaceOf(*s);
        sure = sure && place < places_.size();
        if (!sure) break;
        own[place].things.push_back(s);
      }
      for (size_t place = 0; sure && place < own.size(); ++place) {
        const size_t count = own[place].things.size();
        if (count > 0 && count <= kMostOfAKind) all.push_back({word, count, place, own[place].things});
      }
    }
    for (size_t i = 0; i < all.size(); ++i) std::swap(all[i], all[i + random_.Index(static_cast<uint32_t>(all.size() - i))]);
    all.resize(std::min(all.size(), kMostClauses));
    // Things of one place are said together, first what is ahead or on the left.
    std::ranges::stable_sort(all, {}, &Clause::place);
    return all;
  }

  std::string Things(const Clause& clause) const {
    const Word& word = named_.lexicon().words()[clause.word];
    return clause.count == 1 ? WithArticle(word.one) : std::string(kNumbers[clause.count]) + " " + word.many;
  }

  std::string Said(const std::vector<Clause>& clauses) const {
    std::string text;
    for (size_t i = 0; i < clauses.size();) {
      size_t end = i;
      while (end < clauses.size() && clauses[end].place == clauses[i].place) ++end;
      std::string place = places_[clauses[i].place].said;
      place[0] = static_cast<char>(std::toupper(place[0]));
      text += (text.empty() ? "" : " ") + place + (clauses[i].count == 1 ? " there is " : " there are ");
      for (size_t k = i; k < end; ++k) text += (k == i ? "" : k + 1 == end ? " and " : ", ") + Things(clauses[k]);
      text += ".";
      i = end;
    }
    return text;
  }

  // Where each place goes. A panorama is turned; what is left and right in a camera's picture is exchanged, and two others.
  std::vector<std::vector<size_t>> Orders() const {
    if (picture_ == 0) return {{1, 2, 3, 0}, {2, 3, 0, 1}, {3, 0, 1, 2}};
    return {{2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
  }

  static std::vector<Clause> Moved(std::vector<Clause> clauses, const std::vector<size_t>& order) {
    for (Clause& clause : clauses) clause.place = order[clause.place];
    std::ranges::stable_sort(clauses, {}, &Clause::place);
    return clauses;
  }

  bool IsTrue(const std::vector<Clause>& clauses) const {
    return std::ranges::all_of(clauses, [&](const Clause& clause) {
      const auto& clear = named_.groups(picture_)[clause.word].clear;
      return std::ranges::count_if(clear, [&](const Seen* s) { return PlaceOf(*s) == clause.place; }) ==
             static_cast<std::ptrdiff_t>(clause.count);
    });
  }

  void AddTo(Draft& d, const Clause& clause) const {
    VlnJson things = VlnJson::array();
    for (const Seen* s : clause.things) {
      d.entities.push_back(s->entity);
      things.push_back(Figures(*s, named_.scene()));
    }
    if (std::ranges::find(d.words, clause.word) == d.words.end()) d.words.push_back(clause.word);
    d.query["clauses"].push_back(
        {{"word", named_.lexicon().words()[clause.word].one}, {"count", clause.count}, {"place", places_[clause.place].name}});
    d.proof["clauses"].push_back(things);
  }

  const NamedPlace& named_;
  RngStream& random_;
  size_t picture_;
  std::vector<Place> places_;
};

}  // namespace

std::vector<Draft> CaptionsAt(const NamedPlace& named, RngStream& random) {
  std::vector<Draft> drafts;
  for (size_t picture = 0; picture < named.pictures(); ++picture) Teller(named, random, picture).Tell(drafts);
  return drafts;
}

}  // namespace airsim360::internal
