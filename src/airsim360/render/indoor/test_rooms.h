// Rooms for tests: boxes seen from inside, lamps, openings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/render/indoor/indoor_cache.h"
#include "airsim360/render/surface/surface_tables.h"

namespace airsim360::test {

/// Collects faces; `Build` makes a scene without a sky of them unless told otherwise.
class RoomScene {
 public:
  explicit RoomScene(const char* name) : builder_(name) {}
  SceneBuilder& builder() { return builder_; }
  MaterialId Paint(Vec3f color, Vec3f emission = {}) {
    Material material;
    material.name = "paint";
    material.base_color = color, material.emission = emission, material.roughness = 1;
    return builder_.AddMaterial(material);
  }
  /// The front is where a, b, c, d run counter-clockwise.
  void Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d, MaterialId material, const char* category = "construction/wall") {
    Mesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.parts = {{0, 2, material, kNoEntity}};
    builder_.AddInstance({builder_.AddMesh(mesh), {}, builder_.AddEntity("face", builder_.tree().At(category))});
  }
  /// Six faces that look inwards (or outwards); skip: bits of -x +x -y +y -z +z that are left open.
  void Box(Vec3f a, Vec3f b, MaterialId material, bool inwards = true, unsigned skip = 0) {
    const auto corner = [&](int i) { return Vec3f{i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z}; };
    const int faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    for (int f = 0; f < 6; ++f) {
      if (skip >> f & 1) continue;
      const int* q = faces[f];
      const char* category = f == 5 ? "construction/ceiling" : "construction/wall";
      if (inwards)
        Quad(corner(q[0]), corner(q[1]), corner(q[2]), corner(q[3]), material, category);
      else
        Quad(corner(q[3]), corner(q[2]), corner(q[1]), corner(q[0]), material, category);
    }
  }
  std::shared_ptr<const RayTracer> Build() { return std::make_shared<const RayTracer>(builder_.Build()); }

 private:
  SceneBuilder builder_;
};

/// The light of a scene's rooms without what the renderer adds: no sky, lamps all by surfels.
struct SolvedRoom {
  explicit SolvedRoom(std::shared_ptr<const RayTracer> t, const internal::IndoorOptions& options = {})
      : tracer(std::move(t)),
        tables(tracer->scene(), true),
        lights(tracer->scene(), tables, tracer->scene().environment),
        enclosure(*tracer),
        world{*tracer, tables, nullptr, &lights, nullptr, nullptr},
        solver(world, enclosure, options) {}
  std::shared_ptr<const RayTracer> tracer;
  internal::SurfaceTables tables;
  internal::LightTable lights;
  internal::Enclosure enclosure;
  internal::IndoorWorld world;
  internal::LightSolver solver;
};

}  // namespace airsim360::test
