// Ambient light by place: sky seen past the buildings and the bounces of sun, sky and lamps, baked into a
// grid of probes.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Immutable. Columns stand on a square lattice over the part of the scene where its triangles are; layers
/// are close together near the ground and further apart above. Every probe holds irradiance as a + b . n + c
/// n_z^2 of the normal n, exact for n up, down, and on average level. Probes inside solids count for nothing.
/// The same bytes with any number of threads.
class LightProbes {
 public:
  struct Options {
    int max_probes = 200000;
    float cell = 2.0f;  ///< distance of columns, m; less in small rooms, more where max_probes is reached
  };

  /// None, to be filled by Visit.
  LightProbes() = default;
  /// Light after many bounces: probes twice as far apart are baked first, each time with the result of the
  /// time before. `world.earlier` is ignored.
  LightProbes(const ProbeLight& world, const Options& options);

  ProbeView view() const;
  /// Irradiance at a point for a unit normal, as the shader sees it without normal bias (scalar; for tests).
  Vec3f Irradiance(Vec3f p, Vec3f normal) const;
  /// The same from the nearest probe alone, half a cell in front of the surface; for light that bounces.
  Vec3f NearIrradiance(Vec3f p, Vec3f normal) const;
  bool Covers(Vec3f p) const;
  /// As LampGrid::TypicalLight, of all light at the probes.
  float TypicalLight() const;
  size_t size() const { return valid_.size(); }

  /// All fields, for the disk cache.
  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.cell_, s.origin_, s.nx_, s.ny_, s.nz_, s.layers_, s.height_step_, s.layer_of_height_, s.probes_, s.valid_);
  }

 private:
  void Place(const Scene& scene, const Options& options);
  void Bake(const ProbeLight& world);
  void BakeRow(const ProbeLight& world, int y, int z);
  void FillInvalid();
  Vec3f Position(int x, int y, int z) const;

  float cell_ = 2;
  Vec3f origin_;
  int nx_ = 2, ny_ = 2, nz_ = 2;
  std::vector<float> layers_;  ///< heights
  float height_step_ = 0.125f;
  std::vector<float> layer_of_height_;  ///< fractional layer, height_step_ apart from origin_.z
  TableVector<float> probes_;
  std::vector<uint8_t> valid_;
};

}  // namespace airsim360::internal
