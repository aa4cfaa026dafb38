// The terrace on a roof: deck, parapet, pergola, tables, beds of plants, machines, water tanks, the house of the stairs.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
namespace {

constexpr double kTau = 6.283185307;

}  // namespace

// `front` of the spot holds half the length and half the width of the roof, `size` its height.
void TownFinisher::RoofTerrace(const TownSpot& spot) {
  const auto hx = static_cast<float>(spot.front.x), hy = static_cast<float>(spot.front.y), z = static_cast<float>(spot.size) + 0.2f;
  const Vec3f c = At(spot.p, 0);
  const AffineTransform X = PlaceUpright({c.x, c.y, c.z + z});
  SceneBuilder& builder = scene_.builder;
  SemanticTree& tree = builder.tree();
  const auto start = [&](const char* name, const char* category, Surface surface) {
    const EntityId entity = builder.AddEntity(name, tree.Add(category));
    mesh_.SetEntity(entity);
    mesh_.SetMaterial(scene_.surfaces[surface]);
    mesh_.SetTransform(X);
    return entity;
  };
  const auto put = [&](const char* name, const char* kind, double x, double y, double yaw = 0, float scale = 1, double lift = 0) {
    return scene_.Put(name, kind, {c.x + static_cast<float>(x), c.y + static_cast<float>(y), c.z + z + static_cast<float>(lift)}, yaw, scale, rng_.Index(8));
  };
  // Nobody walks about inside the house: a floor at the height of the knee.
  start("terrace house floor", "construction/building/part", Surface::kConcrete);
  mesh_.Box({-hx + 0.4f, -hy + 0.4f, 0.9f - z}, {hx - 0.4f, hy - 0.4f, 1.0f - z});
  // Pavers, a field of boards in the west, gravel around the machines in the north.
  const float north = hy - 13, board = -hx + 24;
  start("terrace pavers", "ground/pavement/modular", Surface::kSlabsWarm);
  const auto field = [&](float x0, float y0, float x1, float y1, float lift) {
    mesh_.QuadUv({x0, y0, lift}, {x1, y0, lift}, {x1, y1, lift}, {x0, y1, lift}, {x0, -y0}, {x1, -y0}, {x1, -y1}, {x0, -y1});
  };
  field(board, -hy, hx, north, 0);
  start("terrace boards", "ground/floor", Surface::kFrameWood);
  field(-hx, -hy, board, north, 0.03f);
  start("roof gravel", "ground/gravel", Surface::kRoofGravel);
  field(-hx, north, hx, hy, 0);
  // A parapet with a railing on it.
  start("parapet", "construction/wall", Surface::kBrickRed);
  const float t = 0.3f, top = 0.75f;
  const auto wall = [&](float x0, float y0, float x1, float y1) { mesh_.Box({x0, y0, -0.6f}, {x1, y1, top}); };
  wall(-hx, -hy, hx, -hy + t);
  wall(-hx, hy - t, hx, hy);
  wall(-hx, -hy + t, -hx + t, hy - t);
  wall(hx - t, -hy + t, hx, hy - t);
  mesh_.SetMaterial(scene_.surfaces[Surface::kCoping]);
  const auto coping = [&](float x0, float y0, float x1, float y1) { mesh_.Box({x0 - 0.05f, y0 - 0.05f, top}, {x1 + 0.05f, y1 + 0.05f, top + 0.08f}); };
  coping(-hx, -hy, hx, -hy + t);
  coping(-hx, hy - t, hx, hy);
  coping(-hx, -hy + t + 0.06f, -hx + t, hy - t - 0.06f);
  coping(hx - t, -hy + t + 0.06f, hx, hy - t - 0.06f);
  start("railing", "barrier/railing/rail", Surface::kIronBlack);
  for (float side : {-1.0f, 1.0f}) {
    for (float h : {0.98f, 1.2f}) {
      mesh_.Beam({-hx + 0.15f, side * (hy - 0.15f), h}, {hx - 0.15f, side * (hy - 0.15f), h}, 0.045f);
      mesh_.Beam({side * (hx - 0.15f), -hy + 0.15f, h}, {side * (hx - 0.15f), hy - 0.15f, h}, 0.045f);
    }
    for (float x = -hx + 0.15f; x <= hx - 0.1f; x += 1.9f) mesh_.Beam({x, side * (hy - 0.15f), top}, {x, side * (hy - 0.15f), 1.2f}, 0.04f);
    for (float y = -hy + 0.15f; y <= hy - 0.1f; y += 1.9f) mesh_.Beam({side * (hx - 0.15f), y, top}, {side * (hx - 0.15f), y, 1.2f}, 0.04f);
  }
  // The house of stairs and lift, with a door to the terrace.
  start("stair house", "construction/building/part", Surface::kBrickBrown);
  const float bx0 = 4, bx1 = 15, by0 = north + 1.2f, by1 = north + 8.2f;
  mesh_.Box({bx0, by0, -0.1f}, {bx1, by1, 3.6f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kCoping]);
  mesh_.Box({bx0 - 0.15f, by0 - 0.15f, 3.6f}, {bx1 + 0.15f, by1 + 0.15f, 3.82f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameDark]);
  mesh_.Box({7.2f, by0 - 0.06f, 0}, {9.4f, by0, 2.4f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kGlassLit]);
  for (float x : {7.35f, 8.4f}) mesh_.Box({x, by0 - 0.075f, 0.25f}, {x + 0.85f, by0 - 0.05f, 2.25f});
  mesh_.Box({10.6f, by0 - 0.04f, 1.0f}, {13.6f, by0, 2.3f});
  // Machines behind a screen, tanks on legs, vents, antennas.
  for (double x = -hx + 4; x < 0; x += 4.2) put("air conditioner", "ac_unit", x, north + 5, kTau / 4 * rng_.Index(4), 1.3f);
  for (double x = -hx + 5; x < hx - 4; x += 5.5)
    if (x < 2 || x > 17) put("roof vent", "roof_vent", x, north + 9.5 + rng_.Uniform(-0.6, 0.6), rng_.Uniform(0, kTau));
  for (double x : {19.0, 25.5})
    if (x < spot.front.x - 3) put("water tank", "water_tank", x, north + 7.2, 0);
  put("antenna", "antenna", 11, by1 - 1.2, 0, 1, 3.82);
  put("antenna", "antenna", -hx + 3, hy - 2.5, 0);
  start("ducts", "construction/rooftop/ventilation_tube", Surface::kMetal);
  mesh_.Box({-hx + 3, north + 6.6f, 0.35f}, {1.5f, north + 7.3f, 0.95f});
  for (float x = -hx + 4; x < 1; x += 4.2f) mesh_.Box({x - 0.25f, north + 6.0f, 0.5f}, {x + 0.25f, north + 6.7f, 0.85f});
  start("screen", "barrier/fence", Surface::kFrameWood);
  for (float x = -hx + 1; x < 2.5f; x += 0.16f) mesh_.Box({x, north + 0.2f, 0.05f}, {x + 0.1f, north + 0.26f, 1.9f});
  // Beds of shrubs along the edges, small trees in pots.
  const auto bed = [&](float x0, float y0, float x1, float y1) {
    start("planting bed", "furniture/planter/pot", Surface::kFrameWood);
    mesh_.Box({x0, y0, 0}, {x1, y1, 0.55f});
    mesh_.SetMaterial(scene_.surfaces[Surface::kSoil]);
    field(x0 + 0.08f, y0 + 0.08f, x1 - 0.08f, y1 - 0.08f, 0.56f);
    const bool along_x = x1 - x0 > y1 - y0;
    const int count = std::max(2, static_cast<int>(std::max(x1 - x0, y1 - y0) / 1.1f));
    for (int i = 0; i < count; ++i) {
      const float s = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
      const double x = along_x ? x0 + (x1 - x0) * s : (x0 + x1) / 2, y = along_x ? (y0 + y1) / 2 : y0 + (y1 - y0) * s;
      static constexpr const char* kPlants[] = {"shrub", "plant", "plant", "flower_bed"};
      const char* kind = kPlants[rng_.Index(4)];
      put(kind, kind, x, y, rng_.Uniform(0, kTau), kind[0] == 's' ? 0.5f : 0.8f, 0.52);
    }
  };
  for (float x = -hx + 3; x < hx - 8; x += 9.5f) bed(x, -hy + 0.7f, x + 6.5f, -hy + 1.9f);
  for (float y = -hy + 6; y < north - 8; y += 10) {
    bed(-hx + 0.7f, y, -hx + 1.9f, y + 6.5f);
    bed(hx - 1.9f, y, hx - 0.7f, y + 6.5f);
  }
  for (double x : {-8.0, -2.0, 18.0, 24.0})
    if (x < spot.front.x - 2) put("potted tree", "green_pot", x, north - 1.2, 0, 1.5f);
  for (int i = 0; i < 10; ++i) put("pot", i % 2 ? "pot" : "planter", -hx + 2.8 + 2.2 * i, -hy + 2.9, 0);
  // A pergola over long tables in the west.
  start("pergola", "furniture/shade/tarp_post", Surface::kFrameWood);
  const float px0 = -hx + 4, px1 = -hx + 14, py0 = -hy + 6, py1 = -hy + 13;
  for (float x : {px0, (px0 + px1) / 2, px1})
    for (float y : {py0, py1}) mesh_.Beam({x, y, 0}, {x, y, 2.6f}, 0.16f);
  for (float y : {py0, py1}) mesh_.Beam({px0 - 0.4f, y, 2.66f}, {px1 + 0.4f, y, 2.66f}, 0.16f);
  for (float x = px0 - 0.2f; x <= px1 + 0.2f; x += 0.55f) mesh_.Beam({x, py0 - 0.5f, 2.8f}, {x, py1 + 0.5f, 2.8f}, 0.09f);
  for (double x : {px0 + 2.5, px0 + 7.5})
    for (double y : {py0 + 2.2, py0 + 5.0}) put("long table", "picnic_table", x, y, 0, 1, 0.03);
  // Café sets under sunshades in the south-east, benches along the beds; the middle stays free.
  for (double x = 2; x < spot.front.x - 5; x += 4.2)
    for (double y : {-spot.front.y + 5.0, -spot.front.y + 9.0}) {
      const uint32_t variant = rng_.Index(8);
      const auto at = [&](double dx, double dy) { return Vec3f{c.x + static_cast<float>(x + dx), c.y + static_cast<float>(y + dy), c.z + z}; };
      scene_.Put("terrace table", "dining_table", at(0, 0), 0, 1, variant);
      for (int k = 0; k < 4; ++k) {
        const double a = kTau * k / 4 + 0.3;
        scene_.Put("terrace chair", "dining_chair", at(0.8 * std::cos(a), 0.8 * std::sin(a)), static_cast<double>(FacingYaw({static_cast<float>(-std::cos(a)), static_cast<float>(-std::sin(a))})), 1, variant);
      }
      scene_.Put("sunshade", "umbrella", at(0.2, 0.2), 0, 1, rng_.Index(6));
    }
  // A small tree in a square box, benches on its four sides.
  const auto grove = [&](float x, float y) {
    bed(x - 1, y - 1, x + 1, y + 1);
    put("terrace tree", rng_.Chance(0.5) ? "tree_narrowleaf" : "tree_generic", x, y, rng_.Uniform(0, kTau), static_cast<float>(rng_.Uniform(0.3, 0.42)), 0.5);
    for (int k = 0; k < 4; ++k) {
      const double a = kTau / 4 * k;
      put("bench", "bench_wood", x + 1.5 * std::cos(a), y + 1.5 * std::sin(a), static_cast<double>(FacingYaw({static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))})));
    }
  };
  for (float x = board + 4; x < hx - 4; x += 11) grove(x, -hy + 15);
  for (float x : {-10.0f, 4.0f}) grove(x, -1);
  for (float y = -hy + 21; y < north - 5; y += 8) grove(hx - 7, y);
  // Deck chairs under sunshades in the east.
  for (float y = -hy + 19; y < north - 7; y += 4)
    for (double x : {spot.front.x - 14.0, spot.front.x - 11.5}) {
      put("deck chair", "dining_chair", x, y, kTau / 4);
      put("side table", "street_table", x + 0.9, y, 0, 0.8f);
    }
  // Islands of plants with benches; 45 x 20 m between them stay free.
  for (float x = board + 2; x < hx - 9; x += 12) {
    bed(x, north - 5.4f, x + 4.2f, north - 3.6f);
    put("bench", "bench_wood", x + 2.1, north - 6.2, 0);
    put("potted tree", "green_pot", x + 6.2, north - 4.4, 0, 1.7f);
  }
  for (float y = -hy + 17; y < north - 8; y += 8) {
    bed(-hx + 5, y, -hx + 9, y + 1.4f);
    put("bench", "bench_wood", -hx + 7, y - 0.7, 0, 1, 0.03);
    put("bench", "bench_wood", -hx + 7, y + 2.1, kTau / 2, 1, 0.03);
  }
  for (float y = -hy + 8; y < north - 6; y += 10) {
    put("bench", "bench_wood", -hx + 2.6, y, kTau / 4, 1, 0.03);
    put("bench", "bench_wood", hx - 2.6, y, -kTau / 4);
  }
  for (double x = -spot.front.x + 6; x < spot.front.x - 3; x += 11) {
    put("lamp", "bollard_lamp", x, -spot.front.y + 3.4);
    put("lamp", "bollard_lamp", x, static_cast<double>(north) - 2.4);
  }
  mesh_.SetTransform({});
  // The world begins on the terrace, where people stand.
  builder.SetSpawn({c.x + 4, c.y - hy + 13.5f, c.z + z + 1.7f}, 150);
}

}  // namespace airsim360::internal
