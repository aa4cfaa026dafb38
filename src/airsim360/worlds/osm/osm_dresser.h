// Puts the things of a map into its world: what OsmScene holds is shared, the Dresser knows what stands where.
#pragma once

#include <span>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {

/// What a tagged point or area is on the ground.
struct NodeKind {
  std::string_view key, value, kind;
  bool kerbside;  ///< stands at the kerb and looks to the street
};
/// "" as kind: known, but nothing to show. "*" as value: any.
std::span<const NodeKind> NodeKinds();

/// Dresses one map; its parts are called in the order of declaration.
class Dresser {
 public:
  Dresser(OsmScene& scene, const Neighbours& near);
  /// What the map has as points: trees, lamps, benches, signals …
  void Nodes();
  /// Rows of trees, barriers, rails.
  void Ways();
  /// Woods, scrub, playgrounds, car parks, furniture mapped as areas.
  void Areas();
  /// Along the streets: lamps and trees where the map has none at all, cars at the kerb, manholes.
  void Fill();
  /// What stands behind houses: gardens of trees, shrubs and pots, cars at walls, bins.
  void Yards();
  /// Blades of grass on the lawns around the first viewpoint.
  void Grass(const std::vector<std::pair<EntityId, Patches>>& lawns);
  /// Ferns, shrubs, tufts and fallen leaves in the woods there.
  void Undergrowth(const std::vector<std::pair<EntityId, Patches>>& woods);
  /// Adds what was modelled in place as one mesh.
  void Finish();

 private:
  static double Yaw(Vec2d front) { return FacingYaw(ToFloat(front)); }
  void Tree(const std::string& name, Vec2d p, const OsmTags* tags);
  void Simple(const OsmNode& node);
  void Place(const OsmNode& node, std::string_view kind, bool kerbside);
  void Signals(const OsmNode& node);
  void Bicycles(const OsmNode& node);
  void Pole(const OsmNode& node);
  void Statue(const OsmNode& node);
  void Camera(const OsmNode& node);
  void VendingMachine(const OsmNode& node);
  bool Here(Vec2d p) const;
  bool HasAny(std::string_view key, std::string_view value) const;
  bool OnRoad(Vec2d p, double margin) const;
  bool InBuilding(Vec2d p, double margin = 0.6) const;
  /// Off the carriageway, beside its kerb; the second value looks to the street.
  std::pair<Vec2d, Vec2d> Beside(Vec2d p, double gap) const;
  void Barrier(const OsmWay& way);
  void Rails(const OsmWay& way);
  /// About one tree in `each` square metres, apart from each other; `edge` metres off the border.
  void Plant(const OsmArea& area, double each, double edge);
  void Shrubs(const OsmArea& area);
  void Playground(const OsmArea& area);
  void Mow(EntityId lawn, const Patch& patch);
  /// Cars in rows over a car park.
  void Parked(const OsmArea& area);
  void Car(const std::string& name, Vec2d p, Vec2d heading, double lift, RngStream& rng);
  void Cars(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng);
  /// Is p on the carriageway of another segment?
  bool OnOther(Vec2d p, const RoadSegment& self) const;
  void Row(const RoadSegment& segment, double s0, double s1, double pitch, int side, double gap, const char* kind, RngStream& rng);
  void TreeRow(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng);

  OsmScene& scene_;
  const Neighbours& near_;
  MeshBuilder mesh_;  // of things that are no props
  LineIndex paths_;   // all ways for traffic or feet; owner = index into data.ways
  int trees_ = 0, planted_ = 0;
};

inline constexpr int kMostPlanted = 12000;  ///< trees by rule in one world

}  // namespace airsim360::internal
