// JSON with the place of every value, for settings files whose errors name file and line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// One value of a JSON text (RFC 8259), with accessors that check.
struct JsonNode {
  enum class Kind { kNull, kBool, kNumber, kString, kArray, kObject };
  Kind kind = Kind::kNull;
  bool flag = false;
  double number = 0;
  std::string text;
  std::vector<JsonNode> items;    ///< of an array; the values of an object's members
  std::vector<std::string> keys;  ///< of an object's members, in their order, as many as items
  int line = 1;

  /// The member of a key; nullptr if there is none or this is no object. Of repeated keys the last counts.
  const JsonNode* Find(std::string_view key) const;
};

/// InputError "name:line: …" unless `text` is one JSON value, with objects and arrays at most 64 deep.
JsonNode ParseJson(std::string_view text, std::string_view name);

}  // namespace airsim360
