"""People of streets in each camera's frame: KITTI and nuScenes."""
from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import monoloco
from .files import Array, Options, check_stature, found, write_persons

__all__ = ["kitti", "nuscenes"]


def kitti(folder: Path, out: Path, options: Options) -> int:
    """Geiger, Lenz, Urtasun: Are we ready for autonomous driving?, CVPR 2012; readme.txt of the object development kit.

    With OpenPifPaf's `keypoints/NAME.png.predictions.json` and `calib/NAME.txt` beside label_2, kitti.json too; its splits are those of `ImageSets`.
    """
    persons = []
    samples: Dict[str, List[monoloco.Sample]] = {"train": [], "val": [], "test": []}
    splits = monoloco.Splits(next(iter(sorted(folder.rglob("ImageSets"))), folder))
    for path in found(folder, "label_2/*.txt"):
        rows = [(number, line.split()) for number, line in enumerate(path.read_text(encoding="ascii").splitlines(), 1)]
        people = [_Pedestrian(f"{path}:{number}", f"{path.stem}:{number}", words, options) for number, words in rows if words[:1] == ["Pedestrian"]]
        persons += [{"id": person.name, "xyz": person.xyz, "yaw_deg": math.degrees(person.yaw)} for person in people]
        root = path.parent.parent
        split = splits(path.stem)
        if not people or not split or not (root / "keypoints").is_dir():
            continue
        K = _kitti_camera(root / "calib" / f"{path.stem}.txt")
        found_people = monoloco.detected(root / "keypoints", f"{path.stem}.png")
        for i, j in monoloco.matched(found_people, [person.box for person in people]):
            samples[split].append(monoloco.sample(people[j].name, _rays(K, found_people[i]), people[j].xyz, people[j].hwl, people[j].yaw))
    if any(samples.values()):
        monoloco.write(out / "kitti.json", samples)
    return write_persons(out, persons)


class _Pedestrian:
    """A line of label_2."""

    def __init__(self, where: str, name: str, words: List[str], options: Options) -> None:
        try:
            numbers = [float(word) for word in words[1:15]]
            left, top, right, bottom, h, w, l, x, y, z, turn = numbers[3:]
        except ValueError:
            raise ValueError(f"{where}: must have 15 or 16 columns") from None
        if not options.force:
            check_stature(where, h)
            if z <= 0:
                raise ValueError(f"{where}: at z = {z:g} m, behind the camera: are these coordinates of the laser scanner?")
        self.name, self.box, self.hwl, self.yaw = name, (left, top, right, bottom), (h, w, l), turn
        self.xyz = [x, y - h / 2, z]  # y is of the feet


def _kitti_camera(path: Path) -> Array:
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words[:1] == ["P2:"] and len(words) == 13:
            return np.array([float(word) for word in words[1:]]).reshape(3, 4)[:, :3]
    raise ValueError(f"{path}: has no P2 of 12 numbers, the left colour camera")


def _rays(K: Array, points: Array) -> Array:
    pixels = np.concatenate([points[:, :2], np.ones((len(points), 1))], 1)
    rays = pixels @ np.linalg.inv(K).T
    return np.asarray(rays[:, :2] / rays[:, 2:])


def _turn(wxyz: Sequence[float]) -> Array:
    w, x, y, z = np.asarray(wxyz, float) / np.linalg.norm(wxyz)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class _Tables:
    """The tables of nuScenes, whose rows name each other by tokens."""

    def __init__(self, root: Path) -> None:
        self._tables: Dict[str, Dict[str, Any]] = {}
        self._root = root
        for name in ("category", "instance", "sample_data", "calibrated_sensor", "ego_pose", "sensor", "sample_annotation"):
            self.read(name)

    def read(self, name: str) -> None:
        self._tables[name] = {row["token"]: row for row in json.loads((self._root / f"{name}.json").read_text(encoding="utf-8"))}

    def rows(self, name: str) -> List[Any]:
        return list(self._tables[name].values())

    def row(self, name: str, token: str) -> Any:
        if token not in self._tables[name]:
            raise ValueError(f"no {name} has the token {token!r}: are the tables of one version?")
        return self._tables[name][token]


def nuscenes(folder: Path, out: Path, options: Options) -> int:
    """Caesar et al.: nuScenes, CVPR 2020; github.com/nutonomy/nuscenes-devkit, docs/schema_nuscenes.md.

    With OpenPifPaf's `keypoints/FILENAME.predictions.json` beside v1.0-*, nuscenes.json too; `train.txt` and `val.txt` there list the scenes of its splits.
    """
    root = found(folder, "v1.0-*/sample_annotation.json")[0].parent
    tables = _Tables(root)
    keypoints = root.parent / "keypoints"
    splits = monoloco.Splits(root.parent)
    if keypoints.is_dir():
        tables.read("sample")
        tables.read("scene")
    people: Dict[str, List[Any]] = {}
    for row in tables.rows("sample_annotation"):
        if tables.row("category", tables.row("instance", row["instance_token"])["category_token"])["name"].startswith("human.pedestrian"):
            if not options.force:
                check_stature(f"sample_annotation {row['token']}", row["size"][2])  # width, length, height
            people.setdefault(row["sample_token"], []).append(row)
    persons = []
    samples: Dict[str, List[monoloco.Sample]] = {"train": [], "val": [], "test": []}
    for shot in tables.rows("sample_data"):
        camera = tables.row("calibrated_sensor", shot["calibrated_sensor_token"])
        channel = tables.row("sensor", camera["sensor_token"])["channel"]
        if not shot["is_key_frame"] or not channel.startswith("CAM"):
            continue
        ego = tables.row("ego_pose", shot["ego_pose_token"])
        seen = [s for s in (_seen(f"{row['token']}:{channel}", row, ego, camera, shot) for row in people.get(shot["sample_token"], ())) if s is not None]
        persons += [{"id": person.name, "xyz": [float(v) for v in person.xyz], "yaw_deg": math.degrees(person.yaw)} for person in seen]
        if not seen or not keypoints.is_dir():
            continue
        split = splits(tables.row("scene", tables.row("sample", shot["sample_token"])["scene_token"])["name"])
        if split:
            samples[split] += _with_keypoints(keypoints, Path(shot["filename"]).name, seen, np.asarray(camera["camera_intrinsic"], float))
    if any(samples.values()):
        monoloco.write(out / "nuscenes.json", samples)
    return write_persons(out, persons)


def _with_keypoints(folder: Path, picture: str, seen: List["_Seen"], K: Array) -> Iterator[monoloco.Sample]:
    detections = monoloco.detected(folder, picture)
    for i, j in monoloco.matched(detections, [person.box for person in seen]):
        yield monoloco.sample(seen[j].name, _rays(K, detections[i]), seen[j].xyz, seen[j].hwl, seen[j].yaw)


class _Seen(NamedTuple):
    """A person in a camera's frame; the box is of the picture's pixels."""
    name: str
    xyz: Array
    hwl: Tuple[float, float, float]
    yaw: float
    box: monoloco.Box


def _seen(name: str, row: Any, ego: Any, camera: Any, shot: Any) -> Optional[_Seen]:
    # None where the middle of the box is outside the picture.
    to_ego, to_camera, K = _turn(ego["rotation"]).T, _turn(camera["rotation"]).T, np.asarray(camera["camera_intrinsic"])
    turn = to_camera @ to_ego @ _turn(row["rotation"])
    p = to_camera @ (to_ego @ (np.asarray(row["translation"]) - ego["translation"]) - camera["translation"])
    pixel = K @ p
    if p[2] < 0.1 or not (0 <= pixel[0] < shot["width"] * p[2] and 0 <= pixel[1] < shot["height"] * p[2]):
        return None
    w, l, h = row["size"]
    corners = np.array([p + turn @ (np.array([a * l, b * w, c * h]) / 2) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])
    pixels = corners @ K.T / np.maximum(corners[:, 2:], 0.1)
    (left, top), (right, bottom) = (np.clip(edge, 0, (shot["width"], shot["height"])) for edge in (pixels[:, :2].min(0), pixels[:, :2].max(0)))
    return _Seen(name, p, (h, w, l), math.atan2(-turn[2, 0], turn[0, 0]), (float(left), float(top), float(right), float(bottom)))
