#include "airsim360/trace/closest_point.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

Vec3f ClosestPointOnSegment(Vec3f p, Vec3f a, Vec3f b) {
  const Vec3f ab = b - a;
  const float length2 = Dot(ab, ab);
  if (!(length2 > 0)) return a;
  return a + ab * std::clamp(Dot(p - a, ab) / length2, 0.0f, 1.0f);
}

float Distance2(Vec3f a, Vec3f b) { return Dot(a - b, a - b); }

struct Query {
  const RayTracer* tracer;
  bool skip_moved;
};

// Shrinks the query to a nearer triangle. Works in W whatever the instance transform is.
bool VisitTriangle(RTCPointQueryFunctionArguments* args) {
  const auto& user = *static_cast<const Query*>(args->userPtr);
  const RayTracer& tracer = *user.tracer;
  const uint32_t instance_id = args->context->instStackSize > 0 ? args->context->instID[0] : kMiss;
  const SurfaceRef surface = tracer.Resolve(args->geomID, instance_id, args->primID);
  if (user.skip_moved &&
      std::ranges::binary_search(tracer.moved(), surface.instance, {}, &MovedInstance::instance))
    return false;
  const MeshId mesh = tracer.scene().instances[surface.instance].mesh;
  const Vec3u t = tracer.scene().meshes[mesh].triangles[surface.triangle];
  const std::span<const Vec3f> positions = tracer.Positions(mesh);
  const AffineTransform& X_WM = tracer.Place(surface.instance);
  const Vec3f p{args->query->x, args->query->y, args->query->z};
  const Vec3f q =
      ClosestPointOnTriangle(p, X_WM * positions[t.x], X_WM * positions[t.y], X_WM * positions[t.z]);
  const float distance = Norm(p - q);
  if (!(distance < args->query->radius)) return false;
  args->query->radius = distance;
  return true;
}

}  // namespace

Vec3f ClosestPointOnTriangle(Vec3f p, Vec3f a, Vec3f b, Vec3f c) {
  // Inside the prism over the triangle the answer is the foot of the perpendicular, else it is on an edge.
  const Vec3f n = Cross(b - a, c - a);
  const float n2 = Dot(n, n);
  if (n2 > 0) {
    const float wa = Dot(Cross(b - p, c - p), n), wb = Dot(Cross(c - p, a - p), n),
                wc = Dot(Cross(a - p, b - p), n);
    if (wa >= 0 && wb >= 0 && wc >= 0) return p - n * (Dot(p - a, n) / n2);
  }
  const Vec3f candidates[3] = {ClosestPointOnSegment(p, a, b), ClosestPointOnSegment(p, b, c),
                               ClosestPointOnSegment(p, c, a)};
  return *std::min_element(candidates, candidates + 3,
                           [&](Vec3f x, Vec3f y) { return Distance2(p, x) < Distance2(p, y); });
}

float ClosestSurfaceDistance(const RayTracer& tracer, RTCScene top, bool skip_moved, Vec3f p_W,
                             float max_distance) {
  RTCPointQuery query{p_W.x, p_W.y, p_W.z, 0, max_distance};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Query user{&tracer, skip_moved};
  rtcPointQuery(top, &query, &context, VisitTriangle, &user);
  return query.radius;
}

}  // namespace airsim360::internal
