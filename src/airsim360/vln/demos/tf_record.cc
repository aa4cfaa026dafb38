#include "airsim360/vln/demos/tf_record.h"

#include <array>
#include <bit>

namespace airsim360::internal {
namespace {

constexpr std::array<uint32_t, 256> MakeTable() {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t crc = i;
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0x82f63b78u : 0);
    table[i] = crc;
  }
  return table;
}

void Little(std::string& out, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

// So that a CRC of bytes that hold CRCs is no weaker.
uint32_t Masked(uint32_t crc) { return std::rotr(crc, 15) + 0xa282ead8u; }

void Varint(std::string& out, uint64_t value) {
  for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
  out += static_cast<char>(value);
}

// A field of bytes: strings, messages, packed numbers.
void Field(std::string& out, int number, std::string_view bytes) {
  Varint(out, static_cast<uint64_t>(number) << 3 | 2);
  Varint(out, bytes.size());
  out += bytes;
}

}  // namespace

uint32_t Crc32c(std::string_view bytes) {
  static constexpr auto kTable = MakeTable();
  uint32_t crc = ~0u;
  for (const char c : bytes) crc = (crc >> 8) ^ kTable[(crc ^ static_cast<unsigned char>(c)) & 0xff];
  return ~crc;
}

std::string TfRecord(std::string_view bytes) {
  std::string record;
  Little(record, bytes.size(), 8);
  Little(record, Masked(Crc32c(record)), 4);
  record += bytes;
  Little(record, Masked(Crc32c(bytes)), 4);
  return record;
}

void TfExample::Floats(const std::string& name, std::span<const float> values) {
  std::string packed, list;
  for (const float value : values) Little(packed, std::bit_cast<uint32_t>(value), 4);
  Field(list, 1, packed);
  Field(features_[name], 2, list);  // FloatList
}

void TfExample::Ints(const std::string& name, std::span<const int64_t> values) {
  std::string packed, list;
  for (const int64_t value : values) Varint(packed, static_cast<uint64_t>(value));
  Field(list, 1, packed);
  Field(features_[name], 3, list);  // Int64List
}

void TfExample::Bytes(const std::string& name, std::span<const std::string> values) {
  std::string list;
  for (const std::string& value : values) Field(list, 1, value);
  Field(features_[name], 1, list);  // BytesList
}

std::string TfExample::Encode() const {
  std::string features, example;
  for (const auto& [name, feature] : features_) {
    std::string entry;  // of the map
    Field(entry, 1, name);
    Field(entry, 2, feature);
    Field(features, 1, entry);
  }
  Field(example, 1, features);
  return example;
}

}  // namespace airsim360::internal
