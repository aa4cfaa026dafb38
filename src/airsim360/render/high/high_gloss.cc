#include "airsim360/render/high/high_gloss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shared/precipitation_scalar.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kBroad = 0.25f;                            // roughness from which lamps are left to the highlights of the lamp grid
constexpr float kMostRough = 0.6f;                         // above, skins see all sides alike
constexpr float kLeastSkin = 0.045f, kWholeSkin = 0.075f;  // reflectance from which rays count, and count alone
constexpr float kLobe = 0.7f;                              // standard deviation of mirrored directions, radians per alpha
constexpr float kWidest = 0.05f;                           // radians of a blur on the picture
constexpr float kOnePixel = 0.5f;                          // pixels: a narrower lobe is one ray
constexpr float kNear = 1.5f;                              // m
constexpr float kLeastBlur = 0.01f;                        // pixels
constexpr float kManyPixels = 4;                           // a wider one is averaged over so many that few rays each will do
constexpr uint32_t kRays = 4, kFewRays = 2;                // of a pixel

scalar::Bsdf BsdfOf(const SurfaceSet& s, int i) {
  return scalar::bsdf_make(0.0f, {s.ar[i], s.ag[i], s.ab[i]}, s.metallic[i], s.roughness[i], 0.0f, 0.0f, 0.0f);
}
Vec3f Normal(const SurfaceSet& s, int i) { return {s.nx[i], s.ny[i], s.nz[i]}; }
Vec3f Along(const RaySet& rays, int i) { return {rays.dx[i], rays.dy[i], rays.dz[i]}; }
float Alpha(const SurfaceSet& s, int i) { return s.roughness[i] * s.roughness[i]; }

// The mirrored rays of a tile: what each brings is added to its surface.
class GlossTile {
 public:
  GlossTile(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, const SurfaceSet& s)
      : shader_(shader), sampling_(sampling), rays_(rays), s_(s) {}

  void Add(int i) {
    using namespace scalar;
    const Vec3f n = Normal(s_, i), v = -Along(rays_, i), g{s_.gx[i], s_.gy[i], s_.gz[i]}, p{s_.px[i], s_.py[i], s_.pz[i]};
    const Bsdf bsdf = BsdfOf(s_, i);
    const BsdfLobes facets{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    const Vec3f from = p + g * RayOffset(p, rays_.distance[i]);
    const uint32_t place = 16 * sampling_.tile + sampling_.layout->phase[rays_.slot[i]];
    const float pixels = kLobe * Alpha(s_, i) / sampling_.cone_angle;
    count_[i] = pixels < kOnePixel ? 1 : pixels > kManyPixels ? kFewRays : kRays;
    for (uint32_t k = 0; k < count_[i]; ++k) {
      const Vec2f u = SobolPoint(place * count_[i] + k, sampling_.seed ^ 0x7feb352du);
      float event = 0;
      Vec3f r = bsdf_sample(bsdf, facets, n, v, 0.5f, u.x, u.y, event);
      const float below = Dot(r, g);
      if (below < 0.01f) r = Normalized(r + g * (0.02f - 2.0f * below));
      queue_.Add(from, r, i);
      if (queue_.count == 16) Trace();
    }
  }
  void Finish() {
    Trace();
    Shade(sky_, true), Shade(others_, false);
  }
  Vec3f Mean(int i) const { return sum_[i] / static_cast<float>(count_[i]); }
  /// How wide the lobe is on the picture, as a share of its own width: things close to the surface are mirrored sharply.
  float Spread(int i) const { return spread_[i] / static_cast<float>(count_[i]); }

 private:
  void Trace() {
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
    queue_ = RayQueue(kMaskSolid);
    if (sky_.count > kBatch - 16) Shade(sky_, true);
    if (others_.count > kBatch - 16) Shade(others_, false);
  }

  void Land(int k, Vec3f tint) {
    const RayHit16& r = queue_.rays;
    const int from = queue_.lane[k];
    const Vec3f o{r.origin_x[k], r.origin_y[k], r.origin_z[k]}, d{r.direction_x[k], r.direction_y[k], r.direction_z[k]};
    const bool miss = r.geometry[k] == kMiss, broad = s_.roughness[from] >= kBroad;
    spread_[from] += miss ? 1.0f : r.t_far[k] / (r.t_far[k] + rays_.distance[from]);
    SurfaceRef ref{};
    if (!miss) {
      ref = shader_.tracer->Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
      // Surfels, cells apart, are too coarse for what is near.
      if (broad && (r.t_far[k] > kNear || Held(ref))) {
        if (const auto light = KnownRadiance(ref, o + d * r.t_far[k], d)) {
          sum_[from] += *light * tint;
          return;
        }
      }
    }
    RaySet& set = miss ? sky_ : others_;
    const int i = set.count++;
    set.ox[i] = o.x, set.oy[i] = o.y, set.oz[i] = o.z, set.dx[i] = d.x, set.dy[i] = d.y, set.dz[i] = d.z;
    set.slot[i] = static_cast<uint32_t>(from), set.key[i] = 0;
    tint_[miss][i] = tint;
    if (miss) return;
    set.distance[i] = r.t_far[k], set.width[i] = rays_.width[from] + Alpha(s_, from) * r.t_far[k];
    set.u[i] = r.u[k], set.v[i] = r.v[k], set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
  }

  bool Held(const SurfaceRef& ref) const {
    const uint32_t lamp = shader_.lights.LampOf(ref.instance, ref.triangle);
    return lamp != LightTable::kNoLamp && shader_.lamps->Holds(lamp);
  }
  // Of what the surfels know; lamps of the grid shine highlights instead.
  std::optional<Vec3f> KnownRadiance(const SurfaceRef& ref, Vec3f p, Vec3f d) const {
    if (shader_.moving[ref.instance]) return std::nullopt;
    const bool held = Held(ref);
    if (!held && shader_.lights.LampOf(ref.instance, ref.triangle) != LightTable::kNoLamp) return std::nullopt;
    const InstanceRecord& instance = shader_.view.instances[ref.instance];
    const Vec3f normal = GeometricNormal(instance, shader_.view.triangles[instance.first_triangle + ref.triangle]);
    const auto light = shader_.indoor->RadianceAt(p, Dot(normal, d) > 0 ? -normal : normal);
    return light || !held ? light : Vec3f{};
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
  Vec3f tint_[2][kBatch];
  Vec3f sum_[kBatch];
  float spread_[kBatch] = {};
  uint32_t count_[kBatch] = {};
};

// Standard deviations of the lobe on the picture, pixels across and along columns: seen at a slant a lobe is long in the plane
// of view and normal.
void PutBlur(const TileSampling& sampling, Vec3f n, Vec3f d, float radians, uint32_t slot, GlossPixels& pixels) {
  const float along = std::min(radians, kWidest) / sampling.cone_angle;
  const float facing = std::clamp(-Dot(n, d), 0.2f, 1.0f);
  float up2 = 0.5f;  // square of the part of the long axis that goes up the picture
  const Vec3f slant = n - d * Dot(n, d), up = sampling.pole - d * Dot(sampling.pole, d);
  const float lengths = Dot(slant, slant) * Dot(up, up);
  if (sampling.panorama && lengths > 1e-8f) up2 = Dot(slant, up) * Dot(slant, up) / lengths;
  const float narrow2 = sampling.panorama ? facing * facing : 1;
  pixels.blur_y[slot] = kLeastBlur + along * std::sqrt(up2 + (1 - up2) * narrow2);
  pixels.blur_x[slot] = kLeastBlur + along * std::sqrt(1 - up2 + up2 * narrow2);
}

}  // namespace

void FindGloss(const Shader::Impl& shader, const RaySet& rays, const IndoorLight& room, const float* sharp, SurfaceSet& s,
               GlossSet& gloss) {
  for (int i = 0; i < rays.count; ++i) {
    if (room.share[i] <= 0.5f || sharp[i] != 0 || s.kind[i] > 0.5f || s.coat[i] > 0.05f || s.roughness[i] >= kMostRough) continue;
    const Vec3f d = Along(rays, i);
    const scalar::BsdfSide side = scalar::bsdf_side(BsdfOf(s, i), std::max(-Dot(Normal(s, i), d), 0.02f));
    gloss.skin[i] = scalar::bsdf_reflected(side);
    gloss.share[i] = std::clamp((Luminance(gloss.skin[i]) - kLeastSkin) / (kWholeSkin - kLeastSkin), 0.0f, 1.0f);
    if (gloss.share[i] <= 0) continue;
    gloss.any = gloss.is[i] = true;
    if (shader.view.has_sky > 0.5f) {
      const Vec3f eye{rays.ox[i], rays.oy[i], rays.oz[i]};
      const float free = shader.view.air.weather > 0 ? scalar::roofed_way(shader.view.roofs, eye, d, rays.distance[i]) : 0.0f;
      gloss.skin[i] = gloss.skin[i] * scalar::air_to_surface(shader.view.air, eye.z, d, rays.distance[i], free).kept;
    }
    // As if a ray had brought nothing: GatherGloss adds what the skin mirrors.
    s.mirror[i] = 0, s.traced[i] = 1;
    s.reflected_r[i] = s.reflected_g[i] = s.reflected_b[i] = 0;
    if (s.roughness[i] >= kBroad) continue;
    const float left = 1 - gloss.share[i];
    s.lamp_shine_r[i] *= left, s.lamp_shine_g[i] *= left, s.lamp_shine_b[i] *= left;
  }
}

void GatherGloss(const Shader::Impl& shader, const TileSampling* sampling, const RaySet& rays, const SurfaceSet& s, const IndoorLight& room,
                 const GlossSet& gloss, GlossPixels& pixels) {
  constexpr float kInvPi = 0.318309886f;
  std::unique_ptr<GlossTile> mirrored;
  if (sampling != nullptr) {
    mirrored = std::make_unique<GlossTile>(shader, *sampling, rays, s);
    for (int i = 0; i < rays.count; ++i)
      if (gloss.is[i]) mirrored->Add(i);
    mirrored->Finish();
  }
  for (int i = 0; i < rays.count; ++i) {
    if (!gloss.is[i]) continue;
    const uint32_t slot = rays.slot[i];
    Vec3f light = Vec3f{room.r[i], room.g[i], room.b[i]} * kInvPi;
    if (mirrored) light += (mirrored->Mean(i) - light) * gloss.share[i];
    pixels.any = true;
    pixels.light[slot] = light, pixels.skin[slot] = gloss.skin[i];
    pixels.blur_x[slot] = pixels.blur_y[slot] = kLeastBlur;
    if (mirrored) PutBlur(*sampling, Normal(s, i), Along(rays, i), kLobe * Alpha(s, i) * mirrored->Spread(i), slot, pixels);
  }
}

}  // namespace airsim360::internal
