// Places on the surfaces of rooms, in cells of space.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "airsim360/render/indoor/indoor_world.h"
#include "airsim360/render/indoor/surface_samples.h"
#include "airsim360/render/shared/indoor_data.h"

namespace airsim360::internal {

inline constexpr int kClearSectors = 16;
/// Direction (x, y) in the plane of a surfel as a number in [0, kClearSectors): even along a square about it.
inline float ClearSector(float x, float y) {
  const float sum = (x < 0 ? -x : x) + (y < 0 ? -y : y);
  const float a = sum > 0 ? y / sum : 0;
  const float turn = x >= 0 ? (y >= 0 ? a : 4 + a) : 2 - a;
  const float sector = turn * (kClearSectors / 4);
  return sector < kClearSectors ? sector : 0;
}

/// A disc of surface while light is computed.
struct alignas(64) Surfel {
  Vec3f p, n, t, b;            ///< frame: t, b, n
  Vec3f albedo;                ///< share of even light given back
  float area = 0;              ///< m^2 that it stands for
  float clear[kClearSectors];  ///< m, at most two cells
  int32_t cell[3] = {};
  static constexpr int kPoints = 20;
  Vec3f points[kPoints];  ///< of the surface it stands for, those in its plane first
  int point_count = 0, plane_count = 0;
  /// Places in its plane that stand for all of it, itself one of them.
  std::span<const Vec3f> InPlane() const { return {points, static_cast<size_t>(plane_count)}; }
};

/// Surfels of one cell size, sorted by cell. The same with any number of threads.
class SurfelSet {
 public:
  /// On all pieces of surface where `wanted` says so (nullptr: everywhere): of every cell, and there of
  /// each of six directions, the sample nearest to the middle of them; more where samples do not see each other.
  SurfelSet(const IndoorWorld& world, std::span<const SurfacePiece> pieces, float cell,
            const std::function<bool(Vec3f p, Vec3f n)>& wanted = nullptr);

  float cell() const { return cell_; }
  Vec3f origin() const { return origin_; }
  std::vector<Surfel>& surfels() { return surfels_; }
  const std::vector<Surfel>& surfels() const { return surfels_; }
  const std::vector<IndoorCell>& cells() const { return cells_; }
  /// The surfels of a cell: index of the first, and number.
  std::pair<uint32_t, uint32_t> In(int x, int y, int z) const;
  /// How well a surfel stands for a place: 0 not at all.
  float Weight(const Surfel& surfel, Vec3f p, Vec3f n) const;
  /// The surfel nearest to a place on a surface; kNone.
  uint32_t Nearest(Vec3f p, Vec3f n) const;
  /// Gets what Nearest will read first on its way: in big scenes most of its time is waiting for memory.
  void Prefetch(Vec3f p) const;
  static constexpr uint32_t kNone = UINT32_MAX;

 private:
  void MakeTable();
  /// Where Nearest looks at surfels: what of them it needs of all.
  struct Place {
    Vec3f p, n;
  };

  float cell_;
  Vec3f origin_;
  std::vector<Surfel> surfels_;
  std::vector<IndoorCell> cells_;  ///< hash table
  std::vector<Place> places_;      ///< by surfel
};

}  // namespace airsim360::internal
