// Nearest hit: only what it is; all else is for the ray generation shader.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(location = 0) rayPayloadInEXT Hit hit;
hitAttributeEXT vec2 bary;

void main() {
  GpuInstance instance = push.frame.v.instances.v[gl_InstanceCustomIndexEXT];
  hit.t = gl_HitTEXT;
  hit.instance = gl_InstanceCustomIndexEXT;
  hit.primitive = push.frame.v.meshes.v[instance.mesh].first[gl_GeometryIndexEXT] + gl_PrimitiveID;
  hit.bary = bary;
}
