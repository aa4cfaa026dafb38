// Tram lines: grooved rails in the main streets, contact wires over them, spans to the houses, a car now and then.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/osm/osm_ground_builder.h"
#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
namespace {

constexpr double kGauge = 0.9, kWire = 5.7;  // metres: Lisbon's gauge; height of the contact wire

}  // namespace

void TownFinisher::Tram() {
  int cars = 0;
  double since = 60;
  for (const TownStreet& street : map_.streets) {
    if (street.rank != 0 || street.bridge) continue;
    Rails(street);
    Wires(street);
    since += LengthOf(street.line);
    const LinePoint middle = PointAt(street.line, LengthOf(street.line) / 2);
    if (since < 140 || cars >= 6 || !scene_.data.extent.Contains(middle.p, -12)) continue;
    since = 0;
    ++cars;
    Car(middle.p, middle.along);
  }
}

void TownFinisher::Rails(const TownStreet& street) {
  mesh_.SetTransform({});
  mesh_.SetEntity(scene_.builder.AddEntity("tram rails", scene_.builder.tree().At("ground/rail")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kIron]);
  const double length = LengthOf(street.line);
  for (double d : {-kGauge / 2, kGauge / 2})
    for (double s = 0; s < length; s += 4) {
      const LinePoint a = PointAt(street.line, s), b = PointAt(street.line, std::min(s + 4, length));
      const Vec2d na{-a.along.y, a.along.x}, nb{-b.along.y, b.along.x};
      const Vec2d p = a.p + na * (d - 0.05), q = b.p + nb * (d - 0.05), r = b.p + nb * (d + 0.05), t = a.p + na * (d + 0.05);
      if (!scene_.data.extent.Contains(p, 28) || !scene_.data.extent.Contains(q, 28)) continue;
      scene_.Drape(mesh_, p, q, r, -kRoadDrop + 0.012, PlainUv);
      scene_.Drape(mesh_, p, r, t, -kRoadDrop + 0.012, PlainUv);
    }
}

void TownFinisher::Wires(const TownStreet& street) {
  mesh_.SetTransform({});
  mesh_.SetEntity(scene_.builder.AddEntity("tram wires", scene_.builder.tree().Add("furniture/utility/wire")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameDark]);
  const double length = LengthOf(street.line);
  for (double s = 0; s < length; s += 8) {
    const LinePoint a = PointAt(street.line, s), b = PointAt(street.line, std::min(s + 8, length));
    mesh_.Tube(At(a.p, kWire), At(b.p, kWire), 0.012f, 0.012f, 5, false, false);
  }
  // Spans from wall to wall; a mast where no house is near.
  for (double s = 9; s < length - 6; s += 19) {
    const LinePoint at = PointAt(street.line, s);
    const Vec2d side{-at.along.y, at.along.x};
    if (!scene_.data.extent.Contains(at.p, 10)) continue;
    for (double hand : {1.0, -1.0}) {
      double reach = street.half + street.pavement - 0.15;
      bool wall = false;
      for (double d = street.half; d < street.half + street.pavement + 2.5 && !wall; d += 0.25)
        if (InHouse(at.p + side * (hand * d), 0.05)) reach = d, wall = true;
      const Vec2d end = at.p + side * (hand * (wall ? reach : street.half + 0.35));
      mesh_.Tube(At(at.p, kWire + 0.12), At(end, kWire + 0.75), 0.009f, 0.009f, 4, false, false);
      if (!wall) mesh_.Tube(At(end, -0.1), At(end, kWire + 0.95), 0.085f, 0.06f, 10, false, true);
    }
    mesh_.Tube(At(at.p, kWire), At(at.p, kWire + 0.14), 0.012f, 0.012f, 4, false, false);
  }
}

// A short yellow and white car of two axles.
void TownFinisher::Car(Vec2d p, Vec2d along) {
  const double yaw = FacingYaw(ToFloat(along));
  const Footprint place{ToFloat(p), {1.3f, 4.4f}, static_cast<float>(yaw)};
  if (!scene_.occupancy.IsFree(place)) return;
  scene_.occupancy.Add(place);
  // On the slope of the street, its ends on the rails.
  const float back = At(p - along * 2.2, 0).z, front = At(p + along * 2.2, 0).z, z = At(p, -kRoadDrop).z;
  const auto entity = scene_.builder.AddEntity("tram", scene_.builder.tree().At("vehicle/tram"));
  mesh_.SetEntity(entity);
  const AffineTransform X = PlaceUpright(
      {static_cast<float>(p.x), static_cast<float>(p.y), std::max(z, (back + front) / 2 - static_cast<float>(kRoadDrop)) + 0.02f},
      static_cast<float>(yaw));
  const float slope = std::atan2(front - back, 4.4f), c = std::cos(slope), s = std::sin(slope);
  // Its front is -y: pitching up turns it about x.
  const AffineTransform pitch{{{{{1, 0, 0}, {0, c, s}, {0, -s, c}}}}, {}};
  mesh_.SetTransform(X * pitch);
  const MaterialId yellow = scene_.tints.Get(scene_.surfaces[Surface::kPanelWhite], {0.68f, 0.42f, 0.035f}, 0.6f),
                   white = scene_.surfaces[Surface::kPanelWhite];
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameDark]);
  mesh_.Box({-0.8f, -2.2f, 0.12f}, {0.8f, 2.2f, 0.55f});
  for (float y : {-1.35f, 1.35f})
    for (float x : {-0.52f, 0.4f}) {
      mesh_.Tube({x, y, 0.34f}, {x + 0.12f, y, 0.34f}, 0.34f, 0.34f, 18);
    }
  mesh_.SetMaterial(yellow);
  mesh_.Box({-1.15f, -4.0f, 0.5f}, {1.15f, 4.0f, 1.55f});
  mesh_.SetMaterial(white);
  mesh_.Box({-1.15f, -4.0f, 2.45f}, {1.15f, 4.0f, 2.85f});
  for (float x : {-1.15f, 1.07f})
    for (int i = 0; i <= 6; ++i)
      mesh_.Box({x, -4.0f + 1.318f * static_cast<float>(i), 1.55f}, {x + 0.08f, -3.91f + 1.318f * static_cast<float>(i), 2.45f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kGlassDark]);
  mesh_.Box({-1.12f, -3.97f, 1.55f}, {1.12f, 3.97f, 2.45f},
            MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack);
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameDark]);
  mesh_.Box({-1.0f, -3.9f, 2.85f}, {1.0f, 3.9f, 2.98f});
  mesh_.Box({-0.7f, -3.2f, 2.98f}, {0.7f, 3.2f, 3.16f});
  mesh_.Tube({0, 0.4f, 3.16f}, {0, 3.0f, static_cast<float>(kWire + kRoadDrop)}, 0.035f, 0.03f, 8);
  mesh_.SetTransform({});
}

}  // namespace airsim360::internal
