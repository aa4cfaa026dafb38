// The commands of the program: one file each, registered here.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace airsim360 {

/// Flags that every command takes; program.cc adds them to each command and applies --threads and --device.
struct GlobalOptions {
  bool json = false;            ///< machine-readable result on stdout
  uint64_t seed = 0;            ///< of the world, the route and everything random
  int threads = 0;              ///< 0 = all cores
  std::string device = "auto";  ///< auto, cpu or vulkan
  int gpu = -1;                 ///< index of a GPU; -1 = the best
  std::vector<int> gpus;        ///< of `collect --gpu 0,1` or all: several, then `gpu` is the first
  std::string bbox, centre;     ///< of maps: the piece that is opened; empty = all
  double radius = 0;            ///< with `centre`
  std::string labels;           ///< label file of commands that open a world; empty = the world's own labels
};

/// Each adds one subcommand to `app`. The command runs in its callback, after all flags are parsed; `globals`
/// outlives it. It throws InputError (exit status 2) or RuntimeError (exit status 1).
void AddWorldsCommand(CLI::App& app, GlobalOptions& globals);
void AddWorldCommand(CLI::App& app, GlobalOptions& globals);
void AddRenderCommand(CLI::App& app, GlobalOptions& globals);
void AddCollectCommand(CLI::App& app, GlobalOptions& globals);
void AddPlanCommand(CLI::App& app, GlobalOptions& globals);
void AddVerifyCommand(CLI::App& app, GlobalOptions& globals);
void AddStitchCommand(CLI::App& app, GlobalOptions& globals);
void AddEvalCommand(CLI::App& app, GlobalOptions& globals);
void AddMpdeCommand(CLI::App& app, GlobalOptions& globals);
void AddFlyCommand(CLI::App& app, GlobalOptions& globals);
void AddServeCommand(CLI::App& app, GlobalOptions& globals);
void AddAgentCommand(CLI::App& app, GlobalOptions& globals);
void AddVlnCommand(CLI::App& app, GlobalOptions& globals);
void AddLanguageCommand(CLI::App& app, GlobalOptions& globals);
void AddViewCommand(CLI::App& app, GlobalOptions& globals);
void AddPeopleCommand(CLI::App& app, GlobalOptions& globals);
void AddTrafficCommand(CLI::App& app, GlobalOptions& globals);
void AddDroneCommand(CLI::App& app, GlobalOptions& globals);
void AddVideoCommand(CLI::App& app, GlobalOptions& globals);
void AddEnvironmentsCommand(CLI::App& app, GlobalOptions& globals);
void AddDatasetCommand(CLI::App& app, GlobalOptions& globals);
void AddBenchCommand(CLI::App& app, GlobalOptions& globals);
void AddDoctorCommand(CLI::App& app, GlobalOptions& globals);
/// Its flags are those of python/airsim360/learn.
void AddLearnCommand(CLI::App& app);
/// About the program itself, which read no world: `app` with all its commands, once they are there.
void AddCompletionCommand(CLI::App& app);
void AddManCommand(CLI::App& app);

}  // namespace airsim360
