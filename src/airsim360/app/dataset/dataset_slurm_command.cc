// airsim360 dataset slurm: a script that has a cluster make a plan.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "airsim360/app/dataset/dataset_plan_command.h"
#include "airsim360/app/flags/arguments.h"
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

// Flags of one back end are refused with the others.
void CheckFlags(const CLI::App& command, ClusterBackend backend) {
  const auto of = [&](const char* flag, std::initializer_list<ClusterBackend> takers) {
    if (command.count(flag) == 0 || std::ranges::count(takers, backend) > 0) return;
    throw InputError(std::string(flag) + ": --backend " + kClusterBackendNames[static_cast<int>(backend)] + " has no use for it");
  };
  using enum ClusterBackend;
  for (const char* flag : {"--image", "--claim", "--secret"}) of(flag, {kKubernetes});
  of("--time-limit", {kSlurm});
  of("--memory", {kSlurm, kKubernetes});
}

// Kubernetes: what is not on the volume at /data is not there for a pod. A plan elsewhere travels in the manifest.
void PlaceInPods(const CLI::App& command, const SlurmArguments& arguments, const DatasetPlan& plan, ClusterJob& job) {
  constexpr size_t kMostText = 200'000;  // bytes: kubectl apply takes 256 KiB in all
  const auto on_volume = [](const std::string& path) { return path.starts_with("/data/"); };
  if (command.count("--program") == 0) job.program = "airsim360";
  if (arguments.shards.empty()) job.out = "/data/" + std::filesystem::path(arguments.plan).stem().string() + "_shards";
  if (!on_volume(job.out))
    throw InputError("--shards: '" + arguments.shards + "' is not on the volume of the pods, which is mounted at /data");
  if (command.count("--claim") == 0 && !job.remote.empty()) job.claim.clear();
  if (on_volume(job.plan)) return;
  job.plan_text = PlanJson(plan);
  if (job.plan_text.size() > kMostText)
    throw InputError(arguments.plan + ": a plan of " + std::to_string(job.plan_text.size()) +
                     " bytes is too large for a manifest; put it on the volume and give its path there, /data/…");
}

void RunSlurm(const SlurmArguments& arguments, const CLI::App& command, const GlobalOptions& globals) {
  const auto backend = ParseChoice<ClusterBackend>("backend", arguments.backend, kClusterBackendNames, "--backend");
  CheckFlags(command, backend);
  const DatasetPlan plan = ReadPlan(arguments.plan);
  ClusterJob job = arguments.job;
  job.name = plan.recipe.name;
  job.hash = plan.hash;
  job.plan = std::filesystem::absolute(arguments.plan).string();
  job.out = arguments.shards.empty() ? std::filesystem::absolute(arguments.plan).replace_extension("").string() + "_shards"
                                     : std::filesystem::absolute(arguments.shards).string();
  while (job.remote.ends_with('/')) job.remote.pop_back();
  if (command.count("--remote") > 0 && job.remote.find(':') == std::string::npos)
    throw InputError("--remote: '" + job.remote + "' is not REMOTE:PATH, as rclone names what it copies to; a folder is given by --shards");
  if (backend == ClusterBackend::kKubernetes) PlaceInPods(command, arguments, plan, job);
  for (const std::string& text : {job.program, job.plan, job.out, job.flags, job.time, job.image, job.claim, job.secret, job.remote}) {
    if (text.find_first_of("\n\r") != std::string::npos) throw InputError("dataset slurm: a path or flag holds a line feed");
  }
  const int64_t frames = static_cast<int64_t>(FramesOfShard(plan, 0, 1).size());
  if (job.shards > frames)
    throw InputError("--array: " + std::to_string(job.shards) + " shards are more than the " + std::to_string(frames) +
                     " frames that can be made");
  // Slurm does not make the folder of its logs.
  if (backend == ClusterBackend::kSlurm) CreateWritableFolder(job.out);
  WriteFileAtomically(arguments.out, ClusterScript(backend, job));
  if (globals.json) return PrintJson({{"out", arguments.out}, {"shards", job.shards}, {"folder", job.out}, {"backend", arguments.backend}});
  std::printf("%s: %lld shards in %s\n", arguments.out.c_str(), static_cast<long long>(job.shards),
              (job.remote.empty() ? job.out : job.remote).c_str());
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
  command->add_option("--shards", arguments->shards,
                      "folder of the shards, where the nodes find it (default: PLAN_shards beside the plan; kubernetes: in /data)");
  command->add_option("--remote", job.remote, "REMOTE:PATH of rclone: shards are copied there when done, and taken from there to merge");
  command->add_option("--backend", arguments->backend, "slurm, kubernetes (an Indexed Job) or xargs (this machine)");
  command->add_option("--at-once", job.at_once, "shards at the same time at most")->check(CLI::Range(int64_t{1}, int64_t{1'000'000}));
  command->add_option("--tries", job.tries, "of a shard (default 3)")->check(CLI::Range(int64_t{1}, int64_t{100}));
  command->add_option("--cpus", job.cpus, "of a shard (default 2)")->check(CLI::Range(1, 1024));
  command->add_option("--memory", job.memory_gib, "of a shard, GiB (default 8)")->check(CLI::Range(1, 4096));
  command->add_option("--time-limit", job.time, "of a shard, as Slurm writes it (default 24:00:00)");
  command->add_option("--program", job.program, "the program on the nodes (default: this one; kubernetes: airsim360)");
  command->add_option("--flags", job.flags, "further flags of dataset run, for example \"--tier high\"");
  command->add_option("--image", job.image, "kubernetes: container image (default airsim360:latest)");
  command->add_option("--claim", job.claim, "kubernetes: volume claim, mounted at /data (default airsim360; with --remote none)");
  command->add_option("--secret", job.secret,
                      "kubernetes: secret whose keys are environment variables of the shards, such as those of rclone");
  command->callback([arguments, command, &globals] { RunSlurm(*arguments, *command, globals); });
}

}  // namespace airsim360
