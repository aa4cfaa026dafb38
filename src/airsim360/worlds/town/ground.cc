#include "airsim360/worlds/town/ground.h"

#include <cmath>
#include <utility>

namespace airsim360 {

EntityId Ground::Begin(std::string name, std::string_view path, Surface surface) {
  const EntityId entity = builder_.AddEntity(std::move(name), builder_.tree().At(path));
  mesh_.SetEntity(entity);
  Use(surface);
  return entity;
}

void Ground::Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
  mesh_.QuadUv(a, b, c, d, uv(a), uv(b), uv(c), uv(d));
}

void Ground::Rect(const GroundRect& r, float z) { Quad({r.x0, r.y0, z}, {r.x1, r.y0, z}, {r.x1, r.y1, z}, {r.x0, r.y1, z}); }

void Ground::RingSector(Vec2f center, float r0, float r1, float a0, float a1, float z, int steps) {
  const auto at = [&](float r, int i) {
    const float a = a0 + (a1 - a0) * static_cast<float>(i) / static_cast<float>(steps);
    return Vec3f{center.x + r * std::cos(a), center.y + r * std::sin(a), z};
  };
  for (int i = 0; i < steps; ++i) {
    if (r0 > 0) {
      Quad(at(r0, i), at(r1, i), at(r1, i + 1), at(r0, i + 1));
    } else {
      const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
      const Vec3f a = at(0, 0), b = at(r1, i), c = at(r1, i + 1);
      mesh_.Triangle(a, b, c, uv(a), uv(b), uv(c));
    }
  }
}

void Ground::Wall(std::span<const Vec2f> line, float z0, float z1) {
  float u = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2f a = line[i], b = line[i + 1];
    const float next = u + std::hypot(b.x - a.x, b.y - a.y);
    mesh_.QuadUv({a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1}, {u, -z0}, {next, -z0}, {next, -z1}, {u, -z1});
    u = next;
  }
}

void Ground::Finish(std::string name) {
  if (mesh_.empty()) return;
  Mesh flat = mesh_.Finish(std::move(name));
  const MeshId mesh = builder_.AddMesh(lay_ ? lay_(flat) : std::move(flat));
  builder_.AddInstance({mesh, {}, kNoEntity});
}

Vec3f StreetStretch::At(float s, float d, float lift) const {
  const float z = CarriagewayHeight(line, d) + lift;
  return along_x ? Vec3f{s, line.center + d, z} : Vec3f{line.center - d, s, z};
}

BlockSide SideOf(const Block& block, int side) {
  const GroundRect& k = block.kerb;
  switch (side) {
    case 0:
      return {{k.x0, k.y0}, {1, 0}, {0, 1}, k.width()};
    case 1:
      return {{k.x1, k.y0}, {0, 1}, {-1, 0}, k.depth()};
    case 2:
      return {{k.x1, k.y1}, {-1, 0}, {0, -1}, k.width()};
    default:
      return {{k.x0, k.y1}, {0, -1}, {1, 0}, k.depth()};
  }
}

}  // namespace airsim360
