// What moves, many cameras at once, frames in flight.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/render/frame/test_room.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

RenderRequest SquareRequest(int width, double x, double yaw) {
  RenderRequest request;
  request.camera = Equirectangular{width, width / 2};
  request.X_WC = BodyPose({x, 0.25, 2.2}, yaw, 0.1, 0) * CameraInBody();
  request.tier = Tier::kLabels;
  request.products = {.rgb = false, .normal = true};
  return request;
}

struct MovingPair {
  std::shared_ptr<const Scene> scene = test::MakeOpenSquare();
  std::shared_ptr<const RayTracer> tracer = std::make_shared<const RayTracer>(scene, RayTracerOptions{.isa = "avx2"});
  std::unique_ptr<Renderer> cpu = MakeCpuRenderer(tracer);
  std::unique_ptr<GpuRenderer> gpu = MakeVulkanRenderer(tracer, {}, {.validate = test::ValidationInstalled()});
};

// Cubes fly about, one hides; the cubes' mesh breathes.
std::shared_ptr<const SceneState> StateAt(const Scene& scene, int step) {
  auto state = std::make_shared<SceneState>();
  for (uint32_t i = 1; i < 8; ++i) {
    AffineTransform X = scene.instances[i].X_WM;
    X.p = X.p + Vec3f{0.05f * static_cast<float>(step * i), 0.1f * static_cast<float>(step), 0.02f};
    state->moved.push_back({i, X, i == 3 && step % 2 == 1});
  }
  if (step > 0) {
    const Mesh& cube = scene.meshes[1];
    auto positions = std::make_shared<std::vector<Vec3f>>(cube.positions);
    for (Vec3f& p : *positions) p = p * (1.0f + 0.05f * static_cast<float>(step));
    state->deformed.push_back({1, positions});
  }
  return state;
}

TEST(GpuDynamic, WhatMovesHidesAndBendsIsSeenAsByTheCpu) {
  AIRSIM360_NEEDS_GPU();
  MovingPair pair;
  RenderRequest request = SquareRequest(128, 0.5, 0.3);
  // There and back to the scene as built; refits after the first build.
  for (const int step : {0, 1, 2, 3, 1, -1}) {
    request.state = step < 0 ? nullptr : StateAt(*pair.scene, step);
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    const test::LabelDifference d = test::Compare(cpu, gpu, true);
    EXPECT_LE(d.different, 2) << step;
    EXPECT_EQ(d.far, 0) << step;
    EXPECT_LE(d.range, 1e-5) << step;
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuDynamic, FlowIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  MovingPair pair;
  std::vector<Camera> cameras{Equirectangular{128, 64}, CubeFace{CubeFaceName::kPosX, 64}, Pinhole{96, 64, 60, 60, 48, 32},
                              Fisheye::Equidistant(64, 64, 3)};
  for (const Camera& lens : test::CalibratedLenses()) cameras.push_back(lens);
  for (const Camera& camera : cameras) {
    RenderRequest request = SquareRequest(128, 0.5, 0.3);
    request.camera = camera;
    request.products.flow = true;
    request.state = StateAt(*pair.scene, 1);
    request.next_state = StateAt(*pair.scene, 2);
    request.X_WC_next = BodyPose({0.6, 0.2, 2.25}, 0.32, 0.12, 0.02) * CameraInBody();
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    int compared = 0, occlusions = 0, moving = 0;
    double worst = 0;
    for (size_t i = 0; i < cpu.flow.size(); ++i) {
      if (cpu.entity.pixels()[i] != gpu.entity.pixels()[i]) continue;
      const FlowPixel &a = cpu.flow.pixels()[i], &b = gpu.flow.pixels()[i];
      ++compared;
      occlusions += a.occluded != b.occluded;
      moving += a.motion.x != 0;
      worst = std::max<double>(worst, std::hypot(a.dx - b.dx, a.dy - b.dy));
      EXPECT_NEAR(a.range, b.range, 1e-4 * (1 + a.range));
      EXPECT_LE(Norm(a.motion - b.motion), 1e-4f);
    }
    EXPECT_GT(moving, 100);
    EXPECT_LE(occlusions, std::max(3, compared / 500)) << camera.index();
    EXPECT_LE(worst, 2e-3) << camera.index();
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuDynamic, ManyCamerasInOneDispatchAreWhatEachIsAlone) {
  AIRSIM360_NEEDS_GPU();
  MovingPair pair;
  std::vector<RenderRequest> requests;
  for (int i = 0; i < 20; ++i) requests.push_back(SquareRequest(i % 3 == 0 ? 32 : 64, 0.1 * i, 0.2 * i));
  const uint64_t ticket = pair.gpu->Submit(requests);
  const std::vector<GpuFrame> frames = pair.gpu->Wait(ticket);
  ASSERT_EQ(frames.size(), requests.size());
  for (size_t i = 0; i < requests.size(); ++i) {
    Frame alone;
    pair.gpu->Render(requests[i], alone);
    EXPECT_TRUE(std::ranges::equal(alone.range.pixels(), frames[i].range)) << i;
    EXPECT_TRUE(std::ranges::equal(alone.entity.pixels(), frames[i].entity)) << i;
    EXPECT_TRUE(std::ranges::equal(alone.semantic.pixels(), frames[i].semantic)) << i;
    EXPECT_TRUE(std::ranges::equal(alone.normal.pixels(), frames[i].normal)) << i;
  }
  pair.gpu->Release(ticket);
}

TEST(GpuDynamic, FramesInFlightDoNotTouchEachOther) {
  AIRSIM360_NEEDS_GPU();
  MovingPair pair;
  const auto alone = MakeVulkanRenderer(pair.tracer, {}, {.frames_in_flight = 1});
  std::vector<uint64_t> tickets;
  const auto request_of = [&](int i) {
    RenderRequest request = SquareRequest(64, 0.3, 0.1);
    request.state = StateAt(*pair.scene, i);
    return request;
  };
  for (int i = 0; i < 3; ++i) tickets.push_back(pair.gpu->Submit(std::vector{request_of(i)}));
  EXPECT_THROW(pair.gpu->Submit(std::vector{request_of(3)}), RuntimeError);
  for (const int i : {2, 0, 1}) {
    Frame frame;
    alone->Render(request_of(i), frame);
    const GpuFrame got = pair.gpu->Wait(tickets[static_cast<size_t>(i)]).front();
    EXPECT_TRUE(std::ranges::equal(frame.range.pixels(), got.range)) << i;
    pair.gpu->Release(tickets[static_cast<size_t>(i)]);
  }
  EXPECT_THROW(pair.gpu->Wait(tickets[0]), InputError);
}

TEST(GpuDynamic, WrongRequestsAreNamed) {
  AIRSIM360_NEEDS_GPU();
  MovingPair pair;
  auto state = std::make_shared<SceneState>();
  state->moved.push_back({1000, {}, false});
  RenderRequest request = SquareRequest(32, 0, 0);
  request.state = state;
  Frame frame;
  EXPECT_THROW(pair.gpu->Render(request, frame), InputError);
  request.state = nullptr;
  request.camera = Equirectangular{0, 0};
  EXPECT_THROW(pair.gpu->Render(request, frame), InputError);
  request = SquareRequest(32, 0, 0);
  request.products.flow = true;
  EXPECT_THROW(pair.gpu->Render(request, frame), InputError);
  EXPECT_THROW(pair.gpu->Submit({}), InputError);
  EXPECT_THROW(MakeVulkanRenderer(pair.tracer, {}, {.gpu = 99}), InputError);
  // And it goes on working.
  pair.gpu->Render(SquareRequest(32, 0, 0), frame);
  EXPECT_EQ(frame.range.width(), 32);
}

}  // namespace
}  // namespace airsim360
