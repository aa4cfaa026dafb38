// What `--help`, the manual pages and the completion of shells say of a command beside what its flags say
// themselves: which group a flag belongs to, examples, what a flag can be.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

struct CommandExample {
  std::string_view command;  ///< "render", "world export"
  std::string_view line;     ///< as typed
  std::string_view what;     ///< does it, without a full stop
};

/// Two or more of each command that does something, those of a command in a row.
std::span<const CommandExample> CommandExamples();

/// Headings of flags, in the order of --help. Flags in no other are under the last but one, "Further".
std::span<const std::string_view> FlagGroups();
std::string_view GroupOfFlag(std::string_view flag);

/// What a flag ("--tier") or an argument ("world") of the command can be, for completion; empty where any
/// text or a file is meant.
std::vector<std::string> ChoicesOf(std::string_view command, std::string_view flag);
/// Whether a file or folder may be given for it.
bool TakesFiles(std::string_view flag);

/// "world export" of that command of `airsim360`; "" of the program itself.
std::string CommandPath(const CLI::App& command);
/// The program itself, its commands and theirs, but none without a description.
std::vector<const CLI::App*> CommandsOf(const CLI::App& program);

/// Flags in groups, lines of at most 100 columns, examples at the end: of every command of `program`.
void ArrangeHelp(CLI::App& program);

/// `text` in lines of at most `width` characters (a word longer than that has a line of its own), each after
/// the first indented by `indent` spaces.
std::string Wrapped(std::string_view text, size_t width, size_t indent);

}  // namespace airsim360
