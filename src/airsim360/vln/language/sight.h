// What one picture shows of each thing, measured pixel by pixel. For the .cc files of this folder.
#pragma once

#include <span>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/render/renderer.h"
#include "airsim360/vln/language/lexicon.h"
#include "airsim360/vln/language/surface_points.h"
#include "airsim360/vln/predicates/query.h"

namespace airsim360::internal {

/// Pixels from which a person recognises a thing, and up to which nobody notices it; what lies between is doubtful, and so is what
/// others or the edge of the picture hide more than two fifths of (docs/internals/benchmarks/vln.md). What is thin or behind leaves is
/// counted otherwise by other rays: these are a fifth more than the 100 pixels and the half that people need, so that check_language.cc,
/// which counts with rays of its own, finds 85 rays and a third.
inline constexpr int64_t kClear = 125, kUnseen = 4;
inline constexpr double kShown = 0.6;

/// Which picture: a level panorama, or a level camera of 90 degrees that looks `azimuth_deg` from the heading, positive to the
/// right.
struct Picture {
  bool panorama = true;
  double azimuth_deg = 0;
  Viewpoint from;
  int width = 1024, height = 512;

  Camera camera() const;
  RigidTransform X_WC() const;
};

struct Seen {
  EntityId entity = kNoEntity;
  int64_t pixels = 0;
  double azimuth_deg = 0, elevation_deg = 0;  ///< of the mean direction, from the heading of `from`
  double left_deg = 0, right_deg = 0;         ///< azimuths of its edges, around azimuth_deg (may leave [-180, 180])
  double nearest = 0;                         ///< least range, metres
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;       ///< box, inclusive; of a panorama that it crosses the seam of: all columns
  double x = 0;                               ///< mean column, pixels; not across the seam
  bool round = false;                         ///< crosses the seam of a panorama: no box holds it
  double shown = 1;                           ///< share of its surface that nothing else and no edge hides; of what has few pixels 0

  bool clear() const { return pixels >= kClear && shown >= kShown; }
};

/// All that is seen. `frame` holds entity and range of the picture. Ascending by entity. Without `surfaces` all counts as shown.
std::vector<Seen> Look(const Picture& picture, const Frame& frame, const SurfacePoints* surfaces = nullptr);

/// Of a word, who is clearly seen, and who might be counted as one.
struct Sighted {
  std::vector<const Seen*> clear, doubtful;
  /// Exactly one in sight, for sure.
  const Seen* only() const { return clear.size() == 1 && doubtful.empty() ? clear[0] : nullptr; }
  bool none() const { return clear.empty() && doubtful.empty(); }
};
/// By index of lexicon.words(). Pointers into `seen`.
std::vector<Sighted> Group(const Lexicon& lexicon, const std::vector<Seen>& seen);

}  // namespace airsim360::internal
