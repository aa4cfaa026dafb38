#include "airsim360/trace/whereabouts.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace airsim360 {
namespace {

constexpr int kDirections = 256;
// Of the upper directions, for solids often stand on the ground without a bottom of their own:
constexpr double kLeastHits = 0.5;   // share that meets something, to be inside of it
constexpr double kLeastBacks = 0.9;  // share of backs among what they meet

// Directions spread evenly over the sphere: a Fibonacci lattice.
Vec3f Direction(int i) {
  const double z = 1 - (2.0 * i + 1) / kDirections, r = std::sqrt(1 - z * z);
  const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
  return VecCast<float>(Vec3d{r * std::cos(angle), r * std::sin(angle), z});
}

// Outward normal of a triangle in W, not of unit length; mirrored instances keep their outside.
Vec3f FrontOf(const RayTracer& tracer, SurfaceRef surface) {
  const Instance& instance = tracer.scene().instances[surface.instance];
  const Vec3u triangle = tracer.scene().meshes[instance.mesh].triangles[surface.triangle];
  const auto positions = tracer.Positions(instance.mesh);
  const AffineTransform& place = tracer.Place(surface.instance);
  const Vec3f a = place * positions[triangle.x], b = place * positions[triangle.y], c = place * positions[triangle.z];
  return Cross(b - a, c - a) * (place.A.determinant() < 0 ? -1.0f : 1.0f);
}

// What rays from a place meet.
struct Surroundings {
  int rays = 0, hits = 0;
  int up_rays = 0, up_hits = 0, up_backs = 0;  // of them upward
  float nearest_back = std::numeric_limits<float>::infinity();
  SurfaceRef back = {};  // the nearest of the upward backs: a wall or the top of what is around
};

Surroundings LookAround(const RayTracer& tracer, Vec3f p, int step) {
  Surroundings seen;
  for (int i = step / 2; i < kDirections; i += step) {
    const Vec3f direction = Direction(i);
    const auto hit = tracer.Intersect(p, direction);
    ++seen.rays;
    seen.hits += hit.has_value();
    if (direction.z <= 0) continue;
    ++seen.up_rays;
    seen.up_hits += hit.has_value();
    if (!hit || Dot(FrontOf(tracer, hit->surface), direction) <= 0) continue;
    ++seen.up_backs;
    if (hit->distance >= seen.nearest_back) continue;
    seen.nearest_back = hit->distance;
    seen.back = hit->surface;
  }
  return seen;
}

}  // namespace

Whereabouts FindWhereabouts(const RayTracer& tracer, Vec3d p_W) {
  const bool closed = tracer.scene().sky_entity == kNoEntity;
  const Vec3f p = VecCast<float>(p_W);
  // A few rays tell of most places that nothing is wrong with them.
  constexpr int kFew = 16;
  const Surroundings few = LookAround(tracer, p, kDirections / kFew);
  if (2 * few.up_backs < few.up_hits && !(closed && few.hits < few.rays)) return {};
  const Surroundings all = LookAround(tracer, p, 1);
  if (closed && all.hits < all.rays) return {Whereabouts::Kind::kOutside};
  if (all.up_hits < kLeastHits * all.up_rays || all.up_backs < kLeastBacks * all.up_hits) return {};
  return {Whereabouts::Kind::kInside, all.back};
}

}  // namespace airsim360
