// Means of what neighbouring pixels of one surface mirror, over the width that the lobe has on the picture.
#pragma once

#include "airsim360/image/image.h"
#include "airsim360/render/high/high_shading.h"

namespace airsim360::internal {

/// What the surfaces of a frame mirror, in canonical columns. Empty where there are no rooms.
struct GlossPlanes {
  Image<Rgb32f> light;          ///< radiance mirrored: of the rays, then filtered
  Image<Rgb32f> skin;           ///< radiance seen per radiance mirrored
  Image<float> blur_x, blur_y;  ///< standard deviations of the lobe, pixels; 0: no gloss
  Image<Rgb32f> scratch;

  void Resize(int width, int height);
  /// A tile's pixels, in the order of its batch, from (column, row) on.
  void Put(const GlossPixels& pixels, const TileLayout& layout, int column, int row);
  /// Adds the tile's part of the picture to its terms.
  void AddTo(LightTerms& terms, const TileLayout& layout, int column, int row) const;
};

/// `panorama`: columns close up towards the poles and go round.
void FilterGloss(const Image<float>& range, const Image<EntityId>& entity, const Image<Vec3f>& normal, bool panorama, GlossPlanes& gloss);

}  // namespace airsim360::internal
