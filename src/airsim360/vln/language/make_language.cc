#include "airsim360/vln/language/make_language.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/vln/language/balance.h"

namespace airsim360 {
namespace {

using internal::Balance;
using internal::Draft;
using internal::Lookout;
using internal::Picture;
using internal::Placed;
using internal::VlnGround;
using internal::VlnJson;

constexpr int64_t kBatch = 32;          // lookouts at a time
constexpr int64_t kMostFruitless = 15;  // batches in a row without an item: the world gives no more
constexpr int64_t kMostSilent = 3;      // batches without a single draft from the start: the world gives none
constexpr int kCameras = 3;             // at each place
constexpr size_t kMostOfType = 24;      // drafts of one type and place: more would be too alike

// At most so many of each type, drawn; first those that somebody waits for.
void Thin(std::vector<Draft>& drafts, const Balance& balance, RngStream& random) {
  for (size_t i = 0; i + 1 < drafts.size(); ++i) std::swap(drafts[i], drafts[i + random.Index(static_cast<uint32_t>(drafts.size() - i))]);
  std::ranges::stable_partition(drafts, [&](const Draft& d) { return balance.Lacks(d); });
  std::map<std::string, size_t> kept;
  std::set<std::pair<std::string, size_t>> asked;
  std::erase_if(drafts, [&](const Draft& d) { return !asked.insert({d.key, d.answer}).second || ++kept[d.type] > kMostOfType; });
}

class LanguageMaker {
 public:
  LanguageMaker(Stage& stage, const LanguageOptions& options)
      : stage_(stage),
        options_(options),
        lexicon_(stage.scene()),
        surfaces_(stage.shared_scene()),
        ground_(stage.solid()),
        balance_(options.kind == "vqa", options.count, stage.seed()) {
    if (lexicon_.in_use() == 0)
      throw InputError("world '" + stage.name() + "' names nothing that language data could speak of: label it (docs/guide/labels.md)");
    for (int i = 0; i < std::min(ThreadCount(), 16); ++i) renderers_.push_back(stage.NewRenderer(Tier::kLabels));
  }

  LanguageSummary Make(const std::function<void(const std::string&)>& line) {
    ProgressBar bar("language make " + stage_.name(), options_.count);
    int64_t fruitless = 0;
    bool silent = true;
    while (balance_.left() > 0 && fruitless < (silent ? kMostSilent : kMostFruitless)) {
      for (Placed& placed : Batch()) {
        silent = false;
        balance_.Add(std::move(placed));
      }
      const int64_t before = summary_.items;
      Write(balance_.Take(), line);
      fruitless = summary_.items > before ? 0 : fruitless + 1;
      bar.Update(summary_.items);
      // What is left is less than any group.
      if (options_.count - summary_.items < 4 && fruitless > 0) break;
    }
    Write(balance_.TakeRest(), line);
    if (summary_.items < options_.count)
      throw RuntimeError("--count: world '" + stage_.name() + "' gives only " + std::to_string(summary_.items) + " of " +
                         std::to_string(options_.count) + " items of kind " + options_.kind +
                         ": too little is in sight there, or too much that looks alike" +
                         (options_.kind == "vqa" ? ", or every question has always the same answer" : ""));
    summary_.by_type.assign(by_type_.begin(), by_type_.end());
    summary_.pictures = static_cast<int64_t>(pictures_.size());
    return summary_;
  }

 private:
  std::vector<Placed> Batch() {
    std::vector<std::vector<Placed>> found(kBatch);
    std::atomic<int64_t> begun = 0;
    ParallelFor(static_cast<int64_t>(renderers_.size()), [&](int64_t worker) {
      for (int64_t i = begun++; i < kBatch; i = begun++) found[i] = At(next_ + static_cast<uint64_t>(i), *renderers_[worker]);
    });
    next_ += kBatch;
    summary_.lookouts += kBatch;
    std::vector<Placed> all;
    for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(all));
    return all;
  }

  std::vector<Placed> At(uint64_t number, Renderer& renderer) const {
    const bool vqa = options_.kind == "vqa";
    const auto lookout = internal::DrawLookout(ground_, lexicon_, surfaces_, renderer, number,
                                               {.seed = stage_.seed(),
                                                .width = options_.width,
                                                .cameras = kCameras,
                                                .later = vqa && number % 2 == 0,
                                                .masks = options_.kind == "refer"});
    if (!lookout) return {};
    RngStream random(stage_.seed(), "language drafts " + options_.kind, number);
    const internal::NamedPlace named(stage_.scene(), lexicon_, *lookout);
    std::vector<Draft> drafts;
    if (options_.kind == "caption") drafts = internal::CaptionsAt(named, random);
    if (options_.kind == "refer") drafts = internal::ExpressionsAt(named, random);
    if (vqa) {
      drafts = internal::QuestionsAt(named, random);
      for (Draft& d : internal::QuestionsOfFlight(named, random)) drafts.push_back(std::move(d));
    }
    Thin(drafts, balance_, random);
    std::vector<Placed> placed;
    for (Draft& d : drafts) {
      Placed& item = placed.emplace_back(Placed{number, {}, std::move(d)});
      const size_t shown = item.draft.picture;
      if (shown == 0 || shown == internal::kFlight)
        item.pictures.push_back(PanoramaOf(named, item.draft.quarters));
      else
        item.pictures.emplace_back("camera" + std::to_string(shown), named.glance(shown).picture);
      if (shown == internal::kFlight) item.pictures.emplace_back("later", named.glance(shown).picture);
    }
    return placed;
  }

  // Turned by whole columns: the same pixels in another order.
  static std::pair<std::string, Picture> PanoramaOf(const internal::NamedPlace& named, int quarters) {
    Picture picture = named.glance(0).picture;
    picture.from.yaw = std::remainder(picture.from.yaw + quarters * std::numbers::pi / 2, 2 * std::numbers::pi);
    return {quarters == 0 ? "panorama" : "panorama" + std::to_string(quarters * 90), picture};
  }

  std::string World() const { return stage_.name().substr(stage_.name().rfind('/') + 1); }

  std::string FileOf(const Placed& item, const std::string& which) const {
    const std::string world = World();
    return "pictures/" + world.substr(0, world.rfind('.')) + "_" + std::to_string(stage_.seed()) + "_" + std::to_string(item.lookout) +
           "_" + which + ".jpg";
  }

  static VlnJson PictureJson(std::string file, const Picture& picture) {
    VlnJson json = {{"file", std::move(file)},
                    {"projection", picture.panorama ? "equirectangular" : "perspective"},
                    {"width", picture.width},
                    {"height", picture.height},
                    {"position", internal::ToJson(picture.from.p_W)},
                    {"yaw_deg", internal::Rounded(picture.from.yaw * 180 / std::numbers::pi)}};
    if (!picture.panorama) json.update({{"azimuth_deg", picture.azimuth_deg}, {"fov_deg", 90}});
    return json;
  }

  VlnJson Nouns(const Draft& d) const {
    VlnJson nouns = VlnJson::object();
    for (const uint16_t i : d.words) {
      const Word& word = lexicon_.words()[i];
      nouns[word.one] = {{"plural", word.many},
                         {"categories", word.noun.categories},
                         {"names", word.noun.names},
                         {"without", word.noun.without},
                         {"alike", word.alike}};
    }
    return nouns;
  }

  std::string LineOf(const Placed& item, int64_t number) const {
    const Draft& d = item.draft;
    const std::string world = World();
    VlnJson pictures = VlnJson::array();
    for (const auto& [which, picture] : item.pictures) pictures.push_back(PictureJson(FileOf(item, which), picture));
    // Pictures of one place stay in one split.
    const uint64_t part = MixBits(item.lookout ^ HashName(world)) % 10;
    VlnJson json = {{"id", world + "/" + std::to_string(stage_.seed()) + "/" + options_.kind + "/" + std::to_string(number)},
                    {"kind", options_.kind},
                    {"type", d.type},
                    {"world", stage_.name()},
                    {"world_seed", stage_.seed()},
                    {"split", part == 0   ? "test"
                              : part == 1 ? "validation"
                                          : "train"},
                    {"pictures", std::move(pictures)},
                    {options_.kind == "refer" ? "expression" : "question", d.texts[item.text]},
                    {"answer_type", d.answer_type},
                    {"answer", item.choices[item.right]},
                    {"choices", item.choices},
                    {"answer_index", item.right},
                    {"entities", d.entities}};
    VlnJson wrong = VlnJson::array();
    for (size_t i = 0; i < item.choices.size(); ++i)
      if (i != item.right) wrong.push_back(item.choices[i]);
    json["distractors"] = std::move(wrong);
    if (!d.mask.is_null()) json["mask"] = d.mask;
    json["query"] = d.query;
    json["nouns"] = Nouns(d);
    json["proof"] = d.proof;
    return json.dump();
  }

  void Write(const std::vector<Placed>& items, const std::function<void(const std::string&)>& line) {
    std::vector<std::string> lines(items.size());
    ParallelFor(static_cast<int64_t>(items.size()), [&](int64_t i) { lines[i] = LineOf(items[i], summary_.items + i); });
    for (size_t i = 0; i < items.size(); ++i) {
      line(lines[i]);
      ++by_type_[items[i].draft.type];
      for (const auto& [which, picture] : items[i].pictures) pictures_.insert({items[i].lookout, HashName(which)});
    }
    summary_.items += static_cast<int64_t>(items.size());
  }

  Stage& stage_;
  const LanguageOptions& options_;
  Lexicon lexicon_;
  internal::SurfacePoints surfaces_;
  VlnGround ground_;
  Balance balance_;
  std::vector<std::unique_ptr<Renderer>> renderers_;
  uint64_t next_ = 0;
  LanguageSummary summary_;
  std::map<std::string, int64_t> by_type_;
  std::set<std::pair<uint64_t, uint64_t>> pictures_;  // named: lookout, hash of which
};

}  // namespace

void CheckLanguageOptions(const LanguageOptions& options) {
  const std::vector<std::string> kinds(std::begin(kLanguageKinds), std::end(kLanguageKinds));
  if (std::ranges::find(kinds, options.kind) == kinds.end())
    throw InputError("--kind: " + UnknownChoiceMessage("kind", options.kind, kinds));
  if (options.count < 1 || options.count > 100'000'000)
    throw InputError("--count: " + std::to_string(options.count) + " is not in 1 … 100000000");
  if (options.width < 512 || options.width > 4096 || options.width % 4 != 0)
    throw InputError("--width: " + std::to_string(options.width) + " is not in 512 … 4096 or no multiple of 4");
}

LanguageSummary MakeLanguage(Stage& stage, const LanguageOptions& options, const std::function<void(const std::string& line)>& line) {
  CheckLanguageOptions(options);
  return LanguageMaker(stage, options).Make(line);
}

}  // namespace airsim360
