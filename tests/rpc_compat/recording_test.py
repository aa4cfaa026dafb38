"""startRecording … isRecording: what is said is what is written."""
import os
import tempfile
import time
import unittest

from harness import RawClient, Server


class Recording(unittest.TestCase):
    def server(self, folder, **recording):
        server = Server(settings={"Recording": {"RecordInterval": 0.05, "Folder": folder, **recording}})
        self.addCleanup(server.stop)
        client = RawClient(server.port)
        self.addCleanup(client.close)
        return server, client

    def wait(self, client, recording):
        end = time.time() + 30
        while client.call("isRecording") is not recording and time.time() < end:
            time.sleep(0.05)
        return client.call("isRecording") is recording

    def lines(self, folder):
        with open(os.path.join(folder, "airsim_rec.txt")) as file:
            return file.read().splitlines()

    def test_each_recording_has_a_folder_with_a_picture_for_each_line(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            _, client = self.server(place)
            self.assertIs(client.call("isRecording"), False)
            for number in (1, 2):
                client.call("startRecording")
                self.assertIs(client.call("isRecording"), True)
                self.assertEqual(len(os.listdir(place)), number)
                folder = os.path.join(place, max(os.listdir(place), key=lambda name: os.path.getmtime(os.path.join(place, name))))
                end = time.time() + 30
                while len(self.lines(folder)) < 4 and time.time() < end:
                    time.sleep(0.05)
                client.call("stopRecording")
                self.assertIs(client.call("isRecording"), False)
            for name in os.listdir(place):
                lines = [line.split("\t") for line in self.lines(os.path.join(place, name))]
                self.assertEqual(lines[0][0], "VehicleName")
                self.assertGreaterEqual(len(lines), 4)
                for line in lines[1:]:
                    self.assertTrue(os.path.getsize(os.path.join(place, name, "images", line[-1])))

    def test_a_folder_that_cannot_be_made_is_an_error_at_once(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            file = os.path.join(place, "taken")
            open(file, "w").close()
            _, client = self.server(file)
            with self.assertRaises(RuntimeError) as caught:
                client.call("startRecording")
            self.assertIn("cannot create folder", str(caught.exception))
            self.assertIs(client.call("isRecording"), False)
            # Once there is room it records.
            os.remove(file)
            client.call("startRecording")
            self.assertIs(client.call("isRecording"), True)

    def test_one_of_the_settings_that_cannot_start_is_told_and_the_server_runs(self):
        with tempfile.NamedTemporaryFile() as file:
            server, client = self.server(file.name, Enabled=True)
            self.assertIs(client.call("isRecording"), False)
            self.assertIn("nothing is recorded", server.messages())

    def test_it_ends_when_nothing_more_can_be_written(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            server, client = self.server(place)
            client.call("startRecording")
            folder = os.path.join(place, os.listdir(place)[0], "images")
            # Pictures can no longer be made there (root may write anywhere, but not into a file).
            end = time.time() + 30
            while not os.listdir(folder) and time.time() < end:
                time.sleep(0.02)
            os.rename(folder, folder + ".away")
            open(folder, "w").close()
            self.assertTrue(self.wait(client, False))
            self.assertIn("recording has ended", server.messages())


if __name__ == "__main__":
    unittest.main()
