"""`dataset slurm` on a real Slurm of two nodes on this machine: an array of twelve shards, a node that dies and comes back, a
shard that fails once; merged, the bytes of one run. Skipped where Slurm and munge are not installed or this is not root."""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "end_to_end"))
from program import ProgramTest, tree  # noqa: E402

RECIPE = """
name: cluster
picture: {size: 1024x512, tier: fast}
rows:
  - {name: boxes, world: box_room, frames: 96, clearance: 0.5, highest: 5}
"""

# What a user would do, and what may go wrong.
SCENARIO = """
set -u
cd "$1"
flock shards/shard-000003 sleep 8 &      # shard 3 fails at first: another process writes there
job=$(sbatch --parsable job.sh) || exit 1
echo "job $job"
for _ in $(seq 300); do                  # until the second node works
  [ -n "$(squeue -h -w n2 -t R -o %i)" ] && [ "$(ls shards | grep -c 'shard.*')" -gt 5 ] && break; sleep 0.1
done
echo "on n2: $(squeue -h -w n2 -t R -o %i | tr '\\n' ' ')"
slurmd=$(cat /run/slurmd.n2.pid)
victims=$(ps -eo pid,args | awk '/slurmstepd: \\[/ && !/awk/ {print $1}')
for pid in $victims; do
  grep -z -q SLURMD_NODENAME=n2 /proc/$(pgrep -P $pid | head -1)/environ 2>/dev/null && kill -9 $pid $(pgrep -P $pid)
done
kill -9 $slurmd
for pid in $(pgrep -x airsim360); do grep -z -q SLURMD_NODENAME=n2 /proc/$pid/environ && kill -9 $pid; done
scontrol update nodename=n2 state=down reason=killed
sleep 2
squeue -o '%i %T %r'
slurmd -N n2; sleep 1; scontrol update nodename=n2 state=resume
for _ in $(seq 1200); do [ -z "$(squeue -h)" ] && break; sleep 0.25; done
[ -z "$(squeue -h)" ] || { echo "still queued"; squeue; exit 1; }
echo "missing: '$(bash job.sh missing)'"
[ -z "$(bash job.sh missing)" ] || exit 1
[ "$(bash job.sh retry)" = "nothing is missing" ] || exit 1
bash job.sh merge || exit 1
"""


class Slurm(ProgramTest):
    def setUp(self):
        if os.geteuid() != 0:
            self.skipTest("it makes name spaces: run it as root")
        for program in ("slurmctld", "slurmd", "munged", "sbatch", "unshare"):
            if not shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin"):
                self.skipTest(f"{program} is not installed: apt-get install slurm-wlm munge")
        if subprocess.run(["unshare", "-mnpf", "--uts", "true"], capture_output=True).returncode != 0:
            self.skipTest("this machine allows no name spaces")
        super().setUp()

    def test_an_array_survives_a_killed_node_and_a_failed_shard(self):
        (self.folder / "recipe.yaml").write_text(RECIPE)
        plan, shards = self.folder / "plan.json", self.folder / "shards"
        self.run_ok("dataset", "plan", self.folder / "recipe.yaml", "--out", plan)
        self.run_ok("dataset", "run", plan, "--out", self.folder / "whole")
        (shards / "shard-000003").mkdir(parents=True)
        self.run_ok("dataset", "slurm", plan, "--array", "12", "--cpus", "1", "--memory", "1", "--shards", shards, "--out", self.folder / "job.sh")
        (self.folder / "scenario.sh").write_text(SCENARIO)
        result = subprocess.run(["unshare", "-mnpf", "--uts", "bash", str(HERE / "cluster.sh"), str(self.folder), "bash",
                                 str(self.folder / "scenario.sh"), str(self.folder)], capture_output=True, text=True, timeout=500)
        logs = {path.name: path.read_text() for path in shards.glob("*.log")}
        told = result.stdout + result.stderr
        self.assertEqual(result.returncode, 0, told + str(logs))
        self.assertEqual(len(logs), 12)
        self.assertRegex(result.stdout, r"on n2: \S+")
        self.assertTrue(any("start 1" in text for text in logs.values()), "some task was queued again\n" + told + str(logs))
        self.assertIn("another airsim360 is writing here", logs["3.log"])
        self.assertIn("once more", logs["3.log"])
        self.assertEqual(tree(shards / "dataset"), tree(self.folder / "whole"))


if __name__ == "__main__":
    unittest.main()
