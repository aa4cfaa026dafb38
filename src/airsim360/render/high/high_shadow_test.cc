// Dappled shadows of tier `high`: smooth, and without combs of columns where these are narrow.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

constexpr int kWidth = 384, kHeight = kWidth / 2;

// Ground under a crown of black leaves, which throws spots of sun all round below the camera.
std::shared_ptr<const RayTracer> UnderTheCrown() {
  SceneBuilder builder("crown");
  const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  const auto add = [&](Mesh mesh, float albedo) {
    Material material;
    material.base_color = {albedo, albedo, albedo};
    material.roughness = 1;
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(mesh), AffineTransform(), entity});
  };
  add({"ground", {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}}, 0.4f);
  Mesh leaves{"leaves", {}, {}, {}, {}, {}};
  RngStream rng(1, "leaves");
  for (uint32_t i = 0; i < 1200; ++i) {
    const auto x = static_cast<float>(rng.Uniform(-4, 4)), y = static_cast<float>(rng.Uniform(-4, 4)),
               z = static_cast<float>(rng.Uniform(5, 8)), r = 0.12f;
    for (const Vec3f corner : {Vec3f{-r, -r, 0}, Vec3f{r, -r, 0}, Vec3f{r, r, 0}, Vec3f{-r, r, 0}})
      leaves.positions.push_back(Vec3f{x, y, z} + corner);
    leaves.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    leaves.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
  }
  add(leaves, 0);
  builder.AddSky();
  Environment& environment = builder.environment();
  environment.cloud_cover = environment.cirrus_cover = 0;
  environment.sun_elevation_deg = 80;
  return std::make_shared<const RayTracer>(builder.Build());
}

Image<Rgb32f> Render(Renderer& renderer, Tier tier, int samples, uint64_t seed) {
  Frame frame;
  RenderRequest request = MakeRequest(Equirectangular{kWidth, kHeight}, BodyPose({0.2, -0.3, 3}, 0.4, 0, 0) * CameraInBody(), tier,
                                      {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true});
  request.samples = samples, request.seed = seed;
  renderer.Render(request, frame);
  return frame.radiance;
}

// Mean over rows of latitudes from `low` to `high` degrees of `value`(x, y), by solid angle.
template <class Value>
double MeanOver(double low, double high, const Value& value) {
  double sum = 0, weight = 0;
  for (int y = 0; y < kHeight - 1; ++y) {
    const double latitude = 90 - 180 * (y + 0.5) / kHeight;
    if (latitude < low || latitude > high) continue;
    const double w = std::cos(latitude * std::numbers::pi / 180);
    for (int x = 0; x < kWidth; ++x) sum += w * value(x, y), weight += w;
  }
  return sum / weight;
}

TEST(HighShadow, SpotsOfSunUnderATreeAreSmoothAndWithoutCombs) {
  const auto renderer = MakeCpuRenderer(UnderTheCrown(), {.tier = Tier::kHigh});
  const Image<Rgb32f> high = Render(*renderer, Tier::kHigh, 0, 3), other = Render(*renderer, Tier::kHigh, 0, 4);
  const Image<Rgb32f> truth = Render(*renderer, Tier::kReference, 16, 5);
  const auto square = [](double d) { return d * d; };
  for (const auto& [low, up] : {std::pair{-55.0, -35.0}, {-75.0, -55.0}, {-88.0, -75.0}}) {
    const double bright = MeanOver(low, up, [&](int x, int y) { return truth(x, y).g; });
    const double bias = MeanOver(low, up, [&](int x, int y) { return high(x, y).g - truth(x, y).g; });
    EXPECT_NEAR(bias / bright, 0, 0.03) << low;
    const double noise = MeanOver(low, up, [&](int x, int y) { return square(high(x, y).g - other(x, y).g); });
    EXPECT_LT(std::sqrt(0.5 * noise) / bright, 0.15) << low;
    // Steps from column to column are as many times smaller than from row to row as columns are narrower.
    const double across = MeanOver(low, up, [&](int x, int y) { return square(high((x + 1) % kWidth, y).g - high(x, y).g); });
    const double down = MeanOver(low, up, [&](int x, int y) { return square(high(x, y + 1).g - high(x, y).g); });
    const double narrow = MeanOver(low, up, [&](int, int y) { return square(std::sin(std::numbers::pi * (y + 0.5) / kHeight)); });
    EXPECT_LT(across / down, 2 * narrow) << low;
    RecordProperty("noise" + std::to_string(static_cast<int>(-low)), std::to_string(std::sqrt(0.5 * noise) / bright));
    RecordProperty("comb" + std::to_string(static_cast<int>(-low)), std::to_string(across / down / narrow));
  }
}

}  // namespace
}  // namespace airsim360
