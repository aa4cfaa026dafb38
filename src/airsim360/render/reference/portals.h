// Windows of rooms as ways for light.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/indoor/enclosure.h"

namespace airsim360::internal {

/// Clear panes in and beside the enclosed parts of a scene: from within, the sky is to be looked for through them.
/// Immutable.
class Portals {
 public:
  static constexpr size_t kMost = 128;  ///< triangles; the largest where there are more

  Portals() = default;
  Portals(const RayTracer& built, const Enclosure& enclosure);
  bool empty() const { return panes_.empty(); }
  /// Share of rays that go for a pane rather than for the sky as a whole: 0 outdoors.
  float Share(Vec3f p) const { return !panes_.empty() && enclosure_->Touches({p, p}) ? kShare : 0; }
  /// A direction through some pane, likelier the larger it looks; u in [0, 1)^2.
  Vec3f Sample(Vec3f p, Vec2f u) const;
  /// Density per solid angle of Sample.
  float Pdf(Vec3f p, Vec3f direction) const;

 private:
  static constexpr float kShare = 0.75f;
  struct Pane {
    Vec3f corner, a, b, normal;
    float area;
  };
  static float Weight(const Pane& pane, Vec3f p);

  const Enclosure* enclosure_ = nullptr;
  std::vector<Pane> panes_;
};

}  // namespace airsim360::internal
