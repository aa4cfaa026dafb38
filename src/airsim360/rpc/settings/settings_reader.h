// Reads the members of JSON objects into fields and notices what nobody has asked for.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/rpc/wire/json_text.h"

namespace airsim360::internal {

/// One object of a settings file while it is read. Fields that are missing keep their value; values of the
/// wrong kind are InputErrors naming file, line and key. Finish() notes the keys that nobody has read.
class SettingsObject {
 public:
  SettingsObject(const JsonNode& node, std::string_view file, std::vector<std::string>& notices);

  void Read(const char* key, bool& value);
  void Read(const char* key, double& value, double low, double high);
  void Read(const char* key, int& value, int low, int high);
  void Read(const char* key, std::string& value);
  /// The member itself, which counts as read; nullptr if it is missing.
  const JsonNode* Take(const char* key);
  /// The member as an object; nullptr if it is missing.
  const JsonNode* TakeObject(const char* key);
  /// Keys that AirSim knows and that have no meaning here: those that are there are named in one notice.
  void Ignore(std::span<const char* const> keys);
  /// As Ignore, for all keys that nobody has asked for.
  void IgnoreTheRest();
  void Finish();

  [[noreturn]] void Fail(const JsonNode& node, const std::string& what) const;
  const JsonNode& node() const { return node_; }
  std::string_view file() const { return file_; }
  std::vector<std::string>& notices() { return notices_; }

 private:
  void NoticeIgnored(const std::vector<std::string>& keys);
  const JsonNode* Typed(const char* key, JsonNode::Kind kind, const char* kind_name);

  const JsonNode& node_;
  std::string_view file_;
  std::vector<std::string>& notices_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace airsim360::internal
