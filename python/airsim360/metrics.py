"""Scores of pictures, predictions and flights: pure functions of the compiled module, the same as of `airsim360 eval`.

Pictures are (H, W, 3) uint8 sRGB of the same size, paths (N, 3) metres; anything else is a ValueError.
Truths that a numpy.ma array hides are not valid in depth, flow, semantic, panoptic and tracking; elsewhere hidden elements are a ValueError.
"""
from . import _native as _native  # says what is missing where it cannot be loaded
from ._native.metrics import (bfov_iou, boxes, depth, entity, flip, flow, keypoints, layout, mpde, ndtw, panoptic, path_length, psnr, semantic, spl, ssim, tracking, vln, ws_psnr)

__all__ = ["bfov_iou", "boxes", "depth", "entity", "flip", "flow", "keypoints", "layout", "mpde", "ndtw", "panoptic", "path_length", "psnr", "semantic", "spl", "ssim", "tracking", "vln", "ws_psnr"]
