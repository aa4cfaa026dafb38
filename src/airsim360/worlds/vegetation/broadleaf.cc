// Broad-leaved trees of streets: a row of figures each, grown by broadleaf_growth.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/vegetation/broadleaf_growth.h"

namespace airsim360::internal {
namespace {

// Street and park trees of the size of limes and planes: six of different age and build.
Model MakeGeneric(uint32_t variant, uint64_t seed) {
  static const Vec3f fresh[] = {{0.085f, 0.118f, 0.026f}, {0.073f, 0.104f, 0.025f}, {0.099f, 0.128f, 0.031f}};
  static const Vec3f deep[] = {{0.064f, 0.092f, 0.023f}, {0.073f, 0.098f, 0.027f}, {0.055f, 0.083f, 0.024f}};
  static const Texture atlases[2] = {LeafAtlas("leaves fresh", fresh), LeafAtlas("leaves deep", deep)};
  struct Build {
    float height, clear, radius, trunk, leader;
  };
  constexpr Build builds[6] = {{10.5f, 2.7f, 4.0f, 0.19f, 0.55f}, {12.5f, 3.1f, 4.8f, 0.24f, 0.50f}, {8.6f, 2.4f, 3.1f, 0.14f, 0.62f},
                               {11.4f, 2.9f, 3.7f, 0.20f, 0.66f}, {9.4f, 2.5f, 3.9f, 0.17f, 0.45f},  {7.4f, 2.2f, 2.5f, 0.11f, 0.66f}};
  const Build& b = builds[variant];
  BroadleafSpecies s{"tree_generic",
                     b.height,
                     b.clear,
                     b.radius,
                     b.trunk,
                     b.leader,
                     17,
                     0.30f,
                     5200,
                     {},
                     {0.094f, 0.066f, 0.12f, 0.25f},
                     0,
                     0.75f,
                     {0.168f, 0.150f, 0.128f},
                     LeafOrder::kAlternate,
                     0.04f,
                     0.32f};
  s.growth.step = 0.20f;
  s.min_branch = 0.012f;
  s.growth.influence = 1.7f;
  s.growth.kill = 0.42f * b.radius / 4.0f;
  s.leaves = static_cast<int>(46000 * std::min(1.0f, b.radius / 4.0f * b.radius / 4.0f * 1.15f + 0.1f));
  return GrowBroadleaf(s, atlases[variant % 2], seed);
}

// Upright oval crowns with ascending branches and narrow leaves (willow oak, poplar).
Model MakeNarrowleaf(uint32_t variant, uint64_t seed) {
  static const Vec3f tones[] = {{0.081f, 0.112f, 0.034f}, {0.096f, 0.122f, 0.040f}, {0.068f, 0.098f, 0.029f}};
  static const Texture atlas = LeafAtlas("leaves narrow", tones);
  struct Build {
    float height, clear, radius, trunk;
  };
  constexpr Build builds[4] = {
      {12.5f, 2.2f, 1.9f, 0.18f}, {14.5f, 2.5f, 2.3f, 0.22f}, {10.0f, 2.0f, 1.6f, 0.13f}, {13.2f, 2.3f, 2.7f, 0.20f}};
  const Build& b = builds[variant];
  BroadleafSpecies s{"tree_narrowleaf",
                     b.height,
                     b.clear,
                     b.radius,
                     b.trunk,
                     0.86f,
                     18,
                     0.40f,
                     4600,
                     {},
                     {0.097f, 0.041f, 0.15f, 0.2f},
                     46000,
                     0.6f,
                     {0.20f, 0.18f, 0.15f},
                     LeafOrder::kSpiral,
                     0.035f,
                     0.30f,
                     7,
                     0.12f};
  s.growth.step = 0.20f;
  s.min_branch = 0.012f;
  s.growth.influence = 1.5f;
  s.growth.kill = 0.34f;
  s.growth.tropism = {0, 0, 0.45f};
  return GrowBroadleaf(s, atlas, seed);
}

}  // namespace

std::vector<PropKind> BroadleafKinds() {
  return {
      {"tree_generic", "vegetation/tree/broadleaf/generic", 6, MakeGeneric, 1.0f, 6.5f, 14.0f, 130000},
      {"tree_narrowleaf", "vegetation/tree/broadleaf/narrowleaf", 4, MakeNarrowleaf, 0.8f, 9.0f, 16.0f, 130000},
  };
}

}  // namespace airsim360::internal
