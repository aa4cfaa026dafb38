// The program: its commands, and one run of it.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {

/// What a program can do, in the order in which its help tells.
struct CommandSet {
  std::vector<void (*)(CLI::App&, GlobalOptions&)> commands;  ///< which take the flags of GlobalOptions
  std::vector<void (*)(CLI::App&)> own;                       ///< which take flags of their own alone; added last
};

/// Every command.
CommandSet AllCommands();

/// `main` of a program with these commands: what is thrown becomes a message on stderr, "airsim360: error: …", and the exit status:
/// 0 done, 1 failed at run time, 2 bad input.
int Main(int argc, const char* const* argv, const CommandSet& commands);

class Program {
 public:
  explicit Program(const CommandSet& commands);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// The description of the command line, from which --help, manual pages and completion are made.
  CLI::App& app() { return app_; }

  /// Parses the command line and does what it says. InputError for a wrong one, and whatever the command
  /// throws.
  void Run(int argc, const char* const* argv);

 private:
  CLI::App app_;
  GlobalOptions globals_;
  std::unique_ptr<ThreadLimit> limit_;  // once --threads is parsed
};

}  // namespace airsim360
