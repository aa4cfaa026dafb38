// What the builders of one downtown share, and the builders of its parts.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/props/placer.h"
#include "airsim360/worlds/town/ground.h"

namespace airsim360::internal {

/// Height of lawns, metres.
inline constexpr float kLawnZ = 0.06f;

struct District {
  SceneBuilder& builder;
  const Surfaces& surfaces;
  const StreetPlan& plan;
  Ground& ground;
  Placer& placer;
  uint64_t seed;
};

/// A prop as an entity with a name of its own.
EntityId PlaceNamed(District& district, std::string name, std::string_view kind, Vec3f p, float yaw, uint32_t variant = 0, float scale = 1,
                    Vec3f tint = {1, 1, 1});
/// Yaw that turns a prop's front (-Y) towards a direction.
float FacingYaw(Vec2f direction);
/// A run of `kind` panels of 2 m from a to b at height z, stretched to fit, all one entity; with `post` also
/// posts (an entity each) at the joints. The panels' front looks to the right-hand side of a -> b.
void PlaceRun(District& district, std::string_view kind, Vec2f a, Vec2f b, float z, std::string_view post = {});
/// A square tree pit of soil in a stone frame, laid over the paving.
void LayTreePit(Ground& ground, Vec2f at, float z = 0);
/// Grass tufts over a lawn at height z as part of its entity, about `per_m2`, from 2 on with mown grass between them; none
/// within 0.25 m of its edge.
void GrowGrass(District& district, EntityId lawn, const std::vector<Vec2f>& outline, float z, float per_m2);
/// Mown grass as part of the lawn's entity at height z where `inset` (metres from the lawn's edge, negative outside) allows it.
void LayMownGrass(PropShelf& shelf, EntityId lawn, const GroundRect& box, float z, RngStream& rng,
                  const std::function<float(Vec2f)>& inset);
/// Twigs and leaves on the ground around a tree.
void DropLeaves(District& district, EntityId ground, Vec2f at, float radius, int count, float z);
bool InPolygon(const std::vector<Vec2f>& outline, Vec2f p);

/// A dome of grass with trees in a lake whose water is at `water_z`: the entity "island".
void RaiseIsland(District& district, std::string_view category, Vec2f c, Vec2f half, float water_z);
/// An arched footbridge of red steel from south to north through c, `half` metres to either end.
void BuildRedBridge(District& district, Vec2f c, float half);
/// A park of one block: a lake with a wooded island and the red bridge, a walk around it, lawns with trees.
void BuildLakePark(District& district, const Block& block);
/// Distance from p to the nearest edge of the outline.
float EdgeDistance(const std::vector<Vec2f>& outline, Vec2f p);

/// Before the buildings are built: which have red curtains, a bottle on the roof, two that look like them.
void MarkDowntownLandmarks(const StreetPlan& plan, std::vector<BuildingPlan>& buildings);
/// What flight instructions name: on walls and roofs, and on and around the plaza.
void HangDowntownSigns(District& district, const std::vector<BuildingPlan>& buildings);
void PlaceDowntownLandmarks(District& district, const Block& plaza);
/// The plaza: paving, fountain, terrace with café, market, allées.
void BuildPlaza(District& district, const Block& block);
/// The park: pond, ring walk, curved paths, lawns with trees, rocks and wooden fence.
void BuildPark(District& district, const Block& block);
/// Ground and planting inside a built block.
void BuildYard(District& district, const Block& block);
/// Signals and a row of bollards on the kerb return at the far end of a side.
void FurnishCorner(District& district, const Block& block, const BlockSide& side, std::string_view bollard);
/// Where lamps stand along a side of a block between s0 and s1: opposite the gaps of the other side's, or in a row of their own
/// where the street is wide; about 20 m from the nearest, as in real towns (data/osm/distributions.csv).
std::vector<float> LampsAlong(const StreetPlan& plan, const Block& block, int side, float s0, float s1, RngStream& rng);
/// A cover on the crown of every core crossing.
void LayCrossingCovers(District& district);
/// Those who have green, driving over every core crossing from east to west and back, one of them turning off to the left.
/// `cab`: what every third of them is.
void DriveAcross(District& district, std::string_view cab, double traffic);
/// The street along a side of a block is one of the core's, perhaps on its way out.
bool FacesCoreStreet(const StreetPlan& plan, const Block& block, int side);
/// Lamps, trees, meters, bins … along the pavements, by rule.
void FurnishPavements(District& district);
/// Cars at the kerb and in the lanes, buses, manholes.
void FurnishStreets(District& district, const std::vector<StreetStretch>& streets);
/// An arc of mountains around the origin from angle `from` to `to` (radians), its crest about `height` high and broken by noise.
void RaiseRidge(District& district, int index, float radius, float from, float to, float height, Surface surface);
/// Far blocks to 640 m, the plain to the horizon, mountain ridges.
void BuildBackdrop(District& district);

/// Point at distance `r` from `c` in direction `a` [rad].
inline Vec2f Polar(Vec2f c, float r, float a) { return {c.x + r * std::cos(a), c.y + r * std::sin(a)}; }

}  // namespace airsim360::internal
