#include "joints.h"

#include <algorithm>
#include <numeric>

#include "airsim360/base/error.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/body/loft.h"
#include "rest_pose.h"

namespace airsim360::bake {

using internal::At;

Vec3f ToPerson(Vec3f v) { return {0.1f * v.z, 0.1f * v.x, 0.1f * v.y}; }

namespace {

// The joint of ours that a bone of MakeHuman follows; its own children follow it by name.
Joint JointOf(const std::string& full) {
  const std::string bone = full.substr(0, full.find("____"));
  const bool left = bone.ends_with(".L");
  const std::string b = bone.substr(0, bone.find('.'));
  const auto side = [&](Joint l, Joint r) { return left ? l : r; };
  const auto is = [&](std::string_view prefix) { return b.starts_with(prefix); };
  if (b == "root" || b == "spine05" || b == "pelvis") return Joint::kPelvis;
  if (b == "spine04") return Joint::kSpine1;
  if (b == "spine03") return Joint::kSpine2;
  if (is("spine") || b == "breast") return Joint::kSpine3;
  if (is("neck")) return Joint::kNeck;
  if (b == "clavicle" || b == "shoulder01") return side(Joint::kLeftClavicle, Joint::kRightClavicle);
  if (is("upperarm")) return side(Joint::kLeftShoulder, Joint::kRightShoulder);
  if (is("lowerarm")) return side(Joint::kLeftElbow, Joint::kRightElbow);
  if (b == "wrist" || is("metacarpal")) return side(Joint::kLeftWrist, Joint::kRightWrist);
  if (b == "finger1-1") return side(Joint::kLeftThumb1, Joint::kRightThumb1);
  if (is("finger1")) return side(Joint::kLeftThumb2, Joint::kRightThumb2);
  if (is("finger")) return b.ends_with("-1") ? side(Joint::kLeftFingers1, Joint::kRightFingers1) : side(Joint::kLeftFingers2, Joint::kRightFingers2);
  if (is("upperleg")) return side(Joint::kLeftHip, Joint::kRightHip);
  if (is("lowerleg")) return side(Joint::kLeftKnee, Joint::kRightKnee);
  if (b == "foot") return side(Joint::kLeftAnkle, Joint::kRightAnkle);
  if (is("toe")) return side(Joint::kLeftToes, Joint::kRightToes);
  return Joint::kHead;  // head, jaw, eyes, face, tongue
}

}  // namespace

std::array<Vec3d, kJointCount> Joints(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones) {
  const auto mean = [&](const std::string& end) { return VecCast<double>(ToPerson(VecCast<float>(PosedEnd(base, v, bones, end)))); };
  std::array<Vec3d, kJointCount> q;
  const auto set = [&](Joint j, const std::string& bone) { q[At(j)] = mean(bone + "____head"); };
  set(Joint::kPelvis, "spine05");
  set(Joint::kSpine1, "spine04");
  set(Joint::kSpine2, "spine03");
  set(Joint::kSpine3, "spine02");
  set(Joint::kNeck, "neck01");
  set(Joint::kHead, "head");
  const std::pair<Joint, std::string> sides[] = {
      {Joint::kLeftClavicle, "clavicle"}, {Joint::kLeftShoulder, "upperarm01"}, {Joint::kLeftElbow, "lowerarm01"}, {Joint::kLeftWrist, "wrist"},
      {Joint::kLeftHip, "upperleg01"}, {Joint::kLeftKnee, "lowerleg01"}, {Joint::kLeftAnkle, "foot"}, {Joint::kLeftToes, "toe2-1"},
      {Joint::kLeftThumb1, "finger1-1"}, {Joint::kLeftThumb2, "finger1-2"}, {Joint::kLeftFingers1, "finger3-1"}, {Joint::kLeftFingers2, "finger3-2"}};
  for (const auto& [joint, bone] : sides) {
    set(joint, bone + ".L");
    set(internal::MirrorOf(joint), bone + ".R");
  }
  return q;
}

Influences Folded(const BaseHuman& base, const std::array<int, 4>& bones, const std::array<float, 4>& weights) {
  std::array<double, kJointCount> sum{};
  for (size_t k = 0; k < 4; ++k) {
    if (weights[k] <= 0 || bones[k] < 0 || static_cast<size_t>(bones[k]) >= base.bone_names.size()) continue;
    const std::string& name = base.bone_names[static_cast<size_t>(bones[k])];
    const Joint joint = JointOf(name);
    const double share = name.starts_with("lowerarm02") ? 0.35 : 0;
    sum[At(joint)] += weights[k] * (1 - share);
    if (share > 0) sum[At(joint == Joint::kLeftElbow ? Joint::kLeftWrist : Joint::kRightWrist)] += weights[k] * share;
  }
  std::array<size_t, kJointCount> order;
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return sum[a] > sum[b]; });
  Influences in;
  double total = 0;
  for (size_t k = 0; k < 4; ++k) total += sum[order[k]];
  if (total <= 0) return internal::Bone(Joint::kHead);
  for (size_t k = 0; k < 4 && sum[order[k]] > 0; ++k) {
    in.joint[k] = static_cast<uint8_t>(order[k]);
    in.weight[k] = static_cast<float>(sum[order[k]] / total);
  }
  return in;
}

// Vertices of the base mesh (MPFB2's picks), joints, ends of bones.
std::vector<Socket> Sockets(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones, const std::vector<Vec3f>& posed,
                            const std::array<Vec3d, kJointCount>& q, double stature) {
  Body dummy;
  dummy.p_PJ = q;
  internal::Proportions proportions;
  proportions.stature = stature;
  std::vector<Socket> sockets = internal::ProceduralSockets(dummy, proportions);
  const auto put = [&](const std::string& name, Vec3d p) {
    const auto s = std::ranges::find(sockets, name, &Socket::name);
    if (s == sockets.end()) throw InputError("no socket '" + name + "'");
    s->p_J = p - q[At(s->joint)];
  };
  const auto mean = [&](std::initializer_list<size_t> list) {
    Vec3d sum{};
    for (size_t i : list) sum += VecCast<double>(ToPerson(posed[i]));
    return sum / static_cast<double>(list.size());
  };
  const auto end = [&](const std::string& bone) { return VecCast<double>(ToPerson(VecCast<float>(PosedEnd(base, v, bones, bone + "____tail")))); };
  put("nose", mean({297, 7063}));
  put("left_eye", mean({14634, 14661}));
  put("right_eye", mean({14706, 14733}));
  put("left_ear", mean({12106, 12195}));
  put("right_ear", mean({5507, 5598}));
  put("left_knee", mean({11227, 17607}));
  put("right_knee", mean({4609, 16278}));
  put("left_heel", mean({12910, 17981}));
  put("right_heel", mean({6314, 16611}));
  put("neck", mean({1528, 3780}));
  put("head_top", mean({881}));
  put("chin", end("jaw"));
  put("head_center", (mean({881}) + end("jaw")) * 0.5);
  put("mid_hip", (q[At(Joint::kLeftHip)] + q[At(Joint::kRightHip)]) * 0.5);
  for (const char side : {'L', 'R'}) {
    const std::string name = side == 'L' ? "left_" : "right_", dot = std::string(".") + side;
    put(name + "big_toe", end("toe1-2" + dot));
    put(name + "small_toe", end("toe5-3" + dot));
    put(name + "thumb_tip", end("finger1-3" + dot));
    put(name + "finger_tip", end("finger3-3" + dot));
  }
  for (const Socket& s : sockets) {
    const double y = q[At(s.joint)].y + s.p_J.y;
    if ((s.name.starts_with("left") && y <= 0) || (s.name.starts_with("right") && y >= 0)) throw InputError("socket '" + s.name + "' is on the wrong side");
  }
  return sockets;
}

}  // namespace airsim360::bake
