"""Real data sets, from the folders that their makers hand out, as the files that `airsim360 eval` and `airsim360 mpde` read.

    /usr/bin/python3 -m airsim360.real_data stanford2d3d FOLDER --out DIR

| kind | reads | writes |
|---|---|---|
| densepass | `*labelTrainIds.png` anywhere below | labels/NAME.png, classes.txt (19 of Cityscapes; 255 has no class) |
| wildpass | PNGs below `gtFine` (25 ids of Mapillary) | labels/NAME.png, classes.txt (8, as `dataset export --format wildpass`) |
| stanford2d3d | `area_*/pano/depth`, `.../semantic`, `assets/semantic_labels.json` | depth/NAME.npy (metres, 0 = none), labels/NAME.png, classes.txt |
| deep360 | `*_depth.npz` (`arr_0`, metres, Cassini) anywhere below | depth/NAME.npy, equirectangular; beyond 1000 m = 0 |
| matterport3d360 | `*.dpt` anywhere below (metres, float) | depth/NAME.npy; what is not above 0 = 0 |
| spherecraft | `depthmaps/*.exr`, `*_black_list.txt` of scenes | depth/SCENE_NAME.npy; where nothing was hit = 0 |
| kitti | `label_2/*.txt`; with `keypoints/`, `calib/`, `ImageSets/` | persons.json: pedestrians in the camera's frame; kitti.json in MonoLoco's layout |
| nuscenes | `v1.0-*/*.json`; with `keypoints/`, lists of scenes | the same of key frames, whose middle a camera's picture holds; nuscenes.json |
| freeman | `keypoints2d`, `keypoints3d`, `cameras`, lists of sessions | persons.json of those to test on; freeman.json |

Nothing is downloaded, and pictures are not copied: their terms are between you and their makers. A file that is not what its makers describe is
a ValueError that names it and what it looks like, and nothing is written then.
"""
from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Callable, Dict, Iterable, Optional

from .._words import did_you_mean
from . import depths, freeman, labels, people
from .files import Options

__all__ = ["KINDS", "convert", "main"]

KINDS: Dict[str, Callable[[Path, Path, Options], int]] = {
    "densepass": labels.densepass, "wildpass": labels.wildpass, "stanford2d3d": depths.stanford2d3d, "deep360": depths.deep360,
    "matterport3d360": depths.matterport3d360, "spherecraft": depths.spherecraft, "kitti": people.kitti, "nuscenes": people.nuscenes, "freeman": freeman.freeman}
"""What can be read, and the function (folder, out, options) -> number of pictures or persons of each."""


def convert(kind: str, folder: Path, out: Path, *, every: int = 30, force: bool = False) -> int:
    """Converts a folder; how many pictures or persons. `every` N-th frame of videos; `force` takes what looks like a mistake as it is.

    ValueError for a kind, folder or file that is not as described; then `out` stays as it was.
    """
    if kind not in KINDS:
        raise ValueError(f"{kind!r}{did_you_mean(kind, KINDS)}; there are {', '.join(KINDS)}")
    if every < 1:
        raise ValueError(f"--every: {every} is below 1")
    if not folder.is_dir():
        raise ValueError(f"{folder}: no such folder")
    out.parent.mkdir(parents=True, exist_ok=True)
    part = Path(tempfile.mkdtemp(prefix=f".{out.name}_", dir=out.parent))  # beside it: moved, not copied, when all is right
    try:
        count = KINDS[kind](folder, part, Options(every, force))
        for path in sorted(part.rglob("*")):
            if path.is_file():
                target = out / path.relative_to(part)
                target.parent.mkdir(parents=True, exist_ok=True)
                os.replace(path, target)
        return count
    except (KeyError, TypeError, json.JSONDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{folder}: not as the makers of {kind} describe it ({type(error).__name__}: {error})") from None
    except FileNotFoundError as error:
        raise ValueError(f"{error.filename}: is missing") from None
    finally:
        shutil.rmtree(part, ignore_errors=True)


def main(arguments: Optional[Iterable[str]] = None) -> int:
    """Exit status: 0, or 2 for bad input."""
    parser = argparse.ArgumentParser(prog="python3 -m airsim360.real_data", description="Real data sets as files that `airsim360 eval` reads.")
    parser.add_argument("kind", help=", ".join(KINDS))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--every", type=int, default=30, metavar="N", help="every N-th frame of videos (freeman; default 30)")
    parser.add_argument("--force", action="store_true", help="convert what looks like a mistake as it is")
    a = parser.parse_args(None if arguments is None else list(arguments))
    try:
        print(f"{convert(a.kind, a.folder, a.out, every=a.every, force=a.force)} written to {a.out}")
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0
