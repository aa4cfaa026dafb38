// Small things that fill shelves, tables and rails: books, garments, dishes, cartons, labels.
#pragma once

#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {

/// A row of books with printed spines from x0 to x1, their spines at y0, standing on z, none higher than `room`; the last
/// ones may lean.
void BooksOnShelf(PropBuilder& b, float x0, float x1, float y0, float z, float room, uint64_t seed);

/// A vase, box, small frame, bowl or lying books within `radius` of `p`, at most `room` high.
void ShelfThing(PropBuilder& b, Vec3f p, float radius, float room, uint64_t seed);

/// A garment on a hanger under the origin of `X`, `width` across the shoulders along X, `length` long.
void HangingGarment(PropBuilder& b, const AffineTransform& X, float width, float length, uint64_t seed);

/// Carton of `size` on z = 0 about the origin of `X`, taped, with a printed label; `shade` of the board.
void Carton(PropBuilder& b, const AffineTransform& X, Vec3f size, uint64_t seed);

/// A row of packaged goods on a shelf: from x0 to x1, fronts at y0, `depth` deep in ranks, standing on z, at most `room`
/// high. All packages of the row are of one product.
void GoodsOnShelf(PropBuilder& b, float x0, float x1, float y0, float depth, float z, float room, uint64_t seed);

/// Surfaces of revolution that stand at `p`: profile of (radius, height).
void Cup(PropBuilder& b, Vec3f p, float radius, float height);
void Bowl(PropBuilder& b, Vec3f p, float radius, float height);
void Plate(PropBuilder& b, Vec3f p, float radius);
void Bottle(PropBuilder& b, Vec3f p, float radius, float height);

}  // namespace airsim360::internal
