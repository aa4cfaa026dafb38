#include "airsim360/worlds/town_maker/town_finisher.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town/market_stall.h"
#include "airsim360/worlds/town_maker/town_trees.h"

namespace airsim360::internal {
void TownFinisher::Run(const Neighbours& near) {
  for (const OsmArea& area : scene_.areas)
    if (area.tags->Has("building"))
      for (const Patch& patch : area.patches) houses_.emplace_back(BoundsOf(patch.outer), patch.outer);
  for (const TownSpot& spot : map_.spots) Place(spot);
  ChooseSpawn(near);  // cars pass below
  if (spec_.wires) Tram();
  Traffic();
  if (!map_.river.empty() && spec_.country != TownCountry::kCity) RiverBeyond();
  if (spec_.trees > 0 && (spec_.country == TownCountry::kForest || spec_.country == TownCountry::kFields)) FarWoods();
  if (spec_.country != TownCountry::kCity && !spec_.at_sea()) Ridges();
  if (!mesh_.empty()) scene_.builder.AddInstance({scene_.builder.AddMesh(mesh_.Finish("town")), {}, kNoEntity});
}

// Over the street nearest to the middle where a metre around is free, looking along it and not at a near wall.
void TownFinisher::ChooseSpawn(const Neighbours& near) {
  constexpr double kAbove = 4.5, kFree = 1.2, kStep = 2, kFar = 80, kNearWall = 25;  // metres
  constexpr int kSteps = 40;
  if (spec_.terrace) return;  // the terrace has its own
  const LineIndex::Near middle = near.roads.Find(scene_.focus, 400);
  if (middle.owner == UINT32_MAX) return;
  const auto view = [&](Vec2d p, Vec2d along) {
    double s = 0;
    while (s < kFar && !InHouse(p + along * s, 0)) s += kStep;
    return s;
  };
  for (int i = 0; i <= 2 * kSteps; ++i) {
    const int step = (i % 2 ? 1 : -1) * ((i + 1) / 2);
    const LineIndex::Near road = i == 0 ? middle : near.roads.Find(middle.point + middle.direction * (kStep * step), 6);
    if (road.owner == UINT32_MAX) continue;
    Vec2d along = road.direction;
    const Footprint place{ToFloat(road.point), {static_cast<float>(kFree), static_cast<float>(kFree)}, FacingYaw(ToFloat(along))};
    if (!scene_.occupancy.IsFree(place)) continue;
    if (const double ahead = view(road.point, along); ahead < kNearWall && view(road.point, along * -1.0) > ahead) along = along * -1.0;
    return scene_.builder.SetSpawn(At(road.point, kAbove), static_cast<float>(std::atan2(along.y, along.x) * 180 / M_PI));
  }
}

void TownFinisher::Place(const TownSpot& spot) {
  using Do = void (TownFinisher::*)(const TownSpot&);
  static const std::map<std::string_view, Do> kKinds = {
      {"palm", &TownFinisher::Tree},       {"cypress", &TownFinisher::Tree},  {"umbrella_pine", &TownFinisher::Tree},
      {"terrace", &TownFinisher::Terrace}, {"market", &TownFinisher::Market}, {"undergrowth", &TownFinisher::Undergrowth},
      {"ruin", &TownFinisher::Ruin},       {"arch", &TownFinisher::Arch},     {"windmill", &TownFinisher::Windmill},
      {"porch", &TownFinisher::Porch},     {"jetty", &TownFinisher::Jetty},   {"roof_terrace", &TownFinisher::RoofTerrace}};
  if (const auto it = kKinds.find(spot.kind); it != kKinds.end()) return (this->*it->second)(spot);
  if (spot.kind == "cafe") return Cafe(spot.p, spot.front, static_cast<int>(spot.size / 2.6));
  if (spot.kind == "rowboat") return Boat(spot, 3.8, 1.4, false, false);
  if (spot.kind == "boat") return Boat(spot, rng_.Uniform(6.5, 9), 2.7, false, true);
  if (spot.kind == "yacht") return Boat(spot, rng_.Uniform(7, 10.5), 2.8, true, true);
}

EntityId TownFinisher::Start(std::string name, std::string_view category, Vec2d p, Vec2d front, double lift) {
  const EntityId entity = scene_.builder.AddEntity(std::move(name), scene_.builder.tree().Add(category));
  mesh_.SetEntity(entity);
  mesh_.SetTransform(PlaceUpright(At(p, lift), FacingYaw(ToFloat(front))));
  return entity;
}

bool TownFinisher::InHouse(Vec2d p, double margin) const {
  for (const auto& house : houses_)
    if (house.first.Overlaps({p, p}, margin) && (Inside({house.second, {}}, p) || DistanceToRing(house.second, p) < margin)) return true;
  return false;
}

bool TownFinisher::OnStreet(Vec2d p) const {
  return std::any_of(map_.streets.begin(), map_.streets.end(),
                     [&](const TownStreet& street) { return DistanceToLine(street.line, p) < street.half + street.pavement + 0.6; });
}

void TownFinisher::Tree(const TownSpot& spot) {
  if (InHouse(spot.p, 1.6)) return;
  std::vector<MeshId>& meshes = trees_[spot.kind];
  if (meshes.empty())
    for (uint32_t i = 0; i < 3; ++i) meshes.push_back(scene_.shelf.Add(GrowSouthernTree(spot.kind, i)));
  const char* category = spot.kind == "palm"      ? "vegetation/tree/palm"
                         : spot.kind == "cypress" ? "vegetation/tree/conifer/cypress"
                                                  : "vegetation/tree/conifer/pine";
  const EntityId entity =
      scene_.builder.AddEntity(spot.kind == "umbrella_pine" ? "umbrella pine" : spot.kind, scene_.builder.tree().Add(category));
  const auto scale = static_cast<float>(std::clamp(spot.size / TypicalHeight(spot.kind), 0.45, 1.5));
  const auto tone = static_cast<float>(rng_.Uniform(0.88, 1.1));
  scene_.builder.AddInstance({meshes[rng_.Index(3)], PlaceUpright(At(spot.p, -0.03), static_cast<float>(rng_.Uniform(0, kTau)), scale),
                              entity, Vec3f{tone, tone, tone}});
  scene_.occupancy.Add({ToFloat(spot.p), {0.6f, 0.6f}, 0});
}

// A table with two to four chairs, often under a sunshade.
void TownFinisher::CafeSet(Vec2d p) {
  const Footprint place{ToFloat(p), {1.1f, 1.1f}, 0};
  if (InHouse(p, 1.15) || !scene_.occupancy.IsFree(place)) return;
  scene_.occupancy.Add(place);
  const uint32_t variant = rng_.Index(8);
  const double turn = rng_.Uniform(0, kTau);
  scene_.Put("café table", "dining_table", At(p, 0), turn, 1, variant);
  const int chairs = 2 + static_cast<int>(rng_.Index(3));
  for (int i = 0; i < chairs; ++i) {
    const double a = turn + kTau * i / chairs;
    const Vec2d out{std::cos(a), std::sin(a)};
    scene_.Put("café chair", "dining_chair", At(p + out * 0.78, 0),
               static_cast<double>(FacingYaw(ToFloat(out * -1.0))) + rng_.Uniform(-0.2, 0.2), 1, variant);
  }
  if (rng_.Chance(0.7)) scene_.Put("sunshade", "umbrella", At(p + Vec2d{0.15, 0.2}, 0), rng_.Uniform(0, kTau), 1, rng_.Index(6));
}

void TownFinisher::Cafe(Vec2d p, Vec2d front, int tables) {
  const Vec2d along{-front.y, front.x};
  for (int i = 0; i < tables; ++i) CafeSet(p + along * (2.6 * (i - 0.5 * (tables - 1))));
  scene_.Put("poster stand", "poster_stand", At(p + along * (1.3 * tables + 0.6), 0), static_cast<double>(FacingYaw(ToFloat(front))), 1,
             rng_.Index(4));
}

// Tables along two sides of a square.
void TownFinisher::Terrace(const TownSpot& spot) {
  for (int side : {1, -1})
    for (double s = -0.6 * spot.size; s < 0.6 * spot.size; s += 2.9)
      for (int row = 0; row < 2; ++row) CafeSet(spot.p + Vec2d{s, side * (spot.size - 1.5 - 2.8 * row)});
}

void TownFinisher::Market(const TownSpot& spot) {
  std::vector<MeshId> goods;
  for (uint32_t i = 0; i < 4; ++i) goods.push_back(AddStallMesh(scene_.builder, scene_.surfaces, i));
  const double half = std::min(spot.size, 22.0);
  int number = 0;
  for (double y : {-0.62 * half, -0.22 * half, 0.22 * half, 0.62 * half})
    for (double x = -half; x <= half - 1; x += 4.3) {
      const Vec2d p = spot.p + Vec2d{x, y};
      const Footprint place{ToFloat(p), {1.7f, 1.5f}, 0};
      if (rng_.Chance(0.15) || InHouse(p, 2) || !scene_.occupancy.IsFree(place)) continue;
      scene_.occupancy.Add(place);
      const double yaw = y < 0 ? 0 : kTau / 2;
      const EntityId stall =
          scene_.builder.AddEntity("market stall " + std::to_string(++number), scene_.builder.tree().At("furniture/vending/food_stall"));
      scene_.builder.AddInstance({goods[rng_.Index(4)], PlaceUpright(At(p, 0), static_cast<float>(yaw)), stall});
      scene_.Put("market roof", "tarp", At(p, 0), yaw, 1, rng_.Index(6));
      for (double dx : {-1.35, 1.35}) scene_.Put("market post", "tarp_post", At(p + Vec2d{dx, y < 0 ? -1.0 : 1.0}, 0), yaw, 1, 0);
    }
}

void TownFinisher::Undergrowth(const TownSpot& spot) {
  if (InHouse(spot.p, 1)) return;
  static constexpr const char* kPlants[] = {"fern", "shrub", "fern", "plant"};
  // Tufts on the ground's own entity would be many; they are one plant each place.
  const EntityId tufts = scene_.builder.AddEntity("undergrowth", scene_.builder.tree().At("vegetation/grass_tuft"));
  for (int i = 0; i < 14; ++i) {
    const Vec2d p = spot.p + Vec2d{rng_.Uniform(-4, 4), rng_.Uniform(-4, 4)};
    const auto turn = static_cast<float>(rng_.Uniform(0, kTau)), scale = static_cast<float>(rng_.Uniform(0.8, 1.7));
    const uint32_t variant = rng_.Index(16);
    if (!InHouse(p, 0.5) && !OnStreet(p)) scene_.shelf.PlaceAs(tufts, "grass_tuft", PlaceUpright(At(p, -0.01), turn, scale), variant);
  }
  for (int i = 0; i < 6; ++i) {
    const Vec2d p = spot.p + Vec2d{rng_.Uniform(-3, 3), rng_.Uniform(-3, 3)};
    const char* kind = kPlants[rng_.Index(4)];
    const double turn = rng_.Uniform(0, kTau);
    const auto scale = static_cast<float>(rng_.Uniform(0.5, 1.0));
    const uint32_t variant = rng_.Index(6);
    if (!InHouse(p, 0.8) && !OnStreet(p)) scene_.Put(kind, kind, At(p, -0.03), turn, scale, variant);
  }
}

// Cars on their way, in the right-hand lane.
void TownFinisher::Traffic() {
  if (spec_.traffic < 0.15 || spec_.paving == TownPaving::kDirt) return;
  int number = 0;
  for (const TownStreet& street : map_.streets) {
    if (street.rank > 1 || street.bridge || street.half < 2.4) continue;
    const double length = LengthOf(street.line);
    for (double s = 12 + rng_.Uniform(0, 40 / spec_.traffic); s < length - 12;
         s += rng_.Uniform(22, street.rank == 0 ? 55 : 130) / spec_.traffic) {
      const LinePoint at = PointAt(street.line, s);
      const bool back = rng_.Chance(0.5);
      const Vec2d along = at.along * (back ? -1.0 : 1.0), right{along.y, -along.x};
      const Vec2d p = at.p + right * std::clamp(street.half - 3.9, 0.0, 1.75);
      const double yaw = FacingYaw(ToFloat(along));
      const char* kind = rng_.Chance(0.86) ? "car" : "van";
      const Footprint place = FootprintOf(kind, ToFloat(p), static_cast<float>(yaw));
      if (!scene_.data.extent.Contains(p, 10) || !scene_.occupancy.IsFree(place)) continue;
      scene_.occupancy.Add(place);
      ++number;
      scene_.shelf.Place(kind, At(p, -0.13), static_cast<float>(yaw), rng_.Index(36), 1, {1, 1, 1}, Engine::kOn);
    }
  }
  static_cast<void>(number);
}

}  // namespace airsim360::internal
