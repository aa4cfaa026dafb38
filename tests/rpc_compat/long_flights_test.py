"""What AirSim's survey.py and path.py do, over open ground: flights of half a kilometre, landings after them."""
import math
import os
import tempfile
import unittest

from harness import ServerTest

import airsim360.airsim as airsim

# A square of 800 m; +Y of the file is up.
GROUND = "v -400 0 400\nv 400 0 400\nv 400 0 -400\nv -400 0 -400\nf 1 2 3 4\n"


class OpenGround(ServerTest):
    settings, arguments = {}, ("--lockstep",)  # as fast as it can, and the same every time

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
        self.assertTrue(self.fly(self.drone.takeoffAsync()))

    def fly(self, move, seconds=120, see=None):
        """The move's answer; `see` is told the places on the way."""
        done = []
        move.attach_callback(done.append)
        for _ in range(4 * seconds):
            if done:
                return move.get()
            self.drone.simContinueForTime(0.25)
            if see:
                see(self.place())
        return self.fail(f"the move has not ended after {seconds} s")

    def place(self):
        p = self.drone.getMultirotorState().kinematics_estimated.position
        return p.x_val, p.y_val, p.z_val

    def land(self):
        """As scripts end: afterwards it lies on the ground and can take off again."""
        self.assertTrue(self.fly(self.drone.landAsync()))
        self.assertGreater(self.place()[2], -0.1, "it still hung in the air when it said that it had landed")
        self.assertTrue(self.drone.armDisarm(False))
        self.drone.simContinueForTime(1)
        self.assertEqual(self.drone.getMultirotorState().landed_state, airsim.LandedState.Landed)
        self.assertTrue(self.drone.armDisarm(True))
        self.assertTrue(self.fly(self.drone.takeoffAsync()), "the next script takes off at once")

    def test_a_landing_after_a_descent_ends_on_the_ground(self):
        self.fly(self.drone.moveToPositionAsync(0, 0, -20, 5))
        self.fly(self.drone.moveToPositionAsync(0, 0, -5, 2))
        self.land()

    def test_the_rectangle_of_path_py_is_flown_and_the_drone_comes_home(self):
        z = -5
        self.fly(self.drone.moveToZAsync(z, 1))
        corners = [(125, 0), (125, -130), (0, -130), (0, 0)]
        path = [airsim.Vector3r(x, y, z) for x, y in corners]
        seen = []
        flight = self.drone.moveOnPathAsync(path, 12, 120, airsim.DrivetrainType.ForwardOnly, airsim.YawMode(False, 0), 20, 1)
        self.assertTrue(self.fly(flight, 80, seen.append), "the path ends by itself")
        for corner in corners:  # the carrot 20 m ahead cuts them
            self.assertLess(min(math.dist(place[:2], corner) for place in seen), 12, corner)
        self.assertLess(max(abs(place[2] - z) for place in seen), 2)
        self.fly(self.drone.moveToPositionAsync(0, 0, z, 1))
        self.assertLess(math.hypot(*self.place()[:2]), 1.5)
        self.land()


if __name__ == "__main__":
    unittest.main()
