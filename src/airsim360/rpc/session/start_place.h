// Whether a drone can start somewhere.
#pragma once

#include <optional>
#include <string>

#include "airsim360/math/vector.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Why a drone of that radius (metres) that stands with its middle at `p_W` cannot stay there: "in a wall or against it", "over no
/// ground"; "" if it can.
std::string StartFault(const RayTracer& tracer, Vec3d p_W, double radius);
/// The nearest place of the same height without a fault among some within 50 m; nullopt if there is none.
std::optional<Vec3d> NearestStart(const RayTracer& tracer, Vec3d p_W, double radius);

}  // namespace airsim360
