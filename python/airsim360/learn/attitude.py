"""The attitude of a camera from one panorama: which way is up.

The network tells at every pixel the sine of its elevation, d . u for the direction d and the unit vector u that points up, and how
sure it is; u is what fits them best (weighted least squares over the sphere). Convolutions on the sphere see the same whatever the
tilt, and several turned copies of a panorama vote.
"""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, FrozenSet, List, Optional, Sequence

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch.nn import functional as F

from .augment import augment
from .classes import CLASSES
from .frames import Frames
from .labels import read_panorama
from .nets import SphereNet
from .sphere import directions, sample, solid_angles
from .training import Schedule, load_model, train

__all__ = ["Attitude", "Turned", "angles_of", "random_rotation", "train_attitude", "upright"]

_Array = npt.NDArray[Any]
_UP = np.array([0.0, -1.0, 0.0])  # of a level camera, in C


def random_rotation(random: np.random.Generator) -> _Array:
    """R (3, 3), any rotation as likely as any other."""
    w, x, y, z = (q := random.normal(size=4)) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def angles_of(up: _Array) -> Dict[str, float]:
    """Pitch (nose up) and roll (right side down) in degrees of a camera in which `up` (3,) of C points up."""
    return {"pitch_deg": float(np.degrees(np.arcsin(np.clip(up[2], -1, 1)))), "roll_deg": float(np.degrees(np.arctan2(-up[0], -up[1])))}


@dataclass
class Turned:
    """Batches of small panoramas of level frames, each turned any way."""

    pictures: Sequence[Any]
    """(H, 2 H, 3) uint8 of level panoramas."""
    skies: Sequence[Any]
    """(H, 2 H) bool where they show the sky."""
    kinds: FrozenSet[str] = frozenset()
    size: int = 24
    shares: Optional[Sequence[float]] = None
    """How often each picture is taken; None: equally."""

    def batch(self, step: int, random: np.random.Generator) -> List[Any]:
        """[(B, 3, H, 2 H) uint8, (B, 3) up]."""
        pictures, ups = [], []
        height = self.pictures[0].shape[0]
        rays = directions(height)
        for i in random.choice(len(self.pictures), size=self.size, p=self.shares):
            picture = augment(self.pictures[i], random, self.kinds, self.skies[i]) if self.kinds else self.pictures[i]
            if self.kinds and random.random() < 0.5:
                picture = picture[:, ::-1]
            turn = random_rotation(random)
            pictures.append(sample(picture, rays @ turn.T.astype(np.float32)))  # turn takes the camera's directions to the picture's
            ups.append(turn.T @ _UP)
        return [torch.from_numpy(np.stack(pictures).transpose(0, 3, 1, 2).copy()), torch.from_numpy(np.stack(ups).astype(np.float32))]


def small(frames: Frames, height: int) -> Any:
    """Pictures and skies of frames, shrunk to `height`, for Turned."""
    pictures, skies = [], []
    for i in range(len(frames)):
        pictures.append(cv2.resize(frames.rgb(i), (2 * height, height), interpolation=cv2.INTER_AREA))
        sky = (frames.classes(i)[0] == CLASSES.index("sky")).astype(np.float32)
        skies.append(cv2.resize(sky, (2 * height, height), interpolation=cv2.INTER_AREA) > 0.5)
    return pictures, skies


def _network(height: int) -> SphereNet:
    return SphereNet(2, height, coarse=True)


class _Fit:
    # What solves for up, on one device.
    def __init__(self, height: int, device: torch.device) -> None:
        self.rays = torch.from_numpy(directions(height)).reshape(-1, 3).to(device)
        self.area = torch.from_numpy(solid_angles(height)).repeat_interleave(2 * height).to(device)

    def __call__(self, out: Any) -> Any:
        sine = out[:, 0].flatten(1)
        weight = self.area * F.softplus(out[:, 1].flatten(1)).clamp(max=20) + 1e-3 * self.area
        normal = torch.einsum("bn,ni,nj->bij", weight, self.rays, self.rays)
        right = torch.einsum("bn,bn,ni->bi", weight, sine, self.rays)
        return torch.linalg.solve(normal + 1e-4 * torch.eye(3, device=out.device), right), sine


def _loss_of(height: int, device: torch.device) -> Any:
    fit = _Fit(height // 4, device)

    def loss(model: Any, data: Sequence[Any]) -> Any:
        pictures, up = data
        found, sine = fit(model(pictures.float() / 255))
        dense = ((sine - up @ fit.rays.T).abs() * fit.area).sum(1) / fit.area.sum()
        apart = 1 - F.cosine_similarity(found, up, dim=1)
        return (dense + torch.sqrt(apart + 1e-4) + 0.1 * (found - up).abs().sum(1)).mean()

    return loss


def train_attitude(out: Path, frames: Frames, *, steps: int = 3000, height: int = 64, kinds: FrozenSet[str], seed: int = 0,
                   device: torch.device, workers: int = 1, rate: float = 3e-3, precision: str = "float32",
                   photographs: Sequence[Path] = (), share: float = 0.3) -> "Attitude":
    """Trains on frames, which are level, and writes OUT/model.pt. A share of every batch is of `photographs`, level panoramas too, if there are any;
    with 1 the batches have them alone."""
    pictures, skies = small(frames, height)
    real = [cv2.resize(read_panorama(path), (2 * height, height), interpolation=cv2.INTER_AREA) for path in photographs]
    shares = [(1 - share) / len(pictures)] * len(pictures) + [share / len(real)] * len(real) if real else None
    about = {"task": "attitude", "height": height, "kinds": sorted(kinds), "frames": len(frames), "rate": rate,
             "worlds": sorted({frame["world"] for frame in frames.about}), "photographs": sorted(path.name for path in photographs), "share": share}
    turned = Turned([*pictures, *real], [*skies, *[np.zeros(picture.shape[:2], bool) for picture in real]], kinds, shares=shares)
    return fit_attitude(out, turned, about, steps, height, seed, device, workers, rate, precision)


def fit_attitude(out: Path, turned: Turned, about: Dict[str, Any], steps: int, height: int, seed: int, device: torch.device, workers: int,
                 rate: float, precision: str = "float32") -> "Attitude":
    """Trains on any level pictures."""
    model = train(out, about, lambda: _network(height), turned.batch, _loss_of(height, device), Schedule(steps, rate), seed=seed,
                  device=device, workers=workers, precision=precision)
    return Attitude(model, height, device)


class Attitude:
    """A trained network at work."""

    def __init__(self, model: Any, height: int, device: torch.device) -> None:
        self.model, self.height, self.device = model, height, device
        self.fit = _Fit(height // 4, device)
        random = np.random.default_rng(0)
        self.turns = [np.eye(3), *(random_rotation(random) for _ in range(7))]

    @staticmethod
    def load(path: Path, device: torch.device) -> "Attitude":
        """Of `train --out`, or its model.pt."""
        model = load_model(path, "attitude", lambda about: _network(int(about["height"])), device)
        return Attitude(model, model.height, device)

    def up(self, rgb: _Array, votes: int = 8) -> _Array:
        """The unit vector (3,) of C that points up in a panorama (H, 2 H, 3): the median direction of `votes` (1 to 8) turned copies,
        then of as many of the panorama that was set upright by it."""
        picture = cv2.resize(rgb, (2 * self.height, self.height), interpolation=cv2.INTER_AREA)
        found = _middle(self._votes(picture, self.turns[:votes]))
        return _middle(self._votes(picture, [upright(found, k * 2 * np.pi / votes) for k in range(votes)])) if votes > 1 else found

    def _votes(self, picture: _Array, turns: Sequence[_Array]) -> _Array:
        rays = directions(self.height)
        views = np.stack([sample(picture, rays @ turn.T.astype(np.float32)) for turn in turns])
        with torch.no_grad():
            x = torch.from_numpy(views.transpose(0, 3, 1, 2).copy()).to(self.device).float() / 255
            ups = self.fit(self.model(x))[0].cpu().numpy()
        return np.stack([turn @ up for turn, up in zip(turns, ups)])


def upright(up: _Array, heading: float = 0) -> _Array:
    """R (3, 3) that takes directions of a level camera to those of a camera in which `up` points up."""
    y = -up / np.linalg.norm(up)
    helper = np.array([1.0, 0, 0]) if abs(y[0]) < 0.7 else np.array([0, 0, 1.0])
    x = np.cross(y, helper)
    x /= np.linalg.norm(x)
    level = np.stack([x, y, np.cross(x, y)], 1)
    c, s = np.cos(heading), np.sin(heading)
    turned: _Array = level @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return turned


def _middle(vectors: _Array) -> _Array:
    # Geometric median on the sphere, by Weiszfeld's steps.
    unit = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    at = unit.mean(0)
    for _ in range(30):
        weight = 1 / np.maximum(np.linalg.norm(unit - at, axis=1), 1e-3)
        at = (unit * weight[:, None]).sum(0) / weight.sum()
    middle: _Array = at / max(1e-9, float(np.linalg.norm(at)))
    return middle
