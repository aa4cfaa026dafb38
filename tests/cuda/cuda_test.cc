// Pictures for CUDA without CUDA: Vulkan is Mesa's lavapipe, whose memory can be mapped, and the driver is fake_cuda.cc.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/render/cuda/cuda_pictures.h"
#include "airsim360/worlds/worlds.h"
#include "fake_cuda.h"

namespace airsim360 {
namespace {

// The fake shares the memory of the program: real devices have memory of their own.
std::optional<GpuInfo> SoftwareGpu() {
  for (const GpuInfo& gpu : ListGpus()) {
    if (gpu.software && gpu.missing.empty() && gpu.shares_memory) return gpu;
  }
  return {};
}

class Cuda : public testing::Test {
 protected:
  void SetUp() override {
    const auto gpu = SoftwareGpu();
    if (!gpu) GTEST_SKIP() << "no lavapipe that traces rays and shares memory (apt-get install -t bookworm-backports mesa-vulkan-drivers)";
    gpu_ = *gpu;
    ::setenv("AIRSIM360_LIBCUDA", FAKE_CUDA, 1);
    const unsigned char other[16] = {1, 2, 3};
    fake_cuda_set_uuid(0, other);
    fake_cuda_set_uuid(1, gpu_.uuid.data());
    fake_cuda_set_header(0);
    fake_cuda_forget();
    tracer_ = std::make_shared<const RayTracer>(BuildWorld("box_room", {}));
    request_.camera = Equirectangular{64, 32};
    request_.X_WC = {CameraInBody().R, {0, 0, 3}};
    request_.tier = Tier::kLabels;
    request_.products = {.rgb = false, .range = true, .semantic = true, .entity = true, .normal = true};
  }
  std::unique_ptr<CudaRenderer> Make(bool discrete = false) {
    return std::make_unique<CudaRenderer>(tracer_, RendererOptions{}, GpuOptions{.gpu = gpu_.index, .discrete = discrete});
  }
  std::shared_ptr<const CudaPictures> Take(CudaRenderer& renderer) {
    Frame frame;
    renderer.Render(request_, frame);
    EXPECT_TRUE(frame.range.empty()) << "nothing comes to memory of the CPU";
    return renderer.Take();
  }
  Frame Expected() {
    Frame frame;
    MakeVulkanRenderer(tracer_, {}, {.gpu = gpu_.index})->Render(request_, frame);
    return frame;
  }
  // lavapipe's files begin with bytes of its own before the memory.
  void FindHeader(const Frame& expected) {
    const auto renderer = Make();
    const auto pictures = Take(*renderer);
    const auto* begin = reinterpret_cast<const char*>(pictures->frame().range.data());
    const auto* wanted = reinterpret_cast<const char*>(expected.range.pixels().data());
    for (size_t at = 0; at < 65536; at += 16) {
      if (std::memcmp(begin + at, wanted, 1024) != 0) continue;
      fake_cuda_set_header(at);
      return;
    }
    FAIL() << "the picture is not in the shared memory";
  }
  static std::string Calls() { return fake_cuda_calls(); }
  static int Count(const std::string& what) {
    int count = 0;
    const std::string calls = Calls();
    for (size_t at = calls.find(what); at != std::string::npos; at = calls.find(what, at + 1)) ++count;
    return count;
  }

  GpuInfo gpu_;
  std::shared_ptr<const RayTracer> tracer_;
  RenderRequest request_;
};

TEST_F(Cuda, SharedMemoryHoldsThePicturesOfTheVulkanRenderer) {
  const Frame expected = Expected();
  ASSERT_NO_FATAL_FAILURE(FindHeader(expected));
  for (const bool discrete : {false, true}) {
    const auto renderer = Make(discrete);
    const auto pictures = Take(*renderer);
    const GpuFrame& f = pictures->frame();
    ASSERT_EQ(f.width, 64);
    EXPECT_TRUE(std::ranges::equal(f.range, expected.range.pixels()));
    EXPECT_TRUE(std::ranges::equal(f.entity, expected.entity.pixels()));
    EXPECT_TRUE(std::ranges::equal(f.semantic, expected.semantic.pixels()));
    EXPECT_TRUE(std::ranges::equal(f.normal, expected.normal.pixels()));
    EXPECT_TRUE(f.rgb.empty());
  }
}

TEST_F(Cuda, TheValidationLayersHaveNothingToSay) {
  const auto renderer = MakeVulkanRenderer(tracer_, {}, {.gpu = gpu_.index, .validate = true, .discrete = true});
  renderer->ReadBack(false);
  for (int i = 0; i < 2; ++i) {
    const uint64_t ticket = renderer->Submit({&request_, 1});
    const auto memory = renderer->Share(renderer->PictureBytes(ticket));
    const int fd = memory->Open();
    EXPECT_GE(fd, 0);
    ::close(fd);
    renderer->Copy(ticket, *memory, nullptr);
    renderer->Copy(ticket, *memory, nullptr);  // over what CUDA has not given back: it is not wanted
    const auto small = renderer->Share(64);
    EXPECT_THROW(renderer->Copy(ticket, *small, nullptr), InputError);
    renderer->Release(ticket);
  }
  EXPECT_EQ(renderer->messages(), std::vector<std::string>());
}

TEST_F(Cuda, TheDeviceWithTheSameUuidIsTaken) {
  const auto renderer = Make();
  EXPECT_EQ(Take(*renderer)->ordinal(), 1);
  EXPECT_NE(Calls().find("cuDevicePrimaryCtxRetain 101\n"), std::string::npos) << Calls();
  const unsigned char other[16] = {4, 5, 6};
  fake_cuda_set_uuid(1, other);
  EXPECT_THROW(Make(), RuntimeError);
}

TEST_F(Cuda, CallsComeInOrderWithTheSizesOfTheBuffer) {
  const auto renderer = Make();
  const auto pictures = Take(*renderer);
  const std::string calls = Calls();
  size_t at = 0;
  // Each picture begins at a multiple of 64 bytes: range, entity 4 bytes a pixel, semantic 2, normal 12.
  const std::string size = std::to_string(64 * 32 * (4 + 4 + 2 + 12));
  for (const std::string& call :
       {std::string("cuInit 0\n"), std::string("cuDeviceGetCount\n"), std::string("cuDevicePrimaryCtxRetain"),
        std::string("cuImportExternalMemory type 1 size "), "cuExternalMemoryGetMappedBuffer offset 0 size " + size + "\n"}) {
    at = calls.find(call, at);
    ASSERT_NE(at, std::string::npos) << call << " in\n" << calls;
  }
}

TEST_F(Cuda, MemoryIsUsedAgainWhenNobodyHoldsItAndNotBefore) {
  const auto renderer = Make();
  auto first = Take(*renderer);
  const void* const place = first->frame().range.data();
  auto second = Take(*renderer);
  EXPECT_NE(second->frame().range.data(), place);
  EXPECT_EQ(Count("cuImportExternalMemory"), 2);
  EXPECT_EQ(Count("cuCtxSynchronize"), 0);
  first.reset();
  // Work of whoever read it may still be under way on some stream.
  auto third = Take(*renderer);
  EXPECT_EQ(third->frame().range.data(), place);
  EXPECT_EQ(Count("cuImportExternalMemory"), 2);
  EXPECT_EQ(Count("cuCtxSynchronize"), 1);
}

TEST_F(Cuda, LargerPicturesGetLargerMemory) {
  const auto renderer = Make();
  Take(*renderer);
  request_.camera = Equirectangular{128, 64};
  const auto pictures = Take(*renderer);
  EXPECT_EQ(pictures->frame().width, 128);
  EXPECT_EQ(Count("cuImportExternalMemory"), 2);
  EXPECT_EQ(Count("cuDestroyExternalMemory"), 1) << "what is too small is given back";
}

TEST_F(Cuda, PicturesOutliveTheRendererAndEverythingIsGivenBack) {
  const Frame expected = Expected();
  ASSERT_NO_FATAL_FAILURE(FindHeader(expected));
  auto renderer = Make();
  auto pictures = Take(*renderer);
  renderer.reset();
  EXPECT_TRUE(std::ranges::equal(pictures->frame().range, expected.range.pixels()));
  EXPECT_GT(fake_cuda_alive(), 0);
  pictures.reset();
  EXPECT_EQ(fake_cuda_alive(), 0) << Calls();
  EXPECT_EQ(Count("error:"), 0) << Calls();
}

TEST_F(Cuda, CopiesAreMadeOnTheStreamAndToTheCpu) {
  const Frame expected = Expected();
  ASSERT_NO_FATAL_FAILURE(FindHeader(expected));
  auto renderer = Make();
  auto pictures = Take(*renderer);
  const size_t bytes = 64 * 32 * sizeof(float);
  {
    const auto copy = pictures->CopyOnDevice(pictures->frame().range.data(), bytes, reinterpret_cast<void*>(4711));
    EXPECT_NE(Calls().find("cuMemcpyDtoDAsync_v2 " + std::to_string(bytes) + " stream 4711\n"), std::string::npos);
    EXPECT_EQ(std::memcmp(copy.get(), expected.range.pixels().data(), bytes), 0);
  }
  EXPECT_EQ(Count("cuMemFree_v2"), 2);  // that of FindHeader, and the copy
  std::vector<float> host(64 * 32);
  pictures->CopyToHost(host.data(), pictures->frame().range.data(), bytes);
  EXPECT_TRUE(std::ranges::equal(host, expected.range.pixels()));
}

TEST_F(Cuda, FailuresAreToldAndLeaveNothingBehind) {
  for (const char* call : {"cuInit", "cuDevicePrimaryCtxRetain", "cuImportExternalMemory", "cuExternalMemoryGetMappedBuffer"}) {
    fake_cuda_fail(call, 2);
    std::string message;
    try {
      Take(*Make());
    } catch (const RuntimeError& error) {
      message = error.what();
    }
    EXPECT_EQ(message.find("CUDA: "), 0u) << call;
    EXPECT_NE(message.find("fake failure (2)"), std::string::npos) << message;
    EXPECT_EQ(fake_cuda_alive(), 0) << call;
  }
  ::setenv("AIRSIM360_LIBCUDA", "/nowhere/libcuda.so.1", 1);
  EXPECT_THROW(Make(), RuntimeError);
}

TEST_F(Cuda, AFailedPictureFreesItsPlaceInTheRing) {
  const auto renderer = Make();
  for (int i = 0; i < 5; ++i) {
    fake_cuda_fail("cuImportExternalMemory", 2);
    EXPECT_THROW(Take(*renderer), RuntimeError);
  }
  EXPECT_NE(Take(*renderer), nullptr);
  request_.auto_exposure = true;
  EXPECT_THROW(Take(*renderer), InputError);
}

}  // namespace
}  // namespace airsim360
