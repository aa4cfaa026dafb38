#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {
namespace {

// Big-endian bytes of `value`, `size` of them, at `out`.
void StoreBigEndian(uint64_t value, int size, char* out) {
  for (int i = 0; i < size; ++i) out[i] = static_cast<char>(value >> (8 * (size - 1 - i)));
}

}  // namespace

void WireWriter::Number(uint8_t tag, uint64_t value, int size) {
  char buffer[9] = {static_cast<char>(tag)};
  StoreBigEndian(value, size, buffer + 1);
  bytes_.append(buffer, static_cast<size_t>(size) + 1);
}

void WireWriter::Uint(uint64_t value) {
  if (value < 0x80) return Byte(static_cast<uint8_t>(value));
  if (value <= 0xff) return Number(0xcc, value, 1);
  if (value <= 0xffff) return Number(0xcd, value, 2);
  if (value <= 0xffffffff) return Number(0xce, value, 4);
  Number(0xcf, value, 8);
}

void WireWriter::Int(int64_t value) {
  if (value >= 0) return Uint(static_cast<uint64_t>(value));
  const auto bits = static_cast<uint64_t>(value);
  if (value >= -32) return Byte(static_cast<uint8_t>(bits));
  if (value >= std::numeric_limits<int8_t>::min()) return Number(0xd0, bits, 1);
  if (value >= std::numeric_limits<int16_t>::min()) return Number(0xd1, bits, 2);
  if (value >= std::numeric_limits<int32_t>::min()) return Number(0xd2, bits, 4);
  Number(0xd3, bits, 8);
}

void WireWriter::Float(float value) { Number(0xca, std::bit_cast<uint32_t>(value), 4); }
void WireWriter::Double(double value) { Number(0xcb, std::bit_cast<uint64_t>(value), 8); }

void WireWriter::String(std::string_view text) {
  if (text.size() < 32) {
    Byte(static_cast<uint8_t>(0xa0 | text.size()));
  } else if (text.size() <= 0xff) {
    Number(0xd9, text.size(), 1);
  } else if (text.size() <= 0xffff) {
    Number(0xda, text.size(), 2);
  } else {
    Number(0xdb, text.size(), 4);
  }
  bytes_.append(text);
}

void WireWriter::BinaryHeader(size_t size) {
  if (size <= 0xff) return Number(0xc4, size, 1);
  if (size <= 0xffff) return Number(0xc5, size, 2);
  Number(0xc6, size, 4);
}

void WireWriter::Binary(std::string_view bytes) {
  BinaryHeader(bytes.size());
  bytes_.append(bytes);
}

void WireWriter::ArrayHeader(size_t count) {
  if (count < 16) return Byte(static_cast<uint8_t>(0x90 | count));
  if (count <= 0xffff) return Number(0xdc, count, 2);
  Number(0xdd, count, 4);
}

void WireWriter::MapHeader(size_t count) {
  if (count < 16) return Byte(static_cast<uint8_t>(0x80 | count));
  if (count <= 0xffff) return Number(0xde, count, 2);
  Number(0xdf, count, 4);
}

void WireWriter::Floats(std::span<const float> values) {
  ArrayHeader(values.size());
  const size_t start = bytes_.size();
  bytes_.resize(start + kWireFloatBytes * values.size());
  StoreWireFloats(values, bytes_.data() + start);
}

void WireWriter::Append(WireBlock block) {
  if (!bytes_.empty()) blocks_.emplace_back(std::exchange(bytes_, {}));
  if (block.size() > 0) blocks_.push_back(std::move(block));
}

WireBlocks WireWriter::Take() {
  Append({});
  return std::exchange(blocks_, {});
}

void StoreWireFloats(std::span<const float> values, char* out) {
  for (const float value : values) {
    *out = static_cast<char>(0xca);
    const uint32_t bits = __builtin_bswap32(std::bit_cast<uint32_t>(value));
    std::memcpy(out + 1, &bits, sizeof bits);
    out += kWireFloatBytes;
  }
}

}  // namespace airsim360
