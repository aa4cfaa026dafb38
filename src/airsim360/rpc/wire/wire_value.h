// MessagePack (msgpack.org specification of 2013) as the server reads and writes it: bounded, strict, no code
// of others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/rpc/wire/wire_block.h"

namespace airsim360 {

/// The bytes are not one complete msgpack object within the limits.
class WireError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct WireLimits {
  size_t bytes = size_t{16} << 20;  ///< of one object
  size_t values = size_t{1} << 20;  ///< scalars, arrays and maps in one object
  int depth = 32;                   ///< of arrays and maps in each other
};

/// One decoded object. Texts and binaries point into the decoded bytes, which must outlive it.
struct WireValue {
  enum class Kind : uint8_t { kNil, kBool, kInt, kUint, kFloat, kString, kBinary, kArray, kMap, kExtension };
  Kind kind = Kind::kNil;
  bool flag = false;
  int64_t integer = 0;   ///< kInt: every integer that fits
  uint64_t natural = 0;  ///< kUint: integers above 2^63 - 1
  double real = 0;
  std::string_view text;         ///< of kString, kBinary, kExtension
  std::vector<WireValue> items;  ///< kArray: the elements; kMap: key, value, key, value, …

  /// The value of a string key; nullptr if this is no map or has none. Of repeated keys the last counts.
  const WireValue* Find(std::string_view key) const;
};

/// Finds the end of an object in bytes that arrive in pieces; every byte is looked at once.
class WireScanner {
 public:
  explicit WireScanner(const WireLimits& limits = {}) : limits_(limits) {}
  /// `bytes` starts where the object starts and holds all of it that has arrived so far. Returns the object's
  /// length once it is complete, and is then ready for the next object. WireError when a limit is passed or a
  /// byte cannot be msgpack.
  std::optional<size_t> Scan(std::span<const uint8_t> bytes);

 private:
  void Open(uint64_t count);
  void Close();

  WireLimits limits_;
  size_t offset_ = 0;  // start of the next header that has not been read
  size_t values_ = 0;
  std::vector<uint64_t> open_;  // objects still to come in each open container
};

/// Decodes exactly one object that fills `bytes`. WireError otherwise.
WireValue DecodeWire(std::span<const uint8_t> bytes, const WireLimits& limits = {});

/// Floats as elements of an array, `kWireFloatBytes` each, at `out`.
inline constexpr size_t kWireFloatBytes = 5;
void StoreWireFloats(std::span<const float> values, char* out);

/// Appends msgpack to a string. Integers take their shortest form; floats are 4 bytes, doubles 8.
class WireWriter {
 public:
  void Nil() { Byte(0xc0); }
  void Bool(bool value) { Byte(value ? 0xc3 : 0xc2); }
  void Int(int64_t value);
  void Uint(uint64_t value);
  void Float(float value);
  void Double(double value);
  void String(std::string_view text);
  void Binary(std::string_view bytes);
  /// Header of a binary of `size` bytes that the caller appends to bytes().
  void BinaryHeader(size_t size);
  void ArrayHeader(size_t count);
  void MapHeader(size_t count);
  /// An array of floats, as one block.
  void Floats(std::span<const float> values);

  /// Bytes that are sent as they are, without being copied: what a header before them has announced.
  void Append(WireBlock block);

  /// What has been written since the last Append.
  std::string& bytes() { return bytes_; }
  /// Everything; the writer is empty afterwards.
  WireBlocks Take();

 private:
  void Byte(uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void Number(uint8_t tag, uint64_t value, int size);
  WireBlocks blocks_;
  std::string bytes_;
};

}  // namespace airsim360
