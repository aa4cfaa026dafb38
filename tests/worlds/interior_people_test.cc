// People on the furniture of the built-in buildings: bodies against what they sit on and at.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "airsim360/people/body/skinning.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/motion/pose.h"
#include "airsim360/trace/ray_tracer.h"
#include "built_worlds.h"

namespace airsim360 {
namespace {

constexpr int64_t kBegin = 3'000'000'000;  // of the crowd until it is looked at

/// A crowd of a built-in building; where people can walk in it is found once, however many they are.
std::shared_ptr<const CrowdModel> CrowdIn(const std::string& world, size_t count) {
  static std::map<std::string, std::shared_ptr<const NavMesh>> walkable;
  std::shared_ptr<const NavMesh>& mesh = walkable[world];
  const auto crowd = BuildCrowd(*Built(world), mesh, {.file = {}, .count = count, .seed = 3});
  mesh = crowd->navmesh;
  return crowd;
}

/// A crowd that has lived for a moment, and the body of one of its sitters.
struct Sitters {
  explicit Sitters(const std::string& world, size_t count) : scene(Built(world)), tracer(scene) {
    crowd = CrowdIn(world, count);
    state = StartCrowd(*crowd);
    StepCrowd(*crowd, state, kBegin, {});
    for (PersonIndex i = 0; i < state.people.size(); ++i)
      if (state.people[i].lower == Behaviour::kSit && state.people[i].seating.height > 0) who.push_back(i);
  }
  std::shared_ptr<const Scene> scene;
  RayTracer tracer;
  std::shared_ptr<const CrowdModel> crowd;
  CrowdState state;
  std::vector<PersonIndex> who;
};

struct Touches {
  double deepest = 0;   ///< metres of flesh behind a surface of furniture that is no seat, or of the building
  double in_small = 0;  ///< in what lies about
  double in_seat = 0;   // how deep the seat is pressed
  std::string what;
  double lowest_foot = 1, sole_off = 0;
};

/// Flesh is behind a surface if a ray from the nearest bone to it meets the surface first.
void Measure(const Sitters& room, PersonIndex who, Touches& touches) {
  const PersonState& person = room.state.people[who];
  const PersonTraits& traits = room.crowd->people[who];
  const auto body = MakeProceduralBody({.sex = traits.female ? Sex::kFemale : Sex::kMale, .age = traits.age, .stature = traits.stature}, 2);
  MotionState motion = StartMotion(*body, person, who, 0);
  for (int k = 1; k <= 40; ++k) StepMotion(*body, person, k * 50'000'000ll, nullptr, motion);
  const SkeletonPose pose = PoseOf(*body, motion, person);
  std::vector<Vec3f> skin;
  SkinBody(*body, 2, pose, {}, skin);
  const BodyLevel& level = body->levels[2];
  for (uint32_t v = 0; v < level.body_vertices; ++v) {
    const Influences& follows = level.influences[v];
    const auto strongest = static_cast<size_t>(std::max_element(follows.weight.begin(), follows.weight.end()) - follows.weight.begin());
    const auto joint = std::min<size_t>(follows.joint[strongest], kJointCount - 1);
    const Vec3f bone = VecCast<float>(pose.X_WJ[joint].p), d = skin[v] - bone;
    const double above = skin[v].z - person.p_WP.z;
    touches.lowest_foot = std::min(touches.lowest_foot, above);
    const float length = Norm(d);
    if (length < 1e-4f) continue;
    const auto hit = room.tracer.Intersect(bone, d * (1 / length), length);
    if (!hit) continue;
    const double depth = length - hit->distance, z = bone.z + d.z / length * hit->distance - person.p_WP.z;
    if (above < 0.06) continue;  // soles
    if ((hit->normal.z > 0.6f || z < person.seating.height + 0.02) && std::abs(z - person.seating.height) < 0.08) {
      touches.in_seat = std::max(touches.in_seat, z - above);
    } else {
      const Instance& instance = room.scene->instances[hit->surface.instance];
      EntityId entity = instance.entity;
      for (const MeshPart& part : room.scene->meshes[instance.mesh].parts)
        if (hit->surface.triangle - part.first_triangle < part.triangle_count && part.entity != kNoEntity) entity = part.entity;
      const std::string& path = room.scene->tree[room.scene->entity(entity).category].path;
      const bool large = std::ranges::any_of(
          std::array{"furniture/seating", "furniture/sofa", "furniture/desk", "furniture/table", "furniture/counter", "construction"},
          [&](const char* prefix) { return path.starts_with(prefix); });
      double& deepest = large ? touches.deepest : touches.in_small;
      if (depth <= deepest) continue;
      deepest = depth;
      char text[200];
      std::snprintf(text, sizeof text, "%s, joint %zu, %.2f m up, normal %.1f %.1f %.1f", room.scene->entity(entity).name.c_str(), joint,
                    above, hit->normal.x, hit->normal.y, hit->normal.z);
      touches.what = text;
    }
  }
}

TEST(PeopleInRooms, SitOnTheirSeatsAndTouchNothingElse) {
  for (const char* world : {"office", "apartment", "mall"}) {
    SCOPED_TRACE(world);
    const bool small = std::string(world) == "apartment";
    const Sitters room(world, small ? 20 : 220);
    const size_t least = small ? 2 : 20;  // a flat has few seats that nothing stands before
    ASSERT_GE(room.who.size(), least);
    std::set<std::pair<double, double>> places;
    for (const PersonIndex i : room.who) {
      const PersonState& person = room.state.people[i];
      Touches touches;
      Measure(room, i, touches);
      SCOPED_TRACE(room.crowd->people[i].name + " at " + std::to_string(person.p_WP.x) + " " + std::to_string(person.p_WP.y) + " seat " +
                   std::to_string(person.seating.height) + " desk " + std::to_string(person.seating.desk) + " stature " +
                   std::to_string(room.crowd->people[i].stature));
      EXPECT_LE(touches.deepest, 0.02) << touches.what;
      EXPECT_LE(touches.in_small, 0.05) << touches.what;
      EXPECT_LE(touches.in_seat, 0.07);
      EXPECT_NEAR(touches.lowest_foot, 0, 0.03);
      EXPECT_TRUE(places.insert({person.p_WP.x, person.p_WP.y}).second) << "two on one seat";
    }
  }
}

double Facing(const PersonState& person, Vec3d p) {
  return std::abs(std::remainder(std::atan2(p.y - person.p_WP.y, p.x - person.p_WP.x) - person.yaw, 2 * M_PI));
}

TEST(PeopleInRooms, QueueOneBehindTheOtherAndTalkFaceToFace) {
  const auto crowd = CrowdIn("mall", 120);
  CrowdState state = StartCrowd(*crowd);
  int in_line = 0, talks = 0, served = 0;
  std::vector<CrowdEvent> events;
  for (int second = 1; second <= 60; ++second) {
    StepCrowd(*crowd, state, 1'000'000'000, {}, &events);
    if (second != 10 && second != 40) continue;
    for (PersonIndex i = 0; i < state.people.size(); ++i) {
      const PersonState& person = state.people[i];
      if (PersonStateName(*crowd, state, i) == "waiting" && person.lower == Behaviour::kWait) {
        for (PersonIndex k = 0; k < state.people.size(); ++k) {
          const Vec3d d = state.people[k].p_WP - person.p_WP;
          if (k == i || PersonStateName(*crowd, state, k) != "waiting" || std::hypot(d.x, d.y) > 1 || std::abs(d.z) > 1) continue;
          EXPECT_GT(std::hypot(d.x, d.y), 0.55);
          in_line += Facing(person, state.people[k].p_WP) < 0.4;  // the one before
        }
      }
      if (person.group == 0 || person.partner == kNoPerson || person.lower != Behaviour::kIdle) continue;
      const PersonState& other = state.people[person.partner];
      if (other.group != person.group || other.lower != Behaviour::kIdle) continue;
      EXPECT_LT(Norm(other.p_WP - person.p_WP), 2);  // more than two stand on a circle
      talks += Facing(person, other.p_WP) < 0.4;
    }
  }
  for (const CrowdEvent& event : events) served += event.from == "waiting" && event.to == "walking";
  EXPECT_GE(in_line, 3);
  EXPECT_GE(talks, 8);
  EXPECT_GE(served, 3);
}

}  // namespace
}  // namespace airsim360
