// `collect` in several processes: one that knows what is missing, and others that render it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/dataset/collector.h"

namespace airsim360 {

/// Flags of collect, one of them for its own use.
struct ProcessArguments {
  int processes = 0;   ///< 0: not given
  std::string worker;  ///< --worker K/N: this is process K of N; it reads the frames to make from stdin

  void AddTo(CLI::App& command);
  bool is_worker() const { return !worker.empty(); }
};

/// How many processes to use: --processes, else as many as --gpu names GPUs. InputError naming the flag.
int CountProcesses(const ProcessArguments& arguments, const GlobalOptions& globals);

/// In a worker: takes its GPU and its share of the cores out of `globals`, and ends it when its parent dies.
void BecomeWorker(const ProcessArguments& arguments, GlobalOptions& globals);

/// Writes frames and tells `done` of each.
using WriteFramesHere = std::function<CollectResult(std::span<const int64_t> frames, const std::function<void(int64_t frame)>& done)>;
/// In a worker: writes what it is told to and reports on stdout.
void RunWorker(const WriteFramesHere& write);

/// How frames are dealt out among processes: one to each in turn, or to each those that follow one another.
enum class Dealing { kInTurn, kRuns };
/// In the parent: has `processes` copies of this program with the same arguments render. A
/// process that is killed is started again for what it left. RuntimeError if one fails, or dies again and again.
RenderElsewhere RenderInProcesses(int processes, Dealing dealing = Dealing::kInTurn);

}  // namespace airsim360
