// Where an instruction can be given and where it ends. For the .cc files of this folder.
#pragma once

#include <optional>

#include "airsim360/base/random.h"
#include "airsim360/routes/shortest_way.h"
#include "airsim360/vln/episodes/ground.h"
#include "airsim360/vln/episodes/template_syntax.h"

namespace airsim360::internal {

/// Metres free around a start and a goal; rooms are narrow.
inline double StartRoom(const VlnGround& ground) { return ground.rooms() ? 0.7 : 1.0; }
/// Metres free around every way in rooms: doors are narrow, and the drones of episodes reach 0.28 m.
inline constexpr double kNarrowWay = 0.33;
inline double GoalRoom(const VlnGround& ground) { return ground.rooms() ? 0.55 : 0.7; }

/// One draw of a start, between two distances from one of the things; nullopt: the draw was none (blocked, on a roof, no
/// road). Whether the instruction makes sense there is for Decide to say.
std::optional<Standpoint> DrawStart(const VlnGround& ground, SceneGraph& graph, const InstructionTemplate& wanted, double nearest,
                                    double farthest, RngStream& random);

/// The place to stop at for a thing that was meant; nullopt: there is no free one.
std::optional<Vec3d> FindGoal(const VlnGround& ground, const InstructionTemplate& wanted, const Thing& thing, const Viewpoint& start);

/// In rooms: the other free places near the thing and in sight of it, so that whoever stops at either end of a flight of stairs has
/// arrived; about a metre apart, at most kMostPlaces, the nearest to `goal` first.
std::vector<Vec3d> FindPlaces(const VlnGround& ground, const InstructionTemplate& wanted, const Thing& thing, Vec3d goal);
inline constexpr size_t kMostPlaces = 200;

/// The way from a start to a goal with room for a drone around it: in the open as FindShortestWay, in rooms through what is around
/// both, so that a shut door costs little.
ShortestWay FindWay(const VlnGround& ground, Vec3d start, Vec3d goal);

}  // namespace airsim360::internal
