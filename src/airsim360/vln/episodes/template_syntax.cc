#include "airsim360/vln/episodes/template_syntax.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/vln/episodes/any_world_templates.h"
#include "airsim360/vln/episodes/language_episode.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::VlnFields;
using internal::VlnJson;

constexpr size_t kMostTemplates = 10'000;

template <class Kind, size_t kCount>
Kind ChoiceOf(VlnFields& fields, const char* name, const char* const (&names)[kCount], Kind otherwise) {
  const std::string text = fields.Text(name, names[static_cast<int>(otherwise)]);
  const std::vector<std::string> choices(std::begin(names), std::end(names));
  const auto found = std::ranges::find(choices, text);
  if (found == choices.end()) throw InputError(fields.where() + "." + name + ": " + UnknownChoiceMessage(name, text, choices));
  return static_cast<Kind>(found - choices.begin());
}

// "in_sight": true, or how many pixels of it.
int64_t PixelsOf(VlnFields& fields) {
  const VlnJson* found = fields.Find("in_sight");
  if (found != nullptr && found->is_number()) return static_cast<int64_t>(fields.Number("in_sight", 0, 0, kSeenWidth * kSeenWidth / 2.0));
  return fields.Flag("in_sight", false) ? kInSight : 0;
}

// "distance": [24, 150]
void ReadRange(VlnFields& fields, const char* name, double& low, double& high) {
  const VlnJson* found = fields.Find(name);
  if (found == nullptr) return;
  const bool numbers = found->is_array() && found->size() == 2 && (*found)[0].is_number() && (*found)[1].is_number();
  if (!numbers ||
      !((*found)[0].get<double>() >= 0 && (*found)[1].get<double>() >= (*found)[0].get<double>() && (*found)[1].get<double>() <= 1000))
    throw InputError(fields.where() + "." + name + ": " + found->dump().substr(0, 60) + " is not [least, most] within 0 … 1000 metres");
  low = (*found)[0].get<double>();
  high = (*found)[1].get<double>();
}

NextPart PartOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  NextPart part{.query = internal::QueryOf(fields.At("query"), where + ".query")};
  part.goal = ChoiceOf(fields, "goal", kGoalKindNames, GoalKind::kNear);
  part.distance = fields.Number("goal_distance", 4, 0, 50);
  fields.Finish();
  return part;
}

InstructionTemplate TemplateOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  InstructionTemplate made;
  made.id = fields.Text("id", "");
  made.text = fields.Text("text", "");
  if (made.id.empty() || made.text.empty()) throw InputError(where + ": needs 'id' and 'text'");
  made.query = internal::QueryOf(fields.At("query"), where + ".query");
  made.frame = ChoiceOf(fields, "frame", kStartFrameNames, StartFrame::kAround);
  made.heading = fields.Text("heading", "any");
  std::vector<std::string> sectors = {"any"};
  for (const Sector& sector : kSectors) sectors.emplace_back(sector.name);
  if (std::ranges::find(sectors, made.heading) == sectors.end())
    throw InputError(where + ".heading: " + UnknownChoiceMessage("sector", made.heading, sectors));
  ReadRange(fields, "distance", made.nearest, made.farthest);
  ReadRange(fields, "height", made.lowest, made.highest);
  made.goal = ChoiceOf(fields, "goal", kGoalKindNames, GoalKind::kNear);
  made.distance = fields.Number("goal_distance", 4, 0, 50);
  made.in_sight = PixelsOf(fields);
  made.room = fields.Number("room", 0, 0, 10);
  made.radius = fields.Number("radius", 0, 0, 100);
  if (const VlnJson* then = fields.Find("then")) {
    if (!then->is_array() || then->size() > kMostParts)
      throw InputError(where + ".then: is not a list of at most " + std::to_string(kMostParts) + " parts");
    const bool turns = made.frame == StartFrame::kTurn || std::ranges::any_of(made.query.predicates, &Predicate::at_turn);
    if (turns && !then->empty()) throw InputError(where + ".then: an instruction that turns at a junction has one part");
    for (size_t i = 0; i < then->size(); ++i) made.then.push_back(PartOf((*then)[i], where + ".then[" + std::to_string(i) + "]"));
  }
  fields.Finish();
  return made;
}

}  // namespace

std::vector<InstructionTemplate> ParseTemplates(const std::string& text, const std::string& name) {
  const VlnJson list = internal::ParseVlnJson(text, name);
  if (!list.is_array() || list.empty() || list.size() > kMostTemplates)
    throw InputError(name + ": is not a list of 1 … " + std::to_string(kMostTemplates) + " templates");
  std::vector<InstructionTemplate> templates;
  std::set<std::string> ids;
  for (size_t i = 0; i < list.size(); ++i) {
    templates.push_back(TemplateOf(list[i], name + "[" + std::to_string(i) + "]"));
    if (!ids.insert(templates.back().id).second)
      throw InputError(name + "[" + std::to_string(i) + "].id: '" + templates.back().id + "' is there twice");
  }
  return templates;
}

const std::vector<InstructionTemplate>& PaperTemplates() {
  static const std::vector<InstructionTemplate> templates = ParseTemplates(std::string(PaperTemplatesText()), "paper37");
  return templates;
}

std::vector<InstructionTemplate> FindTemplates(const std::string& name, const Scene& scene, bool rooms) {
  if (name == "paper37") return PaperTemplates();
  if (name == "any") return AnyWorldTemplates(scene, rooms);
  if (!std::filesystem::exists(name))
    throw InputError("--templates: " + UnknownChoiceMessage("templates", name, std::vector<std::string>{"paper37", "any"}) +
                     ", and there is no such file");
  return ParseTemplates(ReadTextFile(name, uint64_t{16} << 20), name);
}

}  // namespace airsim360
