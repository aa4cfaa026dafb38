// Kernel: light of the lamps around each surface, all lamps of its cell at once.
#include "airsim360/render/shared/shading_kernels.h"
#include "airsim360/render/shared/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

constexpr int kSlots = 16;                 // lamps of a cell, one spare
constexpr float kFaintHighlight = 0.004f;  // of a surface's irradiance: a fainter one is not worth a ray
constexpr float kBesideStill = 3;          // how much more than moving lamps those that stand count where a ray to a moving one is weighed
static_assert(kSlots % kLanes == 0 && LampCell::kLamps < kSlots);

/// The lamps of one cell as lanes. Unused slots send nothing.
struct alignas(64) CellLanes {
  alignas(64) float x[kSlots], y[kSlots], z[kSlots], radius[kSlots];
  alignas(64) float fx[kSlots], fy[kSlots], fz[kSlots], body[kSlots];
  alignas(64) float r[kSlots], g[kSlots], b[kSlots], soft[kSlots], reach[kSlots];
  alignas(64) float bx[kSlots], by[kSlots], bz[kSlots], sharp[kSlots];
  alignas(64) int32_t seen[kSlots];
  int count;
  bool beams;  // some lamp has one
};

KERNEL void LoadCell(const LampView& view, const LampCell& cell, CellLanes& c) {
  c.count = static_cast<int>(cell.header & 255);
  c.beams = false;
  for (int k = 0; k < kSlots; ++k) {
    const bool used = k < c.count;
    const LampRecord& lamp = view.lamps[used ? cell.lamp[k] & 0xffffffu : 0];
    c.x[k] = lamp.center[0], c.y[k] = lamp.center[1], c.z[k] = lamp.center[2];
    c.radius[k] = lamp.radius;
    c.fx[k] = lamp.facing[0], c.fy[k] = lamp.facing[1], c.fz[k] = lamp.facing[2];
    c.body[k] = lamp.body;
    c.r[k] = used ? lamp.color[0] : 0, c.g[k] = used ? lamp.color[1] : 0, c.b[k] = used ? lamp.color[2] : 0;
    c.soft[k] = lamp.soft;
    c.reach[k] = lamp.reach;
    const float bx = lamp.beam[0], by = lamp.beam[1], bz = lamp.beam[2];
    c.bx[k] = bx, c.by[k] = by, c.bz[k] = bz;
    c.sharp[k] = __builtin_sqrtf(bx * bx + by * by + bz * bz);
    c.beams |= c.sharp[k] > 0;
    c.seen[k] = used ? static_cast<int32_t>(cell.lamp[k] >> 24) : 0;
  }
}

/// Where a point lies in the grid.
struct Place {
  uint32_t cell;     // 0 = no lamps
  float fx, fy, fz;  // in the cell
};
KERNEL Place Locate(const LampView& view, float x, float y, float z) {
  const float gx = (x - view.origin_x) * view.cells_per_metre, gy = (y - view.origin_y) * view.cells_per_metre,
              gz = (z - view.origin_z) * view.cells_per_metre;
  if (!(gx >= 0 && gy >= 0 && gz >= 0 && gx < static_cast<float>(view.nx) && gy < static_cast<float>(view.ny) &&
        gz < static_cast<float>(view.nz)))
    return {0, 0, 0, 0};
  const int ix = static_cast<int>(gx), iy = static_cast<int>(gy), iz = static_cast<int>(gz);
  return {view.cell_of[(static_cast<int64_t>(iz) * view.ny + iy) * view.nx + ix], gx - static_cast<float>(ix), gy - static_cast<float>(iy),
          gz - static_cast<float>(iz)};
}

/// Weights of the corners that are not in solids; 0 where all are.
KERNEL void CornerWeights(uint32_t header, const Place& at, float* weight) {
  float sum = 0;
  for (int k = 0; k < 8; ++k) {
    const float w = (k & 1 ? at.fx : 1 - at.fx) * (k & 2 ? at.fy : 1 - at.fy) * (k & 4 ? at.fz : 1 - at.fz);
    weight[k] = (header >> (8 + k) & 1) != 0 ? w + kCornerWeight : 0;
    sum += weight[k];
  }
  const float scale = sum > 0 ? 1 / sum : 0;
  for (int k = 0; k < 8; ++k) weight[k] *= scale;
}

/// What each lamp of the cell does to one surface.
struct alignas(64) Effects {
  alignas(64) float dx[kSlots], dy[kSlots], dz[kSlots], distance[kSlots];
  alignas(64) float front[3][kSlots], back[3][kSlots], shine[3][kSlots];
  alignas(64) float guess[kSlots], rank[kSlots];
  bool leaf, shiny;  // else back and shine are not filled
};

KERNEL float Brightness(float r, float g, float b) { return 0.2126f * r + 0.7152f * g + 0.0722f * b; }

KERNEL real3 Same(float x, float y, float z) { return make3(real(x), real(y), real(z)); }

/// `highlights`: lamps rank by what they bring to these alone.
KERNEL void Evaluate(const SurfaceSet& s, const RaySet& rays, int i, const CellLanes& c, const float* weight, bool highlights, Effects& e) {
  const real3 p = Same(s.px[i], s.py[i], s.pz[i]), n = Same(s.nx[i], s.ny[i], s.nz[i]);
  const real3 g = Same(s.gx[i], s.gy[i], s.gz[i]), d = Same(rays.dx[i], rays.dy[i], rays.dz[i]);
  const bool leaf = e.leaf = s.kind[i] == kFoliage;
  const bool shiny = e.shiny = s.mirror[i] == 0 && !leaf && (s.roughness[i] < kLampMatt || s.metallic[i] > kShinyMetal);
  const real metallic = real(s.metallic[i]), zero = real(0.0f);
  const real3 f0 = lamp_skin(Same(s.ar[i], s.ag[i], s.ab[i]), metallic);
  const real n_dot_v = rmax(zero - dot3(n, d), real(kViewCosine));
  for (int k = 0; k < kSlots && k < c.count; k += kLanes) {
    // Direction and what comes along it.
    const real3 to = load3(c.x + k, c.y + k, c.z + k) - p;
    const real distance = lamp_distance(to);
    const real3 w = to * (1.0f / distance);
    const real radius = load(c.radius + k);
    const real towards = zero - dot3(load3(c.fx + k, c.fy + k, c.fz + k), w);
    real light = lamp_irradiance(load(c.body + k), towards, load(c.soft + k), radius, distance, load(c.reach + k));
    if (c.beams) {
      const real along = zero - dot3(load3(c.bx + k, c.by + k, c.bz + k), w);
      light = light * beam_shape(load(c.sharp + k), along, zero - w.z);
    }
    const real3 color = load3(c.r + k, c.g + k, c.b + k) * light;

    // Front, back, highlight.
    const real n_dot_l = dot3(n, w), above = dot3(g, w);
    const real lit = leaf ? rmax(n_dot_l, zero) : sel(above > 0.0f, rmax(n_dot_l, zero), zero);
    const real3 front = color * lit;
    real brought = highlights ? zero : luminance(front);
    store3(e.front[0] + k, e.front[1] + k, e.front[2] + k, front);
    if (leaf) {
      const real3 back = color * rmax(zero - n_dot_l, zero);
      if (!highlights) brought = brought + luminance(back);
      store3(e.back[0] + k, e.back[1] + k, e.back[2] + k, back);
    }
    if (shiny) {
      const real3 h = normalize3(w - d);
      const real own = real(s.roughness[i] * s.roughness[i]);
      const real3 f = lamp_highlight(f0, own, radius, distance, n_dot_l, n_dot_v, rmax(dot3(n, h), zero), clamp01(dot3(w, h)));
      const real3 all = f * front;
      const real3 shine = make3(rmin(all.x, real(kBrightestGlint)), rmin(all.y, real(kBrightestGlint)), rmin(all.z, real(kBrightestGlint)));
      brought = brought + luminance(shine);
      store3(e.shine[0] + k, e.shine[1] + k, e.shine[2] + k, shine);
    }

    // Share of the cell's corners that see it.
    const ireal seen(c.seen + k, stdx::vector_aligned);
    real guess = zero;
    for (int corner = 0; corner < 8; ++corner) guess = guess + to_real((seen >> corner) & 1) * weight[corner];
    store3(e.dx + k, e.dy + k, e.dz + k, w);
    store(e.distance + k, distance - radius * kLampEnd);
    store(e.guess + k, guess);
    store(e.rank + k, brought * (kUnseenLamp + (1.0f - kUnseenLamp) * guess));
  }
}

/// Takes the strongest lamps out for rays. The less a lamp stands out from the first one left behind, the
/// less its ray counts: so nothing jumps where the order changes.
KERNEL void ChooseRays(const CellLanes& c, Effects& e, float least, int count, int i, LampRays& wanted) {
  int chosen[LampRays::kMost + 1];
  float rank[LampRays::kMost + 1];
  for (int k = 0; k <= count; ++k) {
    int best = -1;
    for (int j = 0; j < c.count; ++j) {
      if (e.rank[j] > least && (best < 0 || e.rank[j] > e.rank[best])) best = j;
    }
    chosen[k] = best;
    rank[k] = best < 0 ? 0 : e.rank[best];
    if (best >= 0) e.rank[best] = 0;
  }
  for (int k = 0; k < count; ++k) {
    LampRays::Ray& ray = wanted.ray[k][i];
    ray.share = 0;
    const int j = chosen[k];
    if (j < 0) continue;
    const float lead = 2 * (rank[k] - rank[count]) / rank[k];
    ray.share = lead < 1 ? lead : 1;
    ray.dx = e.dx[j], ray.dy = e.dy[j], ray.dz = e.dz[j];
    ray.distance = e.distance[j];
    ray.guess = e.guess[j];
    for (int q = 0; q < 3; ++q)
      ray.front[q] = e.front[q][j], ray.back[q] = e.leaf ? e.back[q][j] : 0, ray.shine[q] = e.shiny ? e.shine[q][j] : 0;
  }
}

/// Light of the lamps of every surface's cell. `moving`: lamps in columns, which come on top of the others.
template <bool moving>
KERNEL void LightBy(const LampView& lamps, const RaySet& rays, int count, const float* in_room, SurfaceSet& s, LampRays& wanted) {
  CellLanes cell;
  cell.count = 0;
  uint32_t loaded = 0;
  const int padded = (rays.count + 15) / 16 * 16;
  for (int i = 0; i < padded; ++i) {
    float front[3] = {}, back[3] = {}, shine[3] = {};
    for (int k = 0; k < count; ++k) wanted.ray[k][i].share = 0;
    const Place at = i < rays.count ? Locate(lamps, s.px[i], s.py[i], moving ? lamps.origin_z : s.pz[i]) : Place{0, 0, 0, 0};
    if (at.cell != 0) {
      if (at.cell != loaded) LoadCell(lamps, lamps.cells[at.cell], cell);
      loaded = at.cell;
      float weight[8];
      CornerWeights(lamps.cells[at.cell].header, at, weight);
      Effects e;
      const bool highlights = in_room != nullptr && in_room[i] > 0.5f;
      Evaluate(s, rays, i, cell, weight, highlights, e);
      // A moving lamp that is nothing beside those that stand needs no ray.
      float total = moving ? kBesideStill * Brightness(s.lamp_r[i], s.lamp_g[i], s.lamp_b[i]) : 0.0f;
      for (int k = 0; k < cell.count; ++k) {
        for (int q = 0; q < 3; ++q) front[q] += e.front[q][k] * e.guess[k];
        for (int q = 0; q < 3 && e.leaf; ++q) back[q] += e.back[q][k] * e.guess[k];
        for (int q = 0; q < 3 && e.shiny; ++q) shine[q] += e.shine[q][k] * e.guess[k];
        total += e.rank[k];
      }
      float least = kFaintLamp * total;
      if (highlights) least = kFaintHighlight * Brightness(front[0], front[1], front[2]);
      if (count > 0) ChooseRays(cell, e, least, count, i, wanted);
    }
    if (moving) {
      s.lamp_r[i] += front[0], s.lamp_g[i] += front[1], s.lamp_b[i] += front[2];
      s.lamp_back_r[i] += back[0], s.lamp_back_g[i] += back[1], s.lamp_back_b[i] += back[2];
      s.lamp_shine_r[i] += shine[0], s.lamp_shine_g[i] += shine[1], s.lamp_shine_b[i] += shine[2];
    } else {
      s.lamp_r[i] = front[0], s.lamp_g[i] = front[1], s.lamp_b[i] = front[2];
      s.lamp_back_r[i] = back[0], s.lamp_back_g[i] = back[1], s.lamp_back_b[i] = back[2];
      s.lamp_shine_r[i] = shine[0], s.lamp_shine_g[i] = shine[1], s.lamp_shine_b[i] = shine[2];
    }
  }
}

}  // namespace

bool LightByMovingLamps(const ShadeView& view, const RaySet& rays, int count, SurfaceSet& s, LampRays& wanted) {
  // Most surfaces are far from all of them.
  const LampView& lamps = view.moving_lamps;
  uint32_t near = 0;
  for (int i = 0; i < rays.count; ++i) near |= Locate(lamps, s.px[i], s.py[i], lamps.origin_z).cell;
  if (near == 0) return false;
  LightBy<true>(lamps, rays, count, nullptr, s, wanted);
  return true;
}

void LightByLamps(const ShadeView& view, const RaySet& rays, int count, const float* in_room, SurfaceSet& s, LampRays& wanted) {
  LightBy<false>(view.lamps, rays, count, in_room, s, wanted);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
