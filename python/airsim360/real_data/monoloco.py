"""MonoLoco's layout, which `airsim360 mpde` trains and tests on: keypoints of people with their distances.

Bertoni, Kreiss, Alahi: Perceiving Humans: from Monocular 3D Localization to Social Distancing, T-ITS 2021; github.com/vita-epfl/monoloco,
monoloco/prep and tests/sample_joints-kitti-mono.json. KITTI and nuScenes have no keypoints: there they are detections of OpenPifPaf.
"""
from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Set, Tuple

import numpy as np

from .files import Array, write_persons

__all__ = ["Box", "Sample", "Splits", "detected", "matched", "sample", "write", "write_tested"]

Sample = Dict[str, Any]
Box = Tuple[float, float, float, float]  # left, top, right, bottom

_POINTS = 17
_PLANE = 10.0       # inputs are on the plane so many metres ahead
_MEAN = (1.72, 0.75, 0.68)  # height, width and length, of which targets are differences in decimetres
_LEAST_IOU = 0.3


class Splits:
    """The split of a name by lists `train.txt`, `validation.txt` or `val.txt` or `valid.txt`, `test.txt`; None for one that they leave out.
    Without lists all are to test on: val."""

    def __init__(self, root: Path) -> None:
        lists = {"train": self._read(root, "train"), "val": self._read(root, "validation", "valid", "val"), "test": self._read(root, "test")}
        self._lists = {split: names for split, names in lists.items() if names}
        self._ignored = self._read(root, "ignore_list")

    @staticmethod
    def _read(root: Path, *files: str) -> Set[str]:
        paths = [root / f"{file}.txt" for file in files if (root / f"{file}.txt").exists()]
        return {line.strip() for path in paths for line in path.read_text(encoding="utf-8").splitlines() if line.strip()}

    def __call__(self, name: str) -> Optional[str]:
        if name in self._ignored:
            return None
        if not self._lists:
            return "val"
        return next((split for split, names in self._lists.items() if name in names), None)


def sample(name: str, rays: Array, xyz: Iterable[float], hwl: Iterable[float], yaw: float) -> Sample:
    """A person: x / z and y / z of the keypoints, the middle and the sizes of the box in metres, the yaw of KITTI; all of the camera's frame."""
    x, y, z = (float(v) for v in xyz)
    r, angle = math.sqrt(x * x + y * y + z * z), yaw - math.atan2(x, z)
    sizes = [10 * (float(v) - mean) for v, mean in zip(hwl, _MEAN)]
    return {"names": name, "xyz": [x, y, z], "yaw_deg": math.degrees(yaw), "X": (_PLANE * rays).ravel().tolist(),
            "Y": [math.atan2(z, x), math.acos(y / r), z, r, *sizes, math.sin(angle), math.cos(angle), yaw]}


def write(path: Path, samples: Dict[str, List[Sample]]) -> None:
    parts = {split: {key: [entry[key] for entry in samples.get(split, ())] for key in ("X", "Y", "names")} for split in ("train", "val", "test")}
    path.write_text(json.dumps(parts), encoding="utf-8")


def write_tested(out: Path, samples: Dict[str, List[Sample]]) -> int:
    """Those to test on, as `eval mpde` reads them."""
    return write_persons(out, [{"id": entry["names"], "xyz": entry["xyz"], "yaw_deg": entry["yaw_deg"]} for entry in samples["test"] or samples["val"]])


def detected(folder: Path, picture: str) -> List[Array]:
    """People whom OpenPifPaf found in a picture: (17, 3) of x, y and confidence each. ValueError if there is no such file."""
    paths = [folder / f"{name}.predictions.json" for name in (picture, Path(picture).stem)]
    path = next((path for path in paths if path.exists()), None)
    if path is None:
        raise ValueError(f"{paths[0]}: is missing: run OpenPifPaf on all pictures (--json-output), or take {folder.name}/ away")
    people = []
    for number, entry in enumerate(json.loads(path.read_text(encoding="utf-8"))):
        points = np.asarray(entry["keypoints"], float)
        if points.size != 3 * _POINTS:
            raise ValueError(f"{path}: person {number}: {points.size} numbers are not x, y and confidence of {_POINTS} keypoints")
        people.append(points.reshape(_POINTS, 3))
    return people


def matched(people: Sequence[Array], boxes: Sequence[Box]) -> Iterator[Tuple[int, int]]:
    """(person, box), each at most once, those first that fit best."""
    overlaps = sorted(((-_iou(_box_of(points), box), i, j) for i, points in enumerate(people) for j, box in enumerate(boxes)))
    taken: Set[int] = set()
    given: Set[int] = set()
    for overlap, i, j in overlaps:
        if -overlap >= _LEAST_IOU and i not in taken and j not in given:
            taken.add(i)
            given.add(j)
            yield i, j


def _box_of(points: Array) -> Box:
    sure = points[points[:, 2] > 0] if (points[:, 2] > 0).any() else points
    (left, top), (right, bottom) = sure[:, :2].min(0), sure[:, :2].max(0)
    return float(left), float(top), float(right), float(bottom)


def _iou(a: Box, b: Box) -> float:
    width, height = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    if width <= 0 or height <= 0:
        return 0
    area = sum((box[2] - box[0]) * (box[3] - box[1]) for box in (a, b))
    return width * height / (area - width * height)
