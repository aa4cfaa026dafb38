// C++ values to and from msgpack, by AirSim's conventions: structs are maps with string keys of which any may
// be missing, enums are integers, byte vectors are binaries, real numbers 4 bytes.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "airsim360/rpc/wire_value.h"

namespace airsim360 {

/// An argument of the wrong type. The text is what AirSim's server says.
class BadCast : public std::bad_cast {};

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
  if (value.kind != WireValue::Kind::kBool) throw BadCast();
  out = value.flag;
}
template <std::integral T>
void FromWire(const WireValue& value, T& out) {
  if (value.kind == WireValue::Kind::kUint && std::is_same_v<T, uint64_t>) {
    out = static_cast<T>(value.natural);
    return;
  }
  if (value.kind != WireValue::Kind::kInt || !std::in_range<T>(value.integer)) throw BadCast();
  out = static_cast<T>(value.integer);
}
template <std::floating_point T>
void FromWire(const WireValue& value, T& out) {
  using Kind = WireValue::Kind;
  if (value.kind == Kind::kFloat) {
    out = static_cast<T>(value.real);
  } else if (value.kind == Kind::kInt) {
    out = static_cast<T>(value.integer);
  } else if (value.kind == Kind::kUint) {
    out = static_cast<T>(value.natural);
  } else {
    throw BadCast();
  }
}
template <class T>
requires std::is_enum_v<T>
void FromWire(const WireValue& value, T& out) {
  std::underlying_type_t<T> number{};
  FromWire(value, number);
  out = static_cast<T>(number);
}
inline void FromWire(const WireValue& value, std::string& out) {
  if (value.kind != WireValue::Kind::kString && value.kind != WireValue::Kind::kBinary) throw BadCast();
  out = value.text;
}
template <class T>
void FromWire(const WireValue& value, std::vector<T>& out) {
  if (value.kind != WireValue::Kind::kArray) throw BadCast();
  out.assign(value.items.size(), T{});
  for (size_t i = 0; i < out.size(); ++i) FromWire(value.items[i], out[i]);
}
template <WireStruct T>
void FromWire(const WireValue& value, T& out) {
  if (value.kind != WireValue::Kind::kMap) throw BadCast();
  auto read = [&](const char* key, auto& field) {
    if (const WireValue* item = value.Find(key)) FromWire(*item, field);
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
