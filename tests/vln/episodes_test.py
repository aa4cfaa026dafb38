"""Episodes, their proofs and the agents that need no model, as a user meets them; in box_room, which takes no time to open."""
import json
import math
import tempfile
import unittest
from pathlib import Path

from vln_tools import ROOT, TEMPLATES, check_schema, lines, make_room, paper_instructions, run

KEYS = {"sr", "osr", "spl", "spl_straight", "ne", "ndtw", "sdtw", "cls", "path_length"}


class Episodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.episodes = make_room(cls.path, 6)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def edited(self, change):
        """A copy of the episodes, the second one changed."""
        episodes = lines(self.episodes)
        change(episodes[1])
        copy = self.path / "edited.jsonl"
        copy.write_text("".join(json.dumps(e) + "\n" for e in episodes), encoding="utf-8")
        return episodes[1]["id"], copy

    def test_the_paper_has_37_instructions_with_eleven_predicates(self):
        templates = json.loads(run("vln", "templates", "--json").stdout)
        self.assertEqual(len(templates), 37)
        self.assertEqual({p["is"] for t in templates for p in t["query"]["predicates"]},
                         {"nearest", "ordinal", "bearing", "height_quantile", "opposite_side", "side_of", "across", "along", "on_top_of", "storey",
                          "surrounded_by"})
        self.assertEqual(paper_instructions()["paper37/26"],
                         "Continue flying straight ahead and stop when you reach the intersection with the main road.")

    def test_episodes_follow_the_schema_and_are_the_same_bytes_again(self):
        schema = json.loads((ROOT / "docs/reference/vln_episode.schema.json").read_text(encoding="utf-8"))
        episodes = lines(self.episodes)
        self.assertEqual(len(episodes), 6)
        for episode in episodes:
            check_schema(schema, episode)
            self.assertAlmostEqual(sum(math.dist(a, b) for a, b in zip(episode["ref"], episode["ref"][1:])), episode["geodesic_length"], delta=0.005)
        with tempfile.TemporaryDirectory() as other:
            again = make_room(other, 6)
            self.assertEqual(again.read_bytes(), self.episodes.read_bytes())

    def test_check_passes_what_make_made_and_names_what_was_spoilt(self):
        whole = json.loads(run("vln", "check", self.episodes, "--json").stdout)
        self.assertEqual((whole["episodes"], whole["wrong"]), (6, 0))

        def other_entity(e): e["goal"]["entities"] = [1]
        def two_answers(e): e["query"] = {"noun": {"word": "wall", "categories": ["construction/wall"]}, "predicates": []}
        def no_answer(e): e["query"]["noun"]["names"] = ["fountain"]
        def through_the_box(e): e["ref"] = [e["ref"][0], [3, 0, 0.5], e["ref"][-1]]
        def elsewhere(e): e["ref"][-1] = [0, 0, 1]
        for change, says in ((other_entity, "not unique"), (two_answers, "compete"), (no_answer, "no box answers"), (through_the_box, "not reachable"),
                             (elsewhere, "not reachable")):
            spoilt, copy = self.edited(change)
            done = run("vln", "check", copy, status=1)
            self.assertIn(spoilt, done.stdout + done.stderr, change.__name__)
            self.assertIn(says, done.stdout, change.__name__)

    def test_any_world_gives_instructions_of_five_lengths_that_hold(self):
        out = self.path / "any.jsonl"
        run("vln", "make", "--world", "box_room", "--templates", "any", "--starts", 2, "--out", out)
        self.assertEqual({e["template"].split("/")[2] for e in lines(out)} - {"3", "5"}, {"1", "2", "4"})
        self.assertGreater(len({len(e["instruction"].split()) for e in lines(out)}), 4)
        # Rooms are small: whoever keeps "a few metres" away has not arrived.
        kept = {e["instruction"] for e in lines(out) if e["template"].endswith("/4")}
        self.assertTrue(all("keep a metre away" in text for text in kept) and kept, kept)
        self.assertEqual(json.loads(run("vln", "check", out, "--json").stdout)["wrong"], 0)

    def test_a_limit_is_shared_among_nouns_and_asks_for_as_many_as_can_be_made(self):
        out = self.path / "limit.jsonl"
        run("vln", "make", "--world", "office", "--templates", "any", "--starts", 1, "--limit", 6, "--out", out)
        self.assertEqual(len(lines(out)), 6)
        self.assertEqual(len({e["query"]["noun"]["word"] for e in lines(out)}), 6)
        self.assertEqual(json.loads(run("vln", "check", out, "--json").stdout)["wrong"], 0)

    def test_what_shows_too_little_is_refused_or_said(self):
        template = {**TEMPLATES[0], "id": "room/far", "in_sight": 100_000}
        templates, out = self.path / "sight.json", self.path / "sight.jsonl"
        templates.write_text(json.dumps([template]), encoding="utf-8")
        self.assertIn("100000 are needed", run("vln", "make", "--world", "box_room", "--templates", templates, "--out", out, status=1).stderr)
        templates.write_text(json.dumps([{**template, "in_sight": "yes"}]), encoding="utf-8")
        self.assertIn("in_sight", run("vln", "make", "--world", "box_room", "--templates", templates, "--out", out, status=2).stderr)

    def test_parts_of_an_instruction_follow_each_other_each_with_a_proof(self):
        wall = {"noun": {"word": "east wall", "names": ["wall east"]}, "predicates": [{"is": "nearest"}]}
        template = {**TEMPLATES[0], "id": "room/two", "text": "Fly straight to the box. Still facing the way you flew, go on to the east wall and stop.",
                    "then": [{"query": wall, "goal_distance": 1}]}
        templates, out, flown = self.path / "parts.json", self.path / "parts.jsonl", self.path / "parts_flown.jsonl"
        templates.write_text(json.dumps([template]), encoding="utf-8")
        run("vln", "make", "--world", "box_room", "--templates", templates, "--starts", 3, "--out", out)
        schema = json.loads((ROOT / "docs/reference/vln_episode.schema.json").read_text(encoding="utf-8"))
        for episode in lines(out):
            check_schema(schema, episode)
            first, = episode["before"]
            self.assertEqual((first["goal"]["name"], episode["goal"]["name"]), ("box", "wall east"))
            self.assertTrue(first["proof"]["unique"] and episode["proof"]["unique"])
            # The way leads by the first goal, about 1 m from the box, on to the wall at x = 5.
            self.assertIn(first["goal"]["position"], episode["ref"])
            self.assertLess(math.dist(first["goal"]["position"], [3, 0, 0.5]), 2.6)
            self.assertAlmostEqual(episode["goal"]["position"][0], 4, delta=0.2)
        self.assertEqual(json.loads(run("vln", "check", out, "--json").stdout)["wrong"], 0)
        self.assertEqual(json.loads(run("vln", "run", out, "--out", flown, "--json").stdout)["process_fidelity"], 1)
        # The goal alone is not all that was asked for.
        episodes = lines(out)
        for episode in episodes:
            episode["before"][0]["goal"]["entities"] = [4]
        out.write_text("".join(json.dumps(e) + "\n" for e in episodes), encoding="utf-8")
        self.assertEqual(json.loads(run("vln", "check", out, "--json", status=1).stdout)["wrong"], 3)
        template["then"] *= 9
        templates.write_text(json.dumps([template]), encoding="utf-8")
        self.assertIn("then", run("vln", "make", "--world", "box_room", "--templates", templates, "--out", out, status=2).stderr)

    def test_a_world_that_lacks_the_thing_says_so(self):
        done = run("vln", "make", "--world", "box_room", "--out", self.path / "none.jsonl", "--starts", 1, status=1)
        self.assertIn("the world has no traffic light", done.stderr)
        self.assertFalse((self.path / "none.jsonl").exists())

    def test_the_oracle_arrives_and_both_commands_give_its_scores(self):
        for decisions in ("waypoints", "yomo"):
            out = self.path / f"oracle_{decisions}.jsonl"
            scores = json.loads(run("vln", "run", self.episodes, "--decisions", decisions, "--out", out, "--json").stdout)
            self.assertLessEqual(KEYS, set(scores))
            self.assertEqual(scores["sr"], 1, decisions)
            self.assertGreater(scores["spl"], 0.8)
            radius = lines(self.episodes)[0]["goal"]["radius"]
            theirs = json.loads(run("eval", "vln", self.episodes, out, "--radius", radius, "--json").stdout)
            for key in KEYS:
                self.assertAlmostEqual(theirs[key], scores[key], delta=1e-9, msg=key)

    def test_the_same_run_gives_the_same_bytes_with_one_worker_and_three(self):
        for agent in ("random", "forward", "heuristic", "mask"):
            one, three = self.path / f"{agent}1.jsonl", self.path / f"{agent}3.jsonl"
            run("vln", "run", self.episodes, "--agent", agent, "--out", one)
            run("vln", "run", self.episodes, "--agent", agent, "--workers", 3, "--out", three)
            self.assertEqual(one.read_bytes(), three.read_bytes(), agent)

    def test_a_camera_in_front_has_to_turn_where_a_panorama_does_not(self):
        turned = {}
        for view in ("erp", "front", "cube6"):
            out = self.path / f"mask_{view}.jsonl"
            scores = json.loads(run("vln", "run", self.episodes, "--agent", "mask", "--view", view, "--decisions", "yomo", "--out", out, "--json").stdout)
            turned[view] = scores["decisions"]
        self.assertEqual(turned["erp"], 1)
        self.assertEqual(turned["cube6"], 1)
        self.assertGreater(turned["front"], 1)

    def test_a_world_that_has_changed_since_is_noticed(self):
        def other_world(e): e["world_things"]["sha256"] = "0" * 64
        def more_things(e): e["world_things"]["count"] += 1
        for change, says in ((other_world, "boxes of its first"), (more_things, "things and has")):
            name, copy = self.edited(change)
            done = run("vln", "check", copy, status=1)
            self.assertEqual(done.stdout.count("the world has changed since it was made"), 1)
            self.assertRegex(done.stdout, f"{name}.*{says}")
            self.assertIn(f"{name}: the world has changed", run("vln", "run", copy, "--agent", "forward", "--out", self.path / "changed.jsonl").stderr)
            (self.path / "changed.jsonl").unlink()
        def unknown(e): e["world_things"] = None
        self.assertEqual(json.loads(run("vln", "check", self.edited(unknown)[1], "--json").stdout)["wrong"], 0)
        def spoilt(e): e["world_things"]["sha256"] = "XYZ"
        self.assertIn("world_things.sha256", run("vln", "check", self.edited(spoilt)[1], status=2).stderr)

    def test_people_do_not_make_it_another_world(self):
        def peopled(e): e["people"] = 3
        done = run("vln", "run", self.edited(peopled)[1], "--agent", "forward", "--out", self.path / "peopled.jsonl")
        self.assertNotIn("has changed", done.stderr)

    def test_results_of_another_run_are_not_mixed(self):
        out = self.path / "mixed.jsonl"
        run("vln", "run", self.episodes, "--agent", "forward", "--limit", 2, "--out", out)
        done = run("vln", "run", self.episodes, "--agent", "random", "--out", out, status=2)
        self.assertIn("another run", done.stderr)

    def test_a_program_of_the_user_flies_and_its_faults_are_told(self):
        good, bad, gone = self.path / "good.py", self.path / "bad.py", self.path / "gone.py"
        good.write_text("import json, sys\nfor line in sys.stdin:\n    o = json.loads(line)\n    assert o['pictures'][0]['jpeg_base64'].startswith('/9j/')\n"
                        "    print(json.dumps({'action': 'turn_left' if o['step'] < 2 else 'stop'}), flush=True)\n")
        bad.write_text("import sys\nfor line in sys.stdin:\n    print('fly!', flush=True)\n")
        gone.write_text("import sys\nsys.stdin.readline()\n")
        ends = {}
        for program in (good, bad, gone):
            out = self.path / f"{program.stem}.jsonl"
            run("vln", "run", self.episodes, "--agent", "exec", "--program", f"/usr/bin/python3 {program}", "--decisions", "discrete", "--width", 64,
                "--limit", 2, "--out", out)
            ends[program.stem] = [(r["end"], r["faults"] > 0) for r in lines(out)]
        self.assertEqual(ends, {"good": [("stopped", False)] * 2, "bad": [("gave_up", True)] * 2, "gone": [("gave_up", True)] * 2})
        self.assertIn("the program has ended", lines(self.path / "gone.jsonl")[0]["explanation"])

    def test_a_report_of_two_runs_holds_both(self):
        first, second = self.path / "a.jsonl", self.path / "b.jsonl"
        run("vln", "run", self.episodes, "--out", first)
        run("vln", "run", self.episodes, "--agent", "forward", "--out", second)
        run("vln", "report", first, second, "--out", self.path / "report.html")
        page, text = (self.path / "report.html").read_text(encoding="utf-8"), (self.path / "report.md").read_text(encoding="utf-8")
        self.assertIn("<svg", page)
        for word in ("oracle", "forward", "You only move once", "room/near"):
            self.assertIn(word, page)
            self.assertIn(word, text)

    def test_bad_files_and_flags_are_named(self):
        broken = self.path / "broken.jsonl"
        for text, says in (("", "holds no episode"), ("{\"id\": 3}\n", "broken.jsonl:1"), ("[" * 100000, "deeper"), ("{\"id\": \"a\"", "not JSON")):
            broken.write_text(text)
            self.assertIn(says, run("vln", "check", broken, status=2).stderr)
        first = self.episodes.read_text(encoding="utf-8").splitlines()[0]
        broken.write_text(first + "\n" + first + "\n")
        self.assertIn("is there twice", run("vln", "check", broken, status=2).stderr)
        for words, says in ((("--protocol", "aerialvnl"), "aerialvln"), (("--agent", "orcale"), "oracle"), (("--view", "erb"), "erp"),
                            (("--workers", 0), "--workers"), (("--decisions", "yolo"), "yomo"), (("--program", "cat"), "--program")):
            self.assertIn(says, run("vln", "run", self.episodes, *words, "--out", self.path / "x.jsonl", status=2).stderr)
        for words, says in ((("--recipe", "omni360"), "omni360-vln"), (("--recipe", "omni360-vln", "--world", "box_room"), "world of the recipe"),
                            (("--recipe", "omni360-vln", "--seeds", 2), "--recipe")):
            self.assertIn(says, run("vln", "make", *words, "--out", self.path / "x.jsonl", status=2).stderr)
        self.assertIn("--starts", run("vln", "make", "--world", "box_room", "--starts", 0, "--out", self.path / "x.jsonl", status=2).stderr)
        self.assertIn("paper37", run("vln", "make", "--world", "box_room", "--templates", "paper73", "--out", self.path / "x.jsonl", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
