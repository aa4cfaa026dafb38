#include "airsim360/trace/dynamic_scene.h"

#include <algorithm>

#include "airsim360/base/parallel.h"
#include "airsim360/trace/trace_limit.h"

namespace airsim360::internal {
namespace {

const DeformedMesh* FindDeformed(const std::vector<DeformedMesh>& list, MeshId mesh) {
  const auto found = std::lower_bound(list.begin(), list.end(), mesh, [](const auto& d, MeshId m) { return d.mesh < m; });
  return found != list.end() && found->mesh == mesh ? &*found : nullptr;
}

}  // namespace

void DynamicScene::Update(EmbreeScene& statics, const Scene& scene, const SceneState& state, const Movers& movers) {
  if (top_ == nullptr || moved_.size() != movers.instances.size()) SetMovers(statics, movers);
  Deform(statics, scene, state);
  Place(statics, scene, state);
  rtcCommitScene(top_.get());
  statics.ThrowOnError();
}

void DynamicScene::SetMovers(EmbreeScene& statics, const Movers& movers) {
  // Something moves for the first time: start anew.
  top_.reset(rtcNewScene(statics.device()));
  rtcSetSceneFlags(top_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(top_.get(), RTC_BUILD_QUALITY_MEDIUM);
  if (empty_ == nullptr) {
    empty_.reset(rtcNewScene(statics.device()));
    rtcCommitScene(empty_.get());
  }
  instances_.clear();
  moved_.clear();
  slots_ = statics.slots();
  for (uint32_t i : movers.instances) {
    moved_.push_back({i, {}, false});
    instances_.emplace_back(rtcNewGeometry(statics.device(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryMask(instances_.back().get(), kMaskAll);
    rtcAttachGeometryByID(top_.get(), instances_.back().get(), statics.TopId(i));
    for (uint32_t s = statics.first_slots()[statics.TopId(i)]; s < slots_.size() && slots_[s].instance == i; ++s) {
      slots_[s].normal_in_world = false;
    }
  }
  shown_.assign(instances_.size(), nullptr);
}

void DynamicScene::Deform(EmbreeScene& statics, const Scene& scene, const SceneState& state) {
  // Bodies are made one after another, then filled and refitted at once.
  std::vector<Body*> bodies;
  for (const DeformedMesh& deformed : state.deformed) bodies.push_back(&bodies_[deformed.mesh]);
  ParallelFor(static_cast<int64_t>(bodies.size()), [&](int64_t k) {
    Body& body = *bodies[static_cast<size_t>(k)];
    const DeformedMesh& deformed = state.deformed[static_cast<size_t>(k)];
    const size_t count = deformed.positions->size();
    body.vertices.resize(count + 1);  // Embree reads 4 bytes beyond the last vertex
    if (body.scene == nullptr) {
      // Of the mesh as it is at rest, whatever was drawn before: where a ray meets two triangles at the same range, the structure decides.
      std::ranges::copy(scene.meshes[deformed.mesh].positions, body.vertices.begin());
      body.scene = statics.MakeDeformable(deformed.mesh, body.vertices.data(), count);
      rtcCommitScene(body.scene.get());
    }
    std::ranges::copy(*deformed.positions, body.vertices.begin());
    for (unsigned id = 0; id < statics.GroupCount(deformed.mesh); ++id) {
      RTCGeometry g = rtcGetGeometry(body.scene.get(), id);
      rtcUpdateGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcCommitGeometry(g);
    }
    rtcCommitScene(body.scene.get());
  });
  deformed_ = state.deformed;
}

void DynamicScene::Place(EmbreeScene& statics, const Scene& scene, const SceneState& state) {
  auto next = state.moved.begin();
  for (size_t k = 0; k < moved_.size(); ++k) {
    const uint32_t i = moved_[k].instance;
    const Instance& instance = scene.instances[i];
    while (next != state.moved.end() && next->instance < i) ++next;
    const MovedInstance place = next != state.moved.end() && next->instance == i ? *next : MovedInstance{i, instance.X_WM, false};
    const bool deformed = FindDeformed(deformed_, instance.mesh) != nullptr;
    // What is hidden needs no structure of its own.
    RTCScene shown = deformed       ? bodies_.at(instance.mesh).scene.get()
                     : place.hidden ? empty_.get()
                                    : statics.SubScene(scene.meshes[instance.mesh], instance.mesh);

    // Only what differs from the last time is told to Embree.
    RTCGeometry g = instances_[k].get();
    const bool same_scene = shown_[k] == shown;
    if (same_scene && !deformed && place.X_WM == moved_[k].X_WM && place.hidden == moved_[k].hidden) continue;
    const Mat3f& A = place.X_WM.A;
    const Vec3f columns[4] = {A.column(0), A.column(1), A.column(2), place.X_WM.p};
    if (!same_scene) rtcSetGeometryInstancedScene(g, shown);
    rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    if (place.hidden || !IsTraceable(A))
      rtcDisableGeometry(g);
    else
      rtcEnableGeometry(g);
    rtcCommitGeometry(g);
    moved_[k] = place;
    shown_[k] = shown;
  }
  placed_.clear();
  groups_.clear();
  for (size_t k = 0; k < moved_.size(); ++k) {
    if (moved_[k].hidden) continue;
    auto& groups = groups_[shown_[k]];
    if (groups.empty()) groups = BuffersOf(shown_[k], statics.GroupCount(scene.instances[moved_[k].instance].mesh));
    placed_.emplace_back(moved_[k].instance, shown_[k], groups, moved_[k].X_WM);
  }
}

void DynamicScene::Find(Vec3f p_W, NearestTriangle& best) const {
  for (const PlacedMesh& mesh : placed_) {
    if (DistanceToBox(p_W, mesh.bounds()) < best.distance) mesh.Find(p_W, best);
  }
}

}  // namespace airsim360::internal
