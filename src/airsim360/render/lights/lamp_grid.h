// Which lamps matter where: for shading without noise.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "airsim360/render/lights/light_table.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Radiance below which a surface that throws no beam lights so evenly that probes do better.
inline constexpr float kBrightLamp = 300 * kLux;

/// Joins a lamp with one of the same beam close by among the last of `merged` from `first` on, or appends it; its index there.
size_t MergeLamp(const Lamp& lamp, size_t first, std::vector<Lamp>& merged);
/// A lamp as kernels see it, with how far it reaches; nullopt: it is nothing beside the daylight (irradiance on the ground).
std::optional<LampRecord> RecordOf(const Lamp& lamp, float daylight);
/// Irradiance with which a lamp still counts.
float LeastLampLight(float daylight);
/// Luminance of the irradiance on a surface at p that faces a lamp, unhidden.
float StrengthOf(const LampRecord& lamp, Vec3f p);

/// Immutable. Lamps that stand close together on one instance are merged; each keeps its power, its place and
/// the direction it shines to. Cells of space near surfaces know the fifteen lamps that bring most light and
/// which of their corners see each; shading weighs all of them and sends rays to the strongest alone. Wide
/// and dim lamps (windows, signs) are not in here: light probes gather them. The same bytes with any number
/// of threads.
class LampGrid {
 public:
  /// `daylight`: irradiance of sun and sky on the ground; lamps that are nothing beside it are left out.
  LampGrid(const RayTracer& tracer, const LightTable& table, float daylight);

  /// lamps == nullptr if none is left.
  LampView view() const;
  /// The same with the lamps of these instances (ascending) switched off; `own` holds what differs, and outlives the view.
  LampView ViewWithout(std::span<const uint32_t> instances, std::vector<LampRecord>& own) const;
  /// Whether a lamp (index into LightTable::lamps) is in the grid, or its light is for the probes to gather.
  bool Holds(uint32_t lamp) const { return record_of_[lamp] != LightTable::kNoLamp; }
  size_t lamps() const { return records_.size(); }
  size_t cells() const { return cells_.size() - 1; }
  /// By cell: mean irradiance on surfaces that face +x, -x, +y, -y, +z, -z.
  std::span<const std::array<Vec3f, 6>> sides() const { return sides_; }
  /// Irradiance at a point for a unit normal with the visibility that the corners know (scalar; for probes
  /// and tests).
  Vec3f Irradiance(Vec3f p, Vec3f normal) const;

  /// Roughly the same, as the nearest cell has it on average; for light that bounces.
  Vec3f NearIrradiance(Vec3f p, Vec3f normal) const;
  /// Irradiance that lit places have: half of all light that level surfaces get falls on brighter ones. 0 if
  /// no lamp reaches any.
  float TypicalLight() const;

 private:
  struct Corner;

  void Merge(const LightTable& table, float daylight);
  void PlaceCells(const RayTracer& tracer);
  using RankedLamps = std::vector<std::pair<float, uint32_t>>;  // minus strength, number
  std::vector<uint32_t> LampsThatReach(const Box3f& box) const;
  void LookAtLamps(const RayTracer& tracer, Vec3f p, RankedLamps& ranked, Corner& corner) const;
  void MarkSolid(const RayTracer& tracer, const std::vector<uint32_t>& places, std::vector<Corner>& corners) const;
  std::vector<Corner> SeeFromCorners(const RayTracer& tracer, const std::vector<uint32_t>& places) const;
  void FillCells(const std::vector<uint32_t>& places, const std::vector<Corner>& corners, const std::vector<uint32_t>& corner_of);
  Vec3f CornerPosition(uint32_t corner) const;
  void AverageCells();
  void RaiseCorners(const RayTracer& tracer, const std::vector<uint32_t>& corners);
  /// Index in the lattice of corners of corner c of a cell: x + 2 y + 4 z.
  uint32_t CornerOf(size_t place, uint32_t c) const;

  std::vector<LampRecord> records_;
  std::vector<uint32_t> record_of_;                         ///< by lamp of the table
  std::vector<std::pair<uint32_t, uint32_t>> of_instance_;  ///< (instance, record), ascending
  std::vector<LampCell> cells_;                             ///< 0: none
  std::vector<uint32_t> cell_of_;
  std::vector<std::array<Vec3f, 6>> sides_;  ///< by cell: mean irradiance on surfaces that face +x, -x, +y …
  std::vector<float> raised_;                ///< by corner, metres; while the grid is made
  Vec3f origin_;
  float cell_ = 2.5f;
  int nx_ = 0, ny_ = 0, nz_ = 0;
};

}  // namespace airsim360::internal
