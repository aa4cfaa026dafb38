// The surfaces of rooms as points, close together.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "airsim360/render/indoor/enclosure.h"
#include "airsim360/render/indoor/indoor_world.h"

namespace airsim360::internal {

/// All parts one after the other; each is let go as soon as it is copied.
template <class T>
std::vector<T> JoinParts(std::vector<std::vector<T>> parts) {
  size_t count = 0;
  for (const auto& part : parts) count += part.size();
  std::vector<T> all;
  all.reserve(count);
  for (auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

struct SurfaceSample {
  Vec3f p, n;  ///< unit geometric normal; surfaces have two sides, so points come in pairs
  Vec3f albedo;
  float area;  ///< m^2 that it stands for
};

/// A part of a triangle in or beside enclosed space.
struct SurfacePiece {
  Vec3f corner[3];
  Vec3f normal;  ///< unit, of the front
  Vec3f albedo;
  float stands_for = 1;  ///< pieces of its size
};

/// Of pieces of less than `least` m^2 some stand for all; u: a random number in [0, 1). False if this one is left out.
bool StandsForTiny(SurfacePiece& piece, float least, float u);
/// Triangles of what does not move and is no clear pane, cut to pieces of at most kPieceSize m, in their order.
std::vector<SurfacePiece> EnclosedPieces(const IndoorWorld& world, const Enclosure& enclosure, const Reflectance& reflectance);
inline constexpr float kPieceSize = 0.7f;
/// m^2 of pieces.
double AreaOf(std::span<const SurfacePiece> pieces);
/// Points on a lattice of about `step` m on one side of a piece, at least one.
void SamplePiece(const SurfacePiece& piece, float step, bool back, const std::function<void(const SurfaceSample&)>& each);

}  // namespace airsim360::internal
