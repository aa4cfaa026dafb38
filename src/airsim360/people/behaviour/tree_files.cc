#include "airsim360/people/behaviour/tree_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/behaviour/xml.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/behaviour/plan.h"

namespace airsim360 {
namespace {

using namespace internal;

// The number of a choice by name.
Value Choice(const char* noun, const std::string& text, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) throw InputError(UnknownChoiceMessage(noun, text, names));
  Value value;
  value.kind = Value::Kind::kNumber;
  value.number = static_cast<double>(found - names.begin());
  return value;
}

}  // namespace

std::string PeopleNodesXml() { return "<root BTCPP_format=\"4\">\n" + PersonPalette().ModelXml() + "</root>\n"; }

std::string DefaultPeopleTrees() { return behaviour::WriteXml(behaviour::ReadXml(DefaultTreesXml(), "the default trees")); }

std::vector<std::string> CheckPeopleTrees(std::string_view xml, std::string_view name, const TreeWords& words) {
  TreeVocabulary vocabulary{words.states, DefaultMessages(), words.areas, words.any_area};
  for (const StateDef& state : DefaultStates()) vocabulary.states.push_back(state.name);
  vocabulary.messages.insert(vocabulary.messages.end(), words.messages.begin(), words.messages.end());
  TreeSet set;
  ReadTrees(xml, name, PersonPalette(), PersonPorts(std::move(vocabulary)), set);
  std::vector<std::string> names;
  for (const Tree& tree : set.trees) names.push_back(tree.name);
  return names;
}

namespace internal {

ParsePort PersonPorts(TreeVocabulary words) {
  return [words = std::move(words)](char what, const std::string& text) {
    // Of a line only Queue knows which place is next.
    static const std::vector<std::string> kinds(kPlaceKindNames, kPlaceKindNames + static_cast<size_t>(PlaceKind::kQueue));
    switch (what) {
      case 's':
        return Choice("state", text, words.states);
      case 'm':
        return Choice("message", text, words.messages);
      case 'k':
        return Choice("kind of place", text, kinds);
      case 'a':
        return words.any_area ? Value{} : Choice("area", text, words.areas);
      default:
        return ParsePoint(text);
    }
  };
}

Value ParsePoint(const std::string& text) {
  Value value;
  if (text.empty()) return value;
  double numbers[3] = {0, 0, 0};
  int n = 0;
  const char* at = text.c_str();
  while (n < 3) {
    char* end = nullptr;
    numbers[n] = std::strtod(at, &end);
    if (end == at || !(std::abs(numbers[n]) < 1e7)) break;
    ++n;
    at = end;
    if (*at != ';') break;
    ++at;
  }
  if (n < 2 || *at != 0) throw InputError("expected 'x;y' or 'x;y;z' in metres, found '" + text.substr(0, 100) + "'");
  value.kind = Value::Kind::kPoint;
  value.point = {numbers[0], numbers[1], numbers[2]};
  value.has_height = n == 3;
  return value;
}

}  // namespace internal

}  // namespace airsim360
