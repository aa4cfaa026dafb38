#include "airsim360/rpc/wire/wire_value.h"

#include <bit>
#include <limits>

#include "airsim360/rpc/wire/wire_header.h"

namespace airsim360 {

using internal::ReadWireHeader;
using internal::WireHeader;

const WireValue* WireValue::Find(std::string_view key) const {
  if (kind != Kind::kMap) return nullptr;
  for (size_t i = items.size(); i >= 2; i -= 2) {
    if (items[i - 2].kind == Kind::kString && items[i - 2].text == key) return &items[i - 1];
  }
  return nullptr;
}

void WireScanner::Open(uint64_t count) {
  if (count == 0) return Close();
  if (open_.size() >= static_cast<size_t>(limits_.depth)) throw WireError("nested too deeply");
  if (count > limits_.values - values_) throw WireError("too many values");
  open_.push_back(count);
}

// One object is complete; so may be the containers it ends.
void WireScanner::Close() {
  while (!open_.empty() && --open_.back() == 0) open_.pop_back();
}

std::optional<size_t> WireScanner::Scan(std::span<const uint8_t> bytes) {
  while (true) {
    if (offset_ > bytes.size()) return std::nullopt;
    const auto header = ReadWireHeader(bytes.subspan(offset_));
    if (!header) return std::nullopt;
    if (header->payload_bytes > limits_.bytes || offset_ + header->header_bytes + header->payload_bytes > limits_.bytes) {
      throw WireError("message too long");
    }
    if (++values_ > limits_.values) throw WireError("too many values");
    // A payload that has not arrived leaves everything as it was but the work of one header.
    const size_t end = offset_ + header->header_bytes + static_cast<size_t>(header->payload_bytes);
    if (end > bytes.size()) {
      --values_;
      return std::nullopt;
    }
    offset_ = end;
    const bool container = header->form == WireHeader::Form::kArray || header->form == WireHeader::Form::kMap;
    container ? Open(header->children) : Close();
    if (!open_.empty()) continue;
    offset_ = 0;
    values_ = 0;
    return end;
  }
}

namespace {

class Decoder {
 public:
  Decoder(std::span<const uint8_t> bytes, const WireLimits& limits) : bytes_(bytes), limits_(limits) {}

  WireValue Next(int depth) {
    const auto header = ReadWireHeader(bytes_.subspan(offset_));
    if (!header) throw WireError("truncated");
    if (++values_ > limits_.values) throw WireError("too many values");
    offset_ += header->header_bytes;
    if (header->payload_bytes > bytes_.size() - offset_) throw WireError("truncated");
    WireValue value = Scalar(*header);
    offset_ += static_cast<size_t>(header->payload_bytes);
    // Every child takes at least a byte: a count that cannot fit takes no memory.
    if (header->children > bytes_.size() - offset_) throw WireError("truncated");
    if (header->children > 0 && depth >= limits_.depth) throw WireError("nested too deeply");
    if (header->children > limits_.values - values_) throw WireError("too many values");
    value.items.reserve(static_cast<size_t>(header->children));
    for (uint64_t i = 0; i < header->children; ++i) value.items.push_back(Next(depth + 1));
    return value;
  }
  bool at_end() const { return offset_ == bytes_.size(); }

 private:
  std::string_view Payload(const WireHeader& header) const {
    return {reinterpret_cast<const char*>(bytes_.data()) + offset_, static_cast<size_t>(header.payload_bytes)};
  }

  WireValue Scalar(const WireHeader& header) const {
    using Form = WireHeader::Form;
    using Kind = WireValue::Kind;
    WireValue value;
    switch (header.form) {
      case Form::kNil:
        break;
      case Form::kBool:
        value.kind = Kind::kBool;
        value.flag = header.bits != 0;
        break;
      case Form::kInt:
        value.kind = Kind::kInt;
        value.integer = static_cast<int64_t>(header.bits);
        break;
      case Form::kUint:
        SetNatural(header.bits, value);
        break;
      case Form::kFloat32:
        value.kind = Kind::kFloat;
        value.real = std::bit_cast<float>(static_cast<uint32_t>(header.bits));
        break;
      case Form::kFloat64:
        value.kind = Kind::kFloat;
        value.real = std::bit_cast<double>(header.bits);
        break;
      case Form::kString:
        value.kind = Kind::kString;
        value.text = Payload(header);
        break;
      case Form::kBinary:
        value.kind = Kind::kBinary;
        value.text = Payload(header);
        break;
      case Form::kExtension:
        value.kind = Kind::kExtension;
        value.text = Payload(header);
        break;
      case Form::kArray:
        value.kind = Kind::kArray;
        break;
      case Form::kMap:
        value.kind = Kind::kMap;
        break;
    }
    return value;
  }

  static void SetNatural(uint64_t bits, WireValue& value) {
    const bool fits = bits <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max());
    value.kind = fits ? WireValue::Kind::kInt : WireValue::Kind::kUint;
    value.integer = fits ? static_cast<int64_t>(bits) : 0;
    value.natural = bits;
  }

  std::span<const uint8_t> bytes_;
  WireLimits limits_;
  size_t offset_ = 0, values_ = 0;
};

}  // namespace

WireValue DecodeWire(std::span<const uint8_t> bytes, const WireLimits& limits) {
  if (bytes.size() > limits.bytes) throw WireError("message too long");
  Decoder decoder(bytes, limits);
  WireValue value = decoder.Next(0);
  if (!decoder.at_end()) throw WireError("bytes after the end");
  return value;
}

}  // namespace airsim360
