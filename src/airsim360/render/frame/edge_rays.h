// Rays of edge pixels on their way through tracing (16 at a time) and shading (256 at a time).
#pragma once

#include <cmath>
#include <cstdint>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/frame/packet_tracer.h"

namespace airsim360::internal {

class EdgeRays {
 public:
  virtual ~EdgeRays() = default;
  EdgeRays(const EdgeRays&) = delete;
  EdgeRays& operator=(const EdgeRays&) = delete;

  int pixel_count() const { return pixel_count_; }
  int ray_count() const { return ray_count_; }

  /// Adds a ray of a pixel; `key` chooses its random numbers.
  void AddRay(int pixel, Vec3d direction, uint32_t key) {
    packet_.direction_x[lanes_] = static_cast<float>(direction.x);
    packet_.direction_y[lanes_] = static_cast<float>(direction.y);
    packet_.direction_z[lanes_] = static_cast<float>(direction.z);
    hits_.sample_key[hits_.count + lanes_] = key;
    owner_[hits_.count + lanes_] = pixel;
    ++ray_count_;
    if (++lanes_ == 16) Trace();
  }
  /// Traces and shades what is left.
  void Finish() {
    if (lanes_ > 0) Trace();
    if (hits_.count > 0) ShadeAll();
  }

 protected:
  /// Of `task`: tracer, rays, labels, origin, samples of a pixel.
  template <class Task>
  EdgeRays(const Task& task, const TileKernels& kernels) : kernels_(kernels), tracer_(*task.tracer), edge_labels_(task.labels) {
    hits_.origin = task.origin;
    hits_.cone_angle = static_cast<float>(task.rays->cone_angle() / std::sqrt(task.samples));
    kernels.init(task.origin.x, task.origin.y, task.origin.z, packet_);
  }
  /// Sixteen rays were traced, the `packet`-th of `hits_`.
  virtual void Traced(const int*, int) {}
  /// Takes what all of `hits_` show to the pixels `owner_`.
  virtual void Shade() = 0;

  const TileKernels& kernels_;
  int pixel_count_ = 0;
  RayHit16 packet_;
  HitBatch hits_;
  int owner_[HitBatch::kCapacity];  // pixel of each ray

 private:
  void Trace() {
    alignas(64) int valid[16];
    TraceLanes(tracer_, edge_labels_.sky_entity != kNoEntity, lanes_, valid, packet_);
    kernels_.append_hits(edge_labels_, packet_, valid, hits_.count / 16, hits_);
    Traced(valid, hits_.count / 16);
    hits_.count += lanes_;
    lanes_ = 0;
    if (hits_.count > HitBatch::kCapacity - 16) ShadeAll();
  }
  void ShadeAll() {
    Shade();
    hits_.count = 0;
  }

  const RayTracer& tracer_;
  const LabelView edge_labels_;
  int lanes_ = 0, ray_count_ = 0;
};

}  // namespace airsim360::internal
