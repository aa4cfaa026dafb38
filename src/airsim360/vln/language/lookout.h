// Places from which language data looks at a world. For the .cc files of this folder.
#pragma once

#include <memory>
#include <optional>

#include "airsim360/vln/episodes/ground.h"
#include "airsim360/vln/language/sight.h"

namespace airsim360::internal {

/// A picture and what it shows.
struct Glance {
  Picture picture;
  std::vector<Seen> seen = {};
  Image<EntityId> pixels = {};  ///< kept if masks are asked for
};

/// One place and what is seen from it: a panorama, pictures of some cameras, and for some places a second panorama at the end of a
/// straight flight ahead.
struct Lookout {
  uint64_t number = 0;
  std::vector<Glance> glances;  ///< first the panorama, then the cameras
  std::optional<Glance> later;
};

struct LookoutOptions {
  uint64_t seed = 0;
  int width = 1024;  ///< of panoramas
  int cameras = 1;
  bool later = false;  ///< whether to fly ahead, past something that is the only one of its word
  bool masks = false;
};

/// Of a few free places of that number the one that promises most, with things of the lexicon in sight; nullopt: its draws found
/// none. A pure function of the world, the options and the number. `renderer`: of labels.
std::optional<Lookout> DrawLookout(const VlnGround& ground, const Lexicon& lexicon, const SurfacePoints& surfaces, Renderer& renderer,
                                   uint64_t number, const LookoutOptions& options);

}  // namespace airsim360::internal
