// Parts of things (windows and doors of a house, leaves and trunk of a tree), told apart beside the entity.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "airsim360/image/image.h"
#include "airsim360/scene/material.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/semantics.h"

namespace airsim360 {

/// What a surface is of the entity that it belongs to. Append only: the values stand in files.
enum class Part : uint8_t { kNone, kWindow, kDoor, kBalcony, kShutter, kWheel, kFoliage, kTrunk };
inline constexpr const char* kPartNames[] = {"", "window", "door", "balcony", "shutter", "wheel", "foliage", "trunk"};

/// The part that a material named `material` is of an entity in `category` (a path of the semantic tree): words of the name
/// ("glass dark", "Door_02") for buildings, vehicles and plants; balconies by their category. kNone = the body of the thing.
Part PartOf(std::string_view category, std::string_view material);

/// The parts (values of Part) of a picture from its categories and material indices plus 1 (0 = nothing hit).
Image<uint8_t> PartPicture(const Image<CategoryId>& semantic, const Image<uint16_t>& material, const SemanticTree& tree,
                           std::span<const Material> materials);

/// 255 where the picture shows the entity `sky`, else 0; kNoEntity: a scene without a sky.
Image<uint8_t> SkyMask(const Image<EntityId>& entity, EntityId sky);

}  // namespace airsim360
