// Buffers on the GPU, each with a device address; an arena for everything that lives as long as the scene.
#pragma once

#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "airsim360/render/vulkan/gpu_device.h"

namespace airsim360::internal {

enum class MemoryKind {
  kDevice,    ///< fast for the GPU
  kUpload,    ///< written by the CPU, coherent
  kReadBack,  ///< read by the CPU through its caches
};

/// One buffer with memory of its own.
class GpuBuffer {
 public:
  GpuBuffer() = default;
  /// RuntimeError where there is no memory left. `size` 0 gives an empty buffer without an address.
  GpuBuffer(GpuDevice& device, size_t size, MemoryKind kind);
  ~GpuBuffer() { Free(); }
  GpuBuffer(GpuBuffer&& other) noexcept { *this = std::move(other); }
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;

  VkBuffer handle() const { return buffer_; }
  VkDeviceAddress address() const { return address_; }
  size_t size() const { return size_; }
  /// Memory as the CPU sees it; nullptr for most kDevice buffers of GPUs with memory of their own.
  std::byte* mapped() const { return mapped_; }
  /// Makes what the GPU wrote visible to the CPU, where memory is not coherent.
  void Invalidate() const;

 private:
  void Free();

  GpuDevice* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceAddress address_ = 0;
  size_t size_ = 0;
  std::byte* mapped_ = nullptr;
  bool coherent_ = true;
};

/// Part of a block of an arena.
struct GpuRange {
  VkBuffer buffer = VK_NULL_HANDLE;
  size_t offset = 0;
  VkDeviceAddress address = 0;
  std::byte* mapped = nullptr;  ///< as the CPU sees it; nullptr where it does not
};

/// Memory handed out in one direction from a few large allocations (drivers allow 4,096), given back all at once.
class GpuArena {
 public:
  explicit GpuArena(GpuDevice& device, MemoryKind kind = MemoryKind::kDevice) : device_(device), kind_(kind) {}
  /// Aligned to 256 bytes; 16 bytes are added at the end, so that wide reads of the last element stay inside.
  GpuRange Take(size_t size);
  /// Takes a range and fills it.
  GpuRange Put(std::span<const std::byte> bytes);
  template <class T, class Allocator>
  GpuRange Put(const std::vector<T, Allocator>& values) {
    return Put(std::as_bytes(std::span<const T>(values)));
  }
  /// Copies bytes to a range, through a staging buffer where the CPU does not see the memory: there they arrive with Flush.
  void Write(const GpuRange& range, std::span<const std::byte> bytes);
  /// Brings all that was written to where it belongs; call it before the GPU reads.
  void Flush();
  /// Flushes and frees the staging buffer; call it when loading is over.
  void EndUploads() {
    Flush();
    staging_ = GpuBuffer();
  }

 private:
  struct Copy {
    VkBuffer to;
    VkBufferCopy part;
  };

  GpuDevice& device_;
  MemoryKind kind_;
  std::vector<GpuBuffer> blocks_;
  size_t next_ = 0;  // in the last block
  GpuBuffer staging_;
  size_t staged_ = 0;
  std::vector<Copy> copies_;  // from the staging buffer
};

}  // namespace airsim360::internal
