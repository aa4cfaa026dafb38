#include "airsim360/sim/traffic/riders.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/scene/scene_additions.h"

namespace airsim360::internal {
namespace {

constexpr double kOnSeat = 0.07;   // from the saddle to the joint of the pelvis
constexpr double kLean = 0.42;     // radians of the trunk
constexpr double kUpright = 0.16;  // likewise, while one stands
constexpr double kDeepest = 1.2;   // likewise, for a bar that is far away
constexpr size_t kFaces = 12;      // different riders
constexpr int kLevel = 1;          // of detail
// Of feet, radians: the toes point down by 0.08 in front and by 0.48 behind.
constexpr double kToesDown = 0.28, kAnkling = 0.2;
// Standing: the pelvis comes that far before the saddle, metres; it is never lower than the frame lets it be.
constexpr double kBeforeSaddle = 0.2, kLowestPelvis = 0.88;
constexpr double kRests = 0.15, kWalks = 1.1;                           // m/s: a foot is down below, on its pedal above
constexpr double kStandingLean = 0.09;                                  // radians
constexpr double kFootForward = 0.06, kFootAside = 0.13, kLift = 0.06;  // metres from the hip, and over the straight way to the ground
constexpr double kSpare = 0.004;                                        // metres that a stretched leg keeps

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

Vec3d WristAt(const Perch& perch, bool left) { return {perch.grip.x - 0.07, (left ? 1 : -1) * perch.grip.y, perch.grip.z + 0.03}; }

void PlaceArm(const Perch& perch, bool left, Rig& rig) {
  const auto joint = [&](Joint l, Joint r) { return left ? l : r; };
  const double side = left ? 1 : -1;
  rig.Follow(joint(Joint::kLeftClavicle, Joint::kRightClavicle));
  rig.Reach(joint(Joint::kLeftShoulder, Joint::kRightShoulder), joint(Joint::kLeftElbow, Joint::kRightElbow),
            joint(Joint::kLeftWrist, Joint::kRightWrist), WristAt(perch, left), {-0.2, side * 0.6, -1}, -1);
  // Palms down, fingers round the bar.
  const Mat3d hand = BoneAlong({1, 0, -0.15}, {0, side * -1.0, 0.2});
  rig.Turn(joint(Joint::kLeftWrist, Joint::kRightWrist), hand);
  const Mat3d curl = RotationX(side * -0.9);
  rig.Turn(joint(Joint::kLeftFingers1, Joint::kRightFingers1), hand * curl);
  rig.Turn(joint(Joint::kLeftFingers2, Joint::kRightFingers2), hand * curl * curl);
  rig.Turn(joint(Joint::kLeftThumb1, Joint::kRightThumb1), hand);
  rig.Turn(joint(Joint::kLeftThumb2, Joint::kRightThumb2), hand);
}

void PlaceTrunk(Vec3d pelvis, double lean, Rig& rig) {
  rig.Root(pelvis, RotationY(0.4 * lean));
  rig.Turn(Joint::kSpine1, RotationY(0.7 * lean));
  rig.Turn(Joint::kSpine2, RotationY(lean));
  rig.Turn(Joint::kSpine3, RotationY(1.15 * lean));
  rig.Turn(Joint::kNeck, RotationY(0.6 * lean));
  rig.Turn(Joint::kHead, RotationY(0.1));
}

// At least by `lean`, and as far as the arms ask for it.
void LeanToBar(const Perch& perch, const Body& body, Vec3d pelvis, double lean, Rig& rig) {
  constexpr int kHalvings = 20;
  constexpr double kBent = 0.96;  // of the length of an arm
  const auto reaches = [&](double angle) {
    PlaceTrunk(pelvis, angle, rig);
    rig.Follow(Joint::kLeftClavicle);
    rig.Follow(Joint::kLeftShoulder);
    return Norm(WristAt(perch, true) - rig.pose()[Joint::kLeftShoulder].p) < kBent * (body.size.upper_arm + body.size.forearm);
  };
  if (reaches(lean)) return;
  double deep = kDeepest;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (lean + deep) / 2;
    (reaches(middle) ? deep : lean) = middle;
  }
  PlaceTrunk(pelvis, deep, rig);
}

// A foot: its joints and what it is like.
struct Foot {
  Joint hip, knee, ankle, toes;
  Vec3d ball;          // from the ankle, foot level
  double ball_height;  // over the sole

  Foot(const Body& body, bool left)
      : hip(left ? Joint::kLeftHip : Joint::kRightHip),
        knee(left ? Joint::kLeftKnee : Joint::kRightKnee),
        ankle(left ? Joint::kLeftAnkle : Joint::kRightAnkle),
        toes(left ? Joint::kLeftToes : Joint::kRightToes) {
    const auto at = [](Joint joint) { return static_cast<size_t>(joint); };
    ball = body.R_zero[at(ankle)] * (body.p_PJ[at(toes)] - body.p_PJ[at(ankle)]);
    ball_height = std::max(0.0, body.size.ankle_height + ball.z);
  }
  // Where the ankle is when the sole under the ball is at `sole`.
  Vec3d AnkleOver(Vec3d sole, const Mat3d& A) const { return sole + A * (Vec3d{0, 0, ball_height} - ball); }
};

// Where a foot is meant to be.
struct Footing {
  Vec3d sole;  // under the ball
  Mat3d tilt;  // of what it stands on
  double pitch = 0;
};

// A sole keeps to its pedal, which turns with it.
Footing OnPedal(const Perch& perch, bool left, double crank) {
  const double pitch = FootPitch(left, crank);
  return {PedalAt(perch, left, crank) + RotationY(pitch) * Vec3d{0, 0, perch.pedal_half_height}, Mat3d{}, pitch};
}

// On the ground beside the hip, the heel as high as the leg asks. The ground tilts in B as the bicycle leans.
Footing OnGround(const Foot& foot, Vec3d hip, double leg, double lean) {
  constexpr int kHalvings = 24;
  constexpr double kHighestHeel = 1.1;
  const Mat3d tilt = RotationX(lean);
  const Vec3d above = tilt.transpose() * hip;
  Footing on{tilt * Vec3d{above.x + kFootForward, above.y + kFootAside, 0}, tilt, 0};
  const auto reaches = [&](double pitch) { return Norm(foot.AnkleOver(on.sole, tilt * RotationY(pitch)) - hip) < leg - kSpare; };
  if (reaches(0)) return on;
  double low = 0;
  on.pitch = kHighestHeel;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + on.pitch) / 2;
    (reaches(middle) ? on.pitch : low) = middle;
  }
  return on;
}

void PlaceLeg(const Perch& perch, bool left, double crank, double standing, const Body& body, Rig& rig) {
  const Foot foot(body, left);
  Footing at = OnPedal(perch, left, crank);
  rig.Follow(foot.hip);
  double turned = 0;  // about X
  if (left && standing > 0) {
    const double lean = LeanOf(standing);
    const Footing down = OnGround(foot, rig.pose()[foot.hip].p, body.size.thigh + body.size.shank, lean);
    at.sole = at.sole + (down.sole - at.sole) * standing + Vec3d{0, 4 * standing * (1 - standing) * kLift, 0};
    at.pitch += (down.pitch - at.pitch) * standing;
    turned = lean * standing;
  }
  const Mat3d A = RotationX(turned) * RotationY(at.pitch);
  rig.Reach(foot.hip, foot.knee, foot.ankle, foot.AnkleOver(at.sole, A), {1, 0, 0.3}, 1);
  rig.Turn(foot.ankle, A);
  // Toes stay on the ground under a raised heel.
  rig.Turn(foot.toes, left && standing > 0 ? RotationX(turned) * RotationY(at.pitch * (1 - standing)) : A);
}

// Without what people carry.
void EmptyHands(Mesh& mesh) {
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
  EmptyHands(body->levels[static_cast<size_t>(level)].mesh);
  return body;
}

}  // namespace

Perch PerchOf(const BicycleMeasures& m, Vec3f offset_M, float scale) {
  const auto in_B = [&](Vec3f p) {
    const Vec3d q = VecCast<double>((p - Vec3f{offset_M.x, offset_M.y, 0}) * scale);
    return Vec3d{-q.y, q.x, q.z};  // -Y of the mesh is ahead, +X its left
  };
  return {in_B(m.saddle),
          in_B(m.bracket),
          in_B(m.grip),
          double{m.crank} * scale,
          double{m.pedal_side} * scale,
          double{m.pedal_half_height} * scale};
}

Vec3d PedalAt(const Perch& perch, bool left, double crank) {
  const double side = left ? 1 : -1;
  return perch.bracket + RotationY(crank) * Vec3d{0, side * perch.pedal_side, -side * perch.crank};
}

double FootPitch(bool left, double crank) {
  // In front of the bracket the pedal of this side goes down.
  return kToesDown + kAnkling * (left ? 1 : -1) * std::sin(crank);
}

double StandingAt(double speed) {
  const double u = std::clamp((kWalks - speed) / (kWalks - kRests), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

double LeanOf(double standing) { return kStandingLean * standing; }

SkeletonPose RidingPose(const Body& body, const Perch& perch, double crank, double standing) {
  Rig rig(body);
  const double trunk = kLean + (kUpright - kLean) * standing;
  // Standing, the pelvis is as high as the left leg likes it.
  const double leg = body.size.thigh + body.size.shank + body.size.ankle_height, on_seat = perch.saddle.z + kOnSeat;
  const Vec3d sits{perch.saddle.x, 0, on_seat}, stands{perch.saddle.x + kBeforeSaddle, 0, std::clamp(0.97 * leg, kLowestPelvis, on_seat)};
  LeanToBar(perch, body, sits + (stands - sits) * standing, trunk, rig);
  for (const bool left : {true, false}) {
    PlaceArm(perch, left, rig);
    PlaceLeg(perch, left, crank, standing, body, rig);
  }
  return rig.pose();
}

std::shared_ptr<Scene> AddRiders(std::shared_ptr<Scene> scene, SimTraffic& traffic) {
  std::vector<size_t> of;
  std::vector<std::shared_ptr<const Body>> faces;
  for (size_t i = 0; i < traffic.bodies.size(); ++i) {
    if (!traffic.model.vehicles[i].shape.bicycle) continue;
    const std::string& name = traffic.bodies[i].name;
    if (faces.size() < kFaces) faces.push_back(MakeRider(traffic.model.seed, faces.size()));
    traffic.riders.push_back({"rider/" + name.substr(name.find('/') + 1), faces[of.size() % kFaces], kLevel});
    of.push_back(i);
  }
  if (of.empty()) return scene;
  std::shared_ptr<Scene> own = OwnScene(AddPeople(std::move(scene), traffic.riders, traffic.rider_refs));
  for (size_t k = 0; k < of.size(); ++k) {
    const PersonRef& ref = traffic.rider_refs[k];
    traffic.bodies[of[k]].rider = ref.instance;
    traffic.bodies[of[k]].rider_entity = ref.entity;
    own->entities[ref.entity - 1].category = own->tree.At("human/rider");
  }
  return own;
}

}  // namespace airsim360::internal
