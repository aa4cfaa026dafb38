// The shapes of cars and the body that is lofted over their cross-sections.
#pragma once

#include <vector>

#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {

/// An interval of the length of a car.
struct CarRange {
  float from, to;
  bool Holds(float y) const { return y > from && y < to; }
};

/// The shape of a car, metres; y runs from the nose (negative) to the tail. Curves are polylines over y.
struct CarShape {
  std::vector<Vec2f> top;    ///< (y, height) of the middle line
  std::vector<Vec2f> belt;   ///< (y, height) of the shoulder below the windows
  std::vector<Vec2f> width;  ///< (y, half width)
  float roof_half_width, front_axle, rear_axle, wheel_radius;
  CarRange windscreen, rear_window, side_glass;
  std::vector<CarRange> pillars;
  bool half_glass = false;  ///< side windows end half-way up to the roof
};

const CarShape& Sedan();
const CarShape& Hatchback();
const CarShape& Suv();
const CarShape& PanelVan();

/// Value of a polyline at y, constant beyond its ends.
float Lookup(const std::vector<Vec2f>& line, float y);

/// Coats of a car; the roof's reaches down to the windows, the sweep's lies along the flanks within its range of y.
struct CarCoats {
  Material body, roof, sweep;
  CarRange swept{0, 0};
};
/// Skin, windows, door gaps and open wheel arches, closed at nose and tail; no wheels.
void AddCarBody(PropBuilder& b, const CarShape& shape, const CarCoats& coats);
inline void AddCarBody(PropBuilder& b, const CarShape& shape, const Material& paint) { AddCarBody(b, shape, {paint, paint, paint}); }

}  // namespace airsim360::internal
