#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/assets/imported.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

std::string Describe(const nlohmann::json& value) {
  if (value.is_array()) return "array of " + std::to_string(value.size());
  if (value.is_object()) return "object";
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace

void JsonRef::Fail(const std::string& what) const {
  throw InputError(*file_ + ": " + (pointer_.empty() ? "/" : pointer_) + ": " + what + " (" + Describe(*value_) + ")");
}

bool JsonRef::IsObject() const { return value_->is_object(); }
bool JsonRef::IsArray() const { return value_->is_array(); }
bool JsonRef::IsNumber() const { return value_->is_number(); }
bool JsonRef::IsNull() const { return value_->is_null(); }

std::optional<JsonRef> JsonRef::Find(std::string_view key) const {
  if (!value_->is_object()) Fail("an object expected");
  const auto it = value_->find(key);
  if (it == value_->end()) return std::nullopt;
  JsonRef member = *this;
  member.value_ = &*it;
  member.pointer_.append("/").append(CleanName(key));
  return member;
}

JsonRef JsonRef::At(std::string_view key) const {
  std::optional<JsonRef> member = Find(key);
  if (!member) Fail("has no \"" + std::string(key) + "\"");
  return *std::move(member);
}

std::vector<std::string> JsonRef::Keys() const {
  if (!value_->is_object()) Fail("an object expected");
  std::vector<std::string> keys;
  for (const auto& [key, value] : value_->items()) keys.push_back(key);
  return keys;
}

size_t JsonRef::size() const {
  if (!value_->is_array()) Fail("an array expected");
  return value_->size();
}

JsonRef JsonRef::operator[](size_t i) const {
  if (i >= size()) Fail("has no element " + std::to_string(i));
  JsonRef element = *this;
  element.value_ = &(*value_)[i];
  element.pointer_.append("/").append(std::to_string(i));
  return element;
}

size_t JsonRef::CountOf(std::string_view key) const {
  const std::optional<JsonRef> member = Find(key);
  return member ? member->size() : 0;
}

double JsonRef::Number() const {
  if (!value_->is_number()) Fail("a number expected");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) Fail("a finite number expected");
  return number;
}

float JsonRef::Float() const {
  const auto number = static_cast<float>(Number());
  if (!std::isfinite(number)) Fail("the number is too large");
  return number;
}

bool JsonRef::Bool() const {
  if (!value_->is_boolean()) Fail("true or false expected");
  return value_->get<bool>();
}

std::string JsonRef::Text() const {
  if (!value_->is_string()) Fail("a string expected");
  return value_->get<std::string>();
}

uint64_t JsonRef::Uint(uint64_t max) const {
  // 3.0 is a whole number too: some exporters write counts that way.
  uint64_t number = 0;
  if (value_->is_number_unsigned()) {
    number = value_->get<uint64_t>();
  } else if (value_->is_number_float() && Number() >= 0 && Number() < 9e15 && Number() == std::floor(Number())) {
    number = static_cast<uint64_t>(Number());
  } else {
    Fail("a whole number from 0 on expected");
  }
  if (number > max) Fail("at most " + std::to_string(max) + " allowed");
  return number;
}

std::vector<double> JsonRef::Numbers(size_t count) const {
  if (size() != count) Fail(std::to_string(count) + " numbers expected");
  std::vector<double> numbers;
  for (size_t i = 0; i < count; ++i) numbers.push_back((*this)[i].Number());
  return numbers;
}

double JsonRef::NumberOr(std::string_view key, double otherwise) const {
  const auto member = Find(key);
  return member ? member->Number() : otherwise;
}

uint64_t JsonRef::UintOr(std::string_view key, uint64_t otherwise) const {
  const auto member = Find(key);
  return member ? member->Uint() : otherwise;
}

bool JsonRef::BoolOr(std::string_view key, bool otherwise) const {
  const auto member = Find(key);
  return member ? member->Bool() : otherwise;
}

std::string JsonRef::TextOr(std::string_view key, std::string_view otherwise) const {
  const auto member = Find(key);
  return member ? member->Text() : std::string(otherwise);
}

std::vector<double> JsonRef::NumbersOr(std::string_view key, std::vector<double> otherwise) const {
  const auto member = Find(key);
  return member ? member->Numbers(otherwise.size()) : otherwise;
}

nlohmann::json ParseJson(const std::string& file, std::string_view text) {
  try {
    return nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    // Line and column of the byte where the parser stopped.
    const std::string_view before = text.substr(0, error.byte == 0 ? 0 : error.byte - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0
    const std::string near = CleanName(text.substr(std::min(before.size(), text.size()), 20));
    throw InputError(file + ":" + std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1) + ": not valid JSON" +
                     (near.empty() ? ": the text ends too early" : " at \"" + near + "\""));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": not valid JSON: " + CleanName(error.what()));
  }
}

}  // namespace airsim360::internal
