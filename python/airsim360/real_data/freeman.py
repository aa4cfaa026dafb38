"""FreeMan: people filmed by eight telephones, in each camera's frame.

Wang et al.: FreeMan: Towards Benchmarking 3D Human Pose Estimation under Real-World Conditions, CVPR 2024, arXiv:2309.05073;
github.com/wangjiongw/FreeMan_API, README and loader. A session has `keypoints2d` (camera, frame, 17, x y score), `keypoints3d_optim` (frame, 17, x y z) by
COCO's order, and cameras as AniposeLib writes them: a rotation vector and a translation from the world to the camera, OpenCV's distortion. Lengths are
centimetres; the makers' pages do not say so, readers of the set do (isarandi/PosePile, posepile/ds/freeman), and the length of bodies is checked here.
"""
from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Dict, Iterator, List, NamedTuple, Tuple

import numpy as np

from . import monoloco
from .files import Array, Options, found
from .pickled import read_objects

__all__ = ["freeman"]

_CENTIMETRES = 100.0
_POINTS = 17
_OPPOSITE = [0, *(i + 1 if i % 2 else i - 1 for i in range(1, _POINTS))]  # COCO: right follows left
_SHOULDERS, _HIPS, _KNEES, _ANKLES = (5, 6), (11, 12), (13, 14), (15, 16)
_BODY = (0.9, 1.8)  # metres from the shoulders over hips and knees to the ankles
_MISS = 0.05        # of the person's height in the picture: by how much projected points may miss those of the picture
_INSIDE = 0.8       # of the points that the picture holds


class _Camera(NamedTuple):
    name: str
    size: Tuple[int, int]
    K: Array
    lens: Array
    R: Array
    t: Array

    def project(self, points: Array) -> Array:
        """Pixels of points in the camera's frame, by OpenCV's model of lenses."""
        pixels: Array = self._bend(points[..., :2] / points[..., 2:]) @ self.K[:2, :2].T + self.K[:2, 2]
        return pixels

    def rays(self, pixels: Array) -> Array:
        """x / z and y / z of pixels: the model's inverse, which has no closed form, by repetition."""
        bent = (pixels - self.K[:2, 2]) @ np.linalg.inv(self.K[:2, :2]).T
        plain: Array = bent.copy()
        for _ in range(30):
            plain += bent - self._bend(plain)
        return plain

    def _bend(self, plain: Array) -> Array:
        k1, k2, p1, p2, k3 = self.lens
        x, y = plain[..., 0], plain[..., 1]
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        return np.stack([x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)], -1)


def freeman(folder: Path, out: Path, options: Options) -> int:
    roots = sorted({path.parent.parent for path in found(folder, "keypoints3d/*.npy")})
    if len(roots) > 1:
        raise ValueError(f"{', '.join(map(str, roots))}: frames of one video are in several; give one of them")
    splits = monoloco.Splits(roots[0])
    samples: Dict[str, List[Dict[str, Any]]] = {"train": [], "val": [], "test": []}
    for path in found(roots[0], "keypoints3d/*.npy"):
        split = splits(path.stem)
        if split:
            samples[split] += _session(roots[0], path.stem, options)
    monoloco.write(out / "freeman.json", samples)
    monoloco.write_tested(out, samples)
    return sum(map(len, samples.values()))


def _numbers(path: Path, key: str, dimensions: int) -> Array:
    entry = read_objects(path)
    if not isinstance(entry, dict) or key not in entry:
        raise ValueError(f"{path}: must hold a dictionary with {key}")
    values = np.asarray(entry[key], float)
    if values.ndim != dimensions or values.shape[-2] != _POINTS or values.shape[-1] not in (2, 3):
        raise ValueError(f"{path}: {key} has the shape {values.shape}: must be {'cameras, ' if dimensions == 4 else ''}frames, {_POINTS}, 3")
    return values


def _cameras(path: Path) -> List[_Camera]:
    cameras = []
    for entry in json.loads(path.read_text(encoding="utf-8")):
        if "matrix" not in entry:
            continue  # AniposeLib's note on the calibration
        lens = np.zeros(5)
        given = np.ravel(entry["distortions"])[:5]
        lens[:len(given)] = given
        cameras.append(_Camera(entry["name"], (int(entry["size"][0]), int(entry["size"][1])), np.asarray(entry["matrix"], float), lens,
                               _rotation(np.ravel(entry["rotation"])), np.ravel(entry["translation"]).astype(float)))
    if not cameras:
        raise ValueError(f"{path}: no cameras in it")
    return cameras


def _rotation(vector: Array) -> Array:
    """Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector / angle if angle > 0 else np.zeros(3)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turned: Array = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return turned


def _session(root: Path, session: str, options: Options) -> Iterator[Dict[str, Any]]:
    path = root / "keypoints3d" / f"{session}.npy"
    world = _numbers(path, "keypoints3d_optim", 3)
    pixels = _numbers(root / "keypoints2d" / f"{session}.npy", "keypoints2d", 4)[..., :2]
    if pixels.shape[1] != len(world):
        raise ValueError(f"{path}: {len(world)} frames, its keypoints2d have {pixels.shape[1]}")
    frames = np.arange(0, len(world), options.every)
    frames = frames[np.isfinite(world[frames]).all((1, 2))]
    if len(frames) == 0:
        return
    _check_unit(path, world[frames])
    camera_file = root / "cameras" / f"{session}.json"
    for camera in _cameras(camera_file):
        view = int(camera.name.lstrip("c")) - 1 if camera.name.lstrip("c").isdigit() else -1
        if not 0 <= view < len(pixels):
            raise ValueError(f"{camera_file}: camera {camera.name!r} is none of the {len(pixels)} of keypoints2d (c01 is the first)")
        seen = frames[np.isfinite(pixels[view, frames]).all((1, 2))]
        points = world[seen] @ camera.R.T + camera.t
        ahead = (points[..., 2] > 0).all(1)
        seen, points = seen[ahead], points[ahead]
        mistake = _mistake(camera, points, pixels[view, seen])
        if mistake and not options.force:
            raise ValueError(f"{camera_file}: {camera.name}: {mistake}; --force leaves such a camera out")
        if not mistake:
            yield from _samples(camera, seen, points / _CENTIMETRES, pixels[view, seen], f"{session}/{camera.name}")


def _check_unit(path: Path, world: Array) -> None:
    """By the length from shoulders to ankles, which is 1.2 to 1.6 m in grown people, however they stand."""
    middles = [world[:, list(pair)].mean(1) for pair in (_SHOULDERS, _HIPS, _KNEES, _ANKLES)]
    length = float(np.median(sum(np.linalg.norm(b - a, axis=-1) for a, b in zip(middles, middles[1:]))))
    if _BODY[0] <= length / _CENTIMETRES <= _BODY[1]:
        return
    unit = next((name for name, size in (("metres", 1.0), ("millimetres", 1000.0)) if _BODY[0] <= length / size <= _BODY[1]), "")
    looks = f"looks like {unit}, FreeMan's are centimetres" if unit else "is of no person in centimetres"
    raise ValueError(f"{path}: from shoulders to ankles {length:.4g}: {looks}")


def _mistake(camera: _Camera, points: Array, pixels: Array) -> str:
    """What is wrong with a camera's points of the picture, by where its calibration puts the points of the world; "" if nothing is."""
    if len(points) == 0:
        return ""
    projected = camera.project(points)
    size = float(np.median(np.ptp(pixels[..., 1], axis=1)))

    def miss(of: Array) -> float:
        return float(np.median(np.linalg.norm(of - projected, axis=-1))) / max(size, 1.0)

    if miss(pixels) <= _MISS:
        return ""
    share, cause = min((miss(np.stack([camera.size[0] - 1 - pixels[..., 0], pixels[..., 1]], -1)), "keypoints2d are mirrored"),
                       (miss(pixels[:, _OPPOSITE]), "left and right are exchanged in keypoints2d"))
    if share <= _MISS:
        return cause
    return f"keypoints2d miss the projected keypoints3d by {100 * miss(pixels):.0f} % of the person's height: calibration and points do not belong together"


def _samples(camera: _Camera, frames: Array, points: Array, pixels: Array, name: str) -> Iterator[Dict[str, Any]]:
    inside = ((pixels >= 0) & (pixels < np.asarray(camera.size))).all(-1).mean(-1)
    rays = camera.rays(pixels)
    for frame, body, ray, share in zip(frames, points, rays, inside):
        if share < _INSIDE:
            continue
        low, high = body.min(0), body.max(0)  # of the camera's axes, which are about level
        # The person faces where the axis to their left, turned by a right angle about the vertical, points.
        left = body[[_SHOULDERS[0], _HIPS[0]]].sum(0) - body[[_SHOULDERS[1], _HIPS[1]]].sum(0)
        yaw = math.atan2(left[0], left[2])
        width, height, length = high - low
        yield monoloco.sample(f"{name}/{int(frame):06}", ray, (low + high) / 2, (height, width, length), yaw)
