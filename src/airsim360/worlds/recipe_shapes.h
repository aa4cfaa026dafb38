// Shapes that the texture recipes share: blends, courses of bricks and slabs, herringbone.
#pragma once

#include "airsim360/worlds/texture_synth.h"

namespace airsim360::internal {

inline float Mix(float a, float b, float t) { return a + (b - a) * t; }
inline Vec3f Mix(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }
/// Smooth step from 0 at `low` to 1 at `high` (or falling where high < low).
float Step(float low, float high, float x);

/// A course-bonded lattice of units: where in the unit a texel is, and which unit it is in.
struct Unit {
  float edge;  ///< metres to the nearest joint centre line
  uint32_t id;
  float x, y;  ///< position in the unit, 0..1
};
/// Courses: `columns` by `rows` units on a tile of `tile` metres, every second row shifted by `offset` units.
Unit Bond(float u, float v, float tile, int columns, int rows, float offset);
/// Herringbone of 2:1 bricks, `n` half-bricks a tile (a multiple of 4).
Unit Herringbone(float u, float v, float tile, int n);

// The recipes by family; u, v in [0, 1).
Texel Asphalt(float u, float v);
Texel Concrete(float u, float v);
Texel Slabs(float u, float v);
Texel PavingBrick(float u, float v);
Texel StoneSetts(float u, float v);
Texel GravelPath(float u, float v);
Texel Grass(float u, float v);
Texel Soil(float u, float v);
Texel RoofGravel(float u, float v);
Texel Rock(float u, float v);
Texel Fields(float u, float v);
Texel PaintWorn(float u, float v);
Texel Brick(float u, float v);
Texel Ashlar(float u, float v);
Texel Plaster(float u, float v);
Texel Planks(float u, float v);
Texel RoofTile(float u, float v);
Texel Stripes(float u, float v);
Texel FarWalls(float u, float v);
Texel Shop(float u, float v, uint32_t kind);
Texel Sign(float u, float v);

}  // namespace airsim360::internal
