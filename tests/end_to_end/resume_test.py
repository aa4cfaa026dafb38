"""A collection that is killed at any moment and run again gives the bytes of one that was not; damage is found."""
import random
import resource
import shutil
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, run, tree

ARGUMENTS = ["collect", "--world", "box_room", "--frames", "10", "--size", "256x128"]


class Resume(ProgramTest):
    def test_killed_at_random_moments_and_finished_gives_the_same_bytes(self):
        whole = self.folder / "whole"
        start = time.monotonic()
        self.run_ok(*ARGUMENTS, "--out", whole)
        seconds = time.monotonic() - start
        moments = random.Random(360)
        interrupted = 0
        for trial in range(5):
            out = self.folder / f"killed{trial}"
            for kill in range(2):
                process = subprocess.Popen([PROGRAM, *ARGUMENTS, "--out", str(out)], stdout=subprocess.DEVNULL,
                                           stderr=subprocess.DEVNULL)
                try:
                    process.wait(seconds * moments.uniform(0.05, 1))
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()
                    interrupted += 1
            self.run_ok(*ARGUMENTS, "--out", out)
            self.assertEqual(tree(out), tree(whole), f"trial {trial}")
            shutil.rmtree(out)
        self.assertGreater(interrupted, 0)

    def test_interrupted_after_every_number_of_frames(self):
        # A file size limit stops the run exactly when a file grows beyond it: here the journal, at different moments.
        whole = self.folder / "whole"
        self.run_ok(*ARGUMENTS, "--out", whole)
        out = self.folder / "limited"
        failures = 0
        for kib in (8, 40, 60, 80, 120, 200):
            def limit(size=kib * 1024):
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
            result = run(*ARGUMENTS, "--out", out, preexec_fn=limit)
            if result.returncode:
                self.assertEqual(result.returncode, 1, result.stderr)
                failures += 1
                self.assertFalse(list(out.rglob("*.tmp")) if out.exists() else [], "nothing half-written")
        self.assertGreater(failures, 0)
        self.run_ok(*ARGUMENTS, "--out", out)
        self.assertEqual(tree(out), tree(whole))

    def test_complete_dataset_is_left_alone(self):
        out = self.folder / "a"
        self.run_ok(*ARGUMENTS, "--out", out)
        times = {path: path.stat().st_mtime_ns for path in out.rglob("*")}
        result = self.run_ok(*ARGUMENTS, "--out", out)
        self.assertIn("complete already", result.stdout)
        self.assertEqual({path: path.stat().st_mtime_ns for path in out.rglob("*")}, times)

    def test_other_parameters_are_refused_by_name(self):
        out = self.folder / "a"
        self.run_ok(*ARGUMENTS, "--out", out)
        self.run_bad(2, *ARGUMENTS, "--seed", "3", "--out", out, says=["seed is 0 there, 3 here"])
        self.run_bad(2, *ARGUMENTS[:-1], "128x64", "--out", out, says=["width is 256 there, 128 here"])


class Verify(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "a"
        self.run_ok("collect", "--world", "box_room", "--frames", "2", "--size", "64x32", "--out", self.out)

    def test_a_good_dataset_passes(self):
        self.run_ok("verify", self.out)
        subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=self.out, check=True)

    def test_a_flipped_bit_in_any_file_is_found(self):
        places = random.Random(1)
        for path in sorted(p for p in self.out.rglob("*") if p.is_file()):
            data = bytearray(path.read_bytes())
            at = places.randrange(len(data))
            data[at] ^= 1 << places.randrange(8)
            good = path.read_bytes()
            path.write_bytes(bytes(data))
            result = run("verify", self.out)
            self.assertEqual(result.returncode, 1, path)
            if path.name != "SHA256SUMS":
                self.assertIn(str(path.relative_to(self.out)), result.stdout)
            path.write_bytes(good)
        self.run_ok("verify", self.out)

    def test_what_verify_names_is_restored_by_deleting_it_and_collecting_again(self):
        good = tree(self.out)
        for path in sorted(p for p in self.out.rglob("*") if p.is_file()):
            path.unlink()
            self.run_ok("collect", "--world", "box_room", "--frames", "2", "--size", "64x32", "--out", self.out)
            self.assertEqual(tree(self.out), good, path)
        # Other parameters are no reason to write meta.json.
        (self.out / "meta.json").unlink()
        self.run_bad(2, "collect", "--world", "box_room", "--frames", "3", "--size", "64x32", "--out", self.out, says=["not empty and not a dataset"])
        self.assertFalse((self.out / "meta.json").exists())

    def test_missing_and_extra_files_are_named(self):
        (self.out / "range/000001.exr").unlink()
        (self.out / "notes.txt").write_text("x")
        result = self.run_bad(1, "verify", self.out, says=["1 findings"])
        self.assertIn("missing  range/000001.exr", result.stdout)
        self.assertIn("extra    notes.txt", result.stdout)

    def test_an_extra_file_alone_is_no_damage(self):
        (self.out / "notes.txt").write_text("x")
        self.assertIn("extra", self.run_ok("verify", self.out).stdout)

    def test_not_a_dataset(self):
        self.run_bad(2, "verify", self.folder, says=["not a dataset"])
        self.run_bad(2, "verify", self.folder / "nowhere", says=["nowhere"])


if __name__ == "__main__":
    unittest.main()
