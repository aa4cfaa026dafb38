// Fields of one JSON object, read one by one: what is missing keeps its default, what nobody has asked for is
// an error. For the .cc files of this module alone.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

using Json = nlohmann::json;  // sorted: a text with many keys costs no more than its length

/// RequestError for a text that is no JSON, too deep, or repeats a key's object too often to matter; empty
/// texts are empty objects.
Json ParseJson(std::string_view text);

class JsonFields {
 public:
  /// RequestError unless `value` is an object. `path` names it in messages ("" for the outermost).
  JsonFields(const Json& value, std::string path);

  /// The field, or nullptr (also for null).
  const Json* Find(const char* name);
  std::string PathOf(std::string_view name) const;

  void Number(const char* name, double& value, double low, double high, double factor = 1);
  void Integer(const char* name, int& value, int low, int high);
  void Integer(const char* name, int64_t& value, int64_t low, int64_t high);
  bool Seed(const char* name, uint64_t& value);
  void Flag(const char* name, bool& value);
  void Text(const char* name, std::string& value, size_t longest);
  /// Index into `names`.
  void Choice(const char* name, size_t& value, std::vector<std::string> names);
  bool Vector(const char* name, Vec3d& value, double limit);
  bool Vectors(const char* name, std::vector<Vec3d>& values, size_t most, double limit);
  /// RequestError for a field that none of the above has named.
  void Finish() const;

 private:
  const Json& value_;
  std::string path_;
  std::vector<std::string> known_;
};

/// RequestError unless `text` is one of `names`; its index.
size_t FindChoice(const std::string& field, std::string_view what, const std::string& text, const std::vector<std::string>& names);

}  // namespace airsim360::internal
