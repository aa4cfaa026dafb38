// Decides what every part of an imported file is: rules of the user first, then keywords.
#pragma once

#include <string>
#include <vector>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/labels/label_rules.h"

namespace airsim360::internal {

/// Label of one mesh part at one node.
struct PartLabel {
  std::string category;
  int rule = -1;  ///< index of the rule that matched, -1 = none
  auto operator<=>(const PartLabel&) const = default;
};

/// For each node (by index) the labels of its mesh's parts; empty for nodes without a mesh. `title` is what
/// the file is called: it labels what has no telling name of its own, as long as it does not contradict the
/// rest.
std::vector<std::vector<PartLabel>> LabelNodes(const ImportedFile& file, const LabelRules& rules, const std::string& title);

/// A warning for each rule that none of these labels comes from (the first 20).
std::vector<std::string> UnusedRules(const ImportedFile& file, const LabelRules& rules, const std::vector<std::vector<PartLabel>>& labels);

}  // namespace airsim360::internal
