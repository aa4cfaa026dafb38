#include "airsim360/render/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/reference/path_lights.h"
#include "airsim360/render/reference/test_statistics.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/sky.h"

namespace airsim360 {
namespace {

using internal::CameraRays;
using internal::PathTracerOptions;
using internal::TracePaths;
namespace scalar = internal::scalar;

struct Traced {
  Image<Rgb32f> mean, variance;
};

struct World {
  SceneBuilder builder{"test"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<const Shader> shader;

  void Add(Mesh mesh, const Material& material) {
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), entity});
  }
  // A clear sky with the sun at this elevation, due south.
  void AddSky(double sun_elevation_deg) {
    builder.AddSky();
    builder.environment().cloud_cover = builder.environment().cirrus_cover = 0;
    builder.environment().moon_elevation_deg = -30;
    builder.environment().sun_azimuth_deg = 180;
    builder.environment().sun_elevation_deg = sun_elevation_deg;
  }
  void Build() { Use(builder.Build()); }
  void Use(std::shared_ptr<const Scene> scene) {
    tracer = std::make_shared<const RayTracer>(std::move(scene));
    shader = std::make_unique<const Shader>(tracer, tracer->scene().environment);
  }
  Traced Trace(const Camera& camera, Vec3f from, const PathTracerOptions& options, const Mat3d& R_WC = Mat3d()) const {
    CameraRays rays;
    rays.Update(camera, R_WC);
    Traced traced;
    TracePaths(*tracer, *shader, rays, from, options, traced.mean, &traced.variance);
    return traced;
  }
};

// An upright quadrangle a, b, c, d seen counter-clockwise.
Mesh Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) { return {"quad", {a, b, c, d}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}}; }
Mesh Ground(float half, float z = 0) { return Quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}); }
// The six sides of [-half, half]^3 about a point, seen from outside or, as a room, from inside.
Mesh Box(float half, Vec3f center = {}, bool room = false) {
  constexpr uint32_t kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(center + Vec3f{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  for (const auto& q : kQuads) {
    const int second = room ? 3 : 1, last = room ? 1 : 3;
    mesh.triangles.push_back({q[0], q[second], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[last]});
  }
  return mesh;
}
Material Matte(float albedo) {
  Material material;
  material.base_color = {albedo, albedo, albedo};
  material.roughness = 1;
  return material;
}

const Mat3d kLookDown = Mat3d::FromColumns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});

double MeanOf(const Image<Rgb32f>& image) {
  double sum = 0;
  for (const Rgb32f& p : image.pixels()) sum += p.g;
  return sum / static_cast<double>(image.pixels().size());
}

// Reflectance of a matte surface for light from everywhere.
double Albedo(float base, float cosine) {
  const auto b = scalar::bsdf_make(0, {base, base, base}, 0, 1, 0, 0, 0.03f);
  const auto seen = scalar::bsdf_side(b, cosine);
  return (scalar::bsdf_reflected(seen) + b.body * scalar::bsdf_entering(seen)).y;
}

TEST(PathTracer, WhiteRoomThatGlowsAddsItsLightAtEveryBounceWithinOnePerCent) {
  World world;
  Material glowing = Matte(1);
  glowing.emission = {0.5f, 0.5f, 0.5f};
  world.Add(Box(2, {}, true), glowing);
  world.Build();
  for (int bounces : {0, 1, 3, 6}) {
    const Traced t = world.Trace(Equirectangular{32, 16}, {0.3f, -0.2f, 0.5f}, {.samples = 32, .max_bounces = bounces});
    EXPECT_NEAR(MeanOf(t.mean), 0.5 * (bounces + 1), 0.005 * (bounces + 1)) << bounces;
  }
}

TEST(PathTracer, GreyRoomThatGlowsShowsTheSeriesOfItsAlbedo) {
  World world;
  Material glowing = Matte(0.5f);
  glowing.emission = {1, 1, 1};
  world.Add(Box(2, {}, true), glowing);
  world.Build();
  double mean_albedo = 0;
  for (int i = 0; i < 1000; ++i) {
    const double mu = (i + 0.5) / 1000;
    mean_albedo += 2 * mu * Albedo(0.5f, static_cast<float>(mu)) / 1000;
  }
  // From the middle of the cube a pixel's cosine is its direction's largest coordinate.
  const Traced t = world.Trace(Equirectangular{32, 16}, {}, {.samples = 64, .max_bounces = 24});
  double expected = 0, count = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x, ++count) {
      const Vec3d d = *PixelToRay(Equirectangular{32, 16}, {x + 0.5, y + 0.5});
      const double cosine = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      expected += 1 + Albedo(0.5f, static_cast<float>(cosine)) / (1 - mean_albedo);
    }
  }
  EXPECT_NEAR(MeanOf(t.mean) / (expected / count), 1, 0.01);
}

TEST(PathTracer, OpenGroundHasTheLightOfSunAndSkyByIntegration) {
  World world;
  world.AddSky(40);
  world.Add(Ground(50), Matte(0.4f));
  world.Build();
  const internal::Sky& sky = *world.shader->impl().sky;
  const auto b = scalar::bsdf_make(0, {0.4f, 0.4f, 0.4f}, 0, 1, 0, 0, 0.03f);
  const auto seen = scalar::bsdf_side(b, 1);
  const auto lobes = scalar::bsdf_lobes(b, seen);
  const auto f = [&](Vec3f l) {
    float pdf = 0;
    return scalar::bsdf_evaluate(b, seen, lobes, {0, 0, 1}, {0, 0, 1}, l, pdf);
  };
  Vec3f expected = sky.sun_irradiance() * f(sky.to_sun());
  constexpr int kCells = 400;
  for (int i = 0; i < kCells * kCells; ++i) {
    const float z = (static_cast<float>(i / kCells) + 0.5f) / kCells, s = std::sqrt(1 - z * z);
    const float a = (static_cast<float>(i % kCells) + 0.5f) / kCells * static_cast<float>(2 * kPi);
    const Vec3f l{s * std::cos(a), s * std::sin(a), z};
    expected += sky.Radiance(l) * f(l) * static_cast<float>(2 * kPi / (kCells * kCells));
  }
  const Traced t = world.Trace(Pinhole{8, 8, 200, 200, 4, 4}, {0, 0, 1}, {.samples = 256}, kLookDown);
  EXPECT_NEAR(MeanOf(t.mean) / expected.y, 1, 0.01);
}

TEST(PathTracer, PenumbraIsAsWideAsTheSunSaysTimesTheDistance) {
  // A roof with a straight edge along x = 0, the sun in the zenith; the camera is under the roof's level.
  constexpr double kHeight = 40;
  World world;
  world.AddSky(90);
  world.Add(Ground(50), Matte(0.4f));
  world.Add(Quad({0, -500, kHeight}, {500, -500, kHeight}, {500, 500, kHeight}, {0, 500, kHeight}), Matte(0));
  world.Build();
  // One metre of ground over 64 columns.
  constexpr int kColumns = 64, kRows = 8;
  const Traced t =
      world.Trace(Pinhole{kColumns, kRows, 128, 128, kColumns / 2, kRows / 2}, {0, 0, 2}, {.samples = 256, .max_bounces = 1}, kLookDown);
  std::vector<double> profile(kColumns);
  for (int x = 0; x < kColumns; ++x)
    for (int y = 0; y < kRows; ++y) profile[x] += t.mean(x, y).g;
  const double lit = profile[2], dark = profile[kColumns - 3];
  const auto crossing = [&](double level) {
    for (int x = 1; x < kColumns; ++x) {
      const double a = (profile[x - 1] - dark) / (lit - dark), b = (profile[x] - dark) / (lit - dark);
      if (a >= level && b < level) return (x - 0.5 + (a - level) / (a - b)) / kColumns;
    }
    return 0.0;
  };
  // The same of a disc of 0.53 degrees that darkens towards its limb, cut by a line.
  std::vector<double> strips(2000);
  for (int i = 0; i < 2000; ++i) {
    const double x = (i + 0.5) / 1000 - 1;
    for (int k = 0; k < 500; ++k) {
      const double y = (k + 0.5) / 500, r2 = x * x + y * y;
      if (r2 < 1) strips[i] += 0.4 + 0.6 * std::sqrt(1 - r2);
    }
  }
  double total = 0, part = 0, low = 0, high = 0;
  for (double s : strips) total += s;
  for (int i = 0; i < 2000; ++i) {
    if (part < 0.1 * total) low = i / 1000.0;
    if (part < 0.9 * total) high = i / 1000.0;
    part += strips[i];
  }
  const double disc = 0.0093;  // its angle
  EXPECT_NEAR((crossing(0.1) - crossing(0.9)) / ((high - low) / 2 * disc * kHeight), 1, 0.04);
}

// Things of every kind on a square; the sun has set, so that light can be found by chance.
World MakeDusk() {
  World world;
  world.AddSky(-1.5);
  world.Add(Ground(8), Matte(0.5f));
  Material car = Matte(0.3f), leaf = Matte(0.3f), pane = Matte(0.9f), metal = Matte(0.8f), water = Matte(0.05f);
  car.clear_coat = 1, car.clear_coat_roughness = 0.3f, car.roughness = 0.5f;
  leaf.kind = SurfaceKind::kFoliage, leaf.transmission = 0.8f, leaf.roughness = 0.5f;
  pane.kind = SurfaceKind::kGlass, pane.transmission = 0.9f, pane.roughness = 0.08f;
  metal.metallic = 1, metal.roughness = 0.35f;
  water.kind = SurfaceKind::kWater;
  world.Add(Box(0.7f, {2, 0, 0.8f}), car);
  world.Add(Box(0.7f, {-2, 0.5f, 0.8f}), metal);
  world.Add(Box(0.7f, {0.2f, 2, 0.8f}), pane);
  world.Add(Quad({-1, -2, 0.2f}, {1, -2, 0.2f}, {1, -2.5f, 1.6f}, {-1, -2.5f, 1.6f}), leaf);
  world.Add(Quad({-4, -4, 0.05f}, {4, -4, 0.05f}, {4, -3, 0.05f}, {-4, -3, 0.05f}), water);
  world.Build();
  return world;
}

TEST(PathTracer, AnotherSeedAgreesWithinTheNoise) {
  const World world = MakeDusk();
  const Traced a = world.Trace(Equirectangular{64, 32}, {0, 0, 1.2f}, {.samples = 64, .seed = 1});
  const Traced b = world.Trace(Equirectangular{64, 32}, {0, 0, 1.2f}, {.samples = 64, .seed = 2});
  EXPECT_NE(0, std::memcmp(a.mean.pixels().data(), b.mean.pixels().data(), a.mean.pixels().size() * sizeof(Rgb32f)));
  EXPECT_GE(test::ShareWithinNoise(a.mean, a.variance, b.mean, b.variance), test::kShareThatMustPass);
}

TEST(PathTracer, LightFoundByChanceAgreesWithinTheNoise) {
  const World world = MakeDusk();
  const Traced a = world.Trace(Equirectangular{64, 32}, {0, 0, 1.2f}, {.samples = 64, .seed = 1});
  const Traced b = world.Trace(Equirectangular{64, 32}, {0, 0, 1.2f}, {.samples = 192, .seed = 2, .next_event = false});
  EXPECT_GE(test::ShareWithinNoise(a.mean, a.variance, b.mean, b.variance), test::kShareThatMustPass);
  // All pixels together: far finer than one by one.
  double error = 0, variance = 0;
  for (size_t i = 0; i < a.mean.pixels().size(); ++i) {
    error += a.mean.pixels()[i].g - b.mean.pixels()[i].g;
    variance += a.variance.pixels()[i].g + b.variance.pixels()[i].g;
  }
  EXPECT_LT(std::abs(error), 4 * std::sqrt(variance));
}

TEST(PathTracer, GivesTheSameBytesWithAnyNumberOfThreads) {
  World world;
  world.Use(test::MakeOpenSquare());
  const auto trace = [&](int threads) {
    const ThreadLimit limit(threads);
    return world.Trace(Equirectangular{64, 32}, {0, 0, 1.5f}, {.samples = 4, .seed = 3});
  };
  const Traced one = trace(1), three = trace(3);
  EXPECT_TRUE(one.mean == three.mean);
  EXPECT_TRUE(one.variance == three.variance);
}

TEST(PathTracer, TurningTheCameraByColumnsRollsTheImage) {
  World world;
  world.Use(test::MakeOpenSquare());
  const Mat3d level = Mat3d::FromColumns({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  const Equirectangular camera{64, 32};
  constexpr int kTurn = 11;
  const Traced a = world.Trace(camera, {0, 0, 1.5f}, {.samples = 4}, level);
  const Traced b = world.Trace(camera, {0, 0, 1.5f}, {.samples = 4}, level * RotationY(kTurn * 2 * kPi / 64));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) ASSERT_EQ(b.mean(x, y), a.mean((x + kTurn) % 64, y)) << x << ' ' << y;
}

TEST(PathTracer, PanesDimTheSunByTheirFresnelAndColour) {
  const auto sunlit = [](bool roofed) {
    World world;
    world.AddSky(90);
    world.Add(Ground(50), Matte(0.4f));
    Material pane = Matte(0.8f);
    pane.kind = SurfaceKind::kGlass, pane.transmission = 1;
    if (roofed) world.Add(Ground(30, 3), pane);
    world.Build();
    return MeanOf(world.Trace(Pinhole{8, 8, 200, 200, 4, 4}, {0, 0, 1}, {.samples = 128, .max_bounces = 1}, kLookDown).mean);
  };
  // Most of the light is the sun's, straight from above; what the pane mirrors back down takes more bounces.
  const double pane = scalar::bsdf_pane(1.0f), share = sunlit(true) / sunlit(false);
  EXPECT_NEAR(share, 0.8 * (1 - pane), 0.03);
}

TEST(PathLights, ChooseDirectionsByTheirDensity) {
  World world;
  world.AddSky(35);
  world.builder.environment().cloud_cover = 0.4;
  world.Add(Ground(5), Matte(0.5f));
  world.Build();
  const internal::PathLights lights(world.shader->impl());
  RngStream random(1, "sky");
  const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
  // Two tests at 1 % together: the sky, and the sun's disc in chord squared by angle.
  const double significance = test::Sidak(0.01, 2);
  const double sky = test::ChiSquareOfDirections(
      [&](Vec3f& d) {
        d = lights.SampleSky({unit(), unit()}).direction;
        return true;
      },
      [&](Vec3f d) { return lights.SkyPdf(d); }, 200000, {.across = 64, .up = 32, .fine = 8});
  EXPECT_GT(sky, significance);

  constexpr int kCells = 8, kCount = 50000;
  const Vec3f to_sun = world.shader->impl().sky->to_sun();
  const Vec3f right = Normalized(Cross({0, 0, 1}, to_sun)), up = Cross(to_sun, right);
  std::vector<double> seen(kCells * kCells);
  for (int i = 0; i < kCount; ++i) {
    const Vec3f d = lights.SampleSun({}, {unit(), unit()}).direction;
    const double x = Dot(d, right), y = Dot(d, up), r2 = (x * x + y * y) / (0.004625 * 0.004625);
    const int ring = std::min(kCells - 1, static_cast<int>(r2 * kCells));
    const int sector = std::min(kCells - 1, static_cast<int>((std::atan2(y, x) / (2 * kPi) + 0.5) * kCells));
    ++seen[ring * kCells + sector];
    ASSERT_LT(r2, 1.001);
  }
  double statistic = 0;
  for (double n : seen) statistic += std::pow(n - kCount / 64.0, 2) / (kCount / 64.0);
  EXPECT_GT(test::ChiSquareTail(statistic, kCells * kCells - 1), significance);
}

TEST(CpuRenderer, ReferenceHasTheLabelsOfTheOtherTiersAndSimilarColours) {
  const auto tracer = std::make_shared<const RayTracer>(test::MakeOpenSquare());
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kReference});
  RenderRequest request{{}, Equirectangular{64, 32}, BodyPose({0, 0, 1.5}, 0, 0, 0) * CameraInBody()};
  Frame fast, reference;
  renderer->Render(request, fast);
  request.tier = Tier::kReference;
  request.samples = 16;
  const RenderStats stats = renderer->Render(request, reference);
  EXPECT_EQ(stats.rays, 64u * 32 * 17);
  EXPECT_TRUE(fast.range == reference.range);
  EXPECT_TRUE(fast.entity == reference.entity);
  EXPECT_TRUE(fast.semantic == reference.semantic);
  double difference = 0;
  for (size_t i = 0; i < fast.rgb.pixels().size(); ++i) difference += std::abs(fast.rgb.pixels()[i].g - reference.rgb.pixels()[i].g);
  EXPECT_LT(difference / static_cast<double>(fast.rgb.pixels().size()), 20);
}

}  // namespace
}  // namespace airsim360
