"""Weather by calls: what changes nothing costs nothing, and a picture does not know which way its weather came about."""
import os
import tempfile
import unittest

from harness import RawClient, ServerTest

RAIN, WETNESS, SNOW, ROAD_SNOW, MAPLE, ROAD_LEAF, DUST, FOG = range(8)

FIELD = """v -100 0 -100
v 100 0 -100
v 100 0 100
v -100 0 100
v -5 0 -12
v 5 0 -12
v 5 6 -12
v -5 6 -12
f 4 3 2 1
f 5 6 7 8
"""


class FieldTest(ServerTest):
    arguments = ("--lockstep", "--clouds", "clear")  # each weather has a sky of its own: those without clouds are painted at once

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.world = os.path.join(cls.place.name, "field.obj")
        with open(cls.world, "w") as file:
            file.write(FIELD)
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        super().tearDownClass()
        cls.place.cleanup()

    def setUp(self):
        self.client = RawClient(self.server.port, timeout=280)
        self.addCleanup(self.client.close)
        self.client.call("simEnableWeather", True)
        for parameter in range(8):
            self.client.call("simSetWeatherParameter", parameter, 0.0)

    def picture(self):
        request = {"camera_name": "0", "image_type": 0, "pixels_as_float": False, "compress": False}
        return self.client.call("simGetImages", [request], "", False)[0]["image_data_uint8"]


class Weather(FieldTest):
    def test_the_same_weather_is_the_same_picture_whichever_way_it_came(self):
        clear = self.picture()
        goals = [{FOG: 0.4}, {RAIN: 0.6, WETNESS: 0.8}, {ROAD_SNOW: 0.7}, {DUST: 0.3}]
        direct = []
        for goal in goals:
            for parameter, value in goal.items():
                self.client.call("simSetWeatherParameter", parameter, value)
            direct.append(self.picture())
            self.assertNotEqual(direct[-1], clear, goal)
            for parameter in goal:
                self.client.call("simSetWeatherParameter", parameter, 0.0)
        self.assertEqual(self.picture(), clear)
        # Again, without clear skies between them and in another order.
        for goal, expected in list(zip(goals, direct))[::-1]:
            for parameter in range(8):
                self.client.call("simSetWeatherParameter", parameter, goal.get(parameter, 0.0))
            self.assertEqual(self.picture(), expected, goal)

    def test_the_time_of_day_ends_and_the_sun_is_the_worlds_again(self):
        first = self.picture()
        self.client.call("simSetTimeOfDay", True, "2021-06-21 06:30:00", False, 1.0, 60.0, True)
        self.assertNotEqual(self.picture(), first)
        self.client.call("simSetTimeOfDay", False, "", False, 1.0, 60.0, True)
        self.assertEqual(self.picture(), first)

    def test_leaves_and_the_same_value_change_nothing(self):
        self.client.call("simSetWeatherParameter", FOG, 0.3)
        foggy = self.picture()
        for parameter, value in [(FOG, 0.3), (MAPLE, 1.0), (ROAD_LEAF, 0.5)]:
            self.client.call("simSetWeatherParameter", parameter, value)
            self.assertEqual(self.picture(), foggy)


class TimeOfDayOfTheSettings(FieldTest):
    settings = {"TimeOfDay": {"Enabled": True, "StartDateTime": "2021-06-21 06:30:00"}}

    def test_the_sun_is_that_of_the_call(self):
        first = self.picture()
        self.client.call("simSetTimeOfDay", False, "", False, 1.0, 60.0, True)
        self.assertNotEqual(self.picture(), first)
        self.client.call("simSetTimeOfDay", True, "2021-06-21 06:30:00", False, 1.0, 60.0, True)
        self.assertEqual(self.picture(), first)


if __name__ == "__main__":
    unittest.main()
