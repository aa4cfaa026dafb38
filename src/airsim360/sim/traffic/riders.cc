#include "airsim360/sim/traffic/riders.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/scene/scene_additions.h"

namespace airsim360::internal {
namespace {

// Of the bicycles of worlds/props: metres from the middle of the wheels.
constexpr Vec3d kSeat{-0.27, 0, 0.93}, kGrip{0.17, 0.27, 1.03};
constexpr Vec3d kPedalDown{-0.09, 0.125, 0.13}, kPedalUp{-0.09, -0.125, 0.47};
constexpr double kOnSeat = 0.07;  // from the saddle to the joint of the pelvis
constexpr double kLean = 0.42;    // radians of the trunk
constexpr size_t kFaces = 12;     // different riders
constexpr int kLevel = 1;         // of detail

// Turns a bone that hangs down at zero along `along`; its front side looks as far to `front` as that lets it.
Mat3d BoneAlong(Vec3d along, Vec3d front) {
  const Vec3d z = Normalized(along) * -1.0, y = Normalized(Cross(z, front));
  return Mat3d::FromColumns(Cross(y, z), y, z);
}

/// Puts joints where they belong, parents first.
class Rig {
 public:
  explicit Rig(const Body& body) : body_(body) {}

  void Root(Vec3d p, const Mat3d& A) {
    pose_.X_WJ[0] = {A * body_.R_zero[0], p};
    zero_[0] = A;
  }
  // `A`: the turn from zero, axes of P.
  void Turn(Joint joint, const Mat3d& A) {
    const auto j = static_cast<size_t>(joint), parent = static_cast<size_t>(ParentOf(joint));
    zero_[j] = A;
    pose_.X_WJ[j] = {A * body_.R_zero[j], pose_.X_WJ[parent].p + pose_.X_WJ[parent].R * (body_.p_PJ[j] - body_.p_PJ[parent])};
  }
  void Follow(Joint joint) { Turn(joint, zero_[static_cast<size_t>(ParentOf(joint))]); }
  /// Two bones from `first` on that reach as near to `target` as they can, their knee or elbow towards `bend`. The front of the
  /// bones is the side of the bend, or the one away from it.
  void Reach(Joint first, Joint second, Joint end, Vec3d target, Vec3d bend, double front) {
    Follow(first);
    const Vec3d from = pose_[first].p;
    const double a = Length(first, second), b = Length(second, end);
    const Vec3d to = target - from;
    const double d = std::clamp(Norm(to), std::abs(a - b) + 0.01, a + b - 0.002);
    const Vec3d u = Normalized(to), side = Normalized(bend - u * Dot(bend, u));
    const double along = (a * a + d * d - b * b) / (2 * d);
    const Vec3d joint = from + u * along + side * std::sqrt(std::max(0.0, a * a - along * along));
    Turn(first, BoneAlong(joint - from, side * front));
    Turn(second, BoneAlong(from + u * d - joint, side * front));
  }
  SkeletonPose pose() const { return pose_; }

 private:
  double Length(Joint a, Joint b) const { return Norm(body_.p_PJ[static_cast<size_t>(b)] - body_.p_PJ[static_cast<size_t>(a)]); }

  const Body& body_;
  SkeletonPose pose_;
  std::array<Mat3d, kJointCount> zero_;
};

void PlaceArm(bool left, Rig& rig) {
  const auto joint = [&](Joint l, Joint r) { return left ? l : r; };
  const double side = left ? 1 : -1;
  const Vec3d wrist{kGrip.x - 0.07, side * kGrip.y, kGrip.z + 0.03};
  rig.Follow(joint(Joint::kLeftClavicle, Joint::kRightClavicle));
  rig.Reach(joint(Joint::kLeftShoulder, Joint::kRightShoulder), joint(Joint::kLeftElbow, Joint::kRightElbow),
            joint(Joint::kLeftWrist, Joint::kRightWrist), wrist, {-0.2, side * 0.6, -1}, -1);
  // Palms down, fingers round the bar.
  const Mat3d hand = BoneAlong({1, 0, -0.15}, {0, side * -1.0, 0.2});
  rig.Turn(joint(Joint::kLeftWrist, Joint::kRightWrist), hand);
  const Mat3d curl = RotationX(side * -0.9);
  rig.Turn(joint(Joint::kLeftFingers1, Joint::kRightFingers1), hand * curl);
  rig.Turn(joint(Joint::kLeftFingers2, Joint::kRightFingers2), hand * curl * curl);
  rig.Turn(joint(Joint::kLeftThumb1, Joint::kRightThumb1), hand);
  rig.Turn(joint(Joint::kLeftThumb2, Joint::kRightThumb2), hand);
}

void PlaceLeg(bool left, const Body& body, Rig& rig) {
  const auto joint = [&](Joint l, Joint r) { return left ? l : r; };
  const Vec3d pedal = left ? kPedalDown : kPedalUp, ankle = pedal + Vec3d{-body.size.ball_length, 0, body.size.ankle_height + 0.01};
  rig.Reach(joint(Joint::kLeftHip, Joint::kRightHip), joint(Joint::kLeftKnee, Joint::kRightKnee),
            joint(Joint::kLeftAnkle, Joint::kRightAnkle), ankle, {1, 0, 0.3}, 1);
  rig.Turn(joint(Joint::kLeftAnkle, Joint::kRightAnkle), Mat3d{});
  rig.Turn(joint(Joint::kLeftToes, Joint::kRightToes), Mat3d{});
}

/// The body in its pose, without what people carry.
Mesh PosedMesh(const Body& body, int level, const SkeletonPose& pose) {
  constexpr float kOut = 1e-3f;
  Body outwards = body;
  Mesh& shape = outwards.levels[static_cast<size_t>(level)].mesh;
  for (size_t v = 0; v < shape.normals.size(); ++v) shape.positions[v] = shape.positions[v] + shape.normals[v] * kOut;
  std::vector<Vec3f> out;
  Mesh mesh = body.levels[static_cast<size_t>(level)].mesh;
  SkinBody(body, level, pose, {}, mesh.positions);
  SkinBody(outwards, level, pose, {}, out);
  for (size_t v = 0; v < mesh.normals.size(); ++v) mesh.normals[v] = Normalized(out[v] - mesh.positions[v]);
  std::vector<Vec3u> triangles;
  std::vector<MeshPart> parts;
  for (const MeshPart& part : mesh.parts) {
    if (part.entity != kNoEntity) continue;
    const auto first = mesh.triangles.begin() + part.first_triangle;
    parts.push_back({static_cast<uint32_t>(triangles.size()), part.triangle_count, part.material, kNoEntity});
    triangles.insert(triangles.end(), first, first + part.triangle_count);
  }
  mesh.triangles = std::move(triangles);
  mesh.parts = std::move(parts);
  return mesh;
}

std::shared_ptr<const Body> MakeRider(uint64_t seed, size_t face) {
  RngStream rng(seed, "rider", face);
  BodySpec spec{.sex = rng.Chance(0.5) ? Sex::kFemale : Sex::kMale, .age = rng.Uniform(18, 65)};
  spec.stature = spec.sex == Sex::kFemale ? rng.Uniform(1.62, 1.74) : rng.Uniform(1.68, 1.84);
  spec.build = rng.Uniform(-0.8, 0.4);
  spec.look = rng.Bits();
  auto body = std::make_shared<Body>(*MakeBody(spec, kLevel));
  int level = std::min(kLevel, static_cast<int>(body->levels.size()) - 1);
  while (body->levels[static_cast<size_t>(level)].mesh.triangles.empty()) ++level;
  body->levels[static_cast<size_t>(level)].mesh = PosedMesh(*body, level, RidingPose(*body));
  return body;
}

}  // namespace

SkeletonPose RidingPose(const Body& body) {
  Rig rig(body);
  rig.Root(kSeat + Vec3d{0, 0, kOnSeat}, RotationY(0.4 * kLean));
  rig.Turn(Joint::kSpine1, RotationY(0.7 * kLean));
  rig.Turn(Joint::kSpine2, RotationY(kLean));
  rig.Turn(Joint::kSpine3, RotationY(1.15 * kLean));
  rig.Turn(Joint::kNeck, RotationY(0.6 * kLean));
  rig.Turn(Joint::kHead, RotationY(0.1));
  for (const bool left : {true, false}) {
    PlaceArm(left, rig);
    PlaceLeg(left, body, rig);
  }
  return rig.pose();
}

std::shared_ptr<Scene> AddRiders(std::shared_ptr<Scene> scene, const TrafficModel& model, std::vector<TrafficBody>& bodies) {
  std::vector<PersonInScene> riders;
  std::vector<size_t> of;
  std::vector<std::shared_ptr<const Body>> faces;
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (!model.vehicles[i].shape.bicycle) continue;
    if (faces.size() < kFaces) faces.push_back(MakeRider(model.seed, faces.size()));
    riders.push_back({"rider/" + bodies[i].name.substr(bodies[i].name.find('/') + 1), faces[riders.size() % kFaces], kLevel});
    of.push_back(i);
  }
  if (riders.empty()) return scene;
  std::vector<PersonRef> refs;
  std::shared_ptr<Scene> own = OwnScene(AddPeople(std::move(scene), riders, refs));
  for (size_t k = 0; k < refs.size(); ++k) {
    bodies[of[k]].rider = refs[k].instance;
    bodies[of[k]].rider_entity = refs[k].entity;
    own->entities[refs[k].entity - 1].category = own->tree.At("human/rider");
  }
  return own;
}

}  // namespace airsim360::internal
