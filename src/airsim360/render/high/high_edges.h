// Antialiasing of tier `high`: more rays on edges, lit by the light already gathered around them.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/render/frame/packet_tracer.h"
#include "airsim360/render/high/high_buffers.h"

namespace airsim360::internal {

struct HighEdgeTask {
  const RayTracer* tracer;
  const Shader* shader;
  const CameraRays* rays;
  LabelView labels;
  SunMapView sun_map;
  Vec3f origin;
  float exposure;  ///< factor from radiance to the input of the tone curve
  int samples;     ///< of an edge pixel, the centre ray included
  uint64_t seed;
  Image<Rgb32f>* radiance;  ///< in the image's columns
  bool gloss = false;       ///< the buffers know what surfaces mirror
};

/// Replaces `task.radiance` of pixels marked in `buffers.edges` by a mean of `samples` rays spread over the
/// pixel: as many where a pixel only contrasts with a neighbour of the same entity, for a choice by the first ones
/// loses what is rare, as sunlit leaves in dark crowns. The mean is one of linear light, as in tier `reference`, but
/// no ray counts for more than what shows as nearly white, so that highlights do not sparkle; in rooms (`gloss`) white pixels
/// beside get the rest. A ray takes its ambient light from the most alike of the nine pixels around. `offsets` are those of
/// MakeSampleOffsets. Returns the number of rays.
int64_t RefineEdges(const HighEdgeTask& task, const std::vector<PixelOffset>& offsets, HighBuffers& buffers);

}  // namespace airsim360::internal
