"""Range at every pixel of a level panorama: a small network with convolutions on the sphere."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, FrozenSet, List, Sequence

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch.nn import functional as F

from .augment import augment
from .classes import CLASSES
from .frames import Frames
from .nets import SphereNet
from .sphere import solid_angles
from .training import Schedule, load_model, train

__all__ = ["Depth", "evaluate_depth", "train_depth"]

_Array = npt.NDArray[Any]
_FAR = 300.0  # metres: what is farther is not learnt


@dataclass
class _Panoramas:
    frames: Frames
    height: int
    kinds: FrozenSet[str]
    size: int = 8

    def batch(self, step: int, random: np.random.Generator) -> List[Any]:
        pictures, ranges = [], []
        for i in random.integers(len(self.frames), size=self.size):
            rgb, distance, sky = _shrunk(self.frames, int(i), self.height)
            rgb = augment(rgb, random, self.kinds, sky) if self.kinds else rgb
            shift, mirror = int(random.integers(2 * self.height)), random.random() < 0.5
            rgb, distance = np.roll(rgb, shift, 1), np.roll(distance, shift, 1)
            pictures.append(rgb[:, ::-1] if mirror else rgb)
            ranges.append(distance[:, ::-1] if mirror else distance)
        return [torch.from_numpy(np.stack(pictures).transpose(0, 3, 1, 2).copy()), torch.from_numpy(np.stack(ranges))]


def _shrunk(frames: Frames, i: int, height: int) -> Any:
    size = (2 * height, height)
    return (cv2.resize(frames.rgb(i), size, interpolation=cv2.INTER_AREA), cv2.resize(frames.range(i), size, interpolation=cv2.INTER_NEAREST),
            cv2.resize((frames.classes(i)[0] == CLASSES.index("sky")).astype(np.uint8), size, interpolation=cv2.INTER_NEAREST) > 0)


def _loss(model: Any, data: Sequence[Any]) -> Any:
    pictures, truth = data
    out = F.interpolate(model(pictures.float() / 255), scale_factor=2, mode="bilinear", align_corners=False)[:, 0]
    area = torch.from_numpy(solid_angles(truth.shape[1])).to(truth.device)[None, :, None] * ((truth > 0) & (truth < _FAR))
    error = out - torch.log(truth.clamp(min=0.1))
    return (error.abs() * area).sum() / area.sum().clamp(min=1e-6)


def _median_rows(frames: Frames, height: int, most: int = 100) -> List[float]:
    """Median range (metres) of each row over up to `most` frames, 0 where nothing is hit: all that is known without looking."""
    count = min(most, len(frames))
    ranges = np.stack([_shrunk(frames, k * len(frames) // count, height)[1] for k in range(count)], 1)
    seen = [row[(row > 0) & (row < _FAR)] for row in ranges]
    return [round(float(np.median(row)), 3) if row.size else 0.0 for row in seen]


def train_depth(out: Path, frames: Frames, *, steps: int = 3000, height: int = 128, kinds: FrozenSet[str], seed: int = 0, device: torch.device,
                workers: int = 1, rate: float = 2e-3, precision: str = "float32") -> "Depth":
    """Trains on frames and writes OUT/model.pt."""
    rows_m = _median_rows(frames, height)
    about = {"task": "depth", "height": height, "kinds": sorted(kinds), "frames": len(frames), "rate": rate,
             "worlds": sorted({frame["world"] for frame in frames.about}), "rows_m": rows_m}
    model = train(out, about, lambda: SphereNet(1, height, level=True), _Panoramas(frames, height, kinds).batch, _loss, Schedule(steps, rate),
                  seed=seed, device=device, workers=workers, precision=precision)
    return Depth(model, height, device, rows_m)


class Depth:
    """A trained network at work."""

    def __init__(self, model: Any, height: int, device: torch.device, rows_m: Sequence[float] = ()) -> None:
        self.model, self.height, self.device, self.rows_m = model, height, device, rows_m

    @staticmethod
    def load(path: Path, device: torch.device) -> "Depth":
        """Of `train --out`, or its model.pt."""
        says: Dict[str, Any] = {}

        def make(about: Dict[str, Any]) -> SphereNet:
            says.update(about)
            return SphereNet(1, int(about["height"]), level=True)
        model = load_model(path, "depth", make, device)
        return Depth(model, model.height, device, says.get("rows_m", ()))

    def range(self, rgb: _Array) -> npt.NDArray[np.float32]:
        """Metres (H, 2 H) of a level panorama (H, 2 H, 3); the sky gets a range too."""
        height = rgb.shape[0]
        picture = cv2.resize(rgb, (2 * self.height, self.height), interpolation=cv2.INTER_AREA)
        with torch.no_grad():
            x = torch.from_numpy(picture.transpose(2, 0, 1).copy())[None].to(self.device).float() / 255
            logarithm = (self.model(x) + self.model(x.flip(-1)).flip(-1))[0, 0].cpu().numpy() / 2
        return np.asarray(np.exp(cv2.resize(logarithm, (2 * height, height), interpolation=cv2.INTER_LINEAR)), np.float32)


def evaluate_depth(depth: Depth, frames: Frames, most: int = 60) -> Dict[str, float]:
    """airsim360.metrics.depth by solid angle, the mean over frames; rows_absrel is that of who knows the median range of every row of the
    true picture, trained_absrel and trained_d1 of who knows those of the frames that were trained on and does not look."""
    from .. import metrics
    found: List[Dict[str, float]] = []
    for k in range(min(most, len(frames))):
        i = k * len(frames) // min(most, len(frames))
        rgb, truth, _ = _shrunk(frames, i, depth.height)
        truth = np.where(truth < _FAR, truth, 0)
        if not (truth > 0).any():
            continue
        result = metrics.depth(depth.range(rgb).astype(np.float64), truth.astype(np.float64), weights="solid_angle")
        rows = np.array([np.median(row[row > 0]) if (row > 0).any() else 1.0 for row in truth])
        constant = metrics.depth(np.broadcast_to(rows[:, None], truth.shape).copy(), truth.astype(np.float64), weights="solid_angle")
        found.append({"absrel": float(result["absrel"]), "d1": float(result["d1"]), "rows_absrel": float(constant["absrel"])})
        if depth.rows_m:
            known = np.asarray(depth.rows_m)
            at_rows = np.interp(np.arange(len(known)), np.flatnonzero(known), known[known > 0]) if known.any() else np.ones(len(known))
            blind = metrics.depth(np.broadcast_to(at_rows[:, None], truth.shape).copy(), truth.astype(np.float64), weights="solid_angle")
            found[-1].update(trained_absrel=float(blind["absrel"]), trained_d1=float(blind["d1"]))
    return {name: float(np.mean([f[name] for f in found])) for name in found[0]}
