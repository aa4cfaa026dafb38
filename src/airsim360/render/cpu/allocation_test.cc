// The render loop takes no memory once its buffers are there. Counts every operator new of the test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace {

std::atomic<int64_t> allocations = 0;

void* Count(size_t size, size_t alignment) {
  ++allocations;
  void* p = alignment > 0 ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : std::malloc(size);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

// All forms of new take their memory from malloc's family, which the compiler does not see through.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(size_t size) { return Count(size == 0 ? 1 : size, 0); }
void* operator new[](size_t size) { return Count(size == 0 ? 1 : size, 0); }
void* operator new(size_t size, std::align_val_t a) { return Count(size, static_cast<size_t>(a)); }
void* operator new[](size_t size, std::align_val_t a) { return Count(size, static_cast<size_t>(a)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }
void operator delete[](void* p, size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, size_t, std::align_val_t) noexcept { std::free(p); }

namespace airsim360 {
namespace {

TEST(Allocation, TheSecondFrameOfASizeTakesNoMemory) {
  const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(test::MakeRoom()));
  const RigidTransform poses[] = {BodyPose({0, 0, 1.5}, 0.3, 0, 0) * CameraInBody(),
                                  BodyPose({0.3, 0.2, 1.7}, 0.5, 0.1, 0) * CameraInBody()};
  for (Tier tier : {Tier::kLabels, Tier::kFast}) {
    for (const bool everything : {false, true}) {
      Products products{.rgb = tier != Tier::kLabels, .normal = true};
      if (everything) {
        products.position = products.albedo = products.material = products.coverage = products.flow = true;
      }
      Frame frame;
      RenderRequest request = MakeRequest(Equirectangular{256, 128}, poses[0], tier, products);
      request.X_WC_next = poses[1];
      renderer->Render(request, frame);
      request.X_WC = poses[1];
      const int64_t before = allocations;
      renderer->Render(request, frame);
      EXPECT_EQ(allocations - before, 0) << static_cast<int>(tier) << everything;
    }
  }
}

}  // namespace
}  // namespace airsim360
