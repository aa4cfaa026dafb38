"""Scores of pictures and flights: pure functions of the compiled module.

Pictures are (H, W, 3) uint8 sRGB of the same size, paths (N, 3) metres; anything else is a ValueError.
"""
from . import _native as _native  # says what is missing where it cannot be loaded
from ._native.metrics import flip, ndtw, path_length, psnr, spl, ssim, ws_psnr

__all__ = ["flip", "ndtw", "path_length", "psnr", "spl", "ssim", "ws_psnr"]
