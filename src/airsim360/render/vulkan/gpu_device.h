// A headless Vulkan device with ray tracing pipelines, and errors in words. Plain C interface of Vulkan, so that
// few headers are heavy; Vulkan stays inside this folder.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <vector>

#include "airsim360/render/vulkan/gpu.h"

namespace airsim360::internal {

/// RuntimeError saying what failed and why (out of memory, device lost, …) unless `result` is a success.
void CheckVk(VkResult result, const char* what);

/// Functions of the ray tracing extensions, which the loader does not export.
struct RayTracingApi {
  PFN_vkCreateAccelerationStructureKHR create_structure;
  PFN_vkDestroyAccelerationStructureKHR destroy_structure;
  PFN_vkGetAccelerationStructureBuildSizesKHR build_sizes;
  PFN_vkGetAccelerationStructureDeviceAddressKHR structure_address;
  PFN_vkCmdBuildAccelerationStructuresKHR build;
  PFN_vkCmdCopyAccelerationStructureKHR copy;
  PFN_vkCmdWriteAccelerationStructuresPropertiesKHR write_properties;
  PFN_vkCreateRayTracingPipelinesKHR create_pipelines;
  PFN_vkGetRayTracingShaderGroupHandlesKHR group_handles;
  PFN_vkCmdTraceRaysKHR trace_rays;
};

class GpuDevice {
 public:
  /// Opens a device. RuntimeError saying what is missing: no Vulkan, no device, an extension, a feature.
  explicit GpuDevice(const GpuOptions& options);
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }
  /// Copies pictures while the other traces, where the device has engines for that alone; else the same as queue().
  VkQueue copy_queue() const { return copy_queue_; }
  uint32_t copy_family() const { return copy_family_; }
  /// Whether memory of the GPU is its own: what the CPU writes and reads is copied.
  bool discrete() const { return discrete_; }
  const RayTracingApi& rt() const { return rt_; }
  const GpuInfo& info() const { return info_; }
  GpuFault fault() const { return fault_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& pipeline_limits() const { return pipeline_limits_; }
  const VkPhysicalDeviceAccelerationStructurePropertiesKHR& structure_limits() const { return structure_limits_; }
  float timestamp_period_ns() const { return timestamp_period_ns_; }
  /// Bits of a timestamp that count.
  uint64_t timestamp_mask() const { return timestamp_mask_; }
  /// Largest piece of memory, bytes.
  VkDeviceSize most_memory() const { return most_memory_; }
  /// Records, submits and waits; what was written is visible to all that is submitted later.
  void Run(const std::function<void(VkCommandBuffer)>& record);
  /// What the validation layers said since the device was opened (empty without them).
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  void OpenInstance(bool validate);
  void OpenDevice(VkPhysicalDevice physical);
  void ChooseQueues(VkPhysicalDevice physical);
  void ReadLimits(VkPhysicalDevice physical);
  void LoadFunctions();
  void Close();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkQueue copy_queue_ = VK_NULL_HANDLE;
  uint32_t queue_family_ = 0, copy_family_ = 0;
  bool discrete_ = false;
  float timestamp_period_ns_ = 0;
  uint64_t timestamp_mask_ = 0;
  VkDeviceSize most_memory_ = 0;
  RayTracingApi rt_{};
  GpuInfo info_;
  GpuFault fault_ = GpuFault::kNone;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkPhysicalDeviceRayTracingPipelinePropertiesKHR pipeline_limits_{};
  VkPhysicalDeviceAccelerationStructurePropertiesKHR structure_limits_{};
  std::vector<std::string> messages_;
};

}  // namespace airsim360::internal
