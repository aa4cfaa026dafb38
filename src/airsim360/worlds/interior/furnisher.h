// Furniture in a room: along its walls, in its middle, on top of other things, under the ceiling.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/interior/building_plan.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360::internal {

/// Props by kind with their measured boxes, each an entity of its own.
class Furnisher {
 public:
  /// Where not `furnished`, what can be carried or driven away is measured and not put.
  Furnisher(SceneBuilder& builder, const ModelSource* models, uint64_t seed, bool furnished = true)
      : builder_(builder), shelf_(builder, models, seed), models_(models), seed_(seed), furnished_(furnished) {}

  /// Of an individual as it stands, front towards -Y.
  const Box3f& BoxOf(std::string_view kind, uint32_t variant);
  uint32_t Variants(std::string_view kind);
  /// Its box's middle comes to (p.x, p.y), its foot to p.z. nullopt: it is not put.
  std::optional<EntityId> Put(std::string_view kind, Vec3f p, float yaw, uint32_t variant, Vec3f tint = {1, 1, 1});
  /// Its box's middle comes to (p.x, p.y), its top to p.z.
  std::optional<EntityId> Hang(std::string_view kind, Vec3f p, float yaw = 0, uint32_t variant = 0);
  SceneBuilder& builder() { return builder_; }

 private:
  struct Individual {
    MeshId mesh;
    Box3f box;
  };
  const Individual& Get(std::string_view kind, uint32_t variant);

  SceneBuilder& builder_;
  PropShelf shelf_;
  const ModelSource* models_;
  uint64_t seed_;
  bool furnished_;
  std::map<std::string, std::vector<Individual>, std::less<>> made_;
};

/// A place at a wall: its foot on the floor, and where the room lies from there.
struct WallSpot {
  Vec2f foot;    ///< on the face of the wall, in the middle of the thing
  Vec2f inward;  ///< unit, into the room
  float yaw;     ///< turns the front (-Y) into the room
  Vec2f along() const { return {-inward.y, inward.x}; }
  Vec2f At(float right, float out) const { return foot + along() * right + inward * out; }
};

/// One room being furnished: what is taken, and by whom.
class RoomSpace {
 public:
  RoomSpace(const InteriorPlan& plan, int room, Furnisher& furnisher);

  const PlanRoom& room() const { return room_; }
  const PlanRect& rect() const { return room_.clear; }
  float z() const { return room_.floor_z; }
  RngStream& rng() { return rng_; }
  Furnisher& furnisher() { return furnisher_; }

  /// A free place at a wall for something so wide and deep, with `front` metres kept free before it; not before windows if
  /// higher than their sills, never before doors. Any free place by chance; `side` in 0 … 3 (south, east, north, west) or -1.
  std::optional<WallSpot> FindWall(float width, float depth, float height, float front = 0, int side = -1);
  /// Stands at a wall with its back to it, where there is room.
  std::optional<WallSpot> AtWall(std::string_view kind, float front = 0, int side = -1, std::optional<uint32_t> variant = {});
  /// Side by side along a wall, at most `count`; how many stand.
  int RowAtWall(std::string_view kind, int count, float gap = 0.02f, float front = 0.7f);
  /// Hung on a wall at a height, where neither windows nor high furniture are.
  bool OnWall(std::string_view kind, float height, int side = -1);
  /// At a place of the floor if it is free there.
  bool At(std::string_view kind, Vec2f p, float yaw, std::optional<uint32_t> variant = {}, Vec3f tint = {1, 1, 1});
  /// At a random free place, `margin` from the walls.
  bool Anywhere(std::string_view kind, float margin = 0.2f, int tries = 12);
  /// Without looking, at a height above the floor: on tables, or what is made to touch.
  void Put(std::string_view kind, Vec2f p, float yaw, float height = 0, std::optional<uint32_t> variant = {}, Vec3f tint = {1, 1, 1});
  void Reserve(Vec2f center, Vec2f half, float yaw = 0) { taken_.Add({center, half, yaw}); }
  bool IsFree(Vec2f center, Vec2f half, float yaw = 0) const { return taken_.IsFree({center, half, yaw}); }
  uint32_t Pick(std::string_view kind, std::optional<uint32_t> variant) {
    return variant ? *variant : rng_.Index(furnisher_.Variants(kind));
  }
  float Top(std::string_view kind, uint32_t variant = 0) { return furnisher_.BoxOf(kind, variant).max.z; }
  Vec3f Size(std::string_view kind, uint32_t variant = 0) { return furnisher_.BoxOf(kind, variant).size(); }
  /// Openings of the room's walls: their middle on the wall's face, direction inward, width.
  struct Hole {
    OpeningKind kind;
    WallSpot spot;
    float width, sill, head;
    int side;
  };
  const std::vector<Hole>& holes() const { return holes_; }
  /// Whether a wall stands all along that side.
  bool HasWall(int side) const { return !open_[side]; }

 private:
  void AddHoles(const PlanWall& wall);
  WallSpot SpotAt(int side, float along) const;
  bool IsBlocked(int side, float along, float width, float height) const;

  const InteriorPlan& plan_;
  const PlanRoom& room_;
  int index_;
  Furnisher& furnisher_;
  RngStream rng_;
  Occupancy taken_;
  std::vector<Hole> holes_;
  struct Used {
    int side;
    float from, to, height;
  };
  std::vector<Used> used_;  // stretches of walls that things stand at
  bool open_[4] = {};
};

/// Furniture of one room by the use of its building.
void FurnishHome(RoomSpace& space, double clutter);
void FurnishWork(RoomSpace& space, double clutter);
void FurnishTrade(RoomSpace& space, double clutter);
void FurnishHall(RoomSpace& space, const InteriorPlan& plan, double clutter);
/// Parked cars, signs and cones of a car park.
void FurnishDecks(const InteriorPlan& plan, Furnisher& furnisher);
/// Furniture of every room: which of the above a building's use asks for.
void FurnishRooms(const InteriorPlan& plan, Furnisher& furnisher);
/// Lamps, vents, ducts, sprinklers, signs.
void InstallServices(const InteriorPlan& plan, Furnisher& furnisher);

/// Uniform in [-by, by].
inline float Jitter(RoomSpace& s, double by) { return static_cast<float>(s.rng().Uniform(-by, by)); }

}  // namespace airsim360::internal
