#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "airsim360/math/angles.h"
#include "airsim360/render/high/high_rays.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/shared_rays_kernel.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr int kAtOnce = 4;  // rays of a pixel that are traced before their light is looked up

// The ambient rays of one tile.
class AmbientTile {
 public:
  AmbientTile(const Shader::Impl& shader, const SunMapView& sun_map, const TileSampling& sampling, const RaySet& rays, const SurfaceSet& s,
              HighTile& tile)
      : shader_(shader),
        sun_map_(sun_map),
        sampling_(sampling),
        rays_(rays),
        s_(s),
        tile_(tile),
        slots_(shader.tracer->slots()),
        first_slots_(shader.tracer->first_slots()) {
    for (Way& way : way_) {
      for (int i = 0; i < 16; ++i) {
        way.packet.mask[i] = kMaskSolid;  // clear panes let light pass
        way.hits.shines[i] = 1;
      }
    }
  }

  // All rays of up to sixteen surfaces of one phase; in later rounds as many again, which go on where all tiles' first end.
  void GatherPhase(int phase, int round, const int* surfaces, int count) {
    any_leaf_ = false;
    for (int i = 0; i < 16; ++i) {
      index_[i] = surfaces[i < count ? i : 0];
      valid_[i] = i < count ? -1 : 0;
      leaf_[i] = s_.kind[index_[i]] == kFoliage && s_.transmission[index_[i]] > 0;
      any_leaf_ |= leaf_[i];
    }
    shader_.kernels.gather_origins(rays_, s_, index_, origins_);
    // A whole number of rays, right on average over the phases.
    const uint32_t place = sampling_.tile * 16 + static_cast<uint32_t>(phase);
    const uint32_t of_round = first_ray(256, sampling_.ambient_rays, sampling_.seed) * static_cast<uint32_t>(round);
    const uint32_t first = of_round + first_ray(place, sampling_.ambient_rays, sampling_.seed);
    const int samples = static_cast<int>(of_round + first_ray(place + 1, sampling_.ambient_rays, sampling_.seed) - first);
    const int first_side = std::popcount(place);
    std::fill(std::begin(sum_r_), std::end(sum_r_), 0.0f);
    std::fill(std::begin(sum_g_), std::end(sum_g_), 0.0f);
    std::fill(std::begin(sum_b_), std::end(sum_b_), 0.0f);
    for (int begin = 0; begin < samples; begin += kAtOnce) {
      const int end = std::min(samples, begin + kAtOnce);
      for (int k = begin; k < end; ++k) {
        // Leaves look to both sides in turn; whose turn it is first must not go with the ray's number.
        const bool behind = ((k + first_side) & 1) != 0;
        Trace(SharedPoint(first + static_cast<uint32_t>(k)), behind, way_[k - begin]);
      }
      for (int k = begin; k < end; ++k) {
        // Each side stands for the rays that were not sent to the other, too.
        const int alike = (samples + 1 - (k & 1)) / 2;
        AddLight(way_[k - begin], samples == 1 ? 2.0f : static_cast<float>(samples) / static_cast<float>(alike));
      }
    }
    for (int i = 0; i < count; ++i) {
      const uint32_t slot = rays_.slot[index_[i]];
      const int before = tile_.light_samples[slot];
      const float share = static_cast<float>(samples) / static_cast<float>(before + samples), scale = kPiF / static_cast<float>(samples);
      tile_.light_samples[slot] = static_cast<uint8_t>(std::min(before + samples, 255));
      tile_.light_r[slot] += share * (sum_r_[i] * scale - tile_.light_r[slot]);
      tile_.light_g[slot] += share * (sum_g_[i] * scale - tile_.light_g[slot]);
      tile_.light_b[slot] += share * (sum_b_[i] * scale - tile_.light_b[slot]);
    }
  }

 private:
  // A point of the sphere; the phases ask for one after the other.
  Vec3f SharedPoint(uint32_t index) {
    static const auto share = AIRSIM360_SELECT_KERNEL(SharedSphere);
    if (index - first_point_ >= 16u) share(first_point_ = index, sampling_.seed, x_, y_, z_);
    const uint32_t i = index - first_point_;
    return {x_[i], y_[i], z_[i]};
  }

  // Sixteen rays and what they met.
  struct Way {
    RayHit16 packet{};
    AmbientHits hits{};
    alignas(64) int sent[16];
    bool behind;
  };

  // Light comes later: what it needs of the surfaces met is on its way to the cache meanwhile.
  void Trace(Vec3f sphere, bool behind, Way& way) {
    RayHit16& packet = way.packet;
    way.behind = behind;
    for (int i = 0; i < 16; ++i) side_[i] = behind && leaf_[i] ? -1.0f : 1.0f;
    shader_.kernels.ambient_rays(origins_, side_, &sphere.x, packet);
    for (int i = 0; i < 16; ++i) packet.t_far[i] = INFINITY;
    for (int i = 0; i < 16; ++i) way.sent[i] = valid_[i];
    for (int i = 0; i < 16 && any_leaf_; ++i) {
      if (leaf_[i] && OnOtherSide(i, sphere)) way.sent[i] = 0;
    }
    shader_.tracer->Intersect16(way.sent, packet, false);
    for (int i = 0; i < 16; ++i) {
      way.hits.instance[i] = kMiss;
      if (way.sent[i] == 0 || packet.geometry[i] == kMiss) continue;
      const SurfaceRef ref = Resolve(packet, i);
      way.hits.instance[i] = ref.instance, way.hits.triangle[i] = ref.triangle;
      const InstanceRecord& instance = shader_.view.instances[ref.instance];
      __builtin_prefetch(&shader_.view.triangles[instance.first_triangle + ref.triangle]);
      if (shader_.view.lamps.lamps != nullptr) AddLamps(i, ref, way);
    }
  }

  // Whether the two normals disagree about the side of a ray: leaves scatter nothing there, as in `reference`.
  bool OnOtherSide(int i, Vec3f sphere) const {
    const Vec3f n{origins_.nx[i], origins_.ny[i], origins_.nz[i]}, g{origins_.gx[i], origins_.gy[i], origins_.gz[i]};
    return Dot(n * side_[i] + sphere, g) * side_[i] < 0;
  }

  // RayTracer::Resolve without a call.
  SurfaceRef Resolve(const RayHit16& packet, int i) const {
    const uint32_t geometry = packet.geometry[i], instance = packet.instance[i], primitive = packet.primitive[i];
    const HitSlot& slot = slots_[instance == kMiss ? first_slots_[geometry] : first_slots_[instance] + geometry];
    return {slot.instance, slot.triangles == nullptr ? primitive : slot.triangles[primitive]};
  }

  // Light of lamps on what was met.
  void AddLamps(int i, const SurfaceRef& ref, Way& way) {
    const RayHit16& packet = way.packet;
    const uint32_t lamp = shader_.lights.LampOf(ref.instance, ref.triangle);
    const bool held =
        lamp != LightTable::kNoLamp && (shader_.lamps->Holds(lamp) || shader_.moving_lamps.Holds(shader_.lights.lamps()[lamp]));
    way.hits.shines[i] = held ? 0.0f : 1.0f;
    const Vec3f d{packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]};
    const Vec3f p = Vec3f{packet.origin_x[i], packet.origin_y[i], packet.origin_z[i]} + d * packet.t_far[i];
    // By the side that the ray came from: the grid's means are too coarse for normals to matter more.
    const Vec3f light = shader_.lamps->NearIrradiance(p, -d);
    way.hits.lamp_r[i] = light.x, way.hits.lamp_g[i] = light.y, way.hits.lamp_b[i] = light.z;
  }

  // What rays meet in rooms has the light that is known there.
  void SeeRooms(const Way& way) {
    const RayHit16& packet = way.packet;
    for (int i = 0; i < 16; ++i) {
      if (way.hits.instance[i] == kMiss || shader_.moving[way.hits.instance[i]]) continue;
      const InstanceRecord& instance = shader_.view.instances[way.hits.instance[i]];
      Vec3f normal = GeometricNormal(instance, shader_.view.triangles[instance.first_triangle + way.hits.triangle[i]]);
      const Vec3f d{packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]};
      if (Dot(normal, d) > 0) normal = -normal;
      const Vec3f p = Vec3f{packet.origin_x[i], packet.origin_y[i], packet.origin_z[i]} + d * packet.t_far[i];
      if (const auto light = shader_.indoor->RadianceAt(p, normal)) r_[i] = light->x, g_[i] = light->y, b_[i] = light->z;
    }
  }

  void AddLight(const Way& way, float leaf_share) {
    shader_.kernels.shade_ambient(shader_.view, sun_map_, way.packet, way.hits, r_, g_, b_);
    for (int i = 0; i < 16 && any_leaf_; ++i) {
      if (!leaf_[i]) continue;
      Vec3f weight = Vec3f{1, 1, 1} * (way.sent[i] != 0 ? leaf_share : 0.0f);
      if (way.behind) weight = weight * scalar::leaf_color() * s_.transmission[index_[i]];
      r_[i] *= weight.x, g_[i] *= weight.y, b_[i] *= weight.z;
    }
    if (shader_.indoor) SeeRooms(way);
    for (int i = 0; i < 16; ++i) sum_r_[i] += r_[i];
    for (int i = 0; i < 16; ++i) sum_g_[i] += g_[i];
    for (int i = 0; i < 16; ++i) sum_b_[i] += b_[i];
  }

  const Shader::Impl& shader_;
  const SunMapView& sun_map_;
  const TileSampling& sampling_;
  const RaySet& rays_;
  const SurfaceSet& s_;
  HighTile& tile_;
  Way way_[kAtOnce];
  alignas(64) int valid_[16];
  alignas(64) float side_[16], r_[16], g_[16], b_[16], sum_r_[16], sum_g_[16], sum_b_[16];
  alignas(64) float x_[16], y_[16], z_[16];  // of the points from first_point_ on
  uint32_t first_point_ = ~0u - 16;          // none
  AmbientOrigins origins_;
  int index_[16];
  bool leaf_[16], any_leaf_;
  std::span<const HitSlot> slots_;
  std::span<const uint32_t> first_slots_;
};

// How many rounds of rays a tile takes. All pixels of a phase look into the same directions, and phases lie between each other:
// how far their means differ tells how well the tile knows its light. In a shady yard below a sunlit wall few rays meet the
// wall, which is most of the light, and the filter cannot even out whole tiles. Noise counts as far as sunlight does not hide it;
// leaves, which are speckled anyway, do not count.
int RoundsFor(const TileSampling& sampling, float open_sky, const int16_t* of_slot, const SurfaceSet& s, const LightTerms& terms,
              const HighTile& tile) {
  float sum = 0, squares = 0, around = 0, sun = 0;
  int phases = 0;
  for (const auto& members : sampling.layout->members) {
    float light = 0;
    int count = 0;
    for (const uint8_t slot : members) {
      const int i = of_slot[slot];
      if (i < 0 || (s.kind[i] == kFoliage && s.transmission[i] > 0)) continue;
      light += scalar::luminance({tile.light_r[slot], tile.light_g[slot], tile.light_b[slot]});
      around += terms.ambient_g[i] * tile.light_g[slot];
      sun += terms.sun_g[i] * s.sunlit[i];
      ++count;
    }
    if (count < 4) continue;
    light /= static_cast<float>(count);
    sum += light, squares += light * light;
    ++phases;
  }
  return static_cast<int>(rounds_of(sum, squares, static_cast<float>(phases), around, sun, sampling.ambient_rays, open_sky));
}

// By night probes, which know all windows around, count as some rays more.
void CountProbes(const Shader::Impl& shader, const RaySet& rays, const SurfaceSet& s, int i, HighTile& tile) {
  const float known = scalar::probe_rays(shader.view.open_sky);
  const uint32_t slot = rays.slot[i];
  const float samples = tile.light_samples[slot];
  if (samples == 0 || (s.kind[i] == kFoliage && s.transmission[i] > 0)) return;
  const Vec3f p{s.px[i], s.py[i], s.pz[i]}, n{s.nx[i], s.ny[i], s.nz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
  const Vec3f light = shader.probes->Irradiance(p + g * (0.45f / shader.view.probes.cells_per_metre), n);
  const float share = known / (known + samples);
  tile.light_r[slot] += share * (light.x - tile.light_r[slot]);
  tile.light_g[slot] += share * (light.y - tile.light_g[slot]);
  tile.light_b[slot] += share * (light.z - tile.light_b[slot]);
}

}  // namespace

void GatherAmbient(const Shader::Impl& shader, const SunMapView& sun_map, const TileSampling& sampling, const RaySet& rays,
                   const SurfaceSet& s, const LightTerms& terms, const IndoorLight* room, HighTile& tile) {
  constexpr float kKnown = 0.999f;  // share of surfels from which no ray is sent
  int16_t of_slot[256];
  std::fill(std::begin(of_slot), std::end(of_slot), int16_t{-1});
  for (int i = 0; i < rays.count; ++i) {
    const uint32_t slot = rays.slot[i];
    tile.light_r[slot] = tile.light_g[slot] = tile.light_b[slot] = 0;
    tile.light_samples[slot] = 0;
    if (room != nullptr && room->share[i] > kKnown) {
      tile.light_r[slot] = room->r[i], tile.light_g[slot] = room->g[i], tile.light_b[slot] = room->b[i];
      tile.light_samples[slot] = kCertain;
    } else if (terms.ambient_r[i] + terms.ambient_g[i] + terms.ambient_b[i] > kVisibleTerm) {
      of_slot[slot] = static_cast<int16_t>(i);
    }
  }
  AmbientTile ambient(shader, sun_map, sampling, rays, s, tile);
  for (int round = 0, rounds = 1; round < rounds; ++round) {
    for (int phase = 0; phase < 16; ++phase) {
      int surfaces[16], count = 0;
      for (const uint8_t slot : sampling.layout->members[phase]) {
        if (of_slot[slot] >= 0) surfaces[count++] = of_slot[slot];
      }
      if (count > 0) ambient.GatherPhase(phase, round, surfaces, count);
    }
    if (round == 0) rounds = RoundsFor(sampling, shader.view.open_sky, of_slot, s, terms, tile);
  }
  if (shader.probes && shader.sky && scalar::probe_rays(shader.view.open_sky) > 0) {
    for (int i = 0; i < rays.count; ++i)
      if (of_slot[rays.slot[i]] >= 0) CountProbes(shader, rays, s, i, tile);
  }
  for (int i = 0; room != nullptr && i < rays.count; ++i) {
    const float share = room->share[i];
    if (share <= 0 || share > kKnown || of_slot[rays.slot[i]] < 0) continue;
    const uint32_t slot = rays.slot[i];
    tile.light_r[slot] += share * (room->r[i] - tile.light_r[slot]);
    tile.light_g[slot] += share * (room->g[i] - tile.light_g[slot]);
    tile.light_b[slot] += share * (room->b[i] - tile.light_b[slot]);
  }
}

}  // namespace airsim360::internal
