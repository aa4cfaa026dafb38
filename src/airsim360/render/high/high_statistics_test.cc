// Per-pixel Z-tests of tier `high`, before denoising, over many seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/reference/path_tracer.h"
#include "airsim360/render/reference/test_statistics.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

struct Estimate {
  Image<Rgb32f> mean, variance;  // of the mean
};

// Of what is added to the errors of the mean for what the tier simplifies on purpose, relative.
constexpr float kModel = 0.01f;

// Mean of `frames` frames with seeds from `seed` on, without denoising.
Estimate Average(Renderer& renderer, RenderRequest request, int frames, uint64_t seed) {
  request.tier = Tier::kHigh;
  request.denoise = false, request.edge_samples = 1;
  request.products = {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true};
  Frame frame;
  std::vector<Vec3d> sums, squares;
  for (int i = 0; i < frames; ++i) {
    request.seed = seed + static_cast<uint64_t>(i);
    renderer.Render(request, frame);
    sums.resize(frame.radiance.size()), squares.resize(frame.radiance.size());
    for (size_t k = 0; k < sums.size(); ++k) {
      const Rgb32f& c = frame.radiance.pixels()[k];
      const Vec3d light{c.r, c.g, c.b};
      sums[k] += light, squares[k] += light * light;
    }
  }
  Estimate e{Image<Rgb32f>(frame.radiance.width(), frame.radiance.height()),
             Image<Rgb32f>(frame.radiance.width(), frame.radiance.height())};
  const auto single = [](Vec3d v) { return Rgb32f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; };
  for (size_t k = 0; k < sums.size(); ++k) {
    const Vec3d mean = sums[k] * (1.0 / frames);
    e.mean.pixels()[k] = single(mean);
    e.variance.pixels()[k] = single((squares[k] * (1.0 / frames) - mean * mean) * (1.0 / (frames - 1)) + mean * mean * (kModel * kModel));
  }
  return e;
}

double Share(const Estimate& a, const Estimate& b) { return test::ShareWithinNoise(a.mean, a.variance, b.mean, b.variance); }

// Ground half under a black roof, whose edge throws a penumbra of 23 pixels, beside a black wall: nothing is
// lit by what is lit, so that both tiers look for the same integral.
std::shared_ptr<const Scene> MakeRoofAndWall() {
  SceneBuilder builder("roof");
  const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  const auto add = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d, float albedo) {
    Material material;
    material.base_color = {albedo, albedo, albedo};
    material.roughness = 1;
    Mesh mesh{"quad", {a, b, c, d}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}};
    mesh.parts = {{0, 2, builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(mesh), AffineTransform(), entity});
  };
  add({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, 0.4f);
  add({0, -20, 40}, {20, -20, 40}, {20, 20, 40}, {0, 20, 40}, 0);
  add({-1, 0.6f, 0}, {1, 0.6f, 0}, {1, 0.6f, 0.5f}, {-1, 0.6f, 0.5f}, 0);
  builder.AddSky();
  Environment& environment = builder.environment();
  environment.cloud_cover = environment.cirrus_cover = 0;
  environment.sun_elevation_deg = 90;
  return builder.Build();
}

TEST(HighStatistics, WithoutBouncesItIsThePathTracersLightWithinTheNoise) {
  const auto tracer = std::make_shared<const RayTracer>(MakeRoofAndWall());
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});
  const RenderRequest request{{}, Pinhole{48, 40, 128, 128, 24, 20}, {Mat3d::FromColumns({1, 0, 0}, {0, -1, 0}, {0, 0, -1}), {0, 0.2, 2}}};
  const Estimate high = Average(*renderer, request, 64, 1);

  const Shader shader(tracer, tracer->scene().environment);
  internal::CameraRays rays;
  rays.Update(request.camera, request.X_WC.R);
  Estimate paths;
  internal::TracePaths(*tracer, shader, rays, VecCast<float>(request.X_WC.p), {.samples = 512, .max_bounces = 1}, paths.mean,
                       &paths.variance);
  // The path tracer's sun is darker towards its limb, and a pixel that no neighbour gives away has one ray.
  const float lit = paths.mean(2, 20).g, dark = paths.mean(46, 20).g;
  for (size_t k = 0; k < paths.mean.size(); ++k) {
    const float light = paths.mean.pixels()[k].g, error = (0.02f * lit) * (0.02f * lit);
    Rgb32f& variance = paths.variance.pixels()[k];
    if (light > 1.1f * dark && light < 0.97f * lit) variance.r += error, variance.g += error, variance.b += error;
  }
  EXPECT_GE(Share(high, paths), test::kShareThatMustPass);
  // A tenth more or less light does not pass.
  for (const float scale : {0.9f, 1.1f}) {
    Estimate wrong = high;
    for (Rgb32f& p : wrong.mean.pixels()) p = {p.r * scale, p.g * scale, p.b * scale};
    EXPECT_LT(Share(wrong, paths), 0.9);
  }
}

TEST(HighStatistics, FewRaysInManyFramesAreManyRaysInFewFrames) {
  const auto tracer = std::make_shared<const RayTracer>(test::MakeOpenSquare());
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});
  RenderRequest request{{}, Equirectangular{64, 32}, BodyPose({0.3, 0.2, 1.7}, 0.3, 0.2, -0.1) * CameraInBody()};
  request.samples = 2;
  const Estimate few = Average(*renderer, request, 96, 1);
  request.samples = 16;
  const Estimate many = Average(*renderer, request, 24, 1000);
  EXPECT_GE(Share(few, many), test::kShareThatMustPass);
}

}  // namespace
}  // namespace airsim360
