// Rendering into memory of a CUDA device: what PyTorch and others read without the pictures ever leaving the GPU.
#pragma once

#include <memory>

#include "airsim360/render/vulkan/gpu.h"

namespace airsim360 {

/// Pictures in memory of a CUDA device. Lives as long as anybody holds it, whatever becomes of the renderer.
class CudaPictures {
 public:
  virtual ~CudaPictures() = default;
  /// Ordinal of the device in CUDA's list.
  virtual int ordinal() const = 0;
  /// Of the pictures: the spans hold addresses of the device, not to be read by the CPU.
  virtual const GpuFrame& frame() const = 0;
  /// A new copy of `size` bytes of the device's memory, done when `stream` comes to it; freed with the pointer.
  virtual std::shared_ptr<const void> CopyOnDevice(const void* from, size_t size, void* stream) const = 0;
  /// Copies to memory of the CPU.
  virtual void CopyToHost(void* to, const void* from, size_t size) const = 0;
};

/// The GPU renderer of the device that CUDA knows by the same UUID. Its frames stay empty: the pictures are those of Take.
class CudaRenderer : public Renderer {
 public:
  /// RuntimeError: no GPU as of MakeVulkanRenderer, one that shares no memory, no CUDA driver, another device.
  CudaRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options, const GpuOptions& gpu);
  ~CudaRenderer() override;

  /// InputError as GpuRenderer, and for automatic exposure, which is found on the CPU.
  RenderStats Render(const RenderRequest& request, Frame& frame) override;
  /// The pictures of the last Render. They are complete: no stream has to wait for them.
  std::shared_ptr<const CudaPictures> Take();
  const GpuInfo& gpu() const;

 private:
  struct Room;
  struct Shared;
  class Pictures;

  std::shared_ptr<Shared> shared_;
  std::shared_ptr<const CudaPictures> taken_;
};

}  // namespace airsim360
