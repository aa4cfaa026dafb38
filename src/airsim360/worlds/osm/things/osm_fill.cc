// Along the streets, by rule, what a map has none of; cars, manholes.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/osm/osm_dresser.h"

namespace airsim360::internal {
// Along the streets: lamps and trees where the map has none at all, cars at the kerb, manholes.
void Dresser::Fill() {
  const double trees = scene_.dress ? scene_.dress->trees : 1;
  const char* lamp = scene_.dress ? scene_.dress->lamp : "street_light";
  const bool lamps = HasAny("highway", "street_lamp"), bins = HasAny("amenity", "waste_basket"),
             hydrants = HasAny("emergency", "fire_hydrant"), racks = HasAny("amenity", "bicycle_parking");
  for (const RoadSegment& segment : near_.graph->segments) {
    const double length = segment.Length(), s0 = segment.start + 6, s1 = length - segment.end - 6;
    if (segment.rank == 0 || segment.rank > 5 || s1 - s0 < 8 || segment.half < 2.6) continue;
    if (scene_.Far(segment.line[0]) > 900 && scene_.Far(segment.line.back()) > 900) continue;
    RngStream rng(scene_.options.seed, "street " + segment.id);
    const Carriageway shares = CarriagewayOf(segment);
    for (int side : {1, -1}) {
      const double pavement = segment.pavement[side > 0 ? 0 : 1];
      // Staggered, so that the nearest lamp is 19 to 20 m away, over the street.
      const double across = 2 * (segment.half + 0.55), stagger = std::sqrt(std::max(19.7 * 19.7 - across * across, 150.0));
      if (lamp && !lamps && pavement > 1.2) Row(segment, s0 + (side > 0 ? 0 : stagger), s1, 2 * stagger, side, 0.55, lamp, rng);
      if ((trees_ == 0 || scene_.dress) && trees > 0 && pavement > 2.6 && rng.Chance(0.8 * trees)) TreeRow(segment, s0 + 5, s1, side, rng);
      if (pavement > 2.2) {
        if (!bins) Row(segment, s0 + rng.Uniform(4, 60), s1, 80, side, 0.7, "trash_can", rng);
        if (!hydrants) Row(segment, s0 + rng.Uniform(4, 90), s1, 110, side, 0.55, "fire_hydrant", rng);
        Row(segment, s0 + rng.Uniform(4, 70), s1, 70, side, 0.5, "traffic_sign", rng);
      }
      const bool bikes = shares.bikes[side > 0 ? 0 : 1];
      if (bikes && !racks && pavement > 2.2) Row(segment, s0 + rng.Uniform(2, 12), s1, 24, side, 1.0, "bicycle", rng);
      if (segment.rank >= 2 && segment.rank <= 4 && segment.half > 3.6 && !(bikes && shares.parking == 0))
        Cars(segment, s0 + 3, s1 - 3, side, rng);
    }
    for (double s = s0 + rng.Uniform(0, 30); s < s1; s += rng.Uniform(30, 60)) {
      const LinePoint at = PointAt(segment.line, s);
      const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * rng.Uniform(-1, 1);
      if (!Here(p)) continue;
      scene_.Put(segment.id + "/manhole", "manhole", scene_.On(p, -0.127), rng.Uniform(0, kTau), 1, rng.Index(2));
    }
  }
}

void Dresser::Car(const std::string& name, Vec2d p, Vec2d heading, double lift, RngStream& rng) {
  const char* kind = rng.Chance(0.88) ? "car" : "van";
  const double yaw = Yaw(heading);
  const Footprint place = FootprintOf(kind, ToFloat(p), static_cast<float>(yaw));
  if (!scene_.occupancy.IsFree(place)) return;
  scene_.occupancy.Add(place);
  scene_.Put(name, kind, scene_.On(p, lift), yaw, 1, rng.Index(36));
}

void Dresser::Cars(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng) {
  int number = 0;
  const double full = rng.Uniform(0.35, 0.8) * (scene_.dress ? scene_.dress->traffic : 1);
  for (double s = s0; s < s1; s += 6.1) {
    if (!rng.Chance(full)) continue;
    const LinePoint at = PointAt(segment.line, s);
    const Vec2d left{-at.along.y, at.along.x};
    const Vec2d p = at.p + left * (side * (segment.half - 1.15));
    if (!Here(p) || OnOther(p, segment)) continue;
    const Vec2d heading = at.along * (side > 0 && !segment.oneway ? -1.0 : 1.0);
    Car(segment.id + (side > 0 ? "/car_left " : "/car_right ") + std::to_string(++number), p, heading, -0.13, rng);
  }
}

// Is p on the carriageway of another segment?
bool Dresser::OnOther(Vec2d p, const RoadSegment& self) const {
  const auto index = static_cast<uint32_t>(&self - near_.graph->segments.data());
  const LineIndex::Near other = near_.roads.Find(p, 14, index);
  return other.owner != UINT32_MAX && other.distance < near_.graph->segments[other.owner].half + 1.5;
}

void Dresser::Row(const RoadSegment& segment, double s0, double s1, double pitch, int side, double gap, const char* kind, RngStream& rng) {
  int number = 0;
  for (double s = s0; s < s1; s += pitch) {
    const LinePoint at = PointAt(segment.line, s);
    const Vec2d left{-at.along.y, at.along.x}, p = at.p + left * (side * (segment.half + gap));
    const Vec2d front = left * -static_cast<double>(side);
    const Footprint place = FootprintOf(kind, ToFloat(p), static_cast<float>(Yaw(front)));
    if (!Here(p) || OnOther(p, segment) || InBuilding(p) || !scene_.occupancy.IsFree(place)) continue;
    scene_.occupancy.Add(place);
    const std::string name = segment.id + "/" + kind + (side > 0 ? " left " : " right ") + std::to_string(++number);
    scene_.Put(name, kind, scene_.On(p), Yaw(front), 1, rng.Index(8));
  }
}

void Dresser::TreeRow(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng) {
  int number = 0;
  for (double s = s0; s < s1; s += rng.Uniform(8.0, 9.6)) {
    const LinePoint at = PointAt(segment.line, s);
    const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * (side * (segment.half + 1.0));
    const Footprint place{ToFloat(p), {0.7f, 0.7f}, 0};
    if (planted_ >= kMostPlanted || !Here(p) || OnOther(p, segment) || InBuilding(p) || !scene_.occupancy.IsFree(place)) continue;
    scene_.occupancy.Add(place);
    const std::string name = segment.id + (side > 0 ? "/tree left " : "/tree right ") + std::to_string(++number);
    // Crowns keep off the walls.
    const double free = segment.pavement[side > 0 ? 0 : 1];
    scene_.Put(name, rng.Chance(0.3) ? "tree_narrowleaf" : "tree_generic", scene_.On(p, -0.02), rng.Uniform(0, kTau),
               static_cast<float>(std::clamp(0.42 + 0.1 * free, 0.5, 0.95) * rng.Uniform(0.85, 1.1)), rng.Index(6));
    ++planted_;
  }
}

}  // namespace airsim360::internal
