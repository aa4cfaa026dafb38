// Pelvis, spine and head: of the gait, of what the legs do, of where the person looks.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/motion/posture.h"

namespace airsim360::internal {
namespace {

// Trunk angles in degrees, spread over the spine at the end.
struct Trunk {
  double lean = 0, side = 0, twist = 0;  // forward, to the left, to the left
  double nod = 0, tilt = 0, look = 0;    // head: down, to the left shoulder, to the left
  double pelvis_list = 0, pelvis_yaw = 0, pelvis_lean = 0;
};

// Pelvis and counter-rotation of a stride (Perry; Whittle): list and rotation of 4 to 5 degrees once per stride.
void AddGait(const PostureInput& in, Trunk& trunk, Posture& posture) {
  const double g = in.motion.gait, run = in.motion.run, p = kTau * in.phase;
  const double scale = g * std::clamp(in.motion.speed / 1.3, 0.3, 1.3);
  trunk.pelvis_list += scale * 3.5 * std::sin(p - 0.12);
  trunk.pelvis_yaw -= scale * (4.5 + 3 * run) * std::cos(p);
  trunk.twist += scale * (9 + 5 * run) * std::cos(p);
  trunk.lean += g * ((1 - run) * 2 + run * std::min(11.0, 2.2 * in.motion.speed));
  posture.pelvis.y += 0.018 * g * (1 - 0.6 * run) * std::sin(p - 0.3);
  // Into a turn.
  trunk.side += std::clamp(in.motion.yaw_rate * in.motion.speed * 3, -8.0, 8.0);
}

// Standing: weight shifts every 5 to 12 s, sway, breathing, looking around.
void AddIdle(const PostureInput& in, Trunk& trunk, Posture& posture) {
  const double still = 1 - in.motion.gait;
  const uint64_t seed = in.motion.seed;
  const double shift = still * std::clamp(1.6 * Sway(seed, 1, 0.06, in.t), -1.0, 1.0);
  posture.pelvis.y += 0.028 * shift;
  trunk.pelvis_list += 2.5 * shift;
  trunk.side -= 2.5 * shift;
  trunk.lean += still * 0.6 * Sway(seed, 2, 0.3, in.t) + 0.5 * std::sin(kTau * (0.25 * in.t + Draw(seed, 3, 0)));
  trunk.look += (6 + 14 * still) * std::clamp(1.5 * Sway(seed, 4, 0.11, in.t), -1.0, 1.0);
  trunk.nod += 3 * Sway(seed, 5, 0.15, in.t);
  if (in.body.spec.age > 62) {
    trunk.lean += 0.35 * (in.body.spec.age - 62);
    trunk.nod -= 0.2 * (in.body.spec.age - 62);
  }
}

// What the legs do besides walking and standing.
void AddLower(const PostureInput& in, Trunk& trunk, Posture& posture) {
  const BodyDimensions& size = in.body.size;
  const double H = in.body.spec.stature, hip = in.body.p_PJ[At(Joint::kPelvis)].z;
  switch (in.lower) {
    case Behaviour::kSit: {
      // On a seat of 0.45 m behind the feet; short people slide back until the knees bend at its edge.
      const Seating& on = in.state.seating;
      const double seat = on.height > 0 ? on.height + kPelvisOverMeasured * H : 0.45 + kPelvisOverSeat * H;
      posture.pelvis = {-(on.height > 0 ? on.reach : std::max(0.25, size.thigh - 0.02)), 0, seat - hip};
      posture.sink = 1;
      trunk.pelvis_lean -= 8;
      trunk.lean += on.desk > 0 ? 4 + kLeanAtDesk : 4;
      break;
    }
    case Behaviour::kCrouch:
      posture.pelvis = {-0.075 * H, 0, 0.33 * H - hip};
      posture.sink = 1;
      trunk.lean += 48;
      trunk.nod -= 5;
      break;
    case Behaviour::kStretch: {
      // Toe touches of 5 s: up with the arms overhead, down.
      const double down = 0.5 - 0.5 * std::cos(kTau * in.t_lower / 5);
      posture.pelvis.x -= 0.11 * H * down;
      trunk.pelvis_lean += 45 * down;
      trunk.lean += 50 * down - 6 * (1 - down);
      break;
    }
    default:
      break;
  }
}

// What arms and head do needs the trunk too.
void AddUpper(const PostureInput& in, Trunk& trunk) {
  const double t = in.t_upper;
  const uint64_t seed = in.motion.seed;
  switch (in.upper) {
    case Behaviour::kTalk:
      trunk.look *= 0.3;
      trunk.nod += in.state.speaking ? 3 * Sway(seed, 20, 0.8, t) : 0;
      trunk.side += 2 * Sway(seed, 21, 0.3, t);
      [[fallthrough]];
    case Behaviour::kListen: {
      // Nods, every three seconds or so.
      trunk.look *= 0.4;
      const double beat = std::fmod(t + 3 * Draw(seed, 22, 0), 3.2);
      if (!in.state.speaking && beat < 1.0) trunk.nod += 6 * std::sin(std::numbers::pi * beat) * std::sin(kTau * beat);
      break;
    }
    case Behaviour::kPhoneCall:
      trunk.tilt -= 8;
      trunk.nod += 4;
      trunk.look *= 0.6;
      break;
    case Behaviour::kTexting:
      trunk.nod += 33;
      trunk.look *= 0.1;
      trunk.lean += 3;
      break;
    case Behaviour::kTakePhoto:
      trunk.look *= 0.1;
      trunk.lean -= 2;
      break;
    case Behaviour::kCarry:
      trunk.side += 4;
      break;
    case Behaviour::kPushStroller:
      trunk.lean += 5;
      trunk.nod += 4;
      break;
    case Behaviour::kCrouch:
      trunk.nod += 15;
      trunk.look *= 0.2;
      break;
    case Behaviour::kLookUp:
      trunk.nod -= in.state.has_gaze ? 0 : 35;
      trunk.lean -= 3;
      break;
    case Behaviour::kWait:
      trunk.look *= 1.5;
      break;
    default:
      break;
  }
}

// Turns the head towards what is looked at: at most 60 degrees, a part of it from the spine.
void AddGaze(const PostureInput& in, Trunk& trunk) {
  if (!in.state.has_gaze) return;
  const Vec3d eye = in.state.p_WP + Vec3d{0, 0, 0.93 * in.body.spec.stature};
  const Vec3d d = RotationZ(-in.state.yaw) * (in.state.p_W_gaze - eye);
  const double side = std::atan2(d.y, d.x) / kDegree, up = std::atan2(d.z, std::hypot(d.x, d.y)) / kDegree;
  trunk.look = std::clamp(side, -65.0, 65.0);
  trunk.nod = -std::clamp(up, -45.0, 55.0);
  trunk.twist += 0.3 * trunk.look;
  trunk.look *= 0.75;
}

}  // namespace

void SetTrunk(const PostureInput& in, Posture& posture) {
  Trunk trunk;
  AddGait(in, trunk, posture);
  AddIdle(in, trunk, posture);
  AddUpper(in, trunk);
  AddLower(in, trunk, posture);
  AddGaze(in, trunk);

  // The shoulders turn back what the pelvis turns, the head what both do.
  const auto turn = [](double lean, double side, double twist) {
    return RotationZ(twist * kDegree) * RotationY(lean * kDegree) * RotationX(-side * kDegree);
  };
  posture.turn[kTPelvis] = turn(trunk.pelvis_lean, -trunk.pelvis_list, trunk.pelvis_yaw);
  const double side = trunk.side + trunk.pelvis_list, twist = trunk.twist - trunk.pelvis_yaw;
  posture.turn[kTSpine1] = turn(0.3 * trunk.lean, 0.4 * side, 0.2 * twist);
  posture.turn[kTSpine2] = turn(0.4 * trunk.lean, 0.35 * side, 0.4 * twist);
  posture.turn[kTSpine3] = turn(0.3 * trunk.lean, 0.25 * side, 0.4 * twist);
  const double bent = std::clamp(trunk.lean + trunk.pelvis_lean, -30.0, 45.0);
  const double nod = trunk.nod - 0.6 * bent, look = trunk.look - trunk.twist;
  posture.turn[kTNeck] = turn(0.45 * nod, 0.4 * trunk.tilt - 0.5 * trunk.side, 0.4 * look);
  posture.turn[kTHead] = turn(0.55 * nod, 0.6 * trunk.tilt - 0.5 * trunk.side, 0.6 * look);
}

}  // namespace airsim360::internal
