// Kernel: light of the last frame where the same point is seen again, and what is kept for the next.
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/filter_simd.h"
#include "airsim360/render/shared/lane_gather.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

KERNEL mask_t AsMask(ireal::mask_type m) { return stdx::__proposed::static_simd_cast<mask_t>(m); }

struct Place {
  real x, y;
};

/// Where points of a panorama were in the last frame's picture.
KERNEL Place Reproject(const FilterPlanes& f, const FilterPast& past, real3 v) {
  const float* R = past.R;
  const real3 c = make3(v.x * R[0] + v.y * R[1] + v.z * R[2], v.x * R[3] + v.y * R[4] + v.z * R[5], v.x * R[6] + v.y * R[7] + v.z * R[8]);
  const real theta = atan2_approx(c.x, c.z);
  const real phi = atan2_approx(real(0.0f) - c.y, rroot(c.x * c.x + c.z * c.z));
  const float per_radian = 0.5f * SHADE_INV_PI * static_cast<float>(f.width);
  return {theta * per_radian + 0.5f * static_cast<float>(f.width), 0.5f * static_cast<float>(f.height) - phi * per_radian};
}

/// What the points are compared with.
struct Recall {
  real3 p, g, n;
  ureal id;
  real thickness;
  real3 light = make3(real(0.0f), real(0.0f), real(0.0f));
  real samples = real(0.0f), share = real(0.0f);
};

/// One of the four pixels around: adds what it has seen of the same points.
KERNEL void AddTap(const FilterPlanes& f, const FilterPast& past, ireal x, ireal y, mask_t wanted, real w, Recall& sum) {
  if (f.sphere) {
    const ireal::mask_type below = y < 0, above = y >= f.height;
    stdx::where(below, y) = -1 - y;
    stdx::where(above, y) = 2 * f.height - 1 - y;
    stdx::where(below || above, x) = x + f.width / 2;
    stdx::where(x < 0, x) = x + f.width;
    stdx::where(x >= f.width, x) = x - f.width;
  }
  const mask_t inside = wanted && AsMask(x >= 0 && x < f.width && y >= 0 && y < f.height);
  ireal index = y * past.stride + x;
  stdx::where(!stdx::__proposed::static_simd_cast<ireal::mask_type>(inside), index) = 0;
  alignas(64) int32_t at[kLanes];
  index.copy_to(at, stdx::vector_aligned);
  KeepInMemory(at);
  const auto quad = [&](int k) __attribute__((always_inline)) {
    return GatherQuads([&](int lane)
                           __attribute__((always_inline)) { return past.pixels + int64_t{FilterPast::kFloats} * at[lane] + 4 * k; });
  };
  const real4 place = quad(0);
  const float* o = past.offset;
  const real3 away = make3(place.x - o[0], place.y - o[1], place.z - o[2]) - sum.p;
  mask_t same = inside && SameId(stdx::__proposed::simd_bit_cast<ureal>(place.w), sum.id) && rabs(dot3(sum.g, away)) <= sum.thickness;
  if (stdx::none_of(same)) return;
  const real4 normal = quad(1), light = quad(2);
  same = same && dot3(Rgb(normal), sum.n) >= kHistoryCosine;
  sum.share = sum.share + If(same, w);
  sum.light = sum.light + make3(If(same, light.x * w), If(same, light.y * w), If(same, light.z * w));
  sum.samples = sum.samples + If(same, normal.w * w);
}

/// Mixes what was recalled into light and samples.
KERNEL void Mix(const FilterPlanes& f, int64_t i, const Recall& sum) {
  const real inverse = 1.0f / sum.share;
  const real3 past = sum.light * inverse;
  const real seen = sum.samples / sum.share;
  const mask_t mixed = sum.share >= kHistoryShare && seen > 0.0f;
  if (stdx::none_of(mixed)) return;
  const real fresh = At(f.samples, i);
  const real kept = sel(fresh > 0.0f, rmin(seen, (kHistoryFrames - 1) * fresh), seen);
  const real weight = fresh / (fresh + kept);
  const real3 light = At3(f.light[0], i);
  const real3 mean = sel3(mixed, past + (light - past) * weight, light);
  Put(f.light[0][0], i, mean.x);
  Put(f.light[0][1], i, mean.y);
  Put(f.light[0][2], i, mean.z);
  Put(f.samples, i, sel(mixed, fresh + kept, fresh));
  uids data = Ids(f.data_id[0], i);
  stdx::where(stdx::__proposed::static_simd_cast<uids::mask_type>(mixed), data) = sum.id;
  data.copy_to(f.data_id[0] + i, stdx::element_aligned);
}

KERNEL void RecallVector(const FilterPlanes& f, const FilterPast& past, int64_t i, int x) {
  if (NoSurface(f, i)) return;
  FetchAhead(f, {i - x, 0}, x, {f.g[0], f.g[1], f.g[2], f.light[0][0], f.light[0][1], f.light[0][2]});
  Recall sum;
  sum.id = Ids(f.id, i), sum.p = At3(f.p, i), sum.g = At3(f.g, i), sum.n = At3(f.n, i);
  sum.thickness = kHistoryThickness * f.cone_angle * rroot(dot3(sum.p, sum.p));
  const float* o = past.offset;
  const Place at =
      past.x == nullptr ? Reproject(f, past, make3(sum.p.x + o[0], sum.p.y + o[1], sum.p.z + o[2])) : Place{At(past.x, x), At(past.y, x)};
  const mask_t wanted = !SameId(sum.id, uids(kNoSurface)) && !SameId(sum.id, uids(0u)) && at.x > -1.0f &&
                        at.x < static_cast<float>(f.width + 1) && at.y > -1.0f && at.y < static_cast<float>(f.height + 1);
  if (stdx::none_of(wanted)) return;
  const real left = rfloor(at.x - 0.5f), top = rfloor(at.y - 0.5f);
  const real fx = at.x - 0.5f - left, fy = at.y - 0.5f - top;
  const ireal x0 = to_int(If(wanted, left)), y0 = to_int(If(wanted, top));
  for (int k = 0; k < 4; ++k) {
    const real w = (k & 1 ? fx : 1.0f - fx) * (k >> 1 ? fy : 1.0f - fy);
    AddTap(f, past, x0 + (k & 1), y0 + (k >> 1), wanted, w, sum);
  }
  Mix(f, i, sum);
}

/// Four numbers of every lane as four rows: lane l has those at rows[l % 4] + l - l % 4.
KERNEL void PutQuads(float (&rows)[4][kLanes], real a, real b, real c, real d) {
  const real4 q = TurnQuads(static_cast<LaneVector>(a), static_cast<LaneVector>(b), static_cast<LaneVector>(c), static_cast<LaneVector>(d));
  store(rows[0], q.x), store(rows[1], q.y), store(rows[2], q.z), store(rows[3], q.w);
}

KERNEL void KeepVector(const FilterPlanes& f, int64_t i, float* to) {
  constexpr int kQuads = FilterPast::kFloats / 4;
  const uids id = Ids(f.data_id[0], i);
  if (stdx::all_of(id == 0u)) {
    for (int k = 0; k < kQuads * kLanes; ++k) _mm_stream_ps(to + 4 * k, _mm_setzero_ps());
    return;
  }
  FetchAhead(f, {i, 0}, 0, {f.light[0][0], f.light[0][1], f.light[0][2], f.samples});
  const real3 p = At3(f.p, i), n = At3(f.n, i), light = At3(f.light[0], i);
  alignas(64) float rows[kQuads][4][kLanes];
  PutQuads(rows[0], p.x, p.y, p.z, stdx::__proposed::simd_bit_cast<real>(id));
  PutQuads(rows[1], n.x, n.y, n.z, At(f.samples, i));
  PutQuads(rows[2], light.x, light.y, light.z, real(0.0f));
  KeepInMemory(rows);
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int k = 0; k < kQuads; ++k) _mm_stream_ps(to + FilterPast::kFloats * lane + 4 * k, _mm_load_ps(rows[k][lane & 3] + (lane & ~3)));
  }
}

}  // namespace

void RecallRow(const FilterPlanes& f, int y, const FilterPast& past) {
  const int64_t row = int64_t{y} * f.stride;
  for (int x = 0; x < f.width; x += kLanes) RecallVector(f, past, row + x, x);
}

void KeepRow(const FilterPlanes& f, int y, float* pixels) {
  const int64_t row = int64_t{y} * f.stride;
  float* to = pixels + FilterPast::kFloats * row;
  for (int x = 0; x < f.width; x += kLanes) KeepVector(f, row + x, to + FilterPast::kFloats * x);
  // Stores past the cache are seen by other threads only after this.
  _mm_sfence();
}

}  // namespace airsim360::internal::AIRSIM360_ISA
