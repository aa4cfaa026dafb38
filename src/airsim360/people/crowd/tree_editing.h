// Trees of people who live already: what they are up to, and other trees for them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/behaviour/tree.h"
#include "airsim360/people/crowd/crowd.h"

namespace airsim360 {

/// Names of the trees of a crowd.
std::vector<std::string> TreeNames(const CrowdModel& model);
/// The file that a tree was read from, whole. InputError naming the nearest.
std::string TreeSource(const CrowdModel& model, std::string_view tree);

/// The crowd with the trees of a file over its own; a tree of a name that is there already replaces it. InputError as
/// BuildCrowd for a file of trees.
std::shared_ptr<const CrowdModel> WithTrees(const CrowdModel& model, std::string_view xml, std::string_view name);
/// Goes on under `after`, which WithTrees made of `before`: people whose tree is another one break off what they do and begin
/// it.
void AdoptTrees(const CrowdModel& before, const CrowdModel& after, CrowdState& state);

/// What a person is up to.
struct PersonMind {
  std::string tree;                 ///< its name
  bool commanded = false;           ///< the tree rests
  std::vector<int> active;          ///< nodes that run: their order in TreeSource
  std::vector<std::string> labels;  ///< of these
  /// A message that waits; unread ones are forgotten after two seconds.
  struct Letter {
    std::string type;
    PersonIndex from = kNoPerson;  ///< kNoPerson: a command
    int64_t t_ns = 0;              ///< sent
  };
  std::vector<Letter> inbox;
  std::vector<behaviour::BoardEntry> board;  ///< what the keys of the tree hold
};
PersonMind MindOf(const CrowdModel& model, const CrowdState& state, PersonIndex person);

}  // namespace airsim360
