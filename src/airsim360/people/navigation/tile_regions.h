// What Recast does not do for regions of a tile, so that their outlines fit together without slits.
#pragma once

struct rcCompactHeightfield;

namespace airsim360::internal {

/// Patches of one kind of ground of fewer than `least` cells become ground of what is around them, before regions are made: gravel that
/// lies on a slope a finger's breadth over the lawn shows grass here and there.
void JoinSpecks(int least, rcCompactHeightfield& tile);

/// What regions have left over, and regions of fewer than `least` cells, becomes part of the one beside it, of its own kind of ground if
/// there is any: strips that are too narrow for a region would be holes of a hand's breadth to walk round, and what the edge of the tile
/// leaves of a region has no corners when its outline is simplified.
void TakeInStrays(int least, rcCompactHeightfield& tile);

/// Where two cells of a region touch at a corner alone, between two other regions, its outline has a corner there that the outlines of
/// the others do not have. Both sides of a border are then simplified on their own, and what is between them is a slit that nobody
/// crosses. One of the four cells changes sides.
void PartCorners(rcCompactHeightfield& tile);

}  // namespace airsim360::internal
