#include "airsim360/worlds/town/pavement_side.h"

#include "airsim360/base/random.h"

namespace airsim360::internal {

PavementSide SideBetweenRamps(const Block& block, int k) {
  constexpr float kAfterRamp = 1.2f;  // metres
  const BlockSide line = SideOf(block, k);
  const float end = block.corner_radius + kCrosswalkStart + kCrosswalkWidth + kAfterRamp;
  return {line, end, line.length - end, block.pavement};
}

void PlaceCafeRow(District& d, const PavementSide& side, float s, const CafeRow& row, RngStream& rng) {
  static constexpr Vec3f kCloths[] = {{0.55f, 0.04f, 0.035f}, {0.05f, 0.22f, 0.10f}, {0.05f, 0.10f, 0.35f}, {0.65f, 0.62f, 0.55f}};
  const Vec3f cloth = kCloths[rng.Index(4)];
  const uint32_t style = rng.Index(4);
  for (int i = 0; i < row.tables; ++i) {
    const Vec3f p = side.At(s + row.pitch * static_cast<float>(i), side.depth - row.from_wall);
    if (!d.placer.Try("street_table", p, 0, 1, {1, 1, 1}, style)) continue;
    d.placer.Put("umbrella", p, 0, row.umbrella, cloth, 0u);
    for (const float a : {-row.to_chair, row.to_chair}) {
      const Vec2f along = side.line.along * a;
      d.placer.Put("dining_chair", {p.x + along.x, p.y + along.y, 0}, FacingYaw(along * -1.0f), 1, {1, 1, 1}, style);
    }
  }
}

}  // namespace airsim360::internal
