// Buffers that other interfaces (CUDA) open by a file descriptor.
#pragma once

#include <memory>

#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// RuntimeError where the driver shares no memory, or has none left. The device must outlive it.
std::unique_ptr<GpuSharedMemory> MakeSharedBuffer(GpuDevice& device, size_t bytes);

/// Copies the first `bytes` of `from`, which no submission writes any more, gives them to whoever opens `to`, and waits.
/// InputError if they do not fit.
void CopyToShared(GpuDevice& device, const GpuBuffer& from, size_t bytes, GpuSharedMemory& to);

}  // namespace airsim360::internal
