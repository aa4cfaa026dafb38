"""Labels of outdoor pictures: sky, building, road, sidewalk, vegetation, car, person, and the borders of entities."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, FrozenSet, List, Optional, Sequence, Tuple

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch.nn import functional as F

from .augment import augment, resurface
from .classes import CLASSES, IGNORED
from .frames import Frames
from .nets import PictureNet
from .sphere import crop_rays, directions, rotation, sample, tangent_patches
from .training import Schedule, load_model, train

__all__ = ["Crops", "Segmenter", "evaluate", "train_segmenter"]

_Array = npt.NDArray[Any]
_RARE = {"person": 0.35, "car": 0.25, "road": 0.2, "sidewalk": 0.2}  # what half of the crops are aimed at
_WEIGHTS = (0.6, 0.7, 1.0, 1.2, 1.3, 1.0, 1.6, 3.0)                  # of classes in the loss
_PANORAMAS, _CROPS = 4, 3                                             # of a batch


@dataclass
class Crops:
    """Batches of perspective crops of panoramas: any heading, field of view 30 to 110 degrees, mostly level, mirrored half of the time."""

    frames: Frames
    size: int = 256
    kinds: FrozenSet[str] = frozenset()
    views: bool = True
    """False: all views have 70 degrees and are level."""

    def batch(self, step: int, random: np.random.Generator) -> List[Any]:
        """[(B, 3, S, S) uint8, (B, S, S) class, (B, S, S) border of an entity]: a function of the random stream alone."""
        pictures, labels, edges = [], [], []
        for i in random.integers(len(self.frames), size=_PANORAMAS):
            rgb = self.frames.rgb(i)
            classes, edge = self.frames.classes(i)
            for _ in range(_CROPS):
                picture, label, border = self._crop(rgb, classes, edge, random)
                pictures.append(picture)
                labels.append(label)
                edges.append(border)
        if self.kinds:
            self._paste(pictures, labels, edges, random)
            if "surface" in self.kinds:
                pictures = [resurface(p, random, label) for p, label in zip(pictures, labels)]
            pictures = [augment(p, random, self.kinds, label == CLASSES.index("sky")) for p, label in zip(pictures, labels)]
        return [torch.from_numpy(np.stack(pictures).transpose(0, 3, 1, 2).copy()), torch.from_numpy(np.stack(labels).astype(np.int64)),
                torch.from_numpy(np.stack(edges).astype(np.float32))]

    def _crop(self, rgb: _Array, classes: _Array, edge: _Array, random: np.random.Generator) -> Tuple[_Array, _Array, _Array]:
        yaw = random.uniform(-np.pi, np.pi)
        fov = np.radians(np.exp(random.uniform(np.log(30), np.log(110)))) if self.views else np.radians(70)
        if random.random() < 0.5:
            yaw = self._aim(classes, random, yaw)
        pitch = np.clip(random.normal(0.02, 0.12 if random.random() < 0.85 else 0.4), -1.0, 0.9) if self.views else 0
        roll = random.normal(0, 0.05) if self.views else 0
        centre = (0.0, random.uniform(-0.25, 0.25) if self.views else 0.0)
        aspect = np.exp(random.uniform(-0.25, 0.25)) if self.views else 1.0
        rays = crop_rays(self.size, self.size, fov, aspect, centre) @ rotation(yaw, pitch, roll).T
        if random.random() < 0.5:
            rays = rays[:, ::-1]
        width = 2 * np.tan(fov / 2) / self.size  # of a pixel; one of the panorama is π / H
        if width > 1.5 * np.pi / len(rgb):
            rgb = cv2.GaussianBlur(rgb, (0, 0), 0.4 * width / (np.pi / len(rgb)))
        return sample(rgb, rays), _filled(sample(classes, rays, nearest=True)), sample(edge.astype(np.uint8), rays, nearest=True)

    @staticmethod
    def _aim(classes: _Array, random: np.random.Generator, yaw: float) -> float:
        name = list(_RARE)[random.choice(len(_RARE), p=list(_RARE.values()))]
        band = classes[len(classes) * 2 // 5:len(classes) * 3 // 5]
        columns = np.nonzero((band == CLASSES.index(name)).any(0))[0]
        if not len(columns):
            return yaw
        return float((columns[random.integers(len(columns))] / classes.shape[1] - 0.5) * 2 * np.pi + random.normal(0, 0.15))

    @staticmethod
    def _paste(pictures: List[_Array], labels: List[_Array], edges: List[_Array], random: np.random.Generator) -> None:
        # Persons and cars of one crop into another (as ClassMix: Olsson, Tranheden, Pinto, Svensson, WACV 2021).
        originals = [(p.copy(), label.copy(), e.copy()) for p, label, e in zip(pictures, labels, edges)]
        for i in range(len(pictures)):
            if random.random() < 0.5:
                continue
            picture, label, edge = originals[random.integers(len(originals))]
            for name in ("person", "car"):
                mask = label == CLASSES.index(name)
                if 30 < mask.sum() < mask.size // 3:
                    pictures[i] = np.where(mask[..., None], picture, pictures[i])
                    labels[i] = np.where(mask, label, labels[i])
                    edges[i] = np.where(mask, edge, edges[i])


def _filled(label: _Array) -> _Array:
    # Crowns as annotators draw them: what is seen between leaves belongs to the tree.
    green = (label == CLASSES.index("vegetation")).astype(np.uint8)
    if not green.any():
        return label
    crowns = cv2.morphologyEx(green, cv2.MORPH_CLOSE, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (7, 7))) > 0
    between = np.isin(label, [CLASSES.index(name) for name in ("other", "sky", "building")])
    return np.where(crowns & between, CLASSES.index("vegetation"), label).astype(np.uint8)


def _loss(model: Any, data: Sequence[Any]) -> Any:
    pictures, labels, edges = data
    out = model(pictures.float() / 255)
    weights = torch.tensor(_WEIGHTS, device=out.device)
    known = labels != IGNORED
    classes = F.cross_entropy(out[:, :-1], labels, weights, ignore_index=IGNORED, label_smoothing=0.05)
    border = F.binary_cross_entropy_with_logits(out[:, -1], edges, reduction="none", pos_weight=torch.tensor(3.0, device=out.device))
    return classes + 0.15 * (border * known).sum() / known.sum().clamp(min=1)


def train_segmenter(out: Path, frames: Frames, *, steps: int = 3000, size: int = 224, kinds: FrozenSet[str], views: bool = True,
                    seed: int = 0, device: torch.device, workers: int = 1, rate: float = 2e-3,
                    precision: str = "float32") -> "Segmenter":
    """Trains on crops of frames, writes OUT/model.pt. A batch has 12 crops of 4 panoramas."""
    about = {"task": "segment", "size": size, "kinds": sorted(kinds), "views": views, "frames": len(frames), "rate": rate,
             "worlds": sorted({frame["world"] for frame in frames.about})}
    crops = Crops(frames, size, kinds, views)
    model = train(out, about, lambda: PictureNet(len(CLASSES) + 1), crops.batch, _loss, Schedule(steps, rate), seed=seed, device=device,
                  workers=workers, precision=precision)
    return Segmenter(model, device)


class Segmenter:
    """A trained network at work."""

    def __init__(self, model: Any, device: torch.device) -> None:
        self.model, self.device = model, device

    @staticmethod
    def load(path: Path, device: torch.device) -> "Segmenter":
        """Of `train --out`, or its model.pt."""
        return Segmenter(load_model(path, "segment", lambda _: PictureNet(len(CLASSES) + 1), device), device)

    def photograph(self, rgb: _Array, sides: Sequence[int] = (256, 352, 480)) -> Tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Shares (H, W, 8) of the classes and probability (H, W) of borders, the mean over enlargements whose shorter sides are `sides`
        and their mirror images."""
        height, width = rgb.shape[:2]
        shares, border = np.zeros((len(CLASSES), height, width), np.float32), np.zeros((height, width), np.float32)
        for side in sides:
            scale = side / min(height, width)
            h, w = (min(2048, max(64, round(n * scale / 32) * 32)) for n in (height, width))
            how = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
            a, b = self._one(cv2.resize(rgb, (w, h), interpolation=how))
            shares += np.stack([cv2.resize(plane, (width, height), interpolation=cv2.INTER_LINEAR) for plane in a])
            border += cv2.resize(b, (width, height), interpolation=cv2.INTER_LINEAR)
        return (shares / len(sides)).transpose(1, 2, 0), border / len(sides)

    def panorama(self, rgb: _Array, side: int = 256) -> Tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """The same of a panorama (H, 2 H), seen through 26 tangent patches of 75 degrees that are blended."""
        height = rgb.shape[0]
        rays, patch = directions(height), crop_rays(side, side, np.radians(75))
        shares, border = np.zeros((height, 2 * height, len(CLASSES)), np.float32), np.zeros((height, 2 * height), np.float32)
        total = np.zeros((height, 2 * height), np.float32)
        for turn in tangent_patches():
            a, b = self._one(sample(rgb, patch @ turn.T))
            local = rays @ turn.astype(np.float32)
            tan = np.tan(np.radians(37.5))
            with np.errstate(divide="ignore", invalid="ignore"):
                x, y = local[..., 0] / local[..., 2] / tan, local[..., 1] / local[..., 2] / tan
            inside = (local[..., 2] > 0) & (np.abs(x) < 1) & (np.abs(y) < 1)
            weight = np.where(inside, (1 - np.abs(x)) * (1 - np.abs(y)), 0).astype(np.float32)
            at = [((np.where(inside, v, 0) + 1) / 2 * side - 0.5).astype(np.float32) for v in (x, y)]
            for k, plane in enumerate(a):
                shares[..., k] += weight * cv2.remap(plane, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
            border += weight * cv2.remap(b, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
            total += weight
        return shares / total[..., None], border / total

    def _one(self, rgb: _Array) -> Tuple[_Array, _Array]:
        with torch.no_grad():
            x = torch.from_numpy(np.ascontiguousarray(rgb.transpose(2, 0, 1)))[None].to(self.device).float() / 255
            out = (self.model(x), self.model(x.flip(-1)).flip(-1))
            shares = sum(F.softmax(o[:, :-1], 1) for o in out) / 2
            border = sum(torch.sigmoid(o[:, -1]) for o in out) / 2
        return shares[0].cpu().numpy(), border[0].cpu().numpy()


def labels_of(shares: _Array, other: float = 0.5) -> npt.NDArray[np.uint8]:
    """The likeliest of the seven classes; 0 where the share of the rest exceeds `other`."""
    best = (1 + shares[..., 1:].argmax(-1)).astype(np.uint8)
    return np.where(shares[..., 0] > other, 0, best).astype(np.uint8)


def evaluate(segmenter: Segmenter, frames: Frames, most: int = 60, size: int = 320) -> Dict[str, Any]:
    """IoU of each class and their mean over four level views of 75 degrees of each frame, all counted together."""
    matrix = np.zeros((len(CLASSES), len(CLASSES)), np.int64)
    for k in range(min(most, len(frames))):
        i = k * len(frames) // min(most, len(frames))
        rgb, (classes, _) = frames.rgb(i), frames.classes(i)
        for turn in range(4):
            rays = crop_rays(size, size, np.radians(75)) @ rotation(turn * np.pi / 2 + 0.3 * k, 0.0, 0).T
            truth = sample(classes, rays, nearest=True)
            shares, _ = segmenter.photograph(sample(rgb, rays), (size,))
            known = truth != IGNORED
            matrix += np.bincount(truth[known].astype(int) * len(CLASSES) + shares.argmax(-1)[known], minlength=matrix.size).reshape(matrix.shape)
    return scores(matrix)


def scores(matrix: _Array) -> Dict[str, Any]:
    """IoU of the seven classes (None: not there), their mean, and the share of right pixels, of a matrix truth x prediction."""
    hit = np.diag(matrix)
    union = matrix.sum(0) + matrix.sum(1) - hit
    iou: Dict[str, Optional[float]] = {name: float(hit[i] / union[i]) if matrix[i].sum() else None for i, name in enumerate(CLASSES) if i}
    there = [v for v in iou.values() if v is not None]
    return {"iou": iou, "miou": float(np.mean(there)) if there else None, "accuracy": float(hit.sum() / max(1, matrix.sum()))}


