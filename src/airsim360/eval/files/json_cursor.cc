#include "airsim360/eval/files/json_cursor.h"

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/base/json_depth.h"

namespace airsim360::internal {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMostJsonBytes = uint64_t{2} << 30;
constexpr int kDeepest = 64;
constexpr size_t kLongestShown = 60;

// Files of others could be nested so deep that walking them overflows the stack.
void CheckDepth(std::string_view text, const std::string& name) {
  if (JsonDepth(text) > kDeepest) throw InputError(name + ": JSON nested deeper than " + std::to_string(kDeepest));
}

Json ParseText(std::string_view text, const std::string& name, size_t line) {
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    // The library counts bytes; users count lines.
    const size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    size_t column = 1;
    for (size_t i = 0; i < at; ++i) {
      if (text[i] == '\n')
        ++line, column = 1;
      else
        ++column;
    }
    const std::string_view near = text.substr(at > 0 ? at - 1 : 0, 10);
    const bool no_number = near.find("NaN") != near.npos || near.find("Inf") != near.npos;
    throw InputError(name + ":" + std::to_string(line) + ":" + std::to_string(column) + ": not JSON" +
                     (no_number ? ", which has no NaN or Infinity: leave the value out" : ""));
  } catch (const Json::exception&) {
    throw InputError(name + ": a number is too large");
  }
}

// Where a value stands below another; "" where it does not.
bool FindPath(const Json& here, const Json* wanted, std::string& path) {
  if (&here == wanted) return true;
  const size_t length = path.size();
  if (here.is_object()) {
    for (const auto& [key, value] : here.items()) {
      path += (length == 0 ? "" : ".") + key;
      if (FindPath(value, wanted, path)) return true;
      path.resize(length);
    }
  } else if (here.is_array()) {
    for (size_t i = 0; i < here.size(); ++i) {
      path += "[" + std::to_string(i) + "]";
      if (FindPath(here[i], wanted, path)) return true;
      path.resize(length);
    }
  }
  return false;
}

std::string Shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown) + "…";
  return text;
}

}  // namespace

JsonFile JsonFile::Read(const std::filesystem::path& path) {
  return Parse(ReadTextFile(path, kMostJsonBytes), path.string(), LowerCaseExtension(path) == ".jsonl");
}

JsonFile JsonFile::Parse(std::string_view text, std::string name, bool lines) {
  CheckDepth(text, name);
  auto root = std::make_unique<Root>();
  root->name = std::move(name);
  if (!lines) {
    root->json = ParseText(text, root->name, 1);
  } else {
    root->json = Json::array();
    size_t number = 1;
    for (size_t at = 0; at < text.size(); ++number) {
      const size_t end = std::min(text.find('\n', at), text.size());
      const std::string_view line = text.substr(at, end - at);
      if (line.find_first_not_of(" \t\r") != std::string_view::npos) root->json.push_back(ParseText(line, root->name, number));
      at = end + 1;
    }
  }
  JsonFile file;
  file.root_ = std::move(root);
  return file;
}

JsonCursor JsonFile::top() const { return {root_.get(), &root_->json}; }

size_t JsonCursor::size() const {
  if (!value_->is_array()) Fail(Shown(*value_) + " is not a list");
  return value_->size();
}

bool JsonCursor::Has(const char* field) const {
  if (!value_->is_object()) return false;
  const auto found = value_->find(field);
  return found != value_->end() && !found->is_null();
}

JsonCursor JsonCursor::operator[](const char* field) const {
  if (!value_->is_object()) Fail(Shown(*value_) + " is not an object");
  const auto found = value_->find(field);
  if (found == value_->end() || found->is_null()) Fail(std::string("has no '") + field + "'");
  return {root_, &*found};
}

std::vector<std::string> JsonCursor::Names() const {
  if (!value_->is_object()) Fail(Shown(*value_) + " is not an object");
  std::vector<std::string> names;
  for (const auto& [key, value] : value_->items()) names.push_back(key);
  return names;
}

double JsonCursor::Number() const {
  if (!value_->is_number()) Fail(Shown(*value_) + " is not a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) Fail("a number that is not finite");
  return number;
}

int64_t JsonCursor::Integer() const {
  if (value_->is_number_unsigned() && value_->get<uint64_t>() > (uint64_t{1} << 62)) Fail(Shown(*value_) + " is too large");
  if (value_->is_number_integer()) return value_->get<int64_t>();
  const double number = Number();
  if (number != std::floor(number) || std::abs(number) > 9e15) Fail(Shown(*value_) + " is not a whole number");
  return static_cast<int64_t>(number);
}

bool JsonCursor::Flag() const {
  if (value_->is_boolean()) return value_->get<bool>();
  if (value_->is_number() && (value_->get<double>() == 0 || value_->get<double>() == 1)) return value_->get<double>() == 1;
  Fail(Shown(*value_) + " is neither true nor false");
}

const std::string& JsonCursor::Text() const {
  if (!value_->is_string()) Fail(Shown(*value_) + " is not a text");
  return value_->get_ref<const std::string&>();
}

std::string JsonCursor::IdText() const { return value_->is_string() ? Text() : std::to_string(Integer()); }

std::vector<double> JsonCursor::Numbers() const {
  std::vector<double> numbers;
  numbers.reserve(size());
  for (size_t i = 0; i < size(); ++i) numbers.push_back((*this)[i].Number());
  return numbers;
}

std::vector<double> JsonCursor::Numbers(size_t count) const {
  if (size() != count) Fail("has " + std::to_string(size()) + " numbers instead of " + std::to_string(count));
  return Numbers();
}

void JsonCursor::Fail(const std::string& text) const {
  std::string path;
  FindPath(root_->json, value_, path);
  throw InputError(root_->name + ": " + (path.empty() ? "" : path + ": ") + text);
}

int64_t OwnId(const JsonCursor& entry, std::set<int64_t>& ids) {
  const int64_t id = entry["id"].Integer();
  if (!ids.insert(id).second) entry.Fail("the id " + std::to_string(id) + " occurs twice");
  return id;
}

}  // namespace airsim360::internal
