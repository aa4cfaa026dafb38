"""Label pictures against the published ids, pixel by pixel."""
import json
import struct
import unittest

import numpy as np

from coco_test import decode_rle
from readers import FormatTest, erp_rays, read_exr, read_ids, read_png

CITYSCAPES_TRAIN = {7: 0, 8: 1, 11: 2, 12: 3, 13: 4, 17: 5, 19: 6, 20: 7, 21: 8, 22: 9, 23: 10, 24: 11, 25: 12, 26: 13, 27: 14, 28: 15,
                    31: 16, 32: 17, 33: 18}


def murmur3(data):
    """MurmurHash3_x86_32, seed 0."""
    mask, h = 0xFFFFFFFF, 0
    rotate = lambda v, n: ((v << n) | (v >> (32 - n))) & mask
    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        k = int.from_bytes(data[i:i + 4], "little") * 0xCC9E2D51 & mask
        h = (rotate(h ^ rotate(k, 15) * 0x1B873593 & mask, 13) * 5 + 0xE6546B64) & mask
    if data[whole:]:
        k = int.from_bytes(data[whole:], "little") * 0xCC9E2D51 & mask
        h ^= rotate(k, 15) * 0x1B873593 & mask
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & mask
    h = (h ^ h >> 13) * 0xC2B2AE35 & mask
    return h ^ h >> 16


class Labels(FormatTest):
    def ids(self, frame):
        return read_png(self.source("semantic", frame)).astype(int)

    def table(self, key):
        table = np.full(1 << 16, -1)
        for category in self.meta["categories"]:
            table[category["id"]] = category[key]
        return table

    def test_cityscapes(self):
        out, table, none, count = self.export("cityscapes"), self.table("cityscapes"), 0, 0
        for frame in self.frames:
            stem = f"train/boxroom/boxroom_000000_{frame['index']:06d}_"
            expected = table[self.ids(frame)]
            labels = read_png(out / "gtFine" / (stem + "gtFine_labelIds.png"))
            np.testing.assert_array_equal(labels, np.maximum(expected, 0))
            train = read_png(out / "gtFine" / (stem + "gtFine_labelTrainIds.png"))
            np.testing.assert_array_equal(train, np.vectorize(lambda i: CITYSCAPES_TRAIN.get(i, 255))(labels))
            instances, entity = read_png(out / "gtFine" / (stem + "gtFine_instanceIds.png")), read_ids(self.source("entity", frame))
            things = instances >= 1000
            np.testing.assert_array_equal(things, (labels >= 24) & (labels <= 33))
            np.testing.assert_array_equal(np.where(things, instances // 1000, instances), labels)
            pairs = np.unique(np.stack([instances[things], entity[things]]), axis=1)
            self.assertEqual(len(set(pairs[0])), pairs.shape[1], "one number one person")
            none, count = none + (expected < 0).sum(), count + expected.size
            self.assertTrue((out / "leftImg8bit" / (stem + "leftImg8bit.png")).exists())
        self.assertAlmostEqual(self.report["notes"]["unmapped_share"], none / count, places=12)

    def test_ade20k(self):
        out, table = self.export("ade20k"), self.table("ade20k")
        for frame in self.frames:
            stored = read_png(out / "annotations/training" / (frame["stem"] + ".png"))
            np.testing.assert_array_equal(stored, table[self.ids(frame)] + 1)  # 0 = other, classes from 1

    def test_wildpass(self):
        out = self.export("wildpass")
        self.assertEqual((out / "classes.txt").read_text().split("\n")[5], "5 Person")
        path = {category["id"]: category["path"] for category in self.meta["categories"]}
        for frame in self.frames:
            stored, ids = read_png(out / "gtFine/train" / (frame["stem"] + ".png")), self.ids(frame)
            np.testing.assert_array_equal(stored == 5, np.vectorize(lambda i: path[i].startswith("human"))(ids))
            self.assertLessEqual(set(np.unique(stored)), {5, 255})

    def test_vps(self):
        out = self.export("vps")
        gt = json.loads((out / "panoptic_gt.json").read_text())
        self.assertEqual([len(v["images"]) for v in gt["videos"]], [len(self.frames)])
        category = {}
        for image in gt["annotations"][0]["annotations"]:
            ids = read_ids(out / "panomasksRGB/0000" / image["file_name"])
            self.assertEqual({s["id"]: s["area"] for s in image["segments_info"]}, dict(zip(*map(list, np.unique(ids, return_counts=True)))))
            for segment in image["segments_info"]:
                self.assertEqual(category.setdefault(segment["id"], segment["category_id"]), segment["category_id"])

    def test_step_and_mots_number_people_the_same_in_all_frames(self):
        step, table = self.export("step"), self.table("cityscapes")
        mots = self.export("mots")
        lines = [line.split(" ") for line in (mots / "instances_txt/0000.txt").read_text().splitlines()]
        of_entity = {}
        for position, frame in enumerate(self.frames):
            entity, ids = read_ids(self.source("entity", frame)), self.ids(frame)
            panoptic = read_png(step / f"panoptic_maps/train/0000/{position:06d}.png").astype(int)
            np.testing.assert_array_equal(panoptic[..., 0], np.vectorize(lambda i: CITYSCAPES_TRAIN.get(i, 255))(table[ids]))
            number = panoptic[..., 1] * 256 + panoptic[..., 2]
            np.testing.assert_array_equal(number > 0, panoptic[..., 0] == 11)
            instances = read_png(mots / f"instances/0000/{position:06d}.png").astype(int)
            np.testing.assert_array_equal(instances, np.where(number > 0, 2000 + number, 0))
            for value in np.unique(number[number > 0]):
                here = set(np.unique(entity[number == value]))
                self.assertEqual(of_entity.setdefault(value, here), here)
            told = {int(l[1]): l for l in lines if int(l[0]) == position}
            self.assertEqual(set(told), set(np.unique(instances)) - {0})
            for value, (_, _, kind, height, width, counts) in told.items():
                self.assertEqual(kind, "2")
                mask = decode_rle({"size": [int(height), int(width)], "counts": counts})
                np.testing.assert_array_equal(mask, instances == value)
        self.assertEqual(len(of_entity), 3)

    def test_cryptomatte_ids_are_hashes_of_names_and_shares_are_the_coverage(self):
        out = self.export("cryptomatte")
        names = {int(i): e["name"] for i, e in json.loads((self.data / "entities.json").read_text()).items()}
        for frame in self.frames[:3]:
            channels, header = read_exr(out / "cryptomatte" / (frame["stem"] + ".exr"), attributes=True)
            key = f"cryptomatte/{murmur3(b'CryptoObject'):08x}"[:19] + "/"
            self.assertEqual(header[key + "name"], b"CryptoObject")
            self.assertEqual(header[key + "hash"], b"MurmurHash3_32")
            self.assertEqual(header[key + "conversion"], b"uint32_to_float32")
            manifest = json.loads(header[key + "manifest"])
            coverage = read_exr(self.source("coverage", frame, ".exr"))
            for rank, (layer, pair) in enumerate((("00", "RG"), ("00", "BA"), ("01", "RG"), ("01", "BA"))):
                ids, share = (channels[f"CryptoObject{layer}.{c}"] for c in pair)
                np.testing.assert_array_equal(share, coverage[f"share.{rank}"])
                for entity in np.unique(coverage[f"id.{rank}"]):
                    bits = set(np.ascontiguousarray(ids[coverage[f"id.{rank}"] == entity]).view(np.uint32))
                    if entity == 0:
                        self.assertEqual(bits, {0})
                        continue
                    name = names[int(entity)]
                    expected = murmur3(name.encode())
                    if (expected >> 23) & 255 in (0, 255):
                        expected ^= 1 << 23
                    self.assertEqual(bits, {expected})
                    self.assertEqual(int(manifest[name], 16), expected)

    def test_flow_is_middleburys(self):
        out = self.export("flow")
        for frame in self.frames:
            data = (out / "flow" / (frame["stem"] + ".flo")).read_bytes()
            self.assertEqual(struct.unpack("<f2i", data[:12]), (202021.25, 128, 64))
            uv = np.frombuffer(data[12:], "<f4").reshape(64, 128, 2)
            source = read_exr(self.source("flow", frame, ".exr"))
            np.testing.assert_array_equal(uv, np.stack([source["dx"], source["dy"]], -1))
            np.testing.assert_array_equal(read_png(out / "occlusion" / (frame["stem"] + ".png")) == 255, source["occluded"] > 0.5)

    def test_bounding_fields_of_view_hold_their_masks(self):
        out = self.export("360vots")
        tracks, crossing, checked = sorted((out / "tracks").iterdir()), 0, 0
        self.assertEqual(len(tracks), self.report["notes"]["tracks"])
        rays = erp_rays(128, 64)
        for track in tracks:
            for name, label in json.loads((track / "label.json").read_text()).items():
                mask = read_png(track / "mask" / name) > 0
                entity = read_ids(self.data / "entity" / name)
                np.testing.assert_array_equal(mask, entity == int(track.name))
                for kind in ("bfov", "rbfov"):
                    b = {key: np.radians(value) for key, value in label[kind].items()}
                    # A view at (clon, clat), longitude to the right and latitude up, turned by the rotation.
                    forward = np.array([np.cos(b["clat"]) * np.sin(b["clon"]), -np.sin(b["clat"]), np.cos(b["clat"]) * np.cos(b["clon"])])
                    right = np.array([np.cos(b["clon"]), 0, -np.sin(b["clon"])])
                    up = np.cross(forward, right) * (1 if np.cross(forward, right)[1] < 0 else -1)
                    c, s = np.cos(b["rotation"]), np.sin(b["rotation"])
                    x, y, z = rays[mask] @ (c * right - s * up), rays[mask] @ (s * right + c * up), rays[mask] @ forward
                    self.assertLessEqual(np.abs(np.arctan2(x, z)).max(), b["fov_h"] / 2 + 1e-9)
                    self.assertLessEqual(np.abs(np.arctan2(y, z)).max(), b["fov_v"] / 2 + 1e-9)
                    # Tight: the centres of the outermost pixels are within two pixels of the border.
                    self.assertGreater(np.abs(np.arctan2(x, z)).max(), b["fov_h"] / 2 - 0.15)
                self.assertLessEqual(label["rbfov"]["fov_h"] * label["rbfov"]["fov_v"], label["bfov"]["fov_h"] * label["bfov"]["fov_v"] + 1e-9)
                box = label["bbox"]
                columns = (np.nonzero(mask)[1] + 0.5 - box["cx"] + 64) % 128 - 64
                self.assertLessEqual(np.abs(columns).max(), box["w"] / 2)
                crossing += box["cx"] + box["w"] / 2 > 128 or box["cx"] < box["w"] / 2
                checked += 1
        self.assertGreater(checked, 5)


if __name__ == "__main__":
    unittest.main()
