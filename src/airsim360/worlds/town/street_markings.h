// What is painted on carriageways: lanes, bays, arrows, words, crosswalks, lines through crossings.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/town/ground.h"

namespace airsim360::internal {

inline constexpr float kPaintLift = 0.004f;

/// The surface of a crossing: triangles from the middle to the rim.
struct Fan {
  Vec3f middle;
  std::vector<Vec3f> rim;
  float Height(Vec2f p) const {
    for (size_t i = 0; i < rim.size(); ++i) {
      const Vec3f a = rim[i] - middle, b = rim[(i + 1) % rim.size()] - middle;
      const float x = p.x - middle.x, y = p.y - middle.y, det = a.x * b.y - a.y * b.x;
      const float s = (x * b.y - y * b.x) / det, t = (a.x * y - a.y * x) / det;
      if (s >= -1e-4f && t >= -1e-4f) return middle.z + a.z * s + b.z * t;
    }
    return middle.z;
  }
};

/// The fan of the crossing of a north-south with an east-west street: over its four mouths and kerb returns.
Fan FanOf(const StreetLine& ns, const StreetLine& ew);

/// A rectangle on a stretch, following the crown.
void StreetRect(Ground& ground, const StreetStretch& street, float s0, float s1, float d0, float d1, float lift);

/// The markings of a stretch by the kind of its street; `bike_lane`: green lanes on both sides of a two-way
/// one.
void LayMarkings(Ground& ground, const StreetStretch& street, const std::string& name, bool bike_lane);

/// The markings of a stretch before there were any but white lines: the middle, dashes between lanes, a bar where traffic stops.
void LayWhiteLines(Ground& ground, const StreetStretch& street, const std::string& name);

/// A crosswalk at the start or the end of a stretch: bars along the street.
void LayCrosswalk(Ground& ground, const StreetStretch& street, bool at_start, const std::string& name);
/// Two lines across the street, asphalt between them: what lies there belongs to those on foot all the same.
void LayLinedCrosswalk(Ground& ground, const StreetStretch& street, bool at_start, const std::string& name);

/// A boulevard's lines through a crossing: green bars of the bike lane, dashes between the lanes, arcs for
/// those who turn left; draped over the fan.
void LayJunctionGuides(Ground& ground, const Fan& fan, const StreetLine& ns, const StreetLine& ew, const std::string& name);

/// The hatched box of a crossing that must not be blocked: white diagonals in a frame, draped over the fan.
void LayJunctionBox(Ground& ground, const Fan& fan, const StreetLine& ns, const StreetLine& ew, const std::string& name);

}  // namespace airsim360::internal
