// The terrace on a roof: deck, parapet, pergola, tables, beds of plants, machines, water tanks, the house of the stairs.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
namespace {

/// Builds on a deck of 2 hx by 2 hy metres. X runs east, Y north, both from the middle of the deck; z from the deck.
class TerraceBuilder {
 public:
  TerraceBuilder(OsmScene& scene, MeshBuilder& mesh, RngStream& rng, Vec3f middle, Vec2d half)
      : scene_(scene),
        mesh_(mesh),
        rng_(rng),
        c_(middle),
        half_(half),
        hx_(static_cast<float>(half.x)),
        hy_(static_cast<float>(half.y)),
        north_(hy_ - 13),
        board_(-hx_ + 24) {}

  void Build(float height) {
    // Nobody walks about inside the house: a floor at the height of the knee.
    Start("terrace house floor", "construction/building/part", Surface::kConcrete);
    mesh_.Box({-hx_ + 0.4f, -hy_ + 0.4f, 0.9f - height}, {hx_ - 0.4f, hy_ - 0.4f, 1.0f - height});
    LayDeck();
    RaiseParapet();
    RaiseRailing();
    RaiseStairHouse();
    PutMachines();
    PutBeds();
    RaisePergola();
    PutCafes();
    PutGroves();
    PutSeats();
    mesh_.SetTransform({});
  }

 private:
  void Start(const char* name, const char* category, Surface surface) {
    SceneBuilder& builder = scene_.builder;
    mesh_.SetEntity(builder.AddEntity(name, builder.tree().Add(category)));
    mesh_.SetMaterial(scene_.surfaces[surface]);
    mesh_.SetTransform(PlaceUpright(c_));
  }

  void Put(const char* name, const char* kind, double x, double y, double yaw = 0, float scale = 1, double lift = 0) {
    scene_.Put(name, kind, {c_.x + static_cast<float>(x), c_.y + static_cast<float>(y), c_.z + static_cast<float>(lift)}, yaw, scale,
               rng_.Index(8));
  }

  void Field(float x0, float y0, float x1, float y1, float lift) {
    mesh_.QuadUv({x0, y0, lift}, {x1, y0, lift}, {x1, y1, lift}, {x0, y1, lift}, {x0, -y0}, {x1, -y0}, {x1, -y1}, {x0, -y1});
  }

  // Pavers, a field of boards in the west, gravel around the machines in the north.
  void LayDeck() {
    Start("terrace pavers", "ground/pavement/modular", Surface::kSlabsWarm);
    Field(board_, -hy_, hx_, north_, 0);
    Start("terrace boards", "ground/floor", Surface::kFrameWood);
    Field(-hx_, -hy_, board_, north_, 0.03f);
    Start("roof gravel", "ground/gravel", Surface::kRoofGravel);
    Field(-hx_, north_, hx_, hy_, 0);
  }

  void RaiseParapet() {
    Start("parapet", "construction/wall", Surface::kBrickRed);
    const float t = 0.3f;
    const auto wall = [&](float x0, float y0, float x1, float y1) { mesh_.Box({x0, y0, -0.6f}, {x1, y1, kParapetTop}); };
    wall(-hx_, -hy_, hx_, -hy_ + t);
    wall(-hx_, hy_ - t, hx_, hy_);
    wall(-hx_, -hy_ + t, -hx_ + t, hy_ - t);
    wall(hx_ - t, -hy_ + t, hx_, hy_ - t);
    mesh_.SetMaterial(scene_.surfaces[Surface::kCoping]);
    const auto coping = [&](float x0, float y0, float x1, float y1) {
      mesh_.Box({x0 - 0.05f, y0 - 0.05f, kParapetTop}, {x1 + 0.05f, y1 + 0.05f, kParapetTop + 0.08f});
    };
    coping(-hx_, -hy_, hx_, -hy_ + t);
    coping(-hx_, hy_ - t, hx_, hy_);
    coping(-hx_, -hy_ + t + 0.06f, -hx_ + t, hy_ - t - 0.06f);
    coping(hx_ - t, -hy_ + t + 0.06f, hx_, hy_ - t - 0.06f);
  }

  // On the parapet.
  void RaiseRailing() {
    Start("railing", "barrier/railing/rail", Surface::kIronBlack);
    for (float side : {-1.0f, 1.0f}) {
      for (float h : {0.98f, 1.2f}) {
        mesh_.Beam({-hx_ + 0.15f, side * (hy_ - 0.15f), h}, {hx_ - 0.15f, side * (hy_ - 0.15f), h}, 0.045f);
        mesh_.Beam({side * (hx_ - 0.15f), -hy_ + 0.15f, h}, {side * (hx_ - 0.15f), hy_ - 0.15f, h}, 0.045f);
      }
      for (float x = -hx_ + 0.15f; x <= hx_ - 0.1f; x += 1.9f)
        mesh_.Beam({x, side * (hy_ - 0.15f), kParapetTop}, {x, side * (hy_ - 0.15f), 1.2f}, 0.04f);
      for (float y = -hy_ + 0.15f; y <= hy_ - 0.1f; y += 1.9f)
        mesh_.Beam({side * (hx_ - 0.15f), y, kParapetTop}, {side * (hx_ - 0.15f), y, 1.2f}, 0.04f);
    }
  }

  // Stairs and lift, with a door to the terrace.
  void RaiseStairHouse() {
    Start("stair house", "construction/building/part", Surface::kBrickBrown);
    const float x0 = 4, x1 = 15, y0 = north_ + 1.2f, y1 = StairHouseBack();
    mesh_.Box({x0, y0, -0.1f}, {x1, y1, 3.6f});
    mesh_.SetMaterial(scene_.surfaces[Surface::kCoping]);
    mesh_.Box({x0 - 0.15f, y0 - 0.15f, 3.6f}, {x1 + 0.15f, y1 + 0.15f, 3.82f});
    mesh_.SetMaterial(scene_.surfaces[Surface::kFrameDark]);
    mesh_.Box({7.2f, y0 - 0.06f, 0}, {9.4f, y0, 2.4f});
    mesh_.SetMaterial(scene_.surfaces[Surface::kGlassLit]);
    for (float x : {7.35f, 8.4f}) mesh_.Box({x, y0 - 0.075f, 0.25f}, {x + 0.85f, y0 - 0.05f, 2.25f});
    mesh_.Box({10.6f, y0 - 0.04f, 1.0f}, {13.6f, y0, 2.3f});
  }

  // Machines behind a screen, tanks on legs, vents, antennas.
  void PutMachines() {
    for (double x = -hx_ + 4; x < 0; x += 4.2) Put("air conditioner", "ac_unit", x, north_ + 5, kTau / 4 * rng_.Index(4), 1.3f);
    for (double x = -hx_ + 5; x < hx_ - 4; x += 5.5)
      if (x < 2 || x > 17) Put("roof vent", "roof_vent", x, north_ + 9.5 + rng_.Uniform(-0.6, 0.6), rng_.Uniform(0, kTau));
    for (double x : {19.0, 25.5})
      if (x < half_.x - 3) Put("water tank", "water_tank", x, north_ + 7.2, 0);
    Put("antenna", "antenna", 11, StairHouseBack() - 1.2, 0, 1, 3.82);
    Put("antenna", "antenna", -hx_ + 3, hy_ - 2.5, 0);
    Start("ducts", "construction/rooftop/ventilation_tube", Surface::kMetal);
    mesh_.Box({-hx_ + 3, north_ + 6.6f, 0.35f}, {1.5f, north_ + 7.3f, 0.95f});
    for (float x = -hx_ + 4; x < 1; x += 4.2f) mesh_.Box({x - 0.25f, north_ + 6.0f, 0.5f}, {x + 0.25f, north_ + 6.7f, 0.85f});
    Start("screen", "barrier/fence", Surface::kFrameWood);
    for (float x = -hx_ + 1; x < 2.5f; x += 0.16f) mesh_.Box({x, north_ + 0.2f, 0.05f}, {x + 0.1f, north_ + 0.26f, 1.9f});
  }

  void PutBed(float x0, float y0, float x1, float y1) {
    Start("planting bed", "furniture/planter/pot", Surface::kFrameWood);
    mesh_.Box({x0, y0, 0}, {x1, y1, 0.55f});
    mesh_.SetMaterial(scene_.surfaces[Surface::kSoil]);
    Field(x0 + 0.08f, y0 + 0.08f, x1 - 0.08f, y1 - 0.08f, 0.56f);
    const bool along_x = x1 - x0 > y1 - y0;
    const int count = std::max(2, static_cast<int>(std::max(x1 - x0, y1 - y0) / 0.5f));
    for (int i = 0; i < count; ++i) {
      // Two rows, each plant beside the gap of the other row.
      const float s = (static_cast<float>(i) + 0.5f) / static_cast<float>(count), t = i % 2 ? 0.32f : 0.68f;
      const double x = x0 + (x1 - x0) * (along_x ? s : t), y = y0 + (y1 - y0) * (along_x ? t : s);
      static constexpr const char* kPlants[] = {"shrub", "plant", "fern", "plant", "flower_bed"};
      const char* kind = kPlants[rng_.Index(5)];
      Put(kind, kind, x, y, rng_.Uniform(0, kTau), kind[0] == 's' ? 0.5f : 0.8f, 0.52);
    }
  }

  // Beds of shrubs along the edges, small trees in pots.
  void PutBeds() {
    for (float x = -hx_ + 3; x < hx_ - 8; x += 9.5f) PutBed(x, -hy_ + 0.7f, x + 6.5f, -hy_ + 1.9f);
    for (float y = -hy_ + 6; y < north_ - 8; y += 10) {
      PutBed(-hx_ + 0.7f, y, -hx_ + 1.9f, y + 6.5f);
      PutBed(hx_ - 1.9f, y, hx_ - 0.7f, y + 6.5f);
    }
    for (double x : {-8.0, -2.0, 18.0, 24.0})
      if (x < half_.x - 2) Put("potted tree", "green_pot", x, north_ - 1.2, 0, 1.5f);
    for (int i = 0; i < 10; ++i) Put("pot", i % 2 ? "pot" : "planter", -hx_ + 2.8 + 2.2 * i, -hy_ + 2.9, 0);
  }

  // Over long tables in the west.
  void RaisePergola() {
    Start("pergola", "furniture/shade/tarp_post", Surface::kFrameWood);
    const float x0 = -hx_ + 4, x1 = -hx_ + 14, y0 = -hy_ + 6, y1 = -hy_ + 13;
    for (float x : {x0, (x0 + x1) / 2, x1})
      for (float y : {y0, y1}) mesh_.Beam({x, y, 0}, {x, y, 2.6f}, 0.16f);
    for (float y : {y0, y1}) mesh_.Beam({x0 - 0.4f, y, 2.66f}, {x1 + 0.4f, y, 2.66f}, 0.16f);
    for (float x = x0 - 0.2f; x <= x1 + 0.2f; x += 0.55f) mesh_.Beam({x, y0 - 0.5f, 2.8f}, {x, y1 + 0.5f, 2.8f}, 0.09f);
    for (double x : {x0 + 2.5, x0 + 7.5})
      for (double y : {y0 + 2.2, y0 + 5.0}) Put("long table", "picnic_table", x, y, 0, 1, 0.03);
  }

  // Sets under sunshades in the south-east.
  void PutCafes() {
    for (double x = 2; x < half_.x - 5; x += 4.2)
      for (double y : {-half_.y + 5.0, -half_.y + 9.0}) {
        const uint32_t variant = rng_.Index(8);
        const auto at = [&](double dx, double dy) {
          return Vec3f{c_.x + static_cast<float>(x + dx), c_.y + static_cast<float>(y + dy), c_.z};
        };
        scene_.Put("terrace table", "dining_table", at(0, 0), 0, 1, variant);
        for (int k = 0; k < 4; ++k) {
          const double a = kTau * k / 4 + 0.3;
          scene_.Put("terrace chair", "dining_chair", at(0.8 * std::cos(a), 0.8 * std::sin(a)),
                     static_cast<double>(FacingYaw({static_cast<float>(-std::cos(a)), static_cast<float>(-std::sin(a))})), 1, variant);
        }
        scene_.Put("sunshade", "umbrella", at(0.2, 0.2), 0, 1, rng_.Index(6));
      }
  }

  // A small tree in a square box, benches on its four sides.
  void PutGrove(float x, float y) {
    PutBed(x - 1, y - 1, x + 1, y + 1);
    Put("terrace tree", rng_.Chance(0.5) ? "tree_narrowleaf" : "tree_generic", x, y, rng_.Uniform(0, kTau),
        static_cast<float>(rng_.Uniform(0.3, 0.42)), 0.5);
    for (int k = 0; k < 4; ++k) {
      const double a = kTau / 4 * k;
      Put("bench", "bench_wood", x + 1.5 * std::cos(a), y + 1.5 * std::sin(a),
          static_cast<double>(FacingYaw({static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))})));
    }
  }

  void PutGroves() {
    for (float x = board_ + 4; x < hx_ - 4; x += 11) PutGrove(x, -hy_ + 15);
    for (float x : {-10.0f, 4.0f}) PutGrove(x, -1);
    for (float y = -hy_ + 21; y < north_ - 5; y += 8) PutGrove(hx_ - 7, y);
  }

  void PutSeats() {
    // Deck chairs in the east.
    for (float y = -hy_ + 19; y < north_ - 7; y += 4)
      for (double x : {half_.x - 14.0, half_.x - 11.5}) {
        Put("deck chair", "dining_chair", x, y, kTau / 4);
        Put("side table", "street_table", x + 0.9, y, 0, 0.8f);
      }
    // Islands of plants with benches; 45 x 20 m between them stay free.
    for (float x = board_ + 2; x < hx_ - 9; x += 12) {
      PutBed(x, north_ - 5.4f, x + 4.2f, north_ - 3.6f);
      Put("bench", "bench_wood", x + 2.1, north_ - 6.2, 0);
      Put("potted tree", "green_pot", x + 6.2, north_ - 4.4, 0, 1.7f);
    }
    for (float y = -hy_ + 17; y < north_ - 8; y += 8) {
      PutBed(-hx_ + 5, y, -hx_ + 9, y + 1.4f);
      Put("bench", "bench_wood", -hx_ + 7, y - 0.7, 0, 1, 0.03);
      Put("bench", "bench_wood", -hx_ + 7, y + 2.1, kTau / 2, 1, 0.03);
    }
    // Benches along the edges, lamps.
    for (float y = -hy_ + 8; y < north_ - 6; y += 10) {
      Put("bench", "bench_wood", -hx_ + 2.6, y, kTau / 4, 1, 0.03);
      Put("bench", "bench_wood", hx_ - 2.6, y, -kTau / 4);
    }
    for (double x = -half_.x + 6; x < half_.x - 3; x += 11) {
      Put("lamp", "bollard_lamp", x, -half_.y + 3.4);
      Put("lamp", "bollard_lamp", x, static_cast<double>(north_) - 2.4);
    }
  }

  float StairHouseBack() const { return north_ + 8.2f; }

  static constexpr float kParapetTop = 0.75f;
  OsmScene& scene_;
  MeshBuilder& mesh_;
  RngStream& rng_;
  const Vec3f c_;
  const Vec2d half_;
  const float hx_, hy_;
  const float north_;  // machines are beyond
  const float board_;  // boards are west of it
};

}  // namespace

// `front` of the spot holds half the length and half the width of the roof, `size` its height.
void TownFinisher::RoofTerrace(const TownSpot& spot) {
  const float z = static_cast<float>(spot.size) + 0.2f;
  Vec3f middle = At(spot.p, 0);
  middle.z += z;
  TerraceBuilder(scene_, mesh_, rng_, middle, spot.front).Build(z);
  // The world begins on the terrace, where people stand.
  scene_.builder.SetSpawn({middle.x + 4, middle.y - static_cast<float>(spot.front.y) + 13.5f, middle.z + 1.7f}, 150);
}

}  // namespace airsim360::internal
