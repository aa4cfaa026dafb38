// shaders/records.h as C++.
#pragma once

#include <cstdint>

#include "airsim360/render/renderer.h"

namespace airsim360::internal {

#define ADDRESS(T) uint64_t
using uint = uint32_t;
struct uvec2 {
  uint32_t x, y;
};
#include "airsim360/render/vulkan/shaders/high_records.h"
#include "airsim360/render/vulkan/shaders/path_records.h"
#include "airsim360/render/vulkan/shaders/records.h"
#include "airsim360/render/vulkan/shaders/shade_records.h"
#undef ADDRESS

inline constexpr uint32_t kGpuHasUvs = 1, kGpuSorted = 2, kGpuHasEntities = 4, kGpuHasColors = 8;
inline constexpr uint32_t kWantRange = 1, kWantEntity = 2, kWantSemantic = 4, kWantNormal = 8, kWantPosition = 16, kWantMaterial = 32,
                          kWantFlow = 64, kWantAlbedo = 128, kWantRadiance = 256, kWantRgb = 512, kWantCoverage = 1024, kWantLight = 2048;
inline constexpr uint32_t kProjectEquirectangular = 0, kProjectPinhole = 1, kProjectFisheye = 2, kProjectLens = 3;
static_assert(sizeof(GpuMesh) == 80 && sizeof(GpuInstance) == 72 && sizeof(GpuAlpha) == 56);
static_assert(sizeof(GpuFlow) == sizeof(FlowPixel) && sizeof(FlowPixel) == 28);
static_assert(sizeof(GpuCoverage) == sizeof(CoveragePixel));

}  // namespace airsim360::internal
