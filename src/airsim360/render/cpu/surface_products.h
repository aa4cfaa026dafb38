// Products that come from what a pixel's centre ray met: position, base colour, material, flow.
#pragma once

#include <memory>

#include "airsim360/render/cpu/flow.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shading/shader.h"

namespace airsim360::internal {

class SurfaceProducts {
 public:
  explicit SurfaceProducts(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}
  /// Whether any of them is asked for, so that hits must be kept.
  static bool Wanted(const Products& products) { return products.position || products.albedo || products.material || products.flow; }
  /// Gets ready for one frame. `shader` lends its tables where there is one; tables of their own are made
  /// when first needed. `next` is used for flow alone. InputError for flow without X_WC_next, and for
  /// material ids of a scene with more than 65534 materials.
  void Update(const RenderRequest& request, const CameraRays& rays, const Shader* shader, std::shared_ptr<const RayTracer> now,
              std::shared_ptr<const RayTracer> next);
  /// Fills the pixels of one tile in the images that are not empty. May run concurrently.
  void Fill(const HitBatch& hits, const LabelTile& labels, const TileTarget& target, Frame& frame) const;

 private:
  void FillAlbedo(const HitBatch& hits, const TileTarget& target, Image<Rgb32f>& out) const;
  void FillMaterial(const HitBatch& hits, const TileTarget& target, Image<uint16_t>& out) const;

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<SurfaceTables> tables_;  // where there is no shader
  ShadeView own_view_{};
  const ShadeView* view_ = nullptr;
  bool stretches_ = false;  // base colours are those of tier high
  FlowTracer flow_;
};

}  // namespace airsim360::internal
