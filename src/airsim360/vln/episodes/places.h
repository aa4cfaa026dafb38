// Where an instruction can be given and where it ends. For the .cc files of this folder.
#pragma once

#include <optional>

#include "airsim360/base/random.h"
#include "airsim360/vln/episodes/ground.h"
#include "airsim360/vln/episodes/instruction_template.h"

namespace airsim360::internal {

inline constexpr double kStartRoom = 1.0, kGoalRoom = 0.7;  // metres free around them

/// One draw of a start, between two distances from one of the things; nullopt: the draw was none (blocked, on a roof, no
/// road). Whether the instruction makes sense there is for Decide to say.
std::optional<Standpoint> DrawStart(const VlnGround& ground, SceneGraph& graph, const InstructionTemplate& wanted, double nearest,
                                    double farthest, RngStream& random);

/// The place to stop at for a thing that was meant; nullopt: there is no free one.
std::optional<Vec3d> FindGoal(const VlnGround& ground, const InstructionTemplate& wanted, const Thing& thing, const Viewpoint& start);

}  // namespace airsim360::internal
