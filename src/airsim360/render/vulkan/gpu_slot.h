// One of the frames in flight: its commands, parameters, pictures and the instants it shows.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "airsim360/render/vulkan/gpu_cameras.h"
#include "airsim360/render/vulkan/gpu_high.h"
#include "airsim360/render/vulkan/gpu_instant.h"
#include "airsim360/render/vulkan/gpu_pipeline.h"

namespace airsim360::internal {

class GpuSlot {
 public:
  GpuSlot(GpuDevice& device, const GpuScene& scene);
  ~GpuSlot();
  GpuSlot(const GpuSlot&) = delete;
  GpuSlot& operator=(const GpuSlot&) = delete;

  static constexpr size_t kProducts = 11;  ///< kinds of pictures
  uint64_t ticket = 0;                     ///< of the submission in this slot; 0 = free

  /// What a submission runs.
  struct Work {
    struct Pass {
      const GpuPipeline* pipeline;
      int32_t number = 0;    ///< for shaders that do several things
      int32_t paths = 0;     ///< of a pixel; tier `reference`
      bool is_long = false;  ///< starts a submission of its own, so that none takes so long that a driver gives up
    };
    std::vector<Pass> passes;                       ///< one after another, each once for each pixel
    VkDeviceAddress shade = 0, high = 0, path = 0;  ///< GpuShade of colour tiers, GpuHigh, GpuPath
    float exposure = 1;
    size_t numbers = 0;             ///< that passes keep of each pixel for each other
    GpuHistory* history = nullptr;  ///< tier `high`, where light of the last frame is mixed in
    uint64_t frames = 0;            ///< that are added up (RenderRequest::temporal)
    bool read_back = true;          ///< pictures go to memory of the CPU
  };
  /// Starts `work` on all requests. The slot must be free.
  void Submit(std::span<const RenderRequest> requests, GpuCameras& cameras, const Work& work);
  /// Waits for the GPU. RuntimeError if it was lost.
  void Wait();
  /// Of empty spans where the pictures were not read back.
  std::vector<GpuFrame> Frames() const { return FramesAt(reads_back_ ? read_back_.mapped() : nullptr); }
  /// The same for a copy of the pictures at `base`.
  std::vector<GpuFrame> FramesAt(const std::byte* base) const;
  /// Where the GPU left the pictures, one after another, and how many bytes they are.
  const GpuBuffer& pictures() const { return device_.discrete() ? pictures_ : read_back_; }
  size_t bytes() const { return bytes_; }
  /// Time of the last tracing, by the clock of the GPU; after Wait.
  double gpu_ms() const { return gpu_ms_; }

 private:
  struct Place {
    size_t offset[kProducts];  // of each product in the pictures; kNowhere = not wanted
    int width, height;
    size_t entity, centers, planes;  // what passes leave for each other: behind all pictures
  };
  void Arrange(std::span<const RenderRequest> requests, const Work& work);
  size_t ArrangePasses(std::span<const RenderRequest> requests, const Work& work);
  void FillParameters(std::span<const RenderRequest> requests, GpuCameras& cameras, const Work& work);
  VkCommandBuffer Begin();
  void Record(const Work& work);
  void RecordPasses(const Work& work, VkCommandBuffer commands);
  void RecordCopy();
  void Start();

  GpuDevice& device_;
  const GpuScene& scene_;
  VkCommandPool pool_ = VK_NULL_HANDLE, copy_pool_ = VK_NULL_HANDLE;
  std::vector<VkCommandBuffer> commands_;  // one after another; the first `parts_` of them are used
  VkCommandBuffer copy_ = VK_NULL_HANDLE;  // for the queue that copies
  size_t parts_ = 0;
  VkSemaphore traced_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool clock_ = VK_NULL_HANDLE;
  GpuInstant now_;
  std::unique_ptr<GpuInstant> next_;  // made when flow first needs it
  bool flows_ = false, waited_ = true, reads_back_ = true;
  GpuBuffer upload_, pictures_, read_back_;  // pictures_ is empty where the GPU writes to read_back_ itself
  std::vector<Place> places_;
  size_t bytes_ = 0;  // of all pictures
  uint32_t width_ = 0, height_ = 0;
  uint64_t parameters_ = 0;
  double gpu_ms_ = 0;
};

}  // namespace airsim360::internal
