// The label file that a user may put beside a model (docs/guide/labels.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/assets/imported.h"

namespace airsim360::internal {

/// One rule: what matches gets this label.
struct LabelRule {
  std::vector<std::string> match;  ///< globs: one for any name, two for node/mesh, three for node/mesh/material
  std::string category;            ///< "" = keep what the keywords say
  std::string name;                ///< of the entity; "" = the node's own
  bool merge = false;              ///< everything that matches is one entity
  int line = 0;
};

struct LabelRules {
  std::string file;
  bool keywords = true;   ///< use the keyword table where no rule matches
  std::string otherwise;  ///< category of what nothing tells; "" = "object"
  int otherwise_line = 0;
  std::vector<LabelRule> rules;
};

/// YAML or JSON. InputError "file:line:column: …" for broken syntax, an unknown key (naming the nearest) or a
/// bad value.
LabelRules ParseLabelRules(const std::string& file, std::string_view text);

/// '*' stands for any characters, '?' for one; case does not matter.
bool MatchesGlob(std::string_view pattern, std::string_view text);

/// Does a rule match a part with these names?
bool Matches(const LabelRule& rule, std::string_view node, std::string_view mesh, std::string_view material);

/// "file:3: rule 1 ('zzz*') matches nothing", or, where `taken`, only what earlier rules have.
std::string UnusedRule(const LabelRules& rules, size_t index, bool taken);

}  // namespace airsim360::internal
