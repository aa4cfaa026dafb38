#include "airsim360/render/indoor/indoor_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/indoor/plain_lamps.h"
#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kLift = 1.5e-3f;
constexpr float kBeforeLamp = 0.999f;  // of the way: a lamp does not stand before itself
constexpr float kMirrorMetal = 0.9f, kMirrorRoughness = 0.12f;

// Mean over all views of what a material gives back in even light.
Vec3f EvenAnswer(const MaterialRecord& m, Vec3f base) {
  constexpr int kViews = 16;
  const scalar::Bsdf bsdf = scalar::bsdf_make(m.kind, base, m.metallic, m.roughness, m.transmission, m.clear_coat, m.clear_coat_roughness);
  Vec3f sum;
  for (int k = 0; k < kViews; ++k) {
    const float cosine = std::sqrt((static_cast<float>(k) + 0.5f) / kViews);
    const scalar::BsdfSide side = scalar::bsdf_side(bsdf, cosine);
    sum += scalar::bsdf_reflected(side) + bsdf.body * scalar::bsdf_entering(side);
  }
  return sum / static_cast<float>(kViews);
}

// What a shadow ray brings if it gets through.
struct Brought {
  Vec3f light;
  Vec3f DirectLight::*to;
  bool odd = false;     // every other one
  uint32_t lamp = 0;    // from which it comes
  float as_if_all = 1;  // factor: if all rays went to that lamp
};

// A packet of shadow rays. `found`: gets what lamps bring, unless nullptr.
class ShadowQueue {
 public:
  ShadowQueue(const IndoorWorld& world, DirectLight& sum, std::vector<FoundLamp>* found) : world_(world), sum_(sum), found_(found) {}
  void Add(Vec3f p, Vec3f d, float t_far, const Brought& brought) {
    if (count_ == 16) Send();
    packet_.Set(count_, p, d, t_far);
    brought_[count_++] = brought;
  }
  /// To be called last.
  void Send() {
    if (count_ == 0) return;
    RayPacket panes = packet_;
    alignas(64) bool occluded[16] = {};
    world_.tracer.Occluded16(packet_.valid, packet_.rays, occluded, false);
    std::array<Vec3f, 16> tint;
    tint.fill({1, 1, 1});
    if (world_.tracer.has_clear_panes()) {
      for (int i = 0; i < count_; ++i) panes.valid[i] = occluded[i] ? 0 : -1;
      DimByPanes(world_.tracer, world_.tables, panes.valid, panes.rays, tint, true);
    }
    for (int i = 0; i < count_; ++i) {
      if (occluded[i]) continue;
      const Brought& one = brought_[i];
      const Vec3f light = one.light * tint[static_cast<size_t>(i)];
      const float luminance = Luminance(light);
      sum_.*one.to += light;
      if (one.to == &DirectLight::held) sum_.held_difference += one.odd ? -luminance : luminance;
      if (found_ != nullptr) found_->push_back({one.lamp, luminance * luminance * one.as_if_all * one.as_if_all, 0});
    }
    packet_.Clear();
    count_ = 0;
  }

 private:
  const IndoorWorld& world_;
  DirectLight& sum_;
  std::vector<FoundLamp>* found_;
  RayPacket packet_;
  Brought brought_[16];
  int count_ = 0;
};

void AddSun(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f n, int rays, Vec2f shift, ShadowQueue& queue) {
  if (world.sky == nullptr || rays == 0) return;
  const SunLight sun = world.sky->sun();
  Vec3f t, b;
  TangentFrame(sun.direction, t, b);
  const float radius = std::tan(sun.angular_radius);
  if (!(Dot(n, sun.direction) > -radius) || sun.irradiance == Vec3f{}) return;
  for (int k = 0; k < rays; ++k) {
    const Vec2f u = EvenPoint(static_cast<uint32_t>(k), shift);
    const float r = radius * std::sqrt(u.x), angle = 2 * kPiF * u.y;
    const Vec3f d = Normalized(sun.direction + t * (r * std::cos(angle)) + b * (r * std::sin(angle)));
    const float cosine = Dot(n, d);
    if (!(cosine > 0)) continue;
    const Vec3f p = points[static_cast<size_t>(k) % points.size()];
    queue.Add(p + n * kLift, d, INFINITY,
              {sun.irradiance * (cosine * world.sky->CloudShadow(p) / static_cast<float>(rays)), &DirectLight::sun});
  }
}

constexpr int kMostChosen = 256;
using Choices = std::array<LightTree::Choice, kMostChosen>;

// By ascending numbers; those up to the tree's share of them are the tree's. Probabilities are those of both together.
void ChooseLamps(const IndoorWorld& world, Vec3f p, Vec3f n, const LampMix& mix, std::span<float> numbers, Choices& chosen) {
  const LightTree& tree = world.lights->tree();
  const float by_tree = mix.guide != nullptr ? mix.guide->tree_share() : 1;
  const auto of_tree = static_cast<size_t>(std::lower_bound(numbers.begin(), numbers.end(), by_tree) - numbers.begin());
  for (float& u : numbers.first(of_tree)) u = std::min(u / by_tree, 0.9999999f);
  tree.ChooseAll(p, n, numbers.first(of_tree), chosen);
  if (mix.guide == nullptr) return;
  for (LightTree::Choice& choice : std::span(chosen).first(of_tree))
    if (choice.probability > 0) choice.probability = by_tree * choice.probability + (1 - by_tree) * mix.guide->Probability(choice.lamp);
  for (size_t i = of_tree; i < numbers.size(); ++i) {
    chosen[i] = mix.guide->Choose((numbers[i] - by_tree) / (1 - by_tree));
    const bool known = i > of_tree && chosen[i].lamp == chosen[i - 1].lamp;
    chosen[i].probability = known ? chosen[i - 1].probability : mix.ChanceOf(*world.lights, p, n, chosen[i].lamp);
  }
}

void AddLamps(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f n, const LampMix& mix, uint32_t seed, ShadowQueue& queue) {
  const int rays = mix.to_lamps;
  if (world.lights == nullptr || world.lights->empty() || rays == 0) return;
  const Vec2f shift = ShiftOf(seed * 2654435761ull + 1);
  const float first = ShiftOf(seed * 2654435761ull + 7).x;
  // The lamp by numbers stratified apart: the sequence pairs them with points of the lamp evenly. One place chooses for all points.
  std::array<float, kMostChosen> numbers;
  Choices chosen;
  for (int k = 0; k < rays; ++k) {
    const int in = k % kMostChosen;
    if (in == 0) {
      const auto count = static_cast<size_t>(std::min(kMostChosen, rays - k));
      for (size_t i = 0; i < count; ++i)
        numbers[i] = std::min((static_cast<float>(k + static_cast<int>(i)) + first) / static_cast<float>(rays), 0.9999999f);
      ChooseLamps(world, points[0], n, mix, std::span(numbers).first(count), chosen);
    }
    const Vec2f u = EvenPoint(static_cast<uint32_t>(k), shift);
    const Vec3f p = points[static_cast<size_t>(k) % points.size()] + n * kLift;
    const LightTree::Choice& choice = chosen[static_cast<size_t>(in)];
    const LightSample sample = world.lights->PointOf(choice, p, u.x, u.y);
    if (!(sample.pdf > 0)) continue;
    if (mix.found != nullptr) mix.found->push_back({sample.lamp, 0, 1});
    const Vec3f to = sample.p - p;
    const float distance = Norm(to);
    const Vec3f d = to / std::max(distance, 1e-6f);
    const float here = Dot(n, d), there = -Dot(sample.normal, d);
    if (!(here > 0 && there > 0)) continue;
    const bool held = world.lamps != nullptr && world.lamps->Holds(sample.lamp);
    const float shape = here * there / (distance * distance);
    const bool shared = mix.plain != nullptr && mix.plain->Holds(sample.lamp);
    const float weight = shape / (sample.pdf * static_cast<float>(rays)) * (shared ? mix.OfLampRays(sample.pdf, shape / kPiF) : 1);
    queue.Add(p, d, distance * kBeforeLamp,
              {sample.radiance * weight, held ? &DirectLight::held : &DirectLight::others, k % 2 != 0, sample.lamp,
               choice.probability * static_cast<float>(rays)});
  }
}

}  // namespace

void TangentFrame(Vec3f n, Vec3f& t, Vec3f& b) {
  // Duff et al., JCGT 6(1), 2017.
  const float s = n.z >= 0 ? 1.0f : -1.0f, a = -1 / (s + n.z), c = n.x * n.y * a;
  t = {1 + s * n.x * n.x * a, s * c, -s * n.x};
  b = {c, s + n.y * n.y * a, -n.y};
}

Vec2f EvenPoint(uint32_t i, Vec2f shift) {
  const float x = shift.x + static_cast<float>((i + 1) * 0xC13FA9A9u >> 8) * 0x1p-24f;
  const float y = shift.y + static_cast<float>((i + 1) * 0x91E10DA5u >> 8) * 0x1p-24f;
  return {x - std::floor(x), y - std::floor(y)};
}

Vec2f ShiftOf(uint64_t seed) {
  const uint64_t bits = MixBits(seed);
  return {static_cast<float>(bits >> 40) * 0x1p-24f, static_cast<float>(bits >> 16 & 0xffffff) * 0x1p-24f};
}

std::vector<uint8_t> MovingInstances(const Scene& scene) {
  std::vector<uint8_t> moving(scene.instances.size());
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const EntityId entity = scene.instances[i].entity;
    if (entity == kNoEntity) continue;
    const std::string& path = scene.tree[scene.entity(entity).category].path;
    moving[i] = path.starts_with("human") || path.starts_with("uav");
  }
  return moving;
}

std::shared_ptr<const RayTracer> StaticTracer(std::shared_ptr<const RayTracer> tracer) {
  const std::vector<uint8_t> moving = MovingInstances(tracer->scene());
  auto state = std::make_shared<SceneState>();
  for (uint32_t i = 0; i < moving.size(); ++i) {
    if (moving[i]) state->moved.push_back({.instance = i, .X_WM = tracer->scene().instances[i].X_WM, .hidden = true});
  }
  return state->moved.empty() ? tracer : DynamicTracer(tracer).At(state);
}

Reflectance::Reflectance(const SurfaceTables& tables) {
  for (const MaterialRecord& material : tables.materials) {
    rest.push_back(EvenAnswer(material, {0, 0, 0}));
    slope.push_back(EvenAnswer(material, {1, 1, 1}) - rest.back());
  }
}

MetSurface SurfaceUnder(const IndoorWorld& world, const RayPacket& packet, int lane) {
  const RayHit16& rays = packet.rays;
  const SurfaceTables& tables = world.tables;
  const SurfaceRef ref = world.tracer.Resolve(rays.geometry[lane], rays.instance[lane], rays.primitive[lane]);
  const InstanceRecord& instance = tables.instances[ref.instance];
  const TriangleRecord& triangle = tables.triangles[instance.first_triangle + ref.triangle];
  MetSurface met;
  met.material = triangle.material & ~kMirroredUv;
  const Vec3f d = packet.Direction(lane);
  met.normal = GeometricNormal(instance, triangle);
  met.behind = Dot(met.normal, d) > 0;
  if (met.behind) met.normal = -met.normal;
  met.point = packet.Origin(lane) + d * rays.t_far[lane];
  const Vec3f tint{instance.tint[0], instance.tint[1], instance.tint[2]};
  met.base = tables.mean_colors[met.material] * tint * tables.MeanColor(instance, ref.triangle);
  const MaterialRecord& material = tables.materials[met.material];
  met.mirror = material.metallic > kMirrorMetal && material.roughness < kMirrorRoughness;
  return met;
}

Vec3f SunFromAbove(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f normal, uint32_t seed, int rays) {
  DirectLight sum;
  ShadowQueue queue(world, sum, nullptr);
  AddSun(world, points, normal, rays, ShiftOf(seed), queue);
  queue.Send();
  return sum.sun;
}

DirectLight LampsAround(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f normal, const LampMix& lamps, uint32_t seed) {
  DirectLight sum;
  ShadowQueue queue(world, sum, lamps.found);
  AddLamps(world, points, normal, lamps, seed, queue);
  queue.Send();
  return sum;
}

}  // namespace airsim360::internal
