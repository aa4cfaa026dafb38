"""Videos of a dataset: what ffmpeg decodes of the label videos is the labels, bit for bit."""
import json
import shutil
import subprocess
import unittest

import numpy as np

from readers import FormatTest, read_exr, read_ids, read_png


def decoded(path):
    done = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True, check=True)
    return np.frombuffer(done.stdout, np.uint8).reshape(-1, 64, 128, 3)


@unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed (apt-get install ffmpeg)")
class Videos(FormatTest):
    def test_labels_without_loss_depth_by_its_scale(self):
        out = self.export("video")
        entity, semantic, depth = (decoded(out / name) for name in ("entity.mkv", "semantic.mkv", "depth.mp4"))
        scale = json.loads((out / "depth.json").read_text())
        for i, frame in enumerate(self.frames):
            np.testing.assert_array_equal(entity[i].astype(int) @ [1, 256, 65536], read_ids(self.source("entity", frame)))
            np.testing.assert_array_equal(semantic[i].astype(int) @ [1, 256, 65536], read_png(self.source("semantic", frame)))
            gray = depth[i, ..., 1].astype(float)
            range_m = scale["nearest"] * (scale["farthest"] / scale["nearest"]) ** ((gray - 1) / 254)
            error = np.abs(range_m / read_exr(self.source("range", frame, ".exr"))["Y"] - 1)
            self.assertLess(np.median(error), 0.03)
        shown = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_streams", "-show_entries", "frame=pts_time", str(out / "colour.mp4")],
                               capture_output=True, text=True, check=True)
        seen = json.loads(shown.stdout)
        self.assertIn("equirectangular", [side.get("projection") for side in seen["streams"][0]["side_data_list"]])
        for shown_at, frame in zip(seen["frames"], self.frames):
            self.assertAlmostEqual(float(shown_at["pts_time"]), 1e-9 * (frame["t_ns"] - self.frames[0]["t_ns"]), delta=2e-5)


if __name__ == "__main__":
    unittest.main()
