// What making an acceleration structure takes, whatever is in it.
#pragma once

#include <algorithm>

#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// `n` rounded up to a multiple of `to`.
inline VkDeviceSize Up(VkDeviceSize n, VkDeviceSize to) { return (n + to - 1) / to * to; }

/// What addresses of scratch memory are multiples of.
inline VkDeviceSize ScratchAlign(const GpuDevice& device) {
  return std::max<VkDeviceSize>(device.structure_limits().minAccelerationStructureScratchOffsetAlignment, 256);
}

/// A structure in memory that is there, to be built.
inline VkAccelerationStructureKHR CreateStructure(GpuDevice& device, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                                                  VkAccelerationStructureTypeKHR type) {
  VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR, nullptr};
  info.buffer = buffer;
  info.offset = offset;
  info.size = size;
  info.type = type;
  VkAccelerationStructureKHR structure;
  CheckVk(device.rt().create_structure(device.device(), &info, nullptr, &structure), "making a structure");
  return structure;
}

}  // namespace airsim360::internal
