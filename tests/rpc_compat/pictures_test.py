"""Pictures, depths, labels and ray sensors against what box_room's walls must give."""
import math
import unittest

import numpy as np

from harness import ServerTest

import airsim360.airsim as airsim



class RoomTest(ServerTest):
    settings = {"Vehicles": {"Drone1": {
        "VehicleType": "SimpleFlight",
        "Cameras": {"small": {"X": 0, "Y": 0, "Z": 0, "CaptureSettings": [{"ImageType": 0, "Width": 64, "Height": 64, "FOV_Degrees": 60}]}},
        "Sensors": {"Lidar1": {"SensorType": 6, "Range": 30, "X": 0, "Y": 0, "Z": 0, "VerticalFOVUpper": 10, "VerticalFOVLower": -10,
                               "DataFrame": "SensorLocalFrame", "NumberOfChannels": 5},
                    "Down": {"SensorType": 5, "Pitch": -90}}}}}
    arguments = ("--lockstep",)

    def setUp(self):
        self.airsim = self.client()
        self.airsim.reset()

    def put(self, x, y, z, yaw=0.0):
        """Puts the drone at a place of the world (east, north, up), facing `yaw` clockwise from north."""
        # The cube's centre is at (3, 0, 0.5): that gives the origin of the global frame.
        box = self.airsim.simGetObjectPose("box").position
        drone = self.airsim.simGetObjectPose("Drone1").position - self.airsim.simGetVehiclePose().position
        north, east, down = y + box.x_val, x - 3 + box.y_val, 0.5 - z + box.z_val
        place = airsim.Vector3r(north, east, down) - drone
        self.airsim.simSetVehiclePose(airsim.Pose(place, airsim.to_quaternion(0, 0, yaw)), True)

    def picture(self, camera, kind, as_float=True):
        response = self.airsim.simGetImages([airsim.ImageRequest(camera, kind, as_float, False)])[0]
        if as_float:
            return airsim.get_pfm_array(response)
        return np.frombuffer(response.image_data_uint8, np.uint8).reshape(response.height, response.width, 3)


class OnAGpu(RoomTest):
    arguments = ("--lockstep", "--device", "vulkan")

    @classmethod
    def setUpClass(cls):
        try:
            super().setUpClass()
        except RuntimeError as error:
            raise unittest.SkipTest(str(error))

    def test_depth_of_a_wall_is_that_of_the_cpu(self):
        self.put(0, 0, 3)
        planar = self.picture("0", 1)
        np.testing.assert_allclose(planar[60:84, 8:248], 4.75, rtol=1e-3)


class Depths(RoomTest):
    def test_planar_and_perspective_depth_of_a_wall(self):
        self.put(0, 0, 3)  # the north wall is 5 m ahead, the camera 0.25 m in front of the middle
        planar, perspective = self.picture("0", 1), self.picture("front_center", 2)
        self.assertEqual(planar.shape, (144, 256))
        np.testing.assert_allclose(planar[60:84, 8:248], 4.75, rtol=1e-3)
        u = (np.arange(256) + 0.5 - 128) / 128
        np.testing.assert_allclose(perspective[72, 8:248], (4.75 * np.sqrt(1 + u**2 + (0.5 / 128)**2))[8:248], rtol=2e-3)

    def test_stock_floats_are_halves_ours_are_exact(self):
        self.put(0, 0, 3)
        raw = self.raw()
        request = {"camera_name": "0", "image_type": 2, "pixels_as_float": True, "compress": False}
        stock = np.array(raw.call("simGetImages", [request], "", False)[0]["image_data_float"], np.float32)
        ours = self.picture("0", 2).ravel()
        np.testing.assert_array_equal(stock, ours.astype(np.float16).astype(np.float32))
        self.assertTrue(np.any(stock != ours))

    def test_shades_and_disparity_follow_from_depth(self):
        self.put(0, 0, 3)
        self.assertAlmostEqual(self.picture("0", 3)[72, 128], 0.0475, places=4)
        self.assertAlmostEqual(self.picture("0", 4)[72, 128], 0.25 * 128 / 4.75 / 256, places=4)
        self.assertEqual(set(self.picture("0", 3, False)[72, 128]), {12})

    def test_cameras_can_be_turned_and_widened(self):
        self.put(0, 0, 3)
        self.airsim.simSetCameraPose("0", airsim.Pose(airsim.Vector3r(0, 0, 0), airsim.to_quaternion(-math.pi / 2, 0, 0)))
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 3, places=2)
        self.airsim.simSetCameraPose("0", airsim.Pose(airsim.Vector3r(0.25, 0, 0), airsim.to_quaternion(0, 0, 0)))
        self.airsim.simSetCameraFov("0", 60)
        self.assertEqual(self.airsim.simGetCameraInfo("0").fov, 60)
        u = (255.5 - 128) / (128 / math.tan(math.radians(30)))
        self.assertAlmostEqual(self.picture("0", 2)[72, 255], 4.75 * math.sqrt(1 + u * u), places=2)
        self.airsim.simSetCameraFov("0", 90)

    def test_own_cameras_have_their_own_size(self):
        response = self.airsim.simGetImages([airsim.ImageRequest("small", 0, False, False)])[0]
        self.assertEqual((response.width, response.height), (64, 64))


class Panoramas(RoomTest):
    def test_range_all_round(self):
        self.airsim.simSetPanoramaResolution("panorama_original", 512, 256)
        self.put(1, 0, 3)
        self.airsim.simTriggerPanoramaCapture("panorama_original")
        depth = self.picture("panorama_depth", 0)
        self.assertEqual(depth.shape, (256, 512))
        for column, expected in [(256, 5), (384, 4), (0, 5), (128, 6)]:  # north, east, south, west
            self.assertAlmostEqual(depth[128, column], expected, delta=0.01)
        self.assertAlmostEqual(depth[0, 0], 3, delta=0.01)
        self.assertAlmostEqual(depth[255, 0], 3, delta=0.01)

    def test_everything_is_of_the_instant_of_the_trigger(self):
        self.put(1, 0, 3)
        self.airsim.simTriggerPanoramaCapture("panorama_original")
        triggered = self.airsim.getMultirotorState().timestamp
        self.airsim.simContinueForTime(0.5)
        self.put(-2, 0, 3)
        responses = self.airsim.simGetImages([airsim.ImageRequest(name, 0, False, False)
                                              for name in ("panorama_original", "panorama_seg", "panorama_entity", "panorama_normal")])
        self.assertEqual({response.time_stamp for response in responses}, {triggered})
        self.assertEqual({tuple(response.camera_position) for response in responses}, {tuple(responses[0].camera_position)})

    def test_entities_are_the_seven_of_the_room(self):
        self.put(-1, 0, 3)
        self.airsim.simTriggerPanoramaCapture("panorama_entity")
        bgr = self.picture("panorama_entity", 0, False).astype(int)
        ids = set((bgr[:, :, 2] + 256 * bgr[:, :, 1] + 65536 * bgr[:, :, 0]).ravel())
        self.assertGreaterEqual(len(ids), 7)

    def test_normals_point_at_the_camera(self):
        self.put(0, 0, 3)
        self.airsim.simTriggerPanoramaCapture("panorama_normal")
        bgr = self.picture("panorama_normal", 0, False)
        height, width = bgr.shape[:2]
        np.testing.assert_allclose(bgr[height // 2, width // 2], (128, 128, 0), atol=1)   # north wall: its normal looks south
        np.testing.assert_allclose(bgr[height - 1, 0], (255, 128, 128), atol=1)           # floor: up


class Labels(RoomTest):
    def test_segmentation_ids_and_their_colours(self):
        self.assertEqual(self.airsim.simGetSegmentationObjectID("no such thing"), -1)
        self.assertFalse(self.airsim.simSetSegmentationObjectID("no such thing", 3))
        self.assertTrue(self.airsim.simSetSegmentationObjectID(".*", 0, True))
        self.assertTrue(self.airsim.simSetSegmentationObjectID("BOX", 20, True), "patterns take either case")
        self.assertEqual(self.airsim.simGetSegmentationObjectID("box"), 20)
        self.put(0, 0, 0.5, math.pi / 2)
        picture = self.picture("0", airsim.ImageType.Segmentation, False)
        colours = {tuple(pixel) for pixel in picture.reshape(-1, 3)}
        self.assertEqual(len(colours), 2)
        self.assertEqual(set(self.picture("0", airsim.ImageType.Infrared, False)[72, 128]), {20})
        self.assertTrue(self.airsim.simSetSegmentationObjectID("box", 70000), "ours: more than 255")
        self.assertEqual(tuple(self.picture("0", 5, False)[72, 128]), (1, 17, 112))

    def test_objects_are_listed_found_and_seen(self):
        names = self.airsim.simListSceneObjects()
        self.assertIn("box", names)
        self.assertIn("box", self.airsim.simListSceneObjects("bo.*"))
        self.assertTrue(math.isnan(self.airsim.simGetObjectPose("nothing").position.x_val))
        self.put(0, 0, 0.5, math.pi / 2)
        self.airsim.simAddDetectionFilterMeshName("0", 0, "bo*")
        self.airsim.simSetDetectionFilterRadius("0", 0, 200 * 100)
        found = self.airsim.simGetDetections("0", 0)
        self.assertEqual([item.name for item in found], ["box"])
        box = found[0].box2D
        self.assertLess(box.min.x_val, 128)
        self.assertGreater(box.max.x_val, 128)
        self.assertAlmostEqual(found[0].relative_pose.position.x_val, 3 - 0.25, delta=0.01)
        self.assertAlmostEqual(found[0].box3D.min.x_val, 2.5 - 0.25, delta=0.01)
        # The visible face is 1 m wide and 2.25 m away.
        self.assertAlmostEqual(box.max.x_val - box.min.x_val, 128 / 2.25, delta=2)
        self.airsim.simClearDetectionMeshNames("0", 0)
        self.assertEqual(self.airsim.simGetDetections("0", 0), [])

    def test_the_relative_pose_of_a_detection_is_that_of_object_and_camera(self):
        c = self.airsim
        box = c.simGetObjectPose("box").position
        c.simAddDetectionFilterMeshName("0", 0, "target")
        c.simSetDetectionFilterRadius("0", 0, 200 * 100)
        self.put(0, 0, 0.5, 0)
        camera_mount = c.simGetCameraInfo("0").pose
        for object_yaw in (0, 30, 90, -135):
            for camera_yaw in (0, 30, -45):
                for pitch, roll in ((0, 0), (20, -10)):
                    case = (object_yaw, camera_yaw, pitch, roll)
                    turn = airsim.to_quaternion(math.radians(pitch), math.radians(roll), math.radians(object_yaw))
                    # North of the drone, which looks north.
                    place = airsim.Vector3r(camera_mount.position.x_val + 2, camera_mount.position.y_val, camera_mount.position.z_val)
                    self.put(0, 0, 0.5, 0)
                    start = c.simGetVehiclePose().position
                    world = c.simGetObjectPose("Drone1").position
                    place = place + (world - start)
                    self.assertEqual(c.simSpawnObject("target", "Cube", airsim.Pose(place, turn), airsim.Vector3r(.4, .4, .4)), "target")
                    self.put(0, 0, 0.5, math.radians(camera_yaw))
                    found = c.simGetDetections("0", 0)
                    self.assertEqual([item.name for item in found], ["target"], case)
                    camera, thing = c.simGetCameraInfo("0").pose, c.simGetObjectPose("target")
                    expected = camera.orientation.inverse() * thing.orientation
                    relative = found[0].relative_pose
                    self.assertAlmostEqual(abs(expected.dot(relative.orientation)), 1, delta=1e-5, msg=str(case))
                    # And the vector from camera to object, in the frame of the camera.
                    way = thing.position - (camera.position + (world - start))
                    turned = camera.orientation.inverse() * airsim.Quaternionr(way.x_val, way.y_val, way.z_val, 0) * camera.orientation
                    np.testing.assert_allclose(relative.position.to_numpy_array(), [turned.x_val, turned.y_val, turned.z_val], atol=2e-3, err_msg=str(case))
                    self.assertTrue(c.simDestroyObject("target"))
        c.simClearDetectionMeshNames("0", 0)

    def test_an_object_can_be_moved_and_taken_away(self):
        pose = self.airsim.simGetObjectPose("box")
        self.put(0, 0, 0.5, math.pi / 2)
        before = self.picture("0", 1)[72, 128]
        self.assertAlmostEqual(before, 2.25, delta=0.01)
        if not self.airsim.simSetObjectPose("box", airsim.Pose(pose.position + airsim.Vector3r(0, 1, 0), pose.orientation)):
            self.skipTest("the cube is part of a larger mesh")
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 3.25, delta=0.01)
        self.assertTrue(self.airsim.simSetObjectPose("box", pose))
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], before, delta=0.01)

    def test_lines_of_sight(self):
        self.put(0, 0, 0.5)
        extents = self.airsim.simGetWorldExtents()
        self.assertEqual(len(extents), 2)
        here = self.airsim.getMultirotorState().gps_location
        self.assertTrue(self.airsim.simTestLineOfSightBetweenPoints(
            here, airsim.GeoPoint(latitude=here.latitude + 2e-5, longitude=here.longitude, altitude=here.altitude)))
        behind_box = airsim.GeoPoint(latitude=here.latitude, longitude=here.longitude + 4 / 75e3, altitude=here.altitude)
        self.assertFalse(self.airsim.simTestLineOfSightToPoint(behind_box))


class Added(RoomTest):
    """What calls add to the world is seen, named, met and taken away again."""

    def place(self, x, y, z):
        """East, north, up as a pose of the global frame."""
        box = self.airsim.simGetObjectPose("box").position
        return airsim.Pose(airsim.Vector3r(y + box.x_val, x - 3 + box.y_val, 0.5 - z + box.z_val), airsim.Quaternionr())

    def test_objects_are_spawned_where_and_as_large_as_asked(self):
        c = self.airsim
        self.assertIn("Cube", c.simListAssets())
        before = c.simListSceneObjects()
        self.put(0, 0, 3)
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 4.75, delta=0.01)
        self.assertEqual(c.simSpawnObject("thing", "Cube", self.place(0, 3, 3), airsim.Vector3r(2, 2, 2)), "thing")
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 1.75, delta=0.01)
        self.assertEqual(set(c.simListSceneObjects()) - set(before), {"thing"})
        np.testing.assert_allclose(c.simGetObjectPose("thing").position.to_numpy_array(), self.place(0, 3, 3).position.to_numpy_array(), atol=1e-3)
        # A name that is taken gets a number; shapes are what they are called.
        self.assertEqual(c.simSpawnObject("thing", "Sphere", self.place(0, 1.5, 3), airsim.Vector3r(1, 1, 1)), "thing2")
        self.assertAlmostEqual(self.picture("0", 2)[72, 128], 0.75, delta=0.01)
        self.assertTrue(c.simDestroyObject("thing2"))
        # A drone meets it.
        self.put(0, 1.95, 3)
        c.simContinueForTime(0.1)
        self.assertEqual(c.simGetCollisionInfo().object_name, "thing")
        self.assertTrue(c.simDestroyObject("thing"))
        self.put(0, 0, 3)
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 4.75, delta=0.01)
        self.assertEqual(c.simListSceneObjects(), before)
        raw = self.raw()
        point = {"x_val": 0.0, "y_val": 0.0, "z_val": 0.0}
        pose = {"position": point, "orientation": {"w_val": 1.0, "x_val": 0.0, "y_val": 0.0, "z_val": 0.0}}
        scale = {"x_val": 1.0, "y_val": 1.0, "z_val": 1.0}
        self.assertError(lambda: raw.call("simSpawnObject", "a", "Teapot", pose, scale, False, False),
                         "There were no assets with name Teapot found in the Registry")
        for _ in range(128):
            raw.call("simSpawnObject", "a", "Cone", pose, scale, False, False)
        self.assertError(lambda: raw.call("simSpawnObject", "a", "Cone", pose, scale, False, False), "All 128 objects of asset Cone")

    def test_a_course_of_hundreds_of_cubes_is_built_seen_and_cleared(self):
        c = self.airsim
        before = c.simListSceneObjects()
        names = []
        for i in range(300):
            names.append(c.simSpawnObject("post", "Cube", self.place(-4 + 8 * (i % 20) / 19, -4 + 8 * (i // 20) / 14, 3), airsim.Vector3r(.1, .1, .1)))
        self.assertEqual(len(set(names)), 300)
        self.assertEqual(set(c.simListSceneObjects()) - set(before), set(names))
        self.put(-4, -4.5, 3)
        self.assertAlmostEqual(self.picture("0", 1)[72, 128], 0.5 - 0.25 - 0.05, delta=0.01)
        for name in names:
            self.assertTrue(c.simDestroyObject(name))
        self.assertEqual(c.simListSceneObjects(), before)

    def test_a_drone_that_is_added_later_is_seen_by_the_others(self):
        c = self.airsim
        self.put(-2, 0, 0.2)
        c.simAddDetectionFilterMeshName("0", 0, "Late*")
        c.simSetDetectionFilterRadius("0", 0, 200 * 100)
        self.assertEqual(c.simGetDetections("0", 0), [])
        self.assertTrue(c.simAddVehicle("Late1", "SimpleFlight", self.place(-2, 2, 0.5)))
        found = c.simGetDetections("0", 0)
        self.assertEqual([item.name for item in found], ["Late1"])
        self.assertAlmostEqual(found[0].relative_pose.position.x_val, 2 - 0.25, delta=0.05)
        c.simClearDetectionMeshNames("0", 0)


class Rays(RoomTest):
    def test_lidar_points_are_on_the_walls(self):
        self.put(0, 0, 3)
        data = self.airsim.getLidarData("Lidar1")
        points = np.array(data.point_cloud, np.float32).reshape(-1, 3)
        self.assertGreater(len(points), 1000)
        self.assertEqual(len(data.segmentation), len(points))
        distance = np.max(np.abs(points[:, :2]), axis=1)
        np.testing.assert_allclose(distance, 5, atol=0.02)
        self.assertEqual(self.airsim.getLidarData().time_stamp, self.airsim.getMultirotorState().timestamp)

    def test_distance_to_the_floor(self):
        self.put(0, 0, 3)
        data = self.airsim.getDistanceSensorData("Down")
        self.assertAlmostEqual(data.distance, 3, delta=0.01)
        self.assertEqual((round(data.min_distance, 3), data.max_distance), (0.2, 40))


class WorldCalls(RoomTest):
    def test_weather_wind_plots_and_the_rest_answer(self):
        c = self.airsim
        c.simSetWind(airsim.Vector3r(3, 0, 0))
        c.simSetWind(airsim.Vector3r())
        c.simEnableWeather(True)
        c.simSetWeatherParameter(airsim.WeatherParameter.Fog, 0.2)
        c.simEnableWeather(False)
        points = [airsim.Vector3r(x, 0, -1) for x in range(3)]
        c.simPlotPoints(points)
        c.simPlotLineStrip(points, is_persistent=True)
        c.simPlotLineList(points[:2])
        c.simPlotArrows(points, points)
        c.simPlotStrings(["a"], points[:1])
        c.simPlotTransforms([airsim.Pose()])
        c.simPlotTransformsWithNames([airsim.Pose()], ["a"])
        c.simFlushPersistentMarkers()
        c.simSetTraceLine([1.0, 0.0, 0.0, 1.0])
        self.assertFalse(c.simRunConsoleCommand("stat fps"))
        self.assertEqual(c.simSwapTextures("box", 0), [])
        self.assertEqual(c.simGetPresetLensSettings("0"), [])
        self.assertIn("Vehicles", c.getSettingsString())
        self.assertFalse(c.isRecording())

    def test_time_of_day_is_set(self):
        self.airsim.simSetTimeOfDay(True, "2018-06-12 12:00:00")
        self.assertTrue(self.airsim.simGetImage("0", 0).startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
