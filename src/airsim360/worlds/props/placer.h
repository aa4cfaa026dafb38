// Puts props where there is room: nothing overlaps a building, another prop or a reserved place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/kit/street_plan.h"
#include "airsim360/worlds/props/props.h"

namespace airsim360 {

/// An oriented rectangle on the ground.
struct Footprint {
  Vec2f center;
  Vec2f half;  ///< half extents along its own x and y
  float yaw = 0;
  bool Overlaps(const Footprint& other) const;
  bool Contains(Vec2f p) const;
};

/// What stands where: footprints in a grid of cells.
class Occupancy {
 public:
  bool IsFree(const Footprint& footprint) const;
  void Add(const Footprint& footprint);
  size_t size() const { return all_.size(); }

 private:
  template <class Visit>
  void ForCells(const Footprint& footprint, const Visit& visit) const;
  std::vector<Footprint> all_;
  std::unordered_map<int64_t, std::vector<uint32_t>> cells_;  // looked up by key only, never iterated
};

/// One prop that was placed.
struct Placement {
  std::string_view kind;
  EntityId entity;
  Vec3f p_W;
  Footprint footprint;
};

/// Places props by kind with their footprints; refuses what does not fit.
class Placer {
 public:
  Placer(PropShelf& shelf, Occupancy& occupancy, uint64_t seed) : shelf_(shelf), occupancy_(occupancy), rng_(seed, "placer") {}

  /// Keeps a place free of later props.
  void Reserve(const Footprint& footprint) { occupancy_.Add(footprint); }
  /// Places a prop if its footprint is free. A random individual where `variant` is not given.
  std::optional<EntityId> Try(std::string_view kind, Vec3f p_W, float yaw = 0, float scale = 1, Vec3f tint = {1, 1, 1},
                              std::optional<uint32_t> variant = {}, Engine engine = Engine::kOff);
  /// Puts a vehicle into traffic if its footprint is free: its lamps are on by night.
  std::optional<EntityId> Drive(std::string_view kind, Vec3f p_W, float yaw) { return Try(kind, p_W, yaw, 1, {1, 1, 1}, {}, Engine::kOn); }
  /// Places without looking: for things made to touch, as fence panels, or to stand in each other, as
  /// umbrella and table.
  EntityId Put(std::string_view kind, Vec3f p_W, float yaw = 0, float scale = 1, Vec3f tint = {1, 1, 1},
               std::optional<uint32_t> variant = {});
  PropShelf& shelf() { return shelf_; }
  RngStream& rng() { return rng_; }
  const std::vector<Placement>& placements() const { return placements_; }

 private:
  uint32_t Pick(std::string_view kind, std::optional<uint32_t> variant);

  PropShelf& shelf_;
  Occupancy& occupancy_;
  RngStream rng_;
  std::vector<Placement> placements_;
};

/// Ground a prop needs: its own rectangle for long things, a square of the kind's radius else.
Footprint FootprintOf(std::string_view kind, Vec2f at, float yaw, float scale = 1);

}  // namespace airsim360
