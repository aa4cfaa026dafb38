#include "airsim360/render/high/high_shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/shading/sun_map.h"

namespace airsim360::internal {
namespace {

// Rows of 16 pixels, phases as in the renderer.
TileLayout Layout() {
  TileLayout layout{};
  for (int k = 0; k < 256; ++k) {
    const int x = k % 16, y = k / 16;
    const int phase = (x + 4 * y + (y >> 2)) & 15;
    layout.slot_of[k] = layout.pixel_of[k] = static_cast<uint8_t>(k);
    layout.phase[k] = static_cast<uint8_t>(phase);
    layout.members[phase][y] = static_cast<uint8_t>(k);
  }
  return layout;
}

struct World {
  SceneBuilder builder{"test"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<const Shader> shader;
  std::unique_ptr<const SunMap> sun_map;

  explicit World(double sun_elevation_deg = 90) {
    builder.AddSky();
    builder.environment().cloud_cover = builder.environment().cirrus_cover = 0;
    builder.environment().sun_elevation_deg = sun_elevation_deg;
  }
  void AddQuad(Vec3f a, Vec3f b, Vec3f c, Vec3f d, float albedo) {
    Material material;
    material.base_color = {albedo, albedo, albedo};
    material.roughness = 1;
    Mesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.parts = {{0, 2, builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(mesh), AffineTransform(), entity, {1, 1, 1}});
  }
  void AddGround(float albedo) { AddQuad({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, albedo); }
  void Build() {
    tracer = std::make_shared<const RayTracer>(builder.Build());
    shader = std::make_unique<const Shader>(tracer, tracer->scene().environment);
    sun_map = std::make_unique<const SunMap>(*tracer, shader->impl().sky->to_sun(), 256);
  }
  // The tile of 16 x 16 rays from `eye` to points `step` apart on the ground around `target`.
  void Shade(Vec3f eye, Vec3f target, float step, float ambient_rays, uint32_t seed, HighTile& tile, uint32_t place = 0) const {
    static const TileLayout layout = Layout();
    HitBatch hits{};
    hits.origin = eye;
    hits.count = 256;
    hits.cone_angle = step / Norm(target - eye);
    for (int k = 0; k < 256; ++k) {
      const Vec3f p = target + Vec3f{(static_cast<float>(k % 16) - 7.5f) * step, (static_cast<float>(k / 16) - 7.5f) * step, 0};
      const Vec3f d = Normalized(p - eye);
      hits.direction_x[k] = d.x, hits.direction_y[k] = d.y, hits.direction_z[k] = d.z;
      const auto hit = tracer->Intersect(eye, d);
      hits.instance[k] = hit ? hit->surface.instance : kMiss;
      hits.triangle[k] = hit ? hit->surface.triangle : 0;
      hits.distance[k] = hit ? hit->distance : 0;
      hits.u[k] = hit ? hit->u : 0, hits.v[k] = hit ? hit->v : 0;
    }
    const TileSampling sampling{&layout, seed, place, ambient_rays, hits.cone_angle};
    LightTerms terms;
    ShadeHigh(*shader, sun_map->view(), hits, &sampling, nullptr, terms, tile);
  }
  // Irradiance on the ground, green, of the directions that are open: midpoint rule.
  float SkyIrradiance(const std::function<bool(Vec3f)>& open) const {
    constexpr int kRows = 200, kColumns = 800;
    double sum = 0;
    for (int i = 0; i < kRows; ++i) {
      for (int k = 0; k < kColumns; ++k) {
        // Even in the square of the cosine: every cell brings the same share of pi.
        const double z = std::sqrt((i + 0.5) / kRows), a = 2 * std::numbers::pi * (k + 0.5) / kColumns;
        const double s = std::sqrt(1 - z * z);
        const Vec3f d{static_cast<float>(s * std::cos(a)), static_cast<float>(s * std::sin(a)), static_cast<float>(z)};
        if (open(d)) sum += shader->impl().sky->blurred(0).At(d).y;
      }
    }
    return static_cast<float>(sum * kPiF / (kRows * kColumns));
  }
};

float MeanLight(const HighTile& tile) {
  double sum = 0;
  for (int k = 0; k < 256; ++k) sum += tile.light_g[k];
  return static_cast<float>(sum / 256);
}

TEST(Sampling, SobolPointsAreStratifiedWhateverTheSeed) {
  for (const uint32_t seed : {0u, 1u, 0xdeadbeefu}) {
    for (uint32_t first = 0; first < 256; first += 16) {
      for (int columns = 1; columns <= 16; columns *= 2) {
        uint32_t seen = 0;
        for (uint32_t i = 0; i < 16; ++i) {
          const Vec2f p = SobolPoint(first + i, seed);
          seen |= 1u << (static_cast<int>(p.x * static_cast<float>(columns)) * (16 / columns) +
                         static_cast<int>(p.y * static_cast<float>(16 / columns)));
        }
        EXPECT_EQ(seen, 0xffffu) << "one point in each cell of " << columns << " columns";
      }
    }
  }
}

TEST(Sampling, SpherePointsPlusANormalAreSpreadAsTheCosine) {
  double mean = 0, square = 0;
  constexpr int kCount = 4096;
  for (uint32_t i = 0; i < kCount; ++i) {
    const Vec3f d = Normalized(SpherePoint(SobolPoint(i, 7)) + Vec3f{0, 0, 1});
    mean += d.z / kCount, square += d.z * d.z / kCount;
  }
  EXPECT_NEAR(mean, 2.0 / 3, 1e-3);
  EXPECT_NEAR(square, 0.5, 1e-3);
}

TEST(HighShading, OpenGroundGetsTheIntegralOfTheSky) {
  World world(40);
  world.AddGround(0.3f);
  world.Build();
  HighTile tile;
  world.Shade({0, 0, 3}, {0, 0, 0}, 0.05f, 16, 3, tile);
  const float truth = world.SkyIrradiance([](Vec3f) { return true; });
  EXPECT_NEAR(MeanLight(tile) / truth, 1, 0.01);
}

TEST(HighShading, GroundAtABlackWallGetsTheSkyThatTheWallLeaves) {
  World world(40);
  world.AddGround(0);
  // A wall that cannot be seen around, 2 m high, in the plane x = 0.
  world.AddQuad({0, -5000, 0}, {0, 5000, 0}, {0, 5000, 2}, {0, -5000, 2}, 0);
  world.Build();
  for (const float x : {0.1f, 0.5f, 2.0f, 6.0f}) {
    constexpr uint32_t kSeeds = 8;
    float mean = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      HighTile tile;
      world.Shade({x, 0, 1.5f}, {x, 0, 0}, 1e-4f, 16, seed, tile);
      mean += MeanLight(tile) / kSeeds;
    }
    const float truth = world.SkyIrradiance([x](Vec3f d) { return d.x >= 0 || d.z / -d.x > 2 / x; });
    EXPECT_NEAR(mean / truth, 1, 0.01) << x << " m from the wall";
  }
}

TEST(HighShading, FractionsOfARayLookAllAroundInEveryTile) {
  World world(40);
  world.builder.environment().cloud_cover = 1;
  world.AddGround(0);
  world.AddQuad({-1, -5000, 0}, {-1, 5000, 0}, {-1, 5000, 2}, {-1, -5000, 2}, 0);
  world.Build();
  const float truth = world.SkyIrradiance([](Vec3f d) { return d.x >= 0 || d.z / -d.x > 2; });
  for (const float rays : {1.0f, 1.06f, 1.25f, 1.6f, 2.1f, 3.3f, 4.0f}) {
    constexpr uint32_t kSeeds = 16;
    float square = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      HighTile tile;
      world.Shade({0, 0, 1.5f}, {0, 0, 0}, 1e-4f, rays, seed, tile, seed % 16);
      float sum = 0, count = 0;
      for (int k = 0; k < 256; ++k) {
        sum += tile.light_g[k] * tile.light_samples[k];
        count += tile.light_samples[k];
      }
      // One or more rounds of them.
      const float rounds = std::round(count / 256 / rays);
      EXPECT_NEAR(count / 256, rounds * rays, rounds / 16);
      const float error = sum / count / truth - 1;
      square += error * error / kSeeds;
    }
    EXPECT_LT(std::sqrt(square), 0.14f) << rays << " rays";
  }
}

TEST(HighShading, ATileThatKnowsItsLightBadlySendsMoreRays) {
  // A black box with a small hole in its lid, which four or five of the 64 directions of a tile with four rays a pixel meet.
  World world(40);
  world.builder.environment().cloud_cover = 1;
  world.AddGround(0);
  for (const auto& [a, b, c, d] : std::vector<std::array<Vec3f, 4>>{{{{-3, -3, 2}, {0.4f, -3, 2}, {0.4f, 3, 2}, {-3, 3, 2}}},
                                                                    {{{1.6f, -3, 2}, {3, -3, 2}, {3, 3, 2}, {1.6f, 3, 2}}},
                                                                    {{{0.4f, -3, 2}, {1.6f, -3, 2}, {1.6f, -0.6f, 2}, {0.4f, -0.6f, 2}}},
                                                                    {{{0.4f, 0.6f, 2}, {1.6f, 0.6f, 2}, {1.6f, 3, 2}, {0.4f, 3, 2}}},
                                                                    {{{-3, -3, 0}, {3, -3, 0}, {3, -3, 2}, {-3, -3, 2}}},
                                                                    {{{-3, 3, 0}, {3, 3, 0}, {3, 3, 2}, {-3, 3, 2}}},
                                                                    {{{-3, -3, 0}, {-3, 3, 0}, {-3, 3, 2}, {-3, -3, 2}}},
                                                                    {{{3, -3, 0}, {3, 3, 0}, {3, 3, 2}, {3, -3, 2}}}})
    world.AddQuad(a, b, c, d, 0);
  world.Build();
  const float truth = world.SkyIrradiance([](Vec3f d) {
    const float x = 2 * d.x / d.z, y = 2 * d.y / d.z;
    return x > 0.4f && x < 1.6f && std::abs(y) < 0.6f;
  });
  constexpr uint32_t kSeeds = 64;
  double mean = 0, square = 0, rays = 0;
  for (uint32_t seed = 0; seed < kSeeds; ++seed) {
    HighTile tile;
    world.Shade({0, 0, 1.5f}, {0, 0, 0}, 1e-4f, 4, seed, tile, seed % 16);
    const double light = MeanLight(tile) / truth;
    mean += light / kSeeds, square += (light - 1) * (light - 1) / kSeeds;
    for (int k = 0; k < 256; ++k) rays += tile.light_samples[k] / (256.0 * kSeeds);
  }
  std::printf("%.2f rays a pixel, mean %.3f, rms %.3f\n", rays, mean, std::sqrt(square));
  EXPECT_GT(rays, 12);
  EXPECT_NEAR(mean, 1, 0.03);
  EXPECT_LT(std::sqrt(square), 0.12);
}

TEST(HighShading, AWhiteWallGivesBackWhatItsSunAndProbesSay) {
  // Ground beside a sunlit wall is brighter than under the open sky, beside a dark one darker.
  float light[2];
  for (const bool white : {false, true}) {
    World world(30);
    world.builder.environment().sun_azimuth_deg = 90;  // in the east, +x
    world.AddGround(0.3f);
    world.AddQuad({0, -50, 0}, {0, 50, 0}, {0, 50, 8}, {0, -50, 8}, white ? 0.8f : 0.0f);
    world.Build();
    HighTile tile;
    world.Shade({1, 0, 1.5f}, {1, 0, 0}, 1e-3f, 16, 3, tile);
    const float open = world.SkyIrradiance([](Vec3f) { return true; });
    light[white] = MeanLight(tile) / open;
  }
  EXPECT_LT(light[0], 0.8f);
  EXPECT_GT(light[1], 1.2f);
}

TEST(HighShading, APenumbraIsAsWideAsTheSunsDiscMakesIt) {
  // A half plane 10 m up under the sun at the zenith: the light on the ground runs over 93 mm.
  constexpr float kHeight = 10, kStep = 0.012f;
  World world(90);
  world.AddGround(0.3f);
  world.AddQuad({-40, -40, kHeight}, {0, -40, kHeight}, {0, 40, kHeight}, {-40, 40, kHeight}, 0.3f);
  world.Build();
  double seen[16] = {};
  for (uint32_t seed = 0; seed < 8; ++seed) {
    HighTile tile;
    world.Shade({0, 0, 1.5f}, {0, 0, 0}, kStep, 1, seed, tile);
    for (int k = 0; k < 256; ++k) seen[k % 16] += tile.sun_seen[k] / (16.0 * 8);
  }
  EXPECT_LT(seen[0], 0.01);
  EXPECT_GT(seen[15], 0.99);
  // Spread of the edge: a disc of radius R gives R / 2, a pixel a twelfth of its square.
  double mean = 0, square = 0;
  for (int i = 1; i < 16; ++i) {
    const double x = (i - 8) * kStep, share = seen[i] - seen[i - 1];
    mean += x * share, square += x * x * share;
  }
  const double radius = 0.5 * 0.0093 * kHeight;
  const double truth = std::sqrt(radius * radius / 4 + kStep * kStep / 6);
  EXPECT_NEAR(std::sqrt(square - mean * mean) / truth, 1, 0.1);
  EXPECT_NEAR(mean, 0, 0.005);
}

TEST(SunMap, KnowsWhatTheRayTracerKnows) {
  World world(35);
  world.AddGround(0.3f);
  world.AddQuad({-6, -6, 4}, {6, -6, 4}, {6, 6, 4}, {-6, 6, 4}, 0.3f);
  world.Build();
  const Vec3f to_sun = world.shader->impl().sky->to_sun();
  int wrong = 0, count = 0;
  for (float y = -20; y < 20; y += 0.37f) {
    for (float x = -20; x < 20; x += 0.41f) {
      const Vec3f p{x, y, 0.01f};
      wrong += world.sun_map->Sunlit(p) == world.tracer->Occluded(p, p + to_sun * 200.0f);
      ++count;
    }
  }
  EXPECT_LT(wrong, count / 25) << "texels at the edge of the shadow";
}

}  // namespace
}  // namespace airsim360::internal
