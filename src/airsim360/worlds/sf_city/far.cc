// What lies around the streets that can be reached: far houses over the hills, towers in the south, the bay, its other shore.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360::internal {
namespace {

constexpr float kStreet = 12.5f, kCity = 1900;

// Walls with pictured windows in the colours of the houses.
std::vector<MaterialId> AddFarWalls(District& d) {
  static constexpr Vec3f kTones[] = {{1.25f, 1.2f, 1.08f}, {1.2f, 0.98f, 0.85f}, {0.95f, 1.08f, 1.2f},
                                     {1.1f, 1.12f, 0.95f}, {1.3f, 1.28f, 1.24f}, {1.12f, 0.9f, 0.8f}};
  std::vector<MaterialId> walls;
  for (size_t i = 0; i < std::size(kTones); ++i) {
    Material material = d.builder.material(d.surfaces[i % 2 ? Surface::kFarWalls1 : Surface::kFarWalls3]);
    material.name = "far house " + std::to_string(i);
    material.base_color = kTones[i] * 0.75f;
    walls.push_back(d.builder.AddMaterial(std::move(material)));
  }
  return walls;
}

class FarBuilder {
 public:
  FarBuilder(District& d, Ground& far, const Hills& hills) : d_(d), far_(far), hills_(hills), walls_(AddFarWalls(d)) {}

  // Beyond the ring: blocks to 900 m with buildings that are entities, then boxes alone.
  void BuildCity(const GroundRect& ring) {
    // The grid goes on from the ring's edges.
    const float pitch_x = ring.width() / 8, pitch_y = ring.depth() / 8;
    for (int j = -18; j <= 12; ++j) {
      for (int i = -12; i <= 10; ++i) {
        const GroundRect block{
            ring.x0 + pitch_x * static_cast<float>(i) + kStreet / 2, ring.y0 + pitch_y * static_cast<float>(j) + kStreet / 2,
            ring.x0 + pitch_x * static_cast<float>(i + 1) - kStreet / 2, ring.y0 + pitch_y * static_cast<float>(j + 1) - kStreet / 2};
        const bool clear = block.x1 < ring.x0 || block.x0 > ring.x1 || block.y1 < ring.y0 || block.y0 > ring.y1;
        const Vec2f c = block.center();
        if (!clear || std::hypot(c.x, c.y) > kCity || block.x1 > 640 || block.y1 > 566) continue;
        BuildBlock(block, static_cast<uint64_t>((j + 64) * 256 + i + 64));
      }
    }
  }

 private:
  void BuildBlock(const GroundRect& block, uint64_t id) {
    RngStream rng(d_.seed, "far sf block", id);
    const Vec2f c = block.center();
    const float r = std::hypot(c.x, c.y);
    if (r < 1000) {
      d_.ground.Begin("far block", "ground/sidewalk", Surface::kSlabs);
      d_.ground.Rect(block, -0.02f);
    }
    const float towers = c.x > -100 ? std::exp(-((c.x - 150) * (c.x - 150) + (c.y + 420) * (c.y + 420)) / (2 * 260.0f * 260.0f)) : 0;
    const EntityId shared = r >= 1000 ? d_.builder.AddEntity("far houses", d_.builder.tree().At("construction/building")) : kNoEntity;
    for (int row = 0; row < 2; ++row) {
      float x = block.x0 + 4;
      while (x < block.x1 - 8) {
        const bool tall = rng.Uniform() < 1.3 * towers;
        const float w = std::min(tall ? static_cast<float>(rng.Uniform(20, 34)) : static_cast<float>(rng.Uniform(7.5, r < 1000 ? 14 : 26)),
                                 block.x1 - 4 - x);
        const float depth = tall ? 28 : static_cast<float>(rng.Uniform(14, 19));
        const GroundRect lot =
            row == 0 ? GroundRect{x, block.y0 + 4, x + w, block.y0 + 4 + depth} : GroundRect{x, block.y1 - 4 - depth, x + w, block.y1 - 4};
        x += w;
        if (w < 5 || rng.Chance(0.03)) continue;
        const float height = tall ? std::clamp(static_cast<float>(22 + 90 * towers * rng.Uniform()), 18.0f, 120.0f)
                                  : static_cast<float>(rng.Uniform(7.5, 12.5) + (rng.Chance(0.06) ? 9 : 0));
        Box(lot, height, tall, shared, rng);
      }
    }
    // Gardens between the rows, seen as crowns.
    if (r > 1000) return;
    for (float x = block.x0 + 10; x < block.x1 - 8; x += static_cast<float>(rng.Uniform(12, 26))) {
      if (towers > 0.3f) break;
      d_.placer.Put(rng.Chance(0.7) ? "tree_generic" : "tree_pine", {x, c.y + static_cast<float>(rng.Uniform(-8, 8)), -0.1f},
                    static_cast<float>(rng.Uniform(0, kTauF)), static_cast<float>(rng.Uniform(0.7, 1.0)));
    }
  }

  void Box(const GroundRect& r, float height, bool tall, EntityId shared, RngStream& rng) {
    float low = 1e9f, high = -1e9f;
    std::vector<Vec2f> outline;
    for (Vec2f p : r.Outline()) {
      const Vec3f at = hills_.drape().At({p.x, p.y, 0});
      low = std::min(low, at.z);
      high = std::max(high, at.z);
      outline.push_back({at.x, at.y});
    }
    static constexpr Surface kTall[] = {Surface::kFarPiers0, Surface::kFarRibbons0, Surface::kFarRibbons1,
                                        Surface::kFarPiers1, Surface::kGlassBlue,   Surface::kFarWalls2};
    const EntityId walls =
        shared != kNoEntity ? shared : d_.builder.AddEntity("far building", d_.builder.tree().At("construction/building"));
    const EntityId roof =
        shared != kNoEntity ? shared : d_.builder.AddEntity("far roof", d_.builder.tree().At("construction/building/roof"));
    MeshBuilder& mesh = far_.mesh();
    mesh.SetEntity(walls);
    mesh.SetMaterial(tall ? d_.surfaces[kTall[rng.Index(6)]] : walls_[rng.Index(static_cast<uint32_t>(walls_.size()))]);
    mesh.Walls(outline, low - 0.5f, high + height);
    mesh.SetEntity(roof);
    mesh.SetMaterial(d_.surfaces[rng.Chance(0.2) && !tall ? Surface::kRoofSlate : Surface::kFarRoof]);
    mesh.Polygon(outline, high + height);
    if (!tall || rng.Chance(0.3)) return;
    const std::vector<Vec2f> hut = OffsetConvex(outline, std::min(r.width(), r.depth()) * 0.3f);
    mesh.SetEntity(walls);
    mesh.SetMaterial(d_.surfaces[Surface::kFarWalls2]);
    mesh.Walls(hut, high + height, high + height + 4);
    mesh.SetEntity(roof);
    mesh.SetMaterial(d_.surfaces[Surface::kFarRoof]);
    mesh.Polygon(hut, high + height + 4);
  }

  District& d_;
  Ground& far_;
  const Hills& hills_;
  std::vector<MaterialId> walls_;
};

// A suspension bridge of red steel over the narrows: two towers, a deck, cables with hangers.
void BuildGate(District& d, Ground& far) {
  Material red;
  red.name = "bridge orange";
  red.base_color = {0.36f, 0.075f, 0.035f};
  red.roughness = 0.5f;
  const MaterialId paint = d.builder.AddMaterial(red);
  MeshBuilder& mesh = far.mesh();
  mesh.SetEntity(d.builder.AddEntity("far bridge", d.builder.tree().At("construction/bridge")));
  mesh.SetMaterial(paint);
  // Along +y from the northern shore in the west; 2.1 km.
  constexpr float kX = -1350, kY0 = 620, kSpan = 1280, kDeck = 67, kTower = 227;
  const auto tower = [&](float y) {
    for (float x : {kX - 14, kX + 14}) {
      float half = 6;
      for (float z : {0.0f, 80.0f, 150.0f}) {
        mesh.Box({x - half, y - half - 2, z - 3}, {x + half, y + half + 2, z == 150.0f ? kTower : z + 80}, MeshBuilder::kAllSides);
        half -= 1;
      }
    }
    for (float z : {50.0f, 110.0f, 150.0f, 188.0f, 218.0f}) mesh.Box({kX - 12, y - 4, z}, {kX + 12, y + 4, z + 9});
  };
  const float t0 = kY0 + 340, t1 = t0 + kSpan;
  tower(t0);
  tower(t1);
  mesh.Box({kX - 14, kY0 - 200, kDeck}, {kX + 14, t1 + 600, kDeck + 7});
  for (float x : {kX - 14, kX + 14}) {
    const auto cable = [&](float y) {
      if (y < t0) return kDeck + 8 + (kTower - kDeck - 8) * std::clamp((y - (t0 - 345)) / 345, 0.0f, 1.0f);
      if (y > t1) return kDeck + 8 + (kTower - kDeck - 8) * std::clamp((t1 + 345 - y) / 345, 0.0f, 1.0f);
      const float t = 2 * (y - t0) / kSpan - 1;
      return kDeck + 10 + (kTower - kDeck - 10) * t * t;
    };
    for (float y = t0 - 345; y < t1 + 344; y += 23) {
      mesh.Tube({x, y, cable(y)}, {x, y + 23, cable(y + 23)}, 0.9f, 0.9f, 6, false, false);
      mesh.Tube({x, y, kDeck + 6}, {x, y, cable(y)}, 0.25f, 0.25f, 4, false, false);
    }
  }
}

}  // namespace

void BuildFarSf(District& d, Ground& far, const Hills& hills) {
  const GroundRect ring{d.plan.north_south.front().center - 6.2f, d.plan.east_west.front().center - 6.2f,
                        d.plan.north_south.back().center + 6.2f, d.plan.east_west.back().center + 6.2f};
  FarBuilder(d, far, hills).BuildCity(ring);
  // Streets between the far blocks; land with woods to the horizon.
  const GroundRect streets{-1000, -1000, 640, 560}, world{-kWorldEdge, -kWorldEdge, kWorldEdge, kWorldEdge};
  const auto sheets = [&](const GroundRect& hole, const GroundRect& all, float z) {
    for (const GroundRect& sheet : {GroundRect{all.x0, all.y0, all.x1, hole.y0},
                                    {all.x0, hole.y1, all.x1, all.y1},
                                    {all.x0, hole.y0, hole.x0, hole.y1},
                                    {hole.x1, hole.y0, all.x1, hole.y1}})
      d.ground.Rect(sheet, z);
  };
  d.ground.Begin("outer streets", "ground/road", Surface::kAsphalt);
  sheets(ring, streets, -0.13f);
  d.ground.Begin("far land", "ground/terrain/landscape", Surface::kPlain);
  sheets(streets, world, -0.4f);
  // So close below the streets that nobody can walk there.
  d.ground.Begin("land under the streets", "ground/terrain/landscape", Surface::kSoil);
  d.ground.Rect(streets, -0.9f);
  // The bay.
  far.Begin("bay", "water/lake", Surface::kWater);
  far.Rect({560, -kWorldEdge, kWorldEdge, kWorldEdge}, kBayLevel);
  far.Rect({-kWorldEdge, 480, 560, kWorldEdge}, kBayLevel);
  struct Ridge {
    float radius, from_deg, to_deg, height;
  };
  int index = 40;
  for (const Ridge& r : {Ridge{4300, 10, 62, 260},
                         {5200, 55, 118, 420},
                         {4600, 104, 150, 330},
                         {7400, -30, 60, 620},
                         {8600, 60, 150, 900},
                         {6800, -75, -25, 420},
                         {6200, 200, 300, 520}})
    RaiseRidge(d, index++, r.radius, r.from_deg * kTauF / 360, r.to_deg * kTauF / 360, r.height,
               r.radius > 5000 ? Surface::kMountainFar : Surface::kMountain);
  BuildGate(d, far);
}

}  // namespace airsim360::internal
