#include "airsim360/render/high/high_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

constexpr Products kAll{.rgb = true, .range = true, .semantic = true, .entity = true, .normal = true, .radiance = true};

std::shared_ptr<const RayTracer> SquareTracer() {
  static const auto tracer = std::make_shared<const RayTracer>(MakeOpenSquare());
  return tracer;
}
Renderer& Square() {
  static const auto renderer = MakeCpuRenderer(SquareTracer(), {.tier = Tier::kHigh});
  return *renderer;
}

RenderRequest Request(int width, double yaw = 0.3) {
  return MakeRequest(Equirectangular{width, width / 2}, BodyPose({0.3, 0.2, 1.7}, yaw, 0.2, -0.1) * CameraInBody(), Tier::kHigh, kAll);
}

Frame Render(const RenderRequest& request) {
  Frame frame;
  Square().Render(request, frame);
  return frame;
}

template <class Pixel>
Image<Pixel> Rolled(const Image<Pixel>& image, int k) {
  Image<Pixel> out(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) out(x, y) = image((x + k) % image.width(), y);
  }
  return out;
}

TEST(HighFrame, LabelsAreThoseOfTierLabelsBitForBit) {
  RenderRequest request = Request(160);
  const Frame high = Render(request);
  request.tier = Tier::kLabels;
  const Frame labels = Render(request);
  EXPECT_EQ(high.range, labels.range);
  EXPECT_EQ(high.entity, labels.entity);
  EXPECT_EQ(high.semantic, labels.semantic);
  EXPECT_EQ(high.normal, labels.normal);
}

TEST(HighFrame, TurningTheRigByColumnsRollsEveryProductByteForByte) {
  constexpr int kWidth = 192;
  RenderRequest request = Request(kWidth);
  const RigidTransform X_WC = request.X_WC;
  const Frame frame = Render(request);
  for (const int k : {1, 7, 16, 100}) {
    request.X_WC = {X_WC.R * RotationY(2 * std::numbers::pi * k / kWidth), X_WC.p};
    const Frame turned = Render(request);
    EXPECT_EQ(turned.radiance, Rolled(frame.radiance, k)) << k;
    EXPECT_EQ(turned.rgb, Rolled(frame.rgb, k)) << k;
    EXPECT_EQ(turned.range, Rolled(frame.range, k)) << k;
    EXPECT_EQ(turned.entity, Rolled(frame.entity, k)) << k;
  }
}

TEST(HighFrame, OneAndManyThreadsGiveTheSameBytes) {
  const RenderRequest request = Request(256);
  const Frame many = Render(request);
  const ThreadLimit limit(1);
  const Frame one = Render(request);
  EXPECT_EQ(one.radiance, many.radiance);
  EXPECT_EQ(one.rgb, many.rgb);
}

TEST(HighFrame, TheOrderOfTilesDoesNotMatter) {
  const auto& tracer = SquareTracer();
  const Shader shader(tracer, tracer->scene().environment);
  const internal::LabelTables tables(*tracer);
  const RenderRequest request = Request(256);
  internal::CameraRays rays;
  rays.Update(request.camera, request.X_WC.R);
  internal::HighFrame high;
  Image<Rgb32f> radiance[2];
  Frame frame;
  for (int i = 0; i < 2; ++i) {
    high.ShuffleTiles(static_cast<uint64_t>(i) * 12345);
    high.Render(*tracer, shader, rays, tables.view(), request, radiance[i], frame);
  }
  EXPECT_EQ(radiance[0], radiance[1]);
}

TEST(HighFrame, FramesAreIndependentUnlessAskedOtherwiseAndSeedsDiffer) {
  RenderRequest request = Request(128);
  const Frame first = Render(request), again = Render(request);
  EXPECT_EQ(first.radiance, again.radiance);
  request.seed = 1;
  EXPECT_FALSE(Render(request).radiance == first.radiance);
}

TEST(HighFrame, EveryPixelIsANumberForAllCamerasAndSampleCounts) {
  const std::vector<Camera> cameras = {Equirectangular{34, 17}, Equirectangular{64, 32}, Pinhole{50, 40, 30, 30, 25, 20},
                                       CubeFace{CubeFaceName::kPosZ, 33}};
  for (const Camera& camera : cameras) {
    for (const int samples : {0, 1, 3}) {
      for (const bool denoise : {false, true}) {
        RenderRequest request = Request(64);
        request.camera = camera, request.samples = samples, request.denoise = denoise;
        const Frame frame = Render(request);
        for (const Rgb32f c : frame.radiance.pixels()) {
          ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
          ASSERT_TRUE(c.r >= 0 && c.g >= 0 && c.b >= 0);
        }
      }
    }
  }
}

TEST(HighFrame, MoreRaysBringTheNoiseDownAndLeaveTheMean) {
  RenderRequest request = Request(128);
  request.denoise = false, request.edge_samples = 1;
  const auto error = [&](int samples, const Image<Rgb32f>& truth, double& bias) {
    request.samples = samples, request.seed = 5;
    const Image<Rgb32f> image = Render(request).radiance;
    double sum = 0, total = 0;
    bias = 0;
    for (size_t i = 0; i < image.size(); ++i) {
      const double d = image.pixels()[i].g - truth.pixels()[i].g;
      sum += d * d, bias += d, total += truth.pixels()[i].g;
    }
    bias /= total;
    return sum;
  };
  request.samples = 128;
  const Image<Rgb32f> truth = Render(request).radiance;
  double bias_few, bias_many;
  const double few = error(2, truth, bias_few), many = error(16, truth, bias_many);
  EXPECT_LT(many, few / 4);
  EXPECT_NEAR(bias_few, 0, 0.005);
  EXPECT_NEAR(bias_many, 0, 0.002);
}

TEST(HighFrame, DenoisingComesCloserToManyRaysAndKeepsTheMean) {
  RenderRequest request = Request(256);
  request.edge_samples = 1, request.denoise = false, request.samples = 64;
  const Image<Rgb32f> truth = Render(request).radiance;
  request.samples = 4, request.seed = 9;
  double error[2] = {}, sum[2] = {}, total = 0;
  for (const bool denoise : {false, true}) {
    request.denoise = denoise;
    const Image<Rgb32f> image = Render(request).radiance;
    for (size_t i = 0; i < image.size(); ++i) {
      const double d = image.pixels()[i].g - truth.pixels()[i].g;
      error[denoise] += d * d, sum[denoise] += d;
    }
  }
  for (const Rgb32f c : truth.pixels()) total += c.g;
  EXPECT_LT(error[1], 0.5 * error[0]);
  EXPECT_NEAR(sum[1] / total, 0, 0.01);
}

}  // namespace
}  // namespace airsim360
