// Meshes of plants: bark tubes, leaves, blades and needles, one layer a material.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/scene/model_source.h"
#include "airsim360/worlds/vegetation/branching.h"

namespace airsim360::internal {

/// Vertices and triangles of one material of a plant.
struct PlantLayer {
  Material material;
  const Texture* texture = nullptr;  ///< base colour; uv of the layer are in tiles
  const Texture* normals = nullptr;
  std::vector<Vec3f> positions, shading_normals;
  std::vector<Vec2f> uvs;
  std::vector<Vec3u> triangles;

  uint32_t Add(Vec3f p, Vec3f n, Vec2f uv);
};

/// Bark: brown-grey of the given colour with furrows.
PlantLayer BarkLayer(Vec3f color);
/// Leaves with the pictures of `atlas` (which must outlive the layer).
PlantLayer LeafLayer(const Texture& atlas, float transmission = 0.8f);

/// Layer 0 is bark, layers 1 to 3 are leaves that see little, half and all of the sky: what the plant itself
/// takes away of the sky's light is in their colour, so that crowns have depth without ambient occlusion.
/// `depth` scales that: 0 leaves all leaves as bright as the outer ones.
std::vector<PlantLayer> PlantLayers(Vec3f bark, const Texture& atlas, float transmission = 0.8f, float depth = 1);
/// The leaves of PlantLayers for a place that sees a share `openness` (0 … 1) of the sky.
PlantLayer& LeavesAt(std::vector<PlantLayer>& layers, float openness);

/// Number of leaf pictures side by side in an atlas.
inline constexpr int kLeafCells = 8;
/// Pictures of leaves with rib, veins and darker edge; colours are linear albedo; every cell varies on one of
/// `tones`, and the last one is yellowed.
Texture LeafAtlas(std::string name, std::span<const Vec3f> tones);

enum class LeafForm {
  kKite,   ///< two triangles that meet at the rib
  kLobed,  ///< four triangles: three lobes, as maple
};

struct LeafShape {
  float length = 0.15f, width = 0.10f;
  float fold = 0.12f;  ///< height of the edges above the rib, in widths
  float droop = 0.2f;  ///< how far the tip hangs below the straight rib, in lengths
  LeafForm form = LeafForm::kKite;
};
/// Leaf: from `base` along `direction`, its upper face to `up`.
/// `soften` is mixed into the shading normal (the direction out of the crown). `cell` in 0 … kLeafCells - 1.
void AddLeaf(PlantLayer& layer, Vec3f base, Vec3f direction, Vec3f up, const LeafShape& shape, int cell, Vec3f soften = {});
/// Blade of grass of three triangles, bending over to `lean` (horizontal, 0..1).
void AddBlade(PlantLayer& layer, Vec3f base, float height, float width, Vec3f lean, float turn, int cell);
/// Blade that a mower has cut at height `cut`: two triangles that end flat.
void AddCutBlade(PlantLayer& layer, Vec3f base, float cut, float width, Vec3f lean, float turn, int cell);
/// One triangle from a base of the given width to a point; its face looks to the side of `normal`.
void AddNeedle(PlantLayer& layer, Vec3f base, Vec3f tip, Vec3f side, float width, Vec3f normal, int cell);

/// Bark around all branches thicker than `min_radius`; the foot flares out into roots below `flare` metres.
void AddBark(PlantLayer& layer, const std::vector<BranchNode>& nodes, float min_radius, float flare);

/// One model with a part a layer (empty layers are left out).
Model JoinLayers(std::string name, std::span<const PlantLayer> layers);

}  // namespace airsim360::internal
