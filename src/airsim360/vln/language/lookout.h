// Places from which language data looks at a world. For the .cc files of this folder.
#pragma once

#include <memory>
#include <optional>

#include "airsim360/vln/episodes/ground.h"
#include "airsim360/vln/language/sight.h"

namespace airsim360::internal {

/// One place and what is seen from it: a panorama, one camera's picture, and for half of the places a second panorama at the end
/// of a straight flight ahead.
struct Lookout {
  uint64_t number = 0;
  Picture panorama, view;
  std::optional<Picture> later;
  std::vector<Seen> around, ahead, afterwards;  ///< of panorama, view, later
  Image<EntityId> around_pixels, ahead_pixels;  ///< kept if `masks`

  const std::vector<Seen>& seen(int picture) const { return picture == 0 ? around : picture == 1 ? ahead : afterwards; }
  const Picture& picture(int k) const { return k == 0 ? panorama : k == 1 ? view : *later; }
};

struct LookoutOptions {
  uint64_t seed = 0;
  int width = 1024;    ///< of panoramas
  bool later = false;  ///< whether to fly ahead
  bool masks = false;
};

/// A free place of that number with things of the lexicon in sight; nullopt: its draws found none. A pure function of the world,
/// the options and the number. `renderer`: of labels.
std::optional<Lookout> DrawLookout(const VlnGround& ground, const Lexicon& lexicon, Renderer& renderer, uint64_t number, const LookoutOptions& options);

}  // namespace airsim360::internal
