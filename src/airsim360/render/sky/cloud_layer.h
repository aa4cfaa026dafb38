// A layer of clouds as a volume: maps of where its tops and bases are, worn by noise.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/sky/noise.h"

namespace airsim360::internal {

/// Immutable once built. The maps hold the smooth body of the clouds; noise only ever takes from it, so that a map of the highest
/// tops tells where a ray need not look. The layer tiles the plane after kCells * cell metres.
class CloudLayer {
 public:
  static constexpr int kCells = 1024;

  /// What makes clouds of one type differ from another's; lengths in metres.
  struct Form {
    float base = 1000;                  ///< of the lowest clouds, above the ground
    float cell = 48;                    ///< of the maps
    float extinction = 0.06f;           ///< 1 / m within
    float erosion = 200;                ///< how deep noise wears the tops
    float least_erosion = 20;           ///< … where the cloud is thin
    float base_erosion = 120;           ///< … the base
    float edge = 60;                    ///< over which density grows from nothing at a worn edge
    float billow = 2000, detail = 350;  ///< sizes of the noise
    float shear = 0.3f;                 ///< drift of the noise with height, along the wind: metres a metre
    float stretch = 1;                  ///< of the noise along the wind
    Vec2f wind{1, 0};                   ///< unit, where it blows to
  };
  /// Height of the body above `base` and of its base above that, of a cell in [0, kCells)^2, metres.
  struct Column {
    float top = 0, base = 0;
  };

  CloudLayer(const Form& form, std::vector<Column> columns);

  /// Extinction at a point of the plane and an altitude above the ground; `detail` with the finer noise. 1 / m.
  float Density(float x, float y, float altitude, bool detail) const;
  /// False where no cloud is within four cells' reach.
  bool MayBeCloud(float x, float y) const;
  /// Moves all clouds.
  void SetOffset(float x, float y) { offset_x_ = x, offset_y_ = y; }

  const Form& form() const { return form_; }
  /// Lowest and highest altitude that hold cloud.
  float lowest() const { return lowest_; }
  float highest() const { return highest_; }
  float extent() const { return form_.cell * kCells; }
  /// Share of the ground below the body.
  float cover() const { return cover_; }

 private:
  struct Texel {
    float top, base, slope, unused;  // slope: cosine of the top's steepness
  };
  static constexpr int kCoarse = 8;  // cells a side of what MayBeCloud knows

  Form form_;
  float offset_x_ = 0, offset_y_ = 0, lowest_ = 0, highest_ = 0, cover_ = 0;
  std::vector<Texel> texels_;
  std::vector<uint8_t> coarse_;
};

}  // namespace airsim360::internal
