#include "airsim360/worlds/vegetation/park_trees.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/vegetation/broadleaf_growth.h"

namespace airsim360::internal {
namespace {

// Of one individual, metres.
struct CrownBuild {
  float height, clear, radius, trunk, leader, lean, dead;
  int leaves;
};

constexpr ParkTreeInfo kInfos[] = {
    {"elm", "vegetation/tree/broadleaf/elm", {4, 3, 3}},
    {"maple", "vegetation/tree/broadleaf/maple", {4, 3, 3}},
    {"weeping willow", "vegetation/tree/broadleaf/weeping_willow", {3, 2, 1}},
    {"pine", "vegetation/tree/conifer/pine", {4, 3, 3}},
    {"amur cork", "vegetation/tree/broadleaf/amur_cork", {3, 2, 2}},
    {"narrowleaf", "vegetation/tree/broadleaf/narrowleaf", {3, 2, 2}},
};
static_assert(std::size(kInfos) == static_cast<size_t>(ParkTree::kCount));

// Individual 0 is the solitary of 16.5 m; then a middle-aged one, an old one with dead limbs, a leaning one.
BroadleafSpecies Elm(int individual) {
  constexpr CrownBuild builds[4] = {{16.5f, 3.4f, 8.2f, 0.46f, 0.55f, 0.015f, 0.02f, 120000},
                                    {14.5f, 3.2f, 5.8f, 0.29f, 0.60f, 0.03f, 0.04f, 58000},
                                    {17.5f, 4.4f, 6.4f, 0.36f, 0.55f, 0.03f, 0.14f, 66000},
                                    {12.0f, 3.0f, 4.9f, 0.23f, 0.50f, 0.09f, 0.06f, 45000}};
  const CrownBuild& b = builds[individual % 4];
  BroadleafSpecies s{.name = "elm",
                     .height = b.height,
                     .clear_trunk = b.clear,
                     .crown_radius = b.radius,
                     .trunk_radius = b.trunk,
                     .leader = b.leader,
                     .lobes = individual == 0 ? 22 : 17,
                     .lobe_radius = individual == 0 ? 0.27f : 0.29f,
                     .attractors = individual == 0 ? 12000 : 8000,
                     .growth = {},
                     .leaf = {0.115f, 0.068f, 0.12f, 0.25f},
                     .leaves = b.leaves,
                     .clumping = 0.72f,
                     .bark = {0.205f, 0.170f, 0.138f},
                     .order = LeafOrder::kAlternate,
                     .internode = 0.035f,
                     .shoot = 0.34f};
  s.growth = {.step = 0.23f, .influence = 2.1f, .kill = 0.47f, .max_nodes = 14000};
  s.lean = b.lean;
  s.dead = b.dead;
  return s;
}

// Round crowns with lobed leaves; the last one is young.
BroadleafSpecies Maple(int individual) {
  constexpr CrownBuild builds[4] = {{13.0f, 3.0f, 5.2f, 0.24f, 0.55f, 0.02f, 0.02f, 64000},
                                    {11.0f, 2.6f, 4.3f, 0.20f, 0.60f, 0.04f, 0.03f, 55000},
                                    {14.5f, 3.4f, 5.0f, 0.27f, 0.62f, 0.03f, 0.10f, 62000},
                                    {8.0f, 2.0f, 2.9f, 0.11f, 0.66f, 0.03f, 0.00f, 32000}};
  const CrownBuild& b = builds[individual % 4];
  BroadleafSpecies s{.name = "maple",
                     .height = b.height,
                     .clear_trunk = b.clear,
                     .crown_radius = b.radius,
                     .trunk_radius = b.trunk,
                     .leader = b.leader,
                     .lobes = 17,
                     .lobe_radius = 0.30f,
                     .attractors = 7500,
                     .growth = {},
                     .leaf = {0.125f, 0.125f, 0.08f, 0.20f},
                     .leaves = b.leaves,
                     .clumping = 0.66f,
                     .bark = {0.19f, 0.165f, 0.14f},
                     .order = LeafOrder::kOpposite,
                     .internode = 0.055f,
                     .shoot = 0.30f};
  s.leaf.form = LeafForm::kLobed;
  s.growth = {.step = 0.20f, .influence = 1.9f, .kill = 0.42f * b.radius / 5.0f + 0.04f, .max_nodes = 12000};
  s.lean = b.lean;
  s.dead = b.dead;
  return s;
}

// Wide, open crowns with corky, light bark.
BroadleafSpecies Cork(int individual) {
  constexpr CrownBuild builds[3] = {{10.5f, 2.2f, 5.0f, 0.26f, 0.40f, 0.05f, 0.06f, 44000},
                                    {9.0f, 1.9f, 4.4f, 0.22f, 0.35f, 0.07f, 0.04f, 38000},
                                    {12.0f, 2.8f, 5.6f, 0.30f, 0.45f, 0.04f, 0.12f, 48000}};
  const CrownBuild& b = builds[individual % 3];
  BroadleafSpecies s{.name = "amur_cork",
                     .height = b.height,
                     .clear_trunk = b.clear,
                     .crown_radius = b.radius,
                     .trunk_radius = b.trunk,
                     .leader = b.leader,
                     .lobes = 15,
                     .lobe_radius = 0.28f,
                     .attractors = 6000,
                     .growth = {},
                     .leaf = {0.112f, 0.050f, 0.12f, 0.30f},
                     .leaves = b.leaves,
                     .clumping = 0.80f,
                     .bark = {0.27f, 0.235f, 0.19f},
                     .order = LeafOrder::kOpposite,
                     .internode = 0.06f,
                     .shoot = 0.36f};
  s.growth = {.step = 0.21f, .influence = 1.9f, .kill = 0.46f, .tropism = {0, 0, 0.02f}, .max_nodes = 10000};
  s.lean = b.lean;
  s.dead = b.dead;
  return s;
}

BroadleafSpecies Poplar(int individual) {
  constexpr CrownBuild builds[3] = {{15.5f, 2.2f, 2.2f, 0.20f, 0.86f, 0.01f, 0.02f, 44000},
                                    {13.0f, 2.0f, 2.4f, 0.18f, 0.80f, 0.02f, 0.03f, 40000},
                                    {17.5f, 2.8f, 2.6f, 0.25f, 0.86f, 0.015f, 0.06f, 52000}};
  const CrownBuild& b = builds[individual % 3];
  BroadleafSpecies s{.name = "narrowleaf",
                     .height = b.height,
                     .clear_trunk = b.clear,
                     .crown_radius = b.radius,
                     .trunk_radius = b.trunk,
                     .leader = b.leader,
                     .lobes = 18,
                     .lobe_radius = 0.40f,
                     .attractors = 5000,
                     .growth = {},
                     .leaf = {0.114f, 0.039f, 0.15f, 0.2f},
                     .leaves = b.leaves,
                     .clumping = 0.6f,
                     .bark = {0.20f, 0.18f, 0.15f},
                     .internode = 0.035f,
                     .shoot = 0.32f,
                     .holes = 7,
                     .open_side = 0.12f};
  s.growth = {.step = 0.20f, .influence = 1.5f, .kill = 0.35f, .tropism = {0, 0, 0.45f}, .max_nodes = 9000};
  s.lean = b.lean;
  s.dead = b.dead;
  return s;
}

// Albedo of leaves: published reflectances of the visible range, a fresh and a deep tone and between.
const Texture& LeavesOf(ParkTree species) {
  static const Vec3f elm[] = {{0.064f, 0.101f, 0.024f}, {0.075f, 0.111f, 0.029f}, {0.055f, 0.090f, 0.024f}};
  static const Vec3f maple[] = {{0.080f, 0.121f, 0.029f}, {0.092f, 0.129f, 0.033f}, {0.068f, 0.107f, 0.029f}};
  static const Vec3f cork[] = {{0.088f, 0.125f, 0.034f}, {0.101f, 0.135f, 0.039f}, {0.076f, 0.113f, 0.033f}};
  static const Vec3f poplar[] = {{0.090f, 0.137f, 0.049f}, {0.107f, 0.149f, 0.056f}, {0.076f, 0.120f, 0.041f}};
  static const Texture atlases[4] = {LeafAtlas("leaves elm", elm), LeafAtlas("leaves maple", maple), LeafAtlas("leaves cork", cork),
                                     LeafAtlas("leaves poplar", poplar)};
  switch (species) {
    case ParkTree::kElm:
      return atlases[0];
    case ParkTree::kMaple:
      return atlases[1];
    case ParkTree::kCork:
      return atlases[2];
    default:
      return atlases[3];
  }
}

// Leaves that a tree keeps at each level of detail.
constexpr float kMiddleShare = 0.09f;
constexpr float kFarLeaves = 1300;

}  // namespace

const ParkTreeInfo& InfoOf(ParkTree species) { return kInfos[static_cast<size_t>(species)]; }

Model MakeParkTree(ParkTree species, TreeDetail detail, int individual, uint64_t seed) {
  const uint64_t key = MixBits(seed ^ HashName(InfoOf(species).name)) + static_cast<uint64_t>(individual);
  if (species == ParkTree::kPine)
    return GrowPine(individual, detail == TreeDetail::kFull ? 1 : detail == TreeDetail::kMiddle ? 0.12f : 0.03f, key);
  if (species == ParkTree::kWillow) {
    constexpr float sizes[3][2] = {{11.0f, 5.0f}, {9.5f, 4.5f}, {12.0f, 5.6f}};
    return GrowWillow(sizes[individual % 3][0], sizes[individual % 3][1],
                      detail == TreeDetail::kFull     ? 1
                      : detail == TreeDetail::kMiddle ? 0.12f
                                                      : 0.03f,
                      key);
  }
  // The solitary elm is not repeated as a far tree: individuals 1, 2, 3.
  const int i = species == ParkTree::kElm && detail != TreeDetail::kFull ? individual + 1 : individual;
  BroadleafSpecies s = species == ParkTree::kElm     ? Elm(i)
                       : species == ParkTree::kMaple ? Maple(i)
                       : species == ParkTree::kCork  ? Cork(i)
                                                     : Poplar(i);
  s.transmission = 0.85f;
  s.depth = 0.6f;
  if (detail == TreeDetail::kMiddle) s = Simplified(s, kMiddleShare);
  if (detail == TreeDetail::kFar) s = Simplified(s, kFarLeaves / static_cast<float>(s.leaves));
  return GrowBroadleaf(s, LeavesOf(species), key);
}

}  // namespace airsim360::internal
