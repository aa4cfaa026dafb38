// Seats of furniture by their shape: where a grown person sits, and what is around.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "airsim360/people/person_state.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

struct Seat {
  Vec3d feet;      ///< between the feet, on the floor that the furniture stands on
  double yaw = 0;  ///< where the sitter looks
  Seating seating;
};

/// Whether things of a category are sat on in furnished rooms.
bool IsSeat(std::string_view category_path);

/// Finds the seats of one piece of furniture after the other.
class SeatFinder {
 public:
  explicit SeatFinder(const Scene& scene);
  ~SeatFinder();
  /// Seats side by side that a person of 1.5 to 1.95 m has room on: back, thighs, shanks and trunk touch neither the piece
  /// nor anything else. `front` is where a piece without a back is sat on from, in W.
  std::vector<Seat> Seats(EntityId furniture, Vec2d front) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace airsim360::internal
