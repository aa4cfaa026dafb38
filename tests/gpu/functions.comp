// Every shared shading function on the GPU, for shading_functions_test.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#include "airsim360/render/shared/shading_constants.h"
#include "airsim360/render/shared/shading_glsl.h"
#include "airsim360/render/shared/shading_shared.h"
// A name of the header that GLSL keeps for itself.
#define in in_
#include "airsim360/render/shared/shading_bsdf.h"
#undef in
#include "airsim360/render/shared/shading_air.h"
#include "airsim360/render/shared/shading_tone.h"
#include "airsim360/render/shared/shading_interior.h"
#include "airsim360/render/shared/shading_wet_snow.h"
#include "airsim360/render/shared/shading_ground.h"
#include "airsim360/render/shared/shading_marks.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Floats { float v[]; };
layout(push_constant, scalar) uniform Push { Floats arguments; Floats results; uint count; } push;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  uint f = 0;
#define FN(low, high, ulps, expression)                             \
  {                                                                 \
    float a = push.arguments.v[(3 * f + 0) * push.count + i];       \
    float b = push.arguments.v[(3 * f + 1) * push.count + i];       \
    float c = push.arguments.v[(3 * f + 2) * push.count + i];       \
    push.results.v[f * push.count + i] = expression;                \
    ++f;                                                            \
  }
#include "functions.inc"
}
