#include "airsim360/people/motion/bvh_clip.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// A root with one leg; second frame: 90 degrees of knee flexion (shank back: about +X in BVH's axes).
constexpr const char* kClip = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT LeftUpLeg
  {
    OFFSET 1 -1 0
    CHANNELS 3 Zrotation Yrotation Xrotation
    JOINT LeftLeg
    {
      OFFSET 0 -5 0
      CHANNELS 3 Zrotation Yrotation Xrotation
      JOINT LeftFoot
      {
        OFFSET 0 -5 0
        CHANNELS 3 Zrotation Yrotation Xrotation
        End Site
        {
          OFFSET 0 -1 2
        }
      }
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.5
0 11 0  0 0 0  0 0 0  0 0 0  0 0 0
0 11 10  0 0 0  0 0 0  0 0 90  0 0 0
)";

TEST(BvhClip, PlaysOnABodyOfOtherSize) {
  const BvhClip clip = ParseBvh(kClip, "clip.bvh");
  EXPECT_EQ(clip.frames, 2);
  EXPECT_EQ(clip.joints.size(), 5u);
  const auto body = MakeProceduralBody({});
  const SkeletonPose rest = ClipPose(clip, *body, 0, {}), bent = ClipPose(clip, *body, 0.5, {});
  // At rest the leg hangs straight down.
  const Vec3d thigh = rest[Joint::kLeftKnee].p - rest[Joint::kLeftHip].p;
  EXPECT_NEAR(thigh.z, -body->size.thigh, 1e-6);
  // Bent, the shank points backwards; the root has gone forward by ten units of legs of ten.
  const Vec3d shank = bent[Joint::kLeftAnkle].p - bent[Joint::kLeftKnee].p;
  EXPECT_NEAR(shank.x, -body->size.shank, 1e-6);
  EXPECT_NEAR(bent[Joint::kPelvis].p.x, body->size.thigh + body->size.shank, 1e-6);
}

TEST(BvhClip, NamesTheLineOfWhatIsWrong) {
  const auto message = [](std::string text, std::string_view from, std::string_view to) {
    text.replace(text.find(from), from.size(), to);
    try {
      ParseBvh(text, "clip.bvh");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(kClip, "Zrotation", "Zrotatoin").find("clip.bvh:5: unknown channel"), std::string::npos);
  EXPECT_NE(message(kClip, "Frames: 2", "Frames: 3").find("a number expected"), std::string::npos);
  EXPECT_NE(message(kClip, "0.5", "nan").find("clip.bvh:28: a number expected"), std::string::npos);
  EXPECT_NE(message(kClip, "Frames: 2", "Frames: 999999999").find("number of frames must be"), std::string::npos);
}

}  // namespace
}  // namespace airsim360
