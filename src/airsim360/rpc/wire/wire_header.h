// The first bytes of a msgpack object.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace airsim360::internal {

/// What the first bytes of an object say.
struct WireHeader {
  enum class Form : uint8_t { kNil, kBool, kInt, kUint, kFloat32, kFloat64, kString, kBinary, kExtension, kArray, kMap };
  Form form = Form::kNil;
  uint32_t header_bytes = 1;   ///< tag, length and number
  uint64_t payload_bytes = 0;  ///< that follow: texts, binaries, extensions
  uint64_t children = 0;       ///< objects that follow: elements, or keys and values
  uint64_t bits = 0;           ///< of the number or bool, sign-extended for kInt
};

/// nullopt: more bytes are needed. Throws WireError for the byte that msgpack does not use.
std::optional<WireHeader> ReadWireHeader(std::span<const uint8_t> bytes);

}  // namespace airsim360::internal
