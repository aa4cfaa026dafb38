#include "airsim360/worlds/osm/walls/osm_stacking.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr double kTouch = 1;      // metres: gaps below this are no passages but rounding (levels, feet)
constexpr double kBehind = 0.01;  // of a closing wall behind the outline, so that it lies in no gable's plane
constexpr int kMostStacked = 8;

bool InsideAny(const Patches& patches, Vec2d p) {
  return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) { return Inside(patch, p); });
}

template <class Visit>
void EachRing(const Patches& patches, const Visit& visit) {
  for (const Patch& patch : patches) {
    visit(patch.outer);
    for (const Ring& hole : patch.holes) visit(hole);
  }
}

// Where the edge a-b meets the borders of the patches: shares of its length, with 0 and 1.
std::vector<double> CutsOf(Vec2d a, Vec2d b, const Patches& patches) {
  std::vector<double> cuts{0, 1};
  const Vec2d v = b - a;
  EachRing(patches, [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2d c = ring[i] - a, w = ring[(i + 1) % ring.size()] - ring[i];
      const double det = v.x * w.y - v.y * w.x;
      if (std::abs(det) < 1e-12) continue;
      const double s = (c.x * w.y - c.y * w.x) / det, t = (c.x * v.y - c.y * v.x) / det;
      if (s > 0 && s < 1 && t >= 0 && t <= 1) cuts.push_back(s);
    }
  });
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

// Walls from z0 to z1 along what of `edges` lies within `area`, `side` metres behind (or before) the edge.
void WallsWithin(MeshBuilder& mesh, const Patches& edges, const Patches& area, double side, double z0, double z1) {
  EachRing(edges, [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2d a = ring[i], b = ring[(i + 1) % ring.size()], v = b - a;
      const double length = std::hypot(v.x, v.y);
      if (length < 1e-3) continue;
      const Vec2d in{-v.y / length, v.x / length};
      const std::vector<double> cuts = CutsOf(a, b, area);
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        if (!InsideAny(area, a + v * ((cuts[k] + cuts[k + 1]) / 2) + in * side)) continue;
        const Vec2f p = ToFloat(a + v * cuts[k] + in * kBehind), q = ToFloat(a + v * cuts[k + 1] + in * kBehind);
        const auto low = static_cast<float>(z0), high = static_cast<float>(z1);
        const auto u0 = static_cast<float>(cuts[k] * length), u1 = static_cast<float>(cuts[k + 1] * length);
        mesh.QuadUv({p.x, p.y, low}, {q.x, q.y, low}, {q.x, q.y, high}, {p.x, p.y, high}, {u0, -low}, {u1, -low}, {u1, -high}, {u0, -high});
      }
    }
  });
}

double GroundUnder(const OsmScene& scene, const Neighbours& near, const OsmVolume& volume, int depth) {
  double ground = 1e18;
  if (depth < kMostStacked)
    for (const OsmVolume* below : SupportsOf(near, volume)) ground = std::min(ground, GroundUnder(scene, near, *below, depth + 1));
  if (ground < 1e17) return ground;
  for (Vec2d p : volume.footprint[0].outer) ground = std::min(ground, scene.relief.At(p));
  return ground;
}

}  // namespace

double LowestRoof(const OsmVolume& volume) {
  if (volume.roof != OsmRoof::kFlat && volume.roof_height >= 0.05) return volume.top - volume.roof_height;
  const double height = volume.top - volume.bottom;
  const bool rim = height > 3.4 && Area(volume.footprint) > 25;
  return volume.top - (rim ? std::min(0.95, height * 0.1) : 0);
}

std::vector<const OsmVolume*> SupportsOf(const Neighbours& near, const OsmVolume& volume) {
  std::vector<const OsmVolume*> supports;
  if (volume.bottom < 0.05 || volume.canopy) return supports;
  Bounds2d box;
  for (const Patch& patch : volume.footprint)
    for (Vec2d p : patch.outer) box.Add(p);
  for (uint32_t i : near.boxes.Find(box)) {
    const OsmVolume& below = *near.volumes[i].volume;
    if (&below == &volume || below.canopy || below.bottom > volume.bottom - 0.05) continue;
    if (volume.bottom > below.top + kTouch) continue;
    if (!Intersect(volume.footprint, below.footprint).empty()) supports.push_back(&below);
  }
  return supports;
}

double GroundUnder(const OsmScene& scene, const Neighbours& near, const OsmVolume& volume) {
  return GroundUnder(scene, near, volume, scene.relief.flat() ? kMostStacked : 0);
}

void CloseOnSupports(MeshBuilder& mesh, const Neighbours& near, const OsmVolume& volume, double ground, MaterialId wall, EntityId entity) {
  for (const OsmVolume* below : SupportsOf(near, volume)) {
    const double low = LowestRoof(*below);
    if (volume.bottom < low + 0.01) continue;
    mesh.SetTransform({});
    mesh.SetEntity(entity);
    mesh.SetMaterial(wall);
    // A little into what lies below.
    const double z0 = ground + std::max(low - 0.02, below->bottom), z1 = ground + volume.bottom;
    WallsWithin(mesh, volume.footprint, below->footprint, 0.05, z0, z1);
    // What stands out under a wider volume: its own borders, between its roof and the floor over it.
    WallsWithin(mesh, below->footprint, volume.footprint, -0.05, z0, z1);
  }
}

}  // namespace airsim360::internal
