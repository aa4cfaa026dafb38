// Kernel: what surfaces do with the paths of tier `reference`.
#include "airsim360/render/reference/path_kernels.h"
#include "airsim360/render/shared/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

struct Lit {
  Bsdf bsdf;
  BsdfSide seen;
  BsdfLobes lobes;
  real3 n, g, v;
};

KERNEL Lit Load(const RaySet& rays, const SurfaceSet& s, int i) {
  Lit a;
  a.n = load3(s.nx + i, s.ny + i, s.nz + i);
  a.g = load3(s.gx + i, s.gy + i, s.gz + i);
  a.v = -load3(rays.dx + i, rays.dy + i, rays.dz + i);
  a.bsdf = bsdf_make(load(s.kind + i), load3(s.ar + i, s.ag + i, s.ab + i), load(s.metallic + i), load(s.roughness + i),
                     load(s.transmission + i), load(s.coat + i), load(s.coat_roughness + i));
  a.seen = bsdf_side(a.bsdf, rmin(rmax(dot3(a.n, a.v), real(kViewCosine)), real(1.0f)));
  a.lobes = bsdf_lobes(a.bsdf, a.seen);
  return a;
}

/// Black where the two normals disagree about the side of l.
KERNEL real3 OnOneSide(const Lit& a, real3 l, real3 f) {
  const real zero = real(0.0f);
  return sel3(dot3(a.n, l) * dot3(a.g, l) > 0.0f, f, make3(zero, zero, zero));
}

}  // namespace

void EvaluateScatter(const RaySet& rays, const SurfaceSet& surfaces, ScatterSet& scatter) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const Lit a = Load(rays, surfaces, i);
    const real3 l = load3(scatter.x + i, scatter.y + i, scatter.z + i);
    real pdf = real(0.0f);
    const real3 f = bsdf_evaluate(a.bsdf, a.seen, a.lobes, a.n, a.v, l, pdf);
    store3(scatter.r + i, scatter.g + i, scatter.b + i, OnOneSide(a, l, f));
    store(scatter.pdf + i, pdf);
  }
}

void SampleScatter(const RaySet& rays, const SurfaceSet& surfaces, const ScatterNumbers& numbers, ScatterSet& scatter) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const Lit a = Load(rays, surfaces, i);
    real event = real(0.0f), pdf = real(0.0f);
    const real3 l = bsdf_sample(a.bsdf, a.lobes, a.n, a.v, load(numbers.choice + i), load(numbers.u + i), load(numbers.w + i), event);
    const real3 f = bsdf_evaluate(a.bsdf, a.seen, a.lobes, a.n, a.v, l, pdf);
    real3 weight = OnOneSide(a, l, f) * (1.0f / rmax(pdf, real(kDividedPdf)));
    const mask_t straight = event > kStraightEvent;
    weight = sel3(straight, bsdf_straight(a.bsdf, a.seen) * (1.0f / rmax(a.lobes.straight, real(kDividedShare))), weight);
    const real kept = weight.x + weight.y + weight.z;
    event = sel((kept > 0.0f) && (straight || (pdf > kLeastPdf)), event, real(0.0f));
    store3(scatter.x + i, scatter.y + i, scatter.z + i, l);
    store3(scatter.r + i, scatter.g + i, scatter.b + i, weight);
    store(scatter.pdf + i, pdf);
    store(scatter.event + i, event);
  }
}

void PassStraight(const RaySet& rays, const SurfaceSet& surfaces, ScatterSet& scatter) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const Lit a = Load(rays, surfaces, i);
    store3(scatter.r + i, scatter.g + i, scatter.b + i, bsdf_straight(a.bsdf, a.seen));
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
