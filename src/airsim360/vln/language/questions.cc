// Questions about one panorama or one camera's picture.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {
namespace {

constexpr int kAbsent = 10;                               // words drawn to ask for, most of them of things that are not there
constexpr size_t kMostPairs = 100;                        // pairs of named things that are compared in one picture
constexpr int kThirds = 3;                                // third things drawn for each pair
constexpr double kFartherShare = 1.25, kFartherBy = 1.0;  // what is surely farther than another thing: share and metres
constexpr size_t kMostCounted = 8;                        // more are not counted at a glance
constexpr double kLeastTurn = 25, kMostTurn = 145;        // degrees between two things so that a turn has a clear side
constexpr double kGapColumns = 0.03;                      // share of a picture's width between two things that lie side by side
constexpr double kFarthest = 90;                          // metres: distances beyond are not compared

const char* At(size_t picture) { return picture == 0 ? "" : " in this picture"; }

class Asker {
 public:
  Asker(const NamedPlace& named, RngStream& random) : named_(named), random_(random) {}

  std::vector<Draft> Ask() {
    for (size_t picture = 0; picture < named_.pictures(); ++picture) {
      quarters_ = 0;
      AskOfWords(picture);
      for (const auto& [a, b] : Pairs(named_.names(picture))) {
        const Name& turns = IsPlain(*a) ? *b : *a;
        quarters_ = picture == 0 ? QuartersTo(turns, a->word * 31U + b->word) : 0;
        AskOfPair(picture, named_.Turned(*a, quarters_), named_.Turned(*b, quarters_));
      }
      for (const Name& name : named_.names(picture)) {
        quarters_ = picture == 0 ? QuartersTo(name, name.word) : 0;
        AskDistance(picture, named_.Turned(name, quarters_));
        if (picture == 0) AskDirection(name);
      }
    }
    return std::move(drafts_);
  }

 private:
  void AskOfWords(size_t picture) {
    std::set<uint16_t> words;
    for (uint16_t word = 0; word < named_.groups(picture).size(); ++word)
      if (!named_.groups(picture)[word].none()) words.insert(word);
    for (int i = 0; i < kAbsent; ++i) words.insert(PickWord());
    for (const uint16_t word : words) {
      AskExists(picture, word);
      AskCount(picture, word);
    }
  }

  // Two things each, drawn; each pair once, either way round.
  std::vector<std::pair<const Name*, const Name*>> Pairs(const std::vector<Name>& names) {
    std::vector<std::pair<const Name*, const Name*>> pairs;
    for (const Name& a : names)
      for (const Name& b : names)
        if (&a < &b && AreTwo(a, b)) pairs.emplace_back(&a, &b);
    const size_t kept = std::min(pairs.size(), kMostPairs);
    for (size_t i = 0; i < kept; ++i) {
      std::swap(pairs[i], pairs[i + random_.Index(static_cast<uint32_t>(pairs.size() - i))]);
      if (random_.Chance(0.5)) std::swap(pairs[i].first, pairs[i].second);
    }
    pairs.resize(kept);
    return pairs;
  }

  // Turns of the heading that bring a thing to a side that depends on the words alone: with four headings to choose from, the same
  // words are found again sooner. 0 for what is called by its word alone.
  static int QuartersTo(const Name& name, uint64_t words) {
    static constexpr const char* kOrder[] = {"front", "right", "behind", "left"};
    const auto side = std::ranges::find_if(kOrder, [&](const char* s) { return name.where == s; }) - std::begin(kOrder);
    return side == 4 ? 0 : static_cast<int>((MixBits(words) + 4 - static_cast<uint64_t>(side)) % 4);
  }

  void AskOfPair(size_t picture, const Name& a, const Name& b) {
    AskNearer(picture, a, b);
    AskBehind(picture, a, b);
    // Either way round: that the answers are opposite is worth learning.
    for (const auto& [first, second] : {std::pair(&a, &b), std::pair(&b, &a)}) {
      if (picture == 0)
        AskFacing(*first, *second);
      else
        AskSide(picture, *first, *second);
    }
    for (int i = 0; i < kThirds; ++i) {
      const Name c = named_.Turned(Pick(named_.names(picture)), quarters_);
      if (!AreTwo(a, c) || !AreTwo(b, c)) continue;
      // From there another one would be the nearest.
      const bool elsewhere = a.where == "nearest" || b.where == "nearest" || c.where == "nearest";
      if (picture == 0 && !elsewhere) AskSeenFrom(a, b, c);
      if (!elsewhere) AskNearTo(picture, a, b, c);
      AskWhatIsBehind(picture, a, b, c);
    }
  }

  // Without a side: what it is called does not change with the heading.
  static bool IsPlain(const Name& name) { return name.where == "only" || name.where == "nearest"; }
  const Name& Pick(const std::vector<Name>& names) { return names[random_.Index(static_cast<uint32_t>(names.size()))]; }
  uint16_t PickWord() { return static_cast<uint16_t>(random_.Index(static_cast<uint32_t>(named_.lexicon().words().size()))); }
  const std::string& One(uint16_t word) const { return named_.lexicon().words()[word].one; }
  const Picture& PictureOf(size_t picture) const { return named_.glance(picture).picture; }

  // Of different words, so that a question never says "the cab or the car" of one thing.
  bool AreTwo(const Name& a, const Name& b) const {
    if (a.word == b.word || a.thing->entity == b.thing->entity) return false;
    const auto named = named_.lexicon().NamedBy(b.thing->entity);
    const auto also = named_.lexicon().NamedBy(a.thing->entity);
    return std::ranges::find(named, a.word) == named.end() && std::ranges::find(also, b.word) == also.end();
  }

  // A draft of a kind with its key; the words of the key are those of the text.
  Draft& Add(const char* type, size_t picture, const std::string& key, std::vector<const Name*> names, VlnJson query) {
    Draft& d = drafts_.emplace_back();
    d.type = type;
    d.picture = picture;
    d.key = std::string(type) + (picture == 0 ? "|pano|" : "|view|") + key;
    d.query = {{"is", type}};
    d.proof = VlnJson::object();
    VlnJson of = VlnJson::array(), things = VlnJson::array();
    d.quarters = picture == 0 ? quarters_ : 0;
    for (const Name* name : names) {
      d.entities.push_back(name->thing->entity);
      d.words.push_back(name->word);
      of.push_back(ToJson(*name, named_.lexicon()));
      VlnJson& figures = things.emplace_back(Figures(*name->thing, named_.scene()));
      if (d.quarters > 0) figures["azimuth_deg"] = Rounded(std::remainder(name->thing->azimuth_deg + 90 * d.quarters, 360));
    }
    if (!names.empty()) {
      d.query["of"] = of;
      d.proof["things"] = things;
    }
    if (query.is_object()) d.query.update(query);
    return d;
  }

  // Two answers, `a` or `b`, in the order of their texts, so that the key does not tell.
  void Between(Draft& d, const Name& a, const Name& b, bool a_is_right) {
    const bool in_order = a.text < b.text;
    d.answer_type = "thing";
    d.answers = {(in_order ? a : b).text, (in_order ? b : a).text};
    d.answer = a_is_right == in_order ? 0 : 1;
  }
  static std::string KeyOf(const Name& a, const Name& b) { return std::min(a.text, b.text) + "|" + std::max(a.text, b.text); }

  void AskExists(size_t picture, uint16_t word) {
    const Sighted& sighted = named_.groups(picture)[word];
    if (sighted.clear.empty() && !sighted.none()) return;
    Draft& d = Add("exists", picture, One(word), {}, {{"word", One(word)}});
    d.words = {word};
    const std::string a = WithArticle(One(word));
    d.texts = picture == 0 ? std::vector<std::string>{"Can you see " + a + " from here?", "Is " + a + " in sight?"}
                           : std::vector<std::string>{"Is there " + a + " in this picture?", "Does this picture show " + a + "?"};
    d.answer_type = "yes/no";
    d.answers = {"yes", "no"};
    d.answer = sighted.clear.empty() ? 1 : 0;
    ProveCount(d, sighted);
  }

  void ProveCount(Draft& d, const Sighted& sighted) {
    VlnJson counted = VlnJson::array();
    for (const Seen* seen : sighted.clear) {
      counted.push_back(Figures(*seen, named_.scene()));
      d.entities.push_back(seen->entity);
    }
    d.proof["counted"] = counted;
    d.proof["doubtful"] = sighted.doubtful.size();
    d.proof["clear_from_pixels"] = kClear;
  }

  void AskCount(size_t picture, uint16_t word) {
    const Sighted& sighted = named_.groups(picture)[word];
    if (!sighted.doubtful.empty() || sighted.clear.size() > kMostCounted) return;
    const std::string& many = named_.lexicon().words()[word].many;
    Draft& d = Add("count", picture, One(word), {}, {{"word", One(word)}});
    d.words = {word};
    d.texts = picture == 0 ? std::vector<std::string>{"How many " + many + " do you see from here?", "How many " + many + " are in sight?"}
                           : std::vector<std::string>{"How many " + many + " does this picture show?",
                                                      "How many " + many + " are there in this picture?"};
    d.answer_type = "number";
    d.answer = sighted.clear.size();  // balance.cc says which numbers are asked for
    ProveCount(d, sighted);
  }

  void AskDirection(const Name& a) {
    if (!IsPlain(a)) return;
    static const std::vector<VlnJson> kAnswers = {"front", "right", "behind", "left"};
    const auto sector = std::ranges::find(kAnswers, VlnJson(NamedPlace::SectorOf(*a.thing)));
    if (sector == kAnswers.end()) return;
    for (quarters_ = 0; quarters_ < 4; ++quarters_) {
      Draft& d = Add("direction", 0, a.text, {&a}, {});
      d.texts = {"In which direction is " + a.text + ": in front of you, on your right, behind you or on your left?",
                 "Which way would you turn to face " + a.text + "?"};
      d.answer_type = "direction";
      d.answers = kAnswers;
      d.answer = (static_cast<size_t>(sector - kAnswers.begin()) + static_cast<size_t>(quarters_)) % kAnswers.size();
    }
  }

  // -1: a is surely nearer, 1: b is, 0: nobody can tell.
  int Compare(size_t picture, const Name& a, const Name& b) const {
    const DistanceBounds da = named_.Range(*a.thing, PictureOf(picture)), db = named_.Range(*b.thing, PictureOf(picture));
    if (da.most > kFarthest || db.most > kFarthest * 2) return 0;
    if (da.most * kFartherShare + kFartherBy < db.least) return -1;
    return db.most * kFartherShare + kFartherBy < da.least ? 1 : 0;
  }

  void ProveRanges(Draft& d, size_t picture, std::initializer_list<const Name*> names) {
    VlnJson bounds = VlnJson::array();
    for (const Name* name : names) {
      const DistanceBounds b = named_.Range(*name->thing, PictureOf(picture));
      bounds.push_back({Rounded(b.least), Rounded(b.most)});
    }
    d.proof["range_between"] = bounds;
  }

  void AskNearer(size_t picture, const Name& a, const Name& b) {
    const int order = Compare(picture, a, b);
    if (order == 0) return;
    Draft& d = Add("nearer", picture, KeyOf(a, b), {&a, &b}, {});
    Between(d, a, b, order < 0);
    const std::string choice = d.answers[0].get<std::string>() + " or " + d.answers[1].get<std::string>();
    const std::string turned = d.answers[1].get<std::string>() + " or " + d.answers[0].get<std::string>();
    d.texts = {"Which is nearer to you, " + choice + "?", "Which is nearer to you, " + turned + "?",
               "Which is closer" + std::string(At(picture)) + ", " + choice + "?",
               "Which is closer" + std::string(At(picture)) + ", " + turned + "?"};
    ProveRanges(d, picture, {&a, &b});
  }

  // How far the azimuths of two things overlap, as a share of the narrower; negative: degrees that lie between them.
  static double Overlap(const Seen& a, const Seen& b) {
    const double shift = std::remainder(b.azimuth_deg - a.azimuth_deg, 360) - (b.azimuth_deg - a.azimuth_deg);
    const double shared = std::min(a.right_deg, b.right_deg + shift) - std::max(a.left_deg, b.left_deg + shift);
    const double narrow = std::min(a.right_deg - a.left_deg, b.right_deg - b.left_deg);
    return shared < 0 ? shared : shared / std::max(narrow, 0.1);
  }

  // `far` stands in line with `near`, farther away.
  bool IsBehind(size_t picture, const Name& far, const Name& near) const {
    const auto level = [](const Seen& s) { return std::abs(s.elevation_deg) < 40; };
    return Overlap(*far.thing, *near.thing) > 0.7 && Compare(picture, near, far) < 0 && level(*far.thing) && level(*near.thing);
  }

  void AskBehind(size_t picture, const Name& a, const Name& b) {
    const bool a_behind = IsBehind(picture, a, b), b_behind = IsBehind(picture, b, a);
    if (a_behind == b_behind) return;
    Draft& d = Add("behind", picture, KeyOf(a, b), {&a, &b}, {});
    Between(d, a, b, a_behind);
    const auto first = d.answers[0].get<std::string>(), second = d.answers[1].get<std::string>();
    d.texts = {"Seen from here, " + first + " and " + second + " stand in line. Which of them is behind the other?",
               "Seen from here, " + second + " and " + first + " stand in line. Which of them is behind the other?"};
    ProveRanges(d, picture, {&a, &b});
    d.proof["overlap"] = Rounded(Overlap(*a.thing, *b.thing));
  }

  void AskWhatIsBehind(size_t picture, const Name& screen, const Name& a, const Name& b) {
    if (!IsBehind(picture, a, screen) || Overlap(*b.thing, *screen.thing) > -10) return;
    Draft& d = Add("what_is_behind", picture, screen.text + "|" + KeyOf(a, b), {&screen, &a, &b}, {});
    Between(d, a, b, true);
    const auto first = d.answers[0].get<std::string>(), second = d.answers[1].get<std::string>();
    d.texts = {"What is behind " + screen.text + ", seen from here: " + first + " or " + second + "?",
               "What is behind " + screen.text + ", seen from here: " + second + " or " + first + "?"};
    ProveRanges(d, picture, {&screen, &a, &b});
    d.proof["overlap"] = {Rounded(Overlap(*a.thing, *screen.thing)), Rounded(Overlap(*b.thing, *screen.thing))};
  }

  void AskFacing(const Name& a, const Name& b) {
    const double turn = std::remainder(b.thing->azimuth_deg - a.thing->azimuth_deg, 360);
    for (const Name* name : {&a, &b})
      if (!IsPlain(*name) || std::abs(name->thing->elevation_deg) > 50 || name->thing->right_deg - name->thing->left_deg > 60) return;
    if (std::abs(turn) < kLeastTurn || std::abs(turn) > kMostTurn) return;
    Draft& d = Add("facing", 0, a.text + "|" + b.text, {&a, &b}, {});
    d.texts = {"You turn to face " + a.text + ". Is " + b.text + " then on your left or on your right?",
               "If you turned on the spot to look at " + a.text + ", on which side of you would " + b.text + " be, left or right?"};
    d.answer_type = "direction";
    d.answers = {"left", "right"};
    d.answer = turn < 0 ? 0 : 1;
    d.proof["turn_deg"] = Rounded(turn);
  }

  void AskSide(size_t picture, const Name& a, const Name& b) {
    const Seen &s = *a.thing, &t = *b.thing;
    const double gap = kGapColumns * PictureOf(picture).width;
    const bool left = s.x1 + gap < t.x0, right = t.x1 + gap < s.x0;
    if (left == right) return;
    Draft& d = Add("side", picture, a.text + "|" + b.text, {&a, &b}, {});
    d.texts = {"In this picture, is " + a.text + " to the left or to the right of " + b.text + "?",
               "On which side of " + b.text + " does this picture show " + a.text + ", left or right?"};
    d.answer_type = "direction";
    d.answers = {"left", "right"};
    d.answer = left ? 0 : 1;
    d.proof["columns"] = {{s.x0, s.x1}, {t.x0, t.x1}};
  }

  // From `a`, looking at `b`: all corners of the box of `c` lie on one side.
  void AskSeenFrom(const Name& a, const Name& b, const Name& c) {
    const Box3d box = named_.BoxOf(c.thing->entity);
    const Vec3d from = Middle(a), to = Middle(b);
    const Viewpoint view{from, std::atan2(to.y - from.y, to.x - from.x)};
    if (Apart(from, to) < 4) return;
    double least = 180, most = -180;
    for (int i = 0; i < 4; ++i) {
      const double azimuth = AzimuthOf(view, {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, 0});
      least = std::min(least, azimuth);
      most = std::max(most, azimuth);
    }
    const Box3d own = named_.BoxOf(a.thing->entity);
    const double size = std::max(own.max.x - own.min.x, own.max.y - own.min.y);
    const bool right = least > kLeastTurn && most < kMostTurn, left = most < -kLeastTurn && least > -kMostTurn;
    if (left == right || size > 12 || Apart(from, Middle(c)) < size + 3) return;
    Draft& d = Add("seen_from", 0, a.text + "|" + b.text + "|" + c.text, {&a, &b, &c}, {});
    d.texts = {"If you stood at " + a.text + " and looked at " + b.text + ", would " + c.text + " be on your left or on your right?",
               "Seen from " + a.text + " while looking at " + b.text + ", is " + c.text + " on the left or on the right?"};
    d.answer_type = "direction";
    d.answers = {"left", "right"};
    d.answer = left ? 0 : 1;
    d.proof["azimuths_from_there_deg"] = {Rounded(least), Rounded(most)};
  }

  Vec3d Middle(const Name& name) const {
    const Box3d box = named_.BoxOf(name.thing->entity);
    return (box.min + box.max) * 0.5;
  }
  static double Apart(Vec3d a, Vec3d b) { return std::hypot(a.x - b.x, a.y - b.y); }

  void AskNearTo(size_t picture, const Name& a, const Name& b, const Name& c) {
    const DistanceBounds to_b = named_.Apart(a.thing->entity, b.thing->entity), to_c = named_.Apart(a.thing->entity, c.thing->entity);
    const bool b_is = to_b.most * kFartherShare + kFartherBy < to_c.least, c_is = to_c.most * kFartherShare + kFartherBy < to_b.least;
    if (b_is == c_is || std::min(to_b.most, to_c.most) > 40) return;
    Draft& d = Add("near_to", picture, a.text + "|" + KeyOf(b, c), {&a, &b, &c}, {});
    Between(d, b, c, b_is);
    const auto first = d.answers[0].get<std::string>(), second = d.answers[1].get<std::string>();
    d.texts = {"Which is nearer to " + a.text + ", " + first + " or " + second + "?",
               "Which is nearer to " + a.text + ", " + second + " or " + first + "?"};
    d.proof["metres_between"] = {{Rounded(to_b.least), Rounded(to_b.most)}, {Rounded(to_c.least), Rounded(to_c.most)}};
  }

  void AskDistance(size_t picture, const Name& a) {
    static constexpr double kMetres[] = {4, 12, 36};
    const DistanceBounds range = named_.Range(*a.thing, PictureOf(picture));
    for (size_t i = 0; i < std::size(kMetres); ++i) {
      if (range.least < kMetres[i] / 1.4 || range.most > kMetres[i] * 1.4) continue;
      Draft& d = Add("distance", picture, a.text, {&a}, {});
      d.texts = {"About how far away is " + a.text + std::string(At(picture)) + ": 4 m, 12 m or 36 m?",
                 "Roughly what is the distance to " + a.text + std::string(At(picture)) + ", 4 m, 12 m or 36 m?"};
      d.answer_type = "distance";
      d.answers = {"4 m", "12 m", "36 m"};
      d.answer = i;
      ProveRanges(d, picture, {&a});
    }
  }

  const NamedPlace& named_;
  RngStream& random_;
  int quarters_ = 0;  // of the panorama that is asked about
  std::vector<Draft> drafts_;
};

}  // namespace

std::vector<Draft> QuestionsAt(const NamedPlace& named, RngStream& random) { return Asker(named, random).Ask(); }

}  // namespace airsim360::internal
