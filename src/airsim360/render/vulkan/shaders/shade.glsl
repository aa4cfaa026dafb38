// Tables of the colour tiers, and the rest of the shading source that all back ends share.
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ShadedInstances;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Materials;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Textures;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Panes;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lamps;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TriangleColors;
#include "shade_records.h"
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles { GpuTriangle v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ShadedInstances { GpuShaded v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Materials { GpuMaterial v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Textures { GpuTexture v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Panes { GpuPane v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lamps { GpuLamp v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TriangleColors { GpuTriangleColors v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Shade { GpuShade v; };
#define view push.frame.v.shade.v

// A name of the header that GLSL keeps for itself.
#define in in_
#include "airsim360/render/shared/shading_bsdf.h"
#undef in
#include "airsim360/render/shared/shading_air.h"
#include "airsim360/render/shared/shading_sky.h"
#include "airsim360/render/shared/shading_tone.h"
#include "airsim360/render/shared/shading_interior.h"
#include "airsim360/render/shared/shading_wet_snow.h"
#include "airsim360/render/shared/shading_moon.h"
#include "airsim360/render/shared/shading_ground.h"
#include "airsim360/render/shared/shading_marks.h"
#include "airsim360/render/shared/shading_surface.h"

/// Whether something keeps rain off a point.
bool roof_hides(vec3 p) {
  if (view.roof_size == 0) return false;
  const float last = float(view.roof_size - 1);
  const float column = (p.x - p.z * view.roof_lean - view.roof_origin[0]) * view.roof_cells_per_metre;
  const float row = (p.y - view.roof_origin[1]) * view.roof_cells_per_metre;
  if (!(column > 0.0 && column < last && row > 0.0 && row < last)) return false;
  return p.z < view.roof_heights.v[int(row) * view.roof_size + int(column)];
}
#define ROOFS_ARGUMENT
#define ROOFS
#define ROOFS_TEXELS_PER_METRE view.roof_cells_per_metre
#include "airsim360/render/shared/shading_precipitation.h"

const uint kMirroredUv = 0x80000000u;

vec3 UnpackDirection(uint p) {
  return octahedral_decode(float(p & 0xffffu) * kDirectionStep - 1.0, float(p >> 16) * kDirectionStep - 1.0);
}
vec3 CornerColor(GpuTriangleColors c, int corner) {
  const uint rg = c.corner[2 * corner], ba = c.corner[2 * corner + 1];
  return vec3(float(rg & 0xffffu), float(rg >> 16), float(ba & 0xffffu)) * kColorStep;
}
/// What vertex colours do to the base colour of a triangle at the weights of its second and third corner.
vec3 VertexColors(GpuShaded own, uint triangle, vec2 bary) {
  if (own.first_color == 0) return vec3(1.0);
  const GpuTriangleColors c = view.colors.v[own.first_color + triangle];
  return corner_color(CornerColor(c, 0), CornerColor(c, 1), CornerColor(c, 2), bary.x, bary.y);
}
float HashOf(uint bits) { return float((bits * 0x9e3779b1u) >> 8) * (1.0 / 16777216.0); }
