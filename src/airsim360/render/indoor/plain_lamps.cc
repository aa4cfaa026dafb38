#include "airsim360/render/indoor/plain_lamps.h"

#include <algorithm>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

uint32_t MaterialOf(const IndoorWorld& world, uint32_t instance, uint32_t triangle) {
  return world.tables.triangles[world.tables.instances[instance].first_triangle + triangle].material & ~kMirroredUv;
}

SurfaceRef RefOf(const IndoorWorld& world, const RayPacket& packet, int lane) {
  return world.tracer.Resolve(packet.rays.geometry[lane], packet.rays.instance[lane], packet.rays.primitive[lane]);
}

}  // namespace

PlainLamps::PlainLamps(const IndoorWorld& world) {
  if (world.lights == nullptr) return;
  for (uint32_t i = 0; i < world.lights->size(); ++i) {
    const auto triangles = world.lights->TrianglesOf(i);
    const uint32_t instance = world.lights->lamps()[i].instance;
    plain_.push_back(std::all_of(triangles.begin(), triangles.end(), [&](uint32_t triangle) {
      const MaterialRecord& look = world.tables.materials[MaterialOf(world, instance, triangle)];
      return look.beam == 0 && look.emission_texture == 0;
    }));
  }
}

Vec3f PlainGlow(const IndoorWorld& world, const PlainLamps& plain, const RayPacket& packet, int lane, const MetSurface& met) {
  if (met.behind) return {};
  const Material& material = world.tracer.scene().materials[met.material];
  if (material.emission == Vec3f{}) return {};
  const SurfaceRef ref = RefOf(world, packet, lane);
  const uint32_t lamp = world.lights->LampOf(ref.instance, ref.triangle);
  if (lamp == LightTable::kNoLamp || !plain.Holds(lamp)) return {};
  return material.emission * world.tables.GlowOf(ref.instance);
}

MetGlow GlowUnder(const IndoorWorld& world, const LampMix& rays, const RayPacket& packet, int lane, const MetSurface& met, Vec3f normal,
                  Vec3f chosen_for) {
  if (rays.plain == nullptr) return {};
  const Vec3f glow = PlainGlow(world, *rays.plain, packet, lane, met);
  if (glow == Vec3f{}) return {};
  const SurfaceRef ref = RefOf(world, packet, lane);
  const Vec3f d = packet.Direction(lane);
  const float distance = std::max(packet.rays.t_far[lane], 1e-4f);
  const float even = std::max(0.0f, Dot(d, normal)) * -Dot(d, met.normal) / (kPiF * distance * distance);
  const uint32_t lamp = world.lights->LampOf(ref.instance, ref.triangle);
  const float left = rays.OfLampRays(rays.ChanceOf(*world.lights, chosen_for, normal, lamp) / world.lights->lamps()[lamp].area, even);
  return {glow * (1 - left), world.lamps != nullptr && world.lamps->Holds(lamp)};
}

}  // namespace airsim360::internal
