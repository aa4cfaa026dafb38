// Scripts that have a cluster make the shards of a plan.
#pragma once

#include <cstdint>
#include <string>

namespace airsim360 {

enum class ClusterBackend { kSlurm, kKubernetes, kXargs };
inline constexpr const char* kClusterBackendNames[] = {"slurm", "kubernetes", "xargs"};

struct ClusterJob {
  std::string name;       ///< of the dataset
  std::string hash;       ///< of the plan
  std::string program;    ///< how the program is called on the nodes
  std::string plan, out;  ///< paths on the nodes: the plan, and the folder of the shards
  std::string flags;      ///< further flags of `dataset run`, as a shell reads them
  std::string time = "24:00:00";
  int64_t shards = 1;
  int64_t at_once = 0;  ///< at most; 0 = as many as the cluster runs
  int64_t tries = 3;    ///< of a shard
  int cpus = 2;
  int memory_gib = 8;
  std::string remote;     ///< REMOTE:PATH of rclone, where shards are copied when they are done; empty: they stay in `out`
  std::string image;      ///< of Kubernetes: the container
  std::string claim;      ///< of Kubernetes: the persistent volume claim, mounted at /data; empty: a folder of the pod's own
  std::string secret;     ///< of Kubernetes: its keys become environment variables; empty: none
  std::string plan_text;  ///< of Kubernetes: the plan, which the manifest carries then; empty: it is at `plan`
};

/// slurm: an sbatch array; a shard that fails is queued again, one that is done is skipped; `bash job.sh missing` names what is
/// missing, `bash job.sh merge` puts the shards together. kubernetes: an Indexed Job (batch/v1). xargs: a shell script that
/// runs the shards on this machine. Every one can be run again until nothing is missing. With `remote` a shard is done once
/// its SHA256SUMS, the last file copied, is there; rclone is a process of its own on the nodes.
std::string ClusterScript(ClusterBackend backend, const ClusterJob& job);

}  // namespace airsim360
