// What lies around the extract of a map.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/line_index.h"
#include "airsim360/worlds/osm/osm_ground_builder.h"

namespace airsim360::internal {
namespace {

constexpr double kUnderlay = 0.6;

// How much of the ground's relief is left `d` metres outside the map: it fades to the plain.
double Fade(double d) { return std::clamp((3000 - d) / 2700, 0.0, 1.0); }

// Frames of quads around the map between two distances; the inner and outer border match in places and heights.
void LayFrame(OsmScene& scene, MeshBuilder& mesh, double inner, double outer, int parts) {
  const OsmBox& e = scene.data.extent;
  const auto corner = [&](double d, size_t i) {
    return Vec2d{i == 0 || i == 3 ? e.x0 - d : e.x1 + d, i < 2 ? e.y0 - d : e.y1 + d};
  };
  const auto at = [&](Vec2d p, double d) {
    return scene.relief.flat() ? scene.On(p, -0.02) : Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(scene.relief.At(p) * Fade(d) - 0.02)};
  };
  for (size_t i = 0; i < 4; ++i) {
    const size_t k = (i + 1) % 4;
    for (int n = 0; n < parts; ++n) {
      const double s = static_cast<double>(n) / parts, t = static_cast<double>(n + 1) / parts;
      const Vec2d a = corner(inner, i) + (corner(inner, k) - corner(inner, i)) * s, b = corner(inner, i) + (corner(inner, k) - corner(inner, i)) * t;
      const Vec2d c = corner(outer, i) + (corner(outer, k) - corner(outer, i)) * t, d = corner(outer, i) + (corner(outer, k) - corner(outer, i)) * s;
      mesh.QuadUv(at(d, outer), at(c, outer), at(b, inner), at(a, inner), PlainUv(d), PlainUv(c), PlainUv(b), PlainUv(a));
    }
  }
}

}  // namespace

void LayCountry(OsmScene& scene, GroundBuilder& ground, bool paved) {
  const OsmBox& e = scene.data.extent;
  SemanticTree& tree = scene.builder.tree();
  MeshBuilder& mesh = ground.mesh();
  mesh.SetEntity(scene.builder.AddEntity("country", tree.At("ground/terrain/landscape")));
  mesh.SetMaterial(scene.surfaces[paved ? Surface::kFarRoof : Surface::kPlain]);
  double inner = kClip;
  if (scene.relief.flat()) {
    for (double outer : {90.0, 300.0, 900.0, 2500.0, 7000.0, 16000.0}) {
      if (outer > 1000) mesh.SetMaterial(scene.surfaces[Surface::kPlain]);
      LayFrame(scene, mesh, inner, outer, 1);
      inner = outer;
    }
  } else {
    // On the ground itself to 90 m, then in frames that widen, as fine along as across.
    const auto box = [&](double d) { return Ring{{e.x0 - d, e.y0 - d}, {e.x1 + d, e.y0 - d}, {e.x1 + d, e.y1 + d}, {e.x0 - d, e.y1 + d}}; };
    ground.Cover(Subtract(Patches{{box(90), {}}}, Patches{{box(kClip), {}}}), -0.02, PlainUv);
    inner = 84;
    const double side = std::max(e.width(), e.depth()) + 180;
    for (double outer = 110; inner < 16000; outer = std::min(outer * 1.25, 16000.0)) {
      if (outer > 1000) mesh.SetMaterial(scene.surfaces[Surface::kPlain]);
      LayFrame(scene, mesh, inner, outer, std::clamp(static_cast<int>(side / 25), 1, 400));
      inner = outer;
    }
  }
  mesh.SetEntity(scene.builder.AddEntity("subsoil", tree.At("ground/dirt")));
  mesh.SetMaterial(scene.surfaces[Surface::kSoil]);
  ground.Cover(ground.clip(), -kUnderlay, PlainUv);
}

void RaiseBackdrop(OsmScene& scene, MeshBuilder& mesh, const std::vector<OsmBuilding>& buildings) {
  std::vector<double> heights;
  for (const OsmBuilding& building : buildings)
    if (!building.orphan && building.height > 3) heights.push_back(building.height);
  if (heights.size() < 20) return;
  std::sort(heights.begin(), heights.end());
  const OsmBox& e = scene.data.extent;
  SemanticTree& tree = scene.builder.tree();
  const CategoryId category = tree.At("construction/building/backdrop");
  // Mapped houses that stand outside the extract keep their ground.
  LineIndex mapped;
  for (const OsmBuilding& building : buildings)
    for (const Patch& patch : building.outline) mapped.AddRing(patch.outer, 0);
  constexpr double kReach = 1300, kPitchX = 78, kPitchY = 52, kStreet = 14;
  static constexpr Surface kWalls[] = {Surface::kFarWalls0, Surface::kFarWalls1, Surface::kFarWalls0, Surface::kFarWalls2};
  RngStream rng(scene.options.seed, "backdrop");
  for (double y = e.y0 - kReach; y < e.y1 + kReach; y += kPitchY) {
    for (double x = e.x0 - kReach; x < e.x1 + kReach; x += kPitchX) {
      const double out = std::max({e.x0 - kClip - x - kPitchX, x - e.x1 - kClip, e.y0 - kClip - y - kPitchY, y - e.y1 - kClip});
      const bool keep = rng.Chance(1.05 - out / kReach);
      if (out < 4 || out > kReach || !keep) continue;
      EntityId entity = kNoEntity;
      for (int i = 0; i < 4; ++i) {
        // Houses wall to wall along the block, each with its height.
        const double w = (kPitchX - kStreet) / 4, x0 = x + w * i, depth = kPitchY - kStreet - rng.Uniform(0, 12);
        const double h = heights[rng.Index(static_cast<uint32_t>(heights.size() * 97 / 100) + 1)];
        const Surface wall = kWalls[rng.Index(4)];
        if (mapped.Find({x0 + w / 2, y + depth / 2}, 30).owner != UINT32_MAX) continue;
        if (entity == kNoEntity) entity = scene.builder.AddEntity("backdrop block", category);
        const double z = scene.relief.At({x0, y}) * Fade(out + kClip);
        const std::vector<Vec2f> outline{ToFloat({x0, y}), ToFloat({x0 + w, y}), ToFloat({x0 + w, y + depth}), ToFloat({x0, y + depth})};
        mesh.SetTransform({});
        mesh.SetEntity(entity);
        mesh.SetMaterial(scene.surfaces[wall]);
        mesh.Walls(outline, static_cast<float>(z - 4), static_cast<float>(z + h));
        mesh.SetMaterial(scene.surfaces[Surface::kFarRoof]);
        mesh.Polygon(outline, static_cast<float>(z + h));
      }
    }
  }
}

}  // namespace airsim360::internal
