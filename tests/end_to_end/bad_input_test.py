"""Bad input gives one clear line and exit status 2, run-time failures 1, and nothing half-written."""
import json
import os
import shutil
import subprocess
import unittest

from program import ProgramTest, run, tree

ROOM = ["--world", "box_room", "--size", "64x32"]


class BadFlags(ProgramTest):
    def test_unknown_names_come_with_the_nearest(self):
        out = self.folder / "out"
        for arguments, says in [
            (["colect"], ["unknown command 'colect'", "did you mean 'collect'"]),
            (["collect", *ROOM, "--out", out, "--frame", "3"], ["--frame", "did you mean '--frames'"]),
            (["render", "--wrld", "box_room", "--out", out], ["--wrld", "did you mean '--world'"]),
            (["worlds", "--jsn"], ["--jsn", "did you mean '--json'"]),
            (["render", "--world", "box_rom", "--out", out], ["box_rom", "did you mean 'box_room'"]),
            (["collect", *ROOM, "--tier", "fats", "--out", out], ["--tier", "did you mean 'fast'"]),
            (["collect", *ROOM, "--format", "native,cocoo", "--out", out], ["cocoo", "did you mean 'coco'"]),
            (["render", *ROOM, "--projection", "rep", "--out", out], ["did you mean 'erp'"]),
            (["render", *ROOM, "--products", "rgb,flwo", "--out", out], ["--products", "flwo", "did you mean 'flow'"]),
            (["collect", *ROOM, "--products", "albeda", "--out", out], ["albeda", "did you mean 'albedo'"]),
            (["worlds", "--device", "cup"], ["--device", "did you mean 'cpu'"]),
            (["worlds", "--gpu", "-3"], ["--gpu", "0 … 255"]),
        ]:
            self.run_bad(2, *arguments, says=says)
        self.assertFalse(out.exists())

    def test_bad_values_name_flag_and_value(self):
        out = self.folder / "out"
        for flag, value in [("--size", "64"), ("--size", "64x33"), ("--size", "0x0"), ("--size", "40000x20000"), ("--size", "-64x-32"),
                            ("--size", "64x32x3"), ("--frames", "0"), ("--frames", "-3"), ("--frames", "many"), ("--shard", "2/2"),
                            ("--shard", "1"), ("--shard", "0/9"), ("--threads", "-1"), ("--threads", "x"), ("--seed", "-1"),
                            ("--rgb-format", "bmp"), ("--pano-frame", "sideways")]:
            arguments = ["collect", "--world", "box_room", "--size", "64x32", "--frames", "4", "--out", out]
            if flag in arguments:
                arguments[arguments.index(flag) + 1] = value
            else:
                arguments += [flag, value]
            self.run_bad(2, *arguments, says=[flag, value])
        for value in ["1,2", "1,2,3,4,5,6,7", "a,b,c", "1,2,nan", "1,2,inf", "1,2,1e30", ""]:
            result = run("render", *ROOM, "--pose", value, "--out", out)
            self.assertEqual(result.returncode, 2 if value else 0, (value, result.stderr))
        for flag, value in [("--pose", "1,2,1e30"), ("--pose", "-1.1e7,2,3")]:
            self.run_bad(2, "render", *ROOM, flag, value, "--out", out, says=[flag, value, "is not in -1e+07 … 1e+07"])
        for flag in ["--fps", "--start", "--people-warmup"]:
            self.run_bad(2, "collect", "--world", "box_room", "--size", "64x32", flag, "nan", "--out", out, says=[flag, "nan"])
        (self.folder / "file").write_text("")
        for place, said in [("", "--out: ''"), (self.folder / "file" / "a" / "b", f"--out: '{self.folder / 'file'}' is not a folder")]:
            self.run_bad(2, "render", *ROOM, "--out", place, says=[said])
        # Nothing is accepted and ignored.
        for flag, value in [("--people-warmup", "5"), ("--people-level", "1"), ("--sockets", "sockets.yaml")]:
            self.run_bad(2, "render", *ROOM, flag, value, "--out", out, says=[flag, "--people N"])
        for flag, value in [("--glare", "0.1"), ("--white-error", "0"), ("--each-frame", None)]:
            self.run_bad(2, "render", *ROOM, flag, *([value] if value else []), "--out", out, says=[flag, "add --look photo"])
        self.run_bad(2, "collect", "--recipe", "omni360-humn", "--out", out, says=["--recipe", "did you mean 'omni360-human'"])
        world = self.folder / "wet.yaml"
        world.write_text("world: box_room\nenvironment: {weather: ran}\n")
        self.run_bad(2, "render", "--world", world, "--out", out, says=["wet.yaml: unknown weather 'ran'; did you mean 'rain'"])
        self.run_bad(2, "collect", "--world", "box_room", "--size", "64x32", "--format", "native,omni360", "--shard", "0/2",
                     "--out", out, says=["--format: 'omni360'", "airsim360 dataset export"])
        for value in ["0", "0.0", "0.5", "180", "nan", "-90"]:
            self.run_bad(2, "render", "--world", "box_room", "--projection", "pinhole", "--fov", value, "--out", out, says=["--fov"])
        self.run_bad(2, "render", "--world", "box_room", "--projection", "cube", "--size", "64x32", "--out", out, says=["did you mean '64x64'"])

    def test_not_a_number_is_no_number_of_any_flag(self):
        mission, out = self.folder / "m.xml", self.folder / "out"
        mission.write_text('<root BTCPP_format="4"><BehaviorTree ID="m"><Wait seconds="1"/></BehaviorTree></root>')
        for arguments in [["fly", "--world", "box_room", "--speed"], ["fly", "--world", "box_room", "--mission", mission, "--longest"],
                          ["collect", *ROOM, "--fps"], ["collect", *ROOM, "--frames", "2", "--fps", "5", "--start"],
                          ["plan", "--route", "coverage", "--area", "0,0,9,9", "--spacing", "2", "--vmax", "3", "--amax", "2", "--height"]]:
            for value in ("nan", "NaN"):
                self.run_bad(2, *arguments, value, "--out", out, says=[f"{arguments[-1]}: '{value}' is not a number"])
            self.assertFalse(out.exists())

    def test_numbers_that_are_none_name_the_value_and_what_is_wanted(self):
        self.run_bad(2, "environments", "sample", "1e3", says=["'1e3' is not a whole number"])
        self.run_bad(2, "language", "make", "--world", "box_room", "--count", "1.5", "--out", self.folder / "out",
                     says=["--count: '1.5' is not a whole number"])
        self.run_bad(2, "traffic", "--seconds", "fast", says=["--seconds: 'fast' is not a number"])
        self.run_bad(2, "vln", "run", "none.jsonl", "--agent", "forward", "--limit", "0", "--out", self.folder / "out", says=["--limit", "0"])
        self.assertEqual(run("learn").returncode, 2)

    def test_a_pack_of_people_that_is_named_has_to_be_one(self):
        # Nobody gets other people than those that they asked for without a word.
        out, pack = self.folder / "out", self.folder / "people.pack"
        crowd = ["render", *ROOM, "--tier", "labels", "--people", "2", "--out", out]
        named = {**os.environ, "AIRSIM360_PEOPLE": str(pack)}
        self.run_bad(2, *crowd, says=["AIRSIM360_PEOPLE", "people.pack", "no such file"], env=named)
        pack.write_text("garbage")
        self.run_bad(2, *crowd, says=["AIRSIM360_PEOPLE", "cut off"], env=named)
        self.assertFalse(out.exists())

    def test_missing_flags_are_named(self):
        self.run_bad(2, "collect", "--world", "box_room", says=["--out"])
        self.run_bad(2, "collect", "--recipe", "omni360-human", "--world", "downtown_west", "--out", self.folder / "crowd",
                     says=["--world", "did you mean 'downtown_city'"])
        self.run_bad(2, "render", "--out", self.folder / "out", says=["--world"])
        self.run_bad(2)

    def test_route_errors_name_file_and_line(self):
        route, out = self.folder / "route.csv", self.folder / "out"
        route.write_text("x,y,z\n0,0,2\n0,zero,2\n")
        self.run_bad(2, "collect", *ROOM, "--route", route, "--out", out, says=["route.csv:3:3", "zero"])
        self.run_bad(2, "collect", *ROOM, "--route", self.folder / "none.csv", "--out", out, says=["none.csv"])
        self.assertFalse(out.exists())

    def test_help_of_every_command_documents_the_common_flags(self):
        for command in ["worlds", "render", "collect", "verify", "stitch", "doctor"]:
            text = self.run_ok(command, "--help").stdout
            for flag in ["--json", "--seed", "--threads", "--device"]:
                self.assertIn(flag, text, command)


class Outputs(ProgramTest):
    def test_worlds_lists_the_contract_fields(self):
        worlds = json.loads(self.run_ok("worlds", "--json").stdout)
        room = next(w for w in worlds if w["name"] == "box_room")
        self.assertEqual(room["setting"], "indoor")
        self.assertAlmostEqual(room["area_m2"], 100, delta=1)
        self.assertTrue(room["categories"])

    def test_doctor_says_what_to_do(self):
        checks = json.loads(self.run_ok("doctor", "--json").stdout)
        for check in checks:
            self.assertEqual(bool(check["fix"]), not check["present"])

    def test_bench_tells_what_it_timed(self):
        report = json.loads(self.run_ok("bench", "--world", "box_room", "--size", "64x32", "--tiers", "fast,labels", "--frames", "2",
                                        "--seconds", "0.1", "--json").stdout)
        self.assertEqual([tier["tier"] for tier in report["tiers"]], ["fast", "labels"])
        for tier in report["tiers"]:
            self.assertLessEqual(tier["render_ms_least"], tier["render_ms"])
            self.assertAlmostEqual(tier["frames_per_second"] * tier["render_ms"], 1000, delta=1e-6)
        # A ray a pixel, of labels no other.
        labels = report["tiers"][1]
        self.assertLessEqual(labels["mrays_per_second"] * 1e3 * labels["render_ms_least"], 64 * 32 * 1.001)
        self.assertEqual(report["entities"], 7)
        # Its steps are those of the simulation, a millisecond each.
        simulation = report["simulation"]
        self.assertAlmostEqual(simulation["steps_per_second"], 1000 * simulation["real_time_factor"], delta=1e-3 * simulation["steps_per_second"])
        self.run_bad(2, "bench", "--tiers", "fats", says=["--tiers", "did you mean 'fast'"])
        self.run_bad(2, "bench", "--frames", "0", says=["--frames: 0 is not in 1 ... 10000"])
        self.run_bad(2, "bench", "--seconds", "1e9", says=["--seconds", "more than a day"])

    def test_existing_file_or_foreign_folder_is_refused(self):
        (self.folder / "file").write_text("x")
        self.run_bad(2, "collect", *ROOM, "--out", self.folder / "file", says=["not a folder"])
        self.run_bad(2, "collect", *ROOM, "--out", self.folder, says=["not empty and not a dataset"])
        self.assertEqual([p.name for p in self.folder.iterdir()], ["file"])

    def test_unwritable_folder_is_a_run_time_failure(self):
        self.run_bad(1, "collect", *ROOM, "--out", "/proc/airsim360", says=["/proc/airsim360"])
        if os.getuid() != 0:
            self.folder.chmod(0o500)
            self.run_bad(1, "collect", *ROOM, "--out", self.folder / "out", says=["out"])

    def test_full_disk_leaves_whole_files_and_can_be_finished(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", disk], capture_output=True)
        if mounted.returncode:
            self.skipTest("mounting a small file system is not permitted here")
        try:
            command = ["collect", *ROOM, "--frames", "20", "--out"]
            failed = self.run_bad(1, *command, disk / "out", says=[str(disk / "out")])
            self.assertRegex(failed.stderr, "No space left on device|disk is full")
            self.run_ok(*command, self.folder / "whole")
            whole, partial = tree(self.folder / "whole"), tree(disk / "out")
            for name, sha in partial.items():
                if not name.startswith("index.sqlite"):
                    self.assertEqual(whole[name], sha, name)
            # With room again the same command finishes it.
            subprocess.run(["mount", "-o", "remount,size=64m", disk], check=True)
            self.run_ok(*command, disk / "out")
            self.assertEqual(tree(disk / "out"), whole)
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_full_stdout_is_a_run_time_failure(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "w") as full:
            result = subprocess.run([run.__globals__["PROGRAM"], "worlds", "--json"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
