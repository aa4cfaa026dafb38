// The light of one tile for tier `high`, in terms that are put together when the whole image is known.
#pragma once

#include <cstdint>

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal {

/// How the pixels of a tile share random directions. A tile's pixels are of sixteen phases, one of each in
/// every row and in about every 4 x 4 pixels; all pixels of one phase send parallel rays (which trace fast),
/// and the phases' directions are stratified together (interleaved sampling, Keller & Heidrich 2001): a mean
/// over 4 x 4 pixels is as good as one pixel with 16 times the samples.
struct TileLayout {
  uint8_t slot_of[256];     ///< index in the batch of pixel 16 y + x
  uint8_t pixel_of[256];    ///< and the other way round
  uint8_t members[16][16];  ///< slots of the pixels of a phase
  uint8_t phase[256];       ///< of a slot
};

/// Of one tile.
struct TileSampling {
  const TileLayout* layout;
  uint32_t seed;       ///< of all random choices in 4 x 4 tiles
  uint32_t tile;       ///< which of these, 0 … 15 in Morton order: together they are stratified, too
  float ambient_rays;  ///< of a pixel in one round, on average; 1 or more
  float cone_angle;    ///< of a pixel, radians
  bool panorama = false;
  Vec3f pole = {};  ///< of a panorama: the axis, in W, about which its columns turn
};

/// HighTile::light_samples of light that has no noise.
inline constexpr uint8_t kCertain = 255;

/// In the order of a HitBatch; zeros where nothing was met.
struct alignas(64) HighTile {
  float sun_seen[kBatch];                                      ///< share of the disc
  float normal_x[kBatch], normal_y[kBatch], normal_z[kBatch];  ///< shading normal
  /// Irradiance found, times 1 / albedo where the albedo differs between front and back of leaves.
  float light_r[kBatch], light_g[kBatch], light_b[kBatch];
  uint8_t light_samples[kBatch];
  /// 0: no shadow ends near by; 1: one does, and every ray saw the sun; else 2 + the penumbra's width in pixels times
  /// kPenumbraSteps, as far as what hides the sun tells.
  uint8_t penumbra[kBatch];
};

/// What surfaces of middling gloss in rooms mirror, in the order of a HitBatch.
struct GlossPixels {
  bool any = false;
  Vec3f light[kBatch];                             ///< radiance mirrored, mean of some rays of the lobe
  Vec3f skin[kBatch];                              ///< radiance seen per radiance mirrored
  float blur_x[kBatch] = {}, blur_y[kBatch] = {};  ///< width of the lobe on the picture, pixels (standard deviation); 0: no gloss
};

/// Shades a tile. Without `sampling` the hits are scattered rays: no ambient rays are sent, and the sun is
/// looked for by one ray, or is as `sun_known` says for each hit where that is not negative. `terms`, in the order of
/// the hits: what met nothing has its radiance in `rest` and zeros elsewhere. `gloss`, if not nullptr: new, gets what surfaces of
/// middling gloss mirror, which is then missing in `terms`.
void ShadeHigh(const Shader& shader, const SunMapView& sun_map, const HitBatch& hits, const TileSampling* sampling, const float* sun_known,
               LightTerms& terms, HighTile& tile, GlossPixels* gloss = nullptr);

}  // namespace airsim360::internal
