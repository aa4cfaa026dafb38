#include "airsim360/trace/point_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/trace/closest_point.h"
#include "airsim360/trace/trace_limit.h"

namespace airsim360::internal {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kRounding = 4e-6f;  // relative, generous for a dozen single precision operations

// At least the largest singular value: exact for rotations times a factor.
float LargestStretch(const Mat3f& A) {
  const Mat3f squares = A.transpose() * A;
  float most = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3f row = squares.row(i);
    most = std::max(most, std::fabs(row.x) + std::fabs(row.y) + std::fabs(row.z));
  }
  return std::sqrt(most) * (1 + kRounding);
}

Box3f BoundsInWorld(RTCScene scene, const AffineTransform& X) {
  RTCBounds b;
  rtcGetSceneBounds(scene, &b);
  Box3f box;
  for (int i = 0; i < 8; ++i) {
    box.Add(X * Vec3f{i & 1 ? b.upper_x : b.lower_x, i & 2 ? b.upper_y : b.lower_y, i & 4 ? b.upper_z : b.lower_z});
  }
  for (int i = 0; i < 3; ++i) {
    const float slack = kRounding * (std::fabs(box.min[i]) + std::fabs(box.max[i]));
    box.min[i] -= slack;
    box.max[i] += slack;
  }
  return box;
}

// Takes the triangle, given with the point asked for as origin, if it is nearer.
bool Improve(Vec3f a, Vec3f b, Vec3f c, NearestTriangle found, NearestTriangle& best) {
  found.offset = ClosestPointOnTriangle({}, a, b, c);
  found.distance = Norm(found.offset);
  if (!(found.distance < best.distance)) return false;
  best = found;
  return true;
}

// Shared by the visits of one query.
struct MeshQuery {
  const PlacedMesh* mesh;
  Vec3f p_W;
  NearestTriangle* best;
};

}  // namespace

TriangleBuffers BuffersOf(RTCGeometry geometry) {
  return {static_cast<const Vec3f*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)),
          static_cast<const Vec3u*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0))};
}

std::vector<TriangleBuffers> BuffersOf(RTCScene scene, unsigned count) {
  std::vector<TriangleBuffers> buffers;
  for (unsigned id = 0; id < count; ++id) buffers.push_back(BuffersOf(rtcGetGeometry(scene, id)));
  return buffers;
}

float DistanceToBox(Vec3f p, const Box3f& box) {
  const Vec3f out = Max(Max(box.min - p, p - box.max), Vec3f{});
  return Norm(out);
}

PlacedMesh::PlacedMesh(uint32_t instance, RTCScene scene, const std::vector<TriangleBuffers>& groups, const AffineTransform& X_WM)
    : instance_(instance), scene_(scene), groups_(&groups), X_WM_(X_WM), stretch_(kInfinity), bounds_(BoundsInWorld(scene, X_WM)) {
  if (Invert(X_WM.A, to_mesh_)) {
    stretch_ = LargestStretch(to_mesh_);
  } else {
    to_mesh_ = {};
  }
}

bool PlacedMesh::VisitTriangle(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<MeshQuery*>(args->userPtr);
  const PlacedMesh& mesh = *query.mesh;
  const TriangleBuffers& group = (*mesh.groups_)[args->geomID];
  const Vec3u t = group.triangles[args->primID];
  // In W, with the point as origin: fewest digits are lost.
  const Vec3f offset = mesh.X_WM_.p - query.p_W;
  const Mat3f& A = mesh.X_WM_.A;
  if (!Improve(A * group.vertices[t.x] + offset, A * group.vertices[t.y] + offset, A * group.vertices[t.z] + offset,
               {0, {}, mesh.instance_, args->geomID, args->primID, true}, *query.best)) {
    return false;
  }
  args->query->radius = std::min(args->query->radius, query.best->distance * mesh.stretch_ * (1 + kRounding));
  return true;
}

void PlacedMesh::Find(Vec3f p_W, NearestTriangle& best) const {
  const Vec3f p = to_mesh_ * (p_W - X_WM_.p);
  RTCPointQuery query{p.x, p.y, p.z, 0, best.distance * stretch_ + kRounding * Norm(p)};
  if (!std::isfinite(query.radius)) query.radius = kInfinity;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  MeshQuery visit{this, p_W, &best};
  rtcPointQuery(scene_, &query, &context, VisitTriangle, &visit);
}

PointQueryScene::PointQueryScene(RTCDevice device, RTCScene top, const std::vector<Baked>& baked, const std::vector<Instanced>& instanced,
                                 size_t meshes)
    : mesh_groups_(meshes), scene_(rtcNewScene(device)) {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  for (const Baked& part : baked) {
    // A geometry of its own: that of `top` may be marked as changed, for its ray mask.
    const TriangleBuffers buffers = BuffersOf(rtcGetGeometry(top, part.id));
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, buffers.vertices, 0, sizeof(Vec3f), part.vertices);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, buffers.triangles, 0, sizeof(Vec3u), part.triangles);
    rtcCommitGeometry(g);
    rtcAttachGeometryByID(scene_, g, part.id);
    rtcReleaseGeometry(g);
    baked_.resize(std::max<size_t>(baked_.size(), part.id + 1));
    instances_.resize(baked_.size());
    baked_[part.id] = buffers;
    instances_[part.id] = part.instance;
  }

  // One user geometry, a primitive an instance.
  placed_.reserve(instanced.size());
  for (const Instanced& i : instanced) {
    if (mesh_groups_[i.mesh].empty()) mesh_groups_[i.mesh] = BuffersOf(i.scene, i.groups);
    placed_.emplace_back(i.instance, i.scene, mesh_groups_[i.mesh], i.X_WM);
  }
  placed_id_ = static_cast<unsigned>(baked_.size());
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(placed_.size()));
  rtcSetGeometryUserData(g, placed_.data());
  rtcSetGeometryBoundsFunction(
      g,
      [](const RTCBoundsFunctionArguments* args) {
        const Box3f& b = static_cast<const PlacedMesh*>(args->geometryUserPtr)[args->primID].bounds();
        *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
      },
      nullptr);
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene_, g, placed_id_);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene_);
}

PointQueryScene::~PointQueryScene() { rtcReleaseScene(scene_); }

struct PointQueryScene::Query {
  const PointQueryScene* scene;
  std::span<const MovedInstance> left_out;
  NearestTriangle* best;
};

bool PointQueryScene::Visit(RTCPointQueryFunctionArguments* args) {
  const auto& [scene, left_out, best] = *static_cast<const Query*>(args->userPtr);
  const bool placed = args->geomID == scene->placed_id_;
  const uint32_t instance = placed ? scene->placed_[args->primID].instance() : scene->instances_[args->geomID];
  if (std::ranges::binary_search(left_out, instance, {}, &MovedInstance::instance)) return false;
  const Vec3f p{args->query->x, args->query->y, args->query->z};
  const float before = best->distance;
  if (placed) {
    scene->placed_[args->primID].Find(p, *best);
  } else {
    const TriangleBuffers& part = scene->baked_[args->geomID];
    const Vec3u t = part.triangles[args->primID];
    Improve(part.vertices[t.x] - p, part.vertices[t.y] - p, part.vertices[t.z] - p, {0, {}, instance, args->geomID, args->primID}, *best);
  }
  if (!(best->distance < before)) return false;
  args->query->radius = best->distance;
  return true;
}

void PointQueryScene::Find(Vec3f p_W, std::span<const MovedInstance> left_out, NearestTriangle& best) const {
  RTCPointQuery query{p_W.x, p_W.y, p_W.z, 0, best.distance};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Query visit{this, left_out, &best};
  rtcPointQuery(scene_, &query, &context, Visit, &visit);
}

}  // namespace airsim360::internal
