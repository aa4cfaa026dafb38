// C++ values to and from msgpack, by AirSim's conventions: structs are maps with string keys of which any may
// be missing, enums are integers, byte vectors are binaries, real numbers 4 bytes.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "airsim360/math/coordinate_limit.h"
#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {

/// An argument that cannot be taken: which part of which argument, its value, what would do. Of one that is
/// of the wrong kind the text begins as AirSim's server's, std::bad_cast.
class BadArgument : public std::exception {
 public:
  enum class Reason : uint8_t { kKind, kRange };
  BadArgument(Reason reason, std::string problem) : reason_(reason), problem_(std::move(problem)) { Write(); }
  /// The problem is in `part` of what it was said to be in: "position", "[2]".
  void Within(const std::string& part);
  /// Which argument it is in, from 1 on.
  void InArgument(size_t number);
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  void Write();
  Reason reason_;
  std::string problem_, part_, argument_, text_;
};

/// BadArgument: `value` is not `wanted` ("a number").
[[noreturn]] void ThrowWrongKind(const WireValue& value, const char* wanted);
[[noreturn]] void ThrowOutOfRange(const WireValue& value, int64_t low, uint64_t high);

/// A real number. BadArgument for another kind, for one that is not a number, and beyond ±`limit`.
double RealFromWire(const WireValue& value, double limit);

/// A number that is NaN.
bool IsNanOnWire(const WireValue& value);

/// Raw bytes of a picture, sent as a binary.
struct WireBytes {
  WireBlock bytes;
};

/// A struct that lists its fields: `template <class V> void Visit(V& v) { v("key", field); … }`.
namespace internal {
struct FieldCounter {
  size_t count = 0;
  template <class T>
  void operator()(const char*, T&&) {
    ++count;
  }
};
}  // namespace internal
template <class T>
concept WireStruct = std::is_class_v<T> && requires(T& t, internal::FieldCounter& c) {
  t.Visit(c);
};

inline void FromWire(const WireValue& value, bool& out) {
  if (value.kind != WireValue::Kind::kBool) ThrowWrongKind(value, "true or false");
  out = value.flag;
}
template <std::integral T>
void FromWire(const WireValue& value, T& out) {
  if (value.kind == WireValue::Kind::kUint && std::is_same_v<T, uint64_t>) {
    out = static_cast<T>(value.natural);
    return;
  }
  if (value.kind != WireValue::Kind::kInt && value.kind != WireValue::Kind::kUint) ThrowWrongKind(value, "a whole number");
  if (value.kind == WireValue::Kind::kUint || !std::in_range<T>(value.integer)) {
    using Limits = std::numeric_limits<T>;
    ThrowOutOfRange(value, static_cast<int64_t>(Limits::min()), static_cast<uint64_t>(Limits::max()));
  }
  out = static_cast<T>(value.integer);
}
/// No real number on the wire has a meaning beyond the limit of coordinates, whatever its unit; times do
/// (Seconds).
template <std::floating_point T>
void FromWire(const WireValue& value, T& out) {
  out = static_cast<T>(RealFromWire(value, kCoordinateLimit));
}
template <class T>
requires std::is_enum_v<T>
void FromWire(const WireValue& value, T& out) {
  std::underlying_type_t<T> number{};
  FromWire(value, number);
  out = static_cast<T>(number);
}
inline void FromWire(const WireValue& value, std::string& out) {
  if (value.kind != WireValue::Kind::kString && value.kind != WireValue::Kind::kBinary) ThrowWrongKind(value, "a text");
  out = value.text;
}
template <class T>
void FromWire(const WireValue& value, std::vector<T>& out) {
  if (value.kind != WireValue::Kind::kArray) ThrowWrongKind(value, "a list");
  out.assign(value.items.size(), T{});
  for (size_t i = 0; i < out.size(); ++i) {
    try {
      FromWire(value.items[i], out[i]);
    } catch (BadArgument& error) {
      error.Within("[" + std::to_string(i) + "]");
      throw;
    }
  }
}
template <WireStruct T>
void FromWire(const WireValue& value, T& out) {
  if (value.kind != WireValue::Kind::kMap) ThrowWrongKind(value, "a map");
  auto read = [&](const char* key, auto& field) {
    const WireValue* item = value.Find(key);
    if (item == nullptr) return;
    try {
      FromWire(*item, field);
    } catch (BadArgument& error) {
      error.Within(key);
      throw;
    }
  };
  out.Visit(read);
}

inline void ToWire(WireWriter& writer, bool value) { writer.Bool(value); }
template <std::integral T>
void ToWire(WireWriter& writer, T value) {
  if constexpr (std::is_signed_v<T>) {
    writer.Int(value);
  } else {
    writer.Uint(value);
  }
}
inline void ToWire(WireWriter& writer, float value) { writer.Float(value); }
inline void ToWire(WireWriter& writer, double value) { writer.Double(value); }
template <class T>
requires std::is_enum_v<T>
void ToWire(WireWriter& writer, T value) { writer.Int(static_cast<int64_t>(value)); }
inline void ToWire(WireWriter& writer, const std::string& value) { writer.String(value); }
inline void ToWire(WireWriter& writer, const WireBytes& value) {
  writer.BinaryHeader(value.bytes.size());
  writer.Append(value.bytes);
}
inline void ToWire(WireWriter& writer, const std::vector<float>& value) { writer.Floats(value); }
template <class A, class B>
void ToWire(WireWriter& writer, const std::pair<A, B>& value) {
  writer.ArrayHeader(2);
  ToWire(writer, value.first);
  ToWire(writer, value.second);
}
template <WireStruct T>
void ToWire(WireWriter& writer, const T& value) {
  // Visit is one function for reading and writing; writing changes nothing.
  T& fields = const_cast<T&>(value);
  internal::FieldCounter counter;
  fields.Visit(counter);
  writer.MapHeader(counter.count);
  auto write = [&](const char* key, const auto& field) {
    writer.String(key);
    ToWire(writer, field);
  };
  fields.Visit(write);
}
template <class T>
void ToWire(WireWriter& writer, const std::vector<T>& value) {
  writer.ArrayHeader(value.size());
  for (const T& item : value) ToWire(writer, item);
}

}  // namespace airsim360
