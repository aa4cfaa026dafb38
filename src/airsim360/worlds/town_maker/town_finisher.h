// Inside BuildTown: what stands in a town beyond its map, kind by kind.
#pragma once

#include <map>
#include <string>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/town_maker/town_map.h"

namespace airsim360::internal {

class TownFinisher {
 public:
  TownFinisher(const TownSpec& spec, const TownMap& map, OsmScene& scene)
      : spec_(spec), map_(map), scene_(scene), rng_(scene.options.seed, "finish") {}
  void Run(const Neighbours& near);

 private:
  // town_finisher.cc
  void Place(const TownSpot& spot);
  void Tree(const TownSpot& spot);
  void Cafe(Vec2d p, Vec2d front, int tables);
  void CafeSet(Vec2d p);
  void Terrace(const TownSpot& spot);
  void Market(const TownSpot& spot);
  void Undergrowth(const TownSpot& spot);
  void Traffic();
  void ChooseSpawn(const Neighbours& near);
  EntityId Start(std::string name, std::string_view category, Vec2d p, Vec2d front, double lift = 0);
  Vec3f At(Vec2d p, double lift) const { return scene_.On(p, lift); }
  bool InHouse(Vec2d p, double margin) const;
  bool OnStreet(Vec2d p) const;

  // town_stones.cc
  void Ruin(const TownSpot& spot);
  void Column(Vec2d p, double radius, double height, bool whole);
  void Arch(const TownSpot& spot);
  void Windmill(const TownSpot& spot);
  void Porch(const TownSpot& spot);

  // town_boats.cc
  void Jetty(const TownSpot& spot);
  void Boat(const TownSpot& spot, double length, double beam, bool mast, bool cabin);

  // town_tram.cc
  void Tram();
  void Rails(const TownStreet& street);
  void Wires(const TownStreet& street);
  void Car(Vec2d p, Vec2d along);

  // town_horizon.cc
  void RiverBeyond();
  void FarWoods();
  void Ridges();

  // roof_terrace.cc
  void RoofTerrace(const TownSpot& spot);

  const TownSpec& spec_;
  const TownMap& map_;
  OsmScene& scene_;
  RngStream rng_;
  MeshBuilder mesh_;
  std::map<std::string, std::vector<MeshId>> trees_;
  std::vector<std::pair<Bounds2d, Ring>> houses_;
  int number_ = 0;
};

}  // namespace airsim360::internal
