// What floors and furniture of middling gloss mirror in rooms.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "airsim360/render/high/high_rays.h"
#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"

namespace airsim360::internal {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kLeastRough = 0.25f, kMostRough = 0.6f;  // below, one ray of the skin is followed; above, skins see all sides alike
constexpr float kLeastSkin = 0.06f;                      // share of the skin in the light given back
constexpr int kRays = 4;

bool Middling(const SurfaceSet& s, int i) {
  return s.kind[i] < 0.5f && s.coat[i] <= 0.05f && s.mirror[i] == 0 && s.traced[i] == 0 && s.roughness[i] >= kLeastRough &&
         s.roughness[i] < kMostRough;
}

// The mirrored rays of a tile: what each brings is added to its surface.
class GlossTile {
 public:
  GlossTile(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, const SurfaceSet& s)
      : shader_(shader), sampling_(sampling), rays_(rays), s_(s) {}

  // Share of the light given back that the skin mirrors, by colour; sends the rays if it is worth it.
  bool Add(int i, Vec3f& skin) {
    using namespace scalar;
    const Vec3f n{s_.nx[i], s_.ny[i], s_.nz[i]}, v{-rays_.dx[i], -rays_.dy[i], -rays_.dz[i]}, g{s_.gx[i], s_.gy[i], s_.gz[i]};
    const Bsdf bsdf = bsdf_make(0.0f, {s_.ar[i], s_.ag[i], s_.ab[i]}, s_.metallic[i], s_.roughness[i], 0.0f, 0.0f, 0.0f);
    const BsdfSide side = bsdf_side(bsdf, std::max(Dot(n, v), 0.02f));
    const Vec3f mirrored = bsdf_reflected(side), body = bsdf.body * bsdf_entering(side);
    const auto share = [](float a, float b) { return a / std::max(a + b, 1e-6f); };
    skin = {share(mirrored.x, body.x), share(mirrored.y, body.y), share(mirrored.z, body.z)};
    if (skin.y < kLeastSkin) return false;
    const BsdfLobes facets{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    const Vec3f p{s_.px[i], s_.py[i], s_.pz[i]};
    const Vec3f from = p + g * RayOffset(p, rays_.distance[i]);
    const uint32_t place = 16 * sampling_.tile + sampling_.layout->phase[rays_.slot[i]];
    for (uint32_t k = 0; k < kRays; ++k) {
      const Vec2f u = SobolPoint(place * kRays + k, sampling_.seed ^ 0x7feb352du);
      float event = 0;
      Vec3f r = bsdf_sample(bsdf, facets, n, v, 0.5f, u.x, u.y, event);
      const float below = Dot(r, g);
      if (below < 0.01f) r = Normalized(r + g * (0.02f - 2.0f * below));
      queue_.Add(from, r, i);
      if (queue_.count == 16) Flush();
    }
    return true;
  }

  void Flush() {
    if (queue_.count == 0) return;
    queue_.Close();
    const RayHit16 sent = queue_.rays;
    shader_.tracer->Intersect16(queue_.valid, queue_.rays, false);
    std::array<Vec3f, 16> tint;
    tint.fill({1, 1, 1});
    if (shader_.tracer->has_clear_panes()) {
      RayHit16 panes = sent;
      for (int k = 0; k < 16; ++k) panes.t_far[k] = queue_.rays.geometry[k] == kMiss ? INFINITY : queue_.rays.t_far[k];
      DimByPanes(*shader_.tracer, shader_.tables, queue_.valid, panes, tint);
    }
    for (int k = 0; k < queue_.count; ++k) Land(k, tint[static_cast<size_t>(k)]);
    Shade(sky_, true), Shade(others_, false);
    queue_ = RayQueue(kMaskSolid);
  }
  Vec3f Sum(int i) const { return sum_[i]; }

 private:
  void Land(int k, Vec3f tint) {
    const RayHit16& r = queue_.rays;
    const int from = queue_.lane[k];
    const Vec3f o{r.origin_x[k], r.origin_y[k], r.origin_z[k]}, d{r.direction_x[k], r.direction_y[k], r.direction_z[k]};
    const bool miss = r.geometry[k] == kMiss;
    SurfaceRef ref{};
    if (!miss) {
      ref = shader_.tracer->Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
      if (const auto light = RadianceAt(ref, o + d * r.t_far[k], d)) {
        sum_[from] += *light * tint;
        return;
      }
    }
    RaySet& set = miss ? sky_ : others_;
    const int i = set.count++;
    set.ox[i] = o.x, set.oy[i] = o.y, set.oz[i] = o.z, set.dx[i] = d.x, set.dy[i] = d.y, set.dz[i] = d.z;
    set.slot[i] = static_cast<uint32_t>(from), set.key[i] = 0;
    tint_[miss][i] = tint;
    if (miss) return;
    set.distance[i] = r.t_far[k], set.width[i] = rays_.width[from] + s_.roughness[from] * s_.roughness[from] * r.t_far[k];
    set.u[i] = r.u[k], set.v[i] = r.v[k], set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
  }

  // Of what the surfels know.
  std::optional<Vec3f> RadianceAt(const SurfaceRef& ref, Vec3f p, Vec3f d) const {
    if (shader_.moving[ref.instance]) return std::nullopt;
    const InstanceRecord& instance = shader_.view.instances[ref.instance];
    const Vec3f n = UnpackDirection(shader_.view.triangles[instance.first_triangle + ref.triangle].geometric_normal);
    const float* m = instance.normal_matrix;
    const Vec3f normal = Normalized(Vec3f{m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
                                          m[6] * n.x + m[7] * n.y + m[8] * n.z});
    return shader_.indoor->RadianceAt(p, Dot(normal, d) > 0 ? -normal : normal);
  }

  void Shade(RaySet& set, bool sky) {
    if (set.count == 0) return;
    LightSet light;
    if (sky) {
      Pad(set);
      shader_.kernels.sky(shader_.view, set, false, light);
    } else {
      shader_.ShadeSurfaces(set, 1, light);
    }
    for (int i = 0; i < set.count; ++i) sum_[set.slot[i]] += Vec3f{light.r[i], light.g[i], light.b[i]} * tint_[sky][i];
    set.count = 0;
  }

  const Shader::Impl& shader_;
  const TileSampling& sampling_;
  const RaySet& rays_;
  const SurfaceSet& s_;
  RayQueue queue_{kMaskSolid};
  RaySet sky_{}, others_{};
  Vec3f tint_[2][16];
  Vec3f sum_[kBatch];
};

}  // namespace

void GatherGloss(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, const SurfaceSet& s, HighTile& tile) {
  bool any = false;
  for (int i = 0; i < rays.count; ++i) any |= tile.light_samples[rays.slot[i]] == kCertain && Middling(s, i);
  if (!any) return;
  const auto gloss = std::make_unique<GlossTile>(shader, sampling, rays, s);
  Vec3f skin[kBatch];
  bool sent[kBatch] = {};
  for (int i = 0; i < rays.count; ++i)
    sent[i] = tile.light_samples[rays.slot[i]] == kCertain && Middling(s, i) && gloss->Add(i, skin[i]);
  gloss->Flush();
  for (int i = 0; i < rays.count; ++i) {
    if (!sent[i]) continue;
    // The skin gives back what it mirrors, not the light of all sides.
    const uint32_t slot = rays.slot[i];
    const Vec3f seen = gloss->Sum(i) * (kPi / kRays);
    tile.light_r[slot] += skin[i].x * (seen.x - tile.light_r[slot]);
    tile.light_g[slot] += skin[i].y * (seen.y - tile.light_g[slot]);
    tile.light_b[slot] += skin[i].z * (seen.z - tile.light_b[slot]);
    tile.light_samples[slot] = kRays;
  }
}

}  // namespace airsim360::internal
