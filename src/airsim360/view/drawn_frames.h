// A dataset that is not there: its frames are drawn when they are looked at.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "airsim360/scene/semantics.h"

namespace airsim360 {

/// All functions may be called from several threads; one frame is drawn at a time.
class DrawnFrames {
 public:
  virtual ~DrawnFrames() = default;

  /// index.json: as that of ViewedDataset, without times, with "planned": true and the world of each frame.
  /// entities.json: things of the worlds that were opened so far.
  /// frame/N: a plane message (view/planes.h) whose header has "p", "q" and "persons".
  /// nullopt for a path that is none; InputError for a frame that cannot be drawn.
  virtual std::optional<std::string> Made(std::string_view path) = 0;
};

/// The number of "frame/N", below `count`; nullopt for another path.
std::optional<int64_t> FrameNumber(std::string_view path, int64_t count);
/// "000012".
std::string FrameStem(int64_t number);
/// "categories" of index.json and session.json, a JSON array.
std::string CategoriesJson(const SemanticTree& tree);

}  // namespace airsim360
