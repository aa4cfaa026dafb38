// A ray of light that met nothing: the payload keeps its tint.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(location = 0) rayPayloadInEXT Hit hit;

void main() { hit.instance = kMiss; }
