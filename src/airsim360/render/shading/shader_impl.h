// The inside of a Shader, for the tiers that are made of the same parts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/render/indoor/indoor_cache.h"
#include "airsim360/render/indoor/indoor_kernels.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/lights/light_table.h"
#include "airsim360/render/lights/moving_lamps.h"
#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shading/roof_map.h"
#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shared/shading_kernels.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/surface/surface_tables.h"

namespace airsim360 {

struct Shader::Impl {
  /// The kernels of shading_kernels.h for this machine.
  struct Kernels {
    decltype(&internal::isa_sse42::PrepareSurfaces) prepare = AIRSIM360_SELECT_KERNEL(PrepareSurfaces);
    decltype(&internal::isa_sse42::LightSurfaces) light = AIRSIM360_SELECT_KERNEL(LightSurfaces);
    decltype(&internal::isa_sse42::SplitLight) split = AIRSIM360_SELECT_KERNEL(SplitLight);
    decltype(&internal::isa_sse42::ScatterReflections) scatter = AIRSIM360_SELECT_KERNEL(ScatterReflections);
    decltype(&internal::isa_sse42::GatherOrigins) gather_origins = AIRSIM360_SELECT_KERNEL(GatherOrigins);
    decltype(&internal::isa_sse42::AmbientRays) ambient_rays = AIRSIM360_SELECT_KERNEL(AmbientRays);
    decltype(&internal::isa_sse42::ShadeAmbient) shade_ambient = AIRSIM360_SELECT_KERNEL(ShadeAmbient);
    decltype(&internal::isa_sse42::LightByLamps) lamps = AIRSIM360_SELECT_KERNEL(LightByLamps);
    decltype(&internal::isa_sse42::LightByMovingLamps) moving_lamps = AIRSIM360_SELECT_KERNEL(LightByMovingLamps);
    decltype(&internal::isa_sse42::LookUpIndoors) indoors = AIRSIM360_SELECT_KERNEL(LookUpIndoors);
    decltype(&internal::isa_sse42::MixLampsIndoors) mix_lamps = AIRSIM360_SELECT_KERNEL(MixLampsIndoors);
    decltype(&internal::isa_sse42::LightSurfacesIndoors) light_indoors = AIRSIM360_SELECT_KERNEL(LightSurfacesIndoors);
    decltype(&internal::isa_sse42::LookUpSky) sky = AIRSIM360_SELECT_KERNEL(LookUpSky);
    decltype(&internal::isa_sse42::AddPrecipitation) precipitation = AIRSIM360_SELECT_KERNEL(AddPrecipitation);
    decltype(&internal::isa_sse42::ToneMapRow) tone = AIRSIM360_SELECT_KERNEL(ToneMapRow);
  };

  Impl(std::shared_ptr<const RayTracer> tracer, const Environment& environment);

  /// The light that an environment brings about, and all that the kernels need to know of it.
  void SetLight(const Environment& environment);
  float ChooseExposure(const Scene& scene, bool lamps_on) const;
  /// Irradiance of sun and sky on level ground.
  float Daylight() const;
  /// What keeps off what falls, and fog, where there is any.
  void FindRoofs();
  /// Finds or computes the light of rooms, where the scene has any.
  void FindIndoors();
  /// The light of rooms on surfaces; false: none of them is in a room. Things that move have no part in it.
  bool LookIndoors(const internal::RaySet& rays, const internal::SurfaceSet& surfaces, internal::IndoorLight& light) const;
  /// Fills lamp_* of surfaces, with `count` rays each.
  void LightByLamps(const internal::RaySet& rays, int count, const float* in_room, internal::SurfaceSet& surfaces) const;
  /// Adds the light of lamps that moved, after all that is known of rooms.
  void LightByMovingLamps(const internal::RaySet& rays, int count, internal::SurfaceSet& surfaces) const;
  /// Lamps of what moved shine where it is now, and no longer where it was.
  void FollowLamps();
  /// Traces the rays that mirrors and clear panes send on (where the surfaces say so) and shades what they
  /// meet in the same way, once.
  /// `around` and `sun` as in Shader::Shade, for what is seen in panes.
  void FollowRays(const internal::RaySet& rays, internal::SurfaceSet& surfaces, const SunNeighbours* around = nullptr,
                  SunPixel* sun = nullptr) const;
  /// One mirrored ray for floors and furniture in rooms that are polished: without it a ground stone floor looks like carpet. Rougher
  /// ones mirror the light of all sides. To be called after FollowRays.
  void FollowPolished(const internal::RaySet& rays, const internal::IndoorLight& room, internal::SurfaceSet& surfaces) const;
  /// Radiance of surfaces; `bounce` 0 = seen by the camera, 1 = seen in another surface. The rest as in
  /// Shader::Shade.
  void ShadeSurfaces(internal::RaySet& rays, int bounce, internal::LightSet& light, const SunNeighbours* around = nullptr,
                     SunPixel* sun = nullptr) const;
  /// Sets `sunlit`.
  void FindSun(const internal::RaySet& rays, internal::SurfaceSet& surfaces, const SunNeighbours* around, SunPixel* sun) const;

  std::shared_ptr<const RayTracer> tracer;
  internal::SurfaceTables tables;
  internal::LightTable lights;
  std::shared_ptr<const internal::Sky> sky;
  std::shared_ptr<const internal::LampGrid> lamps;
  std::vector<internal::LampRecord> still_lamps;  ///< of `lamps`, where some have moved away
  internal::MovingLamps moving_lamps;
  std::shared_ptr<const internal::LightProbes> probes;
  std::shared_ptr<const internal::IndoorCache> indoor;   ///< nullptr: no rooms, or not wanted (yet)
  std::shared_ptr<const RayTracer> built;                ///< of the scene as built
  std::shared_ptr<const internal::Enclosure> enclosure;  ///< made when first wanted
  std::shared_ptr<const internal::RoofMap> roofs;        ///< made when first wanted
  std::vector<uint8_t> moving;                           ///< with `indoor`: by instance
  Environment environment;
  bool wants_indoor = false;
  /// The last lights, latest last: kMostLights at the most.
  struct Light {
    std::string key, table_key;  ///< of what in an environment counts for all of it, and for the table of the sky
    std::shared_ptr<const internal::Sky> sky;
    std::shared_ptr<const internal::LampGrid> lamps;
    std::shared_ptr<const internal::LightProbes> probes;
    std::shared_ptr<const internal::IndoorCache> indoor;
  };
  static constexpr size_t kMostLights = 3;
  std::vector<Light> last_lights;
  internal::ShadeView view{};
  Kernels kernels;
  float exposure = 1;
};

namespace internal {
/// Rays from a surface to its strongest lamps.
inline constexpr int kLampRays = 2;

/// Splits a batch into rays that met a surface and rays that met nothing, packed and padded; `slot` is the
/// index in the batch. `sort`, if not null: surfaces in runs of one material instead of in the order of the
/// batch.
void SplitHits(const HitBatch& hits, RaySet& surfaces, RaySet& sky, const ShadeView* sort = nullptr);
}  // namespace internal

}  // namespace airsim360
