#include "airsim360/render/shading/town_light.h"

#include <gtest/gtest.h>

#include "airsim360/math/angles.h"
#include "airsim360/render/indoor/test_rooms.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

using test::RoomScene;

struct LitField {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<LightTable> lights;

  // A square of ground, in pieces as bounds of detail are those of most triangles, with one lamp of a square metre.
  LitField(float side, float radiance) {
    RoomScene scene("field");
    const MaterialId soil = scene.Paint({0.2f, 0.2f, 0.2f}), lamp = scene.Paint({0, 0, 0}, {radiance, radiance, radiance});
    constexpr int kPieces = 12;
    const float h = side / 2, piece = side / kPieces;
    for (int k = 0; k < kPieces * kPieces; ++k) {
      const float x = -h + piece * static_cast<float>(k % kPieces), y = -h + piece * static_cast<float>(k / kPieces);
      scene.Quad({x, y, 0}, {x + piece, y, 0}, {x + piece, y + piece, 0}, {x, y + piece, 0}, soil);
    }
    scene.Quad({0, 1, 5}, {1, 1, 5}, {1, 0, 5}, {0, 0, 5}, lamp);
    tracer = scene.Build();
    tables = std::make_unique<SurfaceTables>(tracer->scene());
    lights = std::make_unique<LightTable>(tracer->scene(), *tables, tracer->scene().environment);
  }
};

TEST(TownLight, IsTheLampsLumensOverTheGroundUpToThoseOfACity) {
  for (const float side : {20.0f, 100.0f, 800.0f}) {
    const LitField field(side, 0.02f);
    const float lumens = kPiF * 0.02f * kLuxPerUnit;
    EXPECT_NEAR(LampsPerArea(field.tracer->scene(), *field.lights) / (lumens / (side * side)), 1, 1e-3) << side;
    EXPECT_NEAR(TownLight(field.tracer->scene(), *field.lights), std::min(1.0f, lumens / (side * side) / kTownLamps), 1e-4);
  }
  EXPECT_EQ(TownLight(LitField(20, 5).tracer->scene(), *LitField(20, 5).lights), 1);
}

TEST(TownLight, SkyFogAndCloudsGetWhatTheTownSendsUp) {
  Environment night = ParseEnvironmentPreset("night");
  const auto zenith = [&](float cover, float visibility, float town) {
    Environment e = night;
    e.cloud_cover = cover, e.cirrus_cover = e.altocumulus_cover = 0, e.visibility_m = visibility;
    return Luminance(Sky(e, {}, nullptr, town).Radiance({0, 0, 1}));
  };
  for (const auto& [cover, visibility] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 150.0f}}) {
    const float none = zenith(cover, visibility, 0), half = zenith(cover, visibility, 0.5f), city = zenith(cover, visibility, 1);
    EXPECT_NEAR(half / (0.5f * (none + city)), 1, 0.01) << cover << " " << visibility;
    EXPECT_GT(city, 1.5f * none) << cover << " " << visibility;
  }
  // While the lamps are off no town counts.
  night.lamps = Lamps::kOff;
  EXPECT_EQ(zenith(1, 0, 1), zenith(1, 0, 0));
}

}  // namespace
}  // namespace airsim360::internal
