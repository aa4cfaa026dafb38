#!/usr/bin/env python3
"""Places our frames under the paper's, for looking at locally; nothing of the paper's is part of the project.

usage: tools/side_by_side.py FRAMES_FOLDER OUT_FOLDER [PROGRAM]

FRAMES_FOLDER holds airsim360_new_york_city.png, airsim360_city_park.png and airsim360_four_scenes.png (not ours, not
committed).
Writes OUT_FOLDER/NAME.html with both pictures, the paper's above.
"""
import html
import pathlib
import subprocess
import sys

# Their picture, the part of it in pixels (None = all) of its size, our world and how it is rendered.
VIEWS = [
    ("airsim360_new_york_city", None, "new_york_city", ["--pose=-2,-4,36,62", "--people", "examples/people_crossing.yaml"]),
    ("airsim360_city_park", None, "city_park", []),
    ("airsim360_four_scenes", (500, 0, 498, 248, 2000, 504), "downtown_west", ["--pose=31.3,2.6,1.7,90", "--weather", "sunset", "--sun", "250,16"]),
]


def picture(uri, part):
    """HTML of a picture, or of a part of it, as wide as the page."""
    if part is None:
        return f"<img width=100% src='{uri}'>"
    x, y, w, h, width, height = part
    return (f"<div style=\"width:100%;aspect-ratio:{w}/{h};background:url('{uri}') "
            f"{100 * x / (width - w):.2f}% {100 * y / (height - h):.2f}%/{100 * width / w:.1f}% auto\"></div>")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    frames, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    program = sys.argv[3] if len(sys.argv) > 3 else "build/bin/airsim360"
    out.mkdir(parents=True, exist_ok=True)
    for name, part, world, flags in VIEWS:
        theirs = frames / f"{name}.png"
        if not theirs.exists():
            print(f"{theirs}: not there, skipped")
            continue
        command = [program, "render", "--world", world, "--size", "2048x1024", "--tier", "high", "--out", str(out / world)]
        subprocess.run(command + flags, check=True)
        page = (f"<h1>{html.escape(world)}</h1><p>paper<br>{picture(theirs.resolve().as_uri(), part)}"
                f"<p>ours<br><img width=100% src='{world}/rgb/000000.png'>")
        (out / f"{world}.html").write_text(page)
        print(out / f"{world}.html")


if __name__ == "__main__":
    main()
