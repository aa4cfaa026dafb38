#include <algorithm>
#include <bit>
#include <cmath>

#include "airsim360/render/high/high_rays.h"
#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shared_rays_kernel.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr int kSide = 16;
// Rays of a pixel where a shadow ends: always as many. Stopping where the first ones agree would make penumbrae narrower.
constexpr int kSunSamples = 8;

// Calls `each` for the places of the bits that are set until it returns true; whether it did.
template <class Each>
bool AnyBit(uint32_t bits, Each each) {
  for (; bits != 0; bits &= bits - 1) {
    if (each(std::countr_zero(bits))) return true;
  }
  return false;
}

// The surfaces of a tile that ask for the sun, by pixel: rows as bits.
struct SunGrid {
  uint8_t at[256];               // index of the surface of a pixel that asks
  uint32_t seen[2][kSide] = {};  // pixels that do not see the sun, and that do
};

// Whether two surfaces are about the same plane.
bool SamePlane(const RaySet& rays, const SurfaceSet& s, int i, int k) {
  const float facing = s.gx[i] * s.gx[k] + s.gy[i] * s.gy[k] + s.gz[i] * s.gz[k];
  const float apart = s.gx[i] * (s.px[k] - s.px[i]) + s.gy[i] * (s.py[k] - s.py[i]) + s.gz[i] * (s.pz[k] - s.pz[i]);
  return facing > kSamePlane && std::fabs(apart) < kEdgeApart + kEdgeApartByRange * rays.distance[i];
}

SunFrame FrameOf(Vec3f to_sun) {
  const SunDisc disc(to_sun);
  const Vec3f right = disc.right(), up = disc.up();
  return {{to_sun.x, to_sun.y, to_sun.z}, {right.x, right.y, right.z}, {up.x, up.y, up.z}};
}

// Rays of a tile's surfaces to the sun's disc.
class SunTile {
 public:
  SunTile(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& s)
      : shader_(shader),
        sampling_(sampling),
        rays_(rays),
        s_(s),
        sun_(FrameOf(shader.sky->to_sun())),
        seed_(sampling.seed + 0x9e3779b9u * sampling.tile) {
    static const auto ask = AIRSIM360_SELECT_KERNEL(AskSun);
    for (int first = 0; first < rays.count; first += 16) any_ |= asked_[first / 16] = ask(s, first) & Existing(first, rays.count);
  }
  bool any() const { return any_ != 0; }

  // One ray each; true if some see the sun and some do not.
  bool TraceOne() {
    static const auto lift = AIRSIM360_SELECT_KERNEL(LiftRays);
    SharedPoints(16, false);
    RayQueue sixteen(kMaskSolid), queue(kMaskSolid);
    for (int first = 0; first < rays_.count; first += 16) {
      const uint32_t asked = asked_[first / 16];
      if (asked == 0) continue;
      alignas(64) float x[16], y[16], z[16];
      for (int k = 0; k < 16; ++k) {
        const int phase = sampling_.layout->phase[rays_.slot[std::min(first + k, rays_.count - 1)]];
        x[k] = points_.x[phase], y[k] = points_.y[phase], z[k] = points_.z[phase];
      }
      RayHit16& r = sixteen.rays;
      lift(rays_, s_, first, x, y, z, r);
      if (asked == 0xffffu) {
        // Sixteen surfaces that all ask make a packet at once.
        sixteen.Fill(first);
        Ask(sixteen);
        continue;
      }
      ForLanes(asked, [&](int k) {
        queue.Add({r.origin_x[k], r.origin_y[k], r.origin_z[k]}, {x[k], y[k], z[k]}, first + k);
        if (queue.count == 16) Ask(queue);
      });
    }
    if (queue.count > 0) Ask(queue);
    return lit_ && dark_;
  }

  // More where neighbours disagree, from all over the pixel.
  void TraceEdges(uint8_t* penumbra) {
    MakeGrid();
    int edge[kBatch], count = 0;
    for (int y = 0; y < kSide; ++y) {
      for (const int sees : {0, 1}) {
        uint32_t others[5], any = 0;
        for (int k = 0; k < 5; ++k) {
          const int v = y + k - 2;
          any |= others[k] = v >= 0 && v < kSide ? grid_.seen[1 - sees][v] : 0;
        }
        if (any == 0) continue;
        ForLanes(grid_.seen[sees][y], [&](int x) {
          if (AtShadowEdge(x, y, others)) edge[count++] = grid_.at[y * kSide + x];
        });
      }
    }
    if (count == 0) return;
    SharedPoints(SunPoints::kMost, true);
    for (int n = 0; n < count; n += 2) TracePair(edge[n], edge[std::min(n + 1, count - 1)], penumbra);
  }

  // What clear panes on the way take.
  void DimByGlass() {
    if (!shader_.tracer->has_clear_panes()) return;
    ForAsked([&](int i) {
      if (clear_[i] > 0) s_.sunlit[i] *= clear_[i];
    });
  }

 private:
  template <class Each>
  void ForAsked(Each each) const {
    for (int first = 0; first < rays_.count; first += 16) ForLanes(asked_[first / 16], [&](int k) { each(first + k); });
  }

  // The first points of the disc.
  void SharedPoints(int count, bool of_pixel) {
    static const auto share = AIRSIM360_SELECT_KERNEL(SharedSun);
    share(sun_, seed_, count, of_pixel, points_);
  }

  void Ask(RayQueue& queue) {
    float share[16];
    SeenShare(*shader_.tracer, shader_.tables, queue, share);
    for (int k = 0; k < queue.count; ++k) {
      const int i = queue.lane[k];
      const bool seen = share[k] > 0;
      (seen ? lit_ : dark_) = true;
      s_.sunlit[i] = seen ? 1.0f : 0.0f;
      clear_[i] = share[k];
    }
    queue.count = 0;
  }

  void MakeGrid() {
    ForAsked([&](int i) {
      const int pixel = sampling_.layout->pixel_of[rays_.slot[i]];
      grid_.at[pixel] = static_cast<uint8_t>(i);
      grid_.seen[s_.sunlit[i] != 0 ? 1 : 0][pixel / kSide] |= 1u << (pixel % kSide);
    });
  }

  // Whether a pixel within two pixels' heights of this one, on the same plane, is one of `others`, of the five rows
  // about this one; columns are as wide.
  bool AtShadowEdge(int x, int y, const uint32_t* others) const {
    const int i = grid_.at[y * kSide + x];
    float aspect = 1;
    if (sampling_.panorama) aspect = std::max(Norm(Cross(sampling_.pole, Vec3f{rays_.dx[i], rays_.dy[i], rays_.dz[i]})), kLeastAspect);
    const int columns = static_cast<int>(std::min(kSide - 1.0f, 2 / aspect + 0.5f));
    const int left = std::max(0, x - columns), right = std::min(kSide - 1, x + columns);
    const uint32_t window = (2u << right) - (1u << left);
    for (int k = 0; k < 5; ++k) {
      const uint8_t* row = grid_.at + (y + k - 2) * kSide;
      if (AnyBit(others[k] & window, [&](int u) { return SamePlane(rays_, s_, i, row[u]); })) return true;
    }
    return false;
  }

  // Eight rays of each of two surfaces; the same one twice counts once.
  void TracePair(int a, int b, uint8_t* penumbra) {
    static const auto lift = AIRSIM360_SELECT_KERNEL(LiftSunRays);
    const auto first = [&](int i) { return kSunSamples * sampling_.layout->phase[rays_.slot[i]]; };
    const PixelShape shape{sampling_.cone_angle, sampling_.panorama, {sampling_.pole.x, sampling_.pole.y, sampling_.pole.z}};
    lift(rays_, s_, sun_, points_, shape, {{a, b}, {first(a), first(b)}}, pair_.rays);
    pair_.Fill(0);
    if (a == b) pair_.count = kSunSamples;
    pair_.Close();
    shader_.tracer->Intersect16(pair_.valid, pair_.rays, false);
    SumUp(0, a, penumbra);
    if (a != b) SumUp(kSunSamples, b, penumbra);
  }

  // What the eight rays of a surface met, which are in these lanes.
  void SumUp(int lane, int i, uint8_t* penumbra) {
    int blocked = 0;
    float away = 0;
    for (int k = lane; k < lane + kSunSamples; ++k) {
      const bool met = pair_.rays.geometry[k] != kMiss;
      away += met ? pair_.rays.t_far[k] : 0.0f;
      blocked += met ? 1 : 0;
    }
    s_.sunlit[i] = static_cast<float>(kSunSamples - blocked) / kSunSamples;
    penumbra[rays_.slot[i]] = PenumbraCode(i, blocked, away);
  }

  // As HighTile::penumbra: how far the blockers are tells how wide it is.
  uint8_t PenumbraCode(int i, int blocked, float away) const {
    if (blocked == 0) return 1;
    const float width = kSunAngle * away / static_cast<float>(blocked);
    const float pixels = width / std::max(kLeastPixel, rays_.distance[i] * sampling_.cone_angle);
    return static_cast<uint8_t>(std::min(255.0f, 2 + pixels * kPenumbraSteps));
  }

  const Shader::Impl& shader_;
  const TileSampling& sampling_;
  const RaySet& rays_;
  SurfaceSet& s_;
  const SunFrame sun_;
  const uint32_t seed_;
  SunPoints points_;
  SunGrid grid_;
  RayQueue pair_{kMaskSolid};
  uint32_t any_ = 0, asked_[kBatch / 16];  // sixteen surfaces each
  bool lit_ = false, dark_ = false;
  float clear_[kBatch];
};

}  // namespace

void TraceSunDisc(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& s, uint8_t* penumbra) {
  SunTile sun(shader, sampling, rays, s);
  if (!sun.any()) return;
  if (sun.TraceOne()) sun.TraceEdges(penumbra);
  sun.DimByGlass();
}

}  // namespace airsim360::internal
