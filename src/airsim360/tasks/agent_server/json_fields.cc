#include "airsim360/tasks/agent_server/json_fields.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "airsim360/tasks/agent_server/agent_request.h"

namespace airsim360::internal {
namespace {

constexpr int kDeepest = 12;
constexpr size_t kLongestShown = 60;  // characters of a client's text in a message

std::string Shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown) + "…";
  return text;
}

std::string NumberText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.10g", value);
  return text;
}

[[noreturn]] void WrongKind(const std::string& field, const Json& value, const char* wanted) {
  throw RequestError(field, Shown(value) + " is not " + wanted);
}

Vec3d VectorOf(const std::string& field, const Json& value, double limit) {
  if (!value.is_array() || value.size() != 3) WrongKind(field, value, "[x, y, z]");
  double numbers[3];
  for (size_t i = 0; i < 3; ++i) {
    const std::string name = field + "[" + std::to_string(i) + "]";
    if (!value[i].is_number()) WrongKind(name, value[i], "a number");
    numbers[i] = value[i].get<double>();
    if (!(std::abs(numbers[i]) <= limit)) {
      throw RequestError(name, Shown(value[i]) + " is not in " + NumberText(-limit) + " … " + NumberText(limit),
                         NumberText(std::clamp(numbers[i], -limit, limit)));
    }
  }
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

Json ParseJson(std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return Json::object();
  // Of a key that is given twice the library would take one and drop the other.
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kDeepest) throw RequestError("", "JSON is nested deeper than " + std::to_string(kDeepest));
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      const std::string shown = Shown(parsed);
      throw RequestError(shown.substr(1, shown.size() - 1 - shown.ends_with('"')), "the key is given twice");
    }
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), check);
  } catch (const Json::exception& error) {
    // Its words after the library's own number, without the client's bytes.
    const std::string what = error.what();
    const size_t at = what.find("line ");
    const size_t end = what.find(':', at == std::string::npos ? 0 : at);
    throw RequestError("",
                       "the body is not JSON" +
                           (at == std::string::npos || end == std::string::npos ? std::string() : " (" + what.substr(at, end - at) + ")"));
  }
}

JsonFields::JsonFields(const Json& value, std::string path) : value_(value), path_(std::move(path)) {
  if (!value_.is_object()) WrongKind(path_, value_, "an object { … }");
}

std::string JsonFields::PathOf(std::string_view name) const { return path_.empty() ? std::string(name) : path_ + "." + std::string(name); }

const Json* JsonFields::Find(const char* name) {
  if (std::ranges::find(known_, name) == known_.end()) known_.emplace_back(name);
  const auto found = value_.find(name);
  return found == value_.end() || found->is_null() ? nullptr : &*found;
}

void JsonFields::Number(const char* name, double& value, double low, double high, double factor) {
  const Json* field = Find(name);
  if (field == nullptr) return;
  if (!field->is_number()) WrongKind(PathOf(name), *field, "a number");
  const double number = field->get<double>();
  if (!(number >= low && number <= high)) {
    throw RequestError(PathOf(name), Shown(*field) + " is not in " + NumberText(low) + " … " + NumberText(high),
                       NumberText(std::clamp(number, low, high)));
  }
  value = number * factor;
}

void JsonFields::Integer(const char* name, int64_t& value, int64_t low, int64_t high) {
  const Json* field = Find(name);
  if (field == nullptr) return;
  if (!field->is_number_integer()) WrongKind(PathOf(name), *field, "a whole number");
  // Numbers beyond int64 are larger than any bound.
  const bool huge = field->is_number_unsigned() && field->get<uint64_t>() > uint64_t{INT64_MAX};
  const int64_t number = huge ? INT64_MAX : field->get<int64_t>();
  if (number < low || number > high) {
    throw RequestError(PathOf(name), Shown(*field) + " is not in " + std::to_string(low) + " … " + std::to_string(high),
                       std::to_string(std::clamp(number, low, high)));
  }
  value = number;
}

void JsonFields::Integer(const char* name, int& value, int low, int high) {
  int64_t number = value;
  Integer(name, number, int64_t{low}, int64_t{high});
  value = static_cast<int>(number);
}

bool JsonFields::Seed(const char* name, uint64_t& value) {
  const Json* field = Find(name);
  if (field == nullptr) return false;
  if (!field->is_number_unsigned()) WrongKind(PathOf(name), *field, "a whole number from 0 to 2^64 - 1");
  value = field->get<uint64_t>();
  return true;
}

void JsonFields::Flag(const char* name, bool& value) {
  const Json* field = Find(name);
  if (field == nullptr) return;
  if (!field->is_boolean()) WrongKind(PathOf(name), *field, "true or false");
  value = field->get<bool>();
}

void JsonFields::Text(const char* name, std::string& value, size_t longest) {
  const Json* field = Find(name);
  if (field == nullptr) return;
  if (!field->is_string()) WrongKind(PathOf(name), *field, "a text");
  const auto& text = field->get_ref<const std::string&>();
  if (text.size() > longest) {
    throw RequestError(PathOf(name), std::to_string(text.size()) + " bytes are more than " + std::to_string(longest));
  }
  value = text;
}

size_t FindChoice(const std::string& field, std::string_view what, const std::string& text, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  const std::string shown = text.substr(0, kLongestShown);
  throw RequestError(field, UnknownChoiceMessage(what, shown, names), NearestChoice(shown, names));
}

void JsonFields::Choice(const char* name, size_t& value, std::vector<std::string> names) {
  const Json* field = Find(name);
  if (field == nullptr) return;
  if (!field->is_string()) WrongKind(PathOf(name), *field, "a text");
  value = FindChoice(PathOf(name), name, field->get_ref<const std::string&>(), names);
}

bool JsonFields::Vector(const char* name, Vec3d& value, double limit) {
  const Json* field = Find(name);
  if (field == nullptr) return false;
  value = VectorOf(PathOf(name), *field, limit);
  return true;
}

bool JsonFields::Vectors(const char* name, std::vector<Vec3d>& values, size_t most, double limit) {
  const Json* field = Find(name);
  if (field == nullptr) return false;
  if (!field->is_array()) WrongKind(PathOf(name), *field, "a list of [x, y, z]");
  if (field->empty() || field->size() > most) {
    throw RequestError(PathOf(name), std::to_string(field->size()) + " points are not 1 … " + std::to_string(most));
  }
  values.clear();
  for (size_t i = 0; i < field->size(); ++i) values.push_back(VectorOf(PathOf(name) + "[" + std::to_string(i) + "]", (*field)[i], limit));
  return true;
}

void JsonFields::Finish() const {
  for (const auto& [key, value] : value_.items()) {
    if (std::ranges::find(known_, key) == known_.end()) FindChoice(PathOf(key.substr(0, kLongestShown)), "field", key, known_);
  }
}

}  // namespace airsim360::internal
