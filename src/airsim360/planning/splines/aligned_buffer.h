// Scratch memory that only grows, aligned for SIMD vectors.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace airsim360::internal {

class AlignedBuffer {
 public:
  /// At least `size` doubles at a multiple of 64 bytes; what was there is lost when the buffer grows.
  double* Reserve(size_t size) {
    if (size > size_) {
      data_.reset(static_cast<double*>(std::aligned_alloc(64, (size * sizeof(double) + 63) / 64 * 64)));
      if (data_ == nullptr) throw std::bad_alloc();
      size_ = size;
    }
    return data_.get();
  }
  double* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  size_t size_ = 0;
};

}  // namespace airsim360::internal
