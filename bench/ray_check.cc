// Where given rays meet a world, in double precision: what frames and other renderers are held against (bench/cycles).
//
// Usage: ray_check WORLD RAYS ANSWERS. RAYS holds six doubles a ray: origin and direction, in W. ANSWERS gets three doubles
// a ray: the entity, the distance along the direction made a unit vector, and that as Embree has it; 0, 0, 0 where the
// ray meets nothing. Embree only names the triangle: the distance is that of the triangle's plane, from its corners
// and place as the scene holds them, all in double.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/sensors/surface_label.h"
#include "airsim360/trace/ray_tracer.h"

namespace {

using namespace airsim360;

struct Ray {
  double origin[3], direction[3];
};
struct Answer {
  double entity, distance, embree;
};

double DistanceToPlane(const Scene& scene, SurfaceRef surface, Vec3d origin, Vec3d direction) {
  const Instance& instance = scene.instances[surface.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Vec3u triangle = mesh.triangles[surface.triangle];
  const auto corner = [&](uint32_t vertex) {
    const Vec3d p = VecCast<double>(mesh.positions[vertex]);
    const auto row = [&](int i) { return Dot(VecCast<double>(instance.X_WM.A.row(i)), p); };
    return Vec3d{row(0), row(1), row(2)} + VecCast<double>(instance.X_WM.p);
  };
  const Vec3d a = corner(triangle.x), normal = Cross(corner(triangle.y) - a, corner(triangle.z) - a);
  return Dot(normal, a - origin) / Dot(normal, direction);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: ray_check WORLD RAYS ANSWERS\n");
    return 2;
  }
  const Bytes bytes = ReadFile(argv[2]);
  std::vector<Ray> rays(bytes.size() / sizeof(Ray));
  std::memcpy(rays.data(), bytes.data(), rays.size() * sizeof(Ray));
  const RayTracer tracer(LoadWorld({.world = argv[1]}));
  std::vector<Answer> answers(rays.size());
  constexpr int64_t kChunk = 4096;
  ParallelFor((static_cast<int64_t>(rays.size()) + kChunk - 1) / kChunk, [&](int64_t chunk) {
    const size_t end = std::min(rays.size(), static_cast<size_t>((chunk + 1) * kChunk));
    for (size_t i = static_cast<size_t>(chunk * kChunk); i < end; ++i) {
      const Vec3d origin{rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]};
      const Vec3d direction = Normalized(Vec3d{rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]});
      const auto hit = tracer.Intersect(VecCast<float>(origin), VecCast<float>(direction));
      if (!hit) continue;
      answers[i] = {static_cast<double>(LabelOf(tracer, hit->surface).entity),
                    DistanceToPlane(tracer.scene(), hit->surface, origin, direction), static_cast<double>(hit->distance)};
    }
  });
  WriteFileAtomically(argv[3], std::as_bytes(std::span(answers)));
}
