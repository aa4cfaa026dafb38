// Labels of people against rendered pictures, independent rays and independent skinning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/sim/people/silhouette.h"
#include "airsim360/sim/people/test_people.h"

namespace airsim360 {
namespace {

using internal::LevelCamera;
using internal::PeopledRoom;

// Someone alone, someone behind the box, someone behind someone, someone across the seam.
std::vector<internal::Stand> Crowd() {
  return {{{2.2, 0.1, 0}, 3.0}, {{4.3, 0.1, 0}, 3.1}, {{0.5, 3.0, 0}, -1.2},
          {{0.8, 4.2, 0}, 0.4}, {{-3, 0.05, 0}, 1.0}, {{-2, -3, 0}, 2.2}};
}
constexpr Vec3d kEye{-0.2, 0, 1.5};

const PeopledRoom& LabelledRoom() {
  static const PeopledRoom room(Crowd());
  return room;
}

// Whether a triangle is in front of a point, in double precision (Moeller, Trumbore 1997): distance along the
// segment in [0, 1), or 1.
double Block(Vec3d from, Vec3d to, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d d = to - from, e1 = b - a, e2 = c - a, p = Cross(d, e2);
  const double det = Dot(e1, p);
  if (std::abs(det) < 1e-18) return 1;
  const Vec3d s = from - a, q = Cross(s, e1);
  const double u = Dot(s, p) / det, v = Dot(d, q) / det, t = Dot(e2, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1 ? t : 1;
}

// What is first on the way to a point, and where, by looking at every triangle.
std::pair<EntityId, double> FirstOnTheWay(const PeopledRoom& room, Vec3d from, Vec3d to) {
  EntityId first = kNoEntity;
  double nearest = 1;
  for (uint32_t i = 0; i < room.scene->instances.size(); ++i) {
    const Instance& instance = room.scene->instances[i];
    const Mesh& mesh = room.scene->meshes[instance.mesh];
    const auto positions = room.tracer->Positions(instance.mesh);
    const AffineTransform& X_WM = room.tracer->Place(i);
    for (const MeshPart& part : mesh.parts) {
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        Vec3d corners[3];
        for (int j = 0; j < 3; ++j) corners[j] = VecCast<double>(X_WM * positions[mesh.triangles[k][j]]);
        const double t = Block(from, to, corners[0], corners[1], corners[2]);
        if (t >= nearest) continue;
        nearest = t;
        first = part.entity != kNoEntity ? part.entity : instance.entity;
      }
    }
  }
  return {first, nearest};
}

TEST(PeopleLabels, VisibilityAgreesWithIndependentRays) {
  const PeopledRoom& room = LabelledRoom();
  const Camera camera = Equirectangular{512, 256};
  const auto labels = LabelPeople(room.Picture(camera, LevelCamera(kEye)), {.boxes = false});
  ASSERT_EQ(labels.size(), Crowd().size());
  int same = 0, all = 0;
  std::set<KeypointState> seen;
  for (const PersonLabel& label : labels) {
    const auto& sockets = room.people->cast[label.person].body->sockets;
    for (size_t i = 0; i < label.keypoints.size(); ++i) {
      const KeypointLabel& k = label.keypoints[i];
      const auto [entity, t] = FirstOnTheWay(room, kEye, k.p_W);
      const double before = (1 - t) * k.range;  // metres from what is first to the point
      KeypointState expected = KeypointState::kVisible;
      if (entity == label.entity) {
        if (before > 1.3 * sockets[i].radius + 0.01) expected = KeypointState::kBehindOneself;
      } else if (entity != kNoEntity && before > 0.005) {
        expected = room.scene->entity(entity).name.starts_with("person/") ? KeypointState::kBehindPerson : KeypointState::kBehindScene;
      }
      ++all;
      // What the pixels of the picture resolve is no matter of rays to the points.
      const KeypointState found = k.state == KeypointState::kUnresolved ? KeypointState::kVisible : k.state;
      same += expected == found && (found == KeypointState::kVisible || k.occluder == entity);
      seen.insert(found);
    }
  }
  EXPECT_GE(same, 0.99 * all) << same << " of " << all;
  // The scene was made so that all kinds occur.
  EXPECT_EQ(seen.size(), 4u);
}

struct Landing {
  int visible = 0, on = 0, unresolved = 0;
};

// Visible keypoints whose pixel or one around it shows their own person.
Landing CountLandings(const PeopledRoom& room, const Camera& camera, const RigidTransform& X_WC) {
  const Frame frame = room.Render(camera, X_WC);
  const int w = Width(camera), h = Height(camera);
  Landing count;
  for (const PersonLabel& label : LabelPeople(room.Picture(camera, X_WC), {.boxes = false})) {
    for (const KeypointLabel& k : label.keypoints) {
      count.unresolved += k.state == KeypointState::kUnresolved;
      if (k.state != KeypointState::kVisible) continue;
      bool found = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = (static_cast<int>(k.pixel.x) + dx + w) % w, y = std::clamp(static_cast<int>(k.pixel.y) + dy, 0, h - 1);
          found |= frame.entity(x, y) == label.entity;
        }
      }
      ++count.visible;
      count.on += found;
    }
  }
  return count;
}

TEST(PeopleLabels, VisibleKeypointsLandOnTheirOwnPerson) {
  for (const int width : {2048, 256}) {
    const Landing count = CountLandings(LabelledRoom(), Equirectangular{width, width / 2}, LevelCamera(kEye));
    EXPECT_GT(count.visible, 80);
    EXPECT_EQ(count.on, count.visible) << width;
  }
}

TEST(PeopleLabels, PicturesTooCoarseForALimbSaySo) {
  // Nine metres away a pixel is 44 cm wide or 3 cm.
  const PeopledRoom room({{{4.5, 0.3, 0}, 3.0}, {{4.4, -2, 0}, 2.5}, {{4.2, 2.1, 0}, 1.0}});
  const Landing coarse = CountLandings(room, Equirectangular{128, 64}, LevelCamera({-4.5, 0, 1.5}));
  EXPECT_GT(coarse.unresolved, 3);
  EXPECT_EQ(coarse.on, coarse.visible);
  const Landing fine = CountLandings(room, Equirectangular{2048, 1024}, LevelCamera({-4.5, 0, 1.5}));
  EXPECT_EQ(fine.unresolved, 0);
  EXPECT_EQ(fine.on, fine.visible);
}

TEST(PeopleLabels, KeypointsFollowTheSkin) {
  // A vertex fixed to the joint at the place of every socket, skinned like all others, in a pose with every
  // joint turned.
  const auto original = MakeProceduralBody(internal::DrawBodySpec(3, 1));
  Body body = *original;
  BodyLevel level;
  const SkeletonPose rest = RestPose(body, {});
  for (const Socket& socket : body.sockets) {
    level.mesh.positions.push_back(VecCast<float>(SocketPosition(socket, rest)));
    Influences in;
    in.joint[0] = static_cast<uint8_t>(socket.joint);
    in.weight[0] = 1;
    level.influences.push_back(in);
  }
  level.body_vertices = static_cast<uint32_t>(level.mesh.positions.size());
  body.levels = {level};
  SkeletonPose pose = RestPose(body, {RotationZ(1.0), {431, -212, 7}});
  for (int j = 0; j < kJointCount; ++j) {
    RigidTransform& X = pose.X_WJ[static_cast<size_t>(j)];
    X.R = X.R * RotationX(0.1 * j) * RotationY(0.2 - 0.05 * j);
  }
  std::vector<Vec3f> skinned;
  SkinBody(body, 0, pose, pose.X_WP.p, skinned);
  for (size_t i = 0; i < body.sockets.size(); ++i) {
    const Vec3d p = SocketPosition(body.sockets[i], pose);
    EXPECT_LT(Norm(VecCast<double>(skinned[i]) + pose.X_WP.p - p), 1e-4) << body.sockets[i].name;
  }
}

TEST(PeopleLabels, PositionsAreConsistentInAllFrames) {
  const PeopledRoom& room = LabelledRoom();
  const Camera camera = Equirectangular{1024, 512};
  const RigidTransform X_WC = BodyPose(kEye, 0.7, -0.35, 0.1) * CameraInBody();
  for (const PersonLabel& label : LabelPeople(room.Picture(camera, X_WC))) {
    for (const KeypointLabel& k : label.keypoints) {
      EXPECT_LT(Norm(X_WC * k.p_C - k.p_W), 1e-9);
      EXPECT_LT(Norm(DirectionOf(k.lon, k.lat) * k.range - k.p_C), 1e-9);
      EXPECT_NEAR(k.pixel.x, (k.lon / (2 * std::numbers::pi) + 0.5) * 1024, 1e-9);
      EXPECT_NEAR(k.pixel.y, (0.5 - k.lat / std::numbers::pi) * 512, 1e-9);
    }
    EXPECT_LT(Norm(X_WC * label.box3d.center_C - label.box3d.center_W), 1e-9);
  }
}

int64_t CountPixels(const Frame& frame, EntityId entity) { return std::ranges::count(frame.entity.pixels(), entity); }

// Triangles of all sizes around a pinhole, most of them partly behind it: a pixel is covered if its ray meets one.
TEST(PeopleLabels, SilhouettesOfTrianglesThatReachBehindTheCameraAreWhatRaysMeet) {
  RngStream random(3, "triangles");
  const auto draw = [&](float size) {
    const auto in = [&] { return static_cast<float>(random.Uniform(-1.0, 1.0)) * size; };
    return Vec3f{in(), in(), in()};
  };
  int covered = 0, behind = 0;
  for (int k = 0; k < 600; ++k) {
    const Camera camera = k % 3 == 0 ? Camera{CubeFace{static_cast<CubeFaceName>(k % 6), 24}} : Camera{Pinhole{28, 20, 20, 22, 13, 9}};
    const PixelDirections directions(camera);
    const Vec3f middle = draw(1.5f);
    const float size = std::pow(10.0f, static_cast<float>(random.Uniform(-1.0, 1.0)));
    const std::vector<Vec3f> corners{middle + draw(size), middle + draw(size), middle + draw(size)};
    const std::vector<Vec3u> triangles{{0, 1, 2}};
    const Silhouette found = FindSilhouette(directions, corners, triangles);
    int64_t expected = 0;
    for (int y = 0; y < Height(camera); ++y)
      for (int x = 0; x < Width(camera); ++x) {
        const Vec3d d = VecCast<double>(directions.At(x, y));
        expected += Block({}, d * 1e4, VecCast<double>(corners[0]), VecCast<double>(corners[1]), VecCast<double>(corners[2])) < 1;
      }
    // Rays along an edge may be on either side.
    EXPECT_NEAR(static_cast<double>(found.pixels), static_cast<double>(expected), 2) << k;
    covered += expected > 0;
    behind += std::ranges::count_if(corners, [](Vec3f p) { return p.z < 0; }) % 3 != 0;
  }
  EXPECT_GT(covered, 100);
  EXPECT_GT(behind, 200);
}

TEST(PeopleLabels, AmodalSilhouettesAreThePicturesOfPeopleAlone) {
  const Camera cameras[] = {Equirectangular{1024, 512}, Pinhole{640, 480, 400, 400, 320, 240}, Fisheye::Equidistant(512, 512, 3.0)};
  // Alone in the room, straight ahead, across the seam, and below the camera.
  const std::pair<internal::Stand, double> cases[] = {{{{2, 0.3, 0}, 1}, 0.0}, {{{-2.1, 0, 0}, 1}, 0.0}, {{{-0.15, 0.05, 0}, 2}, 0.0}};
  for (const auto& [stand, yaw] : cases) {
    const PeopledRoom room({stand});
    const RigidTransform X_WC = LevelCamera({-0.2, 0, 2.6}, yaw);
    for (const Camera& camera : cameras) {
      const auto labels = LabelPeople(room.Picture(camera, X_WC));
      const Frame frame = room.Render(camera, X_WC);
      const auto shown = static_cast<double>(CountPixels(frame, room.people->refs[0].entity));
      if (labels.empty()) {
        EXPECT_EQ(shown, 0);
        continue;
      }
      EXPECT_NEAR(static_cast<double>(labels[0].amodal.pixels), shown, 2 + 0.002 * shown);
      if (shown == 0) continue;
      // Every pixel of the person is inside the box, and the box touches them.
      const PictureBox box = *labels[0].amodal.box;
      int x0 = 1 << 20, x1 = -1, y0 = 1 << 20, y1 = -1;
      const int w = Width(camera);
      for (int y = 0; y < frame.entity.height(); ++y) {
        for (int x = 0; x < w; ++x) {
          if (frame.entity(x, y) != room.people->refs[0].entity) continue;
          const int column = x < box.x ? x + w : x;
          x0 = std::min(x0, column), x1 = std::max(x1, column), y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
      }
      EXPECT_NEAR(box.x, x0, 1);
      EXPECT_NEAR(box.x + box.w - 1, x1, 1);
      EXPECT_NEAR(box.y, y0, 1);
      EXPECT_NEAR(box.y + box.h - 1, y1, 1);
    }
  }
}

TEST(PeopleLabels, SomeoneAcrossTheSeamHasOneNarrowBox) {
  const PeopledRoom room({{{-3, 0, 0}, 0.5}});
  const auto labels = LabelPeople(room.Picture(Equirectangular{1024, 512}, LevelCamera({0, 0, 1.5})));
  ASSERT_EQ(labels.size(), 1u);
  const PictureBox box = labels[0].amodal.box.value();
  EXPECT_GT(box.x + box.w, 1024);
  EXPECT_LT(box.w, 100);
  EXPECT_NEAR(std::abs(labels[0].amodal.bfov.lon), std::numbers::pi, 0.1);
  EXPECT_LT(labels[0].amodal.bfov.width, 0.6);
}

TEST(PeopleLabels, TheFieldOfViewAndTheBoxContainTheSkin) {
  const PeopledRoom& room = LabelledRoom();
  const RigidTransform X_WC = LevelCamera(kEye);
  for (const PersonLabel& label : LabelPeople(room.Picture(Equirectangular{512, 256}, X_WC))) {
    const PersonRef& ref = room.people->refs[label.person];
    const BodyLevel& level = room.people->cast[label.person].body->levels[static_cast<size_t>(ref.level)];
    const ViewAxes axes = AxesOf(label.amodal.bfov);
    const PersonBox3d& box = label.box3d;
    for (uint32_t v = 0; v < level.body_vertices; ++v) {
      const Vec3d p = VecCast<double>(room.tracer->Place(ref.instance) * room.tracer->Positions(ref.mesh)[v]);
      const Vec3d d = X_WC.inverse() * p;
      const double z = Dot(d, axes.forward);
      // 64 outer directions stand for all: to a hundredth of the angle.
      EXPECT_LE(std::abs(std::atan2(Dot(d, axes.right), z)), 0.505 * label.amodal.bfov.width + 1e-3);
      EXPECT_LE(std::abs(std::atan2(Dot(d, axes.down), z)), 0.505 * label.amodal.bfov.height + 1e-3);
      const Vec3d q = RotationZ(-box.yaw) * (p - box.center_W);
      EXPECT_LE(std::abs(q.x), box.length / 2 + 1e-5);
      EXPECT_LE(std::abs(q.y), box.width / 2 + 1e-5);
      EXPECT_LE(std::abs(q.z), box.height / 2 + 1e-5);
    }
    EXPECT_NEAR(box.height, room.people->cast[label.person].body->spec.stature, 0.08);
  }
}

TEST(PeopleLabels, AlphaIsTheHeadingAsSeenFromTheCamera) {
  // Walking away straight ahead: rotation_y -pi/2 and alpha -pi/2, as in KITTI; the same to the right of it.
  const PeopledRoom room({{{3, 0, 0}, 0}, {{0, -3, 0}, 0}});
  const auto labels = LabelPeople(room.Picture(Equirectangular{256, 128}, LevelCamera({0, 0, 1.5})));
  EXPECT_NEAR(labels[0].box3d.rotation_y, -std::numbers::pi / 2, 1e-6);
  EXPECT_NEAR(labels[0].box3d.alpha, -std::numbers::pi / 2, 0.05);
  EXPECT_NEAR(std::abs(labels[1].box3d.alpha), std::numbers::pi, 0.05);
}

TEST(PeopleLabels, DoNotDependOnThreads) {
  const PeopledRoom& room = LabelledRoom();
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> numbers;
    for (const PersonLabel& label : LabelPeople(room.Picture(Equirectangular{512, 256}, LevelCamera(kEye)))) {
      for (const KeypointLabel& k : label.keypoints) numbers.insert(numbers.end(), {k.lon, k.range, static_cast<double>(k.state)});
      numbers.insert(numbers.end(), {label.amodal.bfov.lon, label.amodal.rbfov.gamma, static_cast<double>(label.amodal.pixels)});
    }
    return numbers;
  };
  EXPECT_EQ(run(1), run(4));
}

}  // namespace
}  // namespace airsim360
