"""`dataset slurm --remote`: shards go to an object store by rclone (here a folder of this machine), SHA256SUMS last. Copying that
is cut off, a machine that is lost and a second run leave the bytes of one run. Skipped where rclone is not installed."""
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
name: store
picture: {size: 64x32, tier: labels}
rows:
  - {name: boxes, world: box_room, frames: 9, clearance: 0.5, highest: 5}
"""

# rclone that dies in the middle of copying a shard, as long as the file `broken` is there.
BREAKING = """#!/bin/sh
if [ -e "%s" ] && [ "$1" = copy ]; then
  rclone "$@" --include '/meta.json' --include '/range/**'
  kill -9 $PPID
fi
exec rclone "$@"
"""


class Remote(ProgramTest):
    def setUp(self):
        if not shutil.which("rclone"):
            self.skipTest("rclone is not installed: apt-get install rclone")
        super().setUp()
        (self.folder / "recipe.yaml").write_text(RECIPE)
        self.plan, self.store, self.shards = self.folder / "plan.json", self.folder / "the store", self.folder / "shards"
        self.run_ok("dataset", "plan", self.folder / "recipe.yaml", "--out", self.plan)
        self.run_ok("dataset", "run", self.plan, "--out", self.folder / "whole")

    def script(self, *flags, name="job.sh"):
        self.run_ok("dataset", "slurm", self.plan, "--backend", "xargs", "--cpus", "1", "--shards", self.shards, "--remote", f":local:{self.store}/", *flags,
                    "--out", self.folder / name)
        return self.folder / name

    def sh(self, script, *words, **variables):
        environment = {**os.environ, "RCLONE_CONFIG": str(self.folder / "none.conf"), **variables}
        return subprocess.run(["sh", str(script), *words], capture_output=True, text=True, env=environment, timeout=300)

    def whole_shards(self):
        return sorted(path.parent.name for path in self.store.glob("shard-*/SHA256SUMS"))

    def test_cut_off_and_lost_machines_leave_the_bytes_of_one_run(self):
        script = self.script("--array", "3")
        self.assertEqual(self.sh(script, "missing").stdout.strip(), "0-2")
        done = self.sh(script, "1")
        self.assertEqual((done.returncode, self.whole_shards()), (0, ["shard-000001"]), done.stderr)
        # The machine dies while it copies shard 0, and is never seen again.
        breaking, broken = self.folder / "breaking.sh", self.folder / "broken"
        breaking.write_text(BREAKING % broken)
        breaking.chmod(0o755)
        broken.touch()
        self.assertNotEqual(self.sh(script, "0", RCLONE=str(breaking)).returncode, 0)
        self.assertTrue((self.store / "shard-000000/meta.json").exists())
        self.assertEqual(self.whole_shards(), ["shard-000001"])
        self.assertEqual(self.sh(script, "missing").stdout.strip(), "0,2")
        shutil.rmtree(self.shards)
        broken.unlink()
        # Another one makes what is missing, and puts together what it has not made too.
        done = self.sh(script)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("shard-000001 is in", done.stdout)
        self.assertEqual(self.sh(script, "missing").stdout.strip(), "")
        self.assertEqual(tree(self.shards / "dataset"), tree(self.folder / "whole"))
        self.assertFalse((self.shards / "shard-000001").exists())

    def test_a_store_of_another_plan_or_number_of_shards_is_not_mixed_in(self):
        self.assertEqual(self.sh(self.script("--array", "3"), "0").returncode, 0)
        told = self.sh(self.script("--array", "4", name="four.sh"), "0")
        self.assertEqual(told.returncode, 1)
        self.assertIn("another number of shards", told.stderr)
        self.run_ok("dataset", "plan", self.folder / "recipe.yaml", "--seed", "2", "--out", self.plan)
        shutil.rmtree(self.shards)
        told = self.sh(self.script("--array", "3", name="other.sh"), "0")
        self.assertEqual(told.returncode, 1)
        self.assertIn("another plan", told.stderr)


if __name__ == "__main__":
    unittest.main()
