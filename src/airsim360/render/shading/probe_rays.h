// What the baking of light probes asks of the scene.
#pragma once

#include <array>
#include <span>

#include "airsim360/render/sky/sky.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

class LampGrid;
class LightProbes;
class LightTable;

/// What gives light to probes. All but `tracer` and `tables` may be nullptr.
struct ProbeLight {
  const RayTracer& tracer;
  const SurfaceTables& tables;
  const Sky* sky = nullptr;            ///< nullptr in closed rooms: there surfaces glow with interior_light
  const LightTable* lights = nullptr;  ///< to know emission that `lamps` holds
  const LampGrid* lamps = nullptr;
  const LightProbes* earlier = nullptr;  ///< light that surfaces got by bounces, as known so far
};

/// What up to sixteen probes see in one direction.
struct Seen {
  std::array<Vec3f, 16> light{};  ///< radiance: the sky, or a surface and what lights it
  std::array<Vec3f, 16> guess{};  ///< what a surface adds if it sees as much sky as in a street
  std::array<bool, 16> open{};    ///< nothing was met
  std::array<bool, 16> behind{};  ///< a surface was met from behind: the probe is in a solid
};

/// One packet from at most sixteen points. Clear panes let light in.
Seen LookAlong(const ProbeLight& world, std::span<const Vec3f> points, Vec3f direction);

/// Where the scene's detail is: all but the outermost hundredths of its triangles, each way, with a margin;
/// empty for an empty scene.
Box3f DetailBounds(const Scene& scene);
/// What of it lies no farther than `reach` from the spawn (or its own middle) in x and in y.
Box3f DetailAround(const Scene& scene, float reach);

}  // namespace airsim360::internal
