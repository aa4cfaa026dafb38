#!/usr/bin/python3
"""Kills `airsim360 dataset run` at random moments and compares what comes out in the end with a run that was left alone.

Usage: dataset_kills.py [--kills 50] [--seed 1] [--program build/bin/airsim360] [--recipe RECIPE.yaml] [--folder DIR]
Each round takes a number of shards (1, 2, 3, 5) and of processes (1, 2, 4), runs the shards in turn, and kills the first process or one
of its helpers with SIGKILL at a random moment of some of the runs. Then every shard is run to its end, merged and verified. Prints a line
a round; status 1 if one SHA256SUMS differs or a run fails for another reason.
"""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

RECIPE = """
name: kills
picture: {size: 256x128, tier: fast}
skies: [{name: two, frames: 6, choices: [{weather: day}, {weather: overcast}]}]
rows:
  - {name: boxes, world: box_room, frames: 24, skies: two, clearance: 0.5, highest: 5}
  - {name: sunny, world: sunlit_room, frames: 16, skies: two, clearance: 0.3, highest: 2.5}
"""


def helpers_of(pid):
    """Processes that a process has started."""
    try:
        return [int(word) for word in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


class Kills:
    def __init__(self, options, folder):
        self.program, self.folder = options.program, folder
        self.lot = random.Random(options.seed)
        self.plan = folder / "plan.json"
        recipe = options.recipe or folder / "recipe.yaml"
        if not options.recipe:
            recipe.write_text(RECIPE)
        self.run("dataset", "plan", recipe, "--seed", "3", "--out", self.plan)
        for _ in range(2):  # the second time with worlds and skies in the cache
            shutil.rmtree(folder / "whole", ignore_errors=True)
            start = time.monotonic()
            self.run("dataset", "run", self.plan, "--out", folder / "whole")
            self.seconds = time.monotonic() - start
        self.wanted = (folder / "whole" / "SHA256SUMS").read_bytes()
        self.kills = self.late = 0

    def run(self, *arguments):
        result = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"{' '.join(map(str, arguments))}: status {result.returncode}\n{result.stderr}")

    def command(self, out, shard, shards, processes):
        return ["dataset", "run", self.plan, "--shard", f"{shard}/{shards}", "--processes", processes, "--out", out]

    def kill(self, out, shard, shards, processes):
        """Kills one run of a shard while it is at work; one that was too fast is begun anew."""
        words = [self.program, *map(str, self.command(out, shard, shards, processes))]
        while True:
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            time.sleep(self.lot.uniform(0.02, self.seconds / shards))
            victim = self.lot.choice([process.pid] + helpers_of(process.pid))
            if process.poll() is None:
                os.kill(victim, signal.SIGKILL)
                break
            self.late += 1
            shutil.rmtree(out)
        _, errors = process.communicate()
        if victim != process.pid and process.returncode != 0:  # a helper that is killed is started again
            sys.exit(f"a killed helper ended the run: status {process.returncode}\n{errors}")
        self.kills += 1

    def round(self, kills):
        shards, processes = self.lot.choice([1, 2, 3, 5]), self.lot.choice([1, 2, 4])
        folders = [self.folder / f"shard-{i}" for i in range(shards)]
        hits = [0] * shards
        for _ in range(kills):
            hits[self.lot.randrange(shards)] += 1
        for shard, folder in enumerate(folders):
            for _ in range(hits[shard]):
                self.kill(folder, shard, shards, processes)
            self.run(*self.command(folder, shard, shards, processes))
        self.run("dataset", "merge", *folders, "--out", self.folder / "merged")
        self.run("verify", self.folder / "merged")
        same = (self.folder / "merged" / "SHA256SUMS").read_bytes() == self.wanted
        print(f"{shards} shards, {processes} processes, {kills} kills: {'the same' if same else 'OTHER BYTES'}", flush=True)
        for folder in [*folders, self.folder / "merged"]:
            shutil.rmtree(folder)
        return same


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parents[1] / "build/bin/airsim360"))
    parser.add_argument("--recipe", type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        kills = Kills(options, pathlib.Path(folder))
        good = True
        while kills.kills < options.kills:
            good &= kills.round(min(5, options.kills - kills.kills))
        print(f"{kills.kills} runs killed at work; {kills.late} more were done before their moment came; a run takes {kills.seconds:.1f} s")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
