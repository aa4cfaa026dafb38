#include "airsim360/render/sky/clouds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/cloud_geometry.h"
#include "airsim360/render/sky/cloud_shapes.h"
#include "airsim360/render/sky/noise.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kFarthest = 85e3f, kFading = 45e3f;  // metres: where clouds end, and begin to fade
constexpr float kClosed = 0.97f;                     // cover from which the deck is closed
constexpr float kLowestRay = 0.0015f;                // sine; flatter rays see the same
constexpr float kDetailRange = 40e3f;                // metres up to which the fine noise shows

// The march from a point of a cloud towards the sun: steps that grow. Further on the field shades it on the mean.
constexpr int kSunSteps = 7;
constexpr float kFirstStep = 26, kStepGrowth = 1.75f, kSunReach = 1708;

// The sum of all steps.
constexpr float WayToSun() {
  float way = 0, step = kFirstStep;
  for (int k = 0; k < kSunSteps; ++k) way += step, step *= kStepGrowth;
  return way;
}
static_assert(WayToSun() > kSunReach - 1 && WayToSun() < kSunReach + 1);

// Multiple scattering as octaves of single scattering, each with half the extinction and 0.55 of the asymmetry of the one before
// (Wrenninge, Kulla & Lundqvist, "Oz: the great and volumetric", 2013); weights so that a thick sunlit side has 0.7 of a white wall.
constexpr int kOctaves = 8;
constexpr float kOctaveWeight = 0.77f, kOctaveAsymmetry = 0.55f;

// Henyey-Greenstein.
float Phase(float g, float mu) {
  const float d = 1 + g * g - 2 * g * mu;
  return (1 - g * g) / (4 * kPiF * d * std::sqrt(d));
}

Vec2f WindOf(uint32_t seed) {
  const float angle = static_cast<float>(RngStream(seed, "wind").Uniform(0, 2 * kPiF));
  return {scalar::cos_approx(angle), scalar::sin_approx(angle)};
}

// The type of the low clouds, where nobody named one.
CloudType TypeOf(const Environment& e, uint32_t seed) {
  if (e.cloud_type != CloudType::kAuto) return e.cloud_type;
  if (e.cloud_cover < 0.22) return CloudType::kHumilis;
  if (e.cloud_cover < 0.55) return CloudType::kMediocris;
  return RngStream(seed, "broken").Chance(0.4) ? CloudType::kStratocumulus : CloudType::kAuto;
}

}  // namespace

// A ray on its way through the layers, from the nearest on.
struct Clouds::Ray {
  Vec3f direction, air;
  float dither;
  float cosine;                         // to the sun
  std::array<float, kOctaves> phase{};  // of the octaves
  Vec3f light{};
  float through = 1;
};

Clouds::Clouds(const Environment& environment, const CloudLight& light)
    : light_(light),
      cirrus_(static_cast<float>(environment.cirrus_cover), WindOf(static_cast<uint32_t>(environment.sky_seed) + 1),
              static_cast<uint32_t>(environment.sky_seed)),
      cover_(static_cast<float>(environment.cloud_cover)) {
  const auto seed = static_cast<uint32_t>(environment.sky_seed);
  const Vec2f wind = WindOf(seed);
  RngStream random(seed, "bases");
  const auto usual = static_cast<float>(random.Uniform(0.85, 1.2));
  if (environment.cloud_cover >= kClosed) {
    deck_base_ = environment.cloud_base_m > 0 ? static_cast<float>(environment.cloud_base_m) : 800 * usual;
    deck_.emplace(deck_base_, light.overcast, light.to_sun, wind, seed);
    return;
  }
  if (environment.cloud_cover > 0.005) AddLow(environment, wind, seed);
  if (environment.altocumulus_cover > 0.02) {
    const float base = 4300 * static_cast<float>(random.Uniform(0.85, 1.15));
    layers_.push_back(SheetLayer({base, 230, static_cast<float>(random.Uniform(420, 750)), 26, 0.022f},
                                 static_cast<float>(environment.altocumulus_cover), WindOf(seed + 2), seed + 77));
  }
  PlaceTheSun(cover_, seed);
  LightLayers();
}

void Clouds::AddLow(const Environment& environment, Vec2f wind, uint32_t seed) {
  const CloudType type = TypeOf(environment, seed);
  const auto base_of = [&](float usual) {
    if (environment.cloud_base_m > 0) return static_cast<float>(environment.cloud_base_m);
    return usual * static_cast<float>(RngStream(seed, "bases").Uniform(0.85, 1.2));
  };
  if (type == CloudType::kStratocumulus || type == CloudType::kStratus) {
    const bool flat = type == CloudType::kStratus;
    const SheetForm form{base_of(flat ? 700 : 1200), flat ? 260.0f : 360.0f, flat ? 2600.0f : 1500.0f, 40, 0.05f};
    layers_.push_back(SheetLayer(form, cover_, wind, seed));
    return;
  }
  CumulusForm form{base_of(900), 2000, 0.7f};  // broken
  if (type == CloudType::kHumilis) form = {base_of(1150), 750, 0.75f};
  if (type == CloudType::kMediocris) form = {base_of(1100), 1350, 1.05f};
  if (type == CloudType::kCongestus) form = {base_of(900), 2600, 1.5f};
  layers_.push_back(CumulusLayer(form, cover_, wind, seed));
}

void Clouds::LightLayers() {
  const Vec3f sun = light_.sun_at(60);
  for (const CloudLayer& layer : layers_) {
    const float cover = layer.cover();
    const float middle = 0.5f * (layer.lowest() + layer.highest());
    const FieldShade shade(layer, light_.to_sun, kSunReach);
    // Between clouds light goes to and fro.
    const Vec3f between = Mix(sun, Vec3f{1, 1, 1} * Luminance(sun), 0.4f) * (0.02f * cover * shade.At(middle));
    lights_.push_back(
        {light_.sun_at(middle), light_.sky * (1 - 0.2f * cover) + between, light_.ground * (1 - 0.45f * cover) + light_.town, shade});
  }
  cirrus_sun_ = light_.sun_at(cirrus_.height());
}

// Moves the field until the sun stands as it should.
void Clouds::PlaceTheSun(float cover, uint32_t seed) {
  RngStream random(seed, "offsets");
  const double lot = random.Uniform();
  const bool hidden = cover >= 0.55f && lot < 0.25, veiled = cover >= 0.55f && !hidden && lot < 0.5;
  constexpr float kRing = 0.03f;  // radians: free means without cloud close to it, either
  float best = 2;
  Vec2f best_offset[4] = {};
  for (int attempt = 0; attempt < 160 && best > 0.05f; ++attempt) {
    Vec2f offset[4] = {};
    for (size_t k = 0; k < layers_.size(); ++k) {
      offset[k] = {static_cast<float>(random.Uniform()) * layers_[k].extent(), static_cast<float>(random.Uniform()) * layers_[k].extent()};
      layers_[k].SetOffset(offset[k].x, offset[k].y);
    }
    float sun = SunThrough(light_.to_sun), around = 0;
    for (int k = 0; k < 6 && !hidden && !veiled; ++k) {
      const float angle = static_cast<float>(k) * kPiF / 3;
      const Vec3f side = Normalized(Vec3f{-light_.to_sun.y, light_.to_sun.x, 1e-6f}), up = Cross(light_.to_sun, side);
      around += (1 - SunThrough(Normalized(light_.to_sun + side * (kRing * std::cos(angle)) + up * (kRing * std::sin(angle))))) / 6;
    }
    const float miss = hidden ? sun : veiled ? std::fabs(sun - 0.35f) : (1 - sun) + around;
    if (miss >= best) continue;
    best = miss;
    std::copy(std::begin(offset), std::end(offset), std::begin(best_offset));
  }
  for (size_t k = 0; k < layers_.size(); ++k) layers_[k].SetOffset(best_offset[k].x, best_offset[k].y);
}

float Clouds::SunThrough(Vec3f d) const {
  float depth = 0;
  d.z = std::max(d.z, 0.03f);
  for (const CloudLayer& layer : layers_) {
    const float first = DistanceToAltitude(d.z, std::max(layer.lowest(), 1.0f)), last = DistanceToAltitude(d.z, layer.highest());
    constexpr int kSteps = 48;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3f p = d * (first + (last - first) * (static_cast<float>(i) + 0.5f) / kSteps);
      if (layer.MayBeCloud(p.x, p.y)) depth += layer.Density(p.x, p.y, AltitudeOf(p), true) * (last - first) / kSteps;
    }
  }
  return scalar::exp_approx(-0.5f * depth);
}

// What sunlight meets before a point of a cloud, up to kSunReach.
float Clouds::DepthToSun(const CloudLayer& layer, Vec3f p, float altitude, float dither) const {
  float t = 0, depth = 0, step = kFirstStep;
  for (int k = 0; k < kSunSteps; ++k) {
    dither += 0.618034f;
    dither -= dither >= 1 ? 1.0f : 0.0f;
    // Shaken within the step: not at all, and bases show terraces; all over it, and they show grain.
    const float at = t + (0.32f + 0.36f * dither) * step, there = altitude + light_.to_sun.z * at;
    if (there > layer.highest()) break;
    depth += layer.Density(p.x + light_.to_sun.x * at, p.y + light_.to_sun.y * at, there, k < 2) * step;
    t += step;
    step *= kStepGrowth;
  }
  return depth;
}

// Light that a point of a cloud scatters to the ray's eye, of the sun: the octaves after what stands before it.
float Clouds::SunScattered(const CloudLayer& layer, const Ray& ray, Vec3f p, float altitude, float dither) const {
  // The extinctions halve from octave to octave: from the last to the first each power is the square of the one before.
  float pass[kOctaves];
  pass[kOctaves - 1] = scalar::exp_approx(-DepthToSun(layer, p, altitude, dither) * (1.0f / (1 << (kOctaves - 1))));
  for (int k = kOctaves - 1; k > 0; --k) pass[k - 1] = pass[k] * pass[k];
  float sum = 0, weight = 1;
  for (int k = 0; k < kOctaves; ++k) sum += weight * ray.phase[k] * pass[k], weight *= kOctaveWeight;
  return sum;
}

// The same of sky and ground: the sky's comes through what lies above by the two-stream form, the ground's fades upwards.
Vec3f Clouds::AmbientScattered(const CloudLayer& layer, const LayerLight& light, float altitude) const {
  const float z = altitude - layer.form().base, thickness = layer.highest() - layer.form().base;
  const float over = layer.form().extinction * std::max(0.0f, 0.8f * thickness - z) * (0.4f + 0.6f * layer.cover());
  const float above = 1 / (1 + 0.1f * over), below = scalar::exp_approx(-0.0025f * std::max(0.0f, z));
  return light.sky * (0.22f + 0.55f * above) + light.ground * (0.12f + 0.38f * below);
}

void Clouds::March(const CloudLayer& layer, const LayerLight& light, Ray& ray) const {
  const Vec3f d = ray.direction;
  const float first = DistanceToAltitude(d.z, std::max(layer.lowest(), 1.0f));
  const float last = std::min(DistanceToAltitude(d.z, layer.highest()), kFarthest);
  const float least = layer.highest() - layer.form().base < 500 ? 14.0f : 26.0f, jump = 3.6f * layer.form().cell;
  Vec3f sum{};
  float through = 1, distance = 0, weight = 0, dither = ray.dither, sun = 0;
  bool outside = true;
  for (float t = first; t < last && through > 0.008f;) {
    // About as fine as a pixel far away; near enough overhead that no grain shows.
    const float step = std::max(std::min(least, 0.009f * t), 0.0035f * t);
    if (!layer.MayBeCloud(d.x * t, d.y * t)) {
      t += std::max(step, jump);
      outside = true;
      continue;
    }
    if (outside) t += step * ray.dither;
    outside = false;
    const Vec3f p = d * t;
    const float altitude = AltitudeOf(p), density = layer.Density(p.x, p.y, altitude, t < kDetailRange);
    if (density <= 0) {
      t += 1.6f * step;
      continue;
    }
    // What little is left to see is lit as what stands before it.
    if (through > 0.25f || weight == 0) {
      dither += 0.7548777f;
      dither -= dither >= 1 ? 1.0f : 0.0f;
      sun = SunScattered(layer, ray, p, altitude, dither) * light.shade.At(altitude);
    }
    const float kept = scalar::exp_approx(-density * step), share = through * (1 - kept);
    sum += (light.sun * sun + AmbientScattered(layer, light, altitude)) * share;
    distance += t * share, weight += share;
    through *= kept;
    t += step;
  }
  if (weight < 1e-4f) return;
  distance /= weight;
  const float near = 1 - SmoothStep(kFading, kFarthest, distance);
  Put(ray, sum * near, weight * near, distance);
}

// Ice scatters forwards strongly: bright about the sun.
void Clouds::AddCirrus(Ray& ray) const {
  if (!cirrus_.any() || ray.through < 0.01f) return;
  const float t = DistanceToAltitude(ray.direction.z, cirrus_.height());
  const float depth = 0.6f * cirrus_.Depth(ray.direction.x * t, ray.direction.y * t) / std::max(0.12f, ray.direction.z);
  const float share = 1 - scalar::exp_approx(-depth);
  if (share < 1e-4f) return;
  const float mu = ray.cosine;
  const float scattered =
      0.70f * Phase(0.80f, mu) + 0.30f * Phase(0, mu) + 0.02f * Phase(0.985f, mu) + 0.10f * (1 - scalar::exp_approx(-2 * depth)) / kPiF;
  Put(ray, (cirrus_sun_ * scattered + light_.sky * 0.6f) * share, share, t);
}

// Lays light over what is behind, less what the air before it takes, with the air's own.
void Clouds::Put(Ray& ray, Vec3f light, float share, float distance) const {
  const float slope = ray.direction.z + distance * (0.5f / kEarthRadius);  // of the way's chord over the curved ground
  const auto kept = [&](float reach) {
    const float r = scalar::layer_path(0, slope, reach, kRayleighHeight), a = scalar::layer_path(0, slope, reach, kAerosolHeight);
    const Vec3f depth = light_.air.rayleigh * r + light_.air.aerosol * a;
    return Vec3f{scalar::exp_approx(-depth.x), scalar::exp_approx(-depth.y), scalar::exp_approx(-depth.z)};
  };
  const Vec3f here = kept(distance), all = kept(4e5f);
  const float dim = deck_ ? 1 : 1 - 0.35f * cover_;  // by the shade of clouds
  for (int c = 0; c < 3; ++c) {
    const float added = ray.air[c] * dim * (1 - here[c]) / std::max(1 - all[c], 1e-3f);
    ray.light[c] += (light[c] * here[c] + added * share) * ray.through;
  }
  ray.through *= 1 - share;
}

Vec3f Clouds::Over(Vec3f direction, Vec3f behind, Vec3f air, float dither) const {
  if (!any()) return behind;
  Ray ray{Normalized(Vec3f{direction.x, direction.y, std::max(direction.z, kLowestRay)}), air, dither, 0};
  if (deck_) {
    ray.air = deck_->AirLight(light_.town);
    Vec3f light = deck_->Radiance(ray.direction);
    if (light_.town != Vec3f{}) light += light_.town * deck_->Reflectance(ray.direction);
    Put(ray, light, 1, DistanceToAltitude(ray.direction.z, deck_base_));
    return ray.light;
  }
  ray.cosine = Dot(ray.direction, light_.to_sun);
  float g = 1;
  for (float& phase : ray.phase) {
    phase = 0.86f * Phase(0.82f * g, ray.cosine) + 0.14f * Phase(-0.25f * g, ray.cosine);
    g *= kOctaveAsymmetry;
  }
  for (size_t k = 0; k < layers_.size(); ++k) {
    if (ray.through > 0.01f) March(layers_[k], lights_[k], ray);
  }
  AddCirrus(ray);
  return ray.light + behind * ray.through;
}

float Clouds::DepthAlongSun(const CloudLayer& layer, float x, float y, float step) const {
  // A very low sun's shadows would run for ever; ten degrees is as far as CloudShadowMap follows them.
  const float z = std::max(light_.to_sun.z, 0.17f);
  step /= z;
  float depth = 0;
  for (float t = layer.lowest() / z + 0.5f * step; t < layer.highest() / z; t += step) {
    const Vec3f p{x + light_.to_sun.x * t, y + light_.to_sun.y * t, z * t};
    if (layer.MayBeCloud(p.x, p.y)) depth += layer.Density(p.x, p.y, p.z, true) * step;
  }
  return depth;
}

float Clouds::SunAt(float x, float y, float step) const {
  if (deck_) return 0;
  float depth = 0;
  for (const CloudLayer& layer : layers_) depth += DepthAlongSun(layer, x, y, step);
  const float z = std::max(light_.to_sun.z, 0.17f), t = cirrus_.height() / z;
  depth += 0.6f * cirrus_.Depth(x + light_.to_sun.x * t, y + light_.to_sun.y * t) / z;
  return scalar::exp_approx(-0.5f * depth);
}

}  // namespace airsim360::internal
