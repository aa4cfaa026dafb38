#include "airsim360/assets/labels/label_rules.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMaxRules = 10000;

[[noreturn]] void Fail(const std::string& file, const YAML::Mark& mark, const std::string& what) {
  throw InputError(file + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1) + ": " + what);
}

// The scalar text of a value, never empty.
std::string Text(const std::string& file, const std::string& key, const YAML::Node& node) {
  if (!node.IsScalar() || node.Scalar().empty()) Fail(file, node.Mark(), key + ": a text expected");
  return node.Scalar().substr(0, 1000);
}

bool Flag(const std::string& file, const std::string& key, const YAML::Node& node) {
  const std::string text = Text(file, key, node);
  if (text != "true" && text != "false") Fail(file, node.Mark(), key + ": " + Quoted(text) + " is neither true nor false");
  return text == "true";
}

// Calls visit(key, value) for each member of a mapping; keys must be among `choices`.
template <size_t N, class Visit>
void VisitMapping(const std::string& file, const YAML::Node& node, const std::array<std::string, N>& choices, const char* what,
                  Visit visit) {
  if (!node.IsMap()) Fail(file, node.Mark(), std::string(what) + ": a mapping of keys to values expected");
  for (const auto& member : node) {
    const std::string key = Text(file, "key", member.first);
    if (std::find(choices.begin(), choices.end(), key) == choices.end()) {
      Fail(file, member.first.Mark(), UnknownChoiceMessage("key", CleanName(key), choices));
    }
    visit(key, member.second);
  }
}

std::vector<std::string> SplitPattern(const std::string& file, const YAML::Node& node) {
  std::vector<std::string> globs(1);
  for (char c : Text(file, "match", node)) {
    if (c == '/')
      globs.emplace_back();
    else
      globs.back() += c;
  }
  if (globs.size() > 3) Fail(file, node.Mark(), "match: at most three parts, node/mesh/material");
  return globs;
}

LabelRule ParseRule(const std::string& file, const YAML::Node& node) {
  static const std::array<std::string, 4> kKeys = {"match", "category", "name", "entity"};
  LabelRule rule;
  rule.line = node.Mark().line + 1;
  VisitMapping(file, node, kKeys, "rule", [&](const std::string& key, const YAML::Node& value) {
    if (key == "match") rule.match = SplitPattern(file, value);
    if (key == "category") rule.category = Text(file, key, value);
    if (key == "name") rule.name = CleanName(Text(file, key, value));
    if (key != "entity") return;
    const std::string entity = Text(file, key, value);
    static const std::array<std::string, 2> kChoices = {"each", "merge"};
    if (std::find(kChoices.begin(), kChoices.end(), entity) == kChoices.end()) {
      Fail(file, value.Mark(), UnknownChoiceMessage("entity", CleanName(entity), kChoices));
    }
    rule.merge = entity == "merge";
  });
  if (rule.match.empty()) Fail(file, node.Mark(), "the rule has no match");
  if (rule.category.empty() && rule.name.empty() && !rule.merge)
    Fail(file, node.Mark(), "the rule says nothing: give a category, a name or entity: merge");
  return rule;
}

LabelRules ParseDocument(const std::string& file, const YAML::Node& root) {
  static const std::array<std::string, 3> kKeys = {"keywords", "default", "rules"};
  LabelRules out;
  out.file = file;
  if (root.IsNull()) return out;
  VisitMapping(file, root, kKeys, "label file", [&](const std::string& key, const YAML::Node& value) {
    if (key == "keywords") out.keywords = Flag(file, key, value);
    if (key == "default") {
      out.otherwise = Text(file, key, value);
      out.otherwise_line = value.Mark().line + 1;
    }
    if (key != "rules" || value.IsNull()) return;
    if (!value.IsSequence()) Fail(file, value.Mark(), "rules: a list expected");
    if (value.size() > kMaxRules) Fail(file, value.Mark(), "rules: at most " + std::to_string(kMaxRules) + " allowed");
    for (const auto& rule : value) out.rules.push_back(ParseRule(file, rule));
  });
  return out;
}

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

LabelRules ParseLabelRules(const std::string& file, std::string_view text) {
  constexpr size_t kMaxSize = size_t{4} << 20;
  if (text.size() > kMaxSize) throw InputError(file + ": a label file of more than 4 MiB");
  // JSON is YAML, but for the tabs that may indent it.
  std::string yaml(text);
  const size_t first = yaml.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && yaml[first] == '{') std::replace(yaml.begin(), yaml.end(), '\t', ' ');
  try {
    return ParseDocument(file, YAML::Load(yaml));
  } catch (const YAML::Exception& error) {
    if (error.mark.is_null()) throw InputError(file + ": " + error.msg);
    Fail(file, error.mark, error.msg);
  }
}

bool MatchesGlob(std::string_view pattern, std::string_view text) {
  // Greedy with one point to come back to: linear in pattern times text.
  size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || Lower(pattern[p]) == Lower(text[t]))) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::string UnusedRule(const LabelRules& rules, size_t index, bool taken) {
  const LabelRule& rule = rules.rules[index];
  std::string pattern;
  for (const std::string& part : rule.match) pattern += (&part == rule.match.data() ? "" : "/") + part;
  return rules.file + ":" + std::to_string(rule.line) + ": rule " + std::to_string(index + 1) + " (" + Quoted(pattern) +
         ") matches nothing" + (taken ? " that an earlier rule has not matched" : "");
}

bool Matches(const LabelRule& rule, std::string_view node, std::string_view mesh, std::string_view material) {
  const auto& m = rule.match;
  if (m.size() == 1) return MatchesGlob(m[0], node) || MatchesGlob(m[0], mesh) || MatchesGlob(m[0], material);
  return MatchesGlob(m[0], node) && MatchesGlob(m[1], mesh) && (m.size() == 2 || MatchesGlob(m[2], material));
}

}  // namespace airsim360::internal
