// Layers of clouds by type, cover and seed.
#pragma once

#include "airsim360/render/sky/cloud_layer.h"

namespace airsim360::internal {

/// Clouds that grow from heated ground: thrown where a field of clusters and streets lets them grow, each a heap of domes under
/// an envelope, sizes log-normal.
struct CumulusForm {
  float base;    ///< metres above the ground
  float size;    ///< usual breadth, metres
  float growth;  ///< height over 0.42 times the breadth
};
/// `cover`: share of the ground below them, 0 … 0.9; `wind`: unit, along the streets.
CloudLayer CumulusLayer(const CumulusForm& form, float cover, Vec2f wind, uint32_t seed);

/// Sheets of rolls and fleeces: stratocumulus, altocumulus.
struct SheetForm {
  float base, thickness, element;  ///< metres; element: distance of neighbours
  float cell;                      ///< of the maps, metres
  float extinction;                ///< 1 / m
};
/// `cover`: share of the ground below it before its edges are worn, 0 … 1.
CloudLayer SheetLayer(const SheetForm& form, float cover, Vec2f wind, uint32_t seed);

}  // namespace airsim360::internal
