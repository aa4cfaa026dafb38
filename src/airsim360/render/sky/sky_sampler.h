// Choosing directions of the sky by its brightness.
#pragma once

#include <functional>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

struct SkySample {
  Vec3f direction;  ///< unit
  Vec3f radiance;   ///< of the sky there, without the sun's disc
  float pdf;        ///< per solid angle, > 0
};

/// Piecewise constant density on a grid of cells of equal solid angle (azimuth by sine of elevation).
/// Immutable.
class SkySampler {
 public:
  static constexpr int kAcross = 256, kUp = 256;

  SkySampler() = default;
  /// `luminance` of a direction is averaged over each cell; a fiftieth of the mean is added to every cell, so
  /// that no direction is left out.
  explicit SkySampler(const std::function<float(Vec3f)>& luminance);
  /// Unit vector; u in [0, 1)^2.
  Vec3f Direction(Vec2f u) const;
  float Pdf(Vec3f direction) const;
  /// Density per solid angle of each cell; running shares of the cells of a row, up to 1; of the rows.
  const std::vector<float>& density() const { return density_; }
  const std::vector<float>& cumulative() const { return cumulative_; }
  const std::vector<float>& rows() const { return row_; }

  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.density_, s.cumulative_, s.row_);
  }

 private:
  std::vector<float> density_;     // per solid angle, of each cell
  std::vector<float> cumulative_;  // of the cells of a row, up to 1
  std::vector<float> row_;         // of the rows
};

}  // namespace airsim360::internal
