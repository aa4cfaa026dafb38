// The light of rooms as it is kept: what pixels and light that bounces look up.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/render/indoor/light_solver.h"
#include "airsim360/render/shared/indoor_data.h"

namespace airsim360::internal {

/// Light on the surfaces of all enclosed space, for one environment and what never moves. Immutable. The same bytes
/// with any number of threads. Doors and furniture stand as the scene has them.
class IndoorCache {
 public:
  /// None, to be filled by Visit.
  IndoorCache() = default;
  explicit IndoorCache(const LightSolver& solver);

  /// Whether numbers fit each other, as they do unless a file was tampered with.
  bool Sound() const;
  IndoorView view() const;
  /// Radiance of a surface in the rooms towards all sides; nullopt where no surfel is near.
  std::optional<Vec3f> RadianceAt(Vec3f p, Vec3f normal) const;
  size_t coarse_size() const { return coarse_.surfels.size(); }
  size_t fine_size() const { return fine_.surfels.size(); }
  float cell() const { return coarse_.cell; }
  size_t bytes() const;
  /// Surfels of the coarse level and their radiance, for tests.
  const TableVector<IndoorSurfel>& coarse() const { return coarse_.surfels; }
  const TableVector<IndoorSurfel>& fine() const { return fine_.surfels; }

  /// All fields, for the disk cache.
  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.coarse_.surfels, s.coarse_.cells, s.coarse_.origin, s.coarse_.cell);
    archive(s.fine_.surfels, s.fine_.cells, s.fine_.origin, s.fine_.cell);
    archive(s.radiance_);
  }

 private:
  struct Level {
    TableVector<IndoorSurfel> surfels;
    TableVector<IndoorCell> cells{16, {kNoCell, 0, 0}};
    Vec3f origin;
    float cell = 1;
  };
  static Level LevelOf(const SurfelSet& set, const LevelLight& light);
  static bool Sound(const Level& level);
  static IndoorLevel View(const Level& level);

  Level coarse_, fine_;
  std::vector<Vec3f> radiance_;  ///< by coarse surfel
};

}  // namespace airsim360::internal
