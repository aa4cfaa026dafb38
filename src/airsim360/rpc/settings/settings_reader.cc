#include "airsim360/rpc/settings/settings_reader.h"

#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"

namespace airsim360::internal {

SettingsObject::SettingsObject(const JsonNode& node, std::string_view file, std::vector<std::string>& notices)
    : node_(node), file_(file), notices_(notices) {
  if (node.kind != JsonNode::Kind::kObject) Fail(node, "expected an object in braces");
}

void SettingsObject::Fail(const JsonNode& node, const std::string& what) const {
  throw InputError(std::string(file_) + ":" + std::to_string(node.line) + ": " + what);
}

const JsonNode* SettingsObject::Take(const char* key) {
  asked_.insert(key);
  const JsonNode* member = node_.Find(key);
  return member != nullptr && member->kind != JsonNode::Kind::kNull ? member : nullptr;
}

const JsonNode* SettingsObject::Typed(const char* key, JsonNode::Kind kind, const char* kind_name) {
  const JsonNode* member = Take(key);
  if (member != nullptr && member->kind != kind) Fail(*member, std::string(key) + ": expected " + kind_name);
  return member;
}

const JsonNode* SettingsObject::TakeObject(const char* key) { return Typed(key, JsonNode::Kind::kObject, "an object in braces"); }

void SettingsObject::Read(const char* key, bool& value) {
  if (const JsonNode* member = Typed(key, JsonNode::Kind::kBool, "true or false")) value = member->flag;
}

void SettingsObject::Read(const char* key, double& value, double low, double high) {
  // "NaN" in quotation marks is how AirSim's own examples write "not given".
  const JsonNode* member = Take(key);
  if (member == nullptr || (member->kind == JsonNode::Kind::kString && member->text == "NaN")) return;
  if (member->kind != JsonNode::Kind::kNumber) Fail(*member, std::string(key) + ": expected a number");
  if (!(member->number >= low && member->number <= high)) {
    char range[100];
    std::snprintf(range, sizeof range, ": %.9g is not in %.9g … %.9g", member->number, low, high);
    Fail(*member, key + std::string(range));
  }
  value = member->number;
}

void SettingsObject::Read(const char* key, int& value, int low, int high) {
  double number = value;
  Read(key, number, low, high);
  if (number != std::floor(number)) Fail(*node_.Find(key), std::string(key) + ": expected a whole number");
  value = static_cast<int>(number);
}

void SettingsObject::Read(const char* key, std::string& value) {
  if (const JsonNode* member = Typed(key, JsonNode::Kind::kString, "a text")) value = member->text;
}

void SettingsObject::Ignore(std::span<const char* const> keys) {
  std::vector<std::string> given;
  for (const char* key : keys) {
    asked_.insert(key);
    if (node_.Find(key) != nullptr) given.emplace_back(key);
  }
  NoticeIgnored(given);
}

void SettingsObject::IgnoreTheRest() {
  std::vector<std::string> given;
  for (const std::string& key : node_.keys) {
    if (asked_.insert(key).second) given.push_back(key);
  }
  NoticeIgnored(given);
}

void SettingsObject::NoticeIgnored(const std::vector<std::string>& keys) {
  if (keys.empty()) return;
  std::string text = std::string(file_) + ":" + std::to_string(node_.line) + ": counts for nothing here: ";
  for (const std::string& key : keys) text += (&key == &keys.front() ? "" : ", ") + key;
  notices_.push_back(text);
}

void SettingsObject::Finish() {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (size_t i = 0; i < node_.keys.size(); ++i) {
    const std::string& key = node_.keys[i];
    if (asked_.contains(key)) continue;
    notices_.push_back(std::string(file_) + ":" + std::to_string(node_.items[i].line) + ": '" + key +
                       "' is not known here and counts for nothing" + DidYouMean(key, known));
  }
}

}  // namespace airsim360::internal
