#include "airsim360/render/shading/high_rays.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"

namespace airsim360::internal {
namespace {

constexpr int kSide = 16;
constexpr float kSunAngle = 0.0093f;          // width of the disc, radians (0.53 degrees)
constexpr int kSunRounds = 2, kSunRound = 8;  // rays of a pixel in a penumbra: rounds of so many
constexpr int kSunSamples = kSunRounds * kSunRound;
constexpr int kMaxSmoothing = 3;  // pixels

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

// Whether a pixel within two of this one, on the same plane, sees the sun otherwise.
bool AtShadowEdge(const RaySet& rays, const SurfaceSet& s, const SurfaceGrid& grid, const uint8_t* asked,
                  int pixel) {
  const int x = pixel % kSide, y = pixel / kSide, i = grid.at[pixel];
  for (int v = std::max(0, y - 2); v <= std::min(kSide - 1, y + 2); ++v) {
    for (int u = std::max(0, x - 2); u <= std::min(kSide - 1, x + 2); ++u) {
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
  void Make(int first, int last) {
    for (int k = first; k < last; ++k) {
      for (int phase = 0; phase < 16; ++phase) {
        const auto index = static_cast<uint32_t>(16 * k + phase);
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

// Moves the start of a ray over the part of the surface's plane that the pixel shows.
Vec3f WithinPixel(const RaySet& rays, const SurfaceSet& s, int i, Vec2f offset, float cone_angle) {
  const Vec3f d{rays.dx[i], rays.dy[i], rays.dz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
  const Vec3f across = Normalized(std::fabs(d.z) < 0.9f ? Vec3f{-d.y, d.x, 0} : Vec3f{0, -d.z, d.y});
  const Vec3f up = Cross(across, d);
  const Vec3f beside = d + across * (offset.x * cone_angle) + up * (offset.y * cone_angle);
  const float slant = Dot(g, d), there = Dot(g, beside);
  const float stretch = there < 0.3f * slant ? std::clamp(slant / there, 0.5f, 2.0f) : 1.0f;
  return (beside * stretch - d) * rays.distance[i];
}

}  // namespace

void TraceSunDisc(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& s,
                  uint8_t* penumbra) {
  const RayTracer& tracer = *shader.tracer;
  const Vec3f to_sun = shader.sky->to_sun();
  uint8_t asked[kBatch];
  bool any = false;
  for (int i = 0; i < rays.count; ++i) any |= (asked[i] = s.sunlit[i] != 0);
  if (!any) return;
  SunDirections directions(to_sun, sampling.seed + 0x9e3779b9u * sampling.tile);
  directions.Make(0, 1);
  const uint8_t* phase = sampling.layout->phase;

  // One ray each.
  RayQueue queue(kMaskSolid);
  float clear[kBatch];  // what panes on the way leave
  const auto flush = [&] {
    float share[16];
    SeenShare(tracer, shader.tables, queue, share);
    for (int i = 0; i < queue.count; ++i) {
      s.sunlit[queue.lane[i]] = share[i] > 0 ? 1.0f : 0.0f;
      clear[queue.lane[i]] = share[i];
    }
    queue.count = 0;
  };
  bool lit = false, dark = false;
  for (int i = 0; i < rays.count; ++i) {
    if (!asked[i]) continue;
    queue.Add(SunStart(rays, s, i, to_sun), directions.at[0][phase[rays.slot[i]]], i);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
  for (int i = 0; i < rays.count; ++i) {
    if (asked[i]) (s.sunlit[i] != 0 ? lit : dark) = true;
  }

  // More where neighbours disagree, from all over the pixel, in rounds while they differ; how far the
  // blockers are tells how wide the penumbra is.
  const SurfaceGrid grid(*sampling.layout, rays);
  int edge[kBatch], count = 0;
  for (int pixel = 0; pixel < (lit && dark ? 256 : 0); ++pixel) {
    const int i = grid.at[pixel];
    if (i >= 0 && asked[i] && AtShadowEdge(rays, s, grid, asked, pixel)) edge[count++] = i;
  }
  float away[kBatch] = {};
  int blocked[kBatch] = {};
  const auto look = [&] {
    queue.Close();
    tracer.Intersect16(queue.valid, queue.rays, false);
    for (int k = 0; k < queue.count; ++k) {
      if (queue.rays.geometry[k] == kMiss) continue;
      ++blocked[queue.lane[k]];
      away[queue.lane[k]] += queue.rays.t_far[k];
    }
    queue.count = 0;
  };
  for (int round = 1, sent = 0; round <= kSunRounds && count > 0; ++round) {
    directions.Make(sent, kSunRound * round);
    for (int n = 0; n < count; ++n) {
      const int i = edge[n], at = phase[rays.slot[i]];
      const Vec3f start = SunStart(rays, s, i, to_sun);
      for (int k = sent; k < kSunRound * round; ++k) {
        queue.Add(start + WithinPixel(rays, s, i, directions.offset[k][at], sampling.cone_angle),
                  directions.at[k][at], i);
        if (queue.count == 16) look();
      }
    }
    if (queue.count > 0) look();
    sent = kSunRound * round;
    int mixed = 0;
    for (int n = 0; n < count; ++n) {
      const int i = edge[n];
      s.sunlit[i] = static_cast<float>(sent - blocked[i]) / static_cast<float>(sent);
      if (blocked[i] == 0 || blocked[i] == sent) continue;
      edge[mixed++] = i;
      const float width = kSunAngle * away[i] / static_cast<float>(blocked[i]);
      const float pixels = width / std::max(1e-6f, rays.distance[i] * sampling.cone_angle);
      penumbra[rays.slot[i]] =
          static_cast<uint8_t>(std::min(static_cast<float>(kMaxSmoothing), pixels * 0.2f));
    }
    count = mixed;
  }
  if (!tracer.has_clear_panes()) return;
  for (int i = 0; i < rays.count; ++i) {
    if (asked[i] && clear[i] > 0) s.sunlit[i] *= clear[i];
  }
}

namespace {

constexpr float kFoliage = 1;  // SurfaceKind

// The ambient rays of one tile.
class AmbientTile {
 public:
  AmbientTile(const Shader::Impl& shader, const SunMapView& sun_map, const TileSampling& sampling,
              const RaySet& rays, const SurfaceSet& s, HighTile& tile)
      : shader_(shader), sun_map_(sun_map), sampling_(sampling), rays_(rays), s_(s), tile_(tile) {
    for (int i = 0; i < 16; ++i) {
      packet_.mask[i] = kMaskSolid;  // clear panes let light pass
      hits_.shines[i] = 1;
      hits_.lamp_r[i] = hits_.lamp_g[i] = hits_.lamp_b[i] = 0;
    }
  }

  // All rays of up to sixteen surfaces of one phase.
  void GatherPhase(int phase, const int* surfaces, int count) {
    for (int i = 0; i < 16; ++i) {
      index_[i] = surfaces[i < count ? i : 0];
      valid_[i] = i < count ? -1 : 0;
      leaf_[i] = s_.kind[index_[i]] == kFoliage && s_.transmission[index_[i]] > 0;
    }
    // A whole number of rays, right on average over the sixteen phases.
    const float turn = static_cast<float>(ReverseBits(static_cast<uint32_t>(phase)) >> 28) / 16 +
                       static_cast<float>((sampling_.seed + sampling_.tile * 0x9e3779b9u) >> 8) * 0x1p-24f;
    const int samples = std::max(1, static_cast<int>(sampling_.ambient_rays + turn - std::floor(turn)));
    const auto most = static_cast<uint32_t>(std::ceil(sampling_.ambient_rays));
    const uint32_t first = (sampling_.tile * 16 + static_cast<uint32_t>(phase)) * most;
    for (int k = 0; k < samples; ++k) {
      const Vec3f sphere = SpherePoint(SobolPoint(first + static_cast<uint32_t>(k), sampling_.seed));
      // Leaves look to both sides in turn.
      const bool behind = ((k + phase + static_cast<int>(sampling_.tile)) & 1) != 0;
      Trace(sphere, behind);
      // Each side stands for the rays that were not sent to the other, too.
      const int alike = (samples + 1 - (k & 1)) / 2;
      AddLight(count, behind, samples == 1 ? 2.0f : static_cast<float>(samples) / static_cast<float>(alike));
    }
    constexpr float kPi = 3.14159265f;
    const float scale = kPi / static_cast<float>(samples);
    for (int i = 0; i < count; ++i) {
      const uint32_t slot = rays_.slot[index_[i]];
      tile_.light_samples[slot] = static_cast<uint8_t>(std::min(samples, 255));
      tile_.light_r[slot] *= scale, tile_.light_g[slot] *= scale, tile_.light_b[slot] *= scale;
    }
  }

 private:
  void Trace(Vec3f sphere, bool behind) {
    for (int i = 0; i < 16; ++i) side_[i] = behind && leaf_[i] ? -1.0f : 1.0f;
    shader_.kernels.ambient_rays(rays_, s_, index_, side_, &sphere.x, packet_);
    for (int i = 0; i < 16; ++i) packet_.t_far[i] = INFINITY;
    shader_.tracer->Intersect16(valid_, packet_, false);
    for (int i = 0; i < 16; ++i) {
      hits_.instance[i] = kMiss;
      if (valid_[i] == 0 || packet_.geometry[i] == kMiss) continue;
      const SurfaceRef ref =
          shader_.tracer->Resolve(packet_.geometry[i], packet_.instance[i], packet_.primitive[i]);
      hits_.instance[i] = ref.instance, hits_.triangle[i] = ref.triangle;
      if (shader_.view.lamps.lamps != nullptr) AddLamps(i, ref);
    }
    shader_.kernels.shade_ambient(shader_.view, sun_map_, packet_, hits_, r_, g_, b_);
  }

  // Light of lamps on what was met.
  void AddLamps(int i, const SurfaceRef& ref) {
    const uint32_t lamp = shader_.lights.LampOf(ref.instance, ref.triangle);
    hits_.shines[i] = lamp != LightTable::kNoLamp && shader_.lamps->Holds(lamp) ? 0.0f : 1.0f;
    const Vec3f d{packet_.direction_x[i], packet_.direction_y[i], packet_.direction_z[i]};
    const Vec3f p =
        Vec3f{packet_.origin_x[i], packet_.origin_y[i], packet_.origin_z[i]} + d * packet_.t_far[i];
    // By the side that the ray came from: the grid's means are too coarse for normals to matter more.
    const Vec3f light = shader_.lamps->NearIrradiance(p, -d);
    hits_.lamp_r[i] = light.x, hits_.lamp_g[i] = light.y, hits_.lamp_b[i] = light.z;
  }

  void AddLight(int count, bool behind, float leaf_share) {
    constexpr float kYellow[3] = {1.10f, 1.15f, 0.55f};  // as in RespondTo (light_kernel.cc)
    for (int i = 0; i < count; ++i) {
      const int k = index_[i];
      const uint32_t slot = rays_.slot[k];
      Vec3f weight{1, 1, 1};
      if (leaf_[i]) weight = weight * leaf_share;
      if (leaf_[i] && behind)
        weight = weight * Vec3f{kYellow[0], kYellow[1], kYellow[2]} * s_.transmission[k];
      tile_.light_r[slot] += r_[i] * weight.x;
      tile_.light_g[slot] += g_[i] * weight.y;
      tile_.light_b[slot] += b_[i] * weight.z;
    }
  }

  const Shader::Impl& shader_;
  const SunMapView& sun_map_;
  const TileSampling& sampling_;
  const RaySet& rays_;
  const SurfaceSet& s_;
  HighTile& tile_;
  RayHit16 packet_{};
  alignas(64) int valid_[16];
  alignas(64) float side_[16], r_[16], g_[16], b_[16];
  AmbientHits hits_{};
  int index_[16];
  bool leaf_[16];
};

}  // namespace

void GatherAmbient(const Shader::Impl& shader, const SunMapView& sun_map, const TileSampling& sampling,
                   const RaySet& rays, const SurfaceSet& s, const LightTerms& terms, HighTile& tile) {
  constexpr float kVisible = 1e-3f;  // radiance per irradiance that matters
  int16_t of_slot[256];
  std::fill(std::begin(of_slot), std::end(of_slot), int16_t{-1});
  for (int i = 0; i < rays.count; ++i) {
    const uint32_t slot = rays.slot[i];
    tile.light_r[slot] = tile.light_g[slot] = tile.light_b[slot] = 0;
    tile.light_samples[slot] = 0;
    if (terms.ambient_r[i] + terms.ambient_g[i] + terms.ambient_b[i] > kVisible)
      of_slot[slot] = static_cast<int16_t>(i);
  }
  AmbientTile ambient(shader, sun_map, sampling, rays, s, tile);
  for (int phase = 0; phase < 16; ++phase) {
    int surfaces[16], count = 0;
    for (const uint8_t slot : sampling.layout->members[phase]) {
      if (of_slot[slot] >= 0) surfaces[count++] = of_slot[slot];
    }
    if (count > 0) ambient.GatherPhase(phase, surfaces, count);
  }
}

}  // namespace airsim360::internal
