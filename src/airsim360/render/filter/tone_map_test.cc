#include "airsim360/render/filter/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/color.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/indoor/test_rooms.h"

namespace airsim360 {
namespace {

TEST(ToneMapTest, TheLinearCurveIsSrgbOfTheExposedLight) {
  Image<Rgb32f> light(300, 2);
  for (int x = 0; x < 300; ++x) light(x, 1) = {0.004f * static_cast<float>(x), 0.01f, 0};
  Image<Rgb8> shown;
  ToneMapImage(light, 2, ToneCurve::kLinear, shown);
  for (int x = 0; x < 300; ++x) {
    EXPECT_NEAR(shown(x, 1).r, LinearToSrgb8(2 * light(x, 1).r), 1);
    EXPECT_NEAR(shown(x, 1).g, LinearToSrgb8(0.02f), 1);
  }
}

/// Frames of the test square.
class ExposedFrameTest : public testing::Test {
 protected:
  Frame Render(RenderRequest request) {
    request.camera = Equirectangular{128, 64};
    request.X_WC = BodyPose({0, 0, 2}, 0.5, 0, 0) * CameraInBody();
    Frame frame;
    renderer_->Render(request, frame);
    return frame;
  }
  std::unique_ptr<Renderer> renderer_ = MakeCpuRenderer(std::make_shared<const RayTracer>(test::MakeRoom()), {.tier = Tier::kFast});
};

TEST_F(ExposedFrameTest, PixelsAreTheToneCurveOfRadianceTimesExposure) {
  for (const ToneCurve tone : {ToneCurve::kFilmic, ToneCurve::kAgx, ToneCurve::kLinear}) {
    RenderRequest request;
    request.exposure_ev = -1, request.edge_samples = 1, request.tone = tone;
    request.products.radiance = true;
    const Frame frame = Render(request);
    Image<Rgb8> shown;
    ToneMapImage(frame.radiance, frame.exposure, tone, shown);
    EXPECT_TRUE(shown == frame.rgb);
  }
}

TEST_F(ExposedFrameTest, AutoExposureUndoesAFixedOne) {
  RenderRequest request;
  request.auto_exposure = true;
  const Frame automatic = Render(request);
  EXPECT_FALSE(automatic.rgb == Render({}).rgb);
  // Stops asked for are added to what the picture says.
  request.exposure_ev = 1;
  EXPECT_FLOAT_EQ(Render(request).exposure, 2 * automatic.exposure);
  // A fixed exposure of the same size gives the same picture.
  const float fixed = Render({}).exposure;
  RenderRequest brighter;
  brighter.exposure_ev = std::log2(automatic.exposure / fixed);
  const Frame same = Render(brighter);
  size_t off = 0;
  for (size_t i = 0; i < same.rgb.size(); ++i) off += std::abs(same.rgb.pixels()[i].g - automatic.rgb.pixels()[i].g) > 1;
  EXPECT_EQ(off, 0u);
}

// In a room the picture chooses its exposure although none is asked for, and says which.
TEST(RoomExposureTest, PixelsAreTheToneCurveOfRadianceTimesTheChosenExposure) {
  test::RoomScene room("dim_room");
  room.builder().AddSky();
  room.Box({0, 0, 0}, {4, 5, 3}, room.Paint({0.6f, 0.5f, 0.4f}));
  const MaterialId lamp = room.Paint({}, {2, 2, 2});
  room.Quad({1, 1, 2.99f}, {1, 2, 2.99f}, {2, 2, 2.99f}, {2, 1, 2.99f}, lamp, "furniture/lighting");
  const auto tracer = room.Build();
  RenderRequest request = MakeRequest(Equirectangular{64, 32}, BodyPose({2, 3, 1.5}, 0.5, 0, 0) * CameraInBody(), Tier::kFast);
  request.edge_samples = 1, request.products.radiance = true;
  std::vector<Frame> frames(2);
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    MakeCpuRenderer(tracer, {.tier = Tier::kFast})->Render(request, frames[threads == 1 ? 0 : 1]);
  }
  const Frame& frame = frames[0];
  EXPECT_EQ(frame.exposure, frames[1].exposure);
  EXPECT_TRUE(frame.rgb == frames[1].rgb);
  Image<Rgb8> shown;
  ToneMapImage(frame.radiance, frame.exposure, ToneCurve::kFilmic, shown);
  EXPECT_TRUE(shown == frame.rgb);
  // Another one than that of the day, which stops that are asked for count from.
  request.exposure_ev = 1e-9;
  Frame fixed;
  MakeCpuRenderer(tracer, {.tier = Tier::kFast})->Render(request, fixed);
  EXPECT_GT(std::abs(std::log2(frame.exposure / fixed.exposure)), 0.5);
}

}  // namespace
}  // namespace airsim360
