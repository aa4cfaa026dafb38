#include "airsim360/render/vulkan/gpu_shaders.h"

#include <algorithm>

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
constexpr uint32_t kPathRaygen[] = {
#include "path.rgen.inc"
};
constexpr uint32_t kCoverageRaygen[] = {
#include "coverage.rgen.inc"
};
constexpr uint32_t kRecordRaygen[] = {
#include "record.rgen.inc"
};
constexpr uint32_t kReplayRaygen[] = {
#include "replay.rgen.inc"
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

std::vector<uint32_t> WithoutContraction(std::span<const uint32_t> code) {
  // SPIR-V 1.5, sections 2.3 and 3: words of an instruction are (count << 16 | opcode), type, result, ...
  constexpr uint32_t kDecorate = 71, kMemberDecorate = 72, kTypeVoid = 19, kTypeFunction = 33, kNoContraction = 42;
  constexpr uint32_t kArithmetic[] = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
  constexpr size_t kHeader = 5;
  size_t at = 0;
  std::vector<uint32_t> decorations;
  for (size_t i = kHeader; i < code.size(); i += code[i] >> 16) {
    const uint32_t opcode = code[i] & 0xffff;
    const bool annotates = opcode == kDecorate || opcode == kMemberDecorate;
    if (at == 0 && (annotates || (opcode >= kTypeVoid && opcode <= kTypeFunction))) at = i;
    if (std::ranges::find(kArithmetic, opcode) != std::end(kArithmetic))
      decorations.insert(decorations.end(), {3u << 16 | kDecorate, code[i + 2], kNoContraction});
  }
  std::vector<uint32_t> out(code.begin(), code.end());
  out.insert(out.begin() + static_cast<std::ptrdiff_t>(at), decorations.begin(), decorations.end());
  return out;
}

std::span<const uint32_t> LabelsRaygen() { return kLabelsRaygen; }
std::span<const uint32_t> ColorRaygen() { return kColorRaygen; }
std::span<const uint32_t> EdgesRaygen() { return kEdgesRaygen; }
std::span<const uint32_t> HighRaygen() { return kHighRaygen; }
std::span<const uint32_t> HighLightRaygen() { return kHighLightRaygen; }
std::span<const uint32_t> FilterRaygen() { return kFilterRaygen; }
std::span<const uint32_t> CombineRaygen() { return kCombineRaygen; }
std::span<const uint32_t> HighEdgesRaygen() { return kHighEdgesRaygen; }
std::span<const uint32_t> PathRaygen() { return kPathRaygen; }
std::span<const uint32_t> CoverageRaygen() { return kCoverageRaygen; }
std::span<const uint32_t> RecordRaygen() { return kRecordRaygen; }
std::span<const uint32_t> ReplayRaygen() { return kReplayRaygen; }
std::span<const uint32_t> LightMissShader() { return kLightMiss; }
std::span<const uint32_t> HitShader() { return kHit; }
std::span<const uint32_t> MissShader() { return kMissShader; }
std::span<const uint32_t> AlphaAnyHit() { return kAlpha; }
std::span<const uint32_t> PaneAnyHit() { return kPane; }

}  // namespace airsim360::internal
