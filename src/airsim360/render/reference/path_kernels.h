// The kernels of tier `reference`: scattering at surfaces, one copy per instruction set.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal {

/// Directions and what the surfaces in the same order do with them.
struct alignas(64) ScatterSet {
  float x[kBatch], y[kBatch], z[kBatch];  ///< unit, away from the surface
  float r[kBatch], g[kBatch], b[kBatch];  ///< see the kernels
  float pdf[kBatch];                      ///< per solid angle with which SampleScatter finds the direction
  float event[kBatch];                    ///< of SampleScatter: 0 absorbed, 1 scattered, 2 straight through a pane
};

/// Numbers in [0, 1), one set a surface.
struct alignas(64) ScatterNumbers {
  float choice[kBatch], u[kBatch], w[kBatch];
};

}  // namespace airsim360::internal

/// In: x, y, z. Out: r, g, b = BSDF times cosine of light from there towards the viewer; pdf. Black where the
/// direction lies on different sides of the shading and the geometric normal.
AIRSIM360_DECLARE_KERNEL(void EvaluateScatter(const RaySet& rays, const SurfaceSet& surfaces, ScatterSet& scatter))
/// Chooses the next direction of every path; r, g, b = BSDF times cosine over density.
AIRSIM360_DECLARE_KERNEL(void SampleScatter(const RaySet& rays, const SurfaceSet& surfaces, const ScatterNumbers& numbers,
                                            ScatterSet& scatter))
/// r, g, b = share of light that passes the surface straight; black where it is no clear pane.
AIRSIM360_DECLARE_KERNEL(void PassStraight(const RaySet& rays, const SurfaceSet& surfaces, ScatterSet& scatter))
