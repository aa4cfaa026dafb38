#include "airsim360/people/body/anatomy.h"

#include <algorithm>
#include <numbers>

namespace airsim360 {
namespace internal {
namespace {

constexpr double kHalf = std::numbers::sqrt2 / 2;

double Mix(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

Joint MirrorOf(Joint joint) {
  const std::string_view name = JointName(joint);
  if (name.starts_with("left_")) return JointByName("right_" + std::string(name.substr(5)));
  if (name.starts_with("right_")) return JointByName("left_" + std::string(name.substr(6)));
  return joint;
}

Proportions ProportionsOf(const BodySpec& spec) {
  Proportions p;
  p.stature = spec.stature;
  p.female = spec.sex == Sex::kFemale;
  p.adult = std::clamp((spec.age - 5) / 11, 0.0, 1.0);
  p.head = Mix(0.168, 0.130, p.adult);
  p.hip = Mix(0.495, 0.530, p.adult);
  p.shoulder = 1 - p.head - Mix(0.058, 0.052, p.adult);
  p.shoulder_half = Mix(0.098, p.female ? 0.102 : 0.113, p.adult);
  p.hip_half = Mix(0.050, p.female ? 0.055 : 0.052, p.adult);
  p.girth = 1 + 0.10 * spec.build + Mix(0.04, 0.0, p.adult);
  p.belly = std::clamp(0.5 * spec.build + 0.25 * std::clamp((spec.age - 30) / 40, 0.0, 1.0), 0.0, 1.0);
  return p;
}

std::array<Vec3d, kJointCount> RestJoints(const Proportions& p) {
  std::array<Vec3d, kJointCount> q;
  const double H = p.stature;
  const auto set = [&](Joint joint, Vec3d share) { q[At(joint)] = share * H; };
  const double trunk = p.shoulder - p.hip;
  set(Joint::kPelvis, {0, 0, p.hip + 0.018});
  set(Joint::kSpine1, {-0.004, 0, p.hip + 0.20 * trunk});
  set(Joint::kSpine2, {-0.006, 0, p.hip + 0.42 * trunk});
  set(Joint::kSpine3, {-0.010, 0, p.hip + 0.66 * trunk});
  set(Joint::kNeck, {-0.008, 0, p.shoulder + 0.016});
  set(Joint::kHead, {0.000, 0, 1 - p.head + 0.012});

  // The left side; arms hang down by 45 degrees, palms down, thumbs forward.
  const Vec3d arm{0, kHalf, -kHalf};
  const double short_arm = Mix(0.94, 1, p.adult);
  const Vec3d shoulder{-0.006, p.shoulder_half, p.shoulder};
  const Vec3d elbow = shoulder + 0.186 * short_arm * arm, wrist = elbow + 0.146 * short_arm * arm;
  set(Joint::kLeftClavicle, {0.008, 0.016, p.shoulder - 0.004});
  set(Joint::kLeftShoulder, shoulder);
  set(Joint::kLeftElbow, elbow);
  set(Joint::kLeftWrist, wrist);
  set(Joint::kLeftFingers1, wrist + 0.052 * arm);
  set(Joint::kLeftFingers2, wrist + 0.078 * arm);
  set(Joint::kLeftThumb1, wrist + 0.020 * arm + Vec3d{0.014, 0, 0});
  set(Joint::kLeftThumb2, wrist + 0.040 * arm + Vec3d{0.024, 0, 0});
  const double knee = 0.285 * p.hip / 0.530;
  set(Joint::kLeftHip, {0, p.hip_half, p.hip});
  set(Joint::kLeftKnee, {0.004, p.hip_half - 0.001, knee});
  set(Joint::kLeftAnkle, {-0.006, p.hip_half - 0.003, 0.044});
  set(Joint::kLeftToes, {0.068, p.hip_half + 0.004, 0.013});
  for (int j = 0; j < kJointCount; ++j) {
    const Joint left = static_cast<Joint>(j), right = MirrorOf(left);
    if (right != left && JointName(left).starts_with("left")) q[At(right)] = {q[At(left)].x, -q[At(left)].y, q[At(left)].z};
  }
  return q;
}

Mat3d RotationBetween(Vec3d a, Vec3d b) {
  // Rodrigues: R = I + [v] + [v]^2 / (1 + c), v = a x b, c = a . b.
  a = Normalized(a);
  b = Normalized(b);
  const Vec3d v = Cross(a, b);
  const double c = Dot(a, b);
  if (c < -0.999999) return RotationX(std::numbers::pi);
  const double k = 1 / (1 + c);
  return {{{{v.x * v.x * k + c, v.x * v.y * k - v.z, v.x * v.z * k + v.y},
            {v.y * v.x * k + v.z, v.y * v.y * k + c, v.y * v.z * k - v.x},
            {v.z * v.x * k - v.y, v.z * v.y * k + v.x, v.z * v.z * k + c}}}};
}

void FinishSkeleton(Body& body) {
  const auto& q = body.p_PJ;
  const auto bone = [&](Joint from, Joint to) { return q[At(to)] - q[At(from)]; };
  body.R_zero.fill(Mat3d{});

  // Limbs from where they are at rest to straight down.
  const Joint chains[][2] = {{Joint::kLeftShoulder, Joint::kLeftElbow},
                             {Joint::kLeftElbow, Joint::kLeftWrist},
                             {Joint::kLeftWrist, Joint::kLeftFingers1},
                             {Joint::kLeftHip, Joint::kLeftKnee},
                             {Joint::kLeftKnee, Joint::kLeftAnkle}};
  for (const auto& link : chains) {
    for (const bool mirror : {false, true}) {
      const Joint a = mirror ? MirrorOf(link[0]) : link[0], b = mirror ? MirrorOf(link[1]) : link[1];
      body.R_zero[At(a)] = RotationBetween(bone(a, b), {0, 0, -1});
    }
  }
  // Hands keep their shape.
  for (const Joint finger : {Joint::kLeftThumb1, Joint::kLeftThumb2, Joint::kLeftFingers1, Joint::kLeftFingers2}) {
    body.R_zero[At(finger)] = body.R_zero[At(Joint::kLeftWrist)];
    body.R_zero[At(MirrorOf(finger))] = body.R_zero[At(Joint::kRightWrist)];
  }

  BodyDimensions& size = body.size;
  size.thigh = Norm(bone(Joint::kLeftHip, Joint::kLeftKnee));
  size.shank = Norm(bone(Joint::kLeftKnee, Joint::kLeftAnkle));
  size.upper_arm = Norm(bone(Joint::kLeftShoulder, Joint::kLeftElbow));
  size.forearm = Norm(bone(Joint::kLeftElbow, Joint::kLeftWrist));
  size.ankle_height = q[At(Joint::kLeftAnkle)].z;
  const Vec3d foot = bone(Joint::kLeftAnkle, Joint::kLeftToes);
  size.ball_length = std::hypot(foot.x, foot.y);
  size.heel_length = 0.036 * body.spec.stature;
  size.hip_half_width = std::abs(q[At(Joint::kLeftHip)].y);
}

namespace {

struct SocketList {
  const Proportions& p;
  const std::array<Vec3d, kJointCount>& q;  // joints at rest, in P
  const double H = p.stature;
  std::vector<Socket> sockets = {};

  // A point given in P at rest; its radius as a share of the stature.
  void Add(std::string_view name, Joint joint, Vec3d p_P, double radius) {
    sockets.push_back({std::string(name), joint, p_P - q[At(joint)], radius * H});
  }
  void AddJoint(std::string_view name, Joint joint, double radius) { Add(name, joint, q[At(joint)], radius); }
  // Both sides, given the left one.
  void Pair(std::string_view name, Joint joint, Vec3d p_P, double radius) {
    Add("left_" + std::string(name), joint, p_P, radius);
    Add("right_" + std::string(name), MirrorOf(joint), {p_P.x, -p_P.y, p_P.z}, radius);
  }
  void JointPair(std::string_view name, Joint joint, double radius) { Pair(name, joint, q[At(joint)], radius); }
};

// COCO-WholeBody names big toe, small toe, heel, one side after the other.
void AddToesAndHeels(SocketList& list) {
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left_" : "right_";
    const Joint toes = side > 0 ? Joint::kLeftToes : Joint::kRightToes;
    const Joint ankle = side > 0 ? Joint::kLeftAnkle : Joint::kRightAnkle;
    const double y = side * list.p.hip_half * list.H;
    list.Add(name + "big_toe", toes, {0.105 * list.H, y - side * 0.010 * list.H, 0.012 * list.H}, 0.012);
    list.Add(name + "small_toe", toes, {0.082 * list.H, y + side * 0.020 * list.H, 0.012 * list.H}, 0.010);
    list.Add(name + "heel", ankle, {-0.040 * list.H, y, 0.014 * list.H}, 0.014);
  }
}

void AddFingerTips(SocketList& list) {
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left_" : "right_";
    const Joint thumb = side > 0 ? Joint::kLeftThumb2 : Joint::kRightThumb2;
    const Joint finger = side > 0 ? Joint::kLeftFingers2 : Joint::kRightFingers2;
    const Joint thumb1 = side > 0 ? Joint::kLeftThumb1 : Joint::kRightThumb1;
    const Vec3d along = Normalized(Vec3d{0, side, -1});
    // In the last pad of the thumb and of the middle finger, which lies towards the thumb of the hand's middle.
    list.Add(name + "thumb_tip", thumb, list.q[At(thumb)] + (list.q[At(thumb)] - list.q[At(thumb1)]) * 0.6, 0.006);
    list.Add(name + "finger_tip", finger, list.q[At(finger)] + 0.022 * list.H * along + Vec3d{0.0054 * list.H, 0, 0}, 0.006);
  }
}

}  // namespace

std::vector<Socket> ProceduralSockets(const Body& body, const Proportions& p) {
  SocketList list{p, body.p_PJ};
  const double top = p.stature, chin = top * (1 - p.head), head = top * p.head;
  // A few millimetres below the skin, so that no camera sees past them.
  list.Add("nose", Joint::kHead, {0.575 * head, 0, chin + 0.365 * head}, 0.010);
  list.Pair("eye", Joint::kHead, {0.385 * head, 0.145 * head, chin + 0.50 * head}, 0.008);
  list.Pair("ear", Joint::kHead, {-0.01 * head, (p.female ? 0.317 : 0.33) * head, chin + 0.43 * head}, 0.010);
  list.JointPair("shoulder", Joint::kLeftShoulder, 0.040);
  list.JointPair("elbow", Joint::kLeftElbow, 0.026);
  list.JointPair("wrist", Joint::kLeftWrist, 0.018);
  list.JointPair("hip", Joint::kLeftHip, 0.062);
  list.JointPair("knee", Joint::kLeftKnee, 0.036);
  list.JointPair("ankle", Joint::kLeftAnkle, 0.026);
  list.Add("head_top", Joint::kHead, {0.02 * head, 0, top - 0.025 * head}, 0.008);
  list.Add("head_center", Joint::kHead, {0.06 * head, 0, chin + 0.52 * head}, 0.055);
  list.AddJoint("neck", Joint::kNeck, 0.036);
  list.Add("chin", Joint::kHead, {0.385 * head, 0, chin + 0.03 * head}, 0.010);
  list.Add("mid_hip", Joint::kPelvis, {0, 0, body.p_PJ[At(Joint::kLeftHip)].z}, 0.070);
  list.AddJoint("pelvis", Joint::kPelvis, 0.070);
  list.AddJoint("spine1", Joint::kSpine1, 0.070);
  list.AddJoint("spine2", Joint::kSpine2, 0.070);
  list.AddJoint("spine3", Joint::kSpine3, 0.075);
  list.JointPair("clavicle", Joint::kLeftClavicle, 0.045);
  AddToesAndHeels(list);
  list.JointPair("hand", Joint::kLeftFingers1, 0.012);
  AddFingerTips(list);
  list.JointPair("foot", Joint::kLeftToes, 0.020);
  return std::move(list.sockets);
}

}  // namespace internal

int FindSocket(const Body& body, std::string_view name) {
  const auto found = std::ranges::find(body.sockets, name, &Socket::name);
  return found == body.sockets.end() ? -1 : static_cast<int>(found - body.sockets.begin());
}

SkeletonPose RestPose(const Body& body, const RigidTransform& X_WP) {
  SkeletonPose pose;
  pose.X_WP = X_WP;
  for (size_t j = 0; j < kJointCount; ++j) pose.X_WJ[j] = {X_WP.R, X_WP * body.p_PJ[j]};
  return pose;
}

}  // namespace airsim360
