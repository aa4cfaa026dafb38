#!/usr/bin/env python3
"""Places our frames under the paper's, for looking at locally; nothing of the paper's is part of the project.

usage: tools/side_by_side.py FRAMES_FOLDER OUT_FOLDER [PROGRAM]

FRAMES_FOLDER holds airsim360_new_york_city.png and airsim360_city_park.png (not ours, not committed).
Writes OUT_FOLDER/NAME.html with both pictures, the paper's above.
"""
import html
import pathlib
import subprocess
import sys

VIEWS = {
    "airsim360_new_york_city": ("new_york_city", "-2,-4,36,62"),
    "airsim360_city_park": ("city_park", None),
}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    frames, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    program = sys.argv[3] if len(sys.argv) > 3 else "build/bin/airsim360"
    out.mkdir(parents=True, exist_ok=True)
    for name, (world, pose) in VIEWS.items():
        theirs = frames / f"{name}.png"
        if not theirs.exists():
            print(f"{theirs}: not there, skipped")
            continue
        command = [program, "render", "--world", world, "--size", "2048x1024", "--tier", "high", "--out", str(out / world)]
        subprocess.run(command + (["--pose", pose] if pose else []), check=True)
        page = f"<h1>{html.escape(world)}</h1><p>paper<br><img width=100% src='{theirs.resolve().as_uri()}'><p>ours<br><img width=100% src='{world}/rgb/000000.png'>"
        (out / f"{world}.html").write_text(page)
        print(out / f"{world}.html")


if __name__ == "__main__":
    main()
