// Referring expressions: words that mean exactly one thing of a picture.
#include <algorithm>
#include <cmath>

#include "airsim360/eval/coco/mask.h"
#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {
namespace {

constexpr double kShare = 1.25, kBy = 0.75;  // share and metres by which one thing is nearer to another than the next
constexpr double kColumns = 0.03;            // share of the width between one and the next in a row
constexpr size_t kMostExpressionChoices = 4, kLongestRow = 6;
constexpr const char* kOrder[] = {"", "", "second ", "third "};

class Pointer {
 public:
  Pointer(const NamedPlace& named, RngStream& random) : named_(named), random_(random) {}

  std::vector<Draft> Point() {
    for (size_t picture = 0; picture < named_.pictures(); ++picture) {
      for (const Name& name : named_.names(picture))
        if (name.where != "nearest") PointByName(picture, name);
      for (uint16_t word = 0; word < named_.groups(picture).size(); ++word) {
        const Sighted& sighted = named_.groups(picture)[word];
        if (sighted.clear.size() + sighted.doubtful.size() < 2 || sighted.clear.empty()) continue;
        PointNearest(picture, word, sighted);
        if (picture > 0) PointInRow(picture, word, sighted);
        if (!named_.names(picture).empty()) PointBeside(picture, word, sighted);
      }
    }
    return std::move(drafts_);
  }

 private:
  const std::string& One(uint16_t word) const { return named_.lexicon().words()[word].one; }

  // Boxes of the thing and of others like it; others at all where there are none.
  void AddBoxes(Draft& d, const Seen& target, uint16_t word) {
    const auto& seen = named_.glance(d.picture).seen;
    std::vector<const Seen*> others;
    for (const Seen* s : named_.groups(d.picture)[word].clear) others.push_back(s);
    for (const Name& name : named_.names(d.picture)) others.push_back(name.thing);
    std::vector<EntityId> used = {target.entity};
    d.answers = {Box(target)};
    for (const Seen* other : others) {
      if (d.answers.size() == kMostExpressionChoices) break;
      if (other->round || std::ranges::find(used, other->entity) != used.end()) continue;
      used.push_back(other->entity);
      d.answers.push_back(Box(*other));
    }
    d.box = d.answers[0];
    d.mask = Mask(target);
    d.proof["seen"] = seen.size();
  }

  static VlnJson Box(const Seen& s) { return {s.x0, s.y0, s.x1 - s.x0 + 1, s.y1 - s.y0 + 1}; }

  VlnJson Mask(const Seen& target) const {
    const Image<EntityId>& pixels = named_.glance(drafts_.back().picture).pixels;
    std::vector<uint8_t> inside(static_cast<size_t>(pixels.width()) * pixels.height());
    for (int y = target.y0; y <= target.y1; ++y)
      for (int x = target.x0; x <= target.x1; ++x) inside[static_cast<size_t>(y) * pixels.width() + x] = pixels(x, y) == target.entity;
    return CompressRle(EncodeMask(inside, pixels.width(), pixels.height()));
  }

  void Add(const char* type, size_t picture, std::string text, const Seen& target, uint16_t word, VlnJson query, VlnJson proof,
           const Name* anchor = nullptr) {
    if (target.round) return;
    Draft& d = drafts_.emplace_back();
    d.type = type;
    d.key = text;
    d.picture = picture;
    d.texts = {std::move(text)};
    d.answer_type = "box";
    d.entities = {target.entity};
    d.words = {word};
    d.query = {{"is", "refer"}, {"word", One(word)}};
    d.query.update(query);
    d.proof = std::move(proof);
    d.proof["target"] = Figures(target, named_.scene());
    if (anchor != nullptr) {
      d.entities.push_back(anchor->thing->entity);
      d.words.push_back(anchor->word);
      d.query["anchor"] = ToJson(*anchor, named_.lexicon());
      d.proof["anchor"] = Figures(*anchor->thing, named_.scene());
    }
    AddBoxes(d, target, word);
  }

  VlnJson Competitors(const Sighted& sighted, const Seen& target) const {
    VlnJson list = VlnJson::array();
    for (const auto* group : {&sighted.clear, &sighted.doubtful})
      for (const Seen* s : *group)
        if (s != &target && list.size() < 4) list.push_back(Figures(*s, named_.scene()));
    return list;
  }

  void PointByName(size_t picture, const Name& name) {
    const bool only = name.where == "only";
    if (only && named_.names(picture).size() < 2) return;
    const Sighted& sighted = named_.groups(picture)[name.word];
    Add(only ? "only" : "direction", picture, name.text, *name.thing, name.word, {{"where", name.where}},
        {{"competitors", Competitors(sighted, *name.thing)}});
  }

  void PointNearest(size_t picture, uint16_t word, const Sighted& sighted) {
    const Picture& from = named_.glance(picture).picture;
    const Seen* best = named_.NearestOf(sighted, from);
    if (best == nullptr || best->nearest > 60) return;
    double next = 1e9;
    for (const auto* group : {&sighted.clear, &sighted.doubtful})
      for (const Seen* s : *group)
        if (s != best) next = std::min(next, named_.Range(*s, from).least);
    Add("nearest", picture, "the " + One(word) + " nearest to you", *best, word, {{"where", "nearest"}},
        {{"range", Rounded(best->nearest)}, {"next_at_least", Rounded(next)}, {"competitors", Competitors(sighted, *best)}});
  }

  // From the left and from the right, as the middles of what is seen lie; doubtful ones must not stand among those counted.
  void PointInRow(size_t picture, uint16_t word, const Sighted& sighted) {
    if (sighted.clear.size() < 2 || sighted.clear.size() > kLongestRow) return;
    std::vector<const Seen*> row = sighted.clear;
    row.insert(row.end(), sighted.doubtful.begin(), sighted.doubtful.end());
    std::ranges::stable_sort(row, {}, &Seen::x);
    const double gap = kColumns * named_.glance(picture).picture.width;
    for (const bool left : {true, false}) {
      if (!left) std::ranges::reverse(row);
      for (size_t k = 0; k < std::min<size_t>(3, row.size()); ++k) {
        if (std::ranges::find(sighted.doubtful, row[k]) != sighted.doubtful.end()) break;
        if (k + 1 < row.size() && std::abs(row[k + 1]->x - row[k]->x) < gap) break;
        if (k > 0 && random_.Chance(0.5)) continue;
        const std::string side = left ? "left" : "right";
        const std::string text =
            k == 0 ? "the " + side + "most " + One(word) : std::string("the ") + kOrder[k + 1] + One(word) + " from the " + side;
        VlnJson columns = VlnJson::array();
        for (const Seen* s : row) columns.push_back(Rounded(s->x));
        Add("row", picture, text, *row[k], word, {{"where", "row"}, {"side", side}, {"k", k + 1}}, {{"columns", columns}});
      }
    }
  }

  // Next to a thing that is named: much nearer to it than any other of its kind.
  void PointBeside(size_t picture, uint16_t word, const Sighted& sighted) {
    const auto& names = named_.names(picture);
    const Name& anchor = names[random_.Index(static_cast<uint32_t>(names.size()))];
    const auto named = named_.lexicon().NamedBy(anchor.thing->entity);
    if (anchor.where != "only" || anchor.word == word || std::ranges::find(named, word) != named.end()) return;
    const Seen* best = nullptr;
    double most = 1e9, next = 1e9;
    for (const Seen* s : sighted.clear) {
      const double reach = named_.Apart(s->entity, anchor.thing->entity).most;
      if (reach < most) {
        most = reach;
        best = s;
      }
    }
    for (const auto* group : {&sighted.clear, &sighted.doubtful})
      for (const Seen* s : *group)
        if (s != best) next = std::min(next, named_.Apart(s->entity, anchor.thing->entity).least);
    if (best == nullptr || most * kShare + kBy > next || most > 15 || best->nearest > 50) return;
    Add("beside", picture, "the " + One(word) + " nearest to " + anchor.text, *best, word, {{"where", "beside"}},
        {{"metres_at_most", Rounded(most)}, {"next_at_least", Rounded(next)}, {"competitors", Competitors(sighted, *best)}}, &anchor);
  }

  const NamedPlace& named_;
  RngStream& random_;
  std::vector<Draft> drafts_;
};

}  // namespace

std::vector<Draft> ExpressionsAt(const NamedPlace& named, RngStream& random) { return Pointer(named, random).Point(); }

}  // namespace airsim360::internal
