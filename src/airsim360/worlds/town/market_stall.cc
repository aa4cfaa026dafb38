#include "airsim360/worlds/town/market_stall.h"

#include "airsim360/base/random.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal {
namespace {

// Linear colours of fruit, vegetables and flowers.
constexpr Vec3f kGoods[] = {{0.55f, 0.04f, 0.03f}, {0.70f, 0.28f, 0.03f}, {0.72f, 0.55f, 0.06f}, {0.18f, 0.36f, 0.05f},
                            {0.30f, 0.10f, 0.22f}, {0.62f, 0.18f, 0.14f}, {0.08f, 0.20f, 0.04f}, {0.60f, 0.46f, 0.28f}};

MaterialId AddGoods(SceneBuilder& builder, Vec3f color, size_t index) {
  Material material;
  material.name = "goods " + std::to_string(index);
  material.base_color = color;
  material.roughness = 0.45f;
  return builder.AddMaterial(std::move(material));
}

}  // namespace

MeshId AddStallMesh(SceneBuilder& builder, const Surfaces& surfaces, uint32_t variant) {
  MeshBuilder mesh;
  RngStream rng(variant, "stall");
  // Counter: boarded front, legs behind, a top sloping to the buyer.
  mesh.SetMaterial(surfaces[Surface::kDoorWood]);
  mesh.Box({-1.3f, -0.45f, 0.05f}, {1.3f, -0.40f, 0.72f});
  for (float x : {-1.25f, 1.17f}) mesh.Box({x, 0.32f, 0}, {x + 0.08f, 0.40f, 0.85f});
  mesh.Box({-1.3f, -0.45f, 0.72f}, {1.3f, 0.45f, 0.76f});
  // Crates in two rows, each heaped with goods of one kind.
  for (int i = 0; i < 8; ++i) {
    const float x = -1.26f + 0.64f * static_cast<float>(i % 4), y = i < 4 ? -0.43f : 0.02f, z = i < 4 ? 0.76f : 0.86f;
    mesh.SetMaterial(surfaces[Surface::kFrameWood]);
    mesh.Box({x, y, z}, {x + 0.6f, y + 0.02f, z + 0.14f});
    mesh.Box({x, y + 0.40f, z}, {x + 0.6f, y + 0.42f, z + 0.14f});
    mesh.Box({x, y + 0.02f, z}, {x + 0.02f, y + 0.40f, z + 0.14f});
    mesh.Box({x + 0.58f, y + 0.02f, z}, {x + 0.6f, y + 0.40f, z + 0.14f});
    mesh.Box({x + 0.02f, y + 0.02f, z}, {x + 0.58f, y + 0.40f, z + 0.07f}, MeshBuilder::kTop);
    const size_t kind = rng.Index(8);
    mesh.SetMaterial(AddGoods(builder, kGoods[kind], kind));
    const float r = kind % 2 ? 0.055f : 0.042f;
    for (float gy = y + 0.07f; gy < y + 0.37f; gy += 2.05f * r) {
      for (float gx = x + 0.07f; gx < x + 0.54f; gx += 2.05f * r) {
        const auto heap = static_cast<float>(rng.Uniform(0.0, 0.05));
        mesh.Sphere({gx, gy, z + 0.08f + heap}, {r, r, r * 0.95f}, 4, 7);
      }
    }
  }
  return builder.AddMesh(mesh.Finish("market stall " + std::to_string(variant)));
}

}  // namespace airsim360::internal
