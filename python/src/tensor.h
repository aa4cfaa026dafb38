// What DLPack exports: a picture in memory of the CPU or of a CUDA device.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "airsim360/render/cuda/cuda_pictures.h"
#include "convert.h"

namespace airsim360::python {

/// Kind of number, as DLPack counts them.
struct TensorType {
  enum Code : uint8_t { kInt = 0, kUint = 1, kFloat = 2 } code;
  uint8_t bits;
};

struct Tensor {
  const void* data = nullptr;
  TensorType type{TensorType::kUint, 8};
  std::vector<int64_t> shape, strides;           ///< strides in numbers, not bytes
  std::shared_ptr<const void> keep;              ///< the memory
  int cuda = -1;                                 ///< ordinal of the CUDA device; -1: the CPU
  std::shared_ptr<const CudaPictures> pictures;  ///< where `cuda` is a device
};

/// A picture of scalars T as (H, W), or of `channels` of them a pixel as (H, W, channels); empty spans give no data.
template <class T, class Pixel>
Tensor CudaTensor(std::span<const Pixel> picture, int channels, const std::shared_ptr<const CudaPictures>& pictures) {
  Tensor tensor;
  tensor.data = picture.data();
  tensor.type = {std::is_floating_point_v<T> ? TensorType::kFloat : TensorType::kUint, 8 * sizeof(T)};
  const GpuFrame& frame = pictures->frame();
  constexpr int64_t kPixel = sizeof(Pixel) / sizeof(T);
  tensor.shape = {frame.height, frame.width}, tensor.strides = {kPixel * frame.width, kPixel};
  if (channels > 0) tensor.shape.push_back(channels), tensor.strides.push_back(1);
  tensor.keep = tensor.pictures = pictures;
  tensor.cuda = pictures->ordinal();
  return tensor;
}

}  // namespace airsim360::python
