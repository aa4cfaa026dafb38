// Branches by space colonisation (Runions, Lane, Prusinkiewicz 2007) and their thickness by the pipe model.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// A joint of the branch graph; parents come before their children.
struct BranchNode {
  Vec3f p;
  int parent = -1;
  float radius = 0;  ///< metres, see Thicken
  int tips = 0;      ///< twigs that it carries; 1 at a tip
  int main = -1;     ///< the child that continues it: the one with the most tips
};

struct GrowthOptions {
  float step = 0.22f;      ///< metres between joints
  float influence = 2.0f;  ///< an attractor pulls the nearest joint within this distance
  float kill = 0.45f;      ///< and is used up when a joint comes this close
  float inertia = 0.35f;   ///< share of the parent's direction
  float wander = 0.16f;    ///< share of a random direction
  Vec3f tropism{0, 0, 0.1f};
  int max_nodes = 12000;
};

/// Unit vector of uniform direction.
Vec3f RandomDirection(RngStream& random);
/// Smooth noise in [0, 1] of a point, cells of 1.
float Noise(Vec3f p, uint64_t seed);

/// A wandering stem from `from` towards `to`, a joint every `step`, appended to `nodes` with `parent` before
/// it; returns the index of its last joint.
int AddStem(std::vector<BranchNode>& nodes, int parent, Vec3f from, Vec3f to, float step, float wander, RngStream& random);

/// Grows `nodes` towards the attractors until none is left within reach, then smooths the joints.
void Colonise(std::vector<BranchNode>& nodes, const std::vector<Vec3f>& attractors, const GrowthOptions& options, RngStream& random);

/// Fills tips, main and radius: radius = tip_radius * tips^(1/n), n chosen so that the first node has
/// `trunk_radius`.
void Thicken(std::vector<BranchNode>& nodes, float trunk_radius, float tip_radius);

/// `count` random points of the box [min, max] for which `inside` holds.
std::vector<Vec3f> ScatterInside(Vec3f min, Vec3f max, int count, const std::function<bool(Vec3f)>& inside, RngStream& random);

}  // namespace airsim360::internal
