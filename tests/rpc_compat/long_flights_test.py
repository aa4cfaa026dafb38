"""What AirSim's survey.py and path.py do, over open ground: flights of half a kilometre, landings after them."""
import math
import os
import tempfile
import time
import unittest

from harness import ServerTest

import airsim360.airsim as airsim

# A square of 800 m; +Y of the file is up.
GROUND = "v -400 0 400\nv 400 0 400\nv 400 0 -400\nv -400 0 -400\nf 1 2 3 4\n"


class OpenGround(ServerTest):
    settings = {"ClockSpeed": 30}

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.world = os.path.join(cls.folder.name, "ground.obj")
        with open(cls.world, "w") as file:
            file.write(GROUND)
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        super().tearDownClass()
        cls.folder.cleanup()

    def setUp(self):
        self.drone = self.client()
        self.drone.reset()
        self.drone.enableApiControl(True)
        self.drone.armDisarm(True)
        self.assertTrue(self.drone.takeoffAsync().get())

    def place(self):
        p = self.drone.getMultirotorState().kinematics_estimated.position
        return p.x_val, p.y_val, p.z_val

    def land(self):
        """As scripts end: afterwards it lies on the ground and can take off again."""
        self.assertTrue(self.drone.landAsync().get())
        self.assertGreater(self.place()[2], -0.1, "it still hung in the air when it said that it had landed")
        self.assertTrue(self.drone.armDisarm(False))
        time.sleep(0.1)
        self.assertEqual(self.drone.getMultirotorState().landed_state, airsim.LandedState.Landed)
        self.assertTrue(self.drone.armDisarm(True))
        self.assertTrue(self.drone.takeoffAsync().get(), "the next script takes off at once")

    def test_a_landing_after_a_descent_ends_on_the_ground(self):
        self.drone.moveToPositionAsync(0, 0, -20, 5).join()
        self.drone.moveToPositionAsync(0, 0, -5, 2).join()
        self.land()

    def test_the_rectangle_of_path_py_is_flown_and_the_drone_comes_home(self):
        z = -5
        self.drone.moveToZAsync(z, 1).join()
        corners = [(125, 0), (125, -130), (0, -130), (0, 0)]
        path = [airsim.Vector3r(x, y, z) for x, y in corners]
        started = self.drone.getMultirotorState().timestamp
        flight = self.drone.moveOnPathAsync(path, 12, 120, airsim.DrivetrainType.ForwardOnly, airsim.YawMode(False, 0), 20, 1)
        nearest = [math.inf] * 4
        seen = []
        while not flight._done.is_set():
            x, y, height = self.place()
            seen.append(height)
            nearest = [min(best, math.hypot(x - cx, y - cy)) for best, (cx, cy) in zip(nearest, corners)]
        self.assertTrue(flight.get(), "the path ends by itself")
        self.assertLess((self.drone.getMultirotorState().timestamp - started) * 1e-9, 80)
        self.assertLess(max(nearest), 15, nearest)  # the carrot 20 m ahead cuts corners
        self.assertLess(max(abs(height - z) for height in seen), 2)
        self.drone.moveToPositionAsync(0, 0, z, 1).join()
        x, y, _ = self.place()
        self.assertLess(math.hypot(x, y), 1.5)
        self.land()


if __name__ == "__main__":
    unittest.main()
