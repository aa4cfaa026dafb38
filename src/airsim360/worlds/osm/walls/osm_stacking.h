// Volumes that stand on others: where one begins over the roof of another, nobody sees through between them.
#pragma once

#include <vector>

#include "airsim360/worlds/osm/osm_scene.h"

namespace airsim360::internal {

/// Metres over the ground at the volume's foot above which its roof lies everywhere: the deck behind a parapet, the
/// eaves of what is not flat.
double LowestRoof(const OsmVolume& volume);

/// The volumes that `volume` stands on: they begin below it, overlap it, and end less than a metre below where it
/// begins, or above that.
std::vector<const OsmVolume*> SupportsOf(const Neighbours& near, const OsmVolume& volume);

/// z of the ground that the heights of a volume count from: at the lowest corner of its outline, or, of one that
/// stands on others, where the lowest of them counts from.
double GroundUnder(const OsmScene& scene, const Neighbours& near, const OsmVolume& volume);

/// Walls from the foot of `volume` down to the roofs that it stands on, as part of `entity`; `ground` as GroundUnder.
void CloseOnSupports(MeshBuilder& mesh, const Neighbours& near, const OsmVolume& volume, double ground, MaterialId wall, EntityId entity);

}  // namespace airsim360::internal
