// Colours of categories for people's eyes: palettes of semantic pictures, legends, panoptic.json.
#pragma once

#include <array>

#include "airsim360/image/image.h"
#include "airsim360/scene/semantics.h"

namespace airsim360 {

/// Colour of every built-in id, black for void and ids that are free. Where Cityscapes has the class it is
/// Cityscapes' colour; else the hue is that of the family (the first part of the path). Any two differ by at
/// least 20 of 765 summed over the channels. Categories appended to the tree leave the others' colours as they are.
const std::array<Rgb8, kFirstCustomId>& CategoryPalette();

/// Colour of any category: of the palette, or for custom ones by their family and path.
Rgb8 CategoryColor(const SemanticTree& tree, CategoryId id);

}  // namespace airsim360
