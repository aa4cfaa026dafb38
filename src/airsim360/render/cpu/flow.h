// Optical flow and scene flow: where the surface point of each pixel is at the next instant.
//
// The point under a pixel's ray is carried by the motion of its instance and of its triangle's corners, then
// projected into the next camera. A ray of the next camera through that place tells whether something hides
// it. Positions are computed in double precision from the same single-precision ray that gave the labels.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/tile_pixels.h"
#include "airsim360/render/renderer.h"

namespace airsim360::internal {

class FlowTracer {
 public:
  /// Sets both instants. InputError without RenderRequest::X_WC_next.
  void Update(const RenderRequest& request, const CameraRays& rays, std::shared_ptr<const RayTracer> now,
              std::shared_ptr<const RayTracer> next);
  /// Flow of the pixels of one tile. May run concurrently.
  void Fill(const HitBatch& hits, const LabelTile& labels, const TileTarget& target, Image<FlowPixel>& out) const;

 private:
  struct Lane {
    Vec3d to_point;  // from the next camera, in W; of the sky: its direction
    FlowPixel flow;
    bool in_picture;
  };
  Lane Follow(const HitBatch& hits, int i, TilePixel pixel, const TileTarget& target) const;
  Vec3d Motion(uint32_t instance, uint32_t triangle, float u, float v) const;
  void MarkMoves(const RayTracer& a, const RayTracer& b);
  void Occlude(const HitBatch& hits, int first, const int* valid, Lane* lanes) const;

  Camera camera_ = Equirectangular{0, 0};
  CameraRays next_rays_;
  int column_turn_ = 0;  // canonical columns between the two cameras, 0 ... width - 1
  Vec3d eye_;            // of the next camera, rounded to what its rays start from
  std::shared_ptr<const RayTracer> now_, next_;
  std::vector<uint8_t> moves_;    // by instance
  std::vector<uint32_t> marked_;  // instances whose entry is not 0
};

}  // namespace airsim360::internal
