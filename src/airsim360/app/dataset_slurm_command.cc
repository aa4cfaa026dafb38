// airsim360 dataset slurm: a script that has a cluster make a plan.
#include <cstdio>
#include <memory>

#include "airsim360/app/arguments.h"
#include "airsim360/app/dataset_plan_command.h"
#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/plan/cluster_jobs.h"

namespace airsim360 {
namespace {

struct SlurmArguments {
  std::string plan, out, shards, backend = "slurm";
  ClusterJob job;
};

void RunSlurm(const SlurmArguments& arguments, const GlobalOptions& globals) {
  const auto backend = ParseChoice<ClusterBackend>("backend", arguments.backend, kClusterBackendNames, "--backend");
  const DatasetPlan plan = ReadPlan(arguments.plan);
  ClusterJob job = arguments.job;
  job.name = plan.recipe.name;
  job.hash = plan.hash;
  job.plan = std::filesystem::absolute(arguments.plan).string();
  job.out = arguments.shards.empty() ? std::filesystem::absolute(arguments.plan).replace_extension("").string() + "_shards"
                                     : std::filesystem::absolute(arguments.shards).string();
  for (const std::string& text : {job.program, job.plan, job.out, job.flags, job.time, job.image, job.claim}) {
    if (text.find_first_of("\n\r") != std::string::npos) throw InputError("dataset slurm: a path or flag holds a line feed");
  }
  const int64_t frames = static_cast<int64_t>(FramesOfShard(plan, 0, 1).size());
  if (job.shards > frames)
    throw InputError("--array: " + std::to_string(job.shards) + " shards are more than the " + std::to_string(frames) + " frames that can be made");
  // Slurm does not make the folder of its logs.
  if (backend == ClusterBackend::kSlurm) CreateWritableFolder(job.out);
  WriteFileAtomically(arguments.out, ClusterScript(backend, job));
  if (globals.json) return PrintJson({{"out", arguments.out}, {"shards", job.shards}, {"folder", job.out}, {"backend", arguments.backend}});
  std::printf("%s: %lld shards in %s\n", arguments.out.c_str(), static_cast<long long>(job.shards), job.out.c_str());
}

}  // namespace

void AddDatasetSlurm(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("slurm", "a script that has a cluster make the shards of a plan");
  auto arguments = std::make_shared<SlurmArguments>();
  ClusterJob& job = arguments->job;
  job.program = std::filesystem::read_symlink("/proc/self/exe").string();
  job.image = "airsim360:latest";
  job.claim = "airsim360";
  command->add_option("PLAN", arguments->plan, "file of airsim360 dataset plan, where the nodes find it")->required();
  command->add_option("--array", job.shards, "shards")->required()->check(CLI::Range(int64_t{1}, int64_t{1'000'000}));
  command->add_option("--out", arguments->out, "the script")->required();
  command->add_option("--shards", arguments->shards, "folder of the shards, where the nodes find it (default: PLAN_shards beside the plan)");
  command->add_option("--backend", arguments->backend, "slurm, kubernetes (an Indexed Job) or xargs (this machine)");
  command->add_option("--at-once", job.at_once, "shards at the same time at most")->check(CLI::Range(int64_t{1}, int64_t{1'000'000}));
  command->add_option("--tries", job.tries, "of a shard (default 3)")->check(CLI::Range(int64_t{1}, int64_t{100}));
  command->add_option("--cpus", job.cpus, "of a shard (default 2)")->check(CLI::Range(1, 1024));
  command->add_option("--memory", job.memory_gib, "of a shard, GiB (default 8)")->check(CLI::Range(1, 4096));
  command->add_option("--time-limit", job.time, "of a shard, as Slurm writes it (default 24:00:00)");
  command->add_option("--program", job.program, "the program on the nodes (default: this one)");
  command->add_option("--flags", job.flags, "further flags of dataset run, for example \"--tier high\"");
  command->add_option("--image", job.image, "kubernetes: container image (default airsim360:latest)");
  command->add_option("--claim", job.claim, "kubernetes: volume claim, mounted at /data (default airsim360)");
  command->callback([arguments, &globals] { RunSlurm(*arguments, globals); });
}

}  // namespace airsim360
