#include "keywords.h"

#include <algorithm>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"

namespace airsim360::python {
namespace {

class KeywordReader : public ConfigVisitor {
 public:
  explicit KeywordReader(const py::dict& keywords) : keywords_(keywords) {}

  void Field(std::string_view name, std::string_view, bool& value) override { Read(name, "True or False", value); }
  void Field(std::string_view name, std::string_view, uint64_t& value) override { Read(name, "a whole number, 0 or more", value); }
  void Field(std::string_view name, std::string_view, double& value, double low, double high) override {
    const std::string wanted = Text("a number from %g to %g", low, high);
    double read = value;
    Read(name, wanted, read);
    if (!(read >= low && read <= high)) Refuse(name, wanted);
    value = read;
  }
  void Field(std::string_view name, std::string_view, std::string& value) override { Read(name, "a text", value); }
  void Field(std::string_view name, std::string_view, std::vector<std::string>& value) override { Read(name, "a list of texts", value); }
  void Count(std::string_view name, std::string_view, int& value, int high) override {
    const py::object given = Find(name);
    if (!given || given.is_none()) return;
    const std::string wanted = Text("a whole number from 1 to %d, or None", high);
    int64_t read = 0;
    Read(name, wanted, read);
    if (read < 1 || read > high) Refuse(name, wanted);
    value = static_cast<int>(read);
  }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double low,
                double high) override {
    const py::object given = Find(name);
    if (!given) return;
    is_word = py::isinstance<py::str>(given) && given.cast<std::string>() == word;
    value = 0;
    if (is_word) return;
    if (py::isinstance<py::str>(given)) Refuse(name, Text("'%s' or a number from %g to %g", word, low, high));
    Field(name, help, value, low, high);
  }
  void Choice(std::string_view name, std::string_view, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>& set) override {
    std::string word = names[index];
    Read(name, "a text", word);
    set(ParseChoice(name, word, names));
  }
  void Group(std::string_view name, std::string_view, const ConfigFields& visit) override {
    const py::object given = Find(name);
    if (!given) return;
    if (!py::isinstance<py::dict>(given)) Refuse(name, "a dictionary");
    ReadKeywords(given.cast<py::dict>(), visit);
  }
  void RefuseUnknown(const std::vector<std::string>& others) const {
    std::vector<std::string> choices = others;
    choices.insert(choices.end(), known_.begin(), known_.end());
    for (const auto& [key, value] : keywords_) {
      const auto name = key.cast<std::string>();
      if (std::ranges::count(known_, name) == 0) throw InputError(UnknownChoiceMessage("keyword", name, choices));
    }
  }

 private:
  py::object Find(std::string_view name) {
    known_.emplace_back(name);
    const py::str key{std::string(name)};
    return keywords_.contains(key) ? py::object(keywords_[key]) : py::object();
  }
  [[noreturn]] void Refuse(std::string_view name, const std::string& wanted) const {
    const std::string key(name);
    throw InputError(key + ": expected " + wanted + ", found " + py::repr(keywords_[py::str(key)]).cast<std::string>());
  }
  template <class T>
  void Read(std::string_view name, const std::string& wanted, T& value) {
    const py::object given = Find(name);
    if (!given) return;
    try {
      value = given.cast<T>();
    } catch (const py::cast_error&) {
      Refuse(name, wanted);
    }
  }
  const py::dict& keywords_;
  std::vector<std::string> known_;
};

class KeywordLister : public ConfigVisitor {
 public:
  void Field(std::string_view name, std::string_view help, bool& value) override { Add(name, help, "bool", value ? "True" : "False"); }
  void Field(std::string_view name, std::string_view help, uint64_t& value) override { Add(name, help, "int", std::to_string(value)); }
  void Field(std::string_view name, std::string_view help, double& value, double, double) override {
    Add(name, help, "float", py::repr(py::float_(value)).cast<std::string>());
  }
  void Field(std::string_view name, std::string_view help, std::string& value) override { Add(name, help, "str", "'" + value + "'"); }
  void Field(std::string_view name, std::string_view help, std::vector<std::string>&) override { Add(name, help, "list[str]", "[]"); }
  void Count(std::string_view name, std::string_view help, int&, int) override { Add(name, help, "int | None", "None"); }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double, double) override {
    Add(name, help, "float | str", is_word ? "'" + std::string(word) + "'" : py::repr(py::float_(value)).cast<std::string>());
  }
  void Choice(std::string_view name, std::string_view help, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>&) override {
    Add(name, help, "str", "'" + std::string(names[index]) + "'");
  }
  void Group(std::string_view name, std::string_view help, const ConfigFields&) override { Add(name, help, "dict", "{}"); }
  std::vector<std::string> names;
  std::string signature, help;

 private:
  void Add(std::string_view name, std::string_view what, const std::string& type, const std::string& standard) {
    names.emplace_back(name);
    signature += (signature.empty() ? "" : ", ") + std::string(name) + ": " + type + " = " + standard;
    help += (help.empty() ? "" : " ") + std::string(name) + ": " + std::string(what) + ".";
  }
};

}  // namespace

void ReadKeywords(const py::dict& keywords, const ConfigFields& fields, const std::vector<std::string>& others) {
  KeywordReader reader(keywords);
  fields(reader);
  reader.RefuseUnknown(others);
}

std::vector<std::string> KeywordNames(const ConfigFields& fields) {
  KeywordLister lister;
  fields(lister);
  return lister.names;
}

std::string KeywordSignature(const ConfigFields& fields) {
  KeywordLister lister;
  fields(lister);
  return lister.signature;
}

std::string KeywordHelp(const ConfigFields& fields) {
  KeywordLister lister;
  fields(lister);
  return lister.help;
}

}  // namespace airsim360::python
