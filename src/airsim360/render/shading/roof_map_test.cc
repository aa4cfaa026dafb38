#include "airsim360/render/shading/roof_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/indoor/test_rooms.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/shared/precipitation_scalar.h"

namespace airsim360::internal {
namespace {

using test::RoomScene;

// A face of this height over a rectangle.
void Slab(RoomScene& scene, Vec2f low, Vec2f high, float z, MaterialId material) {
  scene.Quad({low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}, material);
}

// Open ground with a roof, one of glass, a crown of leaves and a pole.
struct Yard {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<RoofMap> roofs;

  static constexpr Vec2f kRoofLow{-4, -4}, kRoofHigh{4, 4}, kGlassLow{-16, -4}, kGlassHigh{-9, 4};
  static constexpr float kRoof = 4, kGlass = 6;

  Yard() {
    RoomScene scene("yard");
    const MaterialId stone = scene.Paint({0.5f, 0.5f, 0.5f});
    const MaterialId glass =
        scene.builder().AddMaterial({.name = "pane", .kind = SurfaceKind::kGlass, .roughness = 0.02f, .transmission = 0.9f});
    const MaterialId leaf = scene.builder().AddMaterial({.name = "leaf", .kind = SurfaceKind::kFoliage});
    Slab(scene, {-20, -20}, {20, 20}, 0, stone);
    Slab(scene, kRoofLow, kRoofHigh, kRoof, stone);
    Slab(scene, kGlassLow, kGlassHigh, kGlass, glass);
    for (int i = 0; i < 8; ++i) Slab(scene, {10, -16}, {16, -10}, 3 + 0.5f * static_cast<float>(i), leaf);
    scene.Box({10, 10, 0}, {10.2f, 10.2f, 6}, stone, false);
    tracer = scene.Build();
    tables = std::make_unique<SurfaceTables>(tracer->scene());
    roofs = std::make_unique<RoofMap>(*tracer, *tables);
  }
};

// How far inside a rectangle a point is; negative: outside.
float Inside(Vec2f p, Vec2f low, Vec2f high) { return std::min(std::min(p.x - low.x, high.x - p.x), std::min(p.y - low.y, high.y - p.y)); }

TEST(RoofMap, HidesWhatALeaningRayFromTheSkyMeetsARoofBefore) {
  const Yard yard;
  RngStream random(3, "roofs");
  int hidden = 0, open = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3f p{static_cast<float>(random.Uniform(-18, 18)), static_cast<float>(random.Uniform(-18, 18)),
                  static_cast<float>(random.Uniform(0.3, 8))};
    const auto under = [&](float z, Vec2f low, Vec2f high) {
      return p.z < z ? Inside({p.x + kRainLean * (z - p.z), p.y}, low, high) : -100.0f;
    };
    const float inside =
        std::max(under(Yard::kRoof, Yard::kRoofLow, Yard::kRoofHigh), under(Yard::kGlass, Yard::kGlassLow, Yard::kGlassHigh));
    // Roofs reach a texel farther.
    if (inside > -0.7f && inside < 0.1f) continue;
    (inside > 0 ? hidden : open) += 1;
    EXPECT_EQ(yard.roofs->Hides(p), inside > 0) << p.x << " " << p.y << " " << p.z;
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(open, 1000);
}

TEST(RoofMap, IsTheSameOfOneAndManyThreads) {
  const Yard yard;
  const ThreadLimit limit(1);
  const RoofMap again(*yard.tracer, *yard.tables);
  const RoofView a = yard.roofs->view(), b = again.view();
  ASSERT_EQ(a.size, b.size);
  EXPECT_TRUE(std::equal(a.heights, a.heights + static_cast<size_t>(a.size) * static_cast<size_t>(a.size), b.heights));
}

TEST(RoofMap, FogBeginsWhereTheRoofEnds) {
  const Yard yard;
  const RoofView view = yard.roofs->view();
  RngStream random(4, "ways");
  for (int i = 0; i < 300; ++i) {
    const auto angle = static_cast<float>(random.Uniform(0, 6.28318));
    const Vec3f o{static_cast<float>(random.Uniform(-3, 3)), static_cast<float>(random.Uniform(-3, 3)), 1.5f};
    const Vec3f d{std::cos(angle), std::sin(angle), 0};
    const float shift = kRainLean * (Yard::kRoof - o.z);
    const float along_x = ((d.x > 0 ? Yard::kRoofHigh.x : Yard::kRoofLow.x) - shift - o.x) / d.x;
    const float along_y = ((d.y > 0 ? Yard::kRoofHigh.y : Yard::kRoofLow.y) - o.y) / d.y;
    const float edge = std::min(along_x, along_y), way = scalar::roofed_way(view, o, d, 100);
    // A texel farther on either axis, which a ray along the edge takes longer to leave.
    const float least = std::max(std::min(std::fabs(d.x), std::fabs(d.y)), 0.05f);
    EXPECT_GT(way, edge - 0.15f) << o.x << " " << o.y << " " << angle;
    EXPECT_LT(way, edge + 0.6f / least) << o.x << " " << o.y << " " << angle;
    EXPECT_EQ(scalar::roofed_way(view, o, d, 0.5f * edge), 0.5f * edge);
  }
  EXPECT_EQ(scalar::roofed_way(view, {8, 0, 1}, {-1, 0, 0}, 20), 0);
  EXPECT_EQ(scalar::roofed_way(view, {0, 0, 5}, {1, 0, 0}, 20), 0);
}

// A closed room under a sky, and the ground it stands on. Its lamp is so bright that what probes leak through walls does not count.
std::shared_ptr<const RayTracer> LampRoom() {
  RoomScene scene("lamp room");
  scene.builder().AddSky();
  const MaterialId wall = scene.Paint({0.6f, 0.5f, 0.4f}), lamp = scene.Paint({0.5f, 0.5f, 0.5f}, {400, 400, 400});
  Slab(scene, {-30, -30}, {30, 30}, -0.3f, wall);
  scene.Box({-2, -1.5f, 0}, {2, 1.5f, 2.6f}, wall);
  scene.Box({-2.3f, -1.8f, -0.2f}, {2.3f, 1.8f, 2.9f}, wall, false);
  scene.Quad({-0.5f, 0.5f, 2.5f}, {0.5f, 0.5f, 2.5f}, {0.5f, -0.5f, 2.5f}, {-0.5f, -0.5f, 2.5f}, lamp);
  return scene.Build();
}

Image<Rgb32f> RadianceAt(Renderer& renderer, Tier tier, Vec3d p) {
  RenderRequest request;
  request.camera = Equirectangular{96, 48};
  request.X_WC = BodyPose(p, 0.4, 0, 0) * CameraInBody();
  request.tier = tier;
  request.products.radiance = true;
  request.edge_samples = 1;
  Frame frame;
  renderer.Render(request, frame);
  return frame.radiance;
}

// Share of pixels whose light differs by more than a tenth: fog here takes more of a metre and a half, while the light of rooms, solved
// anew, has other noise.
double Changed(const Image<Rgb32f>& a, const Image<Rgb32f>& b) {
  int count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += std::fabs(a.pixels()[i].g - b.pixels()[i].g) > 0.1f * a.pixels()[i].g;
  return count / static_cast<double>(a.size());
}

double MeanLight(const Image<Rgb32f>& image) {
  double sum = 0;
  for (const Rgb32f& c : image.pixels()) sum += c.g;
  return sum / static_cast<double>(image.size());
}

TEST(RoofMap, ARoomInRainSnowAndFogIsThatOfADryDay) {
  const auto tracer = LampRoom();
  Environment dry;
  dry.cloud_cover = dry.cirrus_cover = dry.haze = 0;
  Environment foul = dry;
  foul.rain_mm_h = 30, foul.snowfall_mm_h = 4, foul.visibility_m = 40;
  const auto before = MakeCpuRenderer(tracer, {.tier = Tier::kReference, .environment = dry}),
             in_it = MakeCpuRenderer(tracer, {.tier = Tier::kReference, .environment = foul});
  for (const Tier tier : {Tier::kFast, Tier::kHigh, Tier::kReference}) {
    const Vec3d inside{0.5, 0.4, 1.3}, outside{-9, 1, 1.3};
    const Image<Rgb32f> a = RadianceAt(*before, tier, inside), b = RadianceAt(*in_it, tier, inside);
    EXPECT_LT(Changed(a, b), 0.01) << static_cast<int>(tier);
    EXPECT_NEAR(MeanLight(b) / MeanLight(a), 1, 0.005) << static_cast<int>(tier);
    // Outside all of it changes.
    EXPECT_GT(Changed(RadianceAt(*before, tier, outside), RadianceAt(*in_it, tier, outside)), 0.9) << static_cast<int>(tier);
  }
}

}  // namespace
}  // namespace airsim360::internal
