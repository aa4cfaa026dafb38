#include "airsim360/app/program/help.h"

#include <algorithm>
#include <functional>
#include <memory>

namespace airsim360 {
namespace {

constexpr size_t kColumns = 100, kNameColumns = 30;

// Characters of UTF-8.
size_t Length(std::string_view text) {
  return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// "  name   description", the description wrapped in its column.
std::string Entry(const std::string& name, std::string_view description) {
  std::string text = "  " + name;
  const size_t length = Length(text);
  text += length + 2 > kNameColumns ? "\n" + std::string(kNameColumns, ' ') : std::string(kNameColumns - length, ' ');
  return text + Wrapped(description, kColumns - kNameColumns, kNameColumns) + "\n";
}

class GroupedHelp : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override { return Wrapped(app->get_description(), kColumns, 0) + "\n\n"; }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = make_description(app) + make_usage(app, name) + make_positionals(app);
    for (const std::string_view group : FlagGroups()) {
      const auto flags = app->get_options([&](const CLI::Option* flag) { return flag->get_group() == group && flag->nonpositional(); });
      if (!flags.empty()) text += make_group(std::string(group), false, flags);
    }
    text += make_subcommands(app, mode);
    const std::string examples = make_footer(app);
    return examples.empty() ? text : text + "\n" + examples;
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return Entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override { return Entry(command->get_name(), command->get_description()); }
};

std::string ExamplesText(const std::string& command) {
  std::string text;
  for (const CommandExample& example : CommandExamples()) {
    if (example.command != command) continue;
    text += (text.empty() ? "Examples:\n  " : "\n  ") + std::string(example.line) + "\n      " + Wrapped(example.what, kColumns - 6, 6);
  }
  return text;
}

void Arrange(CLI::App& command, const std::shared_ptr<GroupedHelp>& help) {
  command.formatter(help);
  for (CLI::Option* option : command.get_options()) {
    if (option->nonpositional() && !option->get_group().empty()) option->group(std::string(GroupOfFlag(option->get_name())));
  }
  if (const std::string examples = ExamplesText(CommandPath(command)); !examples.empty()) command.footer(examples);
  for (CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; })) Arrange(*inner, help);
}

}  // namespace

std::string Wrapped(std::string_view text, size_t width, size_t indent) {
  std::string lines;
  size_t column = 0;
  while (!text.empty()) {
    const size_t space = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(std::min(space + 1, text.size()));
    if (column > 0 && column + 1 + Length(word) > width) {
      lines += "\n" + std::string(indent, ' ');
      column = 0;
    }
    if (column > 0) lines += " ", ++column;
    lines += word;
    column += Length(word);
  }
  return lines;
}

std::string CommandPath(const CLI::App& command) {
  if (command.get_parent() == nullptr) return "";
  const std::string above = CommandPath(*command.get_parent());
  return above.empty() ? command.get_name() : above + " " + command.get_name();
}

std::vector<const CLI::App*> CommandsOf(const CLI::App& program) {
  std::vector<const CLI::App*> commands = {&program};
  for (const CLI::App* inner : program.get_subcommands([](const CLI::App*) { return true; })) {
    const auto further = CommandsOf(*inner);
    commands.insert(commands.end(), further.begin(), further.end());
  }
  return commands;
}

void ArrangeHelp(CLI::App& program) { Arrange(program, std::make_shared<GroupedHelp>()); }

}  // namespace airsim360
