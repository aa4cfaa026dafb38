#include "airsim360/dataset/export/hdf5.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr uint64_t kUndefined = ~uint64_t{0};
constexpr int kChunks = 16;  // at most; one node of the chunk tree holds 64
constexpr int kTreeK = 32;   // library's default of "indexed storage internal node K" in superblock 0
constexpr int kLeafK = 4, kGroupK = 16;

class Writer {
 public:
  void U(uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
  }
  void Text(const char* text, size_t size) {
    for (size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<std::byte>(text[i]));
  }
  void Zeros(size_t count) { bytes_.resize(bytes_.size() + count); }
  void Append(const Bytes& more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  void Align() { Zeros((8 - bytes_.size() % 8) % 8); }
  size_t size() const { return bytes_.size(); }
  Bytes Take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// Bytes of the same place in all numbers together, then gzip's deflate: as the filters shuffle and deflate do.
Bytes Compress(const float* values, size_t count) {
  std::vector<uint8_t> shuffled(count * 4);
  const auto* raw = reinterpret_cast<const uint8_t*>(values);
  for (size_t i = 0; i < count; ++i) {
    for (size_t b = 0; b < 4; ++b) shuffled[b * count + i] = raw[4 * i + b];
  }
  uLongf size = compressBound(shuffled.size());
  Bytes packed(size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, shuffled.data(), shuffled.size(), 2) != Z_OK)
    throw RuntimeError("zlib: cannot compress");
  packed.resize(size);
  return packed;
}

struct Message {
  uint16_t type;
  Bytes body;
};

// Version 1 object header.
Bytes ObjectHeader(const std::vector<Message>& messages) {
  Writer all;
  for (const Message& message : messages) {
    const size_t padded = (message.body.size() + 7) / 8 * 8;
    all.U(message.type, 2);
    all.U(padded, 2);
    all.U(message.type == 3 ? 1 : 0, 4);  // a datatype is constant
    all.Append(message.body);
    all.Zeros(padded - message.body.size());
  }
  Writer header;
  header.U(1, 2);
  header.U(messages.size(), 2);
  header.U(1, 4);  // references
  header.U(all.size(), 4);
  header.Zeros(4);
  header.Append(all.Take());
  return header.Take();
}

Bytes Dataspace(int height, int width) {
  Writer w;
  w.U(1, 1), w.U(2, 1), w.Zeros(6);
  w.U(static_cast<uint64_t>(height), 8), w.U(static_cast<uint64_t>(width), 8);
  return w.Take();
}

// IEEE little-endian float32.
Bytes FloatType() {
  Writer w;
  w.U(0x11, 1), w.U(0x20, 1), w.U(0x1f, 1), w.U(0, 1), w.U(4, 4);
  w.U(0, 2), w.U(32, 2), w.U(23, 1), w.U(8, 1), w.U(0, 1), w.U(23, 1), w.U(127, 4);
  return w.Take();
}

Bytes FillValue() {
  Writer w;
  w.U(2, 1), w.U(3, 1), w.U(0, 1), w.U(0, 1);  // allocated incrementally, written at allocation, undefined
  return w.Take();
}

Bytes ChunkedLayout(uint64_t tree, int rows, int width) {
  Writer w;
  w.U(3, 1), w.U(2, 1), w.U(3, 1), w.U(tree, 8);
  w.U(static_cast<uint64_t>(rows), 4), w.U(static_cast<uint64_t>(width), 4), w.U(4, 4);
  return w.Take();
}

Bytes Filters() {
  Writer w;
  w.U(1, 1), w.U(2, 1), w.Zeros(6);
  w.U(2, 2), w.U(0, 2), w.U(1, 2), w.U(1, 2), w.U(4, 4), w.Zeros(4);  // shuffle of 4 bytes
  w.U(1, 2), w.U(0, 2), w.U(1, 2), w.U(1, 2), w.U(2, 4), w.Zeros(4);  // deflate, level 2
  return w.Take();
}

Bytes SymbolTable(uint64_t tree, uint64_t heap) {
  Writer w;
  w.U(tree, 8), w.U(heap, 8);
  return w.Take();
}

// A B-tree node without siblings; `body` is keys and children in turn.
Bytes TreeNode(int type, size_t entries, const Bytes& body, size_t size) {
  Writer w;
  w.Text("TREE", 4);
  w.U(static_cast<uint64_t>(type), 1), w.U(0, 1), w.U(entries, 2);
  w.U(kUndefined, 8), w.U(kUndefined, 8);
  w.Append(body);
  w.Zeros(size - w.size());
  return w.Take();
}

struct Layout {
  uint64_t root = 96, group_tree, heap, names, node, header, chunk_tree, chunks;
};

Bytes Superblock(uint64_t end, const Layout& at) {
  Writer w;
  w.Text("\x89HDF\r\n\x1a\n", 8);
  w.U(0, 1), w.U(0, 1), w.U(0, 1), w.U(0, 1), w.U(0, 1), w.U(8, 1), w.U(8, 1), w.U(0, 1);
  w.U(kLeafK, 2), w.U(kGroupK, 2), w.U(0, 4);
  w.U(0, 8), w.U(kUndefined, 8), w.U(end, 8), w.U(kUndefined, 8);
  w.U(0, 8), w.U(at.root, 8), w.U(1, 4), w.U(0, 4), w.U(at.group_tree, 8), w.U(at.heap, 8);
  return w.Take();
}

// Blocks of `rows` whole rows; the last is filled up with zeros.
std::vector<Bytes> CompressedRows(const Image<float>& picture, int rows) {
  std::vector<Bytes> chunks;
  std::vector<float> block(static_cast<size_t>(rows) * picture.width());
  for (int y = 0; y < picture.height(); y += rows) {
    std::ranges::fill(block, 0.0f);
    for (int r = 0; r < rows && y + r < picture.height(); ++r)
      std::ranges::copy(picture.row(y + r), block.begin() + static_cast<ptrdiff_t>(r) * picture.width());
    chunks.push_back(Compress(block.data(), block.size()));
  }
  return chunks;
}

// Of each chunk: size, filters left out, offsets in rows, columns, bytes, and where it lies from `place` on, which
// becomes the end of the last.
Bytes ChunkKeys(const std::vector<Bytes>& chunks, int rows, int width, uint64_t& place) {
  Writer keys;
  const auto key = [&](uint64_t size, uint64_t row, uint64_t column) {
    keys.U(size, 4), keys.U(0, 4), keys.U(row, 8), keys.U(column, 8), keys.U(0, 8);
  };
  for (size_t i = 0; i < chunks.size(); ++i) {
    key(chunks[i].size(), i * static_cast<size_t>(rows), 0);
    keys.U(place, 8);
    place += (chunks[i].size() + 7) / 8 * 8;
  }
  key(0, chunks.size() * static_cast<size_t>(rows), static_cast<uint64_t>(width));
  return keys.Take();
}

}  // namespace

Bytes EncodeHdf5(const Image<float>& picture, const std::string& name) {
  const int width = picture.width(), height = picture.height(), rows = (height + kChunks - 1) / kChunks;
  const std::vector<Bytes> chunks = CompressedRows(picture, rows);
  // Where everything lies; all parts are multiples of 8 bytes.
  const size_t names_size = 8 + (name.size() + 8) / 8 * 8 + 16;
  const auto dataset_header = [&](uint64_t tree) {
    return ObjectHeader(
        {{1, Dataspace(height, width)}, {3, FloatType()}, {5, FillValue()}, {11, Filters()}, {8, ChunkedLayout(tree, rows, width)}});
  };
  Layout at{};
  at.root = 96;
  at.group_tree = at.root + ObjectHeader({{17, SymbolTable(0, 0)}}).size();
  at.heap = at.group_tree + 24 + (2 * kGroupK + 1) * 8 + 2 * kGroupK * 8;
  at.names = at.heap + 32;
  at.node = at.names + names_size;
  at.header = at.node + 8 + 2 * kLeafK * 40;
  at.chunk_tree = at.header + dataset_header(0).size();
  at.chunks = at.chunk_tree + 24 + (2 * kTreeK + 1) * 32 + 2 * kTreeK * 8;

  uint64_t end = at.chunks;
  Bytes keys = ChunkKeys(chunks, rows, width, end);
  const uint64_t name_at = 8;
  Writer group_keys;
  group_keys.U(0, 8), group_keys.U(at.node, 8), group_keys.U(name_at, 8);

  Writer file;
  file.Append(Superblock(end, at));
  file.Append(ObjectHeader({{17, SymbolTable(at.group_tree, at.heap)}}));
  file.Append(TreeNode(0, 1, group_keys.Take(), at.heap - at.group_tree));
  // Heap of names: an empty one, ours, then one free block.
  const uint64_t free_at = names_size - 16;
  file.Text("HEAP", 4), file.U(0, 4), file.U(names_size, 8), file.U(free_at, 8), file.U(at.names, 8);
  file.Zeros(8);
  file.Text(name.c_str(), name.size()), file.Zeros(free_at - 8 - name.size());
  file.U(1, 8), file.U(16, 8);  // the last free block, of 16 bytes
  file.Text("SNOD", 4), file.U(1, 1), file.U(0, 1), file.U(1, 2);
  file.U(name_at, 8), file.U(at.header, 8), file.Zeros(24);
  file.Zeros(at.header - file.size());
  file.Append(dataset_header(at.chunk_tree));
  file.Append(TreeNode(1, chunks.size(), keys, at.chunks - at.chunk_tree));
  for (const Bytes& chunk : chunks) {
    file.Append(chunk);
    file.Align();
  }
  return file.Take();
}

}  // namespace airsim360::internal
