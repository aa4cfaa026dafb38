// The program: its commands, and one run of it.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "airsim360/app/commands.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {

class Program {
 public:
  Program();
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
