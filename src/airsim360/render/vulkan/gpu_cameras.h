// Cameras of a request as shaders read them, with the same tables of rays as the CPU's.
#pragma once

#include <map>
#include <vector>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/vulkan/gpu_memory.h"
#include "airsim360/render/vulkan/gpu_records.h"

namespace airsim360::internal {

/// Memory of a frame that the CPU fills from front to back.
struct UploadCursor {
  std::byte* mapped;
  VkDeviceAddress address;
  size_t next = 0, size = 0;
  /// A place of `bytes`, aligned to 64; its address goes to `where`.
  std::byte* Take(size_t bytes, uint64_t& where);
};

/// Colour samples of a pixel on an edge; 1 = no antialiasing.
int ColorSamples(const RenderRequest& request);
/// Points of a pixel on an edge that any pass uses, its centre included.
int PointsOfPixel(const RenderRequest& request);
/// Paths of a pixel in tier `reference`.
int PathSamples(const RenderRequest& request);

/// Rotation from the frame of a camera's projection (of cube faces: the face's) to W, of its canonical columns.
Mat3d FromProjection(const Camera& camera, const RayField& field);

class GpuCameras {
 public:
  explicit GpuCameras(GpuDevice& device) : device_(device) {}
  /// Bytes that Fill takes for a request.
  static size_t Size(const RenderRequest& request);
  /// Fills all of `out` but the addresses of pictures. InputError for a camera without pixels, a pose that is not finite, flow
  /// without the next pose. `frames` is the number of those that are added up (RenderRequest::temporal).
  void Fill(const RenderRequest& request, uint64_t frames, UploadCursor& upload, GpuCamera& out);
  /// Rays of the camera that was filled last.
  const RayField& field() const { return rays_.field(); }
  /// Forgets tables of cameras where there are many; only while the GPU is idle.
  void Trim();

 private:
  VkDeviceAddress Table(const Camera& camera, const RayField& field);
  void FillOffsets(int points, UploadCursor& upload, GpuCamera& out);
  void FillNext(const RenderRequest& request, GpuCamera& out);
  void FillHigh(const RenderRequest& request, uint64_t frames, UploadCursor& upload, GpuCamera& out);

  GpuDevice& device_;
  CameraRays rays_, next_rays_;
  std::map<std::vector<double>, GpuBuffer> tables_;  // rays of cameras that are not panoramas
};

}  // namespace airsim360::internal
