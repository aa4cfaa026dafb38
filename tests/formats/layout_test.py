"""Layouts of rooms: corners projected anew from the frames' poses, and read by the program's own evaluation."""
import json

import numpy as np
from readers import FormatTest


class Layout(FormatTest):
    COLLECT = ["--tier", "labels"]
    SIZE = (64, 32)

    def rendered(self, pose):
        out = self.folder / "room"
        self.run_ok("render", "--world", "apartment", "--pose", pose, "--size", "512x256", "--tier", "labels", "--out", out)
        return out

    def test_corners_are_where_the_geometry_puts_them(self):
        rooms = json.loads(self.run_ok("world", "rooms", "apartment", "--json").stdout)
        room = next(r for r in rooms["rooms"] if r["type"] == "living_room")
        (x0, y0), (x1, y1) = room["corners"][0], room["corners"][2]
        at = [x0 + 0.6 * (x1 - x0), y0 + 0.45 * (y1 - y0), room["floor_z"] + 2.2]
        data = self.rendered("%f,%f,%f,35" % tuple(at))
        out = self.export("layout", data=data)
        frame = json.loads((data / "frames.jsonl").read_text().splitlines()[0])
        layout = json.loads((out / "layout" / (frame["stem"] + ".json")).read_text())
        self.assertEqual((layout["room"], layout["type"]), (room["id"], "living_room"))

        # By hand: the camera looks 35 degrees left of +X; azimuth grows to the right.
        yaw = np.radians(35)
        for k, (x, y) in enumerate(layout["corners_W"]):
            dx, dy = x - at[0], y - at[1]
            azimuth = -(np.arctan2(dy, dx) - yaw)
            azimuth = (azimuth + np.pi) % (2 * np.pi) - np.pi
            for j, z in enumerate((room["ceiling_z"], room["floor_z"])):
                elevation = np.arctan2(z - at[2], np.hypot(dx, dy))
                want = np.array([512 * (azimuth / (2 * np.pi) + 0.5) - 0.5, 256 * (0.5 - elevation / np.pi) - 0.5])
                got = np.array(layout["uv"][2 * k + j]) * [512, 256]
                self.assertLess(np.abs(got - want).max(), 0.5)
        self.assertEqual(sorted(map(tuple, layout["corners_W"])), sorted(map(tuple, room["corners"])))

        # The evaluation takes it as truth and as prediction.
        file = out / "layout" / (frame["stem"] + ".json")
        figures = json.loads(self.run_ok("eval", "layout", file, file, "--size", "512x256", "--json").stdout)
        self.assertAlmostEqual(figures["iou3d"], 1, places=6)
        self.assertAlmostEqual(figures["corner_error_percent"], 0, places=9)

    def test_worlds_without_rooms_are_refused(self):
        self.run_bad(2, "dataset", "export", self.data, "--format", "layout", "--out", self.folder / "none", says=["rooms", "apartment"])

    def test_a_camera_outside_has_no_layout(self):
        out = self.export("layout", data=self.rendered("8,-6,1.5"))
        self.assertEqual(self.report["notes"]["frames_outside_rooms"], 1)
        self.assertFalse((out / "layout").exists())
        self.assertIn("doors", json.loads((out / "rooms.json").read_text()))


if __name__ == "__main__":
    import unittest
    unittest.main()
