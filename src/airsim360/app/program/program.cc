#include "airsim360/app/program/program.h"

#include <malloc.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "airsim360/app/flags/gpu_choice.h"
#include "airsim360/app/program/help.h"
#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/dataset/record/version.h"
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
          "--seed", [&](const std::string& seed) { globals.seed = ParseSeed(seed); }, "seed of everything random, 0 … 2^64 - 1 (default 0)")
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
          "--no-cache", [] { ::setenv("AIRSIM360_CACHE", "", 1); }, "build everything anew and keep nothing on disk")
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

bool Any(const CLI::App*) { return true; }

std::vector<std::string> NamesOf(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> FlagNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // not for people
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string HelpHint(const CLI::App& command) {
  const std::string path = CommandPath(command);
  return "'airsim360 " + path + (path.empty() ? "" : " ") + "--help' lists them all";
}

// The command that `words` name, with what is below it; InputError for a word that is none.
const CLI::App& FindCommand(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* command = &program;
  for (const std::string& word : words) {
    const auto inner = command->get_subcommands(Any);
    const auto found = std::ranges::find(inner, word, [](const CLI::App* c) { return c->get_name(); });
    if (found == inner.end()) throw InputError(UnknownChoiceMessage("command", word, NamesOf(inner)));
    command = *found;
  }
  return *command;
}

// The text for flags or words that the command does not take, naming the nearest flag; else that of `error`.
std::string UnknownArgumentMessage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  const std::string path = CommandPath(*command), of = path.empty() ? "" : path + ": ";
  for (const std::string& word : app.remaining(true)) {
    if (word == "--") continue;
    if (word.starts_with("-")) {
      const std::string flag = word.substr(0, word.find('='));
      const std::vector<std::string> flags = FlagNames(*command);
      if (!path.empty() && std::ranges::count(flags, flag) > 0)
        return "'" + flag + "' stands after the command: airsim360 " + path + " " + flag;
      const std::string question = DidYouMean(flag, flags);
      return of + "unknown flag '" + flag + "'" + question + (question.empty() ? "; " : " ") + HelpHint(*command);
    }
    // A command of commands: the word is a wrong one.
    const auto inner = command->get_subcommands(Any);
    if (!inner.empty()) return of + UnknownChoiceMessage("command", word, NamesOf(inner));
    return of + "unexpected argument '" + word + "'";
  }
  return of + error.what() + (path.empty() ? "; 'airsim360 help' lists them" : "");
}

// Numbers have to be such, told by the value and what is wanted. No range holds NaN, and none refuses it: no comparison with it is
// true.
void CheckNumbers(CLI::App& command) {
  const CLI::Validator is_number(
      [](std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && !std::isnan(value) ? std::string() : "'" + text + "' is not a number";
      },
      "");
  const CLI::Validator is_whole(
      [](std::string& text) {
        int64_t value = 0;
        return CLI::detail::lexical_cast(text, value) ? std::string() : "'" + text + "' is not a whole number";
      },
      "");
  for (CLI::Option* option : command.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->check(is_number);
    if (option->get_type_name().starts_with("INT")) option->check(is_whole);
  }
  for (CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; })) CheckNumbers(*inner);
}

// `airsim360 help [COMMAND]`.
void AddHelpCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("help", "what the program or one of its commands does, with its flags");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *words, "one of those that 'airsim360 help' lists");
  command->callback([&app, words] {
    const CLI::App& asked = FindCommand(app, *words);
    const std::string path = CommandPath(asked), name = path.empty() ? "airsim360" : "airsim360 " + path;
    std::fputs(asked.get_formatter()->make_help(&asked, name, CLI::AppFormatMode::Normal).c_str(), stdout);
  });
}

}  // namespace

Program::Program(const CommandSet& commands) : app_("Panoramic (360 degree) simulator for drones", "airsim360") {
  app_.set_version_flag("-V,-v,--version", std::string("airsim360 ") + kVersion);
  app_.require_subcommand(1);
  for (const auto add : commands.commands) add(app_, globals_);
  for (CLI::App* command : app_.get_subcommands(Any)) {
    const auto nested = command->get_subcommands(Any);
    if (nested.empty()) AddGlobalFlags(*command, globals_, limit_);
    for (CLI::App* inner : nested) AddGlobalFlags(*inner, globals_, limit_);
  }
  for (const auto add : commands.own) add(app_);
  AddHelpCommand(app_);
  ArrangeHelp(app_);
  CheckNumbers(app_);
}

void Program::Run(int argc, const char* const* argv) {
  // A wrong command is told here, so that the message can name the nearest one.
  if (argc > 1 && argv[1][0] != '-') FindCommand(app_, {argv[1]});
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // --help, --version
    if (error.get_exit_code() == 0) {
      app_.exit(error);
      return;
    }
    // A misspelt flag may also be why a required one is missing: it is named first.
    throw InputError(UnknownArgumentMessage(app_, error));
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw RuntimeError("cannot write to stdout");
}

int Main(int argc, const char* const* argv, const CommandSet& commands) {
  // A file size limit or a closed pipe comes back as an error of the write, not as a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  // What is large lies in pages of its own, which go back when it goes: malloc would raise this limit to 32 MiB and keep holes.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  try {
    Program(commands).Run(argc, argv);
    return 0;
  } catch (const InputError& error) {
    return Fail(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return Fail(error.what(), kFailed);
  }
}

}  // namespace airsim360
