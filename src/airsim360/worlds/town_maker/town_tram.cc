// Tram lines: grooved rails in the main streets, contact wires over them, spans to the houses, a car now and then.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "airsim360/worlds/osm/osm_ground_builder.h"
#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
namespace {

constexpr double kGauge = 0.9, kWire = 5.7;  // metres: Lisbon's gauge; height of the contact wire

// The car from above, one corner after the other: straight sides, ends that narrow past the doors to a flat front.
constexpr Vec2f kOutline[] = {{1.15f, -2.75f}, {1.15f, 2.75f},   {0.86f, 3.75f},   {0.42f, 4.15f},   {-0.42f, 4.15f}, {-0.86f, 3.75f},
                              {-1.15f, 2.75f}, {-1.15f, -2.75f}, {-0.86f, -3.75f}, {-0.42f, -4.15f}, {0.42f, -4.15f}, {0.86f, -3.75f}};
constexpr size_t kCorners = std::size(kOutline);
bool IsDoor(size_t side) { return side == 1 || side == 5 || side == 7 || side == 11; }

Vec3f Corner(size_t i, float inset, float z) {
  const Vec2f p = kOutline[i % kCorners];
  const float shrink = 1 - inset / 1.15f;
  return {p.x * shrink, p.y * (1 - inset / 4.15f), z};
}

// All around or, with `doors`, along the doors alone or the rest alone.
void Band(MeshBuilder& mesh, float low, float high, float inset, std::optional<bool> doors = std::nullopt) {
  for (size_t i = 0; i < kCorners; ++i) {
    if (doors && IsDoor(i) != *doors) continue;
    mesh.Quad(Corner(i, inset, low), Corner(i + 1, inset, low), Corner(i + 1, inset, high), Corner(i, inset, high));
  }
}

// A vertical bar `width` wide at share `t` of side `i`, proud of the glass.
void Post(MeshBuilder& mesh, size_t i, float t, float width, float low, float high) {
  const Vec3f a = Corner(i, 0, low), b = Corner(i + 1, 0, low), along = b - a;
  const float half = 0.5f * width / Norm(along), from = std::max(0.0f, t - half), to = std::min(1.0f, t + half);
  const Vec3f rise{0, 0, high - low}, p = a + along * from, q = a + along * to;
  mesh.Quad(p, q, q + rise, p + rise);
}

// A vaulted roof with a clerestory, from the eaves of the letter board.
void Roof(MeshBuilder& mesh) {
  constexpr float kInsets[] = {-0.05f, 0.08f, 0.30f, 0.62f}, kHeights[] = {2.78f, 2.90f, 3.00f, 3.05f};
  for (size_t k = 0; k + 1 < std::size(kInsets); ++k)
    for (size_t i = 0; i < kCorners; ++i)
      mesh.Quad(Corner(i, kInsets[k], kHeights[k]), Corner(i + 1, kInsets[k], kHeights[k]), Corner(i + 1, kInsets[k + 1], kHeights[k + 1]),
                Corner(i, kInsets[k + 1], kHeights[k + 1]));
  mesh.Box({-0.55f, -2.9f, 3.0f}, {0.55f, 2.9f, 3.2f});
}

// Frame, wheels, fenders and lamps, which are below and before the car.
void Underside(const OsmScene& scene, MeshBuilder& mesh) {
  mesh.SetMaterial(scene.surfaces[Surface::kFrameDark]);
  mesh.Box({-0.8f, -2.2f, 0.22f}, {0.8f, 2.2f, 0.55f});
  for (const float y : {-1.35f, 1.35f}) {
    for (const float x : {-0.52f, 0.4f}) mesh.Tube({x, y, 0.34f}, {x + 0.12f, y, 0.34f}, 0.34f, 0.34f, 20);
    for (const float x : {-0.86f, 0.78f}) mesh.Box({x, y - 0.55f, 0.30f}, {x + 0.08f, y + 0.55f, 0.42f});
  }
  for (const float end : {-1.0f, 1.0f}) {
    mesh.Box({-0.75f, end * 4.1f - 0.05f, 0.14f}, {0.75f, end * 4.1f + 0.05f, 0.40f});
    mesh.Box({-0.5f, end * 4.2f - 0.06f, 0.60f}, {0.5f, end * 4.2f + 0.06f, 0.74f});
  }
  mesh.SetMaterial(scene.surfaces[Surface::kIron]);
  for (const float end : {-1.0f, 1.0f}) mesh.Tube({0, end * 4.1f, 1.12f}, {0, end * 4.23f, 1.12f}, 0.15f, 0.13f, 16);
  mesh.SetMaterial(scene.surfaces[Surface::kPanelWhite]);
  for (const float end : {-1.0f, 1.0f}) mesh.Tube({0, end * 4.2f, 1.12f}, {0, end * 4.235f, 1.12f}, 0.11f, 0.11f, 16);
}

void CarBody(OsmScene& scene, MeshBuilder& mesh) {
  const auto& surfaces = scene.surfaces;
  const MaterialId yellow = scene.tints.Get(surfaces[Surface::kPanelWhite], {0.60f, 0.36f, 0.03f}, 0.6f);
  const MaterialId cream = scene.tints.Get(surfaces[Surface::kPanelWhite], {0.62f, 0.58f, 0.47f}, 0.6f);
  const MaterialId gray = scene.tints.Get(surfaces[Surface::kPanelWhite], {0.30f, 0.29f, 0.27f}, 0.8f);
  Underside(scene, mesh);
  mesh.SetMaterial(yellow);
  Band(mesh, 0.50f, 1.46f, 0, false);
  Band(mesh, 0.62f, 1.05f, 0.03f, true);  // door leaves
  mesh.SetMaterial(surfaces[Surface::kFrameDark]);
  Band(mesh, 0.42f, 0.62f, 0.02f, true);  // steps
  Band(mesh, 1.46f, 1.49f, -0.012f, false);
  Band(mesh, 2.47f, 2.50f, -0.008f);
  for (const float end : {-1.0f, 1.0f}) mesh.Box({-0.4f, end * 4.16f - 0.02f, 2.53f}, {0.4f, end * 4.16f + 0.02f, 2.73f});
  mesh.SetMaterial(cream);
  Band(mesh, 1.49f, 1.56f, 0, false);
  Band(mesh, 2.40f, 2.78f, 0);
  for (size_t i = 0; i < kCorners; ++i) {
    const bool side = i == 0 || i == 6;
    const int panes = side ? 6 : 1;
    for (int k = 0; k <= panes; ++k)
      Post(mesh, i, static_cast<float>(k) / static_cast<float>(panes), 0.09f, IsDoor(i) ? 1.05f : 1.56f, 2.40f);
    // Sash rails: the upper third of the windows slides.
    if (side) mesh.Quad(Corner(i, 0.004f, 2.05f), Corner(i + 1, 0.004f, 2.05f), Corner(i + 1, 0.004f, 2.09f), Corner(i, 0.004f, 2.09f));
  }
  mesh.SetMaterial(surfaces[Surface::kGlassDark]);
  Band(mesh, 1.56f, 2.40f, 0.03f, false);
  Band(mesh, 1.05f, 2.40f, 0.035f, true);
  mesh.SetMaterial(gray);
  Roof(mesh);
}

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
  CarBody(scene_, mesh_);
  mesh_.Tube({0, 0.4f, 3.2f}, {0, 3.0f, static_cast<float>(kWire + kRoadDrop)}, 0.035f, 0.03f, 8);
  mesh_.SetTransform({});
}

}  // namespace airsim360::internal
