// Shapes of upholstery, bedding, cloth and leaves on top of PropBuilder.
#pragma once

#include <span>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {

/// Upholstery of a cushion, metres.
struct Soft {
  float round = 0.05f;                      ///< radius of the edges
  float crown = 0.02f;                      ///< how far the middle of a face bulges
  float fold = 0;                           ///< height of the wrinkles
  uint64_t seed = 0;                        ///< of the wrinkles
  int cells = 8;                            ///< grid of a face, >= 5: 2 cells^2 triangles each
  unsigned faces = MeshBuilder::kAllSides;  ///< those that anybody sees
};
/// Box with round edges and bulging faces; uv are metres on each face.
void SoftBox(PropBuilder& b, Vec3f lo, Vec3f hi, const Soft& soft);

/// Loose pillow that lies in the XY plane about the origin of `X`: `size` from tip to tip, `thickness` in the middle.
void Pillow(PropBuilder& b, const AffineTransform& X, Vec2f size, float thickness, uint64_t seed, int cells = 12);

/// Cloth over a mattress: lies at z = `top` between y0 and y1, rounds the edges at x = +-half and hangs down `drop`;
/// `fold`: height of its wrinkles.
void Bedspread(PropBuilder& b, float half, float y0, float y1, float top, float drop, float fold, uint64_t seed);

/// Cloth hanging from z = top to 0 between x0 and x1, in `folds` pleats of half depth `depth` about y = 0; two-sided
/// materials only.
void Hanging(PropBuilder& b, float x0, float x1, float top, float depth, int folds, uint64_t seed);

/// Board with the outline of a rounded rectangle, its upper edge rounded over `edge`; uv = (x, -y) on top.
void RoundedBoard(PropBuilder& b, Vec2f lo, Vec2f hi, float corner, float z0, float z1, float edge);
/// The same of a round board about the z axis.
inline void RoundBoard(PropBuilder& b, float radius, float z0, float z1, float edge) {
  RoundedBoard(b, {-radius, -radius}, {radius, radius}, 0.995f * radius, z0, z1, edge);
}

/// Box between two points of a frame in the XZ plane seen from -Y, for doors and drawer fronts: `thick` deep from y
/// to y - thick, bevelled.
inline void Front(PropBuilder& b, float x0, float x1, float z0, float z1, float y, float thick = 0.018f) {
  b.BevelBox({x0, y - thick, z0}, {x1, y, z1}, 0.0025f);
}

/// Bow handle on a front at y: from (x0, z0) to (x1, z1), standing 3 cm off, of round bar.
void BowHandle(PropBuilder& b, Vec2f from, Vec2f to, float y, float radius = 0.005f);

/// Leaf of `length` and `width` from the origin of `X` along its +X, folded along the rib and bent down to `droop` of its
/// length; two-sided materials only. `holes` cuts the rim into lobes.
void BroadLeaf(PropBuilder& b, const AffineTransform& X, float length, float width, float droop, bool lobed = false);

/// Swivel castor with two wheels, standing on z = 0 below `p` (its height is p.z).
void Castor(PropBuilder& b, Vec3f p);

/// Direction of a compass step: i of n, in the XY plane.
Vec3f Around(int i, int n, float offset = 0);

inline float Random(RngStream& rng, float low, float high) { return static_cast<float>(rng.Uniform(low, high)); }

}  // namespace airsim360::internal
