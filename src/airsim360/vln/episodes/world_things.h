// Which world an episode was made in, so that it is not judged in another of the same name.
#pragma once

#include <string>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// The things of a world: how many, and the SHA-256 of their names, categories and boxes. People and bodies that are put into a
/// world later come after all else and do not count.
struct WorldThings {
  size_t count = 0;  ///< 0: not known
  std::string sha256 = {};

  bool operator==(const WorldThings&) const = default;
};

/// Of the first `count` entities, or of all; of fewer where the scene has no more.
WorldThings ThingsOf(const Scene& scene, size_t count = SIZE_MAX);

/// Empty if `made_in` is not known or is this scene, people apart; else what differs, as a sentence.
std::string ThingsDiffer(const WorldThings& made_in, const Scene& scene);

}  // namespace airsim360
