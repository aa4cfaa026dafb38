// The shaders of shaders/ as SPIR-V, compiled at build time by glslangValidator (module.cmake).
#pragma once

#include <cstdint>
#include <span>

namespace airsim360::internal {

std::span<const uint32_t> LabelsRaygen();
std::span<const uint32_t> ColorRaygen();
std::span<const uint32_t> EdgesRaygen();
std::span<const uint32_t> HighRaygen();
std::span<const uint32_t> HighLightRaygen();
std::span<const uint32_t> FilterRaygen();
std::span<const uint32_t> CombineRaygen();
std::span<const uint32_t> HighEdgesRaygen();
std::span<const uint32_t> HitShader();
std::span<const uint32_t> MissShader();
std::span<const uint32_t> LightMissShader();
std::span<const uint32_t> AlphaAnyHit();
std::span<const uint32_t> PaneAnyHit();

}  // namespace airsim360::internal
