// How far the coarser levels of a pack's characters look like the finest one.
//   people_levels PACK [EVERY]
// Looks at each character, walking, from eight sides with parallel rays 5 mm apart, and prints by level: rays that meet the
// body at one of the two levels only, and rays that meet another kind of thing (skin, hair, cloth of above, below, shoes).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "airsim360/base/file.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/body/body_pack.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/people/motion/pose.h"
#include "airsim360/trace/ray_tracer.h"

using namespace airsim360;

namespace {

SkeletonPose Walking(const Body& body) {
  PersonState s;
  s.lower = s.upper = Behaviour::kWalk;
  s.v_WP = {1.3, 0, 0};
  MotionState motion = StartMotion(body, s, 1, 0);
  for (int64_t t = 50'000'000; t <= 3'000'000'000; t += 50'000'000) {
    s.p_WP.x += 1.3 * 0.05;
    StepMotion(body, s, t, nullptr, motion);
  }
  return PoseOf(body, motion, s);
}

// What each ray meets: 0 nothing, else 1 + kind of cloth.
std::vector<int> Seen(const PackCharacter& c, const Body& body, size_t level, const SkeletonPose& pose) {
  SceneBuilder builder("person");
  builder.AddMaterial({});
  std::vector<EntityId> entities;
  for (int kind = 0; kind < 6; ++kind) entities.push_back(builder.AddEntity("kind", builder.tree().At("human/person")));
  Mesh mesh = body.levels[level].mesh;
  SkinBody(body, static_cast<int>(level), pose, pose.X_WP.p, mesh.positions);
  std::erase_if(mesh.parts, [](const MeshPart& p) { return p.entity != 0; });
  mesh.triangles.resize(mesh.parts.back().first_triangle + mesh.parts.back().triangle_count);
  for (MeshPart& p : mesh.parts) {
    p.entity = entities[static_cast<size_t>(c.cloths[p.material])];
    p.material = 0;
  }
  std::vector<int> kinds(mesh.triangles.size());
  for (const MeshPart& p : mesh.parts) std::fill_n(kinds.begin() + p.first_triangle, p.triangle_count, static_cast<int>(p.entity));
  builder.AddInstance({builder.AddMesh(std::move(mesh)), {}, entities[0]});
  const RayTracer tracer(builder.Build());
  std::vector<int> seen;
  constexpr float kStep = 0.005f, kHalf = 0.75f;
  for (int side = 0; side < 8; ++side) {
    const float a = static_cast<float>(kPi) / 4 * static_cast<float>(side);
    const Vec3f towards{-std::cos(a), -std::sin(a), 0}, across{-std::sin(a), std::cos(a), 0};
    for (float z = 0.01f; z < 2; z += kStep) {
      for (float u = -kHalf; u < kHalf; u += kStep) {
        const auto hit = tracer.Intersect(towards * -3 + across * u + Vec3f{0, 0, z}, towards);
        seen.push_back(hit ? kinds[hit->surface.triangle] : 0);
      }
    }
  }
  return seen;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: people_levels PACK [EVERY]\n");
    return 2;
  }
  const BodyPack pack = DecodeBodyPack(ReadFile(argv[1]), argv[1]);
  const size_t every = argc > 2 ? static_cast<size_t>(std::max(1, std::atoi(argv[2]))) : 1;
  double body_rays[4] = {}, outline[4] = {}, other[4] = {}, triangles[4] = {};
  int count = 0;
  for (size_t k = 0; k < pack.characters.size(); k += every, ++count) {
    const PackCharacter& c = pack.characters[k];
    BodyPack one;
    one.characters = {c};
    one.texture_names = pack.texture_names;
    one.textures = pack.textures;
    const auto body = MakePackBody(one, c.spec);
    const SkeletonPose pose = Walking(*body);
    const std::vector<int> finest = Seen(c, *body, 0, pose);
    for (size_t level = 0; level < 4; ++level) {
      const std::vector<int> seen = level == 0 ? finest : Seen(c, *body, level, pose);
      triangles[level] += static_cast<double>(c.levels[level].mesh.triangles.size());
      for (size_t i = 0; i < seen.size(); ++i) {
        body_rays[level] += finest[i] != 0;
        outline[level] += (finest[i] == 0) != (seen[i] == 0);
        other[level] += finest[i] != 0 && seen[i] != 0 && finest[i] != seen[i];
      }
    }
  }
  std::printf("%d characters, share of what level 0 fills: outline differs, another kind is seen\n", count);
  for (size_t level = 0; level < 4; ++level)
    std::printf("level %zu: %6.0f triangles  %5.2f %%  %5.2f %%\n", level, triangles[level] / count,
                100 * outline[level] / body_rays[level], 100 * other[level] / body_rays[level]);
}
