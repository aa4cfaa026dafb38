#include "airsim360/people/body/body.h"

#include <gtest/gtest.h>

#include <set>

#include "airsim360/base/error.h"
#include "airsim360/people/body/seat_sockets.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/people/body/test_bodies.h"

namespace airsim360 {
namespace {

BodySpec Person(int i) { return internal::DrawBodySpec(7, static_cast<uint64_t>(i), 0.3); }

TEST(Skeleton, NamesAreTheirOwnInverseAndParentsComeFirst) {
  for (int j = 0; j < kJointCount; ++j) {
    const Joint joint = static_cast<Joint>(j);
    EXPECT_EQ(JointByName(JointName(joint)), joint);
    EXPECT_LE(static_cast<int>(ParentOf(joint)), j);
  }
  EXPECT_EQ(JointByName("left_tentacle"), Joint::kCount);
}

TEST(Body, TheSameSpecificationGivesTheSameBytes) {
  const auto a = MakeProceduralBody(Person(3)), b = MakeProceduralBody(Person(3));
  ASSERT_EQ(a->levels.size(), b->levels.size());
  for (size_t k = 0; k < a->levels.size(); ++k) {
    EXPECT_EQ(a->levels[k].mesh.positions, b->levels[k].mesh.positions);
    EXPECT_EQ(a->levels[k].mesh.triangles, b->levels[k].mesh.triangles);
  }
  EXPECT_EQ(a->outfit, b->outfit);
}

TEST(Body, StandsOnTheGroundAndIsAsTallAsItsStature) {
  for (int i = 0; i < 12; ++i) {
    const auto body = MakeProceduralBody(Person(i));
    const BodyLevel& level = body->levels[0];
    float low = 9, high = 0;
    for (uint32_t v = 0; v < level.body_vertices; ++v) {
      low = std::min(low, level.mesh.positions[v].z);
      high = std::max(high, level.mesh.positions[v].z);
    }
    EXPECT_NEAR(low, 0, 0.003);
    // Hair, and a cap, stand off by at most 3 cm.
    EXPECT_GT(high, body->spec.stature - 0.01);
    EXPECT_LT(high, body->spec.stature + 0.035);
  }
}

TEST(Body, LevelsGetCoarserAndPartsCoverThem) {
  const auto body = MakeProceduralBody(Person(1));
  size_t before = SIZE_MAX;
  for (const BodyLevel& level : body->levels) {
    size_t triangles = 0, covered = 0;
    for (const MeshPart& part : level.mesh.parts) {
      EXPECT_EQ(part.first_triangle, covered);
      covered += part.triangle_count;
      EXPECT_LT(part.material, body->materials.size());
      if (part.entity == 0) triangles += part.triangle_count;
    }
    EXPECT_EQ(covered, level.mesh.triangles.size());
    EXPECT_LT(triangles, before / 2);
    before = triangles;
    ASSERT_EQ(level.influences.size(), level.mesh.positions.size());
    for (const Influences& in : level.influences) {
      float sum = 0;
      for (size_t k = 0; k < 4; ++k) {
        EXPECT_LE(in.joint[k], kRootInfluence);
        sum += in.weight[k];
      }
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
  EXPECT_LT(before, 600u);
}

TEST(Body, EveryBodyHasEverySocketInsideItself) {
  for (int i = 0; i < 8; ++i) {
    const auto body = MakeBody(Person(i));
    ASSERT_GE(body->sockets.size(), static_cast<size_t>(kSocketCount));
    for (int k = 0; k < kSocketCount; ++k) {
      const Socket& socket = body->sockets[static_cast<size_t>(k)];
      EXPECT_EQ(socket.name, kSocketNames[k]);
      EXPECT_EQ(FindSocket(*body, socket.name), k);
      // Skin within the radius that labels count on, and a bit.
      const Vec3d p = body->p_PJ[static_cast<size_t>(socket.joint)] + socket.p_J;
      double nearest = 9;
      const BodyLevel& level = body->levels[0];
      for (uint32_t v = 0; v < level.body_vertices; ++v) nearest = std::min(nearest, Norm(VecCast<double>(level.mesh.positions[v]) - p));
      EXPECT_LT(nearest, 1.6 * socket.radius + 0.02) << socket.name;
    }
  }
}

TEST(Body, NoCameraSeesPastASocket) {
  // Inside the meshes for people who are 60 pixels tall and more; for smaller ones nearly all.
  int inside = 0, all = 0;
  for (int i = 0; i < 6; ++i) {
    const auto body = MakeProceduralBody(Person(i), 1);
    for (const Socket& socket : body->sockets) {
      const Vec3d p = body->p_PJ[static_cast<size_t>(socket.joint)] + socket.p_J;
      EXPECT_TRUE(IsInside(body->levels[1], p)) << socket.name << " of person " << i;
      inside += IsInside(body->levels[2], p);
      ++all;
    }
  }
  EXPECT_GE(inside, 0.95 * all) << all;
}

TEST(Body, SocketsBesideTheMeshAreSeatedInsideIt) {
  const auto body = MakeProceduralBody(Person(2), 1);
  std::vector<Socket> sockets = body->sockets;
  const int toe = FindSocket(*body, "left_big_toe"), knee = FindSocket(*body, "left_knee");
  Socket& moved = sockets[static_cast<size_t>(toe)];
  moved.p_J.x += 0.02;  // before the shoe
  const Vec3d joint = body->p_PJ[static_cast<size_t>(moved.joint)];
  ASSERT_FALSE(IsInside(body->levels[1], joint + moved.p_J));
  SeatSockets(body->levels, body->p_PJ, 0.001, 0.04, sockets);
  EXPECT_TRUE(IsInside(body->levels[1], joint + moved.p_J));
  EXPECT_LT(Norm(moved.p_J - body->sockets[static_cast<size_t>(toe)].p_J), 0.02);
  EXPECT_EQ(sockets[static_cast<size_t>(knee)].p_J, body->sockets[static_cast<size_t>(knee)].p_J);
}

TEST(Body, LeftAndRightMirrorEachOther) {
  const auto body = MakeProceduralBody(Person(5));
  for (int j = 0; j < kJointCount; ++j) {
    const std::string name(JointName(static_cast<Joint>(j)));
    if (!name.starts_with("left_")) continue;
    const Vec3d a = body->p_PJ[static_cast<size_t>(j)];
    const Vec3d b = body->p_PJ[static_cast<size_t>(JointByName("right_" + name.substr(5)))];
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, -b.y);
    EXPECT_EQ(a.z, b.z);
  }
}

TEST(Body, CrowdsAreVaried) {
  std::set<std::string> outfits;
  for (int i = 0; i < 40; ++i) outfits.insert(MakeProceduralBody(internal::DrawBodySpec(1, static_cast<uint64_t>(i), 0.15))->outfit);
  EXPECT_GE(outfits.size(), 11u);
}

TEST(Body, RefusesGiants) {
  BodySpec spec;
  spec.stature = 4;
  EXPECT_THROW(MakeProceduralBody(spec), InputError);
}

TEST(Skinning, TheRestPoseIsTheMeshMoved) {
  const auto body = MakeProceduralBody(Person(2));
  const RigidTransform X_WP{RotationZ(0.7), {120, -40, 3}};
  SkeletonPose pose = RestPose(*body, X_WP);
  pose.props = ~0u;
  for (int level = 0; level < 4; ++level) {
    std::vector<Vec3f> positions;
    SkinBody(*body, level, pose, X_WP.p, positions);
    const auto& rest = body->levels[static_cast<size_t>(level)].mesh.positions;
    ASSERT_EQ(positions.size(), rest.size());
    for (size_t v = 0; v < rest.size(); ++v) EXPECT_LT(Norm(VecCast<double>(positions[v]) - X_WP.R * VecCast<double>(rest[v])), 1e-5);
  }
}

std::shared_ptr<const Scene> BareGround() {
  SceneBuilder builder("empty");
  const EntityId ground = builder.AddEntity("ground", builder.tree().At("ground/pavement"));
  Mesh plane;
  plane.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  plane.triangles = {{0, 1, 2}};
  builder.AddMaterial({});
  builder.AddInstance({builder.AddMesh(plane), {}, ground});
  return builder.Build();
}

TEST(Skinning, LevelsOfDetailAreOneEntity) {
  const std::vector<PersonInScene> people{{"a", MakeBody(Person(0)), 1, true}, {"b", MakeBody(Person(1)), 2, true}};
  std::vector<PersonRef> refs;
  const auto scene = AddPeople(BareGround(), people, refs);
  EXPECT_EQ(refs[0].level_count, 3);
  EXPECT_EQ(refs[1].level_count, 2);
  for (const PersonRef& ref : refs) {
    for (int level = ref.level; level < ref.level + ref.level_count; ++level)
      EXPECT_EQ(scene->instances[ref.InstanceOf(level)].entity, ref.entity);
  }
  const SkeletonPose a = RestPose(*people[0].body, {Mat3d{}, {5, 6, 0}}), b = RestPose(*people[1].body, {});
  const SkeletonPose* poses[] = {&a, &b};
  const uint8_t levels[] = {2, 0};  // the second has no level 0: its finest
  SceneState state;
  AppendPeople(people, refs, poses, levels, state);
  ASSERT_EQ(state.moved.size(), 5u);
  const bool hidden[] = {true, false, true, false, true};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(state.moved[i].hidden, hidden[i]) << i;
  ASSERT_EQ(state.deformed.size(), 2u);
  EXPECT_EQ(state.deformed[0].mesh, refs[0].MeshOf(2));
  EXPECT_EQ(state.deformed[0].positions->size(), people[0].body->levels[2].mesh.positions.size());
  EXPECT_EQ(state.deformed[1].mesh, refs[1].MeshOf(2));
}

TEST(Skinning, PropsThatAreNotShownTakeNoSpace) {
  const auto body = MakeProceduralBody(Person(2));
  std::vector<Vec3f> positions;
  SkinBody(*body, 0, RestPose(*body, {}), {}, positions);
  for (const PropRange& prop : body->levels[0].props) {
    for (uint32_t v = 1; v < prop.vertex_count; ++v)
      EXPECT_LT(Norm(positions[prop.first_vertex] - positions[prop.first_vertex + v]), 0.003f);
  }
}

TEST(Skinning, PeopleAreEntitiesAfterThoseOfTheScene) {
  const auto bare = BareGround();
  std::vector<PersonInScene> people;
  for (int i = 0; i < 3; ++i) people.push_back({"person/" + std::to_string(i), MakeBody(Person(i)), 2});
  std::vector<PersonRef> refs;
  const auto scene = AddPeople(bare, people, refs);
  ASSERT_EQ(refs.size(), 3u);
  EXPECT_EQ(scene->entities.front().name, "ground");
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene->entity(refs[i].entity).name, people[i].name);
    EXPECT_EQ(scene->tree[scene->entity(refs[i].entity).category].path, "human/person");
    EXPECT_EQ(scene->instances[refs[i].instance].entity, refs[i].entity);
  }
  // One shown, two hidden.
  const SkeletonPose pose = RestPose(*people[1].body, {Mat3d{}, {5, 6, 0}});
  const SkeletonPose* poses[] = {nullptr, &pose, nullptr};
  SceneState state;
  AppendPeople(people, refs, poses, {}, state);
  ASSERT_EQ(state.moved.size(), 3u);
  EXPECT_TRUE(state.moved[0].hidden);
  EXPECT_FALSE(state.moved[1].hidden);
  ASSERT_EQ(state.deformed.size(), 1u);
  EXPECT_EQ(state.deformed[0].mesh, refs[1].mesh);
}

}  // namespace
}  // namespace airsim360
