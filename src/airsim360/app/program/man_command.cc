// airsim360 man: manual pages, from the same description as --help.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "airsim360/app/flags/commands.h"
#include "airsim360/app/program/help.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/record/version.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// The code point at text[i], of which i is moved to the last byte.
uint32_t CodePoint(std::string_view text, size_t& i) {
  const auto first = static_cast<unsigned char>(text[i]);
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  uint32_t code = first & (0x3Fu >> more);
  for (int k = 0; k < more && i + 1 < text.size(); ++k) code = code << 6 | (static_cast<unsigned char>(text[++i]) & 0x3Fu);
  return code;
}

// Text for roff: plain ASCII, nothing of it a request.
std::string Roff(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x80) {
      char glyph[16];
      std::snprintf(glyph, sizeof(glyph), "\\[u%04X]", CodePoint(text, i));
      out += glyph;
    } else if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\'') {
      out += "\\(aq";
    } else if (c == '"') {
      out += "\\(dq";
    } else if (c == '`') {
      out += "\\(ga";
    } else if (c == '^') {
      out += "\\(ha";
    } else if (c == '~') {
      out += "\\(ti";
    } else {
      if (c == '.' && out.empty()) out += "\\&";
      out += c;
    }
  }
  return out;
}

std::string PageName(const CLI::App& command) {
  std::string name = "airsim360", path = CommandPath(command);
  std::ranges::replace(path, ' ', '-');
  return path.empty() ? name : name + "-" + path;
}

std::string Synopsis(const CLI::App& command) {
  const std::string path = CommandPath(command);
  std::string text = ".B airsim360" + (path.empty() ? "" : " " + Roff(path)) + "\n";
  if (!command.get_subcommands([](const CLI::App*) { return true; }).empty()) return text + ".I COMMAND\n.RI [ FLAGS ]\n";
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional() && option->get_required()) text += ".B " + Roff(option->get_name()) + "\n.I VALUE\n";
  }
  text += ".RI [ FLAGS ]\n";
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) continue;
    const std::string name = Roff(option->get_name());
    text += option->get_required() ? ".I " + name + "\n" : ".RI [ " + name + " ]\n";
  }
  return text;
}

std::string OptionEntry(const CLI::Option& option) {
  std::string names = option.nonpositional() ? option.get_name(false, true) : option.get_name();
  std::string text = ".TP\n.B " + Roff(names);
  if (option.nonpositional() && option.get_type_size() != 0) text += " VALUE";
  if (option.get_required()) text += " (required)";
  const std::string about = Roff(option.get_description());
  return text + "\n" + (about.empty() ? "\\&" : about) + "\n";
}

std::string Options(const CLI::App& command) {
  std::string text;
  const auto add = [&](std::string_view heading, const auto& wanted) {
    std::string entries;
    for (const CLI::Option* option : command.get_options()) {
      if (!option->get_group().empty() && wanted(*option)) entries += OptionEntry(*option);
    }
    if (!entries.empty()) text += ".SS " + std::string(heading) + "\n" + entries;
  };
  add("Arguments", [](const CLI::Option& option) { return !option.nonpositional(); });
  for (const std::string_view group : FlagGroups())
    add(group, [&](const CLI::Option& option) { return option.nonpositional() && option.get_group() == group; });
  return text;
}

std::string Page(const CLI::App& command) {
  std::string title = PageName(command);
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = ".TH " + title + " 1 \"\" \"airsim360 " + kVersion + "\" \"AirSim360\"\n.SH NAME\n" + Roff(PageName(command)) +
                     " \\- " + Roff(command.get_description()) + "\n.SH SYNOPSIS\n" + Synopsis(command) + ".SH OPTIONS\n" +
                     Options(command);
  const auto inner = command.get_subcommands([](const CLI::App*) { return true; });
  if (!inner.empty()) text += ".SH COMMANDS\n";
  for (const CLI::App* one : inner) text += ".TP\n.BR " + Roff(PageName(*one)) + " (1)\n" + Roff(one->get_description()) + "\n";
  std::string examples;
  for (const CommandExample& example : CommandExamples()) {
    if (example.command == CommandPath(command)) examples += ".TP\n.B " + Roff(example.line) + "\n" + Roff(example.what) + "\n";
  }
  if (!examples.empty()) text += ".SH EXAMPLES\n" + examples;
  return text + ".SH EXIT STATUS\n0 done, 1 failed at run time, 2 bad input.\n";
}

void WritePages(const CLI::App& program, const std::string& folder) {
  if (folder.empty()) {
    std::fputs(Page(program).c_str(), stdout);
    return;
  }
  CreateWritableFolder(folder);
  for (const CLI::App* command : CommandsOf(program)) {
    const fs::path file = fs::path(folder) / (PageName(*command) + ".1");
    WriteFileAtomically(file, std::string_view(Page(*command)));
    std::printf("%s\n", file.c_str());
  }
}

}  // namespace

void AddManCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("man", "writes the manual pages of all commands");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder of the pages, for example ~/.local/share/man/man1 (default: one page to stdout)");
  command->callback([&app, folder] { WritePages(app, *folder); });
}

}  // namespace airsim360
