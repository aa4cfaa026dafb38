#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(location = 0) rayPayloadInEXT Hit hit;

void main() {
  hit.t = 0.0;
  hit.instance = kMiss;
}
