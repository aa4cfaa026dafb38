#include "airsim360/sensors/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/image/color.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/filter/tone_map.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/indoor/test_rooms.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {
namespace {

/// Renders the test room.
class LensTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { renderer_ = MakeCpuRenderer(std::make_shared<const RayTracer>(test::MakeRoom()), {.tier = Tier::kFast}); }
  static void TearDownTestSuite() { renderer_.reset(); }

  static Image<Rgb8> Take(const Real360* lens, Kinematics body, int width, int64_t t_ns = 0) {
    PanoramicRig rig;
    rig.camera = Equirectangular{width, width / 2};
    rig.tone = ToneCurve::kLinear;
    rig.exposure_ev = -1.5;
    if (lens != nullptr) rig.lens = LensModel::kReal360, rig.real360 = *lens;
    Capture capture;
    CaptureRig(rig, body, t_ns, *renderer_, capture);
    return capture.frame.rgb;
  }

  static std::unique_ptr<Renderer> renderer_;
};
std::unique_ptr<Renderer> LensTest::renderer_;

double MeanDifference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(a.pixels()[i].g - b.pixels()[i].g);
  return sum / static_cast<double>(a.size());
}

/// Column, in pixels, where green crosses the middle between two columns of a row.
double EdgeBetween(const Image<Rgb8>& image, int row, int first, int last) {
  const auto at = [&](int x) { return static_cast<double>(image(x, row).g); };
  const double middle = 0.5 * (at(first) + at(last));
  for (int x = first; x < last; ++x) {
    if ((at(x) - middle) * (at(x + 1) - middle) <= 0 && at(x) != at(x + 1)) {
      return x + 0.5 + (middle - at(x)) / (at(x + 1) - at(x));
    }
  }
  return -1;
}

TEST_F(LensTest, WithoutFaultsThePictureIsTheIdealPanoramaResampled) {
  const Real360 perfect = Real360::Perfect();
  const Kinematics body{BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0), {}, {}};
  const Image<Rgb8> ideal = Take(nullptr, body, 512), real = Take(&perfect, body, 512);
  EXPECT_LT(MeanDifference(ideal, real), 1.0);
  // Away from edges within two steps: the room's walls are plain.
  size_t off = 0;
  for (size_t i = 0; i < ideal.size(); ++i) off += std::abs(ideal.pixels()[i].g - real.pixels()[i].g) > 2;
  EXPECT_LT(static_cast<double>(off) / static_cast<double>(ideal.size()), 0.03);
}

TEST_F(LensTest, NearThingsAreShiftedAtTheSeamByTheParallaxOfTheLenses) {
  // From the room's centre the edge between two walls is 5 sqrt(2) m away; the camera turns so that it lies
  // `angle` from the front axis, on either side of the seam at 90 degrees.
  Real360 lens = Real360::Perfect();
  lens.baseline = 0.6;
  lens.blend_deg = 1;
  const double r = 5 * std::sqrt(2.0);
  const int width = 1024, row = 250;
  for (const double angle_deg : {80.0, 87.0, 93.0, 100.0}) {
    // The wall edge (5, -5) is at azimuth -45 degrees; image angles grow to the right, so yaw + angle.
    const double angle = angle_deg * kDegree;
    const Kinematics body{BodyPose({0, 0, 3}, -45 * kDegree + angle, 0, 0), {}, {}};
    const auto column = [&](double theta) { return (theta / (2 * kPi) + 0.5) * width; };
    const int first = static_cast<int>(column(angle)) - 25, last = first + 50;
    EXPECT_NEAR(EdgeBetween(Take(nullptr, body, width), row, first, last), column(angle), 0.6) << angle_deg;
    // Seen from a centre half a baseline ahead or behind.
    const double half = angle_deg < 90 ? 0.3 : -0.3;
    const double seen = std::atan2(r * std::sin(angle), r * std::cos(angle) - half);
    EXPECT_NEAR(EdgeBetween(Take(&lens, body, width), row, first, last), column(seen), 0.8) << angle_deg;
  }
}

TEST_F(LensTest, LabelsStayIdeal) {
  PanoramicRig rig;
  rig.camera = Equirectangular{128, 64};
  const Kinematics body{BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0), {1, 0, 0}, {0, 0, 1}};
  Capture ideal, real;
  CaptureRig(rig, body, 0, *renderer_, ideal);
  rig.lens = LensModel::kReal360;
  CaptureRig(rig, body, 0, *renderer_, real);
  EXPECT_TRUE(ideal.frame.range == real.frame.range);
  EXPECT_TRUE(ideal.frame.entity == real.frame.entity);
  EXPECT_EQ(real.frame.rgb.width(), 128);
  EXPECT_FALSE(ideal.frame.rgb == real.frame.rgb);
}

TEST_F(LensTest, APhotoChangesColoursAlone) {
  PanoramicRig rig;
  rig.camera = Equirectangular{128, 64};
  rig.products.normal = rig.products.radiance = true;
  const Kinematics body{BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0), {1, 0, 0}, {0, 0, 1}};
  for (const Tier tier : {Tier::kFast, Tier::kHigh}) {
    rig.tier = tier;
    rig.look = Look::kClean;
    Capture clean, photo, again;
    CaptureRig(rig, body, 0, *renderer_, clean);
    EXPECT_FALSE(clean.photo);
    EXPECT_TRUE(clean.frame.light.empty());
    rig.look = Look::kPhoto;
    CaptureRig(rig, body, 0, *renderer_, photo);
    ASSERT_TRUE(photo.photo);
    EXPECT_TRUE(clean.frame.range == photo.frame.range);
    EXPECT_TRUE(clean.frame.entity == photo.frame.entity);
    EXPECT_TRUE(clean.frame.normal == photo.frame.normal);
    EXPECT_TRUE(clean.frame.radiance == photo.frame.radiance);
    EXPECT_FALSE(clean.frame.rgb == photo.frame.rgb);
    CaptureRig(rig, body, 0, *renderer_, again);
    EXPECT_TRUE(photo.frame.rgb == again.frame.rgb);
    // Its grain is another one a moment later.
    CaptureRig(rig, body, 1, *renderer_, again);
    EXPECT_FALSE(photo.frame.rgb == again.frame.rgb);
  }
}

TEST_F(LensTest, TheLightOfAPhotoIsTheRadianceButForSmoothEdges) {
  Frame frame;
  RenderRequest request = MakeRequest(Equirectangular{256, 128}, BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0) * CameraInBody(), Tier::kFast);
  request.products.radiance = request.light = true;
  renderer_->Render(request, frame);
  int differ = 0, outside = 0;
  for (int y = 1; y < 127; ++y) {
    for (int x = 1; x < 255; ++x) {
      const float light = frame.light(x, y).g;
      if (frame.light(x, y) == frame.radiance(x, y)) continue;
      ++differ;
      float low = INFINITY, high = 0;
      for (int i = 0; i < 9; ++i) {
        const float g = frame.radiance(x - 1 + i % 3, y - 1 + i / 3).g;
        low = std::min(low, g), high = std::max(high, g);
      }
      outside += light < 0.98f * low || light > 1.02f * high ? 1 : 0;
    }
  }
  EXPECT_GT(differ, 100);
  EXPECT_LT(differ, 254 * 126 / 4);
  EXPECT_LT(outside, differ / 10);
  EXPECT_EQ(frame.daylight.sun_seen, 0);  // a closed room
}

TEST_F(LensTest, Real360IsDevelopedByTheLookToo) {
  PanoramicRig rig;
  rig.camera = Equirectangular{128, 64};
  rig.lens = LensModel::kReal360;
  const Kinematics body{BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0), {}, {}};
  Capture clean, photo;
  CaptureRig(rig, body, 0, *renderer_, clean);
  rig.look = Look::kPhoto;
  rig.camera_look.metering = 0.4, rig.camera_look.metering_spread = 0;
  CaptureRig(rig, body, 0, *renderer_, photo);
  ASSERT_TRUE(photo.photo);
  EXPECT_TRUE(clean.frame.range == photo.frame.range);
  double sum = 0, whole = 0;
  for (int y = 0; y < 64; ++y) {
    const double weight = std::cos(kPi * (0.5 - (y + 0.5) / 64));
    for (int x = 0; x < 128; ++x) {
      const Rgb8 c = photo.frame.rgb(x, y);
      sum += weight * (0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b) / 255, whole += weight;
    }
  }
  EXPECT_NEAR(sum / whole, 0.4, 0.03);
}

// What the sensors of a lens get is what the ideal picture gets, in a room too, where nothing asks for an exposure.
/// Adds up what another renderer counts.
class CountingRenderer : public Renderer {
 public:
  explicit CountingRenderer(Renderer& of) : of_(of) {}
  RenderStats Render(const RenderRequest& request, Frame& frame) override {
    const RenderStats stats = of_.Render(request, frame);
    rays += stats.rays;
    return stats;
  }
  uint64_t rays = 0;

 private:
  Renderer& of_;
};

TEST(LensInARoom, ItsSensorsShareTheExposureThatIsSaid) {
  test::RoomScene room("dim_room");
  room.builder().AddSky();
  room.Box({0, 0, 0}, {4, 5, 3}, room.Paint({0.6f, 0.5f, 0.4f}));
  // Bright on one side, so that either sensor alone would choose another exposure.
  room.Quad({0.5f, 0.01f, 1}, {3.5f, 0.01f, 1}, {3.5f, 0.01f, 2}, {0.5f, 0.01f, 2}, room.Paint({}, {2, 2, 2}), "furniture/lighting");
  const auto renderer = MakeCpuRenderer(room.Build(), {.tier = Tier::kFast});
  PanoramicRig rig;
  rig.camera = Equirectangular{128, 64};
  rig.tone = ToneCurve::kLinear;
  rig.products.radiance = true;
  const Kinematics body{BodyPose({2, 2.5, 1.5}, -kPi / 2, 0, 0), {}, {}};
  Capture ideal, real, photo;
  CaptureRig(rig, body, 0, *renderer, ideal);
  rig.lens = LensModel::kReal360, rig.real360 = Real360::Perfect();
  CountingRenderer counting(*renderer);
  CaptureRig(rig, body, 0, counting, real);
  EXPECT_EQ(real.stats.rays, counting.rays);
  EXPECT_NEAR(std::log2(real.frame.exposure / ideal.frame.exposure), 0, 0.1);
  Image<Rgb8> shown;
  ToneMapImage(ideal.frame.radiance, real.frame.exposure, rig.tone, shown);
  EXPECT_LT(MeanDifference(shown, real.frame.rgb), 4);
  ToneMapImage(ideal.frame.radiance, 1.3f * real.frame.exposure, rig.tone, shown);
  EXPECT_GT(MeanDifference(shown, real.frame.rgb), 8);

  // Where stops are given, the exposure is the fixed one for both.
  rig.exposure_ev = 5;
  CaptureRig(rig, body, 0, *renderer, real);
  rig.lens = LensModel::kIdeal;
  CaptureRig(rig, body, 0, *renderer, ideal);
  EXPECT_FLOAT_EQ(real.frame.exposure, ideal.frame.exposure);
  rig.exposure_ev = 0;

  rig.lens = LensModel::kIdeal, rig.look = Look::kPhoto, rig.camera_look.metering = 0;
  CaptureRig(rig, body, 0, *renderer, photo);
  const float fixed = photo.frame.exposure;
  rig.exposure_ev = 2;
  CaptureRig(rig, body, 0, *renderer, photo);
  EXPECT_FLOAT_EQ(photo.frame.exposure, 4 * fixed);
}

TEST_F(LensTest, ARollingShutterTurnsRowsByTheirTime) {
  // The body turns to the left by w; a row at elevation e of the front picture is read e / fov of the readout
  // before the middle, so that what it shows is turned to where the camera looked then.
  Real360 lens = Real360::Perfect();
  lens.readout = 0.1;
  const double w = 0.8;
  const int width = 1024;
  const Kinematics still{BodyPose({0, 0, 3}, -45 * kDegree, 0, 0), {}, {}};
  Kinematics turning = still;
  turning.w_WB_B = {0, 0, w};
  const Image<Rgb8> sharp = Take(&lens, still, width), skewed = Take(&lens, turning, width);
  for (const int row : {200, 256, 310}) {
    const double elevation = kPi * (0.5 - (row + 0.5) / 512);
    const double t = -elevation / (lens.fov_deg * kDegree) * lens.readout;
    const double expected = w * t / (2 * kPi) * width;  // turned left, things move right
    const double shift = EdgeBetween(skewed, row, 480, 544) - EdgeBetween(sharp, row, 480, 544);
    EXPECT_NEAR(shift, expected, 0.35) << row;
  }
}

TEST_F(LensTest, TheSameSeedAndTimeGiveTheSamePicture) {
  const Real360 lens;
  const Kinematics body{BodyPose({0.3, -0.4, 2}, 0.3, 0.1, 0), {}, {}};
  const Image<Rgb8> a = Take(&lens, body, 128, 5);
  EXPECT_TRUE(Take(&lens, body, 128, 5) == a);
  EXPECT_FALSE(Take(&lens, body, 128, 6) == a);
}

TEST(SensorNoise, VarianceIsSignalPerFullWellPlusReadNoiseSquared) {
  Real360 lens = Real360::Perfect();
  lens.full_well = 2000;
  lens.read_noise = 20;
  const Equirectangular target{512, 256};
  const Fisheye camera = internal::SensorCamera(lens, target);
  for (const float signal : {0.0f, 0.1f, 0.5f, 1.0f}) {
    Image<Rgb32f> light(camera.width, camera.height, {signal, signal, signal});
    internal::ExposeSensor(lens, camera, false, 3, 4, light);
    double sum = 0, squares = 0, n = 0;
    for (int y = 60; y < 200; ++y) {
      for (int x = 60; x < 200; ++x) {
        for (const float v : {light(x, y).r, light(x, y).g, light(x, y).b}) {
          sum += v - signal;
          squares += (v - signal) * (v - signal);
          ++n;
        }
      }
    }
    const double variance = NoiseVariance(lens, signal);
    EXPECT_DOUBLE_EQ(variance, static_cast<double>(signal) / 2000 + 1e-4);
    // Four standard errors.
    EXPECT_NEAR(sum / n, 0, 4 * std::sqrt(variance / n));
    EXPECT_NEAR(squares / n, variance, 4 * variance * std::sqrt(2 / n));
  }
}

TEST(SensorNoise, SensorsFramesPixelsAndColoursAreIndependent) {
  const Real360 lens;
  const Fisheye camera = internal::SensorCamera(lens, {256, 128});
  const auto noise = [&](bool rear, uint64_t seed, uint64_t frame) {
    Image<Rgb32f> light(camera.width, camera.height, {0.5f, 0.5f, 0.5f});
    internal::ExposeSensor(lens, camera, rear, seed, frame, light);
    return light;
  };
  const Image<Rgb32f> a = noise(false, 1, 1);
  EXPECT_TRUE(a == noise(false, 1, 1));
  EXPECT_FALSE(a == noise(false, 2, 1));
  EXPECT_FALSE(a == noise(false, 1, 2));
  EXPECT_FALSE(a == noise(true, 1, 1));
  // Neighbours and colours: correlation below four standard errors.
  double self = 0, neighbour = 0, colour = 0, n = 0;
  for (int y = 50; y < 90; ++y) {
    for (int x = 50; x < 90; ++x) {
      const double d = a(x, y).g - 0.5 * 0.99, e = a(x + 1, y).g - 0.5 * 0.99, f = a(x, y).r - 0.5 * 0.99;
      self += d * d, neighbour += d * e, colour += d * f, ++n;
    }
  }
  EXPECT_LT(std::abs(neighbour / self), 4 / std::sqrt(n) + 0.1);
  EXPECT_LT(std::abs(colour / self), 4 / std::sqrt(n) + 0.1);
}

TEST(SensorLight, FallsOffTowardsTheRimAndTheRearIsBrighter) {
  Real360 lens = Real360::Perfect();
  lens.vignetting = 0.3;
  lens.mismatch_ev = 1;
  const Fisheye camera = internal::SensorCamera(lens, {512, 256});
  Image<Rgb32f> front(camera.width, camera.height, {1, 1, 1}), rear = front;
  internal::ExposeSensor(lens, camera, false, 0, 0, front);
  internal::ExposeSensor(lens, camera, true, 0, 0, rear);
  const int c = camera.width / 2;
  EXPECT_NEAR(front(c, c).g, 1, 1e-3);
  EXPECT_NEAR(front(camera.width - 1, c).g, 0.7, 5e-3);
  EXPECT_NEAR(front(c + c / 2, c).g, 1 - 0.3 / 4, 5e-3);
  EXPECT_NEAR(rear(c, c).g, 2, 2e-3);
}

TEST(SensorSeam, MixesSmoothlyAndCoversTheSphere) {
  const Real360 lens = Real360::Perfect();
  const Equirectangular target{512, 256};
  const Fisheye camera = internal::SensorCamera(lens, target);
  const Image<Rgb32f> one(camera.width, camera.height, {1, 1, 1}), two(camera.width, camera.height, {2, 2, 2});
  const Image<Rgb32f> both = internal::StitchSensors(lens, camera, one, two, target);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) {
      const Vec3d d = *PixelToRay(target, {x + 0.5, y + 0.5});
      const double off = std::acos(d.z) / kDegree - 90;
      if (off < -2.01) {
        ASSERT_NEAR(both(x, y).g, 1, 1e-6);
      } else if (off > 2.01) {
        ASSERT_NEAR(both(x, y).g, 2, 1e-6);
      } else {
        ASSERT_NEAR(both(x, y).g, 1.5 + 0.5 * std::sin(off / 2 * kPi / 2), 0.02);
      }
    }
  }
}

TEST(Real360Test, NonsenseIsRefused) {
  Real360 lens;
  lens.fov_deg = 181;
  EXPECT_THROW(CheckReal360(lens), InputError);
  PanoramicRig rig;
  rig.camera = Pinhole{};
  rig.lens = LensModel::kReal360;
  SceneBuilder builder("empty");
  builder.AddSky();
  Capture capture;
  EXPECT_THROW(CaptureRig(rig, {}, 0, *MakeNullRenderer(builder.Build()), capture), InputError);
}

TEST(Real360Test, ReadsYaml) {
  Real360 lens;
  ReadYaml("baseline: 0.05\njpeg_quality: 70\n", "lens.yaml", [&](ConfigVisitor& v) { lens.Visit(v); });
  EXPECT_EQ(lens.baseline, 0.05);
  EXPECT_EQ(lens.jpeg_quality, 70);
}

}  // namespace
}  // namespace airsim360
