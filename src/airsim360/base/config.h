// Strict configuration files: a struct with defaults names its fields once; reading, help and docs follow
// from that.
//
//   struct WorldFile {
//     std::string world;
//     uint64_t seed = 0;
//     void Visit(ConfigVisitor& v) { v.Field("world", "name of a world or a model file", world);
//     v.Field("seed", "…", seed); }
//   };
//   WorldFile file;
//   ReadYamlFile("town.yaml", [&](ConfigVisitor& v) { file.Visit(v); });
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Walks the fields of a config struct: reads them from a file, from the command line (app/flags/config_flags.h) or from
/// keywords of Python, or writes them. A field that is not mentioned keeps its value.
class ConfigVisitor {
 public:
  virtual ~ConfigVisitor() = default;
  /// Line of the file at which the struct being read begins, from 1; 0 where there is no file.
  virtual size_t line() const { return 0; }
  virtual void Field(std::string_view name, std::string_view help, bool& value) = 0;
  virtual void Field(std::string_view name, std::string_view help, uint64_t& value) = 0;
  /// Numbers outside [low, high] are refused.
  virtual void Field(std::string_view name, std::string_view help, double& value, double low, double high) = 0;
  virtual void Field(std::string_view name, std::string_view help, std::string& value) = 0;
  virtual void Field(std::string_view name, std::string_view help, std::vector<std::string>& value) = 0;
  /// One of a few words: the enumerators of `Enum`, named in their order.
  template <class Enum, size_t kCount>
  void Field(std::string_view name, std::string_view help, Enum& value, const char* const (&names)[kCount]) {
    Choice(name, help, names, static_cast<size_t>(value), [&value](size_t i) { value = static_cast<Enum>(i); });
  }
  /// A whole number from 1 to `high`; 0 stands for one that was not given, and is refused where one is.
  virtual void Count(std::string_view name, std::string_view help, int& value, int high) = 0;
  /// A number in [low, high], or `word` instead of one.
  virtual void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double low,
                        double high) = 0;
  /// A nested struct.
  virtual void Group(std::string_view name, std::string_view help, const std::function<void(ConfigVisitor&)>& visit) = 0;
  /// Field of an enumeration without its type: `index` of `names` is the present value, `set` takes another. What the
  /// value is part of outlives the visitor, and so may `set`.
  virtual void Choice(std::string_view name, std::string_view help, std::span<const char* const> names, size_t index,
                      const std::function<void(size_t)>& set) = 0;
  /// A list of nested structs: `visit(v, entry)` names the fields of one. A file that mentions the list
  /// replaces it, each entry starting from the defaults.
  template <class T, class Visit>
  void List(std::string_view name, std::string_view help, std::vector<T>& list, const Visit& visit) {
    Entries(
        name, help, list.size(), [&](size_t size) { list.assign(size, T{}); }, [&](ConfigVisitor& v, size_t i) { visit(v, list[i]); });
  }

 protected:
  /// List without its type: `resize` makes that many default entries, `visit` names the fields of one.
  /// Visitors that know no lists skip them.
  virtual void Entries(std::string_view /*name*/, std::string_view /*help*/, size_t /*size*/, const std::function<void(size_t)>& /*resize*/,
                       const std::function<void(ConfigVisitor&, size_t)>& /*visit*/) {}
};

using ConfigFields = std::function<void(ConfigVisitor&)>;

/// Reads YAML (JSON is YAML) into the fields. InputError "file:line:column: …" for a syntax error, a value of
/// the wrong kind or out of range, a repeated key, and an unknown key (naming the nearest valid one). Files
/// up to 16 MiB.
void ReadYamlFile(const std::filesystem::path& file, const ConfigFields& fields);
/// The same from memory; `name` stands for the file in messages.
void ReadYaml(std::string_view text, std::string_view name, const ConfigFields& fields);

/// One line a field: name, current value, help. For --help and docs.
std::string DescribeConfig(const ConfigFields& fields);

}  // namespace airsim360
