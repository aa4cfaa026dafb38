#include "airsim360/render/cuda/cuda_pictures.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/render/cuda/cuda_driver.h"

namespace airsim360 {
namespace {

using internal::CudaAddress;
using internal::CudaDevice;

const std::byte* Pointer(CudaAddress address) { return reinterpret_cast<const std::byte*>(address); }
CudaAddress Address(const void* pointer) { return reinterpret_cast<CudaAddress>(pointer); }

}  // namespace

// Memory that both know. Opened once and used again and again.
struct CudaRenderer::Room {
  Room(const CudaDevice& device, std::unique_ptr<GpuSharedMemory> memory)
      : cuda(device),
        vulkan(std::move(memory)),
        import(cuda.Open(vulkan->Open(), vulkan->allocated(), vulkan->size(), vulkan->dedicated())) {}
  // CUDA lets go first.
  ~Room() { cuda.Close(import); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  const CudaDevice& cuda;
  std::unique_ptr<GpuSharedMemory> vulkan;
  CudaDevice::Import import;
};

// What outlives the renderer while pictures do: memory goes before the device that it is of.
struct CudaRenderer::Shared {
  std::unique_ptr<GpuRenderer> gpu;
  std::unique_ptr<CudaDevice> cuda;
  std::vector<std::shared_ptr<Room>> rooms;  // held by nobody else: free

  std::shared_ptr<Room> FreeRoom(size_t bytes) {
    const auto is_free = [](const std::shared_ptr<Room>& room) { return room.use_count() == 1; };
    for (const std::shared_ptr<Room>& room : rooms) {
      if (!is_free(room) || room->vulkan->size() < bytes) continue;
      // Whoever let go of it may still have work on a stream that reads it.
      std::atomic_thread_fence(std::memory_order_acquire);
      cuda->Synchronize();
      return room;
    }
    // Free ones are too small.
    if (std::ranges::any_of(rooms, is_free)) cuda->Synchronize();
    std::erase_if(rooms, is_free);
    return rooms.emplace_back(std::make_shared<Room>(*cuda, gpu->Share(bytes)));
  }
};

class CudaRenderer::Pictures : public CudaPictures {
 public:
  Pictures(std::shared_ptr<Shared> shared, std::shared_ptr<Room> room, const GpuFrame& frame)
      : shared_(std::move(shared)), room_(std::move(room)), frame_(frame) {}

  int ordinal() const override { return room_->cuda.ordinal(); }
  const GpuFrame& frame() const override { return frame_; }
  std::shared_ptr<const void> CopyOnDevice(const void* from, size_t size, void* stream) const override {
    const CudaAddress address = room_->cuda.Allocate(size);
    const std::shared_ptr<const void> copy(Pointer(address), [shared = shared_](const void* p) { shared->cuda->Free(Address(p)); });
    room_->cuda.CopyOnDevice(address, Address(from), size, stream);
    return copy;
  }
  void CopyToHost(void* to, const void* from, size_t size) const override { room_->cuda.CopyToHost(to, Address(from), size); }

 private:
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<Room> room_;  // goes before what it is of
  GpuFrame frame_;
};

CudaRenderer::CudaRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options, const GpuOptions& gpu)
    : shared_(std::make_shared<Shared>()) {
  shared_->gpu = MakeVulkanRenderer(std::move(tracer), options, gpu);
  shared_->gpu->ReadBack(false);
  shared_->cuda = std::make_unique<CudaDevice>(shared_->gpu->gpu().uuid);
}

CudaRenderer::~CudaRenderer() = default;

RenderStats CudaRenderer::Render(const RenderRequest& request, Frame& frame) {
  const auto start = std::chrono::steady_clock::now();
  if (request.auto_exposure) throw InputError("CUDA: automatic exposure is found on the CPU; give exposure_ev");
  if (request.light) throw InputError("CUDA: a look is made on the CPU; take look clean");
  taken_.reset();
  frame = {};
  GpuRenderer& gpu = *shared_->gpu;
  const uint64_t ticket = gpu.Submit({&request, 1});
  try {
    const size_t bytes = gpu.PictureBytes(ticket);
    if (bytes == 0) throw InputError("CUDA: a capture without pictures");
    const std::shared_ptr<Room> room = shared_->FreeRoom(bytes);
    const std::vector<GpuFrame> frames = gpu.Copy(ticket, *room->vulkan, Pointer(room->import.address));
    taken_ = std::make_shared<const Pictures>(shared_, room, frames.front());
  } catch (...) {
    gpu.Release(ticket);
    throw;
  }
  gpu.Release(ticket);
  RenderStats stats;
  stats.rays = static_cast<uint64_t>(Width(request.camera)) * static_cast<uint64_t>(Height(request.camera));
  stats.render_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

std::shared_ptr<const CudaPictures> CudaRenderer::Take() { return std::move(taken_); }

const GpuInfo& CudaRenderer::gpu() const { return shared_->gpu->gpu(); }

}  // namespace airsim360
