// Stored pictures of two small scenes, every tier, pinned to one instruction set (Embree's SSE4.2, kernels by
// AIRSIM360_ISA, which CTest sets). Labels must be the same bytes, range within 1e-6; of colours at most 1 % of
// the pixels may differ by more than 0.016. After a change that is meant:
// AIRSIM360_ISA=sse42 AIRSIM360_RENEW_GOLDENS=1 build/bin/golden_test, in the root of the repository; look at
// what changed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/base/kernel_isa.h"
#include "airsim360/image/codecs.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

const std::string kFolder = "tests/exactness/goldens/";

bool Renew() { return std::getenv("AIRSIM360_RENEW_GOLDENS") != nullptr; }

// Stores `bytes` if asked to; the stored ones.
Bytes Golden(const std::string& name, const Bytes& bytes) {
  if (Renew()) WriteFileAtomically(kFolder + name, bytes);
  return ReadFile(kFolder + name);
}

void ExpectSameIds(const Image<uint32_t>& ids, const std::string& name) {
  const Image<uint32_t> golden = DecodeIdPng(Golden(name, EncodeIdPng(ids)), name);
  EXPECT_EQ(ids, golden) << name;
}

void ExpectSameRange(const Image<float>& range, const std::string& name) {
  const Image<float> golden = DecodeExr(Golden(name, EncodeExr(range)), name);
  ASSERT_EQ(golden.size(), range.size());
  for (size_t i = 0; i < range.size(); ++i) {
    const float a = range.pixels()[i], b = golden.pixels()[i];
    ASSERT_LE(std::abs(a - b), 1e-6f * b) << name << ", pixel " << i;
  }
}

void ExpectSimilarColours(const Image<Rgb8>& rgb, const std::string& name) {
  const Image<Rgba8> golden = DecodeRgba8(Golden(name, EncodePng(rgb)), name);
  ASSERT_EQ(golden.size(), rgb.size());
  size_t differ = 0;
  for (size_t i = 0; i < rgb.size(); ++i) {
    const Rgb8 a = rgb.pixels()[i];
    const Rgba8 b = golden.pixels()[i];
    const int most = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
    differ += most > 0.016 * 255;
  }
  EXPECT_LE(differ, rgb.size() / 100) << name;
}

void ExpectGoldens(std::shared_ptr<const Scene> scene, const std::string& name) {
  ASSERT_EQ(internal::CurrentKernelIsa(), internal::KernelIsa::kSse42) << "run it with AIRSIM360_ISA=sse42";
  const auto tracer = std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "sse4.2"});
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});
  for (const Tier tier : {Tier::kFast, Tier::kHigh, Tier::kReference}) {
    const int width = tier == Tier::kReference ? 64 : 128;
    Frame frame;
    renderer->Render(MakeRequest(Equirectangular{width, width / 2}, BodyPose({0.3, 0.2, 1.7}, 0.3, 0.2, -0.1) * CameraInBody(), tier),
                     frame);
    const std::string file = name + "_" + kTierNames[static_cast<int>(tier)];
    ExpectSimilarColours(frame.rgb, file + ".png");
    if (tier != Tier::kFast) continue;
    ExpectSameIds(frame.entity, name + "_entity.png");
    ExpectSameRange(frame.range, name + "_range.exr");
  }
}

TEST(Goldens, RoomLooksAsStored) { ExpectGoldens(test::MakeRoom(), "room"); }

TEST(Goldens, SquareUnderTheSkyLooksAsStored) { ExpectGoldens(test::MakeOpenSquare(), "square"); }

}  // namespace
}  // namespace airsim360
