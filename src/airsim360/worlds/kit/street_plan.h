// Streets and blocks of a downtown as plain 2D outlines: what everything else is built on.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Axis-aligned rectangle on the ground, metres in W.
struct GroundRect {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  float width() const { return x1 - x0; }
  float depth() const { return y1 - y0; }
  float area() const { return width() * depth(); }
  Vec2f center() const { return {(x0 + x1) / 2, (y0 + y1) / 2}; }
  GroundRect Inset(float d) const { return {x0 + d, y0 + d, x1 - d, y1 - d}; }
  bool Contains(Vec2f p) const { return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1; }
  /// Corners counter-clockwise from (x0, y0).
  std::vector<Vec2f> Outline() const { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
};

/// What is painted on a street.
enum class StreetKind {
  kTwoWay,     ///< a lane each way between parking bays
  kAvenue,     ///< three lanes each way, parking bays
  kBoulevard,  ///< planted median; bus lane to the left of +s, green bike lane and parking to the right
};

/// How it is painted.
enum class RoadPaint {
  kToday,       ///< yellow middle, bays, arrows, words, cycle and bus lanes, boxes, ladders for those on foot
  kWhiteLines,  ///< white lines between the lanes, two across for those on foot
};

/// A straight street: x = center (north-south) or y = center (east-west).
struct StreetLine {
  float center = 0;
  float half_width = 6;  ///< centre line to kerb face
  StreetKind kind = StreetKind::kTwoWay;
};

enum class BlockKind { kBuilt, kPlaza, kPark, kBackdrop };

struct Block {
  int column = 0, row = 0;
  BlockKind kind = BlockKind::kBuilt;
  GroundRect kerb;          ///< kerb faces
  float corner_radius = 6;  ///< of the kerb returns
  float pavement = 5.0f;    ///< kerb face to building line
  GroundRect inner() const { return kerb.Inset(pavement); }
};

/// Streets on a grid; block (column, row) lies between lines column and column + 1. Lines from `first_core`
/// to `last_core` bound the part that can be reached; the rest is backdrop.
struct StreetPlan {
  std::vector<StreetLine> north_south, east_west;  ///< by growing coordinate
  int first_core = 1, last_core = 4;
  int bike_lane_row = -1;  ///< index of the east-west two-way street with green bike lanes; -1 = none
  RoadPaint paint = RoadPaint::kToday;
  std::vector<Block> blocks;

  /// The reachable ground: to the building lines across the outermost core streets.
  GroundRect reach() const;
};

/// The plan of downtown_west: 3 x 3 core blocks (plaza in the middle, park to its east) in a ring of backdrop
/// blocks (worlds/downtown_west/).
StreetPlan PlanDowntownWest();

/// The plan of new_york_city: avenues 132 m apart, streets 84 m apart, 3 x 3 core blocks (the park is the
/// middle one of the eastern column) in a ring of backdrop blocks. The boulevard and a street cross at the
/// origin (worlds/new_york_city/).
StreetPlan PlanNewYorkCity();

/// Height of the carriageway at distance `d` from the centre line: a crown of 1.8 % above gutters at -0.13 m.
float CarriagewayHeight(const StreetLine& line, float d);

}  // namespace airsim360
