"""Real data sets, from the folders that their makers hand out, as the files that `airsim360 eval` and `airsim360 mpde` read.

    /usr/bin/python3 -m airsim360.real_data stanford2d3d FOLDER --out DIR

| kind | reads | writes |
|---|---|---|
| densepass | `*labelTrainIds.png` anywhere below | labels/NAME.png, classes.txt (19 of Cityscapes; 255 has no class) |
| stanford2d3d | `area_*/pano/depth`, `.../semantic`, `assets/semantic_labels.json` | depth/NAME.npy (metres, 0 = none), labels/NAME.png, classes.txt |
| deep360 | `*_depth.npz` (`arr_0`, metres) anywhere below | depth/NAME.npy; beyond 1000 m = 0 |
| matterport3d360 | `*.dpt` anywhere below (metres, float) | depth/NAME.npy; what is not above 0 = 0 |
| kitti | `label_2/*.txt` | persons.json: pedestrians with distance and yaw in the camera's frame |
| nuscenes | `v1.0-*/*.json` | persons.json: pedestrians that the middle of a camera's picture area holds at its key frames |

Nothing is downloaded, and pictures are not copied: their terms are between you and their makers. A file that is not what its makers describe is
a ValueError that names it, and nothing is written in its place.
"""
from __future__ import annotations

import argparse
import json
import math
import os
import struct
import sys
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._words import did_you_mean

__all__ = ["KINDS", "convert", "main"]

_Array = npt.NDArray[Any]
_CITYSCAPES = ("road", "sidewalk", "building", "wall", "fence", "pole", "traffic light", "traffic sign", "vegetation", "terrain", "sky", "person",
               "rider", "car", "truck", "bus", "train", "motorcycle", "bicycle")
_LARGEST = 1 << 26  # pixels
_DPT_MAGIC = 202021.25  # as Sintel's depth files begin


def _picture(path: Path) -> _Array:
    import cv2
    picture: Optional[_Array] = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if picture is None:
        raise ValueError(f"{path}: cannot be read as a picture")
    return picture


def _found(folder: Path, pattern: str) -> List[Path]:
    paths = sorted(folder.rglob(pattern))
    if not paths:
        raise ValueError(f"{folder}: no {pattern} below it")
    return paths


def _write(path: Path, write: Callable[[Path], Any]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"part_{path.name}")  # keeps the ending, from which writers know the format
    write(part)
    os.replace(part, path)


def _labels(path: Path, ids: _Array) -> None:
    import cv2
    _write(path, lambda part: cv2.imwrite(str(part), ids))


def _names(out: Path, names: Sequence[str]) -> None:
    _write(out / "classes.txt", lambda part: part.write_text("".join(f"{i} {name}\n" for i, name in enumerate(names)), encoding="utf-8"))


def _depth(out: Path, name: str, metres: _Array) -> None:
    _write(out / "depth" / f"{name}.npy", lambda part: np.save(part, metres.astype(np.float32)))


def _densepass(folder: Path, out: Path) -> int:
    paths = _found(folder, "*labelTrainIds.png")
    for path in paths:
        ids = _picture(path)
        if ids.ndim != 2 or ids.dtype != np.uint8 or not np.isin(ids, [*range(len(_CITYSCAPES)), 255]).all():
            raise ValueError(f"{path}: must have one channel of 8 bits with 0 to {len(_CITYSCAPES) - 1}, or 255 for no class")
        _labels(out / "labels" / f"{path.name[:-len('labelTrainIds.png')].rstrip('_')}.png", ids)
    _names(out, _CITYSCAPES)
    return len(paths)


def _stanford(folder: Path, out: Path) -> int:
    depths = _found(folder, "area_*/pano/depth/*_depth.png")
    for path in depths:
        code = _picture(path)
        if code.ndim != 2 or code.dtype != np.uint16:
            raise ValueError(f"{path}: must have one channel of 16 bits")
        _depth(out, path.name[:-len("_depth.png")], np.where(code == 65535, 0, code / 512.0))
    table = next(iter(sorted(folder.rglob("semantic_labels.json"))), None)
    if table is None:
        raise ValueError(f"{folder}: no semantic_labels.json below it")
    instances = [str(name).split("_")[0] for name in json.loads(table.read_text(encoding="utf-8"))]
    names = sorted(set(instances) - {"<UNK>"})
    ids = np.array([names.index(name) if name in names else 255 for name in instances], np.uint8)
    for path in sorted(folder.rglob("area_*/pano/semantic/*_semantic.png")):
        bgr = _picture(path)
        if bgr.ndim != 3 or bgr.dtype != np.uint8:
            raise ValueError(f"{path}: must have three channels of 8 bits")
        index = (bgr[..., 2].astype(np.int64) << 16) + (bgr[..., 1].astype(np.int64) << 8) + bgr[..., 0]
        _labels(out / "labels" / f"{path.name[:-len('_semantic.png')]}.png", np.where(index < len(ids), ids[np.minimum(index, len(ids) - 1)], 255).astype(np.uint8))
    _names(out, names)
    return len(depths)


def _deep360(folder: Path, out: Path) -> int:
    paths = _found(folder, "*_depth.npz")
    for path in paths:
        with np.load(path, allow_pickle=False) as arrays:
            if "arr_0" not in arrays or arrays["arr_0"].ndim != 2:
                raise ValueError(f"{path}: must hold arr_0 of two dimensions")
            metres = arrays["arr_0"].astype(np.float32)
        # Episodes number their frames alike.
        _depth(out, "_".join([*path.relative_to(folder).parts[:-1], path.name[:-len("_depth.npz")]]), np.where(metres <= 1000, metres, 0))
    return len(paths)


def _matterport(folder: Path, out: Path) -> int:
    paths = _found(folder, "*.dpt")
    for path in paths:
        data = path.read_bytes()
        magic, width, height = struct.unpack("<fii", data[:12]) if len(data) >= 12 else (0.0, 0, 0)
        if magic != _DPT_MAGIC or not (0 < width and 0 < height and width * height <= _LARGEST):
            raise ValueError(f"{path}: is no .dpt file: 'PIEH', width, height, then floats")
        if len(data) != 12 + 4 * width * height:
            raise ValueError(f"{path}: {len(data)} bytes are not those of {width}x{height} floats")
        metres = np.frombuffer(data[12:], "<f4").reshape(height, width)
        _depth(out, path.stem, np.where(metres > 0, metres, 0))
    return len(paths)


def _persons(out: Path, persons: List[Dict[str, Any]]) -> int:
    if not persons:
        raise ValueError("no pedestrians in it")
    _write(out / "persons.json", lambda part: part.write_text(json.dumps({"persons": persons}, indent=1), encoding="utf-8"))
    return len(persons)


def _kitti(folder: Path, out: Path) -> int:
    persons = []
    for path in _found(folder, "label_2/*.txt"):
        for number, line in enumerate(path.read_text(encoding="ascii").splitlines(), 1):
            words = line.split()
            if not words or words[0] != "Pedestrian":
                continue
            try:
                h, _, _, x, y, z, turn = (float(word) for word in words[8:15])
            except ValueError:
                raise ValueError(f"{path}:{number}: must have 15 or 16 columns") from None
            persons.append({"id": f"{path.stem}:{number}", "xyz": [x, y - h / 2, z], "yaw_deg": math.degrees(turn)})  # y is of the feet
    return _persons(out, persons)


def _turn(wxyz: Sequence[float]) -> _Array:
    w, x, y, z = np.asarray(wxyz, float) / np.linalg.norm(wxyz)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def _nuscenes(folder: Path, out: Path) -> int:
    root = _found(folder, "v1.0-*/sample_annotation.json")[0].parent

    def table(name: str) -> Dict[str, Any]:
        return {row["token"]: row for row in json.loads((root / f"{name}.json").read_text(encoding="utf-8"))}

    tables = {name: table(name) for name in ("category", "instance", "sample_data", "calibrated_sensor", "ego_pose", "sensor", "sample_annotation")}
    people: Dict[str, List[Any]] = {}
    for row in tables["sample_annotation"].values():
        if tables["category"][tables["instance"][row["instance_token"]]["category_token"]]["name"].startswith("human.pedestrian"):
            people.setdefault(row["sample_token"], []).append(row)
    persons = []
    for shot in tables["sample_data"].values():
        camera = tables["calibrated_sensor"][shot["calibrated_sensor_token"]]
        channel = tables["sensor"][camera["sensor_token"]]["channel"]
        if not shot["is_key_frame"] or not channel.startswith("CAM"):
            continue
        for row in people.get(shot["sample_token"], ()):
            seen = _seen(row, tables["ego_pose"][shot["ego_pose_token"]], camera, shot["width"], shot["height"])
            if seen is not None:
                persons.append({"id": f"{row['token']}:{channel}", "xyz": [float(v) for v in seen[0]], "yaw_deg": seen[1]})
    return _persons(out, persons)


def _seen(row: Any, ego: Any, camera: Any, width: int, height: int) -> Optional[Tuple[_Array, float]]:
    # The middle of a box and its yaw in a camera's frame; None where the middle is outside the picture.
    to_ego, to_camera = _turn(ego["rotation"]).T, _turn(camera["rotation"]).T
    p = to_camera @ (to_ego @ (np.asarray(row["translation"]) - ego["translation"]) - camera["translation"])
    pixel = np.asarray(camera["camera_intrinsic"]) @ p
    if p[2] < 0.1 or not (0 <= pixel[0] < width * p[2] and 0 <= pixel[1] < height * p[2]):
        return None
    ahead = to_camera @ to_ego @ _turn(row["rotation"])[:, 0]
    return p, math.degrees(math.atan2(-ahead[2], ahead[0]))


KINDS: Dict[str, Callable[[Path, Path], int]] = {"densepass": _densepass, "stanford2d3d": _stanford, "deep360": _deep360, "matterport3d360": _matterport,
                                                 "kitti": _kitti, "nuscenes": _nuscenes}
"""What can be read, and the function (folder, out) -> number of pictures or persons of each."""


def convert(kind: str, folder: Path, out: Path) -> int:
    """Converts a folder; how many pictures or persons. ValueError for a kind, folder or file that is not as described."""
    if kind not in KINDS:
        raise ValueError(f"{kind!r}{did_you_mean(kind, KINDS)}; there are {', '.join(KINDS)}")
    if not folder.is_dir():
        raise ValueError(f"{folder}: no such folder")
    try:
        return KINDS[kind](folder, out)
    except (KeyError, TypeError, json.JSONDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{folder}: not as the makers of {kind} describe it ({type(error).__name__}: {error})") from None


def main(arguments: Optional[Iterable[str]] = None) -> int:
    """Exit status: 0, 1 for a missing package, 2 for bad input."""
    parser = argparse.ArgumentParser(prog="python3 -m airsim360.real_data", description="Real data sets as files that `airsim360 eval` reads.")
    parser.add_argument("kind", help=", ".join(KINDS))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    a = parser.parse_args(None if arguments is None else list(arguments))
    try:
        print(f"{convert(a.kind, a.folder, a.out)} written to {a.out}")
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"error: real_data needs Debian's python3-opencv ({error}): apt-get install python3-opencv", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
