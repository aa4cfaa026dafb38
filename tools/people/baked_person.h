// From the package to one character of our pack.
#pragma once

#include "airsim360/people/body/body_pack.h"
#include "mh_data.h"

namespace airsim360::bake {

/// A person to be baked.
struct Recipe {
  std::string name;
  BodySpec spec;
  int race = 0;
  std::string suit;    ///< whose upper part is worn
  std::string bottom;  ///< whose lower part is worn
  std::string shoes, hair;
};

/// Morphs, dresses and skins one person; appends pictures to the pack that it does not have yet.
void BakePerson(const Package& package, const Recipe& recipe, BodyPack& pack);

}  // namespace airsim360::bake
