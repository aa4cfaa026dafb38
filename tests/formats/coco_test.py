"""COCO files: run lengths decoded by the published rules, boxes against pixels, keypoints against the labels of people."""
import json
import unittest

import numpy as np

from readers import FormatTest, read_ids, read_png


def decode_rle(segmentation):
    """(H, W) bool of COCO's compressed run lengths: columns first, five bits a character, differences from the third on."""
    height, width = segmentation["size"]
    runs, value, shift = [], 0, 0
    for character in segmentation["counts"]:
        code = ord(character) - 48
        value |= (code & 31) << shift
        shift += 5
        if not code & 32:
            if code & 16:
                value -= 1 << shift
            runs.append(value + (runs[-2] if len(runs) > 2 else 0))
            value, shift = 0, 0
    assert sum(runs) == height * width and min(runs[1:]) > 0
    flat = np.concatenate([np.full(n, i % 2, bool) for i, n in enumerate(runs)])
    return flat.reshape(width, height).T


class Coco(FormatTest):
    def check(self, name, everything):
        out = self.export(name)
        coco = json.loads((out / "annotations" / "instances.json").read_text())
        self.assertEqual([image["id"] for image in coco["images"]], list(range(1, len(self.frames) + 1)))
        self.assertEqual([a["id"] for a in coco["annotations"]], list(range(1, len(coco["annotations"]) + 1)))
        self.assertEqual(self.report["notes"]["annotations"], len(coco["annotations"]))
        known = {category["id"] for category in coco["categories"]}
        things = {c["id"] for c in self.meta["categories"] if c["kind"] == "thing"}
        for image, frame in zip(coco["images"], self.frames):
            self.assertEqual((image["width"], image["height"]), self.SIZE)
            self.assertEqual((out / "images" / image["file_name"]).read_bytes(), self.source("rgb", frame).read_bytes())
            entity, semantic = read_ids(self.source("entity", frame)), read_png(self.source("semantic", frame))
            seen = set()
            for a in (a for a in coco["annotations"] if a["image_id"] == image["id"]):
                mask = decode_rle(a["segmentation"])
                np.testing.assert_array_equal(mask, entity == a["entity_id"])
                seen.add(a["entity_id"])
                self.assertIn(a["category_id"], known)
                self.assertEqual(a["area"], mask.sum())
                ys, xs = np.nonzero(mask)
                self.assertEqual(a["bbox"], [xs.min(), ys.min(), np.ptp(xs) + 1, np.ptp(ys) + 1])
                # The box on the circle holds the mask, is tight, and no wider.
                x, y, w, h = a["bbox_wrap"]
                columns = {(x + i) % 128 for i in range(w)}
                self.assertTrue(set(xs) <= columns and x in xs and (x + w - 1) % 128 in xs and w <= a["bbox"][2])
                if not everything:
                    self.assertEqual({a["category_id"]}, set(np.unique(semantic[mask])))
            wanted = entity if everything else entity[np.isin(semantic, list(things))]
            self.assertEqual(seen, set(np.unique(wanted)))
        return coco

    def test_instances_are_the_things(self):
        self.check("coco", False)

    def test_entities_are_everything_in_one_category(self):
        coco = self.check("coco_entity", True)
        self.assertEqual({a["category_id"] for a in coco["annotations"]}, {1})

    def test_some_mask_crosses_the_seam(self):
        coco = self.check("coco_entity", True)
        self.assertTrue(any(a["bbox_wrap"][0] + a["bbox_wrap"][2] > 128 for a in coco["annotations"]))

    def test_keypoints_are_those_of_the_labels(self):
        out = self.export("coco_keypoints")
        coco = json.loads((out / "annotations" / "person_keypoints.json").read_text())
        self.assertEqual(len(coco["categories"][0]["keypoints"]), 17)
        by_image = {image["id"]: image for image in coco["images"]}
        lines = [json.loads(line) for line in (self.data / "people.jsonl").read_text().splitlines()]
        expected = {(line["stem"] + ".png", p["entity_id"]): p for line in lines for p in line["persons"] if p["area"] > 0}
        found = {(by_image[a["image_id"]]["file_name"], a["entity_id"]): a for a in coco["annotations"]}
        self.assertEqual(set(found), set(expected))
        self.assertGreater(len(found), 5)
        for key, a in found.items():
            self.assertEqual(a["keypoints"], expected[key]["keypoints"])
            self.assertEqual(a["num_keypoints"], sum(v > 0 for v in a["keypoints"][2::3]))
            np.testing.assert_array_equal(decode_rle(a["segmentation"]), read_ids(self.data / "entity" / key[0]) == key[1])
        self.assertEqual(len({a["id"] for a in coco["annotations"]}), len(found))


if __name__ == "__main__":
    unittest.main()
