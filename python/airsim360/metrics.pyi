"""Scores of pictures, predictions and flights: pure functions of the compiled module, the same as of `airsim360 eval`.

Pictures are (H, W, 3) uint8 sRGB of the same size, paths (N, 3) metres; anything else is a ValueError.
Truths that a numpy.ma array hides are not valid in depth, flow, semantic, panoptic and tracking; elsewhere hidden elements are a ValueError.
"""
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

_Picture = npt.NDArray[np.uint8]
_Numbers = npt.NDArray[Any]
_Path = Sequence[Sequence[float]] | npt.NDArray[Any]

__all__ = ["bfov_iou", "boxes", "depth", "entity", "flip", "flow", "keypoints", "layout", "mpde", "ndtw", "panoptic", "path_length", "psnr", "semantic", "spl", "ssim", "tracking", "vln", "ws_psnr"]

def psnr(a: _Picture, b: _Picture) -> float:
    """Peak signal-to-noise ratio, dB; infinity for equal pictures."""

def ws_psnr(a: _Picture, b: _Picture) -> float:
    """The same for panoramas, every row weighted by its solid angle."""

def ssim(a: _Picture, b: _Picture) -> float:
    """Mean structural similarity of luma, at most 1."""

def flip(reference: _Picture, test: _Picture, pixels_per_degree: float = 67.0206, wrap: bool = False) -> npt.NDArray[np.float32]:
    """FLIP of every pixel, (H, W) float32 in 0 … 1; wrap: the left border goes on at the right one."""

def path_length(path: _Path) -> float:
    """Metres along points (N, 3)."""

def spl(success: bool, shortest: float, flown: float) -> float:
    """Success weighted by path length: success * shortest / max(flown, shortest)."""

def ndtw(path: _Path, reference: _Path, threshold: float) -> float:
    """Normalised dynamic time warping of paths (N, 3), (M, 3), in (0, 1]; threshold: metres that count as success."""

def depth(prediction: _Numbers, truth: _Numbers, weights: str = "pixel", min_depth: float = 0.0, max_depth: float = ...) -> dict[str, float]:
    """Errors of ranges (H, W), metres, as a dict: absrel, sqrel, rmse, rmselog, log10, mae, d1, d2, d3, silog, tau, valid. weights: pixel or solid_angle."""

def semantic(prediction: _Numbers, truth: _Numbers, classes: Sequence[int], weights: str = "pixel") -> dict[str, Any]:
    """Classes of pictures (H, W) or of a stack (N, H, W), in one table: miou, miou_present, pixel_accuracy, macc, fwiou, iou and acc by id, confusion (n, n + 1)."""

def panoptic(prediction: _Numbers, truth: _Numbers, pred_categories: dict[int, int], categories: dict[int, int], crowds: Sequence[int] = ..., weights: str = "pixel") -> dict[int, dict[str, float]]:
    """Panoptic quality of ids (H, W), 0 = void, whose categories are dicts id -> category: a dict category -> pq, sq, rq, iou, tp, fp, fn."""

def entity(predictions: Sequence[_Numbers], scores: Sequence[_Numbers], truths: Sequence[_Numbers], weights: str = "pixel") -> dict[str, float]:
    """COCO's twelve figures of masks without categories: of each picture masks (K, H, W) and scores (K,)."""

def boxes(predictions: Sequence[Any], scores: Sequence[Any], truths: Sequence[Any], kind: str = "bbox", pred_categories: Sequence[Any] | None = None,
          categories: Sequence[Any] | None = None, crowds: Sequence[Any] | None = None, areas: Sequence[Any] | None = None,
          wrap: int | None = None) -> dict[str, Any]:
    """COCO's average precision of boxes (cocodataset.org/#detection-eval), lists of one entry a picture: predictions (K,
    columns), scores (K,), truths (G, columns). kind: bbox (x, y, width, height, pixels), bfov (lon, lat, width, height[,
    turn], radians) or box3d (centre x, y, z, length, width, height, metres, yaw, radians). pred_categories (K,) and
    categories (G,): whole numbers, both or neither (all are one). crowds (G,): 1 = a crowd. areas (G,): pixels, of bbox,
    instead of width * height. wrap: width of panoramas in pixels whose columns go round, of bbox. A dict: of bbox the
    twelve figures ap, ap50, ap75, ap_small, ap_medium, ap_large, ar1, ar10, ar100, ar_small, ar_medium, ar_large, else
    ap, ap50, ap75, ar; per_category, those of each id. -1 = no truth. ValueError names the argument that does not fit."""

def keypoints(predictions: Sequence[Any], scores: Sequence[Any], truths: Sequence[Any], boxes: Sequence[Any], sigmas: Any = None,
              pred_categories: Sequence[Any] | None = None, categories: Sequence[Any] | None = None, crowds: Sequence[Any] | None = None,
              areas: Sequence[Any] | None = None) -> dict[str, Any]:
    """COCO's average precision by object keypoint similarity (cocodataset.org/#keypoints-eval), lists of one entry a
    picture: predictions (K, n, 3), scores (K,), truths (G, n, 3): x, y in pixels, v above 0 where labelled; truths
    without any do not count. boxes (G, 4) of the truths: x, y, width, height, pixels. sigmas (n,): deviations relative to
    the root of the area, COCO's 17 by default. areas (G,): pixels, instead of width * height. Categories and crowds as of
    boxes. A dict: ap, ap50, ap75, ap_medium, ap_large, ar, ar50, ar75, ar_medium, ar_large; per_category. -1 = no truth.
    ValueError names the argument that does not fit."""

def flow(prediction: _Numbers, truth: _Numbers, weights: str = "pixel") -> dict[str, float]:
    """Errors of flow (H, W, 2) or (2, H, W), NaN = unknown: epe, fl_all, below1, below3, below5, angle_error_deg, valid."""

def vln(flown: _Path, reference: _Path, radius: float = 20.0, protocol: str = "ours", goal: Any = None, shortest: Any = None, stopped: bool = True, collided: bool = False) -> dict[str, float]:
    """Scores of one flown path (N, 3): sr, osr, spl, spl_straight, ne, ndtw, sdtw, cls, path_length."""

def mpde(distance: _Numbers, angle: _Numbers, true_distance: _Numbers, true_angle: _Numbers) -> dict[str, float]:
    """Errors of distances (N,), metres, and angles (N,), radians: count, distance_mae_m, angle_mae_deg, angle_unwrapped_mae_deg."""

def layout(prediction: _Numbers, truth: _Numbers, width: int = 1024) -> dict[str, float]:
    """Errors of a room of corners (2 N, 2) in pixels, ceiling and floor in turn: iou2d, iou3d, corner_error_percent, pixel_error_percent, rmse, d1."""

def tracking(pred_category: _Numbers, pred_instance: _Numbers, category: _Numbers, instance: _Numbers, things: Sequence[bool]) -> dict[str, float]:
    """STEP's stq, aq, sq, tubes of one video: arrays (T, H, W), 0xffffffff = void; things: a flag a category."""

def bfov_iou(a: _Numbers, b: _Numbers) -> float:
    """Unbiased intersection over union of boxes (lon, lat, width, height[, turn]) on the sphere, radians."""
