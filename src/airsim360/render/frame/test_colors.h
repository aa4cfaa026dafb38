// A square with vertex colours of every kind under a clear sky, and what its surfaces must look like.
#pragma once

#include <memory>
#include <optional>

#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/scene/scene.h"

namespace airsim360::test {

/// Grey of the ground's picture, sRGB.
inline constexpr uint8_t kPictureGrey = 188;

/// Instance i is entity i + 1: a ground with a plain picture, a hundred triangles above it (every third without colours,
/// the others with random corners; some share a mesh, most are tinted), a pane and a leaf that is cut by its vertices.
inline std::shared_ptr<const Scene> MakeColoredSquare() {
  SceneBuilder builder("colours");
  const CategoryId category = builder.tree().At("construction/building");
  RngStream rng(11, "colours");
  const auto uniform = [&](double low, double high) { return static_cast<float>(rng.Uniform(low, high)); };
  const auto color = [&] { return Vec3f{uniform(0, 1), uniform(0, 1), uniform(0, 1)}; };
  const auto add = [&](MeshId mesh, Vec3f tint = {1, 1, 1}) {
    builder.AddInstance({mesh, {}, builder.AddEntity("thing", category), tint});
  };
  const auto quad = [&](Vec3f corner, Vec3f a, Vec3f b, Material material) {
    Mesh mesh{"quad", {corner, corner + a, corner + a + b, corner + b}, {}, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}, {}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.parts = {{0, 2, builder.AddMaterial(std::move(material)), kNoEntity}};
    return mesh;
  };

  Material pictured;
  pictured.base_color = {0.9f, 0.8f, 0.7f};
  pictured.roughness = 0.9f;
  pictured.base_color_texture =
      builder.AddTexture(Texture::FromImage("grey", Image<Rgba8>(4, 4, {kPictureGrey, kPictureGrey, kPictureGrey, 255}), true));
  Mesh ground = quad({-12, -12, 0}, {24, 0, 0}, {0, 24, 0}, pictured);
  ground.colors = {{65535, 0, 0}, {0, 65535, 0}, {0, 0, 65535}, {50000, 50000, 9000}};
  add(builder.AddMesh(ground));

  Material matte;
  matte.base_color = {0.5f, 1, 0.8f};
  matte.roughness = 0.9f;
  const MaterialId matte_id = builder.AddMaterial(matte);
  std::optional<MeshId> last;
  for (int i = 0; i < 100; ++i) {
    if (i % 5 != 4 || !last) {
      const Vec3f middle{uniform(-8, 8), uniform(-8, 8), uniform(0.3, 3)};
      Mesh mesh{"triangle", {}, {}, {}, {{0, 1, 2}}, {{0, 1, matte_id, kNoEntity}}};
      for (int k = 0; k < 3; ++k) {
        mesh.positions.push_back(middle + Vec3f{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        if (i % 3 != 0) mesh.colors.push_back(MakeVertexColor(color()));
      }
      last = builder.AddMesh(mesh);
    }
    add(*last, i % 2 == 0 ? Vec3f{1, 1, 1} : color());
  }

  Material clear;
  clear.kind = SurfaceKind::kGlass;
  clear.base_color = {1, 1, 1};
  clear.transmission = 0.9f;
  clear.roughness = 0.03f;
  Mesh pane = quad({-6, -4, 4.5f}, {12, 0, 0}, {0, 8, 0}, clear);
  pane.colors = {{65535, 20000, 20000}, {20000, 65535, 20000}, {20000, 20000, 65535}, {65535, 65535, 65535}};
  add(builder.AddMesh(pane));

  Material cut = matte;
  cut.alpha_mode = AlphaMode::kMask;
  cut.alpha_cutoff = 0.5f;
  Mesh leaf = quad({-3, 5, 0.2f}, {6, 0, 0}, {0, 0.5f, 3}, cut);
  leaf.colors = {{65535, 0, 0, 0}, {0, 65535, 0, 65535}, {0, 0, 65535, 20000}, {65535, 65535, 0, 65535}};
  add(builder.AddMesh(leaf));

  builder.AddSky();
  builder.environment().cloud_cover = builder.environment().cirrus_cover = 0;
  builder.environment().sun_elevation_deg = 50;
  builder.SetSpawn({0, 0, 1.6f});
  return builder.Build();
}

/// Base colour of the surface of an instance at a point in W: material, picture, tint and corners. nullopt beside it.
inline std::optional<Vec3d> ColorAt(const Scene& scene, size_t instance, Vec3d p) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const Material& material = scene.materials[mesh.parts[0].material];
  for (const Vec3u& t : mesh.triangles) {
    const Vec3d a = VecCast<double>(mesh.positions[t.x]), b = VecCast<double>(mesh.positions[t.y]) - a,
                c = VecCast<double>(mesh.positions[t.z]) - a, n = Cross(b, c);
    const double u = Dot(Cross(p - a, c), n) / Dot(n, n), v = Dot(Cross(b, p - a), n) / Dot(n, n);
    if (u < -1e-5 || v < -1e-5 || u + v > 1 + 1e-5) continue;
    Vec3d color = VecCast<double>(material.base_color * placed.tint);
    if (material.base_color_texture != kNoTexture) color = color * static_cast<double>(SrgbToLinear(kPictureGrey));
    if (mesh.colors.empty()) return color;
    return color * (VecCast<double>(LinearColor(mesh.colors[t.x])) * (1 - u - v) + VecCast<double>(LinearColor(mesh.colors[t.y])) * u +
                    VecCast<double>(LinearColor(mesh.colors[t.z])) * v);
  }
  return std::nullopt;
}

}  // namespace airsim360::test
