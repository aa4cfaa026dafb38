#include "airsim360/render/cuda/cuda_driver.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr int kOpaqueFd = 1;        // CU_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD
constexpr unsigned kDedicated = 1;  // CUDA_EXTERNAL_MEMORY_DEDICATED

// CUDA_EXTERNAL_MEMORY_HANDLE_DESC and CUDA_EXTERNAL_MEMORY_BUFFER_DESC.
struct MemoryHandle {
  int type;
  union {
    int fd;
    struct {
      void* handle;
      const void* name;
    } win32;
  } handle;
  unsigned long long size;
  unsigned flags, reserved[16];
};
struct MemoryBuffer {
  unsigned long long offset, size;
  unsigned flags, reserved[16];
};
static_assert(sizeof(MemoryHandle) == 104 && sizeof(MemoryBuffer) == 88);

}  // namespace

struct CudaDevice::Api {
  int (*init)(unsigned);
  int (*device_count)(int*);
  int (*device_get)(int*, int);
  int (*device_uuid)(void*, int);
  int (*retain)(void**, int);
  int (*release)(int);
  int (*push)(void*);
  int (*pop)(void**);
  int (*error_string)(int, const char**);
  int (*import_memory)(void**, const MemoryHandle*);
  int (*mapped_buffer)(CudaAddress*, void*, const MemoryBuffer*);
  int (*destroy_memory)(void*);
  int (*free)(CudaAddress);
  int (*allocate)(CudaAddress*, size_t);
  int (*copy_to_host)(void*, CudaAddress, size_t);
  int (*copy_on_device)(CudaAddress, CudaAddress, size_t, void*);
  int (*synchronize)();

  Api() {
    const char* given = std::getenv("AIRSIM360_LIBCUDA");
    const std::string path = given != nullptr && *given != '\0' ? given : "libcuda.so.1";
    // Stays open: the driver does not like to be closed.
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw RuntimeError("CUDA: no driver: " + std::string(::dlerror()) + "; use memory=\"cpu\", or install the driver of the NVIDIA GPU");
    const auto load = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(library, name));
      return function != nullptr;
    };
    const auto need = [&](auto& function, const char* name) {
      if (!load(function, name))
        throw RuntimeError("CUDA: " + path + " has no " + name + ": the driver is older than CUDA 10.2; update it");
    };
    need(init, "cuInit");
    need(device_count, "cuDeviceGetCount");
    need(device_get, "cuDeviceGet");
    // The second version tells parts of a GPU (MIG) apart.
    if (!load(device_uuid, "cuDeviceGetUuid_v2")) need(device_uuid, "cuDeviceGetUuid");
    need(retain, "cuDevicePrimaryCtxRetain");
    if (!load(release, "cuDevicePrimaryCtxRelease_v2")) need(release, "cuDevicePrimaryCtxRelease");
    need(push, "cuCtxPushCurrent_v2");
    need(pop, "cuCtxPopCurrent_v2");
    need(error_string, "cuGetErrorString");
    need(import_memory, "cuImportExternalMemory");
    need(mapped_buffer, "cuExternalMemoryGetMappedBuffer");
    need(destroy_memory, "cuDestroyExternalMemory");
    need(free, "cuMemFree_v2");
    need(allocate, "cuMemAlloc_v2");
    need(copy_to_host, "cuMemcpyDtoH_v2");
    need(copy_on_device, "cuMemcpyDtoDAsync_v2");
    need(synchronize, "cuCtxSynchronize");
  }
};

// The primary context is the thread's while this lives.
class CudaDevice::Current {
 public:
  explicit Current(const CudaDevice& device) : device_(device) { device.Check(device.api_->push(device.context_), "taking the context"); }
  ~Current() {
    void* context = nullptr;
    device_.api_->pop(&context);
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  const CudaDevice& device_;
};

void CudaDevice::Check(int result, const char* what) const {
  if (result == 0) return;
  const char* text = nullptr;
  api_->error_string(result, &text);
  throw RuntimeError(std::string("CUDA: ") + what + ": " + (text ? text : "error") + " (" + std::to_string(result) + ")");
}

CudaDevice::CudaDevice(const std::array<uint8_t, 16>& uuid) : api_(std::make_shared<const Api>()) {
  Check(api_->init(0), "starting the driver");
  int count = 0;
  Check(api_->device_count(&count), "counting devices");
  for (int i = 0; i < count && ordinal_ < 0; ++i) {
    std::array<uint8_t, 16> its{};
    Check(api_->device_get(&device_, i), "opening a device");
    Check(api_->device_uuid(its.data(), device_), "identifying a device");
    if (its == uuid) ordinal_ = i;
  }
  if (ordinal_ < 0)
    throw RuntimeError("CUDA: none of its " + std::to_string(count) +
                       " devices is the GPU that renders; choose another with gpu=, or use memory=\"cpu\"");
  Check(api_->retain(&context_, device_), "opening the primary context");
}

CudaDevice::~CudaDevice() {
  if (context_ != nullptr) api_->release(device_);
}

CudaDevice::Import CudaDevice::Open(int fd, size_t allocated, size_t size, bool dedicated) const {
  Import import;
  try {
    const Current current(*this);
    MemoryHandle handle{};
    handle.type = kOpaqueFd;
    handle.handle.fd = fd;
    handle.size = allocated;
    handle.flags = dedicated ? kDedicated : 0;
    Check(api_->import_memory(&import.memory, &handle), "opening memory of Vulkan");
    fd = -1;  // the driver's from now on
    MemoryBuffer buffer{};
    buffer.size = size;
    Check(api_->mapped_buffer(&import.address, import.memory, &buffer), "mapping memory of Vulkan");
  } catch (...) {
    if (fd >= 0) ::close(fd);
    if (import.memory != nullptr) Close(import);
    throw;
  }
  return import;
}

void CudaDevice::Close(const Import& import) const noexcept {
  void* context = nullptr;
  if (api_->push(context_) != 0) return;
  if (import.address != 0) api_->free(import.address);
  if (import.memory != nullptr) api_->destroy_memory(import.memory);
  api_->pop(&context);
}

void CudaDevice::Synchronize() const {
  const Current current(*this);
  Check(api_->synchronize(), "waiting for the device");
}

CudaAddress CudaDevice::Allocate(size_t size) const {
  const Current current(*this);
  CudaAddress address = 0;
  Check(api_->allocate(&address, size), "allocating memory");
  return address;
}

void CudaDevice::Free(CudaAddress address) const noexcept { Close({nullptr, address}); }

void CudaDevice::CopyOnDevice(CudaAddress to, CudaAddress from, size_t size, void* stream) const {
  const Current current(*this);
  Check(api_->copy_on_device(to, from, size, stream), "copying");
}

void CudaDevice::CopyToHost(void* to, CudaAddress from, size_t size) const {
  const Current current(*this);
  Check(api_->copy_to_host(to, from, size), "copying to memory of the CPU");
}

}  // namespace airsim360::internal
