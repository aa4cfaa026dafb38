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

// The lines of a literal block of YAML.
std::string YamlBlock(const std::string& lines, size_t indent) {
  std::string text;
  for (size_t begin = 0; begin < lines.size();) {
    const size_t end = std::min(lines.find('\n', begin), lines.size());
    if (!text.empty()) text += '\n';
    if (end > begin) text += std::string(indent, ' ') + lines.substr(begin, end - begin);
    begin = end + 1;
  }
  return text;
}

// Letters, digits and '-', as clusters name jobs: with a hash and the index of a pod 63 in all.
std::string JobName(const std::string& name) {
  std::string text;
  for (const char c : name.substr(0, 40))
    text += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '-';
  while (!text.empty() && text.front() == '-') text.erase(0, 1);
  while (!text.empty() && text.back() == '-') text.pop_back();
  return text.empty() ? "dataset" : text;
}

// Replaces every @NAME@.
std::string Filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string mark = "@" + name + "@";
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

// What the scripts of all back ends do with a shard.
constexpr char kShard[] = R"~(PROGRAM=@PROGRAM@ PLAN=@PLAN@ OUT=@OUT@ SHARDS=@SHARDS@ TRIES=@TRIES@
# Makes shard $1; where it was begun it goes on.
make_shard() {
  "$PROGRAM" dataset run "$PLAN" --shard "$1/$SHARDS" --out "$OUT/shard-$(printf %06d "$1")" --threads @CPUS@@FLAGS@
}
missing() { "$PROGRAM" dataset status "$PLAN" "$OUT"/shard-* --array "$SHARDS"; }
merge() { "$PROGRAM" dataset merge "$OUT"/shard-* --out "$OUT/dataset"; }
)~";

// The same with an object store. What is there without SHA256SUMS was interrupted.
constexpr char kRemoteShard[] = R"~(PROGRAM=@PROGRAM@ PLAN=@PLAN@ OUT=@OUT@ SHARDS=@SHARDS@ TRIES=@TRIES@
REMOTE=@REMOTE@ RCLONE=${RCLONE:-rclone}
# Makes shard $1 and copies it to $REMOTE, SHA256SUMS last: a shard that has it there is whole, and is not made again.
make_shard() {
  name=shard-$(printf %06d "$1")
  if [ -n "$("$RCLONE" lsf "$REMOTE/$name/SHA256SUMS" 2>/dev/null)" ]; then
    meta=$("$RCLONE" cat "$REMOTE/$name/meta.json") || return 1
    case $meta in *'"shards": @SHARDS@'[!0-9]*) ;; *) echo "$REMOTE/$name is of another number of shards" >&2; return 2 ;; esac
    case $meta in *'"plan": "@FULL_HASH@"'*) echo "$name is in $REMOTE"; return 0 ;; esac
    echo "$REMOTE/$name is of another plan" >&2
    return 2
  fi
  "$PROGRAM" dataset run "$PLAN" --shard "$1/$SHARDS" --out "$OUT/$name" --threads @CPUS@@FLAGS@ || return
  "$RCLONE" copy "$OUT/$name" "$REMOTE/$name" --exclude /SHA256SUMS || return 1
  "$RCLONE" copyto "$OUT/$name/SHA256SUMS" "$REMOTE/$name/SHA256SUMS" || return 1
}
# What describes the shards that are in $REMOTE; 3: nothing is there yet.
list_remote() {
  "$RCLONE" sync "$REMOTE" "$OUT/list" --include '/shard-*/meta.json' --include '/shard-*/SHA256SUMS' || [ $? -eq 3 ]
}
missing() { mkdir -p "$OUT/list" && list_remote && "$PROGRAM" dataset status "$PLAN" "$OUT"/list/shard-* --array "$SHARDS"; }
merge() {
  "$RCLONE" sync "$REMOTE" "$OUT/remote" --include '/shard-*/**' && "$PROGRAM" dataset merge "$OUT"/remote/shard-* --out "$OUT/dataset"
}
)~";

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
@SHARD@
case "${1:-}" in
  missing) missing; exit ;;
  retry) list=$(missing) || exit; [ -z "$list" ] && { echo "nothing is missing"; exit 0; }; exec sbatch --array="$list@AT_ONCE@" "$0" ;;
  merge) merge; exit ;;
esac
shard=$SLURM_ARRAY_TASK_ID
# A killed node: slurmctld queues the task again, which goes on where it was. A failure: the task queues itself again.
echo "shard $shard/$SHARDS on ${SLURMD_NODENAME:-?}, start ${SLURM_RESTART_COUNT:-0}"
make_shard "$shard"
status=$?
# 2: the plan, the world or the folder is wrong; another try would not help.
if [ $status -ne 0 ] && [ $status -ne 2 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt $((TRIES - 1)) ]; then
  echo "shard $shard failed with status $status; once more"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${shard}"
fi
exit $status
)~";

constexpr char kKubernetes[] = R"~(# Dataset @NAME@, plan @HASH@: @SHARDS@ shards, one an index.
#   kubectl apply -f FILE    a failed index is tried @TRIES@ times
#   @MERGE@
@CONFIG_MAP@apiVersion: batch/v1
kind: Job
metadata:
  name: @NAME@-@SHORT@
spec:
  completionMode: Indexed
  completions: @SHARDS@
  parallelism: @PARALLEL@
  backoffLimitPerIndex: @RETRIES@
  maxFailedIndexes: @MOST_FAILED@
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
            - |
@SHARD_BLOCK@
              make_shard "$JOB_COMPLETION_INDEX"
          resources:
            requests: {cpu: "@CPUS@", memory: "@MEMORY@Gi"}
            limits: {memory: "@MEMORY@Gi"}
@SECRET@          volumeMounts:
            - {name: data, mountPath: /data}
@PLAN_MOUNT@      volumes:
        - name: data
          @DATA@
@PLAN_VOLUME@)~";

constexpr char kXargs[] = R"~(#!/bin/sh
# Dataset @NAME@, plan @HASH@: @SHARDS@ shards on this machine, @PARALLEL@ at once. Run again it goes on where it was.
#   sh FILE            makes all shards and puts them together in $OUT/dataset
#   sh FILE missing    names the shards that are not done; `sh FILE merge` puts them together
set -u
@SHARD@
case "${1:-}" in
  missing) missing; exit ;;
  merge) merge; exit ;;
  [0-9]*)
    for try in $(seq "$TRIES"); do
      make_shard "$1" && exit 0
      [ $? -eq 2 ] && exit 1
    done
    exit 1 ;;
esac
seq 0 @LAST@ | xargs -P @PARALLEL@ -n 1 sh "$0" || exit 1
merge
)~";

constexpr char kConfigMap[] = R"~(apiVersion: v1
kind: ConfigMap
metadata:
  name: @NAME@-@SHORT@
data:
  plan.json: |
@PLAN_BLOCK@
---
)~";

// Where the plan travels with the manifest: what stands at the places above.
struct PlanParts {
  std::string path, config_map, mount, volume;
};
PlanParts PartsOf(const ClusterJob& job) {
  if (job.plan_text.empty()) return {job.plan, "", "", ""};
  return {"/plan/plan.json", kConfigMap, "            - {name: plan, mountPath: /plan}\n",
          "        - name: plan\n          configMap: {name: @NAME@-@SHORT@}\n"};
}

// How many pods run at once, or may fail: Kubernetes allows no more in an Indexed Job.
int64_t MostPods(int64_t shards) { return shards > 100'000 ? 10'000 : 100'000; }

}  // namespace

std::string ClusterScript(ClusterBackend backend, const ClusterJob& job) {
  const bool kubernetes = backend == ClusterBackend::kKubernetes;
  const int64_t wanted = job.at_once > 0 ? job.at_once : backend == ClusterBackend::kXargs ? 1 : job.shards;
  const int64_t parallel = kubernetes ? std::min(wanted, MostPods(job.shards)) : wanted;
  const PlanParts plan = PartsOf(job);
  const std::vector<std::pair<std::string, std::string>> of_shards = {
      {"SHARDS", std::to_string(job.shards)},
      {"CPUS", std::to_string(job.cpus)},
      {"TRIES", std::to_string(job.tries)},
      {"FULL_HASH", job.hash},
      {"FLAGS", job.flags.empty() ? "" : " " + job.flags},
      {"REMOTE", Quoted(job.remote)},
      {"PROGRAM", Quoted(job.program)},
      {"PLAN", Quoted(plan.path)},
      {"OUT", Quoted(job.out)},
  };
  const std::string shard = Filled(job.remote.empty() ? kShard : kRemoteShard, of_shards);
  const std::string merge =
      job.remote.empty()
          ? "airsim360 dataset merge " + job.out + "/shard-* --out DATASET    puts the shards together"
          : "rclone sync " + job.remote + " SHARDS && airsim360 dataset merge SHARDS/shard-* --out DATASET    puts them together";
  const std::vector<std::pair<std::string, std::string>> values = {
      {"CONFIG_MAP", plan.config_map},
      {"PLAN_MOUNT", plan.mount},
      {"PLAN_VOLUME", plan.volume},
      {"DATA", job.claim.empty() ? "emptyDir: {}" : "persistentVolumeClaim: {claimName: " + YamlString(job.claim) + "}"},
      {"SECRET", job.secret.empty() ? "" : "          envFrom:\n            - secretRef: {name: " + YamlString(job.secret) + "}\n"},
      {"NAME", JobName(job.name)},
      {"HASH", job.hash.substr(0, 16)},
      {"SHORT", job.hash.substr(0, 8)},
      {"SHARDS", std::to_string(job.shards)},
      {"LAST", std::to_string(job.shards - 1)},
      {"AT_ONCE", job.at_once > 0 ? "%" + std::to_string(job.at_once) : ""},
      {"PARALLEL", std::to_string(parallel)},
      {"MOST_FAILED", std::to_string(std::min(job.shards, MostPods(job.shards)))},
      {"CPUS", std::to_string(job.cpus)},
      {"MEMORY", std::to_string(job.memory_gib)},
      {"TIME", job.time},
      {"TRIES", std::to_string(job.tries)},
      {"RETRIES", std::to_string(job.tries - 1)},
      {"SELF", "job.sh"},
      {"LOG", job.out},
      {"IMAGE", YamlString(job.image)},
      {"MERGE", merge},
      // Last, as they hold what users wrote.
      {"SHARD_BLOCK", YamlBlock("set -u\n" + shard, 14)},
      {"SHARD", shard.substr(0, shard.size() - 1)},
      {"PLAN_BLOCK", YamlBlock(job.plan_text, 4)},
  };
  const char* texts[] = {kSlurm, kKubernetes, kXargs};
  return Filled(texts[static_cast<int>(backend)], values);
}

}  // namespace airsim360
