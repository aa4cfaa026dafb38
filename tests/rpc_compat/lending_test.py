"""Memory that our client lends to the server: the same pictures, whatever becomes of it."""
import gc
import os
import pickle
import signal
import subprocess
import sys
import time
import unittest

import numpy as np

from harness import ServerTest

import airsim360.airsim as airsim
from airsim360.airsim import lending

PANORAMAS = [("panorama_original", False), ("panorama_depth", True), ("panorama_entity", False), ("panorama_flow", True)]

# A client that dies while its pictures are being made.
VICTIM = """
import sys, threading
import airsim360.airsim as airsim
c = airsim.MultirotorClient(port=int(sys.argv[1]))
c.simGetImages([airsim.ImageRequest("panorama_depth", 0, True, False)])
print("busy", flush=True)
while True:
    c.simGetImages([airsim.ImageRequest("panorama_depth", 0, True, False)])
"""


class Lending(ServerTest):
    settings, arguments = {}, ("--lockstep",)

    def setUp(self):
        self.drone = self.client()
        self.drone.simSetPanoramaResolution("panorama_original", 256, 128)

    def ask(self, cameras=PANORAMAS):
        return self.drone.simGetImages([airsim.ImageRequest(name, 0, is_float, False) for name, is_float in cameras])

    def through_the_socket(self):
        requests = [{"camera_name": name, "image_type": 0, "pixels_as_float": is_float, "compress": False, "binary_float": True}
                    for name, is_float in PANORAMAS]
        return self.raw().call("simGetImages", requests, "", False)

    def test_pictures_are_those_of_the_socket(self):
        expected = self.through_the_socket()
        for _ in range(3):
            for response, other in zip(self.ask(), expected):
                if response.pixels_as_float:
                    self.assertEqual(response.image_data_float.tobytes(), other["image_data_float"])
                else:
                    self.assertIsInstance(response.image_data_uint8, bytes)
                    self.assertEqual(response.image_data_uint8, other["image_data_uint8"])
                self.assertEqual(response.time_stamp, other["time_stamp"])
        self.assertIsNotNone(self.drone._lending, "they did come through lent memory")

    def test_arrays_need_no_copy_and_have_their_shapes(self):
        self.ask()
        color, depth, entity, flow = self.ask()
        self.assertEqual([a.pixels().shape for a in (color, depth, entity, flow)],
                         [(128, 256, 3), (128, 256), (128, 256, 3), (128, 256, 2)])
        self.assertIsNotNone(color.pixels().base)
        self.assertFalse(color.pixels().flags.writeable)
        again = pickle.loads(pickle.dumps(color))
        self.assertEqual(again, color)
        self.assertEqual(again.image_data_uint8, color.image_data_uint8)
        np.testing.assert_array_equal(again.pixels(), color.pixels())
        png = self.drone.simGetImages([airsim.ImageRequest("panorama_original", 0, False, True)])[0]
        with self.assertRaises(ValueError):
            png.pixels()

    def test_pictures_that_are_kept_stay_as_they_are(self):
        self.ask()
        kept = self.ask()[1].pixels()
        before = kept.copy()
        self.drone.simSetVehiclePose(airsim.Pose(airsim.Vector3r(1, 1, -2), airsim.Quaternionr()), True)
        for _ in range(5):
            other = self.ask()[1].pixels()
        self.assertTrue(np.any(other != before))
        np.testing.assert_array_equal(kept, before)
        self.drone.reset()

    def test_memory_is_used_again_and_its_end_is_no_error(self):
        self.ask()
        place = self.ask()[0].pixels().__array_interface__["data"][0]
        gc.collect()
        self.assertEqual(self.ask()[0].pixels().__array_interface__["data"][0], place)
        self.drone._lending.wanted = lending._BYTES + 1
        self.assertEqual(len(self.ask()[0].image_data_uint8), 256 * 128 * 3)
        self.drone._lending.wanted = 1  # too little at first
        kept = [self.ask() for _ in range(3)]
        self.assertEqual({bytes(pictures[1].pixels()) for pictures in kept}, {bytes(self.ask()[1].pixels())})

    def test_regions_that_overlap_nothing_are_given_back_whole(self):
        pool = lending.Lending(self.server.port)
        pool.wanted = 1 << 20
        regions = [pool.take() for _ in range(8)]
        self.assertEqual(len({region.offset for region in regions}), 8)
        for number in (3, 1, 2, 7, 0, 5, 4, 6):
            regions[number] = None
        gc.collect()
        pool.wanted = lending._BYTES
        whole = pool.take()
        self.assertEqual((whole.offset, whole.size), (0, lending._BYTES))
        self.assertIsNone(pool.take())

    def test_wrong_calls_have_airsims_words(self):
        with self.assertRaises(Exception) as caught:
            self.ask([("no such camera", False)])
        self.assertIn("function 'simGetImages'", str(caught.exception))
        self.assertIn("front_center", str(caught.exception))
        self.ask()
        raw, token = self.raw(), self.drone._lending.token
        request = [{"camera_name": "0", "image_type": 0, "pixels_as_float": False, "compress": False}]
        self.assertError(lambda: raw.call("simGetImagesLent", request, "", False, token + 1, 0, 4096), "token")
        for region in ((lending._BYTES, 64), (64, lending._BYTES), (2**64 - 64, 128), (3, 64)):
            self.assertError(lambda: raw.call("simGetImagesLent", request, "", False, token, *region), "region")

    def test_a_server_that_takes_none_sends_them(self):
        self.drone._may_lend = False
        self.assertEqual(len(self.ask()[0].image_data_uint8), 256 * 128 * 3)
        self.assertEqual(self.ask()[1].pixels().shape, (128, 256))
        self.assertIsNone(lending.lend("192.0.2.1", self.server.port))
        self.assertIsNone(lending.lend("127.0.0.1", 1))

    def test_clients_that_are_killed_leave_nothing(self):
        environment = {**os.environ, "PYTHONPATH": os.environ["AIRSIM360_PYTHON"]}
        for number in range(5):
            victim = subprocess.Popen([sys.executable, "-c", VICTIM, str(self.server.port)], stdout=subprocess.PIPE, env=environment)
            victim.stdout.readline()
            time.sleep(0.004 * number)
            victim.send_signal(signal.SIGKILL)
            victim.wait()
            victim.stdout.close()
        self.ask()
        for _ in range(200):
            with open(f"/proc/{self.server.process.pid}/maps") as file:
                lent = sum("memfd:airsim360" in line for line in file)
            if lent <= 1:
                break
            time.sleep(0.02)
        self.assertEqual(lent, 1)


if __name__ == "__main__":
    unittest.main()
