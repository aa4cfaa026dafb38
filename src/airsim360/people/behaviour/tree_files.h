// Files of people's trees for those who edit them: the palette, the trees that come with the program, and what is wrong with
// a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Words that trees of people may use beside those of the default crowd.
struct TreeWords {
  std::vector<std::string> states, messages, areas;
  bool any_area = true;  ///< names of areas are not looked up
};

/// A file of `<root>` with the <TreeNodesModel> of people's leaves, which an editor (Groot2) loads.
std::string PeopleNodesXml();
/// The trees of the default crowd as a file, in the form that WriteXml gives.
std::string DefaultPeopleTrees();
/// Names of the trees of a file, in its order. InputError as ReadTrees.
std::vector<std::string> CheckPeopleTrees(std::string_view xml, std::string_view name, const TreeWords& words = {});

}  // namespace airsim360
