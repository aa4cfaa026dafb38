// The light of the sky where a camera stands, and how much of the sun it sees.
#pragma once

#include "airsim360/render/frame/label_tables.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/shading/shader.h"

namespace airsim360::internal {

/// At `origin` in W. The share of the sun is the mean of 64 rays spread evenly over its disc, shaded as those of
/// the camera: leaves, clear panes and clouds before it count with what they let through.
Daylight DaylightAt(const RayTracer& tracer, const Shader& shader, const LabelView& labels, Vec3f origin);

}  // namespace airsim360::internal
