#include "airsim360/rpc/wire/wire_header.h"

#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360::internal {
namespace {

using Form = WireHeader::Form;

// How a tag from 0xc0 on is laid out: a number of `number_bytes` follows it, which is the value itself, or
// the count of bytes or objects; extensions have one more byte for their type.
struct Layout {
  Form form;
  uint8_t number_bytes;
  uint8_t fixed_payload;  // of fixext
};

constexpr Layout kLayouts[32] = {{Form::kNil, 0, 0},        {Form::kNil, 0, 0} /* 0xc1, unused */,
                                 {Form::kBool, 0, 0},       {Form::kBool, 0, 0},
                                 {Form::kBinary, 1, 0},     {Form::kBinary, 2, 0},
                                 {Form::kBinary, 4, 0},     {Form::kExtension, 1, 0},
                                 {Form::kExtension, 2, 0},  {Form::kExtension, 4, 0},
                                 {Form::kFloat32, 4, 0},    {Form::kFloat64, 8, 0},
                                 {Form::kUint, 1, 0},       {Form::kUint, 2, 0},
                                 {Form::kUint, 4, 0},       {Form::kUint, 8, 0},
                                 {Form::kInt, 1, 0},        {Form::kInt, 2, 0},
                                 {Form::kInt, 4, 0},        {Form::kInt, 8, 0},
                                 {Form::kExtension, 0, 1},  {Form::kExtension, 0, 2},
                                 {Form::kExtension, 0, 4},  {Form::kExtension, 0, 8},
                                 {Form::kExtension, 0, 16}, {Form::kString, 1, 0},
                                 {Form::kString, 2, 0},     {Form::kString, 4, 0},
                                 {Form::kArray, 2, 0},      {Form::kArray, 4, 0},
                                 {Form::kMap, 2, 0},        {Form::kMap, 4, 0}};

uint64_t BigEndian(const uint8_t* bytes, int count) {
  uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

// A header with its number: counts go where they belong.
WireHeader WithNumber(Form form, uint32_t header_bytes, uint64_t number) {
  WireHeader header{.form = form, .header_bytes = header_bytes};
  switch (form) {
    case Form::kString:
    case Form::kBinary:
    case Form::kExtension:
      header.payload_bytes = number;
      break;
    case Form::kArray:
      header.children = number;
      break;
    case Form::kMap:
      header.children = 2 * number;
      break;
    default:
      header.bits = number;
  }
  return header;
}

// The one-byte forms: small integers, short texts, arrays and maps.
WireHeader FixHeader(uint8_t tag) {
  if (tag < 0x80) return WithNumber(Form::kUint, 1, tag);
  if (tag < 0x90) return WithNumber(Form::kMap, 1, tag & 0x0f);
  if (tag < 0xa0) return WithNumber(Form::kArray, 1, tag & 0x0f);
  if (tag < 0xc0) return WithNumber(Form::kString, 1, tag & 0x1f);
  return WithNumber(Form::kInt, 1, static_cast<uint64_t>(static_cast<int64_t>(static_cast<int8_t>(tag))));
}

}  // namespace

std::optional<WireHeader> ReadWireHeader(std::span<const uint8_t> bytes) {
  if (bytes.empty()) return std::nullopt;
  const uint8_t tag = bytes[0];
  if (tag < 0xc0 || tag >= 0xe0) return FixHeader(tag);
  if (tag == 0xc1) throw WireError("byte 0xc1 is not msgpack");
  const Layout layout = kLayouts[tag - 0xc0];
  const bool extension = layout.form == Form::kExtension;
  const uint32_t header_bytes = 1u + layout.number_bytes + (extension ? 1 : 0);
  if (bytes.size() < header_bytes) return std::nullopt;
  uint64_t number = BigEndian(bytes.data() + 1, layout.number_bytes);
  if (layout.form == Form::kBool) number = tag & 1;
  if (layout.fixed_payload) number = layout.fixed_payload;
  if (layout.form == Form::kInt) {
    const int shift = 64 - 8 * layout.number_bytes;
    number = static_cast<uint64_t>(static_cast<int64_t>(number << shift) >> shift);
  }
  return WithNumber(layout.form, header_bytes, number);
}

}  // namespace airsim360::internal
