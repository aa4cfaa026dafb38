#include "airsim360/render/vulkan/gpu_shaders.h"

namespace airsim360::internal {
namespace {

constexpr uint32_t kLabelsRaygen[] = {
#include "labels.rgen.inc"
};
constexpr uint32_t kColorRaygen[] = {
#include "color.rgen.inc"
};
constexpr uint32_t kEdgesRaygen[] = {
#include "edges.rgen.inc"
};
constexpr uint32_t kHighRaygen[] = {
#include "high.rgen.inc"
};
constexpr uint32_t kHighLightRaygen[] = {
#include "high_light.rgen.inc"
};
constexpr uint32_t kFilterRaygen[] = {
#include "filter.rgen.inc"
};
constexpr uint32_t kCombineRaygen[] = {
#include "combine.rgen.inc"
};
constexpr uint32_t kHighEdgesRaygen[] = {
#include "high_edges.rgen.inc"
};
constexpr uint32_t kLightMiss[] = {
#include "light.rmiss.inc"
};
constexpr uint32_t kHit[] = {
#include "hit.rchit.inc"
};
constexpr uint32_t kMissShader[] = {
#include "miss.rmiss.inc"
};
constexpr uint32_t kAlpha[] = {
#include "alpha.rahit.inc"
};
constexpr uint32_t kPane[] = {
#include "pane.rahit.inc"
};

}  // namespace

std::span<const uint32_t> LabelsRaygen() { return kLabelsRaygen; }
std::span<const uint32_t> ColorRaygen() { return kColorRaygen; }
std::span<const uint32_t> EdgesRaygen() { return kEdgesRaygen; }
std::span<const uint32_t> HighRaygen() { return kHighRaygen; }
std::span<const uint32_t> HighLightRaygen() { return kHighLightRaygen; }
std::span<const uint32_t> FilterRaygen() { return kFilterRaygen; }
std::span<const uint32_t> CombineRaygen() { return kCombineRaygen; }
std::span<const uint32_t> HighEdgesRaygen() { return kHighEdgesRaygen; }
std::span<const uint32_t> LightMissShader() { return kLightMiss; }
std::span<const uint32_t> HitShader() { return kHit; }
std::span<const uint32_t> MissShader() { return kMissShader; }
std::span<const uint32_t> AlphaAnyHit() { return kAlpha; }
std::span<const uint32_t> PaneAnyHit() { return kPane; }

}  // namespace airsim360::internal
