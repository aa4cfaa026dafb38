#include "airsim360/base/config.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMaxFileSize = uint64_t{16} << 20;

std::string Where(std::string_view file, const YAML::Mark& mark) {
  std::string where(file);
  if (!mark.is_null()) where += ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
  return where + ": ";
}

/// Reads one mapping; remembers which keys are valid so that the rest can be refused at the end.
class YamlReader : public ConfigVisitor {
 public:
  YamlReader(const YAML::Node& node, std::string_view file) : node_(node), file_(file) {
    if (!node.IsMap()) throw InputError(Where(file, node.Mark()) + "expected 'key: value' lines");
  }

  size_t line() const override {
    const YAML::Mark mark = node_.Mark();
    return mark.is_null() ? 0 : static_cast<size_t>(mark.line) + 1;
  }
  void Field(std::string_view name, std::string_view, bool& value) override { Read(name, "true or false", value); }
  void Field(std::string_view name, std::string_view, uint64_t& value) override {
    // yaml-cpp would take "-1" as a large number.
    if (const YAML::Node node = Find(name); node && node.IsScalar() && node.Scalar().starts_with("-")) {
      Fail(node, name, "a whole number, 0 or more");
    }
    Read(name, "a whole number, 0 or more", value);
  }
  void Field(std::string_view name, std::string_view, double& value, double low, double high) override {
    if (!Find(name)) return;
    double read = value;
    Read(name, "a number", read);
    char range[80];
    std::snprintf(range, sizeof(range), "a number from %g to %g", low, high);
    if (!(read >= low && read <= high)) Fail(Find(name), name, range);
    value = read;
  }
  void Field(std::string_view name, std::string_view, std::string& value) override { Read(name, "a text", value); }
  void Field(std::string_view name, std::string_view, std::vector<std::string>& value) override { Read(name, "a list of texts", value); }
  void Count(std::string_view name, std::string_view, int& value, int high) override {
    const YAML::Node node = Find(name);
    if (!node) return;
    int read = 0;
    const std::string wanted = "a whole number from 1 to " + std::to_string(high);
    Read(name, wanted, read);
    if (read < 1 || read > high) Fail(node, name, wanted);
    value = read;
  }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double low,
                double high) override {
    const YAML::Node node = Find(name);
    if (!node) return;
    is_word = node.IsScalar() && node.Scalar() == word;
    value = 0;
    if (!is_word) Field(name, help, value, low, high);
  }
  void Choice(std::string_view name, std::string_view, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>& set) override {
    const YAML::Node node = Find(name);
    if (!node) return;
    std::string word = names[index];
    Read(name, "a word", word);
    try {
      set(ParseChoice(name, word, names));
    } catch (const InputError& error) {
      throw InputError(Where(file_, node.Mark()) + std::string(name) + ": " + error.what());
    }
  }
  void Group(std::string_view name, std::string_view, const ConfigFields& visit) override {
    if (const YAML::Node node = Find(name)) {
      YamlReader group(node, file_);
      visit(group);
      group.RefuseUnknownKeys();
    }
  }

  void Entries(std::string_view name, std::string_view, size_t, const std::function<void(size_t)>& resize,
               const std::function<void(ConfigVisitor&, size_t)>& visit) override {
    const YAML::Node node = Find(name);
    if (!node || !node.IsDefined()) return;
    if (!node.IsSequence()) throw InputError(Where(file_, node.Mark()) + std::string(name) + ": expected a list ('- key: value' entries)");
    resize(node.size());
    for (size_t i = 0; i < node.size(); ++i) {
      YamlReader entry(node[i], file_);
      visit(entry, i);
      entry.RefuseUnknownKeys();
    }
  }

  void RefuseUnknownKeys() const {
    std::set<std::string> seen;
    for (const auto& entry : node_) {
      if (!entry.first.IsScalar()) throw InputError(Where(file_, entry.first.Mark()) + "a key must be a plain word");
      const std::string& key = entry.first.Scalar();
      if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
        throw InputError(Where(file_, entry.first.Mark()) + UnknownChoiceMessage("key", key, known_));
      }
      if (!seen.insert(key).second) throw InputError(Where(file_, entry.first.Mark()) + "key '" + key + "' is given twice");
    }
  }

 private:
  YAML::Node Find(std::string_view name) {
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.emplace_back(name);
    const YAML::Node found = static_cast<const YAML::Node&>(node_)[std::string(name)];
    return found.IsDefined() ? found : YAML::Node(YAML::NodeType::Undefined);
  }
  [[noreturn]] void Fail(const YAML::Node& node, std::string_view name, std::string_view wanted) const {
    const std::string value = node.IsScalar() ? "'" + node.Scalar().substr(0, 100) + "'" : "a list or mapping";
    throw InputError(Where(file_, node.Mark()) + std::string(name) + ": expected " + std::string(wanted) + ", found " + value);
  }
  template <class T>
  void Read(std::string_view name, std::string_view wanted, T& value) {
    const YAML::Node node = Find(name);
    if (!node || !node.IsDefined()) return;
    try {
      value = node.as<T>();
    } catch (const YAML::Exception&) {
      Fail(node, name, wanted);
    }
  }

  YAML::Node node_;
  std::string_view file_;
  std::vector<std::string> known_;
};

/// Lists fields, their values and help.
class Describer : public ConfigVisitor {
 public:
  explicit Describer(std::string indent = "") : indent_(std::move(indent)) {}
  void Field(std::string_view name, std::string_view help, bool& value) override { Line(name, value ? "true" : "false", help); }
  void Field(std::string_view name, std::string_view help, uint64_t& value) override { Line(name, std::to_string(value), help); }
  void Field(std::string_view name, std::string_view help, double& value, double, double) override {
    char text[32];
    std::snprintf(text, sizeof(text), "%g", value);
    Line(name, text, help);
  }
  void Field(std::string_view name, std::string_view help, std::string& value) override { Line(name, '"' + value + '"', help); }
  void Field(std::string_view name, std::string_view help, std::vector<std::string>& value) override {
    std::string list = "[";
    for (const std::string& item : value) list += (list.size() > 1 ? ", " : "") + item;
    Line(name, list + "]", help);
  }
  void Count(std::string_view name, std::string_view help, int& value, int) override { Line(name, std::to_string(value), help); }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double low,
                double high) override {
    if (is_word) return Line(name, word, help);
    Field(name, help, value, low, high);
  }
  void Choice(std::string_view name, std::string_view help, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>&) override {
    Line(name, '"' + std::string(names[index]) + '"', help);
  }
  void Group(std::string_view name, std::string_view help, const ConfigFields& visit) override {
    Line(name, "", help);
    Describer inner(indent_ + "  ");
    visit(inner);
    text_ += inner.text_;
  }
  void Entries(std::string_view name, std::string_view help, size_t size, const std::function<void(size_t)>&,
               const std::function<void(ConfigVisitor&, size_t)>& visit) override {
    Line(name, "", help);
    for (size_t i = 0; i < size; ++i) {
      Describer inner(indent_ + "    ");
      visit(inner, i);
      // The first line of an entry carries the dash.
      std::string entry = std::move(inner.text_);
      if (!entry.empty()) entry[indent_.size() + 2] = '-';
      text_ += entry;
    }
  }
  const std::string& text() const { return text_; }

 private:
  void Line(std::string_view name, std::string_view value, std::string_view help) {
    text_ += indent_ + std::string(name) + ": " + std::string(value) + "  # " + std::string(help) + "\n";
  }
  std::string indent_, text_;
};

// The line of the '---' that begins a second document; 0 if there is none. YAML::LoadAll never ends on some texts (`,"`).
int SecondDocument(std::string_view text) {
  bool begun = false;
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view one = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
    const bool marker = one.starts_with("---") && (one.size() == 3 || one[3] == ' ' || one[3] == '\r' || one[3] == '\t');
    if (marker && begun) return line;
    begun = begun || marker || (one.find_first_not_of(" \t\r") != std::string_view::npos && one[0] != '#' && one[0] != '%');
  }
  return 0;
}

}  // namespace

void ReadYaml(std::string_view text, std::string_view name, const ConfigFields& fields) {
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    if (const int line = SecondDocument(text); line > 0)
      throw InputError(std::string(name) + ":" + std::to_string(line) + ": a second document (after '---'); one file holds one");
    YamlReader reader(root, name);
    fields(reader);
    reader.RefuseUnknownKeys();
  } catch (const YAML::Exception& error) {
    throw InputError(Where(name, error.mark) + error.msg);
  }
}

void ReadYamlFile(const std::filesystem::path& file, const ConfigFields& fields) {
  ReadYaml(ReadTextFile(file, kMaxFileSize), file.string(), fields);
}

std::string DescribeConfig(const ConfigFields& fields) {
  Describer describer;
  fields(describer);
  return describer.text();
}

}  // namespace airsim360
