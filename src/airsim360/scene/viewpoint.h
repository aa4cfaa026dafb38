// Where a scene is first looked at.
#pragma once

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// The scene's own place for that, else the middle of its bounds; in W, metres. Not finite where a scene has neither.
inline Vec3f FirstViewpoint(const Scene& scene) { return scene.spawn.value_or(scene.bounds.center()); }

}  // namespace airsim360
