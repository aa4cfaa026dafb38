// A stand-in for NVIDIA's driver (libcuda.so.1): notes every call, checks what it is given, keeps account of what is alive. Its "device memory"
// is that of the CPU: what Mesa's lavapipe shares by a file descriptor is mapped.
#include "fake_cuda.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

namespace {

struct Memory {
  void* map;
  size_t mapped;
};

std::mutex mutex;
std::string calls;
std::map<std::string, int> failures;      // call -> error it gives once
std::map<void*, Memory> memories;         // imported
std::map<unsigned long long, bool> live;  // addresses that cuMemFree takes; true = allocated here
unsigned char uuids[2][16];
int contexts = 0, pushed = 0;
size_t header = 0;  // bytes before the memory in the file

constexpr int kInvalid = 1, kNotFound = 500;

// Notes a call; the error that the test wants of it.
int Note(const std::string& name, const std::string& what = "") {
  calls += name + (what.empty() ? "" : " " + what) + "\n";
  const auto found = failures.find(name);
  if (found == failures.end()) return 0;
  const int error = found->second;
  failures.erase(found);
  return error;
}

// As cuda.h lays them out: a union of a descriptor and two pointers stands after the type.
struct MemoryHandle {
  int type;
  alignas(8) int fd;
  int rest_of_union[3];
  unsigned long long size;
  unsigned flags, reserved[16];
};
static_assert(offsetof(MemoryHandle, fd) == 8 && offsetof(MemoryHandle, size) == 24 && offsetof(MemoryHandle, flags) == 32);
struct MemoryBuffer {
  unsigned long long offset, size;
  unsigned flags, reserved[16];
};

}  // namespace

#define LOCK const std::lock_guard lock(mutex)

extern "C" {

const char* fake_cuda_calls() {
  LOCK;
  static std::string text;
  text = calls;
  return text.c_str();
}
void fake_cuda_forget() {
  LOCK;
  calls.clear();
}
void fake_cuda_set_uuid(int device, const unsigned char* uuid) { std::memcpy(uuids[device], uuid, 16); }
void fake_cuda_fail(const char* call, int error) { failures[call] = error; }
void fake_cuda_set_header(unsigned long long bytes) { header = bytes; }
int fake_cuda_alive() {
  LOCK;
  return static_cast<int>(memories.size() + live.size()) + contexts + pushed;
}

int cuInit(unsigned flags) {
  LOCK;
  return Note("cuInit", std::to_string(flags));
}
int cuDeviceGetCount(int* count) {
  LOCK;
  *count = 2;
  return Note("cuDeviceGetCount");
}
int cuDeviceGet(int* device, int ordinal) {
  LOCK;
  *device = 100 + ordinal;  // a handle is not an ordinal
  return Note("cuDeviceGet", std::to_string(ordinal));
}
int cuDeviceGetUuid_v2(void* uuid, int device) {
  LOCK;
  if (device != 100 && device != 101) return kInvalid;
  std::memcpy(uuid, uuids[device - 100], 16);
  return Note("cuDeviceGetUuid_v2");
}
int cuDevicePrimaryCtxRetain(void** context, int device) {
  LOCK;
  if (const int error = Note("cuDevicePrimaryCtxRetain", std::to_string(device))) return error;
  *context = reinterpret_cast<void*>(static_cast<intptr_t>(7000 + device));
  ++contexts;
  return 0;
}
int cuDevicePrimaryCtxRelease_v2(int device) {
  LOCK;
  --contexts;
  return Note("cuDevicePrimaryCtxRelease_v2", std::to_string(device));
}
int cuCtxPushCurrent_v2(void* context) {
  LOCK;
  if (contexts < 1 || (context != reinterpret_cast<void*>(7100) && context != reinterpret_cast<void*>(7101))) return kInvalid;
  ++pushed;
  return 0;
}
int cuCtxPopCurrent_v2(void** context) {
  LOCK;
  *context = nullptr;
  if (pushed < 1) return kInvalid;
  --pushed;
  return 0;
}
int cuGetErrorString(int error, const char** text) {
  *text = error == kNotFound ? "named symbol not found" : "fake failure";
  return 0;
}
int cuImportExternalMemory(void** memory, const MemoryHandle* handle) {
  LOCK;
  if (const int error = Note("cuImportExternalMemory", "type " + std::to_string(handle->type) + " size " + std::to_string(handle->size) +
                                                           " flags " + std::to_string(handle->flags)))
    return error;
  struct stat file {};
  if (pushed < 1 || ::fstat(handle->fd, &file) != 0 || static_cast<size_t>(file.st_size) < handle->size + header) return kInvalid;
  void* const map = ::mmap(nullptr, static_cast<size_t>(file.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, handle->fd, 0);
  if (map == MAP_FAILED) return kInvalid;
  ::close(handle->fd);  // the driver's from now on
  *memory = map;
  memories[map] = {map, static_cast<size_t>(file.st_size)};
  return 0;
}
int cuExternalMemoryGetMappedBuffer(unsigned long long* address, void* memory, const MemoryBuffer* buffer) {
  LOCK;
  if (const int error =
          Note("cuExternalMemoryGetMappedBuffer", "offset " + std::to_string(buffer->offset) + " size " + std::to_string(buffer->size)))
    return error;
  const auto found = memories.find(memory);
  if (found == memories.end() || pushed < 1 || header + buffer->offset + buffer->size > found->second.mapped) return kInvalid;
  *address = reinterpret_cast<unsigned long long>(memory) + header + buffer->offset;
  live[*address] = false;
  return 0;
}
int cuDestroyExternalMemory(void* memory) {
  LOCK;
  const int error = Note("cuDestroyExternalMemory");
  const auto found = memories.find(memory);
  if (found == memories.end()) return kInvalid;
  for (const auto& [address, own] : live) {
    const auto begin = reinterpret_cast<unsigned long long>(memory);
    if (!own && address >= begin && address < begin + found->second.mapped) calls += "error: memory destroyed before its buffer\n";
  }
  ::munmap(found->second.map, found->second.mapped);
  memories.erase(found);
  return error;
}
int cuMemAlloc_v2(unsigned long long* address, size_t size) {
  LOCK;
  if (const int error = Note("cuMemAlloc_v2", std::to_string(size))) return error;
  *address = reinterpret_cast<unsigned long long>(std::malloc(size));
  live[*address] = true;
  return 0;
}
int cuMemFree_v2(unsigned long long address) {
  LOCK;
  const int error = Note("cuMemFree_v2");
  const auto found = live.find(address);
  if (found == live.end()) {
    calls += "error: freed what is not alive\n";
    return kInvalid;
  }
  if (found->second) std::free(reinterpret_cast<void*>(address));
  live.erase(found);
  return error;
}
int cuMemcpyDtoH_v2(void* to, unsigned long long from, size_t size) {
  LOCK;
  if (const int error = Note("cuMemcpyDtoH_v2", std::to_string(size))) return error;
  std::memcpy(to, reinterpret_cast<const void*>(from), size);
  return pushed < 1 ? kInvalid : 0;
}
int cuMemcpyDtoDAsync_v2(unsigned long long to, unsigned long long from, size_t size, void* stream) {
  LOCK;
  const std::string what = std::to_string(size) + " stream " + std::to_string(reinterpret_cast<intptr_t>(stream));
  if (const int error = Note("cuMemcpyDtoDAsync_v2", what)) return error;
  std::memcpy(reinterpret_cast<void*>(to), reinterpret_cast<const void*>(from), size);
  return pushed < 1 ? kInvalid : 0;
}
int cuCtxSynchronize() {
  LOCK;
  return Note("cuCtxSynchronize");
}

}  // extern "C"
