// Levels of detail of one person: the pieces simplified together and joined.
#pragma once

#include <span>
#include <vector>

#include "piece.h"

namespace airsim360::bake {

inline constexpr size_t kBakedLevels = 4;

/// Indices of each piece with at most `triangles` in all where that can be had with an error of less than
/// `most` metres: every piece is simplified with the same error, so that none falls to pieces for another.
std::vector<std::vector<uint32_t>> SimplifyTogether(std::span<const Piece> pieces, size_t triangles, float most);

/// Drops connected parts of a piece that are shorter than `size` metres in every direction: buttons and tufts that nobody
/// sees from where a coarse level is shown, but that no simplification gets below two triangles.
void DropCrumbs(float size, Piece& piece);

/// Level 0 is the finest. The coarser ones drop small things and keep what is worn under garments further away from them.
BodyLevel MakeLevel(std::vector<Piece> pieces, size_t level);

}  // namespace airsim360::bake
