#include "airsim360/render/vulkan/gpu_share.h"

#include <string>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr VkExternalMemoryHandleTypeFlagBits kHandle = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;

class SharedBuffer : public GpuSharedMemory {
 public:
  SharedBuffer(GpuDevice& device, size_t size) : device_(device), size_(size) {
    if (!device.info().shares_memory)
      throw RuntimeError("GPU '" + device.info().name + "' shares no memory (no " VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME ")");
    try {
      Make();
    } catch (...) {
      Free();
      throw;
    }
  }
  ~SharedBuffer() override { Free(); }
  SharedBuffer(const SharedBuffer&) = delete;
  SharedBuffer& operator=(const SharedBuffer&) = delete;

  VkBuffer handle() const { return buffer_; }
  size_t size() const override { return size_; }
  size_t allocated() const override { return allocated_; }
  bool dedicated() const override { return dedicated_; }

  int Open() const override {
    const auto get = reinterpret_cast<PFN_vkGetMemoryFdKHR>(vkGetDeviceProcAddr(device_.device(), "vkGetMemoryFdKHR"));
    if (get == nullptr) throw RuntimeError("GPU driver lacks vkGetMemoryFdKHR");
    const VkMemoryGetFdInfoKHR info{VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR, nullptr, memory_, kHandle};
    int fd = -1;
    CheckVk(get(device_.device(), &info, &fd), "sharing memory");
    return fd;
  }

 private:
  void Make() {
    const VkDevice d = device_.device();
    const VkExternalMemoryBufferCreateInfo shared{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO, nullptr, kHandle};
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, &shared};
    info.size = size_;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    CheckVk(vkCreateBuffer(d, &info, nullptr, &buffer_), "making a buffer to share");
    VkMemoryDedicatedRequirements alone{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS, nullptr};
    VkMemoryRequirements2 needs{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, &alone, {}};
    const VkBufferMemoryRequirementsInfo2 of{VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2, nullptr, buffer_};
    vkGetBufferMemoryRequirements2(d, &of, &needs);
    dedicated_ = alone.requiresDedicatedAllocation || alone.prefersDedicatedAllocation;
    allocated_ = needs.memoryRequirements.size;

    const VkMemoryDedicatedAllocateInfo buffer{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, nullptr, VK_NULL_HANDLE, buffer_};
    const VkExportMemoryAllocateInfo exported{VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO, dedicated_ ? &buffer : nullptr, kHandle};
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (uint32_t i = 0; i < device_.memory().memoryTypeCount && memory_ == VK_NULL_HANDLE; ++i) {
      const bool local = device_.memory().memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
      if (!local || (needs.memoryRequirements.memoryTypeBits >> i & 1) == 0) continue;
      const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &exported, allocated_, i};
      result = vkAllocateMemory(d, &allocate, nullptr, &memory_);
    }
    CheckVk(result, "allocating memory to share");
    CheckVk(vkBindBufferMemory(d, buffer_, memory_, 0), "binding memory to share");
  }
  void Free() {
    if (buffer_ != VK_NULL_HANDLE) vkDestroyBuffer(device_.device(), buffer_, nullptr);
    if (memory_ != VK_NULL_HANDLE) vkFreeMemory(device_.device(), memory_, nullptr);
  }

  GpuDevice& device_;
  size_t size_, allocated_ = 0;
  bool dedicated_ = false;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

}  // namespace

std::unique_ptr<GpuSharedMemory> MakeSharedBuffer(GpuDevice& device, size_t bytes) {
  if (bytes == 0) throw InputError("GPU: memory of 0 bytes to share");
  return std::make_unique<SharedBuffer>(device, bytes);
}

void CopyToShared(GpuDevice& device, const GpuBuffer& from, size_t bytes, GpuSharedMemory& to) {
  const auto& shared = dynamic_cast<const SharedBuffer&>(to);
  if (bytes > shared.size() || bytes > from.size())
    throw InputError("GPU: " + std::to_string(bytes) + " bytes of pictures for " + std::to_string(shared.size()) + " of memory");
  if (bytes == 0) return;
  device.Run([&](VkCommandBuffer commands) {
    // After whatever wrote the pictures; what the buffer held is not wanted, so it need not be taken back from its reader.
    const VkMemoryBarrier before{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &before, 0, nullptr, 0,
                         nullptr);
    const VkBufferCopy copy{0, 0, bytes};
    vkCmdCopyBuffer(commands, from.handle(), shared.handle(), 1, &copy);
    // Given to the other interface.
    const VkBufferMemoryBarrier give{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                     nullptr,
                                     VK_ACCESS_TRANSFER_WRITE_BIT,
                                     0,
                                     device.queue_family(),
                                     VK_QUEUE_FAMILY_EXTERNAL,
                                     shared.handle(),
                                     0,
                                     VK_WHOLE_SIZE};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 1, &give, 0,
                         nullptr);
  });
}

}  // namespace airsim360::internal
