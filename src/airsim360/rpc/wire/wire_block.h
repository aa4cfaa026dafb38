// Bytes of answers on their way from whoever makes them to the socket: made once, never copied.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Bytes that several may hold; nobody changes them once they are shared.
class WireBlock {
 public:
  WireBlock() = default;
  explicit WireBlock(std::string text);
  WireBlock(std::shared_ptr<char[]> bytes, size_t size) : owner_(bytes), bytes_(bytes.get()), size_(size) {}

  const char* data() const { return bytes_; }
  size_t size() const { return size_; }
  std::string_view view() const { return {bytes_, size_}; }

 private:
  std::shared_ptr<const void> owner_;
  const char* bytes_ = nullptr;
  size_t size_ = 0;
};
/// One answer: blocks in the order in which they are sent. Empty: none.
using WireBlocks = std::vector<WireBlock>;
size_t SizeOf(const WireBlocks& blocks);

/// Memory of `size` bytes that is not written yet, for a block.
using TakeBytes = std::function<std::shared_ptr<char[]>(size_t size)>;

/// Memory of large blocks, used again when the last holder has let go: fresh pages would cost as much as
/// filling them. Thread-safe; blocks may outlive the pool.
class BlockPool {
 public:
  BlockPool() : shelf_(std::make_shared<Shelf>()) {}
  /// As TakeBytes.
  std::shared_ptr<char[]> Take(size_t size);
  /// Gives back what is idle, and from then to the next Take what becomes so.
  void Rest();

 private:
  struct Shelf {
    static constexpr size_t kMost = 6, kMostBytes = size_t{96} << 20;
    struct Piece {
      std::unique_ptr<char[]> bytes;
      size_t size = 0;
    };
    void Put(Piece piece);
    std::mutex mutex;
    std::vector<Piece> pieces;
    bool resting = false;
  };
  std::shared_ptr<Shelf> shelf_;
};

}  // namespace airsim360
