#include "airsim360/people/motion/pose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "airsim360/math/angles.h"
#include "airsim360/people/motion/gait_curves.h"

namespace airsim360 {
namespace {

constexpr int64_t kStep = 10'000'000;  // 100 Hz

std::shared_ptr<const Body> Adult(Sex sex = Sex::kMale, double stature = 1.75) {
  BodySpec spec;
  spec.sex = sex;
  spec.stature = stature;
  spec.age = stature < 1.5 ? 9 : 30;
  return MakeProceduralBody(spec);
}

size_t At(Joint j) { return static_cast<size_t>(j); }

// Rotation of a joint from the anatomical zero, in W.
Mat3d Zeroed(const Body& body, const SkeletonPose& pose, Joint j) { return pose[j].R * body.R_zero[At(j)].transpose(); }

struct LegAnglesDeg {
  double hip, knee;
};

LegAnglesDeg LegOf(const Body& body, const SkeletonPose& pose, bool left) {
  const Joint hip = left ? Joint::kLeftHip : Joint::kRightHip, knee = left ? Joint::kLeftKnee : Joint::kRightKnee;
  const Vec3d down{0, 0, -1};
  const Vec3d thigh = pose[Joint::kPelvis].R.transpose() * (Zeroed(body, pose, hip) * down);
  const Vec3d shank = Zeroed(body, pose, hip).transpose() * (Zeroed(body, pose, knee) * down);
  return {std::atan2(thigh.x, -thigh.z) / kDegree, std::atan2(-shank.x, -shank.z) / kDegree};
}

// Somebody who moves under orders.
struct Walker {
  std::shared_ptr<const Body> body;
  PersonState state;
  MotionState motion;
  int64_t t_ns = 0;
  const Ground* ground = nullptr;

  explicit Walker(std::shared_ptr<const Body> b, const Ground* g = nullptr) : body(std::move(b)), ground(g) {
    if (g != nullptr) state.p_WP.z = g->At({}).z;
    motion = StartMotion(*body, state, 5, 0, ground);
  }
  void Do(Behaviour lower, Behaviour upper) {
    if (state.lower != lower) state.lower_since_ns = t_ns;
    if (state.upper != upper) state.upper_since_ns = t_ns;
    state.lower = lower;
    state.upper = upper;
  }
  void Step(double speed, double turn = 0) {
    const double dt = static_cast<double>(kStep) * 1e-9;
    state.yaw += turn * dt;
    state.v_WP = {speed * std::cos(state.yaw), speed * std::sin(state.yaw), 0};
    state.p_WP += state.v_WP * dt;
    if (ground != nullptr) state.p_WP.z = ground->At(state.p_WP).z;
    t_ns += kStep;
    StepMotion(*body, state, t_ns, ground, motion);
  }
  SkeletonPose Pose() const { return PoseOf(*body, motion, state); }
};

TEST(Gait, HipAndKneeAreWithinOneDeviationOfTheBoys) {
  const auto body = Adult();
  Walker walker(body);
  walker.Do(Behaviour::kWalk, Behaviour::kWalk);
  for (int i = 0; i < 400; ++i) walker.Step(1.34);
  double hip[20] = {}, knee[20] = {};
  int count[20] = {};
  for (int i = 0; i < 2000; ++i) {
    walker.Step(1.34);
    const int bin = std::min(19, static_cast<int>(walker.motion.phase * 20));
    const LegAnglesDeg leg = LegOf(*body, walker.Pose(), true);
    hip[bin] += leg.hip;
    knee[bin] += leg.knee;
    ++count[bin];
  }
  int hip_good = 0, knee_good = 0;
  for (int i = 0; i < 20; ++i) {
    ASSERT_GT(count[i], 0);
    const double h = hip[i] / count[i] + internal::kPelvicTiltDeg - internal::kBoysHip[i], k = knee[i] / count[i] - internal::kBoysKnee[i];
    hip_good += std::abs(h) <= internal::kBoysHipDeviation[i];
    knee_good += std::abs(k) <= internal::kBoysKneeDeviation[i];
    if (std::getenv("AIRSIM360_PRINT"))
      std::printf("%2d hip %6.1f (%+5.1f of %.1f) knee %6.1f (%+5.1f of %.1f)\n", i, hip[i] / count[i], h, internal::kBoysHipDeviation[i],
                  knee[i] / count[i], k, internal::kBoysKneeDeviation[i]);
  }
  EXPECT_GE(hip_good, 18);
  EXPECT_GE(knee_good, 18);
}

TEST(Gait, CadenceFollowsTheWalkRatio) {
  for (const double speed : {0.6, 0.8, 1.0, 1.2, 1.34, 1.5, 1.8, 2.0}) {
    Walker walker(Adult());
    walker.Do(Behaviour::kWalk, Behaviour::kWalk);
    for (int i = 0; i < 300; ++i) walker.Step(speed);
    int strikes = 0;
    const int steps = 3000;
    double before = walker.motion.phase;
    for (int i = 0; i < steps; ++i) {
      walker.Step(speed);
      strikes += walker.motion.phase < before;
      before = walker.motion.phase;
    }
    const double per_minute = 2 * strikes / (steps * 0.01) * 60, wanted = 60 * speed / std::sqrt(60 * speed * 0.0064);
    EXPECT_NEAR(per_minute / wanted, 1, 0.035 + 2.0 / (2 * strikes)) << speed;
  }
}

// Feet in contact do not move: the ball while it is planted, the heel while the foot is flat.
struct SlideCheck {
  Vec3d ball[2];
  FootMotion::Mode mode[2] = {FootMotion::Mode::kSwing, FootMotion::Mode::kSwing};
  double worst = 0, deepest = 0;
  std::string where, where_deep;

  void See(const Walker& walker) {
    const SkeletonPose pose = walker.Pose();
    for (size_t k = 0; k < 2; ++k) {
      const FootMotion& foot = walker.motion.feet[k];
      const Joint toes = k == 0 ? Joint::kLeftToes : Joint::kRightToes, ankle = k == 0 ? Joint::kLeftAnkle : Joint::kRightAnkle;
      const Vec3d now = pose[toes].p;
      // While the foot tips over its heel the ball has not come down yet.
      const double phase = walker.motion.phase + (k == 0 ? 0 : 0.5), own = phase - std::floor(phase);
      const bool down = foot.mode == FootMotion::Mode::kPlanted && (walker.motion.gait == 0 || own > 0.08);
      if (down && mode[k] == FootMotion::Mode::kPlanted) Worse(Norm(now - ball[k]), walker, own, worst, where);
      if (!down || mode[k] != FootMotion::Mode::kPlanted) ball[k] = now;
      mode[k] = down ? FootMotion::Mode::kPlanted : FootMotion::Mode::kSwing;
      // The sole, by heel and toe tip.
      const double floor = walker.ground == nullptr ? 0 : std::min(walker.ground->At(now).z, walker.ground->At(pose[ankle].p).z);
      const double H = walker.body->spec.stature;
      const Vec3d rest = walker.body->p_PJ[At(ankle)];
      const Vec3d heel = pose[ankle] * Vec3d{-0.036 * H, 0, -rest.z};
      Worse(std::max(floor - heel.z, floor - (now.z - walker.body->p_PJ[At(toes)].z)), walker, own, deepest, where_deep);
    }
  }
  static void Worse(double value, const Walker& walker, double phase, double& worst, std::string& where) {
    if (value <= worst) return;
    worst = value;
    where = "at " + std::to_string(walker.t_ns / 10'000'000) + " phase " + std::to_string(phase) + " gait " +
            std::to_string(walker.motion.gait) + " run " + std::to_string(walker.motion.run) + " speed " +
            std::to_string(walker.motion.speed);
  }
};

class Stairs : public Ground {
 public:
  GroundPoint At(Vec3d p) const override { return {0.16 * std::floor(p.x / 0.30), {0, 0, 1}}; }
};
class Slope : public Ground {
 public:
  GroundPoint At(Vec3d p) const override { return {0.1 * p.x, Normalized(Vec3d{-0.1, 0, 1})}; }
};

TEST(FootLock, FeetDoNotSlideInMixedMotion) {
  for (const double stature : {1.75, 1.2}) {
    Walker walker(Adult(Sex::kFemale, stature));
    SlideCheck check;
    const struct {
      Behaviour lower, upper;
      double speed, turn;
    } orders[] = {{Behaviour::kWalk, Behaviour::kWalk, 1.3, 0},   {Behaviour::kWalk, Behaviour::kPhoneCall, 1.0, 0.5},
                  {Behaviour::kIdle, Behaviour::kTalk, 0, 0},     {Behaviour::kIdle, Behaviour::kIdle, 0, 0.7},
                  {Behaviour::kJog, Behaviour::kJog, 2.4, 0.2},   {Behaviour::kWalk, Behaviour::kTexting, 0.6, -0.6},
                  {Behaviour::kRun, Behaviour::kRun, 3.5, 0},     {Behaviour::kIdle, Behaviour::kWave, 0, 0},
                  {Behaviour::kWalk, Behaviour::kCarry, 1.6, 0.1}};
    for (int round = 0; round < 3; ++round) {
      double speed = 0;
      for (const auto& order : orders) {
        walker.Do(order.lower, order.upper);
        for (int i = 0; i < 400; ++i) {
          speed += std::clamp(order.speed - speed, -0.03, 0.03);
          walker.Step(speed, order.turn);
          check.See(walker);
        }
      }
    }
    EXPECT_LT(check.worst, 0.01) << stature << check.where;
    EXPECT_LT(check.deepest, 0.010) << stature << check.where_deep;
  }
}

TEST(FootLock, FeetStandOnStairsAndSlopes) {
  const Stairs stairs;
  const Slope slope;
  for (const Ground* ground : {static_cast<const Ground*>(&stairs), static_cast<const Ground*>(&slope)}) {
    Walker walker(Adult(), ground);
    walker.Do(Behaviour::kWalk, Behaviour::kWalk);
    for (int i = 0; i < 800; ++i) {
      walker.Step(0.8);
      const SkeletonPose pose = walker.Pose();
      for (size_t k = 0; k < 2; ++k) {
        const FootMotion& foot = walker.motion.feet[k];
        if (foot.mode != FootMotion::Mode::kPlanted) continue;
        EXPECT_NEAR(foot.p_W.z, ground->At(foot.p_W).z, 1e-9);
        // The ball joint is over its place, at its own height along the normal.
        const Joint toes = k == 0 ? Joint::kLeftToes : Joint::kRightToes;
        const double phase = walker.motion.phase + (k == 0 ? 0 : 0.5), own = phase - std::floor(phase);
        if (own > 0.1) {
          EXPECT_LT(Norm(pose[toes].p - foot.p_W - foot.normal * walker.body->p_PJ[At(toes)].z), 0.02) << i;
        }
      }
    }
  }
}

TEST(Gait, WalkersKeepAFootOnTheGroundAndRunnersFly) {
  for (const bool run : {false, true}) {
    Walker walker(Adult());
    walker.Do(run ? Behaviour::kRun : Behaviour::kWalk, run ? Behaviour::kRun : Behaviour::kWalk);
    for (int i = 0; i < 300; ++i) walker.Step(run ? 3.2 : 1.34);
    int both = 0, none = 0;
    for (int i = 0; i < 600; ++i) {
      walker.Step(run ? 3.2 : 1.34);
      int planted = 0;
      for (const FootMotion& foot : walker.motion.feet) planted += foot.mode == FootMotion::Mode::kPlanted;
      both += planted == 2;
      none += planted == 0;
    }
    if (run) {
      EXPECT_EQ(both, 0);
      EXPECT_GT(none, 60);
    } else {
      EXPECT_EQ(none, 0);
      EXPECT_NEAR(both / 600.0, 0.24, 0.04);  // twice 12 % of the stride
    }
  }
}

TEST(Pose, EveryBehaviourKeepsBonesTheirLength) {
  const auto body = Adult();
  for (int b = 0; b < static_cast<int>(Behaviour::kCount); ++b) {
    Walker walker(body);
    walker.state.speaking = true;
    walker.Do(Behaviour::kIdle, Behaviour::kIdle);
    for (int i = 0; i < 30; ++i) walker.Step(0);
    const Behaviour behaviour = static_cast<Behaviour>(b);
    const bool low = behaviour == Behaviour::kSit || behaviour == Behaviour::kCrouch || behaviour == Behaviour::kStretch;
    walker.Do(low ? behaviour : Behaviour::kIdle, behaviour);
    for (int i = 0; i < 300; ++i) {
      walker.Step(0);
      const SkeletonPose pose = walker.Pose();
      for (int j = 1; j < kJointCount; ++j) {
        const Joint joint = static_cast<Joint>(j), parent = ParentOf(joint);
        const double wanted = Norm(body->p_PJ[At(joint)] - body->p_PJ[At(parent)]);
        ASSERT_NEAR(Norm(pose[joint].p - pose[parent].p), wanted, 1e-9) << b << " " << JointName(joint);
        ASSERT_NEAR(pose[joint].R.determinant(), 1, 1e-9);
      }
    }
  }
}

// The fastest that a joint turns in W of somebody who walks, stops dead and does something else every 0.4 s, rad/s.
double FastestTurn(double stature, double speed, std::string& where) {
  Walker walker(Adult(Sex::kMale, stature));
  const Behaviour uppers[] = {Behaviour::kIdle,  Behaviour::kTalk,      Behaviour::kWave,   Behaviour::kPhoneCall, Behaviour::kTexting,
                              Behaviour::kPoint, Behaviour::kTakePhoto, Behaviour::kListen, Behaviour::kUmbrella,  Behaviour::kCarry};
  SkeletonPose before = walker.Pose();
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    // Also in the middle of a transition.
    if (i % 40 == 0) {
      walker.Do(i % 400 < 200   ? Behaviour::kWalk
                : i % 800 < 600 ? Behaviour::kIdle
                                : Behaviour::kSit,
                uppers[static_cast<size_t>(i / 40) % std::size(uppers)]);
      walker.state.speaking = i % 80 == 0;
    }
    walker.Step(walker.state.lower == Behaviour::kWalk ? speed : 0);
    const SkeletonPose pose = walker.Pose();
    for (int j = 0; j < kJointCount; ++j) {
      // Angle between the two rotations, over 10 ms.
      const Mat3d d = before.X_WJ[static_cast<size_t>(j)].R.transpose() * pose.X_WJ[static_cast<size_t>(j)].R;
      const double rate = std::acos(std::clamp((d.m[0][0] + d.m[1][1] + d.m[2][2] - 1) / 2, -1.0, 1.0)) / 0.01;
      if (rate <= worst) continue;
      worst = rate;
      where = std::string(JointName(static_cast<Joint>(j))) + " at step " + std::to_string(i);
    }
    before = pose;
  }
  return worst;
}

TEST(Pose, NothingJumpsWhenBehavioursChange) {
  // Walkers start and stop within 10 ms here, which is worse than any crowd does. Feet of runners swing at 10 rad/s.
  std::string where;
  for (const double speed : {0.5, 0.9, 1.2, 1.5}) EXPECT_LT(FastestTurn(1.75, speed, where), 20) << speed << " m/s: " << where;
  for (const double speed : {0.5, 0.9}) EXPECT_LT(FastestTurn(1.2, speed, where), 21) << "child, " << speed << " m/s: " << where;
}

TEST(Motion, IsAFunctionOfItsInputs) {
  uint64_t hashes[2];
  for (uint64_t& hash : hashes) {
    Walker walker(Adult());
    for (int i = 0; i < 1000; ++i) {
      walker.Do(i % 300 < 150 ? Behaviour::kWalk : Behaviour::kIdle, i % 200 < 100 ? Behaviour::kTalk : Behaviour::kWave);
      walker.Step(i % 300 < 150 ? 1.2 : 0, 0.3);
    }
    StateHasher hasher;
    HashMotion(walker.motion, hasher);
    for (const RigidTransform& X : walker.Pose().X_WJ) hasher.Add(X.p);
    hash = hasher.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace airsim360
