// What is said of cameras before anything is rendered.
#pragma once

#include <string>

#include "airsim360/dataset/record/spec.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// InputError if a camera of a shot is outside of a world without a sky, naming where the world is; a warning if some are
/// inside something solid. `tracer` is of the world without people and bodies.
void CheckCameraPlaces(const RayTracer& tracer, const DatasetSpec& spec, const Flight& flight);

/// InputError beginning with `what` if a place where something is to begin is outside of a world without a sky, or inside
/// something solid.
void CheckStart(const RayTracer& tracer, Vec3d p_W, const std::string& what);

/// One warning if optical flow is asked for between frames so far apart that little of one is in the next.
void CheckFlowSteps(const RayTracer& tracer, const DatasetSpec& spec, const Flight& flight);

}  // namespace airsim360
