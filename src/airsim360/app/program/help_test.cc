#include "airsim360/app/program/help.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <sstream>

#include "airsim360/app/program/program.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Words of a shell's line up to a redirection; "…" keeps spaces.
std::vector<std::string> ShellWords(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, any = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
      any = true;
    } else if (c == ' ' && !quoted) {
      if (any) words.push_back(std::exchange(word, {}));
      any = false;
    } else if (c == '>' && !quoted) {
      return words;
    } else {
      word += c;
      any = true;
    }
  }
  if (any) words.push_back(word);
  return words;
}

// A program that parses and does nothing.
class Parser {
 public:
  Parser() { Silence(program_.app()); }
  void Parse(const std::vector<std::string>& words) {
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    try {
      program_.Run(static_cast<int>(arguments.size()), arguments.data());
    } catch (const Parsed&) {
    }
  }
  CLI::App& app() { return program_.app(); }

 private:
  struct Parsed {};
  // A command's own callback holds what its flags write to, so it stays; one before it ends the run.
  static void Silence(CLI::App& app) {
    const auto inner = app.get_subcommands([](CLI::App*) { return true; });
    for (CLI::App* command : inner) Silence(*command);
    if (!inner.empty()) return;
    app.parse_complete_callback([&app] {
      if (app.remaining_size() > 0 && !app.get_prefix_command()) throw InputError("unknown: " + app.remaining().front());
      throw Parsed();
    });
  }
  Program program_{AllCommands()};
};

std::string HelpOf(const CLI::App& command) {
  return command.get_formatter()->make_help(&command, "airsim360", CLI::AppFormatMode::Normal);
}

TEST(Help, EveryExampleParses) {
  for (const CommandExample& example : CommandExamples()) {
    const std::vector<std::string> words = ShellWords(example.line);
    ASSERT_EQ(words.front(), "airsim360");
    Parser parser;
    EXPECT_NO_THROW(parser.Parse(words)) << example.line;
    const CLI::App* chosen = &parser.app();
    while (!chosen->get_subcommands().empty()) chosen = chosen->get_subcommands().front();
    EXPECT_EQ(CommandPath(*chosen), example.command) << example.line;
  }
  // What the test of the examples rests on: a wrong line throws.
  EXPECT_THROW(Parser().Parse({"airsim360", "render", "--wrold", "box_room"}), InputError);
  EXPECT_THROW(Parser().Parse({"airsim360", "render", "--world", "box_room"}), InputError);
}

TEST(Help, EveryCommandThatDoesSomethingHasTwoExamples) {
  std::map<std::string, int> counts;
  for (const CommandExample& example : CommandExamples()) ++counts[std::string(example.command)];
  Program program(AllCommands());
  for (const CLI::App* command : CommandsOf(program.app())) {
    if (command->get_subcommands([](const CLI::App*) { return true; }).empty()) {
      EXPECT_GE(counts[CommandPath(*command)], 2) << CommandPath(*command);
    } else {
      EXPECT_EQ(counts[CommandPath(*command)], 0) << CommandPath(*command);
    }
  }
}

TEST(Help, NoLineIsLongerThanAHundredColumnsAndEveryFlagIsThereOnce) {
  Program program(AllCommands());
  for (const CLI::App* command : CommandsOf(program.app())) {
    const std::string help = HelpOf(*command);
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
      const auto columns = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });
      // An example is one line, however long.
      if (line.find("airsim360 ") == std::string::npos) {
        EXPECT_LE(columns, 100) << line;
      }
    }
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_group().empty() || !option->nonpositional()) continue;
      size_t found = 0;
      const std::string entry = "\n  " + option->get_name(false, true);
      for (size_t at = help.find(entry); at != std::string::npos; at = help.find(entry, at + 1))
        found += help[at + entry.size()] == ' ' || help[at + entry.size()] == '\n';
      EXPECT_EQ(found, 1u) << entry;
    }
  }
}

TEST(Help, FlagsAreInGroupsAndRequiredOnesSaySo) {
  Program program(AllCommands());
  const std::string help = HelpOf(*program.app().get_subcommand("collect"));
  size_t last = 0;
  for (const char* heading : {"\nWorld:\n", "\nRoute:\n", "\nCamera:\n", "\nQuality:\n", "\nPeople:\n", "\nWeather:\n", "\nOutput:\n",
                              "\nMachine:\n", "\nExamples:\n"}) {
    const size_t at = help.find(heading);
    ASSERT_NE(at, std::string::npos) << heading;
    EXPECT_GT(at, last);
    last = at;
  }
  EXPECT_NE(help.find("--out TEXT REQUIRED"), std::string::npos);
  EXPECT_EQ(HelpOf(*program.app().get_subcommand("plan")).find("\nFurther:\n"), std::string::npos);
}

TEST(Help, WrappedTextKeepsItsWords) {
  const std::string text = "one two  three … fourteen-letters five";
  for (size_t width = 1; width < 40; ++width) {
    std::istringstream before(text), after(Wrapped(text, width, 3));
    std::string a, b;
    while (before >> a) {
      ASSERT_TRUE(after >> b);
      EXPECT_EQ(a, b);
    }
    EXPECT_FALSE(after >> b);
  }
  EXPECT_EQ(Wrapped("aa bb cc", 5, 2), "aa bb\n  cc");
}

TEST(Help, ChoicesAreTaken) {
  // What completion offers parses; a name that no flag takes is none.
  for (const std::string& tier : ChoicesOf("render", "--tier"))
    EXPECT_NO_THROW(Parser().Parse({"airsim360", "render", "--world", "box_room", "--out", "x", "--tier", tier}));
  EXPECT_FALSE(ChoicesOf("render", "--world").empty());
  EXPECT_TRUE(ChoicesOf("render", "--pose").empty());
}

}  // namespace
}  // namespace airsim360
