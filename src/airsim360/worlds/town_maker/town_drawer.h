// Inside DrawTown: one town being drawn, step by step.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/town_maker/town_map.h"
#include "airsim360/worlds/town_maker/town_streets.h"
#include "airsim360/worlds/town_maker/town_styles.h"

namespace airsim360::internal {

using TagList = std::vector<std::pair<const char*, std::string>>;

/// Metres to the nearest shore of water, from land or from the water.
double DistanceToShore(const Patch& water, Vec2d p);

/// "12.3"
std::string Metres(double value);

class TownDrawer {
 public:
  TownDrawer(const TownSpec& spec, uint64_t seed) : spec_(spec), seed_(seed), rng_(seed, "town") {}
  TownMap Draw();

 private:
  // town_waters.cc
  void LayWaters();
  void LayCoast();
  void LayIsland();
  /// Piers, boats, the promenade.
  void FurnishWaters();
  bool IsWet(Vec2d p, double margin) const;

  // town_drawer.cc
  void LayStreets();
  void AddStreet(const std::vector<Vec2d>& line, int rank, std::vector<int64_t> ends, bool bridge);
  std::pair<double, double> WidthsOf(int rank) const;
  Patches FreeGround() const;
  struct OpenPlaces {
    std::vector<bool> open;   // by block: not for houses
    std::vector<Patch> rest;  // of open blocks, for houses
  };
  std::vector<size_t> BlocksForOpenPlaces() const;
  void LayOpenPlaces();
  void LaySquareIn(OpenPlaces& places, size_t number_of_block, size_t number);
  void LayParks(OpenPlaces& places, const std::vector<size_t>& order, size_t at);
  void LaySquare(const Patch& patch, size_t number);
  void LayPark(const Patch& patch, size_t number);
  OsmWay& AddArea(const Ring& ring, const TagList& tags);
  OsmWay& AddLine(const std::vector<Vec2d>& line, const TagList& tags);
  void AddNode(Vec2d p, const TagList& tags);
  void AddBench(Vec2d p, Vec2d front);
  void AddTree(Vec2d p, double least, double most, bool needles = false);
  void AddSpot(const char* kind, Vec2d p, Vec2d front, double size = 0) { map_.spots.push_back({kind, p, front, size}); }
  bool Inside_(Vec2d p, double margin) const;

  // town_houses.cc
  void BuildHouses();
  void Row(const Patch& block, std::vector<Patch>& built);
  void Detached(const Patch& block, std::vector<Patch>& built);
  void Scatter();
  bool InStreet(Vec2d c, const Ring& ring) const;
  bool HouseIn(const Ring& ring, const Patch& block, std::vector<Patch>& built);
  void AddHouse(const Ring& ring);
  void AddTower(const Ring& ring, Vec2d middle, double floors, const std::string& material, const std::string& colour);
  bool Full() const { return spec_.houses > 0 && houses_ >= spec_.houses; }
  double Floors();

  // town_landmarks.cc
  void BuildLandmarks();
  void BuildChurch(Vec2d p, Vec2d front, bool small);
  void BuildTower(Vec2d p, double side, double height, const TagList& tags, const char* roof, double roof_height);
  void BuildCastle(Vec2d p);
  void BuildTerraceHouse();
  void DressStreets();
  void SetBusStops();
  void PlantStreetRows();
  void PlantWoods();

  const TownSpec& spec_;
  const uint64_t seed_;
  RngStream rng_;
  TownMap map_;
  std::vector<Patch> blocks_;                     // free for houses
  std::vector<Patch> taken_;                      // landmarks, in the order of being built
  std::vector<std::pair<Vec2d, double>> bodies_;  // houses as discs
  std::vector<Vec2d> coast_;
  double x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  int64_t next_node_ = 100'000, next_way_ = 1;
  uint64_t houses_ = 0;
};

inline double Length(Vec2d v) { return std::hypot(v.x, v.y); }

}  // namespace airsim360::internal
