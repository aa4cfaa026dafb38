// box_room has a closed form: every label of every pixel can be computed by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The plane that a ray meets first, from the numbers of docs/reference/contracts.md alone.
struct Answer {
  double range = kInfinity;
  int side = -1;                  ///< 0..5: room x-, x+, y-, y+, floor, ceiling; 6..11: the cube's faces, same order
  double edge_angle = kInfinity;  ///< angle to the nearest edge of the face, radians (a lower bound)
};

constexpr std::array<Vec3d, 2> kRoom = {Vec3d{-5, -5, 0}, Vec3d{5, 5, 6}};
constexpr std::array<Vec3d, 2> kCube = {Vec3d{2.5, -0.5, 0}, Vec3d{3.5, 0.5, 1}};

// Nearest face of a box along a ray; `inside`: the faces seen from within.
void Meet(const std::array<Vec3d, 2>& box, int first_side, bool inside, Vec3d origin, Vec3d ray, Answer& answer) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const double t = (box[end][axis] - origin[axis]) / ray[axis];
      const bool facing = (ray[axis] > 0) == ((end == 1) == inside);
      if (!(t > 0) || t >= answer.range || !facing) continue;
      const Vec3d p = origin + ray * t;
      double margin = kInfinity;  // distance from the face's border, negative outside
      for (int other = 0; other < 3; ++other) {
        if (other != axis) margin = std::min({margin, p[other] - box[0][other], box[1][other] - p[other]});
      }
      if (margin >= 0) answer = {t, first_side + 2 * axis + end, 0};
    }
  }
}

// Angle between a ray and a segment seen from `origin`, by sampling the closest point of the segment's line.
double AngleToSegment(Vec3d origin, Vec3d ray, Vec3d a, Vec3d b) {
  const Vec3d p = a - origin, e = b - a;
  // The point p + s e that minimises the angle to `ray` lies where the plane of p, e and the plane across
  // meet.
  const Vec3d n = Normalized(Cross(p, e));
  const Vec3d flat = ray - n * Dot(n, ray);  // projection of the ray into the plane of the segment and the eye
  const Vec3d side = Cross(n, flat);
  const double denominator = Dot(e, side);
  double s = std::abs(denominator) > 1e-15 ? -Dot(p, side) / denominator : 0;
  if (Dot(p + e * s, flat) < 0) s = Dot(p, ray) > Dot(p + e, ray) ? 0 : 1;
  const Vec3d q = Normalized(p + e * std::clamp(s, 0.0, 1.0));
  return std::atan2(Norm(Cross(q, ray)), Dot(q, ray));
}

double AngleToNearestEdge(Vec3d origin, Vec3d ray) {
  double nearest = kInfinity;
  for (const auto& box : {kRoom, kCube}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 4; ++k) {
        Vec3d a = box[0], b = box[0];
        a[(axis + 1) % 3] = b[(axis + 1) % 3] = box[k & 1][(axis + 1) % 3];
        a[(axis + 2) % 3] = b[(axis + 2) % 3] = box[k >> 1][(axis + 2) % 3];
        a[axis] = box[0][axis];
        b[axis] = box[1][axis];
        nearest = std::min(nearest, AngleToSegment(origin, ray, a, b));
      }
    }
  }
  return nearest;
}

class BoxRoom : public testing::Test {
 protected:
  std::shared_ptr<const Scene> scene_ = BuildWorld("box_room", {});
  std::unique_ptr<Renderer> renderer_ = MakeCpuRenderer(std::make_shared<RayTracer>(scene_));
};

TEST_F(BoxRoom, HasSevenEntities) {
  EXPECT_EQ(scene_->entities.size(), 7u);
  EXPECT_EQ(scene_->sky_entity, kNoEntity);
}

TEST_F(BoxRoom, EveryLabelOfEveryPixelIsTheClosedFormFromTwentyRandomPoses) {
  constexpr int kPoses = 20, kWidth = 512, kHeight = 256;
  RngStream rng(2026, "box_room poses");
  std::map<int, EntityId> entity_of_side;
  std::map<EntityId, int> side_of_entity;
  double worst_range = 0;
  for (int pose = 0; pose < kPoses; ++pose) {
    Vec3d p;
    do {
      p = {rng.Uniform(-4.9, 4.9), rng.Uniform(-4.9, 4.9), rng.Uniform(0.1, 5.9)};
    } while (p.x > 2.4 && p.x < 3.6 && std::abs(p.y) < 0.6 && p.z < 1.1);
    const double pi = std::numbers::pi;
    RenderRequest request = MakeRequest(Equirectangular{kWidth, kHeight},
                                        BodyPose(p, rng.Uniform(-pi, pi), rng.Uniform(-1.5, 1.5), rng.Uniform(-pi, pi)) * CameraInBody(),
                                        Tier::kLabels, {.rgb = false, .normal = true});
    Frame frame;
    renderer_->Render(request, frame);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Vec3d ray = request.X_WC.R * *PixelToRay(request.camera, {x + 0.5, y + 0.5});
        if (AngleToNearestEdge(p, ray) <= 1e-4) continue;
        Answer answer;
        Meet(kRoom, 0, true, p, ray, answer);
        Meet(kCube, 6, false, p, ray, answer);
        // The same side always shows the same entity, and the six sides of the room and the cube seven of
        // them.
        const int side = std::min(answer.side, 6);
        const EntityId id = frame.entity(x, y);
        ASSERT_EQ(entity_of_side.try_emplace(side, id).first->second, id) << "pose " << pose << " pixel " << x << " " << y;
        ASSERT_EQ(side_of_entity.try_emplace(id, side).first->second, side);
        ASSERT_EQ(frame.semantic(x, y), scene_->entity(id).category);
        worst_range = std::max(worst_range, std::abs(frame.range(x, y) / answer.range - 1));
        Vec3d normal;
        normal[(answer.side % 6) / 2] = (answer.side % 2 == 1) == (answer.side < 6) ? -1 : 1;
        ASSERT_LT(Norm(VecCast<double>(frame.normal(x, y)) - normal), 1e-5) << "side " << answer.side;
      }
    }
  }
  EXPECT_LE(worst_range, 1e-5);
  EXPECT_EQ(side_of_entity.size(), 7u);
  RecordProperty("worst_relative_range_error", std::to_string(worst_range));
  std::printf("worst relative range error %.3g\n", worst_range);

  // Names and categories say what the sides are.
  const auto path = [&](int side) { return scene_->tree[scene_->entity(entity_of_side[side]).category].path; };
  EXPECT_EQ(path(4), "ground/floor");
  EXPECT_EQ(path(5), "construction/ceiling");
  for (int wall : {0, 1, 2, 3}) EXPECT_EQ(path(wall), "construction/wall");
}

TEST_F(BoxRoom, EntityAreasAddUpToAllPixels) {
  RenderRequest request = MakeRequest(Equirectangular{256, 128}, BodyPose({0, 1, 2}, 0.3, 0.2, 0.1) * CameraInBody(), Tier::kLabels);
  Frame frame;
  renderer_->Render(request, frame);
  std::map<EntityId, int> area;
  for (EntityId id : frame.entity.pixels()) ++area[id];
  int sum = 0;
  for (const auto& [id, count] : area) {
    EXPECT_TRUE(id >= 1 && id <= 7) << id;
    sum += count;
  }
  EXPECT_EQ(sum, 256 * 128);
}

}  // namespace
}  // namespace airsim360
