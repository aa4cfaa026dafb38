// What a procedural person wears: cut, colours, hair, the painted face.
#pragma once

#include <memory>
#include <string>

#include "airsim360/people/body/body.h"

namespace airsim360::internal {

enum class Top : uint8_t { kTShirt, kShirt, kPullover, kJacket, kVest };
enum class Bottom : uint8_t { kTrousers, kJeans, kShorts, kSkirt, kDress };
enum class Hair : uint8_t { kShort, kCropped, kLong, kBob, kBun, kBald, kCap };

struct Wardrobe {
  Top top = Top::kTShirt;
  Bottom bottom = Bottom::kTrousers;
  Hair hair = Hair::kShort;
  bool coat = false;                                                          ///< the jacket reaches to mid-thigh
  Vec3f skin, hair_color, top_color, second_color, bottom_color, shoe_color;  ///< linear
  int pattern = 0;  ///< of the top: 0 plain, 1 stripes across, 2 checks, 3 stripes along, 4 block
  bool beard = false;
  std::string name;  ///< "t-shirt, jeans"
};

Wardrobe DrawWardrobe(const BodySpec& spec);

/// Materials of a procedural body, by index.
enum BodyMaterial : uint32_t {
  kFaceMaterial,
  kSkinMaterial,
  kHairMaterial,
  kTopMaterial,
  kBottomMaterial,
  kShoeMaterial,
  kSoleMaterial,
  kPropDark,
  kPropLight,
  kPropColor,
  kBodyMaterialCount
};

/// Fills materials and textures of a body.
void PaintBody(const Wardrobe& wardrobe, const BodySpec& spec, Body& body);

}  // namespace airsim360::internal
