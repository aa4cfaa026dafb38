#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <thread>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/interruption.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

constexpr Products kAllLabels{.rgb = false, .range = true, .semantic = true, .entity = true, .normal = true};
constexpr Products kEverything{.rgb = true, .range = true, .semantic = true, .entity = true, .normal = true};

std::unique_ptr<Renderer> RendererOf(std::shared_ptr<const Scene> scene) {
  return MakeCpuRenderer(std::make_shared<const RayTracer>(std::move(scene)));
}

// Renderers of the test scenes, built once: preparing the shader takes longer than a frame.
std::shared_ptr<Renderer> Room() {
  static const std::shared_ptr<Renderer> renderer = RendererOf(MakeRoom());
  return renderer;
}
std::shared_ptr<Renderer> Square() {
  static const std::shared_ptr<Renderer> renderer = RendererOf(MakeOpenSquare());
  return renderer;
}

Frame Labels(Renderer& renderer, const Camera& camera, const RigidTransform& X_WC) {
  Frame frame;
  renderer.Render(MakeRequest(camera, X_WC, Tier::kLabels, kAllLabels), frame);
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

// Every pixel of a camera against the closed form.
void ExpectTruth(const Frame& frame, const Camera& camera, const RigidTransform& X_WC) {
  int64_t checked = 0, pixels = 0, without_ray = 0;
  double worst = 0;
  for (int y = 0; y < frame.range.height(); ++y) {
    for (int x = 0; x < frame.range.width(); ++x) {
      const auto ray = PixelToRay(camera, {x + 0.5, y + 0.5});
      if (!ray) {
        ++without_ray;
        EXPECT_EQ(frame.range(x, y), 0);
        EXPECT_EQ(frame.entity(x, y), kNoEntity);
        EXPECT_EQ(frame.semantic(x, y), kVoid);
        continue;
      }
      ++pixels;
      const Vec3d d = X_WC.R * *ray;
      if (!FarFromEdges(X_WC.p, d)) continue;
      ++checked;
      const Truth truth = Look(X_WC.p, d);
      ASSERT_EQ(frame.entity(x, y), truth.entity) << x << ' ' << y;
      worst = std::max(worst, std::abs(frame.range(x, y) / truth.range - 1));
      EXPECT_LT(Norm(VecCast<double>(frame.normal(x, y)) - truth.normal), 1e-5) << x << ' ' << y;
    }
  }
  EXPECT_LE(worst, 1e-5);
  EXPECT_GT(checked, 0.9 * static_cast<double>(pixels));
  if (!std::holds_alternative<Fisheye>(camera)) {
    EXPECT_EQ(without_ray, 0);
  }
}

TEST(CpuRenderer, InTheRoomEveryLabelIsRightAndEveryRangeExact) {
  const auto renderer = Room();
  RngStream rng(1, "poses");
  for (int i = 0; i < 20; ++i) {
    const RigidTransform X_WC = RandomPose(rng);
    const Equirectangular camera{256, 128};
    ExpectTruth(Labels(*renderer, camera, X_WC), camera, X_WC);
  }
}

TEST(CpuRenderer, OtherCamerasSeeTheSameRoom) {
  const auto renderer = Room();
  RngStream rng(2, "poses");
  const RigidTransform X_WC = RandomPose(rng);
  Fisheye lens = Fisheye::Equidistant(150, 130, 2.6);
  lens.k = {0.01, -0.002, 0, 0};
  const Camera cameras[] = {Pinhole{101, 77, 60, 61, 50, 39}, CubeFace{CubeFaceName::kNegX, 64}, CubeFace{CubeFaceName::kPosY, 50},
                            Fisheye::Equidistant(160, 160, 3.5), lens};
  for (const Camera& camera : cameras) ExpectTruth(Labels(*renderer, camera, X_WC), camera, X_WC);
}

TEST(CpuRenderer, OddSizesAndSinglePixelsWork) {
  const auto renderer = Room();
  RngStream rng(3, "poses");
  const RigidTransform X_WC = RandomPose(rng);
  for (auto [width, height] : {std::pair{101, 50}, {15, 7}, {18, 9}, {2, 1}, {1, 1}, {334, 167}}) {
    const Equirectangular camera{width, height};
    const Frame frame = Labels(*renderer, camera, X_WC);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec3d d = X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5});
        if (FarFromEdges(X_WC.p, d)) {
          EXPECT_EQ(frame.entity(x, y), Look(X_WC.p, d).entity);
        }
      }
    }
  }
}

TEST(CpuRenderer, TurningTheRigByColumnsRollsEveryProductByteForByte) {
  const auto room = Room(), open = Square();
  RngStream rng(4, "poses");
  for (Renderer* renderer : {room.get(), open.get()}) {
    for (int width : {256, 250, 101}) {
      const Equirectangular camera{width, width / 2};
      const RigidTransform poses[] = {BodyPose({0.3, -0.2, 2}, 0, 0, 0) * CameraInBody(), RandomPose(rng),
                                      BodyPose({0.3, -0.2, 2}, 2 * std::numbers::pi / width * 0.5, 0.3, 0) * CameraInBody()};
      for (const RigidTransform& X_WC : poses) {
        Frame still, turned;
        renderer->Render(MakeRequest(camera, X_WC, Tier::kFast, kEverything), still);
        for (int k : {1, 3, 16, 50, width - 1}) {
          RigidTransform X = X_WC;
          X.R = X.R * RotationY(2 * std::numbers::pi * k / width);
          // Through a quaternion, as poses come from files.
          X.R = ToMatrix(ToQuaternion(X.R));
          renderer->Render(MakeRequest(camera, X, Tier::kFast, kEverything), turned);
          EXPECT_EQ(turned.entity, Rolled(still.entity, k)) << k;
          EXPECT_EQ(turned.semantic, Rolled(still.semantic, k)) << k;
          EXPECT_EQ(turned.range, Rolled(still.range, k)) << k;
          EXPECT_EQ(turned.normal, Rolled(still.normal, k)) << k;
          EXPECT_EQ(turned.rgb, Rolled(still.rgb, k)) << k;
        }
      }
    }
  }
}

TEST(CpuRenderer, OneAndManyThreadsGiveTheSameBytes) {
  const RenderRequest request =
      MakeRequest(Equirectangular{320, 160}, BodyPose({0, 0, 2}, 0.4, 0.1, 0.2) * CameraInBody(), Tier::kFast, kEverything);
  Frame one, many;
  {
    const ThreadLimit limit(1);
    Square()->Render(request, one);
    // Building the ray tracer on one thread changes nothing either.
    EXPECT_EQ(Labels(*RendererOf(MakeOpenSquare()), request.camera, request.X_WC).range, one.range);
  }
  Square()->Render(request, many);
  EXPECT_EQ(one.rgb, many.rgb);
  EXPECT_EQ(one.entity, many.entity);
  EXPECT_EQ(one.range, many.range);
  EXPECT_EQ(one.normal, many.normal);
}

// Given up at once, and by another thread in the middle; tiers, and what the flag says, as a live picture has them.
TEST(CpuRenderer, APictureThatIsGivenUpEndsAndLeavesTheNextOneAsItIs) {
  const Camera camera = Equirectangular{512, 256};
  for (const Tier tier : {Tier::kLabels, Tier::kFast}) {
    const RenderRequest request = MakeRequest(camera, {}, tier, kEverything);
    Frame asked, whole;
    Room()->Render(request, whole);
    {
      const std::atomic<bool> wanted{false};
      const InterruptibleScope scope(wanted);
      EXPECT_THROW(Room()->Render(request, asked), Interrupted);
    }
    for (const int pause_us : {100, 1000, 3000}) {
      std::atomic<bool> wanted{true};
      std::jthread other([&] {
        std::this_thread::sleep_for(std::chrono::microseconds(pause_us));
        wanted = false;
      });
      const InterruptibleScope scope(wanted);
      try {
        Room()->Render(request, asked);
      } catch (const Interrupted&) {
      }
    }
    Room()->Render(request, asked);
    EXPECT_EQ(asked.rgb, whole.rgb);
    EXPECT_EQ(asked.range, whole.range);
    EXPECT_EQ(asked.entity, whole.entity);
  }
}

TEST(CpuRenderer, OthersPicturesAreNotGivenUp) {
  const std::atomic<bool> wanted{false};
  const InterruptibleScope scope(wanted);
  std::jthread other([] { EXPECT_NO_THROW(Labels(*Square(), Equirectangular{64, 32}, {})); });
}

TEST(CpuRenderer, AreasOfTheRoomCoverEveryPixelAndTheWholeSphere) {
  const auto renderer = Room();
  const Equirectangular camera{512, 256};
  // From the centre of the room, far enough above the cubes: opposite walls show equal solid angles.
  const Frame frame = Labels(*renderer, camera, BodyPose({0, 0, 5}, 0.3, 0, 0) * CameraInBody());
  std::map<EntityId, double> area;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) area[frame.entity(x, y)] += SolidAngle(camera, x, y);
  }
  double sum = 0;
  for (const auto& [entity, value] : area) {
    EXPECT_TRUE(entity >= 1 && entity <= 9);
    sum += value;
  }
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-6);
  // The ceiling, a square of half side a at height h: 4 asin(a^2 / (a^2 + h^2)).
  EXPECT_NEAR(area[6], 4 * std::asin(25.0 / 26), 5e-3);
}

TEST(CpuRenderer, ScalingTheWorldByTwoDoublesEveryRangeExactly) {
  const auto small = RendererOf(MakeRoom()), large = RendererOf(MakeRoom(2));
  RngStream rng(5, "poses");
  RigidTransform X_WC = RandomPose(rng);
  X_WC.p = VecCast<double>(VecCast<float>(X_WC.p));
  const Frame a = Labels(*small, Equirectangular{256, 128}, X_WC);
  X_WC.p = X_WC.p * 2.0;
  const Frame b = Labels(*large, Equirectangular{256, 128}, X_WC);
  EXPECT_EQ(a.entity, b.entity);
  for (size_t i = 0; i < a.range.size(); ++i) ASSERT_EQ(2 * a.range.pixels()[i], b.range.pixels()[i]);
}

TEST(CpuRenderer, PinholeAndPanoramaAgreeThroughTheProjection) {
  const auto renderer = Square();
  const RigidTransform X_WC = BodyPose({0, 0, 2.5}, 0.7, -0.2, 0.1) * CameraInBody();
  const Equirectangular erp{1024, 512};
  const Pinhole pinhole{160, 120, 90, 90, 80, 60};
  const Frame panorama = Labels(*renderer, erp, X_WC), picture = Labels(*renderer, pinhole, X_WC);
  int different = 0, inner = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Vec2d p = *RayToPixel(erp, *PixelToRay(pinhole, {x + 0.5, y + 0.5}));
      const int u = static_cast<int>(p.x) % 1024, v = static_cast<int>(p.y);
      // Inside a region of the panorama the picture shows the same entity at about the same range.
      bool edge = v < 1 || v > 510;
      for (int dy = -1; dy <= 1 && !edge; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) edge |= panorama.entity((u + dx + 1024) % 1024, v + dy) != panorama.entity(u, v);
      }
      if (edge) continue;
      ++inner;
      different += picture.entity(x, y) != panorama.entity(u, v);
      if (picture.range(x, y) > 0 && picture.range(x, y) < 8) {
        EXPECT_NEAR(picture.range(x, y) / panorama.range(u, v), 1, 0.05);
      }
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(inner, 15000);
}

TEST(CpuRenderer, CubeFacesAgreeWithThePanoramaAwayFromEdges) {
  const auto renderer = Square();
  const RigidTransform X_WC = BodyPose({0, 0, 2.5}, 0.7, -0.2, 0.1) * CameraInBody();
  const Equirectangular erp{256, 128};
  const Frame panorama = Labels(*renderer, erp, X_WC);
  int found = 0;
  for (int f = 0; f < 6; ++f) {
    const CubeFace face{static_cast<CubeFaceName>(f), 256};
    const Frame picture = Labels(*renderer, face, X_WC);
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 256; ++x) {
        const auto p = RayToPixel(face, *PixelToRay(erp, {x + 0.5, y + 0.5}));
        if (!p) continue;
        const int u = static_cast<int>(p->x), v = static_cast<int>(p->y);
        bool edge = u < 1 || v < 1 || u > 254 || v > 254;
        for (int dy = -1; dy <= 1 && !edge; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) edge |= picture.entity(u + dx, v + dy) != picture.entity(u, v);
        }
        if (edge) continue;
        ++found;
        EXPECT_EQ(picture.entity(u, v), panorama.entity(x, y)) << f << ' ' << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(found, 0.9 * 256 * 128);
}

TEST(CpuRenderer, NormalsAreUnitAndFaceTheCameraAlsoOnMirroredInstances) {
  const auto renderer = Room();
  RngStream rng(6, "poses");
  const RigidTransform X_WC = RandomPose(rng);
  const Equirectangular camera{256, 128};
  const Frame frame = Labels(*renderer, camera, X_WC);
  int mirrored = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      const Vec3f n = frame.normal(x, y);
      EXPECT_NEAR(Norm(n), 1, 1e-6);
      EXPECT_LT(Dot(VecCast<double>(n), X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5})), 0);
      mirrored += frame.entity(x, y) == 9;
    }
  }
  EXPECT_GT(mirrored, 20);
}

TEST(CpuRenderer, WhereNothingIsHitThereIsSkyWithRangeZeroAndNoNormal) {
  const auto scene = MakeOpenSquare();
  const auto renderer = RendererOf(scene);
  const Frame frame = Labels(*renderer, Equirectangular{128, 64}, BodyPose({0, 0, 30}, 0, 0, 0) * CameraInBody());
  for (int x = 0; x < 128; ++x) {
    EXPECT_EQ(frame.entity(x, 0), scene->sky_entity);
    EXPECT_EQ(frame.semantic(x, 0), scene->tree.At("sky"));
    EXPECT_EQ(frame.range(x, 0), 0);
    EXPECT_EQ(frame.normal(x, 0), Vec3f{});
    EXPECT_NEAR(frame.range(x, 63), 30 / std::sin(std::numbers::pi * (0.5 - 0.5 / 64)), 1e-4);
  }
}

TEST(CpuRenderer, MoreSamplesChangeColoursOnlyNearEdgesAndLeaveLabelsAlone) {
  const auto renderer = Square();
  RenderRequest request =
      MakeRequest(Equirectangular{256, 128}, BodyPose({0, 0, 2.5}, 0.7, -0.2, 0.1) * CameraInBody(), Tier::kFast, kEverything);
  request.edge_samples = 1;
  Frame rough, smooth;
  renderer->Render(request, rough);
  request.edge_samples = 8;
  const RenderStats stats = renderer->Render(request, smooth);
  EXPECT_EQ(rough.entity, smooth.entity);
  EXPECT_EQ(rough.range, smooth.range);
  EXPECT_GT(stats.rays, 256u * 128);
  // A pixel changes only where it differs from a neighbour in entity or in lightness.
  const auto luma = [&](int x, int y) {
    const Rgb8 c = rough.rgb(x, y);
    return (2 * c.r + 5 * c.g + c.b) >> 3;
  };
  int changed = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      if (rough.rgb(x, y) == smooth.rgb(x, y)) continue;
      ++changed;
      bool on_edge = false;
      for (const auto& [nx, ny] : {std::pair((x + 1) % 256, y), {(x + 255) % 256, y}, {x, std::min(y + 1, 127)}, {x, std::max(y - 1, 0)}}) {
        on_edge |= rough.entity(x, y) != rough.entity(nx, ny) || std::abs(luma(x, y) - luma(nx, ny)) > 15;
      }
      EXPECT_TRUE(on_edge) << x << " " << y;
    }
  }
  EXPECT_GT(changed, 200);
}

TEST(CpuRenderer, ProductsNotAskedForAreEmptyAndDoNotChangeTheOthers) {
  const auto renderer = Square();
  RenderRequest request =
      MakeRequest(Equirectangular{128, 64}, BodyPose({0, 0, 2.5}, 0.7, 0, 0) * CameraInBody(), Tier::kFast, kEverything);
  Frame all, color;
  renderer->Render(request, all);
  request.products = {.rgb = true, .range = false, .semantic = false, .entity = false, .normal = false};
  renderer->Render(request, color);
  EXPECT_EQ(color.rgb, all.rgb);
  EXPECT_TRUE(color.entity.empty() && color.range.empty() && color.semantic.empty() && color.normal.empty());
  request.tier = Tier::kLabels;
  request.products = kEverything;
  renderer->Render(request, color);
  EXPECT_TRUE(color.rgb.empty());
  EXPECT_EQ(color.entity, all.entity);
  EXPECT_EQ(color.range, all.range);
}

TEST(CpuRenderer, ImagesKeepTheirMemoryBetweenCaptures) {
  const auto renderer = Room();
  Frame frame = Labels(*renderer, Equirectangular{128, 64}, BodyPose({0, 0, 5}, 0, 0, 0) * CameraInBody());
  const float* before = frame.range.pixels().data();
  renderer->Render(MakeRequest(Equirectangular{128, 64}, BodyPose({0, 0, 4}, 1, 0, 0) * CameraInBody(), Tier::kLabels, kAllLabels), frame);
  EXPECT_EQ(frame.range.pixels().data(), before);
}

TEST(CpuRenderer, ACameraWithoutPixelsOrPlaceIsAnInputError) {
  const auto renderer = Room();
  Frame frame;
  EXPECT_THROW(renderer->Render(MakeRequest(Equirectangular{0, 0}, {}, Tier::kLabels), frame), InputError);
  EXPECT_THROW(renderer->Render(MakeRequest(Equirectangular{64, 32}, {{}, {0, std::nan(""), 0}}, Tier::kLabels), frame), InputError);
}

TEST(NullRenderer, GivesSkyEverywhere) {
  const auto scene = MakeOpenSquare();
  Frame frame;
  const RenderStats stats = MakeNullRenderer(scene)->Render(MakeRequest(Equirectangular{64, 32}, {}, Tier::kFast), frame);
  EXPECT_EQ(stats.rays, 0u);
  EXPECT_EQ(frame.rgb.size(), 64u * 32);
  for (EntityId id : frame.entity.pixels()) EXPECT_EQ(id, scene->sky_entity);
  for (float range : frame.range.pixels()) EXPECT_EQ(range, 0);
}

}  // namespace
}  // namespace airsim360
