"""airsim360.show: the viewer from Python."""
import os
import shutil
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

import airsim360

ROOM = tempfile.mkdtemp(prefix="airsim360_show_")


def setUpModule():
    subprocess.run([os.environ["AIRSIM360"], "collect", "--world", "box_room", "--frames", "3", "--size", "64x32", "--out", f"{ROOM}/data"], check=True, capture_output=True)


def tearDownModule():
    shutil.rmtree(ROOM)


def page(viewer):
    with urllib.request.urlopen(viewer.url, timeout=30) as answer:
        return answer.read().decode()


class ShowTest(unittest.TestCase):
    def test_a_dataset_is_served_until_it_is_closed(self):
        viewer = airsim360.show(airsim360.Dataset(f"{ROOM}/data"))
        self.assertIn("AirSim360", page(viewer))
        self.assertIn(f'src="{viewer.url}"', viewer._repr_html_())
        viewer.close()
        viewer.close()
        with self.assertRaises(urllib.error.URLError):
            page(viewer)

    def test_a_frame_opens_at_itself_and_two_datasets_side_by_side(self):
        dataset = airsim360.Dataset(f"{ROOM}/data")
        with airsim360.show(dataset[2], compare=dataset) as viewer:
            self.assertTrue(viewer.url.endswith("#frame=2"), viewer.url)
            with urllib.request.urlopen(viewer.address + "/session.json", timeout=30) as answer:
                self.assertIn(b"data/1/", answer.read())

    def test_a_world_is_opened_by_its_name(self):
        with airsim360.show("box_room") as viewer:
            with urllib.request.urlopen(viewer.address + "/session.json", timeout=30) as answer:
                self.assertIn(b'"box_room"', answer.read())

    def test_what_cannot_be_shown_is_a_value_error_that_says_why(self):
        for what, said in {"box_rom": "box_room", ROOM: "not a dataset"}.items():
            with self.assertRaisesRegex(ValueError, said):
                airsim360.show(what)
        with self.assertRaisesRegex(ValueError, "neither"):
            airsim360.show(7)


if __name__ == "__main__":
    unittest.main()
