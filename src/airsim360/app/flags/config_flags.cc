#include "airsim360/app/flags/config_flags.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

std::string FlagOf(std::string_view name, std::string_view before = "--") {
  std::string flag = std::string(before) + std::string(name);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

std::string WordsOf(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

template <class T>
bool Parse(std::string_view text, T& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

[[noreturn]] void Refuse(const std::string& flag, const std::string& text, const std::string& wanted) {
  throw InputError(flag + ": '" + text + "' is not " + wanted);
}

int ParseCount(const std::string& flag, const std::string& text, int high) {
  int64_t value = 0;
  if (!Parse(text, value)) Refuse(flag, text, "a whole number from 1 to " + std::to_string(high));
  const int64_t nearest = std::clamp<int64_t>(value, 1, high);
  if (nearest != value) {
    throw InputError(flag + ": " + text + " is not in 1 … " + std::to_string(high) + "; did you mean " + std::to_string(nearest) + "?");
  }
  return static_cast<int>(value);
}

double ParseNumberIn(const std::string& flag, const std::string& text, double low, double high, const std::string& or_word) {
  double value = 0;
  if (Parse(text, value) && value >= low && value <= high) return value;
  const std::string range = "a number from " + Text(low) + " to " + Text(high);
  throw InputError(flag + ": '" + text + "' is " + (or_word.empty() ? "not " : "neither " + or_word + " nor ") + range);
}

class FlagAdder : public ConfigVisitor {
 public:
  explicit FlagAdder(CLI::App& command) : command_(command) {}

  void Field(std::string_view name, std::string_view help, bool& value) override {
    const bool begins = value;
    command_.add_flag_callback(
        FlagOf(name, begins ? "--no-" : "--"), [&value, begins] { value = !begins; }, (begins ? "without the " : "") + std::string(help));
  }
  void Field(std::string_view name, std::string_view help, uint64_t& value) override {
    command_.add_option(FlagOf(name), value, Help(help, std::to_string(value)));
  }
  void Field(std::string_view name, std::string_view help, double& value, double low, double high) override {
    Add(name, Help(help, Text(value)),
        [&value, low, high](const std::string& flag, const std::string& text) { value = ParseNumberIn(flag, text, low, high, ""); });
  }
  void Field(std::string_view name, std::string_view help, std::string& value) override {
    command_.add_option(FlagOf(name), value, std::string(help));
  }
  void Field(std::string_view name, std::string_view help, std::vector<std::string>& value) override {
    command_.add_option(FlagOf(name), value, std::string(help))->delimiter(',');
  }
  void Count(std::string_view name, std::string_view help, int& value, int high) override {
    Add(name, std::string(help), [&value, high](const std::string& flag, const std::string& text) {
      value = ParseCount(flag, text, high);
    })->type_name("INT");
  }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double low,
                double high) override {
    Add(name, Help(help, is_word ? word : Text(value)),
        [word, &is_word, &value, low, high](const std::string& flag, const std::string& text) {
          is_word = text == word;
          value = is_word ? 0 : ParseNumberIn(flag, text, low, high, "'" + std::string(word) + "'");
        });
  }
  void Choice(std::string_view name, std::string_view help, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>& set) override {
    Add(name, Help(help, names[index]), [what = WordsOf(name), names, set](const std::string& flag, const std::string& text) {
      set(ParseChoice(what, text, names, flag));
    });
  }
  void Group(std::string_view, std::string_view, const ConfigFields& visit) override { visit(*this); }

 private:
  static std::string Help(std::string_view help, const std::string& standard) { return std::string(help) + " (default " + standard + ")"; }
  template <class Take>
  CLI::Option* Add(std::string_view name, const std::string& help, const Take& take) {
    const std::string flag = FlagOf(name);
    return command_.add_option_function<std::string>(
        flag, [flag, take](const std::string& text) { take(flag, text); }, help);
  }
  CLI::App& command_;
};

// Names of flags, and the words of those that are choices.
class FlagLister : public ConfigVisitor {
 public:
  struct Flag {
    std::string name;
    std::vector<std::string> choices;
  };
  void Field(std::string_view name, std::string_view, bool& value) override { Add(name, {}, value ? "--no-" : "--"); }
  void Field(std::string_view name, std::string_view, uint64_t&) override { Add(name); }
  void Field(std::string_view name, std::string_view, double&, double, double) override { Add(name); }
  void Field(std::string_view name, std::string_view, std::string&) override { Add(name); }
  void Field(std::string_view name, std::string_view, std::vector<std::string>&) override { Add(name); }
  void Count(std::string_view name, std::string_view, int&, int) override { Add(name); }
  void NumberOr(std::string_view name, std::string_view, const char* word, bool&, double& value, double, double) override {
    Add(name, {Text(value), word});
  }
  void Choice(std::string_view name, std::string_view, std::span<const char* const> names, size_t,
              const std::function<void(size_t)>&) override {
    Add(name, {names.begin(), names.end()});
  }
  void Group(std::string_view, std::string_view, const ConfigFields& visit) override { visit(*this); }

  std::vector<Flag> flags;

 private:
  void Add(std::string_view name, std::vector<std::string> choices = {}, std::string_view before = "--") {
    flags.push_back({FlagOf(name, before), std::move(choices)});
  }
};

}  // namespace

void AddConfigFlags(CLI::App& command, const ConfigFields& fields) {
  FlagAdder adder(command);
  fields(adder);
}

std::vector<std::string> ConfigFlagNames(const ConfigFields& fields) {
  FlagLister lister;
  fields(lister);
  std::vector<std::string> names;
  for (const FlagLister::Flag& flag : lister.flags) names.push_back(flag.name);
  return names;
}

void RefuseWithout(const CLI::App& command, const std::vector<std::string>& flags, const std::string& owner) {
  if (command.count(owner) > 0) return;
  for (const std::string& flag : flags)
    if (command.count(flag) > 0) throw InputError(flag + ": it is of " + owner + ", which is not given");
}

std::vector<std::string> ConfigFlagChoices(const ConfigFields& fields, std::string_view flag) {
  FlagLister lister;
  fields(lister);
  const auto found = std::ranges::find(lister.flags, flag, &FlagLister::Flag::name);
  return found == lister.flags.end() ? std::vector<std::string>{} : found->choices;
}

}  // namespace airsim360
