"""omni360-mini is what the docs say: its plan and one frame of each world here, all of its files with AIRSIM360_SLOW=1."""
import hashlib
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import unittest.mock

from program import PROGRAM, ProgramTest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/guide/dataset_plans.md"


class ReferenceRelease(ProgramTest):
    def test_its_plan_and_frames_have_the_hashes_of_the_docs(self):
        text = PAGE.read_text()
        section = text[text.index("## The reference release"):].split("\n## ", 1)[0]
        documented = dict(re.findall(r"\| ([^|]+?) \| `([0-9a-f]{64})` \|", section))
        own = tempfile.TemporaryDirectory(prefix="airsim360_mini_cache_")
        self.addCleanup(own.cleanup)
        self.enterContext(unittest.mock.patch.dict(os.environ, AIRSIM360_CACHE=os.environ.get("AIRSIM360_CACHE") or own.name))
        plan = self.folder / "plan.json"
        self.run_ok("dataset", "plan", "omni360-mini", "--out", plan)
        made = json.loads(plan.read_text())
        self.assertEqual(made["hash"], documented.pop("the plan"))
        manifest = documented.pop("`SHA256SUMS`")
        processor = pathlib.Path("/proc/cpuinfo").read_text()
        if not ("GenuineIntel" in processor and "avx512f" in processor):
            self.skipTest("the hashes of frames are of Intel's processors with AVX-512: Embree's hits differ in their last bits on others")
        worlds = set()
        for name, digest in documented.items():
            frame = int(re.fullmatch(r"`frames.jsonl` of `--shard (\d+)/200`", name)[1])
            shard = self.folder / f"shard{frame}"
            self.run_ok("dataset", "run", plan, "--shard", f"{frame}/200", "--device", "cpu", "--out", shard)
            line = (shard / "frames.jsonl").read_bytes()
            worlds.add(json.loads(line)["world"])
            self.assertEqual(hashlib.sha256(line).hexdigest(), digest, line.decode())
        self.assertEqual(worlds, {row["world"] for row in made["recipe"]["rows"]})
        if os.environ.get("AIRSIM360_SLOW"):
            subprocess.run([PROGRAM, "dataset", "run", plan, "--device", "cpu", "--out", self.folder / "mini"], check=True)
            self.assertEqual(hashlib.sha256((self.folder / "mini/SHA256SUMS").read_bytes()).hexdigest(), manifest)


if __name__ == "__main__":
    unittest.main()
