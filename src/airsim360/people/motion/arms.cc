// Arms: swinging in a gait, hanging, and the gestures of the upper layer (table 2.3 of the people reference).
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/motion/posture.h"

namespace airsim360::internal {
namespace {

// Angles of one arm in degrees; abduction is away from the trunk, turn of the hand thumb outwards.
struct ArmAngles {
  double flex = 0, abduct = 6, rotate = 0, elbow = 14, supinate = 0, raise = 0;
};

void Hang(bool left, const ArmAngles& a, Posture& posture) {
  const double s = left ? 1 : -1;
  const size_t arm = left ? kTLeftArm : kTRightArm;
  posture.turn[arm + kClavicle] = RotationX(s * a.raise * kDegree);
  posture.turn[arm + kShoulder] =
      RotationX(s * (a.abduct - a.raise) * kDegree) * RotationY(-a.flex * kDegree) * RotationZ(-s * a.rotate * kDegree);
  posture.turn[arm + kElbow] = RotationY(-a.elbow * kDegree);
  posture.turn[arm + kWrist] = RotationZ(s * a.supinate * kDegree);
}

void TurnHand(bool left, double supinate, double bend, Posture& posture) {
  posture.turn[(left ? kTLeftArm : kTRightArm) + kWrist] =
      RotationZ((left ? 1 : -1) * supinate * kDegree) * RotationX((left ? -1 : 1) * bend * kDegree);
}

// Places a wrist at a point given against the middle between the shoulders, in shares of arm length: forward,
// outwards, up. The elbow points down and outwards.
void Place(const PostureInput& in, bool left, Vec3d share, Posture& posture, Vec3d pole = {-0.35, 0.55, -1}) {
  const double s = left ? 1 : -1, length = in.body.size.upper_arm + in.body.size.forearm;
  const double half = std::abs(in.body.p_PJ[At(Joint::kLeftShoulder)].y);
  const size_t arm = left ? kTLeftArm : kTRightArm;
  posture.turn[arm + kClavicle] = {};
  ReachWith(left, in.body, {share.x * length, s * (share.y * length - half), share.z * length}, {pole.x, s * pole.y, pole.z}, posture);
}

// A point of the head, as Place wants it.
Vec3d AtHead(const PostureInput& in, Vec3d share_of_head) {
  const double H = in.body.spec.stature, length = in.body.size.upper_arm + in.body.size.forearm;
  const Vec3d middle = (in.body.p_PJ[At(Joint::kLeftShoulder)] + in.body.p_PJ[At(Joint::kRightShoulder)]) * 0.5;
  const double head = H - in.body.p_PJ[At(Joint::kHead)].z;
  return (in.body.p_PJ[At(Joint::kHead)] - middle + share_of_head * head) / length;
}

// Swing of both arms against the legs: shoulder 24 degrees back to 8 forward at 1.3 m/s; runs bend the elbows.
void SwingArms(const PostureInput& in, double share, Posture& posture) {
  const double g = in.motion.gait, run = in.motion.run, speed = in.motion.speed;
  const bool jog = in.lower == Behaviour::kJog;
  const double swing = (1 - run) * 16 * std::clamp(speed / 1.3, 0.2, 1.5) + run * (jog ? 24 : 34);
  const double base = (1 - run) * (20 + 4 * speed) + run * (jog ? 80 : 92);
  const uint64_t seed = in.motion.seed;
  for (const bool left : {true, false}) {
    // The arm is forward when the other leg is.
    const double c = -std::cos(kTau * (in.phase + (left ? 0.0 : 0.5)) - 0.2);
    const double personal = (0.85 + 0.3 * Draw(seed, 30, left)) * g * share;
    ArmAngles a;
    a.flex = personal * (swing * c - 5 + 6 * run) + 2 * (1 - g) + 0.8 * Sway(seed, 31 + left, 0.2, in.t);
    a.abduct = 7 + 5 * run * g + (in.body.spec.build > 0 ? 5 * in.body.spec.build : 0);
    a.rotate = 8 + 8 * run * g;
    a.elbow = (1 - g) * 14 + g * (base + personal * 9 * std::max(0.0, c) + 6 * run * c);
    Hang(left, a, posture);
    posture.curl[left ? 0 : 1] = 0.3 + 0.35 * run * g;
  }
}

// Speech: strokes of the hands in a cone before the chest, one beat after another, each with its own place.
void Gesture(const PostureInput& in, Posture& posture) {
  if (!in.state.speaking) return;
  const uint64_t seed = in.motion.seed;
  const double beat = 0.95, x = in.t_upper / beat;
  const auto k = static_cast<int64_t>(std::floor(x));
  const double u = SmoothStep(0.0, 0.45, x - std::floor(x));
  for (const bool left : {true, false}) {
    // One in four beats of each hand is a rest.
    const auto at = [&](int64_t i) {
      if (i < 0 || Draw(seed, 40 + left, i) < 0.25) return Vec3d{0.22, 0.42, -0.66};
      return Vec3d{0.42 + 0.22 * Draw(seed, 42 + left, i), 0.12 + 0.35 * Draw(seed, 44 + left, i), -0.48 + 0.36 * Draw(seed, 46 + left, i)};
    };
    const Vec3d a = at(k - 1), b = at(k);
    Place(in, left, a + (b - a) * u, posture);
    TurnHand(left, 30 + 30 * Draw(seed, 48 + left, k), 0, posture);
    posture.curl[left ? 0 : 1] = 0.25;
  }
}

void Reach(const PostureInput& in, Posture& posture) {
  // Towards what is looked at, or ahead; the arm of that side.
  Vec3d d{0.9, 0, 0.05};
  if (in.state.has_gaze) {
    const Vec3d eye = in.state.p_WP + Vec3d{0, 0, 0.82 * in.body.spec.stature};
    d = Normalized(RotationZ(-in.state.yaw) * (in.state.p_W_gaze - eye));
  }
  const bool left = d.y > 0.25;
  const double half = std::abs(in.body.p_PJ[At(Joint::kLeftShoulder)].y) / (in.body.size.upper_arm + in.body.size.forearm);
  // Not behind the back.
  d.x = std::max(d.x, 0.15);
  d = Normalized(d) * 0.97;
  Place(in, left, {d.x, half + (left ? d.y : -d.y), d.z}, posture);
  TurnHand(left, -35, 0, posture);
  posture.curl[left ? 0 : 1] = 0.15;
}

void Stretch(const PostureInput& in, Posture& posture) {
  const double down = 0.5 - 0.5 * std::cos(kTau * in.t_lower / 5);
  // Up: arms overhead and a little apart; down: hanging towards the toes.
  for (const bool left : {true, false}) {
    const double flex = 172 + (95 - 172) * down;
    Hang(left, {.flex = flex, .abduct = 8, .rotate = 0, .elbow = 8, .supinate = 0, .raise = 22 * (1 - down)}, posture);
    posture.curl[left ? 0 : 1] = 0.05;
  }
}

void Show(Prop prop, Posture& posture) { posture.props |= 1u << static_cast<int>(prop); }

// Both hands at mirrored places.
void PlaceBoth(const PostureInput& in, Vec3d share, Vec3d pole, double supinate, double bend, double curl, Posture& posture) {
  for (const bool left : {true, false}) {
    Place(in, left, share, posture, pole);
    TurnHand(left, supinate, bend, posture);
    posture.curl[left ? 0 : 1] = curl;
  }
}

void PhoneCall(const PostureInput& in, Posture& posture) {
  Place(in, false, AtHead(in, {-0.02, 0.80, -0.25}), posture, {0.45, 0.30, -1});
  TurnHand(false, -20, -12, posture);
  posture.curl[1] = 0.55;
  Show(Prop::kPhone, posture);
}

// Forearm 25 degrees to either side, 1.5 times a second.
void Wave(const PostureInput& in, Posture& posture) {
  const double side = 0.14 * std::sin(kTau * 1.5 * in.t_upper);
  Place(in, false, {0.22, 0.52 + side, 0.56 - 0.3 * side * side}, posture, {-0.3, 1, -0.45});
  TurnHand(false, -75, 0, posture);
  posture.curl[1] = 0.05;
}

// Wrists and hands on the table top before them.
void RestOnDesk(const PostureInput& in, Posture& posture) {
  const double length = in.body.size.upper_arm + in.body.size.forearm;
  const double shoulder = in.body.p_PJ[At(Joint::kLeftShoulder)].z - in.body.p_PJ[At(Joint::kPelvis)].z;
  // The hands of tall people hang from steeper arms.
  const double wrist = 0.085 + 0.14 * std::max(0.0, in.body.spec.stature - 1.6);
  constexpr double kForward = 0.36, kTilt = (kLeanAtDesk - 4) * kDegree;  // metres; of the upper trunk
  const double up = in.state.seating.desk + wrist - (in.state.seating.height + kPelvisOverMeasured * in.body.spec.stature + shoulder);
  const Vec3d target = RotationY(-kTilt) * Vec3d{kForward, 0, up};
  for (const bool left : {true, false}) {
    Place(in, left, {target.x / length, 0.22, target.z / length}, posture, {-0.3, 1.2, -0.35});
    TurnHand(left, -75, 0, posture);
    posture.curl[left ? 0 : 1] = 0.2;
  }
}

void RestOnThighs(const PostureInput& in, Posture& posture) {
  if (in.state.seating.desk > 0) return RestOnDesk(in, posture);
  for (const bool left : {true, false}) {
    Place(in, left, {0.56, 0.30, -0.66}, posture, {-0.9, 0.7, -0.2});
    TurnHand(left, -60, 0, posture);
  }
}

// The loaded arm hangs nearly still.
void Carry(const PostureInput& in, Posture& posture) {
  const double swing = 3.5 * in.motion.gait * std::cos(kTau * in.phase);
  Hang(false, {.flex = swing, .abduct = 9, .rotate = 5, .elbow = 10, .supinate = 0, .raise = -3}, posture);
  posture.curl[1] = 0.9;
  Show(Prop::kBag, posture);
}

// Hands on the handle of the stroller, which stands in P.
void PushStroller(const PostureInput& in, Posture& posture) {
  const double H = in.body.spec.stature, k = std::clamp(H / 1.7, 0.8, 1.1);
  const double length = in.body.size.upper_arm + in.body.size.forearm;
  const double shoulder = in.body.p_PJ[At(Joint::kLeftShoulder)].z, low = 0.015 * H;
  const Vec3d grip{0.39 - 0.035 * H, 0.20, 1.03 * k - (shoulder - low)};
  PlaceBoth(in, grip / length, {-0.5, 0.6, -1}, -70, 0, 0.85, posture);
  Show(Prop::kStroller, posture);
}

// A hand of some shades the eyes.
void LookUp(const PostureInput& in, Posture& posture) {
  if (Draw(in.motion.seed, 60, 0) >= 0.5) return;
  Place(in, false, AtHead(in, {0.62, 0.25, 0.42}), posture, {0.1, 1, -0.5});
  TurnHand(false, -70, 0, posture);
  posture.curl[1] = 0.05;
}

// Some cross their arms.
void Wait(const PostureInput& in, Posture& posture) {
  if (Draw(in.motion.seed, 61, 0) >= 0.4) return;
  Place(in, true, {0.30, -0.16, -0.40}, posture, {0.2, 1, -0.9});
  Place(in, false, {0.36, -0.14, -0.36}, posture, {0.2, 1, -0.9});
  TurnHand(true, -30, 0, posture);
  TurnHand(false, -30, 0, posture);
}

void HoldPhone(const PostureInput& in, Vec3d share, Vec3d pole, double supinate, double bend, Posture& posture) {
  PlaceBoth(in, share, pole, supinate, bend, 0.5, posture);
  Show(Prop::kPhone, posture);
}

void Crouch(const PostureInput& in, Posture& posture) {
  for (const bool left : {true, false}) {
    Place(in, left, {0.52, 0.12, -0.72}, posture);
    posture.curl[left ? 0 : 1] = 0.5;
  }
}

// One hand before the body, closed around something.
void Hold(const PostureInput& in, Vec3d share, double curl, Posture& posture) {
  Place(in, false, share, posture);
  posture.curl[1] = curl;
}

}  // namespace

void SetArms(const PostureInput& in, Posture& posture) {
  SwingArms(in, 1, posture);
  switch (in.upper) {
    case Behaviour::kTalk:
      return Gesture(in, posture);
    case Behaviour::kPhoneCall:
      return PhoneCall(in, posture);
    case Behaviour::kTexting:
      // Over the edge of a table that they sit at.
      if (in.lower == Behaviour::kSit && in.state.seating.desk > 0)
        return HoldPhone(in, {0.46, 0.055, -0.20}, {-0.2, 1.2, -0.5}, 55, -10, posture);
      return HoldPhone(in, {0.46, 0.055, -0.36}, {-0.2, 0.8, -1}, 55, -10, posture);
    case Behaviour::kTakePhoto:
      return HoldPhone(in, AtHead(in, {0, 0, -0.05}) + Vec3d{0.62, 0.05, 0}, {-0.1, 0.6, -1}, 5, -8, posture);
    case Behaviour::kWave:
      return Wave(in, posture);
    case Behaviour::kSit:
      return RestOnThighs(in, posture);
    case Behaviour::kCarry:
      return Carry(in, posture);
    case Behaviour::kPushStroller:
      return PushStroller(in, posture);
    case Behaviour::kCrouch:
      return Crouch(in, posture);
    case Behaviour::kStretch:
      return Stretch(in, posture);
    case Behaviour::kPoint:
      return Reach(in, posture);
    case Behaviour::kLookUp:
      return LookUp(in, posture);
    case Behaviour::kUmbrella:
      Show(Prop::kUmbrella, posture);
      return Hold(in, {0.40, 0.24, -0.25}, 0.9, posture);
    case Behaviour::kWalkDog:
      return Hold(in, {0.42, 0.30, -0.62}, 0.8, posture);
    case Behaviour::kWait:
      return Wait(in, posture);
    default:
      return;
  }
}

}  // namespace airsim360::internal
