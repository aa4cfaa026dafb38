// How far a thing is from not being what a predicate says. For the .cc files of this folder.
#pragma once

#include <functional>
#include <string>

#include "airsim360/vln/predicates/query.h"

namespace airsim360::internal {

struct Candidate {
  const Thing* thing = nullptr;
  bool sure = true;  ///< no predicate so far was too close to tell
};

struct ValueOf {
  std::string unit;
  double needed = 0;                               ///< values nearer to 0 decide nothing
  std::function<double(const Thing&)> value = {};  ///< positive: it holds
};

/// Of the predicates that are filters. InputError for a sector or side that there is not.
ValueOf ValueOfPredicate(SceneGraph& graph, const Noun& noun, const Predicate& predicate, const Viewpoint& view);

}  // namespace airsim360::internal
