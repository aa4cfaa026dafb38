// Shapes that the texture recipes share: blends, courses of bricks and slabs, herringbone.
#pragma once

#include "airsim360/worlds/texture/texture_synth.h"

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

// Recipes by family: painters of whole maps.
struct SurfaceMaps;
void AsphaltAged(SurfaceMaps& maps);
void AsphaltFresh(SurfaceMaps& maps);
void PaintWorn(SurfaceMaps& maps);
void Slabs(SurfaceMaps& maps);
void PavingBrick(SurfaceMaps& maps);
void StoneSetts(SurfaceMaps& maps);
void GravelPath(SurfaceMaps& maps);
void RoofGravel(SurfaceMaps& maps);
void Grass(SurfaceMaps& maps);
void Soil(SurfaceMaps& maps);
void ForestFloor(SurfaceMaps& maps);
void Bitumen(SurfaceMaps& maps);
void BrickRed(SurfaceMaps& maps);
void BrickStock(SurfaceMaps& maps);
void BrickPainted(SurfaceMaps& maps);
void Ashlar(SurfaceMaps& maps);
void Plaster(SurfaceMaps& maps);
void Concrete(SurfaceMaps& maps);
void Planks(SurfaceMaps& maps);
void RoofTile(SurfaceMaps& maps);
void Slate(SurfaceMaps& maps);
void Galvanised(SurfaceMaps& maps);
// Recipes texel by texel; u, v in [0, 1).
Texel Rock(float u, float v);
Texel Fields(float u, float v);
Texel Stripes(float u, float v);
Texel FarWalls(float u, float v);
Texel FarPiers(float u, float v);
Texel FarRibbons(float u, float v);
/// What shines behind the panes of one of the three by night, 1 at most; `columns`, `rows`: bays of its tile.
Vec3f FarLights(Texel (*wall)(float u, float v), int columns, int rows, float u, float v);
Texel Shop(float u, float v, uint32_t kind);

/// Lattice of a wall or pavement: `columns` by `rows` units a tile, rows shifted by half a unit by turns. The
/// same numbers go into Material::units.
struct Lattice {
  int columns, rows;
};
inline constexpr Lattice kSlabUnits{4, 6}, kBrickUnits{8, 26}, kAshlarUnits{5, 10}, kSettUnits{18, 18}, kSlateUnits{8, 10};

}  // namespace airsim360::internal
