"""360 degree videos of flights and datasets: what is decoded is what was rendered, and it says that it is a sphere."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, run, tree

ROOM = ["--world", "box_room", "--size", "256x128"]


def probe(path):
    """What ffprobe sees: the stream, and the times of its frames in seconds."""
    shown = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_streams", "-show_entries", "frame=pts_time", str(path)],
                           capture_output=True, text=True, check=True)
    seen = json.loads(shown.stdout)
    return seen["streams"][0], [float(frame["pts_time"]) for frame in seen["frames"]]


def psnr(video, pictures):
    """dB of each decoded frame against the pictures (a pattern like rgb/%06d.png), by ffmpeg's own filter."""
    shown = subprocess.run(["ffmpeg", "-v", "error", "-i", str(video), "-i", str(pictures), "-lavfi",
                            "[0:v]settb=1/25,setpts=N,scale=in_color_matrix=bt709:in_range=limited:"
                            "flags=bicubic+accurate_rnd+full_chroma_int,format=rgb24[a];"
                            "[1:v]settb=1/25,setpts=N,format=rgb24[b];[a][b]psnr=f=-", "-f", "null", "-"], capture_output=True, text=True, check=True)
    return [float(word[9:]) for line in shown.stdout.splitlines() for word in line.split() if word.startswith("psnr_avg:")]


@unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed (apt-get install ffmpeg)")
class Videos(ProgramTest):
    def test_the_video_of_a_dataset_shows_its_pictures_at_their_times(self):
        out = self.folder / "a"
        self.run_ok("collect", *ROOM, "--frames", "6", "--format", "native,video", "--out", out)
        self.run_ok("verify", out)
        stream, times = probe(out / "video.mp4")
        self.assertEqual((stream["width"], stream["height"], stream["codec_name"]), (256, 128, "h264"))
        self.assertEqual([stream[key] for key in ("pix_fmt", "color_range", "color_space", "color_primaries", "color_transfer")],
                         ["yuv420p", "tv", "bt709", "bt709", "bt709"])
        sides = {side["side_data_type"]: side for side in stream["side_data_list"]}
        self.assertEqual(sides["Spherical Mapping"]["projection"], "equirectangular")
        frames = [json.loads(line)["t_ns"] * 1e-9 for line in (out / "frames.jsonl").read_text().splitlines()]
        self.assertEqual(len(times), 6)
        for shown, taken in zip(times, frames):
            self.assertAlmostEqual(shown, taken - frames[0], delta=2e-5)
        values = psnr(out / "video.mp4", out / "rgb/%06d.png")
        self.assertEqual(len(values), 6)
        self.assertGreater(min(values), 34)

    def test_the_same_bytes_whatever_interrupts_it(self):
        arguments = ["collect", *ROOM, "--frames", "6", "--format", "video"]
        self.run_ok(*arguments, "--out", self.folder / "a")
        process = subprocess.Popen([PROGRAM, *arguments, "--threads", "1", "--out", str(self.folder / "b")], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        time.sleep(0.4)
        process.kill()
        process.wait()
        self.run_ok(*arguments, "--threads", "1", "--out", self.folder / "b")
        self.assertEqual(tree(self.folder / "a"), tree(self.folder / "b"))

    def test_a_flight_is_filmed_evenly_and_flies_as_without_a_camera(self):
        script = ["--script", "takeoff 1.5; hover 0.5", "--seed", "4"]
        plain = json.loads(self.run_ok("fly", *ROOM, *script, "--json", "--out", self.folder / "a").stdout)
        video = self.folder / "deep" / "flight.mp4"
        result = self.run_ok("fly", *ROOM, *script, "--json", "--video", video, "--fps", "10", "--out", self.folder / "b")
        filmed = json.loads(result.stdout)
        self.assertRegex(result.stderr, rf"(?m)^video: {filmed['video']['pictures']} pictures of \d+x\d+, some \d+:\d\d$")
        self.assertEqual(plain["state_hash"], filmed["state_hash"])
        self.assertEqual(tree(self.folder / "a"), tree(self.folder / "b"))
        _, times = probe(video)
        self.assertEqual(len(times), int(filmed["flight_s"] * 10 + 1e-6) + 1)
        self.assertEqual(filmed["video"]["pictures"], len(times))
        for i, t in enumerate(times):
            self.assertAlmostEqual(t, i / 10, delta=2e-5)

    def test_a_video_of_a_dataset_that_is_there(self):
        out = self.folder / "a"
        self.run_ok("collect", *ROOM, "--frames", "3", "--rgb-format", "jpg", "--out", out)
        video = self.folder / "v.mp4"
        report = json.loads(self.run_ok("video", out, "--out", video, "--fps", "12.5", "--encoder", "libx264", "--json").stdout)
        self.assertEqual((report["pictures"], report["encoder"]), (3, "libx264"))
        self.assertAlmostEqual(report["seconds"], 3 / 12.5)
        self.assertEqual(probe(video)[1], [0, 0.08, 0.16])

    def test_frames_by_rate(self):
        out, route = self.folder / "a", self.folder / "route.csv"
        route.write_text("x,y,z,t\n-2,0,2,0\n2,0,2,2\n")
        self.run_ok("collect", *ROOM, "--route", route, "--fps", "5", "--tier", "labels", "--out", out)
        times = [json.loads(line)["t_ns"] for line in (out / "frames.jsonl").read_text().splitlines()]
        self.assertEqual(times, [k * 200_000_000 for k in range(11)])
        self.run_ok("collect", *ROOM, "--route", route, "--fps", "5", "--frames", "3", "--tier", "labels", "--out", self.folder / "b")
        first = [json.loads(line)["t_ns"] for line in (self.folder / "b" / "frames.jsonl").read_text().splitlines()]
        self.assertEqual(first, times[:3])

    def test_an_interrupted_video_leaves_nothing(self):
        folder = self.folder / "v"
        folder.mkdir()
        for sign in (signal.SIGINT, signal.SIGKILL):
            process = subprocess.Popen([PROGRAM, "fly", *ROOM, "--script", "hover 60", "--video", str(folder / "a.mp4"), "--out",
                                        str(self.folder / "o")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(1)
            self.assertIsNone(process.poll(), "it still films")
            process.send_signal(sign)
            process.wait()
            self.assertEqual(list(folder.iterdir()), [], sign)

    def test_what_is_wrong_is_named(self):
        out = self.folder / "a"
        for arguments, says in [
            (["collect", *ROOM, "--format", "video", "--tier", "labels", "--out", out], ["--format", "labels"]),
            (["collect", "--world", "box_room", "--size", "8x4", "--format", "video", "--out", out], ["8x4", "16"]),
            (["fly", *ROOM, "--video", self.folder / "v.mp4", "--encoder", "x264", "--out", out], ["--encoder", "libx264"]),
            (["fly", *ROOM, "--video", self.folder / "v.mp4", "--quality", "60", "--out", out], ["--quality", "60"]),
            (["fly", *ROOM, "--video", self.folder / "v.mp4", "--tier", "labels", "--out", out], ["--video", "labels"]),
            (["fly", *ROOM, "--video", self.folder / "v.webm", "--out", out], ["v.webm", "did you mean", "v.mp4"]),
            (["video", self.folder, "--out", self.folder / "v.mp4"], ["not a dataset"]),
        ]:
            self.run_bad(2, *arguments, says=says)
        self.assertFalse(out.exists())
        self.run_ok("collect", *ROOM, "--frames", "1", "--tier", "labels", "--out", out)
        self.run_bad(2, "video", out, "--out", self.folder / "v.mp4", says=["no colour"])
        self.run_ok("render", *ROOM[:2], "--size", "64x64", "--projection", "cube", "--out", self.folder / "cube")
        self.run_bad(2, "video", self.folder / "cube", "--out", self.folder / "v.mp4", says=["no colour picture, or several"])


class WithoutFfmpeg(ProgramTest):
    def test_the_package_is_named_before_anything_is_written(self):
        environment = {**os.environ, "PATH": str(self.folder)}
        environment.pop("AIRSIM360_FFMPEG", None)
        out = self.folder / "a"
        for arguments in (["collect", *ROOM, "--format", "video", "--out", out], ["fly", *ROOM, "--video", self.folder / "v.mp4", "--out", out],
                          ["video", out, "--out", self.folder / "v.mp4"]):
            self.run_bad(2, *arguments, says=["apt-get install ffmpeg"], env=environment)
        self.assertFalse(out.exists())

    def test_what_ffmpeg_says_is_told(self):
        stub = self.folder / "ffmpeg"
        stub.write_text("#!/bin/sh\necho 'no such codec' >&2\nexit 1\n")
        stub.chmod(0o755)
        environment = {**os.environ, "AIRSIM360_FFMPEG": str(stub)}
        result = run("fly", *ROOM, "--script", "takeoff 1", "--encoder", "libx264", "--video", self.folder / "v.mp4", "--out", self.folder / "a",
                     env=environment)
        self.assertEqual(result.returncode, 1)
        self.assertIn("airsim360: error: ffmpeg (libx264): no such codec\n", result.stderr)
        self.assertFalse((self.folder / "v.mp4").exists())


if __name__ == "__main__":
    unittest.main()
