#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/high/gloss_filter.h"
#include "airsim360/render/indoor/test_rooms.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/luminance.h"

namespace airsim360 {
namespace {

using internal::FilterGloss, internal::GlossPlanes;

// A plane of one surface all over a picture of which light pixels are a pattern of 4 x 4.
struct Plane {
  static constexpr int kWidth = 64, kHeight = 48;
  Image<float> range{kWidth, kHeight};
  Image<EntityId> entity{kWidth, kHeight};
  Image<Vec3f> normal{kWidth, kHeight};
  GlossPlanes gloss;

  explicit Plane(float blur) {
    gloss.Resize(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        range(x, y) = 2, entity(x, y) = 1, normal(x, y) = {0, 0, 1};
        gloss.blur_x(x, y) = gloss.blur_y(x, y) = blur;
        const float light = static_cast<float>((x % 4) * 4 + y % 4);
        gloss.light(x, y) = {light, light, light};
      }
  }
  void Filter() { FilterGloss(range, entity, normal, false, gloss); }
};

TEST(GlossFilter, ThePatternOfSharedRaysLeavesNoTrace) {
  for (const float blur : {0.5f, 1.5f, 4.0f}) {
    Plane plane(blur);
    plane.Filter();
    for (int y = 16; y < 32; ++y)
      for (int x = 16; x < 48; ++x) ASSERT_NEAR(plane.gloss.light(x, y).g, 7.5f, 1e-4f) << blur << " " << x << " " << y;
  }
}

TEST(GlossFilter, OtherSurfacesAndNarrowLobesAreLeftAsTheyAre) {
  Plane plane(3.0f);
  for (int y = 0; y < Plane::kHeight; ++y)
    for (int x = 0; x < Plane::kWidth; ++x) {
      const float light = x < 32 ? 1.0f : 9.0f;
      plane.gloss.light(x, y) = {light, light, light};
      if (x >= 32) plane.entity(x, y) = 2;
    }
  plane.gloss.blur_x(10, 10) = plane.gloss.blur_y(10, 10) = 0.01f;
  plane.gloss.light(10, 10) = {5, 5, 5};
  plane.Filter();
  EXPECT_EQ(plane.gloss.light(10, 10).g, 5);
  EXPECT_NEAR(plane.gloss.light(31, 24).g, 1, 1e-5f);
  EXPECT_NEAR(plane.gloss.light(32, 24).g, 9, 1e-5f);
}

TEST(GlossFilter, HasTheWidthOfTheLobe) {
  for (const float blur : {2.0f, 4.0f}) {
    Plane plane(blur);
    for (Rgb32f& c : plane.gloss.light.pixels()) c = {};
    plane.gloss.light(32, 24) = {1, 1, 1};
    plane.Filter();
    double whole = 0, square = 0;
    for (int y = 0; y < Plane::kHeight; ++y)
      for (int x = 0; x < Plane::kWidth; ++x) {
        const double w = plane.gloss.light(x, y).g;
        whole += w, square += w * (x - 32) * (x - 32);
      }
    EXPECT_NEAR(whole, 1, 0.03) << blur;
    EXPECT_NEAR(std::sqrt(square / whole), blur, 0.15 * blur);
  }
}

TEST(GlossFilter, OneBrightRayBecomesOneHill) {
  for (const float blur : {2.0f, 4.0f, 7.0f, 9.0f}) {
    Plane plane(blur);
    for (Rgb32f& c : plane.gloss.light.pixels()) c = {};
    plane.gloss.light(32, 24) = {1, 1, 1};
    plane.Filter();
    const float top = plane.gloss.light(32, 24).g;
    for (int x = 33; x < Plane::kWidth; ++x)
      ASSERT_LT(plane.gloss.light(x, 24).g, plane.gloss.light(x - 1, 24).g + 0.02f * top) << blur << " " << x;
  }
}

// A small room with a window of light and a floor of two halves that shine.
constexpr float kRoughness[] = {0.2f, 0.4f};
std::shared_ptr<const RayTracer> ShinyRoom() {
  test::RoomScene room("shiny room");
  room.Box({0, 0, 0}, {3, 2.4f, 2.4f}, room.Paint({0.6f, 0.6f, 0.6f}), true, 1u << 4);
  for (const int half : {0, 1}) {
    Material floor;
    floor.name = "floor", floor.base_color = {0.2f, 0.2f, 0.2f}, floor.roughness = kRoughness[half];
    const float x = 1.5f * static_cast<float>(half);
    room.Quad({x, 0, 0}, {x + 1.5f, 0, 0}, {x + 1.5f, 2.4f, 0}, {x, 2.4f, 0}, room.builder().AddMaterial(floor), "ground/floor");
  }
  room.Quad({0.7f, 2.38f, 0.8f}, {2.3f, 2.38f, 0.8f}, {2.3f, 2.38f, 2.0f}, {0.7f, 2.38f, 2.0f}, room.Paint({}, {20, 20, 20}));
  return room.Build();
}

struct Shiny {
  std::shared_ptr<const RayTracer> tracer = ShinyRoom();
  std::unique_ptr<Renderer> renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});
};
Shiny& Room() {
  static Shiny room;
  return room;
}

Frame Render(Tier tier, int width, double yaw = 0) {
  RenderRequest request = MakeRequest(Equirectangular{width, width / 2}, BodyPose({1.5, 0.4, 1.4}, yaw, 0, 0) * CameraInBody(), tier,
                                      {.entity = true, .radiance = true});
  if (tier == Tier::kReference) request.samples = 96;
  Frame frame;
  Room().renderer->Render(request, frame);
  return frame;
}

// The half that is polished.
EntityId FirstFloor() {
  for (const Entity& entity : Room().tracer->scene().entities)
    if (Room().tracer->scene().tree[entity.category].path == "ground/floor") return entity.id;
  return kNoEntity;
}

TEST(HighGloss, FloorsMirrorAsMuchAsInTheReferenceAndWithoutSpecks) {
  const Frame high = Render(Tier::kHigh, 96), reference = Render(Tier::kReference, 96);
  int half = 0;
  for (const Entity& entity : Room().tracer->scene().entities) {
    if (Room().tracer->scene().tree[entity.category].path != "ground/floor") continue;
    double of_high = 0, of_reference = 0, most_high = 0, most_reference = 0;
    for (int y = 24; y < 48; ++y)
      for (int x = 0; x < 96; ++x) {
        if (high.entity(x, y) != entity.id) continue;
        const Rgb32f a = high.radiance(x, y), b = reference.radiance(x, y);
        const double weight = std::cos((0.5 - (y + 0.5) / 48) * M_PI);
        of_high += weight * a.g, of_reference += weight * b.g;
        most_high = std::max<double>(most_high, a.g), most_reference = std::max<double>(most_reference, b.g);
      }
    ASSERT_GT(of_reference, 0);
    EXPECT_NEAR(of_high / of_reference, 1, 0.06) << kRoughness[half];
    EXPECT_LT(most_high, 1.25 * most_reference) << kRoughness[half];
    ++half;
  }
  EXPECT_EQ(half, 2);
}

// Edge pixels show no ray as more than nearly white; what a lamp of a few pixels sends to the eye is all in the picture even so.
TEST(HighEdges, SmallLampsInRoomsHaveAllTheirLight) {
  constexpr int kWidth = 192;
  constexpr float kHalf = 0.08f, kLight = 2000, kFar = 1.98f;
  test::RoomScene room("room with a spot");
  room.Box({0, 0, 0}, {3, 2.4f, 2.4f}, room.Paint({0.1f, 0.1f, 0.1f}));
  room.Quad({1.5f - kHalf, 2.38f, 1.4f - kHalf}, {1.5f + kHalf, 2.38f, 1.4f - kHalf}, {1.5f + kHalf, 2.38f, 1.4f + kHalf},
            {1.5f - kHalf, 2.38f, 1.4f + kHalf}, room.Paint({}, {kLight, kLight, kLight}));
  const auto renderer = MakeCpuRenderer(room.Build(), {.tier = Tier::kHigh});
  const double right = kLight * 4 * std::asin(kHalf * kHalf / (kHalf * kHalf + kFar * kFar));  // of a pyramid's solid angle
  double sum = 0;
  constexpr int kPoses = 8;
  for (int k = 0; k < kPoses; ++k) {
    RenderRequest request =
        MakeRequest(Equirectangular{kWidth, kWidth / 2},
                    BodyPose({1.5, 0.4, 1.4 + 0.01 * k}, 2 * M_PI / kWidth * (k + 0.37) / kPoses, 0, 0) * CameraInBody(), Tier::kHigh,
                    {.entity = true, .radiance = true});
    Frame frame;
    renderer->Render(request, frame);
    for (int y = 0; y < kWidth / 2; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (frame.radiance(x, y).g < 1) continue;  // walls have half of it at most
        sum += frame.radiance(x, y).g * std::cos((0.5 - (y + 0.5) / (kWidth / 2)) * M_PI) * std::pow(2 * M_PI / kWidth, 2) / kPoses;
      }
  }
  RecordProperty("share", std::to_string(sum / right));
  EXPECT_NEAR(sum / right, 1, 0.06);
}

// Tier fast sends one ray where a floor is polished: window and dark wall are seen in it where the reference sees them.
TEST(FastGloss, PolishedFloorsMirrorTheirRoom) {
  const Frame fast = Render(Tier::kFast, 96), reference = Render(Tier::kReference, 96);
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = 26; y < 38; ++y)
    for (int x = 0; x < 96; ++x) {
      if (fast.entity(x, y) != FirstFloor()) continue;
      const double u = fast.radiance(x, y).g, v = reference.radiance(x, y).g;
      ++n, a += u, b += v, aa += u * u, bb += v * v, ab += u * v;
    }
  ASSERT_GT(n, 60);
  EXPECT_NEAR(a / b, 1, 0.12);
  EXPECT_GT((n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b)), 0.7);
}

TEST(HighGloss, TurningByColumnsAndThreadsChangeNoByte) {
  const Frame many = Render(Tier::kHigh, 96), turned = Render(Tier::kHigh, 96, 2 * M_PI * 5 / 96);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 96; ++x) ASSERT_EQ(turned.radiance(x, y), many.radiance((x + 96 - 5) % 96, y));
  const ThreadLimit limit(1);
  EXPECT_EQ(Render(Tier::kHigh, 96).radiance, many.radiance);
}

}  // namespace
}  // namespace airsim360
