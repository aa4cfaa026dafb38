// Lamps of what moves: head lamps, tail lamps, brake lamps and indicators of vehicles, carried along by each instant.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "airsim360/render/lights/light_table.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The lamps that shine where the instances of one instant stand, beside those of a LampGrid. What it holds is found anew for each
/// instant: columns of space that know the fifteen strongest moving lamps, and which of their corners, at the lamp's height, see each.
/// Lamps are merged, left out and shaded as those of the grid are; bent meshes have none. The same bytes with any number of threads,
/// and whatever was shown before.
class MovingLamps {
 public:
  /// Lamps of the instances `moved` at their places there. The instant's rays tell what hides them. `daylight` as in LampGrid.
  void Follow(const RayTracer& tracer, const SurfaceTables& tables, const Environment& environment, std::span<const MovedInstance> moved,
              float daylight);
  /// One layer of cells, whatever the height; lamps == nullptr if none moves.
  LampView view() const;
  size_t lamps() const { return records_.size(); }
  /// Whether the light of a lamp of the table, wherever the scene has it, is among theirs.
  bool Holds(const Lamp& lamp) const;

 private:
  // A column that a lamp reaches, and the light there.
  struct Reached {
    int x, y;
    float strength;
  };

  const std::vector<Lamp>& LampsOf(const Scene& scene, const SurfaceTables& tables, const Environment& environment, uint32_t instance);
  void PlaceColumns(float daylight);
  std::vector<Reached> ColumnsInReach(const LampRecord& lamp, float least) const;
  void Keep(uint32_t lamp, const std::vector<Reached>& reached, std::vector<float>& strengths);
  void LookFromCorners(const RayTracer& tracer, uint32_t lamp, const std::vector<Reached>& reached);
  Vec3f CornerAt(const LampRecord& lamp, int x, int y) const;

  std::map<MeshId, std::vector<Lamp>> mesh_lamps_;  // in the mesh frame, of white glow
  std::vector<uint32_t> instances_;                 // that have lamps now, ascending
  std::vector<LampRecord> records_;
  std::vector<LampCell> cells_;  // 0: none
  std::vector<uint32_t> cell_of_;
  std::vector<std::vector<Reached>> reached_;  // by lamp
  float origin_x_ = 0, origin_y_ = 0, cell_ = 6;
  int nx_ = 0, ny_ = 0;
};

/// Those of RayTracer::moved that are not where the scene has them.
std::vector<MovedInstance> AwayFromHome(const RayTracer& tracer);

}  // namespace airsim360::internal
