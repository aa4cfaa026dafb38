#include "airsim360/trace/alpha_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {
namespace {

// Blobs of opacity with soft edges.
Texture RandomTexture(RngStream& rng) {
  const int width = 3 + static_cast<int>(rng.Uniform(0, 40)), height = 2 + static_cast<int>(rng.Uniform(0, 40));
  const double fx = rng.Uniform(0.5, 3), fy = rng.Uniform(0.5, 3), shift = rng.Uniform(0, 6);
  Image<Rgba8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave = std::sin(fx * 6.28 * x / width + shift) + std::cos(fy * 6.28 * y / height);
      image(x, y) = {90, 120, 60, static_cast<uint8_t>(std::clamp(128 + 300 * wave, 0.0, 255.0))};
    }
  }
  Texture texture = Texture::FromImage("leaf", std::move(image), true);
  texture.wrap_u = static_cast<Wrap>(static_cast<int>(rng.Uniform(0, 3)));
  texture.wrap_v = static_cast<Wrap>(static_cast<int>(rng.Uniform(0, 3)));
  return texture;
}

// Cards with random places and texture coordinates, of all sizes from a texel to several repeats, some of
// them instanced and some parts plain; with `colors`, vertices cover random shares in half of the meshes.
std::shared_ptr<const Scene> LeafScene(RngStream& rng, bool colors = false) {
  SceneBuilder builder("leaves");
  const EntityId entity = builder.AddEntity("leaves", builder.tree().At("vegetation"));
  const MaterialId plain = builder.AddMaterial({});
  for (int m = 0; m < 4; ++m) {
    Material cut;
    cut.alpha_mode = AlphaMode::kMask;
    cut.alpha_cutoff = static_cast<float>(rng.Uniform(0.05, 0.95));
    cut.base_alpha = m == 3 ? 0.8f : 1;
    cut.base_color_texture = builder.AddTexture(RandomTexture(rng));
    cut.uv_scale = {static_cast<float>(rng.Uniform(0.5, 2)), 1};
    cut.uv_rotation = static_cast<float>(rng.Uniform(0, 6));
    cut.uv_offset = {static_cast<float>(rng.Uniform(-3, 3)), 0};
    const MaterialId cut_id = builder.AddMaterial(cut);
    Mesh mesh{"leaves", {}, {}, {}, {}, {}};
    for (uint32_t i = 0; i < 300; ++i) {
      const double size = std::exp(rng.Uniform(-4, 1.5)), u0 = rng.Uniform(-2, 2), v0 = rng.Uniform(-2, 2);
      const Vec3f center{static_cast<float>(rng.Uniform(-4, 4)), static_cast<float>(rng.Uniform(-4, 4)),
                         static_cast<float>(rng.Uniform(-4, 4))};
      for (int k = 0; k < 3; ++k) {
        Vec3f p = center;
        for (int a = 0; a < 3; ++a) p[a] += static_cast<float>(rng.Uniform(-0.6, 0.6));
        mesh.positions.push_back(p);
        mesh.uvs.push_back({static_cast<float>(u0 + rng.Uniform(0, size)), static_cast<float>(v0 + rng.Uniform(0, size))});
      }
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (size_t i = 0; colors && m % 2 == 1 && i < mesh.positions.size(); ++i)
      mesh.colors.push_back(MakeVertexColor({1, 1, 1}, static_cast<float>(rng.Uniform(-0.2, 1.5))));
    mesh.parts = {{0, 250, cut_id, kNoEntity}, {250, 50, plain, kNoEntity}};
    const MeshId id = builder.AddMesh(mesh);
    for (int i = 0; i <= m % 2; ++i)
      builder.AddInstance({id, {Mat3f(), {static_cast<float>(3 * m), 0, static_cast<float>(4 * i)}}, entity});
  }
  return builder.Build();
}

TEST(AlphaTest, OpaqueTrianglesHaveNoHoleAndClearOnesAreAllHole) {
  RngStream rng(1, "alpha");
  int counts[3] = {};
  for (int round = 0; round < 4; ++round) {
    const auto scene = LeafScene(rng);
    for (const Mesh& mesh : scene->meshes) {
      const internal::AlphaTest test(scene->materials[mesh.parts[0].material], scene->textures);
      for (uint32_t t = 0; t < mesh.parts[0].triangle_count; ++t) {
        const internal::Opacity opacity = test.Classify(mesh, t);
        ++counts[static_cast<int>(opacity)];
        if (opacity == internal::Opacity::kMixed) continue;
        const Vec3u c = mesh.triangles[t];
        constexpr int kSteps = 24;
        for (int a = 0; a <= kSteps; ++a) {
          for (int b = 0; a + b <= kSteps; ++b) {
            const float u = static_cast<float>(a) / kSteps, v = static_cast<float>(b) / kSteps;
            const Vec2f uv = (1 - u - v) * mesh.uvs[c.x] + u * mesh.uvs[c.y] + v * mesh.uvs[c.z];
            ASSERT_EQ(test.Solid(uv), opacity == internal::Opacity::kOpaque) << t << ' ' << u << ' ' << v;
          }
        }
      }
    }
  }
  for (int count : counts) EXPECT_GT(count, 200);
}

TEST(AlphaTest, SortingTrianglesByOpacityChangesNoHit) {
  RngStream rng(2, "alpha");
  for (int round = 0; round < 4; ++round) {
    const auto scene = LeafScene(rng, round % 2 == 1);
    const RayTracer sorted(scene), filtered(scene, {.isa = {}, .sort_alpha = false});
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto point = [&] {
        Vec3f p;
        for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(rng.Uniform(-5, 10));
        return p;
      };
      const Vec3f origin = point(), direction = point() - origin;
      const auto a = sorted.Intersect(origin, direction), b = filtered.Intersect(origin, direction);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ++hits;
      EXPECT_EQ(a->distance, b->distance);
      EXPECT_EQ(a->surface.instance, b->surface.instance);
      EXPECT_EQ(a->surface.triangle, b->surface.triangle);
      EXPECT_EQ(a->u, b->u);
      EXPECT_EQ(a->normal, b->normal);
    }
    EXPECT_GT(hits, 2000);
  }
}

// A triangle whose corners cover 0, 1/2 and 1, cut at different heights, without and with a picture that covers half:
// rays meet it exactly where the closed form says.
TEST(AlphaTest, CoverageOfVerticesCutsAlongStraightLines) {
  for (const float cutoff : {0.1f, 0.4f, 0.7f}) {
    for (const bool picture : {false, true}) {
      for (const bool sort : {false, true}) {
        SceneBuilder builder("cut");
        Material material;
        material.alpha_mode = AlphaMode::kMask;
        material.alpha_cutoff = cutoff;
        if (picture)
          material.base_color_texture = builder.AddTexture(Texture::FromImage("half", Image<Rgba8>(2, 2, {255, 255, 255, 128}), true));
        Mesh mesh{"cut", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, {}};
        mesh.parts = {{0, 1, builder.AddMaterial(material), kNoEntity}};
        mesh.colors = {MakeVertexColor({1, 1, 1}, 0), MakeVertexColor({1, 1, 1}, 0.5f), MakeVertexColor({1, 1, 1}, 1)};
        builder.AddInstance({builder.AddMesh(mesh), {}, builder.AddEntity("leaf", builder.tree().At("vegetation"))});
        const RayTracer tracer(builder.Build(), {.isa = {}, .sort_alpha = sort});
        RngStream rng(5, "cut");
        int seen = 0;
        for (int i = 0; i < 2000; ++i) {
          const auto u = static_cast<float>(rng.Uniform(0.01, 0.98)),
                     v = static_cast<float>(rng.Uniform(0.01, 0.99 - static_cast<double>(u)));
          const float alpha = (0.5f * u + v) * (picture ? 128.0f / 255 : 1.0f);
          if (std::fabs(alpha - cutoff) < 1e-4f) continue;
          const bool hit = tracer.Intersect({u, v, 1}, {0, 0, -1}).has_value();
          ASSERT_EQ(hit, alpha > cutoff) << u << ' ' << v << ' ' << cutoff << picture << sort;
          seen += hit;
        }
        EXPECT_EQ(seen > 0, !picture || cutoff < 0.5f);
      }
    }
  }
}

// The alpha of vertices says nothing where the material is opaque.
TEST(AlphaTest, OpaqueMaterialsIgnoreCoverage) {
  SceneBuilder builder("solid");
  Mesh mesh{"solid", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, {}};
  mesh.parts = {{0, 1, builder.AddMaterial({}), kNoEntity}};
  mesh.colors.assign(3, MakeVertexColor({1, 1, 1}, 0));
  builder.AddInstance({builder.AddMesh(mesh), {}, builder.AddEntity("leaf", builder.tree().At("vegetation"))});
  EXPECT_TRUE(RayTracer(builder.Build()).Intersect({0.25f, 0.25f, 1}, {0, 0, -1}).has_value());
}

}  // namespace
}  // namespace airsim360
