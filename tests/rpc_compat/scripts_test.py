"""What AirSim's example scripts do, through our client, and that the drone does what it was told.

box_room is 10 m by 10 m by 6 m with its floor at z = 0; north is +Y of the world.
"""
import math
import time
import unittest

import numpy as np

from harness import ServerTest

import airsim360.airsim as airsim


def position(client, vehicle=""):
    return client.getMultirotorState(vehicle).kinematics_estimated.position


class FlightTest(ServerTest):
    def flying(self, vehicle=""):
        client = self.client()
        client.reset()
        client.enableApiControl(True, vehicle)
        self.assertTrue(client.armDisarm(True, vehicle))
        self.assertTrue(client.takeoffAsync(vehicle_name=vehicle).get())
        return client

    def assertNear(self, place, expected, tolerance):
        self.assertLess(place.distance_to(airsim.Vector3r(*expected)), tolerance, (place, expected))


class HelloDrone(FlightTest):
    def test_take_off_move_hover_pictures_land(self):
        client = self.client()
        client.confirmConnection()
        client.reset()
        self.assertFalse(client.armDisarm(True), "without API control arming is refused")
        client.enableApiControl(True)
        self.assertTrue(client.isApiControlEnabled())
        self.assertTrue(client.armDisarm(True))
        state = client.getMultirotorState()
        self.assertEqual(state.landed_state, airsim.LandedState.Landed)
        self.assertNear(state.kinematics_estimated.position, (0, 0, 0), 0.1)
        self.assertTrue(client.takeoffAsync().get())
        self.assertEqual(client.getMultirotorState().landed_state, airsim.LandedState.Flying)
        self.assertLess(position(client).z_val, -1)
        self.assertTrue(client.moveToPositionAsync(-3, 2, -2, 3).get())
        self.assertNear(position(client), (-3, 2, -2), 1)
        client.hoverAsync().join()
        before = position(client)
        time.sleep(0.5)
        self.assertNear(position(client), (before.x_val, before.y_val, before.z_val), 1)
        self.assertLess(client.getMultirotorState().kinematics_estimated.linear_velocity.get_length(), 0.5)
        responses = client.simGetImages([
            airsim.ImageRequest("0", airsim.ImageType.DepthVis),
            airsim.ImageRequest("1", airsim.ImageType.DepthPerspective, True),
            airsim.ImageRequest("1", airsim.ImageType.Scene),
            airsim.ImageRequest("1", airsim.ImageType.Scene, False, False)])
        self.assertEqual(len({response.time_stamp for response in responses}), 1)
        self.assertTrue(responses[0].image_data_uint8.startswith(b"\x89PNG"))
        self.assertEqual(airsim.get_pfm_array(responses[1]).shape, (144, 256))
        self.assertEqual(len(responses[3].image_data_uint8), 256 * 144 * 3)
        self.assertTrue(client.landAsync().get())
        self.assertGreater(position(client).z_val, -0.3)
        self.assertTrue(client.armDisarm(False))
        time.sleep(0.3)
        self.assertEqual(client.getMultirotorState().landed_state, airsim.LandedState.Landed)
        client.enableApiControl(False)

    def test_sensors_read_as_they_should_on_the_ground(self):
        client = self.client()
        client.reset()
        time.sleep(0.5)
        imu = client.getImuData()
        self.assertAlmostEqual(imu.linear_acceleration.z_val, -9.8, delta=1)
        barometer = client.getBarometerData()
        self.assertAlmostEqual(barometer.altitude, 122, delta=15)
        gps = client.getGpsData()
        self.assertTrue(gps.is_valid)
        self.assertAlmostEqual(gps.gnss.geo_point.latitude, 47.641468, delta=1e-3)
        field = client.getMagnetometerData().magnetic_field_body
        self.assertAlmostEqual(field.get_length(), 0.53, delta=0.1)
        home = client.getHomeGeoPoint()
        self.assertAlmostEqual(home.longitude, -122.140165, delta=1e-3)


class Moves(FlightTest):
    def test_path_is_flown_to_its_end_facing_forwards(self):
        client = self.flying()
        self.assertTrue(client.moveToZAsync(-2, 1).get())
        path = [airsim.Vector3r(*p) for p in [(2, 0, -2), (2, 3, -2), (-2, 3, -2)]]
        future = client.moveOnPathAsync(path, 1, 120, airsim.DrivetrainType.ForwardOnly, airsim.YawMode(False, 0), 1, 1)
        self.assertTrue(future.get())
        self.assertNear(position(client), (-2, 3, -2), 1.2)
        yaw = airsim.to_eularian_angles(client.getMultirotorState().kinematics_estimated.orientation)[2]
        self.assertAlmostEqual(abs(yaw), math.pi, delta=0.5)

    def test_velocity_goes_where_it_points(self):
        client = self.flying()
        start = position(client)
        self.assertTrue(client.moveByVelocityAsync(1, 0, 0, 2).get())
        moved = position(client) - start
        self.assertGreater(moved.x_val, 0.8)
        self.assertLess(abs(moved.y_val), 0.3)
        self.assertTrue(client.moveByVelocityZAsync(0, -1, -3, 2).get())
        after = position(client)
        self.assertLess(after.y_val - start.y_val, -0.6)
        self.assertLess(after.z_val, start.z_val - 0.3)

    def test_body_frame_velocity_follows_the_heading(self):
        client = self.flying()
        self.assertTrue(client.rotateToYawAsync(90, 20, 5).get())
        yaw = airsim.to_eularian_angles(client.getMultirotorState().kinematics_estimated.orientation)[2]
        self.assertAlmostEqual(math.degrees(yaw), 90, delta=7)
        start = position(client)
        self.assertTrue(client.moveByVelocityBodyFrameAsync(1, 0, 0, 2, yaw_mode=airsim.YawMode(True, 0)).get())
        moved = position(client) - start
        self.assertGreater(moved.y_val, 0.8)
        self.assertLess(abs(moved.x_val), 0.5)

    def test_lean_moves_the_way_airsims_scripts_expect(self):
        # Python's pitch is nose down: forward. Its roll is right side down: right.
        client = self.flying()
        client.rotateToYawAsync(0, 10, 5).join()
        start = position(client)
        self.assertTrue(client.moveByRollPitchYawZAsync(0, 0.1, 0, -2, 1.5).get())
        self.assertGreater(position(client).x_val - start.x_val, 0.3)
        client.moveToPositionAsync(0, 0, -2, 2).join()
        start = position(client)
        self.assertTrue(client.moveByRollPitchYawrateThrottleAsync(0.1, 0, 0, 0.59, 1.5).get())
        self.assertGreater(position(client).y_val - start.y_val, 0.3)

    def test_rates_and_motors_answer_after_their_time(self):
        client = self.flying()
        self.assertTrue(client.moveByAngleRatesThrottleAsync(0, 0, 0.5, 0.59, 0.5).get())
        self.assertTrue(client.moveByMotorPWMsAsync(0.59, 0.59, 0.59, 0.59, 0.2).get())
        # Then it hovers again: the rotors are asked while they are told, with the clock stopped.
        told = client.moveByMotorPWMsAsync(0.59, 0.59, 0.59, 0.59, 0.5)
        client.simPause(True)
        rotors = client.getRotorStates().rotors
        client.simPause(False)
        self.assertTrue(told.get())
        self.assertEqual(len(rotors), 4)
        self.assertAlmostEqual(rotors[0]["thrust"], 2.45, delta=0.3)

    def test_go_home_goes_home(self):
        client = self.flying()
        client.moveToPositionAsync(2, 2, -2, 2).join()
        self.assertTrue(client.goHomeAsync(60).get())
        self.assertNear(position(client), (0, 0, 0), 1)

    def test_the_wall_is_hit_and_the_collision_stays_until_it_is_read(self):
        client = self.flying()
        client.simGetCollisionInfo()
        client.moveByVelocityAsync(4, 0, 0, 3).join()
        info = client.simGetCollisionInfo()
        self.assertTrue(info.has_collided)
        self.assertIn(info.object_name, client.simListSceneObjects())
        self.assertFalse(client.getMultirotorState().collision.has_collided, "AirSim never fills it")

    def test_standing_and_taking_off_are_no_collisions(self):
        client = self.client()
        client.reset()
        client.enableApiControl(True)
        client.armDisarm(True)
        self.assertFalse(client.simGetCollisionInfo().has_collided)
        client.takeoffAsync().join()
        self.assertFalse(client.simGetCollisionInfo().has_collided)
        client.landAsync().join()
        self.assertFalse(client.simGetCollisionInfo().has_collided, "a landing at 0.2 m/s")

    def test_teleport_and_kinematics(self):
        client = self.client()
        client.reset()
        client.simPause(True)
        client.simSetVehiclePose(airsim.Pose(airsim.Vector3r(1, -2, -3), airsim.to_quaternion(0, 0, 0.5)), True)
        pose = client.simGetVehiclePose()
        self.assertNear(pose.position, (1, -2, -3), 1e-4)
        self.assertAlmostEqual(airsim.to_eularian_angles(pose.orientation)[2], 0.5, places=5)
        truth = client.simGetGroundTruthKinematics()
        truth.linear_velocity = airsim.Vector3r(0.5, 0.25, 0)
        client.simSetKinematics(truth, True)
        self.assertAlmostEqual(client.simGetGroundTruthKinematics().linear_velocity.y_val, 0.25, places=5)
        environment = client.simGetGroundTruthEnvironment()
        self.assertAlmostEqual(environment.gravity.z_val, 9.80665, places=4)
        self.assertAlmostEqual(environment.air_density, 1.21, delta=0.03)
        client.simPause(False)

    def test_gains_change_how_it_turns(self):
        client = self.flying()
        client.setAngleRateControllerGains(airsim.AngleRateControllerGains())
        client.setAngleLevelControllerGains()
        client.setVelocityControllerGains()
        client.setPositionControllerGains()
        self.assertTrue(client.moveToPositionAsync(1, 0, -2, 2).get())


class Clock(FlightTest):
    arguments = ("--lockstep",)
    settings = {}

    def test_time_passes_by_calls_alone_and_exactly(self):
        client = self.client()
        self.assertTrue(client.simIsPause())
        start = client.getMultirotorState().timestamp
        time.sleep(0.2)
        self.assertEqual(client.getMultirotorState().timestamp, start)
        client.simContinueForTime(0.5)
        self.assertEqual(client.getMultirotorState().timestamp - start, 500_000_000)
        client.simContinueForFrames(3)
        self.assertEqual(client.getMultirotorState().timestamp - start, 560_000_000)
        self.assertTrue(client.simIsPause())

    def test_sensors_have_values_before_time_passes(self):
        client = self.client()
        for again in (False, True):
            if again:
                client.simContinueForTime(1)
                client.reset()
            self.assertAlmostEqual(client.getBarometerData().pressure, 99900, delta=1000)
            self.assertAlmostEqual(client.getMagnetometerData().magnetic_field_body.get_length(), 0.53, delta=0.1)
            self.assertAlmostEqual(client.getImuData().linear_acceleration.z_val, -9.8, delta=1)
            self.assertEqual(client.getImuData().time_stamp, client.getMultirotorState().timestamp)

    def test_the_same_calls_give_the_same_flight(self):
        def fly():
            client = self.client()
            client.reset()
            client.enableApiControl(True)
            client.armDisarm(True)
            client.takeoffAsync()
            client.simContinueForTime(4.2)
            client.moveByVelocityAsync(1, 0.5, 0, 2)
            client.simContinueForTime(1.5)
            return client.simGetVehiclePose()
        first, second = fly(), fly()
        self.assertLess(first.position.z_val, -1)
        self.assertNear(second.position, list(first.position), 1e-3)


class RaySensors(FlightTest):
    settings = {"Vehicles": {
        "Drone1": {"VehicleType": "SimpleFlight", "X": -2, "Sensors": {
            "Lidar": {"SensorType": 6, "NumberOfChannels": 16, "PointsPerSecond": 100000, "VerticalFOVLower": 0, "VerticalFOVUpper": 5,
                      "HorizontalFOVStart": -20, "HorizontalFOVEnd": 20, "DataFrame": "SensorLocalFrame"}}},
        "Drone2": {"VehicleType": "SimpleFlight", "X": 0}}}

    def test_lidar_meets_other_drones_where_they_are(self):
        client = self.client()

        def near():
            data = client.getLidarData("Lidar", "Drone1")
            points = np.reshape(data.point_cloud, (-1, 3))
            chosen = (np.hypot(points[:, 0] - 2, points[:, 1]) < 0.6) & (np.abs(points[:, 2]) < 0.5)
            return int(chosen.sum()), set(np.array(data.segmentation)[chosen])
        count, ids = near()
        self.assertGreater(count, 10)
        self.assertEqual(ids, {client.simGetSegmentationObjectID("Drone2")})
        client.simSetVehiclePose(airsim.Pose(airsim.Vector3r(0, 3, 0)), True, "Drone2")
        self.assertEqual(near()[0], 0)


class ManyDrones(FlightTest):
    settings = {"ClockSpeed": 6, "Vehicles": {
        "Drone1": {"VehicleType": "SimpleFlight", "X": -2, "Y": -2}, "Drone2": {"VehicleType": "SimpleFlight", "X": 2, "Y": 2, "Yaw": 90}}}

    def test_each_has_its_own_frame_and_goes_its_own_way(self):
        client = self.client()
        self.assertEqual(client.listVehicles(), ["Drone1", "Drone2"])
        for name in ("Drone1", "Drone2"):
            client.enableApiControl(True, name)
            client.armDisarm(True, name)
        futures = [client.takeoffAsync(vehicle_name=name) for name in ("Drone1", "Drone2")]
        self.assertEqual([future.get() for future in futures], [True, True])
        futures = [client.moveToPositionAsync(1, 0, -2, 1, vehicle_name="Drone1"),
                   client.moveToPositionAsync(-1, 0, -2, 1, vehicle_name="Drone2")]
        self.assertEqual([future.get() for future in futures], [True, True])
        self.assertNear(position(client, "Drone1"), (1, 0, -2), 1)
        self.assertNear(position(client, "Drone2"), (-1, 0, -2), 1)
        # In the global frame they are where their starts and ways put them.
        self.assertNear(client.simGetObjectPose("Drone2").position, (1, 2, -2), 1.1)
        self.assertTrue(client.simAddVehicle("Drone3", "SimpleFlight", airsim.Pose(airsim.Vector3r(-3, 3, -1))))
        self.assertFalse(client.simAddVehicle("Drone3", "SimpleFlight", airsim.Pose()))
        self.assertEqual(client.listVehicles()[-1], "Drone3")
        self.assertEqual(len(client.simGetImages([airsim.ImageRequest("0", 0)], "Drone3")), 1)


class Mixed(FlightTest):
    """Drones beside a vehicle that only looks."""
    settings = {"ClockSpeed": 8, "Vehicles": {"Drone1": {"VehicleType": "SimpleFlight"},
                                              "Eye": {"VehicleType": "ComputerVision", "X": -2, "Y": 1, "Z": -2,
                                                      "Cameras": {"own": {"CaptureSettings": [{"ImageType": 0, "Width": 40, "Height": 30}]}}},
                                              "Wall": {"VehicleType": "SimpleFlight", "X": 0, "Y": 5}}}

    def test_a_drone_is_added_beside_one_that_only_looks(self):
        client = self.client()
        eye = client.simGetVehiclePose("Eye")
        client.simAddDetectionFilterMeshName("own", 0, "New*", "Eye")
        client.simSetDetectionFilterRadius("own", 0, 50 * 100, "Eye")
        self.assertTrue(client.simAddVehicle("New1", "SimpleFlight", airsim.Pose(airsim.Vector3r(-2, -2, -1))))
        self.assertEqual(set(client.listVehicles()), {"Drone1", "Eye", "Wall", "New1"})
        # The one that looks is where it was, with its camera and its filter.
        self.assertNear(client.simGetVehiclePose("Eye").position, tuple(eye.position), 1e-3)
        image = client.simGetImages([airsim.ImageRequest("own", 0, False, False)], "Eye")[0]
        self.assertEqual((image.width, image.height), (40, 30))
        client.simSetVehiclePose(airsim.Pose(airsim.Vector3r(0, 0, 0), airsim.to_quaternion(0, 0, 0)), True, "Eye")
        # The new one flies.
        client.enableApiControl(True, "New1")
        client.armDisarm(True, "New1")
        self.assertTrue(client.takeoffAsync(vehicle_name="New1").get())
        self.assertTrue(client.moveToPositionAsync(0.5, 0, -2, 1, vehicle_name="New1").get())
        self.assertNear(position(client, "New1"), (0.5, 0, -2), 1)
        self.assertFalse(client.simAddVehicle("Car", "PhysXCar", airsim.Pose()))
        self.assertIn("'Car' was not added: there are vehicles of type SimpleFlight alone", self.server.messages())

    def test_a_start_in_a_wall_is_told_with_the_nearest_free_place(self):
        log = self.server.messages()
        self.assertRegex(log, r"vehicle 'Wall' starts (in something or against it|over no ground) at X 0\.00, Y 5\.00, .*"
                              r"the nearest free place found is X -?[0-9.]+, Y 4\.[0-9]+")
        self.assertNotIn("vehicle 'Drone1' starts", log)

    def test_a_goal_outside_the_room_is_told(self):
        client = self.client()
        client.enableApiControl(True)
        client.armDisarm(True)
        client.moveToPositionAsync(1, 1, -2, 5).join()
        self.assertNotIn("lies outside the world", self.server.messages())
        move = client.moveToPositionAsync(-10, 10, -10, 5)
        client.cancelLastTask()
        move.join()
        self.assertIn("a goal of vehicle 'Drone1' lies outside the world, which in its frame reaches from (", self.server.messages())


class GpuLidar(ServerTest):
    settings = {"SettingsVersion": 2.0, "Vehicles": {"Drone1": {"VehicleType": "SimpleFlight", "Sensors": {
        "gpu": {"SensorType": 8, "NumberOfChannels": 4, "MeasurementsPerCycle": 90, "Range": 30, "VerticalFOVUpper": 10, "VerticalFOVLower": -10,
                "GenerateNoise": True, "MinNoiseStandardDeviation": 0.01, "NoiseDistanceScale": 3, "DrawSensor": False, "DataFrame": "SensorLocalFrame"},
        "exact": {"SensorType": 6, "NumberOfChannels": 4, "MeasurementsPerCycle": 90, "Range": 30, "VerticalFOVUpper": 10, "VerticalFOVLower": -10,
                  "DataFrame": "SensorLocalFrame"},
        "huge": {"SensorType": 8, "NumberOfChannels": 1024, "MeasurementsPerCycle": 36000},
        "sonar": {"SensorType": 7, "NumberOfTraces": 100}}}}}
    arguments = ("--lockstep",)

    def ranges(self, method, name, width):
        cloud = self.raw().call(method, name, "")["point_cloud"]
        points = np.array(cloud, np.float32).reshape(-1, width)[:, :3]
        return np.linalg.norm(points, axis=1)

    def test_it_measures_as_many_points_as_asked_for_with_the_noise_asked_for(self):
        exact = self.ranges("getLidarData", "exact", 3)
        noisy = self.ranges("getGPULidarData", "gpu", 5)
        self.assertEqual((len(exact), len(noisy)), (360, 360))
        expected = 0.01 + exact / 30 * (0.03 - 0.01)
        normal = (noisy - exact) / expected
        # 360 normal numbers: mean and deviation within four of their own.
        self.assertLess(abs(np.mean(normal)), 4 / np.sqrt(360))
        self.assertLess(abs(np.std(normal) - 1), 4 / np.sqrt(720))
        # Without a name: the first of its kind.
        np.testing.assert_array_equal(self.ranges("getGPULidarData", "", 5), noisy)
        np.testing.assert_array_equal(self.ranges("getLidarData", "", 3), exact)

    def test_one_with_too_many_points_is_refused_before_it_measures(self):
        self.assertError(lambda: self.raw().call("getGPULidarData", "huge", ""), "of at most 320 MiB", "fewer points")

    def test_sensors_that_there_are_not_are_told_and_the_rest_works(self):
        self.assertIn("there are no sensors of type 7", self.server.messages())
        self.assertError(lambda: self.raw().call("getLidarData", "sonar", ""), "No lidar with name sonar")


class ReinforcementLearning(FlightTest):
    def test_the_loop_of_a_training_environment(self):
        client = self.client()
        for _ in range(2):
            client.reset()
            client.enableApiControl(True)
            client.armDisarm(True)
            client.moveToPositionAsync(0, 0, -2, 2).join()
            client.moveByVelocityAsync(0, 0, 0, 0.2).join()
            for velocity in [(1, 0, 0), (0, 1, 0), (0, 0, -0.5)]:
                client.moveByVelocityAsync(*velocity, 0.5).join()
                response = client.simGetImages([airsim.ImageRequest("0", airsim.ImageType.DepthPerspective, True, False)])[0]
                depth = airsim.list_to_2d_float_array(response.image_data_float, response.width, response.height)
                self.assertTrue(np.all((depth > 0) & (depth < 20)))
                client.getMultirotorState()
                client.simGetCollisionInfo()


class Fly360(FlightTest):
    settings = {}

    def test_panorama_loop_holds_its_height(self):
        client = self.flying()
        raw = client.client
        self.assertTrue(raw.call("simSetPanoramaResolution", "panorama_original", 448, 224, ""))
        client.setAngleRateControllerGains()
        client.setAngleLevelControllerGains()
        client.moveToPositionAsync(0, 0, -2, 2).join()
        heights = []
        for _ in range(8):
            self.assertTrue(raw.call("simTriggerPanoramaCapture", "panorama_original", ""))
            color, depth = client.simGetImages([airsim.ImageRequest("panorama_original", airsim.ImageType.Scene, False, False),
                                                airsim.ImageRequest("panorama_depth", airsim.ImageType.Scene, True, False)])
            self.assertEqual((color.width, color.height, depth.width), (448, 224, 448))
            self.assertEqual(color.time_stamp, depth.time_stamp)
            heights.append(position(client).z_val)
            client.moveByRollPitchYawThrottleAsync(0, 0, 0, 0.587, 0.1)
            time.sleep(0.05)
        self.assertLess(max(heights) - min(heights), 1)


if __name__ == "__main__":
    unittest.main()
