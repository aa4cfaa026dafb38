"""Our optical flow against OpenCV's DIS, which sees the pictures alone, between two instants of a camera that moves.

Skips without python3-opencv.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))
from program import PROGRAM  # noqa: E402

try:
    import cv2
    import numpy as np

    import airsim360
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

WIDTH, HEIGHT, FOV = 640, 480, 90


class Flow(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_flow_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        # Along the fronts of houses; each frame says where the points of its pixels are in the next.
        (cls.folder / "route.csv").write_text("x,y,z,yaw_deg\n" + "".join(f"{-47 + 0.2 * k},{16 + 0.3 * k},{9.5 + 0.05 * k},{178 + 0.4 * k}\n" for k in range(4)))
        result = subprocess.run([PROGRAM, "collect", "--world", "downtown_west", "--route", str(cls.folder / "route.csv"), "--projection", "pinhole", "--fov", str(FOV), "--size",
                                 f"{WIDTH}x{HEIGHT}", "--tier", "fast", "--edge-samples", "8", "--products", "flow", "--out", str(cls.folder / "flight")],
                                capture_output=True, text=True, timeout=400)
        if result.returncode:
            raise AssertionError(result.stderr)
        cls.frames = list(airsim360.Dataset(cls.folder / "flight"))

    def pairs(self):
        for a, b in zip(self.frames, self.frames[1:]):
            grey = [cv2.cvtColor(np.ascontiguousarray(frame.rgb), cv2.COLOR_RGB2GRAY) for frame in (a, b)]
            yield a, b, grey

    def test_dense_inverse_search_agrees_where_there_is_texture(self):
        errors, still = [], []
        for a, _, (first, second) in self.pairs():
            dis = cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM).calc(first, second, None)
            texture = cv2.cornerMinEigenVal(cv2.GaussianBlur(first, (0, 0), 1), 7)
            known = (a.range > 0) & (a.read("flow")["occluded"] == 0) & (texture > np.percentile(texture, 60))
            errors.append(np.linalg.norm(dis - a.flow, axis=-1)[known])
            still.append(np.linalg.norm(a.flow, axis=-1)[known])
        error, length = np.concatenate(errors), np.concatenate(still)
        print(f"DIS: end-point error median {np.median(error):.3f} px, mean {error.mean():.3f} px, of motions of {np.median(length):.2f} px (median)")
        self.assertGreater(np.median(length), 1)
        self.assertLess(np.median(error), 0.35)

    def test_the_next_picture_along_our_flow_is_this_picture(self):
        x, y = np.meshgrid(np.arange(WIDTH, dtype=np.float32), np.arange(HEIGHT, dtype=np.float32))
        for a, b, (first, second) in self.pairs():
            flow = np.nan_to_num(a.flow).astype(np.float32)
            there = cv2.remap(second, x + flow[..., 0], y + flow[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE).astype(float)
            inside = (a.read("flow")["occluded"] == 0) & (a.range > 0)
            moved, unmoved = np.abs(there - first)[inside].mean(), np.abs(second.astype(float) - first)[inside].mean()
            print(f"warped: grey levels apart {moved:.2f}, without flow {unmoved:.2f}")
            self.assertLess(moved, 0.6 * unmoved)


if __name__ == "__main__":
    unittest.main()
