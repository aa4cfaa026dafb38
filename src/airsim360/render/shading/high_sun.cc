#include <algorithm>
#include <cmath>

#include "airsim360/render/shading/high_rays.h"
#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"

namespace airsim360::internal {
namespace {

constexpr int kSide = 16;
constexpr float kSunAngle = 0.0093f;          // width of the disc, radians (0.53 degrees)
// Rays of a pixel where a shadow ends: always as many. Stopping where the first ones agree would make penumbrae narrower.
constexpr int kSunSamples = 8;

// Index of the surface of each pixel of a tile, -1 = none.
struct SurfaceGrid {
  int16_t at[256];

  SurfaceGrid(const TileLayout& layout, const RaySet& rays) {
    int16_t of_slot[256];
    std::fill(std::begin(of_slot), std::end(of_slot), int16_t{-1});
    for (int i = 0; i < rays.count; ++i) of_slot[rays.slot[i]] = static_cast<int16_t>(i);
    for (int k = 0; k < 256; ++k) at[k] = of_slot[layout.slot_of[k]];
  }
};

// Whether two surfaces are about the same plane.
bool SamePlane(const RaySet& rays, const SurfaceSet& s, int i, int k) {
  const float facing = s.gx[i] * s.gx[k] + s.gy[i] * s.gy[k] + s.gz[i] * s.gz[k];
  const float apart =
      s.gx[i] * (s.px[k] - s.px[i]) + s.gy[i] * (s.py[k] - s.py[i]) + s.gz[i] * (s.pz[k] - s.pz[i]);
  return facing > 0.9f && std::fabs(apart) < 0.01f + 0.002f * rays.distance[i];
}

// Whether a pixel within two pixels' heights of this one, on the same plane, sees the sun otherwise; `columns` are
// as wide.
bool AtShadowEdge(const RaySet& rays, const SurfaceSet& s, const SurfaceGrid& grid, const uint8_t* asked,
                  int pixel, int columns) {
  const int x = pixel % kSide, y = pixel / kSide, i = grid.at[pixel];
  for (int v = std::max(0, y - 2); v <= std::min(kSide - 1, y + 2); ++v) {
    for (int u = std::max(0, x - columns); u <= std::min(kSide - 1, x + columns); ++u) {
      const int k = grid.at[v * kSide + u];
      if (k >= 0 && asked[k] && s.sunlit[k] != s.sunlit[i] && SamePlane(rays, s, i, k)) return true;
    }
  }
  return false;
}

Vec3f PointOf(const SurfaceSet& s, int i) { return {s.px[i], s.py[i], s.pz[i]}; }

// Where rays towards the sun start: on the sun's side of the surface.
Vec3f SunStart(const RaySet& rays, const SurfaceSet& s, int i, Vec3f to_sun) {
  const Vec3f p = PointOf(s, i), g{s.gx[i], s.gy[i], s.gz[i]};
  return p + g * ((Dot(g, to_sun) < 0 ? -1.0f : 1.0f) * RayOffset(p, rays.distance[i]));
}

// The shared directions to the sun's disc, and points of a pixel in units of it, [sample][phase].
struct SunDirections {
  Vec3f at[kSunSamples][16];
  Vec2f offset[kSunSamples][16];

  SunDirections(Vec3f to_sun, uint32_t seed) : disc_(to_sun), seed_(seed) {}
  void MakeFirst() {
    for (uint32_t phase = 0; phase < 16; ++phase)
      at[0][phase] = disc_.At(SobolPoint(phase, seed_ ^ 0x68bc21ebu));
  }
  // The rays of a pixel are an aligned block of points, so they spread over disc and pixel.
  void MakeAll() {
    for (int k = 0; k < kSunSamples; ++k) {
      for (int phase = 0; phase < 16; ++phase) {
        const auto index = static_cast<uint32_t>(kSunSamples * phase + k);
        at[k][phase] = disc_.At(SobolPoint(index, seed_ ^ 0x68bc21ebu));
        const Vec2f u = SobolPoint(index, seed_ ^ 0x02e5be93u);
        offset[k][phase] = {u.x - 0.5f, u.y - 0.5f};
      }
    }
  }

 private:
  SunDisc disc_;
  uint32_t seed_;
};

// Axis about which columns turn: the panorama's, or any across the ray.
Vec3f ColumnAxis(const TileSampling& sampling, Vec3f d) {
  if (sampling.panorama) return sampling.pole;
  return std::fabs(d.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0};
}

// Width of a pixel by its height: less than one towards a panorama's poles.
float PixelAspect(const TileSampling& sampling, Vec3f d) {
  return sampling.panorama ? std::max(Norm(Cross(sampling.pole, d)), 1e-4f) : 1.0f;
}

// Moves the start of a ray over the part of the surface's plane that the pixel shows.
Vec3f WithinPixel(const RaySet& rays, const SurfaceSet& s, int i, Vec2f offset, const TileSampling& sampling) {
  const Vec3f d{rays.dx[i], rays.dy[i], rays.dz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
  const Vec3f across = Normalized(Cross(ColumnAxis(sampling, d), d)), up = Cross(across, d);
  const Vec3f beside = d + across * (offset.x * sampling.cone_angle * PixelAspect(sampling, d)) +
                       up * (offset.y * sampling.cone_angle);
  const float slant = Dot(g, d), there = Dot(g, beside);
  const float stretch = there < 0.3f * slant ? std::clamp(slant / there, 0.5f, 2.0f) : 1.0f;
  return (beside * stretch - d) * rays.distance[i];
}

// Rays of a tile's surfaces to the sun's disc.
class SunTile {
 public:
  SunTile(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& s)
      : shader_(shader),
        to_sun_(shader.sky->to_sun()),
        sampling_(sampling),
        rays_(rays),
        s_(s),
        directions_(to_sun_, sampling.seed + 0x9e3779b9u * sampling.tile),
        queue_(kMaskSolid) {
    for (int i = 0; i < rays.count; ++i) any_ |= (asked_[i] = s.sunlit[i] != 0);
  }
  bool any() const { return any_; }

  // One ray each; true if some see the sun and some do not.
  bool TraceOne() {
    directions_.MakeFirst();
    const auto flush = [&] {
      float share[16];
      SeenShare(*shader_.tracer, shader_.tables, queue_, share);
      for (int k = 0; k < queue_.count; ++k) {
        s_.sunlit[queue_.lane[k]] = share[k] > 0 ? 1.0f : 0.0f;
        clear_[queue_.lane[k]] = share[k];
      }
      queue_.count = 0;
    };
    for (int i = 0; i < rays_.count; ++i) {
      if (!asked_[i]) continue;
      queue_.Add(SunStart(rays_, s_, i, to_sun_), directions_.at[0][Phase(i)], i);
      if (queue_.count == 16) flush();
    }
    if (queue_.count > 0) flush();
    bool lit = false, dark = false;
    for (int i = 0; i < rays_.count; ++i) {
      if (asked_[i]) (s_.sunlit[i] != 0 ? lit : dark) = true;
    }
    return lit && dark;
  }

  // More where neighbours disagree, from all over the pixel.
  void TraceEdges(uint8_t* penumbra) {
    const SurfaceGrid grid(*sampling_.layout, rays_);
    int edge[kBatch], count = 0;
    for (int pixel = 0; pixel < 256; ++pixel) {
      const int i = grid.at[pixel];
      if (i < 0 || !asked_[i]) continue;
      const float aspect = PixelAspect(sampling_, {rays_.dx[i], rays_.dy[i], rays_.dz[i]});
      const int columns = static_cast<int>(std::min(kSide - 1.0f, 2 / aspect + 0.5f));
      if (AtShadowEdge(rays_, s_, grid, asked_, pixel, columns)) edge[count++] = i;
    }
    directions_.MakeAll();
    for (int n = 0; n < count; ++n) AddRays(edge[n]);
    if (queue_.count > 0) Count();
    for (int n = 0; n < count; ++n) {
      const int i = edge[n];
      s_.sunlit[i] = static_cast<float>(kSunSamples - blocked_[i]) / kSunSamples;
      penumbra[rays_.slot[i]] = PenumbraCode(i);
    }
  }

  // What clear panes on the way take.
  void DimByGlass() {
    if (!shader_.tracer->has_clear_panes()) return;
    for (int i = 0; i < rays_.count; ++i) {
      if (asked_[i] && clear_[i] > 0) s_.sunlit[i] *= clear_[i];
    }
  }

 private:
  int Phase(int i) const { return sampling_.layout->phase[rays_.slot[i]]; }

  void AddRays(int i) {
    const int phase = Phase(i);
    const Vec3f start = SunStart(rays_, s_, i, to_sun_);
    for (int k = 0; k < kSunSamples; ++k) {
      queue_.Add(start + WithinPixel(rays_, s_, i, directions_.offset[k][phase], sampling_),
                 directions_.at[k][phase], i);
      if (queue_.count == 16) Count();
    }
  }

  // Adds up what a queue meets.
  void Count() {
    queue_.Close();
    shader_.tracer->Intersect16(queue_.valid, queue_.rays, false);
    for (int k = 0; k < queue_.count; ++k) {
      if (queue_.rays.geometry[k] == kMiss) continue;
      away_[queue_.lane[k]] += queue_.rays.t_far[k];
      ++blocked_[queue_.lane[k]];
    }
    queue_.count = 0;
  }

  // As HighTile::penumbra: how far the blockers are tells how wide it is.
  uint8_t PenumbraCode(int i) const {
    if (blocked_[i] == 0) return 1;
    const float width = kSunAngle * away_[i] / static_cast<float>(blocked_[i]);
    const float pixels = width / std::max(1e-6f, rays_.distance[i] * sampling_.cone_angle);
    return static_cast<uint8_t>(std::min(255.0f, 2 + pixels * kPenumbraSteps));
  }

  const Shader::Impl& shader_;
  const Vec3f to_sun_;
  const TileSampling& sampling_;
  const RaySet& rays_;
  SurfaceSet& s_;
  SunDirections directions_;
  RayQueue queue_;
  bool any_ = false;
  uint8_t asked_[kBatch];
  float clear_[kBatch], away_[kBatch] = {};
  int blocked_[kBatch] = {};
};

}  // namespace

void TraceSunDisc(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& s,
                  uint8_t* penumbra) {
  SunTile sun(shader, sampling, rays, s);
  if (!sun.any()) return;
  if (sun.TraceOne()) sun.TraceEdges(penumbra);
  sun.DimByGlass();
}

}  // namespace airsim360::internal
