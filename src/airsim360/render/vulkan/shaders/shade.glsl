// Tables of the colour tiers, and the shading source that all back ends share.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Triangles;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ShadedInstances;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Materials;
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Textures;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Panes;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Lamps;
#include "shade_records.h"
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Triangles { GpuTriangle v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ShadedInstances { GpuShaded v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Materials { GpuMaterial v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Textures { GpuTexture v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Panes { GpuPane v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Lamps { GpuLamp v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Shade { GpuShade v; };
#define view push.frame.v.shade.v

#include "airsim360/render/shading/shading_glsl.h"
#include "airsim360/render/shading/shading_shared.h"
// A name of the header that GLSL keeps for itself.
#define in in_
#include "airsim360/render/shading/shading_bsdf.h"
#undef in
#include "airsim360/render/shading/shading_air.h"
#include "airsim360/render/shading/shading_tone.h"
#include "airsim360/render/shading/shading_interior.h"
#include "airsim360/render/shading/shading_weather.h"
#include "airsim360/render/shading/shading_ground.h"

const float kFoliage = 1.0, kGlass = 2.0, kWater = 3.0;
const uint kMirroredUv = 0x80000000u;

vec3 UnpackDirection(uint p) {
  const float scale = 2.0 / 65534.0;
  return octahedral_decode(float(p & 0xffffu) * scale - 1.0, float(p >> 16) * scale - 1.0);
}
float HashOf(uint bits) { return float((bits * 0x9e3779b1u) >> 8) * (1.0 / 16777216.0); }
