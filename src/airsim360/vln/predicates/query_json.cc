#include "airsim360/vln/predicates/query_json.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"

namespace airsim360::internal {
namespace {

constexpr int kDeepest = 16;
constexpr size_t kMostTexts = 64, kLongestText = 2000, kLongestShown = 60;
constexpr double kFarthest = 1e6;  // metres

std::string Shown(const VlnJson& value) {
  std::string text = value.dump(-1, ' ', true, VlnJson::error_handler_t::replace);
  return text.size() > kLongestShown ? text.substr(0, kLongestShown) + "…" : text;
}

Noun NounOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  Noun noun{fields.Text("word", ""), fields.Texts("categories"), fields.Texts("names"), fields.Texts("without"),
            fields.Flag("whole", false)};
  fields.Finish();
  if (!Names(noun)) throw InputError(where + ": a noun needs 'categories' or 'names'");
  return noun;
}

VlnJson ToJson(const Noun& noun) {
  VlnJson json = {{"word", noun.word}};
  if (!noun.categories.empty()) json["categories"] = noun.categories;
  if (!noun.names.empty()) json["names"] = noun.names;
  if (!noun.without.empty()) json["without"] = noun.without;
  if (noun.whole) json["whole"] = true;
  return json;
}

Predicate PredicateOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  const std::string is = fields.Text("is", "");
  const std::vector<std::string> names(std::begin(kPredicateNames), std::end(kPredicateNames));
  const auto found = std::ranges::find(names, is);
  if (found == names.end()) throw InputError(where + ".is: " + UnknownChoiceMessage("predicate", is, names));
  Predicate predicate{.kind = static_cast<PredicateKind>(found - names.begin())};
  predicate.sector = fields.Text("sector", "");
  predicate.k = static_cast<int>(fields.Number("k", 1, 1, 100));
  predicate.share = fields.Number("share", 0.5, 0, 1);
  predicate.width = fields.Number("width", 12, 0.1, 1000);
  predicate.clear = fields.Number("clear", 0, 0, 1000);
  predicate.within = fields.Number("within", 40, 0, 1000);
  predicate.at_turn = fields.Flag("at_turn", false);
  predicate.side_of_axis = fields.Flag("side_of_axis", false);
  if (const VlnJson* of = fields.Find("of")) predicate.of = NounOf(*of, where + ".of");
  fields.Finish();
  return predicate;
}

VlnJson ToJson(const Predicate& predicate) {
  const Predicate usual;
  VlnJson json = {{"is", kPredicateNames[static_cast<int>(predicate.kind)]}};
  if (!predicate.sector.empty()) json["sector"] = predicate.sector;
  if (predicate.k != usual.k) json["k"] = predicate.k;
  if (predicate.share != usual.share) json["share"] = predicate.share;
  if (predicate.width != usual.width) json["width"] = predicate.width;
  if (predicate.clear != usual.clear) json["clear"] = predicate.clear;
  if (predicate.within != usual.within) json["within"] = predicate.within;
  if (predicate.at_turn) json["at_turn"] = true;
  if (predicate.side_of_axis) json["side_of_axis"] = true;
  if (Names(predicate.of)) json["of"] = ToJson(predicate.of);
  return json;
}

}  // namespace

double Rounded(double value) { return std::round(value * 1000) / 1000 + 0.0; }

VlnJson ParseVlnJson(const std::string& text, const std::string& name) {
  const auto check = [&](int depth, VlnJson::parse_event_t, VlnJson&) {
    if (depth > kDeepest) throw InputError(name + ": JSON is nested deeper than " + std::to_string(kDeepest) + " levels");
    return true;
  };
  try {
    return VlnJson::parse(text.begin(), text.end(), check);
  } catch (const VlnJson::exception& error) {
    const std::string what = error.what();
    const size_t at = what.find("line ");
    throw InputError(name + ": not JSON" + (at == std::string::npos ? "" : ", " + what.substr(at, what.find(':', at) - at)));
  }
}

VlnFields::VlnFields(const VlnJson& value, std::string where) : value_(value), where_(std::move(where)) {
  if (!value.is_object()) throw InputError(where_ + ": " + Shown(value) + " is not an object");
}

void VlnFields::Refuse(const char* name, const std::string& what) const { throw InputError(where_ + "." + name + ": " + what); }

const VlnJson* VlnFields::Find(const char* name) {
  known_.emplace_back(name);
  const auto found = value_.find(name);
  return found == value_.end() || found->is_null() ? nullptr : &*found;
}

const VlnJson& VlnFields::At(const char* name) {
  const VlnJson* found = Find(name);
  if (found == nullptr) Refuse(name, "is missing");
  return *found;
}

std::string VlnFields::Text(const char* name, const std::string& otherwise) {
  const VlnJson* found = Find(name);
  if (found == nullptr) return otherwise;
  if (!found->is_string()) Refuse(name, Shown(*found) + " is not a text");
  const auto text = found->get<std::string>();
  if (text.size() > kLongestText) Refuse(name, "is longer than " + std::to_string(kLongestText) + " bytes");
  return text;
}

double VlnFields::Number(const char* name, double otherwise, double low, double high) {
  const VlnJson* found = Find(name);
  if (found == nullptr) return otherwise;
  if (!found->is_number()) Refuse(name, Shown(*found) + " is not a number");
  const double value = found->get<double>();
  if (!(value >= low && value <= high)) Refuse(name, Shown(*found) + " is not in " + VlnJson(low).dump() + " … " + VlnJson(high).dump());
  return value;
}

bool VlnFields::Flag(const char* name, bool otherwise) {
  const VlnJson* found = Find(name);
  if (found == nullptr) return otherwise;
  if (!found->is_boolean()) Refuse(name, Shown(*found) + " is neither true nor false");
  return found->get<bool>();
}

std::vector<std::string> VlnFields::Texts(const char* name) {
  const VlnJson* found = Find(name);
  if (found == nullptr) return {};
  if (!found->is_array() || found->size() > kMostTexts) Refuse(name, Shown(*found) + " is not a list of at most 64 texts");
  std::vector<std::string> texts;
  for (const VlnJson& text : *found) {
    if (!text.is_string()) Refuse(name, Shown(text) + " is not a text");
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

Vec3d PointOf(const VlnJson& value, const std::string& where) {
  if (!value.is_array() || value.size() != 3) throw InputError(where + ": " + Shown(value) + " is not [x, y, z]");
  Vec3d p;
  for (int i = 0; i < 3; ++i) {
    const VlnJson& number = value[static_cast<size_t>(i)];
    if (!number.is_number() || !(std::abs(number.get<double>()) <= kFarthest))
      throw InputError(where + ": " + Shown(number) + " is no number of metres within 1000 km");
    p[i] = number.get<double>();
  }
  return p;
}

Vec3d VlnFields::Point(const char* name) { return PointOf(At(name), where_ + "." + name); }

std::vector<Vec3d> VlnFields::Points(const char* name, size_t most) {
  const VlnJson& list = At(name);
  if (!list.is_array() || list.size() > most) Refuse(name, Shown(list) + " is not a list of at most " + std::to_string(most) + " points");
  std::vector<Vec3d> points;
  for (size_t i = 0; i < list.size(); ++i) points.push_back(PointOf(list[i], where_ + "." + name + "[" + std::to_string(i) + "]"));
  return points;
}

void VlnFields::Finish() const {
  for (const auto& [key, value] : value_.items()) {
    if (std::ranges::find(known_, key) == known_.end())
      throw InputError(where_ + ": unknown field '" + key.substr(0, kLongestShown) + "'" +
                       DidYouMean(key.substr(0, kLongestShown), known_));
  }
}

VlnJson ToJson(Vec3d p) { return {Rounded(p.x), Rounded(p.y), Rounded(p.z)}; }

Query QueryOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  Query query{NounOf(fields.At("noun"), where + ".noun")};
  const VlnJson& list = fields.At("predicates");
  if (const VlnJson* rivals = fields.Find("rivals")) query.rivals = NounOf(*rivals, where + ".rivals");
  fields.Finish();
  if (!list.is_array() || list.size() > 16) throw InputError(where + ".predicates: " + Shown(list) + " is not a list of at most 16");
  for (size_t i = 0; i < list.size(); ++i)
    query.predicates.push_back(PredicateOf(list[i], where + ".predicates[" + std::to_string(i) + "]"));
  return query;
}

VlnJson ToJson(const Query& query) {
  VlnJson predicates = VlnJson::array();
  for (const Predicate& predicate : query.predicates) predicates.push_back(ToJson(predicate));
  VlnJson json = {{"noun", ToJson(query.noun)}, {"predicates", predicates}};
  if (Names(query.rivals)) json["rivals"] = ToJson(query.rivals);
  return json;
}

VlnJson ToJson(const Verdict& verdict) {
  VlnJson steps = VlnJson::array();
  for (const ProofStep& step : verdict.steps) {
    VlnJson competitors = VlnJson::array();
    for (const Competitor& c : step.competitors)
      competitors.push_back({{"entity", c.entity}, {"name", c.name}, {"value", Rounded(c.value)}});
    steps.push_back({{"predicate", step.predicate},
                     {"unit", step.unit},
                     {"before", step.before},
                     {"after", step.after},
                     {"value", Rounded(step.value)},
                     {"margin", Rounded(step.margin)},
                     {"needed", step.needed},
                     {"competitors", competitors}});
  }
  return {{"unique", verdict.decided}, {"method", "bounds of boxes"}, {"steps", steps}};
}

}  // namespace airsim360::internal
