// Memory that a client on this machine lends to the server: pictures are written into it and pass through no socket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace airsim360 {

/// Bytes that a client has mapped too. They stay mapped as long as anybody holds this.
class SharedMemory {
 public:
  static constexpr size_t kMost = size_t{256} << 20;  ///< bytes of one

  /// Of a memfd that cannot shrink any more (F_SEAL_SHRINK), 1 byte to kMost; takes `fd` over in any case. Null for anything
  /// else: what can shrink would end the process that writes behind its end.
  static std::shared_ptr<SharedMemory> Map(int fd);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  char* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  SharedMemory(char* data, size_t size) : data_(data), size_(size) {}
  char* data_;
  size_t size_;
};

/// A part of it that one call may fill, front to back.
class LentRegion {
 public:
  static constexpr size_t kAlignment = 64;

  /// std::invalid_argument for a region that the memory does not have.
  LentRegion(std::shared_ptr<SharedMemory> memory, uint64_t offset, uint64_t size);
  /// Room for `size` bytes, aligned within the region; null where there is no more.
  std::shared_ptr<char[]> Take(size_t size);
  /// Whether `bytes` came from Take, and how far they are from the start of the memory.
  bool Has(const char* bytes) const;
  uint64_t OffsetOf(const char* bytes) const { return static_cast<uint64_t>(bytes - memory_->data()); }
  /// What the region would have needed for everything that was asked of Take.
  uint64_t wanted() const { return wanted_; }

 private:
  std::shared_ptr<SharedMemory> memory_;
  uint64_t begin_, end_, next_, wanted_ = 0;
};

/// Where clients lend memory: a Unix socket with the abstract name "airsim360/PORT". A client connects, sends one byte with a
/// memfd (SCM_RIGHTS) and receives 8 bytes, a token, that only it knows; the loan ends with that connection, however the
/// client ends.
class MemoryLoans {
 public:
  MemoryLoans();
  ~MemoryLoans();
  MemoryLoans(const MemoryLoans&) = delete;
  MemoryLoans& operator=(const MemoryLoans&) = delete;

  /// To be called once. If the name is taken nobody can lend (the log says so) and everything else works.
  void Listen(int port);
  /// std::invalid_argument for a token that is not, or no longer, out.
  std::shared_ptr<SharedMemory> Find(uint64_t token) const;
  size_t count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
