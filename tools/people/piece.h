// One garment, the skin or the hair of a person who is being baked.
#pragma once

#include <string>
#include <vector>

#include "airsim360/people/body/body_pack.h"

namespace airsim360::bake {

/// What lies over what: a layer is worn over all lower ones.
enum class Layer { kSkin, kSocks, kShoes, kBottom, kTop, kLoose };  // loose: hair, brows, eyes

/// Triangles of one material, vertices split by uv.
struct Piece {
  Cloth cloth = Cloth::kOther;
  Layer layer = Layer::kLoose;
  bool whole = false;  ///< never simplified: small things that must fit each other
  uint32_t material = 0;
  std::vector<Vec3f> positions;  ///< in P
  std::vector<Vec2f> uvs;
  std::vector<Influences> influences;
  std::vector<uint32_t> source;  ///< vertex of the source mesh, for what is smooth over uv seams
  std::vector<uint32_t> indices;
};

}  // namespace airsim360::bake
