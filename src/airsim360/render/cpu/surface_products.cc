#include "airsim360/render/cpu/surface_products.h"

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/shading/stretched_surfaces.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMaxMaterials = UINT16_MAX - 1;

// Calls write(i, image index) for every ray of a tile that is a pixel.
template <class Write>
void ForEachPixel(const TileTarget& target, Write write) {
  for (int i = 0; i < kTilePixels; ++i) {
    const int64_t index = ImageIndex(target, PixelOfPacketIndex(target.shape, i));
    if (index >= 0) write(i, static_cast<size_t>(index));
  }
}

void FillPosition(const HitBatch& hits, const TileTarget& target, Image<Vec3f>& out) {
  ForEachPixel(target, [&](int i, size_t index) {
    const Vec3f d{hits.direction_x[i], hits.direction_y[i], hits.direction_z[i]};
    out.pixels()[index] = hits.instance[i] != kMiss ? hits.origin + d * hits.distance[i] : Vec3f{};
  });
}

}  // namespace

void SurfaceProducts::Update(const RenderRequest& request, const CameraRays& rays, const Shader* shader,
                             std::shared_ptr<const RayTracer> now, std::shared_ptr<const RayTracer> next) {
  if (request.products.material && scene_->materials.size() > kMaxMaterials) {
    throw InputError("material ids have 16 bits, the scene has " + std::to_string(scene_->materials.size()) + " materials");
  }
  if (request.products.albedo) {
    if (shader == nullptr && tables_ == nullptr) {
      tables_ = std::make_unique<SurfaceTables>(*scene_);
      own_view_ = MakeShadeView(*scene_, *tables_, nullptr, nullptr);
    }
    if (tables_ != nullptr) tables_->Apply(*scene_, now->moved(), now->deformed());
    view_ = shader != nullptr ? &shader->impl().view : &own_view_;
    stretches_ = request.tier == Tier::kHigh;
  }
  if (request.products.flow) flow_.Update(request, rays, std::move(now), std::move(next));
}

void SurfaceProducts::Fill(const HitBatch& hits, const LabelTile& labels, const TileTarget& target, Frame& frame) const {
  if (!frame.position.empty()) FillPosition(hits, target, frame.position);
  if (!frame.albedo.empty()) FillAlbedo(hits, target, frame.albedo);
  if (!frame.material.empty()) FillMaterial(hits, target, frame.material);
  if (!frame.flow.empty()) flow_.Fill(hits, labels, target, frame.flow);
}

void SurfaceProducts::FillAlbedo(const HitBatch& hits, const TileTarget& target, Image<Rgb32f>& out) const {
  static const auto prepare = AIRSIM360_SELECT_KERNEL(PrepareSurfaces), stretched = AIRSIM360_SELECT_KERNEL(PrepareStretched);
  RaySet rays;
  rays.count = 0;
  for (int i = 0; i < kTilePixels; ++i) {
    if (hits.instance[i] == kMiss) continue;
    const int k = rays.count++;
    rays.ox[k] = hits.origin.x, rays.oy[k] = hits.origin.y, rays.oz[k] = hits.origin.z;
    rays.dx[k] = hits.direction_x[i], rays.dy[k] = hits.direction_y[i], rays.dz[k] = hits.direction_z[i];
    rays.distance[k] = hits.distance[i];
    rays.width[k] = hits.distance[i] * hits.cone_angle;
    rays.u[k] = hits.u[i], rays.v[k] = hits.v[i];
    rays.instance[k] = hits.instance[i], rays.triangle[k] = hits.triangle[i];
    rays.key[k] = 0, rays.slot[k] = static_cast<uint32_t>(i);
  }
  Rgb32f colors[kTilePixels] = {};
  if (rays.count > 0) {
    SurfaceSet surfaces;
    Pad(rays);
    (stretches_ ? stretched : prepare)(*view_, rays, surfaces);
    for (int k = 0; k < rays.count; ++k) colors[rays.slot[k]] = {surfaces.ar[k], surfaces.ag[k], surfaces.ab[k]};
  }
  ForEachPixel(target, [&](int i, size_t index) { out.pixels()[index] = colors[i]; });
}

void SurfaceProducts::FillMaterial(const HitBatch& hits, const TileTarget& target, Image<uint16_t>& out) const {
  // Neighbours mostly meet the same part of the same mesh.
  const Mesh* mesh = nullptr;
  const MeshPart* part = nullptr;
  ForEachPixel(target, [&](int i, size_t index) {
    uint16_t& pixel = out.pixels()[index];
    pixel = 0;
    if (hits.instance[i] == kMiss) return;
    const Mesh* hit = &scene_->meshes[scene_->instances[hits.instance[i]].mesh];
    const uint32_t triangle = hits.triangle[i];
    if (hit != mesh || triangle - part->first_triangle >= part->triangle_count) {
      mesh = hit;
      part = &*std::prev(std::ranges::upper_bound(mesh->parts, triangle, {}, &MeshPart::first_triangle));
    }
    pixel = static_cast<uint16_t>(part->material + 1);
  });
}

}  // namespace airsim360::internal
