#include "airsim360/vln/language/layouts.h"

#include <algorithm>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/eval/coco/mask.h"
#include "airsim360/vln/language/language_item.h"
#include "airsim360/vln/language/pickle.h"

namespace airsim360 {
namespace {

using internal::LanguageItem;
using internal::VlnJson;

std::string SaidOf(const VlnJson& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string InSentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + (text.ends_with('.') ? "" : ".");
}

// Numbers of pictures, in order of arrival.
class Numbers {
 public:
  int64_t Of(const std::string& file) { return numbers_.try_emplace(file, static_cast<int64_t>(numbers_.size())).first->second; }

 private:
  std::map<std::string, int64_t> numbers_;
};

VlnJson Info(const std::string& what) { return {{"description", "AirSim360 " + what}, {"version", "1.0"}}; }

// ------------------------------------------------------------------------------------------------ VQA

std::vector<std::filesystem::path> WriteVqa(const std::filesystem::path& items, const std::filesystem::path& stem) {
  Numbers images;
  VlnJson questions = VlnJson::array(), annotations = VlnJson::array();
  internal::ReadLanguageItems(items, [&](const LanguageItem& item) {
    const auto id = static_cast<int64_t>(questions.size());
    const int64_t image = images.Of(item.pictures[0].file);
    VlnJson choices = VlnJson::array(), files = VlnJson::array();
    for (const VlnJson& choice : item.choices) choices.push_back(SaidOf(choice));
    for (const LanguagePicture& picture : item.pictures) files.push_back(picture.file);
    questions.push_back(
        {{"image_id", image}, {"image_files", files}, {"question", item.text}, {"multiple_choices", choices}, {"question_id", id}});
    // Ten annotators agree: the answer is exact.
    VlnJson answers = VlnJson::array();
    for (int k = 1; k <= 10; ++k) answers.push_back({{"answer", SaidOf(item.answer)}, {"answer_confidence", "yes"}, {"answer_id", k}});
    const bool known = item.answer_type == "yes/no" || item.answer_type == "number";
    annotations.push_back({{"question_type", item.type},
                           {"multiple_choice_answer", SaidOf(item.answer)},
                           {"answers", answers},
                           {"image_id", image},
                           {"answer_type", known ? item.answer_type : "other"},
                           {"question_id", id}});
  });
  const VlnJson head = {
      {"info", Info("visual question answering")}, {"license", VlnJson::object()}, {"data_type", "airsim360"}, {"data_subtype", "train"}};
  VlnJson asked = head, answered = head;
  asked["task_type"] = "Multiple-Choice";
  asked["num_choices"] = 4;
  asked["questions"] = std::move(questions);
  answered["annotations"] = std::move(annotations);
  const std::filesystem::path a = stem.string() + "_questions.json", b = stem.string() + "_annotations.json";
  WriteFileAtomically(a, asked.dump() + "\n");
  WriteFileAtomically(b, answered.dump() + "\n");
  return {a, b};
}

// ------------------------------------------------------------------------------------------------ LLaVA

std::string AskedOf(const LanguageItem& item) {
  if (item.kind == "refer") return "Give the bounding box of " + item.text + ", as [x, y, width, height] in pixels.";
  std::string text = item.text;
  if (item.kind == "vqa" && item.answer_type == "number") text += " Answer with a number.";
  return text;
}

std::vector<std::filesystem::path> WriteLlava(const std::filesystem::path& items, const std::filesystem::path& stem) {
  VlnJson list = VlnJson::array();
  internal::ReadLanguageItems(items, [&](const LanguageItem& item) {
    std::string marks;
    VlnJson files = VlnJson::array();
    for (const LanguagePicture& picture : item.pictures) {
      marks += "<image>\n";
      files.push_back(picture.file);
    }
    const std::string answer = item.kind == "refer" ? item.answer.dump() : InSentence(SaidOf(item.answer));
    list.push_back({{"id", item.id},
                    {"image", files.size() == 1 ? files[0] : files},
                    {"conversations", {{{"from", "human"}, {"value", marks + AskedOf(item)}}, {{"from", "gpt"}, {"value", answer}}}}});
  });
  const std::filesystem::path file = stem.string() + "_llava.json";
  WriteFileAtomically(file, list.dump() + "\n");
  return {file};
}

// ------------------------------------------------------------------------------------------------ RefCOCO

std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == ' ')
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

class RefCoco {
 public:
  void Add(const LanguageItem& item) {
    const LanguagePicture& picture = item.pictures[0];
    const auto image = images_.Of(picture.file);
    if (image == static_cast<int64_t>(pictures_.size()))
      pictures_.push_back(
          {{"id", image}, {"file_name", picture.file}, {"width", picture.width}, {"height", picture.height}, {"license", 1}});
    const std::string word = item.query.value("word", "thing");
    const auto category = categories_.try_emplace(word, static_cast<int64_t>(categories_.size()) + 1).first->second;
    // One annotation a thing and picture; each expression is a sentence of its ref.
    const EntityId entity = item.entities.empty() ? 0 : item.entities[0];
    const auto [entry, is_new] = things_.try_emplace({image, entity}, static_cast<int64_t>(refs_.size()));
    if (is_new) AddThing(item, image, category);
    const auto sentence = sentences_++;
    VlnJson& ref = refs_[static_cast<size_t>(entry->second)];
    ref["sent_ids"].push_back(sentence);
    ref["sentences"].push_back({{"sent_id", sentence}, {"sent", item.text}, {"raw", item.text}, {"tokens", WordsOf(item.text)}});
  }

  std::vector<std::filesystem::path> Write(const std::filesystem::path& stem) const {
    VlnJson categories = VlnJson::array();
    for (const auto& [word, id] : categories_) categories.push_back({{"id", id}, {"name", word}, {"supercategory", "thing"}});
    const VlnJson licences = VlnJson::array({{{"id", 1}, {"name", "as of the world"}, {"url", ""}}});
    const VlnJson instances = {{"info", Info("referring expressions")},
                               {"licenses", licences},
                               {"images", pictures_},
                               {"annotations", annotations_},
                               {"categories", categories}};
    const std::filesystem::path a = stem.string() + "_instances.json", b = stem.string() + "_refs.p";
    WriteFileAtomically(a, instances.dump() + "\n");
    WriteFileAtomically(b, internal::PickleOf(refs_));
    return {a, b};
  }

 private:
  void AddThing(const LanguageItem& item, int64_t image, int64_t category) {
    const LanguagePicture& picture = item.pictures[0];
    const auto id = static_cast<int64_t>(refs_.size());
    const RleMask mask = ParseCompressedRle(item.mask, picture.width, picture.height);
    annotations_.push_back({{"id", id},
                            {"image_id", image},
                            {"category_id", category},
                            {"bbox", item.answer},
                            {"area", MaskArea(mask)},
                            {"iscrowd", 0},
                            {"segmentation", {{"size", {picture.height, picture.width}}, {"counts", item.mask}}}});
    // REFER's names of splits.
    const char* split = item.split == "validation" ? "val" : item.split == "test" ? "test" : "train";
    refs_.push_back({{"ref_id", id},
                     {"ann_id", id},
                     {"image_id", image},
                     {"category_id", category},
                     {"file_name", picture.file},
                     {"split", split},
                     {"sent_ids", VlnJson::array()},
                     {"sentences", VlnJson::array()}});
  }

  Numbers images_;
  std::map<std::string, int64_t> categories_;
  std::map<std::pair<int64_t, EntityId>, int64_t> things_;
  VlnJson pictures_ = VlnJson::array(), annotations_ = VlnJson::array(), refs_ = VlnJson::array();
  int64_t sentences_ = 0;
};

std::vector<std::filesystem::path> WriteRefCoco(const std::filesystem::path& items, const std::filesystem::path& stem) {
  RefCoco all;
  internal::ReadLanguageItems(items, [&](const LanguageItem& item) {
    CheckLanguageLayout("refcoco", item.kind);
    all.Add(item);
  });
  return all.Write(stem);
}

}  // namespace

void CheckLanguageLayout(const std::string& layout, const std::string& kind) {
  const std::vector<std::string> known(std::begin(kLanguageLayouts), std::end(kLanguageLayouts));
  if (std::ranges::find(known, layout) == known.end()) throw InputError("--layout: " + UnknownChoiceMessage("layout", layout, known));
  if (layout == "refcoco" && kind != "refer") throw InputError("--layout: refcoco holds items of kind refer, not of " + kind);
  if (layout == "vqa" && kind != "vqa") throw InputError("--layout: vqa holds items of kind vqa, not of " + kind);
}

std::vector<std::filesystem::path> WriteLanguageLayout(const std::filesystem::path& items, const std::string& layout,
                                                       const std::filesystem::path& stem) {
  if (layout == "vqa") return WriteVqa(items, stem);
  if (layout == "llava") return WriteLlava(items, stem);
  return WriteRefCoco(items, stem);
}

}  // namespace airsim360
