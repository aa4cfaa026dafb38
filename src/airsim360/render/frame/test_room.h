// A room whose every ray is known in closed form, for tests of the renderer: 10 x 10 x 6 metres with three
// cubes, two of them instances of one mesh, the last one mirrored; and an open square with a sky.
#pragma once

#include <cmath>
#include <memory>

#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"

namespace airsim360::test {

struct Truth {
  double range = 1e30;
  EntityId entity = 0;
  Vec3d normal;
};

struct Cube {
  Vec3d min, max;
};
inline constexpr Vec3d kRoomMin{-5, -5, 0}, kRoomMax{5, 5, 6};
inline constexpr Cube kCubes[] = {{{2.5, -0.5, 0}, {3.5, 0.5, 1}}, {{-3, 2, 1}, {-1, 3, 4}}, {{-4, -4, 0.25}, {-2, -3, 3.25}}};

/// Entities 1..6 are the walls (-x +x -y +y -z +z), 7..9 the cubes. `scale` multiplies everything.
inline std::shared_ptr<const Scene> MakeRoom(float scale = 1) {
  SceneBuilder builder("room");
  const CategoryId wall = builder.tree().At("construction/building");
  Mesh room{"room", {}, {}, {}, {}, {}}, cube{"cube", {}, {}, {}, {}, {}};
  for (int i = 0; i < 8; ++i) {
    cube.positions.push_back({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
    Vec3f p;
    for (int k = 0; k < 3; ++k) p[k] = scale * static_cast<float>(i >> k & 1 ? kRoomMax[k] : kRoomMin[k]);
    room.positions.push_back(p);
  }
  const uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (uint32_t f = 0; f < 6; ++f) {
    for (Mesh* mesh : {&room, &cube}) {
      const auto& q = quads[f];
      mesh->triangles.push_back({q[0], q[1], q[2]});
      mesh->triangles.push_back({q[0], q[2], q[3]});
    }
    Material material;
    material.base_color = {f & 1 ? 0.7f : 0.3f, f & 2 ? 0.6f : 0.2f, f & 4 ? 0.8f : 0.4f};
    room.parts.push_back({2 * f, 2, builder.AddMaterial(material), builder.AddEntity("wall", wall)});
  }
  builder.AddInstance({builder.AddMesh(room), AffineTransform(), kNoEntity});

  // Cube 0 has a mesh of its own, 1 and 2 share one, 2 is mirrored in x and y.
  const MeshId alone = builder.AddMesh(cube), shared = builder.AddMesh(cube);
  for (int i = 0; i < 3; ++i) {
    AffineTransform X;
    for (int k = 0; k < 3; ++k) {
      const bool mirrored = i == 2 && k < 2;
      const double size = kCubes[i].max[k] - kCubes[i].min[k];
      X.A.m[k][k] = scale * static_cast<float>(mirrored ? -size : size);
      X.p[k] = scale * static_cast<float>(mirrored ? kCubes[i].max[k] : kCubes[i].min[k]);
    }
    builder.AddInstance({i == 0 ? alone : shared, X, builder.AddEntity("cube", wall)});
  }
  builder.SetInteriorLight({3, 3, 3});
  return builder.Build();
}

/// Cubes on a square ground under the sky.
inline std::shared_ptr<const Scene> MakeOpenSquare() {
  SceneBuilder builder("square");
  const CategoryId building = builder.tree().At("construction/building");
  Mesh ground{"ground", {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}};
  const auto room = MakeRoom();
  const MaterialId material = builder.AddMaterial({});
  builder.AddInstance({builder.AddMesh(ground), AffineTransform(), builder.AddEntity("ground", building)});
  Mesh cube = room->meshes[1];
  cube.parts = {{0, 12, material, kNoEntity}};
  const MeshId id = builder.AddMesh(cube);
  RngStream rng(1, "square");
  for (int i = 0; i < 40; ++i) {
    const double angle = rng.Uniform(0, 6.28), r = rng.Uniform(4, 18);
    AffineTransform X = PlaceUpright({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)), 0},
                                     static_cast<float>(rng.Uniform(0, 6)), static_cast<float>(rng.Uniform(0.5, 3)));
    Instance instance{id, X, builder.AddEntity("cube", building)};
    instance.tint = {0.2f + 0.1f * (i % 8), 0.5f, 1 - 0.1f * (i % 8)};
    builder.AddInstance(instance);
  }
  builder.AddSky();
  return builder.Build();
}

/// Closed form of MakeRoom(1) from a point inside it.
inline Truth Look(Vec3d o, Vec3d d) {
  Truth truth;
  for (int k = 0; k < 3; ++k) {
    const double t = ((d[k] > 0 ? kRoomMax[k] : kRoomMin[k]) - o[k]) / d[k];
    if (d[k] == 0 || t >= truth.range) continue;
    truth = {t, static_cast<EntityId>(1 + 2 * k + (d[k] > 0)), {}};
    truth.normal[k] = d[k] > 0 ? -1 : 1;
  }
  for (int c = 0; c < 3; ++c) {
    double near = -1e30, far = 1e30;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
      const double a = (kCubes[c].min[k] - o[k]) / d[k], b = (kCubes[c].max[k] - o[k]) / d[k];
      if (std::min(a, b) > near) near = std::min(a, b), axis = k;
      far = std::min(far, std::max(a, b));
    }
    if (near > far || near <= 0 || near >= truth.range) continue;
    truth = {near, static_cast<EntityId>(7 + c), {}};
    truth.normal[axis] = d[axis] > 0 ? -1 : 1;
  }
  return truth;
}

/// Whether the truth is the same everywhere within 1e-4 rad.
inline bool FarFromEdges(Vec3d o, Vec3d d) {
  const Vec3d a = Normalized(Cross(d, std::abs(d.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0})), b = Cross(d, a);
  const Truth center = Look(o, d);
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.78539816339744831;
    const Truth side = Look(o, d + (a * std::cos(angle) + b * std::sin(angle)) * 1e-4);
    if (side.entity != center.entity || !(side.normal == center.normal)) return false;
  }
  return true;
}

/// A camera pose in free space of the room.
inline RigidTransform RandomPose(RngStream& rng) {
  const Vec3d p{rng.Uniform(-0.9, 2.3), rng.Uniform(-2.5, 1.9), rng.Uniform(1.1, 5.5)};
  return BodyPose(p, rng.Uniform(-3, 3), rng.Uniform(-1.2, 1.2), rng.Uniform(-3, 3)) * CameraInBody();
}

inline Mesh UprightQuad(float y, float half, float z0, float z1, MaterialId material) {
  Mesh mesh;
  mesh.positions = {{-half, y, z0}, {half, y, z0}, {half, y, z1}, {-half, y, z1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 2, material, kNoEntity}};
  return mesh;
}

/// Ground, a wall of windows, and a box whose glass front faces it; `lamps`: they can shine.
inline std::shared_ptr<const Scene> MakeNightStreet(bool lamps) {
  SceneBuilder builder("street");
  builder.AddSky();
  const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  const auto glass = [&](Vec3f color, Vec3f emission, float beam) {
    Material m{.name = "glass", .kind = SurfaceKind::kGlass, .base_color = color, .roughness = 0.05f};
    if (lamps) m.emission = emission, m.lamp = true, m.beam = beam;
    return builder.AddMaterial(m);
  };
  const MaterialId ground = builder.AddMaterial({.name = "ground", .base_color = {0.2f, 0.2f, 0.2f}});
  Mesh plane;
  plane.positions = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
  plane.triangles = {{0, 1, 2}, {0, 2, 3}};
  plane.parts = {{0, 2, ground, kNoEntity}};
  builder.AddInstance({builder.AddMesh(plane), {}, entity});
  const MeshId pane = builder.AddMesh(UprightQuad(0, 0.6f, 0, 1.6f, glass({0.3f, 0.2f, 0.1f}, {0.004f, 0.003f, 0.002f}, 0)));
  for (int i = 0; i < 24; ++i)
    builder.AddInstance(
        {pane, PlaceUpright({-8.0f + 1.5f * static_cast<float>(i % 8), 6, 1 + 2.2f * static_cast<float>(i / 8)}, 0), entity});
  const MeshId lens = builder.AddMesh(UprightQuad(0, 0.5f, -0.1f, 0.1f, glass({0.3f, 0.3f, 0.3f}, {3, 3, 3}, 30)));
  for (float x : {-3.0f, 3.0f})
    builder.AddInstance({lens, PlaceUpright({x, 0, 0.7f}, 3.14159f), entity, {1, 1, 1}, x < 0 && lamps ? Vec3f{} : Vec3f{1, 0.8f, 0.6f}});
  return builder.Build();
}

}  // namespace airsim360::test
