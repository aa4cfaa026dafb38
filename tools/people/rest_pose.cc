#include "rest_pose.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/motion/posture.h"

namespace airsim360::bake {
namespace {

// Which part of the way each bone turns the arm down, degrees about the axis that points forward.
constexpr double kCollarBone = 5, kShoulder = 7, kUpperArm = 8;
constexpr double kElbow = 16;           // degrees that elbows are opened by
constexpr double kFingersClose = 0.75;  // of the angle to the middle finger
constexpr double kThumbCloses = 16;     // degrees

Mat3d About(Vec3d axis, double degrees) { return internal::FromRotationVector(Normalized(axis) * (degrees * kDegree)); }

// Turn of one bone about its head, in axes of the package: x to the person's left, y up, z forward.
Mat3d TurnOf(const BaseHuman& base, const std::vector<Vec3f>& v, const std::string& bone) {
  const std::string name = bone.substr(0, bone.find('.')), side = bone.substr(std::min(bone.size(), bone.find('.')));
  if (side != ".L" && side != ".R") return {};
  const double down = side == ".L" ? -1 : 1;
  const auto head = [&](const std::string& b) { return BoneEnd(base, v, b + side + "____head"); };
  if (name == "clavicle") return About({0, 0, 1}, down * kCollarBone);
  if (name == "shoulder01") return About({0, 0, 1}, down * kShoulder);
  if (name == "upperarm01") return About({0, 0, 1}, down * kUpperArm);
  if (name == "lowerarm01") return About(Cross(head("wrist") - head("lowerarm01"), head("lowerarm01") - head("upperarm01")), kElbow);
  const auto way = [&](char finger) {
    return Normalized(head(std::string("finger") + finger + "-2") - head(std::string("finger") + finger + "-1"));
  };
  if (name == "finger1-1") return About(Cross(way('1'), way('3')), kThumbCloses);
  if (name == "finger2-1" || name == "finger4-1" || name == "finger5-1") {
    // Within the plane of the palm only: fingers keep how far they are bent.
    const Vec3d n = Normalized(Cross(head("finger2-1") - head("wrist"), head("finger5-1") - head("wrist")));
    const auto flat = [&](Vec3d d) { return Normalized(d - n * Dot(d, n)); };
    const Vec3d a = flat(way(name[6])), b = flat(way('3'));
    return About(n, kFingersClose * std::atan2(Dot(Cross(a, b), n), Dot(a, b)) / kDegree);
  }
  return {};
}

}  // namespace

Vec3d BoneEnd(const BaseHuman& base, const std::vector<Vec3f>& v, const std::string& end) {
  const auto found = base.joints.find(end);
  if (found == base.joints.end()) throw InputError("base mesh has no joint '" + end + "'");
  Vec3d sum{};
  for (const int i : found->second) sum += VecCast<double>(v[static_cast<size_t>(i)]);
  return sum / static_cast<double>(found->second.size());
}

Vec3d PosedEnd(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones, const std::string& end) {
  const std::string head = end.substr(0, end.find("____")) + "____head";
  const auto bone = std::ranges::find(base.bone_names, head);
  const Vec3d p = BoneEnd(base, v, end);
  return bone == base.bone_names.end() ? p : bones[static_cast<size_t>(bone - base.bone_names.begin())] * p;
}

std::vector<RigidTransform> RelaxedBones(const BaseHuman& base, const std::vector<Vec3f>& v) {
  std::vector<RigidTransform> bones(base.bone_names.size());
  for (size_t b = 0; b < bones.size(); ++b) {
    const int parent = base.bone_parents[b];
    if (parent >= static_cast<int>(b)) throw InputError("bone '" + base.bone_names[b] + "' stands before its parent");
    const std::string& full = base.bone_names[b];
    RigidTransform own;
    // Each bone is followed by a node of its tail, which does not turn.
    if (full.ends_with("____head") && base.joints.contains(full)) {
      const Vec3d head = BoneEnd(base, v, full);
      own.R = TurnOf(base, v, full.substr(0, full.find("____")));
      own.p = head - own.R * head;
    }
    bones[b] = parent < 0 ? own : bones[static_cast<size_t>(parent)] * own;
  }
  return bones;
}

std::vector<Vec3f> Posed(const SourceMesh& mesh, const std::vector<Vec3f>& at, const std::vector<RigidTransform>& bones) {
  std::vector<Vec3f> out = at;
  for (size_t i = 0; i < at.size() && i < mesh.bones.size(); ++i) {
    const Vec3d p = VecCast<double>(at[i]);
    Vec3d sum{};
    double total = 0;
    for (size_t k = 0; k < 4; ++k) {
      const int b = mesh.bones[i][k];
      const double w = mesh.weights[i][k];
      if (w <= 0 || b < 0 || static_cast<size_t>(b) >= bones.size()) continue;
      sum += (bones[static_cast<size_t>(b)] * p) * w;
      total += w;
    }
    if (total > 0) out[i] = VecCast<float>(sum / total);
  }
  return out;
}

}  // namespace airsim360::bake
