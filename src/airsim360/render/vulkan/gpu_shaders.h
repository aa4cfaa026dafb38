// The shaders of shaders/ as SPIR-V, compiled at build time by glslangValidator (module.cmake).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace airsim360::internal {

/// The same shader with every floating-point operation rounded by itself: no multiplication is fused with an addition, nothing
/// is put in another order.
std::vector<uint32_t> WithoutContraction(std::span<const uint32_t> code);

std::span<const uint32_t> LabelsRaygen();
std::span<const uint32_t> ColorRaygen();
std::span<const uint32_t> EdgesRaygen();
std::span<const uint32_t> HighRaygen();
std::span<const uint32_t> HighLightRaygen();
std::span<const uint32_t> FilterRaygen();
std::span<const uint32_t> CombineRaygen();
std::span<const uint32_t> HighEdgesRaygen();
std::span<const uint32_t> PathRaygen();
std::span<const uint32_t> CoverageRaygen();
std::span<const uint32_t> RecordRaygen();
std::span<const uint32_t> ReplayRaygen();
std::span<const uint32_t> HitShader();
std::span<const uint32_t> MissShader();
std::span<const uint32_t> LightMissShader();
std::span<const uint32_t> AlphaAnyHit();
std::span<const uint32_t> PaneAnyHit();

}  // namespace airsim360::internal
