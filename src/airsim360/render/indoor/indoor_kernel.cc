// Kernel: light of surfaces in rooms. Neighbouring pixels lie in the same cells, so a vector of them looks every
// surfel up together.
#include "airsim360/render/indoor/indoor_kernels.h"
#include "airsim360/render/shared/lane_gather.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

constexpr float kFacing = 0.35f;      // as in surfels.cc
constexpr float kPlane = 0.6f;        // of a cell
constexpr float kSlack = 0.004f;      // m
constexpr float kHardly = 1e-6f;      // weight of a surfel in front or behind
constexpr float kFits = 0.005f;       // weight from which a surfel stands for a place: the bevel of a lamp's frame is no ceiling
constexpr float kLastResort = 1e-9f;  // of one that something stands before
constexpr float kCovered = 0.45f;     // share of the fine cells around from which the fine level counts alone

struct Sums {
  real weight, covered, share, r, g, b, lamp_r, lamp_g, lamp_b;
};

/// Places of a vector of surfaces.
struct Places {
  real3 p, n, g;  // n: shading normal, g: geometric normal
};

/// ClearSector (surfels.h).
KERNEL real Sector(real x, real y) {
  const real sum = rabs(x) + rabs(y);
  const real a = y / rmax(sum, real(1e-20f));
  const real turn = sel(x >= 0.0f, sel(y >= 0.0f, a, 4.0f + a), 2.0f - a);
  return rmin(rmax(turn * 4.0f, real(0.0f)), real(15.0f));
}

KERNEL void AddSurfel(const IndoorLevel& level, const IndoorSurfel& s, const Places& at, mask_t lanes, real place, mask_t& met,
                      Sums& sums) {
  const ufloat3 n{s.normal[0], s.normal[1], s.normal[2]}, t{s.tangent[0], s.tangent[1], s.tangent[2]};
  const ufloat3 b{n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x};
  const real c = dot3(at.g, n);
  const mask_t facing = lanes && (c > kFacing);
  if (!stdx::any_of(facing)) return;
  const real3 d = at.p - make3(real(s.point[0]), real(s.point[1]), real(s.point[2]));
  const real x = dot3(d, t), y = dot3(d, b), e = dot3(d, n) * (level.cells_per_metre / kPlane);
  alignas(64) float clear[16];
  for (int k = 0; k < 16; ++k) clear[k] = static_cast<float>(s.clear[k]) * level.clear_step + kSlack;
  const real far = GatherFloats(clear, to_int(Sector(x, y)));
  const mask_t seen = facing && (x * x + y * y <= far * far);
  const real zero = real(0.0f);
  const real facing2 = (c - kFacing) * (c - kFacing);
  const real fit = rmax(1.0f - e * e * 0.8f, zero) * (facing2 * facing2 * facing2) + kHardly;
  const real weight = sel(facing, place * sel(seen, fit, real(kLastResort)), zero);
  const real bend =
      rmin(rmax(at.n.x * s.bend[1] + at.n.y * s.bend[2] + at.n.z * s.bend[3] + s.bend[0], real(kLeastBend)), real(kMostBend)) * weight;
  met = met || (seen && (fit > kFits));
  sums.weight += weight;
  sums.share += weight * s.share;
  sums.r += bend * s.light[0], sums.g += bend * s.light[1], sums.b += bend * s.light[2];
  sums.lamp_r += weight * s.lamps[0], sums.lamp_g += weight * s.lamps[1], sums.lamp_b += weight * s.lamps[2];
}

KERNEL const IndoorCell* FindCell(const IndoorLevel& level, int32_t x, int32_t y, int32_t z) {
  const uint64_t key = IndoorKey(x, y, z);
  for (uint64_t at = IndoorHash(key) & level.mask;; at = (at + 1) & level.mask) {
    const IndoorCell& cell = level.cells[at];
    if (cell.key == key) return &cell;
    if (cell.key == kNoCell) return nullptr;
  }
}

/// Of the eight cells around every surface, weighted by their place.
static __attribute__((noinline)) void SumLevel(const IndoorLevel& level, const Places& at, mask_t wanted, Sums& sums) {
  const real zero = real(0.0f);
  sums = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
  constexpr float kFarthest = 0.9f * kFarCell;
  const auto lattice = [&](real x, float origin) __attribute__((always_inline)) {
    return rmin(rmax((x - origin) * level.cells_per_metre - 0.5f, real(-kFarthest)), real(kFarthest));
  };
  const real x = lattice(at.p.x, level.origin[0]), y = lattice(at.p.y, level.origin[1]), z = lattice(at.p.z, level.origin[2]);
  const real x0 = rfloor(x), y0 = rfloor(y), z0 = rfloor(z), fx = x - x0, fy = y - y0, fz = z - z0;
  alignas(64) int32_t cx[kLanes], cy[kLanes], cz[kLanes];
  to_int(x0).copy_to(cx, stdx::vector_aligned), to_int(y0).copy_to(cy, stdx::vector_aligned);
  to_int(z0).copy_to(cz, stdx::vector_aligned);
  mask_t left = wanted;
  while (stdx::any_of(left)) {
    // All lanes in the cell of the first one that is left.
    const int lane = stdx::find_first_set(left) & (kLanes - 1);
    const int32_t bx = cx[lane], by = cy[lane], bz = cz[lane];
    const mask_t same = left && (x0 == static_cast<float>(bx)) && (y0 == static_cast<float>(by)) && (z0 == static_cast<float>(bz));
    left = left && !same;
    for (int k = 0; k < 8; ++k) {
      const IndoorCell* cell = FindCell(level, bx + (k & 1), by + (k >> 1 & 1), bz + (k >> 2));
      if (cell == nullptr) continue;
      const real place = (k & 1 ? fx : 1.0f - fx) * (k & 2 ? fy : 1.0f - fy) * (k & 4 ? fz : 1.0f - fz);
      mask_t met = mask_t(false);
      for (uint32_t i = cell->first; i < cell->first + cell->count; ++i) AddSurfel(level, level.surfels[i], at, same, place, met, sums);
      sums.covered += sel(met, place, zero);
    }
  }
}

}  // namespace

void LookUpIndoors(const IndoorView& view, const SurfaceSet& s, int count, IndoorLight& out) {
  for (int i = 0; i < count; i += kLanes) {
    const Places at{load3(s.px + i, s.py + i, s.pz + i), load3(s.nx + i, s.ny + i, s.nz + i), load3(s.gx + i, s.gy + i, s.gz + i)};
    Sums coarse, fine;
    const real zero = real(0.0f);
    SumLevel(view.fine, at, mask_t(true), fine);
    const real trust = sel(fine.covered > 0.0f, rmin(fine.covered * (1 / kCovered), real(1.0f)), zero);
    coarse = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
    if (stdx::any_of(trust < 1.0f)) SumLevel(view.coarse, at, trust < 1.0f, coarse);
    const real of_coarse = sel(coarse.weight > 0.0f, 1.0f / rmax(coarse.weight, real(1e-30f)), zero);
    // Where no coarse surfel is, the fine ones count alone.
    const real share = sel(coarse.weight > 0.0f, trust, sel(fine.weight > 0.0f, real(1.0f), zero));
    const real of_fine = sel(fine.weight > 0.0f, share / rmax(fine.weight, real(1e-30f)), zero);
    const real rest = of_coarse * (1.0f - share);
    const auto mix = [&](real f, real c) __attribute__((always_inline)) { return f * of_fine + c * rest; };
    store3(out.r + i, out.g + i, out.b + i, make3(mix(fine.r, coarse.r), mix(fine.g, coarse.g), mix(fine.b, coarse.b)));
    store3(out.lamp_r + i, out.lamp_g + i, out.lamp_b + i,
           make3(mix(fine.lamp_r, coarse.lamp_r), mix(fine.lamp_g, coarse.lamp_g), mix(fine.lamp_b, coarse.lamp_b)));
    store(out.share + i, mix(fine.share, coarse.share));
  }
}

void MixLampsIndoors(const IndoorLight& indoor, int count, SurfaceSet& s) {
  for (int i = 0; i < count; i += kLanes) {
    const real share = load(indoor.share + i);
    const real3 grid = load3(s.lamp_r + i, s.lamp_g + i, s.lamp_b + i);
    const real3 own = load3(indoor.lamp_r + i, indoor.lamp_g + i, indoor.lamp_b + i);
    store3(s.lamp_r + i, s.lamp_g + i, s.lamp_b + i, lerp3(grid, own, share));
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
