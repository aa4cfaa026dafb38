#include "airsim360/render/lights/light_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

// Rectangle a, a + e, a + e + f, a + f; faces along e x f.
Mesh Rectangle(Vec3f a, Vec3f e, Vec3f f) {
  Mesh mesh;
  mesh.positions = {a, a + e, a + e + f, a + f};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

struct TableWorld {
  SceneBuilder builder{"lamps"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<LightTable> lights;

  MaterialId Emitter(Vec3f emission, bool lamp = false) {
    Material material;
    material.emission = emission;
    material.lamp = lamp;
    return builder.AddMaterial(material);
  }
  void Add(Mesh mesh, MaterialId material, AffineTransform X = {}) {
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), material, kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), X, entity});
  }
  void Build(Lamps lamps = Lamps::kOn) {
    scene = builder.Build();
    Environment environment = scene->environment;
    environment.lamps = lamps;
    tables = std::make_unique<SurfaceTables>(*scene);
    lights = std::make_unique<LightTable>(*scene, *tables, environment);
  }
};

Vec3f Random(RngStream& r) { return {static_cast<float>(r.Uniform()), static_cast<float>(r.Uniform()), static_cast<float>(r.Uniform())}; }
Vec3f Direction(RngStream& r) {
  const double z = r.Uniform(-1, 1), a = r.Uniform(0, 2 * kPiF), s = std::sqrt(1 - z * z);
  return {static_cast<float>(s * std::cos(a)), static_cast<float>(s * std::sin(a)), static_cast<float>(z)};
}

// Irradiance that one sample stands for.
float Contribution(const LightSample& s, Vec3f p, Vec3f n) {
  if (!(s.pdf > 0)) return 0;
  const Vec3f to = s.p - p;
  const float d2 = Dot(to, to), d = std::sqrt(d2);
  return s.radiance.y * std::max(0.0f, Dot(n, to) / d) * std::max(0.0f, -Dot(s.normal, to) / d) / d2 / s.pdf;
}

// Rectangles of random place, direction, size and light.
void AddRandomLamps(TableWorld& world, int count, uint64_t seed) {
  RngStream r(seed, "lamps");
  for (int i = 0; i < count; ++i) {
    const Vec3f n = Direction(r), e = Normalized(Cross(n, Direction(r)));
    const auto size = static_cast<float>(r.Uniform(0.05, 0.5));
    const auto light = static_cast<float>(std::exp(r.Uniform(-2, 3)));
    world.Add(Rectangle((Random(r) - Vec3f{0.5f, 0.5f, 0.5f}) * 40, e * size, Cross(n, e) * size), world.Emitter({light, light, light}));
  }
}

TEST(LightTable, ConnectedTrianglesAreOneLampWithItsPowerAndFacing) {
  TableWorld world;
  Mesh two = Rectangle({0, 0, 3}, {0, 1, 0}, {2, 0, 0});  // faces down
  const Mesh other = Rectangle({5, 0, 3}, {1, 0, 0}, {0, 1, 0});
  for (Vec3f p : other.positions) two.positions.push_back(p);
  two.triangles.push_back({4, 5, 6});
  two.triangles.push_back({4, 6, 7});
  world.Add(two, world.Emitter({1, 2, 3}), {Mat3f::FromColumns({2, 0, 0}, {0, 2, 0}, {0, 0, 2}), {10, 0, 0}});
  world.Build();
  ASSERT_EQ(world.lights->size(), 2u);
  const Lamp& down = world.lights->lamps()[0];
  EXPECT_NEAR(down.area, 8, 1e-4);
  EXPECT_NEAR(down.power.z, kPiF * 3 * 8, 1e-3);
  EXPECT_NEAR(down.facing.z, -8, 1e-4);
  EXPECT_NEAR(down.spread, 0, 1e-3);
  EXPECT_NEAR(Norm(down.center - Vec3f{12, 1, 6}), 0, 1e-4);
  EXPECT_NEAR(down.radius, std::sqrt(5.0f), 1e-4);
  EXPECT_EQ(world.lights->LampOf(0, 1), 0u);
  EXPECT_EQ(world.lights->LampOf(0, 2), 1u);
}

TEST(LightTable, LampMaterialsShineOnlyWhileLampsAreOn) {
  for (const Lamps lamps : {Lamps::kOn, Lamps::kOff, Lamps::kAuto}) {
    TableWorld world;
    world.Add(Rectangle({0, 0, 3}, {1, 0, 0}, {0, 1, 0}), world.Emitter({1, 1, 1}, true));
    world.Add(Rectangle({0, 5, 3}, {1, 0, 0}, {0, 1, 0}), world.Emitter({1, 1, 1}, false));
    world.Add(Rectangle({0, 9, 3}, {1, 0, 0}, {0, 1, 0}), world.Emitter({0, 0, 0}, false));
    world.Build(lamps);  // the sun of the default environment is high: auto is off
    EXPECT_EQ(world.lights->size(), lamps == Lamps::kOn ? 2u : 1u);
  }
}

TEST(LightTable, WithoutLampsNothingIsChosen) {
  TableWorld world;
  world.Add(Rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), world.Emitter({0, 0, 0}));
  world.Build();
  EXPECT_TRUE(world.lights->empty());
  EXPECT_EQ(world.lights->Sample({0, 0, 1}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}).pdf, 0);
  EXPECT_EQ(world.lights->Pdf({0, 0, 1}, {0, 0, 1}, 0, 0), 0);
}

TEST(LightTable, ARectangleGivesItsAnalyticFormFactor) {
  // Parallel, centred over the point: four corners of the classic configuration factor.
  TableWorld world;
  const float a = 1.5f, b = 1.0f, h = 2.0f;
  world.Add(Rectangle({-a, -b, h}, {0, 2 * b, 0}, {2 * a, 0, 0}), world.Emitter({1, 1, 1}));
  world.Build();
  const float x = a / h, y = b / h;
  const float corner =
      (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) + y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
      (2 * kPiF);
  RngStream r(1, "rectangle");
  double sum = 0;
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) sum += Contribution(world.lights->Sample({0, 0, 0}, {0, 0, 1}, Random(r)), {0, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(sum / kSamples / (kPiF * 4 * corner), 1, 0.005);
}

TEST(LightTable, LightShinesToTheFrontOnlyAlsoWhereTheInstanceMirrors) {
  for (const float side : {1.0f, -1.0f}) {
    TableWorld world;
    world.Add(Rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), world.Emitter({1, 1, 1}),
              {Mat3f::FromColumns({side, 0, 0}, {0, 1, 0}, {0, 0, 1}), {}});
    world.Build();
    EXPECT_NEAR(world.lights->lamps()[0].axis.z, 1, 1e-5);
    EXPECT_GT(world.lights->Pdf({0, 0, 2}, {0, 0, -1}, 0, 0), 0);
    EXPECT_EQ(world.lights->Pdf({0, 0, -2}, {0, 0, 1}, 0, 0), 0);
  }
}

TEST(LightTable, SampledAndQueriedDensitiesAgreeAndFrequenciesMatchThem) {
  TableWorld world;
  AddRandomLamps(world, 60, 5);
  world.Build();
  RngStream r(2, "points");
  for (int point = 0; point < 4; ++point) {
    const Vec3f p = (Random(r) - Vec3f{0.5f, 0.5f, 0.5f}) * 30;
    const Vec3f n = point == 3 ? Vec3f{} : Direction(r);

    // Expected counts of every lamp from the densities of its triangles.
    constexpr int kSamples = 40000;
    std::map<uint32_t, double> expected;
    double total = 0;
    for (uint32_t i = 0; i < world.lights->size(); ++i) {
      const double share = world.lights->Pdf(p, n, i, 0) * world.lights->lamps()[i].area;
      expected[i] = share * kSamples;
      total += share;
    }
    EXPECT_LE(total, 1 + 1e-4);
    std::map<uint32_t, int> counted;
    int none = 0;
    for (int k = 0; k < kSamples; ++k) {
      const LightSample s = world.lights->Sample(p, n, Random(r));
      if (s.pdf == 0) {
        ++none;
        continue;
      }
      // The lamp that holds the point.
      uint32_t nearest = 0;
      for (uint32_t i = 1; i < world.lights->size(); ++i) {
        if (Norm(world.lights->lamps()[i].center - s.p) < Norm(world.lights->lamps()[nearest].center - s.p)) nearest = i;
      }
      ++counted[nearest];
      ASSERT_NEAR(s.pdf / world.lights->Pdf(p, n, nearest, 0), 1, 1e-4);
    }
    double chi = std::pow(none - (1 - total) * kSamples, 2) / std::max(5.0, (1 - total) * kSamples);
    int cells = 1;
    for (const auto& [lamp, count] : expected) {
      if (count < 5) continue;
      chi += std::pow(counted[lamp] - count, 2) / count;
      ++cells;
    }
    // 99.9 % quantile of chi-square, Wilson-Hilferty.
    const double k = cells, limit = k * std::pow(1 - 2 / (9 * k) + 3.09 * std::sqrt(2 / (9 * k)), 3);
    EXPECT_LT(chi, limit) << point;
  }
}

TEST(LightTable, TheEstimateEqualsTheSumOverAllLamps) {
  TableWorld world;
  AddRandomLamps(world, 10000, 7);
  world.Build();
  ASSERT_EQ(world.lights->size(), 10000u);
  RngStream r(3, "sum");
  for (int point = 0; point < 3; ++point) {
    const Vec3f p = (Random(r) - Vec3f{0.5f, 0.5f, 0.5f}) * 36, n = Direction(r);
    // Every lamp by a fine grid of points.
    double sum = 0;
    for (uint32_t i = 0; i < world.lights->size(); ++i) {
      const Mesh& mesh = world.scene->meshes[world.scene->instances[i].mesh];
      const Vec3f a = mesh.positions[0], e = mesh.positions[1] - a, f = mesh.positions[3] - a;
      const Vec3f normal = Normalized(Cross(e, f));
      constexpr int kGrid = 4;
      for (int k = 0; k < kGrid * kGrid; ++k) {
        const float s = (static_cast<float>(k % kGrid) + 0.5f) / kGrid, t = (static_cast<float>(k / kGrid) + 0.5f) / kGrid;
        const LightSample at{a + e * s + f * t, normal, world.scene->materials[i].emission, kGrid * kGrid / world.lights->lamps()[i].area,
                             0};
        sum += Contribution(at, p, n);
      }
    }
    double estimate = 0, square = 0;
    constexpr int kSamples = 60000;
    for (int k = 0; k < kSamples; ++k) {
      const double x = Contribution(world.lights->Sample(p, n, Random(r)), p, n);
      estimate += x / kSamples;
      square += x * x / kSamples;
    }
    const double sigma = std::sqrt((square - estimate * estimate) / kSamples);
    EXPECT_NEAR(estimate, sum, 3.5 * sigma + 0.002 * sum) << point;
    // The tree must help: choosing evenly among 10,000 lamps has a relative deviation of about 100.
    EXPECT_LT(std::sqrt(square - estimate * estimate) / estimate, 10) << point;
  }
}

// Angles and their cosines choose alike, and one walk through the tree chooses as many single ones do.
TEST(LightTable, ChoicesMadeTogetherAreThoseMadeOneByOne) {
  TableWorld world;
  RngStream rng(3, "choices");
  for (int k = 0; k < 60; ++k) {
    const Vec3f at = Random(rng) * 8, e = Direction(rng) * 0.3f, f = Direction(rng) * 0.3f;
    world.Add(Rectangle(at, e, f), world.Emitter(Vec3f{1, 1, 1} * static_cast<float>(rng.Uniform(1, 50))));
  }
  world.Build();
  const LightTree& tree = world.lights->tree();
  int other = 0, none = 0, all = 0;
  for (int place = 0; place < 200; ++place) {
    const Vec3f p = Random(rng) * 10 - Vec3f{1, 1, 1}, n = place % 10 == 0 ? Vec3f{} : Direction(rng);
    std::vector<float> u;
    for (int k = 0; k < 40; ++k) u.push_back((static_cast<float>(k) + static_cast<float>(rng.Uniform())) / 40);
    std::vector<LightTree::Choice> together(u.size());
    tree.ChooseAll(p, n, u, together);
    for (size_t k = 0; k < u.size(); ++k, ++all) {
      const LightTree::Choice alone = tree.Choose(p, n, u[k]);
      none += alone.probability == 0;
      if (alone.lamp != together[k].lamp || alone.probability == 0) {
        other += alone.lamp != together[k].lamp;
        continue;
      }
      ASSERT_NEAR(together[k].probability, alone.probability, 2e-3f * alone.probability);
      ASSERT_GE(together[k].u, 0);
      ASSERT_LT(together[k].u, 1);
    }
  }
  EXPECT_LT(other, all / 200);
  EXPECT_LT(none, all / 2);
}

TEST(LightTable, EmissionTexturesAreSeenInSamplesAndInPower) {
  TableWorld world;
  Image<Rgba8> picture(2, 1);
  picture(0, 0) = {255, 255, 255, 255};
  picture(1, 0) = {0, 0, 0, 255};
  Texture texture = Texture::FromImage("half", picture, false);
  texture.wrap_u = Wrap::kClamp;
  Material material;
  material.emission = {2, 2, 2};
  material.emission_texture = world.builder.AddTexture(texture);
  Mesh mesh = Rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  world.Add(mesh, world.builder.AddMaterial(material));
  world.Build();
  RngStream r(4, "texture");
  double sum = 0;
  constexpr int kSamples = 20000;
  for (int k = 0; k < kSamples; ++k) {
    const LightSample s = world.lights->Sample({0.5f, 0.5f, 3}, {0, 0, -1}, Random(r));
    ASSERT_GT(s.pdf, 0);
    if (s.p.x < 0.25f || s.p.x > 0.75f) {
      EXPECT_NEAR(s.radiance.x, s.p.x < 0.5f ? 2 : 0, 1e-5);
    }
    sum += s.radiance.x / kSamples;
  }
  EXPECT_NEAR(sum, 1, 0.02);
  EXPECT_NEAR(world.lights->lamps()[0].power.x, kPiF, 0.02);
}

}  // namespace
}  // namespace airsim360::internal
