// Typed access to a JSON document with messages that name the file, the place (JSON pointer) and the value.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

/// A value in a document that outlives it. Every accessor throws InputError "file: /pointer: what (value)"
/// when the value is not of the kind asked for.
class JsonRef {
 public:
  /// The root of a document.
  JsonRef(const std::string& file, const nlohmann::json& root) : file_(&file), value_(&root) {}

  [[noreturn]] void Fail(const std::string& what) const;
  const std::string& file() const { return *file_; }
  const std::string& pointer() const { return pointer_; }

  bool IsObject() const;
  bool IsArray() const;
  bool IsNumber() const;
  bool IsNull() const;
  /// Members of an object.
  bool Has(std::string_view key) const { return Find(key).has_value(); }
  std::optional<JsonRef> Find(std::string_view key) const;
  JsonRef At(std::string_view key) const;
  std::vector<std::string> Keys() const;
  /// Elements of an array.
  size_t size() const;
  JsonRef operator[](size_t i) const;
  /// Array member `key`, its length; 0 if it is absent.
  size_t CountOf(std::string_view key) const;

  double Number() const;  ///< finite
  float Float() const;    ///< finite in single precision
  bool Bool() const;
  std::string Text() const;
  /// A whole number in [0, max].
  uint64_t Uint(uint64_t max = UINT64_MAX) const;
  /// Exactly `count` finite numbers.
  std::vector<double> Numbers(size_t count) const;

  /// Members with a default.
  double NumberOr(std::string_view key, double otherwise) const;
  uint64_t UintOr(std::string_view key, uint64_t otherwise) const;
  bool BoolOr(std::string_view key, bool otherwise) const;
  std::string TextOr(std::string_view key, std::string_view otherwise) const;
  std::vector<double> NumbersOr(std::string_view key, std::vector<double> otherwise) const;

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  std::string pointer_;
};

/// Parses a document; InputError "file:line:column: …" where its syntax breaks.
nlohmann::json ParseJson(const std::string& file, std::string_view text);

}  // namespace airsim360::internal
