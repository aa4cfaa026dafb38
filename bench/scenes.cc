#include "scenes.h"

#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360::bench {
namespace {

constexpr float kSide = 2000;  // metres

float Height(float x, float y) { return 12 * std::sin(x * .01f) * std::cos(y * .013f) + 3 * std::sin(x * .05f + y * .03f); }

// Half of the triangles are terrain …
void AddTerrain(Mesh& mesh, long triangles) {
  const auto n = static_cast<uint32_t>(std::sqrt(static_cast<double>(triangles) / 4));
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const float x = (static_cast<float>(i) / n - .5f) * kSide, y = (static_cast<float>(j) / n - .5f) * kSide;
      mesh.positions.push_back({x, y, Height(x, y)});
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  }
}

// … half towers of 24 floors with 16 rough sides.
void AddTower(Mesh& mesh, RngStream& rng) {
  constexpr uint32_t kFloors = 24, kSides = 16;
  float cx, cy;
  do {
    cx = static_cast<float>(rng.Uniform(-.5, .5)) * kSide;
    cy = static_cast<float>(rng.Uniform(-.5, .5)) * kSide;
  } while (cx * cx + cy * cy < 900);
  const auto radius = static_cast<float>(rng.Uniform(4, 14)), height = static_cast<float>(6 + 70 * rng.Uniform() * rng.Uniform());
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t k = 0; k <= kFloors; ++k) {
    for (uint32_t s = 0; s < kSides; ++s) {
      const float a = static_cast<float>(s) * 2 * std::numbers::pi_v<float> / kSides;
      const float r = radius * (1 + .08f * static_cast<float>(rng.Uniform()));
      mesh.positions.push_back({cx + r * std::cos(a), cy + r * std::sin(a), Height(cx, cy) - 2 + height * k / kFloors});
    }
  }
  for (uint32_t k = 0; k < kFloors; ++k) {
    for (uint32_t s = 0; s < kSides; ++s) {
      const uint32_t a = first + k * kSides + s, b = first + k * kSides + (s + 1) % kSides;
      mesh.triangles.push_back({a, b, a + kSides});
      mesh.triangles.push_back({b, b + kSides, a + kSides});
    }
  }
}

// A trunkless ball of leaves: random triangles in a sphere.
Mesh Tree() {
  Mesh mesh{"tree", {}, {}, {}, {}, {}};
  RngStream rng(1, "tree");
  for (uint32_t i = 0; i < 5000; ++i) {
    Vec3f c;
    do {
      for (int k = 0; k < 3; ++k) c[k] = static_cast<float>(rng.Uniform(-3, 3));
    } while (Norm(c) > 3);
    for (int v = 0; v < 3; ++v) {
      Vec3f p = c;
      for (int k = 0; k < 3; ++k) p[k] += static_cast<float>(rng.Uniform(-.15, .15));
      mesh.positions.push_back(p + Vec3f{0, 0, 5});
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// Crossed cards with a picture of leaves whose gaps are holes: half of a card's area.
Mesh LeafCards(MaterialId leaves, EntityId entity) {
  Mesh mesh{"cards", {}, {}, {}, {}, {}};
  RngStream rng(1, "cards");
  for (uint32_t i = 0; i < 600; ++i) {
    Vec3f c, u, v;
    do {
      for (int k = 0; k < 3; ++k) c[k] = static_cast<float>(rng.Uniform(-3, 3));
    } while (Norm(c) > 3);
    for (int k = 0; k < 3; ++k) u[k] = static_cast<float>(rng.Uniform(-1, 1)), v[k] = static_cast<float>(rng.Uniform(-1, 1));
    u = Normalized(u) * 0.35f;
    v = Normalized(Cross(u, v)) * 0.35f;
    const Vec3f middle = c + Vec3f{0, 0, 5};
    for (const Vec2f corner : {Vec2f{-1, -1}, Vec2f{1, -1}, Vec2f{1, 1}, Vec2f{-1, 1}}) {
      mesh.positions.push_back(middle + u * corner.x + v * corner.y);
      mesh.uvs.push_back({corner.x * 0.5f + 0.5f, corner.y * 0.5f + 0.5f});
    }
    mesh.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
  }
  mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), leaves, entity}};
  return mesh;
}

Image<Rgba8> LeafPicture() {
  Image<Rgba8> picture(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double leaf = std::sin(x * 0.6) * std::sin(y * 0.5 + x * 0.1);
      picture(x, y) = {80, 120, 40, static_cast<uint8_t>(leaf > 0 ? 255 : 0)};
    }
  }
  return picture;
}

}  // namespace

std::shared_ptr<const Scene> BuildCity(const CityOptions& options) {
  SceneBuilder builder("bench");
  const CategoryId building = builder.tree().At("construction/building");
  Mesh mesh{"city", {}, {}, {}, {}, {}};
  RngStream rng(1, "city");
  const auto add_part = [&] {
    const auto first = mesh.parts.empty() ? 0 : mesh.parts.back().first_triangle + mesh.parts.back().triangle_count;
    mesh.parts.push_back({first, static_cast<uint32_t>(mesh.triangles.size()) - first, 0, builder.AddEntity("part", building)});
  };
  AddTerrain(mesh, options.triangles);
  add_part();
  while (static_cast<long>(mesh.triangles.size()) < options.triangles) {
    AddTower(mesh, rng);
    add_part();
  }
  builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), kNoEntity});
  if (options.trees > 0) {
    const MeshId tree = builder.AddMesh(Tree());
    for (int i = 0; i < options.trees; ++i) {
      const auto x = static_cast<float>(rng.Uniform(-500, 500)), y = static_cast<float>(rng.Uniform(-500, 500));
      builder.AddInstance(
          {tree, PlaceUpright({x, y, Height(x, y)}, static_cast<float>(rng.Uniform(0, 6))), builder.AddEntity("tree", building)});
    }
  }
  builder.AddSky();
  return builder.Build();
}

std::shared_ptr<const Scene> BuildForest(int trees) {
  SceneBuilder builder("forest");
  const CategoryId plant = builder.tree().At("vegetation/tree");
  Mesh ground{"ground", {}, {}, {}, {}, {}};
  AddTerrain(ground, 200'000);
  ground.parts = {{0, static_cast<uint32_t>(ground.triangles.size()), builder.AddMaterial({}), builder.AddEntity("ground", plant)}};
  builder.AddInstance({builder.AddMesh(std::move(ground)), AffineTransform(), kNoEntity});
  Material leaves;
  leaves.kind = SurfaceKind::kFoliage;
  leaves.alpha_mode = AlphaMode::kMask;
  leaves.transmission = 0.8f;
  leaves.base_color_texture = builder.AddTexture(Texture::FromImage("leaf", LeafPicture(), true));
  const MeshId tree = builder.AddMesh(LeafCards(builder.AddMaterial(leaves), kNoEntity));
  RngStream rng(1, "forest");
  for (int i = 0; i < trees; ++i) {
    const auto x = static_cast<float>(rng.Uniform(-150, 150)), y = static_cast<float>(rng.Uniform(-150, 150));
    builder.AddInstance({tree,
                         PlaceUpright({x, y, Height(x, y)}, static_cast<float>(rng.Uniform(0, 6)), static_cast<float>(rng.Uniform(1, 2))),
                         builder.AddEntity("tree", plant)});
  }
  builder.AddSky();
  return builder.Build();
}

}  // namespace airsim360::bench
