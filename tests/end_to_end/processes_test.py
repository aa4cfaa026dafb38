"""`collect --processes`: the bytes of one process, whatever happens to the others."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from program import PROGRAM, ProgramTest, run, tree

ARGUMENTS = ["collect", "--world", "box_room", "--frames", "9", "--size", "384x192"]


def children(pid):
    """Processes whose parent is `pid`."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            if int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1]) == pid:
                found.append(int(entry.name))
        except (OSError, IndexError):
            pass
    return found


class Processes(ProgramTest):
    def wait_for(self, what, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := what():
                return value
            time.sleep(0.01)
        self.fail("nothing in time")

    def start(self, out, *more):
        return subprocess.Popen([PROGRAM, *ARGUMENTS, "--processes", "3", "--out", str(out), *more], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)

    def frames_there(self, out):
        return len(list(out.glob("rgb/*.png"))) if out.exists() else 0

    @classmethod
    def setUpClass(cls):
        # Of one process, undisturbed.
        folder = tempfile.TemporaryDirectory(prefix="airsim360_end_to_end_")
        cls.addClassCleanup(folder.cleanup)
        cls.whole = pathlib.Path(folder.name) / "whole"
        run(*ARGUMENTS, "--out", cls.whole).check_returncode()

    def test_several_processes_write_the_bytes_of_one(self):
        out = self.folder / "a"
        report = json.loads(self.run_ok(*ARGUMENTS, "--processes", "3", "--json", "--out", out).stdout)
        self.assertEqual(tree(out), tree(self.whole))
        self.assertEqual((report["frames"], report["frames_written"]), (9, 9))
        self.assertGreater(report["render_ms"], 0)
        again = json.loads(self.run_ok(*ARGUMENTS, "--processes", "2", "--json", "--out", out).stdout)
        self.assertTrue(again["already_complete"])

    def test_one_process_finishes_what_several_began_and_the_other_way_round(self):
        for first, second in ((["--processes", "3"], []), ([], ["--processes", "3"])):
            out = self.folder / ("a" + "".join(first))
            process = subprocess.Popen([PROGRAM, *ARGUMENTS, *first, "--out", str(out)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.wait_for(lambda: self.frames_there(out) >= 2 or process.poll() is not None)
            started = children(process.pid)
            process.kill()
            process.wait()
            self.wait_for(lambda: not any(os.path.exists(f"/proc/{pid}") for pid in started), 10)
            self.run_ok(*ARGUMENTS, *second, "--out", out)
            self.assertEqual(tree(out), tree(self.whole))

    def test_a_killed_process_is_started_again(self):
        out = self.folder / "a"
        process = self.start(out)
        self.wait_for(lambda: self.frames_there(out) >= 1 or process.poll() is not None)
        victims = children(process.pid)
        for pid in victims[:2]:
            os.kill(pid, signal.SIGKILL)
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        self.assertIn("signal 9", errors)
        self.assertEqual(tree(out), tree(self.whole))

    def test_a_shard_and_a_video_are_the_same_too(self):
        more = ["--shard", "1/2", "--normal"]
        self.run_ok(*ARGUMENTS, *more, "--out", self.folder / "a")
        self.run_ok(*ARGUMENTS, *more, "--processes", "2", "--out", self.folder / "b")
        self.assertEqual(tree(self.folder / "a"), tree(self.folder / "b"))

    def test_a_process_that_fails_ends_the_collection(self):
        out = self.folder / "a"
        self.run_ok(*ARGUMENTS[:-1], "64x32", "--out", out)
        for name in ("SHA256SUMS", "range/000003.exr"):
            (out / name).unlink()
        (out / "range").rename(out / "other")
        (out / "range").write_text("no folder")
        result = run(*ARGUMENTS[:-1], "64x32", "--processes", "2", "--out", out)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("range", result.stderr)

    def test_wrong_numbers_are_named(self):
        out = self.folder / "a"
        self.run_bad(2, *ARGUMENTS, "--processes", "0", "--out", out, says=["--processes"])
        self.run_bad(2, *ARGUMENTS, "--gpu", "77", "--out", out, says=["--gpu: there is no GPU 77"])
        self.run_bad(2, *ARGUMENTS, "--gpu", "1,1", "--out", out, says=["--gpu"])
        self.run_bad(2, *ARGUMENTS, "--gpu", "first", "--out", out, says=["--gpu: 'first' is not"])
        self.run_bad(2, "render", "--world", "box_room", "--gpu", "all", "--out", out, says=["--gpu: 'all' is not an index"])
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
