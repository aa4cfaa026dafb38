"""Language data as users meet it: the files of each layout read back by their own rules, the check, bad input."""
import json
import pickle
import tempfile
import unittest
from pathlib import Path

from vln_tools import ROOT, jpeg_size, lines, run

MAP = ROOT / "data" / "osm" / "crossing.osm"


def counts_of(text):
    """COCO's compressed run lengths, read as pycocotools' rleFrString does."""
    counts, at = [], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            byte = ord(text[at]) - 48
            value |= (byte & 0x1F) << (5 * shift)
            more = bool(byte & 0x20)
            at, shift = at + 1, shift + 1
            if not more and byte & 0x10:
                value |= -1 << (5 * shift)
        if len(counts) > 2:
            value += counts[-2]
        counts.append(value)
    return counts


class LanguageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        cls.report = json.loads(run("language", "make", "--world", MAP, "--kind", "refer", "--count", 24, "--width", 512, "--layout", "refcoco,llava",
                                    "--pictures", "--out", cls.out / "refer.jsonl", "--json").stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_an_imported_map_gives_expressions_that_the_check_proves(self):
        self.assertEqual(self.report["items"], 24)
        checked = json.loads(run("language", "check", self.out / "refer.jsonl", "--json").stdout)
        self.assertEqual((checked["items"], checked["wrong"]), (24, 0))

    def test_the_pickle_of_refs_is_what_refer_reads(self):
        with open(self.out / "refer_refs.p", "rb") as file:
            refs = pickle.load(file)
        instances = json.loads((self.out / "refer_instances.json").read_text())
        self.assertEqual(sum(len(r["sentences"]) for r in refs), 24)
        self.assertTrue(all(type(r["ref_id"]) is int and r["split"] in ("train", "val", "test") for r in refs))
        images, annotations = ({x["id"]: x for x in instances[name]} for name in ("images", "annotations"))
        categories = {c["id"]: c["name"] for c in instances["categories"]}
        for ref in refs:
            annotation, image = annotations[ref["ann_id"]], images[ref["image_id"]]
            x, y, w, h = annotation["bbox"]
            self.assertTrue(0 <= x < x + w <= image["width"] and 0 <= y < y + h <= image["height"])
            self.assertTrue(all(categories[ref["category_id"]] in s["raw"] and s["tokens"] == s["sent"].split() for s in ref["sentences"]))
            # The mask fills its box.
            counts = counts_of(annotation["segmentation"]["counts"])
            self.assertEqual(sum(counts), image["width"] * image["height"])
            self.assertEqual(sum(counts[1::2]), annotation["area"])
            first, last = counts[0], sum(counts) - (counts[-1] if len(counts) % 2 else 0) - 1
            self.assertEqual((first // image["height"], last // image["height"]), (x, x + w - 1))

    def test_every_picture_that_items_name_is_there(self):
        files = {(p["file"], p["width"], p["height"]) for item in lines(self.out / "refer.jsonl") for p in item["pictures"]}
        for file, width, height in files:
            self.assertEqual(jpeg_size((self.out / file).read_bytes()), (width, height))

    def test_conversations_of_llava(self):
        talks = json.loads((self.out / "refer_llava.json").read_text())
        self.assertEqual(len(talks), 24)
        for talk, item in zip(talks, lines(self.out / "refer.jsonl")):
            human, gpt = talk["conversations"]
            self.assertEqual((human["from"], gpt["from"]), ("human", "gpt"))
            self.assertTrue(human["value"].startswith("<image>\n") and item["expression"] in human["value"])
            self.assertEqual(json.loads(gpt["value"]), item["answer"])

    def test_a_spoiled_item_is_named(self):
        items = lines(self.out / "refer.jsonl")
        items[3]["answer"] = items[3]["choices"][items[3]["answer_index"]] = [0, 0, 9, 9]
        (self.out / "spoiled.jsonl").write_text("".join(json.dumps(i) + "\n" for i in items))
        done = run("language", "check", self.out / "spoiled.jsonl", status=1)
        self.assertIn(items[3]["id"], done.stdout)
        self.assertIn("1 otherwise wrong", done.stdout)

    def test_bad_input_says_what_and_writes_nothing(self):
        out = self.out / "none.jsonl"
        for words, said in ((("--kind", "vqas"), "did you mean 'vqa'"), (("--count", "0"), "--count"), (("--count", "1e99"), "--count"), (("--width", "77"), "--width"),
                            (("--kind", "caption", "--layout", "refcoco"), "refcoco holds items of kind refer"), (("--layout", "coco"), "refcoco"),
                            (("--tier", "labels", "--pictures"), "--tier"), (("--tone", "agx"), "--tone: it is of --pictures"),
                            (("--weather", "night"), "--weather: it is of --pictures")):
            done = run("language", "make", "--world", MAP, "--out", out, *words, status=2)
            self.assertIn(said, done.stderr)
        done = run("language", "make", "--world", MAP, "--out", self.out, status=2)
        self.assertIn("is a folder; give a file", done.stderr)
        self.assertFalse(Path(str(self.out) + ".part").exists())
        self.assertIn("is a folder", run("language", "check", self.out, status=2).stderr)
        # One cube in a room: there is nothing to tell it from.
        done = run("language", "make", "--world", "box_room", "--kind", "refer", "--count", "1", "--out", out, status=1)
        self.assertIn("gives only", done.stderr)
        self.assertFalse(out.exists() or Path(str(out) + ".part").exists())
        for text, said in (("", "holds no item"), ("{", ":1"), ("[" * 5000, ":1"), ('{"id": "a"}', "kind"), ("x" * 2_000_000, "1 MiB")):
            (self.out / "bad.jsonl").write_text(text)
            self.assertIn(said, run("language", "check", self.out / "bad.jsonl", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
