// What all shaders share: records, the frame's parameters, rays.
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_shader_8bit_storage : require
#extension GL_EXT_shader_16bit_storage : require

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Floats { float v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Uints { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 2) buffer Shorts { uint16_t v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 1) buffer Bytes { uint8_t v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Shade;
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer High;
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PathTables;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Meshes;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Instances;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Alphas;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Cameras;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Flows;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Coverages;
#define ADDRESS(T) T
#include "records.h"
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Meshes { GpuMesh v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Instances { GpuInstance v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Alphas { GpuAlpha v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Cameras { GpuCamera v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Flows { GpuFlow v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Coverages { GpuCoverage v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Frames { GpuFrameParams v; };

layout(push_constant, scalar) uniform Push { Frames frame; int pass; int paths; } push;

// The source that all back ends share; more in shade.glsl.
#include "airsim360/render/shared/shading_constants.h"
#include "airsim360/render/shared/shading_glsl.h"
#include "airsim360/render/shared/shading_shared.h"
#define word uint
#define reverse_bits bitfieldReverse
#include "airsim360/render/shared/shading_hash.h"
#include "airsim360/render/shared/shading_points.h"

const uint kMiss = 0xffffffffu;
const uint kHasUvs = 1, kSorted = 2, kHasEntities = 4, kHasColors = 8;

/// What a ray met.
struct Hit {
  float t;
  uint instance;   // kMiss = nothing
  uint primitive;  // within the mesh, all geometries counted
  vec2 bary;       // weights of the second and third corner
};

vec3 Load3(Floats f, uint i) { return vec3(f.v[3 * i], f.v[3 * i + 1], f.v[3 * i + 2]); }
uvec3 Corners(GpuMesh mesh, uint primitive) {
  const uint i = 3 * primitive;
  return uvec3(mesh.indices.v[i], mesh.indices.v[i + 1], mesh.indices.v[i + 2]);
}
vec3 Turn(float m[9], vec3 a) {
  return vec3(m[0] * a.x + m[1] * a.y + m[2] * a.z, m[3] * a.x + m[4] * a.y + m[5] * a.z,
              m[6] * a.x + m[7] * a.y + m[8] * a.z);
}
vec3 TurnBack(float m[9], vec3 a) {
  return vec3(m[0] * a.x + m[3] * a.y + m[6] * a.z, m[1] * a.x + m[4] * a.y + m[7] * a.z,
              m[2] * a.x + m[5] * a.y + m[8] * a.z);
}
vec3 Vec(float a[3]) { return vec3(a[0], a[1], a[2]); }
