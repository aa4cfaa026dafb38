"""`dataset plan, run, merge, status, slurm`: frames follow from the plan alone, whatever order, shards and interruptions."""
import json
import os
import random
import signal
import subprocess
import tempfile
import pathlib
import time
import unittest
import unittest.mock

from program import PROGRAM, ProgramTest, read_ids, read_json, run, tree

RECIPE = """
name: rooms
picture: {size: 128x64, tier: fast, exposure: auto}
skies:
  - name: two
    frames: 6
    choices:
      - {weather: day, settings: [{setting: cloud_cover, low: 0, high: 0.9}, {setting: sun_elevation_deg, low: 5, high: 60}]}
      - {weather: overcast}
rows:
  - {name: boxes, world: box_room, frames: 7, skies: two, clearance: 0.5, highest: 5}
  - {name: later, world: no_such_city, frames: 4, skies: two}
  - {name: sunny, world: sunlit_room, frames: 5, skies: two, clearance: 0.3, highest: 2.5}
"""


class Datasets(ProgramTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="airsim360_end_to_end_")
        cls.addClassCleanup(folder.cleanup)
        cls.shared = pathlib.Path(folder.name)
        # The light of rooms takes half a minute a sky: solved once, kept as for users.
        cls.enterClassContext(unittest.mock.patch.dict(os.environ, AIRSIM360_CACHE=os.environ.get("AIRSIM360_CACHE") or str(cls.shared / "cache")))
        (cls.shared / "rooms.yaml").write_text(RECIPE)
        cls.plan = cls.shared / "plan.json"
        run("dataset", "plan", cls.shared / "rooms.yaml", "--seed", "5", "--out", cls.plan).check_returncode()
        cls.whole = cls.shared / "whole"
        run("dataset", "run", cls.plan, "--out", cls.whole).check_returncode()

    def show(self, what):
        lines = self.run_ok("dataset", "plan", self.plan, "--show", what, "--json").stdout
        return [json.loads(line) for line in lines.splitlines()] if ":" in what else json.loads(lines)

    def frames(self, folder):
        return [json.loads(line) for line in (folder / "frames.jsonl").read_text().splitlines()]

    def shards(self, count):
        folders = [self.folder / f"shard-{i}" for i in range(count)]
        for i, folder in enumerate(folders):
            self.run_ok("dataset", "run", self.plan, "--shard", f"{i}/{count}", "--out", folder)
        return folders

    def test_a_frame_is_the_same_alone_in_a_range_and_in_the_dataset(self):
        together = {frame["index"]: frame for frame in self.show("0:16")}
        self.assertEqual(sorted(together), [*range(7), *range(11, 16)])
        written = {frame["index"]: frame for frame in self.frames(self.whole)}
        self.assertEqual(sorted(written), sorted(together))
        for index in (15, 0, 6, 12):
            alone = self.show(str(index))
            self.assertEqual(alone, together[index])
            for key in ("X_WC", "environment", "world", "seed", "row"):
                self.assertEqual(alone[key], written[index][key], key)
        self.assertGreater(len({frame["environment"] for frame in written.values()}), 2)

    def test_a_recipe_is_planned_and_run_by_one_command(self):
        self.run_ok("dataset", "run", self.shared / "rooms.yaml", "--seed", "5", "--out", self.folder / "a")
        self.assertEqual(tree(self.folder / "a"), tree(self.whole))
        self.run_bad(2, "dataset", "run", "omni360-mni", "--out", self.folder / "b", says=["did you mean 'omni360-mini'"])

    def test_the_same_recipe_and_seed_give_the_same_plan_and_another_seed_another(self):
        hashes = []
        for name, seed in (("a", 5), ("b", 5), ("c", 6)):
            report = self.run_ok("dataset", "plan", self.shared / "rooms.yaml", "--seed", seed, "--out", self.folder / name, "--json")
            hashes.append(json.loads(report.stdout)["hash"])
        self.assertEqual((self.folder / "a").read_bytes(), self.plan.read_bytes())
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_frames_of_a_row_do_not_change_when_there_are_more_or_other_rows(self):
        recipe = RECIPE.replace("frames: 7", "frames: 9").replace("{name: later, world: no_such_city, frames: 4, skies: two}",
                                                                  "{name: later, world: no_such_city, frames: 1, skies: two}")
        (self.folder / "more.yaml").write_text(recipe)
        self.run_ok("dataset", "plan", self.folder / "more.yaml", "--seed", "5", "--out", self.folder / "more.json")
        lines = self.run_ok("dataset", "plan", self.folder / "more.json", "--show", "0:7").stdout.splitlines()
        self.assertEqual([json.loads(line)["X_WC"] for line in lines], [frame["X_WC"] for frame in self.show("0:7")])

    def test_shards_merged_are_the_unsharded_dataset_byte_for_byte(self):
        for count in (2, 5):
            with self.subTest(count=count):
                folders = self.shards(count)
                frames = [len(self.frames(folder)) for folder in folders]
                self.assertEqual(sum(frames), 12)
                self.assertLessEqual(max(frames) - min(frames), 1)
                merged = self.folder / f"merged{count}"
                self.run_ok("dataset", "merge", *reversed(folders), "--out", merged)
                self.assertEqual(tree(merged), tree(self.whole))
                self.run_ok("verify", merged)
                for folder in folders:
                    self.run_ok("verify", folder)
                    subprocess.run(["rm", "-r", str(folder)], check=True)

    def test_a_shard_without_frames_is_a_dataset_too(self):
        self.run_ok("dataset", "run", self.plan, "--shard", "0/40", "--out", self.folder / "empty")
        self.assertEqual((self.folder / "empty/frames.jsonl").read_text(), "")
        self.run_ok("verify", self.folder / "empty")

    def test_several_processes_write_the_bytes_of_one(self):
        self.run_ok("dataset", "run", self.plan, "--processes", "2", "--out", self.folder / "two")
        self.assertEqual(tree(self.folder / "two"), tree(self.whole))

    def test_killed_at_random_moments_it_ends_with_the_same_bytes(self):
        lot = random.Random(1)
        for processes in ("1", "2", "4"):
            out = self.folder / f"killed{processes}"
            for _ in range(4):
                process = subprocess.Popen([PROGRAM, "dataset", "run", str(self.plan), "--processes", processes, "--out", str(out)],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
                time.sleep(lot.uniform(0.05, 1.2))
                process.send_signal(signal.SIGKILL)
                process.wait()
            deadline = time.monotonic() + 60
            while (result := run("dataset", "run", self.plan, "--out", out)).returncode == 1 and time.monotonic() < deadline:
                self.assertIn("another airsim360", result.stderr)  # processes of the one that was killed last
                time.sleep(0.1)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(tree(out), tree(self.whole))

    def test_status_counts_what_is_done_missing_and_waiting(self):
        folders = self.shards(2)
        report = json.loads(self.run_ok("dataset", "status", self.plan, folders[0], self.folder / "none", "--array", "2", "--json").stdout)
        self.assertEqual((report["frames"], report["done"], report["missing"], report["waiting"]), (16, 6, 6, 4))
        self.assertEqual((report["missing_frames"], report["missing_shards"]), ("6,11-15", "1"))
        report = json.loads(self.run_ok("dataset", "status", self.plan, *folders, "--json").stdout)
        self.assertEqual((report["done"], report["missing"], report["missing_frames"]), (12, 0, ""))

    def test_ids_of_different_worlds_are_different_and_each_is_in_the_list(self):
        entities = {int(key): value for key, value in read_json(self.whole / "entities.json").items()}
        seen = {}
        for frame in self.frames(self.whole):
            ids = {value for row in read_ids(self.whole / f"entity/{frame['stem']}.png") for value in row}
            seen.setdefault(frame["world"], set()).update(ids)
        self.assertFalse(seen["box_room"] & seen["sunlit_room"])
        self.assertEqual(seen["box_room"] | seen["sunlit_room"], set(entities))
        self.assertTrue(all(entity["name"] for entity in entities.values()))

    def test_a_plan_is_named_by_its_recipe_and_hash(self):
        digest = json.loads(self.plan.read_text())["hash"]
        for name in (f"{self.shared / 'rooms.yaml'}@{digest[:7]}", f"{self.plan}@{digest}"):
            self.run_ok("dataset", "plan", name, "--seed", "5", "--out", self.folder / "named.json")
            self.assertEqual((self.folder / "named.json").read_bytes(), self.plan.read_bytes())
        # It warns of the world that does not exist before it fails.
        other = run("dataset", "plan", f"{self.shared / 'rooms.yaml'}@{digest}", "--out", self.folder / "a")
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertRegex(other.stderr, "error: plan: .*the hash of .*the seed")
        self.assertFalse((self.folder / "a").exists())
        self.run_bad(2, "dataset", "plan", f"{self.plan}@12345", "--out", self.folder / "a", says=["'12345' is not the hash of a plan"])

    def test_a_plan_that_was_edited_is_refused(self):
        edited = self.folder / "edited.json"
        edited.write_text(self.plan.read_text().replace('"frames": 7', '"frames": 8'))
        self.run_bad(2, "dataset", "run", edited, "--out", self.folder / "a", says=["edited.json", "it was edited", "plan again"])
        edited.write_text(self.plan.read_text()[:500])
        self.run_bad(2, "dataset", "run", edited, "--out", self.folder / "a", says=["not a plan"])
        self.assertFalse((self.folder / "a").exists())

    def test_another_version_of_a_world_is_refused(self):
        import hashlib
        plan = json.loads(self.plan.read_text())
        del plan["hash"]
        plan["worlds"]["box_room"] = "0" * 64
        text = json.dumps(plan, separators=(",", ":"), ensure_ascii=False)
        plan = {"hash": hashlib.sha256(text.encode()).hexdigest(), **plan}
        (self.folder / "old.json").write_text(json.dumps(plan))
        self.run_bad(2, "dataset", "run", self.folder / "old.json", "--out", self.folder / "a",
                     says=["world 'box_room' is not the one that was planned with", "0" * 64])

    def test_folders_of_other_plans_and_other_pictures_are_refused(self):
        self.run_ok("dataset", "plan", self.shared / "rooms.yaml", "--seed", "6", "--out", self.folder / "other.json")
        self.run_bad(2, "dataset", "run", self.folder / "other.json", "--out", self.whole, says=["another dataset", "plan is"])
        self.run_bad(2, "dataset", "run", self.plan, "--tier", "labels", "--out", self.whole, says=["another dataset", "tier is"])
        self.run_bad(2, "dataset", "status", self.folder / "other.json", self.whole, says=["of another plan"])
        self.run_ok("dataset", "run", self.folder / "other.json", "--tier", "labels", "--shard", "0/2", "--out", self.folder / "other")
        self.run_bad(2, "dataset", "merge", self.whole, self.folder / "other", "--out", self.folder / "m", says=["of another plan"])
        self.run_ok("dataset", "run", self.plan, "--tier", "labels", "--shard", "0/2", "--out", self.folder / "half")
        self.run_bad(1, "dataset", "merge", self.folder / "half", "--out", self.folder / "m", says=["6 frames are in none", "the first 6"])
        self.run_bad(2, "dataset", "merge", self.whole, self.folder / "half", "--out", self.folder / "m", says=["does not go with", "tier"])
        (self.folder / "half/SHA256SUMS").unlink()
        self.run_bad(2, "dataset", "merge", self.folder / "half", "--out", self.folder / "m", says=["is not finished"])

    def test_a_damaged_shard_is_named_and_once_it_is_whole_the_same_merge_ends(self):
        shards = self.shards(2)
        out = self.folder / "merged"
        for product in ("entity", "normal", "rgb", "range"):
            pictures = sorted((shards[1] / product).glob("*")) if (shards[1] / product).exists() else []
            for picture in pictures[1:2]:
                good = picture.read_bytes()
                for bad in (good[:-9] + bytes([good[-9] ^ 1]) + good[-8:], good[:-20]):
                    picture.unlink()
                    picture.write_bytes(bad)
                    self.run_bad(2, "dataset", "merge", *shards, "--out", out, says=[str(picture), "damaged or cut off", "run its shard again"])
                    self.assertFalse((out / "SHA256SUMS").exists())
                picture.write_bytes(good)
        self.run_ok("dataset", "merge", *shards, "--out", out)
        self.assertEqual(tree(out), tree(self.whole))

    def test_two_runs_in_one_folder_are_refused(self):
        process = subprocess.Popen([PROGRAM, "dataset", "run", str(self.plan), "--size", "2048x1024", "--out", str(self.folder / "a")],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not list(self.folder.glob("a/rgb/*.png")):
            time.sleep(0.01)
        self.run_bad(1, "dataset", "run", self.plan, "--size", "2048x1024", "--out", self.folder / "a", says=["another airsim360 is writing here"])
        process.kill()
        process.wait()

    @unittest.skipIf(os.geteuid() == 0 and not os.path.exists("/dev/full"), "needs /dev/full")
    def test_a_full_disk_is_told_and_nothing_is_lost(self):
        out = self.folder / "a"
        self.run_ok("dataset", "run", self.plan, "--tier", "labels", "--out", out)
        before = tree(out)
        (out / "SHA256SUMS").unlink()
        (out / "frames.jsonl").unlink()
        (out / "frames.jsonl.tmp").symlink_to("/dev/full")
        limited = f"ulimit -f 1; exec {PROGRAM} dataset run {self.plan} --tier labels --out {out}"
        result = subprocess.run(["bash", "-c", limited], capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)
        self.run_ok("dataset", "run", self.plan, "--tier", "labels", "--out", out)
        self.assertEqual(tree(out), before)

    def test_mistakes_in_recipes_name_the_line_or_the_nearest_word(self):
        def plan_of(text, *says):
            (self.folder / "r.yaml").write_text(text)
            self.run_bad(2, "dataset", "plan", self.folder / "r.yaml", "--out", self.folder / "p.json", says=says)
        plan_of(RECIPE.replace("clearance: 0.5", "clearence: 0.5"), "r.yaml:11", "clearance")
        plan_of(RECIPE.replace("weather: overcast", "weather: overcats"), "overcast")
        plan_of(RECIPE.replace("cloud_cover", "clouds_cover"), "cloud_cover")
        plan_of(RECIPE.replace("high: 0.9", "high: 1.9"), "cloud_cover is 1.9")
        plan_of(RECIPE.replace("setting: cloud_cover", "setting: exposure"), "skies 'two'", "exposure: auto")
        plan_of(RECIPE.replace("exposure: auto", "exposure: 0").replace("setting: cloud_cover, low: 0", "setting: exposure, low: -21"), "-20 … 20 stops")
        plan_of(RECIPE.replace("frames: 7", "frames: -7"), "r.yaml:11", "frames")
        plan_of(RECIPE.replace("name: sunny", "name: boxes"), "two rows are called 'boxes'")
        plan_of(RECIPE.replace("size: 128x64", "size: 128x128"), "r.yaml: picture: --size", "did you mean '128x64'")
        plan_of(RECIPE.replace("tier: fast", "tier: fast, products: [norml]"), "r.yaml: picture: --products", "did you mean 'normal'")
        (self.folder / "r.yaml").write_text(RECIPE.replace("no_such_city", "box_rom"))
        planned = self.run_ok("dataset", "plan", self.folder / "r.yaml", "--out", self.folder / "typo.json")
        self.assertIn("world 'box_rom' does not exist yet; did you mean 'box_room'?", planned.stderr)
        plan_of(RECIPE.replace("skies: two, clearance: 0.5", "skies: tow, clearance: 0.5"), "did you mean 'two'")
        plan_of(RECIPE.replace("clearance: 0.3", "clearance: 90"), "no free place")
        self.run_bad(2, "dataset", "plan", "omni360-waypoint", "--out", self.folder / "p.json", says=["flights", "airsim360 plan --dataset waypoint --out", "omni360-waypoint-frames"])
        self.run_bad(2, "dataset", "plan", "omni360-scen", "--out", self.folder / "p.json", says=["did you mean 'omni360-scene'"])
        self.run_bad(2, "dataset", "plan", self.shared / "rooms.yaml", "--frames", "2", "--out", self.folder / "p.json", says=["--frames: 2 is not in 3"])
        self.run_bad(2, "dataset", "plan", self.plan, "--show", "16", says=["--show: '16'"])
        self.run_bad(2, "dataset", "plan", self.plan, "--show", "8", says=["no_such_city"])
        self.assertFalse((self.folder / "p.json").exists())

    def test_photos_and_exposures_of_a_recipe_follow_from_the_plan(self):
        picture = "{size: 64x32, tier: fast, look: photo, exposure: -0.5, camera_look: {each_frame: true, metering_spread: 0.1, noise_free: 0}}"
        recipe = RECIPE.replace("{size: 128x64, tier: fast, exposure: auto}", picture).replace("high: 60}", "high: 60}, {setting: exposure, low: -1, high: 1}")
        (self.folder / "photo.yaml").write_text(recipe)
        self.run_bad(2, "dataset", "plan", self.folder / "photo.yaml", "--out", self.folder / "photo.json", says=["photo.yaml:3", "noise_free"])
        (self.folder / "photo.yaml").write_text(recipe.replace("noise_free: 0", "full_well: 0"))
        plan = self.folder / "photo.json"  # with the seed of the shared one: the same light
        self.run_ok("dataset", "plan", self.folder / "photo.yaml", "--seed", "5", "--out", plan)
        self.run_ok("dataset", "run", plan, "--out", self.folder / "photo")
        frames = {frame["index"]: frame for frame in self.frames(self.folder / "photo")}
        shown = [json.loads(line) for line in self.run_ok("dataset", "plan", plan, "--show", "0:16").stdout.splitlines()]
        self.assertEqual({frame["index"]: frame["exposure"] for frame in shown}, {index: frame["exposure"] for index, frame in frames.items()})
        self.assertTrue(all(-1.5 <= frame["exposure"] <= 0.5 for frame in frames.values()))
        self.assertGreater(len({frame["exposure"] for frame in frames.values()}), 1)
        # A camera of its own for every frame; the same again in shards.
        self.assertEqual(len({frame["look"]["contrast"] for frame in frames.values()}), len(frames))
        shards = [self.folder / f"photo{i}" for i in range(2)]
        for i, folder in enumerate(shards):
            self.run_ok("dataset", "run", plan, "--shard", f"{i}/2", "--out", folder)
        self.run_ok("dataset", "merge", *shards, "--out", self.folder / "merged")
        self.assertEqual(tree(self.folder / "merged"), tree(self.folder / "photo"))
        # Flags count before the recipe: an exposure of each picture's own cannot be drawn as well.
        self.run_bad(2, "dataset", "run", plan, "--look", "clean", "--exposure", "auto", "--out", self.folder / "auto", says=["--exposure", "drawn"])
        self.assertFalse((self.folder / "auto").exists())
        parameters = read_json(self.folder / "photo/meta.json")["parameters"]
        self.assertEqual((parameters["look"], parameters["camera_look"]["metering_spread"], parameters["camera_look"]["each_frame"]), ("photo", 0.1, True))

    def test_rows_are_scaled_in_proportion(self):
        report = json.loads(self.run_ok("dataset", "plan", self.shared / "rooms.yaml", "--frames", "1600", "--out", self.folder / "p.json", "--json").stdout)
        self.assertEqual(report["frames"], 1600)
        rows = [row["frames"] for row in read_json(self.folder / "p.json")["recipe"]["rows"]]
        self.assertEqual([round(n / 100) for n in rows], [7, 4, 5])

    def test_a_script_of_shards_makes_the_dataset_on_this_machine(self):
        self.run_ok("dataset", "slurm", self.plan, "--array", "4", "--backend", "xargs", "--at-once", "2", "--cpus", "1", "--out", self.folder / "job.sh",
                    "--shards", self.folder / "it's here")
        subprocess.run(["sh", str(self.folder / "job.sh")], check=True, capture_output=True)
        self.assertEqual(tree(self.folder / "it's here/dataset"), tree(self.whole))
        again = subprocess.run(["sh", str(self.folder / "job.sh"), "missing"], check=True, capture_output=True, text=True)
        self.assertEqual(again.stdout.strip(), "")
        slurm = ("dataset", "slurm", self.plan, "--out", self.folder / "bad.sh", "--array")
        self.run_bad(2, *slurm, "13", says=["--array: 13 shards"])
        self.run_bad(2, *slurm, "2", "--remote", "/tmp/store", says=["--remote: '/tmp/store'", "REMOTE:PATH"])
        self.run_bad(2, *slurm, "2", "--image", "a", says=["--image", "slurm"])
        self.run_bad(2, *slurm, "2", "--backend", "xargs", "--time-limit", "1:00", says=["--time-limit", "xargs"])
        self.run_bad(2, *slurm, "2", "--backend", "kubernetes", "--shards", "/tmp/s", says=["--shards: '/tmp/s'", "/data"])
        self.assertFalse((self.folder / "bad.sh").exists())

    def test_built_in_recipes_have_the_numbers_of_the_paper(self):
        lines = self.run_ok("dataset", "plan").stdout.splitlines()
        frames = {line.split()[0]: int(line.split()[1]) for line in lines}
        self.assertEqual(frames["omni360-scene"], 61000)
        self.assertEqual(frames["omni360-scene-released"], 80000 + 24812 + 20716)
        self.assertEqual(frames["omni360-human"], 100700)
        self.assertEqual(frames["omni360-1m"], 1000000)
        self.assertEqual(frames["omni360-mini"], 200)


if __name__ == "__main__":
    unittest.main()
