// What the baking of light probes asks of the scene.
#pragma once

#include <array>
#include <span>

#include "airsim360/render/shading/sky.h"
#include "airsim360/render/shading/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// What up to sixteen probes see in one direction.
struct Seen {
  std::array<Vec3f, 16> light{};  ///< radiance: the sky, or a surface lit by the sun
  std::array<Vec3f, 16> guess{};  ///< what a surface adds if it sees as much sky as in a street
  std::array<bool, 16> open{};    ///< nothing was met
  std::array<bool, 16> behind{};  ///< a surface was met from behind: the probe is in a solid
};

/// One packet from at most sixteen points. `sky` is nullptr in closed rooms: there surfaces glow with the
/// scene's interior light, less where they are near.
Seen LookAlong(const RayTracer& tracer, const SurfaceTables& tables, const Sky* sky,
               std::span<const Vec3f> points, Vec3f direction);

/// Where the scene's detail is: all but the outermost hundredths of its triangles, each way, with a margin;
/// empty for an empty scene.
Box3f DetailBounds(const Scene& scene);

}  // namespace airsim360::internal
