#include "airsim360/people/motion/bvh_clip.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/body/anatomy.h"

namespace airsim360 {
namespace {

constexpr int kMaxJoints = 256, kMaxDepth = 64;
constexpr int64_t kMaxNumbers = 20'000'000;

// Words with the line that they are on.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void Fail(const std::string& what) const { throw InputError(name_ + ":" + std::to_string(line_) + ": " + what); }

  std::string_view Next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r' || text_[at_] == '\n')) {
      line_ += text_[at_] == '\n';
      ++at_;
    }
    const size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r' && text_[at_] != '\n') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void Expect(std::string_view word) {
    const std::string_view got = Next();
    if (got != word) Fail("'" + std::string(word) + "' expected, not '" + std::string(got.substr(0, 40)) + "'");
  }
  double Number() {
    const std::string_view word = Next();
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) || std::abs(value) > 1e9)
      Fail("a number expected, not '" + std::string(word.substr(0, 40)) + "'");
    return value;
  }
  int Count(int64_t limit, const char* what) {
    const double value = Number();
    if (!(value >= 0 && value <= static_cast<double>(limit)) || value != std::floor(value))
      Fail(std::string(what) + " must be 0 to " + std::to_string(limit));
    return static_cast<int>(value);
  }

 private:
  std::string_view text_;
  std::string name_;
  size_t at_ = 0;
  int line_ = 1;
};

BvhJoint::Channel ChannelOf(std::string_view word, const Words& words) {
  using Channel = BvhJoint::Channel;
  if (word == "Xposition") return Channel::kX;
  if (word == "Yposition") return Channel::kY;
  if (word == "Zposition") return Channel::kZ;
  if (word == "Xrotation") return Channel::kTurnX;
  if (word == "Yrotation") return Channel::kTurnY;
  if (word == "Zrotation") return Channel::kTurnZ;
  words.Fail("unknown channel '" + std::string(word.substr(0, 40)) +
             "'; one of Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation");
}

// One joint with its children, braces included.
void ReadJoint(Words& words, std::string_view kind, int parent, int depth, BvhClip& clip) {
  if (depth > kMaxDepth) words.Fail("joints nested deeper than " + std::to_string(kMaxDepth));
  if (clip.joints.size() >= kMaxJoints) words.Fail("more than " + std::to_string(kMaxJoints) + " joints");
  const auto index = static_cast<int>(clip.joints.size());
  BvhJoint joint;
  joint.parent = parent;
  joint.end = kind == "End";
  joint.name = std::string(words.Next().substr(0, 64));
  words.Expect("{");
  words.Expect("OFFSET");
  for (int i = 0; i < 3; ++i) joint.offset[i] = words.Number();
  joint.first_channel = clip.channels;
  clip.joints.push_back(joint);
  for (;;) {
    const std::string_view word = words.Next();
    if (word == "}") return;
    if (word == "CHANNELS" && !joint.end) {
      const int count = words.Count(6, "the number of channels");
      for (int i = 0; i < count; ++i) clip.joints[static_cast<size_t>(index)].channels.push_back(ChannelOf(words.Next(), words));
      clip.channels += count;
    } else if ((word == "JOINT" || word == "End") && !joint.end) {
      ReadJoint(words, word, index, depth + 1, clip);
    } else {
      words.Fail("'CHANNELS', 'JOINT', 'End Site' or '}' expected, not '" + std::string(word.substr(0, 40)) + "'");
    }
  }
}

// Names of the same joint in files from CMU (cgspeed), Mixamo and MakeHuman.
struct Names {
  Joint joint;
  std::array<std::string_view, 4> names;
};
constexpr Names kNames[] = {
    {Joint::kPelvis, {"Hips", "hip", "root", "Pelvis"}},
    {Joint::kSpine1, {"LowerBack", "abdomen", "spine05", "Spine"}},
    {Joint::kSpine2, {"Spine", "spine03", "chest", "Spine1"}},
    {Joint::kSpine3, {"Spine1", "Chest", "spine01", "Spine2"}},
    {Joint::kNeck, {"Neck", "neck", "neck01", "Neck1"}},
    {Joint::kHead, {"Head", "head", "", ""}},
    {Joint::kLeftClavicle, {"LeftShoulder", "lCollar", "clavicle.L", "LeftCollar"}},
    {Joint::kLeftShoulder, {"LeftArm", "lShldr", "upperarm01.L", "LeftUpArm"}},
    {Joint::kLeftElbow, {"LeftForeArm", "lForeArm", "lowerarm01.L", "LeftLowArm"}},
    {Joint::kLeftWrist, {"LeftHand", "lHand", "wrist.L", ""}},
    {Joint::kLeftHip, {"LeftUpLeg", "lThigh", "upperleg01.L", "LeftUpperLeg"}},
    {Joint::kLeftKnee, {"LeftLeg", "lShin", "lowerleg01.L", "LeftLowLeg"}},
    {Joint::kLeftAnkle, {"LeftFoot", "lFoot", "foot.L", ""}},
    {Joint::kLeftToes, {"LeftToeBase", "lToe", "toe1-1.L", "LeftToe"}},
};

// "LeftArm" to "RightArm", "lShldr" to "rShldr", "foot.L" to "foot.R".
std::string OtherSide(std::string_view name) {
  if (name.starts_with("Left")) return "Right" + std::string(name.substr(4));
  if (name.ends_with(".L")) return std::string(name.substr(0, name.size() - 1)) + "R";
  if (name.starts_with("l")) return "r" + std::string(name.substr(1));
  return std::string(name);
}

void Match(BvhClip& clip) {
  clip.match.fill(-1);
  std::vector<bool> taken(clip.joints.size(), false);
  const auto find = [&](Joint joint, const auto& name_of) {
    for (size_t n = 0; n < 4; ++n) {
      for (size_t i = 0; i < clip.joints.size(); ++i) {
        std::string_view own = clip.joints[i].name;
        if (const size_t colon = own.rfind(':'); colon != std::string_view::npos) own = own.substr(colon + 1);
        if (taken[i] || clip.joints[i].end || name_of(n).empty() || own != name_of(n)) continue;
        taken[i] = true;
        clip.match[internal::At(joint)] = static_cast<int>(i);
        return;
      }
    }
  };
  for (const Names& row : kNames) {
    find(row.joint, [&](size_t n) { return std::string(row.names[n]); });
    const Joint other = internal::MirrorOf(row.joint);
    if (other != row.joint) find(other, [&](size_t n) { return OtherSide(row.names[n]); });
  }
}

// +Y up, +Z forward, +X left to P.
const Mat3d kToPerson{{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}};

}  // namespace

BvhClip ParseBvh(std::string_view text, const std::string& name) {
  Words words(text, name);
  BvhClip clip;
  words.Expect("HIERARCHY");
  words.Expect("ROOT");
  ReadJoint(words, "ROOT", -1, 0, clip);
  words.Expect("MOTION");
  words.Expect("Frames:");
  if (clip.channels == 0) words.Fail("no channels");
  clip.frames = words.Count(kMaxNumbers / clip.channels, "the number of frames");
  if (clip.frames == 0) words.Fail("no frames");
  words.Expect("Frame");
  words.Expect("Time:");
  clip.frame_time = words.Number();
  if (!(clip.frame_time > 1e-5 && clip.frame_time < 10)) words.Fail("frame time must be between 0.00001 and 10 s");
  // Memory grows with what is there, not with what is announced.
  for (int64_t i = 0; i < int64_t{clip.frames} * clip.channels; ++i) clip.values.push_back(static_cast<float>(words.Number()));
  Match(clip);
  return clip;
}

namespace {

/// The numbers of one frame of a clip.
struct ClipFrame {
  const BvhClip& clip;
  const float* row;

  ClipFrame(const BvhClip& c, int f) : clip(c), row(c.values.data() + static_cast<size_t>(f) * static_cast<size_t>(c.channels)) {}

  Vec3d Root() const {
    Vec3d p = clip.joints[0].offset;
    for (size_t c = 0; c < clip.joints[0].channels.size(); ++c) {
      const auto channel = clip.joints[0].channels[c];
      if (channel <= BvhJoint::Channel::kZ) p[static_cast<int>(channel)] = row[c];
    }
    return p;
  }

  /// Turn of a joint against its parent.
  Mat3d Turn(size_t j) const {
    Mat3d R;
    const BvhJoint& joint = clip.joints[j];
    for (size_t c = 0; c < joint.channels.size(); ++c) {
      const double angle = row[static_cast<size_t>(joint.first_channel) + c] * kDegree;
      if (joint.channels[c] == BvhJoint::Channel::kTurnX) R = R * RotationX(angle);
      if (joint.channels[c] == BvhJoint::Channel::kTurnY) R = R * RotationY(angle);
      if (joint.channels[c] == BvhJoint::Channel::kTurnZ) R = R * RotationZ(angle);
    }
    return R;
  }

  /// World turns of all joints.
  std::vector<Mat3d> WorldTurns() const {
    std::vector<Mat3d> G(clip.joints.size());
    for (size_t j = 0; j < G.size(); ++j) {
      const int parent = clip.joints[j].parent;
      G[j] = parent < 0 ? Turn(j) : G[static_cast<size_t>(parent)] * Turn(j);
    }
    return G;
  }
};

/// From hanging straight down to where the clip's bone i is at rest; bones without children keep what they have.
Mat3d RestTurn(const BvhClip& clip, int i) {
  Vec3d d{};
  for (const BvhJoint& child : clip.joints) {
    if (child.parent == i && Norm(child.offset) > Norm(d)) d = child.offset;
  }
  return Norm(d) > 1e-6 ? internal::RotationBetween({0, 0, -1}, kToPerson * d) : Mat3d{};
}

/// Metres of the body a unit of the clip, by the length of the legs; 0: the clip has none.
double ClipScale(const BvhClip& clip, const Body& body) {
  const auto offset_of = [&](Joint j) {
    const int i = clip.match[internal::At(j)];
    return i < 0 ? Vec3d{} : clip.joints[static_cast<size_t>(i)].offset;
  };
  const double leg = Norm(offset_of(Joint::kLeftKnee)) + Norm(offset_of(Joint::kLeftAnkle));
  return leg > 1e-6 ? (body.size.thigh + body.size.shank) / leg : 0;
}

}  // namespace

SkeletonPose ClipPose(const BvhClip& clip, const Body& body, double t, const RigidTransform& X_WP) {
  const int frame = std::clamp(static_cast<int>(std::floor(t / clip.frame_time + 0.5)), 0, clip.frames - 1);
  const ClipFrame first(clip, 0), present(clip, frame);
  const std::vector<Mat3d> G = present.WorldTurns();

  // Facing of the first frame is along +X of P; lengths as legs are.
  const Mat3d facing = kToPerson * first.Turn(0) * kToPerson.transpose();
  const Mat3d level = RotationZ(-std::atan2(facing.m[1][0], facing.m[0][0]));
  const double scale = ClipScale(clip, body);
  const Vec3d start = first.Root(), now = present.Root();
  Vec3d pelvis = level * (kToPerson * (now - Vec3d{start.x, 0, start.z})) * scale;
  // Height of the root over the ground is that of its legs at rest and its movement.
  pelvis.z = body.p_PJ[0].z + (now.y - start.y) * scale;

  SkeletonPose pose;
  pose.X_WP = X_WP;
  std::array<Mat3d, kJointCount> zero;
  for (size_t j = 0; j < kJointCount; ++j) {
    const size_t parent = internal::At(ParentOf(static_cast<Joint>(j)));
    const int i = clip.match[j];
    zero[j] = j == 0 ? Mat3d{} : zero[parent];
    if (i >= 0) {
      const bool limb = body.R_zero[j] != Mat3d{};
      const Mat3d rest = limb ? RestTurn(clip, i) : Mat3d{};
      zero[j] = level * kToPerson * G[static_cast<size_t>(i)] * kToPerson.transpose() * rest;
    }
    pose.X_WJ[j].R = X_WP.R * zero[j] * body.R_zero[j];
    pose.X_WJ[j].p = j == 0 ? X_WP * pelvis : pose.X_WJ[parent] * (body.p_PJ[j] - body.p_PJ[parent]);
  }
  return pose;
}

}  // namespace airsim360
