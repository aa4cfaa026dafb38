#include "airsim360/rpc/wire/wire_block.h"

#include <algorithm>

namespace airsim360 {

WireBlock::WireBlock(std::string text) {
  const auto owner = std::make_shared<const std::string>(std::move(text));
  bytes_ = owner->data();
  size_ = owner->size();
  owner_ = owner;
}

size_t SizeOf(const WireBlocks& blocks) {
  size_t size = 0;
  for (const WireBlock& block : blocks) size += block.size();
  return size;
}

void BlockPool::Shelf::Put(Piece piece) {
  const std::lock_guard lock(mutex);
  size_t bytes = piece.size;
  for (const Piece& other : pieces) bytes += other.size;
  if (!resting && pieces.size() < kMost && bytes <= kMostBytes) pieces.push_back(std::move(piece));
}

void BlockPool::Rest() {
  const std::lock_guard lock(shelf_->mutex);
  shelf_->resting = true;
  shelf_->pieces.clear();
}

std::shared_ptr<char[]> BlockPool::Take(size_t size) {
  constexpr size_t kSmall = size_t{64} << 10;  // is quickly had
  if (size < kSmall) return std::shared_ptr<char[]>(new char[size]);
  Shelf::Piece piece;
  {
    // The smallest that is large enough, unless most of it would be idle.
    const std::lock_guard lock(shelf_->mutex);
    shelf_->resting = false;
    auto best = shelf_->pieces.end();
    for (auto it = shelf_->pieces.begin(); it != shelf_->pieces.end(); ++it) {
      const bool fits = it->size >= size && it->size <= 4 * size;
      if (fits && (best == shelf_->pieces.end() || it->size < best->size)) best = it;
    }
    if (best != shelf_->pieces.end()) {
      piece = std::move(*best);
      shelf_->pieces.erase(best);
    }
  }
  if (!piece.bytes) piece = {std::make_unique_for_overwrite<char[]>(size), size};
  char* bytes = piece.bytes.release();
  return std::shared_ptr<char[]>(bytes, [shelf = shelf_, capacity = piece.size](char* back) {
    shelf->Put({std::unique_ptr<char[]>(back), capacity});
  });
}

}  // namespace airsim360
