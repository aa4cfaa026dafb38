// airsim360 <command>: parses the command line and turns errors into exit statuses.
// 0 done, 1 failed at run time, 2 bad input; messages on stderr as "airsim360: error: …".
#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "airsim360/app/commands.h"
#include "airsim360/app/gpu_choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/version.h"
#include "airsim360/render/vulkan/choose_renderer.h"

namespace airsim360 {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

int Fail(const std::string& message, int status) {
  std::fprintf(stderr, "airsim360: error: %s\n", message.c_str());
  return status;
}

uint64_t ParseSeed(const std::string& text) {
  uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InputError("--seed: '" + text + "' is not a whole number from 0 to 2^64 - 1");
  }
  return seed;
}

// Adds the flags of GlobalOptions to one command, and --no-cache. `limit` holds the thread limit once
// --threads is parsed.
void AddGlobalFlags(CLI::App& command, GlobalOptions& globals, std::unique_ptr<ThreadLimit>& limit) {
  command.add_flag("--json", globals.json, "machine-readable result on stdout")->group("Common");
  command
      .add_option_function<std::string>(
          "--seed", [&](const std::string& seed) { globals.seed = ParseSeed(seed); },
          "seed of everything random, 0 … 2^64 - 1 (default 0)")
      ->group("Common");
  command
      .add_option_function<int>(
          "--threads",
          [&](int threads) {
            if (threads < 0 || threads > 4096) {
              throw InputError("--threads: " + std::to_string(threads) + " is not in 0 (all cores) … 4096");
            }
            globals.threads = threads;
            limit = std::make_unique<ThreadLimit>(threads);
          },
          "worker threads, 0 = all cores (default); results do not depend on it")
      ->group("Common");
  command
      .add_flag_callback(
          "--no-cache", [] { ::setenv("AIRSIM360_CACHE", "", 1); },
          "build everything anew and keep nothing on disk")
      ->group("Common");
  command
      .add_option_function<std::string>(
          "--device",
          [&](const std::string& device) {
            CheckDevice("--device", device);
            globals.device = device;
          },
          "auto, cpu or vulkan (default auto: a GPU where one traces rays)")
      ->group("Common");
  const bool several = command.get_name() == "collect";
  command
      .add_option_function<std::string>(
          "--gpu",
          [&globals, several](const std::string& text) {
            globals.gpus = ParseGpus(text, several);
            globals.gpu = globals.gpus.front();
            if (globals.gpus.size() == 1) globals.gpus.clear();
          },
          std::string("index of the GPU to use, as 'airsim360 doctor' lists them (default: the best)") +
              (several ? "; several (0,1) or all: a process for each" : ""))
      ->group("Common");
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> FlagNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// The text for flags or words that the command does not take, naming the nearest flag; else that of `error`.
std::string UnknownArgumentMessage(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  for (const std::string& word : app.remaining(true)) {
    if (word == "--") continue;
    if (word.starts_with("-")) {
      const std::string flag = word.substr(0, word.find('='));
      return command.get_name() + ": " + UnknownChoiceMessage("flag", flag, FlagNames(command));
    }
    return command.get_name() + ": unexpected argument '" + word + "'";
  }
  return error.what();
}

int ParseAndRun(int argc, char** argv) {
  CLI::App app("Panoramic (360 degree) simulator for drones", "airsim360");
  app.set_version_flag("--version", std::string("airsim360 ") + kVersion);
  app.require_subcommand(1);
  app.footer("Every command documents its flags: airsim360 COMMAND --help");
  GlobalOptions globals;
  std::unique_ptr<ThreadLimit> limit;
  AddWorldsCommand(app, globals);
  AddWorldCommand(app, globals);
  AddRenderCommand(app, globals);
  AddCollectCommand(app, globals);
  AddPlanCommand(app, globals);
  AddVerifyCommand(app, globals);
  AddVideoCommand(app, globals);
  AddStitchCommand(app, globals);
  AddEvalCommand(app, globals);
  AddFlyCommand(app, globals);
  AddServeCommand(app, globals);
  AddAgentCommand(app, globals);
  AddDroneCommand(app, globals);
  AddDoctorCommand(app, globals);
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const auto nested = command->get_subcommands([](const CLI::App*) { return true; });
    if (nested.empty()) AddGlobalFlags(*command, globals, limit);
    for (CLI::App* inner : nested) AddGlobalFlags(*inner, globals, limit);
  }

  // A wrong command is told here, so that the message can name the nearest one.
  if (argc > 1 && argv[1][0] != '-') {
    const std::vector<std::string> names = CommandNames(app);
    if (std::find(names.begin(), names.end(), argv[1]) == names.end()) {
      throw InputError(UnknownChoiceMessage("command", argv[1], names));
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    // A misspelt flag may also be why a required one is missing: it is named first.
    throw InputError(UnknownArgumentMessage(app, error));
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw RuntimeError("cannot write to stdout");
  return 0;
}

}  // namespace
}  // namespace airsim360

int main(int argc, char** argv) {
  using namespace airsim360;
  // A file size limit or a closed pipe comes back as an error of the write, not as a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return ParseAndRun(argc, argv);
  } catch (const InputError& error) {
    return Fail(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return Fail(error.what(), kFailed);
  }
}
