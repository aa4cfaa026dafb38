#include "airsim360/render/vulkan/gpu_memory.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

// Few cards let the CPU see much of their memory: blocks of that are smaller.
constexpr size_t kBlock = size_t{32} << 20, kUploadBlock = size_t{4} << 20, kStaging = size_t{32} << 20, kAlign = 256, kTail = 16;

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR;

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                                kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// Wishes in order; the last one is the least that will do.
std::array<VkMemoryPropertyFlags, 3> WishesOf(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::kUpload:
      return {kVisible | kCoherent | kLocal, kVisible | kCoherent, kVisible | kCoherent};
    case MemoryKind::kReadBack:
      return {kVisible | kCached | kCoherent, kVisible | kCached, kVisible | kCoherent};
    case MemoryKind::kDevice:
      break;
  }
  return {kLocal, 0, 0};
}

void CheckSize(const GpuDevice& device, size_t size) {
  if (size <= device.most_memory()) return;
  const auto gib = [](size_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / (1 << 30));
    return std::string(text);
  };
  throw RuntimeError("GPU: " + gib(size) + " in one piece are more than " + device.info().name + " gives (" + gib(device.most_memory()) +
                     "): render a smaller picture or fewer cameras");
}

size_t RoundUp(size_t n) { return (n + kAlign - 1) / kAlign * kAlign; }

}  // namespace

GpuBuffer::GpuBuffer(GpuDevice& device, size_t size, MemoryKind kind) : device_(&device), size_(size) {
  if (size == 0) return;
  CheckSize(device, size);
  const VkDevice d = device.device();
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, nullptr};
  info.size = size;
  info.usage = kUsage;
  // Pictures are written by one queue and copied by another.
  const uint32_t families[2] = {device.queue_family(), device.copy_family()};
  if (families[0] != families[1]) {
    info.sharingMode = VK_SHARING_MODE_CONCURRENT;
    info.queueFamilyIndexCount = 2;
    info.pQueueFamilyIndices = families;
  }
  try {
    CheckVk(vkCreateBuffer(d, &info, nullptr, &buffer_), "making a buffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(d, buffer_, &needs);

    // Types in the order of the wishes, the next one where a heap is full.
    const VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr, VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (device.fault() == GpuFault::kNoMemory) CheckVk(result, "allocating memory");
    if (device.fault() == GpuFault::kNoFrameMemory && kind == MemoryKind::kReadBack) CheckVk(result, "allocating memory");
    VkMemoryPropertyFlags got = 0;
    for (const VkMemoryPropertyFlags wish : WishesOf(kind)) {
      for (uint32_t i = 0; i < device.memory().memoryTypeCount && memory_ == VK_NULL_HANDLE; ++i) {
        got = device.memory().memoryTypes[i].propertyFlags;
        if ((needs.memoryTypeBits >> i & 1) == 0 || (got & wish) != wish) continue;
        const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, needs.size, i};
        result = vkAllocateMemory(d, &allocate, nullptr, &memory_);
        if (result >= 0) break;
      }
      if (memory_ != VK_NULL_HANDLE) break;
    }
    CheckVk(result, "allocating memory");
    CheckVk(vkBindBufferMemory(d, buffer_, memory_, 0), "binding memory");
    coherent_ = (got & kCoherent) != 0;
    if ((got & kVisible) && !(kind == MemoryKind::kDevice && device.discrete())) {
      void* p;
      CheckVk(vkMapMemory(d, memory_, 0, VK_WHOLE_SIZE, 0, &p), "mapping memory");
      mapped_ = static_cast<std::byte*>(p);
    }
    const VkBufferDeviceAddressInfo address{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer_};
    address_ = vkGetBufferDeviceAddress(d, &address);
  } catch (...) {
    Free();
    throw;
  }
}

GpuBuffer& GpuBuffer::operator=(GpuBuffer&& other) noexcept {
  if (this == &other) return *this;
  Free();
  device_ = other.device_, size_ = std::exchange(other.size_, 0);
  buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
  memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
  address_ = std::exchange(other.address_, 0);
  mapped_ = std::exchange(other.mapped_, nullptr);
  coherent_ = other.coherent_;
  return *this;
}

void GpuBuffer::Free() {
  if (buffer_ != VK_NULL_HANDLE) vkDestroyBuffer(device_->device(), buffer_, nullptr);
  if (memory_ != VK_NULL_HANDLE) vkFreeMemory(device_->device(), memory_, nullptr);
  buffer_ = VK_NULL_HANDLE, memory_ = VK_NULL_HANDLE, address_ = 0, size_ = 0, mapped_ = nullptr;
}

void GpuBuffer::Invalidate() const {
  if (coherent_ || memory_ == VK_NULL_HANDLE) return;
  const VkMappedMemoryRange range{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, memory_, 0, VK_WHOLE_SIZE};
  CheckVk(vkInvalidateMappedMemoryRanges(device_->device(), 1, &range), "reading back");
}

GpuRange GpuArena::Take(size_t size) {
  const size_t rounded = RoundUp(size + kTail);
  if (blocks_.empty() || next_ + rounded > blocks_.back().size()) {
    // A small rest is given up; a large request gets a block of its own.
    blocks_.emplace_back(device_, std::max(kind_ == MemoryKind::kUpload ? kUploadBlock : kBlock, rounded), kind_);
    next_ = 0;
  }
  const GpuBuffer& block = blocks_.back();
  const GpuRange range{block.handle(), next_, block.address() + next_, block.mapped() != nullptr ? block.mapped() + next_ : nullptr};
  next_ += rounded;
  return range;
}

GpuRange GpuArena::Put(std::span<const std::byte> bytes) {
  const GpuRange range = Take(bytes.size());
  if (!bytes.empty()) Write(range, bytes);
  return range;
}

void GpuArena::Write(const GpuRange& range, std::span<const std::byte> bytes) {
  if (range.mapped != nullptr) {
    std::memcpy(range.mapped, bytes.data(), bytes.size());
    return;
  }
  if (staging_.size() == 0) staging_ = GpuBuffer(device_, kStaging, MemoryKind::kUpload);
  for (size_t done = 0; done < bytes.size();) {
    if (staged_ == kStaging) Flush();
    const size_t n = std::min(kStaging - staged_, bytes.size() - done);
    std::memcpy(staging_.mapped() + staged_, bytes.data() + done, n);
    copies_.push_back({range.buffer, {staged_, range.offset + done, n}});
    staged_ += n, done += n;
  }
}

void GpuArena::Flush() {
  if (copies_.empty()) return;
  device_.Run([&](VkCommandBuffer commands) {
    for (const Copy& copy : copies_) vkCmdCopyBuffer(commands, staging_.handle(), copy.to, 1, &copy.part);
  });
  copies_.clear();
  staged_ = 0;
}

}  // namespace airsim360::internal
