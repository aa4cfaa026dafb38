// A value in a JSON file that knows where it stands: wrong kinds are InputErrors "FILE: annotations[3].score: …". For .cc files of eval alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

class JsonCursor;

/// A parsed file. Cursors point into it.
class JsonFile {
 public:
  /// The whole file, or, where its name ends in .jsonl, a list of the values of its lines. InputError that names the file, the line and
  /// column of what is no JSON, or that it is nested deeper than 64.
  static JsonFile Read(const std::filesystem::path& path);
  static JsonFile Parse(std::string_view text, std::string name, bool lines = false);
  JsonCursor top() const;

 private:
  friend class JsonCursor;
  struct Root {
    nlohmann::json json;
    std::string name;
  };
  std::unique_ptr<const Root> root_;
};

class JsonCursor {
 public:
  bool is_object() const { return value_->is_object(); }
  bool is_array() const { return value_->is_array(); }
  bool is_string() const { return value_->is_string(); }
  bool is_number() const { return value_->is_number(); }

  size_t size() const;                                                              ///< of a list; InputError otherwise
  JsonCursor operator[](size_t index) const { return {root_, &(*value_)[index]}; }  ///< index < size()
  /// A field; InputError naming it if it is missing or null, or if this is no object.
  JsonCursor operator[](const char* field) const;
  bool Has(const char* field) const;       ///< this is an object and the field is there and not null
  std::vector<std::string> Names() const;  ///< of the fields of an object

  double Number() const;    ///< finite
  int64_t Integer() const;  ///< also 3.0
  bool Flag() const;        ///< true, false, 1 or 0
  const std::string& Text() const;
  std::string IdText() const;  ///< text, or an integer as text
  std::vector<double> Numbers() const;
  std::vector<double> Numbers(size_t count) const;  ///< exactly so many

  double NumberOr(const char* field, double other) const { return Has(field) ? (*this)[field].Number() : other; }
  bool FlagOr(const char* field, bool other) const { return Has(field) ? (*this)[field].Flag() : other; }

  /// InputError "FILE: PATH: text".
  [[noreturn]] void Fail(const std::string& text) const;

 private:
  friend class JsonFile;
  JsonCursor(const JsonFile::Root* root, const nlohmann::json* value) : root_(root), value_(value) {}
  const JsonFile::Root* root_;
  const nlohmann::json* value_;
};

/// The field `id` of an entry of a list; InputError if it is among `ids` already, to which it is added.
int64_t OwnId(const JsonCursor& entry, std::set<int64_t>& ids);

}  // namespace airsim360::internal
