#include "airsim360/eval/files/class_file.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/base/text.h"
#include "airsim360/eval/files/json_cursor.h"

namespace airsim360 {
namespace {

using internal::JsonCursor;
using internal::JsonFile;

constexpr uint32_t kMostId = 65534;
constexpr uint64_t kMostClassBytes = 16 << 20;

bool ParseId(std::string_view word, uint32_t& id) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  return error == std::errc() && end == word.data() + word.size();
}

constexpr std::string_view kBetween = " \t\r,:;";

bool LooksNumeric(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789") == std::string_view::npos &&
         word.find_first_of("0123456789") != std::string_view::npos;
}

// Lines of an id and a name, of a name and an id, or of names alone, whose ids are 0, 1, 2, …; all lines of a file are of one kind.
std::vector<LabelClass> FromLines(std::string_view text, const std::string& name_of_file) {
  std::vector<LabelClass> classes;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  enum class Kind { kIdFirst, kIdLast, kNames };
  std::optional<Kind> kind;
  int number = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = Trimmed(text.substr(at, end - at), kBetween);
    at = end + 1;
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const std::string where = name_of_file + ":" + std::to_string(number) + ": '" + std::string(line) + "'";
    const size_t first = line.find_first_of(kBetween), last = line.find_last_of(kBetween);
    const bool two = first != std::string_view::npos;
    uint32_t id = static_cast<uint32_t>(classes.size());
    std::string_view name = line;
    Kind of_line = Kind::kNames;
    if (two && ParseId(line.substr(0, first), id)) {
      of_line = Kind::kIdFirst;
      name = Trimmed(line.substr(first), kBetween);
    } else if (two && ParseId(line.substr(last + 1), id)) {
      of_line = Kind::kIdLast;
      name = Trimmed(line.substr(0, last), kBetween);
    } else if (LooksNumeric(line.substr(0, first))) {
      throw InputError(
          where + (two ? " begins with a number that is no id of a class (0 to 65534)" : " is a number without a name: write \"id name\""));
    }
    // "stage 2" among "road" and "sky" would be the name of a class or its id.
    if (kind && *kind != of_line)
      throw InputError(where +
                       " is of another kind than the lines before it: write \"id name\" in all, \"name id\" in all, or names alone");
    kind = of_line;
    classes.push_back({id, std::string(name)});
  }
  return classes;
}

std::vector<LabelClass> FromJson(const JsonCursor& top) {
  std::vector<LabelClass> classes;
  const auto add = [&](const JsonCursor& id, const std::string& name) {
    const int64_t number = id.Integer();
    if (number < 0 || number > kMostId) id.Fail(std::to_string(number) + " is no id of a class (0 to 65534)");
    classes.push_back({static_cast<uint32_t>(number), name});
  };
  if (top.is_object() && !top.Has("categories")) {
    for (const std::string& name : top.Names()) add(top[name.c_str()], name);
    std::stable_sort(classes.begin(), classes.end(), [](const LabelClass& a, const LabelClass& b) { return a.id < b.id; });
    return classes;
  }
  const JsonCursor list = top.is_object() ? top["categories"] : top;
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i].is_string()) {
      classes.push_back({static_cast<uint32_t>(i), list[i].Text()});
    } else {
      add(list[i]["id"], list[i].Has("name") ? list[i]["name"].Text() : list[i]["path"].Text());
    }
  }
  return classes;
}

}  // namespace

std::vector<LabelClass> ParseClassFile(std::string_view text, const std::string& name, bool json) {
  const std::vector<LabelClass> classes = json ? FromJson(JsonFile::Parse(text, name).top()) : FromLines(text, name);
  if (classes.empty()) throw InputError(name + ": has no classes");
  std::set<uint32_t> ids;
  std::set<std::string> names;
  for (const LabelClass& c : classes) {
    if (c.id > kMostId) throw InputError(name + ": " + std::to_string(c.id) + " is no id of a class (0 to 65534)");
    if (!ids.insert(c.id).second) throw InputError(name + ": the id " + std::to_string(c.id) + " occurs twice");
    if (!names.insert(c.name).second) throw InputError(name + ": the class '" + c.name + "' occurs twice");
  }
  return classes;
}

std::vector<LabelClass> ReadClassFile(const std::filesystem::path& path) {
  return ParseClassFile(ReadTextFile(path, kMostClassBytes), path.string(), LowerCaseExtension(path) == ".json");
}

}  // namespace airsim360
