// The renderer of a device: the CPU's, a GPU's, or the best there is.
#pragma once

#include <memory>
#include <string>

#include "airsim360/render/vulkan/gpu.h"

namespace airsim360 {

struct DeviceChoice {
  std::string device = "auto";  ///< auto, cpu or vulkan
  int gpu = -1;                 ///< index of a GPU (`airsim360 doctor` lists them); -1 = the best
  GpuFault fault = GpuFault::kNone;
};

/// InputError that begins with `flag` unless `device` is auto, cpu or vulkan.
void CheckDevice(const std::string& flag, const std::string& device);

/// Whether MakeRenderer would draw on a GPU.
bool ChoosesGpu(const DeviceChoice& choice);

/// `cpu`: the CPU renderer. `vulkan`: the GPU's; RuntimeError saying why where there is none. `auto`: a GPU in hardware where
/// there is one, else the CPU. Where the machine has no GPU and none was asked for nothing is opened and nothing said; else one
/// line on stderr names the device or says why it is the CPU. What a GPU fails at (out of memory, lost) goes on on the CPU, with
/// a line too. InputError for other devices.
std::unique_ptr<Renderer> MakeRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options, const DeviceChoice& choice);

}  // namespace airsim360
