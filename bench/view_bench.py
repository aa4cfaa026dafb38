#!/usr/bin/python3
"""The viewer in a headless Chromium: how soon one sees something, how fast a live world follows the hands, what memory it takes.

    AIRSIM360=build/bin/airsim360 bench/view_bench.py [first live latency many clicks soak] [--world W] [--minutes M] [--json FILE]

Varied: nothing but what each line says. The browser draws in software (SwiftShader) on the same cores as the renderer, so that
rates are those of a machine without a GPU. Rates of pictures are compared with the renderer's own time in the same run.
"""
import argparse
import json
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
os.environ.setdefault("AIRSIM360_CACHE", str(pathlib.Path.home() / ".cache/airsim360"))  # tests build worlds anew; here a cached one counts
ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests/view"), str(ROOT / "tests/end_to_end")]
from browser import Browser  # noqa: E402
from program import read_ids  # noqa: E402
from view_test import WebSocket  # noqa: E402
from viewer import Viewer  # noqa: E402

FIRST = "window.airsim360?.first"


def collect(folder, *arguments):
    done = run_long("collect", *arguments, "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder


def run_long(*arguments):
    return subprocess.run([os.environ["AIRSIM360"], *map(str, arguments)], capture_output=True, text=True, timeout=1800)


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


class Opened:
    """A viewer and the page on it, and how long that took."""

    def __init__(self, page, *arguments):
        begin = time.monotonic()
        self.viewer = Viewer(*arguments)
        self.listening = time.monotonic() - begin
        page.open(self.viewer.address)
        page.wait(FIRST, 300)
        self.seconds = time.monotonic() - begin
        self.page_seconds = page.run("airsim360.first") / 1000

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.viewer.stop()


def first(page, room, world):
    """Seconds from the command to the first picture, and of those the page's own; the second start counts for the world."""
    data = collect(room / "data", "--world", "box_room", "--frames", 20, "--size", "2048x1024", "--products", "normal")
    figures = {}
    for name, arguments in {"dataset": (data,), "world": ("--world", world)}.items():
        for _ in range(2 if name == "world" else 1):
            with Opened(page, *arguments) as opened:
                figures[f"{name}_command_to_picture_s"] = round(opened.seconds, 2)
                figures[f"{name}_page_to_picture_s"] = round(opened.page_seconds, 2)
    return figures


def alone(viewer, width):
    """Milliseconds that the renderer of this viewer takes when nobody draws what it makes."""
    client = WebSocket(viewer.port)
    times = [client.ask({"do": "picture", "width": width})[0]["render_ms"] for _ in range(40)]
    client.close()
    return statistics.mean(times[10:])


def live(page, room, world):
    """Pictures a second in the page: against the renderer's own time while the page draws, and against its time alone, before
    and after."""
    figures = {}
    for width in (1024, 2048):
        with Opened(page, "--world", world) as opened:
            page.open("about:blank")
            lone = [alone(opened.viewer, width)]
            page.open(opened.viewer.address)
            page.wait(FIRST)
            page.run(f"airsim360.live.width = {width}")
            time.sleep(2)
            page.run("airsim360.live.told = airsim360.live.tell; window.seen = []; airsim360.live.tell = function (h, ms, aside) { this.told(h, ms, aside); window.seen.push([performance.now(), h.render_ms, ms]); }; 0")
            time.sleep(10)
            seen = page.run("window.seen")
            page.open("about:blank")
            lone.append(alone(opened.viewer, width))
            rate = 1000 * (len(seen) - 1) / (seen[-1][0] - seen[0][0])
            render = statistics.mean(s[1] for s in seen)
            figures[f"live_{width}"] = {"pictures_per_s": round(rate, 1), "render_ms": round(render, 1), "share_of_renderer": round(rate * render / 1000, 3),
                                        "render_alone_ms": [round(ms, 1) for ms in lone], "share_of_renderer_alone": round(rate * statistics.mean(lone) / 1000, 3)}
    return figures


# Times of real keys, and of the first picture that has what they say.
WATCH_KEYS = """window.seen = []; window.waits = []; window.pressed = null;
    for (const kind of ["keydown", "keyup"])
      addEventListener(kind, () => { if (window.pressed === null) { window.pressed = performance.now(); window.wanted = airsim360.live.steered; } });
    airsim360.live.told = airsim360.live.tell;
    airsim360.live.tell = function (h, ms, aside) { this.told(h, ms, aside); const now = performance.now(); window.seen.push(now);
      if (window.pressed !== null && h.hands >= window.wanted) { window.waits.push(now - window.pressed); window.pressed = null; window.arrived?.(); } }; 0"""


def latency(page, room, world):
    """From a key in the page to the first picture that was taken with what it says: milliseconds."""
    figures = {}
    with Opened(page, "--world", world):
        page.run(WATCH_KEYS)
        for width in (512, 1024):
            page.run(f"airsim360.live.width = {width}")
            time.sleep(2)
            page.run("window.waits = []; window.seen = []; 0")
            random.seed(1)
            for n in range(200):
                time.sleep(random.uniform(0.1, 0.2))
                page.call("Input.dispatchKeyEvent", type="keyUp" if n % 2 else "keyDown", key="qe"[n // 2 % 2])
                page.run("new Promise(done => { window.arrived = done; if (window.pressed === null) done(); }).then(() => 0)")
            waits, seen = page.run("window.waits"), page.run("window.seen")
            assert len(waits) == 200, len(waits)
            frame = statistics.median(b - a for a, b in zip(seen, seen[1:]))
            figures[f"latency_{width}"] = {"frame_ms": round(frame), "median_ms": round(statistics.median(waits)), "p95_ms": round(percentile(waits, 0.95)),
                                           "p95_less_a_frame_ms": round(percentile(waits, 0.95) - frame)}
    return figures


def many(page, room, world):
    """A dataset of 10,000 frames: opened, scrolled, searched."""
    data = collect(room / "many", "--world", "box_room", "--frames", 10000, "--size", "64x32", "--tier", "labels")
    with Opened(page, data) as opened:
        scroll = page.run("""(async () => { const list = document.getElementById('frame-list'), times = [];
            for (let i = 0; i < 200; ++i) { const t = performance.now(); list.scrollTop = (i * 7919 % 10000) * 28; await new Promise(requestAnimationFrame); times.push(performance.now() - t); }
            return times; })()""")
        begin = time.monotonic()
        page.run("airsim360.find('box')")
        return {"frames_10000": {"command_to_picture_s": round(opened.seconds, 2), "page_to_picture_s": round(opened.page_seconds, 2), "scroll_p95_ms": round(percentile(scroll, 0.95), 1),
                                 "rows_in_the_page": page.run("document.querySelectorAll('.frame-row').length"), "search_s": round(time.monotonic() - begin, 2)}}


def clicks(page, room, world):
    """100 clicks, ten at the seam and ten at the poles, against the label files."""
    data = collect(room / "clicked", "--world", "box_room", "--frames", 4, "--size", "2048x1024", "--tier", "labels")
    random.seed(3)
    right = 0
    with Opened(page, data):
        box = page.run("(b => ({x: b.x, y: b.y, width: b.width, height: b.height}))(document.querySelector('#pane-a canvas').getBoundingClientRect())")
        labels = {}
        for n in range(100):
            frame, x, y = random.randrange(4), random.randrange(2048), random.randrange(1024)
            x = random.choice([0, 2047]) if n % 10 == 0 else x
            y = random.choice([0, 1023]) if n % 10 == 1 else y
            yaw, pitch = f"2 * Math.PI * ({x} + 0.5) / 2048 - Math.PI", f"Math.PI * (0.5 - ({y} + 0.5) / 1024)"
            page.run(f"airsim360.picked = null; airsim360.main.look.set({yaw}, {pitch}, 0.4); airsim360.showFrame({frame})")
            page.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
            picked = page.wait("airsim360.picked")
            labels[frame] = labels.get(frame) or read_ids(data / f"entity/{frame:06}.png")
            right += (picked["x"], picked["y"], picked["id"]) == (x, y, labels[frame][y][x])
    return {"clicks_right_of_100": right}


def heap(page):
    return next(m["value"] for m in page.call("Performance.getMetrics")["metrics"] if m["name"] == "JSHeapUsedSize")


def soak(page, room, world, minutes):
    """Flying, looking around, switching products in turn and light: memory in the second tenth and in the last one."""
    with Opened(page, "--world", world) as opened:
        page.call("HeapProfiler.enable")
        page.call("Performance.enable")
        products = page.run("[...document.getElementById('product').options].map(o => o.value)")
        random.seed(5)
        begin, rows = time.monotonic(), []
        while time.monotonic() < begin + 60 * minutes:
            page.run(f"airsim360.live.held.clear(); airsim360.live.held.add('{random.choice('wasdrfqe')}'); document.getElementById('product').value = '{products[len(rows) % len(products)]}';"
                     f"document.getElementById('product').dispatchEvent(new Event('change')); airsim360.main.panorama.turnTo({random.uniform(-3, 3)}, {random.uniform(-1, 1)}); 0")
            time.sleep(2)
            if len(rows) % 10 == 5:
                page.run(f"airsim360.live.ask({{do: 'set', hour: {random.randrange(6, 20)}}}).then(() => 0)")
            page.call("HeapProfiler.collectGarbage")
            rows.append((time.monotonic() - begin, heap(page), opened.viewer.memory()))
        early = [r for r in rows if 6 * minutes < r[0] < 12 * minutes]
        late = [r for r in rows if r[0] > 54 * minutes]
        mean = lambda part, i: statistics.mean(r[i] for r in part) / 2**20  # noqa: E731
        return {"soak": {"minutes": minutes, "page_mib": [round(mean(early, 1), 1), round(mean(late, 1), 1)], "server_mib": [round(mean(early, 2)), round(mean(late, 2))],
                         "pictures": page.run("airsim360.live.picture.number")}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="*", default=[], choices=[[], "first", "live", "latency", "many", "clicks", "soak"])
    parser.add_argument("--world", default="downtown_west")
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    figures = {}
    page = Browser()
    try:
        with tempfile.TemporaryDirectory(prefix="airsim360_view_bench_") as room:
            for name in arguments.what or ["first", "live", "latency", "many", "clicks", "soak"]:
                more = (arguments.minutes,) if name == "soak" else ()
                figures.update(globals()[name](page, pathlib.Path(room), arguments.world, *more))
                print(json.dumps(figures), flush=True)
    finally:
        page.close()
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
