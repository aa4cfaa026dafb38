// What stands in the lakes of the downtowns: an island and a red footbridge.
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {}  // namespace

void RaiseIsland(District& d, std::string_view category, Vec2f c, Vec2f half, float water_z) {
  const EntityId island = d.ground.Begin("island", category, Surface::kLawn);
  constexpr int kRings = 6, kSides = 40;
  const auto height = [&](float t) { return water_z - 0.15f + std::cos(kTauF / 4 * std::min(1.0f, t * t)); };
  const auto at = [&](int ring, int side) {
    const float t = static_cast<float>(ring) / kRings, a = kTauF * static_cast<float>(side % kSides) / kSides;
    const float wobble = 1 + 0.08f * std::sin(2 * a + 1) + 0.05f * std::sin(5 * a);
    return Vec3f{c.x + half.x * t * wobble * std::cos(a), c.y + half.y * t * wobble * std::sin(a), height(t)};
  };
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSides; ++j) {
      if (i == 0) {
        const Vec3f a = at(0, 0), b = at(1, j), e = at(1, j + 1);
        d.ground.mesh().Triangle(a, b, e, {a.x, -a.y}, {b.x, -b.y}, {e.x, -e.y});
      } else {
        d.ground.Quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  RngStream rng(d.seed, "island");
  const auto top = [&](Vec2f p) { return height(std::hypot((p.x - c.x) / half.x, (p.y - c.y) / half.y)); };
  for (int i = 0; i < 160; ++i) {
    const float a = static_cast<float>(rng.Uniform(0, kTauF)), t = std::sqrt(static_cast<float>(rng.Uniform(0, 0.6)));
    const Vec2f p{c.x + half.x * t * std::cos(a), c.y + half.y * t * std::sin(a)};
    const auto scale = static_cast<float>(rng.Uniform(0.8, 1.5));
    d.placer.shelf().PlaceAs(island, "grass_tuft", PlaceUpright({p.x, p.y, top(p) - 0.01f}, a * 5, scale), rng.Index(16));
  }
  for (Vec2f o : {Vec2f{-0.56f, 0.09f}, Vec2f{0.53f, -0.17f}}) {
    const Vec2f p{c.x + o.x * half.x, c.y + o.y * half.y};
    d.placer.Try("tree_generic", {p.x, p.y, top(p) - 0.05f}, o.x * 6, 0.7f, {1, 1, 1}, 2u);
  }
  for (int i = 0; i < 7; ++i) {
    const float a = kTauF * static_cast<float>(i) / 7;
    const Vec2f p{c.x + 0.81f * half.x * std::cos(a), c.y + 0.81f * half.y * std::sin(a)};
    d.placer.Try(i % 2 ? "rock" : "shrub", {p.x, p.y, top(p) - 0.05f}, a, 0.55f);
  }
}

void BuildRedBridge(District& d, Vec2f c, float half) {
  Material red;
  red.name = "bridge red";
  red.base_color = {0.44f, 0.018f, 0.014f};
  red.roughness = 0.45f;
  const MaterialId paint = d.builder.AddMaterial(red);
  MeshBuilder mesh;
  constexpr int kParts = 28;
  const float rise = 2.1f * half / 16.2f, x = c.x;
  const auto z = [&](float y) {
    const float t = (y - c.y) / half;
    return 0.05f + rise * (1 - t * t);
  };
  for (int i = 0; i < kParts; ++i) {
    const float y0 = c.y - half + 2 * half * static_cast<float>(i) / kParts, y1 = y0 + 2 * half / kParts, z0 = z(y0), z1 = z(y1);
    mesh.SetMaterial(d.surfaces[Surface::kDoorWood]);
    mesh.Quad({x - 1.5f, y0, z0}, {x + 1.5f, y0, z0}, {x + 1.5f, y1, z1}, {x - 1.5f, y1, z1});
    mesh.SetMaterial(paint);
    mesh.Quad({x - 1.5f, y1, z1 - 0.25f}, {x + 1.5f, y1, z1 - 0.25f}, {x + 1.5f, y0, z0 - 0.25f}, {x - 1.5f, y0, z0 - 0.25f});
    for (float side : {-1.0f, 1.0f}) {
      const float e = x + side * 1.55f;
      mesh.Beam({e, y0, z0 - 0.1f}, {e, y1, z1 - 0.1f}, 0.34f);
      mesh.Beam({e, y0, z0 + 1.05f}, {e, y1, z1 + 1.05f}, 0.09f);
      mesh.Beam({e, y0, z0 + 0.55f}, {e, y1, z1 + 0.55f}, 0.04f);
      mesh.Beam({e, y0, z0}, {e, y0, z0 + 1.05f}, i % 4 == 0 ? 0.12f : 0.05f);
      if (i % 7 == 3) mesh.Beam({e, y0, -1.2f}, {e, y0, z0}, 0.3f);
    }
  }
  const EntityId bridge = d.builder.AddEntity("red bridge", d.builder.tree().At("construction/bridge"));
  d.builder.AddInstance({d.builder.AddMesh(mesh.Finish("red bridge")), {}, bridge});
  d.placer.Reserve({c, {1.9f, half + 1}, 0});
}

}  // namespace airsim360::internal
