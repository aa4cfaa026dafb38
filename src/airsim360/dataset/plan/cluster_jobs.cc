#include "airsim360/dataset/plan/cluster_jobs.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace airsim360 {
namespace {

// A word as a POSIX shell reads it back.
std::string Quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// A string as YAML and JSON read it back.
std::string YamlString(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return text + "\"";
}

// Letters, digits and '-', as clusters name jobs.
std::string JobName(const std::string& name) {
  std::string text;
  for (const char c : name.substr(0, 50)) text += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '-';
  while (!text.empty() && text.front() == '-') text.erase(0, 1);
  while (!text.empty() && text.back() == '-') text.pop_back();
  return text.empty() ? "dataset" : text;
}

// Replaces every @NAME@.
std::string Filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string mark = "@" + name + "@";
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size())) text.replace(at, mark.size(), value);
  }
  return text;
}

constexpr char kSlurm[] = R"~(#!/bin/bash
# Dataset @NAME@, plan @HASH@: @SHARDS@ shards.
#   sbatch @SELF@          makes all shards; run again it skips what is done
#   bash @SELF@ missing    names the shards that are not done; `bash @SELF@ retry` submits those alone
#   bash @SELF@ merge      puts the shards together in $OUT/dataset
#SBATCH --job-name=@NAME@
#SBATCH --array=0-@LAST@@AT_ONCE@
#SBATCH --cpus-per-task=@CPUS@
#SBATCH --mem=@MEMORY@G
#SBATCH --time=@TIME@
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=@LOG@/%a.log
set -u
PROGRAM=@PROGRAM@ PLAN=@PLAN@ OUT=@OUT@ SHARDS=@SHARDS@ TRIES=@TRIES@
missing() { "$PROGRAM" dataset status "$PLAN" "$OUT"/shard-* --array "$SHARDS"; }
case "${1:-}" in
  missing) missing; exit ;;
  retry) list=$(missing) || exit; [ -z "$list" ] && { echo "nothing is missing"; exit 0; }; exec sbatch --array="$list@AT_ONCE@" "$0" ;;
  merge) exec "$PROGRAM" dataset merge "$OUT"/shard-* --out "$OUT/dataset" ;;
esac
shard=$SLURM_ARRAY_TASK_ID
# A killed node: slurmctld queues the task again, which goes on where it was. A failure: the task queues itself again.
echo "shard $shard/$SHARDS on ${SLURMD_NODENAME:-?}, start ${SLURM_RESTART_COUNT:-0}"
"$PROGRAM" dataset run "$PLAN" --shard "$shard/$SHARDS" --out "$OUT/shard-$(printf %06d "$shard")" --threads @CPUS@@FLAGS@
status=$?
# 2: the plan, the world or the folder is wrong; another try would not help.
if [ $status -ne 0 ] && [ $status -ne 2 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt $((TRIES - 1)) ]; then
  echo "shard $shard failed with status $status; once more"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${shard}"
fi
exit $status
)~";

constexpr char kKubernetes[] = R"~(# Dataset @NAME@, plan @HASH@: @SHARDS@ shards, one an index.
#   kubectl apply -f FILE; a failed index is tried @TRIES@ times. Then `airsim360 dataset merge @OUT_PLAIN@/shard-*`.
apiVersion: batch/v1
kind: Job
metadata:
  name: @NAME@-@SHORT@
spec:
  completionMode: Indexed
  completions: @SHARDS@
  parallelism: @PARALLEL@
  backoffLimitPerIndex: @RETRIES@
  maxFailedIndexes: @SHARDS@
  podFailurePolicy:
    rules:
      - action: FailIndex
        onExitCodes:
          containerName: shard
          operator: In
          values: [2]
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: shard
          image: @IMAGE@
          command: ["/bin/sh", "-c"]
          args:
            - @COMMAND@
          resources:
            requests: {cpu: "@CPUS@", memory: "@MEMORY@Gi"}
            limits: {memory: "@MEMORY@Gi"}
          volumeMounts:
            - {name: data, mountPath: /data}
      volumes:
        - name: data
          persistentVolumeClaim: {claimName: @CLAIM@}
)~";

constexpr char kXargs[] = R"~(#!/bin/sh
# Dataset @NAME@, plan @HASH@: @SHARDS@ shards on this machine, @PARALLEL@ at once. Run again it goes on where it was.
set -u
seq 0 @LAST@ | xargs -P @PARALLEL@ -I SHARD sh -c '
  dir=$3/shard-$(printf %06d "$4")
  for try in $(seq @TRIES@); do
    "$1" dataset run "$2" --shard "$4/@SHARDS@" --out "$dir" --threads @CPUS@@FLAGS_INNER@ && exit 0
    [ $? -eq 2 ] && exit 1
  done
  exit 1' sh @PROGRAM@ @PLAN@ @OUT@ SHARD || exit 1
exec @PROGRAM@ dataset merge @OUT@/shard-* --out @OUT@/dataset
)~";

}  // namespace

std::string ClusterScript(ClusterBackend backend, const ClusterJob& job) {
  const std::string flags = job.flags.empty() ? "" : " " + job.flags;
  std::string inner;
  for (const char c : flags) inner += c == '\'' ? std::string("'\\''") : std::string(1, c);
  const std::string command = Quoted(job.program) + " dataset run " + Quoted(job.plan) + " --shard \"$JOB_COMPLETION_INDEX/" + std::to_string(job.shards) +
                              "\" --out " + Quoted(job.out) + "/shard-$(printf %06d \"$JOB_COMPLETION_INDEX\") --threads " + std::to_string(job.cpus) + flags;
  const int64_t parallel = job.at_once > 0 ? job.at_once : backend == ClusterBackend::kXargs ? 1 : job.shards;
  const std::vector<std::pair<std::string, std::string>> values = {
      {"NAME", JobName(job.name)},
      {"HASH", job.hash.substr(0, 16)},
      {"SHORT", job.hash.substr(0, 8)},
      {"SHARDS", std::to_string(job.shards)},
      {"LAST", std::to_string(job.shards - 1)},
      {"AT_ONCE", job.at_once > 0 ? "%" + std::to_string(job.at_once) : ""},
      {"PARALLEL", std::to_string(parallel)},
      {"CPUS", std::to_string(job.cpus)},
      {"MEMORY", std::to_string(job.memory_gib)},
      {"TIME", job.time},
      {"TRIES", std::to_string(job.tries)},
      {"RETRIES", std::to_string(job.tries - 1)},
      {"SELF", "job.sh"},
      {"LOG", job.out},
      {"IMAGE", YamlString(job.image)},
      {"CLAIM", YamlString(job.claim)},
      {"COMMAND", YamlString(command)},
      {"OUT_PLAIN", job.out},
      {"FLAGS_INNER", inner},
      {"FLAGS", flags},
      {"PROGRAM", Quoted(job.program)},
      {"PLAN", Quoted(job.plan)},
      {"OUT", Quoted(job.out)},
  };
  const char* texts[] = {kSlurm, kKubernetes, kXargs};
  return Filled(texts[static_cast<int>(backend)], values);
}

}  // namespace airsim360
