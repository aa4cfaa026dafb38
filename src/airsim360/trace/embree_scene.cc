#include "airsim360/trace/embree_scene.h"

#include <algorithm>
#include <thread>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/trace/trace_limit.h"

namespace airsim360::internal {
namespace {

// Spatial splits trace faster but take several times longer to build.
constexpr uint64_t kMaxHighQualityTriangles = 6'000'000;

constexpr uint32_t kLastGeneration = 15;          // two bits of a ray mask each, from 0 on
constexpr uint32_t kAllGenerations = 0x55555555;  // times kMaskSolid or kMaskClearPanes

// Robust: rays do not slip between neighbouring triangles, which would write a wrong label.
SceneHandle NewScene(RTCDevice device, RTCBuildQuality quality, bool robust = true) {
  SceneHandle scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene.get(), quality);
  return scene;
}

// The geometries that a mesh is divided into.
enum class Group : uint8_t { kOpaque, kTested, kPane, kLeftOut };

Group GroupOf(Opacity opacity) {
  return opacity == Opacity::kOpaque ? Group::kOpaque : opacity == Opacity::kClear ? Group::kLeftOut : Group::kTested;
}

// Group of every triangle of a mesh.
std::vector<Group> Classify(const Mesh& mesh, const Scene& scene, bool sort_alpha) {
  std::vector<Group> out(mesh.triangles.size(), Group::kOpaque);
  for (const MeshPart& part : mesh.parts) {
    const Material& material = scene.materials[part.material];
    const auto begin = out.begin() + part.first_triangle;
    if (!NeedsAlphaTest(material, mesh)) {
      if (IsClearPane(material)) std::fill(begin, begin + part.triangle_count, Group::kPane);
      continue;
    }
    const AlphaTest test(material, scene.textures);
    for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t)
      out[t] = sort_alpha ? GroupOf(test.Classify(mesh, t)) : Group::kTested;
  }
  return out;
}

// The triangles of one group; null if there are none.
std::unique_ptr<MeshGeometry> SelectTriangles(const Mesh& mesh, const std::vector<Group>& groups, Group wanted) {
  const auto count = static_cast<size_t>(std::count(groups.begin(), groups.end(), wanted));
  if (count == 0) return nullptr;
  auto out = std::make_unique<MeshGeometry>();
  out->mesh = &mesh;
  out->primitive_count = static_cast<uint32_t>(count);
  // All of the mesh: share its index buffer.
  if (count == mesh.triangles.size()) return out;

  out->triangles.reserve(count);
  for (uint32_t t = 0; t < groups.size(); ++t) {
    if (groups[t] == wanted) out->triangles.push_back(t);
  }
  out->indices.reserve(out->triangles.size());
  for (uint32_t triangle : out->triangles) out->indices.push_back(mesh.triangles[triangle]);
  return out;
}

std::unique_ptr<AlphaGeometry> MakeAlpha(const MeshGeometry& geometry, const Scene& scene) {
  auto alpha = std::make_unique<AlphaGeometry>();
  alpha->mesh = geometry.mesh;
  alpha->triangles = geometry.triangles;
  // The primitives are in the order of the triangles, and so of the parts.
  const auto triangle = [&](uint32_t primitive) { return geometry.triangles.empty() ? primitive : geometry.triangles[primitive]; };
  uint32_t primitive = 0;
  for (const MeshPart& part : geometry.mesh->parts) {
    const uint32_t first = primitive, end = part.first_triangle + part.triangle_count;
    while (primitive < geometry.primitive_count && triangle(primitive) < end) ++primitive;
    if (primitive == first) continue;
    alpha->primitive_test.insert(alpha->primitive_test.end(), primitive - first, static_cast<uint32_t>(alpha->tests.size()));
    alpha->tests.emplace_back(scene.materials[part.material], scene.textures);
  }
  return alpha;
}

// Mostly leaves: they have gaps anyway, and a tenth of the time of a picture full of trees is what robustness costs there.
bool IsFoliage(const Mesh& mesh, const std::vector<Material>& materials) {
  uint64_t leaves = 0;
  for (const MeshPart& part : mesh.parts) leaves += materials[part.material].kind == SurfaceKind::kFoliage ? part.triangle_count : 0;
  return 2 * leaves > mesh.triangles.size();
}

bool IsIdentity(const AffineTransform& X) { return X == AffineTransform(); }

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene, const RayTracerOptions& options) {
  const std::string& isa = options.isa;
  device_.reset(rtcNewDevice(isa.empty() ? nullptr : ("isa=" + isa).c_str()));
  if (device_ == nullptr) throw RuntimeError("ray tracer: Embree refuses a device (isa '" + isa + "')");
  std::vector<uint32_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];

  SplitMeshes(scene, uses, options.sort_alpha);
  BuildSubScenes(scene, uses);
  AttachInstances(scene, uses);
  rtcCommitScene(top_.get());
  if (panes_ != nullptr) rtcCommitScene(panes_.get());
  ThrowOnError();
}

void EmbreeScene::SplitMeshes(const Scene& scene, const std::vector<uint32_t>& uses, bool sort_alpha) {
  groups_.resize(scene.meshes.size());
  foliage_.resize(scene.meshes.size());
  ParallelFor(static_cast<int64_t>(scene.meshes.size()), [&](int64_t m) {
    if (uses[m] == 0) return;
    foliage_[m] = IsFoliage(scene.meshes[m], scene.materials);
    const std::vector<Group> all = Classify(scene.meshes[m], scene, sort_alpha);
    auto opaque = SelectTriangles(scene.meshes[m], all, Group::kOpaque);
    auto tested = SelectTriangles(scene.meshes[m], all, Group::kTested);
    auto panes = SelectTriangles(scene.meshes[m], all, Group::kPane);
    if (tested) tested->alpha = MakeAlpha(*tested, scene);
    if (panes) panes->mask = kMaskClearPanes;
    for (auto* group : {&opaque, &tested, &panes}) {
      if (*group) groups_[m].push_back(std::move(*group));
    }
  });
  for (const MeshGroups& groups : groups_) {
    for (const auto& group : groups) has_clear_panes_ |= group->mask == kMaskClearPanes;
  }
}

// Embree reads 16 bytes at every vertex, so the buffer must go on for 4 bytes after the last one.
const Vec3f* EmbreeScene::PaddedVertices(const Mesh& mesh, const AffineTransform* X_WM, std::vector<Vec3f>& own) const {
  if (X_WM == nullptr && mesh.positions.capacity() > mesh.positions.size()) return mesh.positions.data();
  own.reserve(mesh.positions.size() + 1);
  own = mesh.positions;
  if (X_WM != nullptr) {
    for (Vec3f& p : own) p = *X_WM * p;
  }
  own.emplace_back();
  return own.data();
}

void EmbreeScene::AttachGeometry(RTCScene target, unsigned id, const MeshGeometry& geometry, const Vec3f* vertices, size_t count,
                                 RTCBuildQuality quality) {
  RTCGeometry g = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::vector<Vec3u>& indices = geometry.indices.empty() ? geometry.mesh->triangles : geometry.indices;
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, sizeof(Vec3f), count);
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0, sizeof(Vec3u), indices.size());
  rtcSetGeometryBuildQuality(g, quality);
  rtcSetGeometryMask(g, geometry.mask * kAllGenerations);
  if (geometry.alpha) {
    rtcSetGeometryUserData(g, geometry.alpha.get());
    rtcSetGeometryIntersectFilterFunction(g, FilterAlpha);
    rtcSetGeometryOccludedFilterFunction(g, FilterAlpha);
  }
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(target, g, id);
  if (target == top_.get() && geometry.mask == kMaskClearPanes) AttachPanes(g, id);
  rtcReleaseGeometry(g);
}

void EmbreeScene::AttachPanes(RTCGeometry g, unsigned id) {
  if (panes_ == nullptr) panes_ = NewScene(device_.get(), RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometryByID(panes_.get(), g, id);
}

void EmbreeScene::BuildSubScenes(const Scene& scene, const std::vector<uint32_t>& uses) {
  sub_scenes_.resize(scene.meshes.size());
  mesh_vertices_.resize(scene.meshes.size());
  ParallelFor(static_cast<int64_t>(scene.meshes.size()), [&](int64_t m) {
    if (uses[m] >= 2 && !groups_[m].empty()) BuildSubScene(scene.meshes[m], static_cast<MeshId>(m));
  });
}

void EmbreeScene::BuildSubScene(const Mesh& mesh, MeshId id) {
  const Vec3f* vertices = PaddedVertices(mesh, nullptr, mesh_vertices_[id]);
  // Spatial splits gain nothing among leaves.
  const bool foliage = foliage_[id] != 0;
  const RTCBuildQuality quality = foliage ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH;
  SceneHandle sub_scene = NewScene(device_.get(), quality, !foliage);
  for (unsigned i = 0; i < groups_[id].size(); ++i) {
    AttachGeometry(sub_scene.get(), i, *groups_[id][i], vertices, mesh.positions.size(), quality);
  }
  rtcCommitScene(sub_scene.get());
  sub_scenes_[id] = std::move(sub_scene);
}

RTCScene EmbreeScene::SubScene(const Mesh& mesh, MeshId id) {
  const std::lock_guard lock(mutex_);
  if (sub_scenes_[id] == nullptr) BuildSubScene(mesh, id);
  return sub_scenes_[id].get();
}

const PointQueryScene& EmbreeScene::PointQueries(const Scene& scene) {
  std::call_once(point_queries_once_, [&] {
    std::vector<PointQueryScene::Baked> baked;
    std::vector<PointQueryScene::Instanced> instanced;
    for (uint32_t id = 0; id < first_slots_.size(); ++id) {
      const HitSlot& slot = slots_[first_slots_[id]];
      const Instance& instance = scene.instances[slot.instance];
      if (slot.normal_in_world) {
        baked.push_back({id, slot.instance, static_cast<uint32_t>(scene.meshes[instance.mesh].positions.size()), slot.primitive_count});
      } else {
        instanced.push_back({slot.instance, sub_scenes_[instance.mesh].get(), instance.mesh, GroupCount(instance.mesh), instance.X_WM});
      }
    }
    // On a thread of its own: one that waits for the build may not begin another task of a parallel loop,
    // which would wait for this very build.
    std::thread([&] {
      point_queries_ = std::make_unique<PointQueryScene>(device_.get(), top_.get(), baked, instanced, groups_.size());
    }).join();
    ThrowOnError();
  });
  return *point_queries_;
}

SceneHandle EmbreeScene::MakeDeformable(MeshId id, const Vec3f* vertices, size_t count) {
  // Quality "low" of a scene is Embree's way to say: the structures of its geometries are kept and updated.
  SceneHandle scene = NewScene(device_.get(), RTC_BUILD_QUALITY_LOW);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
  for (unsigned i = 0; i < groups_[id].size(); ++i)
    AttachGeometry(scene.get(), i, *groups_[id][i], vertices, count, RTC_BUILD_QUALITY_REFIT);
  return scene;
}

Movers EmbreeScene::Move(std::span<const uint32_t> instances) {
  const std::lock_guard lock(mutex_);
  std::vector<uint32_t> added;
  for (uint32_t i : instances) {
    if (top_ids_[i] != kMiss && !std::binary_search(movers_.instances.begin(), movers_.instances.end(), i)) added.push_back(i);
  }
  if (added.empty()) return movers_;
  std::sort(added.begin(), added.end());
  added.erase(std::unique(added.begin(), added.end()), added.end());
  if (movers_.generation == kLastGeneration) {
    // Out of mask bits: from now on everything counts as moving.
    movers_ = {{}, kLastGeneration, true};
    for (uint32_t i = 0; i < top_ids_.size(); ++i) {
      if (top_ids_[i] != kMiss) movers_.instances.push_back(i);
    }
    return movers_;
  }
  const uint32_t earlier = (1u << (2 * ++movers_.generation)) - 1;
  for (uint32_t i : added) {
    const uint32_t first = top_ids_[i];
    const HitSlot& slot = slots_[first_slots_[first]];
    // A baked instance has an id for each of its geometries.
    for (uint32_t id = first; id < first_slots_.size() && slots_[first_slots_[id]].instance == slot.instance; ++id) {
      rtcSetGeometryMask(rtcGetGeometry(top_.get(), id), top_masks_[id] & earlier);
    }
  }
  movers_.instances.insert(movers_.instances.end(), added.begin(), added.end());
  std::sort(movers_.instances.begin(), movers_.instances.end());
  return movers_;
}

void EmbreeScene::AttachInstance(unsigned id, RTCScene sub_scene, const AffineTransform& X_WM, unsigned mask) {
  RTCGeometry g = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  const Vec3f columns[4] = {X_WM.A.column(0), X_WM.A.column(1), X_WM.A.column(2), X_WM.p};
  rtcSetGeometryInstancedScene(g, sub_scene);
  rtcSetGeometryMask(g, mask);
  rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  if (!IsTraceable(X_WM.A)) rtcDisableGeometry(g);
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(top_.get(), g, id);
  if ((mask & kMaskClearPanes) != 0) AttachPanes(g, id);
  rtcReleaseGeometry(g);
  has_instances_ = true;
}

void EmbreeScene::AttachInstances(const Scene& scene, const std::vector<uint32_t>& uses) {
  // Vertices of meshes used once, in W.
  instance_vertices_.resize(scene.instances.size());
  std::vector<const Vec3f*> vertices(scene.instances.size());
  ParallelFor(static_cast<int64_t>(scene.instances.size()), [&](int64_t i) {
    const Instance& instance = scene.instances[i];
    if (uses[instance.mesh] != 1) return;
    const AffineTransform* X_WM = IsIdentity(instance.X_WM) ? nullptr : &instance.X_WM;
    vertices[i] = PaddedVertices(scene.meshes[instance.mesh], X_WM, instance_vertices_[i]);
  });

  uint64_t direct_triangles = 0;
  for (size_t m = 0; m < uses.size(); ++m) direct_triangles += uses[m] == 1 ? scene.meshes[m].triangles.size() : 0;
  const auto quality = direct_triangles <= kMaxHighQualityTriangles ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  top_ = NewScene(device_.get(), quality);
  top_ids_.assign(scene.instances.size(), kMiss);

  // One geometry id after another, in the order of the instances.
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const MeshGroups& groups = groups_[instance.mesh];
    const bool direct = uses[instance.mesh] == 1;
    if (groups.empty()) continue;
    top_ids_[i] = static_cast<uint32_t>(first_slots_.size());
    if (!direct) {
      // Rays that look for clear panes alone pass by all that has none.
      unsigned mask = 0;
      for (const auto& group : groups) mask |= group->mask * kAllGenerations;
      AttachInstance(static_cast<unsigned>(first_slots_.size()), sub_scenes_[instance.mesh].get(), instance.X_WM, mask);
      first_slots_.push_back(static_cast<uint32_t>(slots_.size()));
      top_masks_.push_back(mask);
    }
    for (const auto& group : groups) {
      if (direct) {
        AttachGeometry(top_.get(), static_cast<unsigned>(first_slots_.size()), *group, vertices[i],
                       scene.meshes[instance.mesh].positions.size(), quality);
        first_slots_.push_back(static_cast<uint32_t>(slots_.size()));
        top_masks_.push_back(group->mask * kAllGenerations);
      }
      slots_.push_back({i, group->primitive_count, group->triangles.empty() ? nullptr : group->triangles.data(), direct});
    }
  }
}

void EmbreeScene::ThrowOnError() const {
  const RTCError error = rtcGetDeviceError(device_.get());
  if (error == RTC_ERROR_NONE) return;
  const char* what = error == RTC_ERROR_OUT_OF_MEMORY      ? "out of memory"
                     : error == RTC_ERROR_INVALID_ARGUMENT ? "invalid argument"
                     : error == RTC_ERROR_UNSUPPORTED_CPU  ? "unsupported CPU"
                                                           : "unknown error";
  throw RuntimeError(std::string("ray tracer: Embree could not build the scene: ") + what);
}

}  // namespace airsim360::internal
