// The CUDA driver (libcuda.so.1), opened at run time: nothing of CUDA is needed to build or to run without it. Names and
// layouts are those of the driver's public interface (CUDA driver API, version 10.2 and later).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace airsim360::internal {

/// Address in memory of a CUDA device.
using CudaAddress = unsigned long long;

/// One device of the driver with its primary context, which PyTorch, JAX and CuPy use too.
class CudaDevice {
 public:
  /// The device with that UUID. RuntimeError: no driver ($AIRSIM360_LIBCUDA, else libcuda.so.1), no device, none with that UUID.
  explicit CudaDevice(const std::array<uint8_t, 16>& uuid);
  ~CudaDevice();
  CudaDevice(const CudaDevice&) = delete;
  CudaDevice& operator=(const CudaDevice&) = delete;

  int ordinal() const { return ordinal_; }

  /// Opens memory by an opaque file descriptor, which is taken over; at its `size` bytes. RuntimeError if the driver refuses.
  struct Import {
    void* memory = nullptr;
    CudaAddress address = 0;
  };
  Import Open(int fd, size_t allocated, size_t size, bool dedicated) const;
  void Close(const Import& import) const noexcept;

  /// Waits for all work of the device's primary context.
  void Synchronize() const;
  /// Memory of the device, and copies. Copies on a `stream` are done when the stream comes to them.
  CudaAddress Allocate(size_t size) const;
  void Free(CudaAddress address) const noexcept;
  void CopyOnDevice(CudaAddress to, CudaAddress from, size_t size, void* stream) const;
  void CopyToHost(void* to, CudaAddress from, size_t size) const;

 private:
  struct Api;
  class Current;
  void Check(int result, const char* what) const;

  std::shared_ptr<const Api> api_;
  int ordinal_ = -1, device_ = -1;
  void* context_ = nullptr;
};

}  // namespace airsim360::internal
